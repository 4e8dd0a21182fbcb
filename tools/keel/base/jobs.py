# SPDX-License-Identifier: Apache-2.0
"""Runs jobs side by side, and the programs that they start; none outlives the driver."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Protocol, TypeVar

from keel.base import process_limits

T = TypeVar("T")


class Stopped(Exception):
    """The driver is being stopped; nothing new may start."""


@dataclass(frozen=True)
class Finished:
    """What a program left behind."""

    status: int
    output: str
    timed_out: bool = False


class Runner:
    """Starts programs in process groups of their own, so that all of a group can be ended."""

    def __init__(self, environment: dict[str, str], folder: Path) -> None:
        """Take the whole environment, and the folder in which programs run."""
        # Frama-C believes PWD rather than its working directory.
        self._environment = {**environment, "PWD": str(folder), "LC_ALL": "C"}
        self._folder = folder
        self._running: set[subprocess.Popen[str]] = set()
        self._lock = threading.Lock()
        self._stopped = False

    def run(
        self,
        command: Sequence[str],
        timeout: float | None = None,
        merged: bool = True,
        extra: dict[str, str] | None = None,
    ) -> Finished:
        """Run a program to its end; its output is both streams, or stdout if not `merged`.

        The time-out is of processor time (limits.py).
        """
        process = self._start(command, merged, {**self._environment, **(extra or {})})
        try:
            output, _ = process_limits.communicate(process, timeout)
            return Finished(process.returncode, output)
        except subprocess.TimeoutExpired:
            self._kill(process)
            output, _ = process.communicate()
            return Finished(-1, output, timed_out=True)
        except BaseException:
            self._kill(process)
            raise
        finally:
            with self._lock:
                self._running.discard(process)

    def run_until(self, command: Sequence[str], enough: Callable[[str], bool]) -> str:
        """Run a program until it has said enough; all that it has said by then."""
        process = self._start(command, True, self._environment)
        said: list[str] = []
        try:
            assert process.stdout
            for line in process.stdout:
                said.append(line)
                if enough(line):
                    break
            return "".join(said)
        finally:
            self._kill(process)
            process.communicate()
            with self._lock:
                self._running.discard(process)

    def stop(self) -> None:
        """End every program and start no other."""
        with self._lock:
            self._stopped = True
            running = list(self._running)
        for process in running:
            self._kill(process)

    def _start(
        self, command: Sequence[str], merged: bool, environment: dict[str, str]
    ) -> subprocess.Popen[str]:
        with self._lock:
            if self._stopped:
                raise Stopped
            process = subprocess.Popen(
                list(command),
                cwd=self._folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                text=True,
                errors="replace",
                start_new_session=True,
                stderr=subprocess.STDOUT if merged else subprocess.DEVNULL,
            )
            self._running.add(process)
        return process

    @staticmethod
    def _kill(process: subprocess.Popen[str]) -> None:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass


def end_as_by_ctrl_c() -> None:
    """Let a request to end (from CI, or `timeout`) clean up as Ctrl-C does."""

    def interrupt(_number: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, interrupt)


class Stoppable(Protocol):
    """Something that starts programs and can end them all."""

    def stop(self) -> None:
        """End every program and start no other."""


def in_pool(
    tasks: Sequence[Callable[[], T]],
    width: int,
    runner: Stoppable,
    look: Callable[[], None] = lambda: None,
) -> Iterator[tuple[int, T]]:
    """Run tasks, `width` at a time, in their order; yield index and result as each finishes.

    `look` is called now and then while they run.
    """
    pool = ThreadPoolExecutor(max_workers=width)
    futures: dict[Future[T], int] = {}
    complete = False
    try:
        for index, task in enumerate(tasks):
            futures[pool.submit(task)] = index
        waiting = set(futures)
        while waiting:
            # A timeout lets Ctrl-C through.
            done, waiting = wait(waiting, timeout=0.5, return_when=FIRST_COMPLETED)
            look()
            for future in done:
                yield futures[future], future.result()
        complete = True
    finally:
        if not complete:
            runner.stop()
        pool.shutdown(wait=True, cancel_futures=True)
