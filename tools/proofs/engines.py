"""Makes jobs out of units: what each engine has to do, and under which key the verdict is kept."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from . import cbmc, csource, wp
from .cache import digest
from .driver import Job
from .harness import Harness, WrongBody, read_harness, read_wrong_body
from .project import ProjectError, Unit, closure
from .settings import Exceptions


def wp_jobs(
    units: Iterable[Unit], prover: wp.Wp, root: Path, stamp: Mapping[str, str],
    exceptions: Mapping[str, Exceptions], stages: Sequence[wp.Stage] = wp.THOROUGH,
) -> list[Job]:  # fmt: skip
    """A job for each function, and for the lemmas, of the units."""
    jobs = []
    for unit in units:
        allowed = list(exceptions[unit.name].warnings)
        for target in wp.targets(unit):
            key = digest(
                {
                    "kind": "wp", "stamp": dict(stamp), "options": prover.options(),
                    "selection": target.selection, "smoke": wp.SMOKE.seconds, "allowed": allowed,
                    "text": wp.dependencies(target, root), "file": target.file.name,
                }
            )  # fmt: skip

            def execute(target: wp.Target = target, allowed: list[str] = allowed) -> dict[str, Any]:
                return prover.prove(target, stages, allowed=allowed).as_dict()

            theorem = f"{target.file.stem}:" if target.file in unit.theorems else ""
            jobs.append(Job(unit.name, "wp", theorem + target.name, key, execute))
    return jobs


def survey_jobs(
    units: Iterable[Unit], prover: wp.Wp, root: Path, stamp: Mapping[str, str],
    known: frozenset[str],
) -> list[Job]:  # fmt: skip
    """A job for each unit: does Frama-C see functions that this driver would prove nowhere?"""
    jobs = []
    for unit in units:
        file = wp.translation_unit(unit)
        text = {str(path): path.read_text(encoding="utf-8") for path in closure(root, [file])}

        def execute(unit: Unit = unit, file: Path = file) -> dict[str, Any]:
            log = prover.survey(unit.name, file)
            problems = [
                f"{unit.name}: Frama-C sees the function {name}, which the driver does not"
                for name in log.functions
                if name not in known
            ]
            if not log.functions:
                problems.append(f"{unit.name}: Frama-C sees no function: {log.messages}")
            return wp.Result(problems=problems).as_dict()

        key = digest({"survey": text, "stamp": dict(stamp), "known": sorted(known)})
        jobs.append(Job(unit.name, "wp", "survey", key, execute))
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
        for path in unit.wrong_bodies:
            wrong = read_wrong_body(unit, path)
            if wrong.harness not in harnesses:
                raise ProjectError(f"{path.relative_to(root)}: there is no harness {wrong.harness}")
            jobs.append(_wrong_job(wrong, harnesses[wrong.harness], checker, root, stamp))
    return jobs


def cbmc_key(
    harness: Harness, checker: cbmc.Cbmc, root: Path, stamp: Mapping[str, str],
    replacement: Path | None = None,
) -> str:  # fmt: skip
    """What a harness's verdict depends on. Contracts are comments to CBMC."""
    texts = {
        str(path.relative_to(root)): csource.essence(path.read_text(encoding="utf-8"))
        for path in cbmc.dependencies(harness, root, replacement)
    }
    told = [harness.path, *([replacement] if replacement else [])]
    directives = [path.read_text(encoding="utf-8") for path in told]
    return digest(
        {"kind": "cbmc", "stamp": dict(stamp), "options": checker.options(), "texts": texts,
         "directives": directives, "name": harness.name}
    )  # fmt: skip


def _harness_job(harness: Harness, checker: cbmc.Cbmc, root: Path, stamp: Mapping[str, str]) -> Job:
    def execute() -> dict[str, Any]:
        return checker.prove(harness).as_dict()

    key = cbmc_key(harness, checker, root, stamp)
    return Job(harness.unit.name, "cbmc", harness.name, key, execute)


def _wrong_job(
    wrong: WrongBody, harness: Harness, checker: cbmc.Cbmc, root: Path, stamp: Mapping[str, str]
) -> Job:
    def execute() -> dict[str, Any]:
        return checker.refute(wrong, harness).as_dict()

    key = cbmc_key(harness, checker, root, stamp, wrong.path)
    return Job(wrong.unit.name, "negative", wrong.path.name, key, execute)
