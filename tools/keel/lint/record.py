# SPDX-License-Identifier: Apache-2.0
"""What a run of tools/keel lint leaves: a report for the evidence, and SARIF for code hosts."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from keel.base.sarif import SarifResult, write_sarif
from keel.base.source import write_report
from keel.install import Toolchain
from keel.lint.misra import (
    Deviation,
    Violation,
    drivers,
    matched,
    read_deviations,
    rules_without_checker,
)
from keel.lint.texts import Finding, Text

REPORT = "build/lint/report.json"
RESULTS = "build/lint/results.sarif"
RULE = re.compile(r"\d+\.\d+$")


def clear(root: Path) -> None:
    """Forget the last run: one that does not end leaves none."""
    for name in (REPORT, RESULTS):
        (root / name).unlink(missing_ok=True)


def rule_of(kind: str, finding: Finding) -> str:
    """The rule that a finding breaks, as SARIF names it."""
    rule = finding.reason.partition(": ")[0]
    return f"misra-c2012-{rule}" if kind == "misra" and RULE.match(rule) else kind


def deviation_of(deviation: Deviation, allowed: Sequence[Violation]) -> dict[str, Any]:
    """A deviation, and how often it was needed in which file."""
    counts = Counter(violation.file for violation in allowed)
    return {**asdict(deviation), "allows": dict(sorted(counts.items()))}


def content(
    tools: Toolchain,
    root: Path,
    texts: Sequence[Text],
    findings: Mapping[str, list[Finding]],
    violations: Sequence[Violation],
) -> dict[str, Any]:
    """The report."""
    deviations = read_deviations(root)
    matches = list(matched(violations, deviations, texts))
    allowed = {
        item.id: [match.violation for match in matches if item in match.deviations]
        for item in deviations
    }
    found = tools.versions("lint")
    return {
        "findings": [
            {"rule": rule_of(kind, one), **one._asdict()}
            for kind, every in findings.items()
            for one in sorted(set(every))
        ],
        "violations": len(violations),
        "deviations": [deviation_of(item, allowed[item.id]) for item in deviations],
        "rules_without_checker": rules_without_checker(tools),
        "files": [*(text.path for text in texts if text.is_kernel), *drivers(root)],
        "tools": {name: found[name].version for name in ("cppcheck", "clang-format-19")},
    }


def write(
    tools: Toolchain,
    root: Path,
    texts: Sequence[Text],
    findings: Mapping[str, list[Finding]],
    violations: Sequence[Violation],
) -> None:
    """Write both."""
    report = content(tools, root, texts, findings, violations)
    results = [
        SarifResult(one["rule"], one["reason"], one["file"], one["line"])
        for one in report["findings"]
    ]
    write_sarif(root / RESULTS, "lint", results)
    write_report(root / REPORT, report, root, good=not report["findings"])
