# SPDX-License-Identifier: Apache-2.0
"""The Makefile's rules, and which of them a command runs."""

from __future__ import annotations

import re
import subprocess
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

COLLECTIVE = ("check", "generate")
RULE = re.compile(r"^([a-z][a-z/-]*):(?!=)", re.MULTILINE)
TARGET = re.compile(r"make ([a-z][a-z-]*)")
NAME = re.compile(r" NAME=\"?([a-z-]+)")


@cache
def rules(file: str = "Makefile") -> frozenset[str]:
    """The rules of Keel's Makefile, or of another file."""
    return frozenset(RULE.findall((ROOT / file).read_text(encoding="utf-8")))


def rule_of(command: str) -> str:
    """The rule of a command as one types it: that of its first NAME where it has one."""
    found = TARGET.search(command)
    target = found[1] if found else ""
    name = NAME.search(command) if target in COLLECTIVE else None
    return f"{target}/{name[1]}" if name else target


def make_in(folder: Path, *words: str) -> tuple[int, str]:
    """Run make in a project of a user, with Keel's rules: exit status, and what is said."""
    ended = subprocess.run(
        ["make", "-f", str(ROOT / "keel.mk"), *words],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=False,
        text=True,
        timeout=900,
    )
    return ended.returncode, ended.stdout
