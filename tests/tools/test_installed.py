# SPDX-License-Identifier: Apache-2.0
"""Tests of what `cmake --install` leaves: clean projects that find Keel by CMake or by
pkg-config.
"""

from __future__ import annotations

import shutil
from pathlib import Path

from consumer import AS_FOLDER, CORTEX_M7, ROOT, ConsumerTest, answer, version

from keel.install import TARGET_FLAGS

FIND = "find_package(Keel {version} REQUIRED COMPONENTS {components})"
MAJOR, MINOR, _ = version()
PRESENT = f"{MAJOR}.{MINOR}"
SENSIBLE = FIND.format(version=PRESENT, components="rtos middleware flight")
TARGET = " ".join(TARGET_FLAGS)


class PackageTest(ConsumerTest):
    """find_package and pkg-config on an installed Keel, which has moved since."""

    def installed(self, *options: str) -> Path:
        """Build Keel by itself and install it; move it, so that no path of the build can help."""
        self.good(["cmake", "-S", ROOT, "-B", "keel", *options])
        self.good(["cmake", "--build", "keel"])
        self.good(["cmake", "--install", "keel", "--prefix", self.folder / "first"])
        shutil.rmtree(self.folder / "keel")
        return (self.folder / "first").rename(self.folder / "moved")

    def search(self) -> str:
        return f"-DCMAKE_PREFIX_PATH={self.folder}/moved"

    def refusal(self, version: str, components: str) -> str:
        """What CMake says to a request that the package cannot satisfy."""
        self.project(FIND.format(version=version, components=components))
        done = self.attempt(["cmake", "-B", "refused", self.search()])
        self.assertNotEqual(done.returncode, 0)
        return " ".join(done.stderr.split())

    def test_components_on_the_host(self) -> None:
        licence = self.installed() / "share/licenses/keel/LICENSE"
        self.assertEqual(licence.read_bytes(), (ROOT / "LICENSE").read_bytes())
        self.project(SENSIBLE)
        self.assertEqual(self.attempt([self.build(self.search())]).returncode, answer())

    def test_in_a_project_of_cxx_alone(self) -> None:
        self.installed()
        self.project(SENSIBLE, language="CXX")
        self.assertEqual(self.attempt([self.build(self.search())]).returncode, answer())

    def test_components_for_the_target(self) -> None:
        self.installed(*CORTEX_M7)
        self.project(SENSIBLE)
        options = [self.search(), "-DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=BOTH", *CORTEX_M7]
        program = self.build(*options, flags=TARGET)
        self.assertEqual(program.read_bytes()[18], 40, "not a program for ARM")

    def test_numbers_are_installed(self) -> None:
        self.installed("-DKEEL_QUEUE_CAPACITY=8", "-DKEEL_VOTER_SENSORS=2")
        self.project(SENSIBLE)
        self.assertEqual(self.attempt([self.build(self.search())]).returncode, answer(8, 2))

    def test_with_the_project_that_contains_it(self) -> None:
        self.project(AS_FOLDER)
        self.build("-DKEEL_INSTALL=ON")
        self.good(["cmake", "--install", "build", "--prefix", self.folder / "moved"])
        self.project(SENSIBLE)
        program = self.build(self.search(), into="other")
        self.assertEqual(self.attempt([program]).returncode, answer())

    def test_what_is_not_there_is_refused(self) -> None:
        self.installed()
        self.assertIn("Keel has no component autopilot", self.refusal(PRESENT, "rtos autopilot"))
        for other in (f"{MAJOR}.{MINOR - 1}", f"{MAJOR}.{MINOR + 1}", f"{MAJOR + 1}.0"):
            wanted = f'compatible with requested version "{other}"'
            self.assertIn(wanted, self.refusal(other, "rtos"))

    def pkg_config(self, compiler: list[str]) -> Path:
        """A program built by the compiler alone, with the flags that pkg-config gives."""
        self.project("")
        where = {"PKG_CONFIG_PATH": str(next((self.folder / "moved").rglob("pkgconfig")))}
        flags = self.good(["pkg-config", "--cflags", "--libs", "keel"], **where).split()
        self.good([*compiler, "main.c", *flags, "-o", "aircraft"])
        return self.folder / "aircraft"

    def test_pkg_config_on_the_host(self) -> None:
        self.installed("-DKEEL_QUEUE_CAPACITY=16")
        self.assertEqual(self.attempt([self.pkg_config(["gcc"])]).returncode, answer(16))

    def test_pkg_config_for_the_target(self) -> None:
        self.installed(*CORTEX_M7)
        compiler = ["arm-none-eabi-gcc", *TARGET_FLAGS, "--specs=nosys.specs"]
        self.assertEqual(self.pkg_config(compiler).read_bytes()[18], 40, "not a program for ARM")
