# SPDX-License-Identifier: Apache-2.0
"""The files that several kinds of tests are built from."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

from keel.base.errors import ROOT
from keel.base.files import read_text

KERNEL = ["src"]
SMALL = "-DKEEL_QUEUE_CAPACITY=6u"  # A queue that is often full.
INCLUDE = re.compile(r'^#include "([^"]+)"$', re.MULTILINE)


def headers_of(path: Path) -> Iterator[Path]:
    """The headers that a C file includes by their way from its own folder."""
    for name in INCLUDE.findall(read_text(path)):
        header = Path(os.path.normpath(path.parent / name))
        if header.is_file():
            yield header


def code_of(header: Path) -> Iterator[Path]:
    """The sources behind a header x.h: x.c, and each x_part.c that has no header of its own."""
    for path in sorted(header.parent.glob(f"{header.stem}*.c")):
        part = path.stem.startswith(f"{header.stem}_") and not path.with_suffix(".h").is_file()
        if path.stem == header.stem or part:
            yield path


def with_code(source: str, root: Path = ROOT) -> list[str]:
    """A C file, and all code that it asks for by such headers: models, and what drives them."""
    found: dict[Path, None] = {}
    todo = [root / source]
    while todo:
        path = todo.pop()
        if path not in found:
            found[path] = None
            todo += [more for header in headers_of(path) for more in (header, *code_of(header))]
    return [path.relative_to(root).as_posix() for path in found if path.suffix == ".c"]
