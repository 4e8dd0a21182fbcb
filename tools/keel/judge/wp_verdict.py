# SPDX-License-Identifier: Apache-2.0
"""Judges a run of WP: what is proved, and all that takes from the trust in it."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path

from keel.c import source as csource
from keel.c.project import shown
from keel.judge import goals, wp_log
from keel.judge.wp_targets import Result, Target

VARIANT = re.compile(r"(.*_loop_variant(?:_\d+)?_decrease)(?:_part\d+)?$")
CLAUSE = re.compile(r"\b(ensures|invariant|assert|requires|lemma)\s+(\w+)\s*:")
CLAUSE_LINES = 12  # of the longest clause that is shown whole

# Messages that take nothing from a proof.
HARMLESS = {
    "has no registered macro": "the headers are the compiler's own, they ask for no such macro",
    "Callers assumptions might be imprecise": "about \\from clauses, which WP does not use",
    "Failed smoke-test": "counted, and reported by name",
    "No goal generated": "a later stage finds nothing left; a target without goals is a failure",
}


def judge(
    target: Target,
    output: str,
    report: str,
    root: Path,
    allowed: Sequence[str] = (),
    recorded: Mapping[str, str] | None = None,
    pruned: frozenset[int] = frozenset(),
) -> Result:
    """What a run of WP shows, from its output and its JSON report.

    `pruned` are the passes that search for branches that cannot be taken.
    """
    log = wp_log.read_log(output)
    result = Result(smoke=sum(log.smoke.values()))
    result.goals = [
        {"name": goal.name, "status": goal.status, "prover": goal.prover}
        | ({} if goal.proved else {"place": place_of(target, goal.name, root)})
        for goal in log.goals.values()
    ]
    result.problems += _structure(target, log, report, output)
    result.problems += message_problems(log, allowed, result.allowed)
    result.problems += loop_problems(target, log)
    others = len(result.problems)
    result.problems += _unproved(target, log, root)
    # No prover refutes a goal here: each ends at a limit, of time or of what it tries.
    result.gave_up = not others and all(log.smoke.values()) and not log.all_proved
    result.stale = _stale(log, recorded or {})
    # Their prover would be asked in vain in the pass for recorded provers, which does not search.
    result.pruned = [goal.name for goal in log.goals.values() if goal.passes in pruned]
    return result


def _stale(log: wp_log.Log, recorded: Mapping[str, str]) -> list[str]:
    """The goals that their recorded prover did not prove, and who did. Qed is asked in any case."""
    found = []
    for goal in log.goals.values():
        before, now = recorded.get(goal.name), goals.short_name(goal.prover)
        if goal.proved and before and now not in (before, goals.QED) and before != goals.PRUNED:
            found.append(f"{goal.name}: recorded is {before}, but {now} proved it")
    return found


def survey_problems(log: wp_log.Log, file: str, proved: Collection[str]) -> list[str]:
    """What is wrong with a file as Frama-C sees it; `proved` are the functions proved anywhere.

    Its annotations are read behind the preprocessor, which may have made them of anything.
    """
    if not log.surveyed:
        return [f"{file}: Frama-C does not read it: {'; '.join(map(str, log.messages))}"]
    return [
        *(
            f"{text}: it is assumed, not proved; state a lemma or a contract"
            for text in log.assumed
        ),
        *(
            f"{file}: Frama-C sees the function {name}, which the driver does not"
            for name in log.functions
            if name not in proved
        ),
        *(
            f"{file}: {name} is declared here, and proved nowhere"
            for name in log.declared
            if name not in proved
        ),
    ]


def _structure(target: Target, log: wp_log.Log, report: str, output: str) -> list[str]:
    """What is wrong with the run as such."""
    try:
        totals = wp_log.read_report(json.loads(report))
    except (ValueError, AttributeError):
        tail = " | ".join(output.strip().splitlines()[-3:])
        return [f"{target.name}: WP wrote no report; it ended with: {tail}"]
    problems = []
    if difference := wp_log.disagreement(log, totals):
        problems.append(f"{target.name}: do not trust this run, WP's {difference}")
    if not log.goals:
        problems.append(f"{target.name}: WP has no goal for it")
    if target.function and target.function not in log.functions:
        problems.append(f"{target.name}: WP does not know this function")
    return problems


def message_problems(log: wp_log.Log, allowed: Sequence[str], used: list[str]) -> list[str]:
    """Warnings that nobody has declared harmless: each may be a hole in the proof."""
    problems = []
    for message in log.messages:
        if any(text in message.text for text in HARMLESS) and message.level == "Warning":
            continue
        exception = next((text for text in allowed if text in message.text), None)
        if exception is None:
            problems.append(f"{message}")
        elif exception not in used:
            used.append(exception)
    return list(dict.fromkeys(problems))


def _unproved(target: Target, log: wp_log.Log, root: Path) -> list[str]:
    """The goals that no prover proved, and the smoke tests that failed."""
    problems = []
    for goal in log.goals.values():
        if not goal.proved:
            tried = ", ".join(dict.fromkeys(goal.attempts)) or goal.status
            place = place_of(target, goal.name, root)
            problems.append(f"{goal.name} is not proved, provers gave up ({place}): {tried}")
    for name, passed in log.smoke.items():
        if not passed:
            seen = [m.place for m in log.messages if "Failed smoke-test" in m.text]
            places = ", ".join(seen) or "no place known"
            problems.append(f"smoke test {name} failed ({places}): a contradiction, or dead code")
    return problems


def loop_problems(target: Target, log: wp_log.Log) -> list[str]:
    """Every loop needs a variant, or the proof says nothing about its end."""
    if not target.function:
        return []
    for path in (target.file, *target.unit.own_files):
        text = csource.with_ghosts(csource.read(path))
        body = csource.body_of(text, target.function)
        if body:
            loops = csource.loops(body)
            named = (VARIANT.match(goal.name) for goal in log.goals.values())
            variants = {match.group(1) for match in named if match}  # a goal may come in parts
            if loops != len(variants):
                return [
                    f"{target.name}: {loops} loops, but {len(variants)} loop variants: does it end?"
                ]
            return []
    return []


def place_of(target: Target, goal: str, root: Path) -> str:
    """File and line of the clause that bears the goal's label, else of the function."""
    files = [*dict.fromkeys([*target.unit.own_files, target.file])]
    fallback = ""
    for path in files:
        text = csource.read(path)
        for first, last, line in _regions(text, target.function):
            fallback = f"{shown(path, root)}:{line}"
            for number, clause in enumerate(text.splitlines()[first:last], first + 1):
                label = CLAUSE.search(clause)
                if label and re.search(
                    rf"{label[1]}\w*_{label[2]}(_\d+)?(_established|_preserved)?$", goal
                ):
                    return f"{shown(path, root)}:{number}"
    return fallback or "no place known"


def clause_at(root: Path, place: str) -> str:
    """The text of the clause, or the line of code, that stands at FILE:LINE."""
    name, _, line = place.rpartition(":")
    if not line.isdigit() or not (root / name).is_file():
        return ""
    text = (root / name).read_text(encoding="utf-8").splitlines()[int(line) - 1 :]
    found = ""
    for one in text[:CLAUSE_LINES]:
        found += " " + one.strip().removeprefix("/*@").removeprefix("@").strip()
        if not CLAUSE.search(found) or found.rstrip().endswith((";", "*/")):
            break
    return found.strip()


def _regions(text: str, function: str | None) -> Iterator[tuple[int, int, int]]:
    """The lines of a function with its contract: from the end of what stands before it to its own.

    For lemmas, the whole text.
    """
    lines = text.count("\n") + 1
    if function is None:
        yield 0, lines, 1
        return
    first = 0
    for found in csource.functions(csource.with_ghosts(text)):
        last = text.count("\n", 0, found.body[1]) + 1 if found.body else found.line
        if found.name == function:
            yield first, last, found.line
        first = last
