# SPDX-License-Identifier: Apache-2.0
"""Measure what the unit tests cover: statements (lines), branches and MC/DC.

    python3 tools/keel coverage

The unit tests are built with clang's source-based coverage and run; counted are src/ and the
inline functions of include/. Each must be covered in full: every line executed, every branch
taken both ways, every condition of every decision shown to decide it alone. What no test can
reach is listed, with the reason, in specs/coverage_exclusions.toml; an exclusion that excludes
nothing is an error. build/coverage/report.json holds the figures of every file and function, and
every gap.

Exit status: 0 when all is covered or excluded, 1 when not, 2 when it could not be measured.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from keel.base.arguments import Parser
from keel.base.build import Build, source_files
from keel.base.errors import ROOT, ToolError, program
from keel.base.run import output_of
from keel.base.source import write_report
from keel.config import Table, Text, read_toml
from keel.install import Toolchain

BUILD = ROOT / "build/coverage"
REPORT = BUILD / "report.json"
EXCLUSIONS = ROOT / "specs/coverage_exclusions.toml"
TIMEOUT_S = 120

FLAGS = ["-std=c99", "-O0", "-g", "-Iinclude"]
INSTRUMENT = ["-fprofile-instr-generate", "-fcoverage-mapping", "-fcoverage-mcdc"]
METRICS = ("lines", "branches", "mcdc")


@dataclass(frozen=True)
class Gap:
    """Something that is not covered."""

    file: str
    line: int
    text: str
    what: str


class Exclusion(Table):
    """A line that need not be covered, and why."""

    file: Text
    line: Text
    reason: Text

    def excludes(self, gap: Gap) -> bool:
        """True when it is about this gap."""
        return (self.file, self.line) == (gap.file, gap.text)


class Exclusions(Table):
    """The file of exclusions."""

    exclusion: list[Exclusion] = []


@dataclass
class FileCoverage:
    """How much of a file is covered: for each metric, covered and total."""

    lines: tuple[int, int] = (0, 0)
    branches: tuple[int, int] = (0, 0)
    mcdc: tuple[int, int] = (0, 0)
    gaps: list[Gap] = field(default_factory=list)
    functions: dict[str, FileCoverage] = field(default_factory=dict)

    def count(self, metric: str) -> tuple[int, int]:
        """Covered and total of a metric."""
        value: tuple[int, int] = getattr(self, metric)
        return value


# --- Reading what llvm-cov exports ---------------------------------------------------------------


def line_counts(lcov: str) -> dict[str, dict[int, int]]:
    """How often each line of each file was executed, from the lcov format."""
    counts: dict[str, dict[int, int]] = {}
    file: dict[int, int] = {}
    for row in lcov.splitlines():
        key, _, value = row.partition(":")
        if key == "SF":
            file = counts.setdefault(value, {})
        elif key == "DA":
            line, count = (int(part) for part in value.split(",")[:2])
            file[line] = file.get(line, 0) + count
    return counts


def branch_counts(rows: Iterable[Sequence[int]]) -> dict[tuple[int, int], tuple[int, int]]:
    """How often each branch was taken each way; an inline function's copies are added up."""
    counts: dict[tuple[int, int], tuple[int, int]] = {}
    for row in rows:
        place, taken, missed = (row[0], row[1]), row[4], row[5]
        before = counts.get(place, (0, 0))
        counts[place] = (before[0] + taken, before[1] + missed)
    return counts


def mcdc_conditions(rows: Iterable[Sequence[Any]]) -> dict[tuple[int, int], list[bool]]:
    """Which conditions of each decision were shown to decide it alone."""
    found: dict[tuple[int, int], list[bool]] = {}
    for row in rows:
        place, shown = (row[0], row[1]), list(row[-1])
        before = found.get(place, [False] * len(shown))
        found[place] = [a or b for a, b in zip(before, shown, strict=True)]
    return found


def coverage_of(
    name: str,
    text: str,
    lines: dict[int, int],
    branches: Iterable[Sequence[int]],
    decisions: Iterable[Sequence[Any]],
) -> FileCoverage:
    """The coverage of a file from its export."""
    rows = text.splitlines()
    # A macro's own line counts as executed wherever it is used; it is no statement.
    lines = {line: count for line, count in lines.items() if not rows[line - 1].startswith("#")}

    def gap(line: int, what: str) -> Gap:
        return Gap(name, line, rows[line - 1].strip(), what)

    gaps = [gap(line, "line not executed") for line, count in lines.items() if count == 0]
    ways = 0
    ways_taken = 0
    for (line, column), counts in branch_counts(branches).items():
        ways += 2
        ways_taken += sum(1 for count in counts if count > 0)
        for count, side in zip(counts, ("true", "false"), strict=True):
            if count == 0:
                gaps.append(gap(line, f"condition at column {column} is never {side}"))
    conditions = 0
    conditions_shown = 0
    for (line, column), shown in mcdc_conditions(decisions).items():
        conditions += len(shown)
        conditions_shown += sum(shown)
        for number, good in enumerate(shown, start=1):
            if not good:
                what = f"decision at column {column}: condition {number} never decides it alone"
                gaps.append(gap(line, what))
    executed = sum(1 for count in lines.values() if count > 0)
    covered = ((executed, len(lines)), (ways_taken, ways), (conditions_shown, conditions))
    return FileCoverage(*covered, sorted(gaps, key=lambda item: (item.line, item.what)))


def spans_of(functions: Iterable[Mapping[str, Any]]) -> dict[str, dict[str, range]]:
    """The lines of each function, by file and name. A static one's name begins with its file, or
    with the file that includes it."""
    found: dict[str, dict[str, range]] = {}
    for item in functions:
        first, _, last = item["regions"][0][:3]
        name = item["name"].rpartition(":")[2]
        found.setdefault(item["filenames"][0], {})[name] = range(first, last + 1)
    return found


def within(
    span: range,
    name: str,
    text: str,
    lines: dict[int, int],
    branches: Iterable[Sequence[int]],
    decisions: Iterable[Sequence[Any]],
) -> FileCoverage:
    """The coverage of one function of a file."""
    return coverage_of(
        name,
        text,
        {line: count for line, count in lines.items() if line in span},
        [row for row in branches if row[0] in span],
        [row for row in decisions if row[0] in span],
    )


# --- Exclusions ----------------------------------------------------------------------------------


def read_exclusions(path: Path = EXCLUSIONS) -> list[Exclusion]:
    """The exclusions."""
    return read_toml(path, Exclusions).exclusion if path.exists() else []


def apply(
    exclusions: Sequence[Exclusion], gaps: Sequence[Gap]
) -> tuple[list[Gap], list[Gap], list[Exclusion]]:
    """Gaps that remain, gaps that are excluded, and exclusions that exclude nothing."""
    excluded = [gap for gap in gaps if any(item.excludes(gap) for item in exclusions)]
    remaining = [gap for gap in gaps if gap not in excluded]
    unused = [item for item in exclusions if not any(item.excludes(gap) for gap in gaps)]
    return remaining, excluded, unused


# --- Building and running ------------------------------------------------------------------------


class Measurement:
    """Builds and runs the unit tests, and asks llvm-cov what they covered."""

    def __init__(self, tools: Toolchain) -> None:
        self.tools = tools
        self.programs: list[str] = []
        self.profile = str(BUILD / "all.profdata")

    def build(self) -> None:
        """Build one program for each file of unit tests."""
        unity = ["-isystem", self.tools.command("unity")[0]]
        build = Build(self.tools, "clang-19", FLAGS, BUILD, ROOT, INSTRUMENT)
        common = build.objects(["src"], INSTRUMENT)
        common.append(build.object(f"{unity[1]}/unity.c", [*unity, "-w"]))
        for path in sorted((ROOT / "tests/unit").glob("test_*.c")):
            test = build.object(path.relative_to(ROOT).as_posix(), [*INSTRUMENT, *unity])
            self.programs.append(str(build.link(path.stem, [*common, test], ["-lm"])))
        if not self.programs:
            raise ToolError("there are no unit tests")

    def run(self) -> None:
        """Run them, and merge what they executed."""
        profiles = []
        for path in self.programs:
            profile = f"{path}.profraw"
            output_of([path], TIMEOUT_S, environment={"LLVM_PROFILE_FILE": profile})
            profiles.append(profile)
        merge = [*self.tools.command("llvm-profdata-19"), "merge", "-sparse", *profiles]
        output_of([*merge, "-o", self.profile])

    def export(self, form: str) -> str:
        """What llvm-cov tells, in one of its formats."""
        objects = [word for path in self.programs[1:] for word in ("-object", path)]
        command = [*self.tools.command("llvm-cov-19"), "export", f"-format={form}"]
        profile = f"-instr-profile={self.profile}"
        folders = [str(ROOT / "src"), str(ROOT / "include")]
        return output_of([*command, profile, self.programs[0], *objects, *folders])

    def files(self) -> dict[str, FileCoverage]:
        """The coverage of every file that has code."""
        lines = line_counts(self.export("lcov"))
        exported = json.loads(self.export("text"))["data"][0]
        spans = spans_of(exported["functions"])
        found = {}
        for item in exported["files"]:
            path = Path(item["filename"])
            name = str(path.relative_to(ROOT))
            told = (
                name,
                path.read_text(),
                lines.get(str(path), {}),
                item["branches"],
                item["mcdc_records"],
            )
            measured = coverage_of(*told)
            if measured.lines[1] > 0:
                for function, span in spans.get(str(path), {}).items():
                    measured.functions[function] = within(span, *told)
                found[name] = measured
        absent = [source for source in source_files(["src"]) if source not in found]
        if absent:
            raise ToolError(f"nothing is known about {', '.join(absent)}")
        return found


# --- The verdict ---------------------------------------------------------------------------------


def share(covered: int, total: int) -> str:
    """A share in percent, rounded down, so that 100 means all."""
    return f"{covered}/{total} {100 * covered // total if total else 100:>3} %"


def total_of(files: dict[str, FileCoverage], metric: str) -> tuple[int, int]:
    """Covered and total of a metric over all files."""
    counts = [item.count(metric) for item in files.values()]
    return sum(count[0] for count in counts), sum(count[1] for count in counts)


def table(files: dict[str, FileCoverage]) -> str:
    """A row for each file, and one for all."""
    rows: list[tuple[str, ...]] = [("file", *METRICS)]
    for name, item in sorted(files.items()):
        rows.append((name, *(share(*item.count(metric)) for metric in METRICS)))
    rows.append(("all", *(share(*total_of(files, metric)) for metric in METRICS)))
    return "\n".join(f"{row[0]:<32}{row[1]:>16}{row[2]:>16}{row[3]:>16}" for row in rows)


def counts_of(item: FileCoverage) -> dict[str, tuple[int, int]]:
    """Covered and total of every metric."""
    return {metric: item.count(metric) for metric in METRICS}


def report_of(files: dict[str, FileCoverage], exclusions: Sequence[Exclusion]) -> dict[str, object]:
    """The figures of each file and function, and every gap, with its reason if it has one."""
    gaps = [gap for _, item in sorted(files.items()) for gap in item.gaps]
    remaining, excluded, unused = apply(exclusions, gaps)
    return {
        "total": {metric: total_of(files, metric) for metric in METRICS},
        "files": {
            name: {
                **counts_of(item),
                "functions": {
                    function: counts_of(own) for function, own in sorted(item.functions.items())
                },
            }
            for name, item in sorted(files.items())
        },
        "gaps": [asdict(gap) for gap in remaining],
        "excluded": [
            {**asdict(gap), "reason": next(it.reason for it in exclusions if it.excludes(gap))}
            for gap in excluded
        ],
        "unused_exclusions": [item.model_dump() for item in unused],
    }


def judge(files: dict[str, FileCoverage], exclusions: Sequence[Exclusion]) -> int:
    """Print table, gaps and verdict, write the report, and give the exit status."""
    gaps = [gap for _, item in sorted(files.items()) for gap in item.gaps]
    remaining, excluded, unused = apply(exclusions, gaps)
    good = not remaining and not unused
    print(table(files))
    for gap in remaining:
        print(f"{gap.file}:{gap.line}: {gap.what}: {gap.text}")
    for item in unused:
        print(f"{EXCLUSIONS.name}: excludes nothing: {item.file}: {item.line}")
    write_report(REPORT, report_of(files, exclusions), good=good)
    if not good:
        print(f"coverage: {len(remaining)} gaps, {len(unused)} unused exclusions")
        return 1
    print(f"coverage: all lines, branches and MC/DC conditions, {len(excluded)} gaps excluded")
    return 0


def measure() -> dict[str, FileCoverage]:
    """Build, run and read."""
    tools = Toolchain()
    tools.ensure("coverage", "test")
    measurement = Measurement(tools)
    measurement.build()
    measurement.run()
    return measurement.files()


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    Parser("Measure what Keel's unit tests cover.", "coverage").parse_args(arguments)

    def work() -> int:
        BUILD.mkdir(parents=True, exist_ok=True)
        REPORT.unlink(missing_ok=True)
        exclusions = read_exclusions()
        return judge(measure(), exclusions)

    return program("coverage", work)
