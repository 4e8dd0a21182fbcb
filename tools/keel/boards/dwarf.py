# SPDX-License-Identifier: Apache-2.0
"""Where an image has its variables, and what is in them: by the debugger's information."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.errors import ToolError
from keel.boards.packages import load
from keel.install import Toolchain

LAYERS = ("DW_TAG_typedef", "DW_TAG_const_type", "DW_TAG_volatile_type")


@dataclass(frozen=True)
class Place:
    """A variable, or a part of it."""

    address: int
    size: int
    kind: Any  # Its type, without names for it.

    def part(self, path: str) -> Place:
        """A member of it, as `state.mode` or `vote[2].output`."""
        here = self
        for name, index in re.findall(r"(\w+)|\[(\d+)\]", path):
            here = here.element(int(index)) if index else here.member(name)
        return here

    def member(self, name: str) -> Place:
        """A member of a structure."""
        for child in self.kind.iter_children():
            if child.tag == "DW_TAG_member" and text_of(child, "DW_AT_name") == name:
                offset = child.attributes["DW_AT_data_member_location"].value
                return place_of(self.address + offset, type_of(child))
        raise ToolError(f"the image has no member {name} there")

    def element(self, index: int) -> Place:
        """An element of an array."""
        item = place_of(self.address, type_of(self.kind))
        return place_of(item.address + index * item.size, item.kind)

    @property
    def count(self) -> int:
        """How many elements an array has."""
        for child in self.kind.iter_children():
            if child.tag == "DW_TAG_subrange_type":
                return int(child.attributes["DW_AT_upper_bound"].value) + 1
        raise ToolError("that is no array")


def text_of(entry: Any, name: str) -> str:
    """An attribute of an entry, as text."""
    return entry.attributes[name].value.decode() if name in entry.attributes else ""


def declaration_of(entry: Any) -> Any:
    """What has the name and the type of a variable: a header, if that declares it."""
    is_apart = "DW_AT_specification" in entry.attributes
    return entry.get_DIE_from_attribute("DW_AT_specification") if is_apart else entry


def type_of(entry: Any) -> Any:
    """An entry's type, below all names for it."""
    kind = entry.get_DIE_from_attribute("DW_AT_type")
    while kind.tag in LAYERS:
        kind = kind.get_DIE_from_attribute("DW_AT_type")
    return kind


def place_of(address: int, kind: Any) -> Place:
    """A place of a type."""
    if kind.tag == "DW_TAG_array_type":
        item = place_of(address, type_of(kind))
        return Place(address, item.size * Place(address, 0, kind).count, kind)
    if kind.tag == "DW_TAG_pointer_type":
        return Place(address, 4, kind)
    return Place(address, int(kind.attributes["DW_AT_byte_size"].value), kind)


class Variables:
    """The variables of an image."""

    def __init__(self, tools: Toolchain, path: Path) -> None:
        module = load(tools, "pyelftools", "elftools.elf.elffile")
        self._stream = path.open("rb")
        self._info = module.ELFFile(self._stream).get_dwarf_info()
        self._units = {
            text_of(unit.get_top_DIE(), "DW_AT_name"): unit for unit in self._info.iter_CUs()
        }

    def close(self) -> None:
        self._stream.close()

    def find(self, source: str, name: str) -> Place:
        """A variable of a file."""
        unit = self._units.get(source)
        for entry in unit.get_top_DIE().iter_children() if unit else ():
            declared = declaration_of(entry)
            if entry.tag == "DW_TAG_variable" and text_of(declared, "DW_AT_name") == name:
                place = entry.attributes.get("DW_AT_location")
                if place is not None and place.value[0] == 3:  # DW_OP_addr.
                    address = int.from_bytes(bytes(place.value[1:5]), "little")
                    return place_of(address, type_of(declared))
        raise ToolError(f"the image has no variable {name} of {source}")
