# SPDX-License-Identifier: Apache-2.0
"""Reads a harness: does it show that a function does what its model does?

It must call both, with the same numbers, and assert, in an assertion that every execution reaches
(in a loop, if it calls both there) and that stands after both calls: that the results are equal, if
there is one; and of each object that the function may write, that it is the same as the model's in
every field. Neither result nor object may be written between the calls and the assertions, and
nothing that both calls are given between the two, or, of two objects of which one was made of the
other, from there to the calls.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from keel.audit.comparers import FLOATS, Comparers, Same, bare
from keel.audit.harness_writes import ANY, Writes, assigned, names
from keel.c import source as csource
from keel.c import syntax
from keel.c.declarations import Parameter, Signature, Structures, read, signatures
from keel.c.project import closure
from keel.c.source import Call
from keel.c.syntax import Node, written
from keel.judge.harness import Harness

# The head of a loop over a whole array.
WHOLE = re.compile(
    r"\(uint32_t (?P<name>\w+) = 0u; (?P=name) < (?P<size>\w+); (?:(?P=name)\+\+|\+\+(?P=name))\)"
)

JUMPS = ("break_statement", "continue_statement", "goto_statement")
# What is around a place that not every execution reaches.
CONDITIONAL = frozenset(
    [
        "if_statement",
        "while_statement",
        "do_statement",
        "switch_statement",
        "conditional_expression",
    ]
)


@dataclass(frozen=True)
class Claim:
    """Something asserted in every execution: a part of an assertion that holds by itself."""

    text: str
    # The assertion.
    call: Call


@dataclass
class Reading:
    """What a harness shows of a function."""

    harness: str
    compares: bool = False
    problems: list[str] = field(default_factory=list)


class Reader:
    """Reads the harnesses of one function, which has one model."""

    def __init__(
        self, function: str, model: str, signature: Signature, structures: Structures
    ) -> None:
        self._function = function
        self._model = model
        self._signature = signature
        self._structures = structures

    def read(self, harness: Harness) -> Reading:
        """What a harness shows; if it does not call the model, it shows nothing here."""
        reading = Reading(harness.name)
        body = csource.body_of(csource.read(harness.path), harness.name)
        code = csource.calls(body, self._function)
        model = csource.calls(body, self._model)
        reading.compares = bool(model)
        if not model:
            return reading
        if len(code) != 1 or len(model) != 1:
            reading.problems.append(f"must call {self._function} and {self._model} once each")
            return reading
        texts = read(closure(harness.unit.root, [harness.path]))
        comparison = _Comparison(
            body, (code[0], model[0]), self._signature, texts, self._structures, harness.defines
        )
        reading.problems += comparison.start()
        reading.problems += comparison.results(self._signature.result, self._structures)
        for number, parameter in enumerate(self._signature.parameters):
            reading.problems += comparison.argument(number, parameter, self._structures)
        return reading


class _Comparison:
    """Two calls in a body, and what is asserted of them."""

    def __init__(
        self,
        body: str,
        calls: tuple[Call, Call],
        signature: Signature,
        texts: Sequence[str],
        structures: Structures,
        defines: Sequence[str],
    ) -> None:
        self._body = body
        self._code, self._model = calls
        self._comparers = Comparers(texts, structures, defines)
        self._claims = claims(body, texts)
        self._writes = Writes(texts, {call.name: signature for call in calls})

    def start(self) -> list[str]:
        """What keeps a claim from being about both calls."""
        problems = []
        for call in (self._code, self._model):
            if loops(call.node) is None:
                problems.append(f"{written(call.node)} is not called in every execution")
        if syntax.found(syntax.parse(self._body), "return_statement"):
            problems.append("a harness that returns early may assert nothing")
        if syntax.found(syntax.parse(self._body), *JUMPS):
            problems.append("a harness that jumps may pass its assertions by")
        return problems

    def _taken(self, call: Call) -> str:
        """What holds a call's result: a variable, or the call itself."""
        around = call.node.parent
        if around and around.type in ("init_declarator", "assignment_expression"):
            return written(around.children[0])
        return written(call.node)

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
            one, other = (self._writes.pointed(self._body, text) for text in pair)
            if ANY in one | other or one & other:
                return [f"{parameter.name}: {pair[0]} and {pair[1]} may be one object"]
            return [
                *self._equal(objects, parameter.base, structures, f"{parameter.name}:"),
                *self._start(parameter.name, pair),
            ]
        if not parameter.type.endswith("*") and pair[0] != pair[1]:
            return [f"{parameter.name}: the model is given {pair[1]}, the function {pair[0]}"]
        if pair[0] != pair[1]:
            return self._start(parameter.name, pair)
        return [
            f"{parameter.name}: {name} is written between the calls"
            for name in dict.fromkeys(names(pair[0]))
            if {name, ANY} & self._written_between()
        ]

    def _start(self, name: str, pair: tuple[str, str]) -> list[str]:
        """Whether two objects start as copies, if one comes of the other: written since by none."""
        both = {re.sub(r"\W.*", "", _object(text), flags=re.DOTALL) for text in pair}
        first, last = sorted((self._code.start, self._model.start))
        copies = [
            node.end_byte
            for node, target, value in assigned(self._body)
            if value and node.end_byte <= first and {target, written(value)} == both
        ]
        if copies and both & self._written(max(copies), last):
            return [
                f"{name}: {' or '.join(sorted(both))} is written after one was made of the other"
            ]
        return []

    def _written_between(self) -> set[str]:
        """What is written by the first call and its result, and from there to the second."""
        first, second = sorted((self._code, self._model), key=lambda call: call.start)
        around = first.node.parent
        results = (
            {self._taken(first)} if around and written(first.node) != self._taken(first) else set()
        )
        return results | self._writes.within(self._body, (first.start, second.start))

    def _equal(
        self, pair: tuple[str, str], type_: str, structures: Structures, what: str
    ) -> list[str]:
        """Whether two things are asserted to be the same after both calls."""
        last = max(self._code, self._model, key=lambda call: call.start)
        place = loops(last.node)
        for claim in self._claims:
            heads = loops(claim.call.node)
            if claim.call.end <= last.start or place is None or heads is None:
                continue
            if heads[: len(place)] != place:
                continue
            name = _compares(claim.text, pair, type_ in structures or type_ in FLOATS)
            if name is not None:
                return self._judge(pair, claim, name, type_, structures)
        return [f"{what} are not asserted to be the same: {' and '.join(pair)}, as {type_}"]

    def _judge(
        self, pair: tuple[str, str], claim: Claim, name: str, type_: str, structures: Structures
    ) -> list[str]:
        """What is wrong with a claim that two things are the same."""
        problems = []
        calls = (self._code, self._model)
        over = self._over(claim)
        between = (min(call.end for call in calls), over[-1].end_byte if over else claim.call.end)
        for one in pair:
            root = re.match(r"\w+", one)
            calls_it = one in [written(call.node) for call in calls]
            if root and not calls_it and {root[0], ANY} & self._written(*between):
                problems.append(f"{root[0]} is written between the calls and the assertion")
        if type_ in structures:
            same = self._comparers.of(name, type_)
            if not same:
                return [*problems, f"{name} does not compare two {type_}"]
            problems += self._comparers.problems(same)
            problems += self._indices(claim, same)
        elif over:
            problems.append(f"{' and '.join(pair)}: asserted in a loop of its own")
        if type_ in FLOATS and name != "float_same":
            problems.append(f"{' and '.join(pair)}: floats are compared by float_same")
        return problems

    def _written(self, first: int, last: int) -> set[str]:
        """What is written there, other than by the calls and their results."""
        calls = [call.node for call in (self._code, self._model)]
        return self._writes.within(self._body, (first, last), calls)

    def _over(self, claim: Claim) -> list[Node]:
        """The loops around a claim that are not around the calls, from within."""
        last = max(self._code, self._model, key=lambda call: call.start)
        around = _loops_around(claim.call.node)
        return around[len(_loops_around(last.node)) :][::-1]

    def _indices(self, claim: Claim, same: Same) -> list[str]:
        """The indices of a claim that are not all of those that an array has."""
        [call] = csource.calls(syntax.expression(claim.text), rf"{same.name}")
        given = call.arguments[2:]
        sizes = self._comparers.sizes(same)
        if len(given) != len(sizes):
            return [f"{same.name} is given {len(given)} indices, not {len(sizes)}"]
        problems = []
        every = self._whole_loops(claim)
        if every is None:
            return [f"{same.name}: a loop around it does more than assert at every index"]
        for index, wanted in zip(given, sizes.values(), strict=True):
            size = every.get(index) or self._any_below(index)
            if not size:
                problems.append(f"{same.name}: {index} is not arbitrary")
            problems += [
                f"{same.name}: {index} is below {size}, and an array has {one} places"
                for one in sorted(wanted)
                if size and not self._comparers.equal(size, one)
            ]
        return problems

    def _whole_loops(self, claim: Claim) -> dict[str, str] | None:
        """The variables of the loops around a claim, each with what it stays below; None if one of
        the loops is none that does nothing but assert."""
        every: dict[str, str] = {}
        for loop in self._over(claim):
            head = loops_head(loop)
            match = WHOLE.fullmatch(head)
            body = loop.child_by_field_name("body")
            if not match or not body or not _asserts_alone(body):
                return None
            every[match["name"]] = match["size"]
        return every

    def _any_below(self, index: str) -> str:
        """What an arbitrary index stays below; "" if it is none, or is written again."""
        values = [value for _, name, value in assigned(self._body) if name == index]
        if len(values) != 1 or not values[0]:
            return ""
        match = re.fullmatch(r"any_below\(\s*(\w+)\s*\)", written(values[0]))
        return match[1] if match else ""


def _loops_around(node: Node) -> list[Node]:
    """The loops around a node, from without."""
    every: list[Node] = []
    while node.parent:
        body = node.parent.child_by_field_name("body")
        if node.parent.type == "for_statement" and body == node:
            every.insert(0, node.parent)
        node = node.parent
    return every


def loops_head(loop: Node) -> str:
    """What stands in the parentheses of a `for`, with them."""
    body = loop.child_by_field_name("body")
    head = loop.text[: body.start_byte - loop.start_byte].decode() if body and loop.text else ""
    return " ".join(head.split()).removeprefix("for ")


def _asserts_alone(body: Node) -> bool:
    """Whether a loop's body does nothing but assert, in loops of its own perhaps."""
    inner = body.named_children if body.type == "compound_statement" else [body]
    for one in inner:
        if one.type == "for_statement":
            within = one.child_by_field_name("body")
            if not within or not _asserts_alone(within):
                return False
        elif one.type != "comment" and not re.match(r"__CPROVER_assert\b", written(one)):
            return False
    return True


def _sides(node: Node, operator: str) -> list[Node]:
    """What an operator stands between; an expression of any other kind by itself."""
    node = bare(node)
    sign, *sides = (node.child_by_field_name(name) for name in ("operator", "left", "right"))
    if node.type != "binary_expression" or written(sign) != operator:
        return [node]
    return [part for side in sides if side for part in _sides(side, operator)]


def _object(argument: str) -> str:
    """What an argument points to, or would if it were not null."""
    node = bare(syntax.expression(argument))
    if node.type == "conditional_expression" and written(node.children[-1]) == "NULL":
        node = bare(node.children[2])
    return written(node).removeprefix("&")


def _dense(text: str) -> str:
    return re.sub(r"\s+", "", text)


def _compares(claim: str, pair: tuple[str, str], by_function: bool) -> str | None:
    """How a claim says that two things are the same: the function's name, "" for ==."""
    wanted = {_dense(text) for text in pair}
    node = bare(syntax.expression(claim))
    sides = _sides(node, "==")
    if len(sides) == 2 and not by_function:
        return "" if {_dense(written(side)) for side in sides} == wanted else None
    for call in csource.calls(node, r"\w+_same"):
        if call.node == node:
            given = {_dense(text).removeprefix("&") for text in call.arguments[:2]}
            return written(call.node.children[0]) if given == wanted else None
    return None


def loops(node: Node) -> tuple[str, ...] | None:
    """The heads of the loops around a node; None if a block that is no loop is around it."""
    heads: list[str] = []
    while node.parent and node.parent.parent and node.parent.parent.parent:
        around = node.parent
        body = around.child_by_field_name("body")
        if around.type == "for_statement" and body:
            heads.insert(0, loops_head(around))
        elif around.type in CONDITIONAL or _skipped(around, node):
            return None
        node = around
    return tuple(heads)


def _skipped(around: Node, node: Node) -> bool:
    """Whether a node is the second side of && or ||."""
    operator, right = (around.child_by_field_name(name) for name in ("operator", "right"))
    return right == node and written(operator) in ("&&", "||")


def claims(body: str, texts: Sequence[str] = ()) -> Sequence[Claim]:
    """What a body asserts in every execution, taken apart at &&.

    A contract that stand-ins share, F_does(...), counts as the expression that it returns.
    """
    every = []
    for call in csource.calls(body, "__CPROVER_assert"):
        waiting = [call.arguments[0]] if call.arguments and loops(call.node) is not None else []
        while waiting:
            parts = [written(one) for one in _sides(syntax.expression(waiting.pop()), "&&")]
            meant = _unfolded(parts[0], texts)
            if len(parts) > 1:
                waiting += parts
            elif meant:
                waiting.append(meant)
            else:
                every.append(Claim(parts[0], call))
    return every


def _unfolded(text: str, texts: Sequence[str]) -> str:
    """What a call of F_does stands for; "" if it is none, or does more than return it."""
    node = bare(syntax.expression(text))
    for call in csource.calls(node, r"\w+_does"):
        name = written(call.node.children[0])
        for one in texts if call.node == node else ():
            returned = _returned(csource.body_of(one, name))
            if returned:
                names = [parameter.name for parameter in signatures(one)[name].parameters]
                return _replaced(returned, dict(zip(names, call.arguments, strict=True)))
    return ""


def _returned(body: str) -> Node | None:
    """The expression that a function does nothing but return."""
    statements = [one for block in syntax.parse(body).children for one in block.named_children]
    if len(statements) != 1 or statements[0].type != "return_statement":
        return None
    return next(iter(statements[0].named_children), None)


def _replaced(node: Node, values: Mapping[str, str]) -> str:
    """An expression with values in the place of variables."""
    words = (one for one in syntax.within(node) if not one.children)
    return " ".join(
        values.get(written(one), written(one)) if one.type == "identifier" else written(one)
        for one in words
    )
