# SPDX-License-Identifier: Apache-2.0
"""Tests of what a newcomer copies: examples/minimal, and the README's files and commands."""

from __future__ import annotations

import re
import resource
import shutil

from consumer import ROOT, ConsumerTest

from keel.install import TARGET_FLAGS


class ExampleTest(ConsumerTest):
    """What a newcomer copies."""

    def test_minimal(self) -> None:
        """Periods of 1, 4 and 20 ms, until the slowest ran 50 times: 980 ms and a little more.

        Of them the program sleeps most. A busy host costs runs of the others.
        """
        self.good(["cmake", "-S", ROOT / "examples/minimal", "-B", "build"])
        self.good(["cmake", "--build", "build"])
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        told = self.good([self.folder / "build/flight"])
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        runs = {name: int(count) for name, count in re.findall(r"(\w+) (\d+)", told)}
        self.assertEqual(runs["telemetry"], 50)
        self.assertTrue(50 < runs["control"] < runs["gyro"], told)
        # One that polls takes the processor for all of 980 ms.
        self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 0.5)

    def blocks(self) -> dict[str, str]:
        """The fenced blocks of the README's section, by language."""
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        section = re.search(r"^## Use it in your firmware\n(.*?)(?=^## |\Z)", text, re.M | re.S)
        self.assertIsNotNone(section, "README.md has no such section")
        assert section is not None
        found = re.findall(r"^```(\w+)\n(.*?)^```$", section[1], re.M | re.S)
        self.assertEqual(sorted(name for name, _ in found), ["c", "cmake", "sh"])
        return dict(found)

    def test_readme(self) -> None:
        """The README's very files and commands, in an empty folder beside Keel."""
        blocks = self.blocks()
        (self.folder / "keel").symlink_to(ROOT)
        (self.folder / "CMakeLists.txt").write_text(blocks["cmake"])
        (self.folder / "main.c").write_text(blocks["c"])
        told = self.good(["bash", "-euc", blocks["sh"]], CFLAGS="-Wall -Wextra -Werror")
        self.assertRegex(told, r"telemetry (ran )?50")

    def test_makefile_of_the_scheduler_alone(self) -> None:
        """The documents' Makefile, the README's program, and no file of Keel but those named."""
        text = (ROOT / "docs/integration.md").read_text(encoding="utf-8")
        [makefile] = re.findall(r"^```make\n(.*?)^```$", text, re.M | re.S)
        self.assertEqual(len(makefile.splitlines()), 5)
        shutil.copytree(ROOT / "src/rtos", self.folder / "keel/src/rtos")
        shutil.copytree(ROOT / "include", self.folder / "keel/include")
        sources = list((self.folder / "keel/src").rglob("*.c"))
        self.assertIn("twelve files" if len(sources) == 12 else "", text)
        (self.folder / "Makefile").write_text(makefile)
        (self.folder / "main.c").write_text(self.blocks()["c"])
        self.good(["make"])
        self.assertRegex(self.good([self.folder / "flight"]), "telemetry 50 times")

    def test_the_scheduler_calls_nobody(self) -> None:
        """What its objects leave to the linker is theirs, or what a compiler may call by itself."""
        compiler = ["arm-none-eabi-gcc", *TARGET_FLAGS, "-std=c99", "-O2", f"-I{ROOT}/include"]
        for source in sorted((ROOT / "src/rtos").glob("*.c")):
            self.good([*compiler, "-c", source, "-o", f"{source.stem}.o"])
        objects = sorted(path.name for path in self.folder.glob("*.o"))
        told = self.good(["arm-none-eabi-nm", *objects])
        defined = set(re.findall(r" [TDBR] (\w+)", told))
        self.assertGreater(len(defined), 10)
        left = set(re.findall(r" U (\w+)", told)) - defined
        of_compiler = {"memcpy", "memmove", "memset", "__aeabi_ldivmod", "__aeabi_uldivmod"}
        self.assertLessEqual(left, of_compiler)
