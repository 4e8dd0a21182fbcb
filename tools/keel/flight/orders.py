# SPDX-License-Identifier: Apache-2.0
"""Flies the seeds that stand on stdin, and answers on stdout: a worker's program.

    echo '[1, 2, 3]' | python3 tools/keel with fly -m keel.flight.orders

An answer has the digest of all that the flights depend on, so that whoever asked sees whether the
same was flown.
"""

from __future__ import annotations

import fcntl
import json
import os
import sys
from pathlib import Path
from typing import Any

from keel.base.errors import ROOT, program
from keel.flight import library
from keel.flight.crew import Job, flown
from keel.flight.varied import digest_of, order_of
from keel.install import Toolchain

BUILD = ROOT / "build/flights"


def library_of(digest: str) -> Path:
    """The copter's library of these sources; built by the first who asks."""
    folder = BUILD / f"library-{digest[:16]}"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / library.NAME
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not path.is_file():
            library.build(Toolchain(), folder)
    return path


def answer_of(seed: int, digest: str) -> dict[str, Any]:
    """One flight."""
    order = order_of(seed)
    outcome = flown(Job(f"seed {seed}", order, library_of(library.digest_of())))
    return {"digest": digest, **outcome.as_json(), "fault": order.scenario.description}


def answer() -> int:
    """All of them. What anything else prints goes to stderr."""
    out = os.dup(1)
    os.dup2(2, 1)
    digest = digest_of()
    answers = [answer_of(seed, digest) for seed in json.load(sys.stdin)]
    with os.fdopen(out, "w") as stream:
        stream.write(json.dumps(answers) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(program("flights", answer))
