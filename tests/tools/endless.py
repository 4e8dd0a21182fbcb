# SPDX-License-Identifier: Apache-2.0
"""A machine that is busy with other work, for tests of what must not depend on that."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator

PROGRAM = "while True:\n    pass\n"
CORES = os.cpu_count() or 1


@contextlib.contextmanager
def busy(programs: int) -> Iterator[None]:
    """As many endless programs run."""
    children = [subprocess.Popen([sys.executable, "-c", PROGRAM]) for _ in range(programs)]
    try:
        yield
    finally:
        for child in children:
            child.kill()
            child.wait()
