# SPDX-License-Identifier: Apache-2.0
"""The whole copter behind functions of plain numbers: what tests of its tasks share."""

from __future__ import annotations

import ctypes
import unittest
from pathlib import Path

from shim import below, library_of

ROOT = Path(__file__).resolve().parents[2]
COMMON = ("slots", "task_table", "trace", "trace_log")
# The least that a port needs: a clock that stands, and receivers that hear nothing.
SILENT = """\
#include "copter.h"
static uint32_t read_clock(void *context)
{
    (void)context;
    return 0u;
}
static bool read_byte(void *context, uint32_t receiver, copter_byte_t *byte)
{
    (void)context;
    (void)receiver;
    (void)byte;
    return false;
}
"""


def copter_of(case: type[unittest.TestCase], shim: str) -> ctypes.CDLL:
    """The copter, linked with a shim in C, for as long as the case's tests run."""
    folders = ("include", "bsp", "examples/urpilot", "examples/copter")
    sources = [
        *below("examples/copter"),
        "examples/urpilot/urpilot_tasks.c",
        *(f"bsp/common/{name}.c" for name in COMMON),
        *below("src"),
    ]
    flags = ("-Wall", "-Werror", *(f"-I{folder}" for folder in folders))
    return library_of(case, shim, sources, flags)
