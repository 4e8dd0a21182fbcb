# SPDX-License-Identifier: Apache-2.0
"""Keeps measured seconds apart: they are all that differs between two packages of one source.

Parts give theirs as `measured`; those of a report that is packed are taken out of the copy. All of
them stand in one file of the package and on the page that shows it, and nowhere else.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from keel.base.source import STAMP

FILE = "measured.json"
PAGE = "site/measured.html"
FILES = (FILE, PAGE)
KEY = "seconds"  # What every report calls them.
TIME = re.compile(rb'(<testsuites?\b[^>]*?) time="[\d.]+"')  # JUnit has the report's once more.

Measured = dict[str, float]


def without(value: Any) -> Any:
    """A report, or a piece of one, without its seconds."""
    if isinstance(value, dict):
        return {name: without(inner) for name, inner in value.items() if name != KEY}
    return [without(inner) for inner in value] if isinstance(value, list) else value


def seconds_in(value: Any, place: str) -> Iterator[tuple[str, float]]:
    """The seconds of a report, each with its place there."""
    inside = enumerate(value) if isinstance(value, list) else ()
    for name, inner in value.items() if isinstance(value, dict) else inside:
        if name == KEY:
            yield place, float(inner)
        else:
            yield from seconds_in(inner, f"{place}/{name}")


def copied(name: str, path: Path) -> tuple[bytes, Measured]:
    """A file as it is packed, and what was measured in it. What is no report stays as it is."""
    data = path.read_bytes()
    if path.suffix == ".xml":
        return TIME.sub(rb"\1", data), {}
    if path.suffix != ".json":
        return data, {}
    report = json.loads(data)
    found = dict(seconds_in(report, name))
    if STAMP not in report or not found:
        return data, {}
    text = json.dumps(without(report), indent=1, ensure_ascii=False) + "\n"
    return text.encode(), found
