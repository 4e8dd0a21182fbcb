# SPDX-License-Identifier: Apache-2.0
"""A log out of what a board's console said: lines of `log` and hexadecimal digits among others."""

from __future__ import annotations

import re
from pathlib import Path

from keel.base.errors import ToolError
from keel.base.files import read_text, write_bytes

LINE = re.compile(r"log ((?:[0-9a-f]{2})+)")
BEGIN = "log 554c6f67"  # With it a log begins anew.
END = "log ends"


def messages(path: Path) -> list[bytes]:
    """The messages of the last log that a board sent; a board that was reset begins another."""
    found: list[bytes] = []
    for number, line in enumerate(read_text(path).splitlines(), 1):
        if not line.startswith("log ") or line == END:
            continue
        if not (message := LINE.fullmatch(line.rstrip())):
            raise ToolError(f"{path}:{number}: expected hexadecimal digits behind `log`: {line!r}")
        found = [] if line.startswith(BEGIN) else found
        found.append(bytes.fromhex(message[1]))
    return found


def log_of(path: Path) -> Path:
    """The log in ULog beside a console's text, which is made now."""
    found = messages(path)
    if not found:
        raise ToolError(f"{path}: has no line of a log; a board sends it when `r` is pressed")
    log = path.with_suffix(".ulg")
    write_bytes(log, b"".join(found))
    return log
