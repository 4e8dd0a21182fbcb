# SPDX-License-Identifier: Apache-2.0
"""Runs the jobs whose verdict is not known yet."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from keel.base.jobs import Runner, in_pool
from keel.base.verdict_cache import Cache
from keel.c.project import ProjectError
from keel.prove.progress import Running
from keel.prove.times import Times


@dataclass(frozen=True)
class Job:
    """One verdict to be had."""

    unit: str
    kind: str
    name: str
    # A digest of all that the verdict depends on, as it is now.
    key: Callable[[], str]
    # The verdict, with so many times the usual limits of processor time.
    execute: Callable[[int], dict[str, Any]]

    @property
    def label(self) -> str:
        """What the job is called between runs."""
        return f"{self.unit}/{self.kind}/{self.name}"


@dataclass(frozen=True)
class Outcome:
    """A job's result, and whether it came from the cache."""

    job: Job
    result: dict[str, Any]
    cached: bool

    @property
    def problems(self) -> list[str]:
        """What is wrong; nothing if all is proved."""
        return list(self.result["problems"])


# The limits of a job that is asked again when it is alone.
ALONE = 2
# The jobs that start first: contracts and theorems are the first verdict that a user waits for.
FIRST = "wp"


@dataclass(frozen=True)
class Pool:
    """How many jobs run side by side, with how many times the usual limits of processor time."""

    width: int
    room: int = 1
    # Whether what provers gave up is asked again, alone and with more room, when all else is done.
    again: bool = True


def run_jobs(
    jobs: Sequence[Job],
    cache: Cache,
    runner: Runner,
    pool: Pool,
    times: Times,
    done: Callable[[Outcome], None],
    late: Callable[[Job, float], None] = lambda _job, _s: None,
) -> list[Outcome]:
    """Have a verdict for every job; `done` hears of each as it comes, `late` of what takes long."""
    outcomes: list[Outcome] = []
    given_up: list[Outcome] = []
    running = Running(late, lambda job: times.seconds.get(job.label))

    def finish(outcome: Outcome) -> None:
        outcomes.append(outcome)
        if not outcome.cached:
            times.note(outcome.job.label, float(outcome.result["seconds"]))
        done(outcome)

    waiting: list[Job] = []
    for job in jobs:
        known = cache.get(job.key())
        if known is None:
            waiting.append(job)
        else:
            finish(Outcome(job, known, cached=True))
    waiting.sort(key=lambda job: (job.kind != FIRST, -times.expected(job.label), job.label))

    def ended(chosen: Sequence[Job], width: int, room: int) -> Iterator[Outcome]:
        tasks = [functools.partial(_execute, job, cache, room, running) for job in chosen]
        for index, result in in_pool(tasks, width, runner, running.look):
            yield Outcome(chosen[index], result, cached=False)

    for outcome in ended(waiting, pool.width, pool.room):
        if outcome.result.get("gave_up") and pool.again:
            given_up.append(outcome)
            print(
                f"{outcome.job.label}: given up, asked again alone when all else is done",
                flush=True,
            )
        else:
            finish(outcome)
    # More time proves nothing of a unit of which something else is known to be wrong.
    wrong = {one.job.unit for one in outcomes if one.problems and not one.result.get("gave_up")}
    for outcome in given_up:
        if outcome.job.unit in wrong:
            finish(outcome)
    again = [one.job for one in given_up if one.job.unit not in wrong]
    for outcome in ended(again, 1, pool.room * ALONE):
        finish(outcome)
    return outcomes


def _execute(job: Job, cache: Cache, room: int, running: Running) -> dict[str, Any]:
    """Run a job and keep its success, if it is one about the text that is still there."""
    try:
        before = job.key()
        with running.now(job):
            result = job.execute(room)
        changed = job.key() != before
    except OSError as error:
        raise ProjectError(f"{job.label}: did the tree change meanwhile? {error}") from error
    if changed:
        result["problems"].append(f"{job.label}: its text changed while it was proved: run again")
    if not result["problems"]:
        cache.put(before, result)
    return result
