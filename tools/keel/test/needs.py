# SPDX-License-Identifier: Apache-2.0
"""What suites of `make test` and `make test-all` need, from tests/suites.toml."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

from keel.base.errors import ROOT
from keel.config import Field, Mistake, Table, Text, read_toml
from keel.install.lock import Lock

NEEDS = ROOT / "tests/suites.toml"


class Need(Table):
    """What one suite needs beside what all of its folder need."""

    name: Text
    groups: list[Text] = []
    seconds: Annotated[float, Field(ge=0.0)] = 0.0
    more: bool = False
    waits: bool = False


class Absent(Table):
    """Groups of tools that programs under test ask for, and that `make test` does not install."""

    groups: Annotated[list[Text], Field(min_length=1)]
    reason: Text


class Needs(Table):
    """The whole file."""

    suite: list[Need]
    absent: list[Absent] = []

    def of(self, name: str) -> Need:
        """What a suite needs; nothing when it is not named."""
        return next((need for need in self.suite if need.name == name), Need(name=name))


def mistakes(needs: Needs) -> Iterator[Mistake]:
    """Groups that the lock file does not have, and names that occur twice."""
    known = Lock.read().groups
    named = {
        "suite": [need.groups for need in needs.suite],
        "absent": [entry.groups for entry in needs.absent],
    }
    for kind, lists in named.items():
        for number, groups in enumerate(lists):
            if wrong := [group for group in groups if group not in known]:
                yield (kind, number, "groups"), f"there is no group {', '.join(wrong)}"
    names = [need.name for need in needs.suite]
    for number, name in enumerate(names):
        if name in names[:number]:
            yield ("suite", number, "name"), f"{name} is named twice"


def read_needs(path: Path = NEEDS) -> Needs:
    """Read and check the file."""
    return read_toml(path, Needs, mistakes)
