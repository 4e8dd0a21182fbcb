# SPDX-License-Identifier: Apache-2.0
"""Makes jobs out of units: what each engine has to do, and under which key the verdict is kept."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from keel.base.verdict_cache import digest
from keel.c import source as csource
from keel.c.places import read_by_provers
from keel.c.project import KEEL, ProjectError, Unit, closure, shown
from keel.engines import cbmc, gappa, wp
from keel.judge import wp_frames, wp_targets, wp_verdict
from keel.judge.goals import read_goals
from keel.judge.harness import Harness, harnesses_of, read_harness
from keel.judge.settings import Exceptions
from keel.judge.wrong_bodies import WrongBody, read_wrong_bodies
from keel.prove import located
from keel.prove.driver import Job


def wp_jobs(
    units: Iterable[Unit],
    prover: wp.Wp,
    root: Path,
    stamp: Mapping[str, str],
    exceptions: Mapping[str, Exceptions],
    stages: Sequence[wp.Stage] = wp.THOROUGH,
    printed: Callable[[wp_targets.Target], str] = lambda _: "",
) -> list[Job]:
    """A job for each function, and for the lemmas, of the units; `printed` is what WP prints."""
    jobs = []
    for unit in units:
        allowed = list(exceptions[unit.name].warnings)
        recorded = read_goals(unit.goal_list, shown(unit.goal_list, root)).provers
        for whole in wp_targets.targets(unit):
            target = wp_frames.restricted(whole, exceptions[unit.name])

            execute = functools.partial(_prove, prover, printed, target, stages, allowed, recorded)
            key = functools.partial(wp_key, target, prover, root, stamp, allowed)
            theorem = f"{target.file.stem}:" if target.file in unit.theorems else ""
            jobs.append(Job(unit.name, "wp", theorem + target.name, key, execute))
    return jobs


def placeless(options: Iterable[str], root: Path) -> list[str]:
    """Options without the place of the clone: the text of its files is in the key elsewhere."""
    return [text.replace(f"{root}/", "").replace(f"{KEEL}/", "keel:") for text in options]


def _prove(
    prover: wp.Wp,
    printed: Callable[[wp_targets.Target], str],
    target: wp_targets.Target,
    stages: Sequence[wp.Stage],
    allowed: Sequence[str],
    recorded: Mapping[str, str],
    room: int,
) -> dict[str, Any]:
    result = prover.prove(target, stages, True, allowed, recorded, room)
    located.locate(result, functools.partial(printed, target))
    return result.as_dict()


def wp_key(
    target: wp_targets.Target,
    prover: wp.Wp,
    root: Path,
    stamp: Mapping[str, str],
    allowed: Sequence[str],
) -> str:
    """What the verdict on a function, or on lemmas, depends on: no comment that is prose."""
    return digest(
        {
            "kind": "wp",
            "stamp": dict(stamp),
            "options": placeless(prover.options(), root),
            "selection": target.selection,
            "allowed": list(allowed),
            "text": {
                place: read_by_provers(text)
                for place, text in wp_targets.dependencies(target, root).items()
            },
            "file": target.file.name,
        }
    )


def survey_jobs(
    units: Iterable[Unit],
    prover: wp.Wp,
    root: Path,
    stamp: Mapping[str, str],
    known: frozenset[str],
    exceptions: Mapping[str, Exceptions],
) -> list[Job]:
    """A job for each file that WP proves: is there a function in it that this driver would prove
    nowhere, or anything that its annotations take for granted?"""
    jobs = []
    elsewhere = known.union(*(one.no_body for one in exceptions.values()))
    for unit in units:
        for file in (wp_targets.translation_unit(unit), *unit.theorems):

            def execute(_room: int, file: Path = file) -> dict[str, Any]:
                log = prover.survey(file)
                problems = wp_verdict.survey_problems(log, shown(file, root), elsewhere)
                return wp_targets.Result(problems=problems).as_dict()

            def key(file: Path = file) -> str:
                files = closure(root, [file])
                text = {shown(path, root): read_by_provers(csource.read(path)) for path in files}
                return digest({"survey": text, "stamp": dict(stamp), "known": sorted(elsewhere)})

            theorem = f"{file.stem}:" if file in unit.theorems else ""
            jobs.append(Job(unit.name, "wp", f"{theorem}survey", key, execute))
    return jobs


def cbmc_jobs(
    units: Iterable[Unit], checker: cbmc.Cbmc, root: Path, stamp: Mapping[str, str]
) -> list[Job]:
    """A job for each harness, and for each wrong body, of the units."""
    jobs = []
    for unit in units:
        harnesses = {path.stem: read_harness(unit, path) for path in unit.harnesses}
        for harness in harnesses.values():
            jobs.append(_harness_job(harness, checker, root, stamp))
        for wrong in read_wrong_bodies(unit):
            jobs.append(_wrong_job(wrong, harnesses[wrong.harness], checker, root, stamp))
    return jobs


def cbmc_key(
    harness: Harness,
    checker: cbmc.Cbmc,
    root: Path,
    stamp: Mapping[str, str],
    wrong: WrongBody | None = None,
) -> str:
    """What the verdict of a harness depends on, on the unit or on a wrong body.

    Contracts are comments to CBMC. Directives count as they were read, not as they stand there now.
    So do a wrong body's replacements, by what they make of the file as it is now. The other wrong
    bodies of the unit do not matter, nor where in the file it stands.
    """
    texts = {
        shown(path, root): csource.essence(csource.read(path))
        for path in cbmc.dependencies(harness, root)
    }
    expected: tuple[object, ...] = ()
    if wrong:
        place = shown(wrong.file, root)
        if place not in texts:
            raise ProjectError(f"{wrong.shown}: {wrong.harness} does not depend on {place}")
        texts[place] = csource.essence(wrong.text())
        expected = (wrong.name, wrong.expect, place, wrong.defines)
    sources = [shown(path, root) for path in harness.sources]
    directives = [
        harness.name,
        harness.options,
        sources,
        harness.covers,
        harness.defines,
        harness.replaces,
        harness.assertions_only,
        harness.reach,
    ]
    # What is replaced is proved by other harnesses, at whose text this one's verdict looks.
    others = {
        shown(path, root): csource.essence(csource.read(path))
        for name in harness.replaces
        for path in harnesses_of(root, name)
    }
    return digest(
        {
            "kind": "cbmc",
            "stamp": dict(stamp),
            "options": placeless(checker.options(), root),
            "texts": texts,
            "directives": directives,
            "expected": expected,
            "others": others,
        }
    )


def gappa_jobs(
    units: Iterable[Unit], prover: gappa.Gappa, root: Path, stamp: Mapping[str, str]
) -> list[Job]:
    """A job for each file of bounds, and for each wrong one, of the units."""

    def key(path: Path) -> str:
        texts = {
            shown(file, root): file.read_text(encoding="utf-8")
            for file in prover.dependencies(path)
        }
        return digest({"kind": "gappa", "stamp": dict(stamp), "texts": texts})

    jobs = []
    for unit in units:
        for kind, paths, judge in (
            ("gappa", unit.statements, prover.prove),
            ("gappa-negative", unit.wrong_statements, prover.refute),
        ):
            for path in paths:

                def execute(
                    _room: int, path: Path = path, judge: Callable[[Path], gappa.Result] = judge
                ) -> dict[str, Any]:
                    return judge(path).as_dict()

                jobs.append(Job(unit.name, kind, path.name, functools.partial(key, path), execute))
    return jobs


def _harness_job(harness: Harness, checker: cbmc.Cbmc, root: Path, stamp: Mapping[str, str]) -> Job:
    def execute(room: int) -> dict[str, Any]:
        return checker.prove(harness, room).as_dict()

    key = functools.partial(cbmc_key, harness, checker, root, stamp)
    return Job(harness.unit.name, "cbmc", harness.name, key, execute)


def _wrong_job(
    wrong: WrongBody, harness: Harness, checker: cbmc.Cbmc, root: Path, stamp: Mapping[str, str]
) -> Job:
    def execute(room: int) -> dict[str, Any]:
        return checker.refute(wrong, harness, room).as_dict()

    key = functools.partial(cbmc_key, harness, checker, root, stamp, wrong)
    return Job(wrong.unit.name, "negative", wrong.name, key, execute)
