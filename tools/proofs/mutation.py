"""Runs mutants against the proofs: one that no proof notices shows a contract that is too weak."""

from __future__ import annotations

import json
import math
import shutil
import threading
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from . import cbmc, engines, frames, targets, wp
from .cache import Cache, digest
from .harness import Harness, read_harness
from .jobs import Runner
from .mutants import Mutant
from .project import ProjectError, Unit, closure
from .settings import Exceptions
from .times import Times

Identity = tuple[str, str, str, int]

# What is not true is given up soon; how soon depends on how long what is true takes.
PROVERS = {"Alt-Ergo": "alt-ergo", "CVC4": "cvc4", "Z3": "z3"}
PATIENCE = 3.0
SHORTEST, LONGEST = 2, 30
IMPATIENT = 20.0
LAST_PATIENCE = 10.0  # for the attempt after which a mutant is said to survive
NO_ANSWER = "no answer"
# A goal that is not proved within the limits above may be one that takes longer.
UNDECIDED = "not proved in the short limit"


@dataclass
class Verdict:
    """What became of a mutant."""

    mutant: Mutant
    status: str = "survived"
    reason: str = ""
    engines: dict[str, str] = field(default_factory=dict)

    def as_dict(self) -> dict[str, Any]:
        """For the report."""
        mutant = self.mutant
        return {
            "function": mutant.function, "kind": mutant.kind, "line": mutant.line,
            "original": mutant.before, "mutant": mutant.after, "occurrence": mutant.occurrence,
            "status": self.status, "reason": self.reason, "engines": self.engines,
        }  # fmt: skip


def read_equivalent(path: Path) -> dict[Identity, str]:
    """proofs/UNIT/equivalent.toml: survivors that a person has accepted, each with the reason.

    [[equivalent]]
    function = "open_slot"
    original = "for (uint32_t i = queue->count; i > place; i--) {"
    mutant = "for (uint32_t i = queue->count; i != place; i--) {"
    reason = "place never exceeds count, so the loop ends at place either way"
    """
    raw = tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    found: dict[Identity, str] = {}
    for entry in raw.get("equivalent", []):
        wanted = {"function", "original", "mutant", "reason"}
        if not wanted <= set(entry) <= wanted | {"occurrence"} or not entry["reason"].strip():
            raise ProjectError(f"{path}: each entry needs {', '.join(sorted(wanted))}")
        occurrence = int(entry.get("occurrence", 1))
        found[entry["function"], entry["original"], entry["mutant"], occurrence] = entry["reason"]
    return found


class Trees:
    """Copies of the tree, one for each trial at a time: the tree itself is never touched."""

    def __init__(self, root: Path, scratch: Path, count: int) -> None:
        self._free: list[Path] = []
        self._lock = threading.Lock()
        for number in range(count):
            tree = scratch / f"tree{number}"
            for name in ("include", "src", "proofs"):
                shutil.copytree(root / name, tree / name)
            self._free.append(tree)

    @contextmanager
    def with_mutant(self, mutant: Mutant, root: Path) -> Iterator[Path]:
        """A tree in which the mutant has taken its file's place."""
        with self._lock:
            tree = self._free.pop()
        file = tree / mutant.file.relative_to(root)
        text = file.read_text(encoding="utf-8")
        try:
            file.write_text(mutant.apply(text), encoding="utf-8")
            yield tree
        finally:
            file.write_text(text, encoding="utf-8")
            with self._lock:
                self._free.append(tree)


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


class Trial:
    """Tries the mutants of one unit."""

    def __init__(
        self, unit: Unit, tools: Tools, trees: Trees, asked: Sequence[str], every: bool,
        cache: Cache, stamp: Mapping[str, str], exceptions: Exceptions,
        times: Times, patient: bool = True,
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
        self._harnesses = [read_harness(unit, path) for path in unit.harnesses]

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

    def try_mutant(self, mutant: Mutant) -> Verdict:
        """Which engine notices the mutant, if any."""
        verdict = Verdict(mutant)
        with self._trees.with_mutant(mutant, self._unit.root) as tree:
            unit = Unit(tree, self._unit.layer, self._unit.name)
            runner = self._runner(tree)
            same = self._compare(unit, runner)
            if same:
                verdict.status, verdict.reason = same
                return verdict
            key = self._key(mutant, unit)
            known = self._cache.get(key)
            if known:
                verdict.status, verdict.engines = "killed", known["engines"]
                return verdict
            self._ask_engines(verdict, unit, runner)
            if verdict.status == "killed":
                self._cache.put(key, {"engines": verdict.engines})
        return verdict

    def _ask_engines(self, verdict: Verdict, unit: Unit, runner: Runner) -> None:
        """Ask each engine, or until one notices.

        In the latter case CBMC has little time at first: some mutants that are very hard for it
        are easy for WP.
        """
        asked = list(self._engines)
        if not self._every and asked == ["cbmc", "wp"]:
            asked = ["cbmc", "wp", "cbmc"]
        for number, engine in enumerate(asked):
            last = engine not in asked[number + 1 :]
            if verdict.engines.get(engine, NO_ANSWER) != NO_ANSWER:
                continue
            if engine == "cbmc":
                verdict.engines[engine] = self._by_cbmc(verdict.mutant, unit, runner, last)
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

    def _key(self, mutant: Mutant, unit: Unit) -> str:
        """All that a verdict depends on, with the mutant in it."""
        files = closure(unit.root, [*unit.own_files, *unit.harnesses])
        texts = {str(path.relative_to(unit.root)): path.read_text() for path in files}
        return digest(
            {"mutant": mutant.function, "texts": texts, "stamp": self._stamp,
             "engines": list(self._engines), "every": self._every, "stages": str(wp.THOROUGH)}
        )  # fmt: skip

    def _compare(self, unit: Unit, runner: Runner) -> tuple[str, str] | None:
        """Whether the mutant does not compile, or compiles to what the original compiles to."""
        original = self._assembly(self._unit, self._runner(self._unit.root))
        if original is None:
            raise ProjectError(f"{self._unit.name} does not compile, even unchanged")
        mutated = self._assembly(unit, runner)
        if mutated is None:
            return "stillborn", "does not compile"
        if mutated == original:
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

    def _by_cbmc(self, mutant: Mutant, unit: Unit, runner: Runner, patient: bool) -> str:
        """Whether a harness that reaches the function fails."""
        scratch = self._tools.scratch / unit.root.name
        checker = cbmc.Cbmc(self._tools.goto_cc, self._tools.cbmc, runner, unit.root, scratch)
        answers = []
        for path in self._harness_files(mutant, unit):
            harness = read_harness(unit, path)
            binary, complaint = checker.build(harness, harness.name)
            limited = replace(harness, timeout=self._limit(harness) if patient else IMPATIENT)
            if complaint:
                answers.append(NO_ANSWER)
                continue
            answer = checker.check(limited, binary, ["--stop-on-fail"])
            if answer.failed and self._passes_unchanged(harness.name):
                return f"killed: {harness.name}: {answer.first_failure}"
            answers.append("survived" if answer.complete else NO_ANSWER)
        if not answers:
            return "no harness"
        return NO_ANSWER if NO_ANSWER in answers else "survived"

    def _passes_unchanged(self, name: str) -> bool:
        """Whether a harness proves the original: if not, its failure shows nothing."""
        with self._baseline:
            if name not in self._sound:
                tools, root = self._tools, self._unit.root
                runner = self._runner(root)
                checker = cbmc.Cbmc(tools.goto_cc, tools.cbmc, runner, root, tools.scratch)
                harness = next(item for item in self._harnesses if item.name == name)
                key = engines.cbmc_key(harness, checker, root, self._stamp)
                known = self._proved.get(key)
                self._sound[name] = known is not None or not checker.prove(harness).problems
            return self._sound[name]

    def _limit(self, harness: Harness) -> float:
        """How long a harness may take: some mutants are much harder than the original."""
        usual = self._times.of("cbmc", self._unit.name, harness.name)
        return min(harness.timeout, max(IMPATIENT, LAST_PATIENCE * (usual or harness.timeout)))

    def _harness_files(self, mutant: Mutant, unit: Unit) -> list[Path]:
        """The harnesses that reach the function, its own first."""
        relevant = [harness for harness in self._harnesses if mutant.function in harness.covers]

        def rank(harness: Harness) -> tuple[bool, str]:
            return harness.function != mutant.function, harness.name

        return [unit.folder / harness.path.name for harness in sorted(relevant, key=rank)]

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


def count(verdicts: Sequence[Verdict], status: str) -> int:
    """How many mutants have a status."""
    return sum(verdict.status == status for verdict in verdicts)


def settle(
    verdicts: Sequence[Verdict], accepted: Mapping[Identity, str], complete: bool
) -> list[str]:
    """Apply the accepted reasons to survivors; what is left to complain about."""
    problems = []
    unused = dict(accepted)
    for verdict in verdicts:
        reason = unused.pop(verdict.mutant.identity, None)
        if reason is None:
            continue
        if verdict.status in ("survived", "undecided"):
            verdict.status, verdict.reason = "equivalent", reason
        elif verdict.status != "skipped":
            problems.append(f"equivalent.toml: needless, it is {verdict.status}: {verdict.mutant}")
    if complete:
        problems += [f"equivalent.toml: there is no such mutant: {' | '.join(map(str, identity))}"
                     for identity in unused]  # fmt: skip
    return problems


def table(verdicts: Sequence[Verdict], engines: Sequence[str]) -> list[str]:
    """Numbers of the run, by engine and by kind of mutant."""
    lines = []
    for engine in engines:
        asked = [verdict for verdict in verdicts if engine in verdict.engines]
        killed = sum(verdict.engines[engine].startswith("killed") for verdict in asked)
        lines.append(f"{engine.upper():<5} killed {killed:>3} of {len(asked):>3} that it saw")
    return lines


def report(unit: str, verdicts: Sequence[Verdict], problems: Sequence[str]) -> str:
    """The report, as JSON."""
    names = ("killed", "survived", "undecided", "equivalent", "stillborn", "skipped")
    summary: dict[str, Any] = {name: count(verdicts, name) for name in names}
    entries = [verdict.as_dict() for verdict in verdicts]
    content = {"unit": unit, "summary": summary, "problems": list(problems), "mutants": entries}
    return json.dumps(content, indent=1) + "\n"
