# SPDX-License-Identifier: Apache-2.0
"""Trees in which a mutant stands in the place of its file."""

from __future__ import annotations

import shutil
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from keel.judge.harness import MODELS
from keel.mutate.operators import Mutant


class Trees:
    """Copies of the tree, one for each trial at a time: the tree itself is never touched."""

    def __init__(self, root: Path, scratch: Path, count: int) -> None:
        self._root = root
        self._free = [scratch / f"tree{number}" for number in range(count)]
        self._lock = threading.Lock()

    @contextmanager
    def with_mutant(self, mutant: Mutant, root: Path) -> Iterator[Path]:
        """A tree in which the mutant has taken its file's place."""
        with self._lock:
            tree = self._free.pop()
        self._fill(tree)
        file = tree / mutant.file.relative_to(root)
        text = file.read_text(encoding="utf-8")
        try:
            file.write_text(mutant.apply(text), encoding="utf-8")
            yield tree
        finally:
            file.write_text(text, encoding="utf-8")
            with self._lock:
                self._free.append(tree)

    def _fill(self, tree: Path) -> None:
        """Copy what proofs are made of, when the tree is used for the first time."""
        for name in ("include", "src", "proofs", MODELS):
            if (self._root / name).is_dir() and not (tree / name).is_dir():
                shutil.copytree(self._root / name, tree / name)
