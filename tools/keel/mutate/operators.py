# SPDX-License-Identifier: Apache-2.0
"""Generates wrong versions of C functions: one slip each, of the kinds that programmers make.

Here are slips of the pen: another operator, a number beside the right one, a condition turned
round, a statement left out, another result. Slips of thought are in mutant_slips.py.

Mutants are made from the text between comments, so contracts and annotations stay as they are. A
mutant is known by its function, its line before and after, and which of equal ones it is: line
numbers would change with every edit above it.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from keel.c import declarations
from keel.c import source as csource
from keel.c.syntax import Node, found, span, within, written
from keel.mutate import slips as mutant_slips
from keel.mutate.slips import Change, Surroundings

Others = dict[str, tuple[str, ...]]

RELATIONS: Others = {
    "<": ("<=", ">="),
    "<=": ("<", ">"),
    ">": (">=", "<="),
    ">=": (">", "<"),
    "==": ("!=",),
    "!=": ("==",),
}
ARITHMETIC: Others = {
    "+": ("-",),
    "-": ("+",),
    "*": ("/",),
    "/": ("*",),
    "%": ("/",),
    "<<": (">>",),
    ">>": ("<<",),
    "++": ("--",),
    "--": ("++",),
    "+=": ("-=",),
    "-=": ("+=",),
    "*=": ("/=",),
    "/=": ("*=",),
}
LOGIC: Others = {"&&": ("||",), "||": ("&&",), "&": ("|",), "|": ("&",)}
KINDS = {"relation": RELATIONS, "logic": LOGIC, "arithmetic": ARITHMETIC}
# Other results, by type.
OTHERS = {"bool": ["true", "false"], "keel_status_t": ["KEEL_OK", "KEEL_ERR_STATE"]}


NUMBER = re.compile(r"(0[xX][0-9A-Fa-f]+|\d+)([uUlL]*)")
CONSTANT = re.compile(r"[A-Z][A-Z0-9_]{2,}$")
NO_CONSTANT = re.compile(r"NULL$|KEEL_OK$|KEEL_ERR_")
SIGNS = ("binary_expression", "assignment_expression", "update_expression")
PARENTHESIZED = ("if_statement", "while_statement", "do_statement")
CONDITIONAL = (*PARENTHESIZED, "for_statement", "conditional_expression")
RELATION = re.compile(r"[=!<>]=|(?<![-<])[<>](?![<>])")


# Nothing but the file itself is known.
ALONE = Surroundings()


@dataclass(frozen=True)
class Mutant:
    """One wrong version of a file."""

    file: Path
    function: str
    kind: str
    start: int
    end: int
    replacement: str
    line: int
    before: str
    after: str
    occurrence: int = 1

    @property
    def identity(self) -> tuple[str, str, str, int]:
        """What stays the same when the file changes elsewhere."""
        return (self.function, self.before, self.after, self.occurrence)

    def apply(self, text: str) -> str:
        """The file with the slip in it."""
        return text[: self.start] + self.replacement + text[self.end :]

    def __str__(self) -> str:
        return f"{self.function}:{self.line}  {self.before}  ->  {self.after}"


@dataclass
class Generated:
    """The mutants of a file, and how many were the same text as another or as the original."""

    mutants: list[Mutant]
    dropped: int = 0


def mutants(file: Path, around: Surroundings = ALONE) -> list[Mutant]:
    """All mutants of the functions that a file defines, in the order of the text."""
    return generate(file, around).mutants


def generate(file: Path, around: Surroundings = ALONE) -> Generated:
    """The same, without those that say the same as another or as the original."""
    text = csource.read(file)
    code = csource.code_only(text)
    results = declarations.signatures(text)
    made = Generated([])
    texts = {_plain(code)}
    seen: Counter[tuple[str, str, str]] = Counter()
    for function in csource.defined(text):
        assert function.body
        block = csource.block(text, function.body)
        changes = set(_changes(code, block, results[function.name].result))
        changes |= set(mutant_slips.changes(text, code, block, around))
        numbers = around.beyond.get(function.name, around.beyond.get(file.stem, ()))
        changes |= set(mutant_slips.changes_beyond(code, block, numbers, around))
        for change in sorted(changes, key=lambda c: (c.start, c.end, c.kind, c.replacement)):
            replacement = csource.without_comments(change.replacement)
            changed = _plain(code[: change.start] + replacement + code[change.end :])
            if changed in texts:
                made.dropped += 1
                continue
            texts.add(changed)
            before, after = _lines(text, change)
            seen[function.name, before, after] += 1
            made.mutants.append(
                Mutant(
                    file,
                    function.name,
                    change.kind,
                    change.start,
                    change.end,
                    change.replacement,
                    text.count("\n", 0, change.start) + 1,
                    before,
                    after,
                    seen[function.name, before, after],
                )
            )
    return made


def _plain(code: str) -> int:
    """What stands for a text in which only white space may differ."""
    return hash("".join(code.split()))


def _lines(text: str, change: Change) -> tuple[str, str]:
    """The lines of a change before and after it, on one line each, comments aside."""
    first = text.rfind("\n", 0, change.start) + 1
    last = text.find("\n", change.end)
    last = len(text) if last < 0 else last
    before = text[first:last]
    after = text[first : change.start] + change.replacement + text[change.end : last]
    return _one_line(before), _one_line(after)


def _one_line(text: str) -> str:
    return " ".join(csource.essence(text).split())


def _changes(code: str, block: Node, result: str) -> Iterator[Change]:
    yield from _token_changes(block)
    yield from _conditions(code, block)
    yield from _returns(code, block, result)
    yield from _deletions(block)


def _token_changes(block: Node) -> Iterator[Change]:
    """Operators and constants."""
    for node in within(block):
        token = written(node)
        around = node.parent.type if node.parent else ""
        if node.type == "number_literal":
            yield from _number_changes(node)
        elif node.type == "identifier" and CONSTANT.match(token) and not NO_CONSTANT.match(token):
            for operator in "+-":
                yield Change("constant", *span(node), f"({token} {operator} 1u)")
        elif node.type == "!" and around == "unary_expression":
            yield Change("negation", *span(node), "")
        elif around in SIGNS:
            for kind, signs in KINDS.items():
                for other in signs.get(node.type, ()):
                    yield Change(kind, *span(node), other)


def _number_changes(node: Node) -> Iterator[Change]:
    match = NUMBER.fullmatch(written(node))
    value = int(match[1], 0) if match else 0
    for other in sorted({value + 1, max(value - 1, 0), 0} - {value}) if match else ():
        yield Change("constant", *span(node), f"{other}{match[2] if match else ''}")


def _conditions(code: str, block: Node) -> Iterator[Change]:
    """Conditions of branches, loops and choices, negated.

    Where that is what another relation does, the relations do it already.
    """
    for node in found(block, *CONDITIONAL):
        condition = node.child_by_field_name("condition")
        if condition and node.type in PARENTHESIZED:
            condition = condition.named_children[0]
        text = code[slice(*span(condition))] if condition else ""
        if condition and not (RELATION.search(text) and not re.search(r"&&|\|\|", text)):
            yield Change("condition", *span(condition), f"!({text})")


def _returns(code: str, block: Node, result: str) -> Iterator[Change]:
    """Other results of the same type."""
    for node in found(block, "return_statement"):
        for value in node.named_children:
            text = code[slice(*span(value))]
            if result.endswith("*"):
                others = ["NULL"]
            else:
                others = OTHERS.get(result, ["0u", f"({text}) + 1u"])
            for other in others:
                if other != text:
                    yield Change("result", *span(value), other)


def _deletions(block: Node) -> Iterator[Change]:
    """Statements left out: assignments, increments, calls."""
    for node in found(block, "expression_statement"):
        for one in node.named_children:
            yield Change("deletion", *span(one), "")
