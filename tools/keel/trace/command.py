# SPDX-License-Identifier: Apache-2.0
"""Trace every requirement to its clauses, harnesses and tests, and find what stands alone.

    python3 tools/keel trace             # every orphan, one a line
    python3 tools/keel trace --update    # first bring specs/requirements up to date

A high-level requirement is an entry of specs/requirements/high_level.sdoc, say HLR-003: what Keel
takes from the paper, or adds. A low-level requirement is an entry of another document there, say
QUE-003; its parents are high-level ones. The ACSL clauses that state it carry its id in their
labels (QUE_003, QUE_003_count), and so do the assertions of the CBMC harnesses and the names of the
tests (tests/unit, tests/bsp, tests/reference) that check it; a requirement may also list unit tests
by name under TESTS, or the file of a test that checks far more. Where a harness compares the code
with its model (specs/model), which it includes, a comment of the model that names a requirement
counts as an assertion does. An orphan is

    a low-level requirement without a parent and without a reason (DERIVED);
    a high-level requirement without a source in the paper and without a reason, without what
        VERIFICATION says, or with a departure from the paper that docs/paper.md does not list;
    a function of the product without a requirement (tracing/functions.py);
    a label, an assertion, a test or a comment of a header or a model that names no requirement;
    a model that no harness includes or links;
    a requirement without a clause, unless VERIFICATION says test (it then needs a test) or
        theorem (specs/soundness.md must then name it);
    a requirement with clauses which neither a harness nor a test names, unless it is a theorem;
    a test listed under TESTS that does not exist, a CLAUSES that is not what the files say;
    a function that may change something when it refuses, and that STA-001 does not list;
    a function of a unit with a model whose outcome nothing determines (proofs/determined.py).

Tests that run on the target alone (tests/target) count as unit tests do.

Exit status: 0 without orphans, 1 with, 2 when they could not be looked for.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from keel.audit import determined
from keel.base.arguments import Parser
from keel.base.errors import ROOT, program
from keel.base.files import write_text
from keel.c import source as csource
from keel.c.project import closure
from keel.lint import refusals
from keel.trace.functions import Function, function_problems, read_functions
from keel.trace.requirements import FOLDER, Requirement, level_problems, read_requirements

LABEL = r"[A-Z]{3,4}_\d{3}(?:_\w+)?"
KEYWORD = r"\b(?:ensures|lemma|assert|check|invariant)"
CLAUSE = re.compile(rf"{KEYWORD}\s+({LABEL})\s*(?:\{{[^}}]*\}})?\s*:")
BOUND = re.compile(rf"\|({LABEL})\| <= ")
ASSERTION = re.compile(rf'"({LABEL})[:"]')
TEST = re.compile(r"\bRUN_TEST\((\w+)\)")
REFERENCE = re.compile(rf'"({LABEL})"')
MENTION = re.compile(r"\b[A-Z]{3,4}-\d{3}\b")
LINKED = re.compile(r"(?<=specs/model/)\w+(?=\.c\b)")


def id_of(label: str) -> str:
    """QUE_003_count names QUE-003; what names none gives an empty text."""
    match = re.match(r"([A-Z]{3,4})_(\d{3})(?![0-9])", label)
    return f"{match[1]}-{match[2]}" if match else ""


def collect(root: Path, pattern: re.Pattern[str], *globs: str) -> list[tuple[str, str]]:
    """What the pattern finds in the files, each once per file, with the file's path."""
    found: dict[tuple[str, str], None] = {}
    for glob in globs:
        for path in sorted(root.glob(glob)):
            where = path.relative_to(root).as_posix()
            for match in pattern.finditer(path.read_text(encoding="utf-8")):
                found[(match[1] if pattern.groups else match[0], where)] = None
    return list(found)


def compared_models(root: Path) -> set[str]:
    """The models that a harness includes, be it by a header, or links."""
    models = (root / "specs/model").resolve()
    harnesses = sorted(root.glob("proofs/*/*_harness.c"))
    included = {path.stem for path in closure(root, harnesses) if path.parent == models}
    heads = (path.read_text(encoding="utf-8") for path in harnesses)
    return included | {name for text in heads for name in LINKED.findall(text)}


def modelled(root: Path) -> tuple[list[tuple[str, str]], list[str]]:
    """What comments of models name, with the place, and the models that stand alone."""
    found: dict[tuple[str, str], None] = {}
    alone = []
    compared = compared_models(root)
    for path in sorted((root / "specs/model").glob("*.c")):
        where = path.relative_to(root).as_posix()
        if path.stem not in compared:
            alone.append(f"{where}: no harness compares the code with this model")
            continue
        comments = csource.comments(path.read_text(encoding="utf-8"))
        found.update(((uid, where), None) for text in comments for uid in MENTION.findall(text))
    return list(found), alone


@dataclass
class Trace:
    """The join: requirements by id, and what names one that does not exist."""

    requirements: dict[str, Requirement]
    functions: list[Function]
    orphans: list[str]
    clauses: int = 0
    harnesses: int = 0
    tests: int = 0


def join(root: Path) -> Trace:
    """Read everything and bring it together."""
    trace = Trace({}, read_functions(root), [])
    for entry in read_requirements(root):
        if entry.uid in trace.requirements:
            trace.orphans.append(f"{entry.uid}: two requirements have this id")
        trace.requirements[entry.uid] = entry
    clauses = collect(root, CLAUSE, "include/**/*.h", "proofs/*/*.c")
    clauses += collect(root, BOUND, "proofs/*/*.g")
    assertions = collect(root, ASSERTION, "proofs/*/*.[ch]")
    tests = collect(root, TEST, "tests/unit/*.c", "tests/bsp/*.c")
    tests += collect(root, REFERENCE, "tests/reference/*.cpp")
    tests += collect(root, TEST, "tests/target/*.c")
    for kind, pairs in (("clauses", clauses), ("harnesses", assertions), ("tests", tests)):
        for name, where in pairs:
            uid = id_of(name)
            if uid in trace.requirements:
                getattr(trace.requirements[uid], kind).append(name)
            elif uid:
                trace.orphans.append(f"{where}: {name}: there is no requirement {uid}")
    named, alone = modelled(root)
    trace.orphans += alone
    for uid, where in named:
        if uid in trace.requirements:
            trace.requirements[uid].harnesses.append(where)
    mentions = collect(root, MENTION, "include/**/*.h", "bsp/**/*.h", "specs/model/*.[ch]")
    for uid, where in mentions:
        if uid not in trace.requirements:
            trace.orphans.append(f"{where}: there is no requirement {uid}")
    trace.clauses = len({name for name, _ in clauses})
    trace.harnesses = len({where for _, where in assertions if where.endswith(".c")})
    trace.tests = len(tests)
    known = {name for name, _ in tests}
    known |= {path.relative_to(root).as_posix() for path in (root / "tests").glob("*/*.*")}
    soundness = root / "specs/soundness.md"
    theorems = MENTION.findall(soundness.read_text(encoding="utf-8")) if soundness.exists() else []
    for entry in trace.requirements.values():
        trace.orphans += [f"{entry.uid}: {text}" for text in lacks(entry, known, theorems)]
    paper = root / "docs/paper.md"
    departures = paper.read_text(encoding="utf-8") if paper.exists() else ""
    trace.orphans += level_problems(trace.requirements, departures)
    trace.orphans += function_problems(trace.functions)
    trace.orphans += refusals.problems(root)
    trace.orphans += [text for one in determined.of_tree(root) for text in one.problems]
    return trace


def lacks(entry: Requirement, tests: set[str], theorems: Sequence[str]) -> Iterator[str]:
    """What a requirement lacks."""
    for name in sorted(set(entry.listed_tests) - tests):
        yield f"TESTS lists {name}, which is no test"
    if entry.high:
        return
    if "proof" in entry.verification and not entry.clauses:
        yield "no clause states it"
    if "theorem" in entry.verification and entry.uid not in theorems:
        yield "specs/soundness.md does not name it"
    tested = entry.tests or set(entry.listed_tests) & tests
    if "test" in entry.verification and not tested:
        yield "no test checks it"
    if entry.clauses and "theorem" not in entry.verification and not (entry.harnesses or tested):
        yield "neither a harness nor a test names it"
    if entry.listed_clauses != list(dict.fromkeys(entry.clauses)):
        yield "CLAUSES is not what the headers say (tools/keel trace --update)"


def update(root: Path) -> None:
    """Write the labels of its clauses into each entry."""
    requirements = join(root).requirements
    for path in sorted((root / FOLDER).glob("*.sdoc")):
        lines: list[str] = []
        uid = ""
        for line in path.read_text(encoding="utf-8").splitlines():
            uid = line.removeprefix("UID: ") if line.startswith("UID: ") else uid
            if not line.startswith("CLAUSES:"):
                lines.append(line)
            if line.startswith("VERIFICATION:") and requirements[uid].clauses:
                lines.append("CLAUSES: " + ", ".join(dict.fromkeys(requirements[uid].clauses)))
        write_text(path, "\n".join(lines) + "\n")


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = Parser("Trace requirements to clauses, harnesses and tests.", "trace")
    parser.add_argument("--update", action="store_true", help="write CLAUSES first")
    options = parser.parse_args(arguments)

    def work() -> int:
        if options.update:
            update(root)
        trace = join(root)
        for orphan in sorted(trace.orphans):
            print(orphan)
        print(
            f"traced {len(trace.requirements)} requirements: {trace.clauses} clauses, "
            f"{trace.harnesses} harnesses, {trace.tests} tests, "
            f"{len(trace.functions)} functions, "
            f"{len(trace.orphans)} orphans"
        )
        return 1 if trace.orphans or not trace.requirements else 0

    return program("trace", work)
