# SPDX-License-Identifier: Apache-2.0
"""What WP proves of functions whose postconditions are left to CBMC (units.toml, not_by_wp).

Their results are floats, on whose rounding WP's provers do not come to an end. All else is WP's all
the same: that nothing is written but what `assigns` names, that what is called is called within its
precondition, loop invariants, variants, pointers and integers. What WP does not prove of that is
named in units.toml, by_cbmc: a labelled precondition of a function that is called, or a loop
invariant, with the harness that asserts it. So nothing is left out in silence.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

from keel.c import source as csource
from keel.c.project import Unit
from keel.judge.harness import Harness, read_harness
from keel.judge.settings import Exceptions

if TYPE_CHECKING:
    from keel.judge.wp_targets import Target

# Whether a sum or a product of floats stays finite is CBMC's to check, for each operation.
NO_FLOATS = ("-warn-special-float", "none")
INVARIANT = re.compile(r"\bloop invariant (\w+):")
REQUIRES = re.compile(r"\brequires (\w+):")


def not_left(left: tuple[str, ...] | None) -> list[str]:
    """What WP proves, in the words of -wp-prop: all but these; nothing when it proves all."""
    return [] if left is None else ["-@ensures", *(f"-{label}" for label in left)]


def selection(left: tuple[str, ...] | None) -> list[str]:
    """The options that leave to CBMC what is CBMC's; nothing when WP proves all."""
    return [] if left is None else [f"-wp-prop={','.join(not_left(left))}", *NO_FLOATS]


def restricted(target: Target, exceptions: Exceptions) -> Target:
    """The target with what the exceptions leave to CBMC taken out of it."""
    if target.function not in exceptions.not_by_wp:
        return target
    entries = (entry.split() for entry in exceptions.by_cbmc)
    left = tuple(clause for function, clause, _ in entries if function == target.function)
    return dataclasses.replace(target, left=left)


def problems(unit: Unit, exceptions: Exceptions, units: Iterable[Unit]) -> list[str]:
    """Why something that WP does not prove may be proved by nobody."""
    contracts = preconditions(units)
    harnesses = {path.stem: read_harness(unit, path) for path in unit.harnesses}
    found = []
    for entry in exceptions.by_cbmc:
        function, clause, harness = entry.split()
        start = f"units.toml: [{unit.name}] by_cbmc: {function}, {clause}:"
        if function not in exceptions.not_by_wp:
            found.append(f"{start} only what not_by_wp names may leave a clause")
        elif harness not in harnesses:
            found.append(f"{start} there is no harness {harness}")
        else:
            complaint = _complaint(unit, function, clause, harnesses[harness], contracts)
            found += [f"{start} {complaint}"] if complaint else []
    return found + _unproved_postconditions(unit, exceptions)


def preconditions(units: Iterable[Unit]) -> dict[str, str]:
    """The function whose contract has a labelled precondition, by label."""
    found: dict[str, str] = {}
    for unit in units:
        for path in unit.own_files:
            for name, contract in contracts(csource.read(path)):
                found.update(dict.fromkeys(REQUIRES.findall(contract), name))
    return found


def contracts(text: str) -> list[tuple[str, str]]:
    """Each function, ghosts too, with the annotations that stand before it, after the last one."""
    text = csource.with_ghosts(text)
    lines = text.splitlines()
    found = []
    first = 0
    for function in csource.functions(text):
        last = text.count("\n", 0, function.body[1]) + 1 if function.body else function.line
        before = "\n".join(lines[first : function.line - 1])
        found.append((function.name, " ".join(inner for _, inner in csource.acsl(before))))
        first = last
    return found


def _body(unit: Unit, function: str) -> tuple[str, str]:
    """The body of a function: as code, and as it stands there."""
    for path in unit.own_files:
        text = csource.read(path)
        for found in csource.defined(text):
            if found.name == function and found.body:
                return csource.body_of(text, function), text[slice(*found.body)]
    return "", ""


def _complaint(
    unit: Unit, function: str, clause: str, harness: Harness, contracts: dict[str, str]
) -> str:
    """Why a harness does not prove a clause in WP's place."""
    code, text = _body(unit, function)
    if function not in harness.covers:
        return f"{harness.name} does not cover {function}"
    if clause in INVARIANT.findall(text):
        asserted = f'"{clause}:' in csource.read(harness.path)
        return "" if asserted else f"{harness.name} has no assertion {clause}"
    callee = contracts.get(clause, "")
    if not callee or not csource.calls(code, callee):
        return f"is no precondition of what {function} calls, and none of its loop invariants"
    if callee not in harness.replaces:
        return f"{harness.name} does not replace {callee}, so that nobody asserts its precondition"
    return ""


def _unproved_postconditions(unit: Unit, exceptions: Exceptions) -> list[str]:
    """A static function has no harness of its own that would prove its postcondition."""
    found = []
    for path in unit.own_files:
        text = csource.read(path)
        static = {function.name for function in csource.functions(text) if function.static}
        found += [
            f"{path.relative_to(unit.root)}: {name}: WP leaves its postcondition, which no harness"
            " can assert: callers may not rely on one"
            for name, contract in contracts(text)
            if name in static & set(exceptions.not_by_wp) and re.search(r"\bensures\b", contract)
        ]
    return found
