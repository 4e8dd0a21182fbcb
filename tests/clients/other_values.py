# SPDX-License-Identifier: Apache-2.0
"""Values that the copter's parameters can have, and do not have by default."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

SHARP = 2**24  # Below this each whole number is a float,
COARSE = 128  # and of those that an int32 can be each multiple of this.
METADATA = Path(__file__).resolve().parents[2] / "examples/copter/parameters.json"


def rounded(number: float) -> float:
    """As a float of C."""
    return float(struct.unpack("<f", struct.pack("<f", number))[0])


def another(row: dict[str, Any]) -> float:
    """For a row of the metadata: near to the default, so that it contradicts no other."""
    default, end = row["default"], row["max"] if row["max"] > row["default"] else row["min"]
    if "increment" in row:
        step = 1 if default < SHARP else COARSE
        return float(default + (step if end > default else -step))
    return rounded(default + (end - default) / 64.0)


def defaults() -> dict[str, float]:
    """By name."""
    return {row["name"]: rounded(row["default"]) for row in rows()}


def others() -> dict[str, float]:
    """By name."""
    return {row["name"]: another(row) for row in rows()}


def rows() -> list[dict[str, Any]]:
    """The metadata."""
    found: list[dict[str, Any]] = json.loads(METADATA.read_text(encoding="utf-8"))["parameters"]
    return found
