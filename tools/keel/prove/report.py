# SPDX-License-Identifier: Apache-2.0
"""What a run found out, for machines (report.json) and for people (the console)."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from keel.audit import determined
from keel.audit.theorems import labels
from keel.base.source import STAMP, stamp_of
from keel.c.project import KEEL, Unit
from keel.install import Found
from keel.judge import cbmc_answers
from keel.judge.settings import Exceptions
from keel.prove.driver import FIRST, Job, Outcome
from keel.prove.times import Forecast, Times, estimates

# Where it stands what helps a proof that takes too long.
PAGE = KEEL / "docs" / "finding_a_proof.md"
HELP = f"{PAGE.relative_to(Path.cwd()) if PAGE.is_relative_to(Path.cwd()) else PAGE}#what-helps"
EXPLAINED = 5  # commands that a summary names


@dataclass
class UnitResult:
    """All that is known about one unit."""

    unit: Unit
    exceptions: Exceptions
    goals: list[dict[str, str]] = field(default_factory=list)
    listed: list[str] = field(default_factory=list)
    smoke: int = 0
    accepted: list[str] = field(default_factory=list)
    stale: list[str] = field(default_factory=list)
    pruned: list[str] = field(default_factory=list)
    harnesses: dict[str, dict[str, Any]] = field(default_factory=dict)
    negative: dict[str, bool] = field(default_factory=dict)
    bounds: list[dict[str, str]] = field(default_factory=list)
    wrong_bounds: dict[str, bool] = field(default_factory=dict)
    problems: list[str] = field(default_factory=list)
    # What determines each function.
    outcomes: list[determined.Outcome] = field(default_factory=list)
    # How long each job took when its verdict was had: KIND/NAME.
    seconds: dict[str, float] = field(default_factory=dict)

    @property
    def wp_total(self) -> int:
        """Goals made or listed: one that has vanished counts, and not as proved."""
        return len({goal["name"] for goal in self.goals} | set(self.listed))

    @property
    def wp_proved(self) -> int:
        """Goals proved."""
        return len({goal["name"] for goal in self.goals if goal["status"] == "Valid"})

    def _sum(self, key: str) -> int:
        return sum(int(harness[key]) for harness in self.harnesses.values())

    @property
    def cbmc_total(self) -> int:
        """Properties of the harnesses."""
        return self._sum("properties")

    @property
    def cbmc_proved(self) -> int:
        """Properties proved."""
        return self._sum("proved")

    @property
    def assertions_only(self) -> list[str]:
        """The harnesses that leave all other checks to others."""
        return [name for name, one in self.harnesses.items() if one["checks"] == "assertions"]

    @property
    def gappa_total(self) -> int:
        """Bounds of rounding errors."""
        return len(self.bounds)

    @property
    def gappa_proved(self) -> int:
        """Bounds proved."""
        return sum(bound["status"] == "Valid" for bound in self.bounds)

    def add(self, outcome: Outcome) -> None:
        """Take in a job's result."""
        job, result = outcome.job, outcome.result
        self.problems += outcome.problems
        self.seconds[f"{job.kind}/{job.name}"] = float(result["seconds"])
        if job.kind == "wp":
            self.goals += [{**goal, "target": job.name} for goal in result["goals"]]
            self.smoke += result["smoke"]
            self.stale += result["stale"]
            self.pruned += result["pruned"]
            self.accepted += [text for text in result["allowed"] if text not in self.accepted]
        elif job.kind == "cbmc":
            self.harnesses[job.name] = _harness(result, not outcome.problems)
        elif job.kind == "gappa":
            self.bounds += result["goals"]
        elif job.kind == "gappa-negative":
            self.wrong_bounds[job.name] = not outcome.problems
        else:
            self.negative[job.name] = not outcome.problems


def _harness(result: Mapping[str, Any], sound: bool) -> dict[str, Any]:
    """A harness in the report: numbers, and its assertions, to be joined with requirements."""
    properties = result["properties"]
    return {
        "properties": len(properties),
        "proved": sum(item["status"] == "SUCCESS" for item in properties),
        "sound": sound,
        "assertions": [
            {key: item[key] for key in ("name", "description", "status")}
            for item in properties
            if cbmc_answers.ASSERTION.search(item["name"])
        ],
        "defines": result["defines"],
        "replaces": result["replaces"],
        "checks": result["checks"],
        "coverage": {"blocks": result["blocks"], "reached": result["covered"]},
    }


def unproved(outcome: Outcome) -> list[str]:
    """The names under which --explain knows what a job did not prove."""
    job, result = outcome.job, outcome.result
    if job.kind == "wp":
        return [goal["name"] for goal in result["goals"] if goal["status"] != "Valid"]
    if job.kind == "cbmc" and any(one["status"] != "SUCCESS" for one in result["properties"]):
        return [job.name]
    return [job.name] if job.kind == "negative" and outcome.problems else []


@dataclass
class Gathered:
    """The results of a run."""

    units: dict[str, UnitResult]
    engines: Sequence[str]
    problems: list[str] = field(default_factory=list)
    # Verdicts that were known, and those that were had now.
    known: int = 0
    fresh: int = 0
    # The unit and the name of what is not proved, as --explain takes it.
    open: list[tuple[str, str]] = field(default_factory=list)
    outcomes: list[Outcome] = field(default_factory=list)
    # What the report of a shard has besides; it says nothing about the whole.
    shard: dict[str, Any] = field(default_factory=dict)
    # The source as it was when the run began: a change meanwhile must not pass as proved.
    stamp: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Look at the project that the units are of."""
        roots = {result.unit.root for result in self.units.values()}
        self.stamp = stamp_of(min(roots)) if roots else {}

    def add(self, outcome: Outcome) -> None:
        """Take in a job's result."""
        self.units[outcome.job.unit].add(outcome)
        self.outcomes.append(outcome)
        self.open += [(outcome.job.unit, name) for name in unproved(outcome)]
        self.known += outcome.cached
        self.fresh += not outcome.cached

    @property
    def requirements(self) -> set[str]:
        """Those of which a goal or an assertion is proved, and none is not."""
        goals = {
            text: one.get("status") in ("Valid", "SUCCESS")
            for outcome in self.outcomes
            for kind in ("goals", "properties")
            for one in outcome.result.get(kind, ())
            for text in (f"{outcome.job.label} {one.get('name')} {one.get('description', '')}",)
        }
        proved = labels(text for text, good in goals.items() if good)
        return proved - labels(text for text, good in goals.items() if not good)

    @property
    def wp_total(self) -> int:
        """WP's goals."""
        return sum(unit.wp_total for unit in self.units.values())

    @property
    def wp_proved(self) -> int:
        """WP's goals that are proved."""
        return sum(unit.wp_proved for unit in self.units.values())

    @property
    def cbmc_total(self) -> int:
        """CBMC's properties."""
        return sum(unit.cbmc_total for unit in self.units.values())

    @property
    def cbmc_proved(self) -> int:
        """CBMC's properties that are proved."""
        return sum(unit.cbmc_proved for unit in self.units.values())

    @property
    def gappa_total(self) -> int:
        """Gappa's goals."""
        return sum(unit.gappa_total for unit in self.units.values())

    @property
    def gappa_proved(self) -> int:
        """Gappa's goals that are proved."""
        return sum(unit.gappa_proved for unit in self.units.values())

    @property
    def total(self) -> int:
        """All goals."""
        return self.wp_total + self.cbmc_total + self.gappa_total

    @property
    def proved(self) -> int:
        """All goals that are proved."""
        return self.wp_proved + self.cbmc_proved + self.gappa_proved

    @property
    def decided(self) -> list[determined.Outcome]:
        """What determines each function."""
        return [one for unit in self.units.values() for one in unit.outcomes]

    @property
    def all_problems(self) -> list[str]:
        """Every reason why this is not a success."""
        texts = [*self.problems, *(text for unit in self.units.values() for text in unit.problems)]
        return list(dict.fromkeys(texts))

    @property
    def success(self) -> bool:
        """True when all is proved, and there is something to prove."""
        if self.shard:
            return not self.all_problems
        return not self.all_problems and 0 < self.total == self.proved


KINDS = {
    "wp": ("WP", "goals"),
    "cbmc": ("CBMC", "properties"),
    "negative": ("CBMC", "wrong bodies refuted"),
    "gappa": ("Gappa", "goals"),
    "gappa-negative": ("Gappa", "wrong bounds refused"),
}


class Console:
    """Tells people how far the run is: a line for each job that ran, and for each unit."""

    def __init__(self, jobs: Sequence[Job], times: Times, width: int) -> None:
        labels = [job.label for job in jobs]
        guessed = [label for label in labels if label not in times.seconds]
        self._forecast = Forecast(estimates(labels, times.seconds), width, guessed)
        self._waiting = [(job.unit, job.kind) for job in jobs]
        self._sums: dict[tuple[str, str], tuple[int, int, float]] = {}
        self._theorems = sorted(
            {job.name.partition(":")[0] for job in jobs if job.kind == FIRST and ":" in job.name}
        )
        self._doubtful = False
        self._start = time.monotonic()

    def done(self, outcome: Outcome) -> None:
        """A job has its verdict."""
        job = outcome.job
        proved, total = self._numbers(outcome)
        seconds = 0.0 if outcome.cached else float(outcome.result["seconds"])
        if outcome.cached:
            self._forecast.known(job.label)
        else:
            self._forecast.done(job.label, seconds)
        if not outcome.cached and total:
            self._line(job, job.name, proved, total, seconds, self._forecast.text())
        for text in outcome.problems:
            print(f"    FAILED {text}", flush=True)
        for text in () if outcome.cached else outcome.result.get("stale", ()):
            print(f"    note   {text}", flush=True)
        kind = (job.unit, job.kind)
        before = self._sums.get(kind, (0, 0, 0.0))
        self._sums[kind] = (before[0] + proved, before[1] + total, before[2] + seconds)
        self._waiting.remove(kind)
        if kind not in self._waiting:
            self._line(job, "", *self._sums[kind])
        if job.kind == FIRST:
            self._doubtful = self._doubtful or bool(outcome.problems) or proved < total
            self._first_verdict(outcome)

    def _first_verdict(self, last: Outcome) -> None:
        """Tell that WP has proved all that it is asked, while other engines have work left."""
        left = {kind for _unit, kind in self._waiting}
        if last.cached or self._doubtful or FIRST in left or not left:
            return
        total = sum(numbers[1] for (_unit, kind), numbers in self._sums.items() if kind == FIRST)
        theorems = f", and the theorems of {', '.join(self._theorems)}" if self._theorems else ""
        minutes = (time.monotonic() - self._start) / 60
        print(
            f"first verdict, after {minutes:.1f} min: WP proves all of its {total} goals, the"
            f" contracts' clauses{theorems}; equality with the models and wrong bodies follow",
            flush=True,
        )

    def late(self, job: Job, seconds: float) -> None:
        """A job takes long: name it, and where it stands what helps."""
        self._forecast.late(job.label)
        start = f"{job.unit:<10} {KINDS[job.kind][0]:<5} {job.name:<37}"
        print(
            f"{start} still runs after {seconds / 60:.0f} min: what helps, see {HELP}", flush=True
        )

    @staticmethod
    def _numbers(outcome: Outcome) -> tuple[int, int]:
        result = outcome.result
        if outcome.job.kind in ("wp", "gappa"):
            return sum(goal["status"] == "Valid" for goal in result["goals"]), len(result["goals"])
        if outcome.job.kind == "cbmc":
            properties = result["properties"]
            return sum(item["status"] == "SUCCESS" for item in properties), len(properties)
        return int(not outcome.problems), 1

    @staticmethod
    def _line(job: Job, name: str, proved: int, total: int, seconds: float, left: str = "") -> None:
        engine, what = KINDS[job.kind]
        time = f"{seconds:.0f} s" if seconds else "known"
        numbers = f"{proved:>4} of {total:>4} {what}"
        text = f"{job.unit:<10} {engine:<5} {name:<37} {numbers}  {time:<7}{left}"
        print(text.rstrip(), flush=True)


def typed(unit: str, arguments: str) -> str:
    """The command that proves with these arguments; keel.mk says how its projects do."""
    call = os.environ.get("KEEL_CALL", "make prove UNIT={unit} ARGS={arguments}")
    return call.replace("{unit}", unit).replace("{arguments}", f"'{arguments}'")


def closing_lines(gathered: Gathered) -> list[str]:
    """What is wrong and was not told when a job ended, and whether all is well, and proved."""
    told = {text for outcome in gathered.outcomes for text in outcome.problems}
    lines = [f"FAILED {text}" for text in gathered.all_problems if text not in told]
    if told:
        lines.append("all that failed, together: build/prove/summary.md")
    lines += [
        f"to see why: {typed(unit, f'--explain {name}')}"
        for unit, name in gathered.open[:EXPLAINED]
    ]
    if given_up := [one.job for one in gathered.outcomes if one.result.get("gave_up")]:
        again = typed(f"'{' '.join(dict.fromkeys(job.unit for job in given_up))}'", "--patience 8")
        lines.append(
            f"provers gave up on {len(given_up)} jobs, which refutes nothing: more time may help,"
            f" {again}"
        )
    for name, unit in gathered.units.items():
        if unit.exceptions.not_by_wp and "wp" in gathered.engines:
            left = len(unit.exceptions.not_by_wp)
            lines.append(
                f"{name}: the postconditions of {left} functions are left to CBMC,"
                " see proofs/units.toml"
            )
    alone = [name for unit in gathered.units.values() for name in unit.assertions_only]
    if alone:
        lines.append(f"checked for assertions and unwinding alone: {', '.join(alone)}")
    if stale := sum(len(unit.stale) for unit in gathered.units.values()):
        lines.append(f"{stale} goals have a better prover than is recorded: run --update-goals")
    lines.append(f"verdicts: {gathered.known} known before, {gathered.fresh} had now")
    engines = f"WP {gathered.wp_proved}, CBMC {gathered.cbmc_proved}, Gappa {gathered.gappa_proved}"
    if gathered.decided:
        lines.append(determined.summary(gathered.decided))
    if gathered.shard:
        lines.append(f"shard {gathered.shard['shard']}: see --join for the verdict on the whole")
    return [
        *lines,
        f"{failed(gathered.all_problems)}proved {gathered.proved} of {gathered.total}"
        f" goals ({engines})",
    ]


def failed(problems: Sequence[str]) -> str:
    """What the last line begins with when all goals may be proved, and something else is wrong."""
    return f"FAILED, {len(problems)} problem{'s' * (len(problems) > 1)}: " if problems else ""


def _tool(found: Found) -> dict[str, Any]:
    return {"version": found.version, "sha256": found.sha256, "parts": found.parts}


def content(
    gathered: Gathered, tools: Mapping[str, Found], seconds: float, partial: bool
) -> dict[str, Any]:
    """The report."""
    report: dict[str, Any] = {"verdict": "proved" if gathered.success else "failed"}
    if partial or gathered.shard:
        report["partial"] = True
    report |= gathered.shard
    return report | {
        "goals": gathered.total,
        "proved": gathered.proved,
        "verdicts": {"known": gathered.known, "fresh": gathered.fresh},
        "problems": gathered.all_problems,
        "units": {name: _unit(result, gathered.engines) for name, result in gathered.units.items()},
        "tools": {name: _tool(found) for name, found in tools.items()},
        "seconds": round(seconds, 1),
        STAMP: gathered.stamp,
    }


def _unit(result: UnitResult, engines: Sequence[str]) -> dict[str, Any]:
    exceptions = result.exceptions
    outcomes = [outcome.as_dict() for outcome in result.outcomes]
    entry: dict[str, Any] = {
        "problems": result.problems,
        "determined": outcomes,
        "seconds": dict(sorted(result.seconds.items())),
    }
    if "wp" in engines:
        entry["wp"] = {
            "goals": result.wp_total,
            "proved": result.wp_proved,
            "smoke_tests": result.smoke,
            "accepted_warnings": {text: exceptions.warnings[text] for text in result.accepted},
            "stale_provers": result.stale,
            "not_proved_here": exceptions.no_body,
            "not_by_wp": exceptions.not_by_wp,
            "by_cbmc": exceptions.by_cbmc,
            "goal_list": sorted(result.goals, key=lambda goal: goal["name"]),
        }
    if "cbmc" in engines:
        harnesses = result.harnesses
        entry["cbmc"] = {
            "properties": result.cbmc_total,
            "proved": result.cbmc_proved,
            "coverage": {
                key: sum(harness["coverage"][key] for harness in harnesses.values())
                for key in ("blocks", "reached")
            },
            "negative": {
                "bodies": len(result.negative),
                "refuted": sum(result.negative.values()),
                "list": result.negative,
            },
            "assertions_only": result.assertions_only,
            "without_harness": exceptions.no_harness,
            "harnesses": harnesses,
        }
    if "gappa" in engines:
        entry["gappa"] = {
            "goals": result.gappa_total,
            "proved": result.gappa_proved,
            "negative": {
                "bounds": len(result.wrong_bounds),
                "refused": sum(result.wrong_bounds.values()),
                "list": result.wrong_bounds,
            },
            "goal_list": result.bounds,
        }
    return entry


def as_text(report: Mapping[str, Any]) -> str:
    """As it is written."""
    return json.dumps(report, indent=1) + "\n"
