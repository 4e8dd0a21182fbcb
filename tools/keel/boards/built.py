# SPDX-License-Identifier: Apache-2.0
"""The image that `make firmware` left for a board: nothing but what its report vouches for."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.errors import ToolError
from keel.base.files import sha256_of

FIRMWARE = "build/firmware"


@dataclass(frozen=True)
class BuiltImage:
    """A board's image, what is in the report on it, and where it belongs."""

    folder: Path
    elf: Path
    binary: Path
    address: int
    room: int  # Bytes of flash from that address on.
    objects: Mapping[str, str]  # Of each source, from the folder.


def read_built(root: Path, board: str) -> BuiltImage:
    """The image of a board; the error says how to build it."""
    folder = root / FIRMWARE / board
    remedy = f"run: make firmware BOARD={board}"
    try:
        report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
        image = image_of(folder, report)
        same = all(
            sha256_of(folder / report[part]["file"]) == report[part]["sha256"]
            for part in ("elf", "binary")
        )
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ToolError(f"there is no whole image of {board} ({error}); {remedy}") from error
    if not same:
        raise ToolError(f"{folder.relative_to(root)} is not what its report says; {remedy}")
    return image


def image_of(folder: Path, report: Mapping[str, Any]) -> BuiltImage:
    """What a report says of an image."""
    return BuiltImage(
        folder,
        folder / report["elf"]["file"],
        folder / report["binary"]["file"],
        int(report["load_address"]),
        int(report["regions"]["FLASH"]["size"]),
        dict(report["objects"]),
    )
