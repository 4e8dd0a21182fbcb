#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Run Python with the packages of a group of tools, which are installed when they are missing.

    python3 tools/with_packages.py timing -m timing analyze specs/tasksets/urpilot.toml

Exit status: the program's, or 2 when the packages could not be had.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path

TOOLS_DIR = Path(__file__).resolve().parent
sys.path.insert(0, str(TOOLS_DIR))

from keel.install import Toolchain, ToolchainError


def main(arguments: Sequence[str]) -> int:
    """Entry point; does not return when all goes well."""
    if len(arguments) < 2:
        print("usage: with_packages.py GROUP PROGRAM [ARGUMENT ...]", file=sys.stderr)
        return 2
    group, *program = arguments
    try:
        tools = Toolchain()
        tools.ensure(group)
        groups = [name for name in tools.lock.groups[group] if name.endswith("-packages")]
        packages = [tools.command(name)[0] for name in groups]
    except ToolchainError as error:
        print(f"with_packages: {error}", file=sys.stderr)
        return 2
    variables = {**os.environ, "PYTHONPATH": os.pathsep.join([*packages, str(TOOLS_DIR)])}
    os.execve(sys.executable, [sys.executable, *program], variables)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
