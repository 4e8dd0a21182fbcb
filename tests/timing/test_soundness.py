# SPDX-License-Identifier: Apache-2.0
"""The analyser against brute force: what it calls safe no simulation by the kernel's code breaks.

KEEL_RANDOM_SETS sets how many sets are tried, 10 000 unless given. Each runs for many of its
periods on the virtual board, with the longest times, with random ones, and with runs that are
either as long as they can be or next to nothing.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from sets import random_set, with_chains

from keel.install import Toolchain
from keel.timing import board
from keel.timing.analysis import admission_reasons, analyse
from keel.timing.board import Experiment, Result
from keel.timing.phases import spread
from keel.timing.scheduler_bounds import Bounds, bounds_of, collisions, declared, needs, path_bound
from keel.timing.taskset import Task, TaskSet
from keel.timing.textbook_tests import fixed_priority, freshness, hyperperiod, jeffay, reaction

SETS = int(os.environ.get("KEEL_RANDOM_SETS", "10000"))
LOADS = (0.15, 0.3, 0.45, 0.6, 0.75, 0.9)
LENGTH_US = 12_000
BATCH = 250
MODELS = (("constant", 1), ("uniform", 2), ("either", 3))


@pytest.fixture(scope="module")
def program() -> Path:
    """The virtual board."""
    return board.build(Toolchain(), "experiment-test")


def simulated(
    program: Path, sets: Sequence[TaskSet], plan: Callable[[TaskSet], list[Experiment]]
) -> Iterator[tuple[TaskSet, list[Result]]]:
    """Every set with the results of its plan, two batches side by side."""

    def run(chunk: Sequence[TaskSet]) -> list[tuple[TaskSet, list[Result]]]:
        plans = [plan(tasks) for tasks in chunk]
        orders = [item for items in plans for item in items]
        results = iter(board.run_batch(program, orders, 120.0, refusals=True))
        pairs = zip(chunk, plans, strict=True)
        return [(tasks, [next(results) for _ in items]) for tasks, items in pairs]

    chunks = [sets[first : first + BATCH] for first in range(0, len(sets), BATCH)]
    with ThreadPoolExecutor(2) as pool:
        for answers in pool.map(run, chunks):
            yield from answers


def with_kernel(tasks: TaskSet) -> list[Experiment]:
    """The kernel, with the longest times and with random ones."""
    return [
        Experiment(tasks, model=model, seed=seed, duration_us=LENGTH_US, turn_ns=500)
        for model, seed in MODELS
    ]


@dataclass
class Seen:
    """How much the comparison had to compare."""

    refused: int = 0
    safe: int = 0
    broken: int = 0  # Sets with a missed deadline.
    tight: float = 0.0  # The observed response that came nearest to its bound.


def hold(tasks: TaskSet, found: Bounds, result: Result, seen: Seen) -> None:
    """Every bound that is claimed holds for this run."""
    for task in tasks.realtime:
        worst = result.tasks[task.name].worst
        if found.realtime[task.name] <= task.period:
            assert worst <= found.realtime[task.name], (tasks, task.name)
            seen.tight = max(seen.tight, worst / found.realtime[task.name])
        if found.realtime_promotion[task.name] <= task.period:
            assert worst <= found.realtime_promotion[task.name], (tasks, task.name)
    for task in tasks.others:
        outcome, bound = result.tasks[task.name], found.others[task.name]
        if bound.promoted_response is not None:
            assert outcome.worst <= bound.promoted_response, (tasks, task.name)
        if bound.response is not None:
            assert outcome.worst <= bound.response, (tasks, task.name)
            assert outcome.promotions == 0, (tasks, task.name)
            seen.tight = max(seen.tight, outcome.worst / bound.response)


def test_what_is_called_safe_is_not_broken(program: Path) -> None:
    sets = [random_set(number, LOADS[number % len(LOADS)]) for number in range(SETS)]
    seen = Seen()
    for tasks, results in simulated(program, sets, with_kernel):
        analysis, found = analyse(tasks), bounds_of(tasks)
        refused = any(admission_reasons(tasks))
        # The analyser's rules of admission are the kernel's.
        assert all((result.status != 0) == refused for result in results), tasks
        seen.refused += refused
        if refused:
            assert not analysis.schedulable, tasks
            continue
        late = sum(task.late + task.skipped for result in results for task in result.tasks.values())
        assert not (late and analysis.schedulable), (tasks, late)
        seen.safe += analysis.schedulable
        seen.broken += late > 0
        for result in results:
            hold(tasks, found, result, seen)
    print(seen)
    # The comparison means something: there was enough of each, and bounds are not far away.
    assert seen.safe > SETS / 25 and seen.broken > SETS / 100 and seen.tight > 0.9, seen


def understated(tasks: TaskSet) -> list[Experiment]:
    """The kernel with declared budgets that are far too small."""
    budgets = {task.name: max(1, task.budget // 3) for task in tasks.tasks}
    return [replace(plan, budgets=budgets) for plan in with_kernel(tasks)]


def test_under_overload_the_bounds_behind_promotion_hold(program: Path) -> None:
    """They rest neither on utilisation, nor on admission, nor on budgets that are kept."""
    sets = [random_set(number, 0.6 + 0.2 * (number % 5)) for number in range(SETS // 4)]
    compared = overloads = 0
    for tasks, results in simulated(program, sets, understated):
        bounds = bounds_of(tasks)
        overloads += sum(task.utilisation for task in tasks.tasks) > 1.0
        for result in results:
            for task in tasks.realtime if result.status == 0 else ():
                bound = bounds.realtime_promotion[task.name]
                if bound <= task.period:
                    assert result.tasks[task.name].worst <= bound, (tasks, task.name)
                    compared += 1
            for task in tasks.others if result.status == 0 else ():
                limit = bounds.others[task.name].promoted_response
                if limit is not None:
                    assert result.tasks[task.name].worst <= limit, (tasks, task.name)
                    compared += 1
    print(f"{compared} compared, {overloads} sets above 100 %")
    assert compared > SETS / 10 and overloads > SETS / 100


@dataclass
class Paths:
    """How the paths of the simulation stand against what is said of them."""

    bounded: int = 0
    followed: int = 0
    tight: float = 0.0  # The observed reaction that came nearest to its bound.
    sample_beyond_e: int = 0  # Reaction to a sample, above eq. 5 and 6.
    event_beyond_e: int = 0  # Reaction to an event that just misses its sample.
    output_beyond_f: int = 0  # Age of a sample at an output, above eq. 7.
    value_beyond_f: int = 0  # Age of a value until it is replaced.


def hold_paths(tasks: TaskSet, found: Bounds, results: list[Result], seen: Paths) -> None:
    """No path that has a safe bound exceeds it."""
    for chain in tasks.chains:
        bound = path_bound(tasks, chain, found)
        outcomes = [result.chains[chain.name] for result in results]
        if bound.least is None:
            continue
        sample = max(outcome.reaction for outcome in outcomes)
        output = max(outcome.freshness for outcome in outcomes)
        event = max(outcome.event for outcome in outcomes)
        assert max(sample, output, event) <= bound.least, (tasks, chain)
        path = tasks.path(chain)
        seen.bounded += 1
        seen.followed += bound.followed is not None
        seen.tight = max(seen.tight, event / bound.least)
        seen.sample_beyond_e += sample > reaction(path)
        seen.event_beyond_e += event > reaction(path)
        seen.output_beyond_f += output > freshness(path)
        seen.value_beyond_f += event > freshness(path)


def test_no_path_exceeds_its_safe_bound(program: Path) -> None:
    """Eq. 5 to 7 are exceeded, which is why they are called no bounds: how often is printed."""
    sets = []
    for number in range(SETS // 2):
        tasks = random_set(number, LOADS[number % 4])
        sets.append(with_chains(spread(tasks)[0] if number % 2 else tasks, number))
    seen = Paths()
    for tasks, results in simulated(program, sets, with_kernel):
        if not any(admission_reasons(tasks)):
            hold_paths(tasks, bounds_of(tasks), results, seen)
    print(seen)
    assert seen.bounded > SETS / 10 and seen.followed > SETS / 50 and seen.tight > 0.9, seen
    assert seen.sample_beyond_e and seen.event_beyond_e, seen
    assert seen.output_beyond_f and seen.value_beyond_f, seen


def plain_edf(tasks: TaskSet) -> list[Experiment]:
    """Plain EDF without costs, all tasks alike."""
    return [
        Experiment(tasks, policy="edf", model=model, seed=seed, duration_us=LENGTH_US, turn_ns=0)
        for model, seed in MODELS[:2]
    ]


def test_jeffay_never_passes_a_set_that_edf_breaks(program: Path) -> None:
    sets = [random_set(number, 0.5 + 0.1 * (number % 6), free=True) for number in range(SETS // 4)]
    low = [
        replace(tasks, tasks=tuple(replace(task, class_name="low") for task in tasks.tasks))
        for tasks in sets
    ]
    holds = broken = 0
    for tasks, results in simulated(program, low, plain_edf):
        late = sum(task.late + task.skipped for result in results for task in result.tasks.values())
        passes = jeffay(tasks.tasks).holds
        assert not (passes and late), tasks
        holds += passes
        broken += late > 0
    print(f"{holds} hold, {broken} broken")
    assert holds > SETS / 100 and broken > SETS / 100


def fixed_priority_simulation(tasks: Sequence[Task], length: int) -> list[int]:
    """Non-preemptive fixed priorities, written to be obvious; the worst response of each task."""
    jobs = [[task.phase + k * task.period for k in range(length // task.period)] for task in tasks]
    worst = [0] * len(tasks)
    now = 0
    while any(jobs):
        ready = [index for index, waiting in enumerate(jobs) if waiting and waiting[0] <= now]
        if not ready:
            now = min(waiting[0] for waiting in jobs if waiting)
            continue
        now += tasks[ready[0]].budget
        worst[ready[0]] = max(worst[ready[0]], now - jobs[ready[0]].pop(0))
    return worst


def test_fixed_priority_responses_bound_a_simulation() -> None:
    bounded = 0
    for number in range(min(SETS, 1000)):
        tasks = random_set(number, 0.4 + 0.1 * (number % 6), free=True).tasks
        bound = fixed_priority(tasks, 0)
        seen = fixed_priority_simulation(tasks, 3000)
        for limit, worst in zip(bound, seen, strict=True):
            assert limit is None or worst <= limit, (tasks, bound, seen)
            bounded += limit is not None
    assert bounded > 1000


def test_phases_keep_tasks_apart(program: Path) -> None:
    """With phases nobody waits: each response is the task's own time, a pass and a dispatch."""
    sets = [spread(random_set(number, 0.3)) for number in range(min(SETS, 1000))]
    apart = [tasks for tasks, crowded in sets if not crowded]
    assert len(apart) > len(sets) / 20
    for tasks, results in simulated(program, apart, with_kernel):
        if any(admission_reasons(tasks)):
            continue
        for result in results:
            for task in tasks.tasks:
                # One more us: the loop turns every half one, and the clock counts whole ones.
                assert result.tasks[task.name].worst <= declared(tasks, task) + 1.0, tasks
            hold(tasks, bounds_of(tasks), result, Seen())


def meet(tasks: TaskSet) -> bool:
    """Whether tasks collide, from every release of two common periods."""
    length = 2 * hyperperiod(tasks.tasks)
    releases = sorted(
        (release, index)
        for index, task in enumerate(tasks.tasks)
        for release in range(task.phase, length + task.period, task.period)
    )
    return any(
        second - first < needs(tasks, tasks.tasks[one], tasks.tasks[two])
        for number, (first, one) in enumerate(releases)
        for second, two in releases[number + 1 : number + 1 + len(tasks.tasks)]
    )


def test_collisions_are_those_of_the_releases() -> None:
    """The congruence against a look at every release, with phases that were found and moved."""
    seen = {True: 0, False: 0}
    for number in range(min(SETS, 1000)):
        tasks = random_set(number, 0.15)
        if number % 2:
            tasks = spread(tasks)[0]
        if hyperperiod(tasks.tasks) > 10_000:
            continue
        assert bool(collisions(tasks)) == meet(tasks), tasks
        seen[meet(tasks)] += 1
    assert min(seen.values()) > min(SETS, 1000) / 50, seen
