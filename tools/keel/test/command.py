# SPDX-License-Identifier: Apache-2.0
"""Build and run Keel's tests on this host.

    python3 tools/keel test                    # what a newcomer wants to see: a few minutes
    python3 tools/keel test --all              # everything
    python3 tools/keel test --filter unit/     # the suites whose name contains this
    python3 tools/keel test --jobs 1           # one after another

Suites: unit/<unit> (Unity), bsp/<driver> (Unity, on simulated hardware), property/<size> (the
scheduler against its reference model), reference/<unit> (C++, an independent computation with
Eigen in double precision), machdep (Frama-C's data model against the compiler), tools/<tool>,
timing/<part> and flight/<part> (Python). The C and C++ suites are built with the address and
undefined-behaviour sanitizers; where their libraries are missing this is said, in the output and in
the report.

Suites run side by side, as many as there are cores; tests/suites.toml says which tools they need
and which take long. So whatever a suite writes lies in a folder of its own: a temporary one, or one
below build/test. Each is told as a whole when it ends, the longest begin; the reports have them in
their order here.

A suite that does not build, crashes, hangs, or runs no test counts as a failed test of its own
name. build/test/report.json holds the verdicts, build/test/junit.xml the same for CI systems; an
unfinished run leaves none.

Exit status: 0 when at least one test ran and none failed, 1 otherwise, 2 when no test could be run.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.build import Build
from keel.base.errors import ROOT, program
from keel.base.jobs import end_as_by_ctrl_c
from keel.base.run import run
from keel.install import Toolchain
from keel.test import suites as running
from keel.test.needs import Needs, read_needs
from keel.test.outcomes import (
    EXACT_FLOATS,
    Outcome,
    program_outcome,
    pytest_outcome,
    reference_outcome,
    unity_outcome,
)
from keel.test.sources import KERNEL, SMALL, with_code
from keel.test.suites import Suite

BUILD = Path("build/test")
SUITE_TIMEOUT_S = 120
PYTEST_TIMEOUT_S = 600  # Of processor time: whole images run on the model of the chip.

SANITIZERS = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
WARNINGS = ["-Wall", "-Wextra", "-Werror", "-Wconversion"]
FLAGS = ["-std=c99", "-O1", "-g", *WARNINGS, "-Iinclude", "-Ibsp"]
CPP_FLAGS = ["-std=c++17", "-O1", "-g", *WARNINGS, "-Iinclude", "-Itests/reference"]
# It writes each verdict at once: then a crash shows behind which test it came.
UNITY_FLAGS = ["-w", "-DUNITY_USE_FLUSH_STDOUT"]

# The drivers that run on simulated hardware; what only a target can build lies in other folders.
DRIVERS = ("bsp/common/*.c", "bsp/devices/*.c", "bsp/stm32f767/*.c")

# What only this suite has: drivers of a file system that is fetched, and that file system.
FATFS_SUITE, FATFS_DRIVERS = "bsp/black_box", "bsp/fatfs"

# The property test, with its model and what drives both, runs with the queue's own capacity, and
# with one that it often fills.
PROPERTIES = "tests/property/test_scheduler.c"
CAPACITIES: dict[str, tuple[int, list[str]]] = {
    "default": (1_000_000, []),
    "small": (1_000_000, [SMALL]),
}


class HostBuilds:
    """Builds test programs, each file once a run, for suites that run side by side."""

    def __init__(self, tools: Toolchain) -> None:
        self.tools = tools
        self._lock = threading.RLock()
        self._sanitizers: list[str] | None = None
        self._builds: dict[str, Build] = {}

    @property
    def sanitizers(self) -> list[str]:
        """The sanitizers' flags, or none where a program cannot be built and run with them."""
        with self._lock:
            if self._sanitizers is None:
                self._sanitizers = SANITIZERS if self._sanitizers_work() else []
            return self._sanitizers

    def _sanitizers_work(self) -> bool:
        """Whether a program can be built and run with them; that it cannot is said."""
        probe = ROOT / BUILD / "probe.c"
        probe.write_text("int main(void)\n{\n    return 0;\n}\n")
        trial = probe.with_suffix("")
        command = [*self.tools.command("gcc"), *SANITIZERS, str(probe), "-o", str(trial)]
        works = run(command).good and run([trial]).good
        if not works:
            print("run_tests: WITHOUT sanitizers: their libraries are missing", flush=True)
        return works

    @property
    def sanitized(self) -> bool | None:
        """Whether the C suites ran with the sanitizers; None when none was built."""
        return None if self._sanitizers is None else bool(self._sanitizers)

    def build(self, compiler: str) -> Build:
        """What gcc or g++ builds."""
        with self._lock:
            if compiler not in self._builds:
                flags = [*(CPP_FLAGS if compiler == "g++" else FLAGS), *self.sanitizers]
                folder = ROOT / BUILD
                self._builds[compiler] = Build(
                    self.tools, compiler, flags, folder, ROOT, self.sanitizers
                )
            return self._builds[compiler]

    def objects(self, names: Sequence[str], extra: Sequence[str] = ()) -> list[Path]:
        """Compile C files and folders."""
        return self.build("gcc").objects(names, extra)

    def unity(self) -> Path:
        """Unity itself, without the warnings that are for our own code."""
        folder = self.tools.command("unity")[0]
        return self.build("gcc").object(f"{folder}/unity.c", ["-isystem", folder, *UNITY_FLAGS])

    def fatfs(self) -> list[Path]:
        """FatFs, without the warnings that are for our own code, and our drivers of it."""
        folder = f"{self.tools.command('fatfs')[0]}/fatfs/source"
        flags = [f"-I{FATFS_DRIVERS}", "-isystem", folder]
        own = self.objects([FATFS_DRIVERS], flags)
        return [*own, self.build("gcc").object(f"{folder}/ff.c", [*flags, "-w"])]

    def link(self, name: str, objects: Sequence[Path], compiler: str = "gcc") -> Path:
        """Link a program."""
        return self.build(compiler).link(name.replace("/", "-"), objects, ["-lm"])


def driver_sources() -> list[str]:
    """The drivers' source files."""
    return [
        path.relative_to(ROOT).as_posix() for glob in DRIVERS for path in sorted(ROOT.glob(glob))
    ]


def unit_suite(builds: HostBuilds, name: str, source: str) -> Outcome:
    """Build and run the unit tests of one file, with all of the kernel, and drivers with theirs."""
    folder = builds.tools.command("unity")[0]
    own = driver_sources() if name.startswith("bsp/") else []
    objects = [*builds.objects([*KERNEL, *own]), builds.unity()]
    if name == FATFS_SUITE:
        objects += builds.fatfs()
    objects += builds.objects([source], ["-isystem", folder, EXACT_FLOATS])
    return unity_outcome(name, run([builds.link(name, objects)], SUITE_TIMEOUT_S))


def reference_suite(builds: HostBuilds, name: str, source: str) -> Outcome:
    """Build and run one program of reference tests, with Eigen and all of the kernel."""
    eigen = ["-isystem", builds.tools.command("eigen")[0]]
    objects = [*builds.objects(KERNEL), builds.build("g++").object(source, eigen)]
    return reference_outcome(name, source, run([builds.link(name, objects, "g++")]))


def property_suite(builds: HostBuilds, name: str, size: str) -> Outcome:
    """The scheduler against its model, a given number of random operations."""
    steps, extra = CAPACITIES[size]
    sources = [*KERNEL, *with_code(PROPERTIES)]
    ended = run([builds.link(name, builds.objects(sources, extra)), "--steps", str(steps)])
    # All of it: the seed, and the shortest sequence that fails.
    return program_outcome(name, ended, ended.output.strip())


def machdep_suite() -> Outcome:
    """Frama-C's data model against the cross compiler's."""
    return program_outcome("machdep", run([sys.executable, "tests/machdep/check_machdep.py"]))


def python_suite(name: str, source: Path, group: str, may_skip: bool) -> Outcome:
    """Run the tests of one Python file."""
    report = ROOT / BUILD / f"{name.replace('/', '-')}.xml"
    report.unlink(missing_ok=True)
    options = ["-q", "-p", "no:cacheprovider", "--tb=short", f"--junitxml={report}"]
    program = ["tools/keel", "with", group, "-m", "pytest", *options, str(source)]
    ended = run([sys.executable, *program], PYTEST_TIMEOUT_S)
    return pytest_outcome(name, report, ended, may_skip)


# --- All of them ---------------------------------------------------------------------------------


def c_suites(folder: str, ending: str, run_one: Callable[[str, str], Outcome]) -> list[Suite]:
    """One for each file of a folder of tests in C or C++."""
    suites = []
    for path in sorted((ROOT / "tests" / folder).glob(f"test_*{ending}")):
        name = f"{folder}/{path.stem.removeprefix('test_')}"
        source = path.relative_to(ROOT).as_posix()
        suites.append(Suite(name, ("test",), partial(run_one, name, source)))
    return suites


def python_suites(folder: str, groups: tuple[str, ...], may_skip: bool) -> list[Suite]:
    """One for each file of a folder of tests in Python; the first group brings what runs them."""
    suites = []
    for path in sorted((ROOT / "tests" / folder).glob("test_*.py")):
        name = f"{folder}/{path.stem.removeprefix('test_')}"
        run_it = partial(python_suite, name, path, groups[0], may_skip)
        suites.append(Suite(name, groups, run_it))
    return suites


def all_suites(builds: HostBuilds, needs: Needs) -> list[Suite]:
    """Every suite, in the order of the reports."""
    unit, reference = partial(unit_suite, builds), partial(reference_suite, builds)
    suites = [
        *c_suites("unit", ".c", unit),
        *c_suites("bsp", ".c", unit),
        *c_suites("reference", ".cpp", reference),
    ]
    for size in CAPACITIES:
        name = f"property/{size}"
        suites.append(Suite(name, ("test",), partial(property_suite, builds, name, size)))
    suites.append(Suite("machdep", ("prove",), machdep_suite))
    suites += [
        *python_suites("tools", ("tools-tests", "c-syntax"), True),
        *python_suites("timing", ("timing-tests",), False),
        *python_suites("flight", ("fly-tests",), False),
        *python_suites("clients", ("clients",), False),
    ]
    return [with_needs(suite, needs) for suite in suites]


def with_needs(suite: Suite, needs: Needs) -> Suite:
    """A suite with what tests/suites.toml says of it."""
    need = needs.of(suite.name)
    groups = (*suite.groups, *need.groups)
    return replace(suite, groups=groups, seconds=need.seconds, more=need.more, waits=need.waits)


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    end_as_by_ctrl_c()
    # A suite that calls make would hand on what the make that began this was told.
    for name in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS", "ARGS", "UNIT"):
        os.environ.pop(name, None)
    parser = Parser("Build and run Keel's tests.", "test")
    running.add_options(parser)
    parser.add_argument("--all", action="store_true", help="also long suites (make test-all)")
    options = running.parse(parser, arguments)

    def work() -> int:
        running.begin(ROOT / BUILD)
        builds = HostBuilds(Toolchain())
        named = running.chosen(all_suites(builds, read_needs()), options.filter)
        left_out = [] if options.all or options.filter else [one.name for one in named if one.more]
        suites = [suite for suite in named if suite.name not in left_out]
        outcomes = running.run_all(builds.tools, suites, options.jobs)
        if left_out:
            print(f"not run, as they take long: {len(left_out)} suites (make test-all)")
        facts = {"filter": options.filter, "left_out": left_out, "sanitizers": builds.sanitized}
        return running.end(ROOT / BUILD, "Keel", outcomes, facts)

    return program("test", work)
