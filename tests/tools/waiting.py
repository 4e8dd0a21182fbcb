# SPDX-License-Identifier: Apache-2.0
"""Waits for what other processes do, as long as a slow machine may need."""

from __future__ import annotations

import time
from collections.abc import Callable

WAIT_S = 120.0


def wait_for(condition: Callable[[], bool]) -> bool:
    """Whether a condition comes true in time."""
    until = time.monotonic() + WAIT_S
    while not condition() and time.monotonic() < until:
        time.sleep(0.05)
    return condition()
