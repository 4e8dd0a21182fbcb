# SPDX-License-Identifier: Apache-2.0
"""Measure which conditions of the kernel's object code the unit tests show both ways.

    python3 tools/keel coverage-target

The unit tests are built as firmware is (the board mps2_an500) and run on the Cortex-M7 that QEMU
emulates, one instruction at a time. Counted are the conditional instructions in the object code of
src/, inlined functions of include/ among them: branches (b<condition>, cbz, cbnz), the instructions
of IT blocks, and selections (vsel). Each must be seen with its condition true (taken) and false
(not taken); a computed jump is refused, for it has no two outcomes. Images of the same function
must agree, and every function of src/ must be in one of them.

What no test can show stands in specs/object_coverage.toml:

    [[uncovered]]
    function = "keel_x"           the function of the object code; a clone (.part, .isra) too
    line = "if (a && b) {"        the text of the source line, without its indentation
    never = "taken"               or "not taken"
    instructions = 2              how many of that line it is about; 1 unless set
    reason = "why it cannot be"

An entry that fits no gap, or another number of them, is an error. `untraced` are tests with so many
steps that they are left out. build/coverage-target/report.json holds all of it.

Exit status: 0 when all is seen or has a reason, 1 when not, 2 when it could not be measured.
"""

from __future__ import annotations

import os
from collections import Counter, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Annotated, Literal

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import read_text
from keel.base.run import Ended
from keel.base.source import write_report
from keel.boards.conditions import BLOCK, BRANCH, SELECTION, Conditional, Conditions
from keel.boards.elf import Symbol, read_contents
from keel.boards.firmware import Image
from keel.boards.lines import read_lines
from keel.config import Field, Mistake, Table, Text, read_toml
from keel.install import Toolchain
from keel.test.emulated import EmulatedBoard
from keel.test.emulated_tests import unit_image
from keel.test.outcomes import unity_outcome
from keel.test.trace import Outcomes, traced

REPORT = ROOT / "build/coverage-target/report.json"
REASONS = ROOT / "specs/object_coverage.toml"
SOURCE = "src"
# Whatever is compared with the model in random steps: hundreds of thousands of them, which
# instruction by instruction would take an hour. The file of reasons names other tests.
UNTRACED_END = "specified"
SHOWN = {BRANCH: "branches", BLOCK: "in IT blocks", SELECTION: "selections"}
NEVER: dict[bool, Literal["taken", "not taken"]] = {True: "taken", False: "not taken"}

Key = tuple[str, str, int]  # Source file, function, offset: an instruction, whatever the image.


class UncoveredError(ToolError):
    """Tests that fail, or do not reach all of the code: what they cover is no evidence."""

    status = 1


@dataclass
class Condition:
    """A conditional instruction of src/, and the outcomes that were seen."""

    unit: str  # the file that was compiled
    function: str
    offset: int
    kind: str
    instruction: str
    file: str  # where its source line stands: the unit, or a header
    line: int
    text: str
    seen: set[bool] = field(default_factory=set)

    def same(self, other: Condition) -> bool:
        """Whether another image has the same instruction there."""
        return (self.kind, self.instruction, self.file, self.line) == (
            other.kind,
            other.instruction,
            other.file,
            other.line,
        )


@dataclass(frozen=True)
class Gap:
    """An outcome of a condition that no test showed."""

    file: str
    line: int
    text: str
    function: str
    offset: int
    instruction: str
    never: str


class Reason(Table):
    """An outcome that no test can show, of one or more instructions of a line, and why."""

    function: Text
    line: Text
    never: Literal["taken", "not taken"]
    instructions: Annotated[int, Field(ge=1)] = 1
    reason: Text

    def explains(self, gap: Gap) -> bool:
        """True when it is about this gap."""
        function = gap.function.partition(".")[0]
        return (self.function, self.line, self.never) == (function, gap.text, gap.never)


class Reasons(Table):
    """The file of reasons."""

    untraced: list[Text] = []
    uncovered: list[Reason] = []

    def traces(self, test: Path) -> bool:
        """Whether a test is run: it has not too many steps."""
        return not name_of(test).endswith(UNTRACED_END) and name_of(test) not in self.untraced


def read_reasons(path: Path = REASONS, root: Path = ROOT) -> Reasons:
    """The reasons."""

    def unknown(reasons: Reasons) -> Iterator[Mistake]:
        tests = {name_of(path) for path in unit_tests(root)}
        for number, name in enumerate(reasons.untraced):
            if name not in tests:
                yield ("untraced", number), f"there is no tests/unit/test_{name}.c"

    return read_toml(path, Reasons, unknown)


# --- Measuring -----------------------------------------------------------------------------------


def unit_tests(root: Path) -> list[Path]:
    """The files of unit tests."""
    return sorted((root / "tests/unit").glob("test_*.c"))


def name_of(test: Path) -> str:
    """A test without what all of them begin and end with."""
    return test.stem.removeprefix("test_")


Pairs = list[tuple[Conditional, Condition]]  # Of an image, and of all images.
Found = tuple[str, Pairs]  # With the name of the test.


class Measurement:
    """Runs the unit tests' images, and puts together what they show."""

    def __init__(self, board: EmulatedBoard, root: Path = ROOT) -> None:
        self.board = board
        self.root = root
        self.finder = Conditions(board.tools)
        self.found: dict[Key, Condition] = {}
        self.functions: set[tuple[str, str]] = set()
        self._texts: dict[str, list[str]] = {}

    def run(self, sources: Sequence[str]) -> None:
        """Run files of tests: images are built one by one, while others run."""
        running: deque[tuple[Found, Future[tuple[Ended, Outcomes]]]] = deque()
        with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
            for source in sources:
                name = f"unit/{name_of(Path(source))}"
                image = unit_image(self.board, name, source)
                found = self.conditions(image)
                items = [item for item, _ in found]
                running.append(
                    (
                        (name, found),
                        pool.submit(traced, self.board.tools, self.board.board, image.elf, items),
                    )
                )
                while running and running[0][1].done():
                    self.note(*running.popleft())
            for made, run in running:
                self.note(made, run)

    def note(self, made: Found, run: Future[tuple[Ended, Outcomes]]) -> None:
        """Keep what a run has shown, once it has ended."""
        name, found = made
        ended, outcomes = run.result()
        outcome = unity_outcome(name, ended)
        if outcome.failures or not outcome.passed:
            raise UncoveredError("\n".join([f"{name}: failed on the target", *outcome.failures]))
        for item, condition in found:
            condition.seen |= outcomes[item.address]
        print(f"{name:<24} {outcome.passed:>4} passed", flush=True)

    def conditions(self, image: Image) -> Pairs:
        """The conditional instructions of src/ in an image."""
        contents = read_contents(self.board.tools, image.elf)
        lines = read_lines(self.board.tools, image.elf, (SOURCE,))
        found = []
        for function in contents.functions:
            unit = lines.at(function.address).unit
            if not unit:
                continue
            self.functions.add((unit, function.name))
            for item in self.finder.of(contents, function):
                place = lines.at(item.address)
                condition = Condition(
                    unit,
                    function.name,
                    item.offset,
                    item.kind,
                    item.text,
                    place.file,
                    place.line,
                    self.text(place.file, place.line),
                )
                found.append((item, self.known(condition)))
        return found

    def known(self, condition: Condition) -> Condition:
        """The condition as other images have it."""
        key = (condition.unit, condition.function, condition.offset)
        known = self.found.setdefault(key, condition)
        if not known.same(condition):
            raise ToolError(
                f"{key[0]}: {key[1]}+0x{key[2]:x} differs between images: "
                f"{known.instruction}, {condition.instruction}"
            )
        return known

    def text(self, file: str, line: int) -> str:
        """A line of a source file."""
        if file not in self._texts:
            self._texts[file] = read_text(self.root / file).splitlines()
        return self._texts[file][line - 1].strip()

    def check_all_functions(self) -> None:
        """Each function of src/ must have been in an image: the linker leaves out what no test
        calls."""
        absent = [f"{unit}: {name}" for unit, name in self.compiled() - self.functions]
        if absent:
            names = ", ".join(sorted(absent))
            raise UncoveredError(f"in no image, so nothing of it is seen: {names}")

    def compiled(self) -> set[tuple[str, str]]:
        """The functions that src/ has as object code."""
        objects = self.board.builder.objects([SOURCE])
        source = self.board.builder.build.sources()
        names = set()
        for path in objects:
            symbols: Iterable[Symbol] = read_contents(self.board.tools, path).functions
            names |= {(source[path], symbol.name) for symbol in symbols}
        return names


def measure(reasons: Reasons) -> tuple[list[Condition], dict[str, object]]:
    """Build and run; the conditions, and what the report says of the run."""
    tools = Toolchain()
    tools.ensure("target", "stack")
    board = EmulatedBoard(tools)
    measurement = Measurement(board)
    all_tests = unit_tests(ROOT)
    tests = [path.relative_to(ROOT).as_posix() for path in all_tests if reasons.traces(path)]
    measurement.run(tests)
    measurement.check_all_functions()
    versions = {name: item.version for name, item in tools.versions("target", "stack").items()}
    untraced = [name_of(path) for path in all_tests if not reasons.traces(path)]
    facts: dict[str, object]
    facts = {"tests": tests, "untraced": untraced, "flags": board.builder.flags, "tools": versions}
    return [measurement.found[key] for key in sorted(measurement.found)], facts


# --- The verdict ---------------------------------------------------------------------------------


def gaps_of(conditions: Iterable[Condition]) -> list[Gap]:
    """Every outcome that was not seen."""
    return [
        Gap(item.file, item.line, item.text, item.function, item.offset, item.instruction, told)
        for item in conditions
        for way, told in NEVER.items()
        if way not in item.seen
    ]


def counts(conditions: Iterable[Condition]) -> dict[str, int]:
    """Instructions, by kind and in all, and outcomes that were seen."""
    items = list(conditions)
    kinds = Counter(item.kind for item in items)
    return {
        **dict(sorted(kinds.items())),
        "conditions": len(items),
        "outcomes": 2 * len(items),
        "seen": sum(len(item.seen) for item in items),
    }


def apply(
    reasons: Sequence[Reason], gaps: Sequence[Gap]
) -> tuple[list[Gap], list[dict[str, object]], list[Reason]]:
    """Gaps without a reason, gaps with theirs, and reasons that fit none or another number."""
    explained = [
        {**asdict(gap), "reason": item.reason.strip()}
        for gap in gaps
        for item in reasons
        if item.explains(gap)
    ]
    remaining = [gap for gap in gaps if not any(item.explains(gap) for item in reasons)]
    stale = [item for item in reasons if sum(map(item.explains, gaps)) != item.instructions]
    return remaining, explained, stale


def report_of(
    conditions: Sequence[Condition], reasons: Sequence[Reason], facts: Mapping[str, object]
) -> dict[str, object]:
    """The figures of each file and function, and every gap, with its reason if it has one."""
    gaps = gaps_of(conditions)
    remaining, explained, stale = apply(reasons, gaps)
    units: dict[str, dict[str, object]] = {}
    for unit in dict.fromkeys(item.unit for item in conditions):
        own = [item for item in conditions if item.unit == unit]
        names = dict.fromkeys(item.function for item in own)
        units[unit] = {
            **counts(own),
            "functions": {
                name: counts(item for item in own if item.function == name) for name in names
            },
        }
    return {
        "total": counts(conditions),
        "files": units,
        "gaps": [asdict(gap) for gap in remaining],
        "explained": explained,
        "stale_reasons": [item.model_dump() for item in stale],
        **facts,
    }


def print_table(conditions: Sequence[Condition]) -> None:
    """A row for each file, and one for all."""
    print(f"{'file':<32}{'conditions':>12}{'outcomes seen':>16}")
    for unit in dict.fromkeys(item.unit for item in conditions):
        own = counts(item for item in conditions if item.unit == unit)
        seen = f"{own['seen']}/{own['outcomes']}"
        print(f"{unit:<32}{own['conditions']:>12}{seen:>16}")


def judge(
    conditions: Sequence[Condition], reasons: Sequence[Reason], facts: Mapping[str, object]
) -> int:
    """Print table, gaps and verdict, write the report, and give the exit status."""
    remaining, explained, stale = apply(reasons, gaps_of(conditions))
    print_table(conditions)
    for gap in remaining:
        print(
            f"{gap.file}:{gap.line}: {gap.function}+0x{gap.offset:x} {gap.instruction}: never "
            f"{gap.never}: {gap.text}"
        )
    for item in stale:
        print(
            f"{REASONS.name}: fits another number of gaps than {item.instructions}: "
            f"{item.function}: never {item.never}: {item.line}"
        )
    good = bool(conditions) and not remaining and not stale
    write_report(REPORT, report_of(conditions, reasons, facts), good=good)
    total = counts(conditions)
    told = ", ".join(f"{total[kind]} {name}" for kind, name in SHOWN.items() if kind in total)
    print(
        f"coverage-target: {total['seen']} of {total['outcomes']} outcomes of conditional "
        f"instructions ({told}); {len(explained)} cannot be, {len(remaining)} gaps, "
        f"{len(stale)} stale reasons"
    )
    return 0 if good else 1


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    Parser("Measure what the unit tests cover of the object code.", "coverage-target").parse_args(
        arguments
    )

    def work() -> int:
        REPORT.unlink(missing_ok=True)
        reasons = read_reasons()
        conditions, facts = measure(reasons)
        return judge(conditions, reasons.uncovered, facts)

    return program("coverage-target", work)
