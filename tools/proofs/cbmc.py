"""Proves harnesses with CBMC, on goto binaries of the very sources, built for the target."""

from __future__ import annotations

import json
import os
import re
import shutil
import time
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from . import harness as harnesses
from .cache import write_atomically
from .harness import Harness
from .jobs import Finished, Runner
from .project import closure
from .wrong import WrongBody

CHECKS = (
    "--unwinding-assertions", "--bounds-check", "--pointer-check", "--pointer-overflow-check",
    "--pointer-primitive-check", "--div-by-zero-check", "--float-div-by-zero-check",
    "--signed-overflow-check", "--unsigned-overflow-check", "--conversion-check",
    "--undefined-shift-check", "--float-overflow-check", "--nan-check", "--enum-range-check",
    "--drop-unused-functions",
)  # fmt: skip
# What a harness that checks assertions alone is checked for.
ASSERTIONS = ("--no-standard-checks", "--unwinding-assertions", "--drop-unused-functions")
# The coverage run asks what can be reached at all. CBMC takes assertions for assumptions there.
COVERAGE = ("--cover", "location", "--no-standard-checks", "--drop-unused-functions")
HARMLESS = (
    # Said of every coverage run; the proof itself has unwinding assertions.
    "--cover is incompatible with --unwinding-assertions",
    "Use --unwinding-assertions to obtain sound verification results",
)
ASSERTION = re.compile(r"\.assertion\.\d+$")


@dataclass
class Result:
    """What became of a harness."""

    properties: list[dict[str, str]] = field(default_factory=list)
    defines: list[str] = field(default_factory=list)
    replaces: list[str] = field(default_factory=list)
    checks: str = "all"
    covered: int = 0
    blocks: int = 0
    problems: list[str] = field(default_factory=list)
    seconds: float = 0.0

    def as_dict(self) -> dict[str, Any]:
        """For the cache."""
        return asdict(self)


@dataclass(frozen=True)
class Answer:
    """CBMC's JSON output, taken apart."""

    properties: list[dict[str, str]]
    goals: list[dict[str, Any]]
    warnings: list[str]
    complete: bool
    failed: bool = False
    first_failure: str = ""


def checks_of(harness: Harness) -> tuple[str, ...]:
    """What CBMC is to look for."""
    return ASSERTIONS if harness.assertions_only else CHECKS


def file_of(location: dict[str, Any]) -> str:
    """File of a source location."""
    return os.path.normpath(str(location.get("file", "?")))


def place(location: dict[str, Any]) -> str:
    """File and line of a source location."""
    return f"{file_of(location)}:{location.get('line', '?')}"


def read_answer(text: str) -> Answer:
    """Read CBMC's JSON output. Output that breaks off is not complete."""
    try:
        entries = json.loads(text)
    except ValueError:
        return Answer([], [], ["CBMC's output breaks off"], complete=False)
    properties: list[dict[str, str]] = []
    goals: list[dict[str, Any]] = []
    warnings: list[str] = []
    complete = failed = False
    first_failure = ""
    for entry in entries if isinstance(entries, list) else []:
        if entry.get("messageType") in ("WARNING", "ERROR"):
            warnings.append(str(entry.get("messageText", "")))
        for item in entry.get("result", []):
            location = item.get("sourceLocation", {})
            properties.append(
                {
                    "name": str(item["property"]), "description": str(item["description"]),
                    "status": str(item["status"]), "place": place(location),
                    "function": str(location.get("function", "")),
                }
            )  # fmt: skip
        goals += entry.get("goals", [])
        # A solver that crashes or says `unknown` makes it "error".
        ended = entry.get("cProverStatus") in ("success", "failure")
        complete = complete or ended or "goalsCovered" in entry
        failed = failed or entry.get("cProverStatus") == "failure"
        for step in entry.get("trace", []):  # what --stop-on-fail shows
            if step.get("stepType") == "failure":
                first_failure = str(step.get("reason", ""))
    return Answer(properties, goals, warnings, complete, failed, first_failure)


def numbers(ranges: str) -> set[int]:
    """The lines in "18,20-22"."""
    lines: set[int] = set()
    for part in ranges.split(","):
        first, _, last = part.partition("-")
        lines.update(range(int(first), int(last or first) + 1))
    return lines


POINTER_CALL = re.compile(r"[.>]\w+\(")


@dataclass(frozen=True)
class Block:
    """A basic block of the code and whether any execution reaches it."""

    function: str
    places: frozenset[tuple[str, int]]
    first: str
    reached: bool


def blocks(goals: Iterable[dict[str, Any]]) -> list[Block]:
    """The blocks of a coverage run."""
    found = []
    for goal in goals:
        places = frozenset(
            (os.path.normpath(file), line)
            for file, functions in goal.get("basicBlockLines", {}).items()
            for ranges in functions.values()
            for line in numbers(ranges)
        )
        location = goal.get("sourceLocation", {})
        function = str(location.get("function", ""))
        found.append(Block(function, places, place(location), goal.get("status") == "satisfied"))
    return found


def proof_problems(answer: Answer) -> list[str]:
    """Every property that is not proved, and reasons not to believe the rest."""
    problems = [
        f"{item['place']}: {item['description']}: {item['status']} ({item['name']})"
        for item in answer.properties
        if item["status"] != "SUCCESS"
    ]
    problems += [text for text in answer.warnings if not any(known in text for known in HARMLESS)]
    if not answer.complete:
        problems.append("CBMC did not finish")
    elif not any(ASSERTION.search(item["name"]) for item in answer.properties):
        problems.append("there is no assertion in it")
    return problems


def coverage_problems(
    found: Sequence[Block], harness: Harness, properties: Sequence[dict[str, str]]
) -> list[str]:
    """What no execution reaches: the harness's end, an assertion, a block of what it covers."""
    problems = []
    ends = [block for block in found if block.function == harness.name]
    last = max((line for block in ends for _, line in block.places), default=0)
    if not any(block.reached and any(line == last for _, line in block.places) for block in ends):
        problems.append(
            "no execution reaches the harness's end: its assumptions contradict each other"
        )
    reached = {f"{file}:{line}" for block in found if block.reached for file, line in block.places}
    for item in properties:
        if ASSERTION.search(item["name"]) and item["place"] not in reached:
            problems.append(f"{item['place']}: no execution reaches this assertion")
    for function in harness.covers:
        own = [block for block in found if block.function == function]
        if not own:
            problems.append(f"{function} is covered nowhere: it is never called")
        problems += [
            f"{block.first}: not reached in {function}"
            for block in own
            if not block.reached and not _is_dispatch(block, reached, harness.unit.root)
        ]
    return list(dict.fromkeys(problems))


def _is_dispatch(block: Block, reached: frozenset[str] | set[str], root: Path) -> bool:
    """Whether a block is only what CBMC makes of a call through a pointer that hits no function.

    CBMC turns the call into a choice of functions and a remainder that no valid pointer reaches.
    The call's own line is reached all the same, or this is no such block.
    """
    return bool(block.places) and all(
        f"{file}:{line}" in reached
        and POINTER_CALL.search((root / file).read_text(encoding="utf-8").splitlines()[line - 1])
        for file, line in block.places
    )


class Cbmc:
    """CBMC and its compiler for the target."""

    def __init__(
        self, goto_cc: Sequence[str], cbmc: Sequence[str], runner: Runner, root: Path, scratch: Path
    ) -> None:
        self._goto_cc = list(goto_cc)
        self._cbmc = list(cbmc)
        self._runner = runner
        self._root = root
        self._scratch = scratch

    def options(self) -> list[str]:
        """What is the same for all harnesses."""
        return [*self._goto_cc[1:], *CHECKS, *ASSERTIONS, *COVERAGE]

    def prove(self, harness: Harness) -> Result:
        """Prove a harness and measure what it reaches."""
        start = time.monotonic()
        problems = harnesses.text_problems(harness)
        result = Result(
            problems=problems, defines=list(harness.defines), replaces=list(harness.replaces),
            checks="assertions" if harness.assertions_only else "all",
        )  # fmt: skip
        binary, complaint = self.build(harness, harness.name)
        if complaint:
            result.problems.append(complaint)
        else:
            answer = self.check(harness, binary)
            result.properties = answer.properties
            result.problems += proof_problems(answer)
            self._measure(harness, binary, result)
        shown = harness.path.relative_to(self._root)
        result.problems = [f"{shown}: {text}" if not text.startswith(str(shown)) else text
                           for text in result.problems]  # fmt: skip
        result.seconds = round(time.monotonic() - start, 1)
        return result

    def refute(self, wrong: WrongBody, harness: Harness) -> Result:
        """Show that a harness notices a wrong body, by the assertions that it should."""
        start = time.monotonic()
        result = Result()
        binary, complaint = self.build(harness, f"{harness.name}-{wrong.name}", wrong)
        if complaint:
            result.problems.append(f"{wrong.shown}: {complaint}")
        else:
            answer = self.check(harness, binary, self._selection(harness, binary, wrong.expect))
            result.problems += refutation_problems(answer, wrong)
            if result.problems:
                other = self.check(harness, binary, ["--stop-on-fail"]).first_failure
                result.problems[0] += f"; what fails is: {other or 'nothing'}"
        result.seconds = round(time.monotonic() - start, 1)
        return result

    def check(self, harness: Harness, binary: Path, extra: Sequence[str] = ()) -> Answer:
        """Ask for the status of every property."""
        command = [*self._cbmc, str(binary), "--json-ui", *checks_of(harness)]
        command += [*harness.options, *extra]
        return self._answer(self._runner.run(command, harness.timeout, merged=False), harness)

    def _selection(self, harness: Harness, binary: Path, expect: Sequence[str]) -> list[str]:
        """Options that restrict CBMC to the assertions that are to fail: all others take longer."""
        command = [*self._cbmc, str(binary), "--json-ui", "--show-properties", *checks_of(harness)]
        done = self._runner.run(command, harness.timeout, merged=False)
        return selection(done.output, expect)

    def build(
        self, harness: Harness, name: str, wrong: WrongBody | None = None
    ) -> tuple[Path, str]:
        """Compile and link; the binary, and the compiler's complaint if there is one.

        A wrong body takes the place of the file that it changes, be it a source or a header.
        """
        folder = self._scratch / "cbmc" / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        include = ["-Iinclude"]
        sources = list(harness.sources)
        if wrong:
            tree = self._write(wrong)
            include.insert(0, f"-I{tree / 'include'}")
            changed = tree / wrong.file.relative_to(self._root)
            sources = [changed if path == wrong.file else path for path in sources]
        objects: list[str] = []
        for number, source in enumerate([*sources, harness.path]):
            shown = source.relative_to(self._root) if source.is_relative_to(self._root) else source
            objects.append(str(folder / f"{number}.gb"))
            options = [*include, *harness.defines, "-c", str(shown), "-o", objects[-1]]
            done = self._runner.run([*self._goto_cc, *options])
            if done.status != 0 or "warning" in done.output.lower():
                return folder, f"goto-cc: {done.output.strip()}"
        binary = folder / "harness.gb"
        done = self._runner.run(
            [*self._goto_cc, *objects, "--function", harness.name, "-o", str(binary)]
        )
        complaint = (
            f"goto-cc: {done.output.strip()}" if done.status != 0 or done.output.strip() else ""
        )
        if complaint or not harness.replaces:
            return binary, complaint
        return self._with_stand_ins(harness, binary)

    def _with_stand_ins(self, harness: Harness, binary: Path) -> tuple[Path, str]:
        """The binary with calls of stand-ins in the place of those of the replaced functions."""
        replaced = binary.with_name("replaced.gb")
        instrument = str(Path(self._goto_cc[0]).with_name("goto-instrument"))
        calls = [word for name in harness.replaces
                 for word in ("--replace-calls", f"{name}:{name}_stand_in")]  # fmt: skip
        done = self._runner.run([instrument, *calls, str(binary), str(replaced)])
        if done.status != 0 or "warning" in done.output.lower():
            return replaced, f"goto-instrument: {done.output.strip()}"
        return replaced, ""

    def _write(self, wrong: WrongBody) -> Path:
        """Write the file with the fault in it; the folder in which it has its usual place."""
        tree = self._root / "build" / "prove" / "wrong" / wrong.unit.name / wrong.name
        write_atomically(tree / wrong.file.relative_to(self._root), wrong.text())
        return tree

    def _measure(self, harness: Harness, binary: Path, result: Result) -> None:
        """Find out what the harness reaches."""
        options = harnesses.without_solver(list(harness.options))
        command = [*self._cbmc, str(binary), "--json-ui", *COVERAGE, *options]
        answer = self._answer(self._runner.run(command, harness.timeout, merged=False), harness)
        found = blocks(answer.goals)
        if not answer.complete:
            result.problems += ["the coverage run did not finish", *answer.warnings]
            return
        result.problems += coverage_problems(found, harness, result.properties)
        own = [block for block in found if block.function in harness.covers]
        result.blocks, result.covered = len(own), sum(block.reached for block in own)

    @staticmethod
    def _answer(done: Finished, harness: Harness) -> Answer:
        if done.timed_out:
            return Answer([], [], [f"no answer in {harness.timeout:.0f} s"], complete=False)
        return read_answer(done.output)


def selection(listing: str, expect: Sequence[str]) -> list[str]:
    """The options that select the properties whose description contains an expected text."""
    try:
        entries = json.loads(listing)
    except ValueError:
        return []
    return [
        word
        for entry in entries
        for item in entry.get("properties", [])
        if any(text in item["description"] for text in expect)
        for word in ("--property", item["name"])
    ]


def refutation_problems(answer: Answer, wrong: WrongBody) -> list[str]:
    """Why a wrong body does not count as refuted; nothing if it does."""
    shown = wrong.shown
    if not answer.complete:
        return [f"{shown}: CBMC did not finish: {' '.join(answer.warnings)}"]
    failed = [item["description"] for item in answer.properties if item["status"] == "FAILURE"]
    if not failed:
        wanted = ", ".join(wrong.expect)
        return [f"{shown}: {wrong.harness} does not refute this wrong body at {wanted}: too weak"]
    return [
        f"{shown}: {wrong.harness} fails, but not at {expected}; it fails at: {'; '.join(failed)}"
        for expected in wrong.expect
        if not any(expected in description for description in failed)
    ]


def dependencies(harness: Harness, root: Path) -> list[Path]:
    """All files of the project that a harness's verdict depends on."""
    return closure(root, [harness.path, *harness.sources, harness.unit.header])
