# SPDX-License-Identifier: Apache-2.0
"""What was counted of passes and steps, by their kinds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from keel.base.errors import ToolError

KINDS = ("waited", "idle", "realtime", "other", "several")
NO_TASK = ("waited", "idle")
ONE_TASK = ("realtime", "other")


@dataclass
class Kind:
    """All passes of one kind. The longest is of those that were counted one by one; of functions
    only callgrind tells."""

    passes: int = 0
    instructions: int = 0
    longest: int = 0
    functions: Counter[str] = field(default_factory=Counter)

    @property
    def mean(self) -> float:
        return self.instructions / self.passes if self.passes else 0.0

    def add(self, other: Kind) -> None:
        self.passes += other.passes
        self.instructions += other.instructions
        self.longest = max(self.longest, other.longest)
        self.functions += other.functions


Kinds = dict[str, Kind]


def merged(kinds: Mapping[str, Kind], names: Sequence[str]) -> Kind:
    """Several kinds taken together."""
    total = Kind()
    for name in names:
        total.add(kinds[name])
    return total


def all_of(kinds: Mapping[str, Kind], names: Sequence[str]) -> Kind:
    """Several kinds taken together, each of which was measured."""
    for name in names:
        if name not in kinds or not kinds[name].passes:
            raise ToolError(f"no pass was measured of the kind {name}")
    return merged(kinds, names)


def twice(run: Callable[[], Kinds], about: str) -> Kinds:
    """What two runs counted, which must be the same to the instruction."""
    first, second = run(), run()
    if first != second:
        raise ToolError(f"two runs {about} differ")
    return first
