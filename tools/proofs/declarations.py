# SPDX-License-Identifier: Apache-2.0
"""Reads declarations of Keel's headers: structures, signatures, macros.

They are in one style, a declaration a line, which a few expressions can read. What they cannot is
an error, never left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from . import csource
from .project import ProjectError

STRUCT = re.compile(r"^typedef struct \w+ \{\n(?P<body>.*?)^\} (?P<name>\w+);", re.M | re.S)
FIELD = re.compile(
    r"(?:const )?(?P<type>\w+)\s+(?:const )?(?P<pointer>\*?)\s*(?P<name>\w+)\s*"
    r"(?:\[(?P<size>\w+)\])?"
)
MACRO = re.compile(
    r"^[ \t]*#[ \t]*define[ \t]+(?P<name>\w+)(?P<parameters>\([^)]*\))?[ \t]+"
    r"(?P<text>(?:\\\n|[^\n])*)",
    re.M,
)
STORAGE = frozenset(["static", "inline", "extern"])


@dataclass(frozen=True)
class Field:
    """One field of a structure; `size` is that of an array, as it is written."""

    name: str
    type: str
    pointer: bool
    size: str


Structures = dict[str, tuple[Field, ...]]


@dataclass(frozen=True)
class Parameter:
    """One parameter: its type without the name, an array being a pointer."""

    name: str
    type: str

    @property
    def base(self) -> str:
        """The type that a pointer points to, or the type itself."""
        return self.type.replace("const ", "").rstrip("* ")

    @property
    def written(self) -> bool:
        """Whether the function may write through it."""
        return self.type.endswith("*") and not self.type.startswith("const ")


@dataclass(frozen=True)
class Signature:
    """What a function takes and gives."""

    result: str
    parameters: tuple[Parameter, ...]

    @property
    def types(self) -> tuple[str, ...]:
        """Of result and parameters, which two functions must share to be alike."""
        return (self.result, *(parameter.type for parameter in self.parameters))


def structures(texts: Iterable[str]) -> Structures:
    """The structures that texts declare, by the names of their types."""
    found: Structures = {}
    for text in texts:
        for match in STRUCT.finditer(csource.without_comments(text)):
            lines = match["body"].split(";")
            found[match["name"]] = tuple(_field(match["name"], line) for line in lines[:-1])
    return found


def _field(struct: str, text: str) -> Field:
    match = FIELD.fullmatch(" ".join(text.split()))
    if not match:
        raise ProjectError(f"{struct}: what is {' '.join(text.split())!r}? One plain field a line")
    return Field(match["name"], match["type"], bool(match["pointer"]), match["size"] or "")


def signatures(text: str) -> dict[str, Signature]:
    """The functions that a text declares or defines."""
    code = csource.code_only(text)
    found = {}
    for match in csource.FUNCTION.finditer(code):
        words = match["head"].replace("*", " * ").split()
        if words[0] in csource.NOT_A_FUNCTION:
            continue
        result = " ".join(word for word in words if word not in STORAGE)
        parameters = match["parameters"].strip()
        parts = [] if parameters in ("", "void") else parameters.split(",")
        found[match["name"]] = Signature(result, tuple(_parameter(part) for part in parts))
    return found


def _parameter(text: str) -> Parameter:
    plain, array, _ = text.partition("[")
    words = plain.replace("*", " * ").split()
    name = words.pop()
    if "*" in words and words[-1] == "const":
        words.pop()
    if "*" not in words and not array:
        words = [word for word in words if word != "const"]
    return Parameter(name, " ".join([*words, *(["*"] if array else [])]))


def macros(texts: Iterable[str]) -> dict[str, tuple[tuple[str, ...], str]]:
    """Macros by name: parameters and text."""
    found = {}
    for text in texts:
        for match in MACRO.finditer(csource.without_comments(text)):
            parameters = tuple(re.findall(r"\w+", match["parameters"] or ""))
            found[match["name"]] = (
                parameters,
                " ".join(match["text"].replace("\\\n", " ").split()),
            )
    return found


def resolved(word: str, known: dict[str, tuple[tuple[str, ...], str]]) -> str:
    """The last name that a plain macro leads to; numbers, which may be chosen anew, are none."""
    seen: set[str] = set()
    while word in known and not known[word][0] and word not in seen:
        seen.add(word)
        text = known[word][1].strip("() ")
        if not text.isidentifier():
            break
        word = text
    return word


@dataclass(frozen=True)
class Call:
    """A call in a body of code."""

    start: int
    end: int
    arguments: tuple[str, ...]


def calls(body: str, pattern: str) -> Iterator[Call]:
    """The calls of functions whose name a pattern matches."""
    for match in re.finditer(rf"\b(?:{pattern})\s*\(", body):
        end = closing(body, match.end() - 1)
        arguments = split(body[match.end() : end - 1], ",")
        yield Call(match.start(), end, tuple(arguments))


def closing(text: str, start: int) -> int:
    """The index behind the parenthesis that closes the one at `start`."""
    depth = 0
    for match in re.finditer(r"[()]", text[start:]):
        depth += 1 if match.group() == "(" else -1
        if depth == 0:
            return start + match.end()
    return len(text)


def split(text: str, separator: str) -> list[str]:
    """The parts between separators outside of parentheses and brackets, white space made one."""
    parts = [""]
    depth = position = 0
    while position < len(text):
        character = text[position]
        depth += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(character, 0)
        if depth == 0 and text.startswith(separator, position):
            parts.append("")
            position += len(separator)
        else:
            parts[-1] += character
            position += 1
    return [" ".join(part.split()) for part in parts if part.strip()]


def bare(text: str) -> str:
    """An expression without parentheses around the whole of it."""
    text = text.strip()
    while text.startswith("(") and closing(text, 0) == len(text):
        text = text[1:-1].strip()
    return text


def read(paths: Iterable[Path]) -> list[str]:
    """The texts of files."""
    return [path.read_text(encoding="utf-8") for path in paths]
