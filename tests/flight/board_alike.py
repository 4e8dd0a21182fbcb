# SPDX-License-Identifier: Apache-2.0
"""A scenario in which the image of FMUv5, on the model of its chip, and the host's copter must fly
alike.

Both have two units. The host's copter boots as long as the image, so that frames of the radio meet
the same turns of tasks, and its units count as coarsely.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from keel.flight import judge, loop, scenario
from keel.flight.board import BOARDS, BoardCopter
from keel.flight.library import Copter
from keel.flight.loop import Flight, Order, Trace
from keel.flight.pilot import Pilot, Sight

ROLL_PITCH_DEG, PLACE_M = 1.0, 0.5
STEP_US = 10
BOOTS_MS = 2000
TURN_ROWS = 4  # Of 5 ms each: a turn of the state machine.
APART_ROWS = 20  # By so much a state may begin earlier or later.
RATE_COUNT = math.radians(1 / 16.4)
# Of each unit, what a count is, by the data sheets: ICM-20689 and BMI055.
COUNTS = ((9.80665 / 2048, RATE_COUNT), (9.80665 / 128, RATE_COUNT))
ARMS_S = 24.6


class LatePilot(Pilot):
    """He switches on when the estimates no longer differ by what they met at the start, which in
    angle mode becomes metres: nobody holds the place there."""

    waited_s = 0.0

    def _wait(self, sight: Sight) -> None:
        self.waited_s += self.frame_s
        super()._wait(sight)
        self.armed = self.armed and self.waited_s >= ARMS_S


def of_two_units(name: str) -> scenario.Scenario:
    """A scenario with as many units as the board has."""
    return scenario.with_units(scenario.read(name), BOARDS["fmuv5"])


def flight(copter: Copter, asked: scenario.Scenario, pilot: type[Pilot] = Pilot) -> Trace:
    """From the motors' start on."""
    trace = Flight(copter, Order(asked, "jsbsim", asked.seed), pilot).fly()
    assert not trace.problem and not trace.crash
    return trace


def begins(trace: Trace) -> list[int]:
    """The rows with which states begin, and the end."""
    changes = np.flatnonzero(np.diff(trace.view["state"])) + 1
    return [0, *changes.tolist(), len(trace.truth)]


def latest(trace: Trace, other: Trace) -> int:
    """By how many rows the begins of states are apart at most."""
    return max(abs(a - b) for a, b in zip(begins(trace), begins(other), strict=True))


def largest(trace: Trace, other: Trace, names: tuple[str, ...]) -> float:
    """By how much columns differ at most. Each state counts from its begin, or from a turn of the
    state machine before or behind it: who comes home two centimetres earlier lands a turn earlier.
    """
    return max(
        min(apart(trace, own, other, its, names, turn) for turn in (-TURN_ROWS, 0, TURN_ROWS))
        for own, its in zip(pairwise(begins(trace)), pairwise(begins(other)), strict=True)
    )


def apart(
    trace: Trace,
    own: tuple[int, int],
    other: Trace,
    its: tuple[int, int],
    names: tuple[str, ...],
    later: int,
) -> float:
    """By how much columns of a state differ, where the other one's is read so many rows later."""
    rows = min(own[1] - own[0], its[1] - its[0]) - abs(later)
    here, there = own[0] + max(0, -later), its[0] + max(0, later)
    return max(
        float(np.abs(trace.column(it)[here:][:rows] - other.column(it)[there:][:rows]).max())
        for it in names
    )


def since_begun(trace: Trace, kind: str) -> np.ndarray:
    """Counts of tasks since the motors started."""
    before, after = trace.done
    return np.asarray(after[kind] - before[kind])


def first_run_us(copter: Copter, asked: scenario.Scenario) -> int:
    """From power-up to the end of the first run of a task, among the devices of a flight."""
    begun = Flight(copter, Order(asked, "jsbsim", asked.seed))
    run_until, seen_us = copter.run_until, list[int]()

    def run_in_steps(time_us: int) -> int:
        for now_us in range(time_us - 1000 + STEP_US, time_us + 1, STEP_US):
            assert run_until(now_us) == 0
            if copter.done()["runs"].any():
                seen_us.append(now_us)
        return 0

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(copter, "run_until", run_in_steps)
        for now_ms in range(1, BOOTS_MS):
            begun.step(now_ms)
            if seen_us:
                return seen_us[0]
    raise AssertionError("no task runs")


def counted_as_the_board_does(copter: Copter) -> Callable[[int], int]:
    """Runs a copter on samples of whole counts."""
    run_until = copter.run_until

    def run(time_us: int) -> int:
        for imu, (force, rate) in zip(copter.sensors["imu"], COUNTS, strict=False):
            imu["accelerometer"] = force * np.round(imu["accelerometer"] / force)
            imu["gyroscope"] = rate * np.round(imu["gyroscope"] / rate)
        return int(run_until(time_us))

    return run


def check_alike(copter: Copter, board: BoardCopter, name: str) -> None:
    """Fly both."""
    asked = of_two_units(name)
    with pytest.MonkeyPatch.context() as patch:
        boot_us = first_run_us(board, asked) - first_run_us(copter, asked)
        patch.setattr(copter, "boot_us", boot_us)
        patch.setattr(copter, "run_until", counted_as_the_board_does(copter))
        host, own = flight(copter, asked, LatePilot), flight(board, asked, LatePilot)
    assert own.column("up").max() > 2.5
    assert loop.state_names(own) == loop.state_names(host)
    assert latest(own, host) <= APART_ROWS
    assert math.degrees(largest(own, host, ("roll", "pitch"))) <= ROLL_PITCH_DEG
    assert largest(own, host, ("north", "east", "up")) <= PLACE_M
    assert not since_begun(own, "skipped").any() and not since_begun(own, "overruns").any()
    assert since_begun(own, "runs").all()
    assert judge.is_good(asked, own, judge.judged(asked, own, None))
    assert [task.name for task in board.timed() if not task.fits] == []
