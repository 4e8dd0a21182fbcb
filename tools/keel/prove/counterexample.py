# SPDX-License-Identifier: Apache-2.0
"""Reads a counterexample of CBMC: what the harness chose, what the code made of it, what fails.

CBMC tells an execution step by step. Kept are the variables of the harness and the static ones that
something writes, as they stand when the function under test is called and as they stand at the end.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

from keel.judge.cbmc_answers import place

INDEX = re.compile(r"\[(\d+)[ulUL]*\]")
NULL = re.compile(r"\(?\([^()]*(?:\(\*\))?[^()]*\)\s*NULL\)?")
SUFFIX = re.compile(r"(?<=\d)[ulUL]+$")
START = "__CPROVER_initialize"
RETURNED = "goto_symex$$return_value$$"
LONG_RUN = 4  # equal values that are told once
A_LINE = 8  # values of an array

State = dict[str, str]


@dataclass
class _Frame:
    """A call that is going on, and its own variables."""

    function: str
    called_at: str
    own: set[str] = field(default_factory=set)


@dataclass
class Counterexample:
    """An execution at whose end an assertion or a check fails."""

    reason: str = ""
    place: str = ""
    called_at: str = ""
    # The calls that lead from the harness to the failure, innermost last.
    calls: list[str] = field(default_factory=list)
    before: State = field(default_factory=dict)
    after: State = field(default_factory=dict)
    # What the functions returned that the harness calls.
    returned: State = field(default_factory=dict)


def read_trace(steps: Iterable[Mapping[str, Any]], entry: str, function: str) -> Counterexample:
    """The counterexample in the steps of a trace; `entry` is the harness."""
    return _Reader(entry, function).read(steps)


class _Reader:
    """Goes through the steps of a trace."""

    def __init__(self, entry: str, function: str) -> None:
        self._entry = entry
        self._function = function
        self._frames: list[_Frame] = []
        self._state: State = {}
        self._static: set[str] = set()
        self._last: dict[str, str] = {}
        self._found = Counterexample()

    def read(self, steps: Iterable[Mapping[str, Any]]) -> Counterexample:
        """The counterexample."""
        for step in steps:
            kind = step.get("stepType")
            if kind == "function-call":
                self._call(step)
            elif kind == "function-return" and self._frames:
                self._return()
            elif kind == "assignment":
                self._assign(step)
            elif kind == "failure":
                self._found.reason = str(step.get("reason", ""))
                self._found.place = place(step.get("sourceLocation", {}))
                self._found.calls = [
                    f"{one.function} (called at {one.called_at})"
                    for one in self._frames
                    if one.function != self._entry
                ]
        self._found.after = dict(self._state)
        if not self._found.called_at:
            self._found.before = dict(self._state)
        return self._found

    def _call(self, step: Mapping[str, Any]) -> None:
        name = str(step["function"]["displayName"])
        called_at = place(step.get("sourceLocation", {}))
        if name == self._function and self._in_harness() and not self._found.called_at:
            self._found.called_at = called_at
            self._found.before = dict(self._state)
        self._frames.append(_Frame(name, called_at))

    def _return(self) -> None:
        ended = self._frames.pop()
        if self._in_harness() and ended.function in self._last:
            self._found.returned[ended.function] = self._last.pop(ended.function)

    def _in_harness(self) -> bool:
        return bool(self._frames) and self._frames[-1].function == self._entry

    def _assign(self, step: Mapping[str, Any]) -> None:
        name, value = str(step.get("lhs", "")), step.get("value", {})
        if name.startswith(RETURNED):
            self._last.update({name.removeprefix(RETURNED): text for _, text in _parts("", value)})
        if not self._frames or "$" in name or name.startswith(("__CPROVER", "return_value_")):
            return
        name = INDEX.sub(r"[\1]", name)
        base = re.split(r"[.\[]", name)[0]
        if self._frames[0].function == START:
            self._static.add(base)
        elif base == name and base not in self._static and not self._in_harness():
            # A pointer owns nothing: what is written through it bears the name of its object.
            self._frames[-1].own |= {base} if value.get("name") != "pointer" else set()
        elif not any(base in frame.own for frame in self._frames):
            self._state.update(_parts(name, value))


def _parts(name: str, value: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """The scalars of a value, each with its way from the variable."""
    for member in value.get("members", []):
        yield from _parts(f"{name}.{member['name']}", member["value"])
    for element in value.get("elements", []):
        yield from _parts(f"{name}[{element['index']}]", element["value"])
    if "data" in value and "$" not in name:
        yield name, shown(value)


def shown(value: Mapping[str, Any]) -> str:
    """A value as a person writes it."""
    data = str(value["data"])
    bits = int(value.get("binary", "0"), 2)
    if data.startswith("'") and "binary" in value:
        return str(bits)  # a byte that is no character
    if value.get("name") == "boolean" and bits > 1:
        return f"{data} (its bits are {bits:#x}, neither false nor true)"
    data = re.sub(r"/\*enum\*/|!\d+(?:@\d+)?", "", data)
    return SUFFIX.sub("", NULL.sub("NULL", data))


def lines(state: Mapping[str, str]) -> list[str]:
    """A state: an array together, equal neighbours once; a copy of a variable as such."""
    variables: dict[str, dict[str, str]] = {}
    for name, value in state.items():
        base = re.split(r"[.\[]", name)[0]
        variables.setdefault(base, {})[name.removeprefix(base)] = value
    found: list[str] = []
    for base, parts in variables.items():
        twin = next((one for one in variables if variables[one] == parts), base)
        if twin != base and len(parts) > 1:
            found.append(f"{base}: the same as {twin}")
        else:
            found += _variable(base, parts)
    return found


def changes(before: Mapping[str, str], after: Mapping[str, str]) -> list[str]:
    """What has changed from one state to the next."""
    return [
        f"{name} = {new} (before: {before.get(name, 'nothing')})"
        for name, new in after.items()
        if before.get(name) != new
    ]


def _variable(base: str, parts: Mapping[str, str]) -> list[str]:
    """The lines of a variable."""
    arrays: dict[str, dict[int, str]] = {}
    for way, value in parts.items():
        match = INDEX.search(way)
        name = base + (INDEX.sub("[]", way, count=1) if match else way)
        arrays.setdefault(name, {})[int(match[1]) if match else -1] = value
    return [line for name, values in arrays.items() for line in _array(name, values)]


def _array(name: str, values: Mapping[int, str]) -> list[str]:
    """The lines of an array: long runs of equal values apart, of others a few a line."""
    found: list[str] = []
    loose: list[tuple[int, str]] = []

    def flush() -> None:
        for start in range(0, len(loose), A_LINE):
            part = loose[start : start + A_LINE]
            found.append(_line(name, part[0][0], part[-1][0], ", ".join(text for _, text in part)))
        loose.clear()

    for value, group in groupby(values.items(), key=lambda entry: entry[1]):
        run = list(group)
        if len(run) < LONG_RUN:
            loose += run
        else:
            flush()
            found.append(_line(name, run[0][0], run[-1][0], f"{value}, each"))
    flush()
    return found


def _line(name: str, first: int, last: int, text: str) -> str:
    indices = str(first) if first == last else f"{first}..{last}"
    return f"{name.replace('[]', f'[{indices}]', 1)} = {text}"
