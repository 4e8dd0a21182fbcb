# SPDX-License-Identifier: Apache-2.0
"""The analysis of a task set: every test, and a verdict with the first reason."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from keel.timing import textbook_tests
from keel.timing.isolation import Isolation, isolation_of
from keel.timing.scheduler_bounds import Bounds, Tails, bounds_of, collisions, declared, path_bound
from keel.timing.taskset import CLASSES, Task, TaskSet

# How a set stands: by the first of its reasons, most basic first.
SCHEDULABLE = "schedulable"
NOT_SHOWN = "not shown to be schedulable"  # A bound fails, which is sufficient, not necessary.
REFUSED = "not admitted"  # keel_scheduler_start refuses it, by rules that are sufficient alone.
IMPOSSIBLE = "NOT schedulable"  # By any scheduler, if runs take as long as declared.

LOAD_TARGET = 40.0  # Percent; section IV-C of the paper.
LOAD_ALARM = (65.0, 75.0)


@dataclass(frozen=True)
class ClassLoad:
    """The utilisation of a class, beside its bounds."""

    name: str
    tasks: int
    utilisation: float
    liu_layland: float
    hyperbolic: float  # Must not exceed 2.


@dataclass(frozen=True)
class RealtimeRow:
    """Response times of a real-time task."""

    label: str
    name: str
    period: int
    budget: int
    unguarded: int | None  # Textbook: fixed priorities, blocked by the longest other task.
    guarded: int | None  # Textbook: blocked by real-time tasks alone.
    bound: int  # Keel, costs included, nobody promoted.
    bound_promotion: int  # Keel, and one promoted task is in the way.
    bound_apart: int | None  # Keel, with the phases of the set; None where tasks collide.
    response: int  # The one that counts.


@dataclass(frozen=True)
class OtherRow:
    """A task that is not real-time."""

    label: str
    name: str
    class_name: str
    period: int
    budget: int
    fits: str  # Which real-time gaps take the declared budget and the guard.
    bound: int | None  # Whatever the phases of the tasks that are not real-time.
    bound_apart: int | None  # With the phases of the set; None where tasks collide.
    response: int | None  # The one that counts.
    promotion_wait: int
    promoted_bound: int | None


@dataclass(frozen=True)
class ChainRow:
    """A path against its limits."""

    name: str
    path: list[str]
    reaction: int
    reaction_limit: int
    freshness: int
    freshness_limit: int
    conventional: int | None
    followed: int | None
    safe: int | None  # The least of these two bounds.
    advisory: bool

    @property
    def within(self) -> bool:
        """Whether eq. 5 to 7 are within the limits."""
        return self.reaction <= self.reaction_limit and self.freshness <= self.freshness_limit

    @property
    def safe_within(self) -> bool:
        """Whether the safe bound, which counts missed samples, keeps the limits."""
        return self.safe is not None and self.safe <= min(self.reaction_limit, self.freshness_limit)

    def report(self) -> dict[str, Any]:
        """For JSON: the row and its verdicts."""
        verdicts = {"within": self.within, "safe_within": self.safe_within}
        return {**asdict(self), **verdicts}


@dataclass(frozen=True)
class Gaps:
    """Between the end of real-time tasks that take their declared budgets and the next release.

    With the phases of the set. None: no real-time task, or too many releases to look at.
    """

    shortest: int | None
    longest: int | None
    admission: int | None  # The kernel's rule: shortest T - C of one real-time task.


@dataclass(frozen=True)
class Analysis:
    """Everything that is reported."""

    name: str
    classes: list[ClassLoad]
    realtime: ClassLoad
    others: ClassLoad
    total: ClassLoad
    published: dict[str, float | None] | None
    jeffay: textbook_tests.Jeffay
    realtime_rows: list[RealtimeRow]
    other_rows: list[OtherRow]
    promotion_excluded: bool
    isolation: Isolation
    collisions: list[tuple[str, str]]  # Labels of tasks that may want the processor together.
    gaps: Gaps
    chains: list[ChainRow]
    hyperperiod: int
    standing: str
    reasons: list[str]

    @property
    def schedulable(self) -> bool:
        """Whether every task meets its deadline, and every path its limits, by bounds that hold."""
        return self.standing == SCHEDULABLE

    @property
    def load_zone(self) -> str:
        """Where the utilisation stands between target and alarm."""
        percent = 100.0 * self.total.utilisation
        if percent <= LOAD_TARGET:
            return f"{LOAD_TARGET - percent:.1f} points below the target of {LOAD_TARGET:.0f} %"
        if percent < LOAD_ALARM[0]:
            return f"above the target of {LOAD_TARGET:.0f} %, below the alarm"
        return f"in or above the alarm zone of {LOAD_ALARM[0]:.0f} to {LOAD_ALARM[1]:.0f} %"

    @property
    def advice(self) -> list[str]:
        """What is wrong with paths, but not judged."""
        found = []
        for row in self.chains:
            if row.advisory and not row.within:
                found.append(f"path {row.name} exceeds its limits by eq. 5 to 7")
            if not row.safe_within:
                limit = min(row.reaction_limit, row.freshness_limit)
                bound = "there is no safe bound" if row.safe is None else f"up to {row.safe} us"
                found.append(
                    f"path {row.name} may take longer than its limit of {limit} us from an event "
                    f"that just misses its sample: {bound}"
                )
        return found

    def report(self) -> dict[str, Any]:
        """For JSON."""
        verdict = {"schedulable": self.schedulable, "load": self.load_zone, "advice": self.advice}
        return {**verdict, **asdict(self), "chains": [row.report() for row in self.chains]}


def class_load(name: str, tasks: list[Task]) -> ClassLoad:
    """The utilisation of some tasks."""
    return ClassLoad(
        name,
        len(tasks),
        float(textbook_tests.utilisation(tasks)),
        textbook_tests.liu_layland(len(tasks)),
        textbook_tests.hyperbolic(tasks),
    )


def realtime_rows(tasks: TaskSet, found: Bounds) -> list[RealtimeRow]:
    """Response times of the real-time tasks."""
    outside = max((task.budget for task in tasks.others), default=0)
    unguarded = textbook_tests.fixed_priority(tasks.realtime, outside)
    guarded = textbook_tests.fixed_priority(tasks.realtime, 0)
    return [
        RealtimeRow(
            task.label,
            task.name,
            task.period,
            task.budget,
            without,
            within,
            found.realtime_guarded[task.name],
            found.realtime_promotion[task.name],
            (found.apart or {}).get(task.name),
            found.realtime[task.name],
        )
        for task, without, within in zip(tasks.realtime, unguarded, guarded, strict=True)
    ]


def gaps_of(tasks: TaskSet) -> Gaps:
    """The gaps between real-time tasks, from every release of a common period."""
    if not tasks.realtime:
        return Gaps(None, None, None)
    admission = max(0, min(task.period - declared(tasks, task) for task in tasks.realtime))
    tails = Tails(tasks.realtime)
    if not tails.instants:
        return Gaps(None, None, admission)
    gaps: list[int] = []
    end = 0  # Of all work released so far.
    for turn in range(2):  # The first leaves the backlog that every later one begins with.
        gaps.clear()
        for index, at in enumerate(tails.instants):
            following = (*tails.instants, tails.instants[0] + tails.cycle)[index + 1]
            work = sum(
                declared(tasks, task)
                for task in tasks.realtime
                if (at - task.phase) % task.period == 0
            )
            end = max(end, turn * tails.cycle + at) + work
            gaps.append(max(0, turn * tails.cycle + following - end))
    open_gaps = [gap for gap in gaps if gap] or [0]
    return Gaps(min(open_gaps), max(open_gaps), admission)


def fits(tasks: TaskSet, task: Task, gaps: Gaps) -> str:
    """Which gaps take a declared budget and the guard."""
    if not tasks.realtime:
        return "always"
    if gaps.shortest is None or gaps.longest is None:
        return "not known"
    need = tasks.costs.guard_us + declared(tasks, task)
    if need <= gaps.shortest:
        return "every"
    return "some" if need <= gaps.longest else "none"


def other_rows(tasks: TaskSet, found: Bounds) -> list[OtherRow]:
    """The tasks that are not real-time."""
    gaps = gaps_of(tasks)
    rows = []
    for task in tasks.others:
        bound = found.others[task.name]
        rows.append(
            OtherRow(
                task.label,
                task.name,
                task.class_name,
                task.period,
                task.budget,
                fits(tasks, task, gaps),
                bound.any_phase,
                (found.apart or {}).get(task.name),
                bound.response,
                bound.promotion_wait,
                bound.promoted_response,
            )
        )
    return rows


def chain_rows(tasks: TaskSet, found: Bounds) -> list[ChainRow]:
    """The chains."""
    rows = []
    for chain in tasks.chains:
        path = tasks.path(chain)
        bound = path_bound(tasks, chain, found)
        rows.append(
            ChainRow(
                chain.name,
                [task.label for task in path],
                textbook_tests.reaction(path),
                chain.reaction_limit_us,
                textbook_tests.freshness(path),
                chain.freshness_limit_us,
                bound.total,
                bound.followed,
                bound.least,
                chain.advisory,
            )
        )
    return rows


def admission_reasons(tasks: TaskSet) -> Iterator[str]:
    """Why keel_scheduler_start would refuse the set (ADM-003), budgets as declared."""
    guard = tasks.costs.guard_us
    demand = sum(declared(tasks, task) for task in tasks.realtime)
    for task in tasks.realtime:
        if demand + 2 * guard > task.period:
            yield (
                f"the kernel refuses it: real-time budgets and twice the guard, "
                f"{demand + 2 * guard} us, exceed the period of {task.name}, {task.period} us"
            )
        gap = task.period - declared(tasks, task)
        for other in tasks.others:
            need = declared(tasks, other) + guard
            if need > gap:
                yield (
                    f"the kernel refuses it: {other.name} needs {need} us with the guard, and "
                    f"{task.name} leaves {max(gap, 0)} us"
                )
    # As the kernel counts: in parts per million, each task rounded up.
    ppm = sum(-(-declared(tasks, task) * 1_000_000 // task.period) for task in tasks.tasks)
    limit = tasks.costs.utilisation_limit_ppm
    if ppm > limit:
        yield (
            f"the kernel refuses it: utilisation with the scheduler's own time, "
            f"{ppm / 10_000:.2f} %, exceeds the limit of {limit / 10_000:.2f} %"
        )


def realtime_reasons(tasks: TaskSet, found: Bounds) -> Iterator[str]:
    """Which bounds of real-time tasks exceed their deadlines."""
    behind = "" if found.promotion_excluded else ", one promoted task in it"
    for task in tasks.realtime:
        bound = found.realtime[task.name]
        if bound > task.period:
            yield (
                f"{task.name} responds within {bound} us by its bound{behind}; its deadline is "
                f"{task.period} us"
            )


def other_reasons(found: Bounds) -> Iterator[str]:
    """Why tasks that are not real-time have no bounds, and what follows."""
    for name, short in found.shortfalls.items():
        yield (
            f"{name} has no bound within its period of {short.period} us: it would be "
            f"{short.least} us or more, {short.own} its own, {short.blocking} for what began "
            f"before it, {short.realtime} for real-time tasks, {short.rivals} for tasks that may "
            f"come first, {short.tails} for gaps that are too short for it"
        )
    more = "" if found.promotion_excluded else " and be promoted"
    yield (
        f"tasks that are not real-time have no bounds that agree, so none is known to hold: "
        f"they may miss deadlines{more}"
    )


def reasons(tasks: TaskSet, found: Bounds, chains: list[ChainRow]) -> Iterator[tuple[str, str]]:
    """Why the set is not schedulable, or not shown to be: how it stands by that, and the reason,
    most basic first."""
    total = textbook_tests.utilisation(tasks.tasks)
    if total > 1:
        yield IMPOSSIBLE, f"utilisation is {100.0 * float(total):.2f} %, above 100 % (eq. 11)"
    yield from ((REFUSED, text) for text in admission_reasons(tasks))
    yield from ((NOT_SHOWN, text) for text in realtime_reasons(tasks, found))
    if any(bound.response is None for bound in found.others.values()):
        yield from ((NOT_SHOWN, text) for text in other_reasons(found))
    for chain in chains:
        if not (chain.within or chain.advisory):
            yield (
                NOT_SHOWN,
                (
                    f"path {chain.name}: E = {chain.reaction} us of {chain.reaction_limit} us, "
                    f"F = {chain.freshness} us of {chain.freshness_limit} us (eq. 5 to 7)"
                ),
            )


def analyse(tasks: TaskSet) -> Analysis:
    """Every test of a task set."""
    found = bounds_of(tasks)
    chains = chain_rows(tasks, found)
    published = tasks.published.model_dump() if tasks.published else None
    why = list(reasons(tasks, found, chains))
    return Analysis(
        name=tasks.name,
        classes=[
            class_load(name, members)
            for name in CLASSES
            if (members := [task for task in tasks.tasks if task.class_name == name])
        ],
        realtime=class_load("real-time (FCFS)", tasks.realtime),
        others=class_load("others (EDF)", tasks.others),
        total=class_load("all", list(tasks.tasks)),
        published=published,
        jeffay=textbook_tests.jeffay(tasks.tasks),
        realtime_rows=realtime_rows(tasks, found),
        other_rows=other_rows(tasks, found),
        promotion_excluded=found.promotion_excluded,
        isolation=isolation_of(tasks, found, admission_reasons(tasks)),
        collisions=[(one.label, two.label) for one, two in collisions(tasks)],
        gaps=gaps_of(tasks),
        chains=chains,
        hyperperiod=textbook_tests.hyperperiod(tasks.tasks),
        standing=why[0][0] if why else SCHEDULABLE,
        reasons=[text for _, text in why],
    )
