# SPDX-License-Identifier: Apache-2.0
"""Holds requirement STA-001 against the code: which functions change something when they refuse.

STA-001 (specs/requirements/status.sdoc) lists the exceptions, a line for each:

    - OVS_003_refused keel_oversample_add, KEEL_ERR_VALUE: the run is counted

with the label of a clause or an assertion about the function that says so. Every other function
that returns a status must be shown to leave all as it was: it assigns nothing at all, or has a
behaviour that does not, or its contract or a harness of its own has a label that ends in _kept or
_unchanged.
"""

from __future__ import annotations

import re
from pathlib import Path

from keel.c import source as csource
from keel.c.syntax import written
from keel.judge import wp_frames

EXCEPTION = re.compile(r"^- (\w+) (keel_\w+), (?:KEEL_ERR_\w+|any): ", re.MULTILINE)
STATUS = "keel_status_t"
KEPT = re.compile(r"assigns \\nothing|\b[A-Z]{3,4}_\d{3}_(?:kept|unchanged)\b")


def fallible(root: Path) -> dict[str, str]:
    """Every function of Keel's headers that returns a status, with its contract."""
    found: dict[str, str] = {}
    for path in sorted((root / "include").glob("keel/**/*.h")):
        text = csource.read(path)
        contracts = dict(wp_frames.contracts(text))
        for node, declarator in csource.at_file_level(text):
            name = written(declarator.children[0])
            if name.startswith("keel_") and written(node.child_by_field_name("type")) == STATUS:
                found[name] = contracts[name] or found.get(name, "")
    return found


def evidence(root: Path, function: str, contract: str) -> str:
    """What is stated of a function: its contract and the harnesses that prove it."""
    paths = sorted(root.glob(f"proofs/*/{function}*_harness.c"))
    own = [path for path in paths if path.stem.startswith((f"{function}_harness", f"{function}__"))]
    return "\n".join([contract, *(path.read_text(encoding="utf-8") for path in own)])


def problems(root: Path) -> list[str]:
    """Functions that may change something in a refusal, unlisted, and lines that nothing proves."""
    path = root / "specs" / "requirements" / "status.sdoc"
    if not path.is_file():
        return []
    listed = {match[2]: match[1] for match in EXCEPTION.finditer(path.read_text(encoding="utf-8"))}
    stated = {name: evidence(root, name, contract) for name, contract in fallible(root).items()}
    unknown = set(listed) - set(stated)
    found = [f"STA-001: there is no {name} that returns a status" for name in unknown]
    for name, text in stated.items():
        if name in listed:
            if not re.search(rf"\b{listed[name]}\b", text):
                label = listed[name]
                found.append(f"STA-001: {name}: {label} is neither in its contract nor asserted")
        elif not KEPT.search(text):
            found.append(f"STA-001: {name}: nothing says that its refusals change nothing")
    return sorted(found)
