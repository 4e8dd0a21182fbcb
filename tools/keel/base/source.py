# SPDX-License-Identifier: Apache-2.0
"""Says which source a report was made from, so that nobody takes an old report for a new one."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from keel.base.errors import ROOT, ToolError
from keel.base.files import sha256_of, write_json
from keel.base.git import commit_of

PRODUCT = ("include", "src")  # What is proved, and what goes into a firmware.
MADE = ("build", "__pycache__", ".git", ".mypy_cache", ".ruff_cache")  # Nobody's source.
STAMP = "made_from"
VERDICT = "verdict"
GOOD, FAILED, PARTIAL = "good", "failed", "partial"  # Partial: good, but not all was looked at.


def files_below(root: Path) -> Iterator[Path]:
    """All files that are somebody's source, in order."""
    for path in sorted(root.iterdir()):
        if path.name in MADE:
            continue
        if path.is_dir() and not path.is_symlink():
            yield from files_below(path)
        else:
            yield path


def digest_of_tree(root: Path, folders: Sequence[str] = ()) -> str:
    """SHA-256 over the names and contents of all files, or of those in some folders."""
    asked = [root / folder for folder in folders] or [root]
    places = [place for place in asked if place.is_dir()]
    whole = hashlib.sha256()
    for place in places:
        for path in files_below(place):
            content = sha256_of(path) if path.is_file() else "none"
            whole.update(f"{path.relative_to(root).as_posix()} {content}\n".encode())
    return whole.hexdigest()


def stamp_of(root: Path = ROOT) -> dict[str, str]:
    """What the tree is now: its commit, the digest of all of it, and that of the product."""
    if not root.is_dir():
        raise ToolError(f"{root}: there is no such folder")
    return {
        "commit": commit_of(root),
        "tree": digest_of_tree(root),
        "product": digest_of_tree(root, PRODUCT),
    }


def verdict_of(good: bool, whole: bool = True) -> str:
    """The one word by which a report says how its run ended."""
    if not good:
        return FAILED
    return GOOD if whole else PARTIAL


def write_report(
    path: Path, report: Mapping[str, object], root: Path = ROOT, *, good: bool, whole: bool = True
) -> None:
    """Write a report with its verdict, and with the stamp of the source that it speaks of."""
    said = {VERDICT: verdict_of(good, whole), STAMP: stamp_of(root)}
    write_json(path, {**report, **said})
