# SPDX-License-Identifier: Apache-2.0
"""The project's files, and what a finding is."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

SKIPPED = frozenset({".git", "build", "__pycache__", ".mypy_cache", ".ruff_cache", ".venv"})


class Finding(NamedTuple):
    """What is wrong, and where."""

    file: str
    line: int
    reason: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.reason}"


class Text(NamedTuple):
    """A file of the project: its path from the root, with slashes, and its lines."""

    path: str
    lines: list[str]

    @property
    def is_c(self) -> bool:
        return self.path.endswith((".c", ".h"))

    @property
    def has_layout(self) -> bool:
        """Whether it is C or C++, which clang-format lays out."""
        return self.is_c or self.path.endswith((".cpp", ".hpp"))

    @property
    def is_kernel(self) -> bool:
        """Whether it is code that is proved and flown."""
        return self.is_c and self.path.startswith(("include/", "src/"))


def read_texts(root: Path) -> list[Text]:
    """The text files below a folder, generated and version-control ones apart."""
    texts = []
    for path in sorted(root.rglob("*")):
        place = path.relative_to(root)
        if SKIPPED.isdisjoint(place.parts) and path.is_file() and not path.is_symlink():
            data = path.read_bytes()
            if b"\0" not in data:
                lines = data.decode(errors="replace").splitlines()
                texts.append(Text(place.as_posix(), lines))
    return texts
