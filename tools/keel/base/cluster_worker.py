# SPDX-License-Identifier: Apache-2.0
"""What a worker of a cluster does: unpacks the project and has one of its own programs run.

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
    place = Path(tempfile.gettempdir()) / f"keel-order-{os.getuid()}-{name}"
    if not place.is_dir():
        work = Path(tempfile.mkdtemp(prefix="keel-order-"))
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


def carry_out(archive: bytes, words: list[str], order: Any) -> Any:
    """Run a program of the project on an order, which it reads as JSON; its answer is the last
    line that it writes. `words` are the program, from the project's root, and its arguments."""
    place = unpack(archive)
    done = subprocess.run(
        [sys.executable, *words],
        input=json.dumps(order),
        capture_output=True,
        text=True,
        cwd=place,
        check=False,
        env={key: value for key, value in os.environ.items() if key != "DASK"},
    )
    if done.returncode != 0:
        raise RuntimeError(f"an order failed: {done.stderr[-2000:]}")
    return json.loads(done.stdout.splitlines()[-1])
