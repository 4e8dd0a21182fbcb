# SPDX-License-Identifier: Apache-2.0
"""Reads CBMC harnesses: their directives, and what their text must satisfy.

Directives stand in the first comment lines of a harness, up to an empty one, which prose follows:

    // cbmc: --unwind 33 --external-sat-solver cadical   options of the search, from OPTIONS
    // sources: src/rtos/queue.c              what is linked; default: the unit's source
    // covers: keel_queue_add open_slot       functions that must be reached everywhere
    // reach: --z3 --fpa                      options of the search for executions that reach all
    // defines: -DKEEL_QUEUE_CAPACITY=8u      for a smaller model, shown in the report
    // timeout: 900                           seconds
    // checks: assertions                     assertions and unwinding alone; default: all checks
    // replaces: keel_voter_mean              functions that their contracts stand in for

Where the harness calls a replaced function F, the harness's own F_stand_in is called: it asserts
F_may(...) and returns anything that F_does(...) allows, while F_harness assumes the one and
asserts the other of F itself, or one of F's harnesses for all its cases, F__any_harness, does. So
what is proved holds of every function with F's contract.

With `checks: assertions` two computations of floats stay the same terms for z3, which so sees at
once that they are equal. Overflows, bounds and pointers are then the affair of other harnesses of
the same function, which link the same sources and reach all that this one covers, but for models.

The function that a harness proves is in its name: keel_queue_add_harness, or, for one of several
cases, keel_queue_add__full_harness.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from keel.c import source as csource
from keel.c.project import KEEL, ProjectError, Unit, closure, find_file

HARNESS_KEYS = frozenset("cbmc sources covers reach defines timeout entry replaces checks".split())
# What is meant as a directive, but is none of a harness.
STRAY_KEYS = frozenset("harness expect source cover wp".split())
# A smaller size, or a switch of the harness's own: what replaces code or an assertion is none.
DEFINE = re.compile(r"-D[A-Z][A-Z0-9_]*(?:=\d+u?)?")
DIRECTIVE = re.compile(r"^// ?(\w+): *(.*?)\s*$")

# Options that choose how CBMC searches. None of them makes it overlook anything: unwinding too
# little is caught by the unwinding assertions. True: takes a value.
# Without field sensitivity of arrays, a structure of many members in an array is copied as one: the
# symbolic execution of a step of the virtual unit takes 4 s, else 42 s.
OPTIONS = {
    "--unwind": True,
    "--unwindset": True,
    "--object-bits": True,
    "--external-sat-solver": True,
    "--z3": False,
    "--fpa": False,
    "--no-sat-preprocessor": False,
    "--no-simplify": False,
    "--arrays-uf-always": False,
    "--arrays-uf-never": False,
    "--refine": False,
    "--max-field-sensitivity-array-size": True,
    "--no-array-field-sensitivity": False,
}
# Those that choose a solver. The coverage run (many easy questions, an answer to each) does without
# or, where the answers are hard to find, has its own. Each is one of the pinned tools: a verdict
# depends on which it is.
SOLVERS = frozenset(["--external-sat-solver", "--z3", "--fpa"])
EXTERNAL = ("cadical",)
ANSWERING = ("--external-sat-solver", "--z3", "--refine")
# Where models stand: they are compared, and bear no checks of their own.
MODELS = "specs/model"
# What harnesses link: the code that is built, and models. A copy would drift.
LINKED = ("src", MODELS)


def directives(path: Path) -> dict[str, list[str]]:
    """The directives of a harness; each may be given on several lines."""
    found: dict[str, list[str]] = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line.startswith("//") or line.strip() == "//":
            break
        match = DIRECTIVE.match(line)
        if match and match[1] in HARNESS_KEYS:
            found.setdefault(match[1], []).append(match[2])
        elif match and match[1] in STRAY_KEYS:
            raise ProjectError(f"{path}: the directive {match[1]} does not belong here")
    return found


def search_options(path: Path, lines: list[str]) -> list[str]:
    """The options of a `cbmc` or `reach` directive, checked."""
    words = shlex.split(" ".join(lines))
    expect_value = False
    before = ""
    for word in words:
        if before == "--external-sat-solver" and word not in EXTERNAL:
            raise ProjectError(f"{path}: {word} is no solver of ours: {' '.join(EXTERNAL)}")
        before = word
        if expect_value:
            expect_value = False
        elif word not in OPTIONS:
            raise ProjectError(f"{path}: a harness may not use {word}; it may: {' '.join(OPTIONS)}")
        else:
            expect_value = OPTIONS[word]
    if sum(word in ANSWERING for word in words) > 1:
        raise ProjectError(f"{path}: one solver answers, and CBMC does not say which: name one")
    return words


def without_solver(options: list[str]) -> list[str]:
    """The options but for those that choose a solver."""
    kept: list[str] = []
    skip = False
    for word in options:
        if skip:
            skip = False
        elif word in SOLVERS:
            skip = OPTIONS[word]
        else:
            kept.append(word)
    return kept


@dataclass(frozen=True)
class Harness:
    """A harness as its file describes it."""

    unit: Unit
    path: Path
    options: tuple[str, ...]
    sources: tuple[Path, ...]
    covers: tuple[str, ...]
    defines: tuple[str, ...]
    timeout: float
    replaces: tuple[str, ...] = ()
    # Whether CBMC is to look at assertions and unwinding alone.
    assertions_only: bool = False
    # Options of the coverage run, beside those of the search.
    reach: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Of the harness, which is that of its file and of its entry."""
        return self.path.stem

    @property
    def function(self) -> str:
        """The function that is proved."""
        return self.name.removesuffix("_harness").partition("__")[0]


def read_harness(unit: Unit, path: Path) -> Harness:
    """Read a harness's directives."""
    given = directives(path)
    defines = tuple(" ".join(given.get("defines", [])).split())
    if given.get("entry", [path.stem]) != [path.stem]:
        raise ProjectError(f"{path}: the entry of a harness bears the name of its file")
    checks = given.get("checks", [])
    if checks not in ([], ["assertions"]):
        raise ProjectError(f"{path}: `checks` takes `assertions`, or is left out for all of them")
    sources = tuple(
        find_file(unit.root, name) for line in given.get("sources", []) for name in line.split()
    )
    if not sources and unit.source.is_file():
        sources = (unit.source,)
    for source in sources:
        if not source.is_file():
            raise ProjectError(f"{path}: there is no source {source.relative_to(unit.root)}")
        homes = (root / place for root in (unit.root, KEEL) for place in LINKED)
        if not any(source.is_relative_to(home) for home in homes):
            raise ProjectError(
                f"{path}: {source.name} is linked from elsewhere than {' or '.join(LINKED)}"
            )
    for word in defines:
        if not (DEFINE.fullmatch(word) or _is_left_to_builds(word, sources)):
            raise ProjectError(
                f"{path}: `defines` takes -DNAME=NUMBER, NAME in capitals, or a macro that a source"
                f" leaves to builds: {word}"
            )
    return Harness(
        unit=unit,
        path=path,
        sources=sources,
        defines=defines,
        options=tuple(search_options(path, given.get("cbmc", []))),
        covers=tuple(" ".join(given.get("covers", [])).split()),
        timeout=float(given.get("timeout", ["900"])[0]),
        replaces=tuple(" ".join(given.get("replaces", [])).split()),
        assertions_only=bool(checks),
        reach=tuple(search_options(path, given.get("reach", []))),
    )


def _is_left_to_builds(word: str, sources: Iterable[Path]) -> bool:
    """Whether a definition is of a macro with arguments of which a source says that a build may
    define it."""
    named = re.match(r"-D(KEEL_[A-Z0-9_]+)\(", word)
    return named is not None and any(
        f"#ifndef {named[1]}\n" in source.read_text(encoding="utf-8") for source in sources
    )


def text_problems(harness: Harness) -> list[str]:
    """What is wrong with a harness before it runs."""
    text = csource.read(harness.path)
    place = harness.path.relative_to(harness.unit.root)
    problems = []
    if not csource.body_of(text, harness.name):
        problems.append(f"{place}: defines no {harness.name}")
    elif len(csource.calls(csource.body_of(text, harness.name), harness.function)) != 1:
        problems.append(f"{place}: must call {harness.function} exactly once")
    elif len(csource.calls(text, harness.function)) != 1:
        problems.append(f"{place}: calls {harness.function} outside {harness.name}, too")
    if harness.unit.source.is_file() and harness.unit.source not in harness.sources:
        problems.append(
            f"{place}: does not link {harness.unit.source.relative_to(harness.unit.root)}"
        )
    if harness.function not in harness.covers:
        problems.append(f"{place}: `covers` must name {harness.function}")
    return problems + replacement_problems(harness)


def replacement_problems(harness: Harness) -> list[str]:
    """Why what a harness proves with stand-ins does not hold of the functions themselves."""
    root = harness.unit.root
    place = harness.path.relative_to(root)
    files = closure(harness.unit.root, [harness.path])
    texts = [csource.read(path) for path in files]
    problems = []
    for name in harness.replaces:
        if name == harness.function or name in harness.covers:
            problems.append(f"{place}: replaces {name}, which it is to prove")
        stand_in = "".join(csource.body_of(text, f"{name}_stand_in") for text in texts)
        lacking = _lacks(stand_in, name, "assert", "assume")
        problems += [f"{place}: {name}_stand_in lacks {text}...)" for text in lacking]
        proofs = [
            csource.body_of(csource.read(path), path.stem) for path in harnesses_of(root, name)
        ]
        lacks = [_lacks(proof, name, "assume", "assert") for proof in proofs or [""]]
        problems += [f"{place}: {name}_harness lacks {text}...)" for text in min(lacks, key=len)]
    return problems


def unchecked(harnesses: Iterable[Harness]) -> list[str]:
    """What harnesses that check assertions alone leave without the other checks."""
    every = list(harnesses)
    problems = []
    for one in (harness for harness in every if harness.assertions_only):
        models = one.unit.root / MODELS
        sources = {path for path in one.sources if not path.is_relative_to(models)}
        reached = {
            name
            for other in every
            if other.function == one.function and not other.assertions_only
            if sources <= set(other.sources)
            for name in other.covers
        }
        own = {
            function.name
            for path in one.sources
            if path.is_relative_to(models)
            for function in csource.defined(csource.read(path))
        }
        place = one.path.relative_to(one.unit.root)
        problems += [
            f"{place}: checks assertions alone, and no other harness of {one.function} on the same"
            f" sources covers {name} with all checks"
            for name in one.covers
            if name not in reached | own
        ]
    return problems


def harnesses_of(root: Path, function: str) -> list[Path]:
    """The harnesses of a function, in whichever unit."""
    found = root.glob(f"proofs/*/{function}*_harness.c")
    own = (f"{function}_harness", f"{function}__")
    return sorted(path for path in found if path.stem.startswith(own))


def _lacks(body: str, name: str, before: str, after: str) -> list[str]:
    """What a body does not do with the two sides of a contract."""
    wanted = (f"__CPROVER_{before}({name}_may(", f"__CPROVER_{after}({name}_does(")
    return [text for text in wanted if text not in body]
