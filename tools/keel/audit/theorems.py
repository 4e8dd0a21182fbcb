# SPDX-License-Identifier: Apache-2.0
"""Tells which theorems of specs/theorems.toml a run has proved: all clauses that one rests on."""

from __future__ import annotations

import re
import textwrap
import tomllib
from collections.abc import Iterable
from pathlib import Path

LIST = "specs/theorems.toml"
LABEL = re.compile(r"(?<![A-Z0-9])[A-Z]{3}_\d{3}(?!\d)")
WIDTH = 100


def labels(texts: Iterable[str]) -> set[str]:
    """The requirements, as QUE-001, whose labels goals and assertions bear."""
    return {label.replace("_", "-") for text in texts for label in LABEL.findall(text)}


def told(root: Path, proved: set[str]) -> list[str]:
    """The statement of each theorem all of whose requirements are proved, in lines."""
    path = root / LIST
    listed = tomllib.loads(path.read_text(encoding="utf-8"))["theorem"] if path.is_file() else ()
    lines: list[str] = []
    for one in listed:
        if proved.issuperset(one["rests_on"]):
            start = f"  {one['id']}: "
            lines += textwrap.wrap(
                one["statement"], WIDTH, initial_indent=start, subsequent_indent="    "
            )
    return ["these theorems hold (conditions: docs/proved.md):", *lines] if lines else []
