#!/usr/bin/env python3
"""Measure how strong the proofs of a unit are: break its code in small ways, see who notices.

    python3 tools/mutate.py --unit queue                 # CBMC first, WP if CBMC does not notice
    python3 tools/mutate.py --unit queue --engine both   # each engine by itself
    python3 tools/mutate.py --unit queue --list          # the mutants, without trying them

A mutant that nobody notices shows a contract that is too weak, or a change that makes no
difference; the latter is accepted with its reason in proofs/UNIT/equivalent.toml. The tree is
never touched. build/mutate/UNIT.json has the details.

Exit status: 0 when every mutant is killed or explained, 1 when not, 2 for a wrong command line.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from proofs.cache import Cache, write_atomically  # noqa: E402
from proofs.jobs import end_as_by_ctrl_c, in_pool  # noqa: E402
from proofs.mutants import Mutant, mutants  # noqa: E402
from proofs.mutation import Tools, Trees, Trial, Verdict  # noqa: E402
from proofs.project import RECORDED_TIMES, ProjectError, Unit, find_units  # noqa: E402
from proofs.session import own_digest, prover_answers, tool_stamp  # noqa: E402
from proofs.settings import read_exceptions  # noqa: E402
from proofs.times import Times  # noqa: E402
from toolchain import TARGET_FLAGS, Toolchain, ToolchainError  # noqa: E402

from proofs import clauses, mutant_slips, mutation  # noqa: E402

ENGINES = {"wp": ("wp",), "cbmc": ("cbmc",), "both": ("cbmc", "wp"), None: ("cbmc", "wp")}


def parse(arguments: Sequence[str] | None, names: Sequence[str]) -> argparse.Namespace:
    """The command line; a unit that does not exist is named, with those that do."""
    parser = argparse.ArgumentParser(description="Measure the proofs of a unit by mutants.")
    parser.add_argument("--unit", required=True, metavar="U", help="the unit whose code is broken")
    parser.add_argument(
        "--engine",
        choices=("wp", "cbmc", "both"),
        help="only this, or each apart; default: WP for what CBMC leaves",
    )
    parser.add_argument("--function", metavar="F", help="only mutants of this function")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="mutants side by side")
    parser.add_argument("--max-seconds", type=float, default=float("inf"), metavar="S",
                        help="start no mutant after this time")  # fmt: skip
    parser.add_argument("--list", action="store_true", help="print the mutants, try none")
    parser.add_argument("--quick", action="store_true",
                        help="short limits for WP; what they leave open is not killed")  # fmt: skip
    parser.add_argument("--fresh", action="store_true", help="try every mutant afresh")
    options = parser.parse_args(arguments)
    if options.unit not in names:
        parser.error(f"no such unit: {options.unit} (there are: {', '.join(names)})")
    if options.jobs < 1:
        parser.error("--jobs needs at least 1")
    return options


def tools_for(toolchain: Toolchain, root: Path, scratch: Path) -> Tools:
    """The programs of the trials."""
    compiler = [
        *toolchain.command("arm-none-eabi-gcc"),
        *TARGET_FLAGS,
        "-std=c99",
        "-ffreestanding",
    ]
    stamp = tool_stamp(toolchain.versions("prove"))
    return Tools(
        frama_c=toolchain.frama_c(), goto_cc=toolchain.goto_cc(), cbmc=toolchain.command("cbmc"),
        compiler=compiler, scratch=scratch, answers=prover_answers(root, stamp),
        verdicts=toolchain.cache.folder / "verdicts",
        environment={**os.environ, **toolchain.environment(), "TMPDIR": str(scratch)},
    )  # fmt: skip


def try_all(trial: Trial, found: Sequence[Mutant], width: int, max_seconds: float) -> list[Verdict]:
    """The verdicts on all mutants, told as they come."""
    end = time.monotonic() + max_seconds

    def attempt(mutant: Mutant) -> Verdict:
        if time.monotonic() > end:
            return Verdict(mutant, "skipped", "out of time")
        return trial.try_mutant(mutant)

    verdicts: dict[int, Verdict] = {}
    tasks = [lambda mutant=mutant: attempt(mutant) for mutant in found]
    for index, verdict in in_pool(tasks, width, trial):
        verdicts[index] = verdict
        how = verdict.reason or "; ".join(f"{k} {v}" for k, v in verdict.engines.items())
        print(
            f"{len(verdicts):>4}/{len(found)} {verdict.status:<10} {verdict.mutant}  [{how}]",
            flush=True,
        )
    return [verdicts[index] for index in sorted(verdicts)]


def measure(unit: Unit, options: argparse.Namespace, toolchain: Toolchain) -> int:
    """Try the mutants of a unit and report; the exit status."""
    around = mutant_slips.surroundings(clauses.header_texts(unit.root))
    found = [mutant for path in unit.own_files for mutant in mutants(path, around)]
    if options.function:
        found = [mutant for mutant in found if mutant.function == options.function]
    if options.list:
        print("\n".join(f"{mutant.kind:<10} {mutant}" for mutant in found))
        return 0
    build = unit.root / "build" / "mutate"
    target = build / f"{unit.name}.json"
    target.unlink(missing_ok=True)
    scratch = Path(tempfile.mkdtemp(prefix="keel-mutate-"))
    engines = ENGINES[options.engine]
    stamp = {**tool_stamp(toolchain.versions("prove")), "driver": own_digest()}
    cache = Cache(build / "cache", options.fresh)
    tools = tools_for(toolchain, unit.root, scratch)
    trees = Trees(unit.root, scratch, options.jobs)
    exceptions = read_exceptions(unit.root / "proofs" / "units.toml", list(find_units(unit.root)))
    times = Times(unit.root / "build/prove/times.json", unit.root / RECORDED_TIMES)
    trial = Trial(
        unit, tools, trees, engines, options.engine == "both", cache, stamp,
        exceptions[unit.name], times, patient=not options.quick,
    )  # fmt: skip
    try:
        verdicts = try_all(trial, found, options.jobs, options.max_seconds)
    finally:
        trial.stop()
        shutil.rmtree(scratch, ignore_errors=True)
    accepted = mutation.read_equivalent(unit.folder / "equivalent.toml")
    problems = [f"{name} is not proved even unchanged" for name in trial.unusable]
    problems += mutation.settle(verdicts, accepted, not options.function)
    write_atomically(target, mutation.report(unit.name, verdicts, problems))
    return conclude(verdicts, problems, engines)


def conclude(verdicts: Sequence[Verdict], problems: Sequence[str], engines: Sequence[str]) -> int:
    """Tell the result; the exit status."""
    print("\n".join(mutation.table(verdicts, engines)))
    undecided = mutation.count(verdicts, "undecided")
    statuses = ("survived", "undecided", "skipped")
    open_ones = [verdict for verdict in verdicts if verdict.status in statuses]
    for verdict in open_ones:
        print(f"{verdict.status.upper()} {verdict.mutant.file.name}: {verdict.mutant}")
    for text in problems:
        print(f"FAILED {text}")
    numbers = {
        name: mutation.count(verdicts, name) for name in ("killed", "equivalent", "stillborn")
    }
    print(
        f"killed {numbers['killed']} of {len(verdicts) - numbers['stillborn']} mutants"
        f" ({numbers['equivalent']} equivalent), {len(open_ones) - undecided} survived unexplained"
        + (f", {undecided} undecided" if undecided else "")
    )
    return 1 if open_ones or problems else 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    end_as_by_ctrl_c()
    try:
        units = find_units()
        options = parse(arguments, list(units))
        toolchain = Toolchain()
        toolchain.ensure("prove")
        return measure(units[options.unit], options, toolchain)
    except (ProjectError, ToolchainError) as error:
        print(f"mutate: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("mutate: interrupted; nothing was reported", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
