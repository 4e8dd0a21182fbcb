# SPDX-License-Identifier: Apache-2.0
"""The Python packages of a group: versions from pyproject.toml, SHA-256 from packages.lock."""

from __future__ import annotations

import re
import tomllib
from functools import cache
from pathlib import Path

TOOLS_DIR = Path(__file__).resolve().parents[2]
PROJECT = TOOLS_DIR.parent / "pyproject.toml"
HASHES = TOOLS_DIR / "packages.lock"
ENTRY = re.compile(r"^([a-z0-9.-]+==\S+)((?: \\\n    --hash=sha256:[0-9a-f]{64})+)$", re.MULTILINE)


class GroupError(Exception):
    """A group is not there, or not wholly pinned; the message says which and why."""


@cache
def hashes(file: Path = HASHES) -> dict[str, str]:
    """The options by which pip holds each name and version to its files."""
    return dict(ENTRY.findall(file.read_text(encoding="utf-8")))


@cache
def groups(file: Path = PROJECT) -> dict[str, list[str]]:
    """The names and versions of each group."""
    found: dict[str, list[str]] = tomllib.loads(file.read_text("utf-8"))["dependency-groups"]
    return found


def requirements_of(group: str, project: Path = PROJECT, lock: Path = HASHES) -> str:
    """A group as a file for pip."""
    if group not in groups(project):
        raise GroupError(f"{project.name}: there is no group {group}")
    known = hashes(lock)
    for name in groups(project)[group]:
        if name not in known:
            raise GroupError(f"{lock.name}: {name} of group {group} has no SHA-256")
    return "".join(f"{name}{known[name]}\n" for name in groups(project)[group])
