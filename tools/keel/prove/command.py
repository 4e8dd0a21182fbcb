# SPDX-License-Identifier: Apache-2.0
"""Prove Keel: every contract with Frama-C/WP, every harness with CBMC, rounding with Gappa.

    python3 tools/keel prove                    # everything
    python3 tools/keel prove --unit queue       # one unit
    python3 tools/keel prove --kernel           # scheduler, voter, filter and PID
    python3 tools/keel prove --update-goals     # accept the goals as they are now, after review
    python3 tools/keel prove --shard 2/4        # a quarter of it: build/prove/shard-2-of-4.json
    python3 tools/keel prove --join FILE...     # the verdict on the whole, from all four reports
    python3 tools/keel prove --project FOLDER   # a project of your own: docs/own_unit.md
    python3 tools/keel prove --explain NAME    # why a goal, harness or assertion fails; how a wrong
                                              # body is refuted

Exit status: 0 when all is proved and the goals are those of proofs/UNIT/goals.txt, 1 when not, 2
when it could not be tried (a name that is unknown, a tool that is missing), 130 when it was
interrupted. make ends with 2 for all of them. build/prove/report.json has the details; junit.xml
and results.sarif beside it say the same to CI systems and editors. There is none while a run is not
over. A verdict is kept in the user's cache (KEEL_CACHE) under all that it depends on, and only
success is: another clone of the same text has it, too.
"""

from __future__ import annotations

import argparse
import os
import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path

from keel.base.errors import program
from keel.base.jobs import end_as_by_ctrl_c
from keel.c.project import KEEL, ProjectError, Unit, find_units
from keel.install import Toolchain
from keel.prove.proof_run import Choice, Session
from keel.prove.shards import Shard, read_shard

ENGINES = ("wp", "cbmc", "gappa")
# Which units the paper is about.
KERNEL = "specs/kernel.toml"


def shard(text: str) -> Shard:
    """The shard that the command line names."""
    try:
        return read_shard(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def size(text: str) -> str:
    """A size that a build chooses, for a compiler."""
    if not re.fullmatch(r"[A-Z][A-Z0-9_]*=[1-9][0-9]*", text):
        raise argparse.ArgumentTypeError(f"{text}: expected NAME=NUMBER, NAME as #define has it")
    return f"-D{text}u"


def parse(arguments: Sequence[str] | None, names: Sequence[str]) -> argparse.Namespace:
    """The command line; a unit that does not exist is named, with those that do."""
    parser = argparse.ArgumentParser(description="Prove Keel with Frama-C/WP, CBMC and Gappa.")
    parser.add_argument(
        "--project",
        type=Path,
        metavar="FOLDER",
        help="a project that uses Keel; default: Keel itself",
    )
    parser.add_argument("--unit", nargs="+", metavar="U", help="only these units")
    parser.add_argument(
        "--kernel", action="store_true", help="only the scheduler, the voter, filter and PID"
    )
    parser.add_argument("--engine", choices=ENGINES, help="only this engine")
    parser.add_argument("--update-goals", action="store_true", help="rewrite proofs/UNIT/goals.txt")
    # One more than there are cores, as WP waits a moment for each goal.
    parser.add_argument(
        "-j",
        dest="width",
        type=int,
        default=(os.cpu_count() or 1) + 1,
        metavar="N",
        help="jobs side by side (default %(default)s)",
    )
    parser.add_argument(
        "--fresh", action="store_true", help="prove everything, whatever verdicts are known"
    )
    parser.add_argument(
        "--quick", action="store_true", help="give up early on what provers do not prove at once"
    )
    parser.add_argument(
        "--size",
        type=size,
        action="append",
        default=[],
        metavar="NAME=N",
        help="of a build: KEEL_QUEUE_CAPACITY=8, KEEL_VOTER_SENSORS=3",
    )
    parser.add_argument(
        "--patience",
        type=int,
        default=1,
        metavar="N",
        help="N times the processor time for every prover",
    )
    parser.add_argument("--shard", type=shard, metavar="N/M", help="only this part of the jobs")
    parser.add_argument(
        "--join",
        nargs="+",
        type=Path,
        metavar="FILE",
        help="prove nothing: take what the reports of all shards say",
    )
    parser.add_argument(
        "--explain", metavar="NAME", help="why a goal, harness, assertion or wrong body fails"
    )
    options = parser.parse_args(arguments)
    selected = options.unit or options.engine or options.quick or options.kernel or options.size
    if options.unit and options.kernel:
        parser.error("--kernel is a choice of units, as --unit is")
    if options.shard and (selected or options.join or options.update_goals):
        parser.error("--shard is a part of a whole run (make prove-all), with --fresh and -j only")
    if options.join and (selected or options.fresh):
        parser.error("--join takes a whole run (make prove-all) together, with --update-goals only")
    unknown = [name for name in options.unit or () if name not in names]
    if unknown:
        parser.error(f"no such unit: {', '.join(unknown)} (there are: {', '.join(names)})")
    if options.width < 1 or options.patience < 1:
        parser.error("-j and --patience need at least 1")
    return options


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    end_as_by_ctrl_c()
    return program("prove", lambda: prove(arguments))


def project(arguments: Sequence[str] | None) -> Path:
    """The project to be proved, which decides what units there are."""
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--project", type=Path, default=KEEL)
    root: Path = parser.parse_known_args(arguments)[0].project.resolve()
    if not find_units(root):
        raise ProjectError(f"{root}: there is no unit, include/LAYER/NAME.h")
    return root


def kernel_of(root: Path, units: Mapping[str, Unit]) -> list[str]:
    """The names of the units that the paper is about, as the project's list has them."""
    path = root / KERNEL
    if not path.is_file():
        raise ProjectError(f"{path}: not there, so --kernel chooses nothing")
    try:
        listed = tomllib.loads(path.read_text(encoding="utf-8"))
        layers, more, without = listed["layers"], listed["units"], listed["without"]
    except (tomllib.TOMLDecodeError, KeyError) as error:
        raise ProjectError(f"{path}: {error}") from error
    if strange := [name for name in (*more, *without) if name not in units]:
        raise ProjectError(f"{path}: no such unit: {', '.join(strange)}")
    return [
        name
        for name, unit in units.items()
        if (unit.layer in layers or name in more) and name not in without
    ]


def prove(arguments: Sequence[str] | None) -> int:
    """Do what the command line asks for."""
    root = project(arguments)
    units = find_units(root)
    options = parse(arguments, list(units))
    names = kernel_of(root, units) if options.kernel else options.unit or list(units)
    chosen = tuple(one for one in units.values() if one.name in names)
    tools = Toolchain()
    tools.ensure("prove")
    choice = Choice(
        units=chosen,
        partial=len(chosen) < len(units) or bool(options.engine or options.size),
        engines=(options.engine,) if options.engine else ENGINES,
        width=options.width,
        verdicts=tools.cache.folder / "verdicts",
        fresh=options.fresh,
        quick=options.quick,
        update_goals=options.update_goals,
        patience=options.patience,
        defines=tuple(options.size),
        shard=options.shard,
        join=tuple(path.resolve() for path in options.join or ()),
    )
    session = Session(root, tools, choice)
    return session.explain(options.explain) if options.explain else session.run()
