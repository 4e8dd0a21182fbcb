# SPDX-License-Identifier: Apache-2.0
"""Findings as SARIF 2.1.0, which code hosts and editors show beside the lines they are about."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.files import write_json

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
PLACE = re.compile(r"(?P<file>[\w./+-]+\.\w+):(?P<line>[1-9]\d*)\b")


@dataclass(frozen=True)
class SarifResult:
    """A finding. `rule` is the kind of thing that is wrong; a file is named from the root."""

    rule: str
    message: str
    file: str = ""
    line: int = 0


def split_place(place: str) -> tuple[str, int]:
    """File and line of the first FILE:LINE in a text; "" and 0 if there is none."""
    match = PLACE.search(place)
    return (match["file"], int(match["line"])) if match else ("", 0)


def document(tool: str, results: Iterable[SarifResult]) -> dict[str, Any]:
    """A log of one run."""
    every = list(results)
    driver = {"name": tool, "rules": [{"id": rule} for rule in sorted({one.rule for one in every})]}
    run = {"tool": {"driver": driver}, "results": [_result(one) for one in every]}
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def _result(one: SarifResult) -> dict[str, Any]:
    found: dict[str, Any] = {"ruleId": one.rule, "level": "error", "message": {"text": one.message}}
    if one.file:
        location: dict[str, Any] = {"artifactLocation": {"uri": one.file}}
        if one.line:
            location["region"] = {"startLine": one.line}
        found["locations"] = [{"physicalLocation": location}]
    return found


def write_sarif(path: Path, tool: str, results: Iterable[SarifResult]) -> None:
    """Write a log in one go."""
    write_json(path, document(tool, results))
