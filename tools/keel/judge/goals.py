# SPDX-License-Identifier: Apache-2.0
"""proofs/UNIT/goals.txt: the goals that must be proved, and who proved each of them last.

    keel_box_put_assigns qed
    keel_box_put_ensures_BOX_001 alt-ergo
    keel_box_put_ensures_BOX_002
    keel_box_put_ensures_BOX_003 pruned

The prover is a hint, and may be missing: it is asked first, alone, and when it fails, or none is
recorded, all of them race. So a wrong one costs time and nothing else. A goal
that is `pruned` needs WP's search for branches that cannot be taken: the pass that does so then
comes before the one that does not.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from keel.c.project import ProjectError

QED = "qed"  # WP's own simplifier, which is asked in any case.
PRUNED = "pruned"  # Any of them, after WP's search for branches that cannot be taken.
PROVERS = ("alt-ergo", "cvc4", "z3", QED)


@dataclass(frozen=True)
class GoalList:
    """The goals in the order of the file, and the provers of those that have one."""

    names: list[str] = field(default_factory=list)
    provers: dict[str, str] = field(default_factory=dict)


def short_name(title: str) -> str:
    """How a prover is recorded: no version, "CVC4 1.8" is cvc4; "" if it is none of ours."""
    name = title.split(" ")[0].lower()
    return name if name in PROVERS else ""


def read_goals(path: Path, shown: str) -> GoalList:
    """Read a list; one that is not there yet is empty."""
    found = GoalList()
    if not path.is_file():
        return found
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        words = line.split()
        if not words:
            continue
        found.names.append(words[0])
        if len(words) == 2 and words[1] in (*PROVERS, PRUNED):
            found.provers[words[0]] = words[1]
        elif len(words) > 1:
            known = ", ".join((*PROVERS, PRUNED))
            raise ProjectError(f"{shown}:{number}: a goal and its prover, one of {known}: {line}")
    return found


def as_text(names: Iterable[str], provers: Mapping[str, str]) -> str:
    """A list as it is written."""
    return "".join(f"{name} {provers.get(name, '')}".rstrip() + "\n" for name in sorted(set(names)))
