#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of the flags that CMake builds Keel with: those of the proofs, whatever the project around
it asks for, and none that reaches the project's own code.

    python3 tests/tools/test_build_flags.py
"""

from __future__ import annotations

import json
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from consumer import AS_FOLDER, CORTEX_M7, ROOT, ConsumerTest  # noqa: E402
from toolchain import TARGET_FLAGS  # noqa: E402

RECKLESS = "-Ofast -ffast-math -ffp-contract=fast -fassociative-math -freciprocal-math"
TARGET = " ".join(TARGET_FLAGS)


class FlagsTest(ConsumerTest):
    """Keel's flags and the project's."""

    def test_nothing_leaks(self) -> None:
        """Keel's flags stay Keel's; nothing but its libraries is built, and nothing installed."""
        self.project(AS_FOLDER)
        self.build("-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", "-DCMAKE_INSTALL_PREFIX=prefix", flags="")
        commands = json.loads((self.folder / "build/compile_commands.json").read_text())
        words = {Path(item["file"]).name: item["command"].split() for item in commands}
        main = [word for word in words.pop("main.c") if re.match("-[fWO]", word)]
        self.assertEqual(main, [])
        sources = {path.name for path in (ROOT / "src").rglob("*.c")}
        self.assertEqual(set(words), sources)
        for flags in words.values():
            self.assertIn("-std=c99", flags)
        self.good(["cmake", "--install", "build", "--prefix", "prefix"])
        installed = [path for path in (self.folder / "prefix").rglob("*") if path.is_file()]
        self.assertEqual([path.name for path in installed], ["aircraft"])

    def code_of(self, flags: str, into: str) -> dict[str, bytes]:
        """The instructions of every unit of Keel, built for the Cortex-M7 with these flags."""
        self.build(*CORTEX_M7, flags=f"{TARGET} {flags}", into=into)
        code = {}
        for path in sorted((self.folder / into / "keel").rglob("*.obj")):
            raw = path.with_suffix(".bin")
            self.good(["arm-none-eabi-objcopy", "-O", "binary", "-j", ".text*", path, raw])
            code[path.name] = raw.read_bytes()
        return code

    def test_arithmetic_of_the_proofs(self) -> None:
        """With flags that reorder sums, or fuse them with products, Keel's code stays as it is."""
        self.project(AS_FOLDER)
        plain = self.code_of("-O3", "plain")
        self.assertEqual(len(plain), len(list((ROOT / "src").rglob("*.c"))))
        self.assertEqual(self.code_of(RECKLESS, "reckless"), plain)

    def test_toolchain_file(self) -> None:
        """The target is the one of the proofs and the firmware."""
        text = (ROOT / "cmake/cortex_m7.cmake").read_text()
        self.assertIn(f'"{TARGET}"', text)


if __name__ == "__main__":
    unittest.main()
