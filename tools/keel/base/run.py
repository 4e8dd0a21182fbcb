# SPDX-License-Identifier: Apache-2.0
"""Runs programs: each with a limit of its processor time, in a session of its own, so that none
outlives its caller."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from keel.base import process_limits
from keel.base.errors import ROOT, ToolError

TIMEOUT_S = 300.0
LINES_OF_A_CRASH = 12
NOT_STARTED = 127
GRACE_S = 5.0
SANITIZER = ("runtime error:", "ERROR: AddressSanitizer")


@dataclass(frozen=True)
class Ended:
    """How a program ended: its exit status (negative: the signal) and what it wrote."""

    status: int
    output: str
    timed_out: bool = False
    errors: str = ""  # The other stream, when the two were kept apart.

    @property
    def good(self) -> bool:
        """Whether it came to its end by itself, with status 0."""
        return self.status == 0 and not self.timed_out

    @property
    def how(self) -> str:
        """In words."""
        if self.timed_out:
            return "hung: killed at the limit of its processor time, or as it did nothing"
        if self.status < 0:
            return f"crashed: {signal.Signals(-self.status).name}"
        return f"exit status {self.status}"

    @property
    def evidence(self) -> str:
        """The lines that say most about a crash: a sanitizer's first, or else the last ones."""
        lines = f"{self.output}{self.errors}".strip().splitlines()
        for number, line in enumerate(lines):
            if any(mark in line for mark in SANITIZER):
                return "\n".join(lines[number : number + LINES_OF_A_CRASH])
        return "\n".join(lines[-LINES_OF_A_CRASH:])


class Stopped(BaseException):
    """Everything is being stopped; nothing new may start. As Ctrl-C, it is nobody's to handle."""


class Running:
    """The programs that run now, whichever threads wait for them."""

    def __init__(self) -> None:
        self._children: set[subprocess.Popen[str]] = set()
        self._lock = threading.Lock()
        self._stopped = False

    def start(
        self, command: Sequence[str], cwd: Path, environment: Mapping[str, str], apart: bool
    ) -> subprocess.Popen[str]:
        """Start a program, unless everything is being stopped."""
        with self._lock:
            if self._stopped:
                raise Stopped
            child = subprocess.Popen(
                command,
                cwd=cwd,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE if apart else subprocess.STDOUT,
                text=True,
                errors="replace",
                start_new_session=True,
            )
            self._children.add(child)
        return child

    def ended(self, child: subprocess.Popen[str]) -> None:
        """Somebody has waited for the end of a program."""
        with self._lock:
            self._children.discard(child)

    def stop(self, grace_s: float) -> None:
        """End every program and start no other. First as Ctrl-C does, so that one which has started
        others itself can end them; then for certain, at once when Ctrl-C comes again."""
        with self._lock:
            self._stopped = True
        try:
            self._signal(signal.SIGINT)
            until = time.monotonic() + grace_s
            while self._children and time.monotonic() < until:
                time.sleep(0.05)
        finally:
            self._signal(signal.SIGKILL)

    def _signal(self, number: signal.Signals) -> None:
        """Signal the sessions of all programs."""
        with self._lock:
            for child in self._children:
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(child.pid, number)


RUNNING = Running()


def stop_all(grace_s: float = GRACE_S) -> None:
    """End every program that `run` has started in any thread, and let it start no other."""
    RUNNING.stop(grace_s)


def run(
    command: Sequence[str | Path],
    timeout_s: float | None = TIMEOUT_S,
    *,
    cwd: Path = ROOT,
    environment: Mapping[str, str] | None = None,
    apart: bool = False,
) -> Ended:
    """Run a program, for at most so many seconds of processor time (limits.py).

    Variables are added to ours. Its two output streams are one, unless `apart`. A program that is
    missing ends with 127.
    """
    try:
        words = [str(word) for word in command]
        child = RUNNING.start(words, cwd, {**os.environ, **(environment or {})}, apart)
    except OSError as error:
        return Ended(NOT_STARTED, f"{command[0]}: {error.strerror}")
    try:
        return _end_of(child, timeout_s)
    finally:
        RUNNING.ended(child)


def _end_of(child: subprocess.Popen[str], timeout_s: float | None) -> Ended:
    """Wait for the end of a program, or make one."""
    try:
        output, errors = process_limits.communicate(child, timeout_s)
    except BaseException as error:
        # The whole session: a child of the program would keep the pipe open.
        os.killpg(child.pid, signal.SIGKILL)
        output, errors = child.communicate()
        if not isinstance(error, subprocess.TimeoutExpired):
            raise
        return Ended(child.returncode, output, timed_out=True, errors=errors or "")
    return Ended(child.returncode, output, errors=errors or "")


def output_of(
    command: Sequence[str | Path],
    timeout_s: float | None = TIMEOUT_S,
    *,
    cwd: Path = ROOT,
    environment: Mapping[str, str] | None = None,
) -> str:
    """What a program prints; when it does not end well, that and its words are the error."""
    ended = run(command, timeout_s, cwd=cwd, environment=environment, apart=True)
    if not ended.good:
        words = f"{ended.errors}{ended.output}".strip()
        raise ToolError(f"{Path(command[0]).name}: {ended.how}\n{words}".strip())
    return ended.output
