# SPDX-License-Identifier: Apache-2.0
"""The whole copter behind functions of plain numbers: what tests of its tasks share."""

from __future__ import annotations

import ctypes
import shutil
import tempfile
import unittest
from pathlib import Path

from keel.base.run import output_of

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
    scratch = tempfile.mkdtemp()
    case.addClassCleanup(shutil.rmtree, scratch)
    source, library = Path(scratch, "shim.c"), Path(scratch, "copter.so")
    source.write_text(shim, encoding="utf-8")
    folders = ("include", "bsp", "examples/urpilot", "examples/copter")
    sources = [
        *sorted((ROOT / "examples/copter").glob("*.c")),
        ROOT / "examples/urpilot/urpilot_tasks.c",
        *(ROOT / f"bsp/common/{name}.c" for name in COMMON),
        *sorted((ROOT / "src").rglob("*.c")),
    ]
    output_of(
        [
            "gcc",
            "-std=c99",
            "-O1",
            "-Wall",
            "-Werror",
            "-shared",
            "-fPIC",
            *(f"-I{ROOT / folder}" for folder in folders),
            source,
            *sources,
            "-lm",
            "-o",
            library,
        ]
    )
    return ctypes.CDLL(str(library))
