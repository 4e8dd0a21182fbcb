# SPDX-License-Identifier: Apache-2.0
"""Reads C: comments and annotations as text, functions, loops and calls by its syntax."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from keel.base.files import read_text
from keel.c.syntax import Node, SyntaxProblem, found, parse, span, written

TOKEN = re.compile(
    r"""
      (?P<comment> /\*.*?\*/ | //(?:\\\n|[^\n])* )
    | (?P<literal> "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])*' )
    """,
    re.DOTALL | re.VERBOSE,
)
# The two macros of c_declarations.h stand for a directive: they are nothing to C.
DIRECTIVE = re.compile(r"^(?:[ \t]*#(?:\\\n|[^\n])*|KEEL_C_(?:BEGIN|END)$)", re.MULTILINE)
GHOST = re.compile(r"/\*@\s*ghost\b(?P<code>.*?)\*/", re.DOTALL)
GHOST_LINE = re.compile(r"//@\s*ghost\b(?P<code>[^\n]*)")
LOOPS = ("for_statement", "while_statement", "do_statement")
LEMMA = re.compile(r"\blemma\s+(\w+)")


def read(path: Path) -> str:
    """The text of a file of C, its ghost code being C, too."""
    text = read_text(path)
    try:
        parse(text)
        parse(with_ghosts(text))
    except SyntaxProblem as error:
        raise SyntaxProblem(f"{path}:{error}") from error
    return text


def blanked(match: re.Match[str]) -> str:
    """The same number of characters and lines, all of them white."""
    return re.sub(r"[^\n]", " ", match.group())


@lru_cache(maxsize=1024)
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


@lru_cache(maxsize=1024)
def without_prose(text: str) -> str:
    """The text with nothing in its comments but what provers read, each line in its place."""

    def replace(match: re.Match[str]) -> str:
        comment = match.group("comment")
        if comment is None:
            return match.group()
        if comment[2:3] == "@":
            return comment[:3] + re.sub(r"//[^\n]*", "", comment[3:])
        return " " + "\n" * comment.count("\n")

    bare = TOKEN.sub(replace, text)
    return "\n".join(line.rstrip() for line in bare.splitlines())


@lru_cache(maxsize=1024)
def essence(text: str) -> str:
    """The text without comments and blank lines: what a compiler sees of it, places aside."""
    bare = TOKEN.sub(lambda match: " " if match.group("comment") else match.group(), text)
    return "\n".join(line.rstrip() for line in bare.splitlines() if line.strip())


@lru_cache(maxsize=1024)
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


def declarators(node: Node) -> Iterator[Node]:
    """The functions that a definition or a declaration is of: name and parameters of each."""
    for one in node.children_by_field_name("declarator"):
        inner: Node | None = one
        while inner and inner.type == "pointer_declarator":
            inner = inner.child_by_field_name("declarator")
        name = inner.child_by_field_name("declarator") if inner else None
        if inner and inner.type == "function_declarator" and name and name.type == "identifier":
            yield inner


def at_file_level(text: str) -> Iterator[tuple[Node, Node]]:
    """Each function of a text, in its order: the definition or declaration, and the declarator."""
    last = 0
    for node in found(parse(text), "function_definition", "declaration"):
        if node.start_byte >= last:
            yield from ((node, declarator) for declarator in declarators(node))
            last = node.end_byte if node.type == "function_definition" else last


@lru_cache(maxsize=1024)
def functions(text: str) -> tuple[Function, ...]:
    """The functions that a text defines or declares, in its order."""
    every = []
    for node, declarator in at_file_level(text):
        name = declarator.children[0]
        words = [written(child) for child in node.children]
        body = node.child_by_field_name("body")
        line = name.start_point.row + 1
        place = span(body) if body else None
        every.append(Function(written(name), line, "static" in words, place))
    return tuple(every)


def block(text: str, body: tuple[int, int]) -> Node:
    """The tree of a body."""
    blocks = found(parse(text), "compound_statement")
    return next(one for one in blocks if span(one) == body)


def defined(text: str) -> list[Function]:
    """The functions that a text defines."""
    return [function for function in functions(text) if function.body]


@lru_cache(maxsize=1024)
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
    """How many loops a body of code has."""
    return len(found(parse(body), *LOOPS))


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


@lru_cache(maxsize=1024)
def includes(text: str) -> tuple[tuple[str, bool], ...]:
    """The files that a text includes, and whether with quotation marks.

    A name that only the preprocessor could tell is an error.
    """
    named = []
    for node in found(parse(text), "preproc_include"):
        path = node.child_by_field_name("path")
        if path is None or path.type not in ("string_literal", "system_lib_string"):
            raise SyntaxProblem(f"{node.start_point.row + 1}: {written(node)}: which file is that?")
        named.append((written(path)[1:-1], path.type == "string_literal"))
    return tuple(named)


@dataclass(frozen=True)
class Call:
    """A call in a text of C, with its arguments, white space in them made one."""

    node: Node
    arguments: tuple[str, ...]

    @property
    def name(self) -> str:
        """Of what is called."""
        return written(self.node.child_by_field_name("function"))

    @property
    def start(self) -> int:
        """Where its name starts."""
        return self.node.start_byte

    @property
    def end(self) -> int:
        """Behind its parentheses."""
        return self.node.end_byte


def calls(code: str | Node, pattern: str) -> list[Call]:
    """The calls, in a text or a tree, of functions whose name a pattern matches."""
    every = []
    for node in found(parse(code) if isinstance(code, str) else code, "call_expression"):
        name, given = (node.child_by_field_name(field) for field in ("function", "arguments"))
        if name and given and re.fullmatch(pattern, written(name)):
            arguments = (one for one in given.named_children if one.type != "comment")
            every.append(Call(node, tuple(map(written, arguments))))
    return every


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
