# SPDX-License-Identifier: Apache-2.0
"""A card for a board's slot, as a PC formats it, and the log that a flight leaves there: by
pyfatfs, a file system that others wrote."""

from __future__ import annotations

import contextlib
import io
import mmap
import tempfile
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from keel.base.errors import ToolError
from keel.boards.packages import load
from keel.install import Toolchain

MIB = 1 << 20
SIZE = 1024 * MIB  # From 256 MiB on clusters have 4 KiB, as cards that are sold have at least.


def file_system(tools: Toolchain) -> tuple[Any, Any]:
    """Of pyfatfs: the class that formats, and the one that reads."""
    tools.ensure("card", say=lambda _: None)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Its own imports are of another time.
        return (
            load(tools, "card-packages", "pyfatfs.PyFat").PyFat,
            load(tools, "card-packages", "pyfatfs.PyFatFS").PyFatBytesIOFS,
        )


def format_card(system: Any, path: Path, kind: str, size: int) -> None:
    """A file with an empty file system, of a kind: FAT12, FAT16 or FAT32."""
    with path.open("wb") as file, warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        file.truncate(size)
        maker = system()
        maker.mkfs(str(path), fat_type=getattr(system, f"FAT_TYPE_{kind}"), size=size)
        maker.close()


@contextlib.contextmanager
def opened(system: Any, file: io.IOBase, offset: int = 0) -> Iterator[Any]:
    """What is on a card, to be read."""
    found = system(file, offset=offset)
    try:
        yield found
    finally:
        found.fs.is_read_only = True  # Its end would write.


def new_card(tools: Toolchain) -> mmap.mmap:
    """A card with a FAT32 and no file; what is written to it is this process's own."""
    with tempfile.TemporaryDirectory(prefix="keel-card-") as folder:
        path = Path(folder) / "card.img"
        format_card(file_system(tools)[0], path, "FAT32", SIZE)
        with path.open("r+b") as file:
            return mmap.mmap(file.fileno(), SIZE, mmap.MAP_PRIVATE)


class Reader(io.RawIOBase):
    """A card's content as a file, of which nothing is copied."""

    def __init__(self, card: mmap.mmap) -> None:
        super().__init__()
        self._card = card
        self._at = 0

    def readable(self) -> bool:
        """It is."""
        return True

    def seekable(self) -> bool:
        """It is."""
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """The next byte that is read."""
        base = {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: len(self._card)}[whence]
        self._at = base + offset
        return self._at

    def readinto(self, room: Any) -> int:
        """Bytes, as many as there is room for."""
        part = self._card[self._at : self._at + len(room)]
        room[: len(part)] = part
        self._at += len(part)
        return len(part)


def log_of(tools: Toolchain, card: mmap.mmap) -> bytes:
    """The log on a card, as it is when the power is cut now."""
    with opened(file_system(tools)[1], Reader(card)) as found:
        names = [str(name) for name in found.walk.files() if str(name).endswith(".ULG")]
        if len(names) != 1:
            raise ToolError(f"the card has {len(names)} logs, where it should have one")
        return bytes(found.readbytes(names[0]))
