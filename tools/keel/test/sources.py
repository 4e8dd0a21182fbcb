# SPDX-License-Identifier: Apache-2.0
"""The files that several kinds of tests are built from."""

from __future__ import annotations

KERNEL = ["src"]
SMALL = "-DKEEL_QUEUE_CAPACITY=6u"  # A queue that is often full.
SPECIFIED = (
    "admission",
    "admission_queue",
    "clock",
    "decision",
    "pass",
    "pass_idle",
    "pass_run",
    "pass_turn",
    "priority",
    "queue",
    "scheduler",
    "stats",
    "task",
)
# The scheduler's model, and what drives both.
MODEL_SOURCES = [f"tests/property/{name}.c" for name in ("model", "drive", "lockstep")]
MODEL_SOURCES += [f"specs/model/{name}.c" for name in SPECIFIED]
