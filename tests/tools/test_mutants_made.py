# SPDX-License-Identifier: Apache-2.0
"""Whether the results of mutation are of the mutants that the operators make now."""

from __future__ import annotations

import re
from pathlib import Path

from keel.c.project import find_units
from keel.mutate import command, table

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/proved.md"
NAMED = re.compile(r"The operators have changed since the mutants of (?P<units>[^.]*) last ran\.")


def test_the_page_names_the_units_whose_mutants_are_others_now() -> None:
    around = command.surroundings(ROOT)
    units = find_units(ROOT)
    others = [
        name
        for name, record in table.read(ROOT).unit.items()
        if record.mutants
        != sum(len(made.mutants) for made in command.generated(units[name], around))
    ]
    said = NAMED.search(" ".join(PAGE.read_text(encoding="utf-8").split()))
    named = re.split(r", | and ", said["units"]) if said else []
    assert sorted(named) == sorted(others)
