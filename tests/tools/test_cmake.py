#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of CMakeLists.txt: clean projects that contain Keel, on the host and for a Cortex-M7.

    python3 tests/tools/test_cmake.py
"""

from __future__ import annotations

import json
import re
import sys
import unittest
from hashlib import sha256
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from consumer import (  # noqa: E402
    AS_FOLDER,
    CORTEX_M7,
    ROOT,
    ConsumerTest,
    answer,
    keel_archive,
)
from toolchain import TARGET_FLAGS  # noqa: E402

RECKLESS = "-Ofast -ffast-math -ffp-contract=fast -fassociative-math -freciprocal-math"
TARGET = " ".join(TARGET_FLAGS)


class FolderTest(ConsumerTest):
    """add_subdirectory and FetchContent."""

    def test_as_a_folder(self) -> None:
        self.project(AS_FOLDER)
        self.build_for_both()

    def test_fetched_as_an_archive(self) -> None:
        archive = keel_archive(self.folder / "keel.tar.gz")
        digest = sha256(archive.read_bytes()).hexdigest()
        source = f"URL {archive} URL_HASH SHA256={digest}"
        lines = ["include(FetchContent)", f"FetchContent_Declare(keel {source})"]
        self.project("\n".join([*lines, "FetchContent_MakeAvailable(keel)"]))
        self.build_for_both("-DCMAKE_POLICY_DEFAULT_CMP0135=NEW")

    def test_one_layer_alone(self) -> None:
        main = '#include "keel/rtos/scheduler.h"\nint main(void) { return KEEL_QUEUE_CAPACITY; }\n'
        self.project(AS_FOLDER, "Keel::rtos", main)
        self.assertEqual(self.attempt([self.build()]).returncode, 32)

    def test_a_layer_brings_those_below(self) -> None:
        """The controller's sources call the middleware."""
        main = '#include "keel/flight/pid.h"\nstatic keel_pid_t pid;\n'
        main += "int main(void) { keel_pid_reset(&pid); return 7; }\n"
        self.project(AS_FOLDER, "Keel::flight", main)
        self.assertEqual(self.attempt([self.build()]).returncode, 7)

    def test_numbers_reach_who_uses_the_library(self) -> None:
        self.project(f"set(KEEL_QUEUE_CAPACITY 8)\n{AS_FOLDER}")
        program = self.build("-DKEEL_VOTER_SENSORS=3")
        self.assertEqual(self.attempt([program]).returncode, answer(8, 3))

    def test_the_extreme_numbers_build(self) -> None:
        self.project(AS_FOLDER)
        for capacity, sensors in ((1, 2), (255, 4)):
            numbers = [f"-DKEEL_QUEUE_CAPACITY={capacity}", f"-DKEEL_VOTER_SENSORS={sensors}"]
            program = self.build(*numbers, into=f"build-{capacity}")
            self.assertEqual(self.attempt([program]).returncode, answer(capacity, sensors))

    def test_a_bad_number_is_refused_in_words(self) -> None:
        self.project(AS_FOLDER)
        for number in ("0", "256", "many", ""):
            done = self.attempt(["cmake", "-B", "bad", f"-DKEEL_QUEUE_CAPACITY={number}"])
            self.assertNotEqual(done.returncode, 0, number)
            wanted = f"KEEL_QUEUE_CAPACITY is '{number}', not a number from 1 to 255"
            self.assertIn(wanted, " ".join(done.stderr.split()))

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
        for path in sorted((self.folder / into / "keel").rglob("*.o*")):
            if path.suffix not in (".o", ".obj"):
                continue
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


class ExampleTest(ConsumerTest):
    """What a newcomer copies."""

    def test_minimal(self) -> None:
        """Periods of 1, 4 and 20 ms, until the slowest ran 50 times: 980 ms and a little more."""
        self.good(["cmake", "-S", ROOT / "examples/minimal", "-B", "build"])
        self.good(["cmake", "--build", "build"])
        told = self.good([self.folder / "build/flight"])
        runs = dict(re.findall(r"(\w+) (\d+)", told))
        self.assertEqual(int(runs["telemetry"]), 50)
        self.assertTrue(900 <= int(runs["gyro"]) <= 1000, told)
        self.assertTrue(225 <= int(runs["control"]) <= 250, told)

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

    def test_toolchain_file(self) -> None:
        """The target is the one of the proofs and the firmware."""
        text = (ROOT / "cmake/cortex_m7.cmake").read_text()
        self.assertIn(f'"{TARGET}"', text)


if __name__ == "__main__":
    unittest.main()
