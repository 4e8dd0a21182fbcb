# SPDX-License-Identifier: Apache-2.0
"""What several suites need built: once for the sources as they are now, by whoever comes first.

Suites are processes of their own, side by side. A build lies below build/test/shared, in a folder
named by the digest of all that it is made of, and its users change nothing there.
"""

from __future__ import annotations

import contextlib
import fcntl
import functools
import hashlib
import io
import shutil
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from keel.base.errors import ROOT
from keel.boards import firmware
from keel.boards.board import application_of, read_board
from keel.boards.rebuilt import SOURCES
from keel.flight import board as flying
from keel.flight import library
from keel.install import Toolchain

SHARED = ROOT / "build/test/shared"
PARTS = (*SOURCES, "specs")
MADE_BY = ("tools/keel", "tools/toolchain.lock.json")
COPTER = "copter"
NEVER = ("__pycache__", "*.pyc")
KEPT = 8  # Folders; a state of the sources has four at most.


def copy_sources(folder: Path, root: Path = ROOT) -> Path:
    """All that images are made of, in a folder of its own."""
    for part in PARTS:
        shutil.copytree(root / part, folder / part, ignore=shutil.ignore_patterns(*NEVER))
    return folder


def images(tools: Toolchain, boards: Iterable[str]) -> Path:
    """The copter's images of boards, in a copy of the sources: they do not replace the user's."""
    tools.ensure("firmware", "fatfs")
    root = _folder("images") / "root"
    _once(root, copy_sources)
    for name in boards:
        _once(root / firmware.FIRMWARE / name, lambda _, name=name: _image(tools, name, root))
    return root


def flying_board(tools: Toolchain, name: str) -> Path:
    """The library that flies a board's image."""
    tools.ensure("model")
    root = images(tools, (name,))
    folder = root.with_name(f"flying-{name}")
    _once(folder, lambda draft: flying.pack(tools, name, draft, root))
    return folder / flying.LIBRARY


def copter_library(tools: Toolchain, more: Sequence[str] = ()) -> Path:
    """The host's copter, with more flags."""
    folder = _folder("copter", *more)
    _once(folder / "made", lambda draft: library.build(tools, draft, more=more))
    return folder / "made" / library.NAME


def _image(tools: Toolchain, name: str, root: Path) -> None:
    named = application_of(read_board(root, name), COPTER)
    with contextlib.redirect_stdout(io.StringIO()):
        firmware.build(tools, name, named.application, root, "fatfs" in named.libraries)


def _folder(*kind: str) -> Path:
    return SHARED / hashlib.sha256("\0".join((_digest(), *kind)).encode()).hexdigest()[:16]


@functools.cache
def _digest() -> str:
    """Of each file that a build depends on, and of what builds it."""
    total = hashlib.sha256()
    for part in (*PARTS, *MADE_BY):
        place = ROOT / part
        for path in sorted(place.rglob("*")) if place.is_dir() else [place]:
            if path.is_file() and path.suffix != ".pyc":
                total.update(f"{path.relative_to(ROOT)}\0".encode())
                total.update(hashlib.sha256(path.read_bytes()).digest())
    return total.hexdigest()


def _once(folder: Path, make: Callable[[Path], object]) -> None:
    """Make what a folder holds, unless it was made; others wait meanwhile."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    whole = folder.with_name(f"{folder.name}.whole")
    with folder.with_name(f"{folder.name}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not whole.exists():
            shutil.rmtree(folder, ignore_errors=True)
            make(folder)
            whole.touch()
            for old in sorted(SHARED.iterdir(), key=lambda it: it.stat().st_mtime)[:-KEPT]:
                shutil.rmtree(old, ignore_errors=True)
