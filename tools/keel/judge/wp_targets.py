# SPDX-License-Identifier: Apache-2.0
"""What WP proves in one process each: the functions and the lemmas of a unit."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from keel.base.files import write_text
from keel.c import source as csource
from keel.c.project import Unit, closure, shown
from keel.judge import wp_frames


@dataclass(frozen=True)
class Target:
    """What one process proves: a function, or the lemmas of a unit, in one file."""

    unit: Unit
    file: Path
    function: str | None
    lemmas: tuple[str, ...] = ()
    # Labels that CBMC proves, postconditions and the results of floats besides; None: none.
    left: tuple[str, ...] | None = None

    @property
    def name(self) -> str:
        """For people."""
        return self.function or "lemmas"

    @property
    def identity(self) -> str:
        """For files."""
        return f"{self.unit.name}-{self.file.stem}-{self.name}"

    @property
    def selection(self) -> list[str]:
        """The options that select these goals and no others."""
        if self.function:
            return ["-wp-fct", self.function, *wp_frames.selection(self.left)]
        return ["-wp-prop", ",".join(self.lemmas)]


@dataclass
class Result:
    """What became of a target."""

    goals: list[dict[str, str]] = field(default_factory=list)
    smoke: int = 0
    allowed: list[str] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    # Whether nothing is wrong but that provers came to the limit of their time.
    gave_up: bool = False
    # Goals whose recorded prover did not prove them: that costs time, and nothing else.
    stale: list[str] = field(default_factory=list)
    # Goals for which it is recorded that WP had to search for branches that cannot be taken.
    pruned: list[str] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def proved(self) -> int:
        """How many goals are proved."""
        return sum(goal["status"] == "Valid" for goal in self.goals)

    def as_dict(self) -> dict[str, Any]:
        """For the cache."""
        return asdict(self)


def translation_unit(unit: Unit) -> Path:
    """The file that is proved: the source, or a file that includes a unit of inline functions."""
    if unit.source.is_file():
        return unit.source
    path = unit.root / "build" / "prove" / "inline" / f"{unit.name}.c"
    write_text(path, f'#include "{unit.header.relative_to(unit.root / "include")}"\n')
    return path


def targets(unit: Unit) -> Iterator[Target]:
    """All that is to be proved about a unit."""
    main = translation_unit(unit)
    yield from _targets_of(unit, main, unit.own_files)
    for theorem in unit.theorems:
        yield from _targets_of(unit, theorem, [theorem])


def _targets_of(unit: Unit, main: Path, files: Sequence[Path]) -> Iterator[Target]:
    texts = [csource.read(path) for path in files]
    for text in texts:
        for function in csource.proved(text):
            yield Target(unit, main, function.name)
    lemmas = tuple(name for text in texts for name in csource.lemmas(text))
    if lemmas:
        yield Target(unit, main, None, lemmas)


def dependencies(target: Target, root: Path) -> dict[str, str]:
    """The text that a target's verdict depends on, file by file."""
    keep = frozenset([target.function] if target.function else [])
    return {
        shown(path, root): csource.without_other_bodies(csource.read(path), keep)
        for path in closure(root, [target.file, *target.unit.own_files])
    }
