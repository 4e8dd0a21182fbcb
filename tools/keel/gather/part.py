# SPDX-License-Identifier: Apache-2.0
"""What a part of the evidence package is made of, and what it is made from.

A module of gather.parts has a function `make(context)` that gives a Part. It fails rather than
flatters: what is missing, stale, failed or without a reason is a problem of the part, in one line
that names it, and a package with a problem is not made.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, get_args

from pydantic import BaseModel, ConfigDict

from keel.base.source import STAMP

Kind = Literal[
    "requirement",
    "function",
    "unit",
    "goal",
    "harness",
    "test",
    "mutant",
    "assumption",
    "objective",
    "tool",
    "image",
    "file",
    "deviation",
    "constraint",
    "part",
]
KINDS: tuple[str, ...] = get_args(Kind)
# In the order of the package: from what was wanted to what was found, and what it rests on.
PARTS = (
    "objectives",
    "plans",
    "requirements",
    "trace",
    "contracts",
    "formal",
    "strength",
    "tests",
    "static",
    "object",
    "tools",
    "configuration",
    "safety",
)
State = Literal["good", "bad", "open", "told"]  # told: a fact that is neither, a limit for example


class Frozen(BaseModel):
    """A value."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Item(Frozen):
    """Something that a reviewer looks for: it gets a page, links both ways, and is searchable."""

    kind: Kind
    id: str  # unique within its kind: QUE-003, keel_queue_add, queue/keel_queue_add_harness
    title: str
    text: str = ""  # paragraphs; the lines of a contract or of a harness's bounds as they stand
    state: State = "told"
    facts: dict[str, str] = {}  # name and value: prover, seconds, bound, file and line
    links: tuple[str, ...] = ()  # "kind:id" of what this rests on or belongs to


class Table(Frozen):
    """A table; a cell "kind:id" that names an item becomes a link to it."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""  # what the table does not show


class Part(Frozen):
    """One kind of evidence."""

    name: str  # the folder of the package
    title: str
    summary: dict[str, str] = {}  # the figures that a reader wants first
    text: str = ""  # what this part shows, and what it does not; paragraphs
    tables: tuple[Table, ...] = ()
    items: tuple[Item, ...] = ()
    files: dict[str, Path] = {}  # name in the folder, and where the file is now
    measured: dict[str, float] = {}  # seconds, which stand nowhere else (evidence.measured)
    problems: tuple[str, ...] = ()


@dataclass(frozen=True)
class Context:
    """What a part may look at, and where it may write."""

    root: Path
    build: Path  # the reports of the other commands
    work: Path  # a folder of the part's own
    stamp: dict[str, str]  # of the tree as it is now (common.source)
    say: Callable[[str], None] = field(default=print)  # progress

    def report(self, name: str, problems: list[str]) -> dict[str, Any]:
        """A report below build/; empty, with the reason among the problems, if it cannot serve.

        It must be there, be whole, and speak of the tree as it is now.
        """
        path = self.build / name
        shown = f"build/{name}"
        try:
            read = json.loads(path.read_text(encoding="utf-8"))
        except OSError:
            problems.append(f"{shown}: is missing")
            return {}
        except ValueError as error:
            problems.append(f"{shown}: is not whole: {error}")
            return {}
        if not isinstance(read, dict) or read.get(STAMP) != self.stamp:
            problems.append(f"{shown}: {self.another_source(read)}")
            return {}
        return read

    def another_source(self, read: Any) -> str:
        """How the source that a report speaks of differs from the one that is here."""
        told = read.get(STAMP) if isinstance(read, dict) else None
        commit = told.get("commit") if isinstance(told, dict) else None
        if commit is None:
            how = "it names none"
        elif commit == self.stamp["commit"]:
            how = "the same commit, other files"
        else:
            how = f"commit {commit[:12] or 'none'}, here {self.stamp['commit'][:12] or 'none'}"
        return f"speaks of another source than the one that is here ({how})"
