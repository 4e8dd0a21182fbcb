# SPDX-License-Identifier: Apache-2.0
"""Follows docs/primer.md to the letter, from an empty folder to a unit that is proved and tested.

A block that names a file is that file, or with `diff` a change of it. The commands of a block are
run in the project; each line of the block of text behind it must be in what they say. The provers
are the real ones; what they prove is kept in the user's cache.
"""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "primer.md"
BLOCK = re.compile(r"^```(?P<kind>\w+)(?: (?P<file>\S+))?\n(?P<text>.*?)^```$", re.M | re.S)
FILES = frozenset(["c", "toml"])


def plain(text: str) -> str:
    """A text with white space made one."""
    return " ".join(text.split())


class Primer(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.project = Path(folder.name).resolve()

    def test_it_leads_from_nothing_to_proved(self) -> None:
        said, status = "", 0
        for block in BLOCK.finditer(PAGE.read_text(encoding="utf-8")):
            kind, text = block["kind"], block["text"]
            with self.subTest(kind=kind, file=block["file"], begins=text.partition("\n")[0]):
                if kind == "sh":
                    status, said = self.run_commands(text)
                elif kind == "text":
                    for line in text.splitlines():
                        self.assertIn(plain(line), plain(said), said)
                    self.assertEqual(status != 0, "FAILED" in text, said)
                elif kind == "diff":
                    self.change(self.project / block["file"], text)
                else:
                    self.assertIn(kind, FILES)
                    path = self.project / block["file"]
                    path.parent.mkdir(parents=True, exist_ok=True)
                    path.write_text(text, encoding="utf-8")
        self.assertEqual(status, 0, said)
        self.assertRegex(said, r"proved (\d+) of \1 goals")

    def run_commands(self, text: str) -> tuple[int, str]:
        """Run commands until one fails: the status of the last one, and what all said."""
        ended = subprocess.run(
            ["sh", "-ec", text],
            cwd=self.project,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
            timeout=1500,
            env={**os.environ, "KEEL": str(ROOT)},
        )
        return ended.returncode, ended.stdout

    def change(self, path: Path, difference: str) -> None:
        """Replace the lines that a difference takes away, at the one place where they are."""
        lines = difference.splitlines(keepends=True)
        before = "".join(line[1:] for line in lines if line[0] in " -")
        after = "".join(line[1:] for line in lines if line[0] in " +")
        text = path.read_text(encoding="utf-8")
        self.assertEqual(text.count(before), 1, f"{before} in {path.name}")
        path.write_text(text.replace(before, after), encoding="utf-8")
