# SPDX-License-Identifier: Apache-2.0
"""One run of the driver, from the choice of units to the report."""

from __future__ import annotations

import contextlib
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from keel.audit import (
    assertions,
    clauses,
    completeness,
    determined,
    disguises,
    harness_rules,
    places,
    theorems,
    unused,
)
from keel.base.files import write_text
from keel.base.jobs import Runner
from keel.base.verdict_cache import Cache
from keel.c import source as csource
from keel.c.project import KEEL, RECORDED_TIMES, ProjectError, Unit, closure, find_units
from keel.engines import cbmc, gappa, wp
from keel.install import Toolchain, small_environment
from keel.judge import wp_frames
from keel.judge.goals import PRUNED, as_text, read_goals, short_name
from keel.judge.harness import read_harness, unchecked
from keel.judge.settings import Exceptions, read_exceptions
from keel.prove import driver, explain, exports, located, report, shards
from keel.prove import job_list as engines
from keel.prove.times import Times, read_times, recorded_anew
from keel.prove.times import as_text as times_text
from keel.prove.verdict_keys import headers_digest, prover_answers, tool_stamp, verdict_stamp


@dataclass(frozen=True)
class Choice:
    """What the command line asks for."""

    units: tuple[Unit, ...]
    partial: bool
    engines: tuple[str, ...]
    width: int
    # Where verdicts are kept, for all clones of the user.
    verdicts: Path
    fresh: bool = False
    quick: bool = False
    # How many times the usual limits of processor time provers have.
    patience: int = 1
    update_goals: bool = False
    # The sizes that a build chooses, as -DNAME=NUMBER; none: those that are shipped.
    defines: tuple[str, ...] = ()
    # A part of the jobs, or the reports of all parts.
    shard: shards.Shard | None = None
    join: tuple[Path, ...] = ()


class Session:
    """Runs a choice of proofs on a tree."""

    def __init__(self, root: Path, tools: Toolchain, choice: Choice) -> None:
        self._root = root
        self._tools = tools
        self._choice = choice
        self._build = root / "build" / "prove"
        self._exceptions = root / "proofs" / "units.toml"

    @contextlib.contextmanager
    def _programs(self) -> Iterator[tuple[Runner, Path]]:
        """What starts programs, and a folder for what they write; both end with the block."""
        # No verdict of such a run may be kept, so it must not begin.
        if strange := places.plug_ins(self._root):
            raise ProjectError("\n".join(strange))
        # Not below build/: why3 puts a socket there, whose path must be short.
        scratch = Path(tempfile.mkdtemp(prefix="keel-prove-"))
        tools = {**self._tools.environment(), "TMPDIR": str(scratch)}
        runner = Runner(small_environment(tools), self._root)
        try:
            yield runner, scratch
        finally:
            runner.stop()
            shutil.rmtree(scratch, ignore_errors=True)

    def explain(self, name: str) -> int:
        """Explain what bears a name; 0 if all is well with it, 1 if not, 2 if nothing does."""
        everything = list(find_units(self._root).values())
        every = explain.subjects(self._choice.units, self._build / "report.json")
        try:
            found = explain.named(every, name)
        except explain.UnknownName as error:
            print(f"prove: {error}", file=sys.stderr)
            return 2
        exceptions = read_exceptions(self._exceptions, [unit.name for unit in everything])
        sound = True
        with self._programs() as (runner, scratch):
            explainer = explain.Explainer(
                explain.Engines(
                    self._checker(runner, scratch),
                    self._prover(runner, scratch),
                    exceptions,
                    clauses.header_texts(self._root),
                ),
                self._root,
            )
            for subject in found:
                text, well = explainer.explain(subject)
                print("\n".join([*text, ""]), flush=True)
                sound = sound and well
        return 0 if sound else 1

    def run(self) -> int:
        """Prove, report; the exit status."""
        start = time.monotonic()
        shard = self._choice.shard
        target = self._build / (shard.file_name if shard else "report.json")
        target.unlink(missing_ok=True)
        exports.clear(self._build)
        with self._programs() as (runner, scratch):
            gathered = self._prove(runner, scratch)
        seconds = time.monotonic() - start
        versions = self._tools.versions("prove")
        content = report.content(gathered, versions, seconds, self._choice.partial)
        write_text(target, report.as_text(content))
        if not gathered.shard:
            write_text(self._build / "determined.md", determined.as_markdown(gathered.decided))
        exports.write(self._build, gathered)
        if gathered.success and not gathered.shard:
            told = theorems.told(self._root, gathered.requirements)
            for line in (*told, *self._what_is_left()):
                print(line, flush=True)
        print("\n".join(report.closing_lines(gathered)), flush=True)
        return 0 if gathered.success else 1

    def _what_is_left(self) -> list[str]:
        """How to go on after a run that was not of all units."""
        left = [
            name
            for name in find_units(self._root)
            if name not in [unit.name for unit in self._choice.units]
        ]
        if not left or self._root != KEEL:
            return []
        return [f"not looked at: {len(left)} units ({', '.join(left)}): make prove-all"]

    def _prove(self, runner: Runner, scratch: Path) -> report.Gathered:
        """Have the verdicts of the choice, and apply the rules."""
        choice = self._choice
        if "wp" in choice.engines:
            self._need_contracts()
        everything = find_units(self._root)
        exceptions = read_exceptions(self._exceptions, list(everything))
        gathered = report.Gathered(
            {unit.name: report.UnitResult(unit, exceptions[unit.name]) for unit in choice.units},
            choice.engines,
        )
        tools = tool_stamp(self._tools.versions("prove"))
        headers = headers_digest(self._tools.header_folders())
        stamps = {engine: verdict_stamp(engine, tools, headers) for engine in choice.engines}
        jobs = self._jobs(runner, scratch, stamps, everything, exceptions)
        times = Times(self._build / "times.json", self._root / RECORDED_TIMES)
        commit = gathered.stamp.get("commit", "")
        made_of = shards.origin(jobs, stamps, commit) if choice.shard or choice.join else {}
        if choice.shard:
            jobs = shards.part(jobs, choice.shard, times.recorded)
        console = report.Console(jobs, times, choice.width)
        if choice.join:
            outcomes = shards.joined(jobs, choice.join, made_of)
            for outcome in outcomes:
                console.done(outcome)
        else:
            cache = Cache(choice.verdicts, choice.fresh)
            pool = driver.Pool(choice.width, choice.patience, again=not choice.quick)
            outcomes = driver.run_jobs(jobs, cache, runner, pool, times, console.done, console.late)
            times.save()
            cache.prune()
        for outcome in outcomes:
            gathered.add(outcome)
        if choice.shard:
            # The rules look at all that there is: they wait for the reports to be joined.
            gathered.shard = shards.entries(choice.shard, made_of, outcomes)
            return gathered
        self._apply_rules(gathered)
        if choice.update_goals:
            self._record_times(outcomes)
        return gathered

    def _need_contracts(self) -> None:
        """Ask no prover for what no contract says."""
        lacking = [
            text
            for unit in self._choice.units
            for text in completeness.without_contract(unit, self._root)
        ]
        if lacking:
            raise ProjectError("\n".join(lacking))

    def _record_times(self, outcomes: Sequence[driver.Outcome]) -> None:
        """Record how long the jobs took, for everybody; what failed says nothing."""
        path = self._root / RECORDED_TIMES
        seen = {
            outcome.job.label: float(outcome.result["seconds"])
            for outcome in outcomes
            if not outcome.problems
        }
        whole = not self._choice.partial and len(seen) == len(outcomes)
        text = times_text(recorded_anew(read_times(path), seen, whole))
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            write_text(path, text)

    def _jobs(
        self,
        runner: Runner,
        scratch: Path,
        stamps: dict[str, dict[str, str]],
        everything: dict[str, Unit],
        exceptions: dict[str, Exceptions],
    ) -> list[driver.Job]:
        """All jobs of the choice."""
        choice = self._choice
        jobs: list[driver.Job] = []
        if "wp" in choice.engines:
            jobs += self._wp_jobs(runner, scratch, stamps["wp"], everything, exceptions)
        if "cbmc" in choice.engines:
            checker = self._checker(runner, scratch)
            jobs += engines.cbmc_jobs(choice.units, checker, self._root, stamps["cbmc"])
        if "gappa" in choice.engines:
            bounds = gappa.Gappa(self._tools.command("gappa"), runner, self._root, scratch)
            jobs += engines.gappa_jobs(choice.units, bounds, self._root, stamps["gappa"])
        return jobs

    def _checker(self, runner: Runner, scratch: Path) -> cbmc.Cbmc:
        return cbmc.Cbmc(
            self._tools.goto_cc(),
            self._tools.command("cbmc"),
            runner,
            self._root,
            scratch,
            self._choice.defines,
        )

    def _prover(self, runner: Runner, scratch: Path) -> wp.Wp:
        answers = prover_answers(self._root, tool_stamp(self._tools.versions("prove")))
        return wp.Wp(
            self._tools.frama_c(),
            runner,
            self._root,
            scratch,
            None if self._choice.fresh else answers,
            self._tools.command("ocamlfind"),
            self._choice.defines,
        )

    def _wp_jobs(
        self,
        runner: Runner,
        scratch: Path,
        stamp: dict[str, str],
        everything: dict[str, Unit],
        exceptions: dict[str, Exceptions],
    ) -> list[driver.Job]:
        choice = self._choice
        prover = self._prover(runner, scratch)
        known = frozenset(
            function.name
            for unit in (*everything.values(), *find_units().values())
            for path in (*unit.own_files, *unit.theorems)
            for function in csource.proved(csource.read(path))
        )
        stages = wp.QUICK if choice.quick else wp.THOROUGH
        place = (self._root, stamp)
        printer = located.Printer(prover, runner, scratch)
        return [
            *engines.survey_jobs(choice.units, prover, *place, known, exceptions),
            *engines.wp_jobs(choice.units, prover, *place, exceptions, stages, printer),
        ]

    def _apply_rules(self, gathered: report.Gathered) -> None:
        """What must hold besides that the proofs succeed."""
        root = self._root
        own = [path for unit in self._choice.units for path in (*unit.own_files, *unit.theorems)]
        shared = [*(root / "include").glob("keel/*.h"), *(root / "specs").glob("**/*.[ch]")]
        gathered.problems += completeness.assumptions_in([*own, *sorted(shared)], root)
        everything = find_units(root)
        gathered.problems += completeness.endless(
            path for unit in everything.values() for path in (*unit.own_files, *unit.theorems)
        )
        gathered.problems += completeness.strays(root, everything.values())
        gathered.problems += completeness.defined_twice(root)
        gathered.problems += completeness.undeclared(root)
        gathered.problems += completeness.contracts_elsewhere(root)
        gathered.problems += completeness.include_circles(root)
        allowed = read_exceptions(self._exceptions, list(everything))
        accepted = {text for one in allowed.values() for text in one.conditionals}
        gathered.problems += places.problems(root, everything.values())
        gathered.problems += disguises.problems(root, accepted)
        gathered.problems += harness_rules.problems(root, everything.values())
        gathered.problems += unused.problems(root)
        decider = determined.Decider(root)
        if self._choice.update_goals and determined.update_kept(root):
            print(f"{determined.KEPT} rewritten: review the difference")
        for result in gathered.units.values():
            unit, exceptions = result.unit, result.exceptions
            result.outcomes = decider.outcomes(unit)
            result.problems += [text for one in result.outcomes for text in one.problems]
            result.problems += completeness.unread_contracts(unit, root)
            result.problems += completeness.undefined_functions(unit, exceptions.no_body, root)
            result.problems += completeness.left_by_wp(unit, exceptions.not_by_wp, root)
            result.problems += completeness.left_twice(unit, exceptions.by_cbmc)
            result.problems += wp_frames.problems(unit, exceptions, find_units(root).values())
            if "cbmc" in self._choice.engines:
                files = [path for path in closure(root, unit.harnesses) if "proofs" in path.parts]
                result.problems += completeness.switched_off_checks(files, root)
                result.problems += unchecked(read_harness(unit, path) for path in unit.harnesses)
                result.problems += completeness.missing_harnesses(unit, exceptions.no_harness, root)
                self._check_assertions(result)
            if "wp" in self._choice.engines:
                self._check_warnings(result)
                self._check_goal_list(result)
        gathered.problems += determined.kept_problems(
            root, decider, gathered.decided, not self._choice.partial
        )

    @staticmethod
    def _check_warnings(result: report.UnitResult) -> None:
        """An accepted warning that does not occur any more must go."""
        result.problems += [
            f"units.toml: [{result.unit.name}] warnings: nothing says {text!r} any more, remove it"
            for text in result.exceptions.warnings
            if text not in result.accepted
        ]

    def _check_assertions(self, result: report.UnitResult) -> None:
        """Compare CBMC's assertions with the fixed list, or make the list anew."""
        unit, harnesses = result.unit, result.harnesses
        if self._choice.update_goals and assertions.update(unit, harnesses):
            shown = assertions.list_of(unit).relative_to(self._root)
            print(f"{unit.name:<10} {shown} rewritten: review the difference")
        result.problems += assertions.problems(unit, harnesses)
        result.problems += assertions.left_open(unit, result.exceptions.not_by_wp, harnesses)

    def _check_goal_list(self, result: report.UnitResult) -> None:
        """Compare the goals with the fixed list, or make the list anew."""
        seen = [goal["name"] for goal in result.goals]
        path = result.unit.goal_list
        shown = str(path.relative_to(self._root))
        if self._choice.update_goals:
            self._update_goal_list(result, seen, path)
        if path.is_file():
            result.listed = read_goals(path, shown).names
            result.problems += completeness.compare_goals(result.listed, seen, shown)
        else:
            result.problems.append(f"{shown} is missing: review the goals, run --update-goals")

    def _update_goal_list(self, result: report.UnitResult, seen: Sequence[str], path: Path) -> None:
        """Rewrite the list, unless the run itself is in doubt.

        A goal that is not proved, in this run, keeps the prover that it had.
        """
        shown = str(path.relative_to(self._root))
        if any("WP" in text for text in result.problems):
            print(f"{result.unit.name:<10} {shown} left alone: the run failed")
            return
        provers = read_goals(path, shown).provers | {
            goal["name"]: short_name(goal["prover"]) for goal in result.goals if goal["prover"]
        }
        provers |= dict.fromkeys(result.pruned, PRUNED)
        text = as_text(seen, provers)
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            write_text(path, text)
            print(f"{result.unit.name:<10} {shown} rewritten: review the difference")
