# SPDX-License-Identifier: Apache-2.0
"""Where StrictDoc and LOBSTER are: they are programs of their own, and not imported here."""

from __future__ import annotations

import sys

from keel.base.errors import ToolError
from keel.install import Toolchain, ToolchainError


def packages() -> str:
    """The folder that holds both; they are installed when they are missing."""
    tools = Toolchain()
    try:
        tools.ensure("trace", say=lambda line: print(line, file=sys.stderr))
        return tools.command("trace-packages")[0]
    except ToolchainError as error:
        raise ToolError(str(error)) from error
