# SPDX-License-Identifier: Apache-2.0
"""Reads declarations of Keel's headers: structures, signatures, macros.

Of a structure, plain fields are understood, and arrays of one dimension. Any other is an error,
never left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from keel.c import source as csource
from keel.c.project import ProjectError
from keel.c.syntax import Node, found, parse, written

PLAIN_TYPES = ("type_identifier", "primitive_type")
STORAGE = frozenset(["static", "inline", "extern"])


@dataclass(frozen=True)
class Field:
    """One field of a structure; `size` is that of an array, as it is written."""

    name: str
    type: str
    pointer: bool
    size: str


Structures = dict[str, tuple[Field, ...]]
# The parameters and the text of each.
Macros = dict[str, tuple[tuple[str, ...], str]]


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
    every: Structures = {}
    for text in texts:
        every |= _structures(text)
    return every


@lru_cache(maxsize=1024)
def _structures(text: str) -> Structures:
    every: Structures = {}
    for node in found(parse(text), "type_definition"):
        struct, name = (node.child_by_field_name(field) for field in ("type", "declarator"))
        body = struct.child_by_field_name("body") if struct else None
        if struct and struct.type == "struct_specifier" and body:
            fields = (one for one in body.named_children if one.type != "comment")
            every[written(name)] = tuple(_field(written(name), one) for one in fields)
    return every


@dataclass(frozen=True)
class _Declared:
    """What a declarator says: the name, None if there is none, and what it is besides its type."""

    name: Node | None
    pointer: bool
    sizes: tuple[str, ...]


def _declared(node: Node | None) -> _Declared:
    pointer, sizes = False, []
    while node and node.type in ("pointer_declarator", "array_declarator"):
        pointer = pointer or node.type == "pointer_declarator"
        if node.type == "array_declarator":
            sizes.append(written(node.child_by_field_name("size")))
        node = node.child_by_field_name("declarator")
    return _Declared(node, pointer, tuple(sizes))


def _field(struct: str, node: Node) -> Field:
    type_ = node.child_by_field_name("type")
    every = [_declared(one) for one in node.children_by_field_name("declarator")]
    plain = type_ and type_.type in PLAIN_TYPES and len(every) == 1 and len(every[0].sizes) < 2
    bits = [one for one in node.named_children if one.type == "bitfield_clause"]
    if not plain or bits or not every[0].name or every[0].name.type != "field_identifier":
        raise ProjectError(f"{struct}: what is {written(node)!r}? One plain field a line")
    [one] = every
    return Field(written(one.name), written(type_), one.pointer, "".join(one.sizes))


@lru_cache(maxsize=1024)
def signatures(text: str) -> dict[str, Signature]:
    """The functions that a text declares or defines."""
    code = csource.code_only(text)
    every = {}
    for node, declarator in csource.at_file_level(text):
        name, parameters = declarator.children[:2]
        words = _words(code[node.start_byte : name.start_byte])
        result = " ".join(word for word in words if word not in STORAGE)
        given = [one for one in parameters.named_children if one.type == "parameter_declaration"]
        every[written(name)] = Signature(
            result, tuple(_parameter(one, code) for one in given if written(one) != "void")
        )
    return every


def _words(text: str) -> list[str]:
    return text.replace("*", " * ").split()


def _parameter(node: Node, code: str) -> Parameter:
    one = _declared(node.child_by_field_name("declarator"))
    words = _words(code[node.start_byte : one.name.start_byte if one.name else node.end_byte])
    if one.pointer and words[-1] == "const":
        words.pop()
    if not one.pointer and not one.sizes:
        words = [word for word in words if word != "const"]
    return Parameter(written(one.name), " ".join([*words, *(["*"] if one.sizes else [])]))


@lru_cache(maxsize=1024)
def _macros(text: str) -> Macros:
    bare = csource.without_comments(text)
    every: Macros = {}
    for node in found(parse(text), "preproc_def", "preproc_function_def"):
        name, parameters = (node.child_by_field_name(field) for field in ("name", "parameters"))
        last = parameters or name
        if name and last:
            meant = " ".join(bare[last.end_byte : node.end_byte].replace("\\\n", " ").split())
            names = found(parameters, "identifier") if parameters else []
            every |= {written(name): (tuple(map(written, names)), meant)} if meant else {}
    return every


def macros(texts: Iterable[str]) -> Macros:
    """Macros by name: parameters and text."""
    every: Macros = {}
    for text in texts:
        every |= _macros(text)
    return every


def resolved(word: str, known: Macros) -> str:
    """The last name that a plain macro leads to; numbers, which may be chosen anew, are none."""
    seen: set[str] = set()
    while word in known and not known[word][0] and word not in seen:
        seen.add(word)
        text = known[word][1].strip("() ")
        if not text.isidentifier():
            break
        word = text
    return word


NUMBER = re.compile(r"\b(0[xX][0-9a-fA-F]+|\d+)(?:[uU]?[lL]{0,2}|[lL]{1,2}[uU]?)\b")
ARITHMETIC = re.compile(r"[\s()+*]|\d+|0[xX][0-9a-fA-F]+|-|/|<<|>>")
DEPTH = 20  # Macros behind each other.


def number(text: str, known: Macros) -> int | None:
    """The number that a constant expression of macros and integers comes to, None if it is none."""
    for _ in range(DEPTH):
        names = re.findall(r"\b[A-Za-z_]\w*", NUMBER.sub("", text))
        if not names:
            break
        if any(name not in known or known[name][0] for name in names):
            return None
        for name in set(names):
            text = re.sub(rf"\b{name}\b", f"({known[name][1]})".replace("\\", " "), text)
    plain = NUMBER.sub(lambda match: str(int(match[1], 0)), text).replace("/", "//")
    if not plain.strip() or ARITHMETIC.sub("", plain.replace("//", "/")):
        return None
    try:
        return int(eval(plain, {"__builtins__": {}}))
    except (SyntaxError, ValueError, TypeError, ZeroDivisionError):
        return None


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


def read(paths: Iterable[Path]) -> list[str]:
    """The texts of files of C."""
    return [csource.read(path) for path in paths]
