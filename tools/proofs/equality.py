# SPDX-License-Identifier: Apache-2.0
"""Reads a harness: does it show that a function does what its model does?

It must call both, with the same numbers, and assert, in an assertion that every execution reaches
(in a loop, if it calls both there) and that stands after both calls: that the results are equal, if
there is one; and of each object that the function may write, that it is the same as the model's in
every field. Neither result nor object may be written between the calls and the assertions.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from . import csource
from .declarations import (
    Call,
    Parameter,
    Signature,
    Structures,
    bare,
    calls,
    closing,
    read,
    signatures,
    split,
)
from .harness import Harness
from .project import closure
from .sameness import FLOATS, Comparers

# What may be anything, as far as there is room.
ANY = r"(?:(?:nondet|any)_\w+\(\s*\)|any_below\(\s*[A-Z]\w*\s*\))"
RETURNED = re.compile(r"\{\s*return\b([^;]*);\s*\}")
NARROWED = re.compile(r"\bany_bits\w*\(\s*\w+\s*\)")


@dataclass(frozen=True)
class Claim:
    """Something asserted in every execution: a part of an assertion that holds by itself."""

    text: str
    # Where the assertion starts and ends, in the body.
    start: int
    end: int


@dataclass
class Reading:
    """What a harness shows of a function."""

    harness: str
    compares: bool = False
    problems: list[str] = field(default_factory=list)
    bounds: list[str] = field(default_factory=list)


class Reader:
    """Reads the harnesses of one function, which has one model."""

    def __init__(
        self, function: str, model: str, signature: Signature, structures: Structures
    ) -> None:  # fmt: skip
        self._function = function
        self._model = model
        self._signature = signature
        self._structures = structures

    def read(self, harness: Harness) -> Reading:
        """What a harness shows; if it does not call the model, it shows nothing here."""
        reading = Reading(harness.name)
        body = csource.body_of(harness.path.read_text(encoding="utf-8"), harness.name)
        code = [*calls(body, self._function)]
        model = [*calls(body, self._model)]
        reading.compares = bool(model)
        if not model:
            return reading
        reading.bounds = bounds(harness, body, code[0].start if code else 0)
        if len(code) != 1 or len(model) != 1:
            reading.problems.append(f"must call {self._function} and {self._model} once each")
            return reading
        texts = read(closure(harness.unit.root, [harness.path]))
        comparison = _Comparison(body, code[0], model[0], texts, self._structures)
        reading.problems += comparison.start()
        reading.problems += comparison.results(self._signature.result, self._structures)
        for number, parameter in enumerate(self._signature.parameters):
            reading.problems += comparison.argument(number, parameter, self._structures)
        return reading


class _Comparison:
    """Two calls in a body, and what is asserted of them."""

    def __init__(
        self, body: str, code: Call, model: Call, texts: Sequence[str], structures: Structures
    ) -> None:  # fmt: skip
        self._body = body
        self._code = code
        self._model = model
        self._comparers = Comparers(texts, structures)
        self._claims = claims(body, texts)

    def start(self) -> list[str]:
        """What keeps a claim from being about both calls."""
        found = []
        for call in (self._code, self._model):
            if loops(self._body, call.start) is None:
                found.append(f"{self._text(call)} is not called in every execution")
        if re.search(r"\breturn\b", self._body):
            found.append("a harness that returns early may assert nothing")
        return found

    def _text(self, call: Call) -> str:
        return " ".join(self._body[call.start : call.end].split())

    def _taken(self, call: Call) -> str:
        """What holds a call's result: a variable, or the call itself."""
        match = re.search(r"(\w+)\s*=\s*$", self._body[: call.start])
        return match[1] if match else self._text(call)

    def results(self, type_: str, structures: Structures) -> list[str]:
        """Whether the results are asserted to be equal."""
        if type_ == "void":
            return []
        pair = (self._taken(self._code), self._taken(self._model))
        return self._equal(pair, type_, structures, "the results")

    def argument(self, number: int, parameter: Parameter, structures: Structures) -> list[str]:
        """Whether an argument is the same, or what is written through it."""
        try:
            pair = (self._code.arguments[number], self._model.arguments[number])
        except IndexError:
            return [f"{parameter.name}: an argument is missing"]
        if parameter.written:
            objects = (_object(pair[0]), _object(pair[1]))
            if objects[0] == objects[1]:
                return [f"{parameter.name}: both are given one object, {objects[0]}"]
            return self._equal(objects, parameter.base, structures, f"{parameter.name}:")
        if not parameter.type.endswith("*") and pair[0] != pair[1]:
            return [f"{parameter.name}: the model is given {pair[1]}, the function {pair[0]}"]
        return []

    def _equal(
        self, pair: tuple[str, str], type_: str, structures: Structures, what: str
    ) -> list[str]:
        """Whether two things are asserted to be the same after both calls."""
        last = max(self._code.start, self._model.start)
        place = loops(self._body, last)
        for claim in self._claims:
            if claim.end <= last or loops(self._body, claim.start) != place:
                continue
            name = _compares(claim.text, pair, type_ in structures or type_ in FLOATS)
            if name is not None:
                return self._judge(pair, claim, name, type_, structures)
        return [f"{what} are not asserted to be the same: {' and '.join(pair)}, as {type_}"]

    def _judge(
        self, pair: tuple[str, str], claim: Claim, name: str, type_: str, structures: Structures
    ) -> list[str]:
        """What is wrong with a claim that two things are the same."""
        found = []
        first = min(self._code.end, self._model.end)
        between = self._body[first : claim.end]
        for one in pair:
            root = re.match(r"\w+", one)
            calls_it = one in (self._text(self._code), self._text(self._model))
            if root and not calls_it and _written(root[0], between, self._own(one)):
                found.append(f"{root[0]} is written between the calls and the assertion")
        if type_ in structures:
            same = self._comparers.of(name, type_)
            if not same:
                return [*found, f"{name} does not compare two {type_}"]
            found += self._comparers.problems(same)
            found += [f"{name}: {index} is not arbitrary" for index in self._indices(claim.text)]
        elif type_ in FLOATS and name != "float_same":
            found.append(f"{' and '.join(pair)}: floats are compared by float_same")
        return found

    def _own(self, variable: str) -> Sequence[str]:
        """The calls whose result a variable may take."""
        wanted = (self._code, self._model)
        return [self._text(call) for call in wanted if self._taken(call) == variable]

    def _indices(self, claim: str) -> list[str]:
        """The indices of a claim that are not just any."""
        [call] = calls(claim, r"\w+_same")
        return [
            index
            for index in call.arguments[2:]
            if not re.search(rf"\b{re.escape(index)}\s*=\s*{ANY}", self._body)
        ]


def _object(argument: str) -> str:
    """What an argument points to, or would if it were not null."""
    match = re.fullmatch(r"\(?\w+\)? \? (.+) : NULL", bare(argument))
    return (match[1] if match else argument).removeprefix("&")


def _compares(claim: str, pair: tuple[str, str], by_function: bool) -> str | None:
    """How a claim says that two things are the same: the function's name, "" for ==."""
    wanted = {re.sub(r"\s+", "", text) for text in pair}
    sides = split(claim, "==")
    if len(sides) == 2 and not by_function:
        given = {re.sub(r"\s+", "", bare(side)) for side in sides}
        return "" if given == wanted else None
    match = re.fullmatch(r"(\w+_same)\s*\(.*\)", claim, re.S)
    if match and closing(claim, claim.index("(")) == len(claim):
        [call] = [call for call in calls(claim, r"\w+_same") if call.start == 0]
        given = {re.sub(r"\s+", "", text).removeprefix("&") for text in call.arguments[:2]}
        return match[1] if given == wanted else None
    return None


def _written(name: str, text: str, allowed: Sequence[str]) -> bool:
    """Whether a text writes a variable or a part of it, other than by the calls allowed."""
    for match in re.finditer(rf"(?<![\w.>&]){name}\b[\w.\[\]\s>-]*?(?<![=!<>])=(?!=)", text):
        rest = " ".join(text[match.end() :].split())
        if not any(rest.startswith(call) for call in allowed):
            return True
    return False


def loops(body: str, place: int) -> tuple[str, ...] | None:
    """The heads of the loops around a place; None if a block that is no loop is around it."""
    heads: list[str] = []
    for match in re.finditer(r"[{}]", body[:place]):
        if match.group() == "}":
            heads.pop()
        else:
            head = re.search(r"\bfor\s*(\([^{};]*;[^{};]*;[^{};]*\))\s*$", body[: match.start()])
            heads.append(" ".join(head[1].split()) if head else "")
    return tuple(heads[1:]) if all(heads[1:]) else None


def claims(body: str, texts: Sequence[str] = ()) -> Sequence[Claim]:
    """What a body asserts in every execution, taken apart at &&.

    A contract that stand-ins share, F_does(...), counts as the expression that it returns.
    """
    found = []
    for call in calls(body, "__CPROVER_assert"):
        if call.arguments and loops(body, call.start) is not None:
            waiting = [call.arguments[0]]
            while waiting:
                text = bare(waiting.pop())
                parts = split(text, "&&")
                meant = _unfolded(text, texts)
                if len(parts) > 1:
                    waiting += parts
                elif meant:
                    waiting.append(meant)
                else:
                    found.append(Claim(text, call.start, call.end))
    return found


def _unfolded(text: str, texts: Sequence[str]) -> str:
    """What a call of F_does stands for; "" if it is none, or does more than return it."""
    match = re.match(r"(\w+_does)\s*\(", text)
    if not match or closing(text, match.end() - 1) != len(text):
        return ""
    given = split(text[match.end() : -1], ",")
    for one in texts:
        returned = RETURNED.fullmatch(csource.body_of(one, match[1]))
        if returned:
            names = [parameter.name for parameter in signatures(one)[match[1]].parameters]
            values = dict(zip(names, given, strict=True))
            return re.sub(r"(?<![\w.>])\w+", lambda word: values.get(word[0], word[0]), returned[1])
    return ""


def bounds(harness: Harness, body: str, place: int) -> list[str]:
    """What a harness narrows: numbers it defines and draws, what it assumes and takes as proved."""
    around = loops(body, place) or ()
    assumed = [call.arguments[0] for call in calls(body, "__CPROVER_assume") if call.arguments]
    return [
        *(word.removeprefix("-D") for word in harness.defines),
        *dict.fromkeys(NARROWED.findall(body)),
        *assumed,
        *(f"for {head}" for head in around),
        *(f"{name} by its contract" for name in harness.replaces),
    ]
