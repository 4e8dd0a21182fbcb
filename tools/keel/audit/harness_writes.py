# SPDX-License-Identifier: Apache-2.0
"""Tells which variables of a harness are written in a stretch of it, by name or behind its back.

A function that is called there writes what it is given a pointer to that is not const, and the
variables at file level that it assigns. Where a write goes through any other pointer, or a function
has neither a body nor a declaration in what the harness includes, anything may be written: ANY.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

from keel.audit.comparers import bare
from keel.c import source as csource
from keel.c import syntax
from keel.c.declarations import Signature, signatures
from keel.c.syntax import Node, written

ANY = "*"
# Nodes that write a variable.
WRITES = ("assignment_expression", "update_expression", "init_declarator")
# Functions that write nothing: CBMC's own, those of the language's library, and macros, which
# neither assign nor call (keel.audit.harness_rules).
NOTHING = re.compile(
    r"__CPROVER_(?:assert|assume|equal|r_ok|uninterpreted_\w+)|nondet_\w+"
    r"|memcmp|is(?:nan|inf|finite)|signbit|__builtin_inff|[A-Z][A-Z0-9_]*"
)
# Functions that write what their first argument points to.
FIRST = ("memcpy", "memset", "memmove", "__CPROVER_havoc_object")


@dataclass(frozen=True)
class _Own:
    """The names that a body declares, those of them that it declares again, and those that are
    arrays; its parameters, and those of them that it does not set."""

    names: frozenset[str]
    twice: frozenset[str]
    arrays: frozenset[str]
    parameters: frozenset[str]
    steady: frozenset[str]


class Writes:
    """What the functions that a harness sees may write."""

    def __init__(self, texts: Sequence[str], compared: Mapping[str, Signature]) -> None:
        # The functions that are compared: they write what their parameters say, and no more.
        self._compared = compared
        self._signatures: dict[str, Signature] = {}
        self._bodies: dict[str, str] = {}
        for text in texts:
            self._signatures |= signatures(text)
            self._bodies |= {
                one.name: csource.body_of(text, one.name) for one in csource.defined(text)
            }
        self._signatures |= compared

    def within(
        self, body: str, stretch: tuple[int, int], passed: Collection[Node] = ()
    ) -> set[str]:
        """The variables that are written in a stretch of a body, but for what gives the value of
        one of the nodes, and by the calls that they are."""
        tree = syntax.parse(body)
        own = _own(tree, ())
        here = [node for node in _writing(tree) if stretch[0] <= node.start_byte < stretch[1]]
        return {
            name
            for node in here
            if node not in passed and _value(node) not in passed
            for name in self._by(node, own, frozenset())
        }

    @staticmethod
    def pointed(body: str, argument: str) -> set[str]:
        """The variables of a body into which an argument may point."""
        return set(_pointed(syntax.expression(argument), _own(syntax.parse(body), ())))

    def _by(self, node: Node, own: _Own, around: frozenset[str]) -> Iterator[str]:
        """What a node writes, seen from the body that it stands in."""
        if node.type == "call_expression":
            yield from self._called(node, own, around)
        elif node.type == "declaration":
            # One of a name that is declared elsewhere, too, stands for another thing.
            every = node.children_by_field_name("declarator")
            yield from (name for one in every if (name := declared(one)) in own.twice)
        else:
            yield from _target(_left(node), own)

    def _called(self, node: Node, own: _Own, around: frozenset[str]) -> Iterator[str]:
        """What a call writes."""
        name = written(node.child_by_field_name("function"))
        given = node.child_by_field_name("arguments")
        arguments = [one for one in given.named_children if one.type != "comment"] if given else []
        if NOTHING.fullmatch(name) or name in around:
            return
        if name in FIRST:
            yield from _pointed(arguments[0], own)
            return
        signature = self._signatures.get(name)
        known = signature and len(signature.parameters) == len(arguments)
        if not signature or not known or name in own.names | own.parameters:
            yield ANY
            return
        for one, parameter in zip(arguments, signature.parameters, strict=False):
            if parameter.written:
                yield from _pointed(one, own)
        if name not in self._compared:
            yield from self._beside(name, signature, around | {name})

    def _beside(self, name: str, signature: Signature, around: frozenset[str]) -> Iterator[str]:
        """What a function writes besides what its parameters point to."""
        tree = syntax.parse(self._bodies.get(name, ""))
        own = _own(tree, [one.name for one in signature.parameters])
        for node in _writing(tree):
            yield from (
                one
                for one in self._by(node, own, around)
                if one not in own.names and one not in own.parameters
            )


def assigned(body: str) -> Iterator[tuple[Node, str, Node | None]]:
    """What writes a variable by its name: where, which, and the value if there is one."""
    for node in syntax.found(syntax.parse(body), *WRITES):
        yield node, root(_left(node)), _value(node)


def root(node: Node | None) -> str:
    """The variable that an expression is a part of, or that a declarator declares."""
    return next(map(written, syntax.found(node, "identifier")), "") if node else ""


def names(text: str) -> list[str]:
    """The variables and functions in an expression."""
    return [written(one) for one in syntax.found(syntax.expression(text), "identifier")]


def _writing(tree: Node) -> list[Node]:
    return syntax.found(tree, *WRITES, "declaration", "call_expression")


def _field(node: Node, *fields: str) -> Node | None:
    return next(filter(None, map(node.child_by_field_name, fields)), None)


def _left(node: Node) -> Node | None:
    return _field(node, "left", "argument", "declarator")


def _value(node: Node) -> Node | None:
    return _field(node, "right", "value")


def declared(node: Node | None) -> str:
    """The name that a declarator declares, a field's too; not one in the size of an array."""
    while node and not node.type.endswith("identifier"):
        inner = node.child_by_field_name("declarator")
        in_parentheses = node.type == "parenthesized_declarator"
        node = inner or (node.named_children[0] if in_parentheses else None)
    return written(node) if node else ""


def _own(tree: Node, parameters: Collection[str]) -> _Own:
    pairs = [
        (declared(one), one)
        for node in syntax.found(tree, "declaration")
        for one in node.children_by_field_name("declarator")
    ]
    every: Mapping[str, Node] = dict(pairs)
    twice = {name for name in every if [one for one, _ in pairs].count(name) > 1}
    arrays = {
        name
        for name, node in every.items()
        if "array_declarator" in (node.type, getattr(_left(node), "type", ""))
    }
    every_parameter = frozenset(parameters)
    # A parameter that is set points elsewhere.
    set_ = {
        written(left)
        for node in syntax.found(tree, *WRITES)
        if (left := _left(node)) and left.type == "identifier"
    }
    return _Own(
        frozenset(every),
        frozenset(twice),
        frozenset(arrays),
        every_parameter,
        every_parameter - set_,
    )


def _target(node: Node | None, own: _Own) -> Iterator[str]:
    """What is written where this stands on the left."""
    node = bare(node) if node else None
    if node is None:
        yield ANY
    elif node.type.endswith("declarator"):
        yield declared(node)
    elif node.type == "identifier":
        yield written(node)
    elif node.type == "field_expression" and written(node.child_by_field_name("operator")) == ".":
        yield from _target(node.child_by_field_name("argument"), own)
    elif node.type in ("field_expression", "subscript_expression", "pointer_expression"):
        yield from _pointed(node.child_by_field_name("argument"), own)
    else:
        yield ANY


def _pointed(node: Node | None, own: _Own) -> Iterator[str]:
    """What is written where this points to it."""
    node = bare(node) if node else None
    if node is None:
        yield ANY
        return
    if node.type == "conditional_expression" and written(node.children[-1]) == "NULL":
        node = bare(node.children[2])
    if node.type == "pointer_expression" and written(node.children[0]) == "&":
        yield from _target(node.child_by_field_name("argument"), own)
    elif node.type == "field_expression":
        # An array in a structure; of a pointer in one nobody knows whither.
        yield from _target(node, own)
        yield ANY
    else:
        name = written(node)
        known = name in own.arrays or (name in own.steady and name not in own.names)
        yield name if node.type == "identifier" and known else ANY
