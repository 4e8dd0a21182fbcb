# SPDX-License-Identifier: Apache-2.0
"""Fixes the assertions of CBMC's harnesses in the repository, as goals.txt does WP's goals.

proofs/UNIT/assertions.txt has a line for each: the harness and the assertion's text. One that
vanishes, or a whole harness, is a failure until a person has accepted it with --update-goals.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from keel.base.files import write_text
from keel.c.project import Unit


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
