# SPDX-License-Identifier: Apache-2.0
"""A machine that is busy with other work, for tests of what must not depend on that."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator

PROGRAM = "while True:\n    pass\n"
# Others' work: it is in a session of its own, so that its time is not the test's, and ends with it.
OTHERS = "import os\ntest = os.getppid()\nwhile os.getppid() == test:\n    pass\n"
CORES = os.cpu_count() or 1


@contextlib.contextmanager
def busy(programs: int) -> Iterator[None]:
    """As many endless programs run."""
    line = [sys.executable, "-c", OTHERS]
    children = [subprocess.Popen(line, start_new_session=True) for _ in range(programs)]
    try:
        yield
    finally:
        for child in children:
            child.kill()
            child.wait()
