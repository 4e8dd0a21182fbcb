"""Runs the jobs whose verdict is not known yet."""

from __future__ import annotations

import functools
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .cache import Cache, write_atomically
from .jobs import Runner, in_pool
from .project import ProjectError


@dataclass(frozen=True)
class Job:
    """One verdict to be had."""

    unit: str
    kind: str
    name: str
    # A digest of all that the verdict depends on, as it is now.
    key: Callable[[], str]
    execute: Callable[[], dict[str, Any]]

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


class Times:
    """How long each job took last time: the longest go first, so that none is left to wait for."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._seconds = self._read()
        self._noted: dict[str, float] = {}

    def _read(self) -> dict[str, float]:
        try:
            return dict(json.loads(self._path.read_text(encoding="utf-8")))
        except (OSError, ValueError):
            return {}

    def of(self, kind: str, unit: str, name: str) -> float | None:
        """The last duration of a job, if it was ever run."""
        return self._seconds.get(f"{unit}/{kind}/{name}")

    def expected(self, job: Job) -> float:
        """The last duration; a job never seen may be the longest of all."""
        return self._seconds.get(job.label, float("inf"))

    def note(self, outcome: Outcome) -> None:
        """Remember a duration."""
        if not outcome.cached:
            self._noted[outcome.job.label] = float(outcome.result["seconds"])

    def save(self) -> None:
        """Keep for the next run, beside what another run may have kept meanwhile."""
        merged = {**self._read(), **self._noted}
        write_atomically(self._path, json.dumps(merged, indent=1, sort_keys=True))


def run_jobs(
    jobs: Sequence[Job], cache: Cache, runner: Runner, width: int, times: Times,
    done: Callable[[Outcome], None],
) -> list[Outcome]:  # fmt: skip
    """Have a verdict for every job; `done` hears of each as it comes."""
    outcomes: list[Outcome] = []

    def finish(outcome: Outcome) -> None:
        outcomes.append(outcome)
        times.note(outcome)
        done(outcome)

    waiting: list[Job] = []
    for job in jobs:
        known = cache.get(job.key())
        if known is None:
            waiting.append(job)
        else:
            finish(Outcome(job, known, cached=True))
    waiting.sort(key=lambda job: (-times.expected(job), job.label))
    tasks = [functools.partial(_execute, job, cache) for job in waiting]
    for index, result in in_pool(tasks, width, runner):
        finish(Outcome(waiting[index], result, cached=False))
    return outcomes


def _execute(job: Job, cache: Cache) -> dict[str, Any]:
    """Run a job and keep its success, if it is one about the text that is still there."""
    try:
        before = job.key()
        result = job.execute()
        changed = job.key() != before
    except OSError as error:
        raise ProjectError(f"{job.label}: did the tree change meanwhile? {error}") from error
    if changed:
        result["problems"].append(f"{job.label}: its text changed while it was proved: run again")
    if not result["problems"]:
        cache.put(before, result)
    return result
