# SPDX-License-Identifier: Apache-2.0
"""A small log of runs, made by hand, and what must be seen in it."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from pathlib import Path

RUN, TASK = 0, 1
FORMATS = (
    "run:uint64_t timestamp;uint32_t late_us;uint32_t length_us;uint16_t skipped;"
    "uint8_t slot;uint8_t flags;",
    "task:uint64_t timestamp;uint32_t period_us;uint32_t budget_us;uint32_t guard_us;"
    "uint8_t slot;uint8_t priority;char[32] name;",
)
LOOP, LOW = (0, 1000, 100, 16, "Rate <loop>"), (2, 4000, 300, 1, "Telemetry")


def message(kind: str, body: bytes) -> bytes:
    """A message of ULog."""
    return struct.pack("<HB", len(body), ord(kind)) + body


def task(slot: int, period_us: int, budget_us: int, priority: int, name: str) -> bytes:
    """What a task declares; the guard is 20 us."""
    return message(
        "D",
        struct.pack(
            "<HQIIIBB32s", TASK, 0, period_us, budget_us, 20, slot, priority, name.encode()
        ),
    )


def run(slot: int, start: int, late: int, length: int, skipped: int = 0, flags: int = 0) -> bytes:
    """A run."""
    return message("D", struct.pack("<HQIIHBB", RUN, start, late, length, skipped, slot, flags))


def written(path: Path, messages: Sequence[bytes], formats: Sequence[str] = FORMATS) -> Path:
    """A log of messages."""
    magic = bytes([0x55, 0x4C, 0x6F, 0x67, 0x01, 0x12, 0x35, 0x01])
    log = [magic, bytes(8), message("B", bytes(40))]
    log += [message("F", one.encode()) for one in formats]
    log += [
        message("A", struct.pack("<BH", 0, number) + one.partition(":")[0].encode())
        for number, one in enumerate(formats)
    ]
    path.write_bytes(b"".join([*log, *messages]))
    return path


# Telemetry's second run waits 100 us, is promoted, and takes from 5100 to 9100: it misses its
# deadline at 9000, and Rate loop, which was due from 3000 on, skips six periods. Then 2 ms are
# lost.
SAMPLE = (
    task(*LOOP),
    run(0, 1000, 0, 80, flags=1),
    task(*LOW),
    run(2, 1080, 80, 350, flags=1),
    run(0, 2010, 10, 90),
    run(2, 5100, 100, 4000, flags=2),
    run(0, 9100, 6100, 90, skipped=6),
    message("O", struct.pack("<H", 2)),
    run(0, 12000, 0, 80),
)
