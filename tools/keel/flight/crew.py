# SPDX-License-Identifier: Apache-2.0
"""Flies scenarios, several at a time: a process for each, as there is one copter in a process."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.errors import ToolError
from keel.flight import board, judge, plots
from keel.flight.board_tasks import BoardTask
from keel.flight.library import Copter
from keel.flight.loop import Order, Trace, fly, state_names, without_faults

INTERRUPTED = 130  # As a shell tells it.
PATIENCE_S = 10.0
COPTERS: dict[str, Copter] = {}  # Of this process, by the library's path.


@dataclass(frozen=True)
class Job:
    """A flight to be made and judged; `picture` is where it is drawn, `log` where its log goes, if
    it is wanted, and `trace` whether that has each run of a task."""

    name: str
    order: Order
    library: Path
    picture: Path | None = None
    log: Path | None = None
    trace: bool = False


@dataclass(frozen=True)
class Outcome:
    """What became of it."""

    name: str
    plant: str
    seed: int
    good: bool
    findings: list[judge.Finding]
    measured: dict[str, float]
    states: list[str]
    digest: str
    expects_failure: bool
    armed_s: float
    tasks: Sequence[BoardTask] = ()  # Of a board's image, each with its longest run.

    @property
    def broken(self) -> list[judge.Finding]:
        """The limits that do not hold."""
        return [finding for finding in self.findings if not finding.good]

    def as_json(self) -> dict[str, Any]:
        """For reports."""
        return {
            "name": self.name,
            "plant": self.plant,
            "seed": self.seed,
            "good": self.good,
            "expects_failure": self.expects_failure,
            "states": self.states,
            "armed_after_s": self.armed_s,
            "sha256": self.digest,
            "measured": self.measured,
            "limits": [finding.as_json() for finding in self.findings],
            **({"tasks": [task.as_json() for task in self.tasks]} if self.tasks else {}),
        }


def copter_of(library: Path) -> Copter:
    """The copter of this process."""
    if str(library) not in COPTERS:
        COPTERS[str(library)] = board.made_of(library)
    return COPTERS[str(library)]


def flown(job: Job) -> Outcome:
    """Make a flight, and the unbroken one that it is compared with."""
    copter, order = copter_of(job.library), job.order
    trace = fly(copter, order, job.log, job.trace)
    tasks = copter.timed()
    unbroken: Trace | None = None
    if order.scenario.limits.without_fault_deg is not None:
        unbroken = fly(copter, without_faults(order))
    findings = judge.judged(order.scenario, trace, unbroken)
    if job.picture and len(trace.truth):
        title = f"{job.name} in {order.plant}"
        plots.plot_flight(title, order.scenario, trace, job.picture)
    return Outcome(
        job.name,
        order.plant,
        order.seed,
        judge.is_good(order.scenario, trace, findings),
        findings,
        judge.measured(order.scenario, trace, unbroken),
        state_names(trace),
        trace.digest,
        order.scenario.expects_failure,
        trace.armed_s,
        tasks,
    )


def all_flown(jobs: Sequence[Job], width: int) -> Iterator[tuple[int, Outcome]]:
    """The outcomes as they come, each with the place of its job."""
    pool = ProcessPoolExecutor(
        width, mp_context=multiprocessing.get_context("spawn"), initializer=leave_ctrl_c
    )
    try:
        futures = {pool.submit(flown, job): place for place, job in enumerate(jobs)}
        for future in as_completed(futures):
            yield futures[future], future.result()
    except BrokenProcessPool as error:
        raise ToolError("a flight crashed: the copter's library ended its process") from error
    except BaseException:
        end_soon()
        raise
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def end_soon() -> None:
    """Nobody waits for flights that nobody wants any more; nor for long for the pool's threads,
    which may wait for a lock that a killed one held."""
    for child in multiprocessing.active_children():
        child.kill()
    watchdog = threading.Timer(PATIENCE_S, os._exit, (INTERRUPTED,))
    watchdog.daemon = True
    watchdog.start()


def leave_ctrl_c() -> None:
    """Ctrl-C is for the process that asked for the flights, and which ends this one."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
