# SPDX-License-Identifier: Apache-2.0
"""Refuses shapes of code and of annotations that audits, or provers, would take for another thing.

Directives in a function's body, which a verdict on another function would not depend on though the
code behind them does. A function's name in parentheses, by which no audit finds the function. Casts
to pointers, by which one object has two types: a compiler may take it for two objects. Labels that
look like WP's own names of goals, by which a goal is judged.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Set

from keel.c import source as csource
from keel.c.syntax import Node, found, parse, written

DIRECTIVE = re.compile(r"[ \t]*#[ \t]*(\w*)")
BRANCHES = frozenset("if ifdef ifndef else elif endif".split())
# Not the name of a field: that is behind a dot or an arrow.
GOAL_NAME = re.compile(
    r"(?<![\w.\\])(?<!->)(?:loop_(?:variant|invariant|assigns)|"
    r"(?:wp|rte|ensures|requires|assigns|call|terminates|variant|decreases|exits)_)\w*"
)
LABEL = re.compile(r"\b(?:ensures|requires|assigns|terminates|variant)\s*:(?!:)")


def in_annotations(text: str) -> Iterator[tuple[int, str]]:
    """What is wrong in the annotations of any text."""
    for comment in csource.TOKEN.finditer(text):
        said = comment["comment"] or ""
        if said[2:3] == "@":
            first = text.count("\n", 0, comment.start()) + 1
            inner = re.sub(r"//[^\n]*", csource.blanked, said[3:])
            for at, what in _in_annotation(inner, said[3:]):
                yield first + inner.count("\n", 0, at), what


def _in_annotation(inner: str, whole: str) -> Iterator[tuple[int, str]]:
    """Places in an annotation, which is given without its remarks and with them."""
    for named in (*GOAL_NAME.finditer(inner), *LABEL.finditer(inner)):
        yield named.start(), f"{named.group()}: it looks like a goal's own name"
    if text := re.search(r'"', inner):
        yield text.start(), "a string in an annotation: no name is read from there"
    if directive := re.search(r"^[\s@]*#", inner, re.MULTILINE):
        yield directive.end(), "a directive in an annotation"
    if (ghost := re.search(r"\bghost\b", inner)) and not re.match(r"\s*ghost\b", whole):
        yield ghost.start(), "ghost code that does not begin its annotation"


def in_what_is_proved(text: str, pointers: Set[str] = frozenset()) -> Iterator[tuple[int, str]]:
    """What is wrong in a source, a header or a theorem; `pointers` are names of pointers' types."""
    yield from _directives_in_bodies(text)
    tree = parse(csource.with_ghosts(text))
    for node in found(tree, "parenthesized_declarator"):
        if not any(one.type == "pointer_declarator" for one in node.named_children):
            yield _line(node), f"`{written(node)}`: a name in parentheses, which audits do not find"
    for node in found(tree, "call_expression"):
        called = node.child_by_field_name("function")
        if called and called.type not in ("identifier", "field_expression"):
            yield _line(node), f"`{written(called)}(...)`: a call that audits do not follow"
    for node in found(tree, "cast_expression"):
        type_ = written(node.child_by_field_name("type"))
        if "*" in type_ or pointers & set(re.findall(r"\w+", type_)):
            yield _line(node), f"`({type_})`: a cast to a pointer: one object would have two types"


def _directives_in_bodies(text: str) -> Iterator[tuple[int, str]]:
    """Directives that are no branches: the rules of conditionals are about those."""
    lines = csource.without_comments(text).split("\n")
    for function in csource.defined(text):
        if function.body:
            first, last = (text.count("\n", 0, at) for at in function.body)
            for number in range(first, last + 1):
                directive = DIRECTIVE.match(lines[number])
                if directive and directive[1] not in BRANCHES:
                    yield number + 1, f"#{directive[1]} in the body of {function.name}"


def pointers_in(text: str) -> frozenset[str]:
    """The names that a text gives to types of pointers."""
    names = set()
    for node in found(parse(text), "type_definition"):
        for declarator in node.children_by_field_name("declarator"):
            if "*" in written(declarator).partition("(")[0] or "(*" in written(declarator):
                names |= set(re.findall(r"\w+", written(declarator).partition(")")[0]))
    return frozenset(names)


def _line(node: Node) -> int:
    return node.start_point.row + 1
