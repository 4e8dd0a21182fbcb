# SPDX-License-Identifier: Apache-2.0
"""bench/budget.toml: which figures there are, how they are counted, and what they may be."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated

from keel.base.errors import ROOT, ToolError
from keel.base.files import read_text, write_text
from keel.bench.kinds import Kind
from keel.config import Field, Mistake, Table, Text, place_of, read_toml

BUDGET = ROOT / "bench/budget.toml"
PASSES = ("no_task", "one_task")  # The figures that a host build has of its passes, too.

Positive = Annotated[float, Field(gt=0, lt=1e9)]


class Figure(Table):
    """A figure, as the head of the file says."""

    about: Text
    of: Annotated[list[Text], Field(min_length=1)] | None = None
    step: Annotated[str, Field(pattern=r"^keel_\w+$")] | None = None
    goal: Annotated[int, Field(gt=0)] | None = None
    budget: Positive


class Budget(Table):
    """The whole file."""

    tolerance_percent: Positive
    figures: dict[str, Figure]

    @property
    def steps(self) -> dict[str, Figure]:
        """The figures that are counted in a host build, too."""
        return {name: figure for name, figure in self.figures.items() if figure.step}

    def kinds(self, name: str) -> list[str]:
        """The kinds of passes that a figure is the mean of."""
        return self.figures[name].of or [name]

    def goal(self, name: str) -> int:
        """The goal of a figure that has one."""
        return self.figures[name].goal or 0

    def limit(self, name: str) -> float:
        """What a figure may be at most."""
        return self.figures[name].budget * (1.0 + self.tolerance_percent / 100.0)

    def exceeded(self, counted: Mapping[str, Kind]) -> list[str]:
        """The figures that are above their budget by more than the tolerance."""
        return [
            f"{self.figures[name].about} {kind.mean:.1f} > {self.limit(name):.1f}"
            for name, kind in counted.items()
            if kind.mean > self.limit(name)
        ]


def mistakes(budget: Budget) -> Iterator[Mistake]:
    """Passes and steps have goals, and a step is counted under its own name alone."""
    for name in PASSES:
        if name not in budget.figures:
            yield ("figures", name), "is missing"
    for name, figure in budget.figures.items():
        if (figure.step or name in PASSES) and figure.goal is None:
            yield ("figures", name, "goal"), "is missing"
        if figure.step and figure.of:
            yield ("figures", name, "of"), "a step is counted under the figure's own name"


def read_budget(path: Path = BUDGET) -> Budget:
    """Read and check the file."""
    return read_toml(path, Budget, mistakes)


def accept(counted: Mapping[str, Kind], path: Path = BUDGET) -> None:
    """Make what was measured the budget, and leave the rest of the file."""
    text = read_text(path)
    for name, kind in counted.items():
        line = rf"(?m)^({name} = \{{ .*\bbudget = )[0-9.]+( \}})$"
        text, count = re.subn(line, rf"\g<1>{kind.mean:.1f}\g<2>", text)
        if count != 1:
            raise ToolError(
                f"{place_of(path)}: {count} lines `{name} = {{ ..., budget = ... }}`, not one"
            )
    write_text(path, text)
