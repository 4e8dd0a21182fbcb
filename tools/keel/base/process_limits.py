# SPDX-License-Identifier: Apache-2.0
"""Limits the processor time of programs, so that no verdict depends on how busy a machine is."""

from __future__ import annotations

import contextlib
import os
import subprocess
import time
from pathlib import Path

CORES = os.cpu_count() or 1
TICKS_PER_S = os.sysconf("SC_CLK_TCK")
SHORTEST_S = 0.2  # between two looks at what has been used
# A program that computes gets more than this part of a processor, however busy the machine is. One
# that gets less for as long as its limit waits for something that does not come.
HANGING = 0.01
# Fields of /proc/PID/stat behind the name: the session, the process's times and its children's.
SESSION, TIMES = 3, slice(11, 15)


def used_s(session: int) -> float:
    """The processor time of all processes of a session, and of those that they have waited for."""
    ticks = 0
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError, ValueError, IndexError):
            fields = stat.read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
            if int(fields[SESSION]) == session:
                ticks += sum(map(int, fields[TIMES]))
    return ticks / TICKS_PER_S


def communicate(child: subprocess.Popen[str], limit_s: float | None) -> tuple[str, str]:
    """What a program writes until it ends, on both streams.

    It leads a session of its own. TimeoutExpired when the session has used up its processor time,
    or hangs: it is not ended then.
    """
    seen_s, since = 0.0, time.monotonic()
    while True:
        try:
            wait_s = None if limit_s is None else max((limit_s - seen_s) / CORES, SHORTEST_S)
            return child.communicate(timeout=wait_s)
        except subprocess.TimeoutExpired:
            assert limit_s is not None
            used, now = used_s(child.pid), time.monotonic()
            if used >= limit_s:
                raise
            if used - seen_s > HANGING * (now - since):
                seen_s, since = used, now
            elif now - since >= limit_s:
                raise
