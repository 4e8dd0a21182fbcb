# SPDX-License-Identifier: Apache-2.0
"""The runs of a log: topics `run` and `task` of bsp/common/trace_log.h."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from keel.base.errors import ROOT, ToolError
from keel.base.files import read_text
from keel.timeline import ulog

PRIORITIES = "include/keel/rtos/priority.h"
FIRST, PROMOTED = 1, 2  # Of a run's flags, as trace.h has them.
RUN = np.dtype(
    [
        ("task", "u2"),
        ("release", "i8"),
        ("start", "i8"),
        ("end", "i8"),
        ("deadline", "i8"),
        ("skipped", "u2"),
        ("promoted", "?"),
        ("slack", "i8"),
    ]
)


@dataclass(frozen=True)
class Task:
    """What a task declares. Times are in us."""

    name: str
    period_us: int
    budget_us: int
    priority: int

    @property
    def is_realtime(self) -> bool:
        """Whether it is served first come, first served."""
        return self.priority == classes()["realtime"]

    @property
    def sort(self) -> str:
        """The class of its priority, in words."""
        names = {number: name for name, number in classes().items()}
        return names.get(self.priority, f"priority {self.priority}").replace("_", " ")


@dataclass(frozen=True)
class Schedule:
    """What ran. Each run has its task's number, and times in us since the scheduler's start:
    release, start, end and deadline, and the slack when it was chosen."""

    tasks: list[Task]
    guard_us: int
    runs: Any
    dropouts: list[tuple[int, int]]  # After which time, and for how many ms, runs are missing.

    def of(self, task: int) -> Any:
        """The runs of a task."""
        return self.runs[self.runs["task"] == task]


def classes() -> dict[str, int]:
    """The priorities that have names."""
    found = re.findall(r"#define KEEL_PRIORITY_(\w+)\s+(\d+)u", read_text(ROOT / PRIORITIES))
    return {name.lower(): int(number) for name, number in found}


def task_of(row: Any) -> Task:
    """A message of topic `task`."""
    name = bytes(row["name"]).rstrip(b"\0").decode(errors="replace")
    if not row["period_us"]:
        raise ToolError(f"task {name!r} has no period")
    return Task(
        name or f"slot {row['slot']}",
        int(row["period_us"]),
        int(row["budget_us"]),
        int(row["priority"]),
    )


def numbered(runs: Any, rows: Any) -> tuple[Any, list[Task]]:
    """Each run's task by its number, and the tasks. A slot's first run, and one that says so, is of
    the next task that was told of the slot."""
    told: dict[int, Iterator[int]] = defaultdict(lambda: iter(()))
    for slot in np.unique(rows["slot"]):
        told[int(slot)] = iter(np.flatnonzero(rows["slot"] == slot).tolist())
    now: dict[int, int] = {}
    numbers = np.zeros(len(runs), "u2")
    for place, (slot, flags) in enumerate(
        zip(runs["slot"].tolist(), runs["flags"].tolist(), strict=True)
    ):
        if slot not in now or flags & FIRST:
            number = next(told[slot], None)
            if number is None:
                raise ToolError(
                    f"the run at {runs['timestamp'][place]} us is of no task that was "
                    f"told (slot {slot})"
                )
            now[slot] = number
        numbers[place] = now[slot]
    return numbers, [task_of(row) for row in rows]


def slack(runs: Any, tasks: list[Task], times: Any) -> Any:
    """How long it is from each time, behind a choice at that time, until the next release of a
    real-time task; -1 where none is known."""
    nearest = np.full(len(times), np.iinfo("i8").max)
    for number, task in enumerate(tasks):
        own = runs[runs["task"] == number]
        if task.is_realtime and len(own):
            releases = np.append(own["release"], own["deadline"][-1])
            after = releases[np.searchsorted(own["start"], times, side="right")]
            nearest = np.minimum(nearest, after)
    return np.where(nearest == np.iinfo("i8").max, -1, np.maximum(nearest - times, 0))


def schedule_of(log: ulog.Log) -> Schedule:
    """The schedule of a log. A damaged one lacks runs, and its statistics would be wrong."""
    if log.damage:
        first = log.damage[0]
        raise ToolError(f"byte {first.at}: {first.reason}")
    if ("run", 0) not in log.data or not len(log.topic("run")):
        raise ToolError("the log has no runs of tasks; flights log them with ARGS=--trace")
    told, rows = log.topic("run"), log.topic("task")
    runs = np.zeros(len(told), RUN)
    runs["task"], tasks = numbered(told, rows)
    runs["start"] = told["timestamp"]
    runs["release"] = runs["start"] - told["late_us"]
    runs["end"] = runs["start"] + told["length_us"]
    periods = np.array([task.period_us for task in tasks], "i8")[runs["task"]]
    runs["deadline"] = runs["release"] + (told["skipped"].astype("i8") + 1) * periods
    runs["skipped"] = told["skipped"]
    runs["promoted"] = (told["flags"] & PROMOTED) > 0
    runs["slack"] = slack(runs, tasks, runs["start"])
    return Schedule(tasks, int(rows["guard_us"][-1]), runs, log.dropouts)


def read(path: Path) -> Schedule:
    """Read a log."""
    try:
        return schedule_of(ulog.read(path))
    except ToolError as error:
        text = str(error)
        raise ToolError(text if text.startswith(str(path)) else f"{path}: {text}") from error
