#!/usr/bin/env python3
"""Build and run Keel's tests on this host.

    python3 tools/run_tests.py                    # everything but the fuzzer
    python3 tools/run_tests.py --filter unit/     # the suites whose name contains this
    python3 tools/run_tests.py --fuzz 60          # everything, and 60 seconds of fuzzing

Suites: unit/<unit> (Unity), bsp/<driver> (Unity, on simulated hardware), property/<size> (the
scheduler against its reference model), reference/<unit> (C++, an independent computation with
Eigen in double precision), machdep (Frama-C's data model against the compiler), tools/<tool>
(unittest), timing/<part> (pytest), fuzz (libFuzzer). The C and C++ suites are built with the
address and undefined-behaviour sanitizers; where their libraries are missing this is said, in the
output and in the report.

A suite that does not build, crashes, hangs, or runs no test counts as a failed test of its own
name. build/test/report.json holds the verdicts; an unfinished run leaves none.

Exit status: 0 when at least one test ran and none failed, 1 otherwise, 2 for a wrong command line.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools"))

from toolchain import Toolchain, ToolchainError, write_atomically  # noqa: E402

BUILD = Path("build/test")
REPORT = BUILD / "report.json"
SUITE_TIMEOUT_S = 120
PYTEST_TIMEOUT_S = 300
LINES_OF_A_CRASH = 12

SANITIZERS = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
WARNINGS = ["-Wall", "-Wextra", "-Werror", "-Wconversion"]
FLAGS = ["-std=c99", "-O1", "-g", *WARNINGS, "-Iinclude", "-Ibsp"]

# The drivers that run on simulated hardware; what only a target can build lies in other folders.
DRIVERS = ("bsp/common/*.c", "bsp/devices/*.c", "bsp/stm32f767/*.c")
CPP_FLAGS = ["-std=c++17", "-O1", "-g", *WARNINGS, "-Iinclude", "-Itests/reference"]

# The property test runs with the queue's own capacity, and with one that it often fills.
SMALL = "-DKEEL_QUEUE_CAPACITY=6u"
CAPACITIES: dict[str, tuple[int, list[str]]] = {
    "default": (1_000_000, []),
    "small": (1_000_000, [SMALL]),
}

SPECIFIED = ("admission", "admission_queue", "clock", "decision", "pass", "pass_run", "priority",
             "queue", "scheduler", "stats", "task")  # fmt: skip
MODEL_SOURCES = [f"tests/property/{name}.c" for name in ("model", "drive", "lockstep")]
MODEL_SOURCES += [f"specs/model/{name}.c" for name in SPECIFIED]


class BuildError(Exception):
    """A test program could not be built; the message is the compiler's."""


@dataclass
class Outcome:
    """How a suite went: its tests by name, and what each failure says."""

    tests: dict[str, str] = field(default_factory=dict)
    passed: int = 0
    failures: list[str] = field(default_factory=list)
    seconds: float = 0.0

    def add(self, name: str, failure: str = "") -> None:
        """Count one test."""
        self.tests[name] = "failed" if failure else "passed"
        if failure:
            self.failures.append(failure)
        else:
            self.passed += 1

    def as_dict(self) -> dict[str, Any]:
        """For the report."""
        return {
            "passed": self.passed,
            "failed": len(self.failures),
            "seconds": round(self.seconds, 1),
            "tests": self.tests,
            "failures": self.failures,
        }


@dataclass(frozen=True)
class Ended:
    """How a program ended: its exit status (negative: the signal) and what it wrote."""

    status: int
    output: str
    timed_out: bool = False

    @property
    def how(self) -> str:
        """In words."""
        if self.timed_out:
            return "hung: killed at its time limit"
        if self.status < 0:
            return f"crashed: {signal.Signals(-self.status).name}"
        return f"exit status {self.status}"

    @property
    def evidence(self) -> str:
        """The lines that say most about a crash: a sanitizer's first, or else the last ones."""
        lines = self.output.strip().splitlines()
        for number, line in enumerate(lines):
            if "runtime error:" in line or "ERROR: AddressSanitizer" in line:
                return "\n".join(lines[number : number + LINES_OF_A_CRASH])
        return "\n".join(lines[-LINES_OF_A_CRASH:])


def run(command: Sequence[str | Path], timeout_s: float = SUITE_TIMEOUT_S) -> Ended:
    """Run a program at the root of the project, with both output streams in one."""
    child = subprocess.Popen(
        [str(word) for word in command], cwd=ROOT, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
        start_new_session=True,
    )  # fmt: skip
    try:
        output, _ = child.communicate(timeout=timeout_s)
    except subprocess.TimeoutExpired:
        # The whole session: a child of the program would keep the pipe open.
        os.killpg(child.pid, signal.SIGKILL)
        output, _ = child.communicate()
        return Ended(child.returncode, output, timed_out=True)
    return Ended(child.returncode, output)


class Bench:
    """Builds test programs; remembers what was compiled in this run."""

    def __init__(self, tools: Toolchain) -> None:
        self.tools = tools
        self._objects: dict[tuple[str, ...], Path] = {}
        self._sanitizers: list[str] | None = None

    @property
    def sanitizers(self) -> list[str]:
        """The sanitizers' flags, or none where a program cannot be built and run with them."""
        if self._sanitizers is None:
            probe = ROOT / BUILD / "probe.c"
            probe.write_text("int main(void)\n{\n    return 0;\n}\n")
            program = BUILD / "probe"
            command = [*self.tools.command("gcc"), *SANITIZERS, str(probe), "-o", str(program)]
            works = run(command).status == 0 and run([ROOT / program]).status == 0
            self._sanitizers = SANITIZERS if works else []
            if not works:
                print("run_tests: WITHOUT sanitizers: their libraries are missing", flush=True)
        return self._sanitizers

    @property
    def sanitized(self) -> bool | None:
        """Whether the C suites ran with the sanitizers; None when none was built."""
        return None if self._sanitizers is None else bool(self._sanitizers)

    def object(self, source: str, extra: Sequence[str] = ()) -> Path:
        """Compile one source file, in C or (*.cpp) C++, once a run."""
        key = (source, *extra)
        if key not in self._objects:
            target = BUILD / f"{Path(source).stem}-{len(self._objects)}.o"
            compiler, own = ("g++", CPP_FLAGS) if source.endswith(".cpp") else ("gcc", FLAGS)
            flags = [*own, *self.sanitizers, *extra]
            build([*self.tools.command(compiler), *flags, "-c", source, "-o", str(target)])
            self._objects[key] = target
        return self._objects[key]

    def unity(self) -> Path:
        """Unity itself, without the warnings that are for our own code."""
        folder = self.tools.command("unity")[0]
        # It writes each verdict at once: then a crash shows behind which test it came.
        extra = ["-isystem", folder, "-w", "-DUNITY_USE_FLUSH_STDOUT"]
        return self.object(f"{folder}/unity.c", extra)

    def program(self, name: str, objects: Sequence[Path], linker: str = "gcc") -> Path:
        """Link a program."""
        target = BUILD / name.replace("/", "-")
        words = [str(item) for item in objects]
        build([*self.tools.command(linker), *self.sanitizers, *words, "-o", str(target)])
        return ROOT / target


def build(command: Sequence[str]) -> None:
    """Run a compiler; its words are the error."""
    ended = run(command)
    if ended.status != 0:
        raise BuildError(f"{ended.how} of {command[0]}:\n{ended.output.strip()}")


def kernel_sources() -> list[str]:
    """The kernel's source files."""
    return sorted(str(path.relative_to(ROOT)) for path in (ROOT / "src").rglob("*.c"))


def driver_sources() -> list[str]:
    """The drivers' source files, and the kernel's, which one of them looks at."""
    own = [str(path.relative_to(ROOT)) for glob in DRIVERS for path in sorted(ROOT.glob(glob))]
    return [*kernel_sources(), *own]


# --- Unit tests ----------------------------------------------------------------------------------

UNITY_LINE = re.compile(r"^(.+?):(\d+):(\w+):(PASS|FAIL|IGNORE)(?::? ?(.*))?$")
UNITY_SUMMARY = re.compile(r"^(\d+) Tests (\d+) Failures (\d+) Ignored", re.MULTILINE)


def unity_outcome(name: str, ended: Ended) -> Outcome:
    """Read what a Unity program wrote. An ignored test is a failed one: it tested nothing."""
    outcome = Outcome()
    for line in ended.output.splitlines():
        match = UNITY_LINE.match(line)
        if match:
            file, number, test, verdict, message = match.groups()
            failure = f"{file}:{number}: {test}: {message or verdict}"
            outcome.add(test, "" if verdict == "PASS" else failure)
    summary = UNITY_SUMMARY.search(ended.output)
    told = int(summary.group(1)) if summary else -1
    failed = len(outcome.failures)
    if ended.timed_out or told != len(outcome.tests) or ended.status != failed:
        last = list(outcome.tests)[-1:] or ["the start"]
        outcome.add(name, f"{name}: {ended.how}, after {last[0]}\n{ended.evidence}")
    return outcome


def unit_suite(bench: Bench, name: str, source: str) -> Outcome:
    """Build and run the unit tests of one file."""
    folder = bench.tools.command("unity")[0]
    sources = driver_sources() if name.startswith("bsp/") else kernel_sources()
    objects = [bench.object(item) for item in sources]
    objects += [bench.unity(), bench.object(source, ["-isystem", folder])]
    return unity_outcome(name, run([bench.program(name, objects)]))


# --- Reference tests -----------------------------------------------------------------------------

REFERENCE_LINE = re.compile(r"^(PASS|FAIL) (\S+?)(?:: (.*))?$", re.MULTILINE)
REFERENCE_SUMMARY = re.compile(r"^(\d+) passed, (\d+) failed\n*\Z", re.MULTILINE)


def reference_outcome(name: str, source: str, ended: Ended) -> Outcome:
    """Read what a reference program wrote: `PASS test` or `FAIL test: why` for each test, any
    other lines, and last `N passed, N failed`. Its exit status is 0 exactly if none failed."""
    outcome = Outcome()
    for verdict, test, message in REFERENCE_LINE.findall(ended.output):
        outcome.add(test, "" if verdict == "PASS" else f"{source}: {test}: {message or verdict}")
    summary = REFERENCE_SUMMARY.search(ended.output)
    told = (int(summary[1]), int(summary[2])) if summary else None
    failed = len(outcome.failures)
    counted = len(outcome.tests) == outcome.passed + failed  # No name twice.
    good = told == (outcome.passed, failed) and ended.status == (1 if failed else 0)
    if ended.timed_out or not counted or not good:
        last = list(outcome.tests)[-1:] or ["the start"]
        outcome.add(name, f"{name}: {ended.how}, after {last[0]}\n{ended.evidence}")
    return outcome


def reference_suite(bench: Bench, name: str, source: str) -> Outcome:
    """Build and run one program of reference tests, with Eigen and all of the kernel."""
    eigen = ["-isystem", bench.tools.command("eigen")[0]]
    objects = [bench.object(item) for item in kernel_sources()]
    objects.append(bench.object(source, eigen))
    return reference_outcome(name, source, run([bench.program(name, objects, "g++")]))


# --- Programs that are one test ------------------------------------------------------------------


def program_outcome(name: str, ended: Ended) -> Outcome:
    """A program whose exit status is its verdict."""
    outcome = Outcome()
    good = ended.status == 0 and not ended.timed_out
    outcome.add(name, "" if good else f"{name}: {ended.how}\n{ended.evidence}")
    return outcome


def property_suite(bench: Bench, name: str, size: str) -> Outcome:
    """The scheduler against its model, a given number of random operations."""
    steps, extra = CAPACITIES[size]
    sources = [*kernel_sources(), *MODEL_SOURCES, "tests/property/test_scheduler.c"]
    program = bench.program(name, [bench.object(item, extra) for item in sources])
    ended = run([program, "--steps", str(steps)])
    outcome = program_outcome(name, ended)
    if outcome.failures:  # All of it: the seed, and the shortest sequence that fails.
        outcome.failures = [f"{name}: {ended.how}\n{ended.output.strip()}"]
    return outcome


def machdep_suite(_: Bench, name: str) -> Outcome:
    """Frama-C's data model against the cross compiler's."""
    return program_outcome(name, run([sys.executable, "tests/machdep/check_machdep.py"]))


FUZZ_FINDING = re.compile(
    r"^.*(?:DIFFER|runtime error:|ERROR: AddressSanitizer|Test unit written to).*$", re.MULTILINE
)


def fuzz_program(tools: Toolchain) -> Path:
    """Build the libFuzzer target."""
    target = BUILD / "fuzz_scheduler"
    flags = ["-std=c99", "-O1", "-g", "-Iinclude", SMALL]
    flags += ["-fsanitize=fuzzer,address,undefined", "-fno-sanitize-recover=all"]
    sources = [*kernel_sources(), *MODEL_SOURCES, "tests/fuzz/fuzz_scheduler.c"]
    build([*tools.command("clang-19"), *flags, *sources, "-o", str(target)])
    return ROOT / target


def fuzz_suite(bench: Bench, name: str, seconds: int) -> Outcome:
    """Let libFuzzer look for a sequence on which the kernel and the model differ."""
    program = fuzz_program(bench.tools)
    folder = BUILD / "fuzz"  # The corpus stays there, and helps the next run.
    (ROOT / folder / "corpus").mkdir(parents=True, exist_ok=True)
    options = [f"-max_total_time={seconds}", "-max_len=4096", "-timeout=10", "-print_final_stats=1"]
    options += [f"-artifact_prefix={folder}/"]
    ended = run([program, *options, folder / "corpus"], seconds + 120.0)
    outcome = program_outcome(name, ended)
    if outcome.failures:
        told = FUZZ_FINDING.findall(ended.output) or [ended.evidence]
        again = f"to see it again: {BUILD}/fuzz_scheduler FILE"
        outcome.failures = ["\n".join([f"{name}: {ended.how}", *told, again])]
    return outcome


# --- Tests of the tools --------------------------------------------------------------------------

PYTHON_SUMMARY = re.compile(r"^Ran (\d+) tests? in ", re.MULTILINE)
PYTHON_COUNTS = re.compile(r"^(?:FAILED|OK)(?: \((.*)\))?$", re.MULTILINE)
PYTHON_FAILURE = re.compile(
    r"^={70}\n(?:FAIL|ERROR): (.*)\n(?:.*\n)?-{70}\n((?:.+\n)+)", re.MULTILINE
)
PYTHON_PLACE = re.compile(r'^  File "(.*)", line (\d+)', re.MULTILINE)


def python_failure(test: str, trace: str) -> str:
    """A failure of unittest as file:line: message."""
    places = PYTHON_PLACE.findall(trace) or [("?", "0")]
    file, line = next((place for place in reversed(places) if "/tests/" in place[0]), places[-1])
    shown = Path(file).relative_to(ROOT) if file.startswith(f"{ROOT}/") else file
    return f"{shown}:{line}: {test}: {trace.strip().splitlines()[-1]}"


def python_outcome(name: str, ended: Ended) -> Outcome:
    """Read what unittest wrote. Its tests are counted; those that failed are named."""
    outcome = Outcome()
    for test, trace in PYTHON_FAILURE.findall(ended.output):
        outcome.add(test, python_failure(test, trace))
    summary = PYTHON_SUMMARY.search(ended.output)
    counts = PYTHON_COUNTS.findall(ended.output)
    told = dict(re.findall(r"(\w+)=(\d+)", counts[-1])) if counts else {}
    failed = int(told.get("failures", 0)) + int(told.get("errors", 0))
    ran = int(summary.group(1)) if summary else 0
    outcome.passed = max(ran - failed - int(told.get("skipped", 0)), 0)
    good = ended.status == (1 if failed else 0) and counts and not ended.timed_out
    if not good or ran == 0 or failed != len(outcome.failures):
        outcome.add(name, f"{name}: {ended.how}, {ran} tests\n{ended.evidence}")
    return outcome


def python_suite(_: Bench, name: str, source: Path) -> Outcome:
    """Run the tests of one Python file."""
    where = ["-s", str(source.parent), "-p", source.name]
    return python_outcome(name, run([sys.executable, "-m", "unittest", "discover", *where]))


def pytest_outcome(name: str, report: Path, ended: Ended) -> Outcome:
    """Read pytest's report. A skipped test is a failed one: it tested nothing."""
    outcome = Outcome()
    cases = ElementTree.parse(report).iter("testcase") if report.is_file() else ()
    for case in cases:
        test = f"{case.get('classname')}.{case.get('name')}"
        wrong = [part for part in case if part.tag in ("failure", "error", "skipped")]
        told = "; ".join(f"{part.tag}: {part.get('message', '')}" for part in wrong)
        outcome.add(test, f"{test}: {told}" if wrong else "")
    if ended.timed_out or ended.status != (1 if outcome.failures else 0) or not outcome.tests:
        outcome.add(name, f"{name}: {ended.how}\n{ended.evidence}")
    return outcome


def pytest_suite(_: Bench, name: str, source: Path) -> Outcome:
    """Run the tests of one Python file that needs packages."""
    report = ROOT / BUILD / f"{name.replace('/', '-')}.xml"
    report.unlink(missing_ok=True)
    program = ["timing", "-m", "pytest", "-q", "-p", "no:cacheprovider", f"--junitxml={report}"]
    ended = run([sys.executable, "tools/with_packages.py", *program, source], PYTEST_TIMEOUT_S)
    return pytest_outcome(name, report, ended)


# --- All of them ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Suite:
    """A named set of tests, with the groups of tools that it needs."""

    name: str
    groups: tuple[str, ...]
    run: Callable[[Bench], Outcome]


def unit_suites() -> list[Suite]:
    """One for each file of unit tests."""
    suites = []
    folders = ("tests/unit", "tests/bsp")
    for path in (path for name in folders for path in sorted((ROOT / name).glob("test_*.c"))):
        name = f"{path.parent.name}/{path.stem.removeprefix('test_')}"
        source = str(path.relative_to(ROOT))
        suites.append(Suite(name, ("test",), partial(unit_suite, name=name, source=source)))
    return suites


def reference_suites() -> list[Suite]:
    """One for each file of reference tests."""
    suites = []
    for path in sorted((ROOT / "tests/reference").glob("test_*.cpp")):
        name = f"reference/{path.stem.removeprefix('test_')}"
        source = str(path.relative_to(ROOT))
        suites.append(Suite(name, ("test",), partial(reference_suite, name=name, source=source)))
    return suites


def python_suites() -> list[Suite]:
    """One for each file of tests of the tools."""
    suites = []
    for path in sorted((ROOT / "tests/tools").glob("test_*.py")):
        name = f"tools/{path.stem.removeprefix('test_')}"
        suites.append(Suite(name, (), partial(python_suite, name=name, source=path)))
    return suites


def pytest_suites() -> list[Suite]:
    """One for each file of tests of the timing tools."""
    suites = []
    for path in sorted((ROOT / "tests/timing").glob("test_*.py")):
        name = f"timing/{path.stem.removeprefix('test_')}"
        suites.append(Suite(name, ("timing",), partial(pytest_suite, name=name, source=path)))
    return suites


def property_suites() -> list[Suite]:
    """One for each capacity of the queue."""
    suites = []
    for size in CAPACITIES:
        name = f"property/{size}"
        suites.append(Suite(name, ("test",), partial(property_suite, name=name, size=size)))
    return suites


def all_suites(fuzz_seconds: int) -> list[Suite]:
    """Every suite, in the order in which they run: what fails fastest comes first."""
    suites = [*unit_suites(), *reference_suites(), *property_suites()]
    suites.append(Suite("machdep", ("prove",), partial(machdep_suite, name="machdep")))
    suites += [*python_suites(), *pytest_suites()]
    if fuzz_seconds > 0:
        run_it = partial(fuzz_suite, name="fuzz", seconds=fuzz_seconds)
        suites.append(Suite("fuzz", ("fuzz",), run_it))
    return suites


def run_suite(bench: Bench, suite: Suite) -> Outcome:
    """Run one suite; whatever keeps it from running is its failure."""
    began = time.monotonic()
    try:
        bench.tools.ensure(*suite.groups)
        outcome = suite.run(bench)
    except (BuildError, ToolchainError, OSError) as error:
        outcome = Outcome()
        outcome.add(suite.name, f"{suite.name}: {error}")
    if not outcome.passed and not outcome.failures:
        outcome.add(suite.name, f"{suite.name}: no test was run")
    outcome.seconds = time.monotonic() - began
    return outcome


def tell(name: str, outcome: Outcome) -> None:
    """One line for a suite, and its failures."""
    failed = f", {len(outcome.failures)} FAILED" if outcome.failures else ""
    print(f"{name:<24} {outcome.passed:>4} passed{failed}  ({outcome.seconds:.1f} s)", flush=True)
    for failure in outcome.failures:
        print(failure, flush=True)


def write_report(bench: Bench, outcomes: dict[str, Outcome], chosen: str) -> tuple[int, int]:
    """Write the report in one go, and give the totals."""
    passed = sum(outcome.passed for outcome in outcomes.values())
    failed = sum(len(outcome.failures) for outcome in outcomes.values())
    report = {
        "passed": passed,
        "failed": failed,
        "filter": chosen,
        "sanitizers": bench.sanitized,
        "suites": {name: outcome.as_dict() for name, outcome in outcomes.items()},
    }
    write_atomically(ROOT / REPORT, json.dumps(report, indent=1) + "\n")
    return passed, failed


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Build and run Keel's tests.")
    parser.add_argument("--filter", default="", metavar="TEXT", help="suites whose name has this")
    parser.add_argument("--fuzz", type=int, default=0, metavar="SECONDS", help="fuzz as well")
    options = parser.parse_args(arguments)
    (ROOT / BUILD).mkdir(parents=True, exist_ok=True)
    (ROOT / REPORT).unlink(missing_ok=True)
    bench = Bench(Toolchain())
    outcomes: dict[str, Outcome] = {}
    for suite in all_suites(options.fuzz):
        if options.filter in suite.name:
            outcomes[suite.name] = run_suite(bench, suite)
            tell(suite.name, outcomes[suite.name])
    passed, failed = write_report(bench, outcomes, options.filter)
    if not outcomes:
        print(f"run_tests: no suite's name contains {options.filter!r}", file=sys.stderr)
    print(f"{passed} passed, {failed} failed")
    return 0 if passed > 0 and failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
