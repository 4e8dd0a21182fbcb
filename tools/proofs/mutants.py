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

from . import csource, mutant_slips
from .mutant_slips import Change, Surroundings

RELATIONS = {
    "<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"),
    "==": ("!=",), "!=": ("==",),
}  # fmt: skip
ARITHMETIC = {
    "+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",), "%": ("/",), "<<": (">>",), ">>": ("<<",),
    "++": ("--",), "--": ("++",), "+=": ("-=",), "-=": ("+=",), "*=": ("/=",), "/=": ("*=",),
}  # fmt: skip
LOGIC = {"&&": ("||",), "||": ("&&",), "&": ("|",), "|": ("&",)}

TOKEN = re.compile(
    r"(?P<name>[A-Za-z_]\w*)|(?P<number>0[xX][0-9A-Fa-f]+|\d+)(?P<suffix>[uUlL]*)(?![\w.])"
    r"|(?P<sign>->|\+\+|--|<<=|>>=|[-+*/%&|^<>=!]=|<<|>>|&&|\|\||[-+*/%&|<>!?:;,=(){}\[\]~.^])"
)
CONSTANT = re.compile(r"[A-Z][A-Z0-9_]{2,}$")
NO_CONSTANT = re.compile(r"NULL$|KEEL_OK$|KEEL_ERR_")
CONDITION = re.compile(r"\b(if|while)\s*\(|\bfor\s*\([^;]*;")
RELATION = re.compile(r"[=!<>]=|(?<![-<])[<>](?![<>])")
RETURN = re.compile(r"\breturn\b\s*([^;]*);")
STATEMENT = re.compile(
    r"(?<=[;{}])(?P<space>\s*)(?P<text>[A-Za-z_*(][^;{}]*?(?:[^=!<>]=[^=]|\+\+|--|\))[^;{}]*);"
)
NO_STATEMENT = re.compile(
    r"(return|if|for|while|do|switch|case|default|else|break|continue|const|static)\b"
)
DECLARATION = re.compile(
    r"[A-Za-z_]\w*(?:\s+|\s*\*\s*(?:const\s+)?)[A-Za-z_]\w*(?:\[[^]]*\])?\s*(?:=|$)"
)


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
    text = file.read_text(encoding="utf-8")
    code = csource.code_only(text)
    made = Generated([])
    texts = {_plain(code)}
    seen: Counter[tuple[str, str, str]] = Counter()
    for function in csource.defined(text):
        assert function.body
        head = code[: function.body[0]].rpartition(f"{function.name}")[0]
        changes = set(_changes(code, *function.body, _result_type(head)))
        changes |= set(mutant_slips.changes(text, code, function.body, around))
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
                    file, function.name, change.kind, change.start, change.end, change.replacement,
                    text.count("\n", 0, change.start) + 1, before, after,
                    seen[function.name, before, after],
                )
            )  # fmt: skip
    return made


def _plain(code: str) -> int:
    """What stands for a text in which only white space may differ."""
    return hash("".join(code.split()))


def _result_type(head: str) -> str:
    """The type before a function's name."""
    words = re.split(r"[;}]", head)[-1].replace("*", " * ").split()
    return " ".join(word for word in words if word not in ("static", "inline", "const", "extern"))


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


def _changes(code: str, start: int, end: int, result: str) -> Iterator[Change]:
    yield from _token_changes(code, start, end)
    yield from _conditions(code, start, end)
    yield from _returns(code, start, end, result)
    yield from _deletions(code, start, end)


def _token_changes(code: str, start: int, end: int) -> Iterator[Change]:
    """Operators and constants."""
    before = ""
    for match in TOKEN.finditer(code, start, end):
        token = match.group()
        if match["number"]:
            yield from _number_changes(match)
        elif match["name"] and CONSTANT.match(token) and not NO_CONSTANT.match(token):
            for operator in "+-":
                yield Change("constant", *match.span(), f"({token} {operator} 1u)")
        elif match["sign"]:
            yield from _sign_changes(match, before)
        before = token


def _number_changes(match: re.Match[str]) -> Iterator[Change]:
    value = int(match["number"], 0)
    for other in sorted({value + 1, max(value - 1, 0), 0} - {value}):
        yield Change("constant", *match.span(), f"{other}{match['suffix']}")


def _sign_changes(match: re.Match[str], before: str) -> Iterator[Change]:
    token = match["sign"]
    binary = bool(re.match(r"[\w)\]]", before[-1:])) and before not in ("return", "sizeof")
    if token in RELATIONS:
        for other in RELATIONS[token]:
            yield Change("relation", *match.span(), other)
    elif token in LOGIC and binary:
        for other in LOGIC[token]:
            yield Change("logic", *match.span(), other)
    elif token in ARITHMETIC and (binary or len(token) > 1):
        for other in ARITHMETIC[token]:
            yield Change("arithmetic", *match.span(), other)
    elif token == "!":
        yield Change("negation", *match.span(), "")


def _closing_parenthesis(code: str, start: int) -> int:
    depth = 0
    for match in re.finditer(r"[()]", code[start:]):
        depth += 1 if match.group() == "(" else -1
        if depth == 0:
            return start + match.start()
    return len(code)


def _conditions(code: str, start: int, end: int) -> Iterator[Change]:
    """Conditions of branches, loops and choices, negated.

    Where that is what another relation does, the relations do it already.
    """
    for first, last in _condition_places(code, start, end):
        condition = code[first:last].strip()
        if condition and not (RELATION.search(condition) and not re.search(r"&&|\|\|", condition)):
            yield Change("condition", first, last, f"!({condition})")


def _condition_places(code: str, start: int, end: int) -> Iterator[tuple[int, int]]:
    for match in CONDITION.finditer(code, start, end):
        if match[1]:
            yield match.end(), _closing_parenthesis(code, match.end() - 1)
        else:
            yield match.end(), code.index(";", match.end())
    for match in re.finditer(r"\?", code[start:end]):
        last = start + match.start()
        yield _start_of_operand(code, last), last


def _start_of_operand(code: str, end: int) -> int:
    """Where the expression that ends before a question mark starts."""
    depth = 0
    for position in range(end - 1, -1, -1):
        character = code[position]
        depth += {")": 1, "(": -1}.get(character, 0)
        if depth < 0 or (depth == 0 and character in "=,;{}:?"):
            return position + 1
        if depth == 0 and code.startswith("return", position):
            return position + len("return ")
    return 0


def _returns(code: str, start: int, end: int, result: str) -> Iterator[Change]:
    """Other results of the same type."""
    for match in RETURN.finditer(code, start, end):
        value = match[1].strip()
        if result.endswith("*"):
            others = ["NULL"]
        elif result == "bool":
            others = ["true", "false"]
        elif result == "keel_status_t":
            others = ["KEEL_OK", "KEEL_ERR_STATE"]
        elif result == "void" or not value:
            others = []
        else:
            others = ["0u", f"({value}) + 1u"]
        for other in others:
            if other != value:
                yield Change("result", *match.span(1), other)


def _deletions(code: str, start: int, end: int) -> Iterator[Change]:
    """Statements left out: assignments, increments, calls."""
    for match in STATEMENT.finditer(code, start, end):
        text = match["text"]
        if NO_STATEMENT.match(text) or DECLARATION.match(text):
            continue
        if code.count("(", start, match.start()) != code.count(")", start, match.start()):
            continue  # between the parentheses of a for
        yield Change("deletion", match.start("text"), match.end("text"), "")
