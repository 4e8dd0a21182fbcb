#!/usr/bin/env python3
"""Measure what the unit tests cover: statements (lines), branches and MC/DC.

    python3 tools/coverage.py

The unit tests are built with clang's source-based coverage and run; counted are src/ and the
inline functions of include/. Each must be covered in full: every line executed, every branch
taken both ways, every condition of every decision shown to decide it alone. What no test can
reach is listed, with the reason, in specs/coverage_exclusions.toml; an exclusion that excludes
nothing is an error. build/coverage/report.json holds the figures and every gap.

Exit status: 0 when all is covered or excluded, 1 otherwise, 2 for a wrong command line.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools"))

from toolchain import Toolchain, ToolchainError, write_atomically  # noqa: E402

BUILD = ROOT / "build/coverage"
REPORT = BUILD / "report.json"
EXCLUSIONS = ROOT / "specs/coverage_exclusions.toml"
TIMEOUT_S = 120

FLAGS = ["-std=c99", "-O0", "-g", "-Iinclude"]
INSTRUMENT = ["-fprofile-instr-generate", "-fcoverage-mapping", "-fcoverage-mcdc"]
METRICS = ("lines", "branches", "mcdc")


class CoverageError(Exception):
    """The coverage could not be measured; the message says why."""


@dataclass(frozen=True)
class Gap:
    """Something that is not covered."""

    file: str
    line: int
    text: str
    what: str


@dataclass(frozen=True)
class Exclusion:
    """A line that need not be covered, and why."""

    file: str
    line: str
    reason: str

    def excludes(self, gap: Gap) -> bool:
        """True when it is about this gap."""
        return (self.file, self.line) == (gap.file, gap.text)


@dataclass
class FileCoverage:
    """How much of a file is covered: for each metric, covered and total."""

    lines: tuple[int, int] = (0, 0)
    branches: tuple[int, int] = (0, 0)
    mcdc: tuple[int, int] = (0, 0)
    gaps: list[Gap] = field(default_factory=list)

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
    name: str, text: str, lines: dict[int, int], branches: Iterable[Sequence[int]],
    decisions: Iterable[Sequence[Any]],
) -> FileCoverage:  # fmt: skip
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


# --- Exclusions ----------------------------------------------------------------------------------


def read_exclusions(path: Path = EXCLUSIONS) -> list[Exclusion]:
    """The exclusions; each must name a file, a line and a reason, and nothing else."""
    raw = tomllib.loads(path.read_text()) if path.exists() else {}
    unknown = set(raw) - {"exclusion"}
    if unknown:
        raise CoverageError(f"{path.name}: unknown key {sorted(unknown)[0]!r}")
    exclusions = []
    for number, entry in enumerate(raw.get("exclusion", []), start=1):
        if set(entry) != {"file", "line", "reason"} or not all(entry.values()):
            raise CoverageError(f"{path.name}: exclusion {number} needs file, line and reason")
        exclusions.append(Exclusion(**{key: str(value) for key, value in entry.items()}))
    return exclusions


def apply(
    exclusions: Sequence[Exclusion], gaps: Sequence[Gap]
) -> tuple[list[Gap], list[Gap], list[Exclusion]]:
    """Gaps that remain, gaps that are excluded, and exclusions that exclude nothing."""
    excluded = [gap for gap in gaps if any(item.excludes(gap) for item in exclusions)]
    remaining = [gap for gap in gaps if gap not in excluded]
    unused = [item for item in exclusions if not any(item.excludes(gap) for gap in gaps)]
    return remaining, excluded, unused


# --- Building and running ------------------------------------------------------------------------


def output_of(command: Sequence[str], environment: dict[str, str] | None = None) -> str:
    """The output of a program; its failure is ours, with its own words."""
    try:
        done = subprocess.run(
            list(command), cwd=ROOT, env={**os.environ, **(environment or {})}, text=True,
            errors="replace", stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, timeout=TIMEOUT_S, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired as error:
        raise CoverageError(f"{Path(command[0]).name} hung") from error
    if done.returncode != 0:
        words = f"{done.stdout}{done.stderr}".strip()
        raise CoverageError(f"{Path(command[0]).name}: exit status {done.returncode}\n{words}")
    return done.stdout


def kernel_sources() -> list[str]:
    """The kernel's source files."""
    return sorted(str(path.relative_to(ROOT)) for path in (ROOT / "src").rglob("*.c"))


class Measurement:
    """Builds and runs the unit tests, and asks llvm-cov what they covered."""

    def __init__(self, tools: Toolchain) -> None:
        self.tools = tools
        self.programs: list[str] = []
        self.profile = str(BUILD / "all.profdata")

    def compile(self, source: str, extra: Sequence[str]) -> str:
        """Compile one file."""
        target = str(BUILD / f"{Path(source).stem}.o")
        output_of([*self.tools.command("clang-19"), *FLAGS, *extra, "-c", source, "-o", target])
        return target

    def build(self) -> None:
        """Build one program for each file of unit tests."""
        unity = self.tools.command("unity")[0]
        system = ["-isystem", unity]
        common = [self.compile(source, INSTRUMENT) for source in kernel_sources()]
        common.append(self.compile(f"{unity}/unity.c", [*system, "-w"]))
        for path in sorted((ROOT / "tests/unit").glob("test_*.c")):
            test = self.compile(str(path.relative_to(ROOT)), [*INSTRUMENT, *system])
            program = str(BUILD / path.stem)
            linked = [*common, test, "-lm", "-o", program]
            output_of([*self.tools.command("clang-19"), *INSTRUMENT, *linked])
            self.programs.append(program)
        if not self.programs:
            raise CoverageError("there are no unit tests")

    def run(self) -> None:
        """Run them, and merge what they executed."""
        profiles = []
        for program in self.programs:
            profile = f"{program}.profraw"
            output_of([program], {"LLVM_PROFILE_FILE": profile})
            profiles.append(profile)
        merge = [*self.tools.command("llvm-profdata-19"), "merge", "-sparse", *profiles]
        output_of([*merge, "-o", self.profile])

    def export(self, form: str) -> str:
        """What llvm-cov tells, in one of its formats."""
        objects = [word for program in self.programs[1:] for word in ("-object", program)]
        command = [*self.tools.command("llvm-cov-19"), "export", f"-format={form}"]
        profile = f"-instr-profile={self.profile}"
        folders = [str(ROOT / "src"), str(ROOT / "include")]
        return output_of([*command, profile, self.programs[0], *objects, *folders])

    def files(self) -> dict[str, FileCoverage]:
        """The coverage of every file that has code."""
        lines = line_counts(self.export("lcov"))
        exported = json.loads(self.export("text"))["data"][0]["files"]
        found = {}
        for item in exported:
            path = Path(item["filename"])
            name = str(path.relative_to(ROOT))
            counts = lines.get(str(path), {})
            measured = coverage_of(
                name, path.read_text(), counts, item["branches"], item["mcdc_records"]
            )
            if measured.lines[1] > 0:
                found[name] = measured
        absent = [source for source in kernel_sources() if source not in found]
        if absent:
            raise CoverageError(f"nothing is known about {', '.join(absent)}")
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


def write_report(
    files: dict[str, FileCoverage], remaining: list[Gap], excluded: list[Gap],
    unused: list[Exclusion],
) -> None:  # fmt: skip
    """Write the report in one go."""
    report = {
        "ok": not remaining and not unused,
        "total": {metric: total_of(files, metric) for metric in METRICS},
        "files": {
            name: {metric: item.count(metric) for metric in METRICS}
            for name, item in sorted(files.items())
        },
        "gaps": [asdict(gap) for gap in remaining],
        "excluded": [asdict(gap) for gap in excluded],
        "unused_exclusions": [asdict(item) for item in unused],
    }
    write_atomically(REPORT, json.dumps(report, indent=1) + "\n")


def judge(files: dict[str, FileCoverage], exclusions: Sequence[Exclusion]) -> int:
    """Print table, gaps and verdict, write the report, and give the exit status."""
    gaps = [gap for _, item in sorted(files.items()) for gap in item.gaps]
    remaining, excluded, unused = apply(exclusions, gaps)
    print(table(files))
    for gap in remaining:
        print(f"{gap.file}:{gap.line}: {gap.what}: {gap.text}")
    for item in unused:
        print(f"{EXCLUSIONS.name}: excludes nothing: {item.file}: {item.line}")
    write_report(files, remaining, excluded, unused)
    if remaining or unused:
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
    parser = argparse.ArgumentParser(description="Measure what Keel's unit tests cover.")
    parser.parse_args(arguments)
    BUILD.mkdir(parents=True, exist_ok=True)
    REPORT.unlink(missing_ok=True)
    try:
        exclusions = read_exclusions()
        return judge(measure(), exclusions)
    except (CoverageError, ToolchainError, tomllib.TOMLDecodeError, OSError) as error:
        print(f"coverage: {error}", file=sys.stderr)
        print("coverage: not measured")
        return 1


if __name__ == "__main__":
    sys.exit(main())
