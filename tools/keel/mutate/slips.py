# SPDX-License-Identifier: Apache-2.0
"""Generates slips of thought: what an engineer may write who has understood a little less.

Wrong order, a stale value, the neighbour's field or index, a check that comes too late, a clause
forgotten, an update left out in one branch, two arguments exchanged, another constant of the same
kind. All of them are generated, wherever the text allows; none is picked.

And slips that show beyond a bound alone: of what is proved within a bound, another body above it
would pass. An index or a count comes round, a loop ends, a condition changes, at a number that no
value within the bound reaches. None has a block of its own, which coverage would notice.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from keel.c import source as csource
from keel.c.declarations import Structures, macros, structures
from keel.c.syntax import Node, found, parse, span, written

COMPOUND = ("if_statement", "for_statement", "while_statement", "do_statement", "switch_statement")
NO_STATEMENT = ("comment", "preproc_")
JUNCTIONS = ("&&", "||")
DECLARED = re.compile(r"(?:const\s+)?[A-Za-z_]\w*(?:\s*\*+\s*|\s+)(?:const\s+)?[A-Za-z_]\w*\s*;")
LEAVES = re.compile(r"(?:return|break|continue|goto)\b")
# A field of an object is written, and a variable that is no object.
WRITES = re.compile(r"(?P<left>\w+(?:->|\.|\[)[\w.\[\]>+ -]*?)\s*[-+*/|&]?=(?!=)[^;]*;", re.S)
# A variable is written, or declared with a value; and what else may write in a value.
COMPUTES = re.compile(
    r"(?:(?:const\s+)?\w+(?:\s*\*\s*(?:const\s+)?|\s+))?(\w+)\s*"
    r"(?:[-+*/|&]?=(?!=)([^;]*)|\+\+|--);",
    re.S,
)
SIDE_EFFECT = re.compile(r"\+\+|--|(?<![=!<>])=(?!=)")
LOCAL = re.compile(r"(?:[\w ]+[\s*]+)?\w+\s*[-+*/|&]?=(?!=)")
CALL = re.compile(r"\b([a-z_]\w*)\s*\(")
MOST = 1 << 31  # Numbers beyond bounds stay below.
TIME = "_us"  # How the name of a time ends, in microseconds.
INTEGER = re.compile(r"u?int(?:8|16|32)_t")
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
    # By functions: numbers that nothing within the bounds reaches within which they are proved.
    beyond: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    # By fields that are arrays: how many elements.
    lengths: Mapping[str, int] = field(default_factory=dict)


def surroundings(
    texts: Iterable[str], beyond: Mapping[str, tuple[int, ...]] | None = None
) -> Surroundings:
    """Structures and families of constants of these texts, with numbers beyond bounds."""
    every = list(texts)
    families = [family for text in every for family in _families(text)]
    known = structures(every)
    return Surroundings(known, tuple(families), beyond or {}, _lengths(known, every))


def _lengths(known: Structures, texts: Iterable[str]) -> dict[str, int]:
    """How many elements each field has that is an array; the most, where several have its name."""
    said = macros(texts)
    found_ones: dict[str, int] = {}
    for one in (one for fields in known.values() for one in fields if one.size):
        _, text = said.get(one.size, ((), one.size))
        if number := re.fullmatch(r"(\d+)[uU]?", text):
            found_ones[one.name] = max(int(number[1]), found_ones.get(one.name, 0))
    return found_ones


def numbers_beyond(bounds: Iterable[str]) -> tuple[int, ...]:
    """Of bounds as proofs/determined.md has them: for each the next power of two above it, which
    no size, count or index within it reaches."""
    found_ones = set()
    for bound in bounds:
        text = re.sub(r"\(\d+ is shipped\)", "", bound)
        for bits in re.findall(r"\bany_bits(?:64)?\((\d+)", text):
            found_ones.add(1 << int(bits))
        text = re.sub(r"\bany_bits\w*\(.*?\)", "", text)
        for number in re.findall(r"(?:=|<=|<|\[|any_below\()\s*(\d+)", text):
            if int(number) > 1:
                found_ones.add(1 << int(number).bit_length())
    return tuple(sorted(one for one in found_ones if one < MOST))


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


def changes_beyond(
    code: str, block: Node, numbers: Iterable[int], around: Surroundings
) -> Iterator[Change]:
    """Slips that show at these numbers, or above, alone. An index of an array is below its length,
    and what counts it is at most the length: neither reaches a greater number."""
    ends = _ends(block, around.lengths)
    for number in numbers:
        for node in found(block, "subscript_expression"):
            index = node.child_by_field_name("index")
            if index and index.type == "identifier" and not CONSTANT.fullmatch(written(index)):
                if number < ends.get(written(index), MOST):
                    yield Change("beyond", *span(index), f"{written(index)} % {number}u")
        for node in found(block, "binary_expression"):
            yield from _relation_beyond(code, node, number, ends)
        for node in found(block, "for_statement", "while_statement", "do_statement"):
            yield from _loop_beyond(code, node, number, around.structures, ends)


def _ends(block: Node, lengths: Mapping[str, int]) -> dict[str, int]:
    """By variables and fields that are an index in a block: the shortest array's length."""
    ends: dict[str, int] = {}
    for node in found(block, "subscript_expression"):
        array = node.child_by_field_name("argument")
        name = written(array.child_by_field_name("field")) if array else ""
        if name in lengths:
            index = written(node.child_by_field_name("index"))
            ends[index] = min(lengths[name], ends.get(index, MOST))
    return ends


def _may_reach(name: str, number: int, ends: Mapping[str, int]) -> bool:
    """Whether a name is of an index or a count, which may come to a number. A time is neither."""
    return not name.endswith(TIME) and number <= ends.get(name, MOST)


def _relation_beyond(
    code: str, node: Node, number: int, ends: Mapping[str, int]
) -> Iterator[Change]:
    """A size that comes round in a comparison; a comparison that comes out otherwise above."""
    left, operator, right = node.children
    if operator.type not in ("<", "<=", ">", ">="):
        return
    for side in (left, right):
        name = written(side)
        if not _may_reach(name, number, ends):
            continue
        if side.type in ("identifier", "field_expression") and not CONSTANT.fullmatch(name):
            yield Change("beyond", *span(side), f"({name} % {number}u)")
            text = code[slice(*span(node))]
            yield Change("beyond", *span(node), f"(({text}) || ({name} >= {number}u))")
            yield Change("beyond", *span(node), f"(({text}) && ({name} < {number}u))")


def _loop_beyond(
    code: str, node: Node, number: int, known: Structures, ends: Mapping[str, int]
) -> Iterator[Change]:
    """A loop that ends by its head before what it counts comes so far; or, where it counts nothing
    itself, while a number beside what it looks at is so large."""
    condition = node.child_by_field_name("condition")
    if condition and condition.type == "parenthesized_expression":
        condition = condition.named_children[0]
    if not condition:
        return
    counted = {
        written(one.child_by_field_name("argument") or one.child_by_field_name("left"))
        for one in found(node, "update_expression", "assignment_expression")
    }
    text = code[slice(*span(condition))]
    looked_at = [name for name in sorted(counted) if _is_in(name, text)]
    for name in looked_at or _numbers_beside(condition, known):
        if _may_reach(name, number, ends):
            yield Change("beyond", *span(condition), f"({text}) && ({name} < {number}u)")


def _is_in(name: str, text: str) -> bool:
    """Whether a text has a variable or a field, as a whole."""
    return bool(re.search(rf"(?<![\w>.]){re.escape(name)}(?!\w|->|\.)", text))


def _numbers_beside(condition: Node, known: Structures) -> Iterator[str]:
    """The whole numbers of the structure whose fields a condition looks at."""
    for node in found(condition, "field_expression"):
        field_name = written(node.child_by_field_name("field"))
        start = written(node).removesuffix(field_name)
        for fields in known.values():
            if any(one.name == field_name for one in fields):
                for one in fields:
                    if INTEGER.fullmatch(one.type) and not one.pointer and not one.size:
                        yield f"{start}{one.name}"


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
        elif (
            not one.word
            and not DECLARED.fullmatch(first)
            and not (_commute(first, second) or _are_apart(first, second, code))
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
    return not any(
        re.search(rf"\b{name}\b", text) or re.search(rf"&\s*{name}\b", code)
        for name, text in others
    )


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
