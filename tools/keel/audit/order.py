# SPDX-License-Identifier: Apache-2.0
"""Refuses expressions whose outcome may depend on an order of evaluation that C leaves open.

Provers evaluate operands from left to right, a compiler in any order (ISO C11, 6.5p2 and p3). So
where one operand may write, by a call or by an assignment, no operand beside it may write, or read
what could be written: what a pointer or an array holds, a variable of the file, or a local one
whose address the function takes. A function writes nothing if its contract says so, `assigns
\\nothing`, which WP proves. The operands of &&, ||, ?: and the comma have an order of their own.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Set
from functools import lru_cache
from pathlib import Path

from keel.c import source as csource
from keel.c.project import KEEL
from keel.c.syntax import Node, found, parse, written
from keel.judge import wp_frames

ASSIGNS = re.compile(r"\bassigns\b([^;]*);")
BEHAVIOR = re.compile(r"\bbehavior\b")
ORDERED = frozenset(("&&", "||", ","))
KINDS = (
    "assignment_expression",
    "binary_expression",
    "call_expression",
    "initializer_list",
    "subscript_expression",
)
WRITES = ("assignment_expression", "update_expression")


@lru_cache(maxsize=1024)
def writes_nothing(text: str) -> frozenset[str]:
    """The functions whose contract in a text says that they write nothing."""
    names = set()
    for name, contract in wp_frames.contracts(text):
        # The frame of a behaviour holds in that behaviour alone.
        frames = [frame.strip() for frame in ASSIGNS.findall(BEHAVIOR.split(contract)[0])]
        if frames and all(frame == "\\nothing" for frame in frames):
            names.add(name)
    return frozenset(names)


def problems(root: Path) -> list[str]:
    """Such expressions in what a project builds."""
    texts = {
        path: csource.read(path)
        for pattern in ("include/**/*.h", "src/**/*.[ch]")
        for path in sorted(root.glob(pattern))
    }
    headers = {path for folder in (root, KEEL) for path in folder.glob("include/**/*.h")}
    shared = {name for path in headers for name in writes_nothing(csource.read(path))}
    return [
        f"{path.relative_to(root)}:{line}: {what}"
        for path, text in texts.items()
        for line, what in unordered(text, shared)
    ]


def unordered(text: str, shared: Set[str] = frozenset()) -> Iterator[tuple[int, str]]:
    """The expressions of a text whose operands must not come in another order, with their lines."""
    own = {function.name for function in csource.defined(text) if function.static}
    reader = _Reader(parse(csource.with_ghosts(text)), (shared - own) | writes_nothing(text))
    for node in found(reader.file, *KINDS):
        if reader.depends_on_order(node):
            line = node.start_point.row + 1
            yield line, f"`{written(node)}`: what comes out may depend on the order of evaluation"


class _Reader:
    """Tells operands that may write, and those that read what may be written."""

    def __init__(self, file: Node, harmless: Set[str]) -> None:
        self.file = file
        # A call by a pointer's name is one of whatever function it leads to.
        names = found(file, "declaration", "parameter_declaration")
        self._harmless = harmless - {name for one in names for name in _pointed(one)}
        declared = [one for one in file.children if one.type == "declaration"]
        variables = [
            name
            for one in declared
            if not found(one, "function_declarator") and not _is_constant(one)
            for name in found(one, "identifier")
        ]
        taken = [one for one in found(file, "pointer_expression") if written(one)[0] == "&"]
        roots = [_variable(one.child_by_field_name("argument")) for one in taken]
        self._reachable = {written(one) for one in (*variables, *roots)} - {""}

    def depends_on_order(self, node: Node) -> bool:
        """Whether one operand may write what another one reads or writes."""
        operands = self._operands(node)
        for index, one in enumerate(operands):
            others = operands[:index] + operands[index + 1 :]
            if self._writes(one):
                seen = self._reachable | _targets(one) | self._given(one)
                if any(self._writes(two) or _reads(two, seen) for two in others):
                    return True
        return False

    def _operands(self, node: Node) -> list[Node]:
        """The expressions that a node evaluates in any order."""
        inner = [one for one in node.named_children if one.type != "comment"]
        operator = written(node.child_by_field_name("operator"))
        if node.type == "binary_expression" and operator in ORDERED:
            return []
        if node.type == "assignment_expression" and operator == "=":
            left, right = inner
            return [right, *_evaluated(left)]
        if node.type == "call_expression":
            function, given = inner
            return [function, *(one for one in given.named_children if one.type != "comment")]
        return inner

    def _writes(self, node: Node) -> bool:
        called = (one.child_by_field_name("function") for one in found(node, "call_expression"))
        return bool(found(node, *WRITES)) or any(
            written(one) not in self._harmless for one in called
        )

    def _given(self, node: Node) -> set[str]:
        """The structures of which calls that may write are given a part: an array's address."""
        calls = [one for one in found(node, "call_expression") if self._writes(one)]
        parts = [part for one in calls for part in found(one, "field_expression")]
        return {written(_variable(one)) for one in parts} - {""}


def _pointed(declaration: Node) -> set[str]:
    """The pointers to functions that a declaration gives."""
    return {
        written(name)
        for one in found(declaration, "parenthesized_declarator")
        for name in found(one, "identifier")
    }


def _targets(node: Node) -> set[str]:
    """The variables that an expression itself changes."""
    changed = [one.child_by_field_name("left") for one in found(node, "assignment_expression")]
    changed += [one.child_by_field_name("argument") for one in found(node, "update_expression")]
    return {written(_variable(one)) for one in changed} - {""}


def _reads(node: Node, variables: Set[str]) -> bool:
    """Whether an expression reads one of these variables, or what a pointer or an array holds."""
    through = found(node, "field_expression", "subscript_expression", "call_expression")
    through += [one for one in found(node, "pointer_expression") if written(one)[0] == "*"]
    named = {written(one) for one in found(node, "identifier") if not _is_taken(one)}
    return bool(through) or bool(named & variables)


def _is_constant(declaration: Node) -> bool:
    qualifiers = [written(one) for one in declaration.children if one.type == "type_qualifier"]
    return "const" in qualifiers and not found(declaration, "pointer_declarator")


def _is_taken(name: Node) -> bool:
    """Whether a variable's address is taken here, which does not read the variable."""
    return name.parent is not None and written(name.parent) == f"&{written(name)}"


def _variable(place: Node | None) -> Node | None:
    """The variable that an object is part of; none where a pointer leads to it."""
    while place and place.type in ("parenthesized_expression", "subscript_expression"):
        place = place.named_children[0]
    if place and place.type == "field_expression":
        is_own = written(place.child_by_field_name("operator")) == "."
        return _variable(place.child_by_field_name("argument")) if is_own else None
    return place if place and place.type == "identifier" else None


def _evaluated(place: Node) -> list[Node]:
    """What has to be read to know which object an expression on the left names."""
    argument = place.child_by_field_name("argument")
    if place.type == "parenthesized_expression":
        return _evaluated(place.named_children[0])
    if not argument or (
        place.type == "field_expression" and written(place.child_by_field_name("operator")) == "->"
    ):
        return [argument] if argument else []
    if place.type == "pointer_expression":
        return [argument]
    index = place.child_by_field_name("index")
    return [*_evaluated(argument), *([index] if index else [])]
