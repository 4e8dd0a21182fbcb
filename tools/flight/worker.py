# SPDX-License-Identifier: Apache-2.0
"""What a worker of a cluster does: unpacks the project and has its own tools fly some seeds.

It is sent as it stands here, so that a worker needs Python and nothing of Keel's.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path
from typing import Any


def unpack(archive: bytes) -> Path:
    """The project's folder; unpacked once, whichever orders come."""
    name = hashlib.sha256(archive).hexdigest()[:16]
    place = Path(tempfile.gettempdir()) / f"keel-flights-{os.getuid()}-{name}"
    if not place.is_dir():
        work = Path(tempfile.mkdtemp(prefix="keel-flights-"))
        with tarfile.open(fileobj=io.BytesIO(archive)) as tar:
            for entry in tar:
                file = tar.extractfile(entry)
                path = work / entry.name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(file.read() if file else b"")
        try:
            work.rename(place)
        except OSError:
            if not place.is_dir():  # else another order was faster
                raise
    return place


def carry_out(archive: bytes, seeds: list[int]) -> list[dict[str, Any]]:
    """Fly these seeds; what the project's own program says of each."""
    place = unpack(archive)
    words = [sys.executable, str(place / "tools/with_packages.py"), "fly", "-m", "flight.orders"]
    done = subprocess.run(words, input=json.dumps(seeds), capture_output=True, text=True, cwd=place,
                          check=False)  # fmt: skip
    if done.returncode != 0:
        raise RuntimeError(f"an order failed: {done.stderr[-2000:]}")
    answers: list[dict[str, Any]] = json.loads(done.stdout.splitlines()[-1])
    return answers
