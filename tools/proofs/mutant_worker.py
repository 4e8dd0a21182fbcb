# SPDX-License-Identifier: Apache-2.0
"""What a worker of a cluster does: unpacks the project and has its own tools try some mutants.

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
    place = Path(tempfile.gettempdir()) / f"keel-mutate-{os.getuid()}-{name}"
    if not place.is_dir():
        work = Path(tempfile.mkdtemp(prefix="keel-mutate-"))
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


def carry_out(archive: bytes, order: dict[str, Any]) -> dict[str, Any]:
    """Try the mutants that an order names; what the project's own program says of them."""
    place = unpack(archive)
    done = subprocess.run(
        [sys.executable, str(place / "tools/mutate.py"), "--order"], input=json.dumps(order),
        capture_output=True, text=True, cwd=place, check=False,
        env={key: value for key, value in os.environ.items() if key != "DASK"},
    )  # fmt: skip
    if done.returncode != 0:
        raise RuntimeError(f"an order failed: {done.stderr[-2000:]}")
    answer: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return answer
