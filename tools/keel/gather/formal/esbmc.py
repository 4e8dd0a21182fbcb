# SPDX-License-Identifier: Apache-2.0
"""Asks ESBMC, a third engine, about harnesses: is each proved, and is a wrong body refuted?

ESBMC has a front end and a memory model of its own; its bundle has Z3 alone. It is asked for
assertions, overflow, bounds, pointers, divisions and unwinding, on 32-bit little-endian.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from keel.base.errors import ToolError
from keel.base.files import write_text
from keel.base.jobs import Runner
from keel.c import source as csource
from keel.c.project import closure, shown
from keel.judge.harness import Harness
from keel.judge.wrong_bodies import WrongBody

CHECKS = (
    "--32",
    "--z3",
    "--overflow-check",
    "--unsigned-overflow-check",
    "-D__CPROVER_assume=__ESBMC_assume",
    "-D__CPROVER_assert=__ESBMC_assert",
)
PROVED, REFUTED = "proved", "refuted"
PASSED = re.compile(r"^ +PASSED +\[\S+\] +line +\d+ +(\w+):", re.MULTILINE)
LABELLED = re.compile(r"\b[A-Z]{3,4}_\d{3}\w*:")
COUNT = re.compile(r"^\*\* 0 of (\d+) properties failed", re.MULTILINE)
BODYLESS = re.compile(r"no body for function (?!nondet_)(\w+)")
VERDICT = re.compile(r"^VERIFICATION (SUCCESSFUL|FAILED)$", re.MULTILINE)


@dataclass(frozen=True)
class Question:
    """A harness, with the bounds under which ESBMC is asked."""

    harness: Harness
    unwind: int
    defines: tuple[str, ...]
    seconds: float
    wrong: WrongBody | None = None  # What it must refute.


def texts_of(question: Question) -> dict[str, str]:
    """All that an answer depends on, of the tree."""
    root = question.harness.unit.root
    files = closure(root, [question.harness.path, *question.harness.sources])
    texts = {shown(path, root): csource.essence(path.read_text("utf-8")) for path in files}
    wrong = question.wrong
    return texts | (
        {"wrong": csource.essence(wrong.text()), "expect": str(wrong.expect)} if wrong else {}
    )


class Esbmc:
    """ESBMC, started on harnesses."""

    def __init__(
        self, program: Sequence[str], headers: Path, runner: Runner, root: Path, scratch: Path
    ) -> None:
        self._program = list(program)
        self._runner = runner
        self._root = root
        self._scratch = scratch
        # The compiler's own headers for freestanding programs; no C library is needed.
        write_text(scratch / "include/stdint.h", '#include "stdint-gcc.h"\n')
        self._include = [f"-I{scratch / 'include'}", f"-I{headers}"]

    def command(self, question: Question, wrong: WrongBody | None) -> list[str]:
        """The command line for a harness, with a wrong body in its place if one is given."""
        harness = question.harness
        sources, include = list(harness.sources), [f"-I{self._root / 'include'}"]
        defines = question.defines
        if wrong:
            changed = self._scratch / wrong.name / wrong.file.relative_to(self._root)
            write_text(changed, wrong.text())
            include.insert(0, f"-I{self._scratch / wrong.name / 'include'}")
            sources = [changed if path == wrong.file else path for path in sources]
            # What a source includes beside it is found beside the original.
            include += [f"-I{path.parent}" for path in harness.sources]
        return [
            *self._program,
            str(harness.path),
            *map(str, sources),
            "--function",
            harness.name,
            "--nostdinc",
            *include,
            *self._include,
            *defines,
            *CHECKS,
            "--unwind",
            str(question.unwind),
        ]

    def ask(self, question: Question) -> dict[str, object]:
        """What ESBMC says of a harness, and of the wrong body that it must refute, if any."""
        verdict, count = self._verdict(question, None)
        refuted = self._verdict(question, question.wrong)[0] if question.wrong else ""
        return {"verdict": verdict, "properties": count, "wrong": refuted}

    def _verdict(self, question: Question, wrong: WrongBody | None) -> tuple[str, int]:
        done = self._runner.run(self.command(question, wrong), question.seconds)
        if done.timed_out:
            return f"no answer in {question.seconds:.0f} s", 0
        return judged(done.output, wrong.expect if wrong else ())


def judged(output: str, expected: Sequence[str]) -> tuple[str, int]:
    """The verdict in ESBMC's output, and how many properties it has proved.

    A proof counts only if a labelled assertion is among what passed, a refutation only if a
    labelled assertion failed: the one that must fail, or another, as ESBMC shows what fails in one
    example. What has no body is not what CBMC was asked about.
    """
    if bodyless := BODYLESS.search(output):
        return f"does not know {bodyless[1]}", 0
    verdict = VERDICT.search(output)
    if not verdict:
        error = next(
            (line for line in output.splitlines() if "error" in line.lower()), "no verdict"
        )
        return error.strip(), 0
    if verdict[1] == "SUCCESSFUL":
        count = COUNT.search(output)
        labelled = PASSED.findall(output)
        return (PROVED, int(count[1])) if count and labelled else ("checked no assertion", 0)
    failed = [line for line in output.splitlines() if line.lstrip().startswith("FAILED")]
    if expected and any(LABELLED.search(line) for line in failed):
        return REFUTED, 0
    return f"failed: {' '.join(failed[0].split()[2:]) if failed else 'nobody knows what'}", 0


def narrowed(harness: Harness, defines: Sequence[str]) -> tuple[str, ...]:
    """The harness's definitions, and those that take their place."""
    names = {word.partition("=")[0] for word in defines}
    return (*(word for word in harness.defines if word.partition("=")[0] not in names), *defines)


def headers_of(gcc: Sequence[str], runner: Runner) -> Path:
    """Where the compiler's own headers are."""
    done = runner.run([*gcc, "-print-file-name=include"], merged=False)
    path = Path(done.output.strip())
    if done.status != 0 or not (path / "stdint-gcc.h").is_file():
        raise ToolError(f"{' '.join(gcc)} does not say where its headers are")
    return path
