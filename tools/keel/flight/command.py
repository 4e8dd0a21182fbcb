# SPDX-License-Identifier: Apache-2.0
"""Fly examples/copter in models of an aircraft that others wrote, and judge the flights.

    python3 tools/keel fly [--scenario NAME] [--plant jsbsim] [--board fmuv5]

build/fly gets fly.json (every flight, its errors, limits and the SHA-256 of its trace) and a
picture of each flight. With --scenario the report is named after it. --seed flies a flight of
`make check NAME=flights` again and draws it. With either, or with --logs, there is the
flight's log, too, for `make log`; with --trace it has each run of each task, and stands beside its
two files of `make generate NAME=schedule`.

With --board the very image of a board flies, on a model of its chip and its devices: the same
scenarios, the same judge, the same limits. Units there are as many as the board has. A log is
wanted as on the host; it comes from a card, without the last second, and without the runs of tasks.
With --scenario a second table has each task's longest run beside its budget, and the report has
them for every flight. With --compare the host's copter flies the scenario, too, in JSBSim, with as
many units, after as long a boot: a table says by how much the two flights differ.

Exit status: 0 when every flight keeps its limits (or breaks them, where that is expected), 1 when
not, 2 when it could not be flown.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import write_json
from keel.flight import alike, board, library, scenario, tables
from keel.flight.crew import Job, Outcome, all_flown
from keel.flight.library import Copter
from keel.flight.loop import Order
from keel.flight.varied import order_of
from keel.install import Toolchain
from keel.plants import plants
from keel.timeline import command as schedule

BUILD = ROOT / "build/fly"
SCHEMA = 1


def parsed(arguments: Sequence[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = Parser("Fly the copter in plants that others wrote, and judge the flights.", "fly")
    parser.add_argument("--scenario", metavar="NAME", help="one of examples/copter/scenarios")
    parser.add_argument(
        "--scenarios",
        type=Path,
        default=scenario.FOLDER,
        metavar="FOLDER",
        help="where scenarios lie",
    )
    parser.add_argument(
        "--seed", type=int, metavar="N", help="a flight of make check NAME=flights, again"
    )
    parser.add_argument("--plant", choices=plants.NAMES, help="in this one only")
    parser.add_argument(
        "--board", choices=board.BOARDS, help="fly its image in place of the host's copter"
    )
    parser.add_argument(
        "--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="flights at a time"
    )
    parser.add_argument(
        "--build",
        type=Path,
        default=BUILD,
        metavar="FOLDER",
        help="where the report and the pictures go",
    )
    parser.add_argument("--no-pictures", action="store_true")
    parser.add_argument("--logs", action="store_true", help="keep the log of every flight")
    parser.add_argument(
        "--trace",
        action="store_true",
        help="with the log, each run of each task, for Perfetto and as a page",
    )
    parser.add_argument(
        "--compare", action="store_true", help="a board's flight of a scenario with the host's"
    )
    found = parser.parse_args(arguments)
    if found.seed is not None and (found.scenario or found.plant):
        raise ToolError("--seed: says scenario and plant by itself")
    if found.board and found.trace:
        raise ToolError("--trace: the log of an image has no runs of tasks")
    if found.compare and not (found.board and found.scenario):
        raise ToolError("--compare: with --board and --scenario")
    if found.compare and (found.plant or found.logs):
        raise ToolError("--compare: is in JSBSim, and leaves no log")
    if found.jobs < 1:
        raise ToolError(f"--jobs: expected 1 or more, found {found.jobs}")
    return found


def jobs_of(options: argparse.Namespace, copter: Path) -> list[Job]:
    """Every flight. All scenarios are read before the first one is flown."""
    if options.seed is not None:
        name = report_name(options)
        picture = None if options.no_pictures else options.build / f"{name}.svg"
        log = options.build / f"{name}.ulg"
        order = order_for(options, order_of(options.seed))
        return [Job(name, order, copter, picture, log, options.trace)]
    known = scenario.names(options.scenarios)
    names = [options.scenario] if options.scenario else known
    if not names:
        raise ToolError(f"{options.scenarios}: there is no scenario")
    jobs = []
    for name in names:
        found = scenario.read(name, options.scenarios)
        own = [] if options.board else scenario.of_board(found)
        if own and options.scenario:
            raise ToolError(f"{name}: {library.NO_BOARD.format(own[0])}")
        if own:
            continue  # Of all scenarios the host flies those that it can.
        for plant in found.plants:
            if options.plant in (None, plant):
                made = f"{prefix(options)}{name}-{plant}"
                picture = None if options.no_pictures else options.build / f"{made}.svg"
                wanted = options.logs or options.scenario or options.trace or found.needs_card
                log = options.build / f"{made}.ulg" if wanted else None
                order = order_for(options, Order(found, plant, found.seed))
                jobs.append(Job(name, order, copter, picture, log, options.trace))
    if not jobs:
        raise ToolError(f"{options.scenario or 'no scenario'}: is not flown in {options.plant}")
    return jobs


def order_for(options: argparse.Namespace, order: Order) -> Order:
    """The same with as many inertial units as the board has, if one flies."""
    if not options.board:
        return order
    own = scenario.with_units(order.scenario, board.BOARDS[options.board])
    return replace(order, scenario=own)


def prefix(options: argparse.Namespace) -> str:
    """What names begin with: a board's flights have names of their own."""
    return f"{options.board}-" if options.board else ""


def report_name(options: argparse.Namespace) -> str:
    """What the report is called."""
    if options.seed is not None:
        return f"{prefix(options)}seed-{options.seed}"
    return prefix(options) + str(options.scenario or "fly")


def library_of(options: argparse.Namespace) -> Path:
    """Where the copter's library is made."""
    folder: Path = options.build
    return folder / options.board / board.LIBRARY if options.board else folder / library.NAME


def build(options: argparse.Namespace) -> None:
    """The copter that flies, made anew."""
    if options.board:
        board.build(Toolchain(), options.board, library_of(options).parent)
    else:
        library.build(Toolchain(), options.build)


def all_outcomes(jobs: Sequence[Job], width: int) -> list[Outcome]:
    """Fly them, with a line for each that ends."""
    outcomes: dict[int, Outcome] = {}
    for place, outcome in all_flown(jobs, min(width, len(jobs))):
        outcomes[place] = outcome
        word = "good" if outcome.good else "NOT GOOD"
        print(f"[{len(outcomes)}/{len(jobs)}] {outcome.name} in {outcome.plant}: {word}")
    return [outcomes[place] for place in range(len(jobs))]


def tell(outcomes: Sequence[Outcome], report: Path, one: bool) -> None:
    """Print the tables, what is not good, and what happened, in this order."""
    console = tables.console()
    if one:
        for outcome in outcomes:
            console.print(tables.one_flight(outcome))
            if outcome.tasks:
                console.print(tables.task_times(outcome.tasks))
    else:
        console.print(tables.all_flights(outcomes))
    bad = tables.failures(outcomes)
    for line in bad:
        print(line)
    print(
        f"fly: {len(outcomes)} flights, {len(outcomes) - len(bad)} good, {len(bad)} not; "
        f"{shown(report)} has them"
    )


def compare(options: argparse.Namespace) -> int:
    """Fly a scenario with the board's image and with the host's copter; tell how they differ."""
    report: Path = options.build / f"{report_name(options)}-compared.json"
    report.unlink(missing_ok=True)
    asked = scenario.read(options.scenario, options.scenarios)
    if own := scenario.of_board(asked):
        raise ToolError(f"{options.scenario}: {library.NO_BOARD.format(own[0])}")
    build(options)
    host = Copter(library.build(Toolchain(), options.build))
    found = alike.compared(host, board.BoardCopter(library_of(options)), asked, options.board)
    good = all(finding.good for finding in found)
    write_json(
        report,
        {
            "schema": SCHEMA,
            "board": options.board,
            "sources_sha256": library.digest_of(),
            "good": good,
            "findings": [finding.as_json() for finding in found],
        },
    )
    title = f"{options.scenario} in JSBSim: the image of {options.board} and the host's copter"
    tables.console().print(tables.limits(title, found))
    word = "alike" if good else "not alike"
    print(f"fly: the image and the host's copter fly {word}; {shown(report)} has the figures")
    return 0 if good else 1


def shown(report: Path) -> Path:
    """A report's place, as it is printed."""
    return report.relative_to(ROOT) if report.is_relative_to(ROOT) else report


def fly(arguments: Sequence[str] | None) -> int:
    """Build, fly, write, tell."""
    options = parsed(arguments)
    if options.compare:
        return compare(options)
    jobs = jobs_of(options, library_of(options))
    report: Path = options.build / f"{report_name(options)}.json"
    report.unlink(missing_ok=True)  # What an older run found is not what this one finds.
    build(options)
    outcomes = all_outcomes(jobs, options.jobs)
    write_json(
        report,
        {
            "schema": SCHEMA,
            "board": options.board,
            "sources_sha256": library.digest_of(),
            "good": all(outcome.good for outcome in outcomes),
            "flights": [outcome.as_json() for outcome in outcomes],
        },
    )
    if options.board:
        print(f"fly: the image of {options.board} on a model of its chip")
    one = options.scenario is not None or options.seed is not None
    tell(outcomes, report, one)
    for job in jobs:
        if job.trace and job.log:
            schedule.tell(job.log)
    return 0 if all(outcome.good for outcome in outcomes) else 1


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("fly", lambda: fly(arguments))
