# SPDX-License-Identifier: Apache-2.0
"""Sign that you have reviewed a unit's proofs, or see who has.

    python3 tools/keel review                    # who has reviewed which unit
    python3 tools/keel review --unit queue       # the files to look at, and their digest
    python3 tools/keel review --unit queue --sign "A. Reviewer" --remarks "no findings"

CONTRIBUTING.md, "Reviewing a proof", has the questions. A signature goes into
specs/reviews.toml, with the digest of what it is of: it is stale as soon as that changes.

Exit status: 0, 1 when a signature is stale, 2 for a wrong command line.
"""

from __future__ import annotations

import argparse
import datetime
import json
from collections.abc import Sequence
from pathlib import Path

from keel.base.errors import ROOT, ToolError, program
from keel.base.files import read_text, write_text
from keel.c.project import Unit
from keel.gather.formal import reviews


def parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="review", description="Reviews of proofs by people.")
    parser.add_argument("--unit", metavar="U", help="the unit; default: tell about all")
    parser.add_argument("--sign", metavar="NAME", help="you, who have reviewed the unit")
    parser.add_argument("--remarks", metavar="TEXT", default="", help="what you found")
    options = parser.parse_args(arguments)
    if options.sign is not None and not (options.sign.strip() and options.unit):
        parser.error("--sign needs a name, and --unit")
    if options.sign and not options.remarks.strip():
        parser.error("--sign needs --remarks: what was found, or that nothing was")
    return options


def sign(unit: Unit, person: str, remarks: str, today: str) -> None:
    """Add a signature on a unit."""
    path = unit.root / reviews.FILE
    entry = {
        "unit": unit.name,
        "person": person,
        "date": today,
        "digest": reviews.digest_of(unit),
        "remarks": remarks,
    }
    lines = [f"{name} = {json.dumps(text, ensure_ascii=False)}" for name, text in entry.items()]
    write_text(path, "\n".join([read_text(path).rstrip(), "", "[[review]]", *lines, ""]))


def tell(root: Path) -> int:
    """Who has reviewed which unit; 1 when a signature is stale."""
    reviewed = reviews.read_reviews(root)
    for unit, state, person, date, _ in reviews.table(reviewed).rows:
        print(f"{unit.partition(':')[2]:<12} {state}  {person} {date}".rstrip())
    stale = list(reviews.problems(reviewed))
    for text in stale:
        print(f"FAILED {text}")
    return 1 if stale else 0


def run(options: argparse.Namespace, root: Path = ROOT) -> int:
    """Tell, or sign; the exit status."""
    if not options.unit:
        return tell(root)
    units = reviews.proved_units(root)
    if options.unit not in units:
        raise ToolError(f"there is no unit {options.unit} with proofs: {', '.join(units)}")
    unit = units[options.unit]
    if options.sign:
        sign(unit, options.sign, options.remarks, datetime.date.today().isoformat())
        print(f"signed: {reviews.FILE}")
        return 0
    for path in reviews.reviewed_files(unit):
        print(path.relative_to(root))
    print(f"digest {reviews.digest_of(unit)}")
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("review", lambda: run(parse(arguments)))
