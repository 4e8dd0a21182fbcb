# SPDX-License-Identifier: Apache-2.0
"""Refuses shapes of code and of annotations that audits, or provers, would take for another thing.

Directives in a function's body, which a verdict on another function would not depend on though the
code behind them does. A function's name in parentheses, by which no audit finds the function. Casts
to pointers, by which one object has two types: a compiler may take it for two objects. Addresses
taken for numbers and sizes of types, which the target's need not be: CBMC numbers objects, and its
enumerations have four bytes. Functions that are inline and not static: a build may call another
one's. Unions, whose members are apart for WP. Types of functions, by which a function is declared
where no audit finds it. Variables that are initialised with themselves. Variables that files share,
and constants of headers without a value. Labels that look like WP's own names of goals, by which a
goal is judged.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Set

from keel.audit.harness_writes import declared
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
    """What is wrong in a source, a header or a theorem.

    `pointers` are names of types that are pointers, and of fields that are addresses.
    """
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
        elif type_ != "void" and _is_address(node.child_by_field_name("value"), pointers):
            yield _line(node), f"`{written(node)}`: an address as a number, unlike the target's"
    for node in found(tree, "sizeof_expression"):
        if not _counts_elements(node):
            yield _line(node), f"`{written(node)}`: a size, which may be another one on the target"
    for node in found(tree, "function_definition", "declaration"):
        words = {written(one) for one in node.children if one.type == "storage_class_specifier"}
        if "inline" in words and "static" not in words:
            yield _line(node), "inline and not static: a build may call another function"
    for node in found(tree, "union_specifier"):
        yield _line(node), "a union: provers take its members for objects of their own"
    for node in found(tree, "type_definition"):
        if any(_is_function(one) for one in node.children_by_field_name("declarator")):
            yield _line(node), "a type of functions, by which no audit finds what is declared"
    for node in found(tree, "init_declarator"):
        name, value = declared(node), node.child_by_field_name("value")
        read = (one for one in found(node, "identifier") if not written(one.parent).startswith("&"))
        if value and name in {written(one) for one in read if one.start_byte >= value.start_byte}:
            yield _line(node), f"`{written(node)}`: {name} is read before it has a value"


def in_file(text: str, *, is_header: bool) -> Iterator[tuple[int, str]]:
    """Objects of what is built that another file may see or change; ghosts are none."""
    for node in found(parse(text), "declaration"):
        names = [one for one in node.children_by_field_name("declarator") if not _is_function(one)]
        words = {written(one) for one in node.children if one.type == "storage_class_specifier"}
        is_constant = "const" in {written(one) for one in node.children}
        if names and "extern" in words and not is_constant:
            yield _line(node), f"`{written(node)}`: a variable that files share"
        elif names and is_header and "extern" not in words and not _is_local(node):
            if any(one.type != "init_declarator" for one in names) or not is_constant:
                yield _line(node), f"`{written(node)}`: in a header, and no constant with a value"


def _is_local(node: Node) -> bool:
    inside = node.parent
    while inside and inside.type != "function_definition":
        inside = inside.parent
    return inside is not None


def _is_function(declarator: Node) -> bool:
    """Whether a function is declared, and no pointer to one."""
    inner: Node | None = declarator
    while inner and inner.type == "pointer_declarator":
        inner = inner.child_by_field_name("declarator")
    if not inner or inner.type != "function_declarator":
        return False
    named = inner.child_by_field_name("declarator")
    return named is not None and named.type != "parenthesized_declarator"


def _is_address(node: Node | None, fields: Set[str]) -> bool:
    """Whether an expression gives the address of something; `fields` are names of such fields."""
    if not node:
        return False
    inner = [one for one in node.named_children if one.type != "comment"]
    match node.type:
        case "parenthesized_expression":
            return _is_address(inner[0], fields)
        case "pointer_expression":
            return written(node.child_by_field_name("operator")) == "&"
        case "string_literal":
            return True
        case "identifier":
            return _names_an_address(node)
        case "field_expression":
            return written(node.child_by_field_name("field")) in fields
        case "conditional_expression" | "comma_expression":
            return any(_is_address(one, fields) for one in inner[-2:])
        case "binary_expression":  # The difference of two addresses is a number.
            return [_is_address(one, fields) for one in inner].count(True) == 1
    return False


def _names_an_address(name: Node) -> bool:
    """Whether a name is that of a pointer or an array: its function's, or else the file's."""
    file = function = name
    while file.parent:
        function = file if file.type == "function_definition" else function
        file = file.parent
    own = found(function, "declaration", "parameter_declaration")
    shared = [node for node in file.children if node.type == "declaration"]
    known = {one: is_address for node in (*shared, *own) for one, is_address in _declared(node)}
    return known.get(written(name), False)


def _counts_elements(node: Node) -> bool:
    """Whether a size is part of `sizeof a / sizeof a[0]`, which no size of a type changes."""
    both = node.parent
    if not both or both.type != "binary_expression":
        return False
    whole, _, one = (re.sub(r"[\s()]|sizeof", "", written(part)) for part in both.children)
    return written(both.children[1]) == "/" and one == f"{whole}[0]"


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


def pointers_in(texts: Iterable[str]) -> frozenset[str]:
    """The names of types that are pointers, and those of fields that always are addresses."""
    types: set[str] = set()
    addresses: set[str] = set()
    numbers: set[str] = set()
    for tree in map(parse, texts):
        for node in found(tree, "type_definition"):
            for declarator in node.children_by_field_name("declarator"):
                if "*" in written(declarator).partition("(")[0] or "(*" in written(declarator):
                    types |= set(re.findall(r"\w+", written(declarator).partition(")")[0]))
        for node in found(tree, "field_declaration"):
            for name, is_address in _declared(node):
                (addresses if is_address else numbers).add(name)
    return frozenset(types | (addresses - numbers))


def _declared(node: Node) -> Iterator[tuple[str, bool]]:
    """The names that a declaration gives, each with whether it is a pointer's or an array's."""
    for declarator in node.children_by_field_name("declarator"):
        given = declarator.child_by_field_name("value")
        inner = declarator.child_by_field_name("declarator") if given else declarator
        is_address = inner is not None and inner.type in ("pointer_declarator", "array_declarator")
        if name := declared(declarator):
            yield name, is_address


def _line(node: Node) -> int:
    return node.start_point.row + 1
