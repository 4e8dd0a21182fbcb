# SPDX-License-Identifier: Apache-2.0
"""Refuses macros behind which audits, which read texts, would miss what provers read.

A macro has a name in capitals, so it is no function, field, type or predicate, nor a word of C or
of annotations; it is no enumerator either, and a header's macro is defined in one place only. In
its text are no words that control what is run or that state what is taken for true, no functions of
the project, whose calls audits follow, and no call of what is given to it. It hides no change of an
object unless it looks like a call, and no cast to a pointer, `sizeof` or union.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from keel.audit.shapes import GOAL_NAME
from keel.c import source as csource
from keel.c.project import KEEL
from keel.c.syntax import Node, found, parse, written

NAME = re.compile(r"[A-Z][A-Z0-9_]*")
# Macros of the standard's headers, which a text that comes before them could give another meaning.
STANDARD = re.compile(r"NULL|U?INT\w*_(?:MAX|MIN|C)|(?:SIZE|PTRDIFF)_(?:MAX|MIN)|(?:FLT|DBL)_\w+")
STATES = frozenset("lemma axiom axiomatic inductive ghost admit check logic predicate".split())
CONTROLS = frozenset(
    "while for do goto return if else switch case default break continue terminates".split()
)
CHANGES = re.compile(r"\+\+|--|(?<![=!<>])=(?!=)|<<=|>>=")
HIDES = re.compile(r"\*\s*\)|\b(?:sizeof|union)\b")
PLACES = re.compile(r"KEEL_REALTIME_(?:CODE|DATA|ZERO)")
LOGIC_NAME = re.compile(
    r"\b(?:ensures|requires|assert|invariant|assumes)\s+(\w+)\s*:"
    r"|\b(?:lemma|behavior|predicate|logic\s+\w+)\s+(\w+)"
)
DECLARES = (
    "enumerator",
    "type_definition",
    "struct_specifier",
    "union_specifier",
    "enum_specifier",
    "declaration",
    "field_declaration",
    "parameter_declaration",
    "function_definition",
)


@dataclass(frozen=True)
class Macro:
    """A macro where it is defined; `parameters` is None if it is no function's likeness."""

    name: str
    line: int
    parameters: tuple[str, ...] | None
    text: str

    @property
    def words(self) -> set[str]:
        """All words of its text."""
        return set(re.findall(r"\w+", self.text))


@lru_cache(maxsize=1024)
def defined(text: str) -> tuple[Macro, ...]:
    """The macros that a text defines."""
    bare = csource.without_comments(text)
    every = []
    for node in found(parse(text), "preproc_def", "preproc_function_def"):
        name, parameters = (node.child_by_field_name(field) for field in ("name", "parameters"))
        if name:
            given = found(parameters, "identifier") if parameters else []
            names = tuple(map(written, given)) if parameters else None
            meant = bare[(parameters or name).end_byte : node.end_byte]
            every.append(Macro(written(name), node.start_point.row + 1, names, meant))
    return tuple(every)


def everywhere(text: str) -> Iterator[tuple[int, str]]:
    """What is wrong with the macros of any text."""
    for one in defined(text):
        if not NAME.fullmatch(one.name) or STANDARD.fullmatch(one.name):
            yield one.line, f"the macro {one.name}: its name is not in capitals, or the standard's"
        for word in sorted(one.words & STATES):
            yield one.line, f"the macro {one.name} stands for `{word}`, which audits look for"
        if match := GOAL_NAME.search(one.text):
            yield one.line, f"the macro {one.name} stands for {match.group()}, a goal's own name"


def in_what_is_built(text: str) -> Iterator[tuple[int, str]]:
    """What is wrong, besides, with those of a source or a header."""
    seen: set[str] = set()
    for one in defined(text):
        for word in sorted(one.words & CONTROLS):
            yield one.line, f"the macro {one.name} stands for `{word}`, which audits look for"
        if PLACES.fullmatch(one.name):
            yield one.line, f"the macro {one.name} is a linker's place, which audits skip in code"
        if one.parameters is None and CHANGES.search(one.text):
            yield one.line, f"the macro {one.name} changes an object, which its look does not say"
        if match := HIDES.search(one.text):
            yield one.line, f"the macro {one.name} hides `{match.group()}` from audits of code"
        for given in one.parameters or ():
            if re.search(rf"\b{given}[\s)]*\(", one.text):
                yield one.line, f"the macro {one.name} calls {given}, whatever that is"
        if one.name in seen:
            yield one.line, f"the macro {one.name} is defined a second time"
        seen.add(one.name)


def problems(root: Path) -> list[str]:
    """Macros that stand for a function, that take another's name, or that are defined twice."""
    built = _texts(root, ("include/**/*.h", "src/**/*.[ch]"))
    others = _texts(root, ("specs/model/*.[ch]", "proofs/**/*.[ch]"))
    headers = {path: text for path, text in built.items() if path.is_relative_to(root / "include")}
    kernel = {} if root.resolve() == KEEL else _texts(KEEL, ("include/**/*.h",))
    declared = {name for text in (*built.values(), *kernel.values()) for name in _declared(text)}
    functions = {
        one.name
        for text in (*built.values(), *kernel.values())
        for one in csource.functions(csource.with_ghosts(text))
    }
    first = {
        one.name: path
        for path, text in reversed((*headers.items(), *kernel.items()))
        for one in defined(text)
    }
    found_ = []
    for path, text in (built | others).items():
        for one in defined(text):
            place = f"{path.relative_to(root)}:{one.line}: the macro {one.name}"
            if one.name in declared:
                found_.append(f"{place} has the name of something that a text declares")
            if path in built and (called := one.words & functions):
                found_.append(f"{place} stands for the function {min(called)}")
            if first.get(one.name, path) != path:
                found_.append(f"{place} is defined in a header already, {first[one.name].name}")
    return found_


def _texts(root: Path, patterns: Iterable[str]) -> dict[Path, str]:
    paths = [path for pattern in patterns for path in sorted(root.glob(pattern))]
    return {path: csource.read(path) for path in paths if path.is_file()}


@lru_cache(maxsize=1024)
def _declared(text: str) -> frozenset[str]:
    """The names that a text declares, as code or in its annotations."""
    names = {one for match in LOGIC_NAME.findall("\n".join(_annotations(text))) for one in match}
    for node in found(parse(csource.with_ghosts(text)), *DECLARES):
        if name := node.child_by_field_name("name"):
            names.add(written(name))
        for declarator in node.children_by_field_name("declarator"):
            names.add(_name_of(declarator))
    return frozenset(names - {""})


def _annotations(text: str) -> Iterator[str]:
    return (inner for _, inner in csource.acsl(text))


def _name_of(declarator: Node) -> str:
    """The name that a declarator is about, however it is wrapped."""
    inner: Node | None = declarator
    while inner and inner.named_children:
        inner = inner.child_by_field_name("declarator") or inner.named_children[-1]
    return written(inner) if inner else ""
