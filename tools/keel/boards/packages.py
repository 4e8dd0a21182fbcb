# SPDX-License-Identifier: Apache-2.0
"""Modules of the Python packages that the toolchain has."""

from __future__ import annotations

import importlib
import sys
from typing import Any

from keel.install import Toolchain


def load(tools: Toolchain, package: str, module: str) -> Any:
    """A module of a package."""
    folder = tools.command(package)[0]
    if folder not in sys.path:
        sys.path.insert(0, folder)
    return importlib.import_module(module)
