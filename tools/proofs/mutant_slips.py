# SPDX-License-Identifier: Apache-2.0
"""Generates slips of thought: what an engineer may write who has understood a little less.

Wrong order, a stale value, the neighbour's field or index, a check that comes too late, a clause
forgotten, an update left out in one branch, two arguments exchanged, another constant of the same
kind. All of them are generated, wherever the text allows; none is picked.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from . import csource
from .declarations import Structures, structures
from .syntax import Node, found, parse, span, written

COMPOUND = (
    "if_statement", "for_statement", "while_statement", "do_statement", "switch_statement",
)  # fmt: skip
NO_STATEMENT = ("comment", "preproc_")
JUNCTIONS = ("&&", "||")
DECLARED = re.compile(r"(?:const\s+)?[A-Za-z_]\w*(?:\s*\*+\s*|\s+)(?:const\s+)?[A-Za-z_]\w*\s*;")
LEAVES = re.compile(r"(?:return|break|continue|goto)\b")
# A field of an object is written, and a variable that is no object.
WRITES = re.compile(r"(?P<left>\w+(?:->|\.|\[)[\w.\[\]>+ -]*?)\s*[-+*/|&]?=(?!=)[^;]*;", re.S)
# A variable is written, or declared with a value; and what else may write in a value.
COMPUTES = re.compile(
    r"(?:(?:const\s+)?\w+(?:\s*\*\s*(?:const\s+)?|\s+))?(\w+)\s*"
    r"(?:[-+*/|&]?=(?!=)([^;]*)|\+\+|--);", re.S
)  # fmt: skip
SIDE_EFFECT = re.compile(r"\+\+|--|(?<![=!<>])=(?!=)")
LOCAL = re.compile(r"(?:[\w ]+[\s*]+)?\w+\s*[-+*/|&]?=(?!=)")
CALL = re.compile(r"\b([a-z_]\w*)\s*\(")
CONSTANT = re.compile(r"[A-Z][A-Z0-9]*_[A-Z0-9_]+")
FUNCTION = re.compile(r"[a-z_]\w*")


@dataclass(frozen=True)
class Change:
    """A piece of text to be replaced."""

    kind: str
    start: int
    end: int
    replacement: str


@dataclass(frozen=True)
class Surroundings:
    """What the headers say: structures, and constants that belong together."""

    structures: Structures = field(default_factory=dict)
    families: tuple[tuple[str, ...], ...] = ()


def surroundings(texts: Iterable[str]) -> Surroundings:
    """Structures and families of constants of these texts."""
    every = list(texts)
    families = [family for text in every for family in _families(text)]
    return Surroundings(structures(every), tuple(families))


def _families(text: str) -> Iterator[tuple[str, ...]]:
    """Enumerations, and macros that stand line by line and begin alike."""
    for node in found(parse(text), "enumerator_list"):
        yield tuple(written(one.children[0]) for one in found(node, "enumerator"))
    block: list[str] = []
    last = -1
    for node in found(parse(text), "preproc_def"):
        name, value = (written(node.child_by_field_name(field)) for field in ("name", "value"))
        if not value or not CONSTANT.fullmatch(name):
            continue
        follows = node.start_point.row == last and name.split("_")[:2] == block[0].split("_")[:2]
        if not follows and len(block) > 1:
            yield tuple(block)
        block = [*(block if follows else ()), name]
        last = node.start_point.row + 1
    if len(block) > 1:
        yield tuple(block)


@dataclass(frozen=True)
class Item:
    """A statement of a block: `word` is the keyword of one that has blocks of its own."""

    node: Node
    word: str
    blocks: tuple[Node, ...] = ()

    @property
    def start(self) -> int:
        """Where it starts."""
        return self.node.start_byte

    @property
    def end(self) -> int:
        """Behind its brace or semicolon."""
        return self.node.end_byte


def items(block: Node) -> list[Item]:
    """The statements between two braces."""
    statements = (one for one in block.named_children if not one.type.startswith(NO_STATEMENT))
    return [Item(one, _word(one), tuple(_blocks(one))) for one in statements]


def _word(node: Node) -> str:
    return node.type.removesuffix("_statement") if node.type in COMPOUND else ""


def _blocks(node: Node) -> Iterator[Node]:
    """The blocks of a statement, those of what else it does, too."""
    if node.type == "compound_statement":
        yield node
    elif node.type in (*COMPOUND, "else_clause"):
        for child in node.named_children:
            yield from _blocks(child)


def blocks(block: Node) -> Iterator[list[Item]]:
    """The statements of a block, and of all blocks in it."""
    own = items(block)
    yield own
    for item in own:
        for inner in item.blocks:
            yield from blocks(inner)


def changes(text: str, code: str, block: Node, around: Surroundings) -> Iterator[Change]:
    """All slips of thought in the body of a function."""
    for own in blocks(block):
        yield from _order(text, code, own)
        yield from _branches(code, own)
        yield from _stale(code, own)
    yield from _clauses(block)
    yield from _members(block, around.structures)
    yield from _indices(block)
    yield from _arguments(code, block)
    yield from _constants(block, around.families)


def _order(text: str, code: str, own: list[Item]) -> Iterator[Change]:
    """Two statements exchanged; a statement before the check that may refuse."""
    for one, two in zip(own, own[1:], strict=False):
        second = code[two.start : two.end]
        if two.word or DECLARED.fullmatch(second) or LEAVES.match(second):
            continue
        first = code[one.start : one.end]
        exchanged = (
            text[two.start : two.end] + text[one.end : two.start] + text[one.start : one.end]
        )
        if one.word == "if" and re.search(r"\breturn\b", first):
            if not LOCAL.match(second):
                yield Change("early", one.start, two.end, exchanged)
        elif not one.word and not DECLARED.fullmatch(first) and not (
            _commute(first, second) or _are_apart(first, second, code)
        ):
            yield Change("order", one.start, two.end, exchanged)


def _commute(first: str, second: str) -> bool:
    """Whether two assignments to fields of one object plainly touch nothing in common."""
    one, two = WRITES.fullmatch(first), WRITES.fullmatch(second)
    if not one or not two or CALL.search(first + second):
        return False
    left, right = (
        re.findall(r"\w+", re.sub(r"\[[^]]*\]", "", match["left"])) for match in (one, two)
    )
    length = min(len(left), len(right))
    if left[0] != right[0] or left[:length] == right[:length]:
        return False
    return not (re.search(rf"\b{left[-1]}\b", second) or re.search(rf"\b{right[-1]}\b", first))


def _are_apart(first: str, second: str, code: str) -> bool:
    """Whether two local variables are computed, neither from the other."""
    one, two = COMPUTES.fullmatch(first), COMPUTES.fullmatch(second)
    if not one or not two or CALL.search(first + second):
        return False
    if any(SIDE_EFFECT.search(value) for value in (one[2] or "", two[2] or "")):
        return False
    others = ((one[1], second), (two[1], first))
    return not any(re.search(rf"\b{name}\b", text) or re.search(rf"&\s*{name}\b", code)
                   for name, text in others)  # fmt: skip


def _branches(code: str, own: list[Item]) -> Iterator[Change]:
    """A branch left out: the whole of an if, or what it does otherwise."""
    for item in own:
        if item.word != "if":
            continue
        yield Change("branch", item.start, item.end, ";")
        for inner in item.blocks[1:]:
            if inner.named_children:
                yield Change("branch", inner.start_byte + 1, inner.end_byte - 1, "")


def _stale(code: str, own: list[Item]) -> Iterator[Change]:
    """A value that is computed, but not taken: what was there before is used on."""
    for item in own:
        one = item.node.named_children[0] if item.node.type == "expression_statement" else None
        right = one.child_by_field_name("right") if one else None
        if one and right and written(one.child_by_field_name("operator")) == "=":
            value = code[right.start_byte : right.end_byte]
            if "(" in value:
                yield Change("stale", item.start, item.end, f"(void)({value});")


def _clauses(block: Node) -> Iterator[Change]:
    """One clause of a condition forgotten."""
    for node in found(block, "binary_expression"):
        left, operator, right = node.children
        if operator.type in JUNCTIONS:
            if written(left.child_by_field_name("operator")) not in JUNCTIONS:
                yield Change("clause", left.start_byte, operator.end_byte, " ")
            yield Change("clause", operator.start_byte, right.end_byte, " ")


def _neighbours(names: list[str], name: str) -> list[str]:
    """The names beside one, the last being beside the first."""
    place = names.index(name)
    found = [names[(place + 1) % len(names)], names[place - 1]]
    return [other for other in dict.fromkeys(found) if other != name]


def _members(block: Node, structures: Structures) -> Iterator[Change]:
    """Another field of the same type, of a structure that has the field."""
    for node in found(block, "field_identifier"):
        name = written(node)
        called = node.parent and node.parent.parent and node.parent.parent.type == "call_expression"
        for fields in () if called else structures.values():
            own = next((one for one in fields if one.name == name), None)
            if not own:
                continue
            kind = (own.type, own.pointer, own.size)
            alike = [one.name for one in fields if (one.type, one.pointer, one.size) == kind]
            for other in _neighbours(alike, own.name):
                yield Change("field", *span(node), other)


def _indices(block: Node) -> Iterator[Change]:
    """Another index: of another variable, the next one, the first one."""
    every = (one.child_by_field_name("index") for one in found(block, "subscript_expression"))
    indices = [one for one in every if one and one.type == "identifier"]
    used = list(dict.fromkeys(map(written, indices)))
    for node in indices:
        name = written(node)
        others = [other for other in used if other != name and not CONSTANT.fullmatch(other)]
        for other in (*others, f"{name} + 1u", "0u"):
            yield Change("index", *span(node), other)


def _arguments(code: str, block: Node) -> Iterator[Change]:
    """Two arguments of a call exchanged."""
    for call in csource.calls(block, FUNCTION.pattern):
        nodes = call.node.children[1].named_children
        given = [" ".join(code[one.start_byte : one.end_byte].split()) for one in nodes]
        for place, (one, two) in enumerate(zip(given, given[1:], strict=False)):
            if one != two:
                exchanged = ", ".join([*given[:place], two, one, *given[place + 2 :]])
                yield Change("arguments", nodes[0].start_byte, nodes[-1].end_byte, exchanged)


def _constants(block: Node, families: tuple[tuple[str, ...], ...]) -> Iterator[Change]:
    """Another constant of the same family."""
    for node in found(block, "identifier"):
        for family in families:
            if written(node) in family:
                for other in _neighbours(list(family), written(node)):
                    yield Change("family", *span(node), other)
