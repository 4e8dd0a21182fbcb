# SPDX-License-Identifier: Apache-2.0
"""Which line of which source file an instruction comes from, as the compiler's DWARF says."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.boards.packages import load
from keel.install import Toolchain


@dataclass(frozen=True, order=True)
class Place:
    """From here on, instructions come from that line; file "" ends a sequence."""

    address: int
    unit: str = ""  # the file that was compiled
    file: str = ""  # the file with the line: the unit, or a header with an inline function
    line: int = 0


class Lines:
    """The places of an image."""

    def __init__(self, places: Sequence[Place]) -> None:
        # Of several at one address the last counts; the sort keeps their order. Where a function
        # ends another one may begin, which the linker was free to put there.
        self.places = sorted(places, key=lambda place: (place.address, bool(place.unit)))
        self.addresses = [place.address for place in self.places]

    def at(self, address: int) -> Place:
        """Where an instruction comes from; without a file where nobody knows."""
        found = bisect_right(self.addresses, address)
        return self.places[found - 1] if found else Place(address)


def read_lines(tools: Toolchain, path: Path, folders: Sequence[str]) -> Lines:
    """The places of an image that come from units in some folders."""
    module = load(tools, "pyelftools", "elftools.elf.elffile")
    with path.open("rb") as stream:
        dwarf = module.ELFFile(stream).get_dwarf_info()
        found: list[Place] = []
        for unit in dwarf.iter_CUs():
            name = unit.get_top_DIE().attributes["DW_AT_name"].value.decode()
            if name.startswith(tuple(f"{folder}/" for folder in folders)):
                found += places_of(name, dwarf.line_program_for_CU(unit))
    return Lines(found)


def places_of(unit: str, program: Any) -> Iterator[Place]:
    """The places of one unit, but for functions that the linker left out: those begin at 0."""
    files = file_names(program.header)
    rows: list[Any] = []
    for state in (entry.state for entry in program.get_entries() if entry.state):
        rows.append(state)
        if not state.end_sequence:
            continue
        if rows[0].address:
            # A row where the sequence ends has no instruction; another function may begin there.
            for row in rows:
                if row.line and row.address < state.address:
                    yield Place(row.address, unit, files[row.file], row.line)
            yield Place(state.address)
        rows = []


def file_names(header: Any) -> dict[int, str]:
    """The files of a unit by their numbers, which begin at 1 before version 5, and then at 0."""
    first = 0 if header["version"] >= 5 else 1
    folders = [item.decode() for item in header["include_directory"]]
    found = {}
    for number, item in enumerate(header["file_entry"], first):
        inside = item.dir_index - first
        folder = folders[inside] if inside >= 0 and item.dir_index else ""
        found[number] = (Path(folder) / item.name.decode()).as_posix()
    return found
