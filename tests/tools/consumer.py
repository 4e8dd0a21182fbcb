# SPDX-License-Identifier: Apache-2.0
"""A project of somebody else, in a folder of its own, that builds on Keel."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tarfile
import tempfile
import unittest
from collections.abc import Sequence
from pathlib import Path

from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

TIMEOUT_S = 300
CORTEX_M7 = (
    f"-DCMAKE_TOOLCHAIN_FILE={ROOT}/cmake/cortex_m7.cmake",
    "-DCMAKE_EXE_LINKER_FLAGS=--specs=nosys.specs",
)
# A consumer's warnings, all of them errors: Keel's sources and headers give none.
STRICT = (
    "-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wundef -Wcast-qual -Wdouble-promotion "
    "-Wstrict-prototypes -Wmissing-prototypes -Werror"
)
CMAKE = """\
cmake_minimum_required(VERSION 3.16)
project(aircraft LANGUAGES {language})
{keel}
add_executable(aircraft {main})
target_link_libraries(aircraft PRIVATE {targets})
install(TARGETS aircraft)
"""
MAIN = """\
#include "keel/flight/pid.h"
#include "keel/middleware/virtual_imu.h"
#include "keel/rtos/scheduler.h"

static keel_scheduler_t scheduler;
static keel_voter_t voter;
static keel_pid_t pid;

int main(void)
{
    int sizes_fit = (sizeof scheduler.queue.order == KEEL_QUEUE_CAPACITY) &&
        (sizeof voter.sensor == (KEEL_VOTER_SENSORS * sizeof voter.sensor[0]));
    int refused = (keel_scheduler_init(&scheduler, 0) == KEEL_ERR_NULL) &&
        (keel_scheduler_step(0) == KEEL_ERR_NULL);
    refused = refused && (keel_voter_check(&voter.config) == KEEL_ERR_SENSORS);
    keel_pid_reset(&pid);
    return (sizes_fit && refused) ? (int)((KEEL_QUEUE_CAPACITY + 100u * KEEL_VOTER_SENSORS) % 256u)
                                  : 1;
}
"""
ALL_TARGETS = "Keel::rtos Keel::middleware Keel::flight"
AS_FOLDER = f"add_subdirectory({ROOT} keel)"


def version() -> tuple[int, int, int]:
    """Keel's version, as its header says it."""
    text = (ROOT / "include/keel/version.h").read_text()
    parts = ("MAJOR", "MINOR", "PATCH")
    found = [re.search(rf"^#define KEEL_VERSION_{part} (\d+)$", text, re.M) for part in parts]
    major, minor, patch = (int(match[1]) if match else -1 for match in found)
    return major, minor, patch


def answer(capacity: int = 32, sensors: int = 4) -> int:
    """The exit status of MAIN built with these numbers."""
    return (capacity + 100 * sensors) % 256


def keel_archive(path: Path) -> Path:
    """An archive of what a project needs of Keel, in a folder named keel."""
    with tarfile.open(path, "w:gz") as archive:
        for name in ("CMakeLists.txt", "LICENSE", "cmake", "include", "src"):
            archive.add(ROOT / name, f"keel/{name}")
    return path


class ConsumerTest(unittest.TestCase):
    """Builds a project in an empty folder with the tools of the group `consumer`."""

    tools: Toolchain

    @classmethod
    def setUpClass(cls) -> None:
        cls.tools = Toolchain()
        cls.tools.ensure("consumer", say=lambda _: None)

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def environment(self) -> dict[str, str]:
        """The pinned programs first, and no setting of the user that steers a build."""
        commands = ("cmake", "gcc", "tcc", "arm-none-eabi-gcc", "pkg-config")
        paths = [str(Path(self.tools.command(name)[0]).parent) for name in commands]
        kept = {key: os.environ[key] for key in ("HOME", "PATH") if key in os.environ}
        kept["PATH"] = os.pathsep.join([*dict.fromkeys(paths), kept["PATH"]])
        steering = {"CMAKE_GENERATOR": "Unix Makefiles", "CMAKE_BUILD_PARALLEL_LEVEL": "2"}
        return {**kept, **steering, "LC_ALL": "C"}

    def attempt(
        self, command: Sequence[str | Path], **variables: str
    ) -> subprocess.CompletedProcess[str]:
        """Run a program in the project's folder."""
        return subprocess.run(
            command,
            cwd=self.folder,
            env={**self.environment(), **variables},
            text=True,
            capture_output=True,
            timeout=TIMEOUT_S,
            check=False,
        )

    def good(self, command: Sequence[str | Path], **variables: str) -> str:
        """Run a program that must succeed; what it wrote."""
        done = self.attempt(command, **variables)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout

    def python(self, *arguments: str | Path, **variables: str) -> str:
        """Run Python with the packages of the group; what it wrote."""
        packages = self.tools.command("consumer-packages")[0]
        return self.good([sys.executable, *arguments], PYTHONPATH=packages, **variables)

    def project(
        self, keel: str, targets: str = ALL_TARGETS, main: str = MAIN, language: str = "C"
    ) -> None:
        """Write the project; `keel` are the lines that make Keel's targets known."""
        name = "main.c" if language == "C" else "main.cpp"
        lines = CMAKE.format(keel=keel, targets=targets, language=language, main=name)
        (self.folder / "CMakeLists.txt").write_text(lines)
        (self.folder / name).write_text(main)

    def build(self, *options: str, flags: str = STRICT, into: str = "build") -> Path:
        """Configure and build the project; where its program is."""
        self.good(["cmake", "-B", into, f"-DCMAKE_C_FLAGS={flags}", *options])
        self.good(["cmake", "--build", into])
        return self.folder / into / "aircraft"

    def build_for_both(self, *options: str) -> None:
        """Build for the host, where the program answers right, and for the Cortex-M7."""
        self.assertEqual(self.attempt([self.build(*options)]).returncode, answer())
        target = ["-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard"]
        flags = " ".join([*target, STRICT])
        program = self.build(*options, *CORTEX_M7, flags=flags, into="build-m7")
        self.assertEqual(program.read_bytes()[18], 40, "not a program for ARM")
