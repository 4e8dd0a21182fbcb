#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compare how structures lie in memory for the provers, the target's compiler and this host.

    python3 tests/machdep/check_layouts.py    # one line; exit status 1 on a difference

Size and alignment of each structure of the headers in include/ and src/, and offset and size of
each of its fields, as four see them: CBMC (goto-cc, as proofs build), Frama-C (its machdep),
arm-none-eabi-gcc and the host's compiler. A structure that one of them lays out in another way is
another object: what is proved of the one says nothing of the other's bytes. The host has longer
pointers, so of structures that hold one nothing is asked there.

No structure holds an enumeration, in sources neither: CBMC gives each four bytes, the target as few
as it needs. The list of structures is read off the text, and what the reader does not understand is
an error.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(Path(__file__).resolve().parent)]

from check_machdep import compiler_values, frama_c_values, output_of, words_of

from keel.c.declarations import Structures, structures
from keel.c.project import ProjectError, include_options
from keel.c.source import read
from keel.c.syntax import Node, found, parse, written
from keel.install import MACHDEP_FILE, Toolchain, ToolchainError

# Types of one size and one alignment on target and host, in a structure as well as alone.
ALIKE = frozenset(
    ["bool", "char", "float", "double"]
    + [f"{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)]
)
AGGREGATES = ("struct_specifier", "union_specifier", "enum_specifier")


@dataclass(frozen=True)
class Fact:
    """A constant expression, and what it says when a person reads it."""

    name: str
    expression: str
    on_host: bool


@dataclass(frozen=True)
class Compared:
    """What was compared, and what differs."""

    structures: int
    on_host: int
    facts: int
    differences: tuple[str, ...]


class Types:
    """What the names of types stand for, in headers and in sources."""

    def __init__(self, headers: Sequence[str], sources: Sequence[str]) -> None:
        self.structures: Structures = structures(headers)
        self._aliases: dict[str, str] = {}
        self._enumerations: set[str] = set()
        self._roots = [parse(text) for text in (*headers, *sources)]
        for root in self._roots:
            for node in found(root, "type_definition"):
                self._read(node)

    def _read(self, node: Node) -> None:
        """One typedef; that of a pointer leaves a name that stands for nothing known."""
        kind = node.child_by_field_name("type")
        for declarator in node.children_by_field_name("declarator"):
            if kind and declarator.type == "type_identifier":
                if kind.type == "enum_specifier":
                    self._enumerations.add(written(declarator))
                elif kind.type not in AGGREGATES:
                    self._aliases[written(declarator)] = written(kind)

    def meant(self, name: str) -> str:
        """What a name stands for in the end."""
        while name in self._aliases:
            name = self._aliases[name]
        return name

    def problems(self) -> Iterator[str]:
        """Enumerations in structures, and structures that the list lacks, as they have no name."""
        for root in self._roots:
            for node in found(root, "struct_specifier", "union_specifier"):
                body = node.child_by_field_name("body")
                named = node.parent is not None and node.parent.type == "type_definition"
                if body and not (named and node.type == "struct_specifier"):
                    yield f"not a structure behind typedef: {written(node)[:60]!r}"
                for one in found(body, "field_declaration") if body else ():
                    if self._is_enumeration(one.child_by_field_name("type")):
                        yield f"{written(one)!r}: an enumeration in a structure"

    def _is_enumeration(self, kind: Node | None) -> bool:
        return kind is not None and (
            kind.type == "enum_specifier" or self.meant(written(kind)) in self._enumerations
        )

    def is_on_host(self, name: str) -> bool:
        """Whether a structure holds nothing that is longer on a host of 64 bits."""
        return all(not one.pointer and self._is_alike(one.type) for one in self.structures[name])

    def _is_alike(self, kind: str) -> bool:
        meant = self.meant(kind)
        return self.is_on_host(meant) if meant in self.structures else meant in ALIKE

    def facts(self) -> Iterator[Fact]:
        """What must agree."""
        for name, fields in self.structures.items():
            host = self.is_on_host(name)
            yield Fact(f"size of {name}", f"sizeof({name})", host)
            yield Fact(f"alignment of {name}", f"__alignof__({name})", host)
            for one in fields:
                place = f"{name}.{one.name}"
                yield Fact(f"offset of {place}", f"offsetof({name}, {one.name})", host)
                yield Fact(f"size of {place}", f"sizeof((({name} *)0)->{one.name})", host)


def program(headers: Sequence[Path], facts: Sequence[Fact]) -> str:
    """One array of words, one word a fact."""
    included = "".join(f'#include "{path}"\n' for path in headers)
    rows = "".join(f"    {fact.expression},\n" for fact in facts)
    return f"#include <stddef.h>\n{included}\nunsigned facts[] = {{\n{rows}}};\n"


def cbmc_values(tools: Toolchain, source: Path, options: Sequence[str]) -> list[int]:
    """The facts as CBMC folds them: the initial values of a goto binary of the project's proofs."""
    environment = {**os.environ, **tools.environment()}
    binary = source.with_suffix(".gb")
    command = [*tools.goto_cc(), *options, "-c", str(source), "-o", str(binary)]
    output_of(command, environment, "goto-cc")
    command = [*tools.command("cbmc"), str(binary), "--show-symbol-table", "--json-ui"]
    every = json.loads(output_of(command, environment, "cbmc"))
    [table] = [one["symbolTable"] for one in every if "symbolTable" in one]
    values = table["facts"]["value"]["sub"]
    unfolded = [one["id"] for one in values if one["id"] != "constant"]
    if unfolded:
        raise ToolchainError(f"cbmc leaves facts unfolded: {unfolded[:3]}")
    return [int(one["namedSub"]["value"]["id"], 16) for one in values]


def host_values(tools: Toolchain, source: Path, options: Sequence[str]) -> list[int]:
    """The facts as this machine's compiler sees them."""
    command = [*tools.command("gcc"), "-std=c99", *options, "-S", str(source), "-o", "-"]
    return words_of(output_of(command, dict(os.environ), "the host's compiler"))


def seen_by_all(tools: Toolchain, source: Path, options: Sequence[str]) -> dict[str, list[int]]:
    """The facts of a program, by who says so; the target's compiler comes first."""
    folded, _ = frama_c_values(tools, source, MACHDEP_FILE, options)
    return {
        "arm-none-eabi-gcc": compiler_values(tools, source, ["-std=c99", *options]),
        "Frama-C": folded,
        "CBMC": cbmc_values(tools, source, options),
        "the host": host_values(tools, source, options),
    }


def differences_of(facts: Sequence[Fact], seen: dict[str, list[int]]) -> Iterator[str]:
    """Where one says something else than the target's compiler."""
    [first, *others] = seen
    for who, values in seen.items():
        if len(values) != len(facts):
            raise ToolchainError(f"{who} has {len(values)} of {len(facts)} facts")
    for number, fact in enumerate(facts):
        for who in others if fact.on_host else others[:-1]:
            is_so, should = seen[who][number], seen[first][number]
            if is_so != should:
                yield f"{fact.name}: {first} says {should}, {who} {is_so}"


def compared(tools: Toolchain, root: Path) -> Compared:
    """All structures of a project."""
    options = [word.replace("-I", f"-I{root}/", 1) for word in include_options(root)]
    headers, sources = (
        [path for part in ("include", "src") for path in sorted(root.glob(f"{part}/**/*.{ending}"))]
        for ending in "hc"
    )
    types = Types([read(path) for path in headers], [read(path) for path in sources])
    facts = list(types.facts())
    with tempfile.TemporaryDirectory(prefix="keel-layouts-") as folder:
        source = Path(folder) / "layouts.c"
        source.write_text(program(headers, facts), encoding="utf-8")
        wrong = [*types.problems(), *differences_of(facts, seen_by_all(tools, source, options))]
    on_host = sum(map(types.is_on_host, types.structures))
    return Compared(len(types.structures), on_host, len(facts), tuple(wrong))


def main() -> int:
    """Entry point."""
    try:
        result = compared(Toolchain(), ROOT)
    except (ProjectError, ToolchainError) as error:
        print(f"layouts: {error}", file=sys.stderr)
        return 1
    of = f"{result.facts} facts of {result.structures} structures"
    if result.differences or not result.structures:
        print(f"layouts: {len(result.differences)} wrong, of {of}", file=sys.stderr)
        print("\n".join(f"  {line}" for line in result.differences), file=sys.stderr)
        return 1
    rest = result.structures - result.on_host
    print(
        f"layouts: {of} are the same for CBMC, Frama-C and the target's compiler, and on the "
        f"host, but for {rest} with pointers there"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
