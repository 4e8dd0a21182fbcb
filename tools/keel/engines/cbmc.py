# SPDX-License-Identifier: Apache-2.0
"""Proves harnesses with CBMC, on goto binaries of the very sources, built for the target."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Collection, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from keel.base.jobs import Finished, Runner
from keel.base.shared_results import Once
from keel.c.project import closure
from keel.engines.cbmc_build import Builder
from keel.judge import harness as harnesses
from keel.judge.cbmc_answers import (
    ASSERTION,
    Answer,
    blocks,
    coverage_problems,
    proof_problems,
    read_answer,
    refutation_problems,
)
from keel.judge.harness import Harness
from keel.judge.wrong_bodies import WrongBody

CHECKS = (
    "--unwinding-assertions",
    "--bounds-check",
    "--pointer-check",
    "--pointer-overflow-check",
    "--pointer-primitive-check",
    "--div-by-zero-check",
    "--float-div-by-zero-check",
    "--signed-overflow-check",
    "--unsigned-overflow-check",
    "--conversion-check",
    "--undefined-shift-check",
    "--float-overflow-check",
    "--nan-check",
    "--enum-range-check",
    "--drop-unused-functions",
)
# What a harness that checks assertions alone is checked for.
ASSERTIONS = ("--no-standard-checks", "--unwinding-assertions", "--drop-unused-functions")
# Leaves out of the formula the assignments on which nothing that is asked depends: it saves time,
# most of it where one assertion is asked for. Assumptions stay. A trace would lack them, too, and
# z3 gains nothing.
SLICE = "--slice-formula"
# The coverage run asks what can be reached at all. CBMC takes assertions for assumptions there.
COVER = ("--cover", "location", "--no-standard-checks", "--drop-unused-functions")
COVERAGE = (*COVER, SLICE)


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
    # Whether nothing is wrong but that CBMC came to the limit of its time.
    gave_up: bool = False
    seconds: float = 0.0

    def as_dict(self) -> dict[str, Any]:
        """For the cache."""
        return asdict(self)


def checks_of(harness: Harness) -> tuple[str, ...]:
    """What CBMC is to look for."""
    return ASSERTIONS if harness.assertions_only else CHECKS


class Cbmc:
    """CBMC and its compiler for the target."""

    def __init__(
        self,
        goto_cc: Sequence[str],
        cbmc: Sequence[str],
        runner: Runner,
        root: Path,
        scratch: Path,
        defines: Sequence[str] = (),
    ) -> None:
        """Take what is to be started, and the sizes that the build chooses, as -DNAME=NUMBER."""
        self._defines = tuple(defines)
        self._goto_cc = list(goto_cc)
        self._cbmc = list(cbmc)
        self._runner = runner
        self._root = root
        self._builder = Builder(goto_cc, runner, root, scratch)
        self._listings = Once()

    def options(self) -> list[str]:
        """What is the same for all harnesses."""
        return [*self._goto_cc[1:], *CHECKS, *ASSERTIONS, *COVERAGE, *self._defines]

    def sized(self, harness: Harness) -> Harness:
        """The harness with the sizes that the build chooses, where it has none of its own."""
        own = [word.partition("=")[0] for word in harness.defines]
        more = [word for word in self._defines if word.partition("=")[0] not in own]
        return replace(harness, defines=(*harness.defines, *more)) if more else harness

    def prove(self, harness: Harness, room: int = 1) -> Result:
        """Prove a harness and measure what it reaches, in `room` times its processor time."""
        start = time.monotonic()
        harness = replace(self.sized(harness), timeout=harness.timeout * room)
        problems = harnesses.text_problems(harness)
        result = Result(
            problems=problems,
            defines=list(harness.defines),
            replaces=list(harness.replaces),
            checks="assertions" if harness.assertions_only else "all",
        )
        binary, complaint = self.build(harness, harness.name)
        if complaint:
            result.problems.append(complaint)
        else:
            answer = self.check(harness, binary)
            result.properties = answer.properties
            result.gave_up = answer.gave_up and not result.problems
            result.problems += proof_problems(answer)
            if not answer.gave_up:
                self._measure(harness, binary, result)
        shown = harness.path.relative_to(self._root)
        result.problems = [
            f"{shown}: {text}" if not text.startswith(str(shown)) else text
            for text in result.problems
        ]
        result.seconds = round(time.monotonic() - start, 1)
        return result

    def refute(self, wrong: WrongBody, harness: Harness, room: int = 1) -> Result:
        """Show that a harness notices a wrong body, by the assertions that it should."""
        start = time.monotonic()
        harness = replace(self.sized(harness), timeout=harness.timeout * room)
        result = Result()
        if wrong.defines:
            harness = replace(harness, defines=wrong.defines)
        binary, complaint = self.build(harness, f"{harness.name}-{wrong.name}", wrong)
        if complaint:
            result.problems.append(f"{wrong.shown}: {complaint}")
        else:
            answer = self.check(harness, binary, self._selection(harness, binary, wrong.expect))
            result.gave_up = answer.gave_up
            result.problems += refutation_problems(answer, wrong)
            if result.problems and not answer.gave_up:
                other = self.check(harness, binary, ["--stop-on-fail"]).first_failure
                result.problems[0] += f"; what fails is: {other or 'nothing'}"
        result.seconds = round(time.monotonic() - start, 1)
        return result

    def check(self, harness: Harness, binary: Path, extra: Sequence[str] = ()) -> Answer:
        """Ask for the status of every property."""
        command = [*self._cbmc, str(binary), "--json-ui", *checks_of(harness)]
        command += [*harness.options, *extra]
        whole = "--trace" in extra or "--z3" in harness.options
        command += [] if whole else [SLICE]
        return self._answer(self._runner.run(command, harness.timeout, merged=False), harness)

    def counterexample(
        self, harness: Harness, wrong: WrongBody | None, expect: Sequence[str]
    ) -> tuple[Answer, str]:
        """An execution in which an assertion fails that contains an expected text, or any check.

        The answer has its trace, or says that there is none; the text is a compiler's complaint.
        """
        if wrong and wrong.defines:
            harness = replace(harness, defines=wrong.defines)
        name = f"{harness.name}-{wrong.name}" if wrong else harness.name
        binary, complaint = self.build(harness, name, wrong)
        if complaint:
            return Answer([], [], [], complete=False), complaint
        selected = self._selection(harness, binary, expect) if expect else []
        return self.check(harness, binary, ["--stop-on-fail", "--trace", *selected]), ""

    def _selection(self, harness: Harness, binary: Path, expect: Sequence[str]) -> list[str]:
        """Options that restrict CBMC to the assertions that are to fail: all others take longer.

        A harness's assertions have the same names whatever body it is linked with; checks do not.
        """

        def listed() -> str:
            command = [*self._cbmc, str(binary), "--json-ui", "--show-properties"]
            command += checks_of(harness)
            return self._runner.run(command, harness.timeout, merged=False).output

        listing = self._listings.get((harness.name, harness.defines), listed)
        return selection(listing if are_assertions(listing, expect) else listed(), expect)

    def build(
        self, harness: Harness, name: str, wrong: WrongBody | None = None
    ) -> tuple[Path, str]:
        """Compile and link; the binary, and the compiler's complaint if there is one."""
        return self._builder.build(harness, name, wrong)

    def _measure(self, harness: Harness, binary: Path, result: Result) -> None:
        """Find out what the harness reaches."""
        options = [*harnesses.without_solver(list(harness.options)), *harness.reach]
        command = [*self._cbmc, str(binary), "--json-ui", *COVERAGE, *options]
        listing = self._runner.run([*command, "--show-properties"], harness.timeout, merged=False)
        command += blocks_of(listing.output, looked_at(harness, result.properties))
        answer = self._answer(self._runner.run(command, harness.timeout, merged=False), harness)
        found = blocks(answer.goals)
        if not answer.complete:
            result.gave_up = answer.gave_up and not result.problems
            result.problems += ["the coverage run did not finish", *answer.warnings]
            return
        result.problems += coverage_problems(found, harness, result.properties)
        own = [block for block in found if block.function in harness.covers]
        result.blocks, result.covered = len(own), sum(block.reached for block in own)

    @staticmethod
    def _answer(done: Finished, harness: Harness) -> Answer:
        if done.timed_out:
            said = f"gave up after {harness.timeout:.0f} s of processor time, which refutes nothing"
            return Answer([], [], [said], complete=False, gave_up=True)
        return read_answer(done.output)


def selection(listing: str, expect: Sequence[str]) -> list[str]:
    """The options that select the properties whose description contains an expected text."""
    return _select(listing, lambda item: any(text in item["description"] for text in expect))


def are_assertions(listing: str, expect: Sequence[str]) -> bool:
    """Whether each expected text is an assertion's, and no other property's."""
    return all(
        found and all(ASSERTION.search(item["name"]) for item in found)
        for found in (
            [item for item in _properties(listing) if text in item["description"]]
            for text in expect
        )
    )


def looked_at(harness: Harness, properties: Sequence[dict[str, str]]) -> set[str]:
    """The functions whose blocks are looked at: what is to be covered, and where assertions are."""
    asserting = {item["function"] for item in properties if ASSERTION.search(item["name"])}
    return {harness.name, *harness.covers, *asserting}


def blocks_of(listing: str, functions: Collection[str]) -> list[str]:
    """The options that select the blocks of functions. Of others it may be hard to say."""
    return _select(listing, lambda one: one.get("sourceLocation", {}).get("function") in functions)


def _select(listing: str, wanted: Callable[[dict[str, Any]], bool]) -> list[str]:
    """The options that select properties of a list by CBMC."""
    found = filter(wanted, _properties(listing))
    return [word for item in found for word in ("--property", item["name"])]


def _properties(listing: str) -> list[dict[str, Any]]:
    """The properties in a list by CBMC; none if it breaks off."""
    try:
        return [item for entry in json.loads(listing) for item in entry.get("properties", [])]
    except ValueError:
        return []


def dependencies(harness: Harness, root: Path) -> list[Path]:
    """All files of the project that a harness's verdict depends on."""
    return closure(root, [harness.path, *harness.sources, harness.unit.header])
