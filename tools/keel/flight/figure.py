# SPDX-License-Identifier: Apache-2.0
"""The picture of the project's first page: a flight in which an inertial unit freezes.

    python3 tools/keel flight-picture

Flies imu_freeze in JSBSim's F450 three times (with the vote, with a plain mean in its place, and
with nothing broken) and draws build/fly/flight.svg.

Exit status: 0 when it was drawn, 2 when it could not be flown.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from keel.base.errors import ROOT, program
from keel.base.plotting import BLUE, GREY, ORANGE, RED, new_figure, write_svg
from keel.flight import library, scenario
from keel.flight.library import Copter
from keel.flight.loop import Order, Trace, fly, without_faults
from keel.install import Toolchain

BUILD = ROOT / "build/fly"
PICTURE = BUILD / "flight.svg"
NAME, PLAIN, PLANT = "imu_freeze", "imu_freeze_plain", "jsbsim"
FROM_S, TO_S = 4.0, 20.0
EVERY = 10  # Rows of the trace for a point of a curve: 20 points a second.


def traces(copter: Copter) -> tuple[tuple[str, str, Trace], ...]:
    """The three flights, each with its label and colour."""
    voted, plain = (scenario.read(name, scenario.FOLDER) for name in (NAME, PLAIN))
    order = Order(voted, PLANT, voted.seed)
    return (
        ("nothing breaks", GREY, fly(copter, without_faults(order))),
        ("plain mean", ORANGE, fly(copter, Order(plain, PLANT, plain.seed))),
        ("Keel's vote", BLUE, fly(copter, order)),
    )


def draw(copter: Copter, path: Path) -> None:
    """Roll and height of the three, one above the other."""
    fault_s = scenario.read(NAME, scenario.FOLDER).fault[0].at_s
    figure = new_figure(7.5, 3.6)
    roll, height = figure.subplots(2, 1, sharex=True)
    for label, colour, trace in traces(copter):
        time = trace.column("time")
        shown = np.flatnonzero((time >= FROM_S) & (time <= TO_S))[::EVERY]
        width = 4.0 if colour == GREY else 1.2
        roll.plot(
            time[shown],
            np.degrees(trace.column("roll")[shown]),
            color=colour,
            label=label,
            linewidth=width,
        )
        height.plot(time[shown], trace.column("up")[shown], color=colour, linewidth=width)
    for axes in (roll, height):
        axes.axvline(fault_s, color=RED, linestyle="--", linewidth=0.8)
        axes.set_xlim(FROM_S, TO_S)
    roll.set_ylabel("roll, degrees")
    roll.set_ylim(-20.0, 60.0)
    roll.legend(loc="upper left", ncols=3)
    height.set_ylabel("height, m")
    height.set_xlabel(f"time in flight, s; from {fault_s:g} s on one of three units is frozen")
    write_svg(path, figure)


def main(_arguments: Sequence[str] | None = None) -> int:
    """Entry point."""

    def work() -> int:
        built = library.build(Toolchain(), BUILD)
        draw(Copter(built), PICTURE)
        print(f"flight: {PICTURE.relative_to(ROOT)} drawn")
        return 0

    return program("flight", work)
