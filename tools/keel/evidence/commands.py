# SPDX-License-Identifier: Apache-2.0
"""The commands whose reports the package is made from; each is run, unless its report holds."""

from __future__ import annotations

import functools
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.errors import ROOT
from keel.base.files import write_text
from keel.base.run import Ended, run, stop_all
from keel.base.source import GOOD, VERDICT
from keel.boards.board import board_names
from keel.gather.part import Context
from keel.gather.parts.tools import report_problems
from keel.install import Toolchain

PROOFS = "prove/report.json"
ELSEWHERE = "KEEL_PROVED"
PROVED = "proved"  # The word of make prove, whose reports are joined from those of shards.
TIMEOUT_S = 3600.0


@dataclass(frozen=True)
class Command:
    """A target of make, and the report below build/ that says how it ended."""

    report: str
    words: tuple[str, ...]
    # Whether it keeps one core busy, and needs nothing of those like it that stand beside it.
    narrow: bool = False

    @property
    def shown(self) -> str:
        """As one types it."""
        return " ".join(["make", *self.words])


def commands_of(root: Path) -> tuple[Command, ...]:
    """In the order in which they run: images are built before they are run and looked into."""
    boards = board_names(root)
    return (
        Command(PROOFS, ("prove-all",)),
        *(
            Command(f"firmware/{name}/report.json", ("firmware", f"BOARD={name}"), narrow=True)
            for name in boards
        ),
        Command("test-target/report.json", ("test-target",)),
        Command("test/report.json", ("test-all",)),
        Command("coverage-target/report.json", ("check", "NAME=coverage-target")),
        Command("contracts-run/report.json", ("check", "NAME=contracts-run")),
        Command("coverage/report.json", ("coverage",), narrow=True),
        Command("qualify/report.json", ("check", "NAME=qualify"), narrow=True),
        Command("eva/report.json", ("check", "NAME=eva"), narrow=True),
        Command("lint/report.json", ("lint",), narrow=True),
        Command("bench/report.json", ("bench",), narrow=True),
        Command("opinion/report.json", ("check", "NAME=opinion"), narrow=True),
        *(
            Command(f"stack/{name}.json", ("check", "NAME=stack", f"BOARD={name}"), narrow=True)
            for name in boards
        ),
    )


def own_commands() -> tuple[Command, ...]:
    """Those of a project that uses Keel."""
    rules = ("-f", str(ROOT / "keel.mk"))
    return (Command(PROOFS, (*rules, "prove")), Command("test/report.json", (*rules, "test")))


def handed_over(context: Context) -> list[str]:
    """Why the proofs of other machines, of which KEEL_PROVED=1 tells, cannot serve; none if they
    can, or if this machine proves."""
    if os.environ.get(ELSEWHERE) != "1":
        return []
    tools = Toolchain()
    tools.ensure("prove")
    problems: list[str] = []
    report = context.report(PROOFS, problems)
    if report and not is_good(report):
        problems.append(f"build/{PROOFS}: does not say that all is proved")
    specs = {spec.name: spec for spec in tools.lock.of_groups(("prove",))}
    problems += report_problems(PROOFS, report, specs, tools.versions("prove"))
    return [f"{problem} ({ELSEWHERE}=1: nothing is proved here)" for problem in problems]


Start = Callable[[Sequence[str], Path], Ended]


def start_make(words: Sequence[str], root: Path) -> Ended:
    """Run make, without the variables of the make that may have started us."""
    names = (
        "MAKEFLAGS",
        "MAKELEVEL",
        "MFLAGS",
        "ARGS",
        "UNIT",
        "BOARD",
        "PROJECT",
        "KEEL_ARGS",
        "KEEL_UNIT",
        "KEEL_PROJECT",
    )
    outside = dict.fromkeys(names, "")
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
    places = {
        command: f"[{number}/{len(commands)}] {command.shown}"
        for number, command in enumerate(commands, 1)
    }

    def ran(command: Command) -> str:
        return _run_one(context, command, places[command], start)

    told: list[str] = []
    for batch in batches(commands):
        told += _side_by_side([functools.partial(ran, command) for command in batch])
    return [problem for problem in told if problem]


def batches(commands: Sequence[Command]) -> list[list[Command]]:
    """Those that run at the same time: narrow ones that follow each other."""
    found: list[list[Command]] = []
    for command in commands:
        if command.narrow and found and found[-1][-1].narrow:
            found[-1].append(command)
        else:
            found.append([command])
    return found


def _side_by_side(tasks: Sequence[Callable[[], str]]) -> list[str]:
    """What each says, as many at once as there are cores. Whatever ends this ends all programs."""
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        try:
            return list(pool.map(lambda task: task(), tasks))
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            stop_all()
            raise


def _run_one(context: Context, command: Command, place: str, start: Start) -> str:
    """Run a command unless its report holds; what went wrong."""
    if still_holds(context, command):
        context.say(f"{place}: holds, build/{command.report} is of this source")
        return ""
    context.say(f"{place} ...")
    begun = time.monotonic()
    ended = start(command.words, context.root)
    context.say(f"{place}: {ended.how}, {time.monotonic() - begun:.0f} s")
    log = context.work / "logs" / f"{command.report.replace('/', '-')}.txt"
    write_text(log, ended.output)
    if ended.good:
        return ""
    last = (ended.output.strip().splitlines() or ["it said nothing"])[-1]
    return f"{command.shown}: {ended.how}: {last} (all of it: {log})"
