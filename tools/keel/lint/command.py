# SPDX-License-Identifier: Apache-2.0
"""Check the text of the project: layout of C and C++, MISRA C:2012, the rules of the house, and
the workflows of CI.

    python3 tools/keel lint           # every finding as file:line: reason
    python3 tools/keel lint --fix     # lay out the code first

Layout is clang-format's, with .clang-format, for all C and C++. MISRA C:2012 is checked by Cppcheck
and its addon over src/, the drivers of bsp/ and the headers they include, beside Cppcheck's own
checks; what it finds stays in build/lint/cppcheck.sarif. A finding stands unless a deviation in
specs/misra_deviations.toml covers it; deviations and marks that cover nothing are findings
themselves. The texts of the guidelines cannot be distributed, so findings name the rule only.

build/lint/results.sarif has all findings with file and line, build/lint/report.json these, what
each deviation allows, and the rules that nothing looks for; an unfinished run leaves neither.

The workflows of .github are held against the schema of GitHub's (check-jsonschema); actionlint
looks for what they name and is not there, zizmor for what strangers may use in them. None asks the
network.

ruff checks the Python of tools/ and tests/ and lays it out, and import-linter holds the order of
the rooms of tools/keel; pyproject.toml has the rules.

The rules of the house: see HOUSE_CHECKS in tools/keel/lint/house.py, and
tools/keel/lint/prose.py.

Exit status: 0 without findings, 1 with, 2 when something could not be checked.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.run import run
from keel.install import Toolchain
from keel.install.packages import provide
from keel.lint import record
from keel.lint.house import check_house
from keel.lint.misra import find_violations, judge, read_deviations
from keel.lint.python import check_python, lay_out
from keel.lint.texts import Finding, Text, read_texts

provide("ci")

from keel.lint.workflows import check_workflows

NOT_LAID_OUT = re.compile(r"^(.+?):\d+:\d+: error: code should be clang-formatted", re.MULTILINE)


def clang_format(tools: Toolchain, root: Path) -> list[str]:
    return [*tools.command("clang-format-19"), f"--style=file:{root / '.clang-format'}"]


def changed_lines(before: Sequence[str], after: Sequence[str]) -> Iterator[int]:
    """The first line of each place at which two texts differ."""
    for tag, start, _, _, _ in difflib.SequenceMatcher(None, before, after, False).get_opcodes():
        if tag != "equal":
            yield start + 1


def check_layout(tools: Toolchain, root: Path, texts: Sequence[Text]) -> Iterator[Finding]:
    """What clang-format would change: it is asked for all files at once, then for those alone."""
    paths = [text.path for text in texts if text.has_layout]
    command = [*clang_format(tools, root), "--dry-run", "-Werror", *paths]
    done = run(command, cwd=root) if paths else None
    if not done or done.good:
        return
    names = set(NOT_LAID_OUT.findall(done.output))
    if not names:
        raise ToolError(f"clang-format fails:\n{done.output.strip()}")
    for text in texts:
        if text.path in names:
            yield from differences(tools, root, text)


def differences(tools: Toolchain, root: Path, text: Text) -> Iterator[Finding]:
    """Where a file is not as clang-format writes it."""
    done = run([*clang_format(tools, root), text.path], cwd=root, apart=True)
    if not done.good:
        raise ToolError(f"clang-format fails on {text.path}:\n{done.errors.strip()}")
    for line in changed_lines(text.lines, done.output.splitlines()):
        yield Finding(text.path, line, "not laid out as clang-format does (--fix does it)")


def fix_layout(tools: Toolchain, root: Path, texts: Sequence[Text]) -> None:
    paths = [text.path for text in texts if text.has_layout]
    done = run([*clang_format(tools, root), "-i", *paths], cwd=root) if paths else None
    if done and not done.good:
        raise ToolError(f"clang-format fails:\n{done.output.strip()}")


def lint(tools: Toolchain, root: Path, fix: bool) -> list[Finding]:
    """Every finding, in the order of files and lines; what was found is written down."""
    if fix:
        fix_layout(tools, root, read_texts(root))
        lay_out(tools, root)
    texts = read_texts(root)
    violations = find_violations(tools, root, texts)
    findings = {
        "layout": list(check_layout(tools, root, texts)),
        "misra": list(judge(violations, read_deviations(root), texts)),
        "house": list(check_house(texts)),
        "python": check_python(tools, root),
        "workflows": check_workflows(tools, root, texts),
    }
    record.write(tools, root, texts, findings, violations)
    return sorted({one for every in findings.values() for one in every})


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = Parser("Check layout, MISRA C:2012, the house's rules and workflows.", "lint")
    parser.add_argument("--fix", action="store_true", help="lay out the code first")
    options = parser.parse_args(arguments)

    def work() -> int:
        record.clear(root)
        deviations = len(read_deviations(root))
        tools = Toolchain()
        tools.ensure("lint", "fatfs", "python")
        findings = lint(tools, root, options.fix)
        for finding in findings:
            print(finding)
        number = f"{len(findings)} findings" if findings else "no finding"
        print(
            f"lint: {number}; layout, MISRA C:2012 with {deviations} deviations, house rules,"
            " Python, workflows."
        )
        return 1 if findings else 0

    return program("lint", work)
