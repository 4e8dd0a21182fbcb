# SPDX-License-Identifier: Apache-2.0
"""C behind functions of plain numbers, so that a test knows no layout of a structure."""

from __future__ import annotations

import ctypes
import tempfile
import unittest
from collections.abc import Iterable
from pathlib import Path

from keel.base.run import output_of

ROOT = Path(__file__).resolve().parents[2]


def library_of(
    case: type[unittest.TestCase],
    shim: str,
    sources: Iterable[str],
    flags: Iterable[str] = ("-Iinclude",),
) -> ctypes.CDLL:
    """A shim linked with sources of the project, for as long as the case's tests run."""
    folder = tempfile.TemporaryDirectory()
    case.addClassCleanup(folder.cleanup)
    source, built = Path(folder.name, "shim.c"), Path(folder.name, "shim.so")
    source.write_text(shim, encoding="utf-8")
    gcc = ["gcc", "-std=c99", "-O1", "-shared", "-fPIC", *flags]
    output_of([*gcc, source, *sources, "-lm", "-o", built])
    return ctypes.CDLL(str(built))


def below(folder: str) -> list[str]:
    """All sources below a folder of the project."""
    paths = sorted((ROOT / folder).rglob("*.c"))
    return [path.relative_to(ROOT).as_posix() for path in paths]
