# SPDX-License-Identifier: Apache-2.0
"""Task sets: what a file may say, and reading one with errors that name file, line and key."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal, Self

from keel.base.files import read_text
from keel.config import ConfigError, Field, Mistake, Table, model_validator, parse_toml

# The kernel's own limits: priority.h (KEEL_PERIOD_LIMIT_US, KEEL_PRIORITY_*), queue.h
# (KEEL_QUEUE_CAPACITY, as it ships, and the greatest). tests/timing/test_tools.py compares them
# with the headers.
PERIOD_LIMIT_US = 2**31
QUEUE_CAPACITY = 32
CAPACITY_LIMIT = 255
PRIORITY_MAX = 16
CLASSES = {"low": 1, "medium": 2, "medium-high": 3, "high": 4, "real-time": PRIORITY_MAX}
REALTIME = "real-time"
SIZE_LIMIT = 1 << 20

# Names that the C table (ctable.py) takes: of its own macros, of the macros of stdint.h, which it
# includes, and of the kernel.
TABLE_NAMES = frozenset({"TASK_COUNT", "GUARD_US", "UTILISATION_LIMIT_PPM", "TASKS_H"})
STDINT_NAME = re.compile(
    r"(U?INT(_?(FAST|LEAST))?\d+|U?INT(PTR|MAX)|PTRDIFF|SIZE|SIG_ATOMIC|WCHAR|WINT)_(MIN|MAX|C)"
)
KERNEL = "keel"

Time = Annotated[int, Field(ge=1, lt=PERIOD_LIMIT_US)]
Cost = Annotated[int, Field(ge=0, lt=1_000_000)]
Percent = Annotated[float, Field(ge=0.0, le=100.0, allow_inf_nan=False)]
Fraction = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]
# Names go into C strings and comments, and into tables of fixed width.
Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9 ,_/-]{0,31}$")]
Label = Annotated[str, Field(pattern=r"^[A-Za-zΑ-ω][A-Za-z0-9_]{0,7}$")]


class Costs(Table):
    """The scheduler: how many tasks its queue holds (KEEL_QUEUE_CAPACITY of the build), its guard,
    what a pass and a dispatch cost, and the admission's limit."""

    capacity: Annotated[int, Field(ge=1, le=CAPACITY_LIMIT)] = QUEUE_CAPACITY

    guard_us: Cost = 20
    pass_us: Cost = 5
    dispatch_us: Cost = 1
    utilisation_limit_percent: Percent = 100.0
    without_promotion: bool = False  # Nothing is promoted, however long it waits.

    @property
    def utilisation_limit_ppm(self) -> int:
        """The limit as the kernel takes it, in parts per million."""
        return round(self.utilisation_limit_percent * 10_000)


DEFAULT_COSTS = Costs()


class Published(Table):
    """What a publication printed about the set."""

    realtime_utilisation: Fraction
    other_utilisation: Fraction
    total_utilisation: Fraction
    load_percent: Percent | None = None


class RawTask(Table):
    """A task as written: its class by name, or its static priority and whether it is real-time."""

    name: Name
    label: Label | None = None
    class_: Literal["low", "medium", "medium-high", "high", "real-time"] | None = Field(
        default=None, alias="class"
    )
    priority: Annotated[int, Field(ge=1, le=4)] | None = None
    realtime: bool | None = None
    period_us: Time
    budget_us: Time
    phase_us: Annotated[int, Field(ge=0, lt=PERIOD_LIMIT_US)] = 0
    sigma_percent: Percent | None = None

    @model_validator(mode="after")
    def has_one_class(self) -> Self:
        ways = [self.class_ is not None, self.priority is not None, self.realtime is True]
        if sum(ways) != 1 or (self.class_ is not None and self.realtime is not None):
            raise ValueError("expected one of class, priority (1 to 4) and realtime = true")
        return self

    def task(self, number: int) -> Task:
        """The task, which is the one of that number."""
        names = {value: name for name, value in CLASSES.items()}
        class_name = self.class_ or names[self.priority or PRIORITY_MAX]
        return Task(
            self.name,
            self.label or f"#{number}",
            class_name,
            self.period_us,
            self.budget_us,
            self.phase_us,
            self.sigma_percent,
        )


class Chain(Table):
    """A path from a sensor to an actuator; limits that are advice are told, not judged."""

    name: Name
    path: Annotated[list[Name], Field(min_length=2, max_length=CAPACITY_LIMIT)]
    reaction_limit_us: Time
    freshness_limit_us: Time
    advisory: bool = False


class RawTaskSet(Table):
    """A file."""

    name: Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]{0,31}$")]
    scheduler: Costs = DEFAULT_COSTS
    published: Published | None = None
    task: Annotated[list[RawTask], Field(min_length=1, max_length=CAPACITY_LIMIT)]
    chain: Annotated[list[Chain], Field(max_length=64)] = []


@dataclass(frozen=True)
class Task:
    """A task; times in us."""

    name: str
    label: str
    class_name: str
    period: int
    budget: int
    phase: int = 0
    sigma: float | None = None

    @property
    def realtime(self) -> bool:
        """Whether FCFS serves it."""
        return self.class_name == REALTIME

    @property
    def priority(self) -> int:
        """The static priority sp."""
        return CLASSES[self.class_name]

    @property
    def utilisation(self) -> float:
        """C / T."""
        return self.budget / self.period


@dataclass(frozen=True)
class TaskSet:
    """A checked task set, in the order of the queue."""

    name: str
    tasks: tuple[Task, ...]
    chains: tuple[Chain, ...] = ()
    costs: Costs = DEFAULT_COSTS
    published: Published | None = None

    @property
    def realtime(self) -> list[Task]:
        """The tasks that FCFS serves, in queue order."""
        return [task for task in self.tasks if task.realtime]

    @property
    def others(self) -> list[Task]:
        """The tasks that EDF serves, in queue order."""
        return [task for task in self.tasks if not task.realtime]

    def named(self, name: str) -> Task:
        """The task of that name."""
        return next(task for task in self.tasks if task.name == name)

    def path(self, chain: Chain) -> list[Task]:
        """The tasks of a chain."""
        return [self.named(name) for name in chain.path]


def symbol_of(name: str) -> str:
    """The name as part of a C identifier."""
    return re.sub(r"[^A-Z0-9]+", "_", name.upper()).strip("_")


def wrong_count(raw: RawTaskSet) -> Iterator[Mistake]:
    """More tasks than the queue holds."""
    capacity = raw.scheduler.capacity
    if len(raw.task) > capacity:
        yield (
            ("task", capacity, "name"),
            (
                f"expected at most {capacity} tasks, which the queue holds; `capacity` of "
                "[scheduler] is for builds with another KEEL_QUEUE_CAPACITY"
            ),
        )


def wrong_times(raw: RawTaskSet) -> Iterator[Mistake]:
    """Budgets and phases beyond their periods."""
    for number, task in enumerate(raw.task):
        if task.budget_us > task.period_us:
            yield ("task", number, "budget_us"), f"expected at most the period, {task.period_us}"
        if task.phase_us >= task.period_us:
            yield ("task", number, "phase_us"), f"expected less than the period, {task.period_us}"


def wrong_names(raw: RawTaskSet) -> Iterator[Mistake]:
    """Names that come twice, also as part of a C identifier, and those that the C table takes."""
    if raw.name.split("_")[0] == KERNEL:
        expected = f'expected a name that does not begin with "{KERNEL}", as the kernel\'s do in C'
        yield ("name",), expected
    seen: dict[tuple[str, str], str] = {}
    for number, task in enumerate(raw.task):
        symbol = symbol_of(task.name)
        whole = f"{raw.name.upper()}_{symbol}"
        if symbol in TABLE_NAMES or STDINT_NAME.fullmatch(whole):
            owner = "the C table's" if symbol in TABLE_NAMES else "stdint.h's"
            expected = f"expected a name other than {owner} own: it becomes {whole}"
            yield ("task", number, "name"), expected
        for kind, text in (("name", symbol), ("label", task.label or "")):
            if text and (kind, text) in seen:
                taken = seen[kind, text]
                expected = f'expected another than that of "{taken}" (as a C identifier)'
                yield ("task", number, kind), expected
            seen.setdefault((kind, text), task.name)


def wrong_chains(raw: RawTaskSet) -> Iterator[Mistake]:
    """Chains of tasks that do not exist, or come twice."""
    known = {task.name for task in raw.task}
    for number, chain in enumerate(raw.chain):
        for name in chain.path:
            if name not in known:
                expected = f'expected names of tasks; there is no "{name}"'
                yield ("chain", number, "path"), expected
        if len(set(chain.path)) != len(chain.path):
            yield ("chain", number, "path"), "expected each task at most once"


def mistakes(raw: RawTaskSet) -> Iterator[Mistake]:
    """What types cannot say."""
    yield from wrong_count(raw)
    yield from wrong_times(raw)
    yield from wrong_names(raw)
    yield from wrong_chains(raw)


def parse(text: str, file: str = "task set") -> TaskSet:
    """The task set in a text. Raises ConfigError with every mistake found."""
    raw = parse_toml(text, RawTaskSet, file, mistakes)
    tasks = tuple(task.task(number) for number, task in enumerate(raw.task, 1))
    return TaskSet(raw.name, tasks, tuple(raw.chain), raw.scheduler, raw.published)


def read(path: Path) -> TaskSet:
    """The task set in a file. Raises ToolError."""
    if path.is_file() and path.stat().st_size > SIZE_LIMIT:
        raise ConfigError(f"{path}:1: expected at most {SIZE_LIMIT} bytes")
    return parse(read_text(path), str(path))
