# SPDX-License-Identifier: Apache-2.0
"""Says of a goal that is not proved in which line it stands, and what its provers' words mean.

A clause has a label, by which its line is known. What WP checks besides, such as a division or an
access to memory, has none: WP knows its line, and tells it when it prints the goals.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path

from keel.base.jobs import Runner
from keel.engines.wp import Stage, Wp
from keel.judge.wp_targets import Result, Target
from keel.prove.sequents import Sequent, bearing, read_sequents

NUMBER = re.compile(r"_(\d+)$")
ANSWER = re.compile(r"(?<=: )(?:Unknown|Timeout|Stepout|Failed)\b")
# Z3 is ended by the system at its limit of processor time, and why3 takes that for a failure.
MEANINGS = {
    "Unknown": "could not tell",
    "Timeout": "came to the limit of its time",
    "Stepout": "came to the limit of its steps",
    "Failed": "ended without an answer, at the limit of its time or by a fault of its own",
}
NO_PROVER = Stage(("none",), 1)


class Printer:
    """Has WP print the goals of a target, which it does without a prover in a second or two."""

    def __init__(self, prover: Wp, runner: Runner, scratch: Path) -> None:
        self._prover = prover
        self._runner = runner
        self._scratch = scratch

    def __call__(self, target: Target) -> str:
        """What WP prints."""
        report = self._scratch / f"{target.identity}-printed.json"
        command = self._prover.command(target, [NO_PROVER], False, report)
        return self._runner.run([*command, "-wp-print"]).output


def in_words(answers: str) -> str:
    """What provers answered, each answer in words."""
    return ANSWER.sub(lambda match: MEANINGS[match[0]], answers)


def locate(result: Result, printed: Callable[[], str]) -> None:
    """Give each goal that is not proved its line, and its problem words that people understand.

    `printed` is what WP prints of the target's goals: asked for only if there is something open.
    """
    still_open = [goal for goal in result.goals if goal["status"] != "Valid"]
    if not still_open:
        return
    sequents = read_sequents(printed(), ())
    names = [goal["name"] for goal in result.goals]
    for goal in still_open:
        before, now = goal.get("place", ""), line_of(goal["name"], names, sequents)
        goal["place"] = now or before
        start = f"{goal['name']} is not proved"
        result.problems = [
            in_words(text.replace(f"({before})", f"({goal['place']})"))
            if text.startswith(start)
            else text
            for text in result.problems
        ]


def line_of(goal: str, names: Sequence[str], sequents: Sequence[Sequent]) -> str:
    """The FILE:LINE that WP tells of a goal; empty when it tells none, or leaves a doubt.

    WP numbers goals of one kind in the order in which it prints them.
    """
    kind = NUMBER.sub("", goal)
    number = NUMBER.search(goal)
    alike = bearing(goal, sequents)
    index = int(number[1]) - 1 if number else 0
    if len(alike) != sum(NUMBER.sub("", name) == kind for name in names) or index >= len(alike):
        return ""
    return "" if alike[index].claim == "true" else alike[index].place
