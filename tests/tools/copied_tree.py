# SPDX-License-Identifier: Apache-2.0
"""A copy of parts of the tree for tests that change it: made once, and put back for each test.

Making a copy takes longer than most of what is tested on it.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

State = tuple[int, int] | None  # when a file was written, and its size; None: a folder


class CopiedTree:
    """The copy, which is there until the process ends.

    A copied file bears the time at which the original was written. So one that a test has written
    differs, however soon after the copy that was.
    """

    def __init__(self, source: Path, parts: Sequence[str]) -> None:
        self._holder = tempfile.TemporaryDirectory(prefix="keel-test-")
        self._source = source
        self.root = Path(self._holder.name)
        for part in parts:
            shutil.copytree(source / part, self.root / part)
        self._made = dict(self._found())

    def put_back(self) -> Path:
        """Undo what has been done to the copy; its root."""
        now = dict(self._found())
        for path in now.keys() - self._made.keys():
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path)
            else:
                path.unlink(missing_ok=True)  # its folder may have been new, too
        for path, state in self._made.items():
            if now.get(path, 0) != state:
                self._copy(path)
        return self.root

    def _copy(self, path: Path) -> None:
        original = self._source / path.relative_to(self.root)
        if original.is_dir():
            path.mkdir(exist_ok=True)
        else:
            path.unlink(missing_ok=True)
            shutil.copy2(original, path)

    def _found(self) -> Iterator[tuple[Path, State]]:
        """All that is there, folders before what is in them."""
        for folder, folders, files in os.walk(self.root):
            for name in folders:
                yield Path(folder, name), None
            for name in files:
                path = Path(folder, name)
                told = path.lstat()
                yield path, (told.st_mtime_ns, told.st_size)
