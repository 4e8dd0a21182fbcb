# SPDX-License-Identifier: Apache-2.0
"""Runs mutants against the proofs: one that no proof notices shows a contract that is too weak."""

from __future__ import annotations

import json
import math
import shutil
import threading
from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from keel.base.jobs import Runner
from keel.base.verdict_cache import Cache, digest
from keel.c import source as csource
from keel.c.project import ProjectError, Unit, closure
from keel.engines import cbmc, wp
from keel.judge import wp_frames as frames
from keel.judge import wp_targets as targets
from keel.judge.harness import Harness
from keel.judge.settings import Exceptions
from keel.mutate.execution import CONFIRMING, Executions, Sample
from keel.mutate.harnesses import Seen, in_tree, survey
from keel.mutate.operators import Mutant
from keel.mutate.seeds import SECONDS, Seeds
from keel.mutate.small_harnesses import TIME, WALL, Small
from keel.mutate.trees import Trees
from keel.mutate.verdicts import Identity, Verdict
from keel.prove import job_list as engines
from keel.prove.times import Times
from keel.prove.verdict_keys import started

# What is not true is given up soon; how soon depends on how long what is true takes.
PROVERS = {"Alt-Ergo": "alt-ergo", "CVC4": "cvc4", "Z3": "z3"}
PATIENCE = 3.0
SHORTEST, LONGEST = 2, 30
IMPATIENT = 20.0
CHOSEN = "__points_harness"  # Of chosen points: nothing is arbitrary there.
ENDED = 60.0  # where executions did not end: WP sees a loop that goes on for ever, and soon
UNTIMED = 60.0  # what a harness counts for whose time nobody knows
LAST_PATIENCE = 4.0  # for the attempt after which a mutant is said to survive
NO_ANSWER = "no answer"
CONTRADICTION = "contradiction"
CONFIRM = 50  # of so many mutants that executions kill CBMC is asked about one
# Of so many mutants that WP kills one is asked about with the full limits: that takes three provers
# some ten minutes.
CONFIRM_WP = 50
# A program that may take so many seconds of processor time.
LIMITED = ("sh", "-c", 'ulimit -t "$0"; exec "$@"')
# C allows no pointer for a number, nor one for another type's: who mixes them up is stillborn.
NO_MIXTURE = ("-Werror=int-conversion", "-Werror=incompatible-pointer-types")
# In a stamp, what judges mutants by each engine, and what judges what is unchanged: the latter is
# more, and the kept proofs of `make prove` alone depend on it.
BY_CBMC, BY_WP, DRIVER = "judges by CBMC", "judges by WP", "driver"
# A goal that is not proved within the limits above may be one that takes longer.
UNDECIDED = "not proved in the short limit"
SHORTLY = " (not proved in three times the time)"


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
    # What harnesses are executed with, its version, and where inputs are kept; or nothing.
    clang: Sequence[str] = ()
    clang_version: str = ""
    inputs: Path | None = None


class Trial:
    """Tries the mutants of one unit.

    A mutant is tried first by executions of the harnesses on this machine, some of which CBMC is
    asked to confirm. Where they do not come to an end, CBMC is asked about the harness in which
    they did not. Then small harnesses try it, the one that killed most mutants of its function
    before the others; then it is tried by WP, which asks the function alone: what its callers rely
    on is its contract, not its body. The rest get the harnesses themselves: those that compare
    its function with the model before the others that cover it. Among equals the one that is
    usually fastest comes first. A mutant whose reason to be none is accepted
    is tried by executions and small harnesses alone: they tell a wrong reason.

    All limits for CBMC are in processor time: what else the machine does changes no verdict.
    """

    def __init__(
        self,
        unit: Unit,
        tools: Tools,
        trees: Trees,
        asked: Sequence[str],
        every: bool,
        cache: Cache,
        stamp: Mapping[str, str],
        exceptions: Exceptions,
        times: Times,
        patient: bool = True,
        seen: Sequence[Seen] | None = None,
        small_only: bool = False,
        accepted: Collection[Identity] = (),
        confirm: int = CONFIRM,
    ) -> None:
        self._unit = unit
        self._tools = tools
        self._trees = trees
        self._engines = list(asked)
        self._every = every
        self._cache = cache
        self._stamp = dict(stamp)
        self._runners: list[Runner] = []
        self._exceptions = exceptions
        self._times = times
        self._patient = patient
        self._small_only = small_only
        self._accepted = frozenset(accepted)
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
        self._seen = {one.harness.name: one for one in linked}
        self._beside: dict[tuple[str, Path], str] = {}
        self.sample = Sample(confirm)
        self.late = Sample(CONFIRM_WP)
        self._executions = (
            Executions(
                unit,
                tools.clang,
                tools.clang_version,
                linked,
                tools.scratch,
                Cache(tools.inputs),
                lambda: self._runner(unit.root),
                self._seeds,
            )
            if tools.clang
            else None
        )
        self._small = Small({one.harness.name: one.files for one in linked}, self._unchanged)
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

    @property
    def not_executed(self) -> dict[str, str]:
        """The harnesses that could have been executed, but are not, with the reason."""
        return dict(self._executions.failing) if self._executions else {}

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

    def digest_of(self, mutants: Sequence[Mutant], accepted: str) -> str:
        """Of all that a report on mutants depends on, accepted reasons included."""
        names = [list(mutant.identity) for mutant in mutants]
        return digest([self._digest(self._texts, ""), names, accepted])

    def known(self, mutant: Mutant) -> Verdict | None:
        """The verdict that was kept, if nothing that it depends on has changed."""
        keys = [self._key(mutant)]
        if self._engines[:1] == ["cbmc"] and not self._every:
            keys += [
                self._kill_key(mutant, one)
                for one in self._linked
                if mutant.function in self._reached[one.name]
            ]
        kept = next((found for key in keys if (found := self._cache.get(key))), None)
        return Verdict.of(mutant, kept) if kept else None

    def keep(self, verdict: Verdict) -> None:
        """Keep a verdict, so that whoever goes on need not ask again."""
        contradicted = verdict.engines.get("cbmc", "").startswith(CONTRADICTION)
        if verdict.status == "skipped" or contradicted:
            return
        key = self._key(verdict.mutant)
        if verdict.status == "killed" and list(verdict.engines) == ["cbmc"]:
            name = verdict.engines["cbmc"].split(": ")[1]
            key = self._kill_key(verdict.mutant, next(x for x in self._linked if x.name == name))
        self._cache.put(key, verdict.outcome)

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

        In the latter case WP comes first: what the small harnesses left is slow for CBMC.
        """
        if "cbmc" in self._engines and self._killed_by_execution(verdict, unit, runner):
            return
        if "cbmc" in self._engines and self._killed_where_it_ended(verdict, unit, runner):
            return
        if "cbmc" in self._engines and self._killed_by_small(verdict, unit, runner):
            return
        if self._small_only:
            verdict.status, verdict.reason = "skipped", "left by the small harnesses"
            return
        if verdict.mutant.identity in self._accepted:
            verdict.engines = dict.fromkeys(self._engines, "not asked: the reason is accepted")
            return
        asked = self._engines
        if not self._every and asked == ["cbmc", "wp"]:
            asked = ["wp", "cbmc"]
        for engine in asked:
            if engine in verdict.engines:
                continue
            if engine == "cbmc":
                verdict.engines[engine] = self._by_cbmc(verdict.mutant, unit, runner)
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

    def _kill_key(self, mutant: Mutant, harness: Harness) -> str:
        """All that the counterexample of a harness depends on: contracts are comments to CBMC."""
        place = (harness.name, mutant.file)
        if place not in self._beside:
            root = self._unit.root
            texts = {
                path.relative_to(root).as_posix(): csource.essence(self._texts[path])
                for path in self._seen[harness.name].files
                if path != mutant.file
            }
            self._beside[place] = digest([texts, self._seen[harness.name].command])
        changed = csource.essence(mutant.apply(self._texts[mutant.file]))
        stamp = started("cbmc", self._stamp_without(DRIVER, BY_WP))
        return digest([self._beside[place], mutant.function, changed, stamp])

    def _key(self, mutant: Mutant) -> str:
        """All that a verdict depends on, with the mutant in it."""
        changed = mutant.apply(self._texts[mutant.file])
        accepted = " accepted" if mutant.identity in self._accepted else ""
        return self._digest({**self._texts, mutant.file: changed}, mutant.function + accepted)

    def _digest(self, texts: Mapping[Path, str], function: str) -> str:
        root = self._unit.root
        return digest(
            {
                "mutant": function,
                "texts": {str(path.relative_to(root)): text for path, text in texts.items()},
                "harnesses": [one.command for one in self._seen.values()],
                "exceptions": asdict(self._exceptions),
                "stamp": self._stamp_without(DRIVER),
                "engines": self._engines,
                "every": self._every,
                "stages": str(wp.THOROUGH),
                "patient": self._patient,
            }
        )

    def _stamp_without(self, *apart: str) -> dict[str, str]:
        return {name: text for name, text in self._stamp.items() if name not in apart}

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
            *NO_MIXTURE,
            *keep,
            "-Iinclude",
            "-S",
            "-o",
            "-",
            str(file.relative_to(unit.root)),
        ]
        done = runner.run([*self._tools.compiler, *options], merged=False)
        return done.output if done.status == 0 else None

    def _by_cbmc(self, mutant: Mutant, unit: Unit, runner: Runner) -> str:
        """Whether a harness that covers the function fails."""
        covering = [one for one in self._ranked(mutant) if mutant.function in one.covers]
        survived = True
        for original in covering:
            killed, complete = self._by_harness(original, unit, runner, self._limit(original))
            if killed:
                return killed
            survived = survived and complete
        if not covering:
            return "no harness"
        return "survived" if survived else NO_ANSWER

    def _by_harness(
        self, original: Harness, unit: Unit, runner: Runner, limit: float
    ) -> tuple[str, bool]:
        """How a harness kills within a limit, or nothing; and whether CBMC came to an end."""
        harness = replace(in_tree(original, unit.root), timeout=WALL * limit)
        checker = self._checker(unit.root, runner, limit)
        binary, complaint = checker.build(harness, harness.name)
        if complaint:
            return "", False
        answer = checker.check(harness, binary, ["--stop-on-fail"])
        if answer.failed and self._passes_unchanged(harness.name):
            return f"killed: {harness.name}: {answer.first_failure}", answer.complete
        return "", answer.complete

    def _killed_by_execution(self, verdict: Verdict, unit: Unit, runner: Runner) -> bool:
        """Execute the harnesses; whether no engine need be asked."""
        mutant = verdict.mutant
        if not self._executions:
            return False
        kill = self._executions.kills(mutant, self._ranked(mutant), unit.root, runner)
        if not kill:
            return False
        verdict.engines["cbmc"] = kill.said
        verdict.status = "killed"
        if self.sample.takes():
            checker = self._checker(unit.root, runner, CONFIRMING)
            confirmed = self._executions.confirmed(kill, checker, unit.root)
            self.sample.heard(confirmed, f"{mutant}: {kill.said}")
            if confirmed is False:
                said = f"{CONTRADICTION}: CBMC sees no failure in this execution"
                verdict.engines["cbmc"] = f"{said}: {kill.said}"
                verdict.status = "undecided"
                return True
        return not self._every

    def _killed_where_it_ended(self, verdict: Verdict, unit: Unit, runner: Runner) -> bool:
        """Ask the harness in which no execution came to its end; whether no engine need be asked.

        It does what C leaves undefined, or goes on for ever: small harnesses look for neither. One
        in which nothing is arbitrary needs no solver to see that a loop has no end.
        """
        mutant = verdict.mutant
        ended = self._executions and self._executions.ended.get(mutant.identity)
        if not ended:
            return False
        chosen = [one for one in self._ranked(mutant) if one.name.endswith(CHOSEN)]
        for harness in (*chosen, ended):
            limit = min(ENDED, self._limit(harness))
            killed, _ = self._by_harness(harness, unit, runner, limit)
            if killed:
                verdict.engines["cbmc"] = killed
                verdict.status = "killed"
                return not self._every
        return False

    def _killed_by_small(self, verdict: Verdict, unit: Unit, runner: Runner) -> bool:
        """Ask small harnesses; whether no other engine need be asked."""
        mutant = verdict.mutant
        checker = self._checker(unit.root, runner, TIME)
        for harness in self._small.ranked(mutant.function, self._ranked(mutant)):
            if text := self._small.kills(harness, mutant.function, checker, unit.root):
                verdict.engines["cbmc"] = text
                verdict.status = "killed"
                return not self._every
        return False

    def _unchanged(self) -> cbmc.Cbmc:
        """What asks about the tree itself."""
        return self._checker(self._unit.root, self._runner(self._unit.root))

    def _seeds(self) -> Seeds:
        """What finds inputs for harnesses that are executed."""
        root = self._unit.root
        command = [*LIMITED, str(SECONDS), *self._tools.cbmc]
        return Seeds(command, self._unchanged(), self._runner(root), root)

    def _checker(self, root: Path, runner: Runner, limit: float = 0.0) -> cbmc.Cbmc:
        """CBMC, with a limit of its processor time if there is one."""
        tools = self._tools
        scratch = tools.scratch if root == self._unit.root else tools.scratch / root.name
        command = [*LIMITED, str(math.ceil(limit)), *tools.cbmc] if limit else tools.cbmc
        return cbmc.Cbmc(tools.goto_cc, command, runner, root, scratch)

    def _passes_unchanged(self, name: str) -> bool:
        """Whether a harness proves the original: if not, its failure shows nothing."""
        with self._baseline:
            if name not in self._sound:
                root, checker = self._unit.root, self._unchanged()
                harness = next(item for item in self._linked if item.name == name)
                stamp = started("cbmc", self._stamp_without(BY_CBMC, BY_WP))
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

    def _ranked(self, mutant: Mutant) -> list[Harness]:
        """The harnesses to ask: those that compare the function with its model first."""

        def rank(harness: Harness) -> tuple[int, float, str]:
            usual = self._times.of("cbmc", harness.unit.name, harness.name)
            covers = mutant.function in harness.covers
            compares = covers and "model_" in " ".join(harness.covers)
            own = harness.function == mutant.function
            place = 3 - covers - compares - (compares and own)
            return place, UNTIMED if usual is None else usual, harness.name

        found = [one for one in self._linked if mutant.function in self._reached[one.name]]
        return sorted(found, key=rank)

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
        """What WP says within a multiple of the time that the unchanged function needs.

        One in CONFIRM_WP of those that it does not prove gets the full limits. If these prove one,
        the limits say too little of the unit: then all get the full ones from there on, and the
        run fails, as others were said to be killed before.
        """
        problem = prover.first_problem(target, stages, self._allowed)
        if not problem:
            return "survived"
        if not self._patient:
            return f"{UNDECIDED}: {problem}"
        if not self.late.takes() and not self.late.contradictions:
            return f"killed: {problem}{SHORTLY}"
        proved = not prover.first_problem(target, wp.THOROUGH, self._allowed)
        self.late.heard(not proved, f"{target.name}: {problem}")
        return "survived" if proved else f"killed: {problem}"


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
