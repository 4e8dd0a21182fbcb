# SPDX-License-Identifier: Apache-2.0
"""The facts that the register headers state: names from their text, values from the compiler."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from keel.base.errors import ToolError
from keel.base.files import read_text
from keel.base.run import output_of
from keel.install import Toolchain

HEADERS = ("bsp/cortex_m7/core.h", "bsp/stm32f767/registers/*.h")


class RegistersError(ToolError):
    """Something could not be compared; the message says what and why."""


STRUCT = re.compile(r"typedef struct (keel_(\w+)) \{(.*?)\} keel_\w+_t;", re.DOTALL)
MEMBER = re.compile(
    r"volatile uint32_t (\w+)(?:\[\d+\])?;|keel_(?P<part>\w+)_t (?P<array>\w+)\[(?P<count>\d+)\];"
)
DEFINE = re.compile(r"^#define (\w+) +(?!\\)(.+?)(?: */\*.*)?$", re.MULTILINE)


@dataclass(frozen=True)
class Header:
    """The names in one header: register blocks with their registers, and macros.

    A block has each register with its place in C. A block that another one has an array of, such as
    the streams of a controller, is a part of it: register CR of its third is CR2.
    """

    path: str
    blocks: dict[str, dict[str, str]]
    macros: list[str]


def places_of(body: str, parts: dict[str, str]) -> Iterator[tuple[str, str]]:
    """The registers of a block with their places in C."""
    for member in MEMBER.finditer(body):
        if not member["part"]:
            if "reserved" not in member[1]:
                yield member[1], member[1]
            continue
        inner = dict(places_of(parts[member["part"]], parts))
        for i in range(int(member["count"])):
            for name, place in inner.items():
                yield f"{name}{i}", f"{member['array']}[{i}].{place}"


def read_header(root: Path, path: Path) -> Header:
    """The names of a header."""
    text = read_text(path)
    bodies = {match[2]: match[3] for match in STRUCT.finditer(text)}
    parts = {match["part"] for body in bodies.values() for match in MEMBER.finditer(body)}
    blocks = {
        name.upper(): dict(places_of(body, bodies))
        for name, body in bodies.items()
        if name not in parts
    }
    macros = [name for name, _ in DEFINE.findall(text)]
    return Header(path.relative_to(root).as_posix(), blocks, macros)


@dataclass(frozen=True)
class Fact:
    """One statement of a header: its kind, its name, and the numbers that it gives."""

    kind: str
    name: str
    where: str
    block: str = ""
    register: str = ""
    values: tuple[int, ...] = ()


def split_macro(name: str, header: Header) -> tuple[str, str, str]:
    """Block, register and rest of a macro such as RCC_CR_HSEON; empty texts if it is no such."""
    for block, registers in header.blocks.items():
        for register in sorted(registers, key=len, reverse=True):
            prefix = f"{block}_{register}_"
            if name.startswith(prefix):
                return block, register, name.removeprefix(prefix)
    return "", "", ""


def block_of(instance: str, header: Header) -> str:
    """The register block that a peripheral has."""
    if instance in header.blocks or len(header.blocks) != 1:
        return instance if instance in header.blocks else ""
    return next(iter(header.blocks))


def facts_of(header: Header) -> Iterator[Fact]:
    """What a header states, still without the numbers."""
    for name in header.macros:
        block, register, rest = split_macro(name, header)
        if rest == "KEY":
            continue
        if match := re.fullmatch(r"MEMORY_(\w+)_(?:BASE|SIZE)", name):
            yield Fact("memory", name, header.path, match[1])
        elif name.endswith("_IRQ"):
            yield Fact("interrupt", name, header.path, name.removesuffix("_IRQ"))
        elif rest == "RESET":
            for instance in instances_of(block, header):
                if f"{instance}_{register}_RESET" not in header.macros or instance == block:
                    yield Fact("reset", name, header.path, instance, register)
        elif match := re.fullmatch(r"(\w+?)_(\w+)_RESET", name):
            yield Fact("reset", name, header.path, match[1], match[2])
        elif rest:
            yield Fact("field", name, header.path, block, register)
        elif name.endswith("_BASE"):
            instance = name.removesuffix("_BASE")
            yield Fact("base", name, header.path, instance)
            for member in header.blocks.get(block_of(instance, header), []):
                yield Fact("register", f"{instance}.{member}", header.path, instance, member)


def instances_of(block: str, header: Header) -> list[str]:
    """The peripherals that have a register block."""
    bases = [name.removesuffix("_BASE") for name in header.macros if name.endswith("_BASE")]
    return [name for name in bases if block_of(name, header) == block]


def expression(fact: Fact, header: Header) -> str:
    """A C expression for the number of a fact."""
    if fact.kind != "register":
        return fact.name
    block = block_of(fact.block, header)
    place = header.blocks[block][fact.register]
    return f"{fact.block}_BASE + offsetof(keel_{block.lower()}_t, {place})"


def read_headers(root: Path) -> list[Header]:
    """All headers."""
    paths = sorted(path for pattern in HEADERS for path in root.glob(pattern))
    return [read_header(root, path) for path in paths]


def read_facts(tools: Toolchain, root: Path, headers: Sequence[Header]) -> list[Fact]:
    """The facts with their numbers, from a program that includes the headers."""
    pairs = [(fact, header) for header in headers for fact in facts_of(header)]
    if not pairs:
        raise RegistersError("no header states a fact")
    values = evaluate(tools, root, headers, [expression(*pair) for pair in pairs])
    return [with_value(fact, value) for (fact, _), value in zip(pairs, values, strict=True)]


def evaluate(
    tools: Toolchain, root: Path, headers: Sequence[Header], expressions: Sequence[str]
) -> list[int]:
    """What C makes of expressions, with the headers."""
    names = sorted({header.path.removeprefix("bsp/") for header in headers})
    lines = ["#include <stddef.h>", "#include <stdio.h>", *(f'#include "{it}"' for it in names)]
    shown = [f'    printf("%llu\\n", (unsigned long long)({text}));' for text in expressions]
    with tempfile.TemporaryDirectory() as folder:
        source, program = Path(folder, "facts.c"), Path(folder, "facts")
        source.write_text("\n".join([*lines, "int main(void) {", *shown, "    return 0; }", ""]))
        gcc = tools.command("gcc")
        output_of([*gcc, "-std=c99", f"-I{root / 'bsp'}", source, "-o", program])
        return [int(word) for word in output_of([program]).split()]


def with_value(fact: Fact, value: int) -> Fact:
    """A fact with its number; a field's mask is the number of its lowest bit, and how many."""
    if fact.kind != "field":
        return replace(fact, values=(value,))
    low, width = (value & -value).bit_length() - 1, value.bit_count()
    if value != ((1 << width) - 1) << low:
        raise RegistersError(f"{fact.where}: {fact.name}: not one run of bits: {value:#x}")
    return replace(fact, values=(low, width))
