# SPDX-License-Identifier: Apache-2.0
"""Whether an image depends on nothing but its source: built once more, in another folder."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

from keel.boards.board import read_board
from keel.boards.firmware import Builder
from keel.install import Toolchain

SOURCES = ("bsp", "examples", "include", "src")
COMPARED = ("keel.elf", "keel.bin")


def differences(tools: Toolchain, root: Path, name: str, folder: Path, work: Path) -> Iterator[str]:
    """The files of a board's image in `folder` that are not the same when its source lies in a
    folder below `work`."""
    tools.ensure("firmware", say=lambda _: None)
    copy = work / "another" / "folder"
    shutil.rmtree(copy, ignore_errors=True)
    for part in SOURCES:
        shutil.copytree(root / part, copy / part)
    board = read_board(copy, name)
    builder = Builder(tools, board, copy / "build" / name, copy)
    image = builder.link("keel", builder.objects(board.application))
    for file in COMPARED:
        again = image.elf.with_name(file)
        if again.read_bytes() != (folder / file).read_bytes():
            yield f"{name}/{file}: another folder gives other bits than build/firmware/{name}"
    shutil.rmtree(copy, ignore_errors=True)
