# SPDX-License-Identifier: Apache-2.0
"""Whether the image of a board, on the model of its chip, flies as the host's copter does.

The host's copter has as many inertial units, boots as long as the image, so that frames of the
radio meet the same turns of tasks, and its units count as coarsely as the board's.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from keel.base.errors import ToolError
from keel.flight import judge, loop, scenario
from keel.flight.board import BOARDS, BoardCopter
from keel.flight.judge import Finding
from keel.flight.library import Copter
from keel.flight.loop import Flight, Order, Trace
from keel.flight.pilot import Pilot, Sight

PLANT = "jsbsim"
LANDING = "landing"
ROLL_PITCH_DEG, PLACE_M, APART_MS = 1.0, 0.5, 100
# It touches the ground when it has not come down for half a second, which a speed near the limit
# begins anew.
LANDS_MS = 600
ARMS_S = 24.6
STEP_US, BOOTS_MS = 10, 2000
ROW_MS = 5
TURN_ROWS = 4  # A turn of the state machine.
RATE_COUNT = math.radians(1 / 16.4)
# Of each unit of the board, what a count is, by the data sheets: ICM-20689 and BMI055.
COUNTS = ((9.80665 / 2048, RATE_COUNT), (9.80665 / 128, RATE_COUNT))


class LatePilot(Pilot):
    """He switches on when the estimates no longer differ by what they met at the start, which in
    angle mode becomes metres: nobody holds the place there."""

    waited_s = 0.0

    def _wait(self, sight: Sight) -> None:
        self.waited_s += self.frame_s
        super()._wait(sight)
        self.armed = self.armed and self.waited_s >= ARMS_S


def flown(copter: Copter, asked: scenario.Scenario) -> Trace:
    """From the motors' start on."""
    return Flight(copter, Order(asked, PLANT, asked.seed), LatePilot).fly()


def compared(
    host: Copter, board: BoardCopter, whole: scenario.Scenario, name: str
) -> list[Finding]:
    """Fly a scenario with the host's copter and a board's; what is found of the board's flight."""
    asked = scenario.with_units(whole, BOARDS[name])
    with as_the_board(host, board, asked):
        theirs, own = flown(host, asked), flown(board, asked)
    found = [_broken(own), _states(own, theirs)]
    if all(one.good for one in found):
        found += [*differences(own, theirs), *_counts(own)]
    over = [task.name for task in board.timed() if not task.fits]
    found.append(Finding("over budget", ", ".join(over) or "none", "none", not over))
    return [*found, *judge.judged(asked, own, None)]


def differences(own: Trace, theirs: Trace) -> list[Finding]:
    """How far two flights with the same states are from each other."""
    apart_ms = [ROW_MS * abs(a - b) for a, b in zip(begins(own), begins(theirs), strict=True)]
    names = loop.state_names(own)
    landed = names.index(LANDING) + 1 if LANDING in names else len(apart_ms)
    angles = [math.degrees(largest(own, theirs, (name,))) for name in ("roll", "pitch")]
    place = largest(own, theirs, ("north", "east", "up"))
    return [
        _apart_in_time("states begin", max(apart_ms[:landed]), APART_MS),
        *(
            Finding(name, f"{angle:.2f} deg", f"{ROLL_PITCH_DEG} deg", angle <= ROLL_PITCH_DEG)
            for name, angle in zip(("roll", "pitch"), angles, strict=True)
        ),
        Finding("place", f"{place:.2f} m", f"{PLACE_M} m", place <= PLACE_M),
        _apart_in_time("lands", max(apart_ms[landed:], default=0), LANDS_MS),
    ]


def _apart_in_time(name: str, apart_ms: int, most_ms: int) -> Finding:
    return Finding(name, f"{apart_ms} ms apart", f"{most_ms} ms", apart_ms <= most_ms)


def begins(trace: Trace) -> list[int]:
    """The rows with which states begin, and the end."""
    changes = np.flatnonzero(np.diff(trace.view["state"])) + 1
    return [0, *changes.tolist(), len(trace.truth)]


def largest(own: Trace, theirs: Trace, names: tuple[str, ...]) -> float:
    """By how much columns differ at most. Each state counts from its begin, or from a turn of the
    state machine before or behind it: who comes home two centimetres earlier lands a turn earlier.
    """
    return max(
        min(
            _apart((own, here), (theirs, there), names, turn) for turn in (-TURN_ROWS, 0, TURN_ROWS)
        )
        for here, there in zip(pairwise(begins(own)), pairwise(begins(theirs)), strict=True)
    )


def _apart(
    one: tuple[Trace, tuple[int, int]],
    other: tuple[Trace, tuple[int, int]],
    names: tuple[str, ...],
    later: int,
) -> float:
    """By how much columns of a state differ, where the other one's is read so many rows later. A
    state of fewer rows than that says nothing."""
    (own, here), (theirs, there) = one, other
    rows = min(here[1] - here[0], there[1] - there[0]) - abs(later)
    if rows <= 0:
        return math.inf
    first, second = here[0] + max(0, -later), there[0] + max(0, later)
    return max(
        float(np.abs(own.column(it)[first:][:rows] - theirs.column(it)[second:][:rows]).max())
        for it in names
    )


def _broken(own: Trace) -> Finding:
    problem = own.problem or ("it crashed" if own.crash else "")
    return Finding("flies", problem or "to the end", "to the end", not problem)


def _states(own: Trace, theirs: Trace) -> Finding:
    names, wanted = (" > ".join(loop.state_names(trace)) for trace in (own, theirs))
    return Finding("states", names, wanted, names == wanted)


def _counts(own: Trace) -> Iterator[Finding]:
    """Periods that were skipped, and runs beyond their budgets, since the motors started."""
    before, after = own.done
    for kind in ("skipped", "overruns"):
        count = int((after[kind] - before[kind]).sum())
        yield Finding(kind, str(count), "0", count == 0)
    idle = int((after["runs"] == before["runs"]).sum())
    yield Finding("tasks without a run", str(idle), "0", idle == 0)


@contextlib.contextmanager
def as_the_board(host: Copter, board: BoardCopter, asked: scenario.Scenario) -> Iterator[None]:
    """The host's copter boots as long as the board's, and its units count as coarsely."""
    boot_us = first_run_us(board, asked) - first_run_us(host, asked)
    with _with(host, "boot_us", boot_us), _with(host, "run_until", _on_counts(host)):
        yield


def first_run_us(copter: Copter, asked: scenario.Scenario) -> int:
    """From power-up to the end of the first run of a task, among the devices of a flight."""
    begun = Flight(copter, Order(asked, PLANT, asked.seed))
    run_until, seen_us = copter.run_until, list[int]()

    def run_in_steps(time_us: int) -> int:
        for now_us in range(time_us - 1000 + STEP_US, time_us + 1, STEP_US):
            if status := run_until(now_us):
                return int(status)
            if copter.done()["runs"].any():
                seen_us.append(now_us)
        return 0

    with _with(copter, "run_until", run_in_steps):
        for now_ms in range(1, BOOTS_MS):
            begun.step(now_ms)
            if seen_us:
                return seen_us[0]
    raise ToolError(f"no task runs within {BOOTS_MS} ms")


def _on_counts(copter: Copter) -> Callable[[int], int]:
    """Runs a copter on samples of whole counts."""
    run_until = copter.run_until

    def run(time_us: int) -> int:
        for imu, (force, rate) in zip(copter.sensors["imu"], COUNTS, strict=False):
            imu["accelerometer"] = force * np.round(imu["accelerometer"] / force)
            imu["gyroscope"] = rate * np.round(imu["gyroscope"] / rate)
        return int(run_until(time_us))

    return run


@contextlib.contextmanager
def _with(copter: Copter, name: str, value: Any) -> Iterator[None]:
    """A copter one attribute of which is another for a while."""
    before = getattr(copter, name)
    setattr(copter, name, value)
    try:
        yield
    finally:
        setattr(copter, name, before)
