# SPDX-License-Identifier: Apache-2.0
"""Measure how strong the proofs of a unit are: break its code in small ways, see who notices.

    python3 tools/keel mutate                              # all units, on all cores
    python3 tools/keel mutate --unit queue                 # until CBMC or WP notices
    python3 tools/keel mutate --unit queue --engine both   # each engine by itself
    python3 tools/keel mutate --unit queue --list          # the mutants, without trying them
    python3 tools/keel mutate --status                     # results kept and had, which are stale
    python3 tools/keel mutate --record                     # keep the results in specs/mutation.toml
    python3 tools/keel mutate --unit sbus --confirm 1      # CBMC confirms all executions that kill
    DASK=tcp://host:8786 python3 tools/keel mutate         # on a Dask cluster (make mutate)

Mutants are slips of the pen (another operator, a number beside the right one, a statement left out)
and of thought (order, a stale value, the neighbour's field or index, a check that comes too late, a
clause forgotten; tools/keel/mutate/slips.py). One is killed by a counterexample to a harness of
CBMC, or by a goal that WP leaves open within three times the processor time that the unchanged
function needs; one of 50 such goals is asked about with WP's full limits, and the run fails where
these prove it. A counterexample is an execution:
first the harnesses are executed on this machine, on inputs that were found on the unchanged code
(tools/keel/mutate/execution.py; CBMC is asked to confirm one of 50, see --confirm, and the run
fails where it does not), then CBMC looks for one, at small capacities first
(tools/keel/mutate/small_harnesses.py). A mutant that nobody notices shows a contract that
is too weak, or a change that makes no difference; the latter is accepted with its reason in
proofs/UNIT/equivalent.toml. What does not compile, or compiles to the same code, does not count.

The tree is never touched. build/mutate/UNIT.json has the details, and a digest of what they were
found with: sources, contracts, harnesses, tools. Each verdict is kept with those of the proofs as
it comes (KEEL_CACHE): who was interrupted calls the program again, from any clone, and it goes on.

Exit status: 0 when every mutant is killed or explained, 1 when not, 2 for a wrong input.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.audit import clauses, determined
from keel.base.errors import ToolError
from keel.base.files import write_text
from keel.base.jobs import end_as_by_ctrl_c
from keel.base.verdict_cache import Cache, digest
from keel.c.project import RECORDED_TIMES, Unit, find_units
from keel.install import TARGET_FLAGS, Toolchain, ToolchainError, small_environment
from keel.judge.settings import read_exceptions
from keel.mutate import execution as mutant_execution
from keel.mutate import records as mutant_records
from keel.mutate import slips as mutant_slips
from keel.mutate import standing as mutant_standing
from keel.mutate import table as mutant_table
from keel.mutate import verdicts as mutant_verdicts
from keel.mutate.crew import Dask, Job, Threads, answer_order
from keel.mutate.harnesses import survey
from keel.mutate.mutation import BY_CBMC, BY_WP, CONFIRM, DRIVER, Tools, Trial
from keel.mutate.operators import Generated, Mutant, generate
from keel.mutate.trees import Trees
from keel.mutate.verdicts import Verdict
from keel.prove.times import Times
from keel.prove.verdict_keys import mutants_digest, own_digest, prover_answers, tool_stamp

CLANG = "clang-19"
ENGINES = {"wp": ("wp",), "cbmc": ("cbmc",), "both": ("cbmc", "wp"), None: ("cbmc", "wp")}


def parse(arguments: Sequence[str] | None, names: Sequence[str]) -> argparse.Namespace:
    """The command line; a unit that does not exist is named, with those that do."""
    parser = argparse.ArgumentParser(description="Measure the proofs of units by mutants.")
    parser.add_argument(
        "--unit",
        nargs="+",
        metavar="U",
        default=list(names),
        help="the units whose code is broken; default: all",
    )
    parser.add_argument(
        "--engine",
        choices=("wp", "cbmc", "both"),
        help="only this, or each apart; default: WP for what CBMC leaves",
    )
    parser.add_argument(
        "--function", metavar="F", help="only mutants of this function, and no report"
    )
    parser.add_argument(
        "--jobs",
        type=int,
        default=os.cpu_count() or 1,
        metavar="N",
        help="mutants side by side; default: one a core",
    )
    parser.add_argument(
        "--max-seconds",
        type=float,
        default=float("inf"),
        metavar="S",
        help="start no mutant after this time",
    )
    parser.add_argument("--list", action="store_true", help="print the mutants, try none")
    parser.add_argument(
        "--status", action="store_true", help="print the results that there are, try none"
    )
    parser.add_argument(
        "--quick",
        action="store_true",
        help="short limits for WP; what they leave open is not killed",
    )
    parser.add_argument(
        "--small", action="store_true", help="no more than executions and small harnesses"
    )
    parser.add_argument(
        "--confirm",
        type=int,
        default=CONFIRM,
        metavar="N",
        help="CBMC confirms one of N executions; default: 50",
    )
    parser.add_argument("--fresh", action="store_true", help="try every mutant afresh")
    parser.add_argument(
        "--record", action="store_true", help="keep the results in specs/mutation.toml"
    )
    parser.add_argument("--order", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    for name in options.unit:
        if name not in names:
            parser.error(f"no such unit: {name} (there are: {', '.join(names)})")
    if options.record and (options.function or options.quick or options.engine):
        parser.error("--record keeps whole results: without --function, --quick and --engine")
    for name in ("jobs", "confirm"):
        if getattr(options, name) < 1:
            parser.error(f"--{name} needs at least 1")
    return options


def tries(options: argparse.Namespace) -> bool:
    """Whether mutants are tried, not only told."""
    return not (options.list or options.status)


def tools_for(toolchain: Toolchain, root: Path, scratch: Path, trying: bool) -> Tools:
    """The programs of the trials; who only tells needs no compiler to execute harnesses."""
    compiler = [
        *toolchain.command("arm-none-eabi-gcc"),
        *TARGET_FLAGS,
        "-std=c99",
        "-ffreestanding",
    ]
    stamp = tool_stamp(toolchain.versions("prove"))
    return Tools(
        frama_c=toolchain.frama_c(),
        goto_cc=toolchain.goto_cc(),
        cbmc=toolchain.command("cbmc"),
        compiler=compiler,
        scratch=scratch,
        answers=prover_answers(root, stamp),
        verdicts=toolchain.cache.folder / "verdicts",
        environment=small_environment({**toolchain.environment(), "TMPDIR": str(scratch)}),
        clang=toolchain.command(CLANG) if trying else (),
        clang_version=toolchain.versions("fuzz")[CLANG].version if trying else "",
        inputs=toolchain.cache.folder / "inputs",
    )


def stamp_of(toolchain: Toolchain) -> dict[str, str]:
    """What identifies the tools of a verdict."""
    tools = tool_stamp(toolchain.versions("prove"))
    by_cbmc = digest([mutants_digest("cbmc"), mutant_execution.judge()])
    judges = {BY_CBMC: by_cbmc, BY_WP: mutants_digest("wp")}
    return {**tools, **judges, DRIVER: own_digest("cbmc")}


@dataclass
class Measured:
    """A unit, its mutants, and what became of them."""

    unit: Unit
    trial: Trial
    found: list[Mutant]
    dropped: int
    verdicts: dict[int, Verdict]

    @property
    def reasons(self) -> Path:
        """Why survivors make no difference."""
        return self.unit.folder / "equivalent.toml"

    @property
    def digest(self) -> str:
        """Of all that the report depends on."""
        text = self.reasons.read_text(encoding="utf-8") if self.reasons.is_file() else ""
        return self.trial.digest_of(self.found, text)


def surroundings(root: Path) -> mutant_slips.Surroundings:
    """What the mutants of a tree are made of besides the function's own text."""
    beyond = {
        name: mutant_slips.numbers_beyond(bounds)
        for name, bounds in determined.bounds_of(root).items()
    }
    return mutant_slips.surroundings(clauses.header_texts(root), beyond)


def generated(unit: Unit, around: mutant_slips.Surroundings) -> list[Generated]:
    """The mutants of a unit, file by file."""
    return [generate(path, around) for path in unit.own_files]


def report_of(unit: Unit) -> Path:
    """Where the report of the last trials of a unit is."""
    return unit.root / "build" / "mutate" / f"{unit.name}.json"


class Measurement:
    """The trials of some units, with what they need."""

    def __init__(
        self, units: Sequence[Unit], options: argparse.Namespace, tools: Toolchain
    ) -> None:
        self._options = options
        self.engines = ENGINES[options.engine]
        self.stamp = stamp_of(tools)
        self._tools = tools
        root = units[0].root
        self._scratch = Path(tempfile.mkdtemp(prefix="keel-mutate-"))
        trees = Trees(root, self._scratch, options.jobs)
        programs = tools_for(tools, root, self._scratch, tries(options))
        exceptions = read_exceptions(root / "proofs" / "units.toml", list(find_units(root)))
        times = Times(root / "build/prove/times.json", root / RECORDED_TIMES)
        cache = Cache(tools.cache.folder / "mutants", options.fresh)
        cache.prune()
        around = surroundings(root)
        self.units: list[Measured] = []
        seen = survey(root)
        for unit in units:
            accepted = mutant_verdicts.read_equivalent(unit.folder / "equivalent.toml")
            trial = Trial(
                unit,
                programs,
                trees,
                self.engines,
                options.engine == "both",
                cache,
                self.stamp,
                exceptions[unit.name],
                times,
                not options.quick,
                seen,
                options.small,
                accepted,
                options.confirm,
            )
            made = generated(unit, around)
            found = [
                mutant
                for one in made
                for mutant in one.mutants
                if options.function in (None, mutant.function)
            ]
            dropped = sum(one.dropped for one in made)
            self.units.append(Measured(unit, trial, found, dropped, {}))

    def stop(self) -> None:
        """End all programs."""
        for one in self.units:
            one.trial.stop()

    def close(self) -> None:
        """End all programs and leave nothing behind."""
        self.stop()
        shutil.rmtree(self._scratch, ignore_errors=True)

    def run(self, crew: Threads | Dask) -> None:
        """Have a verdict on every mutant, those that are known without asking again."""
        for one in self.units:
            if not self._options.function:
                report_of(one.unit).unlink(missing_ok=True)
            for place, mutant in enumerate(one.found):
                known = one.trial.known(mutant)
                if known and known.is_lasting:
                    one.verdicts[place] = known
        waiting = [
            (one, place)
            for one in self.units
            for place in range(len(one.found))
            if place not in one.verdicts
        ]
        total = sum(len(one.found) for one in self.units)
        print(f"{total} mutants, {total - len(waiting)} known before", flush=True)
        jobs: list[Job] = [(one.unit.name, one.trial, one.found[place]) for one, place in waiting]
        start = time.monotonic()
        for number, (job, verdict) in enumerate(crew.run(jobs), 1):
            one, place = waiting[job]
            one.verdicts[place] = verdict
            if verdict.is_lasting:
                one.trial.keep(verdict)
            how = verdict.reason or "; ".join(f"{k} {v}" for k, v in verdict.engines.items())
            left = (time.monotonic() - start) / number * (len(jobs) - number) / 60
            print(
                f"{number:>4}/{len(jobs)} {left:>4.0f} min left {verdict.status:<10}"
                f" {verdict.mutant}  [{how}]",
                flush=True,
            )

    def conclude(self) -> int:
        """Report on each unit; the exit status."""
        status = 0
        for one in self.units:
            accepted = mutant_verdicts.read_equivalent(one.reasons)
            verdicts = [one.verdicts[place] for place in sorted(one.verdicts)]
            problems = [f"{name} is not proved even unchanged" for name in one.trial.unusable]
            problems += [
                f"executed, and CBMC sees no failure: {text}"
                for text in one.trial.sample.contradictions
            ]
            problems += [
                f"not proved in short limits, and proved in the full ones: {text}"
                for text in one.trial.late.contradictions
            ]
            problems += mutant_verdicts.settle(verdicts, accepted, not self._options.function)
            text = mutant_verdicts.report(
                one.unit.name, verdicts, problems, one.dropped, one.digest
            )
            if not self._options.function:
                write_text(report_of(one.unit), text)
            if self._options.record:
                harnesses = mutant_records.all_harnesses(one.unit.root)
                versions = self._tools.versions("prove")
                judges = mutant_records.killers(verdict.engines for verdict in verdicts)
                made_of = mutant_records.origin(one.unit, harnesses, versions, judges)
                print(mutant_table.keep(one.unit, verdicts, problems, made_of))
            print("\n".join(executed(one)))
            print(f"{one.unit.name}: dropped {one.dropped} that say the same as another")
            status = max(status, conclude(verdicts, problems, self.engines))
        return status


def executed(one: Measured) -> list[str]:
    """What was executed now, what CBMC said of it, and which harnesses were left out."""
    name, sample, late = one.unit.name, one.trial.sample, one.trial.late
    lines = [
        f"{name}: {sample.executed} killed by executions now, {sample.confirmed} of them"
        " confirmed by CBMC",
        f"{name}: {late.executed} killed by WP now, {late.confirmed} of them within full limits",
    ]
    lines += [
        f"{name}: {harness} is not executed: {why}"
        for harness, why in sorted(one.trial.not_executed.items())
    ]
    return lines


def conclude(verdicts: Sequence[Verdict], problems: Sequence[str], engines: Sequence[str]) -> int:
    """Tell the result; the exit status."""
    print("\n".join(mutant_verdicts.table(verdicts, engines)))
    statuses = ("survived", "undecided", "skipped")
    open_ones = [verdict for verdict in verdicts if verdict.status in statuses]
    for verdict in open_ones:
        print(f"{verdict.status.upper()} {verdict.mutant.file.name}: {verdict.mutant}")
    for text in problems:
        print(f"FAILED {text}")
    numbers = {name: mutant_verdicts.count(verdicts, name) for name in mutant_verdicts.STATUSES}
    print(
        f"killed {numbers['killed']} of {len(verdicts) - numbers['stillborn']} mutants"
        f" ({numbers['equivalent']} equivalent), {numbers['survived']} survived unexplained"
        + (f", {numbers['undecided']} undecided" if numbers["undecided"] else "")
        + (f", {numbers['skipped']} not tried" if numbers["skipped"] else "")
    )
    return 1 if open_ones or problems else 0


def measure(units: Sequence[Unit], options: argparse.Namespace, toolchain: Toolchain) -> int:
    """Try the mutants of units and report; the exit status."""
    if options.record:
        mutant_table.read(units[0].root)  # One that is refused is told before hours of work.
    measurement = Measurement(units, options, toolchain)
    crew: Threads | Dask | None = None
    try:
        if options.list:
            found = [mutant for one in measurement.units for mutant in one.found]
            print("\n".join(f"{mutant.kind:<10} {mutant}" for mutant in found))
            return 0
        if address := os.environ.get("DASK"):
            order = {"engine": options.engine, "quick": options.quick, "small": options.small}
            crew = Dask(address, units[0].root, digest(measurement.stamp), order)
        else:
            end = time.monotonic() + options.max_seconds
            crew = Threads(options.jobs, measurement, end)
        measurement.run(crew)
        return measurement.conclude()
    finally:
        if isinstance(crew, Dask):
            crew.stop()
        measurement.close()


def tell_status(units: Sequence[Unit], options: argparse.Namespace, toolchain: Toolchain) -> int:
    """What is kept and what build/mutate has on units, and whether it is of what is there."""
    problems: list[str] = []
    tools = toolchain.versions("prove")
    for kept in mutant_standing.standings(units[0].root, units, tools, problems):
        print(kept.line)
    if tried := [unit for unit in units if report_of(unit).is_file()]:
        print("last tried in this tree, in build/mutate:")
        measurement = Measurement(tried, options, toolchain)
        for one in measurement.units:
            print(mutant_verdicts.standing(one.unit.name, report_of(one.unit), one.digest))
        measurement.close()
    for text in problems:
        print(f"mutate: {text}", file=sys.stderr)
    return 2 if problems else 0


def carry_out(
    order: Mapping[str, Any], units: Mapping[str, Unit], toolchain: Toolchain
) -> dict[str, Any]:
    """Try the mutants that an order from another machine names."""
    line = ["--unit", order["unit"], "--jobs", "1", *(["--quick"] if order["quick"] else [])]
    line += ["--small"] if order["small"] else []
    line += ["--engine", order["engine"]] if order["engine"] else []
    measurement = Measurement([units[order["unit"]]], parse(line, list(units)), toolchain)
    [one] = measurement.units
    named = {mutant.identity: mutant for mutant in one.found}
    try:
        outcomes = []
        for identity in order["mutants"]:
            mutant = named[(identity[0], identity[1], identity[2], identity[3])]
            known = one.trial.known(mutant)
            verdict = known if known and known.is_lasting else one.trial.try_mutant(mutant)
            if verdict.is_lasting:
                one.trial.keep(verdict)
            outcomes.append(verdict.outcome)
    finally:
        measurement.close()
    return {"stamp": digest(measurement.stamp), "verdicts": outcomes}


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    end_as_by_ctrl_c()
    try:
        units = find_units()
        options = parse(arguments, list(units))
        toolchain = Toolchain()
        if options.order:
            return answer_order(sys.stdin.read, lambda order: _ordered(order, units, toolchain))
        toolchain.ensure("prove")
        if tries(options):
            toolchain.ensure("fuzz")
        chosen = [units[name] for name in options.unit]
        if options.status:
            return tell_status(chosen, options, toolchain)
        return measure(chosen, options, toolchain)
    except (ToolError, ToolchainError) as error:
        print(f"mutate: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(
            "mutate: interrupted; what was decided is kept, call it again to go on", file=sys.stderr
        )
        return 130


def _ordered(
    order: Mapping[str, Any], units: Mapping[str, Unit], toolchain: Toolchain
) -> dict[str, Any]:
    toolchain.ensure("prove", "fuzz")
    return carry_out(order, units, toolchain)
