#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Show a flight's log: a picture beside it, and tables.

    python3 tools/with_packages.py fly tools/log.py build/fly/hover-jsbsim.ulg

The picture has attitude, place, motors, votes, the processor's load, and the spectrum of each
inertial unit while the motors turned (the paper's fig. 13); the tables have the topics, the tasks'
times and the strongest vibrations.

Exit status: 0, or 2 when the log cannot be read.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from common.arguments import Parser  # noqa: E402
from common.errors import ROOT, ToolError, program  # noqa: E402
from common.files import read_text  # noqa: E402
from flight import log_plots, tables, ulog  # noqa: E402

TASKS = ROOT / "examples/urpilot/urpilot_tasks.c"


def task_names() -> list[str]:
    """Those of table 2, in order, and the two beside them."""
    return [*re.findall(r'^    \{"([^"]+)",', read_text(TASKS), re.MULTILINE), "Log", "Telemetry"]


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
    log_plots.plot_log(path.name, log, picture)
    console = tables.console()
    console.print(log_plots.topics(log))
    console.print(log_plots.tasks(log, task_names()))
    console.print(log_plots.vibration(log))
    for time_us, text in log.texts:
        print(f"{time_us / 1e6:10.3f} s  {text}")
    lost_ms = sum(length for _, length in log.dropouts)
    print(f"log: {len(log.dropouts)} dropouts, {lost_ms} ms; {log.cut} bytes cut off at the end; "
          f"{picture} drawn")  # fmt: skip
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("log", lambda: show(arguments))


if __name__ == "__main__":
    sys.exit(main())
