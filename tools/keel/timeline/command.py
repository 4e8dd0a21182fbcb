# SPDX-License-Identifier: Apache-2.0
"""Show a schedule as it ran: each run of each task, its release, its deadline, and the slack.

    python3 tools/keel schedule [build/fly/hover-jsbsim.ulg]

Without a log it runs the paper's 21 tasks for some seconds on the virtual board (examples/traced)
and leaves build/schedule/demo.ulg. Of what a board's console said (.txt or .log), it first makes a
log. Beside the log it writes two files of the same name: .pftrace
for Perfetto (ui.perfetto.dev), and .html for any browser. It prints a table of the tasks: their
times, how late their runs started, and how often each was longer than its budget, promoted,
skipped, or behind its deadline.

Exit status: 0, or 2 when the log cannot be read or made.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rich.console import Console

from keel.base.arguments import Parser
from keel.base.build import Build
from keel.base.errors import ROOT, ToolError, program
from keel.base.run import output_of
from keel.install import Toolchain
from keel.timeline import console, page, pftrace, picture, runs, table

BUILD = ROOT / "build/schedule"
FLAGS = (
    "-std=c99",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-Iinclude",
    "-Ibsp",
    "-Iexamples/urpilot",
)
SOURCES = (
    "src",
    "bsp/common/trace.c",
    "bsp/common/trace_log.c",
    "bsp/host/host_board.c",
    "examples/urpilot/urpilot_tasks.c",
    "examples/traced",
)
SECONDS_MOST = 3600
WIDTH = 160  # Of the table.
CONSOLES = (".txt", ".log")  # What a board's console said.
PICTURED_US = (1_000_000, 1_006_000)


def demo(tools: Toolchain, folder: Path, seconds: int) -> tuple[Path, str]:
    """The log of the 21 tasks, and what their scheduler counted."""
    program_path = Build(tools, "gcc", FLAGS, folder).program("traced", SOURCES, ("-lm",))
    log = folder / "demo.ulg"
    return log, output_of([str(program_path), str(log), str(seconds)])


def written(log: Path) -> tuple[runs.Schedule, list[Path]]:
    """A log's schedule, and the files that show it."""
    schedule = runs.read(log)
    files = [log.with_suffix(".pftrace"), log.with_suffix(".html")]
    pftrace.write(files[0], schedule)
    page.write(files[1], schedule, f"Schedule: {log.stem}")
    return schedule, files


def shown(path: Path) -> str:
    """A path as people read it."""
    return str(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path)


def tell(log: Path) -> runs.Schedule:
    """Write the files of a log and say so."""
    schedule, files = written(log)
    Console(width=WIDTH, highlight=False).print(table.table(schedule))
    ran = schedule.runs
    promoted, missed = int(ran["promoted"].sum()), int((ran["end"] > ran["deadline"]).sum())
    lost = f"; runs were lost at {len(schedule.dropouts)} places" if schedule.dropouts else ""
    print(
        f"schedule: {len(ran)} runs of {len(schedule.tasks)} tasks, {promoted} promoted, "
        f"{missed} behind their deadlines{lost}; {shown(files[0])} for ui.perfetto.dev, "
        f"{shown(files[1])} for any browser"
    )
    return schedule


def show(arguments: Sequence[str] | None) -> int:
    """Make a log, or take one; write and tell."""
    parser = Parser("Show a schedule as it ran.", "schedule")
    parser.add_argument(
        "file",
        nargs="?",
        metavar="FILE",
        help="a log in ULog with runs of tasks, or a board's console (.txt, .log)",
    )
    parser.add_argument("--seconds", type=int, default=10, help="of the demo, without FILE")
    parser.add_argument("--picture", action="store_true", help="draw the demo's for the documents")
    options = parser.parse_args(arguments)
    if not 1 <= options.seconds <= SECONDS_MOST:
        raise ToolError(f"--seconds: expected 1 to {SECONDS_MOST}, found {options.seconds}")
    if options.file:
        path = Path(options.file)
        tell(console.log_of(path) if path.suffix in CONSOLES else path)
        return 0
    log, _ = demo(Toolchain(), BUILD, options.seconds)
    schedule = tell(log)
    if options.picture:
        picture.plot(BUILD / "schedule.svg", schedule, *PICTURED_US)
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("schedule", lambda: show(arguments))
