# SPDX-License-Identifier: Apache-2.0
"""Tests of the Containerfile: it has the packages that the tools are made of, and no others."""

from __future__ import annotations

import re
import unittest
from pathlib import Path

from keel.install.lock import Lock

ROOT = Path(__file__).resolve().parents[2]

FIRST = {"git", "make", "python3", "ca-certificates"}  # What `make` needs to install the others.
BOARDS = "flash-"  # Groups of programs that write to a board, which a container does not see.


def installed(text: str) -> list[str]:
    """The packages that a container file installs."""
    [words] = re.findall(r"apt-get install ((?:.*\\\n)+)", text)
    return [word for word in words.split() if not word.startswith(("-", "\\"))]


class Container(unittest.TestCase):
    """The file as it is."""

    def setUp(self) -> None:
        text = (ROOT / "Containerfile").read_text(encoding="utf-8")
        self.packages = installed(text.partition("&& rm ")[0])
        self.text = text

    def test_it_has_the_packages_of_the_tools(self) -> None:
        lock = Lock.read()
        groups = [name for name in lock.groups if not name.startswith(BOARDS)]
        wanted = {package for spec in lock.of_groups(groups) for package in spec.packages}
        self.assertIn("frama-c-base", wanted)
        self.assertEqual(sorted(self.packages), sorted(FIRST | wanted))

    def test_it_is_the_system_of_the_workflows(self) -> None:
        [base] = re.findall(r"^FROM (\S+)$", self.text, re.MULTILINE)
        for path in (ROOT / ".github/workflows").glob("*.yml"):
            systems = re.findall(r"^ +container: (\S+)$", path.read_text(encoding="utf-8"), re.M)
            self.assertEqual(set(systems), {base}, path.name)

    def test_the_documents_show_its_cache_and_its_folder(self) -> None:
        document = (ROOT / "docs/building.md").read_text(encoding="utf-8")
        for setting, shown in (
            (r"KEEL_CACHE=(\S+)", "-v keel:{}"),
            (r"WORKDIR (\S+)", '-v "$PWD":{}'),
        ):
            [folder] = re.findall(setting, self.text)
            for program in ("podman", "docker"):
                [line] = re.findall(rf"^{program} build .*$", document, re.MULTILINE)
                self.assertIn(f"{shown.format(folder)} ", line)
