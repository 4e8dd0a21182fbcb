# SPDX-License-Identifier: Apache-2.0
"""Lines that are typed while something else goes on: nobody waits for them."""

from __future__ import annotations

import os
import select

MOST = 4096  # Bytes at a time, and of a line.


class Keyboard:
    """The lines of a terminal or a pipe. After their end, or an error, there are none."""

    def __init__(self, descriptor: int = 0) -> None:
        self._descriptor = descriptor
        self._bytes = b""
        self._open = True

    def _may_read(self) -> bool:
        """Whether there is something, for us: reading a terminal from the background would stop
        us."""
        try:
            if os.isatty(self._descriptor) and os.tcgetpgrp(self._descriptor) != os.getpgrp():
                return False
            return bool(select.select([self._descriptor], [], [], 0)[0])
        except (OSError, ValueError):
            self._open = False
            return False

    def lines(self) -> list[str]:
        """Those that have come since."""
        if not self._open or not self._may_read():
            return []
        try:
            data = os.read(self._descriptor, MOST)
        except OSError:
            data = b""
        self._open = bool(data)
        *whole, self._bytes = (self._bytes + data).split(b"\n")
        if not self._open and self._bytes:  # The last line needs no end.
            whole, self._bytes = [*whole, self._bytes], b""
        self._bytes = self._bytes[:MOST]
        return [line.decode("ascii", "replace").strip() for line in whole]
