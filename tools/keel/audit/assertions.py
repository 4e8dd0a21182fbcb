# SPDX-License-Identifier: Apache-2.0
"""Fixes the assertions of CBMC's harnesses in the repository, as goals.txt does WP's goals.

proofs/UNIT/assertions.txt has a line for each: the harness and the assertion's text. One that
vanishes, or a whole harness, is a failure until a person has accepted it with --update-goals.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from keel.base.files import write_text
from keel.c import source as csource
from keel.c.project import Unit
from keel.judge import wp_frames
from keel.judge.harness import read_harness

POSTCONDITION = re.compile(r"\bensures\s+(?:(?P<label>\w+)\s*:(?!:))?")


def list_of(unit: Unit) -> Path:
    """Where a unit's assertions are fixed."""
    return unit.folder / "assertions.txt"


def lines(harnesses: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """The assertions of harnesses as they are reported, sorted; equal ones each time."""
    return sorted(
        f"{name} {assertion['description']}"
        for name, harness in harnesses.items()
        for assertion in harness["assertions"]
    )


def update(unit: Unit, harnesses: Mapping[str, Mapping[str, Any]]) -> bool:
    """Rewrite the list, unless a harness had nothing to say; whether it has changed."""
    if not all(harness["assertions"] for harness in harnesses.values()):
        return False
    text = "".join(f"{line}\n" for line in lines(harnesses))
    path = list_of(unit)
    if (path.read_text(encoding="utf-8") if path.is_file() else "") == text:
        return False
    write_text(path, text)
    return True


def problems(unit: Unit, harnesses: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """How the assertions that CBMC checked differ from the fixed list."""
    path = list_of(unit)
    where = path.relative_to(unit.root)
    seen = lines(harnesses)
    if not path.is_file():
        missing = f"{where} is missing: review the assertions, run --update-goals"
        return [missing] if seen else []
    listed = path.read_text(encoding="utf-8").splitlines()
    found = [] if listed == sorted(listed) else [f"{where}: not sorted; run --update-goals"]
    found += [
        f"{where}: {line}: is listed, but no harness asserts it any more: if it was removed on"
        " purpose, review and run --update-goals"
        for line in (Counter(listed) - Counter(seen)).elements()
    ]
    found += [
        f"{where}: {line}: is a new assertion: review and run --update-goals"
        for line in (Counter(seen) - Counter(listed)).elements()
    ]
    return found


def left_open(
    unit: Unit, left: Collection[str], harnesses: Mapping[str, Mapping[str, Any]]
) -> list[str]:
    """The postconditions of functions that WP leaves to CBMC, and that no harness asserts.

    WP takes them for granted at each call. A harness that covers the function has to assert them
    under their labels; people judge whether clause and assertion say the same.
    """
    covers = {path.stem: read_harness(unit, path).covers for path in unit.harnesses}
    asserted = {
        (function, assertion["description"].partition(":")[0])
        for name, harness in harnesses.items()
        for assertion in harness["assertions"]
        for function in covers.get(name, ())
    }
    found = []
    for path in unit.own_files:
        for function, contract in wp_frames.contracts(csource.read(path)):
            for clause in POSTCONDITION.finditer(contract if function in left else ""):
                label = clause["label"]
                if not label:
                    found.append(f"{function}: WP leaves a postcondition without a label to CBMC")
                elif (function, label) not in asserted:
                    found.append(
                        f"{function}: WP leaves {label} to CBMC, and no harness that covers the"
                        f' function has an assertion "{label}: ..."'
                    )
    return list(dict.fromkeys(found))
