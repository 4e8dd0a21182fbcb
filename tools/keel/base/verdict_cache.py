# SPDX-License-Identifier: Apache-2.0
"""Remembers proofs that succeeded, under everything that they depend on.

Only success is kept. A time-out says something about the machine's load, not about the code, and a
failure is worth looking at again.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from keel.base.files import write_text


def digest(value: object) -> str:
    """SHA-256 of a JSON value."""
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()


def digest_of_files(files: list[Path], root: Path) -> dict[str, str]:
    """SHA-256 of each file, by its name relative to the root."""
    return {
        os.path.relpath(path, root): hashlib.sha256(path.read_bytes()).hexdigest() for path in files
    }


OLDEST = 90 * 24 * 3600.0  # seconds since an entry was last of use
LARGEST = 500_000_000  # bytes of all entries


class Cache:
    """Results of successful jobs, one file each; what the keys are made of names no clone.

    A fresh one is written, and not read.
    """

    def __init__(self, folder: Path | None, fresh: bool = False) -> None:
        self._folder = folder
        self._fresh = fresh

    def get(self, key: str) -> dict[str, Any] | None:
        """The result kept under a key; None if there is none, or none that can be trusted."""
        if not self._folder or self._fresh:
            return None
        path = self._folder / f"{key}.json"
        try:
            entry = json.loads(path.read_text(encoding="utf-8"))
            result = dict(entry["result"])
            if entry["key"] != key or entry["digest"] != digest(result) or result.get("problems"):
                return None
            os.utime(path)
        except (OSError, ValueError, KeyError, TypeError):
            return None
        return result

    def put(self, key: str, result: Mapping[str, Any]) -> None:
        """Keep a result. The caller only offers success."""
        if self._folder:
            entry = {"key": key, "digest": digest(dict(result)), "result": result}
            write_text(self._folder / f"{key}.json", json.dumps(entry))

    def prune(self, oldest: float = OLDEST, largest: int = LARGEST) -> None:
        """Forget what has been of no use for long, and the least recently used beyond a size."""
        entries = []
        for path in self._folder.glob("*.json") if self._folder else ():
            with contextlib.suppress(OSError):  # another run prunes as well
                seen = path.stat()
                entries.append((seen.st_mtime, seen.st_size, path))
        total = 0
        for used, size, path in sorted(entries, reverse=True):
            total += size
            if total > largest or used < time.time() - oldest:
                path.unlink(missing_ok=True)
