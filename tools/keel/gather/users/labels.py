# SPDX-License-Identifier: Apache-2.0
"""Which requirements a name speaks of."""

from __future__ import annotations

import re

LABEL = re.compile(r"(?<![A-Z])([A-Z]{3})_(\d{3})(?!\d)")


def requirements_of(*names: str) -> set[str]:
    """The ids in names of clauses, assertions and tests: BAT_001_limit belongs to BAT-001."""
    return {f"{word}-{number}" for name in names for word, number in LABEL.findall(name)}


def links_of(*names: str) -> tuple[str, ...]:
    """The same as links."""
    return tuple(f"requirement:{uid}" for uid in sorted(requirements_of(*names)))
