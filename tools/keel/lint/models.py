# SPDX-License-Identifier: Apache-2.0
"""The rules of the executable specification (specs/model/README.md) that a text shows."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import PurePosixPath

from keel.c import source as csource
from keel.c import syntax
from keel.c.declarations import signatures
from keel.c.syntax import Node, written
from keel.lint.texts import Finding, Text

FOLDER = "specs/model/"
CODE = re.compile(r"keel_\w+")
# The head of a loop that counts from one number to another.
HEAD = re.compile(
    r"for \((?:\w+ )?(?P<name>\w+) = [^;=]+; (?P<bound>[^;]+);"
    r" (?:(?P=name)\+\+|\+\+(?P=name)|(?P=name)--|--(?P=name)|(?P=name) [-+]= \d+[uU]?)\)"
)
LOOPS = ("for_statement", "while_statement", "do_statement")
EXITS = ("break_statement", "continue_statement", "goto_statement", "return_statement")
WRITES = ("assignment_expression", "update_expression")
INCLUDE = re.compile(r'#include "(\w+)\.h"')
REQUIREMENT = re.compile(r"/\*.*\b[A-Z]{3}-\d{3}\b")


def check_models(texts: Sequence[Text], layers: Sequence[str]) -> Iterator[Finding]:
    """What models do that they must not."""
    layer_of = {
        PurePosixPath(text.path).stem: PurePosixPath(text.path).parent.name
        for text in texts
        if text.path.startswith("include/keel/")
    }
    rank = {unit: layers.index(layer) for unit, layer in layer_of.items() if layer in layers}
    models = {
        text.path: "\n".join(text.lines) + "\n"
        for text in texts
        if text.is_c and text.path.startswith(FOLDER)
    }
    declared = {
        path: frozenset(one.name for one in csource.functions(text) if not one.static)
        for path, text in models.items()
        if path.endswith(".h")
    }
    for path, text in models.items():
        if path.endswith(".c"):
            yield from _source(path, text, declared)
        own = rank.get(_unit_of(path, declared), len(layers))
        for number, line in enumerate(text.splitlines(), 1):
            match = INCLUDE.match(line)
            if match and rank.get(match[1], -1) > own:
                yield Finding(path, number, f"{match[1]} stands above: a model calls those below")
        yield from _data(path, text)
    for path, names in declared.items():
        unit = PurePosixPath(path).stem
        said = {
            one.name
            for other, text in models.items()
            if other.endswith(".c") and _unit_of(other, declared) == unit
            for one in csource.defined(text)
        }
        for name in sorted(names - said):
            yield Finding(path, 1, f"{name} is declared, and no source of {unit} says what it does")


def _unit_of(path: str, declared: dict[str, frozenset[str]]) -> str:
    """The unit that a source is of: that of its name, or, for a part, of what its name starts
    with."""
    stem = PurePosixPath(path).stem
    units = [PurePosixPath(one).stem for one in declared]
    return max(
        (one for one in units if stem == one or stem.startswith(f"{one}_")), key=len, default=""
    )


def _source(path: str, text: str, declared: dict[str, frozenset[str]]) -> Iterator[Finding]:
    unit = _unit_of(path, declared)
    own = declared.get(f"{FOLDER}{unit}.h", frozenset())
    tree = syntax.parse(text)
    for function in csource.defined(text):
        if not function.static and function.name not in own:
            yield Finding(path, function.line, f"{function.name} is not declared in {unit}.h")
    for call in csource.calls(text, CODE.pattern):
        name = written(call.node.children[0])
        yield Finding(path, _line(call.node), f"{name} is of the code: a model calls models")
    for loop in syntax.found(tree, *LOOPS):
        if not _counts(loop, text):
            yield Finding(path, _line(loop), "this loop does not count to a bound that it leaves")
        for leave in syntax.found(loop, *EXITS):
            decides = leave.type == "return_statement" and bool(leave.named_children)
            if not decides and not _in_switch(leave, loop):
                yield Finding(path, _line(leave), "a loop is left early, and nothing is decided")
    yield from _refusals(path, text)


def _counts(loop: Node, text: str) -> bool:
    """Whether a loop counts, and writes neither what it counts nor what it counts to."""
    body = loop.child_by_field_name("body")
    if loop.type != "for_statement" or not body:
        return False
    head = " ".join(csource.code_only(text)[loop.start_byte : body.start_byte].split())
    match = HEAD.fullmatch(head)
    if not match or not re.search(rf"\b{match['name']}\b", match["bound"]):
        return False
    bounds = set(re.findall(r"[a-z]\w*", match["bound"]))
    return not {_last_name(_target(node)) for node in syntax.found(body, *WRITES)} & bounds


def _last_name(node: Node | None) -> str:
    """The field, or the variable, that is written, whichever of its elements."""
    while node and node.type in ("subscript_expression", "parenthesized_expression"):
        node = node.child_by_field_name("argument") or node.named_children[0]
    field = node.child_by_field_name("field") if node else None
    return written(field or node).lstrip("*")


def _target(node: Node) -> Node | None:
    return node.child_by_field_name("left") or node.child_by_field_name("argument")


def _in_switch(node: Node, loop: Node) -> bool:
    around = node.parent
    while around and around != loop:
        if around.type == "switch_statement":
            return True
        around = around.parent
    return False


def _line(node: Node) -> int:
    return node.start_point.row + 1


def _data(path: str, text: str) -> Iterator[Finding]:
    """Variables that outlive a call."""
    for node in syntax.found(syntax.parse(text), "declaration"):
        words = [written(child) for child in node.children]
        around = node.parent
        while around and around.type.startswith("preproc"):
            around = around.parent
        outside = bool(around and around.type == "translation_unit")
        function = bool(syntax.found(node, "function_declarator"))
        plain = outside and not function or "static" in words
        if plain and not function and "const" not in words and "typedef" not in words:
            yield Finding(path, _line(node), f"static data: {written(node)[:40]}")


def _refusals(path: str, text: str) -> Iterator[Finding]:
    """Functions that give a status, and write before they refuse."""
    for function in csource.defined(text):
        signature = signatures(text)[function.name]
        if signature.result != "keel_status_t" or not function.body:
            continue
        block = csource.block(text, function.body)
        pointers = {one.name for one in signature.parameters if one.written}
        first = min((node.start_byte for node in _writes(block, pointers)), default=None)
        for leave in syntax.found(block, "return_statement"):
            refuses = re.search(r"\bKEEL_ERR_\w+", written(leave))
            line = text.splitlines()[leave.start_point.row]
            if refuses and first is not None and leave.start_byte > first:
                if REQUIREMENT.search(line):
                    continue
                yield Finding(path, _line(leave), f"{function.name} writes before it refuses")


def _writes(block: Node, pointers: set[str]) -> Iterator[Node]:
    """What is written through pointers."""
    for node in syntax.found(block, *WRITES):
        target = _target(node)
        names = syntax.found(target, "identifier") if target else []
        if names and written(names[0]) in pointers and target and target.type != "identifier":
            yield node
