# SPDX-License-Identifier: Apache-2.0
"""Splits the jobs of a whole run between machines, and joins what each of them reports."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.verdict_cache import digest
from keel.c.project import ProjectError
from keel.prove.driver import Job, Outcome
from keel.prove.times import estimates


@dataclass(frozen=True)
class Shard:
    """One of several parts."""

    number: int
    of: int

    def __str__(self) -> str:
        return f"{self.number}/{self.of}"

    @property
    def file_name(self) -> str:
        """Its report."""
        return f"shard-{self.number}-of-{self.of}.json"


def read_shard(text: str) -> Shard:
    """The shard that "2/4" names."""
    match = re.fullmatch(r"(\d+)/(\d+)", text)
    if not match or not 1 <= int(match[1]) <= int(match[2]):
        raise ValueError(f"{text!r} is no shard; 2/4 is the second of four")
    return Shard(int(match[1]), int(match[2]))


def part(jobs: Sequence[Job], shard: Shard, recorded: Mapping[str, float]) -> list[Job]:
    """The jobs of a shard: the longest goes first, each to the part that has least to do.

    Only recorded times count: every machine must come to the same parts.
    """
    expected = estimates([job.label for job in jobs], recorded)
    loads = [0.0] * shard.of
    own = []
    for job in sorted(jobs, key=lambda job: (-expected[job.label], job.label)):
        lightest = loads.index(min(loads))
        loads[lightest] += expected[job.label]
        if lightest == shard.number - 1:
            own.append(job)
    return own


def origin(
    jobs: Sequence[Job], stamps: Mapping[str, Mapping[str, str]], commit: str
) -> dict[str, str]:
    """What a report was made of: the tools, by engine, the text behind every job of the whole run,
    and the commit."""
    tools = {engine: dict(stamp) for engine, stamp in stamps.items()}
    source = {job.label: job.key() for job in jobs}
    return {"tools": digest(tools), "source": digest(source), "commit": commit}


def entries(
    shard: Shard, made_of: Mapping[str, str], outcomes: Sequence[Outcome]
) -> dict[str, Any]:
    """What a shard's report has besides what every report has."""
    return {
        "shard": str(shard),
        "origin": dict(made_of),
        "outcomes": {outcome.job.label: outcome.result for outcome in outcomes},
    }


def joined(jobs: Sequence[Job], files: Sequence[Path], made_of: Mapping[str, str]) -> list[Outcome]:
    """The outcome of every job, from the reports of all shards."""
    results = _results(files, made_of)
    missing = [job.label for job in jobs if job.label not in results]
    if missing:
        raise ProjectError(f"no report has {', '.join(missing[:5])}; {len(missing)} are missing")
    return [Outcome(job, results[job.label], cached=True) for job in jobs]


def _results(files: Sequence[Path], made_of: Mapping[str, str]) -> dict[str, dict[str, Any]]:
    """All results by job, after a look at whether the reports belong together."""
    seen: dict[Shard, Path] = {}
    results: dict[str, dict[str, Any]] = {}
    for path in files:
        shard, report = _read(path)
        for what in ("tools", "source", "commit"):
            if report["origin"].get(what) != made_of[what]:
                raise ProjectError(f"{path}: made with another {what} than there is here")
        if shard in seen:
            raise ProjectError(f"{path}: shard {shard} is also in {seen[shard]}")
        if any(other.of != shard.of for other in seen):
            raise ProjectError(f"{path}: shard {shard} is of another division than the others")
        seen[shard] = path
        for label, result in report["outcomes"].items():
            if label in results:
                raise ProjectError(f"{path}: another report has {label}, too")
            results[label] = result
    of = next(iter(seen)).of
    shards = [Shard(number + 1, of) for number in range(of)]
    if absent := [str(shard) for shard in shards if shard not in seen]:
        raise ProjectError(f"the report of shard {', '.join(absent)} is missing")
    return results


def _read(path: Path) -> tuple[Shard, dict[str, Any]]:
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
        results = report["outcomes"].values()
        sound = all("problems" in result and "seconds" in result for result in results)
        if not sound or not isinstance(report["origin"], dict):
            raise KeyError
        return read_shard(report["shard"]), report
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise ProjectError(f"{path}: no report of a shard") from error
