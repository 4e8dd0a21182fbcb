"""Remembers proofs that succeeded, under everything that they depend on.

Only success is kept. A time-out says something about the machine's load, not about the code, and a
failure is worth looking at again.
"""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any


def digest(value: object) -> str:
    """SHA-256 of a JSON value."""
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()


def digest_of_files(files: list[Path], root: Path) -> dict[str, str]:
    """SHA-256 of each file, by its name relative to the root."""
    return {
        os.path.relpath(path, root): hashlib.sha256(path.read_bytes()).hexdigest() for path in files
    }


def write_atomically(path: Path, text: str) -> None:
    """Write a file so that whoever reads it sees all of it or none."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as stream:
            stream.write(text)
        os.replace(name, path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


class Cache:
    """Results of successful jobs, one file each."""

    def __init__(self, folder: Path | None) -> None:
        self._folder = folder

    def get(self, key: str) -> dict[str, Any] | None:
        """The result kept under a key; None if there is none, or none that can be read."""
        if not self._folder:
            return None
        try:
            entry = json.loads((self._folder / f"{key}.json").read_text(encoding="utf-8"))
            return dict(entry["result"]) if entry["key"] == key else None
        except (OSError, ValueError, KeyError, TypeError):
            return None

    def put(self, key: str, result: Mapping[str, Any]) -> None:
        """Keep a result. The caller only offers success."""
        if self._folder:
            text = json.dumps({"key": key, "result": result}, indent=1)
            write_atomically(self._folder / f"{key}.json", text)
