# SPDX-License-Identifier: Apache-2.0
"""Parses C by tree-sitter. What it cannot parse is an error, never passed over.

Places in a tree are places in the text: each character is one byte to the parser, and what stands
for nothing in the language, an attribute or a macro for one, is blank to it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache, lru_cache

from keel.base.errors import ToolError
from keel.install.packages import provide

provide("c-syntax")

import tree_sitter_c
from tree_sitter import Language, Node, Parser, Query, QueryCursor

__all__ = ["Node", "SyntaxProblem", "expression", "found", "parse", "span", "within", "written"]

LANGUAGE = Language(tree_sitter_c.language())
PARSER = Parser(LANGUAGE)
# Nothing to C: the macros of c_declarations.h, those of placement in memory, and GNU's attributes.
NOTHING = re.compile(
    r"^KEEL_C_(?:BEGIN|END)$"
    r"|(?<!define )\bKEEL_REALTIME_(?:CODE|DATA|ZERO)\b"
    r"|\b__attribute__\(\((?:[^()]|\([^()]*\))*\)\)",
    re.MULTILINE,
)
SHOWN = 40  # Characters of what cannot be parsed that an error quotes.


class SyntaxProblem(ToolError):
    """A text is not C; the message starts with the line."""


@lru_cache(maxsize=1024)
def parse(text: str) -> Node:
    """The tree of a text: a file, or a block or statements out of it."""
    plain = NOTHING.sub(lambda match: " " * len(match.group()), text)
    root = PARSER.parse(plain.encode("ascii", "replace")).root_node
    if root.has_error:
        wrong = next(node for node in within(root) if node.is_error or node.is_missing)
        line = wrong.start_point.row + 1
        near = text.splitlines()[line - 1 : line]
        raise SyntaxProblem(f"{line}: this is no C that can be parsed: {near[0].strip()[:SHOWN]}")
    return root


def expression(text: str) -> Node:
    """The tree of an expression, in parentheses that are not the text's."""
    [statement] = parse(f"({text});").children
    return statement.children[0]


def within(node: Node) -> Iterator[Node]:
    """A node and all that it consists of, in the order of the text."""
    waiting = [node]
    while waiting:
        one = waiting.pop()
        yield one
        waiting += reversed(one.children)


@cache
def _query(types: tuple[str, ...]) -> Query:
    return Query(LANGUAGE, f"[{' '.join(f'({name})' for name in types)}] @found")


def found(node: Node, *types: str) -> list[Node]:
    """The nodes of these types in a node, in the order of the text."""
    nodes = QueryCursor(_query(types)).captures(node).get("found", [])
    return sorted(nodes, key=lambda one: (one.start_byte, -one.end_byte))


def span(node: Node) -> tuple[int, int]:
    """Where a node starts and ends."""
    return node.start_byte, node.end_byte


def written(node: Node | None) -> str:
    """How a node is written, white space made one."""
    return " ".join(node.text.decode().split()) if node and node.text else ""
