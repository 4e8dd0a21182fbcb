# SPDX-License-Identifier: Apache-2.0
"""Reads wrong bodies: faults, put in on purpose, that a harness must notice.

proofs/UNIT/wrong.toml says of each which text of the unit to replace, so that the rest of a wrong
body is always the code as it is now:

    [[wrong]]
    name = "find_skips_last"
    description = "find never looks into the last slot, and gives it as the answer."
    harness = "keel_queue_find_harness"
    expect = ["QUE_002_found"]

    [[wrong.replace]]
    old = "while ((i < queue->count)"
    new = "while (((i + 1u) < queue->count)"

`harness` must refute it, and each text of `expect` must be part of an assertion that fails. `file`
is changed, else the unit's source, or its header if the unit is inline.
`defines` takes the place of the harness's: a smaller model shows a fault sooner.
Replacements are made in their order. The old text must occur exactly once in the file or, where
`function` is given with it, in the body of that function: a wrong body that has gone stale is an
error.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.files import read_text
from keel.base.toml_lines import line_index, line_of
from keel.c import source as csource
from keel.c.project import ProjectError, Unit

KEYS = frozenset(["name", "description", "harness", "expect", "file", "defines", "replace"])
REPLACE_KEYS = frozenset(["old", "new", "function"])
# A name is a folder's below build/, too.
NAME = re.compile(r"[A-Za-z0-9_-]+")
BOUNDS = ".g"


@dataclass(frozen=True)
class Replacement:
    """One text and what takes its place, in the file or in the body of a function of it."""

    old: str
    new: str
    function: str = ""

    def apply(self, text: str) -> str:
        """The text with the replacement made; ValueError if it is not clear where."""
        start, end = self._range(text)
        times = text.count(self.old, start, end)
        if times != 1:
            where = f" in {self.function}" if self.function else ""
            raise ValueError(f"{self.old!r} occurs {times} times{where}, and must occur once")
        place = text.index(self.old, start, end)
        return text[:place] + self.new + text[place + len(self.old) :]

    def _range(self, text: str) -> tuple[int, int]:
        if not self.function:
            return 0, len(text)
        for function in csource.defined(text):
            if function.name == self.function and function.body:
                return function.body
        raise ValueError(f"there is no function {self.function}")


@dataclass(frozen=True)
class WrongBody:
    """A wrong body of a unit, and the harness that must refute it."""

    unit: Unit
    line: int
    name: str
    description: str
    harness: str
    expect: tuple[str, ...]
    file: Path
    replacements: tuple[Replacement, ...]
    defines: tuple[str, ...] = ()

    @property
    def place(self) -> str:
        """The file and the line of its entry."""
        return f"{self.unit.wrong_list.relative_to(self.unit.root)}:{self.line}"

    @property
    def shown(self) -> str:
        """Its entry, as messages name it."""
        return f"{self.place}: {self.name}"

    def text(self) -> str:
        """The file with the fault in it, made from the file as it is now."""
        text = self.file.read_text(encoding="utf-8")
        try:
            for replacement in self.replacements:
                text = replacement.apply(text)
        except ValueError as error:
            place = self.file.relative_to(self.unit.root)
            raise ProjectError(f"{self.shown}: stale, {place}: {error}") from error
        return text


def read_wrong_bodies(unit: Unit) -> list[WrongBody]:
    """The wrong bodies of a unit, in the order of its file.

    A key that is missing, unknown, there twice or of the wrong kind is an error.
    """
    _refuse_files(unit)
    return _read(unit) if unit.wrong_list.is_file() else []


def _refuse_files(unit: Unit) -> None:
    """A wrong body that has a file of its own; wrong bounds have."""
    place = unit.wrong_list.relative_to(unit.root)
    for path in sorted(unit.wrong_folder.glob("*")):
        if path.suffix != BOUNDS:
            raise ProjectError(
                f"{path.relative_to(unit.root)}: a wrong body belongs into {place}, as a [[wrong]]"
                f" with the name {path.stem}; only bounds for Gappa (*{BOUNDS}) stand here"
            )


def _read(unit: Unit) -> list[WrongBody]:
    text = read_text(unit.wrong_list)
    place = unit.wrong_list.relative_to(unit.root)
    try:
        raw = tomllib.loads(text)
        _check_keys(raw, frozenset(["wrong"]))
        entries = _tables(raw, "wrong")
    except (ValueError, tomllib.TOMLDecodeError) as error:
        raise ProjectError(f"{place}: {error}") from error
    lines = line_index(text)
    found: dict[str, WrongBody] = {}
    for number, entry in enumerate(entries):
        line = line_of(lines, ("wrong", number))
        name = entry.get("name", f"number {number + 1}")
        try:
            body = _parse(unit, line, entry)
            if body.name in found:
                raise ValueError(f"line {found[body.name].line} has this name, too")
        except ValueError as error:
            raise ProjectError(f"{place}:{line}: {name}: {error}") from error
        found[body.name] = body
    return list(found.values())


def _parse(unit: Unit, line: int, raw: Mapping[str, Any]) -> WrongBody:
    _check_keys(raw, KEYS)
    if not NAME.fullmatch(_string(raw, "name")):
        raise ValueError("`name` takes letters, digits, _ and -")
    expect = raw.get("expect")
    if not isinstance(expect, list) or not expect:
        raise ValueError("`expect` must list the assertions that must fail")
    return WrongBody(
        unit=unit,
        line=line,
        name=raw["name"],
        description=_string(raw, "description"),
        harness=_harness(unit, raw),
        file=_file(unit, raw),
        expect=tuple(_string({"expect": text}, "expect") for text in expect),
        replacements=tuple(_replacement(entry) for entry in _tables(raw, "replace")),
        defines=_defines(raw),
    )


def _harness(unit: Unit, raw: Mapping[str, Any]) -> str:
    name = _string(raw, "harness")
    if name not in [path.stem for path in unit.harnesses]:
        raise ValueError(f"there is no harness {name}")
    return name


def _file(unit: Unit, raw: Mapping[str, Any]) -> Path:
    own = unit.source if unit.source.is_file() else unit.header
    file = unit.root / _string(raw, "file") if "file" in raw else own
    if not file.is_file() or not file.is_relative_to(unit.root):
        raise ValueError(f"there is no file {raw.get('file')}")
    return file


def _defines(raw: Mapping[str, Any]) -> tuple[str, ...]:
    words = tuple(_string(raw, "defines").split()) if "defines" in raw else ()
    if any(not word.startswith("-D") for word in words):
        raise ValueError("`defines` takes -DNAME=VALUE only")
    return words


def _replacement(raw: Mapping[str, Any]) -> Replacement:
    _check_keys(raw, REPLACE_KEYS)
    new = raw.get("new")
    if not isinstance(new, str):
        raise ValueError("`new` must be a text")
    function = _string(raw, "function") if "function" in raw else ""
    return Replacement(_string(raw, "old"), new, function)


def _tables(raw: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    """The tables of an array, of which there must be one at least."""
    entries = raw.get(key)
    if not isinstance(entries, list) or not entries:
        raise ValueError(f"`{key}` must be an array of tables, with one at least")
    if not all(isinstance(entry, Mapping) for entry in entries):
        raise ValueError(f"`{key}` must hold tables only")
    return entries


def _check_keys(raw: Mapping[str, Any], known: frozenset[str]) -> None:
    unknown = sorted(set(raw) - known)
    if unknown:
        raise ValueError(f"unknown key {', '.join(unknown)}; known: {', '.join(sorted(known))}")


def _string(raw: Mapping[str, Any], key: str) -> str:
    value = raw.get(key)
    if not isinstance(value, str) or not value.strip():
        raise ValueError(f"`{key}` must be a text that is not empty")
    return value
