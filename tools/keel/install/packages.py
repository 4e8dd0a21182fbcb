# SPDX-License-Identifier: Apache-2.0
"""Makes the Python packages of a group importable; they are installed when they are missing."""

from __future__ import annotations

import sys

from keel.base.errors import CANNOT
from keel.install import Toolchain, ToolchainError


def provide(group: str = "common") -> None:
    """Put the packages first on the path. What keeps them away ends the program, in one line."""
    tools = Toolchain()
    try:
        # On stderr: a program's own output may be read by another program.
        tools.ensure(group, say=lambda line: print(line, file=sys.stderr))
        folder = tools.command(f"{group}-packages")[0]
    except ToolchainError as error:
        print(f"packages: {error}", file=sys.stderr)
        sys.exit(CANNOT)
    if folder not in sys.path:
        sys.path.insert(0, folder)
