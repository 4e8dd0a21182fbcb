# SPDX-License-Identifier: Apache-2.0
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
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from keel.base.jobs import Runner
from keel.c import source as csource
from keel.c.project import include_options
from keel.engines.frama_modules import Modules
from keel.install.provers import CLOCK_PER_PROCESSOR, SMOKE_SECONDS
from keel.judge import wp_frames, wp_log
from keel.judge.goals import PRUNED, QED
from keel.judge.wp_targets import Result, Target, dependencies
from keel.judge.wp_verdict import judge, loop_problems, message_problems

OWN = Path(__file__).resolve().parent
# What Frama-C loads: with all of its plugins each of hundreds of processes took 0.2 s more.
PLUGINS = ("rtegen", "wp")
CHECKS = (
    "-warn-unsigned-overflow",
    "-warn-unsigned-downcast",
    "-warn-signed-downcast",
    # Each call through a pointer has a `calls` annotation, whose goal says more than that the
    # pointer is some function: WP has no meaning for \valid_function.
    "-rte-no-pointer-call",
)


@dataclass(frozen=True)
class Stage:
    """One pass over the goals that are still open. Several provers race for each goal."""

    provers: tuple[str, ...]
    # Of the processor.
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
        options += ["-wp-timeout", str(self.seconds * CLOCK_PER_PROCESSOR)]
        options += ["-wp-pruning" if self.pruning else "-wp-no-pruning"]
        return [*options, "-wp-steps", str(self.steps)] if self.steps else options

    def of(self, *provers: str) -> Stage:
        """The same for these provers."""
        return replace(self, provers=provers)

    def of_all(self) -> Stage:
        """The same for all provers.

        Where some goals are left to CBMC, Z3 is asked at once for what no recorded prover has
        proved: it needs a moment for some products, on which the others would spend all their time.
        """
        return self.of("alt-ergo", "cvc4", "z3")

    def with_room(self, room: int) -> Stage:
        """The same with so many times the processor time."""
        return replace(self, seconds=self.seconds * room)


# Alt-Ergo proves nearly everything in milliseconds, CVC4 what is left in little more; z3 hardly
# ever helps. To prepare the goals costs WP more than to prove them, and two thirds of that is its
# search for branches that cannot be taken; the few goals that need it get it in a pass of their
# own. Long limits come last, and cost time only when something is wrong.
QUICK = (Stage(("alt-ergo", "cvc4"), 10),)
THOROUGH = (
    *QUICK,
    Stage(("alt-ergo", "cvc4"), 60, pruning=True),
    Stage(("alt-ergo", "cvc4", "z3"), 100),
)
# A prover that is recorded for a goal proved it, if on a faster machine: to wait for it costs less
# than to ask all the others. Of the processor, as all limits here; the longest take 22 s.
RECORDED = Stage((), 100)
# A contradiction shows early: seeded ones were found within a second by either prover, among
# integers by CVC4 with 50 000 steps wherever with 75 000, among floats by Alt-Ergo with 300
# wherever with 3000. Debian's CVC4 is built without floats: it gives up on the first literal of
# one, and WP takes that for a test that was passed. WP proves calls through pointers once more in
# this pass, which takes 56 000 steps. Steps count alike on every machine; what has steps left ends
# by the processor's time (install/provers.py).
SMOKE = Stage(("cvc4",), SMOKE_SECONDS, steps=60_000)
SMOKE_OF_FLOATS = Stage(("alt-ergo",), SMOKE_SECONDS, steps=300)
FLOATS = re.compile(r"\b(?:float|double)\b")


def smoke_stage(target: Target, root: Path) -> Stage:
    """The pass that looks for contradictions, by a prover that knows what the goals may have."""
    texts = map(csource.without_prose, dependencies(target, root).values())
    return SMOKE_OF_FLOATS if any(map(FLOATS.search, texts)) else SMOKE


class Wp:
    """Frama-C/WP for the target."""

    def __init__(
        self,
        frama_c: Sequence[str],
        runner: Runner,
        root: Path,
        scratch: Path,
        prover_cache: Path | None = None,
        ocamlfind: Sequence[str] = ("ocamlfind",),
        defines: Sequence[str] = (),
    ) -> None:
        """Take what is to be started, and the sizes that the build chooses, as -DNAME=NUMBER."""
        self._defines = list(defines)
        self._frama_c = list(frama_c)
        self._runner = runner
        self._root = root
        self._scratch = scratch
        self._prover_cache = prover_cache
        self._modules = Modules(frama_c, ocamlfind, runner, scratch / "modules")

    def options(self) -> list[str]:
        """Everything on the command line that is the same for all targets."""
        words = " ".join([*include_options(self._root), *self._defines])
        return [*self._frama_c, *CHECKS, f"-cpp-extra-args={words}"]

    def _loaded(self, *scripts: str) -> list[str]:
        """The options with nothing loaded but what WP needs, and these scripts, in their order."""
        options = self.options()
        place = options.index("-load-script")
        paths = [Path(options[place + 1]), *(OWN / name for name in scripts)]
        modules = ",".join([*PLUGINS, *map(self._modules.compiled, paths)])
        loading = ["-no-autoload-plugins", "-load-module", modules]
        return [*options[:place], *loading, *options[place + 2 :]]

    def survey(self, file: Path) -> wp_log.Log:
        """Parse a file and learn what it defines, includes and all, and what it assumes."""
        command = [*self._loaded("find_assumptions.ml"), self._shown(file), "-rte"]
        return wp_log.read_log(self._runner.run(command).output)

    def prove(
        self,
        target: Target,
        stages: Sequence[Stage] = THOROUGH,
        smoke: bool = True,
        allowed: Sequence[str] = (),
        recorded: Mapping[str, str] | None = None,
        room: int = 1,
    ) -> Result:
        """Prove a target; `recorded` are the provers to ask first, by goal.

        All provers have `room` times their processor time.
        """
        start = time.monotonic()
        known = recorded or {}
        stages = [stage.with_room(room) for stage in stages]
        with self._answers_alone(target):
            result = self._prove_lemmas(target, allowed, known, room)
            if result is None or result.problems:
                result = self._run(target, stages, smoke, allowed, known, room)
        result.seconds = round(time.monotonic() - start, 1)
        return result

    def _prove_lemmas(
        self, target: Target, allowed: Sequence[str], recorded: Mapping[str, str], room: int = 1
    ) -> Result | None:
        """Lemmas, each by the prover that is recorded for it; None if it is not for all of them."""
        groups: dict[str, list[str]] = {}
        for name in target.lemmas:
            groups.setdefault(recorded.get(f"lemma_{name}", QED), []).append(name)
        if target.function or not groups.keys().isdisjoint((PRUNED, QED)):
            return None
        passes = [
            (RECORDED.of(prover).with_room(room), ["-wp-prop", ",".join(names)])
            for prover, names in sorted(groups.items())
        ]
        report = self._report_of(target)
        return self._judged(target, self._words(target, passes, report), report, allowed, recorded)

    def _run(
        self,
        target: Target,
        stages: Sequence[Stage],
        smoke: bool,
        allowed: Sequence[str],
        recorded: Mapping[str, str],
        room: int = 1,
    ) -> Result:
        report = self._report_of(target)
        if target.left is not None:
            stages = [
                stage.of_all() if number == 0 else stage for number, stage in enumerate(stages)
            ]
        if PRUNED in _own_provers(target, recorded).values():
            stages = sorted(stages, key=lambda stage: not stage.pruning)
        file = self._recorded_file(target, recorded)
        extra = {"KEEL_RECORDED": str(file)} if file else {}
        if smoke:
            extra["KEEL_SMOKE"] = self._smoke_words(target)
        command = self.command(target, stages, smoke, report, file is not None, room)
        pruned = frozenset(number for number, stage in enumerate(stages, 1) if stage.pruning)
        return self._judged(target, command, report, allowed, recorded, pruned, extra)

    def _smoke_words(self, target: Target) -> str:
        """What find_contradictions.ml is told."""
        stage = smoke_stage(target, self._root)
        words = [*stage.provers, str(stage.steps), str(target.function)]
        return " ".join([*words, *wp_frames.not_left(target.left)])

    def _report_of(self, target: Target) -> Path:
        """Where WP is to write its report; none is there yet."""
        report = self._scratch / f"{target.identity}.json"
        report.unlink(missing_ok=True)
        return report

    def _judged(
        self,
        target: Target,
        command: Sequence[str],
        report: Path,
        allowed: Sequence[str],
        recorded: Mapping[str, str],
        pruned: frozenset[int] = frozenset(),
        extra: dict[str, str] | None = None,
    ) -> Result:
        done = self._runner.run(command, extra=extra)
        self._drop_failures(target)
        written = report.read_text(encoding="utf-8") if report.is_file() else ""
        return judge(target, done.output, written, self._root, allowed, recorded, pruned)

    def _recorded_file(self, target: Target, recorded: Mapping[str, str]) -> Path | None:
        """The function and its goals with their provers, for ask_recorded.ml; None without any.

        Qed is asked before any prover, so its goals go with the first one's: parts of a clause that
        are left out would have all of its parts proved again.
        """
        if target.function is None:
            return None
        provers = _own_provers(target, recorded)
        own = {goal: name for goal, name in provers.items() if name != PRUNED}
        asked = sorted({name for name in own.values() if name != QED})
        if not asked:
            return None
        lines = [f"{goal} {asked[0] if name == QED else name}" for goal, name in own.items()]
        file = self._scratch / f"{target.identity}.recorded"
        selected = " ".join([target.function, *wp_frames.not_left(target.left)])
        file.write_text("\n".join([selected, *lines]) + "\n", encoding="utf-8")
        return file

    def first_problem(self, target: Target, stages: Sequence[Stage], allowed: Sequence[str]) -> str:
        """Why a target is not proved, without waiting for more than one reason; "" if it is."""
        report = self._scratch / f"{target.identity}.json"
        passes = 0

        def enough(line: str) -> bool:
            nonlocal passes
            passes += line.startswith(wp_log.PASS)
            goal = wp_log.GOAL.match(line)
            return passes == len(stages) and goal is not None and goal["status"] != "Valid"

        output = self._runner.run_until(self.command(target, stages, False, report), enough)
        self._drop_failures(target)
        log = wp_log.read_log(output)
        if not log.goals:
            return "WP has no goal"
        problems = [goal.name for goal in log.goals.values() if not goal.proved]
        problems += message_problems(log, allowed, []) + loop_problems(target, log)
        return problems[0] if problems else ""

    def printed(self, target: Target) -> str:
        """What WP prints of a target's goals, each tried for a short time."""
        selected = [(stage, [*target.selection, "-wp-print"]) for stage in QUICK]
        report = self._report_of(target)
        with self._answers_alone(target):
            output = self._runner.run(self._words(target, selected, report)).output
            self._drop_failures(target)
        return output

    def command(
        self,
        target: Target,
        stages: Sequence[Stage],
        smoke: bool,
        report: Path,
        recorded: bool = False,
        room: int = 1,
    ) -> list[str]:
        """One process; each stage takes up what the stages before it left open.

        Lemmas are not filtered by WP in that way; they get all provers in one stage, and have no
        code that a smoke test could look at.
        """
        if target.function is None:
            names = dict.fromkeys(name for stage in stages for name in stage.provers)
            stages = [Stage(tuple(names), max(stage.seconds for stage in stages))]
        scripts = ["ask_recorded.ml"] * (recorded and target.function is not None)
        scripts += ["find_contradictions.ml"] * (smoke and target.function is not None)
        selected = [(stage, target.selection) for stage in stages]
        return self._words(target, selected, report, scripts, room)

    def _words(
        self,
        target: Target,
        passes: Sequence[tuple[Stage, list[str]]],
        report: Path,
        scripts: Sequence[str] = (),
        room: int = 1,
    ) -> list[str]:
        """The command line of these passes, each over its selection of goals, after our scripts."""
        command = [*self._loaded(*scripts), self._shown(target.file)]
        command += self._cache_options(target)
        command += _scripts_pass(target, room) if scripts else ()
        before: tuple[str, ...] = ()
        for number, (stage, selection) in enumerate(passes):
            command += ["-then"] if number else []
            command += ["-wp", "-wp-rte", "-wp-status-invalid", *selection, "-wp-par", "2"]
            command += stage.options(before)
            before = stage.provers
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


def _scripts_pass(target: Target, room: int) -> list[str]:
    """The options of the pass in which our scripts have goals tried that they choose."""
    options = ["-rte", "-rte-select", str(target.function), "-wp-rte"]
    options += wp_frames.NO_FLOATS if target.left is not None else ()
    options += ["-wp-par", "2", *RECORDED.with_room(room).options(())]
    options += ["-wp-smoke-timeout", str(SMOKE_SECONDS * CLOCK_PER_PROCESSOR)]
    return [*options, "-then", "-no-rte"]


def _own_provers(target: Target, recorded: Mapping[str, str]) -> dict[str, str]:
    """The recorded provers of a function's goals; none for lemmas."""
    if target.function is None:
        return {}
    return {goal: name for goal, name in recorded.items() if goal.startswith(target.function)}
