# SPDX-License-Identifier: Apache-2.0
"""How long jobs take: as recorded for everybody, as seen in this clone, and what is left."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path

from keel.base.files import write_text

UNKNOWN = 10.0  # seconds, of a job whose kind was never seen
# Seconds that count as if they had gone as recorded, so that a run's first jobs say little.
PRIOR = 60.0


def read_times(path: Path) -> dict[str, float]:
    """Seconds by job; none if the file is not there or cannot be read."""
    try:
        entries = json.loads(path.read_text(encoding="utf-8")).items()
        return {str(label): float(seconds) for label, seconds in entries}
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def kind_of(label: str) -> str:
    """The kind in "unit/kind/name"."""
    return label.split("/")[1]


def estimates(labels: Iterable[str], seconds: Mapping[str, float]) -> dict[str, float]:
    """What each job may take; one never seen takes what its kind does on average."""
    kinds: dict[str, list[float]] = {}
    for label, taken in seconds.items():
        kinds.setdefault(kind_of(label), []).append(taken)
    usual = {kind: sum(values) / len(values) for kind, values in kinds.items()}
    return {label: seconds.get(label, usual.get(kind_of(label), UNKNOWN)) for label in labels}


class Times:
    """How long each job took last time, here or where it was recorded for everybody."""

    def __init__(self, path: Path, recorded: Path | None = None) -> None:
        self._path = path
        self.recorded = read_times(recorded) if recorded else {}
        self.seconds = {**self.recorded, **read_times(path)}
        self._noted: dict[str, float] = {}

    def of(self, kind: str, unit: str, name: str) -> float | None:
        """The last duration of a job, if it was ever run."""
        return self.seconds.get(f"{unit}/{kind}/{name}")

    def expected(self, label: str) -> float:
        """The last duration; a job never seen may be the longest of all, and should start first."""
        return self.seconds.get(label, float("inf"))

    def note(self, label: str, seconds: float) -> None:
        """Remember a duration."""
        self._noted[label] = seconds

    def save(self) -> None:
        """Keep for the next run, beside what another run may have kept meanwhile."""
        merged = {**read_times(self._path), **self._noted}
        write_text(self._path, json.dumps(merged, indent=1, sort_keys=True))


def recorded_anew(
    before: Mapping[str, float], seen: Mapping[str, float], complete: bool
) -> dict[str, float]:
    """The times to record: whole seconds, changed only where they are far off.

    After a complete run, jobs that are no more go.
    """
    kept = {label: old for label, old in before.items() if label in seen or not complete}
    for label, new in seen.items():
        old = kept.get(label)
        if old is None or abs(new - old) > max(2.0, 0.5 * old):
            kept[label] = max(1.0, float(f"{new:.2g}") if new >= 10 else round(new))
    return {label: int(kept[label]) for label in sorted(kept)}


def as_text(seconds: Mapping[str, float]) -> str:
    """Times as they are written, a job a line."""
    return json.dumps(seconds, indent=1, sort_keys=True) + "\n"


class Forecast:
    """How long a run will still take, from what its jobs should take and how fast it is."""

    def __init__(
        self, expected: Mapping[str, float], width: int, guessed: Collection[str] = ()
    ) -> None:
        """Take what each job should take, and of which that is a guess: they were never timed."""
        self._left = dict(expected)
        self._width = width
        self._unknown = set(guessed)
        self._should = self._did = PRIOR

    def known(self, label: str) -> None:
        """A job that need not run."""
        self._left.pop(label, None)

    def late(self, label: str) -> None:
        """A job that runs for longer than it should: nobody knows for how long it will."""
        self._unknown.add(label)

    def done(self, label: str, seconds: float) -> None:
        """A job that ran."""
        expected = self._left.pop(label, None)
        if expected is not None:
            self._should += expected
            self._did += seconds

    def seconds(self) -> float:
        """What is left: no less than the longest job takes."""
        if not self._left:
            return 0.0
        whole = max(sum(self._left.values()) / self._width, max(self._left.values()))
        return whole * self._did / self._should

    def text(self) -> str:
        """What is left, in words; nothing at the end. Where time is not known, it is not told."""
        if not self._unknown.isdisjoint(self._left):
            return f"{len(self._left)} job{'s' * (len(self._left) > 1)} left"
        seconds = self.seconds()
        if not seconds:
            return ""
        return "less than 1 min left" if seconds < 60 else f"about {seconds / 60:.0f} min left"
