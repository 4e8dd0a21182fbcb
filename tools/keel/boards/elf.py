# SPDX-License-Identifier: Apache-2.0
"""What is in an ELF file: sections that take memory, and symbols."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

from keel.base.errors import ToolError
from keel.boards.packages import load
from keel.install import Toolchain

SHF_ALLOC, SHF_EXECINSTR = 2, 4


@dataclass(frozen=True)
class Section:
    """A section that takes memory, with its addresses at run time and in the image."""

    name: str
    address: int
    size: int
    load: int | None  # None: nothing of it is in the image.


@dataclass(frozen=True)
class Symbol:
    """A function or object."""

    name: str
    address: int
    size: int
    function: bool
    section: str
    file: str  # of a local symbol: the name of its source file.


@dataclass
class Contents:
    """Sections and symbols of an ELF file."""

    entry: int
    sections: list[Section] = field(default_factory=list)
    symbols: list[Symbol] = field(default_factory=list)
    code: dict[str, bytes] = field(default_factory=dict)  # The bytes of sections with code,
    marks: list[tuple[int, bool]] = field(default_factory=list)  # and from where they are code.

    def symbol(self, name: str) -> Symbol:
        for symbol in self.symbols:
            if symbol.name == name:
                return symbol
        raise ToolError(f"the image has no symbol {name}")

    @property
    def functions(self) -> Iterator[Symbol]:
        return (symbol for symbol in self.symbols if symbol.function)

    def load_of(self, item: Section | Symbol) -> int | None:
        """Where the image holds a thing."""
        if isinstance(item, Section):
            return item.load
        for section in self.sections:
            if section.name == item.section and section.load is not None:
                return section.load + item.address - section.address
        return None

    def instructions_of(self, symbol: Symbol) -> Iterator[tuple[int, bytes]]:
        """A function's instructions, without the data among them: addresses and bytes."""
        [home] = (section for section in self.sections if section.name == symbol.section)
        end = symbol.address + symbol.size
        if not symbol.size:  # Of a library's assembly: up to the next function.
            last = home.address + home.size
            end = min(
                (it.address for it in self.functions if symbol.address < it.address < last),
                default=last,
            )
        inside = [(at, code) for at, code in self.marks if symbol.address < at < end]
        before = [(at, code) for at, code in self.marks if at <= symbol.address]
        parts = [(symbol.address, not before or before[-1][1]), *inside, (end, False)]
        for (start, is_code), (stop, _) in pairwise(parts):
            if is_code:
                yield start, self.code[home.name][start - home.address : stop - home.address]


def read_contents(tools: Toolchain, path: Path) -> Contents:
    """Read an ELF file: of a linked image, or of an object (whose addresses mean nothing)."""
    module = load(tools, "pyelftools", "elftools.elf.elffile")
    with path.open("rb") as stream:
        elf = module.ELFFile(stream)
        segments = list(elf.iter_segments())
        contents = Contents(int(elf["e_entry"]))
        names = [section.name for section in elf.iter_sections()]
        for section in elf.iter_sections():
            if section["sh_flags"] & SHF_ALLOC and section["sh_size"]:
                place, size = section["sh_addr"], int(section["sh_size"])
                loaded = load_address(section, segments)
                contents.sections.append(Section(section.name, place, size, loaded))
                if section["sh_flags"] & SHF_EXECINSTR:
                    contents.code[section.name] = section.data()
        contents.symbols = [item for item in read_symbols(elf, names) if item.name[0] != "$"]
        contents.marks = sorted(
            (item.address, item.name.startswith("$t"))
            for item in read_symbols(elf, names)
            if item.name.startswith(("$t", "$d")) and item.section in contents.code
        )
    return contents


def load_address(section: Any, segments: Sequence[Any]) -> int | None:
    """Where the image holds a section's bytes."""
    if section["sh_type"] == "SHT_NOBITS":
        return None
    for segment in segments:
        offset = section["sh_addr"] - segment["p_vaddr"]
        if segment["p_type"] == "PT_LOAD" and 0 <= offset < max(segment["p_filesz"], 1):
            return int(segment["p_paddr"] + offset)
    return None


def read_symbols(elf: Any, sections: Sequence[str]) -> Iterator[Symbol]:
    """Functions, objects, the linker script's names, and the marks of code and data ($t, $d)."""
    file = ""
    for symbol in elf.get_section_by_name(".symtab").iter_symbols():
        kind, where = symbol["st_info"]["type"], symbol["st_shndx"]
        if kind == "STT_FILE":
            file = Path(symbol.name).name
        elif kind in ("STT_FUNC", "STT_OBJECT", "STT_NOTYPE") and symbol.name:
            section = sections[where] if isinstance(where, int) else str(where)
            local = symbol["st_info"]["bind"] == "STB_LOCAL"
            function = kind == "STT_FUNC"
            address = int(symbol["st_value"]) & (~1 if function else ~0)
            if section != "SHN_UNDEF":
                size, origin = int(symbol["st_size"]), file if local else ""
                yield Symbol(symbol.name, address, size, function, section, origin)
