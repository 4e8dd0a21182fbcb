# SPDX-License-Identifier: Apache-2.0
"""What the parts `requirements` and `trace` are made from: the trace, and the verdicts on it."""

from __future__ import annotations

from dataclasses import dataclass

from keel.gather.part import Context
from keel.trace.command import Trace, join
from keel.trace.requirements import Requirement, children
from keel.trace.verdicts import Verdicts, of_proofs, of_tests, states

REPORTS = ("prove/report.json", "test/report.json", "test-target/report.json")


@dataclass
class Traced:
    """The trace of the tree, with what the reports say of it."""

    trace: Trace
    verdicts: Verdicts
    below: dict[str, list[Requirement]]
    state: dict[str, str]


def read(context: Context, problems: list[str]) -> Traced:
    """Read the tree and the reports; a report that cannot serve is a problem."""
    trace = join(context.root)
    prove, *tests = [context.report(name, problems) for name in REPORTS]
    verdicts = Verdicts([*of_proofs(prove), *of_tests(*tests)], trace.functions)
    below = children(trace.requirements)
    return Traced(trace, verdicts, below, states(trace.requirements, verdicts, below))
