# SPDX-License-Identifier: Apache-2.0
"""Reads C text just well enough for the driver: comments, functions, loops, annotations.

Keel's style (one declaration per line, functions at the left margin, no macro that hides a brace)
makes a scanner of a few lines reliable. Where it matters, what it says is compared with what the
prover says.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

TOKEN = re.compile(
    r"""
      (?P<comment> /\*.*?\*/ | //(?:\\\n|[^\n])* )
    | (?P<literal> "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])*' )
    """,
    re.DOTALL | re.VERBOSE,
)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+"([^"]+)"', re.MULTILINE)
# The two macros of c_declarations.h stand for a directive: they are nothing to C.
DIRECTIVE = re.compile(r"^(?:[ \t]*#(?:\\\n|[^\n])*|KEEL_C_(?:BEGIN|END)$)", re.MULTILINE)
FUNCTION = re.compile(
    r"^(?P<head>[A-Za-z_][\w \t\n*]*?[ \t\n*])(?P<name>[A-Za-z_]\w*)[ \t\n]*"
    r"\((?P<parameters>[^;{}]*)\)[ \t\n]*(?P<end>[{;])",
    re.MULTILINE,
)
GHOST = re.compile(r"/\*@\s*ghost\b(?P<code>.*?)\*/", re.DOTALL)
GHOST_LINE = re.compile(r"//@\s*ghost\b(?P<code>[^\n]*)")
NOT_A_FUNCTION = frozenset("if for while switch return sizeof typedef".split())
LOOP = re.compile(r"\b(?:for|while)\b")
LEMMA = re.compile(r"\blemma\s+(\w+)")


def blanked(match: re.Match[str]) -> str:
    """The same number of characters and lines, all of them white."""
    return re.sub(r"[^\n]", " ", match.group())


def without_comments(text: str) -> str:
    """The text with comments, annotations and the insides of literals blanked, places kept."""

    def replace(match: re.Match[str]) -> str:
        if match.group("comment"):
            return blanked(match)
        literal = match.group("literal")
        return literal[0] + " " * (len(literal) - 2) + literal[-1]

    return TOKEN.sub(replace, text)


def comments(text: str) -> list[str]:
    """The comments of a text, annotations too."""
    return [match.group("comment") for match in TOKEN.finditer(text) if match.group("comment")]


def essence(text: str) -> str:
    """The text without comments and blank lines: what a compiler sees of it, places aside."""
    bare = TOKEN.sub(lambda match: " " if match.group("comment") else match.group(), text)
    return "\n".join(line.rstrip() for line in bare.splitlines() if line.strip())


def code_only(text: str) -> str:
    """The text without comments, literals and preprocessor directives, places kept."""
    return DIRECTIVE.sub(blanked, without_comments(text))


@dataclass(frozen=True)
class Function:
    """A function found in a text; `body` is the slice from brace to brace, None if declared."""

    name: str
    line: int
    static: bool
    body: tuple[int, int] | None


def closing(code: str, start: int) -> int:
    """The index behind the brace that closes the one at `start`."""
    depth = 0
    for match in re.finditer(r"[{}]", code[start:]):
        depth += 1 if match.group() == "{" else -1
        if depth == 0:
            return start + match.end()
    return len(code)


def functions(text: str) -> list[Function]:
    """The functions that a text defines or declares, in its order."""
    code = code_only(text)
    found: list[Function] = []
    position = 0
    while match := FUNCTION.search(code, position):
        position = match.end()
        name, head = match.group("name"), match.group("head")
        words = head.split()
        if name in NOT_A_FUNCTION or not words or words[0] in NOT_A_FUNCTION:
            continue
        body: tuple[int, int] | None = None
        if match.group("end") == "{":
            body = (match.end() - 1, closing(code, match.end() - 1))
            position = body[1]
        line = code.count("\n", 0, match.start("name")) + 1
        found.append(Function(name, line, "static" in words, body))
    return found


def defined(text: str) -> list[Function]:
    """The functions that a text defines."""
    return [function for function in functions(text) if function.body]


def with_ghosts(text: str) -> str:
    """The text with ghost code laid open, its annotations too.

    Provers take ghost code for code: a ghost function's contract is assumed where it is called, a
    ghost loop must end. Places are kept.
    """

    def opened(match: re.Match[str]) -> str:
        code = match.group("code").replace("/@ ", "/*@").replace("@/", "*/")
        return " " * (len(match.group()) - len(code) - 2) + code + "  "

    def opened_line(match: re.Match[str]) -> str:
        return match["code"].rjust(len(match.group()))

    return GHOST_LINE.sub(opened_line, GHOST.sub(opened, text))


def proved(text: str) -> list[Function]:
    """The functions that a text defines, ghosts too: those that provers must prove."""
    return defined(with_ghosts(text))


def ghosts(text: str) -> dict[str, str]:
    """The ghost functions of a text, each with its body as code."""
    real = {function.name for function in defined(text)}
    opened = with_ghosts(text)
    return {one.name: body_of(opened, one.name) for one in proved(text) if one.name not in real}


def body_of(text: str, name: str) -> str:
    """The body of a function as code, or "" when it is not defined here."""
    for function in defined(text):
        if function.name == name and function.body:
            return code_only(text)[slice(*function.body)]
    return ""


def without_other_bodies(text: str, keep: frozenset[str]) -> str:
    """The text with the bodies of all functions but those in `keep` removed.

    WP proves a function from its own body and the contracts of those it calls, so this is what the
    verdict on that function depends on.
    """
    parts: list[str] = []
    position = 0
    for function in defined(text):
        if function.name not in keep and function.body:
            parts += [text[position : function.body[0]], "{}"]
            position = function.body[1]
    return "".join([*parts, text[position:]])


def loops(body: str) -> int:
    """How many loops a body of code has (a do loop shows by its `while`)."""
    return len(LOOP.findall(body))


def acsl(text: str) -> list[tuple[int, str]]:
    """The ACSL annotations of a text and the line of each, comments in them blanked."""
    found = []
    for match in TOKEN.finditer(text):
        comment = match.group("comment") or ""
        if comment[2:3] == "@":
            inner = re.sub(r"//[^\n]*", blanked, comment[3:])
            found.append((text.count("\n", 0, match.start()) + 1, inner))
    return found


def lemmas(text: str) -> list[str]:
    """The lemmas that a text states."""
    return [name for _, inner in acsl(text) for name in LEMMA.findall(inner)]


def includes(text: str) -> list[str]:
    """The files that a text includes with quotation marks."""
    return INCLUDE.findall(
        TOKEN.sub(lambda m: blanked(m) if m.group("comment") else m.group(), text)
    )


def calls(body: str, name: str) -> int:
    """How often a body of code calls a function."""
    return len(re.findall(rf"\b{re.escape(name)}\s*\(", body))


# What takes a claim for granted, or states one that no caller may rely on. Every one of them is a
# hole in the proof, whatever the prover says.
FORBIDDEN = re.compile(r"\b(axiom|axiomatic|admit|check|inductive)\b|(\bterminates\s+\\false)")


def forbidden(text: str) -> list[tuple[int, str]]:
    """Annotations that would weaken a proof: line and word."""
    found = []
    for line, inner in acsl(text):
        for match in FORBIDDEN.finditer(inner):
            found.append((line + inner.count("\n", 0, match.start()), match.group()))
    return found


PROVER_CODE = re.compile(r"\b(__CPROVER\w*|__FRAMAC__|__FC_\w*|__ESBMC\w*)|#\s*pragma\s+CPROVER")


def prover_code(text: str) -> list[tuple[int, str]]:
    """Places where the code itself knows of a prover: line and word."""
    code = without_comments(text)
    return [(code.count("\n", 0, m.start()) + 1, m.group()) for m in PROVER_CODE.finditer(code)]
