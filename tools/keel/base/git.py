# SPDX-License-Identifier: Apache-2.0
"""Asks git. A clone has a commit, and a release archive has no git; that git fails is neither."""

from __future__ import annotations

from pathlib import Path

from keel.base.errors import ToolError
from keel.base.run import NOT_STARTED, Ended, run


def is_clone(root: Path) -> bool:
    """Whether git keeps this folder; a release archive, and a folder within a clone, are none."""
    return (root / ".git").exists()


def git(root: Path, *words: str) -> str:
    """What git answers; when it fails, its own words are the error."""
    asked = run(["git", *words], cwd=root, apart=True)
    if not asked.good:
        raise failed(root, asked)
    return asked.output


def failed(root: Path, asked: Ended) -> ToolError:
    """Why git tells nothing of a folder."""
    if asked.status == NOT_STARTED:
        return ToolError(f"{root}: is a clone, but git does not start: {asked.output.strip()}")
    said = f"{asked.errors}{asked.output}".strip() or asked.how
    return ToolError(f"{root}: git fails: {said}")


def commit_of(root: Path) -> str:
    """The commit that is checked out; empty where there is none: in an archive, before the first.

    A clone that git does not trust must not pass for an archive: its reports would bear no commit.
    """
    if not is_clone(root):
        return ""
    asked = run(["git", "rev-parse", "--verify", "--quiet", "HEAD"], cwd=root, apart=True)
    before_the_first = asked.status == 1 and not f"{asked.errors}{asked.output}"
    if not asked.good and not before_the_first:
        raise failed(root, asked)
    return asked.output.strip()
