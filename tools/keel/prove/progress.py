# SPDX-License-Identifier: Apache-2.0
"""The jobs that run now: names those that take long, again whenever they have run twice as long."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from keel.prove.driver import Job

PATIENCE_S = 60.0
# A job that was timed is not late before it has taken so many times as long.
LATE = 2.0


class Running:
    """Knows which jobs run since when; they start in threads of their own."""

    def __init__(
        self,
        tell: Callable[[Job, float], None],
        expected: Callable[[Job], float | None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Take what hears of a job that is late, with its seconds, and what a job should take."""
        self._tell = tell
        self._expected = expected
        self._clock = clock
        # When each began, and at how many seconds it is named next.
        self._since: dict[str, tuple[Job, float]] = {}
        self._next: dict[str, float] = {}
        self._lock = threading.Lock()

    @contextlib.contextmanager
    def now(self, job: Job) -> Iterator[None]:
        """While a job runs."""
        with self._lock:
            self._since[job.label] = (job, self._clock())
            patience = max(PATIENCE_S, LATE * (self._expected(job) or 0.0))
            self._next.setdefault(job.label, patience)
        try:
            yield
        finally:
            with self._lock:
                self._since.pop(job.label)

    def look(self) -> None:
        """Name what is late."""
        with self._lock:
            since = list(self._since.values())
        for job, start in since:
            seconds = self._clock() - start
            if seconds >= self._next[job.label]:
                self._next[job.label] = 2 * seconds
                self._tell(job, seconds)
