# SPDX-License-Identifier: Apache-2.0
"""Whether all of an image lies where its board's file asks, and what it takes of memories."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

from keel.base.build import source_files
from keel.base.errors import ROOT
from keel.boards.board import Board, Place
from keel.boards.elf import Contents, Section, Symbol


@dataclass(frozen=True)
class Check:
    """One thing that was looked at, and what is wrong with it."""

    what: str
    address: int
    region: str
    wrong: str = ""


def check_sections(board: Board, contents: Contents) -> Iterator[Check]:
    """Every section lies within one region, and so do its bytes in the image."""
    for section in contents.sections:
        for what, address, does in (
            ("section", section.address, "lie in"),
            ("load of", section.load, "are loaded into"),
        ):
            if address is not None:
                home = next((it.name for it in board.region if it.holds(address, section.size)), "")
                wrong = "" if home else f"{section.size} bytes {does} no region"
                yield Check(f"{what} {section.name}", address, home, wrong)


def check_overlap(contents: Contents) -> Iterator[Check]:
    """No two sections share bytes, at run time or in the image."""
    at_run = [(s.address, s.address + s.size, s.name) for s in contents.sections]
    loaded = [(s.load, s.load + s.size, s.name) for s in contents.sections if s.load is not None]
    for kind, spans in (("", sorted(at_run)), ("load of ", sorted(loaded))):
        for (_, end, first), (start, _, second) in zip(spans, spans[1:], strict=False):
            if start < end:
                yield Check(f"{kind}{second}", start, "", f"overlaps {first}")


def functions_of(
    place: Place, contents: Contents, own: Mapping[str, Contents], root: Path
) -> list[Symbol]:
    """The functions in the image that come from the source files of a place, but for some."""
    wanted = set(source_files(place.code_of, root))
    names = {
        (item.name, item.file)
        for source, made in own.items()
        if source in wanted
        for item in made.functions
    }
    return [
        item
        for item in contents.functions
        if (item.name, item.file) in names
        and not any(fnmatchcase(item.name, pattern) for pattern in place.but)
    ]


def placed(
    place: Place, contents: Contents, own: Mapping[str, Contents], root: Path
) -> Iterator[tuple[str, list[Section | Symbol]]]:
    """Each name of a place with what it stands for in the image."""
    for pattern in place.sections:
        found = [item for item in contents.sections if fnmatchcase(item.name, pattern)]
        yield f"section {pattern}", [*found]
    for pattern in place.symbols:
        named = [item for item in contents.symbols if fnmatchcase(item.name, pattern)]
        yield f"symbol {pattern}", [*named]
    if place.code_of:
        yield f"code of {', '.join(place.code_of)}", [*functions_of(place, contents, own, root)]


def check_places(
    board: Board, contents: Contents, own: Mapping[str, Contents], root: Path = ROOT
) -> Iterator[Check]:
    """What the board's file places lies there."""
    for place in board.place:
        region = board.memory(place.region)
        for name, found in placed(place, contents, own, root):
            if not found and not place.optional:
                yield Check(name, 0, place.region, "the image holds no such thing")
            for item in found:
                what = f"{name}: {item.name}" if item.name not in name.split() else name
                inside = region.holds(item.address, item.size)
                yield Check(what, item.address, place.region, "" if inside else "lies elsewhere")
                if place.load:
                    load = contents.load_of(item)
                    good = load is not None and board.memory(place.load).holds(load, item.size)
                    yield Check(
                        f"load of {what}", load or 0, place.load, "" if good else "lies elsewhere"
                    )


def check_start(board: Board, contents: Contents) -> Iterator[Check]:
    """The image begins at the load address, and its entry is code in the image."""
    loads = [section.load for section in contents.sections if section.load is not None]
    first = min(loads, default=0)
    wrong = "" if first == board.load_address else f"the image begins at 0x{first:08x}"
    yield Check("load address", board.load_address, "", wrong)
    code = [
        item
        for item in contents.functions
        if item.address == contents.entry & ~1 and contents.entry & 1
    ]
    yield Check("entry", contents.entry, "", "" if code else "is no Thumb function")


def check_image(
    board: Board, contents: Contents, own: Mapping[str, Contents], root: Path = ROOT
) -> list[Check]:
    """All checks."""
    return [
        *check_start(board, contents),
        *check_sections(board, contents),
        *check_overlap(contents),
        *check_places(board, contents, own, root),
    ]


def usage(board: Board, contents: Contents) -> dict[str, int]:
    """How much of each region is taken, the copies of what runs elsewhere included."""
    used = dict.fromkeys((region.name for region in board.region), 0)
    for section in contents.sections:
        for address in {section.address, section.load}:
            for region in board.region:
                if address is not None and region.holds(address, section.size):
                    used[region.name] += section.size
    return used
