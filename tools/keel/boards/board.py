# SPDX-License-Identifier: Apache-2.0
"""Boards: what bsp/<board>/board.toml says (tools/keel firmware tells what each key means)."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal, Self

from keel.base.errors import ToolError, unknown
from keel.config import Field, Mistake, Table, Text, model_validator, read_toml

BOARD_FILE = "board.toml"

Word = Annotated[int, Field(ge=0, le=0xFFFF_FFFF)]


class Region(Table):
    """A memory of the board."""

    name: Text
    origin: Word
    size: Word

    def holds(self, address: int, size: int = 0) -> bool:
        """Whether all of these bytes lie in it; an empty thing may lie at its end."""
        return self.origin <= address and address + size <= self.origin + self.size


class Place(Table):
    """Something of the image that must lie in a region."""

    region: Text
    load: Text | None = None
    sections: list[Text] = []
    symbols: list[Text] = []
    code_of: list[Text] = []
    but: list[Text] = []
    optional: bool = False

    @model_validator(mode="after")
    def is_of_one_kind(self) -> Self:
        if sum(map(bool, (self.sections, self.symbols, self.code_of))) != 1:
            raise ValueError("one of sections, symbols and code_of is needed")
        return self


class Named(Table):
    """An application besides the board's own, by a name."""

    name: Text
    application: Annotated[list[Text], Field(min_length=1)]
    libraries: list[Literal["fatfs"]] = []


class Shared(Table):
    """What boards of one chip may share; all of it may be empty here."""

    sources: list[Text] = []
    application: list[Text] = []
    named: list[Named] = []
    region: list[Region] = []
    place: list[Place] = []
    include: list[Text] = []
    defines: list[Text] = []


class BoardFile(Shared):
    """A board's file."""

    description: Text
    linker_script: Text
    load_address: Word
    base: Text | None = None


class Board(Shared):
    """A board: its file joined with its base, and the name of the folder that it lies in."""

    name: str
    description: Text
    linker_script: Text
    load_address: Word

    def memory(self, name: str) -> Region:
        return next(region for region in self.region if region.name == name)


def application_of(board: Board, name: str) -> Named:
    """An application by its name; the error tells which there are."""
    known = {found.name: found for found in board.named}
    if name not in known:
        raise ToolError(unknown("application", name, known))
    return known[name]


def board_names(root: Path, file: str = BOARD_FILE) -> list[str]:
    """The boards that have such a file."""
    return sorted(path.parent.name for path in (root / "bsp").glob(f"*/{file}"))


def board_folder(root: Path, name: str, file: str = BOARD_FILE) -> Path:
    """The folder of a board that has such a file; the error tells which there are."""
    known = board_names(root, file)
    if name not in known:
        raise ToolError(unknown("board", name, known))
    return root / "bsp" / name


def names_of_nothing(root: Path, file: Shared, others: Shared) -> Iterator[Mistake]:
    """Names of what is not there; `others` may have the regions that a place lies in."""
    for folder in file.include:
        if not (root / folder).exists():
            yield ("include",), f"there is no {folder}"
    known = {region.name for region in (*file.region, *others.region)}
    for number, place in enumerate(file.place):
        for key in ("region", "load"):
            if (name := getattr(place, key)) and name not in known:
                yield ("place", number, key), f"there is no region {name}"


def read_base(root: Path, file: BoardFile) -> Shared:
    """What a board shares with others; nothing unless its file names a base."""
    if not file.base:
        return Shared()
    return read_toml(root / file.base, Shared, lambda found: names_of_nothing(root, found, file))


def mistakes(root: Path, file: BoardFile) -> Iterator[Mistake]:
    """What is wrong with a board's file though its types are right."""
    if file.base and not (root / file.base).is_file():
        yield ("base",), f"there is no {file.base}"
        return
    if not (root / file.linker_script).is_file():
        yield ("linker_script",), f"there is no {file.linker_script}"
    base = read_base(root, file)
    yield from names_of_nothing(root, file, base)
    for key in ("sources", "application", "region", "place"):
        if not getattr(file, key) and not getattr(base, key):
            yield (key,), "is missing"


def joined(name: str, file: BoardFile, base: Shared) -> Board:
    """A board's lists behind those of its base; its regions instead of those with their names."""
    lists = {key: [*getattr(base, key), *getattr(file, key)] for key in Shared.model_fields}
    lists["region"] = list({region.name: region for region in lists["region"]}.values())
    return Board(
        name=name,
        description=file.description,
        linker_script=file.linker_script,
        load_address=file.load_address,
        **lists,
    )


def read_board(root: Path, name: str) -> Board:
    """Read and check a board's file."""
    path = board_folder(root, name) / BOARD_FILE
    file = read_toml(path, BoardFile, lambda found: mistakes(root, found))
    return joined(name, file, read_base(root, file))
