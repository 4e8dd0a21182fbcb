# SPDX-License-Identifier: Apache-2.0
"""The tasks of a board's image: what each declares, and how long it took on the model at most.

All of it is read from the image's memory, where its scheduler has it, so that no list of tasks
beside the image's own can be out of date.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any

from keel.boards.dwarf import Place
from keel.timing.taskset import CLASSES

NAME_LIMIT = 64  # No task's name is longer.
DECLARED = ("period_us", "budget_us", "phase_us", "priority")
CLASS_NAMES = {priority: name for name, priority in CLASSES.items()}


@dataclass(frozen=True)
class BoardTask:
    """A task as the image declares it, and what became of it."""

    name: str
    class_name: str
    period_us: int
    budget_us: int
    phase_us: int
    runs: int
    longest_us: int

    @property
    def fits(self) -> bool:
        """Whether no run was longer than declared."""
        return self.longest_us <= self.budget_us

    def as_json(self) -> dict[str, Any]:
        """For reports."""
        return asdict(self)


class BoardTasks:
    """Where an image has its tasks."""

    def __init__(self, scheduler: Place, declaration: Place) -> None:
        queue = scheduler.part("queue")
        first, stats = declaration.element(0), queue.part("stats[0]")
        self._task = queue.part("task")
        self._slots = self._task.count
        self._stats_bytes = stats.size
        self._counts = [stats.part(name) for name in ("runs", "longest_us")]
        self._name = first.part("name").address - first.address
        self._declared = [
            (first.part(name).address - first.address, first.part(name).size) for name in DECLARED
        ]

    def read(self, number: Callable[[int, int], int]) -> Iterator[BoardTask]:
        """The tasks in the queue, by a function that tells a number of the image's memory."""
        for slot in range(self._slots):
            at = number(self._task.address + 4 * slot, 4)
            if at:
                period, budget, phase, priority = (
                    number(at + offset, size) for offset, size in self._declared
                )
                runs, longest = (
                    number(place.address + slot * self._stats_bytes, place.size)
                    for place in self._counts
                )
                name = text_at(number, number(at + self._name, 4))
                yield BoardTask(
                    name, CLASS_NAMES.get(priority, ""), period, budget, phase, runs, longest
                )


def text_at(number: Callable[[int, int], int], address: int) -> str:
    """A text of the image's memory."""
    found = bytearray()
    while len(found) < NAME_LIMIT and (byte := number(address + len(found), 1)):
        found.append(byte)
    return found.decode("ascii", "replace")
