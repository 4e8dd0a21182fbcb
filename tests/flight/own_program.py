# SPDX-License-Identifier: Apache-2.0
"""A program of a test's own on an FMUv5, built from a copy of the sources."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from keel.base.errors import ROOT
from keel.boards import firmware
from keel.boards.board import read_board
from keel.boards.rebuilt import SOURCES
from keel.install import Toolchain


@contextmanager
def sources_with(name: str, text: str) -> Iterator[Path]:
    """A copy of the sources in which the program stands in examples/NAME."""
    with tempfile.TemporaryDirectory(prefix="keel-test-") as folder:
        root = Path(folder)
        for part in SOURCES:
            shutil.copytree(ROOT / part, root / part)
        (root / "examples" / name).mkdir()
        (root / "examples" / name / "main.c").write_text(text)
        yield root


def builder_of(tools: Toolchain, root: Path, folder: str) -> firmware.Builder:
    """What builds it, in a folder below build."""
    return firmware.Builder(tools, read_board(root, "fmuv5"), root / "build" / folder, root)
