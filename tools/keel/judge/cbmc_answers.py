# SPDX-License-Identifier: Apache-2.0
"""Reads what CBMC answers: what is proved, what is reached, what refutes a wrong body."""

from __future__ import annotations

import json
import posixpath
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from keel.judge.harness import Harness
from keel.judge.wrong_bodies import WrongBody

HARMLESS = (
    # Said of every coverage run; the proof itself has unwinding assertions.
    "--cover is incompatible with --unwinding-assertions",
    "Use --unwinding-assertions to obtain sound verification results",
)
# CBMC's words, and those of the reader: a failure comes with a counterexample.
VERDICTS = {"FAILURE": "REFUTED by a counterexample"}
ASSERTION = re.compile(r"\.assertion\.\d+$")


@dataclass(frozen=True)
class Answer:
    """CBMC's JSON output, taken apart."""

    properties: list[dict[str, str]]
    goals: list[dict[str, Any]]
    warnings: list[str]
    complete: bool
    failed: bool = False
    # CBMC was ended at the limit of its time.
    gave_up: bool = False
    # With --stop-on-fail: the execution that fails, step by step.
    trace: list[dict[str, Any]] = field(default_factory=list)

    @property
    def first_failure(self) -> str:
        """What fails at the end of the trace."""
        failures = [step for step in self.trace if step.get("stepType") == "failure"]
        return str(failures[0].get("reason", "")) if failures else ""


def file_of(location: dict[str, Any]) -> str:
    """File of a source location."""
    return posixpath.normpath(str(location.get("file", "?")))


def place(location: dict[str, Any]) -> str:
    """File and line of a source location."""
    return f"{file_of(location)}:{location.get('line', '?')}"


def read_answer(text: str) -> Answer:
    """Read CBMC's JSON output. Output that breaks off is not complete."""
    try:
        entries = json.loads(text)
    except ValueError:
        return Answer([], [], ["CBMC's output breaks off"], complete=False)
    properties: list[dict[str, str]] = []
    goals: list[dict[str, Any]] = []
    warnings: list[str] = []
    complete = failed = False
    trace: list[dict[str, Any]] = []
    for entry in entries if isinstance(entries, list) else []:
        if entry.get("messageType") in ("WARNING", "ERROR"):
            warnings.append(str(entry.get("messageText", "")))
        for item in entry.get("result", []):
            location = item.get("sourceLocation", {})
            properties.append(
                {
                    "name": str(item["property"]),
                    "description": str(item["description"]),
                    "status": str(item["status"]),
                    "place": place(location),
                    "function": str(location.get("function", "")),
                }
            )
        goals += entry.get("goals", [])
        # A solver that crashes or says `unknown` makes it "error".
        ended = entry.get("cProverStatus") in ("success", "failure")
        complete = complete or ended or "goalsCovered" in entry
        failed = failed or entry.get("cProverStatus") == "failure"
        trace += entry.get("trace", [])
    return Answer(properties, goals, warnings, complete, failed, trace=trace)


def numbers(ranges: str) -> set[int]:
    """The lines in "18,20-22"."""
    lines: set[int] = set()
    for part in ranges.split(","):
        first, _, last = part.partition("-")
        lines.update(range(int(first), int(last or first) + 1))
    return lines


POINTER_CALL = re.compile(r"[.>]\w+\(")


@dataclass(frozen=True)
class Block:
    """A basic block of the code and whether any execution reaches it."""

    function: str
    places: frozenset[tuple[str, int]]
    first: str
    reached: bool


def blocks(goals: Iterable[dict[str, Any]]) -> list[Block]:
    """The blocks of a coverage run."""
    found = []
    for goal in goals:
        places = frozenset(
            (posixpath.normpath(file), line)
            for file, functions in goal.get("basicBlockLines", {}).items()
            for ranges in functions.values()
            for line in numbers(ranges)
        )
        location = goal.get("sourceLocation", {})
        function = str(location.get("function", ""))
        found.append(Block(function, places, place(location), goal.get("status") == "satisfied"))
    return found


def proof_problems(answer: Answer) -> list[str]:
    """Every property that is not proved, and reasons not to believe the rest."""
    problems = [
        f"{item['place']}: {item['description']}: {VERDICTS.get(item['status'], item['status'])}"
        f" ({item['name']})"
        for item in answer.properties
        if item["status"] != "SUCCESS"
    ]
    problems += [text for text in answer.warnings if not any(known in text for known in HARMLESS)]
    if not answer.complete:
        problems.append("CBMC did not finish")
    elif not any(ASSERTION.search(item["name"]) for item in answer.properties):
        problems.append("there is no assertion in it")
    return problems


def coverage_problems(
    found: Sequence[Block], harness: Harness, properties: Sequence[dict[str, str]]
) -> list[str]:
    """What no execution reaches: the harness's end, an assertion, a block of what it covers."""
    problems = []
    ends = [block for block in found if block.function == harness.name]
    last = max((line for block in ends for _, line in block.places), default=0)
    if not any(block.reached and any(line == last for _, line in block.places) for block in ends):
        problems.append(
            "no execution reaches the harness's end: its assumptions contradict each other"
        )
    reached = {f"{file}:{line}" for block in found if block.reached for file, line in block.places}
    for item in properties:
        if ASSERTION.search(item["name"]) and item["place"] not in reached:
            problems.append(f"{item['place']}: no execution reaches this assertion")
    for function in harness.covers:
        own = [block for block in found if block.function == function]
        if not own:
            problems.append(f"{function} is covered nowhere: it is never called")
        problems += [
            f"{block.first}: not reached in {function}"
            for block in own
            if not block.reached and not _is_dispatch(block, reached, harness.unit.root)
        ]
    return list(dict.fromkeys(problems))


def _is_dispatch(block: Block, reached: frozenset[str] | set[str], root: Path) -> bool:
    """Whether a block is only what CBMC makes of a call through a pointer that hits no function.

    CBMC turns the call into a choice of functions and a remainder that no valid pointer reaches.
    The call's own line is reached all the same, or this is no such block.
    """
    return bool(block.places) and all(
        f"{file}:{line}" in reached
        and POINTER_CALL.search((root / file).read_text(encoding="utf-8").splitlines()[line - 1])
        for file, line in block.places
    )


def refutation_problems(answer: Answer, wrong: WrongBody) -> list[str]:
    """Why a wrong body does not count as refuted; nothing if it does."""
    shown = wrong.shown
    if not answer.complete:
        return [f"{shown}: CBMC did not finish: {' '.join(answer.warnings)}"]
    failed = [item["description"] for item in answer.properties if item["status"] == "FAILURE"]
    if not failed:
        wanted = ", ".join(wrong.expect)
        return [f"{shown}: {wrong.harness} does not refute this wrong body at {wanted}: too weak"]
    return [
        f"{shown}: {wrong.harness} fails, but not at {expected}; it fails at: {'; '.join(failed)}"
        for expected in wrong.expect
        if not any(expected in description for description in failed)
    ]
