"""Task sets: what a file may say, and reading one with errors that name file, line and field."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from json import dumps
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from timing.toml_lines import Path as KeyPath
from timing.toml_lines import line_index, line_of

# The kernel's own limits: priority.h (KEEL_PERIOD_LIMIT_US, KEEL_PRIORITY_*), queue.h
# (KEEL_QUEUE_CAPACITY). tests/timing/test_tools.py compares them with the headers.
PERIOD_LIMIT_US = 2**31
QUEUE_CAPACITY = 32
PRIORITY_MAX = 16
CLASSES = {"low": 1, "medium": 2, "medium-high": 3, "high": 4, "real-time": PRIORITY_MAX}
REALTIME = "real-time"
SIZE_LIMIT = 1 << 20

# Names that the C table (ctable.py) takes: of its own macros, of the macros of stdint.h, which it
# includes, and of the kernel.
TABLE_NAMES = frozenset({"TASK_COUNT", "GUARD_US", "UTILISATION_LIMIT", "TASKS_H"})
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


class Strict(BaseModel):
    """No unknown keys, no conversions: a typing error must not pass for a wish."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class Costs(Strict):
    """The scheduler: its guard, what a pass and a dispatch cost, and the admission's limit."""

    guard_us: Cost = 20
    pass_us: Cost = 5
    dispatch_us: Cost = 1
    utilisation_limit_percent: Percent = 100.0

    @property
    def utilisation_limit(self) -> int:
        """The limit as the kernel takes it, in parts per million."""
        return round(self.utilisation_limit_percent * 10_000)


DEFAULT_COSTS = Costs()


class Published(Strict):
    """What a publication printed about the set."""

    realtime_utilisation: Fraction
    other_utilisation: Fraction
    total_utilisation: Fraction
    load_percent: Percent | None = None


class RawTask(Strict):
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


class Chain(Strict):
    """A path from a sensor to an actuator; limits that are advice are told, not judged."""

    name: Name
    path: Annotated[list[Name], Field(min_length=2, max_length=QUEUE_CAPACITY)]
    reaction_limit_us: Time
    freshness_limit_us: Time
    advisory: bool = False


class RawTaskSet(Strict):
    """A file."""

    name: Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]{0,31}$")]
    scheduler: Costs = DEFAULT_COSTS
    published: Published | None = None
    task: Annotated[list[RawTask], Field(min_length=1, max_length=QUEUE_CAPACITY)]
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


@dataclass(frozen=True)
class Problem:
    """What is wrong with a file, and where."""

    file: str
    line: int
    field: str
    expected: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.field}: {self.expected}"


class TaskSetError(Exception):
    """A file that is no task set: all that is wrong with it."""

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__("\n".join(map(str, problems)))
        self.problems = problems


def symbol_of(name: str) -> str:
    """The name as part of a C identifier."""
    return re.sub(r"[^A-Z0-9]+", "_", name.upper()).strip("_")


class Reader:
    """Turns a text into a task set, or into a list of problems."""

    def __init__(self, text: str, file: str) -> None:
        self.file = file
        self.text = text
        self.problems: list[Problem] = []
        self.lines: dict[KeyPath, int] = {}
        self.data: dict[str, Any] = {}

    def blame(self, path: KeyPath, expected: str) -> None:
        """Add a problem."""
        line = line_of(self.lines, path)
        self.problems.append(Problem(self.file, line, self.field(path), expected))

    def field(self, path: KeyPath) -> str:
        """A path in words: task "GPS": period_us."""
        words = []
        for number, part in enumerate(path):
            if isinstance(part, int):
                words.append(self.item(path[:number], part))
            elif not (number + 1 < len(path) and isinstance(path[number + 1], int)):
                words.append(part if len(part) <= 40 else f"{part[:37]}...")
        return ": ".join(words) or "file"

    def item(self, path: KeyPath, index: int) -> str:
        """An element of an array, by its name if it has one."""
        kind = str(path[-1])
        items = self.data.get(kind) if len(path) == 1 else None
        entry = items[index] if isinstance(items, list) and index < len(items) else None
        name = entry.get("name") if isinstance(entry, dict) else None
        if not isinstance(name, str):
            return f"{kind} number {index + 1}"
        # Quoted as in JSON: a name that is refused may hold line ends.
        return f"{kind} {dumps(name[:40], ensure_ascii=False)}"

    def fail_if_wrong(self) -> None:
        """Stop when something is wrong."""
        if self.problems:
            self.problems.sort(key=lambda problem: problem.line)
            raise TaskSetError(self.problems)

    def load(self) -> None:
        """TOML to data."""
        try:
            self.data = tomllib.loads(self.text)
        except tomllib.TOMLDecodeError as error:
            match = re.search(r"\(at line (\d+), column \d+\)", str(error))
            line = int(match[1]) if match else self.text.count("\n") + 1
            what = re.sub(r" \(at .*\)$", "", str(error))
            self.problems.append(Problem(self.file, line, "file", f"expected TOML: {what}"))
        except (RecursionError, ValueError) as error:
            # What tomllib lets through: deeply nested brackets, numbers of thousands of digits.
            what = (
                "nested too deeply" if isinstance(error, RecursionError) else "not a usable number"
            )
            self.problems.append(Problem(self.file, 1, "file", f"expected TOML: {what}"))
        self.fail_if_wrong()
        self.lines = line_index(self.text)

    def read(self) -> TaskSet:
        """All steps."""
        self.load()
        try:
            raw = RawTaskSet.model_validate(self.data)
        except ValidationError as error:
            for found in error.errors(include_url=False, include_context=False):
                place: KeyPath = tuple(found["loc"])
                self.blame(place, expectation(place, found["msg"], found["input"]))
            self.fail_if_wrong()
            raise
        tasks = tuple(self.task(entry, number) for number, entry in enumerate(raw.task))
        self.check_names(raw)
        self.check_chains(raw)
        self.fail_if_wrong()
        return TaskSet(raw.name, tasks, tuple(raw.chain), raw.scheduler, raw.published)

    def task(self, raw: RawTask, number: int) -> Task:
        """A task, checked beyond its types."""
        place: KeyPath = ("task", number)
        if raw.budget_us > raw.period_us:
            self.blame((*place, "budget_us"), f"expected at most the period, {raw.period_us}")
        if raw.phase_us >= raw.period_us:
            self.blame((*place, "phase_us"), f"expected less than the period, {raw.period_us}")
        label = raw.label or f"#{number + 1}"
        return Task(raw.name, label, self.class_of(raw, place), raw.period_us, raw.budget_us,
                    raw.phase_us, raw.sigma_percent)  # fmt: skip

    def class_of(self, raw: RawTask, place: KeyPath) -> str:
        """The class, however it is written."""
        ways = [raw.class_ is not None, raw.priority is not None, raw.realtime is True]
        if sum(ways) != 1 or (raw.class_ is not None and raw.realtime is not None):
            self.blame(place, "expected one of class, priority (1 to 4) and realtime = true")
        if raw.class_ is not None:
            return raw.class_
        names = {value: name for name, value in CLASSES.items()}
        return names[raw.priority or PRIORITY_MAX]

    def check_names(self, raw: RawTaskSet) -> None:
        """No name twice, also not as part of a C identifier, and none that the C table takes."""
        if raw.name.split("_")[0] == KERNEL:
            self.blame(("name",), f'expected a name that does not begin with "{KERNEL}", as the '
                       "kernel's do in C")  # fmt: skip
        for number, task in enumerate(raw.task):
            symbol = symbol_of(task.name)
            whole = f"{raw.name.upper()}_{symbol}"
            if symbol in TABLE_NAMES or STDINT_NAME.fullmatch(whole):
                owner = "the C table's" if symbol in TABLE_NAMES else "stdint.h's"
                expected = f"expected a name other than {owner} own: it becomes {whole}"
                self.blame(("task", number, "name"), expected)
        seen: dict[tuple[str, str], int] = {}
        for number, task in enumerate(raw.task):
            for kind, text in (("name", symbol_of(task.name)), ("label", task.label or "")):
                first = seen.setdefault((kind, text), number) if text else number
                if first != number:
                    taken = raw.task[first].name
                    expected = f'expected another than that of "{taken}" (as a C identifier)'
                    self.blame(("task", number, kind), expected)

    def check_chains(self, raw: RawTaskSet) -> None:
        """Chains name tasks that exist, each once."""
        known = {task.name for task in raw.task}
        for number, chain in enumerate(raw.chain):
            place: KeyPath = ("chain", number, "path")
            for name in chain.path:
                if name not in known:
                    self.blame(place, f'expected names of tasks; there is no "{name}"')
            if len(set(chain.path)) != len(chain.path):
                self.blame(place, "expected each task at most once")


TABLES: dict[str | int, type[Strict]] = {
    "scheduler": Costs, "published": Published, "task": RawTask, "chain": Chain
}  # fmt: skip


def keys_at(place: KeyPath) -> list[str]:
    """The keys that a table may have, given the path of one that it has not."""
    model = TABLES[place[0]] if len(place) > 1 else RawTaskSet
    return [field.alias or name for name, field in model.model_fields.items()]


def expectation(place: KeyPath, message: str, given: Any) -> str:
    """pydantic's message in the form of ours, with what was there instead."""
    if message == "Field required":
        return "expected: this key is missing"
    if message == "Extra inputs are not permitted":
        return f"unknown key; expected one of {', '.join(keys_at(place))}"
    return f"{re.sub('^[A-Z][a-z]+ should', 'expected to', message)}, found {shown(given)}"


def shown(given: Any) -> str:
    """What was found, in few words: nested tables and long numbers have no repr of any length."""
    if isinstance(given, dict):
        return "a table"
    if isinstance(given, list):
        return "an array"
    if isinstance(given, int) and given.bit_length() > 128:
        return f"a number of {given.bit_length()} bits"
    text = repr(given)
    return text if len(text) <= 40 else f"{text[:37]}..."


def parse(text: str, file: str = "task set") -> TaskSet:
    """The task set in a text. Raises TaskSetError with every problem found."""
    return Reader(text, file).read()


def read(path: Path) -> TaskSet:
    """The task set in a file. Raises TaskSetError."""
    file = str(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        reason = f"cannot be read: {error.strerror}"
        raise TaskSetError([Problem(file, 1, "file", reason)]) from error
    if len(data) > SIZE_LIMIT:
        raise TaskSetError([Problem(file, 1, "file", f"expected at most {SIZE_LIMIT} bytes")])
    try:
        return parse(data.decode(), file)
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise TaskSetError([Problem(file, line, "file", "expected UTF-8")]) from error
