# SPDX-License-Identifier: Apache-2.0
"""Write what the last run of tools/keel prove proved into docs/status.md.

    python3 tools/keel status

The page holds what build/prove/report.json says, and nothing that changes from run to run. A report
of some units or of one engine only is refused, as its table would pass for the whole.

Exit status: 0 when the page was written, 2 when not; the reason is told.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import read_text, write_text

PAGE = Path("docs/status.md")
INTRODUCTION = """\
# Status

This is proved by the last complete run of `make prove-all`. `make generate NAME=status` writes
the page from the run's report; nobody edits it.

"""
HEAD = """\
| unit | functions determined | WP goals | CBMC harnesses | CBMC properties | Gappa goals | \
mistakes refuted |
|---|---|---|---|---|---|---|
"""
KEY = """
A *function determined* is a public function of which result and every field it writes are proved to
be those of its [executable specification](../specs/model/README.md), in every valid state or within
a bound, or are determined by WP's clauses; `proofs/determined.md` says which. A *goal* is a
statement that WP or Gappa proves. A *harness* is a program that calls a function, mostly once, with
arbitrary or chosen arguments and states; a *property* is one thing that CBMC checks in it. A
*mistake* is made on purpose in a body or a bound, and must be noticed. [What is proved](proved.md)
says what all of this amounts to.
"""
DETERMINED = ("equality", "wp")
REASONS = "`proofs/units.toml`"


def numbers(unit: Mapping[str, Any]) -> list[tuple[int, int]]:
    """Of a unit: functions, goals, harnesses, properties, bounds, mistakes, as (good, all)."""
    functions, wp, cbmc, gappa = (unit[key] for key in ("determined", "wp", "cbmc", "gappa"))
    harnesses = cbmc["harnesses"].values()
    bodies, bounds = cbmc["negative"], gappa["negative"]
    return [
        (sum(function["by"] in DETERMINED for function in functions), len(functions)),
        (wp["proved"], wp["goals"]),
        (sum(harness["sound"] for harness in harnesses), len(harnesses)),
        (cbmc["proved"], cbmc["properties"]),
        (gappa["proved"], gappa["goals"]),
        (bodies["refuted"] + bounds["refused"], bodies["bodies"] + bounds["bounds"]),
    ]


def row(name: str, pairs: Sequence[tuple[int, int]]) -> str:
    """A line of the table; a number alone means all of them."""
    cells = [str(good) if good == all_ else f"**{good} of {all_}**" for good, all_ in pairs]
    return f"| {' | '.join([name, *cells])} |\n"


def undetermined(units: Mapping[str, Any]) -> list[str]:
    """The public functions that some choice is left to."""
    functions = [function for unit in units.values() for function in unit["determined"]]
    return [entry["function"] for entry in functions if entry["by"] not in DETERMINED]


def left_to_cbmc(units: Mapping[str, Any]) -> str:
    """How many functions each unit leaves to CBMC; empty when there is none."""
    counts = {name: len(unit["wp"]["not_by_wp"]) for name, unit in units.items()}
    parts = [f"`{name}` {count}" for name, count in counts.items() if count]
    return f"{sum(counts.values())} functions: {', '.join(parts)}" if parts else ""


def named(functions: Sequence[str]) -> str:
    """Functions, as code."""
    return ", ".join(f"`{name}`" for name in functions)


def exceptions(units: Mapping[str, Any]) -> str:
    """What an engine does not prove; each has its reason in proofs/units.toml."""

    def every(engine: str, key: str) -> list[str]:
        return [name for unit in units.values() for name in unit[engine][key]]

    kinds = {
        "not determined in every field": named(undetermined(units)),
        "declared without a body": named(every("wp", "not_proved_here")),
        "without a harness": named(every("cbmc", "without_harness")),
        "postconditions left to CBMC": left_to_cbmc(units),
    }
    lines = [f"- {what}: {which}.\n" for what, which in kinds.items() if which]
    return f"\nExceptions; {REASONS} has the reason of each:\n\n{''.join(lines)}" if lines else ""


def page(report: Mapping[str, Any]) -> str:
    """The report as a table, with a line under it that says whether everything is proved."""
    if report.get("partial"):
        raise ToolError("the last run was not of all units and engines: run make prove-all first")
    units = {name: numbers(unit) for name, unit in report["units"].items()}
    if not units:
        raise ToolError("the report names no unit")
    columns = list(zip(*units.values(), strict=True))
    total = [(sum(good for good, _ in pairs), sum(all_ for _, all_ in pairs)) for pairs in columns]
    rows = "".join(row(f"`{name}`", pairs) for name, pairs in units.items())
    if report["verdict"] == "proved":
        verdict = "Every goal and every property is proved.\n"
    else:
        verdict = f"**Not everything is proved**: {len(report['problems'])} problems.\n"
    table = f"{HEAD}{rows}{row('all', total)}"
    return f"{INTRODUCTION}{table}\n{verdict}{exceptions(report['units'])}{KEY}"


def write(root: Path) -> int:
    """Read the report, write the page."""
    path = root / "build/prove/report.json"
    if not path.is_file():
        raise ToolError("there is no report: run make prove-all first")
    write_text(root / PAGE, page(json.loads(read_text(path))))
    return 0


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    Parser(f"Write {PAGE}, what the proofs proved.", "status").parse_args(arguments)
    return program("status", lambda: write(root))
