# SPDX-License-Identifier: Apache-2.0
"""Checks functions X_same(a, b) of the proofs: whether each compares every field of its structure.

What it does not compare may be anything after a call, and no harness would notice. A comparer is
one expression: it returns comparisons that are joined by &&, and does nothing else. A field is
compared by ==, a float by float_same, a structure by a function X_same of its own or field by
field. An array is compared so at an index that the caller hands in, a uint32_t, or at each of its
places by number. No name in a comparer may be that of a macro.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from keel.c import source as csource
from keel.c.declarations import (
    Field,
    Macros,
    Parameter,
    Structures,
    macros,
    number,
    resolved,
    signatures,
)
from keel.c.syntax import Node, within, written

FLOATS = frozenset(["float", "double"])
FLOAT_SAME = "float_same"
# The whole of float_same (proofs/common/same.h).
FLOAT_BODY = "{return__CPROVER_equal(a,b);}"
INDEX_TYPE = "uint32_t"
# The names on the way to a field, and the indices, in brackets.
Way = tuple[str, ...]


@dataclass(frozen=True)
class Same:
    """A function that compares two objects of a structure."""

    name: str
    type: str
    left: str
    right: str
    # What comes after the two objects: indices at which arrays are compared.
    indices: tuple[str, ...]
    # What it returns; None if it does anything else.
    expression: Node | None
    # Why it is no comparer, or "".
    wrong: str = ""


@dataclass(frozen=True)
class Fact:
    """Something that a comparer compares: by ==, by float_same or by a comparer."""

    way: Way
    by: str
    # What a comparer is given besides.
    indices: tuple[str, ...] = ()


class Comparers:
    """The functions X_same that a harness sees, in what it includes."""

    def __init__(
        self, texts: Iterable[str], structures: Structures, defines: Iterable[str] = ()
    ) -> None:
        every = list(texts)
        self._structures = structures
        self.macros: Macros = macros(every) | _defined(defines)
        self._known: dict[str, list[Same]] = {}
        for text in every:
            for same in _found(text, structures):
                self._known.setdefault(same.name, []).append(same)
        self._floats = [body for text in every if (body := csource.body_of(text, FLOAT_SAME))]

    def of(self, name: str, type_: str) -> Same | None:
        """The function of that name, if it compares this type."""
        same = next(iter(self._known.get(name, ())), None)
        return same if same and same.type == type_ else None

    def problems(self, same: Same) -> list[str]:
        """What a function leaves out, and those that it calls."""
        return list(dict.fromkeys(self._problems(same, whole=True)))

    def _problems(self, same: Same, whole: bool) -> list[str]:
        """The same, twice perhaps; of a comparer of a part of the fields, its form alone."""
        wrong = self._form(same)
        if same.expression and whole:
            wrong += self._leaves(same, same.type, (), self._facts(same))
        for inner in self._called(same):
            wrong += self._problems(inner, whole=inner.type != same.type)
        return wrong

    def sizes(self, same: Same) -> dict[str, set[str]]:
        """The sizes of the arrays that are compared at each index that a function is handed."""
        every: dict[str, set[str]] = {index: set() for index in same.indices}
        for fact in _facts(same):
            for at, field in self._arrays(same.type, fact.way):
                if at in every:
                    every[at].add(field.size)
            inner = self.of(fact.by, self._type(same.type, fact.way))
            wanted = self.sizes(inner).values() if inner else ()
            for given, sizes in zip(fact.indices, wanted, strict=False):
                if given in every:
                    every[given] |= sizes
        return every

    def equal(self, one: str, other: str) -> bool:
        """Whether two sizes are the same, by name or by number."""
        names = [resolved(size, self.macros) for size in (one, other)]
        values = [number(size, self.macros) for size in (one, other)]
        return names[0] == names[1] or (None not in values and values[0] == values[1])

    def _form(self, same: Same) -> list[str]:
        """Why a function is no comparer: what is not an expression of comparisons."""
        problems = [same.wrong] if same.wrong else []
        if len(self._known[same.name]) > 1:
            problems.append(f"{same.name} is defined more than once")
        if same.expression is None:
            return problems
        problems += [
            f"{same.name}: `{written(part)}` compares nothing of the two"
            for part in _parts(same.expression)
            if _fact(same, part) is None
        ]
        names = {
            written(node)
            for node in within(same.expression)
            if node.type in ("identifier", "field_identifier") and not _is_index(node)
        }
        problems += [
            f"{same.name}: {name} is a macro: it may stand for anything"
            for name in sorted(names & self.macros.keys())
        ]
        if FLOAT_SAME in names and [re.sub(r"\s", "", one) for one in self._floats] != [FLOAT_BODY]:
            problems.append(f"{same.name}: {FLOAT_SAME} is not that of proofs/common/same.h")
        return problems

    def _called(self, same: Same) -> Iterator[Same]:
        """The comparers that a comparer calls."""
        for fact in _facts(same):
            inner = self.of(fact.by, self._type(same.type, fact.way))
            if inner:
                yield inner

    def _facts(self, same: Same) -> list[Fact]:
        """What a comparer compares, by those too that compare a part of the same two objects."""
        every = []
        for fact in _facts(same):
            part = self.of(fact.by, same.type) if not fact.way else None
            if not part:
                every.append(fact)
            elif part.name != same.name:
                pairs = zip(part.indices, fact.indices, strict=False)
                names = {f"[{one}]": f"[{new}]" for one, new in pairs}
                every += [
                    Fact(tuple(names.get(step, step) for step in one.way), one.by)
                    for one in self._facts(part)
                ]
        return every

    def _type(self, type_: str, way: Way) -> str:
        """The type of what a way leads to."""
        for step in way:
            if not step.startswith("["):
                fields = {one.name: one for one in self._structures.get(type_, ())}
                type_ = fields[step].type if step in fields else ""
        return type_

    def _arrays(self, type_: str, way: Way) -> Iterator[tuple[str, Field]]:
        """The indices on a way, each with the array that it is one of."""
        for position, step in enumerate(way):
            if step.startswith("[") and position:
                outer = self._type(type_, way[: position - 1])
                fields = {one.name: one for one in self._structures.get(outer, ())}
                if way[position - 1] in fields:
                    yield step[1:-1], fields[way[position - 1]]

    def _leaves(self, same: Same, type_: str, way: Way, facts: list[Fact]) -> list[str]:
        """What is not compared of the structure that a way leads to."""
        problems = []
        for field in self._structures[type_]:
            complaint = self._field(same, field, (*way, field.name), facts)
            if complaint:
                problems.append(f"{same.name}: {type_}.{field.name} {complaint}")
        return problems

    def _field(self, same: Same, field: Field, way: Way, facts: list[Fact]) -> str:
        """Why a field is not compared, or ""."""
        if not field.size:
            return self._one(same, field, way, facts)
        places = {
            fact.way[len(way)]
            for fact in facts
            if fact.way[: len(way)] == way and len(fact.way) > len(way)
        }
        good = {step[1:-1] for step in places if not self._one(same, field, (*way, step), facts)}
        size = number(field.size, self.macros)
        by_number = {number(one, self.macros) for one in good}
        if good & set(same.indices) or (size is not None and set(range(size)) <= by_number):
            return ""
        if places and not good:
            return self._one(same, field, (*way, min(places)), facts)
        return f"is not compared at all of its {field.size} places"

    def _one(self, same: Same, field: Field, way: Way, facts: list[Fact]) -> str:
        """Why one value is not compared, or ""."""
        by = [fact.by for fact in facts if fact.way == way]
        if field.pointer or field.type not in {*FLOATS, *self._structures}:
            return "" if "==" in by else "is not compared"
        if field.type in FLOATS:
            return "" if FLOAT_SAME in by else "is not compared by float_same"
        if any(self.of(name, field.type) for name in by):
            return ""
        if not self._leaves(same, field.type, way, facts):
            return ""
        return f"is not compared by a function of its own for {field.type}"


def _defined(defines: Iterable[str]) -> Macros:
    """The macros of a command line."""
    words = (word.removeprefix("-D").partition("=") for word in defines)
    return {name.partition("(")[0]: ((), value or "1") for name, _, value in words}


def _found(text: str, structures: Structures) -> Iterable[Same]:
    """The functions X_same that a text defines for structures."""
    bare = csource.without_comments(text)
    for function in csource.defined(text):
        signature = signatures(text).get(function.name)
        if not function.name.endswith("_same") or not signature or not function.body:
            continue
        objects = signature.parameters[:2]
        if len(objects) < 2 or not _pair(objects, structures):
            continue
        rest = signature.parameters[2:]
        whole = "#" not in bare[slice(*function.body)]
        expression = returned(csource.block(text, function.body)) if whole else None
        wrong = "" if expression else f"{function.name} is not one expression that it returns"
        if any(one.type != INDEX_TYPE for one in rest):
            wrong = f"{function.name}: an index is a {INDEX_TYPE}"
        names = tuple(one.name for one in rest)
        yield Same(
            function.name,
            objects[0].base,
            objects[0].name,
            objects[1].name,
            names,
            expression,
            wrong,
        )


def returned(block: Node) -> Node | None:
    """The expression that a body does nothing but return."""
    statements = [one for one in block.named_children if one.type != "comment"]
    if len(statements) != 1 or statements[0].type != "return_statement":
        return None
    return next((one for one in statements[0].named_children if one.type != "comment"), None)


def _pair(objects: tuple[Parameter, ...], structures: Structures) -> bool:
    """Whether both point to one structure."""
    one, two = objects
    return one.type == two.type and one.type.endswith("*") and one.base in structures


def bare(node: Node) -> Node:
    """An expression without parentheses around the whole of it."""
    while node.type == "parenthesized_expression":
        [node] = [one for one in node.named_children if one.type != "comment"]
    return node


def _parts(node: Node) -> Iterator[Node]:
    """What && joins."""
    node = bare(node)
    sign, *sides = (node.child_by_field_name(name) for name in ("operator", "left", "right"))
    if node.type == "binary_expression" and written(sign) == "&&":
        for side in sides:
            if side:
                yield from _parts(side)
    else:
        yield node


def _facts(same: Same) -> list[Fact]:
    """What a comparer itself compares."""
    parts = _parts(same.expression) if same.expression else ()
    return [fact for part in parts if (fact := _fact(same, part))]


def _fact(same: Same, node: Node) -> Fact | None:
    """What a part of an expression compares, None if it does not compare the two objects."""
    sign, left, right = (node.child_by_field_name(name) for name in ("operator", "left", "right"))
    if node.type == "binary_expression" and written(sign) == "==" and left and right:
        way = _both(same, left, right, address=False)
        return Fact(way, "==") if way else None
    if node.type != "call_expression":
        return None
    name, given = (node.child_by_field_name(field) for field in ("function", "arguments"))
    arguments = [one for one in given.named_children if one.type != "comment"] if given else []
    if not re.fullmatch(r"\w+_same", written(name)) or len(arguments) < 2:
        return None
    way = _both(same, arguments[0], arguments[1], address=written(name) != FLOAT_SAME)
    return None if way is None else Fact(way, written(name), tuple(map(written, arguments[2:])))


def _both(same: Same, one: Node, two: Node, address: bool) -> Way | None:
    """The way to what two expressions name, if it is the same, from one object and the other."""
    first, second = _way(one, address), _way(two, address)
    if not first or not second or first[1:] != second[1:]:
        return None
    return first[1:] if {first[0], second[0]} == {same.left, same.right} else None


def _way(node: Node, address: bool) -> Way | None:
    """How an expression names a field: the object, then the names and indices; None if it is not
    one, or not its address where that is wanted."""
    node = bare(node)
    if address:
        if node.type == "identifier":
            return (written(node),)
        inner = node.child_by_field_name("argument")
        is_address = node.type == "pointer_expression" and written(node).startswith("&")
        return _way(inner, address=False) if is_address and inner else None
    steps: list[str] = []
    while node.type in ("field_expression", "subscript_expression"):
        inner = node.child_by_field_name("argument")
        if node.type == "field_expression":
            steps.insert(0, written(node.child_by_field_name("field")))
            through = written(node.child_by_field_name("operator")) == "->"
            if not inner or through != (inner.type == "identifier"):
                return None
        else:
            index = node.child_by_field_name("index")
            if not index or index.type not in ("identifier", "number_literal"):
                return None
            steps.insert(0, f"[{written(index)}]")
        if not inner:
            return None
        node = inner
    return (written(node), *steps) if node.type == "identifier" and steps else None


def _is_index(node: Node) -> bool:
    """Whether a name stands in brackets."""
    around = node.parent
    return bool(
        around
        and around.type == "subscript_expression"
        and around.child_by_field_name("index") == node
    )
