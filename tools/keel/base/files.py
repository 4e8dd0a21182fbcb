# SPDX-License-Identifier: Apache-2.0
"""Writes files: whole or not at all, and errors name the file."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import threading
from collections.abc import Mapping
from pathlib import Path

from keel.base.errors import ToolError, nearest


def write_bytes(path: Path, data: bytes) -> None:
    """Replace a file so that no reader ever sees a half of it."""
    draft = path.with_name(f".{path.name}.{os.getpid()}-{threading.get_ident()}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        draft.write_bytes(data)
        draft.replace(path)
    except OSError as error:
        raise ToolError(f"cannot write {path}: {error.strerror}") from error
    finally:
        with contextlib.suppress(OSError):
            draft.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Replace a file by a text."""
    write_bytes(path, text.encode())


def write_json(path: Path, report: Mapping[str, object]) -> None:
    """Replace a file by a report."""
    write_text(path, json.dumps(report, indent=1, ensure_ascii=False) + "\n")


def read_text(path: Path) -> str:
    """A file's text."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise ToolError(f"{path}: cannot be read: {error.strerror}{guess_of(path)}") from error
    try:
        return data.decode()
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise ToolError(f"{path}:{line}: expected UTF-8") from error


def guess_of(path: Path) -> str:
    """The file that may have been meant instead of one that is not there."""
    folder = path.parent
    there = sorted(item.name for item in folder.iterdir()) if folder.is_dir() else []
    like = "" if path.name in there else nearest(path.name, there)
    return f"; did you mean {folder / like}?" if like else ""


def sha256_of(path: Path) -> str:
    """SHA-256 of a file's content."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
