# SPDX-License-Identifier: Apache-2.0
"""The commands whose reports the package is made from; each is run, unless its report holds."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from boards.board import board_names
from common.errors import ROOT
from common.files import write_text
from common.run import Ended, run

from evidence.part import Context

GOOD_VERDICTS = ("proved", "passed", "good")
WRONG = ("failed", "problems", "findings", "gaps")  # What a report says of what is wrong.
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


def is_whole_and_good(report: dict[str, Any]) -> bool:
    """Whether a report speaks of everything, and well. One without a verdict lists what is wrong,
    or counts it, or has goals that are met or not."""
    if report.get("partial") or report.get("filter") or report.get("ok") is False:
        return False
    if report.get("verdict", GOOD_VERDICTS[0]) not in GOOD_VERDICTS:
        return False
    goals = report["goals"] if isinstance(report.get("goals"), list) else []
    unmet = [goal for goal in goals if not goal.get("met", True)]
    return not (unmet or any(report.get(what) for what in WRONG))


def still_holds(context: Context, command: Command) -> bool:
    """Whether a report is of the tree as it is now, and good."""
    problems: list[str] = []
    report = context.report(command.report, problems)
    return not problems and is_whole_and_good(report)


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
