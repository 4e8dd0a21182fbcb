# SPDX-License-Identifier: Apache-2.0
"""What is sent to the workers of a cluster: see cluster_worker.py."""

from __future__ import annotations

import io
import tarfile
from collections.abc import Sequence
from pathlib import Path

SETTINGS = "pyproject.toml"  # The tools read there which packages a command needs.


def archive(root: Path, folders: Sequence[str]) -> bytes:
    """What a worker needs of the project; the same bytes for the same files."""
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w:xz") as tar:
        for name in (SETTINGS, *folders):
            for path in sorted([root / name, *(root / name).rglob("*")]):
                if path.is_file() and "__pycache__" not in path.parts:
                    entry = tarfile.TarInfo(path.relative_to(root).as_posix())
                    entry.size, entry.mode = path.stat().st_size, 0o644
                    with path.open("rb") as file:
                        tar.addfile(entry, file)
    return stream.getvalue()
