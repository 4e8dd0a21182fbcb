# SPDX-License-Identifier: Apache-2.0
"""The part `proofs` of a project: the goals and harnesses of its units, from `make prove`."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from keel.base.files import read_text
from keel.c.project import find_units
from keel.gather.part import Context, Item, Part
from keel.gather.users.labels import links_of

HEAD = re.compile(r"(?://[^\n]*\n)+")  # A harness's options and bounds, with their reasons.
COVERS = re.compile(r"^// covers: (.*)$", re.MULTILINE)


def function_of(goal: str, functions: Sequence[str]) -> tuple[str, ...]:
    """A link to the function whose goal this is; the longest name that it begins with."""
    found = [name for name in functions if goal.startswith(f"{name}_")]
    return (f"function:{max(found, key=len)}",) if found else ()


def goals(unit: str, report: Mapping[str, Any], functions: Sequence[str]) -> Iterator[Item]:
    """WP's goals."""
    for goal in report["wp"]["goal_list"]:
        yield Item(
            kind="goal",
            id=f"{unit}/{goal['name']}",
            title=goal["name"],
            state="good" if goal["status"] == "Valid" else "bad",
            facts={"prover": goal["prover"]},
            links=(f"unit:{unit}", *function_of(goal["name"], functions), *links_of(goal["name"])),
        )


def harnesses(
    root: Path, unit: str, report: Mapping[str, Any], functions: Sequence[str]
) -> Iterator[Item]:
    """CBMC's harnesses, with the lines at their heads, and their assertions."""
    for name, found in report["cbmc"]["harnesses"].items():
        text = read_text(root / f"proofs/{unit}/{name}.c")
        head, covers = HEAD.match(text), COVERS.search(text)
        covered = [one for one in covers[1].split() if one in functions] if covers else []
        key = f"{unit}/{name}"
        yield Item(
            kind="harness",
            id=key,
            title=name,
            text=head[0] if head else "",
            state="good" if found["sound"] else "bad",
            facts={"properties": f"{found['proved']} of {found['properties']} proved"},
            links=(f"unit:{unit}", *(f"function:{one}" for one in covered)),
        )
        for one in found["assertions"]:
            yield Item(
                kind="goal",
                id=f"{key}/{one['name'].rpartition('.')[2]}",
                title=one["description"],
                facts={"prover": "CBMC"},
                state="good" if one["status"] == "SUCCESS" else "bad",
                links=(f"harness:{key}", *links_of(one["description"])),
            )


def make(context: Context) -> Part:
    """All units."""
    problems: list[str] = []
    report = context.report("prove/report.json", problems)
    functions = [
        one["function"] for unit in report.get("units", {}).values() for one in unit["determined"]
    ]
    items: list[Item] = []
    for unit in find_units(context.root):
        if unit in report.get("units", {}):
            own = report["units"][unit]
            items += goals(unit, own, functions)
            items += harnesses(context.root, unit, own, functions)
    problems += report.get("problems", ())
    summary = {
        "verdict": report.get("verdict", "none"),
        "goals": str(report.get("goals", 0)),
        "proved": str(report.get("proved", 0)),
    }
    return Part(
        name="proofs",
        title="Formal verification",
        items=tuple(items),
        summary=summary,
        problems=tuple(problems),
    )
