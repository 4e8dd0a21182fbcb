# SPDX-License-Identifier: Apache-2.0
"""Runs mutants against the proofs: one that no proof notices shows a contract that is too weak."""

from __future__ import annotations

import json
import math
import re
import shutil
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from . import cbmc, csource, engines, frames, targets, wp
from .cache import Cache, digest
from .harness import MODELS, Harness, read_harness
from .jobs import Runner
from .mutant_verdicts import Verdict
from .mutants import Mutant
from .project import ProjectError, Unit, closure, find_units
from .settings import Exceptions
from .times import Times

# What is not true is given up soon; how soon depends on how long what is true takes.
PROVERS = {"Alt-Ergo": "alt-ergo", "CVC4": "cvc4", "Z3": "z3"}
PATIENCE = 3.0
SHORTEST, LONGEST = 2, 30
IMPATIENT = 20.0
UNTIMED = 60.0  # what a harness counts for whose time nobody knows
LAST_PATIENCE = 10.0  # for the attempt after which a mutant is said to survive
NO_ANSWER = "no answer"
# In a stamp, what makes the mutants: proofs of what is unchanged do not depend on it.
MAKERS = "mutants"
# A goal that is not proved within the limits above may be one that takes longer.
UNDECIDED = "not proved in the short limit"


class Trees:
    """Copies of the tree, one for each trial at a time: the tree itself is never touched."""

    def __init__(self, root: Path, scratch: Path, count: int) -> None:
        self._root = root
        self._free = [scratch / f"tree{number}" for number in range(count)]
        self._lock = threading.Lock()

    @contextmanager
    def with_mutant(self, mutant: Mutant, root: Path) -> Iterator[Path]:
        """A tree in which the mutant has taken its file's place."""
        with self._lock:
            tree = self._free.pop()
        self._fill(tree)
        file = tree / mutant.file.relative_to(root)
        text = file.read_text(encoding="utf-8")
        try:
            file.write_text(mutant.apply(text), encoding="utf-8")
            yield tree
        finally:
            file.write_text(text, encoding="utf-8")
            with self._lock:
                self._free.append(tree)


    def _fill(self, tree: Path) -> None:
        """Copy what proofs are made of, when the tree is used for the first time."""
        for name in ("include", "src", "proofs", MODELS):
            if (self._root / name).is_dir() and not (tree / name).is_dir():
                shutil.copytree(self._root / name, tree / name)


@dataclass(frozen=True)
class Tools:
    """The programs that a trial needs, and where it may write."""

    frama_c: Sequence[str]
    goto_cc: Sequence[str]
    cbmc: Sequence[str]
    compiler: Sequence[str]
    environment: Mapping[str, str]
    scratch: Path
    answers: Path
    verdicts: Path


@dataclass(frozen=True)
class Seen:
    """A harness, the files that its binary is made of, and the functions that it may call."""

    harness: Harness
    files: frozenset[Path]
    reached: frozenset[str]


def survey(root: Path) -> list[Seen]:
    """All harnesses of all units."""
    read = [read_harness(unit, path)
            for unit in find_units(root).values() for path in unit.harnesses]  # fmt: skip
    found = []
    for harness in read:
        files = closure(root, [harness.path, *harness.sources])
        found.append(Seen(harness, frozenset(files), _reached(harness, files)))
    return found


def _reached(harness: Harness, files: Sequence[Path]) -> frozenset[str]:
    """The functions that a harness may call, in whichever of its files."""
    bodies: dict[str, str] = {}
    for path in files:
        text = csource.read(path)
        code = csource.code_only(text)
        for function in csource.defined(text):
            if function.body:
                bodies[function.name] = bodies.get(function.name, "") + code[slice(*function.body)]
    seen: set[str] = set()
    waiting = [harness.name]
    while waiting:
        for name in re.findall(r"\b\w+\b", bodies.get(waiting.pop(), "")):
            if name in bodies and name not in seen and name not in harness.replaces:
                seen.add(name)
                waiting.append(name)
    return frozenset(seen)


class Trial:
    """Tries the mutants of one unit.

    A mutant is tried first by the harnesses that compare its function with the model, then by the
    others that cover it, then by WP, which asks the function alone: what its callers rely on is its
    contract, not its body. What is left are the harnesses that were too slow and, with little time
    each, those that only call it. Among equals the one that is usually fastest comes first.
    """

    def __init__(
        self, unit: Unit, tools: Tools, trees: Trees, asked: Sequence[str], every: bool,
        cache: Cache, stamp: Mapping[str, str], exceptions: Exceptions,
        times: Times, patient: bool = True, seen: Sequence[Seen] | None = None,
    ) -> None:  # fmt: skip
        self._unit = unit
        self._tools = tools
        self._trees = trees
        self._engines = asked
        self._every = every
        self._cache = cache
        self._stamp = dict(stamp)
        self._runners: list[Runner] = []
        self._exceptions = exceptions
        self._times = times
        self._patient = patient
        self._allowed = list(exceptions.warnings)
        self._baseline = threading.Lock()
        self._proved = Cache(tools.verdicts)
        self._sound: dict[str, bool] = {}
        self._stages: dict[str, tuple[wp.Stage, ...]] = {}
        self._original: str | None = None
        own = {path.resolve() for path in unit.own_files}
        linked = [one for one in seen or survey(unit.root) if own & one.files]
        self._linked = [one.harness for one in linked]
        self._reached = {one.harness.name: one.reached for one in linked}
        files = {*closure(unit.root, unit.own_files)}.union(*(one.files for one in linked))
        self._texts = {path: path.read_text(encoding="utf-8") for path in sorted(files)}

    def stop(self) -> None:
        """End all programs."""
        for runner in self._runners:
            runner.stop()

    @property
    def unusable(self) -> list[str]:
        """What is not proved even unchanged, function or harness: it notices nothing."""
        functions = [name for name, stages in self._stages.items() if not stages]
        return sorted([*functions, *(name for name, sound in self._sound.items() if not sound)])

    def _stages_for(self, function: str) -> tuple[wp.Stage, ...]:
        """The provers and limits that prove the function unchanged; none if it is not proved."""
        with self._baseline:
            if function not in self._stages:
                runner = self._runner(self._unit.root)
                tools = self._tools
                prover = wp.Wp(tools.frama_c, runner, self._unit.root, tools.scratch, tools.answers)
                target = self._target(self._unit, function)
                result = prover.prove(target, wp.THOROUGH, False, self._allowed)
                self._stages[function] = (
                    () if result.problems else limits(result, tools.answers / target.identity)
                )
            return self._stages[function]

    def _target(self, unit: Unit, function: str) -> targets.Target:
        target = next(item for item in targets.targets(unit) if item.function == function)
        return frames.restricted(target, self._exceptions)

    @property
    def digest(self) -> str:
        """Of all that the verdicts depend on, mutants aside."""
        return self._digest(self._texts, "")

    def known(self, mutant: Mutant) -> Verdict | None:
        """The verdict that was kept, if nothing that it depends on has changed."""
        kept = self._cache.get(self._key(mutant))
        return Verdict.of(mutant, kept) if kept else None

    def keep(self, verdict: Verdict) -> None:
        """Keep a verdict, so that whoever goes on need not ask again."""
        if verdict.status != "skipped":
            self._cache.put(self._key(verdict.mutant), verdict.outcome)

    def try_mutant(self, mutant: Mutant) -> Verdict:
        """Which engine notices the mutant, if any."""
        verdict = Verdict(mutant)
        with self._trees.with_mutant(mutant, self._unit.root) as tree:
            unit = Unit(tree, self._unit.layer, self._unit.name)
            runner = self._runner(tree)
            same = self._compare(unit, runner)
            if same:
                verdict.status, verdict.reason = same
            else:
                self._ask_engines(verdict, unit, runner)
        return verdict

    def _ask_engines(self, verdict: Verdict, unit: Unit, runner: Runner) -> None:
        """Ask each engine, or until one notices.

        In the latter case CBMC has little time at first: some mutants that are very hard for it
        are easy for WP.
        """
        said: dict[str, str] = {}
        asked = list(self._engines)
        if not self._every and asked == ["cbmc", "wp"]:
            asked = ["cbmc", "wp", "cbmc"]
        for number, engine in enumerate(asked):
            last = engine not in asked[number + 1 :]
            if verdict.engines.get(engine, NO_ANSWER) != NO_ANSWER:
                continue
            if engine == "cbmc":
                verdict.engines[engine] = self._by_cbmc(verdict.mutant, unit, runner, last, said)
            else:
                verdict.engines[engine] = self._by_wp(verdict.mutant, unit, runner)
            if verdict.engines[engine].startswith("killed"):
                verdict.status = "killed"
                if not self._every:
                    return
            elif verdict.engines[engine].startswith(UNDECIDED) and verdict.status != "killed":
                verdict.status = "undecided"

    def _runner(self, folder: Path) -> Runner:
        runner = Runner(dict(self._tools.environment), folder)
        self._runners.append(runner)
        return runner

    def _key(self, mutant: Mutant) -> str:
        """All that a verdict depends on, with the mutant in it."""
        changed = mutant.apply(self._texts[mutant.file])
        return self._digest({**self._texts, mutant.file: changed}, mutant.function)

    def _digest(self, texts: Mapping[Path, str], function: str) -> str:
        root = self._unit.root
        return digest(
            {"mutant": function, "texts": {str(path.relative_to(root)): text
                                           for path, text in texts.items()},
             "stamp": self._stamp, "engines": list(self._engines), "every": self._every,
             "stages": str(wp.THOROUGH), "patient": self._patient}
        )  # fmt: skip

    def _compare(self, unit: Unit, runner: Runner) -> tuple[str, str] | None:
        """Whether the mutant does not compile, or compiles to what the original compiles to."""
        with self._baseline:
            if self._original is None:
                self._original = self._assembly(self._unit, self._runner(self._unit.root))
        if self._original is None:
            raise ProjectError(f"{self._unit.name} does not compile, even unchanged")
        mutated = self._assembly(unit, runner)
        if mutated is None:
            return "stillborn", "does not compile"
        if mutated == self._original:
            return "equivalent", "same object code"
        return None

    def _assembly(self, unit: Unit, runner: Runner) -> str | None:
        """The optimised assembly of a unit; None if it does not compile."""
        file = targets.translation_unit(unit)
        keep = ("-fkeep-inline-functions", "-fkeep-static-functions")
        options = [
            "-O2",
            "-w",
            *keep,
            "-Iinclude",
            "-S",
            "-o",
            "-",
            str(file.relative_to(unit.root)),
        ]
        done = runner.run([*self._tools.compiler, *options], merged=False)
        return done.output if done.status == 0 else None

    def _by_cbmc(
        self, mutant: Mutant, unit: Unit, runner: Runner, patient: bool, asked: dict[str, str]
    ) -> str:  # fmt: skip
        """Whether a harness that reaches the function fails; `asked` has what each said."""
        scratch = self._tools.scratch / unit.root.name
        checker = cbmc.Cbmc(self._tools.goto_cc, self._tools.cbmc, runner, unit.root, scratch)
        for original in self._ranked(mutant, patient):
            if asked.get(original.name, NO_ANSWER) != NO_ANSWER:
                continue
            own = Unit(unit.root, original.unit.layer, original.unit.name)
            harness = read_harness(own, own.folder / original.path.name)
            binary, complaint = checker.build(harness, harness.name)
            thorough = patient and mutant.function in harness.covers
            limited = replace(harness, timeout=self._limit(harness) if thorough else IMPATIENT)
            asked[harness.name] = NO_ANSWER
            if complaint:
                continue
            answer = checker.check(limited, binary, ["--stop-on-fail"])
            if answer.failed and self._passes_unchanged(harness.name):
                return f"killed: {harness.name}: {answer.first_failure}"
            if answer.complete:
                asked[harness.name] = "survived"
        if not asked:
            return "no harness" if patient else NO_ANSWER
        return NO_ANSWER if not patient or NO_ANSWER in asked.values() else "survived"

    def _passes_unchanged(self, name: str) -> bool:
        """Whether a harness proves the original: if not, its failure shows nothing."""
        with self._baseline:
            if name not in self._sound:
                tools, root = self._tools, self._unit.root
                runner = self._runner(root)
                checker = cbmc.Cbmc(tools.goto_cc, tools.cbmc, runner, root, tools.scratch)
                harness = next(item for item in self._linked if item.name == name)
                stamp = {name: text for name, text in self._stamp.items() if name != MAKERS}
                key = engines.cbmc_key(harness, checker, root, stamp)  # that of make prove
                if self._proved.get(key) is None:
                    result = checker.prove(harness)
                    if not result.problems:
                        self._proved.put(key, result.as_dict())
                    self._sound[name] = not result.problems
                else:
                    self._sound[name] = True
            return self._sound[name]

    def _limit(self, harness: Harness) -> float:
        """How long a harness may take: some mutants are much harder than the original."""
        usual = self._times.of("cbmc", harness.unit.name, harness.name)
        return min(harness.timeout, max(IMPATIENT, LAST_PATIENCE * (usual or harness.timeout)))

    def _ranked(self, mutant: Mutant, patient: bool) -> list[Harness]:
        """The harnesses to ask: those that compare the function with its model first."""

        def rank(harness: Harness) -> tuple[int, float, str]:
            usual = self._times.of("cbmc", harness.unit.name, harness.name)
            covers = mutant.function in harness.covers
            compares = covers and "model_" in " ".join(harness.covers)
            own = harness.function == mutant.function
            place = 3 - covers - compares - (compares and own)
            return place, UNTIMED if usual is None else usual, harness.name

        found = [one for one in self._linked if mutant.function in self._reached[one.name]]
        return sorted(
            (one for one in found if patient or mutant.function in one.covers), key=rank
        )  # fmt: skip

    def _by_wp(self, mutant: Mutant, unit: Unit, runner: Runner) -> str:
        """Whether a goal of the function is not proved any more."""
        stages = self._stages_for(mutant.function)
        if not stages:
            return "the function is not proved unchanged"
        scratch = self._tools.scratch / unit.root.name
        answers = scratch / "answers"
        target = self._target(unit, mutant.function)
        known = self._tools.answers / target.identity
        if known.is_dir() and not (answers / target.identity).is_dir():
            shutil.copytree(known, answers / target.identity)
        prover = wp.Wp(self._tools.frama_c, runner, unit.root, scratch, answers)
        return self._asked(prover, target, stages)

    def _asked(self, prover: wp.Wp, target: targets.Target, stages: Sequence[wp.Stage]) -> str:
        """What WP says, first within short limits: what is not proved then gets the full ones."""
        problem = prover.first_problem(target, stages, self._allowed)
        if problem and not self._patient:
            return f"{UNDECIDED}: {problem}"
        problem = problem and prover.first_problem(target, wp.THOROUGH, self._allowed)
        return f"killed: {problem}" if problem else "survived"


def limits(result: targets.Result, answers: Path) -> tuple[wp.Stage, ...]:
    """Passes with the provers that a proof needed, and a multiple of the time that it needed."""
    needed = {goal["prover"].split(" ")[0] for goal in result.goals} & set(PROVERS)
    longest = 0.0
    for path in answers.glob("*.json"):
        answer = json.loads(path.read_text(encoding="utf-8"))
        if answer["verdict"] == "valid" and str(answer["prover"]).split(":")[0] in needed:
            longest = max(longest, float(answer.get("time", 0.0)))
    seconds = min(max(SHORTEST, math.ceil(PATIENCE * longest)), LONGEST)
    names = tuple(name for prover, name in PROVERS.items() if prover in needed) or ("alt-ergo",)
    return wp.Stage(names, seconds), wp.Stage(names, seconds, pruning=True)
