# SPDX-License-Identifier: Apache-2.0
"""What each harness bounds, why, what that leaves out, and what covers what is left out."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.files import read_text
from keel.c import source as csource
from keel.c.project import find_units
from keel.gather.part import Item, State, Table
from keel.judge.harness import Harness, read_harness

Report = Mapping[str, Any]

SIZE = re.compile(r"^-D(KEEL_\w+)=(\d+)u?$")
DRAWN = re.compile(r"\b(?:any_bits\w*|narrow_\w+)\((?:[^()]*,)?\s*(\d+)u?\s*\)")
# What a function asks of its caller, or another one's contract: no bound of the harness.
CONTRACT = re.compile(r"^!?\w*(?:_may|_does|valid_here)\(")
NUMBER = re.compile(r"(?<![\w.])(?!0u?\b)\d[\w.]*")
# A harness of one of several cases, on numbers that are chosen for it.
CHOSEN = ("exact", "points", "rounding", "same")
UNBOUNDED = "nothing: every input that the precondition allows"


@dataclass(frozen=True)
class Bounded:
    """A harness with its bounds."""

    harness: Harness
    reason: str  # The prose at its head.
    sizes: tuple[str, ...]  # Capacities that it makes smaller.
    numbers: tuple[str, ...]  # Numbers that it draws from fewer bits, or assumes.
    chosen: bool

    @property
    def unit(self) -> str:
        """The unit in whose folder it stands."""
        return self.harness.unit.name

    @property
    def id(self) -> str:
        """As an item."""
        return f"{self.unit}/{self.harness.name}"

    @property
    def place(self) -> str:
        """Its file."""
        return self.harness.path.relative_to(self.harness.unit.root).as_posix()

    @property
    def bounds(self) -> list[str]:
        """All that is bounded."""
        return [*self.sizes, *self.numbers, *(["chosen numbers"] if self.chosen else [])]

    @property
    def left_out(self) -> list[str]:
        """What the bounds leave out."""
        sizes = [f"larger than {text.replace('=', ' ')}" for text in self.sizes]
        numbers = [f"what breaks {text}" for text in self.numbers]
        return [*sizes, *numbers, *(["all other numbers"] if self.chosen else [])]

    @property
    def unwinding(self) -> str:
        """How far loops are unwound; that this is far enough is asserted, and proved."""
        options = list(self.harness.options)
        steps = options[options.index("--unwind") + 1] if "--unwind" in options else ""
        return f"{steps}, proved to be complete" if steps else "as far as they go"


def prose_of(path: Path) -> str:
    """What a harness's head says in words, behind its directives."""
    head = itertools.takewhile(lambda line: line.startswith("//"), read_text(path).splitlines())
    prose = itertools.dropwhile(lambda line: line.strip() != "//", head)
    return "\n".join(line.removeprefix("//").strip() for line in prose).strip()


def read_bounds(harness: Harness) -> Bounded:
    """A harness's bounds, from its directives and its text."""
    code = csource.code_only(read_text(harness.path))
    sizes = [f"{match[1]}={match[2]}" for word in harness.defines if (match := SIZE.match(word))]
    drawn = [" ".join(match[0].split()) for match in DRAWN.finditer(code)]
    assumptions = csource.calls(code, "__CPROVER_assume")
    assumed = [" ".join(call.arguments[0].split()) for call in assumptions if call.arguments]
    own = [text for text in assumed if not CONTRACT.match(text) and NUMBER.search(text)]
    case = harness.name.removesuffix("_harness").partition("__")[2]
    return Bounded(
        harness,
        prose_of(harness.path),
        tuple(sizes),
        tuple(dict.fromkeys([*drawn, *own])),
        case in CHOSEN,
    )


def read_all(root: Path) -> list[Bounded]:
    """The harnesses of all units."""
    return [
        read_bounds(read_harness(unit, path))
        for unit in find_units(root).values()
        for path in unit.harnesses
    ]


def cover_of(one: Bounded, every: Iterable[Bounded], report: Report) -> list[str]:
    """What proves the same function without the bounds of a harness."""
    function = one.harness.function
    found: list[str] = []
    for unit in report.get("units", {}).values():
        goals = [goal for goal in unit["wp"]["goal_list"] if goal["target"] == function]
        if goals and function not in unit["wp"]["not_by_wp"]:
            found.append(f"WP, {len(goals)} goals without bounds")
    found += [
        f"harness:{other.id}"
        for other in every
        if other.harness.function == function and not other.bounds
    ]
    return found


def problems(harnesses: Iterable[Bounded], report: Report) -> Iterator[str]:
    """A bound without a reason, a harness that the report lacks, and the other way round."""
    seen = set()
    units = report.get("units", {})
    for one in harnesses:
        seen.add(one.id)
        if one.bounds and not one.reason:
            yield f"{one.place}: bounds {', '.join(one.bounds)}, and its head does not say why"
        if units and one.harness.name not in units.get(one.unit, {}).get("cbmc", {}).get(
            "harnesses", {}
        ):
            yield f"{one.place}: build/prove/report.json has no verdict of it"
    for unit, found in units.items():
        for name, result in found["cbmc"]["harnesses"].items():
            if f"{unit}/{name}" not in seen:
                yield f"harness {unit}/{name}: has a verdict, but there is no file of it"
            elif not result["sound"]:
                yield f"harness {unit}/{name}: not sound, see the problems of make prove"


def items(harnesses: Iterable[Bounded], report: Report) -> Iterator[Item]:
    """Each harness, with its bounds and the numbers of its checks."""
    every = list(harnesses)
    public = {
        outcome["function"]
        for unit in report.get("units", {}).values()
        for outcome in unit["determined"]
    }
    for one in every:
        unit = report.get("units", {}).get(one.unit, {})
        result = unit.get("cbmc", {}).get("harnesses", {}).get(one.harness.name)
        facts = {
            "bounded": "; ".join(one.bounds) or UNBOUNDED,
            "loops are unwound": one.unwinding,
            "stand-ins by contract": " ".join(one.harness.replaces) or "none",
            "covers": " ".join(one.harness.covers),
            "file": one.place,
        }
        if result:
            labelled = len(result["assertions"])
            facts |= {
                "assertions": str(labelled),
                "built-in checks": str(result["properties"] - labelled),
                "proved": f"{result['proved']} of {result['properties']}",
                "checked": "everything" if result["checks"] == "all" else "assertions, unwinding",
            }
        function = one.harness.function
        own = [f"function:{function}"] if function in public else []
        state: State = ("good" if result["sound"] else "bad") if result else "open"
        yield Item(
            kind="harness",
            id=one.id,
            title=one.harness.name,
            text=one.reason,
            state=state,
            facts=facts,
            links=(f"unit:{one.unit}", *own),
        )


def table(harnesses: Iterable[Bounded], report: Report) -> Table:
    """All harnesses: what is bounded, what that leaves out, and what covers that."""
    every = list(harnesses)
    rows = [
        (
            f"harness:{one.id}",
            "; ".join(one.bounds) or UNBOUNDED,
            one.unwinding,
            "; ".join(one.left_out),
            " ".join(one.reason.split()),
            "; ".join(cover_of(one, every, report)) if one.bounds else "",
        )
        for one in every
    ]
    return Table(
        title="Harnesses and their bounds",
        columns=(
            "harness",
            "bounded",
            "loops unwound",
            "leaves out",
            "reason at its head",
            "covered by",
        ),
        rows=tuple(rows),
        note="A function's precondition and the contracts of its stand-ins are no bounds: the"
        " first is the caller's to keep, the others are proved by harnesses of their own."
        " Where nothing is named as cover, what is left out is not proved by this package.",
    )
