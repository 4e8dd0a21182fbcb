"""Proves units with Frama-C/WP, one process per function.

WP is modular: the proof of a function depends on its body and on the contracts of what it calls.
So functions are proved apart, two at a time, and one that did not change is not proved again. A
function is proved where it is defined, in the unit of its header or source; a lemma likewise.
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import re
import shutil
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from . import csource, frames, wplog
from .cache import write_atomically
from .jobs import Runner
from .project import Unit, closure

CHECKS = (
    "-warn-unsigned-overflow", "-warn-unsigned-downcast", "-warn-signed-downcast",
    # Each call through a pointer has a `calls` annotation, whose goal says more than that the
    # pointer is some function: WP has no meaning for \valid_function.
    "-rte-no-pointer-call",
)  # fmt: skip


@dataclass(frozen=True)
class Stage:
    """One pass over the goals that are still open. Several provers race for each goal."""

    provers: tuple[str, ...]
    seconds: int
    pruning: bool = False
    steps: int = 0

    def options(self, before: Sequence[str]) -> list[str]:
        """The options that choose this pass; `before` are the provers of the pass before it.

        A prover that is named again would be asked again, once for each time.
        """
        added = [name for name in self.provers if name not in before]
        dropped = [f"-{name}" for name in before if name not in self.provers]
        changes = ",".join([*dropped, *added])
        options = [f"-wp-prover={changes}"] if changes else []
        options += ["-wp-timeout", str(self.seconds)]
        options += ["-wp-pruning" if self.pruning else "-wp-no-pruning"]
        return [*options, "-wp-steps", str(self.steps)] if self.steps else options


# Alt-Ergo proves nearly everything in milliseconds, CVC4 what is left in little more; z3 hardly
# ever helps. To prepare the goals costs WP more than to prove them, and two thirds of that is its
# search for branches that cannot be taken; the few goals that need it get it in a pass of their
# own. Long limits come last, and cost time only when something is wrong or the machine is loaded.
QUICK = (Stage(("alt-ergo", "cvc4"), 10),)
THOROUGH = (
    *QUICK,
    Stage(("alt-ergo", "cvc4"), 20, pruning=True),
    Stage(("alt-ergo", "cvc4", "z3"), 100),
)
# A contradiction shows early: seeded ones were found with 50 000 steps wherever they were with
# 75 000. WP proves calls through pointers once more in this pass, which takes 56 000. Steps count
# alike on every machine; the seconds only guard.
SMOKE = Stage(("cvc4",), 10, steps=60_000)

VARIANT = re.compile(r"(.*_loop_variant(?:_\d+)?_decrease)(?:_part\d+)?$")
CLAUSE = re.compile(r"\b(?:ensures|invariant|assert|requires|lemma)\s+(\w+)\s*:")

# Messages that take nothing from a proof.
HARMLESS = {
    "has no registered macro": "the headers are the compiler's own, they ask for no such macro",
    "Callers assumptions might be imprecise": "about \\from clauses, which WP does not use",
    "Failed smoke-test": "counted, and reported by name",
    "No goal generated": "a later stage finds nothing left; a target without goals is a failure",
}


@dataclass(frozen=True)
class Target:
    """What one process proves: a function, or the lemmas of a unit, in one file."""

    unit: Unit
    file: Path
    function: str | None
    lemmas: tuple[str, ...] = ()
    # Labels that CBMC proves, postconditions and the results of floats besides; None: none.
    left: tuple[str, ...] | None = None

    @property
    def name(self) -> str:
        """For people."""
        return self.function or "lemmas"

    @property
    def identity(self) -> str:
        """For files."""
        return f"{self.unit.name}-{self.file.stem}-{self.name}"

    @property
    def selection(self) -> list[str]:
        """The options that select these goals and no others."""
        if self.function:
            return ["-wp-fct", self.function, *frames.selection(self.left)]
        return ["-wp-prop", ",".join(self.lemmas)]


@dataclass
class Result:
    """What became of a target."""

    goals: list[dict[str, str]] = field(default_factory=list)
    smoke: int = 0
    allowed: list[str] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def proved(self) -> int:
        """How many goals are proved."""
        return sum(goal["status"] == "Valid" for goal in self.goals)

    def as_dict(self) -> dict[str, Any]:
        """For the cache."""
        return asdict(self)


def translation_unit(unit: Unit) -> Path:
    """The file that is proved: the source, or a file that includes a unit of inline functions."""
    if unit.source.is_file():
        return unit.source
    path = unit.root / "build" / "prove" / "inline" / f"{unit.name}.c"
    write_atomically(path, f'#include "keel/{unit.layer}/{unit.name}.h"\n')
    return path


def targets(unit: Unit) -> Iterator[Target]:
    """All that is to be proved about a unit."""
    main = translation_unit(unit)
    yield from _targets_of(unit, main, unit.own_files)
    for theorem in unit.theorems:
        yield from _targets_of(unit, theorem, [theorem])


def _targets_of(unit: Unit, main: Path, files: Sequence[Path]) -> Iterator[Target]:
    texts = [path.read_text(encoding="utf-8") for path in files]
    for text in texts:
        for function in csource.defined(text):
            yield Target(unit, main, function.name)
    lemmas = tuple(name for text in texts for name in csource.lemmas(text))
    if lemmas:
        yield Target(unit, main, None, lemmas)


def dependencies(target: Target, root: Path) -> dict[str, str]:
    """The text that a target's verdict depends on, file by file."""
    keep = frozenset([target.function] if target.function else [])
    return {
        str(path.relative_to(root)): csource.without_other_bodies(path.read_text(), keep)
        for path in closure(root, [target.file, *target.unit.own_files])
    }


class Wp:
    """Frama-C/WP for the target."""

    def __init__(
        self, frama_c: Sequence[str], runner: Runner, root: Path, scratch: Path,
        prover_cache: Path | None = None,
    ) -> None:  # fmt: skip
        self._frama_c = list(frama_c)
        self._runner = runner
        self._root = root
        self._scratch = scratch
        self._prover_cache = prover_cache

    def options(self) -> list[str]:
        """Everything on the command line that is the same for all targets."""
        return [*self._frama_c, *CHECKS, "-cpp-extra-args=-Iinclude"]

    def _own_options(self, name: str) -> list[str]:
        """The options for one process, with a machdep of its own.

        Frama-C compiles a script beside its source, where two processes would collide.
        """
        options = self.options()
        place = options.index("-load-script") + 1
        script = Path(options[place])
        copy = self._scratch / name / script.name
        copy.parent.mkdir(exist_ok=True)
        shutil.copyfile(script, copy)
        return [*options[:place], str(copy), *options[place + 1 :]]

    def survey(self, unit: str, file: Path) -> wplog.Log:
        """Parse a file and learn which functions it defines, includes and all."""
        command = [*self._own_options(f"{unit}-survey"), self._shown(file), "-rte"]
        return wplog.read_log(self._runner.run(command).output)

    def prove(
        self, target: Target, stages: Sequence[Stage] = THOROUGH, smoke: bool = True,
        allowed: Sequence[str] = (),
    ) -> Result:  # fmt: skip
        """Prove a target."""
        start = time.monotonic()
        report = self._scratch / f"{target.identity}.json"
        report.unlink(missing_ok=True)
        with self._answers_alone(target):
            done = self._runner.run(self.command(target, stages, smoke, report))
            self._drop_failures(target)
        written = report.read_text(encoding="utf-8") if report.is_file() else ""
        result = judge(target, done.output, written, self._root, allowed)
        result.seconds = round(time.monotonic() - start, 1)
        return result

    def first_problem(self, target: Target, stages: Sequence[Stage], allowed: Sequence[str]) -> str:
        """Why a target is not proved, without waiting for more than one reason; "" if it is."""
        report = self._scratch / f"{target.identity}.json"
        passes = 0

        def enough(line: str) -> bool:
            nonlocal passes
            passes += line.startswith("[wp] Running WP plugin")
            goal = wplog.GOAL.match(line)
            return passes == len(stages) and goal is not None and goal["status"] != "Valid"

        output = self._runner.run_until(self.command(target, stages, False, report), enough)
        self._drop_failures(target)
        log = wplog.read_log(output)
        if not log.goals:
            return "WP has no goal"
        problems = [goal.name for goal in log.goals.values() if not goal.proved]
        problems += _messages(log, allowed, []) + _loops(target, log)
        return problems[0] if problems else ""

    def command(
        self, target: Target, stages: Sequence[Stage], smoke: bool, report: Path
    ) -> list[str]:
        """One process; each stage takes up what the stages before it left open.

        Lemmas are not filtered by WP in that way; they get all provers in one stage, and have no
        code that a smoke test could look at.
        """
        command = [*self._own_options(target.identity), self._shown(target.file)]
        command += self._cache_options(target)
        before: tuple[str, ...] = ()
        smoke = smoke and target.function is not None
        passes = [*stages, SMOKE] if smoke else list(stages)
        if target.function is None:
            names = dict.fromkeys(name for stage in stages for name in stage.provers)
            passes = [Stage(tuple(names), max(stage.seconds for stage in stages))]
        for number, stage in enumerate(passes):
            command += ["-then"] if number else []
            command += ["-wp", "-wp-rte", "-wp-status-invalid", *target.selection, "-wp-par", "2"]
            command += stage.options(before)
            before = stage.provers
        if smoke:
            command += ["-wp-smoke-tests", "-wp-smoke-timeout", str(SMOKE.seconds)]
        return [*command, "-wp-report-json", str(report)]

    def _shown(self, file: Path) -> str:
        return str(file.relative_to(self._root)) if file.is_relative_to(self._root) else str(file)

    def _cache_of(self, target: Target) -> Path | None:
        """A folder per target: two processes never write one file."""
        base = self._prover_cache
        return base / target.identity if base else None

    def _cache_options(self, target: Target) -> list[str]:
        folder = self._cache_of(target)
        if not folder:
            return ["-wp-cache", "none"]
        folder.mkdir(parents=True, exist_ok=True)
        return ["-wp-cache", "update", "-wp-cache-dir", str(folder)]

    @contextlib.contextmanager
    def _answers_alone(self, target: Target) -> Iterator[None]:
        """Keep another run in this clone away from the same answers."""
        folder = self._cache_of(target)
        if not folder:
            yield
            return
        folder.parent.mkdir(parents=True, exist_ok=True)
        with folder.with_suffix(".lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield

    def _drop_failures(self, target: Target) -> None:
        """Forget what a prover did not prove, but for the steps that smoke tests use up."""
        folder = self._cache_of(target)
        for path in folder.glob("*.json") if folder else ():
            try:
                entry = json.loads(path.read_text())
                keep = entry["verdict"] in ("valid", "stepout")
            except (OSError, ValueError, KeyError, TypeError):
                keep = False
            if not keep:
                path.unlink(missing_ok=True)


def judge(
    target: Target, output: str, report: str, root: Path, allowed: Sequence[str] = ()
) -> Result:
    """What a run of WP shows, from its output and its JSON report."""
    log = wplog.read_log(output)
    result = Result(smoke=sum(log.smoke.values()))
    result.goals = [
        {"name": goal.name, "status": goal.status, "prover": goal.prover}
        for goal in log.goals.values()
    ]
    result.problems += _structure(target, log, report, output)
    result.problems += _messages(log, allowed, result.allowed)
    result.problems += _unproved(target, log, root)
    result.problems += _loops(target, log)
    return result


def _structure(target: Target, log: wplog.Log, report: str, output: str) -> list[str]:
    """What is wrong with the run as such."""
    try:
        totals = wplog.read_report(json.loads(report))
    except (ValueError, AttributeError):
        tail = " | ".join(output.strip().splitlines()[-3:])
        return [f"{target.name}: WP wrote no report; it ended with: {tail}"]
    problems = []
    if difference := wplog.disagreement(log, totals):
        problems.append(f"{target.name}: do not trust this run, WP's {difference}")
    if not log.goals:
        problems.append(f"{target.name}: WP has no goal for it")
    if target.function and target.function not in log.functions:
        problems.append(f"{target.name}: WP does not know this function")
    return problems


def _messages(log: wplog.Log, allowed: Sequence[str], used: list[str]) -> list[str]:
    """Warnings that nobody has declared harmless: each may be a hole in the proof."""
    problems = []
    for message in log.messages:
        if any(text in message.text for text in HARMLESS) and message.level == "Warning":
            continue
        exception = next((text for text in allowed if text in message.text), None)
        if exception is None:
            problems.append(f"{message}")
        elif exception not in used:
            used.append(exception)
    return list(dict.fromkeys(problems))


def _unproved(target: Target, log: wplog.Log, root: Path) -> list[str]:
    """The goals that no prover proved, and the smoke tests that failed."""
    problems = []
    for goal in log.goals.values():
        if not goal.proved:
            tried = ", ".join(dict.fromkeys(goal.attempts)) or goal.status
            place = place_of(target, goal.name, root)
            problems.append(f"{goal.name} is not proved ({place}): {tried}")
    for name, passed in log.smoke.items():
        if not passed:
            seen = [m.place for m in log.messages if "Failed smoke-test" in m.text]
            places = ", ".join(seen) or "no place known"
            problems.append(f"smoke test {name} failed ({places}): a contradiction, or dead code")
    return problems


def _loops(target: Target, log: wplog.Log) -> list[str]:
    """Every loop needs a variant, or the proof says nothing about its end."""
    if not target.function:
        return []
    for path in (target.file, *target.unit.own_files):
        body = csource.body_of(path.read_text(encoding="utf-8"), target.function)
        if body:
            loops = csource.loops(body)
            named = (VARIANT.match(goal.name) for goal in log.goals.values())
            variants = {match.group(1) for match in named if match}  # a goal may come in parts
            if loops != len(variants):
                return [
                    f"{target.name}: {loops} loops, but {len(variants)} loop variants:"
                    " does it end?"
                ]
            return []
    return []


def place_of(target: Target, goal: str, root: Path) -> str:
    """File and line of the clause that bears the goal's label, else of the function."""
    files = [*dict.fromkeys([*target.unit.own_files, target.file])]
    fallback = ""
    for path in files:
        text = path.read_text(encoding="utf-8")
        shown = path.relative_to(root) if path.is_relative_to(root) else path
        for first, last, line in _regions(text, target.function):
            fallback = f"{shown}:{line}"
            for number, clause in enumerate(text.splitlines()[first:last], first + 1):
                label = CLAUSE.search(clause)
                if label and re.search(
                    rf"_{label.group(1)}(_\d+)?(_established|_preserved)?$", goal
                ):
                    return f"{shown}:{number}"
    return fallback or "no place known"


def _regions(text: str, function: str | None) -> Iterator[tuple[int, int, int]]:
    """The lines of a function with its contract: from the end of what stands before it to its own.

    For lemmas, the whole text.
    """
    lines = text.count("\n") + 1
    if function is None:
        yield 0, lines, 1
        return
    first = 0
    for found in csource.functions(text):
        last = text.count("\n", 0, found.body[1]) + 1 if found.body else found.line
        if found.name == function:
            yield first, last, found.line
        first = last
