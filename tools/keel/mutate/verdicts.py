# SPDX-License-Identifier: Apache-2.0
"""What became of mutants: accepted reasons, numbers, the report and whether it is still true."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from keel.c.project import ProjectError
from keel.mutate.operators import Mutant

Identity = tuple[str, str, str, int]
# What a verdict says of a harness that was executed, before the number of the input.
EXECUTED = " (executed, input "
# What a verdict says of WP when that had no proof of the code as it is.
UNPROVED = "the function is not proved unchanged"
# Why a mutant makes no difference if nobody has to say so.
SAME_CODE = "same object code"
STATUSES = ("killed", "survived", "undecided", "equivalent", "stillborn", "skipped")


@dataclass
class Verdict:
    """What became of a mutant."""

    mutant: Mutant
    status: str = "survived"
    reason: str = ""
    engines: dict[str, str] = field(default_factory=dict)

    def as_dict(self) -> dict[str, Any]:
        """For the report."""
        mutant = self.mutant
        return {
            "function": mutant.function,
            "kind": mutant.kind,
            "line": mutant.line,
            "original": mutant.before,
            "mutant": mutant.after,
            "occurrence": mutant.occurrence,
            "status": self.status,
            "reason": self.reason,
            "engines": self.engines,
        }

    @property
    def outcome(self) -> dict[str, Any]:
        """What is kept, or sent from where the mutant was tried."""
        return {"status": self.status, "reason": self.reason, "engines": self.engines}

    @property
    def is_lasting(self) -> bool:
        """Whether who asks again gets the same. Where WP did not prove the code as it is, a prover
        may have been interrupted, or have had no time on a busy machine."""
        return UNPROVED not in self.engines.values()

    @classmethod
    def of(cls, mutant: Mutant, outcome: Mapping[str, Any]) -> Verdict:
        """The verdict on a mutant, from what was kept or sent."""
        return cls(mutant, outcome["status"], outcome["reason"], dict(outcome["engines"]))


def read_equivalent(path: Path) -> dict[Identity, str]:
    """proofs/UNIT/equivalent.toml: survivors that a person has accepted, each with the reason.

    [[equivalent]]
    function = "open_slot"
    original = "for (uint32_t i = queue->count; i > place; i--) {"
    mutant = "for (uint32_t i = queue->count; i != place; i--) {"
    reason = "place never exceeds count, so the loop ends at place either way"
    """
    raw = tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    found: dict[Identity, str] = {}
    for entry in raw.get("equivalent", []):
        wanted = {"function", "original", "mutant", "reason"}
        if not wanted <= set(entry) <= wanted | {"occurrence"} or not entry["reason"].strip():
            raise ProjectError(f"{path}: each entry needs {', '.join(sorted(wanted))}")
        occurrence = int(entry.get("occurrence", 1))
        found[entry["function"], entry["original"], entry["mutant"], occurrence] = entry["reason"]
    return found


def count(verdicts: Sequence[Verdict], status: str) -> int:
    """How many mutants have a status."""
    return sum(verdict.status == status for verdict in verdicts)


def settle(
    verdicts: Sequence[Verdict], accepted: Mapping[Identity, str], complete: bool
) -> list[str]:
    """Apply the accepted reasons to survivors; what is left to complain about."""
    problems = []
    unused = dict(accepted)
    for verdict in verdicts:
        reason = unused.pop(verdict.mutant.identity, None)
        if reason is None:
            continue
        if verdict.status in ("survived", "undecided"):
            verdict.status, verdict.reason = "equivalent", reason
        elif verdict.status != "skipped":
            problems.append(f"equivalent.toml: needless, it is {verdict.status}: {verdict.mutant}")
    if complete:
        problems += [
            f"equivalent.toml: there is no such mutant: {' | '.join(map(str, identity))}"
            for identity in unused
        ]
    return problems


def table(verdicts: Sequence[Verdict], engines: Sequence[str]) -> list[str]:
    """Numbers of the run, by engine and by kind of mutant."""
    lines = []
    for engine in engines:
        asked = [verdict for verdict in verdicts if engine in verdict.engines]
        killed = sum(verdict.engines[engine].startswith("killed") for verdict in asked)
        lines.append(f"{engine.upper():<5} killed {killed:>3} of {len(asked):>3} that it saw")
        if executed := sum(EXECUTED in verdict.engines[engine] for verdict in asked):
            lines[-1] += f", {executed} by executions of its harnesses"
    for kind, (killed, of) in by_kind(verdicts).items():
        lines.append(f"{kind:<10} killed {killed:>4} of {of:>4}")
    return lines


def by_kind(verdicts: Sequence[Verdict]) -> dict[str, tuple[int, int]]:
    """Killed, and all that compile and make a difference, for each kind of mutant."""
    kinds = sorted({verdict.mutant.kind for verdict in verdicts})
    found = {}
    for kind in kinds:
        own = [verdict for verdict in verdicts if verdict.mutant.kind == kind]
        of = [one for one in own if one.status not in ("stillborn", "equivalent")]
        found[kind] = (count(of, "killed"), len(of))
    return found


def report(
    unit: str, verdicts: Sequence[Verdict], problems: Sequence[str], dropped: int, digest: str
) -> str:
    """The report, as JSON; the digest says of what it holds."""
    summary: dict[str, Any] = {name: count(verdicts, name) for name in STATUSES}
    content = {
        "unit": unit,
        "digest": digest,
        "summary": summary,
        "dropped": dropped,
        "kinds": by_kind(verdicts),
        "problems": list(problems),
        "mutants": [verdict.as_dict() for verdict in verdicts],
    }
    return json.dumps(content, indent=1) + "\n"


def score(summary: Mapping[str, int]) -> str:
    """What became of the mutants of a unit that compile, in a line."""
    of = sum(summary[name] for name in STATUSES) - summary["stillborn"]
    line = f"killed {summary['killed']} of {of}, {summary['equivalent']} equivalent"
    open_ones = summary["survived"] + summary["undecided"] + summary["skipped"]
    return line + (f", {open_ones} open" if open_ones else "")


def standing(unit: str, path: Path, digest: str) -> str:
    """A line about the last report on a unit, and whether it is about what there is now."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        line = f"{unit:<12} {score(content['summary'])}"
        made_of = str(content["digest"])
    except (OSError, ValueError, KeyError, TypeError):
        return f"{unit:<12} no result"
    return line if made_of == digest else f"{line}; STALE: sources, proofs or tools have changed"
