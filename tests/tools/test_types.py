# SPDX-License-Identifier: Apache-2.0
"""The types of the tools, by mypy with pyproject.toml, beside the libraries that they use."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]


class TypesTest(unittest.TestCase):
    """mypy, strict, over all of the tools."""

    variables: dict[str, str]
    cache: str

    @classmethod
    def setUpClass(cls) -> None:
        tools = Toolchain()
        tools.ensure(
            "types", "fly-tests", "evidence", "trace", "c-syntax", "model", "stack", "schedule"
        )
        groups = (
            "types",
            "fly-tests",
            "evidence",
            "trace",
            "c-syntax",
            "model",
            "stack",
            "schedule",
        )
        names = dict.fromkeys(name for group in groups for name in tools.lock.groups[group])
        places = [
            tools.command(name)[0]
            for name in names
            if tools.lock.tools[name].kind in ("packages", "wheel")
        ]
        cls.variables = {**os.environ, "PYTHONPATH": os.pathsep.join(places)}
        cls.cache = cls.enterClassContext(tempfile.TemporaryDirectory(prefix="keel-test-"))

    def mypy(self, *places: str) -> str:
        """What mypy says of files and folders."""
        command = [sys.executable, "-m", "mypy", "--cache-dir", self.cache, *places]
        done = subprocess.run(
            command, cwd=ROOT, env=self.variables, check=False, text=True, capture_output=True
        )
        return done.stdout + done.stderr

    def test_the_tools_have_the_types_that_they_say(self) -> None:
        modules = list((ROOT / "tools").rglob("*.py"))
        self.assertIn(f"Success: no issues found in {len(modules)} source", self.mypy("tools"))

    def test_a_wrong_type_is_found(self) -> None:
        with tempfile.TemporaryDirectory(prefix="keel-test-") as folder:
            wrong = Path(folder) / "wrong.py"
            wrong.write_text("def half(number: int) -> int:\n    return number / 2\n")
            self.assertIn("wrong.py:2: error: Incompatible return value", self.mypy(str(wrong)))
