# SPDX-License-Identifier: Apache-2.0
"""The timing tools.

    python3 tools/keel timing analyze specs/tasksets/urpilot.toml

Exit status: 0 when all is well, 1 when a set is not shown to be schedulable (the last line tells
whether it cannot be, is not admitted, or has no bound), a table is stale or a goal of an experiment
is missed, 2 for a wrong command line, a bad file, or what could not be run. (`make` itself ends
with 2 for either.)
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import write_json
from keel.config import ConfigError
from keel.install import Toolchain
from keel.timing import ctable
from keel.timing.analysis import analyse
from keel.timing.board import build, for_capacity
from keel.timing.evaluation import evaluate
from keel.timing.output import Cell, console, table
from keel.timing.phases import spread, without_phases
from keel.timing.plots import plot_classes, plot_paths, plot_tasks
from keel.timing.report import plot_responses, plot_utilisation, print_analysis, verdict
from keel.timing.synthesis import SynthesisError, print_synthesis, synthesize
from keel.timing.taskset import TaskSet, read

BUILD = Path("build/timing")


def run_analyze(options: argparse.Namespace) -> int:
    """Analyse a task set."""
    tasks = read(options.taskset)
    if options.verdict:
        return run_verdict(tasks)
    if options.synthesize:
        return run_synthesis(tasks)
    if options.phases:
        return run_phases(tasks)
    analysis = analyse(tasks)
    out = console()
    print_analysis(analysis, out)
    folder = ROOT / BUILD / tasks.name
    plot_utilisation(analysis, folder / "utilisation.svg")
    plot_responses(analysis, folder / "responses.svg")
    write_json(folder / "analysis.json", analysis.report())
    print(f"written: {BUILD / tasks.name}/analysis.json, utilisation.svg, responses.svg")
    for advice in analysis.advice:
        print(f"advice: {advice}")
    for reason in analysis.reasons[1:]:
        print(f"also: {reason}")
    print(verdict(analysis))
    return 0 if analysis.schedulable else 1


def run_verdict(tasks: TaskSet) -> int:
    """Does a task set hold? In a line."""
    analysis = analyse(tasks)
    print(verdict(analysis))
    return 0 if analysis.schedulable else 1


def run_synthesis(tasks: TaskSet) -> int:
    """Find periods from the limits of the paths."""
    try:
        found = synthesize(tasks)
    except SynthesisError as error:
        print(f"{tasks.name}: no synthesis: {error}")
        return 1
    print_synthesis(found, console())
    folder = ROOT / BUILD / tasks.name
    periods = {task.name: task.period for task in found.after.tasks}
    report = {"periods_us": periods, "spare_us": found.spare_us, **found.analysis.report()}
    write_json(folder / "synthesis.json", report)
    print(f"written: {BUILD / tasks.name}/synthesis.json")
    print(f"synthesis: {verdict(found.analysis)}")
    return 0 if found.analysis.schedulable else 1


def run_phases(tasks: TaskSet) -> int:
    """Find phases with which tasks do not collide."""
    found, crowded = spread(without_phases(tasks))
    rows: list[list[Cell]] = [
        [task.label, task.name, task.period, task.phase] for task in found.tasks
    ]
    console().print(table("Phases, us", ["", "task", "T", "phase_us"], rows, 2))
    report = {"phases_us": {task.name: task.phase for task in found.tasks}, "crowded": crowded}
    write_json(ROOT / BUILD / tasks.name / "phases.json", report)
    print(f"written: {BUILD / tasks.name}/phases.json")
    if crowded:
        print(f"phases: no room apart from the others for {', '.join(crowded)}")
        return 1
    print("phases: with these no two tasks ever want the processor at the same time.")
    return 0


def run_table(options: argparse.Namespace) -> int:
    """Write the C table of a task set, or see whether it is what it would be."""
    tasks = read(options.taskset)
    files = ctable.table(tasks, options.taskset.name)
    if not options.check:
        changed = ctable.write(files, options.folder)
        print(f"table: {options.folder}: {', '.join(changed) or 'nothing'} changed")
        return 0
    wrong = ctable.stale(files, options.folder)
    for name in wrong:
        print(
            f"{options.folder / name}:1: stale: not what {options.taskset} gives; "
            "`make generate NAME=tables` regenerates it",
            file=sys.stderr,
        )
    print(f"table: {options.folder}: {f'{len(wrong)} stale files' if wrong else 'up to date'}")
    return 1 if wrong else 0


def run_all_experiments(options: argparse.Namespace) -> int:
    """The paper's evaluation on the virtual board."""
    tasks = read(options.taskset)
    began = time.monotonic()
    findings, results = evaluate(tasks, build(Toolchain(), extra=for_capacity(tasks)), console())
    folder = ROOT / BUILD / "experiments"
    plot_classes(tasks, results, folder / "figure12.svg")
    plot_tasks(tasks, results, folder / "deviation.svg")
    plot_paths(findings.report["paths"], folder / "figure10.svg")
    write_json(folder / "experiments.json", findings.report)
    print(
        f"written: {BUILD}/experiments/experiments.json, figure10.svg, figure12.svg, deviation.svg"
    )
    met = sum(goal.met for goal in findings.goals)
    known = len(findings.goals) - met - len(findings.unexplained)
    print(
        f"timing: {met} goals met, {known} missed for known reasons, {len(findings.unexplained)} "
        f"FAILED, in {time.monotonic() - began:.0f} s"
    )
    return 1 if findings.unexplained else 0


def arguments_parser() -> argparse.ArgumentParser:
    """The command line."""
    parser = Parser("Timing tools.", "timing")
    commands = parser.add_subparsers(dest="command", required=True)
    analyze = commands.add_parser("analyze", help="analyse a task set")
    analyze.add_argument("taskset", type=Path)
    what = analyze.add_mutually_exclusive_group()
    what.add_argument("--synthesize", action="store_true", help="find periods from the limits")
    what.add_argument("--phases", action="store_true", help="find phases without collisions")
    what.add_argument("--verdict", action="store_true", help="say in a line whether it holds")
    analyze.set_defaults(run=run_analyze)
    tables = commands.add_parser("table", help="write the C task table")
    tables.add_argument("taskset", type=Path)
    tables.add_argument("folder", type=Path)
    tables.add_argument("--check", action="store_true", help="only see whether it is stale")
    tables.set_defaults(run=run_table)
    experiments = commands.add_parser("experiments", help="the paper's evaluation")
    experiments.add_argument("taskset", type=Path)
    experiments.set_defaults(run=run_all_experiments)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    options = arguments_parser().parse_args(arguments)

    def work() -> int:
        try:
            status: int = options.run(options)
        except ConfigError as error:
            # As they are: an editor finds the lines.
            print(error, file=sys.stderr)
            problems = len(str(error).splitlines())
            raise ToolError(f"{problems} problems in the task set") from error
        return status

    return program(options.command, work)
