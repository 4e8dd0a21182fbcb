"""Boards: what bsp/<board>/board.toml says (tools/firmware.py tells what each key means)."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Self

from common.config import Field, Mistake, Table, Text, model_validator, read_toml
from common.errors import ToolError, unknown

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
    optional: bool = False

    @model_validator(mode="after")
    def is_of_one_kind(self) -> Self:
        if sum(map(bool, (self.sections, self.symbols, self.code_of))) != 1:
            raise ValueError("one of sections, symbols and code_of is needed")
        return self


class BoardFile(Table):
    """A board's file."""

    description: Text
    linker_script: Text
    sources: list[Text]
    application: list[Text]
    load_address: Word
    region: Annotated[list[Region], Field(min_length=1)]
    place: Annotated[list[Place], Field(min_length=1)]
    include: list[Text] = []
    defines: list[Text] = []


class Board(BoardFile):
    """A board: its file, and the name of the folder that it lies in."""

    name: str

    def memory(self, name: str) -> Region:
        return next(region for region in self.region if region.name == name)


def board_folder(root: Path, name: str, file: str = BOARD_FILE) -> Path:
    """The folder of a board that has such a file; the error tells which there are."""
    known = sorted(path.parent.name for path in (root / "bsp").glob(f"*/{file}"))
    if name not in known:
        raise ToolError(unknown("board", name, known))
    return root / "bsp" / name


def mistakes(root: Path, board: BoardFile) -> Iterator[Mistake]:
    """Names of what is not there."""
    if not (root / board.linker_script).is_file():
        yield ("linker_script",), f"there is no {board.linker_script}"
    for folder in board.include:
        if not (root / folder).exists():
            yield ("include",), f"there is no {folder}"
    known = {region.name for region in board.region}
    for number, place in enumerate(board.place):
        for key in ("region", "load"):
            if (name := getattr(place, key)) and name not in known:
                yield ("place", number, key), f"there is no region {name}"


def read_board(root: Path, name: str) -> Board:
    """Read and check a board's file."""
    path = board_folder(root, name) / BOARD_FILE
    file = read_toml(path, BoardFile, lambda found: mistakes(root, found))
    return Board(name=name, **dict(file))
