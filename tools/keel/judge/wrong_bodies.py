# SPDX-License-Identifier: Apache-2.0
"""Reads wrong bodies: faults, put in on purpose, that a harness must notice.

proofs/UNIT/wrong/NAME.toml says which text of the unit to replace, so that the rest of a wrong
body is always the code as it is now:

    # find never looks into the last slot, and gives it as the answer.
    harness = "keel_queue_find_harness"
    expect = ["QUE_002_found"]
    [[replace]]
    old = "while ((i < queue->count)"
    new = "while (((i + 1u) < queue->count)"

`harness` must refute it, and each text of `expect` must be part of an assertion that fails. `file`
is changed, else the unit's source, or its header if the unit is inline.
`defines` takes the place of the harness's: a smaller model shows a fault sooner.
Replacements are made in their order. The old text must occur exactly once in the file or, where
`function` is given beside it, in the body of that function: a wrong body that has gone stale is an
error.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.c import source as csource
from keel.c.project import ProjectError, Unit

KEYS = frozenset(["harness", "expect", "file", "defines", "replace"])
REPLACE_KEYS = frozenset(["old", "new", "function"])


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
    path: Path
    harness: str
    expect: tuple[str, ...]
    file: Path
    replacements: tuple[Replacement, ...]
    defines: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Of the wrong body, which is that of its file."""
        return self.path.stem

    @property
    def shown(self) -> str:
        """Its file, as messages name it."""
        return str(self.path.relative_to(self.unit.root))

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


def read_wrong_body(unit: Unit, path: Path) -> WrongBody:
    """Read a wrong body; what is missing, unknown or of the wrong kind is an error."""
    try:
        return _parse(unit, path, tomllib.loads(path.read_text(encoding="utf-8")))
    except (ValueError, tomllib.TOMLDecodeError) as error:
        raise ProjectError(f"{path.relative_to(unit.root)}: {error}") from error


def _parse(unit: Unit, path: Path, raw: Mapping[str, Any]) -> WrongBody:
    _check_keys(raw, KEYS)
    expect, entries = raw.get("expect"), raw.get("replace")
    if not isinstance(expect, list) or not expect:
        raise ValueError("`expect` must list the assertions that must fail")
    if not isinstance(entries, list) or not entries:
        raise ValueError("needs a [[replace]]")
    own = unit.source if unit.source.is_file() else unit.header
    file = unit.root / _string(raw, "file") if "file" in raw else own
    if not file.is_file() or not file.is_relative_to(unit.root):
        raise ValueError(f"there is no file {raw.get('file')}")
    return WrongBody(
        unit=unit, path=path, harness=_string(raw, "harness"), file=file,
        expect=tuple(_string({"expect": text}, "expect") for text in expect),
        replacements=tuple(_replacement(entry) for entry in entries),
        defines=_defines(raw),
    )  # fmt: skip


def _defines(raw: Mapping[str, Any]) -> tuple[str, ...]:
    words = tuple(_string(raw, "defines").split()) if "defines" in raw else ()
    if any(not word.startswith("-D") for word in words):
        raise ValueError("`defines` takes -DNAME=VALUE only")
    return words


def _replacement(entry: Any) -> Replacement:
    if not isinstance(entry, Mapping):
        raise ValueError("needs a [[replace]], a table")
    _check_keys(entry, REPLACE_KEYS)
    new = entry.get("new")
    if not isinstance(new, str):
        raise ValueError("`new` must be a text")
    function = _string(entry, "function") if "function" in entry else ""
    return Replacement(_string(entry, "old"), new, function)


def _check_keys(raw: Mapping[str, Any], known: frozenset[str]) -> None:
    unknown = sorted(set(raw) - known)
    if unknown:
        raise ValueError(f"unknown key {', '.join(unknown)}; known: {', '.join(sorted(known))}")


def _string(raw: Mapping[str, Any], key: str) -> str:
    value = raw.get(key)
    if not isinstance(value, str) or not value.strip():
        raise ValueError(f"`{key}` must be a text that is not empty")
    return value
