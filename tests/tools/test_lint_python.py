# SPDX-License-Identifier: Apache-2.0
"""Tests of the Python rules of `make lint`, each on a small package that breaks one of them."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from keel.install import Toolchain
from keel.lint.python import check_python, lay_out

SETTINGS = """\
[tool.ruff]
line-length = 100
[tool.ruff.lint]
select = ["F", "I"]
[tool.importlinter]
root_package = "keel"
[[tool.importlinter.contracts]]
name = "rooms"
type = "layers"
layers = ["keel.high", "keel.low"]
"""


class PythonRules(unittest.TestCase):
    """A package of two rooms, and an empty folder of tests."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()
        self.write("pyproject.toml", SETTINGS)
        for room in ("", "high/", "low/"):
            self.write(f"tools/keel/{room}__init__.py", "")
        (self.root / "tests").mkdir()
        self.tools = Toolchain()
        self.tools.ensure("python")

    def write(self, name: str, text: str) -> None:
        """A file of the package."""
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def found(self) -> list[str]:
        """Every finding."""
        return [str(one) for one in check_python(self.tools, self.root)]

    def test_a_room_may_import_the_one_below(self) -> None:
        self.write("tools/keel/high/a.py", "from keel import low\n\nprint(low)\n")
        self.assertEqual(self.found(), [])

    def test_a_room_that_imports_the_one_above_is_found(self) -> None:
        self.write("tools/keel/low/a.py", "# Low.\nfrom keel import high\n\nprint(high)\n")
        self.assertEqual(
            self.found(),
            ["tools/keel/low/a.py:2: imports keel.high, against the order in pyproject.toml"],
        )

    def test_a_mistake_is_found_in_its_line(self) -> None:
        self.write("tools/keel/low/a.py", "def half() -> int:\n    return number\n")
        self.assertEqual(self.found(), ["tools/keel/low/a.py:2: F821: Undefined name `number`"])

    def test_another_layout_is_found_and_mended(self) -> None:
        self.write("tests/test_a.py", "import sys\nimport os\nprint( os, sys )\n")
        self.assertIn("tests/test_a.py:1: not laid out as ruff does (--fix does it)", self.found())
        lay_out(self.tools, self.root)
        self.assertEqual(self.found(), [])

    def test_a_project_without_settings_has_no_rules(self) -> None:
        (self.root / "pyproject.toml").unlink()
        self.write("tools/keel/low/a.py", "import os\n")
        self.assertEqual(self.found(), [])
        lay_out(self.tools, self.root)
        self.assertEqual((self.root / "tools/keel/low/a.py").read_text("utf-8"), "import os\n")
