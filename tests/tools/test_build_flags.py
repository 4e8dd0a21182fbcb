# SPDX-License-Identifier: Apache-2.0
"""Tests of the flags that CMake builds Keel with: those of the proofs, whatever the project around
it asks for, and none that reaches the project's own code.
"""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

from consumer import AS_FOLDER, CORTEX_M7, ROOT, ConsumerTest, answer

from keel.install import TARGET_FLAGS

RECKLESS = "-Ofast -ffast-math -ffp-contract=fast -fassociative-math -freciprocal-math"
TARGET = " ".join(TARGET_FLAGS)

# What a project may ask of GCC, and what that does to floats, where Keel's flags do not undo it.
HARMFUL = {
    "-O2 -mfma -ffp-contract=fast": "fuses a product and a sum",
    "-O2 -fassociative-math -fno-signed-zeros -fno-trapping-math": "changes the order of sums",
    "-O2 -freciprocal-math": "divides by multiplying",
    "-O2 -fno-signed-zeros": "loses the sign of zero",
    "-O2 -ffinite-math-only": "the compiler takes it that there is no NaN",
    "-Ofast": "the compiler may compute as it likes",
}


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


class FloatsTest(ConsumerTest):
    """What CMake says of the arithmetic, which it looks at with a program of its own."""

    def configure(self, *options: str) -> tuple[int, str]:
        """The exit status of CMake in a new folder, and what it says, without its layout."""
        shutil.rmtree(self.folder / "build", ignore_errors=True)
        done = self.attempt(["cmake", "-B", "build", *options])
        return done.returncode, " ".join((done.stdout + done.stderr).split())

    def test_each_harm_is_undone_or_told(self) -> None:
        self.project(AS_FOLDER)
        fuses = " fma " in Path("/proc/cpuinfo").read_text()
        for flags, harm in HARMFUL.items():
            if "-mfma" in flags and not fuses:
                continue
            with self.subTest(flags):
                given = f"-DCMAKE_C_FLAGS={flags}"
                status, said = self.configure(given)
                self.assertEqual(status, 0, said)
                status, said = self.configure(given, "-DKEEL_FLOAT_FLAGS=")
                self.assertNotEqual(status, 0, said)
                self.assertIn(harm, said)
                self.project(f"add_compile_options({flags.replace(' ', ';')})\n{AS_FOLDER}")
                self.assertIn(harm, self.configure("-DKEEL_FLOAT_FLAGS=")[1])
                self.project(AS_FOLDER)

    def test_what_keel_cannot_undo_is_told(self) -> None:
        """GCC starts a program that was linked with this flag by flushing subnormal numbers."""
        self.project(AS_FOLDER)
        status, said = self.configure("-DCMAKE_C_FLAGS=-O2 -ffast-math")
        self.assertEqual(status, 0)
        self.assertIn("CMake Warning", said)
        self.assertIn("a program of this project flushes subnormal numbers to zero", said)

    def test_for_a_target_the_macros_are_looked_at(self) -> None:
        self.project(AS_FOLDER)
        status, said = self.configure(*CORTEX_M7)
        self.assertEqual(status, 0, said)
        self.assertIn("Keel: the check of the arithmetic was compiled, and not run", said)
        status, said = self.configure(*CORTEX_M7, "-DKEEL_FLOAT_FLAGS=-ffast-math")
        self.assertNotEqual(status, 0)
        self.assertIn("the compiler may compute as it likes", said)

    def test_other_flags_are_looked_at_anew(self) -> None:
        self.project(AS_FOLDER)
        self.assertEqual(self.configure()[0], 0)
        again = self.attempt(["cmake", "-B", "build"])
        self.assertNotIn("check of the arithmetic", again.stdout)
        other = self.attempt(["cmake", "-B", "build", "-DKEEL_FLOAT_FLAGS=-O2 -freciprocal-math"])
        self.assertNotEqual(other.returncode, 0)

    def test_every_question_has_its_words(self) -> None:
        """CMake reads an exit status as a place in its list."""
        words = re.search(r"KEEL_FLOAT_QUESTIONS(.*?)\)", self.text("KeelFloats.cmake"), re.S)
        asked = re.search(r"wrong\[\]\)\(void\) = \{(.*?)\}", self.text("float_check.c"), re.S)
        assert words is not None
        assert asked is not None
        self.assertEqual(words[1].count('"') // 2, len(re.findall(r"\w+", asked[1])))

    @staticmethod
    def text(name: str) -> str:
        """A file of cmake/."""
        return (ROOT / "cmake" / name).read_text()

    def test_another_compiler_has_its_flags_from_the_integrator(self) -> None:
        self.project(AS_FOLDER)
        status, said = self.configure("-DCMAKE_C_COMPILER=tcc")
        self.assertNotEqual(status, 0)
        self.assertIn("Say them with -DKEEL_FLOAT_FLAGS=", said)
        program = self.build("-DCMAKE_C_COMPILER=tcc", "-DKEEL_FLOAT_FLAGS=", flags="", into="tcc")
        self.assertEqual(self.attempt([program]).returncode, answer())
