#!/usr/bin/env python3
"""Write what the last run of tools/prove.py proved into README.md.

    python3 tools/status.py

The table between the lines <!-- status --> and <!-- /status --> is replaced; it holds what
build/prove/report.json says, and nothing that changes from run to run. A report of some units or
of one engine only is refused, as its table would pass for the whole.

Exit status: 0 when the table was written, 1 when not (the reason is told), 2 for a wrong command
line.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
BEGIN, END = "<!-- status -->\n", "<!-- /status -->\n"
HEAD = """\
| unit | WP goals proved | CBMC harnesses | CBMC properties | Gappa goals | wrong variants refuted |
|---|---|---|---|---|---|
"""


class StatusError(Exception):
    """Why no table can be written."""


def numbers(unit: Mapping[str, Any]) -> list[tuple[int, int]]:
    """Of a unit: goals, harnesses, properties, bounds, wrong variants, each as (good, all)."""
    wp, cbmc, gappa = unit["wp"], unit["cbmc"], unit["gappa"]
    harnesses = cbmc["harnesses"].values()
    bodies, bounds = cbmc["negative"], gappa["negative"]
    return [
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


def exceptions(units: Mapping[str, Any]) -> str:
    """The functions that an engine does not prove; each has its reason in proofs/units.toml."""
    kinds = {"Without a harness": ("cbmc", "without_harness"),
             "Declared without a body": ("wp", "not_proved_here"),
             "Postconditions left to CBMC": ("wp", "not_by_wp")}  # fmt: skip
    text = ""
    for what, (engine, key) in kinds.items():
        functions = [f"`{name}`" for unit in units.values() for name in unit[engine][key]]
        if functions:
            text += f"{what} (reasons in `proofs/units.toml`): {', '.join(functions)}.\n"
    return text


def table(report: Mapping[str, Any]) -> str:
    """The report as a table, with a line under it that says whether everything is proved."""
    if report.get("partial"):
        raise StatusError("the last run was not of all units and engines: run make prove first")
    units = {name: numbers(unit) for name, unit in report["units"].items()}
    if not units:
        raise StatusError("the report names no unit")
    columns = list(zip(*units.values(), strict=True))
    total = [(sum(good for good, _ in pairs), sum(all_ for _, all_ in pairs)) for pairs in columns]
    rows = "".join(row(f"`{name}`", pairs) for name, pairs in units.items())
    if report["verdict"] == "proved":
        verdict = "Every goal and every property is proved.\n"
    else:
        verdict = f"**Not everything is proved**: {len(report['problems'])} problems.\n"
    return f"{HEAD}{rows}{row('all', total)}\n{verdict}{exceptions(report['units'])}"


def replaced(text: str, new: str) -> str:
    """The text with what stands between the marks replaced."""
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        raise StatusError("README.md needs one <!-- status --> and one <!-- /status --> line")
    before, rest = text.split(BEGIN)
    if END not in rest:
        raise StatusError("README.md: <!-- /status --> stands before <!-- status -->")
    return before + BEGIN + new + END + rest.split(END)[1]


def write(root: Path) -> None:
    """Read the report, write the table."""
    path = root / "build/prove/report.json"
    if not path.is_file():
        raise StatusError("there is no report: run make prove first")
    readme = root / "README.md"
    new = table(json.loads(path.read_text(encoding="utf-8")))
    readme.write_text(replaced(readme.read_text(encoding="utf-8"), new), encoding="utf-8")


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Write the status table of README.md.")
    parser.parse_args(arguments)
    try:
        write(root)
    except StatusError as error:
        print(f"status: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
