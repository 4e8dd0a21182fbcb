# SPDX-License-Identifier: Apache-2.0
"""The sections of include/keel/status.h: which layer may return what."""

from __future__ import annotations

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SECTION = re.compile(r"^    /\* ([^*]+)\. \*/$")
CODE = re.compile(r"\bKEEL_(?:OK|ERR_[A-Z]+(?:_[A-Z]+)*)\b")


def sections() -> dict[str, set[str]]:
    """The codes below each section's comment, by its first words."""
    found: dict[str, set[str]] = {}
    name = ""
    for line in (ROOT / "include/keel/status.h").read_text(encoding="utf-8").splitlines():
        if told := SECTION.match(line):
            name = told[1].split(":")[0]
        elif name and (code := CODE.search(line)):
            found.setdefault(name, set()).add(code[0])
    return found


def used_in(*folders: str) -> dict[str, set[str]]:
    """The codes that each file below the folders names."""
    files = [path for folder in folders for path in sorted((ROOT / folder).rglob("*.[ch]"))]
    return {path.name: set(CODE.findall(path.read_text(encoding="utf-8"))) for path in files}


class Sections(unittest.TestCase):
    def test_a_layer_names_its_own_codes_only(self) -> None:
        codes = sections()
        common, rtos, above = codes.values()
        self.assertEqual(
            list(codes), ["Any layer", "The RTOS layer", "The middleware and flight layers"]
        )
        for file, used in used_in("include/keel/rtos", "src/rtos").items():
            self.assertLessEqual(used, common | rtos, file)
        upper = ("include/keel/middleware", "include/keel/flight", "src/middleware", "src/flight")
        for file, used in used_in(*upper).items():
            self.assertLessEqual(used, common | above, file)

    def test_every_code_is_used(self) -> None:
        used = set[str]().union(*used_in("src").values())
        self.assertEqual(set[str]().union(*sections().values()), used)
