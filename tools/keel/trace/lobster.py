# SPDX-License-Identifier: Apache-2.0
"""Has LOBSTER check the trace: a gate that shares no code with requirements_trace.py.

LOBSTER counts whatever refers to a requirement as its cover, also a test that failed. So what is
not good refers to nothing here, and says why: LOBSTER then finds it alone.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from keel.base.errors import ToolError
from keel.base.files import read_text, write_json, write_text
from keel.base.run import Ended, run
from keel.trace.functions import Function
from keel.trace.requirements import FOLDER, Requirement
from keel.trace.verdicts import HARNESS, TEST, Verdict, Verdicts, modelled

POLICY = """\
requirements "High-level requirements" {
   source: "high.lobster";
   requires: "Low-level requirements" or "Tests";
}

requirements "Low-level requirements" {
   source: "low.lobster";
   trace to: "High-level requirements";
   requires: "Proofs" or "Tests";
}

implementation "Functions" {
   source: "functions.lobster";
   trace to: "Low-level requirements";
}

activity "Proofs" {
   source: "proofs.lobster";
   trace to: "Low-level requirements";
}

activity "Tests" {
   source: "tests.lobster";
   trace to: "High-level requirements";
   trace to: "Low-level requirements";
}
"""
SCHEMAS = {
    "high": ("lobster-req-trace", 4),
    "low": ("lobster-req-trace", 4),
    "functions": ("lobster-imp-trace", 3),
    "proofs": ("lobster-act-trace", 3),
    "tests": ("lobster-act-trace", 3),
}
REPORT, PAGE = "report.lobster", "lobster.html"


def _item(
    tag: str, name: str, refs: Iterable[str], file: str = "", line: int = 0
) -> dict[str, Any]:
    """What all of LOBSTER's items have."""
    where = {"kind": "file", "file": file, "line": line or None, "column": None}
    return {
        "tag": tag,
        "name": name,
        "location": where if file else {"kind": "void"},
        "messages": [],
        "just_up": [],
        "just_down": [],
        "just_global": [],
        "refs": [f"req {uid}" for uid in refs],
    }


def requirement_item(one: Requirement) -> dict[str, Any]:
    """A requirement; what is derived, or put together by hand, is justified by that."""
    file = f"{FOLDER}/{one.document}.sdoc"
    found = _item(f"req {one.uid}", f"{one.uid} {one.of('TITLE')}", one.parents, file)
    found |= {"framework": "StrictDoc", "kind": "requirement", "text": one.of("STATEMENT")}
    if one.of("DERIVED") and not one.high:
        found["just_up"] = [one.of("DERIVED")]
    if "theorem" in one.verification:
        found["just_down"] = ["put together by hand: specs/soundness.md"]
    return found


def function_item(one: Function) -> dict[str, Any]:
    """A function."""
    tag = f"c {one.file}:{one.name}"
    return _item(tag, one.name, one.requirements, one.file, one.line) | {
        "language": "C",
        "kind": "static function" if one.helper else "function",
    }


def activity_item(one: Verdict, uids: Iterable[str]) -> dict[str, Any]:
    """A goal, a harness or a test. LOBSTER takes @ in a tag for a version."""
    kind, _, name = one.key.partition(":")
    tag = f"{kind} {name}".replace("@", " at ")
    found = _item(tag, name, uids if one.good else ())
    found["messages"] = [] if one.good else [f"its verdict is: {one.said}"]
    return found | {"framework": one.by, "kind": kind, "status": "ok" if one.good else "fail"}


def of_tests(known: Mapping[str, Requirement], verdicts: Verdicts) -> Iterator[dict[str, Any]]:
    """The tests that bear a requirement's id, or that one lists."""
    named: dict[str, dict[str, None]] = {}
    for verdict in verdicts.every:
        if verdict.by == TEST and verdict.uids:
            named[verdict.key] = dict.fromkeys(verdict.uids)
    for uid, one in known.items():
        for name in one.listed_tests:
            for verdict in verdicts.listed(name):
                named.setdefault(verdict.key, {})[uid] = None
    for verdict in verdicts.every:
        if verdict.key in named:
            yield activity_item(verdict, named[verdict.key])


def items(
    known: Mapping[str, Requirement], functions: Sequence[Function], verdicts: Verdicts
) -> dict[str, list[dict[str, Any]]]:
    """What LOBSTER reads, by file."""
    proofs = [one for one in verdicts.every if one.by != TEST]
    told = {
        one.name: [uid for uid in one.requirements if uid in known and modelled(known[uid])]
        for one in functions
        if not one.helper
    }
    stated = {
        one.key: dict.fromkeys(
            [*one.uids, *(told.get(one.function, ()) if one.by == HARNESS else ())]
        )
        for one in proofs
    }
    return {
        "high": [requirement_item(one) for one in known.values() if one.high],
        "low": [requirement_item(one) for one in known.values() if not one.high],
        "functions": [function_item(one) for one in functions],
        "proofs": [activity_item(one, stated[one.key]) for one in proofs if stated[one.key]],
        "tests": list(of_tests(known, verdicts)),
    }


def _lobster(packages: str, tool: str, folder: Path, *arguments: str) -> Ended:
    """Run one of LOBSTER's programs in a folder."""
    start = f"import sys; from lobster.tools.core.{tool}.{tool} import main; sys.exit(main())"
    return run(
        [sys.executable, "-c", start, *arguments], cwd=folder, environment={"PYTHONPATH": packages}
    )


def gate(folder: Path, packages: str, levels: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """Have LOBSTER join the levels, and say what it finds wrong; its report stays in the folder."""
    for name, (schema, version) in SCHEMAS.items():
        content = {"schema": schema, "version": version, "generator": "keel"}
        write_json(folder / f"{name}.lobster", {**content, "data": levels[name]})
    write_text(folder / "policy.conf", POLICY)
    joined = _lobster(packages, "report", folder, "--lobster-config=policy.conf", f"--out={REPORT}")
    page = _lobster(packages, "html_report", folder, REPORT, f"--out={PAGE}")
    if not (folder / REPORT).is_file() or not page.good:
        raise ToolError(f"LOBSTER does not join the trace: {joined.output}{page.output}")
    found = complaints(read_text(folder / REPORT))
    judged = _lobster(packages, "ci_report", folder, REPORT)
    if judged.good == bool(found):
        raise ToolError(f"LOBSTER's gate says {judged.how}, and its report has {len(found)} faults")
    return found


def complaints(report: str) -> list[str]:
    """Every item of LOBSTER's report that does not trace, with its reasons; the gate's own lines
    do not name the items."""
    return [
        f"LOBSTER: {item['tag']}: {'; '.join(item['messages']) or item['tracing_status']}"
        for level in json.loads(report)["levels"]
        for item in level["items"]
        if item["tracing_status"] not in ("OK", "JUSTIFIED")
    ]
