# SPDX-License-Identifier: Apache-2.0
"""What passes and steps cost on the Cortex-M7: instructions, counted on the emulated machine.

The image (bench/bench_target.c) runs twice and must print the same
both times. Its figures stand beside the host's in a table and, as cortex_m7, in the report; each is
held against its budget in bench/budget.toml.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from keel.base.errors import ROOT, ToolError
from keel.base.files import read_text, write_json, write_text
from keel.base.source import VERDICT, verdict_of
from keel.config import Field, Mistake, Table, read_toml
from keel.install import Toolchain
from keel.test.emulated import EmulatedBoard

BUDGET = ROOT / "bench/budget.toml"
SOURCES = (
    "bench/bench_target.c",
    "examples/urpilot/urpilot_tasks.c",
    "examples/copter",
    "examples/copter_on_target/desk.c",
)
SHIFT = 10  # An instruction takes 1024 ns: more than a tick of the counter, which so sees each one.
LINE = re.compile(r"^bench (\w+) passes (\d+) instructions (\d+) longest (\d+)$", re.MULTILINE)
TIMEOUT_S = 120.0
GOAL_TASKS = "21"

# The figures: what they are, the kinds of passes that they are the mean of, the goal if any, and
# where the report has the host's figure.
FIGURES: dict[str, tuple[str, tuple[str, ...], int | None, tuple[str, ...]]] = {
    "no_task": ("pass, no task", ("waited", "idle"), 25, ("sets", GOAL_TASKS, "no_task")),
    "one_task": (
        "pass, one task of 21",
        ("realtime", "other"),
        200,
        ("sets", GOAL_TASKS, "one_task"),
    ),
    # What a pass costs that the analyser counts with (specs/tasksets/urpilot.toml).
    "several_tasks": ("pass, two or three tasks", ("several",), None, ()),
    "four_tasks": ("pass, four tasks", ("four",), None, ()),
    "imu": ("virtual IMU, 3 x 6, all agree", ("imu",), 900, ("steps", "imu")),
    "imu_worst": ("virtual IMU, 3 x 6, one outvoted", ("imu_worst",), 900, ("steps", "imu_worst")),
    "filter": ("filter step", ("filter",), 30, ("steps", "filter")),
    "pid": ("PID step, its filter included", ("pid",), 110, ("steps", "pid")),
    "reference": ("reference generator, four sticks", ("reference",), 150, ("steps", "reference")),
    "mixer": ("mixer, 4 motors, all fits", ("mixer",), 200, ("steps", "mixer")),
    "mixer_worst": (
        "mixer, 4 motors, all gives way",
        ("mixer_worst",),
        200,
        ("steps", "mixer_worst"),
    ),
    "mode": ("mode, in flight", ("mode",), 250, ("steps", "mode")),
    "mode_worst": ("mode, all facts waiting", ("mode_worst",), 250, ("steps", "mode_worst")),
    "attitude": ("attitude, all sensors in each", ("attitude",), 600, ("steps", "attitude")),
    "altitude": ("altitude, a pressure in each", ("altitude",), 250, ("steps", "altitude")),
    "position": ("position, a fix in each", ("position",), 500, ("steps", "position")),
    "cascade": ("cascade, all four stages", ("cascade",), 3000, ("steps", "cascade")),
    "battery": ("battery, two modules", ("battery",), 400, ("steps", "battery")),
    "calibration": ("calibration at rest", ("calibration",), 250, ("steps", "calibration")),
    "sbus": ("SBUS, a byte of right frames", ("sbus",), 100, ("steps", "sbus")),
    "sbus_worst": (
        "SBUS, a byte of nothing but headers",
        ("sbus_worst",),
        300,
        ("steps", "sbus_worst"),
    ),
    "ms5611": ("MS5611, a reading in frost", ("ms5611",), 300, ("steps", "ms5611")),
    "ubx": ("UBX, a byte of right messages", ("ubx",), 200, ("steps", "ubx")),
    "mavlink": ("MAVLink, a byte of right frames", ("mavlink",), 200, ("steps", "mavlink")),
    "signing": ("signatures, a right frame", ("signing",), 1500, ("steps", "signing")),
    "log_ring": ("log ring, a record of 36 bytes", ("log_ring",), 1200, ("steps", "log_ring")),
    "ulog": ("ULog, 36 bytes of data", ("ulog",), 1000, ("steps", "ulog")),
    # Begin, end and the record in the ring; the board's own clock is not in it.
    "trace": ("trace, a run of a task", ("trace",), None, ()),
    "lateness": ("lateness, a run of a task", ("lateness",), None, ()),
    "table_line": ("task table, a task's line", ("table_line",), None, ()),
    "spread": ("spread, once, 21 tasks", ("spread",), None, ()),
    "crsf": ("CRSF, a byte of right frames", ("crsf",), 200, ("steps", "crsf")),
    "ibus": ("IBUS, a byte of right frames", ("ibus",), 200, ("steps", "ibus")),
    "ppm": ("PPM, an edge of right frames", ("ppm",), 200, ("steps", "ppm")),
}
# The bodies of the 21 tasks of examples/copter, in flight, with what they read of their devices.
TASKS = (
    "scheduler_analysis",
    "stack",
    "adc",
    "background_power_module",
    "foreground_power_module",
    "background_barometer",
    "foreground_barometer",
    "background_magnetometer",
    "foreground_magnetometer",
    "calibration_magnetometer",
    "background_imu",
    "foreground_imu",
    "calibration_imu",
    "gps",
    "background_radio",
    "foreground_radio",
    "navigation",
    "angle_rate_control",
    "angle_control",
    "position_control",
    "state_machine",
)
FIGURES |= {
    f"task_{name}": (f"task: {name.replace('_', ' ')}", (f"task_{name}",), None, ())
    for name in TASKS
}


@dataclass(frozen=True)
class Figure:
    """What was counted of one kind."""

    passes: int
    instructions: int
    longest: int

    @property
    def mean(self) -> float:
        return self.instructions / self.passes if self.passes else 0.0


def read_figures(output: str) -> dict[str, Figure]:
    """What the image printed, by kind of pass."""
    if "\nbench ended\n" not in output:
        last = output.strip().splitlines()[-1:] or ["nothing"]
        raise ToolError(f"the target's bench did not end well; last it said: {last[0]}")
    return {name: Figure(*map(int, words)) for name, *words in LINE.findall(output)}


def together(kinds: Mapping[str, Figure], names: Sequence[str]) -> Figure:
    """Several kinds as one."""
    if missing := [name for name in names if not kinds.get(name, Figure(0, 0, 0)).passes]:
        raise ToolError(f"no pass was measured of the kind {missing[0]}")
    found = [kinds[name] for name in names]
    return Figure(
        sum(item.passes for item in found),
        sum(item.instructions for item in found),
        max(item.longest for item in found),
    )


def measure(tools: Toolchain) -> dict[str, Figure]:
    """Build, run twice, compare."""
    board = EmulatedBoard(tools)
    image = board.builder.link("bench", board.builder.objects(SOURCES))
    outputs = []
    for _ in range(2):
        ended = board.run(image, TIMEOUT_S, SHIFT)
        if not ended.good:
            raise ToolError(f"the target's bench: {ended.how}\n{ended.evidence}")
        outputs.append(ended.output)
    if outputs[0] != outputs[1]:
        raise ToolError("two runs on the emulated machine differ")
    kinds = read_figures(outputs[0])
    return {name: together(kinds, parts) for name, (_, parts, _, _) in FIGURES.items()}


Positive = Annotated[float, Field(gt=0, lt=1e9)]


class Budget(Table):
    """The budget file."""

    tolerance_percent: Positive
    instructions: dict[str, Positive]

    def limit(self, name: str) -> float:
        return self.instructions[name] * (1.0 + self.tolerance_percent / 100.0)


def odd_figures(budget: Budget) -> Iterator[Mistake]:
    """A budget has exactly the figures that there are."""
    for name in sorted(set(budget.instructions) ^ set(FIGURES)):
        reason = "is missing" if name in FIGURES else "is no figure"
        yield ("instructions", name), reason


def read_budget(path: Path) -> Budget:
    """Read and check the budget."""
    return read_toml(path, Budget, odd_figures)


def accept(path: Path, figures: Mapping[str, Figure]) -> None:
    """Write what was measured into the budget, and leave the rest of the file."""
    text = read_text(path)
    for name, figure in figures.items():
        text, count = re.subn(rf"(?m)^{name} = .*$", f"{name} = {figure.mean:.1f}", text)
        if count != 1:
            raise ToolError(f"{path.name}: {name} stands {count} times on a line of its own")
    write_text(path, text)


def exceeded(figures: Mapping[str, Figure], budget: Budget) -> list[str]:
    """The figures that are above their budget by more than the tolerance."""
    return [
        f"{FIGURES[name][0]} {figure.mean:.1f} > {budget.limit(name):.1f}"
        for name, figure in figures.items()
        if figure.mean > budget.limit(name)
    ]


def host_mean(report: Mapping[str, object], path: Sequence[str]) -> float | None:
    """The host's figure in the report of tools/keel bench."""
    item: object = report
    for key in path:
        item = item.get(key) if isinstance(item, Mapping) else None
    mean = item.get("mean") if path and isinstance(item, Mapping) else None
    return float(mean) if isinstance(mean, int | float) else None


def print_table(
    report: Mapping[str, object], figures: Mapping[str, Figure], budget: Budget
) -> None:
    print("\nInstructions, mean (longest)         host  Cortex-M7             budget   goal")
    for name, (label, _, goal, path) in FIGURES.items():
        host = host_mean(report, path)
        shown = f"{host:9.1f}" if host is not None else f"{'-':>9}"
        figure = figures[name]
        met = "-" if goal is None else f"{goal} {'met' if figure.mean <= goal else 'MISSED'}"
        print(
            f"  {label:30}{shown}{figure.mean:11.1f} ({figure.longest:5})"
            f"{budget.instructions[name]:11.1f}   {met}"
        )


def add(tools: Toolchain, report_file: Path, accepting: bool = False) -> list[str]:
    """Measure on the target, add it to the report of the host's figures, print both. Gives the
    figures above their budgets."""
    tools.ensure("target")
    try:
        figures = measure(tools)
        if accepting:
            accept(BUDGET, figures)
        budget = read_budget(BUDGET)
    except ToolError:
        report_file.unlink(missing_ok=True)  # Half a report must not look whole.
        raise
    report = json.loads(report_file.read_text())
    over = exceeded(figures, budget)
    report["cortex_m7"] = {
        "emulator": tools.versions("target")["qemu"].version,
        "figures": {
            name: {
                "passes": figure.passes,
                "instructions": figure.instructions,
                "mean": round(figure.mean, 2),
                "longest": figure.longest,
                "budget": budget.instructions[name],
                "goal": FIGURES[name][2],
            }
            for name, figure in figures.items()
        },
        "over_budget": over,
    }
    report[VERDICT] = verdict_of(not over)
    write_json(report_file, report)
    print_table(report, figures, budget)
    return over
