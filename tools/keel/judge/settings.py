# SPDX-License-Identifier: Apache-2.0
"""proofs/units.toml: the few exceptions that a person has accepted, each with its reason.

    [queue]
    no_harness = [{ function = "keel_queue_init", reason = "…" }]
    no_body = [{ function = "keel_board_now", reason = "…" }]
    not_by_wp = [{ function = "keel_queue_sort", reason = "…" }]
    by_cbmc = [{ function = "f", clause = "label", harness = "f_harness", reason = "…" }]
    determined = [{ function = "keel_queue_find", by = "wp", reason = "…" }]
    warnings = [{ text = "part of a message of Frama-C", reason = "…" }]
    conditionals = [{ text = "#ifdef MY_BOARD", reason = "…" }]

Of a function under not_by_wp WP proves all but the postconditions, and that no result of floats
overflows (frames.py); by_cbmc names what else WP does not prove of it. `determined` names the
functions whose outcome no harness shows to be a model's (determined.py): by "wp", or by "nothing".
`conditionals` are those of the preprocessor in what is built (disguises.py).
An exception without a reason, or that nothing needs any more, is an error.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from keel.c.project import ProjectError

KINDS = {
    "no_harness": ("function",),
    "no_body": ("function",),
    "not_by_wp": ("function",),
    "by_cbmc": ("function", "clause", "harness"),
    "determined": ("function", "by"),
    "warnings": ("text",),
    "conditionals": ("text",),
}
# A shorter part of a message might be one of any message.
TELLING = 20


@dataclass
class Exceptions:
    """The exceptions of one unit: for each kind, what is excepted and why.

    Of by_cbmc the key is "function clause harness", of determined "function by".
    """

    no_harness: dict[str, str] = field(default_factory=dict)
    no_body: dict[str, str] = field(default_factory=dict)
    not_by_wp: dict[str, str] = field(default_factory=dict)
    by_cbmc: dict[str, str] = field(default_factory=dict)
    determined: dict[str, str] = field(default_factory=dict)
    warnings: dict[str, str] = field(default_factory=dict)
    conditionals: dict[str, str] = field(default_factory=dict)


def _read_kind(unit: str, kind: str, entries: Any) -> dict[str, str]:
    if kind not in KINDS:
        raise ProjectError(
            f"units.toml: [{unit}] has the unknown key {kind}; known: {', '.join(KINDS)}"
        )
    wanted = {*KINDS[kind], "reason"}
    found: dict[str, str] = {}
    for entry in entries:
        if set(entry) != wanted or not all(str(value).strip() for value in entry.values()):
            raise ProjectError(
                f"units.toml: [{unit}] {kind}: each entry needs {' and '.join(sorted(wanted))}"
            )
        if kind == "warnings" and len(str(entry["text"])) < TELLING:
            raise ProjectError(f"units.toml: [{unit}] warnings: quote more of {entry['text']!r}")
        found[" ".join(str(entry[key]) for key in KINDS[kind])] = str(entry["reason"])
    return found


def read_exceptions(path: Path, units: list[str]) -> dict[str, Exceptions]:
    """Read the file; units that it does not name have no exceptions."""
    raw = tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    for name in raw:
        if name not in units:
            raise ProjectError(f"units.toml: there is no unit {name}")
    return {
        name: Exceptions(
            **{kind: _read_kind(name, kind, entries) for kind, entries in raw.get(name, {}).items()}
        )
        for name in units
    }
