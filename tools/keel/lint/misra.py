# SPDX-License-Identifier: Apache-2.0
"""MISRA C:2012 with Cppcheck, and the deviations from it."""

from __future__ import annotations

import json
import re
import shutil
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Annotated, Literal, NamedTuple

from keel.base.errors import ToolError
from keel.base.files import read_text
from keel.base.run import output_of, run
from keel.base.toml_lines import line_index
from keel.config import Field, Mistake, Table, read_toml
from keel.install import Toolchain
from keel.lint.texts import Finding, Text

DEVIATIONS = "specs/misra_deviations.toml"
SARIF = "build/lint/cppcheck.sarif"
DUMPS = "build/lint/cppcheck"  # Cppcheck would write them beside the source, while others read it.
FATFS_DRIVERS = "bsp/fatfs"


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


Stated = Annotated[str, Field(pattern=r"\S")]


class Entry(Table):
    """A deviation as written."""

    id: Annotated[str, Field(pattern=r"^MD-[0-9]{3}$")]
    rule: Stated
    reason: Stated
    scope: Literal["project", "line"]
    where: Annotated[list[Stated], Field(min_length=1)]
    line: str = ""


class Entries(Table):
    """The file of deviations: a slip in it must not let findings through."""

    deviation: list[Entry] = []


def slips(entries: Entries) -> Iterator[Mistake]:
    """What types cannot say."""
    seen: set[str] = set()
    for number, entry in enumerate(entries.deviation):
        if entry.id in seen:
            yield ("deviation", number, "id"), "is declared twice"
        seen.add(entry.id)
        try:
            re.compile(entry.line)
        except re.error as error:
            yield ("deviation", number, "line"), f"no regular expression: {error}"


def read_deviations(root: Path) -> list[Deviation]:
    """The deviations, each with the line that declares it."""
    path = root / DEVIATIONS
    if not path.is_file():
        return []
    entries = read_toml(path, Entries, slips).deviation
    lines = line_index(read_text(path))
    return [
        Deviation(
            entry.id,
            entry.rule,
            entry.reason.strip(),
            tuple(entry.where),
            entry.line,
            entry.scope == "line",
            lines["deviation", number],
        )
        for number, entry in enumerate(entries)
    ]


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
    folders = ("bsp/common", "bsp/devices", FATFS_DRIVERS, "bsp/stm32f767")
    paths = [path for folder in folders for path in sorted((root / folder).glob("*.c"))]
    return [path.relative_to(root).as_posix() for path in paths]


def fatfs_flags(tools: Toolchain, root: Path) -> list[str]:
    """Where the headers of FatFs are, which are not ours to check; nothing where nobody asks."""
    if not (root / FATFS_DRIVERS).is_dir():
        return []
    folder = f"{tools.command('fatfs')[0]}/fatfs/source"
    return [f"-I{FATFS_DRIVERS}", f"-I{folder}", f"--suppress=*:{folder}/*"]


def cppcheck_command(tools: Toolchain, root: Path) -> list[str]:
    """The command; writes the addon's settings beside the report."""
    folder = (root / SARIF).parent
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "rules.txt").write_text(rule_texts())
    addon = {"script": "misra.py", "args": [f"--rule-texts={folder / 'rules.txt'}"]}
    (folder / "misra.json").write_text(json.dumps(addon))
    return [
        *tools.command("cppcheck"),
        f"--addon={folder / 'misra.json'}",
        "--quiet",
        "--std=c99",
        f"--cppcheck-build-dir={root / DUMPS}",
        "--enable=warning,style,performance,portability",
        "--check-level=exhaustive",
        "--platform=arm32-wchar_t4",
        "-Iinclude",
        "-Ibsp",
        "--output-format=sarif",
        f"--output-file={root / SARIF}",
        *fatfs_flags(tools, root),
        "src",
        *drivers(root),
    ]


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
    shutil.rmtree(root / DUMPS, ignore_errors=True)  # It would believe what it found before.
    (root / DUMPS).mkdir(parents=True)
    done = run(cppcheck_command(tools, root), cwd=root)
    if not done.good or done.output.strip() or not report.is_file():
        raise ToolError(f"cppcheck: {done.how}\n{done.output}".strip())
    return read_sarif(report.read_text())


def covers(deviation: Deviation, violation: Violation, line: str, marks: Sequence[Mark]) -> bool:
    """Whether a deviation allows a violation; marks are those at the line or the one above."""
    return (
        deviation.rule == violation.rule
        and violation.file.startswith(deviation.where)
        and re.search(deviation.line, line) is not None
        and (not deviation.marked or any(mark.id == deviation.id for mark in marks))
    )


class Match(NamedTuple):
    """A violation, the deviations that allow it, and the marks in the source that say so."""

    violation: Violation
    deviations: tuple[Deviation, ...]
    marks: tuple[Mark, ...]


def matched(
    violations: Sequence[Violation], deviations: Sequence[Deviation], texts: Sequence[Text]
) -> Iterator[Match]:
    """Each violation with what covers it."""
    lines = {text.path: text.lines for text in texts}
    marks = read_marks(texts)
    for violation in violations:
        known = lines.get(violation.file, [])
        line = known[violation.line - 1] if 0 < violation.line <= len(known) else ""
        near = [
            mark
            for mark in marks
            if mark.file == violation.file and violation.line - mark.line in (0, 1)
        ]
        covering = tuple(item for item in deviations if covers(item, violation, line, near))
        names = {item.id for item in covering}
        yield Match(violation, covering, tuple(mark for mark in near if mark.id in names))


def judge(
    violations: Sequence[Violation], deviations: Sequence[Deviation], texts: Sequence[Text]
) -> Iterator[Finding]:
    """The violations that no deviation covers, then the deviations and marks without use."""
    matches = list(matched(violations, deviations, texts))
    used = {item.id for match in matches for item in match.deviations}
    used_marks = {mark for match in matches for mark in match.marks}
    for violation, covering, _ in matches:
        if not covering:
            yield Finding(violation.file, violation.line, f"{violation.rule}: {violation.message}")
    for item in deviations:
        if item.id not in used:
            yield Finding(DEVIATIONS, item.declared, f"{item.id} covers no finding")
    for mark in read_marks(texts):
        if mark not in used_marks:
            yield Finding(mark.file, mark.line, f"the mark of {mark.id} covers no finding")


def find_violations(tools: Toolchain, root: Path, texts: Sequence[Text]) -> list[Violation]:
    """What Cppcheck finds in the project; nothing where there is no kernel."""
    sources = any(text.path.startswith("src/") and text.is_c for text in texts)
    return run_cppcheck(tools, root) if sources else []


def rules_without_checker(tools: Toolchain) -> list[str]:
    """The rules that neither Cppcheck nor its addon looks for, as the addon itself tells."""
    program = Path(tools.versions("lint")["cppcheck"].location)
    addon = program.parent / "addons/misra.py"
    table = output_of([sys.executable, "-B", addon, "-generate-table"]).splitlines()
    return [row[0] for row in map(str.split, table) if len(row) == 1]
