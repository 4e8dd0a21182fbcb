#!/usr/bin/env python3
"""Check the text of the project: layout of C and C++, MISRA C:2012, and the rules of the house.

    python3 tools/lint.py           # every finding as file:line: reason
    python3 tools/lint.py --fix     # lay out the code first

Layout is clang-format's, with .clang-format, for all C and C++. MISRA C:2012 is checked by Cppcheck
and its addon over src/, the drivers of bsp/ and the headers they include, beside Cppcheck's own
checks; what it finds
stays in build/lint/cppcheck.sarif. A finding stands unless a deviation in
specs/misra_deviations.toml covers it; deviations and marks that cover nothing are findings
themselves. The texts of the guidelines cannot be distributed, so findings name the rule only.

The rules of the house: see HOUSE_CHECKS below.

Exit status: 0 without findings, 1 with, or when a tool is missing, 2 for a wrong command line.
"""

from __future__ import annotations

import argparse
import difflib
import json
import re
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from toolchain import Toolchain, ToolchainError

ROOT = Path(__file__).resolve().parents[1]
SKIPPED = frozenset({".git", "build", "__pycache__", ".mypy_cache", ".ruff_cache", ".venv"})
DEVIATIONS = "specs/misra_deviations.toml"
SARIF = "build/lint/cppcheck.sarif"
LINE_LIMIT = 100
TIMEOUT_S = 300


class LintError(Exception):
    """Something could not be checked; the message says what and why."""


class Finding(NamedTuple):
    """What is wrong, and where."""

    file: str
    line: int
    reason: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.reason}"


class Text(NamedTuple):
    """A file of the project: its path from the root, with slashes, and its lines."""

    path: str
    lines: list[str]

    @property
    def is_c(self) -> bool:
        return self.path.endswith((".c", ".h"))

    @property
    def has_layout(self) -> bool:
        """Whether it is C or C++, which clang-format lays out."""
        return self.is_c or self.path.endswith((".cpp", ".hpp"))

    @property
    def is_kernel(self) -> bool:
        """Whether it is code that is proved and flown."""
        return self.is_c and self.path.startswith(("include/", "src/"))


def read_texts(root: Path) -> list[Text]:
    """The text files below a folder, generated and version-control ones apart."""
    texts = []
    for path in sorted(root.rglob("*")):
        place = path.relative_to(root)
        if SKIPPED.isdisjoint(place.parts) and path.is_file() and not path.is_symlink():
            data = path.read_bytes()
            if b"\0" not in data:
                lines = data.decode(errors="replace").splitlines()
                texts.append(Text(place.as_posix(), lines))
    return texts


def run(command: Sequence[str], root: Path) -> subprocess.CompletedProcess[str]:
    try:
        return subprocess.run(
            command, cwd=root, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
        )
    except subprocess.TimeoutExpired:
        raise LintError(f"{command[0]} does not end within {TIMEOUT_S} s") from None


# --- Layout --------------------------------------------------------------------------------------


def clang_format(tools: Toolchain, root: Path) -> list[str]:
    return [*tools.command("clang-format-19"), f"--style=file:{root / '.clang-format'}"]


def changed_lines(before: Sequence[str], after: Sequence[str]) -> Iterator[int]:
    """The first line of each place at which two texts differ."""
    for tag, start, _, _, _ in difflib.SequenceMatcher(None, before, after, False).get_opcodes():
        if tag != "equal":
            yield start + 1


def check_layout(tools: Toolchain, root: Path, texts: Sequence[Text]) -> Iterator[Finding]:
    for text in texts:
        if text.has_layout:
            done = run([*clang_format(tools, root), text.path], root)
            if done.returncode != 0:
                raise LintError(f"clang-format fails on {text.path}:\n{done.stderr.strip()}")
            for line in changed_lines(text.lines, done.stdout.splitlines()):
                yield Finding(text.path, line, "not laid out as clang-format does (--fix does it)")


def fix_layout(tools: Toolchain, root: Path, texts: Sequence[Text]) -> None:
    paths = [text.path for text in texts if text.has_layout]
    done = run([*clang_format(tools, root), "-i", *paths], root) if paths else None
    if done and done.returncode != 0:
        raise LintError(f"clang-format fails:\n{done.stderr.strip()}")


# --- MISRA C:2012 --------------------------------------------------------------------------------


@dataclass(frozen=True)
class Deviation:
    """A departure from a rule, as the file of deviations declares it."""

    id: str
    rule: str
    reason: str
    where: tuple[str, ...]
    line: str
    marked: bool
    declared: int  # line in the file of deviations


FIELDS = frozenset({"id", "rule", "reason", "where", "line", "scope"})
SCOPES = {"project": False, "line": True}


def deviation_of(entry: dict[str, object], declared: int) -> Deviation:
    """One entry, checked: a slip in it must not let findings through."""
    name = str(entry.get("id", ""))
    if not re.fullmatch(r"MD-\d{3}", name):
        raise LintError(f"{DEVIATIONS}:{declared}: no id of the form MD-001")
    if unknown := entry.keys() - FIELDS:
        raise LintError(f"{DEVIATIONS}:{declared}: {name}: unknown field {min(unknown)}")
    where = entry.get("where")
    scope = str(entry.get("scope"))
    rule, reason = (str(entry.get(key, "")).strip() for key in ("rule", "reason"))
    if not rule or not reason or not isinstance(where, list) or not where or scope not in SCOPES:
        raise LintError(f"{DEVIATIONS}:{declared}: {name}: rule, reason, where or scope is missing")
    paths = tuple(str(path) for path in where)
    pattern = str(entry.get("line", ""))
    return Deviation(name, rule, reason, paths, pattern, SCOPES[scope], declared)


def read_deviations(root: Path) -> list[Deviation]:
    path = root / DEVIATIONS
    text = path.read_text() if path.is_file() else ""
    try:
        entries = tomllib.loads(text).get("deviation", [])
    except tomllib.TOMLDecodeError as error:
        raise LintError(f"{DEVIATIONS}: {error}") from error
    headings = [i for i, line in enumerate(text.splitlines(), 1) if line == "[[deviation]]"]
    if len(headings) != len(entries):
        raise LintError(f"{DEVIATIONS}: each entry begins with [[deviation]] on a line of its own")
    deviations = [deviation_of(*pair) for pair in zip(entries, headings, strict=True)]
    names = [deviation.id for deviation in deviations]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise LintError(f"{DEVIATIONS}: {twice[0]} is declared twice")
    return deviations


MARK = re.compile(r"MISRA deviation (MD-\d+)")


class Mark(NamedTuple):
    """A reference to a deviation in the source."""

    file: str
    line: int
    id: str


def read_marks(texts: Iterable[Text]) -> list[Mark]:
    return [
        Mark(text.path, number, name)
        for text in texts
        if text.is_kernel
        for number, line in enumerate(text.lines, 1)
        for name in MARK.findall(line)
    ]


class Violation(NamedTuple):
    """What Cppcheck found."""

    file: str
    line: int
    rule: str
    message: str


def rule_texts() -> str:
    """A text of its own for every rule, so that no two findings on one line look the same."""
    rules = [f"{chapter}.{rule}" for chapter in range(1, 24) for rule in range(1, 31)]
    texts = [f"Rule {rule} Required\nMISRA C:2012 rule {rule} is not met.\n" for rule in rules]
    return "\n".join(["Appendix A Summary of guidelines\n", *texts])


def drivers(root: Path) -> list[str]:
    """The drivers that also run on simulated hardware; what only a target can build is left out."""
    folders = ("bsp/common", "bsp/devices", "bsp/stm32f767")
    paths = [path for folder in folders for path in sorted((root / folder).glob("*.c"))]
    return [path.relative_to(root).as_posix() for path in paths]


def cppcheck_command(tools: Toolchain, root: Path) -> list[str]:
    """The command; writes the addon's settings beside the report."""
    folder = (root / SARIF).parent
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "rules.txt").write_text(rule_texts())
    addon = {"script": "misra.py", "args": [f"--rule-texts={folder / 'rules.txt'}"]}
    (folder / "misra.json").write_text(json.dumps(addon))
    return [
        *tools.command("cppcheck"), f"--addon={folder / 'misra.json'}", "--quiet", "--std=c99",
        "--enable=warning,style,performance,portability", "--check-level=exhaustive",
        "--platform=arm32-wchar_t4", "-Iinclude", "-Ibsp", "--output-format=sarif",
        f"--output-file={root / SARIF}", "src", *drivers(root),
    ]  # fmt: skip


def read_sarif(text: str) -> list[Violation]:
    violations = []
    for result in json.loads(text)["runs"][0]["results"]:
        place = result["locations"][0]["physicalLocation"]
        file = PurePosixPath(place["artifactLocation"]["uri"]).as_posix()
        rule = result["ruleId"].removeprefix("misra-c2012-")
        line = place["region"]["startLine"]
        violations.append(Violation(file, line, rule, result["message"]["text"]))
    return violations


def run_cppcheck(tools: Toolchain, root: Path) -> list[Violation]:
    report = root / SARIF
    report.unlink(missing_ok=True)
    done = run(cppcheck_command(tools, root), root)
    if done.returncode != 0 or done.stdout.strip() or not report.is_file():
        raise LintError(f"cppcheck fails:\n{done.stdout}{done.stderr}".strip())
    return read_sarif(report.read_text())


def covers(deviation: Deviation, violation: Violation, line: str, marks: Sequence[Mark]) -> bool:
    """Whether a deviation allows a violation; marks are those at the line or the one above."""
    return (
        deviation.rule == violation.rule
        and violation.file.startswith(deviation.where)
        and re.search(deviation.line, line) is not None
        and (not deviation.marked or any(mark.id == deviation.id for mark in marks))
    )


def judge(
    violations: Sequence[Violation], deviations: Sequence[Deviation], texts: Sequence[Text]
) -> Iterator[Finding]:
    """The violations that no deviation covers, then the deviations and marks without use."""
    lines = {text.path: text.lines for text in texts}
    marks = read_marks(texts)
    used: set[str] = set()
    used_marks: set[Mark] = set()
    for violation in violations:
        known = lines.get(violation.file, [])
        line = known[violation.line - 1] if 0 < violation.line <= len(known) else ""
        near = [
            mark
            for mark in marks
            if mark.file == violation.file and violation.line - mark.line in (0, 1)
        ]
        covering = [item for item in deviations if covers(item, violation, line, near)]
        used.update(item.id for item in covering)
        used_marks.update(mark for mark in near for item in covering if mark.id == item.id)
        if not covering:
            yield Finding(violation.file, violation.line, f"{violation.rule}: {violation.message}")
    for item in deviations:
        if item.id not in used:
            yield Finding(DEVIATIONS, item.declared, f"{item.id} covers no finding")
    for mark in marks:
        if mark not in used_marks:
            yield Finding(mark.file, mark.line, f"the mark of {mark.id} covers no finding")


def check_misra(tools: Toolchain, root: Path, texts: Sequence[Text]) -> Iterator[Finding]:
    if any(text.path.startswith("src/") and text.is_c for text in texts):
        yield from judge(run_cppcheck(tools, root), read_deviations(root), texts)


# --- The rules of the house ----------------------------------------------------------------------

# In two parts, so that this file does not break the rules that it checks.
UNFINISHED = re.compile(r"\b(TO" + r"DO|FIX" + r"ME|XX" + r"X)\b")
MACHINE_PATH = re.compile(r"(?<![\w.}])/(root|work|home/\w+|Users/\w+)/")
REGISTRY = re.compile(
    r"\b(pypi|pythonhosted|crates|npmjs|rubygems|docker|ghcr|quay|debian|ubuntu|golang|maven|conda)"
    r"\.(org|io|com|net)\b",
    re.IGNORECASE,
)
PROVER = re.compile(r"\b(__FRAMAC__|__CPROVER\w*|__KLEE\w*)\b")


def check_lines(text: Text, pattern: re.Pattern[str], reason: str) -> Iterator[Finding]:
    for number, line in enumerate(text.lines, 1):
        if match := pattern.search(line):
            yield Finding(text.path, number, reason.format(match[0]))


def check_words(text: Text) -> Iterator[Finding]:
    """Nothing unfinished, nothing of one machine, no name of a registry's host."""
    yield from check_lines(text, UNFINISHED, "unfinished: {}")
    yield from check_lines(text, MACHINE_PATH, "a path of one machine: {}")
    yield from check_lines(text, REGISTRY, "the name of a registry's host: {}")


def check_length(text: Text) -> Iterator[Finding]:
    """At most 100 columns; clang-format leaves comments alone. Directives are one line each."""
    if text.path.endswith((".c", ".h", ".cpp", ".hpp", ".py")):
        for number, line in enumerate(text.lines, 1):
            if len(line) > LINE_LIMIT and not DIRECTIVE.match(line):
                yield Finding(text.path, number, f"{len(line)} columns, {LINE_LIMIT} at most")


DIRECTIVE = re.compile(r"// [a-z-]+: ")
UNPROVED = re.compile(r"\b(admit|axiom)\b")
ANNOTATION = re.compile(r"/\*@.*?\*/|//@[^\n]*", re.DOTALL)
ANNOTATION_COMMENT = re.compile(r"//[^\n]*")
PROVER_INPUT = re.compile(r"^proofs/.*\.(why|mlw|driver|ml|v|smt2)$")


def statements(text: Text) -> Iterator[tuple[int, str]]:
    """What a prover reads in a file, each piece with its line; comments are blank."""
    whole = "\n".join(text.lines)
    if PROVER_INPUT.match(text.path):
        yield 1, whole
    if text.is_kernel or (text.is_c and text.path.startswith("proofs/")):
        for match in ANNOTATION.finditer(whole):
            body = match[0][:3] + ANNOTATION_COMMENT.sub("", match[0][3:])
            yield whole.count("\n", 0, match.start()) + 1, body


def check_unproved(text: Text) -> Iterator[Finding]:
    """Nothing is taken for true: no admit, no axiom. Their names in prose are no matter."""
    for first, statement in statements(text):
        for match in UNPROVED.finditer(statement):
            line = first + statement.count("\n", 0, match.start())
            yield Finding(text.path, line, f"taken for true without a proof: {match[0]}")


def check_prover(text: Text) -> Iterator[Finding]:
    """What is proved is what is built: the kernel does not know that it is being proved."""
    if text.is_kernel:
        yield from check_lines(text, PROVER, "the kernel knows a prover: {}")


def check_guard(text: Text) -> Iterator[Finding]:
    """A header's guard is named after its path."""
    if not text.path.endswith(".h") or not text.path.startswith("include/"):
        return
    place = text.path.removeprefix("include/")
    guard = re.sub(r"\W", "_", place).upper()
    directives = [(n, line) for n, line in enumerate(text.lines, 1) if line.startswith("#")]
    wanted = [f"#ifndef {guard}", f"#define {guard}"]
    if [line for _, line in directives[:2]] != wanted or directives[-1][1] != "#endif":
        line = directives[0][0] if directives else 1
        yield Finding(text.path, line, f"the include guard is not {guard}")


# The layers, and within the RTOS layer its units, from the bottom to the top. A unit includes
# units below it only; units of one rank do not know each other.
LAYERS = ("rtos", "middleware", "flight")
RTOS_UNITS = (
    ("clock", "priority", "load"), ("task",), ("queue",), ("admission", "decision"),
    ("scheduler_state",), ("pass",), ("scheduler",)
)  # fmt: skip
RTOS_RANK = {name: rank for rank, names in enumerate(RTOS_UNITS) for name in names}
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')
COMMON_HEADERS = frozenset({"keel/c_declarations.h", "keel/status.h"})
# For users alone: if the kernel included it, a new version would ask for new proofs.
VERSION_HEADER = "include/keel/version.h"
SYSTEM_HEADERS = frozenset({"float.h", "limits.h", "math.h", "stdbool.h", "stddef.h", "stdint.h"})


def unit_of(path: str) -> tuple[str, str]:
    """Layer and unit of a header or source, from its path."""
    parts = PurePosixPath(path).parts
    return (parts[-2] if len(parts) > 1 else ""), PurePosixPath(path).stem


def include_reason(path: str, quoted: bool, header: str) -> str:
    """Why a file of the kernel must not include a header; empty when it may."""
    if not quoted:
        return "" if header in SYSTEM_HEADERS else f"<{header}> is not freestanding"
    if header in COMMON_HEADERS:
        return ""
    layer, unit = unit_of(path)
    other_layer, other_unit = unit_of(header)
    if not header.startswith("keel/") or layer not in LAYERS or other_layer not in LAYERS:
        return f"{header} belongs to no layer"
    if LAYERS.index(other_layer) > LAYERS.index(layer):
        return f"{layer} includes {other_layer}, which stands above it"
    if layer != "rtos" or (unit == other_unit and path.endswith(".c")):
        return ""
    if unit not in RTOS_RANK or other_unit not in RTOS_RANK:
        return f"{unit} or {other_unit} has no place in the order of units (tools/lint.py)"
    if RTOS_RANK[other_unit] >= RTOS_RANK[unit]:
        return f"{unit} includes {other_unit}, which does not stand below it"
    return ""


def check_includes(text: Text) -> Iterator[Finding]:
    """Arrows point down only."""
    if text.is_kernel:
        for number, line in enumerate(text.lines, 1):
            match = INCLUDE.match(line)
            reason = include_reason(text.path, match[1] == '"', match[2]) if match else ""
            if reason:
                yield Finding(text.path, number, reason)


DECLARATION = re.compile(r"\bkeel_task_config_t\b(?!\s*\*)")
APART = re.compile(
    r"^static (const )?keel_task_config_t \w+[\[ ;]"  # An object of its own, or a table.
    r"|^(static )?keel_task_config_t \w+\("  # A function that gives one.
    r"|\(keel_task_config_t\)\{"  # A value, which is copied into one.
)


def check_declarations(text: Text) -> Iterator[Finding]:
    """Examples show what the kernel asks for: a declaration outlives its task's stay, and lies
    outside of the scheduler. As an object of a file it does; in a structure it may not."""
    if text.path.startswith("examples/") and text.is_c:
        for number, line in enumerate(text.lines, 1):
            if DECLARATION.search(line) and not APART.search(line):
                yield Finding(text.path, number, "the declaration of a task is no static object")


HOUSE_CHECKS: tuple[Callable[[Text], Iterator[Finding]], ...] = (
    check_words, check_length, check_unproved, check_prover, check_guard, check_includes,
    check_declarations,
)  # fmt: skip


def check_reached(texts: Sequence[Text]) -> Iterator[Finding]:
    """Every header is included by a source, directly or not: else Cppcheck does not see it."""
    kernel = {text.path: text for text in texts if text.is_kernel}
    todo = [path for path in kernel if path.endswith(".c")]
    seen = set(todo)
    while todo:
        matches = map(INCLUDE.match, kernel[todo.pop()].lines)
        headers = {f"include/{match[2]}" for match in matches if match}
        new = (headers & kernel.keys()) - seen
        seen |= new
        todo.extend(new)
    for path in sorted(kernel.keys() - seen - {VERSION_HEADER}):
        yield Finding(path, 1, "no source includes this header, so nothing checks it")


def check_house(texts: Sequence[Text]) -> Iterator[Finding]:
    for text in texts:
        for check in HOUSE_CHECKS:
            yield from check(text)
    yield from check_reached(texts)


# --- All together --------------------------------------------------------------------------------


def lint(tools: Toolchain, root: Path, fix: bool) -> list[Finding]:
    """Every finding, in the order of files and lines."""
    if fix:
        fix_layout(tools, root, read_texts(root))
    texts = read_texts(root)
    findings = [
        *check_layout(tools, root, texts),
        *check_misra(tools, root, texts),
        *check_house(texts),
    ]
    return sorted(set(findings))


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    parser = argparse.ArgumentParser(
        description="Check layout, MISRA C:2012 and the house's rules."
    )
    parser.add_argument("--fix", action="store_true", help="lay out the C code first")
    options = parser.parse_args(arguments)
    try:
        tools = Toolchain()
        tools.ensure("lint")
        findings = lint(tools, root, options.fix)
        deviations = len(read_deviations(root))
    except (LintError, ToolchainError) as error:
        print(f"lint: {error}", file=sys.stderr)
        return 1
    for finding in findings:
        print(finding)
    number = f"{len(findings)} findings" if findings else "no finding"
    print(f"lint: {number}; layout, MISRA C:2012 with {deviations} deviations, house rules.")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
