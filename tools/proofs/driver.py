# SPDX-License-Identifier: Apache-2.0
"""Runs the jobs whose verdict is not known yet."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from .cache import Cache
from .jobs import Runner, in_pool
from .project import ProjectError
from .times import Times


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


@dataclass(frozen=True)
class Pool:
    """How many jobs run side by side, with how many times the usual limits of processor time."""

    width: int
    room: int = 1
    # Whether what provers gave up is asked again, alone and with more room, when all else is done.
    again: bool = True


def run_jobs(
    jobs: Sequence[Job], cache: Cache, runner: Runner, pool: Pool, times: Times,
    done: Callable[[Outcome], None],
) -> list[Outcome]:  # fmt: skip
    """Have a verdict for every job; `done` hears of each as it comes."""
    outcomes: list[Outcome] = []
    given_up: list[Job] = []

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
    waiting.sort(key=lambda job: (-times.expected(job.label), job.label))
    tasks = [functools.partial(_execute, job, cache, pool.room) for job in waiting]
    for index, result in in_pool(tasks, pool.width, runner):
        if result.get("gave_up") and pool.again:
            given_up.append(waiting[index])
            print(f"{waiting[index].label}: given up, asked again alone when all else is done")
        else:
            finish(Outcome(waiting[index], result, cached=False))
    for job in given_up:
        result = _execute(job, cache, pool.room * ALONE)
        finish(Outcome(job, result, cached=False))
    return outcomes


def _execute(job: Job, cache: Cache, room: int) -> dict[str, Any]:
    """Run a job and keep its success, if it is one about the text that is still there."""
    try:
        before = job.key()
        result = job.execute(room)
        changed = job.key() != before
    except OSError as error:
        raise ProjectError(f"{job.label}: did the tree change meanwhile? {error}") from error
    if changed:
        result["problems"].append(f"{job.label}: its text changed while it was proved: run again")
    if not result["problems"]:
        cache.put(before, result)
    return result
