# SPDX-License-Identifier: Apache-2.0
"""Checks functions X_same(a, b) of the proofs: whether each compares every field of its structure.

What it does not compare may be anything after a call, and no harness would notice. A field is
compared by == (or by != where the function then gives false), a float by float_same, a structure
by a function X_same of its own, an array so at an index, which is a parameter of the function or
the variable of a loop over the whole array. A const copy of a field stands for the field.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from . import csource
from .declarations import Field, Parameter, Structures, macros, resolved, signatures

FLOATS = frozenset(["float", "double"])
COPY = re.compile(r"\bconst\s+\w+\s+(\w+)\s*=\s*(\w+\s*->[^;&]*);")


@dataclass(frozen=True)
class Same:
    """A function that compares two objects of a structure."""

    name: str
    type: str
    left: str
    right: str
    # What comes after the two objects: indices at which arrays are compared.
    indices: tuple[str, ...]
    body: str


class Comparers:
    """The functions X_same that a harness sees, in what it includes."""

    def __init__(self, texts: Iterable[str], structures: Structures) -> None:
        every = list(texts)
        self._structures = structures
        self._macros = macros(every)
        self._known = {
            same.name: same for text in every for same in _found(text, structures)
        }  # fmt: skip

    def of(self, name: str, type_: str) -> Same | None:
        """The function of that name, if it compares this type."""
        same = self._known.get(name)
        return same if same and same.type == type_ else None

    def problems(self, same: Same) -> list[str]:
        """What a function leaves out, and those that it calls."""
        found = []
        if re.search(r"\|\||\?", same.body):
            found.append(f"{same.name} may be true of objects that differ: it has `||` or `?`")
        for match in re.finditer(r"^\s*(\w+)\s*=(?!=)\s*(\w+)?(\s*&&)?", same.body, re.M):
            if match[1] != match[2] or not match[3]:
                found.append(f"{same.name}: {match[1]} forgets what was found before")
        for field in self._structures[same.type]:
            complaint = self._compared(same, field)
            if complaint:
                found.append(f"{same.name}: {same.type}.{field.name} {complaint}")
        for part in self._parts(same):
            found += [text for text in self.problems(part) if f": {same.type}." not in text]
        for name, field in self._nested(same):
            inner = self.of(name, field.type)
            found += self.problems(inner) if inner else []
        return list(dict.fromkeys(found))

    def _parts(self, same: Same) -> list[Same]:
        """The functions that compare a part of the same two objects, at the same indices."""
        arguments = r"\s*,\s*".join([same.left, same.right, *same.indices])
        names = re.findall(rf"\b(\w+_same)\(\s*{arguments}\s*\)", same.body)
        found = (self.of(name, same.type) for name in names if name != same.name)
        return [part for part in found if part]

    def _compared(self, same: Same, field: Field) -> str:
        """Why a field is not compared, here or in a part, or ""."""
        complaint = self._compared_here(same, field)
        if complaint and any(not self._compared(part, field) for part in self._parts(same)):
            return ""
        return complaint

    def _compared_here(self, same: Same, field: Field) -> str:
        index = r"\s*\[\s*(\w+)\s*\]" if field.size else r"()"
        mine, other = (rf"{name}\s*->\s*{field.name}\b{index}(?!\s*[\w.\[(]|\s*->)"
                       for name in (same.left, same.right))  # fmt: skip
        if field.pointer or field.type not in {*FLOATS, *self._structures}:
            forms = [rf"{one}\s*[=!]=\s*{two}" for one, two in ((mine, other), (other, mine))]
            how = "is not compared"
        elif field.type in FLOATS:
            forms = [rf"\bfloat_same\(\s*{mine}\s*,\s*{other}"]
            how = "is not compared by float_same"
        else:
            names = [name for name, inner in self._nested(same) if inner == field]
            good = [name for name in names if self.of(name, field.type)]
            forms = [rf"\b{name}\(\s*&\s*{mine}\s*,\s*&\s*{other}" for name in good]
            how = f"is not compared by a function of its own for {field.type}"
        match = next((m for form in forms if (m := re.search(form, same.body))), None)
        if not match:
            return how
        return self._index_problem(same, field, match[1], match[2]) if field.size else ""

    def _nested(self, same: Same) -> list[tuple[str, Field]]:
        """The functions X_same that are called on fields."""
        found = []
        for field in self._structures[same.type]:
            pattern = rf"\b(\w+_same)\(\s*&\s*(?:{same.left}|{same.right})\s*->\s*{field.name}\b"
            found += [(match[1], field) for match in re.finditer(pattern, same.body)]
        return found

    def _index_problem(self, same: Same, field: Field, one: str, two: str) -> str:
        if one != two:
            return f"is compared at {one} with that at {two}"
        if one in same.indices:
            return ""
        loop = re.search(
            rf"\bfor\s*\([^;]*\b{one}\s*=\s*0u?\s*;\s*{one}\s*<\s*(\w+)\s*;\s*"
            rf"(?:{one}\s*\+\+|\+\+\s*{one})\s*\)",
            same.body,
        )
        if loop and resolved(loop[1], self._macros) == resolved(field.size, self._macros):
            return ""
        return f"is not compared at all of its {field.size} indices"


def _found(text: str, structures: Structures) -> Iterable[Same]:
    """The functions X_same that a text defines for structures."""
    for name, signature in signatures(text).items():
        objects = signature.parameters[:2]
        if not name.endswith("_same") or len(objects) < 2 or not _pair(objects, structures):
            continue
        indices = tuple(parameter.name for parameter in signature.parameters[2:])
        body = _without_copies(csource.body_of(text, name))
        if body:
            yield Same(name, objects[0].base, objects[0].name, objects[1].name, indices, body)


def _without_copies(body: str) -> str:
    """A body in which the address of what was copied stands in place of that of its copy."""
    for copy in COPY.finditer(body):
        body = re.sub(rf"&\s*{copy[1]}\b", f"&{copy[2]}", body)
    return body


def _pair(objects: tuple[Parameter, ...], structures: Structures) -> bool:
    """Whether both point to one structure."""
    one, two = objects
    return one.type == two.type and one.type.endswith("*") and one.base in structures
