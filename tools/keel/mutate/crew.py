# SPDX-License-Identifier: Apache-2.0
"""Has mutants tried: by threads of this machine, or by the workers of a Dask cluster.

To a cluster go orders, each a few mutants of one function, so that what the function costs
unchanged is paid once. A worker's tools must be the same as here, by version and checksum.
"""

from __future__ import annotations

import importlib
import json
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from keel.base import cluster_worker
from keel.base.cluster import archive
from keel.base.jobs import Stoppable, in_pool
from keel.c.project import ProjectError
from keel.judge.harness import MODELS
from keel.mutate.operators import Mutant
from keel.mutate.verdicts import Verdict

SENT = ("include", "src", "proofs", MODELS, "tools")
PROGRAM = ["tools/keel", "mutate", "--order"]
ORDER = 6  # mutants in an order


class Tries(Protocol):
    """Something that tries mutants."""

    def try_mutant(self, mutant: Mutant) -> Verdict:
        """Which engine notices the mutant, if any."""


# A mutant, the name of its unit, and who tries it.
Job = tuple[str, Tries, Mutant]


class Threads:
    """This machine, several mutants at a time."""

    def __init__(self, width: int, stoppable: Stoppable, end: float = float("inf")) -> None:
        self._width = width
        self._stoppable = stoppable
        self._end = end

    def run(self, jobs: Sequence[Job]) -> Iterator[tuple[int, Verdict]]:
        """The verdicts as they come, each with the place of its job."""

        def attempt(tries: Tries, mutant: Mutant) -> Verdict:
            if time.monotonic() > self._end:
                return Verdict(mutant, "skipped", "out of time")
            return tries.try_mutant(mutant)

        tasks: list[Callable[[], Verdict]] = [
            lambda tries=tries, mutant=mutant: attempt(tries, mutant)  # type: ignore[misc]
            for _, tries, mutant in jobs
        ]
        yield from in_pool(tasks, self._width, self._stoppable)


class Dask:
    """A cluster, by the address of its scheduler; the order says how to try."""

    def __init__(self, address: str, root: Path, stamp: str, order: Mapping[str, Any]) -> None:
        self._root = root
        self._stamp = stamp
        self._order = dict(order)
        try:
            self._distributed: Any = importlib.import_module("distributed")
            pickle: Any = importlib.import_module("cloudpickle")
        except ImportError as error:
            raise ProjectError(f"DASK is set, but there is no {error.name}") from error
        pickle.register_pickle_by_value(cluster_worker)
        try:
            self._client: Any = self._distributed.Client(address, timeout=20, set_as_default=False)
        except (OSError, ValueError) as error:
            raise ProjectError(f"no cluster answers at {address}: {error}") from error

    def run(self, jobs: Sequence[Job]) -> Iterator[tuple[int, Verdict]]:
        """The verdicts as they come, each with the place of its job."""
        sent = self._client.scatter(archive(self._root, SENT), broadcast=True, hash=True)
        groups = orders(jobs)
        futures = {
            self._client.submit(
                cluster_worker.carry_out, sent, PROGRAM, self._of(group, jobs), pure=False
            ): group
            for group in groups
        }
        try:
            done = self._distributed.as_completed(
                futures, with_results=True, loop=self._client.loop
            )
            for future, answer in done:
                yield from self._verdicts(answer, futures[future], jobs)
        finally:
            self._client.cancel(list(futures))

    def _of(self, group: Sequence[int], jobs: Sequence[Job]) -> dict[str, Any]:
        mutants = [list(jobs[place][2].identity) for place in group]
        return {**self._order, "unit": jobs[group[0]][0], "mutants": mutants}

    def _verdicts(
        self, answer: Mapping[str, Any], group: Sequence[int], jobs: Sequence[Job]
    ) -> Iterator[tuple[int, Verdict]]:
        if answer["stamp"] != self._stamp:
            raise ProjectError("a worker has other tools than there are here")
        if len(answer["verdicts"]) != len(group):
            raise ProjectError("a worker has not tried what it was to try")
        for place, outcome in zip(group, answer["verdicts"], strict=True):
            yield place, Verdict.of(jobs[place][2], outcome)

    def stop(self) -> None:
        """Leave the cluster."""
        self._client.close()


def orders(jobs: Sequence[Job]) -> list[list[int]]:
    """The places of the jobs, those of one function together, a few at a time."""
    groups: dict[tuple[str, str], list[int]] = {}
    for place, (unit, _, mutant) in enumerate(jobs):
        groups.setdefault((unit, mutant.function), []).append(place)
    return [
        group[start : start + ORDER]
        for group in groups.values()
        for start in range(0, len(group), ORDER)
    ]


def answer_order(
    read: Callable[[], str], carry_out: Callable[[Mapping[str, Any]], dict[str, Any]]
) -> int:
    """What `mutate.py --order` does: an order in, an answer out; all else goes to stderr."""
    out, sys.stdout = sys.stdout, sys.stderr
    try:
        answer = carry_out(json.loads(read()))
    finally:
        sys.stdout = out
    print(json.dumps(answer), flush=True)
    return 0
