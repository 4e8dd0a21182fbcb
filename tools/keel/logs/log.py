# SPDX-License-Identifier: Apache-2.0
"""Show a flight's log: a picture beside it, and tables.

    python3 tools/keel log build/fly/hover-jsbsim.ulg

The picture has attitude, place, motors, votes, the processor's load, and the spectrum of each
inertial unit while the motors turned (the paper's fig. 13); the tables have the topics, the tasks'
times and the strongest vibrations; a line says what the battery's current adds to the magnetic
field. Of a log of PX4 it has what is alike. Where the file is damaged
is told by the byte, and the rest is shown.

Exit status: 0, or 2 when the log cannot be read.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import read_text
from keel.flight import tables
from keel.logs import log_plots
from keel.logs.own_field import own_field
from keel.timeline import ulog

TOLD = 20  # Places of damage, one by one.
TASKS = ROOT / "examples/urpilot/urpilot_tasks.c"


def task_names() -> list[str]:
    """Those of table 2, in order, and the two beside them."""
    return [*re.findall(r'^    \{"([^"]+)",', read_text(TASKS), re.MULTILINE), "Log", "Telemetry"]


def tell_damage(path: Path, log: ulog.Log) -> None:
    """Where the file makes no sense, the first places of many, and how much was left out."""
    for damage in log.damage[:TOLD]:
        print(f"{path}: byte {damage.at}: {damage.reason}; {damage.size} bytes left out")
    if log.damage:
        print(
            f"{path}: {len(log.damage)} places are damaged; "
            f"{sum(damage.size for damage in log.damage)} bytes left out"
        )


def show(arguments: Sequence[str] | None) -> int:
    """Read, draw, print."""
    parser = Parser("Show a flight's log.", "log")
    parser.add_argument("file", metavar="FILE", help="a log in ULog, as build/fly/NAME.ulg")
    parser.add_argument("--picture", type=Path, metavar="FILE", help="default: beside the log")
    options = parser.parse_args(arguments)
    if not options.file:
        raise ToolError("which log? make log FILE=build/fly/hover-jsbsim.ulg")
    path = Path(options.file)
    log = ulog.read(path)
    picture: Path = options.picture or path.with_suffix(".log.svg")
    drawn = log_plots.plot_log(path.name, log, picture)
    console = tables.console()
    for table in (
        log_plots.topics(log),
        log_plots.tasks(log, task_names()),
        log_plots.vibration(log),
    ):
        if table:
            console.print(table)
    if magnetic := own_field(log):
        print(magnetic)
    for text in log.texts:
        print(f"{text.time_us / 1e6:10.3f} s  {text.text}")
    tell_damage(path, log)
    lost_ms = sum(length for _, length in log.dropouts)
    print(
        f"log: {len(log.dropouts)} dropouts, {lost_ms} ms; {log.cut} bytes cut off at the end; "
        + (f"{picture} drawn" if drawn else "it has nothing that a picture shows")
    )
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("log", lambda: show(arguments))
