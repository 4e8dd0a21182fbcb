# SPDX-License-Identifier: Apache-2.0
"""Reads what WP says: the goals of its log, the totals of its JSON report, its warnings.

Frama-C exits 0 with goals unproved, so nothing here looks at an exit status. The verdict is that
of the JSON report; names and provers come from the log; the two must agree in every number.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

GOAL = re.compile(
    r"^\[wp\] \[(?P<by>[^\]]+)\] Goal (?:typed\w*?_)?(?P<name>\w+)(?: : (?P<status>\w+))?"
)
SMOKE = re.compile(r"^\[wp\] \[(?P<by>\w+)\] Smoke-test (?:typed\w*?_)?(?P<name>\w+)")
PASS = "[wp] Running WP plugin"
ATTEMPT = re.compile(r"^ +(?P<by>[\w-]+(?: [\d.]+)?): (?P<status>[A-Z]\w*)")
MESSAGE = re.compile(
    r"^\[(?P<who>[\w:.-]+)\] (?:(?P<place>[^\s:]+:\d+): )?"
    r"(?P<level>Warning|[\w ]*[Ee]rror|Failure|Unimplemented|Not supported): ?(?P<text>.*)$"
)
ABORT = re.compile(r"^\[(?P<who>[\w:.-]+)\] (?P<text>.*(?:aborted|Unexpected|unsupported).*)$")
CALL_POINT = re.compile(r"(_call_point_\w+)_s\d+$")
# What find_assumptions.ml tells.
ASSUMED = re.compile(r"^keel: assumed: (.*)$", re.MULTILINE)
DECLARED = re.compile(r"^keel: declared: (\w+)$", re.MULTILINE)
SURVEYED = "keel: looked"
ANNOTATED = re.compile(r"^\[rte:annot\] annotating function (\w+)$", re.MULTILINE)


@dataclass
class Goal:
    """One proof obligation and how far the provers got."""

    name: str
    status: str = ""
    prover: str = ""
    # How many passes of WP had begun when it was proved.
    passes: int = 0
    attempts: list[str] = field(default_factory=list)

    @property
    def proved(self) -> bool:
        """True when a prover said so."""
        return self.status == "Valid"


@dataclass(frozen=True)
class Message:
    """A warning or an error."""

    who: str
    place: str
    level: str
    text: str

    def __str__(self) -> str:
        return f"[{self.who}] {self.place + ': ' if self.place else ''}{self.level}: {self.text}"


@dataclass
class Log:
    """What a log says."""

    goals: dict[str, Goal] = field(default_factory=dict)
    smoke: dict[str, bool] = field(default_factory=dict)
    messages: list[Message] = field(default_factory=list)
    functions: list[str] = field(default_factory=list)
    # What annotations take for granted, and functions without a body; whether all was looked at.
    assumed: list[str] = field(default_factory=list)
    declared: list[str] = field(default_factory=list)
    surveyed: bool = False
    passes: int = 0

    @property
    def proved(self) -> int:
        """How many goals are proved."""
        return sum(goal.proved for goal in self.goals.values())

    @property
    def all_proved(self) -> bool:
        """Whether no goal is left."""
        return self.proved == len(self.goals)


def _note_goal(log: Log, match: re.Match[str]) -> Goal:
    """Record a goal line. A goal tried again by a later stage keeps its best status."""
    # A statement's number would change with every edit above it.
    name = CALL_POINT.sub(r"\1", match["name"])
    goal = log.goals.setdefault(name, Goal(name))
    status = match["status"] or "Unproved"
    if match["status"]:
        goal.attempts.append(f"{match['by']}: {status}")
    if not goal.proved:
        goal.passes = log.passes
        goal.status, goal.prover = status, match["by"] if status == "Valid" else ""
    return goal


def read_log(text: str) -> Log:
    """Read the output of Frama-C, all stages."""
    log = Log(
        functions=ANNOTATED.findall(text),
        assumed=ASSUMED.findall(text),
        declared=DECLARED.findall(text),
        surveyed=SURVEYED in text,
    )
    goal: Goal | None = None
    message: Message | None = None
    for line in text.splitlines():
        if message and line.startswith("  "):
            message = Message(
                message.who, message.place, message.level, f"{message.text} {line.strip()}".strip()
            )
            log.messages[-1] = message
            continue
        message = None
        log.passes += line.startswith(PASS)
        if match := GOAL.match(line):
            goal = _note_goal(log, match)
            continue
        if match := SMOKE.match(line):
            log.smoke[match["name"]] = match["by"] == "Passed"
        elif (match := ATTEMPT.match(line)) and goal:
            goal.attempts.append(f"{match['by']}: {match['status']}")
            continue
        elif match := MESSAGE.match(line):
            message = Message(match["who"], match["place"] or "", match["level"], match["text"])
            log.messages.append(message)
        elif match := ABORT.match(line):
            log.messages.append(Message(match["who"], "", "Error", match["text"]))
        goal = None
    return log


@dataclass(frozen=True)
class Totals:
    """The numbers of the JSON report, smoke tests included, and the properties not proved.

    A call through a pointer has a goal for each path to it, all with one name: repeated counts
    those that the log shows once.
    """

    total: int
    valid: int
    open: tuple[str, ...]
    repeated: int = 0
    repeated_valid: int = 0


def read_report(report: Mapping[str, Any]) -> Totals:
    """Read the JSON report. Anything but an explicit `valid` counts against a property."""
    overall = report.get("wp:global", {}).get("wp:main", {})
    unproved: list[str] = []
    repeated = repeated_valid = 0
    for part in ("wp:axiomatics", "wp:functions"):
        for group in report.get(part, {}).values():
            for name, provers in group.items():
                counts = provers.get("wp:main", {})
                if name != "wp:section" and counts.get("valid", 0) != counts.get("total", 0):
                    unproved.append(name)
                if CALL_POINT.search(name):
                    repeated += counts.get("total", 0) - 1
                    repeated_valid += max(counts.get("valid", 0) - 1, 0)
    return Totals(
        int(overall.get("total", 0)),
        int(overall.get("valid", 0)),
        tuple(unproved),
        repeated,
        repeated_valid,
    )


def disagreement(log: Log, totals: Totals) -> str:
    """In which number the log and the report differ, or ""."""
    counted = len(log.goals) + len(log.smoke)
    proved = log.proved + sum(log.smoke.values())
    if counted + totals.repeated != totals.total:
        return f"log shows {counted} goals and smoke tests, its report {totals.total}"
    if proved + totals.repeated_valid != totals.valid:
        return f"log shows {proved} proved or passed, its report {totals.valid}"
    if totals.open and log.proved == len(log.goals) and all(log.smoke.values()):
        return f"log leaves nothing open, its report {', '.join(totals.open)}"
    if bool(totals.open) != (totals.valid != totals.total):
        return "report has totals that differ from its entries"
    return ""
