# SPDX-License-Identifier: Apache-2.0
"""The commands whose reports the package is made from; each is run, unless its report holds."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from boards.board import board_names
from common.errors import ROOT
from common.files import write_text
from common.run import Ended, run
from common.source import GOOD, VERDICT

from evidence.part import Context

PROVED = "proved"  # The word of make prove, whose reports are joined from those of shards.
TIMEOUT_S = 3600.0


@dataclass(frozen=True)
class Command:
    """A target of make, and the report below build/ that says how it ended."""

    report: str
    words: tuple[str, ...]

    @property
    def shown(self) -> str:
        """As one types it."""
        return " ".join(["make", *self.words])


def commands_of(root: Path) -> tuple[Command, ...]:
    """In the order in which they run: images are built before they are run and looked into."""
    boards = board_names(root)
    return (
        Command("prove/report.json", ("prove",)),
        *(Command(f"firmware/{name}/report.json", ("firmware", f"BOARD={name}"))
          for name in boards),
        Command("test-target/report.json", ("test-target",)),
        Command("test/report.json", ("test",)),
        Command("coverage/report.json", ("coverage",)),
        Command("coverage-target/report.json", ("coverage-target",)),
        Command("contracts-run/report.json", ("contracts-run",)),
        Command("eva/report.json", ("eva",)),
        Command("qualify/report.json", ("qualify",)),
        Command("opinion/report.json", ("opinion",)),
        Command("lint/report.json", ("lint",)),
        *(Command(f"stack/{name}.json", ("stack", f"BOARD={name}")) for name in boards),
        Command("bench/report.json", ("bench",)),
    )  # fmt: skip


def own_commands() -> tuple[Command, ...]:
    """Those of a project that uses Keel."""
    rules = ("-f", str(ROOT / "keel.mk"))
    return (Command("prove/report.json", (*rules, "prove")),
            Command("test/report.json", (*rules, "test")))  # fmt: skip


Start = Callable[[Sequence[str], Path], Ended]


def start_make(words: Sequence[str], root: Path) -> Ended:
    """Run make, without the variables of the make that may have started us."""
    outside = {"MAKEFLAGS": "", "MAKELEVEL": "", "MFLAGS": "", "ARGS": "", "UNIT": "", "BOARD": ""}
    return run(["make", "--no-print-directory", *words], TIMEOUT_S, cwd=root, environment=outside)


def is_good(report: Mapping[str, Any]) -> bool:
    """Whether a report says of itself that all was looked at, and is good."""
    said = report.get(VERDICT)
    return said == GOOD or (said == PROVED and not report.get("partial"))


def still_holds(context: Context, command: Command) -> bool:
    """Whether a report is of the tree as it is now, and good."""
    problems: list[str] = []
    report = context.report(command.report, problems)
    return not problems and is_good(report)


def not_good(context: Context, commands: Sequence[Command]) -> Iterator[str]:
    """Reports that do not say that they are good; of those that cannot serve the parts tell."""
    for command in commands:
        report = context.report(command.report, [])
        if report and not is_good(report):
            said = f"its verdict is {report[VERDICT]!r}" if VERDICT in report else "has no verdict"
            partial = ", of a part alone" * bool(report.get("partial"))
            yield f"build/{command.report}: {said}{partial}: {command.shown}"


def run_commands(
    context: Context, commands: Sequence[Command], start: Start = start_make
) -> list[str]:
    """Run what has to be run, with progress; gives what went wrong."""
    problems: list[str] = []
    for number, command in enumerate(commands, 1):
        place = f"[{number}/{len(commands)}] {command.shown}"
        if still_holds(context, command):
            context.say(f"{place}: holds, build/{command.report} is of this source")
            continue
        context.say(f"{place} ...")
        begun = time.monotonic()
        ended = start(command.words, context.root)
        context.say(f"{place}: {ended.how}, {time.monotonic() - begun:.0f} s")
        log = context.work / "logs" / f"{command.report.replace('/', '-')}.txt"
        write_text(log, ended.output)
        if not ended.good:
            last = (ended.output.strip().splitlines() or ["it said nothing"])[-1]
            problems.append(f"{command.shown}: {ended.how}: {last} (all of it: {log})")
    return problems
