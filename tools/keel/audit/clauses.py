# SPDX-License-Identifier: Apache-2.0
"""Reads contracts: which of the fields that a function assigns a clause says something of.

A clause counts if it bears the id of a requirement and is no invariant: what a contract requires
and ensures alike says nothing of what the call does. A predicate counts as what it stands for; what
is said of the state before the call does not count.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from keel.audit.unused import DEFINITION
from keel.c import source as csource
from keel.c.declarations import Signature, Structures, closing, macros, read, split
from keel.c.project import Unit, closure, include_folders
from keel.judge import wp_frames

CLAUSE = re.compile(r"\b(requires|assumes|assigns|ensures|behavior|complete|disjoint)\b")
LABEL = re.compile(r"\s*([A-Z]{3,4}_\d{3}\w*)\s*:")
RESULT = "\\result"


# The names on the way to a field, from a parameter or from the result.
Path_ = tuple[str, ...]


@dataclass
class Coverage:
    """The fields that a function writes, each with the labels of the clauses about it."""

    fields: dict[str, list[str]] = field(default_factory=dict)
    problems: list[str] = field(default_factory=list)


def coverage(unit: Unit, function: str, signature: Signature, structures: Structures) -> Coverage:
    """What the contract says of what a function writes and returns."""
    files = closure(unit.root, unit.headers)
    contract = _contract(unit, function, read(files))
    found = Coverage()
    ways: list[Path_] = []
    for location in contract.assigns:
        fields = leaves(location, signature, structures)
        if not fields:
            found.problems.append(f"{function}: what is assigned by {location}?")
        ways += fields
    if signature.result != "void":
        ways += [(RESULT, *rest) for rest in _fields(signature.result, structures)]
    for way in ways:
        shown = ".".join(way[1:] if len(way) > 1 and way[0] != RESULT else way)
        found.fields[shown] = [label for label, text in contract.ensures if _names(text, way)]
    if not found.fields:
        found.problems.append(f"{function}: its contract names nothing that it writes or returns")
    found.problems += [
        f"{function}: no clause of its contract says what becomes of {name}"
        for name, labels in found.fields.items()
        if not labels
    ]
    return found


@dataclass(frozen=True)
class _Contract:
    assigns: list[str]
    # Label, and text with what its predicates stand for.
    ensures: list[tuple[str, str]]


def _contract(unit: Unit, function: str, texts: Iterable[str]) -> _Contract:
    every = list(texts)
    raw = next(
        (
            contract
            for path in unit.headers
            for name, contract in wp_frames.contracts(csource.read(path))
            if name == function and contract
        ),
        "",
    )
    parts = _clauses(" ".join(re.sub(r"(^|\s)@(?=\s)", " ", raw).split()))
    known = macros(every)
    assigns = [
        location
        for kind, text in parts
        if kind == "assigns"
        for one in split(text.partition("\\from")[0], ",")
        for location in _expanded(one, known)
        if location != "\\nothing"
    ]
    required = " && ".join(text for kind, text in parts if kind == "requires")
    definitions = _definitions(every)
    ensures = [
        (label[1], _unfolded(after(_without(text[label.end() :], required)), definitions))
        for kind, text in parts
        if kind == "ensures" and (label := LABEL.match(text))
    ]
    return _Contract(list(dict.fromkeys(assigns)), ensures)


def _clauses(contract: str) -> list[tuple[str, str]]:
    """The clauses of a contract, each with its keyword."""
    found = []
    pieces = CLAUSE.split(contract)
    for keyword, text in zip(pieces[1::2], pieces[2::2], strict=True):
        found.append((keyword, statement(text).strip()))
    return found


def statement(text: str) -> str:
    """A text up to its end: a semicolon that belongs to no quantifier."""
    position = open_ones = 0
    for match in re.finditer(r";|\\(?:forall|exists|let)\b", text):
        open_ones += 1 if match.group() != ";" else -1
        if open_ones < 0:
            position = match.start()
            break
    return text[:position] if open_ones < 0 else text


def _expanded(location: str, known: Mapping[str, tuple[tuple[str, ...], str]]) -> list[str]:
    """The locations that a macro stands for, or the location itself."""
    match = re.fullmatch(r"(\w+)\((.*)\)", location)
    if not match or match[1] not in known:
        return [location]
    parameters, text = known[match[1]]
    for name, value in zip(parameters, split(match[2], ","), strict=True):
        text = re.sub(rf"\b{name}\b", lambda _, value=value: value, text)  # type: ignore[misc]
    return [one for part in split(text, ",") for one in _expanded(part, known)]


def leaves(location: str, signature: Signature, structures: Structures) -> list[Path_]:
    """The fields that a location of an `assigns` clause consists of, each with the way to it."""
    path = re.findall(r"\w+", re.sub(r"\[[^]]*\]", "", location))
    types = {parameter.name: parameter.base for parameter in signature.parameters}
    if not path or path[0] not in types:
        return []
    type_ = types[path[0]]
    for name in path[1:]:
        inner = {one.name: "" if one.pointer else one.type for one in structures.get(type_, ())}
        if name not in inner:
            return []
        type_ = inner[name]
    return [(*path, *rest) for rest in _fields(type_, structures)]


def _fields(type_: str, structures: Structures) -> list[Path_]:
    """The ways to all fields of a structure; of anything else there is one, and it is empty."""
    if type_ not in structures:
        return [()]
    return [
        (one.name, *rest)
        for one in structures[type_]
        for rest in _fields("" if one.pointer else one.type, structures)
    ]


def after(text: str) -> str:
    """A text without what it says of the state before the call."""
    match = re.search(r"\\(old|at)\s*\(", text)
    if not match:
        return text
    end = closing(text, match.end() - 1)
    parts = split(text[match.end() : end - 1], ",")
    before = match[1] == "old" or parts[-1] in ("Pre", "Old", "L")
    kept = " " if before else f"({after(','.join(parts[:-1]))})"
    return text[: match.start()] + kept + after(text[end:])


def _definitions(texts: Iterable[str]) -> dict[str, str]:
    """What predicates and logic functions stand for."""
    return {
        match["name"]: after(
            " ".join(statement(inner[match.start("body") :]).replace("@", " ").split())
        )
        for text in texts
        for _, inner in csource.acsl(text)
        for match in DEFINITION.finditer(inner)
        if match["body"]
    }


def _without(text: str, required: str) -> str:
    """A clause without the parts that are required, too."""
    plain = re.sub(r"\s+", "", required)
    return " && ".join(part for part in split(text, "&&") if re.sub(r"\s+", "", part) not in plain)


def _unfolded(text: str, definitions: Mapping[str, str]) -> str:
    """A text with that of all definitions that it leads to."""
    seen: dict[str, str] = {}
    waiting = [text]
    while waiting:
        for name in re.findall(r"\w+", waiting.pop()):
            if name in definitions and name not in seen and not name.endswith("_valid"):
                seen[name] = definitions[name]
                waiting.append(definitions[name])
    return " ".join([text, *seen.values()])


def _names(text: str, way: Path_) -> bool:
    """Whether a text names a field or, as a whole, a structure that it is part of."""
    root, *names = way
    if root == RESULT:
        if RESULT not in text:
            return False
        if not names:
            return True
    elif re.search(rf"\*\s*{root}\b", text):
        return True
    if names and re.search(rf"(?:->|\.)\s*{names[-1]}\b", text):
        return True
    whole = r"(?!\w)(?!\s*(?:\[[^]]*\]\s*)*(?:\.|->))"
    return any(re.search(rf"(?:->|\.)\s*{name}{whole}", text) for name in names[:-1])


def header_texts(root: Path) -> list[str]:
    """All headers of the project and of Keel."""
    return read(path for folder in include_folders(root) for path in sorted(folder.rglob("*.h")))
