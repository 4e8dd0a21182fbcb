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

from . import csource, declarations
from .declarations import Structures

KEYWORD = re.compile(r"(if|else|for|while|do|switch)\b")
DECLARED = re.compile(r"(?:const\s+)?[A-Za-z_]\w*(?:\s*\*+\s*|\s+)(?:const\s+)?[A-Za-z_]\w*\s*;")
LEAVES = re.compile(r"(?:return|break|continue|goto)\b")
ASSIGNED = re.compile(
    r"(?P<left>[A-Za-z_*(][\w.\[\]>() -]*?)\s*(?<![=!<>])=(?!=)\s*(?P<right>.*);", re.S
)
# A field of an object is written, and a variable that is no object.
WRITES = re.compile(r"(?P<left>\w+(?:->|\.|\[)[\w.\[\]>+ -]*?)\s*[-+*/|&]?=(?!=)[^;]*;", re.S)
# A variable is written, or declared with a value; and what else may write in a value.
COMPUTES = re.compile(
    r"(?:(?:const\s+)?\w+(?:\s*\*\s*(?:const\s+)?|\s+))?(\w+)\s*"
    r"(?:[-+*/|&]?=(?!=)([^;]*)|\+\+|--);", re.S
)  # fmt: skip
SIDE_EFFECT = re.compile(r"\+\+|--|(?<![=!<>])=(?!=)")
LOCAL = re.compile(r"(?:[\w ]+[\s*]+)?\w+\s*[-+*/|&]?=(?!=)")
ENUM = re.compile(r"\benum(?:\s+\w+)?\s*\{(?P<body>[^}]*)\}")
DEFINE = re.compile(r"^[ \t]*#[ \t]*define[ \t]+([A-Z][A-Z0-9]*_[A-Z0-9_]+)[ \t]+\S")
INDEX = re.compile(r"\[\s*([A-Za-z_]\w*)\s*\]")
MEMBER = re.compile(r"(?:->|\.)\s*([A-Za-z_]\w*)\b(?!\s*\()")
CALL = re.compile(r"\b([a-z_]\w*)\s*\(")
CONSTANT = re.compile(r"\b[A-Z][A-Z0-9]*_[A-Z0-9_]+\b")


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
    return Surroundings(declarations.structures(every), tuple(families))


def _families(text: str) -> Iterator[tuple[str, ...]]:
    """Enumerations, and macros that stand line by line and begin alike."""
    bare = csource.without_comments(text)
    for match in ENUM.finditer(bare):
        names = [part.partition("=")[0].strip() for part in match["body"].split(",")]
        yield tuple(name for name in names if name)
    block: list[str] = []
    for line in [*bare.splitlines(), ""]:
        found = DEFINE.match(line)
        if found and (not block or found[1].split("_")[:2] == block[0].split("_")[:2]):
            block.append(found[1])
            continue
        if len(block) > 1:
            yield tuple(block)
        block = [found[1]] if found else []


@dataclass(frozen=True)
class Item:
    """A statement of a block: `word` is the keyword of one that has blocks of its own."""

    start: int
    end: int
    word: str
    blocks: tuple[tuple[int, int], ...] = ()


def items(code: str, start: int, end: int) -> list[Item]:
    """The statements between two braces."""
    found: list[Item] = []
    position = start
    while match := re.compile(r"\S").search(code, position, end):
        place = match.start()
        keyword = KEYWORD.match(code, place)
        if code[place] in "{}":
            position = place + 1
            continue
        item = _compound(code, place, end, keyword[1]) if keyword else None
        item = item or Item(place, _semicolon(code, place, end), "")
        if item.word == "else" and found:
            before = found.pop()
            item = Item(before.start, item.end, before.word, before.blocks + item.blocks)
        found.append(item)
        position = item.end
    return found


def _semicolon(code: str, start: int, end: int) -> int:
    """The index behind the semicolon that ends the statement at `start`."""
    depth = 0
    for position in range(start, end):
        depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(code[position], 0)
        if depth == 0 and code[position] == ";":
            return position + 1
    return end


def _compound(code: str, start: int, end: int, word: str) -> Item | None:
    """A statement with a block: up to its closing brace; None if it has no braces."""
    brace = code.find("{", start, end)
    if brace < 0:
        return None
    last = csource.closing(code, brace)
    stop = _semicolon(code, last, end) if word == "do" else last
    return Item(start, stop, word, ((brace + 1, last - 1),))


def blocks(code: str, start: int, end: int) -> Iterator[list[Item]]:
    """The statements of a block, and of all blocks in it."""
    own = items(code, start, end)
    yield own
    for item in own:
        for inner in item.blocks:
            yield from blocks(code, *inner)


def changes(text: str, code: str, body: tuple[int, int], around: Surroundings) -> Iterator[Change]:
    """All slips of thought in the body of a function."""
    start, end = body
    for own in blocks(code, start + 1, end - 1):
        yield from _order(text, code, own)
        yield from _branches(code, own)
        yield from _stale(code, own)
    yield from _clauses(code, start, end)
    yield from _members(code, start, end, around.structures)
    yield from _indices(code, start, end)
    yield from _arguments(code, start, end)
    yield from _constants(code, start, end, around.families)


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
            if code[slice(*inner)].strip():
                yield Change("branch", *inner, "")


def _stale(code: str, own: list[Item]) -> Iterator[Change]:
    """A value that is computed, but not taken: what was there before is used on."""
    for item in own:
        match = None if item.word else ASSIGNED.fullmatch(code, item.start, item.end)
        if (
            match
            and "(" in match["right"]
            and not re.match(r"(?:const\s+)?\w+\s+\**\w", match["left"])
        ):
            yield Change("stale", item.start, item.end, f"(void)({match['right']});")


def _clauses(code: str, start: int, end: int) -> Iterator[Change]:
    """One clause of a condition forgotten."""
    for match in re.finditer(r"&&|\|\|", code[start:end]):
        first, last = start + match.start(), start + match.end()
        left, chained = _left_end(code, first, start)
        if not chained:
            yield Change("clause", left, last, " ")
        yield Change("clause", first, _right_end(code, last, end), " ")


def _left_end(code: str, position: int, start: int) -> tuple[int, bool]:
    """Where the clause before an operator starts, and whether another operator precedes it."""
    depth = 0
    for place in range(position - 1, start, -1):
        character = code[place]
        depth += {")": 1, "]": 1, "(": -1, "[": -1}.get(character, 0)
        if depth < 0 or (depth == 0 and character in ",;{}?:"):
            return place + 1, False
        if depth == 0 and code[place - 1 : place + 1] in ("&&", "||"):
            return place + 1, True
        if (
            depth == 0
            and character == "="
            and code[place - 1] not in "=!<>"
            and code[place + 1] != "="
        ):
            return place + 1, False
        if depth == 0 and re.match(r"return\b", code[place : place + 7]):
            return place + len("return"), False
    return start + 1, False


def _right_end(code: str, position: int, end: int) -> int:
    """Where the clause behind an operator ends."""
    depth = 0
    for place in range(position, end):
        character = code[place]
        depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(character, 0)
        if depth < 0 or (
            depth == 0 and (character in ",;?:" or code[place : place + 2] in ("&&", "||"))
        ):
            return place
    return end


def _neighbours(names: list[str], name: str) -> list[str]:
    """The names beside one, the last being beside the first."""
    place = names.index(name)
    found = [names[(place + 1) % len(names)], names[place - 1]]
    return [other for other in dict.fromkeys(found) if other != name]


def _members(code: str, start: int, end: int, structures: Structures) -> Iterator[Change]:
    """Another field of the same type, of a structure that has the field."""
    for match in MEMBER.finditer(code, start, end):
        for fields in structures.values():
            own = next((one for one in fields if one.name == match[1]), None)
            if not own:
                continue
            kind = (own.type, own.pointer, own.size)
            alike = [one.name for one in fields if (one.type, one.pointer, one.size) == kind]
            for other in _neighbours(alike, own.name):
                yield Change("field", *match.span(1), other)


def _indices(code: str, start: int, end: int) -> Iterator[Change]:
    """Another index: of another variable, the next one, the first one."""
    used = list(dict.fromkeys(match[1] for match in INDEX.finditer(code, start, end)))
    for match in INDEX.finditer(code, start, end):
        others = [name for name in used if name != match[1] and not CONSTANT.match(name)]
        for other in (*others, f"{match[1]} + 1u", "0u"):
            yield Change("index", *match.span(1), other)


def _arguments(code: str, start: int, end: int) -> Iterator[Change]:
    """Two arguments of a call exchanged."""
    for match in CALL.finditer(code, start, end):
        if match[1] in csource.NOT_A_FUNCTION:
            continue
        first = match.end()
        last = declarations.closing(code, first - 1) - 1
        given = declarations.split(code[first:last], ",")
        for place, (one, two) in enumerate(zip(given, given[1:], strict=False)):
            if one != two:
                exchanged = [*given[:place], two, one, *given[place + 2 :]]
                yield Change("arguments", first, last, ", ".join(exchanged))


def _constants(
    code: str, start: int, end: int, families: tuple[tuple[str, ...], ...]
) -> Iterator[Change]:
    """Another constant of the same family."""
    for match in CONSTANT.finditer(code, start, end):
        for family in families:
            if match.group() in family:
                for other in _neighbours(list(family), match.group()):
                    yield Change("family", *match.span(), other)
