# SPDX-License-Identifier: Apache-2.0
"""Build and run the unit tests of a project that uses Keel: its tests/unit/test_*.c, with Unity.

    python3 tools/keel test-project --project FOLDER

Each file is a program, linked with all of the project's src/ and of Keel's. build/test/junit.xml in
the project has the results, report.json beside it the same with the source that they are of.

Exit status: 0 when all tests pass, 1 when one fails, 2 when they cannot be built.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.build import Build
from keel.base.errors import ROOT, ToolError, program
from keel.base.junit import JUnitSuite, write_junit
from keel.base.run import run
from keel.base.source import write_report
from keel.install import Toolchain

FLAGS = (
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-g",
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
)
LINE = re.compile(r"^(?P<place>\S+:\d+):(?P<test>\w+):(?P<verdict>PASS|FAIL)(?::(?P<why>.*))?$")
SUMMARY = re.compile(r"^(\d+) Tests (\d+) Failures", re.MULTILINE)


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("test", lambda: test(arguments))


def test(arguments: Sequence[str] | None) -> int:
    """Build and run the tests of a project."""
    parser = Parser(__doc__.partition("\n")[0], prog="test")
    parser.add_argument("--project", type=Path, required=True, metavar="FOLDER")
    root: Path = parser.parse_args(arguments).project.resolve()
    tests = sorted((root / "tests/unit").glob("test_*.c"))
    if not tests:
        raise ToolError(f"{root}: there is no tests/unit/test_*.c")
    tools = Toolchain()
    tools.ensure("own-test")
    unity = tools.command("unity")[0]
    include = ("-Iinclude", f"-I{ROOT}/include", "-isystem", unity)
    build = Build(tools, "gcc", (*FLAGS, *include), root / "build/test", root, FLAGS)
    shared = [*build.objects(["src"]), *keel(tools, root).objects(["src"])]
    shared.append(build.object(f"{unity}/unity.c"))
    suites = {path.stem: outcome(build, path, shared) for path in tests}
    write_junit(root / "build/test/junit.xml", "unit tests", suites)
    status = conclude(suites)
    told = {name: suite.tests for name, suite in suites.items()}
    write_report(root / "build/test/report.json", {"suites": told}, root, good=not status)
    return status


def keel(tools: Toolchain, root: Path) -> Build:
    """What builds Keel's own sources, below the project's folder."""
    return Build(tools, "gcc", (*FLAGS, "-Iinclude"), root / "build/test/keel", ROOT)


def outcome(build: Build, path: Path, shared: Sequence[Path]) -> JUnitSuite:
    """Build and run a file of tests; what each test said, and the program if it broke off."""
    source = str(path.relative_to(build.root))
    ended = run([build.link(path.stem, [*shared, build.object(source)])], cwd=build.root)
    found = [match for line in ended.output.splitlines() if (match := LINE.match(line))]
    tests = {
        match["test"]: ""
        if match["verdict"] == "PASS"
        else f"{match['place']}: {(match['why'] or '').strip()}"
        for match in found
    }
    told = SUMMARY.search(ended.output)
    if not told or int(told[1]) != len(tests) or ended.timed_out:
        tests[path.stem] = f"{ended.how}\n{ended.evidence}"
    return JUnitSuite(tests)


def conclude(suites: dict[str, JUnitSuite]) -> int:
    """Tell what failed, and how many passed; the exit status."""
    failures = [
        (name, text) for suite in suites.values() for name, text in suite.tests.items() if text
    ]
    for name, text in failures:
        print(f"FAILED {name}: {text}")
    total = sum(len(suite.tests) for suite in suites.values())
    print(f"{total - len(failures)} of {total} tests passed")
    return 1 if failures or not total else 0
