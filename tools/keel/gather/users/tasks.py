# SPDX-License-Identifier: Apache-2.0
"""The part `tasks` of a project: whether its task table holds, by the analyser."""

from __future__ import annotations

from keel.base.files import write_json
from keel.gather.part import Context, Part, Table
from keel.install.packages import provide

FILE = "specs/tasks.toml"


def make(context: Context) -> Part:
    """The table, and the analyser's verdict."""
    provide("timing")
    from keel.timing.analysis import analyse
    from keel.timing.report import verdict
    from keel.timing.taskset import read

    tasks = read(context.root / FILE)
    analysis = analyse(tasks)
    written = context.work / "analysis.json"
    write_json(written, analysis.report())
    rows = tuple(
        (task.name, task.class_name, str(task.period), str(task.budget)) for task in tasks.tasks
    )
    table = Table(title="Tasks", columns=("task", "class", "period, us", "budget, us"), rows=rows)
    problems = () if analysis.schedulable else tuple(f"{FILE}: {why}" for why in analysis.reasons)
    return Part(
        name="tasks",
        title="Task table",
        tables=(table,),
        problems=problems,
        files={written.name: written},
        summary={"verdict": verdict(analysis)},
    )
