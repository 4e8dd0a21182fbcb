# SPDX-License-Identifier: Apache-2.0
"""A small evidence package for the tests of its frame: two units, and one thing of each kind."""

from __future__ import annotations

import json
import tempfile
import unittest
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from keel.install.packages import provide

provide("common")
provide("evidence")

from keel.base.source import STAMP as MADE_FROM
from keel.evidence.assemble import Assembled, assemble
from keel.evidence.package import Source
from keel.gather.part import Context, Item, Part, Table

ROOT = Path(__file__).resolve().parents[2]

STAMP = {"commit": "c" * 40, "tree": "d" * 64, "product": "e" * 64}
SOURCE = Source(STAMP, 1_750_000_000)
LONG = "keel_queue_earliest_release_of_all_tasks_that_wait_for_their_turn"
CONTRACT = "/*@ requires \\valid(queue);\n  @ ensures QUE_001_count: queue->count == 0u;\n  @*/"
BOUNDS = "tasks: 8, as shipped\nperiods: 5 bits, since a release moves on"


def requirements() -> Part:
    """What is wanted."""
    items = [
        Item(
            kind="requirement",
            id=f"{unit[:3].upper()}-{number:03}",
            title=f"It shall {number}",
            text="It shall count.\n\nAnd go on.",
            state="good",
            links=(f"unit:{unit}",),
        )
        for unit in ("queue", "voter")
        for number in range(1, 13)
    ]
    units = [Item(kind="unit", id=unit, title=f"The {unit}") for unit in ("queue", "voter")]
    return Part(
        name="requirements",
        title="Requirements",
        items=(*items, *units),
        summary={"requirements": "24"},
    )


def formal() -> Part:
    """What is proved."""
    function = Item(
        kind="function",
        id="keel_queue_init",
        title="Empties a queue",
        text=CONTRACT,
        state="good",
        links=("unit:queue", "requirement:QUE-001"),
    )
    other = Item(kind="function", id=LONG, title="The earliest", links=("unit:queue",))
    harness = Item(
        kind="harness",
        id="queue/keel_queue_init_harness",
        title="Any queue",
        text=BOUNDS,
        state="good",
        facts={"unwound": "completely"},
        links=("function:keel_queue_init",),
    )
    goals = [
        Item(
            kind="goal",
            id=f"queue/keel_queue_init_ensures_QUE_001_{number}",
            title="count is 0",
            state="open" if number == 7 else "good",
            facts={"prover": "z3"},
            links=("function:keel_queue_init", "requirement:QUE-001"),
        )
        for number in range(60)
    ]
    asserted = Item(
        kind="goal",
        id="queue/keel_queue_init_harness/QUE_001",
        title="as the model",
        state="good",
        links=("harness:queue/keel_queue_init_harness",),
    )
    assumption = Item(
        kind="assumption",
        id="A-01",
        title="Pointers are valid",
        links=("function:keel_queue_init",),
    )
    table = Table(
        title="Bounds",
        columns=("harness", "bound", "why"),
        note="Not the time it took.",
        rows=(("harness:queue/keel_queue_init_harness", "8", "as shipped " * 30),),
    )
    return Part(
        name="formal",
        title="Formal verification",
        tables=(table,),
        items=(function, other, harness, *goals, asserted, assumption),
    )


def sample_tests() -> Part:
    """What was sample_tests, and what the tests do not see."""
    ran = [
        Item(
            kind="test",
            id=f"unit/test_queue/test_{number}_adds",
            title="It adds",
            state="good",
            links=("requirement:QUE-001", "unit:queue"),
        )
        for number in range(9)
    ]
    mutants = [
        Item(
            kind="mutant",
            id=f"queue/{number}",
            title="< for <=",
            state="good",
            text="- a < b\n+ a <= b",
            links=("function:keel_queue_init",),
        )
        for number in range(8)
    ]
    return Part(name="tests", title="Tests", items=(*ran, *mutants), text="One.\n\nTwo.")


SAMPLE: dict[str, Callable[[Context], Part]] = {
    "requirements": lambda _: requirements(),
    "formal": lambda _: formal(),
    "tests": lambda _: sample_tests(),
}


def context_in(folder: Path) -> Context:
    """A context in which no report is there yet, and which keeps silent."""
    for name in ("build", "work"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    return Context(folder, folder / "build", folder / "work", STAMP, lambda _: None)


def assembled(folder: Path, **parts: Callable[[Context], Part]) -> Assembled:
    """The sample, with other parts beside or instead of its own."""
    makers = {**SAMPLE, **parts}
    return assemble(context_in(folder), list(makers), lambda name: makers[name])


class PartTest(unittest.TestCase):
    """A part of Keel's package, made from a build folder of reports into which tests put faults."""

    maker: Callable[[Context], Part]

    def setUp(self) -> None:
        self.build = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))

    def write(self, name: str, report: Mapping[str, Any]) -> None:
        """Write a report with this tree's stamp, or the one that it has."""
        path = self.build / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps({MADE_FROM: STAMP, **report}), encoding="utf-8")

    def make(self) -> Part:
        """The part."""
        return type(self).maker(
            Context(ROOT, self.build, self.build / "work", STAMP, lambda _: None)
        )

    def problem(self) -> str:
        """The one problem of the part."""
        problems = self.make().problems
        self.assertEqual(len(problems), 1, problems)
        return problems[0]
