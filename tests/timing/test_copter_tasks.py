# SPDX-License-Identifier: Apache-2.0
"""Where the copter departs from table 2: what examples/copter/copter.h declares holds."""

from __future__ import annotations

import re
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from keel.timing.analysis import analyse
from keel.timing.taskset import Task, TaskSet, read

ROOT = Path(__file__).resolve().parents[2]
DEFINED = re.compile(r"^#define COPTER_(\w+) +(\d+)u", re.MULTILINE)

CLASSED = re.compile(r"^#define COPTER_(\w+) KEEL_PRIORITY_(\w+)", re.MULTILINE)
# Tasks that what the pilot says goes through; a run that is far too long leaves any one of them to
# promotion (priority.h: once its age is 15 periods over its priority), and the others to theirs.
HEARD_BY = ("Background radio", "Foreground radio", "State machine")


@pytest.fixture(scope="module")
def copter() -> TaskSet:
    """Table 2 with the copter's rows in place of the paper's."""
    text = (ROOT / "examples/copter/copter.h").read_text(encoding="utf-8")
    number = {name: int(value) for name, value in DEFINED.findall(text)}
    named = {name: value.lower().replace("_", "-") for name, value in CLASSED.findall(text)}
    rows = {
        "Scheduler analysis": {
            "budget": number["ANALYSIS_WCET_US"],
            "phase": number["ANALYSIS_PHASE_US"],
        },
        "Background radio": {"budget": number["RADIO_WCET_US"], "phase": number["RADIO_PHASE_US"]},
        "Foreground radio": {
            "phase": number["PILOT_PHASE_US"],
            "class_name": named["PILOT_PRIORITY"],
        },
        "State machine": {"phase": number["STATE_PHASE_US"], "class_name": named["STATE_PRIORITY"]},
    }
    paper = read(ROOT / "specs/tasksets/urpilot.toml")
    return replace(
        paper, tasks=tuple(replace(task, **rows.get(task.name, {})) for task in paper.tasks)
    )


def test_the_copters_tasks_hold(copter: TaskSet) -> None:
    """No two ever want the processor at once, and each judged path keeps its limits, safely."""
    found = analyse(copter)
    assert found.schedulable
    assert not found.collisions
    judged = [chain for chain in found.chains if not chain.advisory]
    assert [chain.name for chain in judged] == ["IMU, rate", "IMU, angle", "Magnetometer", "Radio"]
    for chain in judged:
        assert chain.safe is not None
        assert chain.safe <= chain.reaction_limit


def test_at_the_papers_phase_there_is_no_room(copter: TaskSet) -> None:
    """The phases are not for show."""
    paper = read(ROOT / "specs/tasksets/urpilot.toml")
    phase = next(task.phase for task in paper.tasks if task.name == "Background radio")
    tasks = tuple(
        replace(task, phase=phase) if task.name == "Background radio" else task
        for task in copter.tasks
    )
    assert analyse(replace(copter, tasks=tasks)).collisions


# --- The board's own set. ---


@pytest.fixture(scope="module")
def fmuv5() -> TaskSet:
    return read(ROOT / "specs/tasksets/fmuv5.toml")


def own_task(source: str) -> dict[str, int]:
    """What a task beside table 2 declares."""
    text = (ROOT / "examples/copter" / source).read_text(encoding="utf-8")
    names = {"PERIOD_US": "period", "WCET_US": "budget", "PHASE_US": "phase"}
    found = re.findall(r"^#define (\w+) +(\d+)u", text, re.MULTILINE)
    return {names[name]: int(value) for name, value in found if name in names}


def test_the_boards_set_is_the_copters_with_its_own_tasks(fmuv5: TaskSet, copter: TaskSet) -> None:
    plain = [replace(task, label="", sigma=None) for task in (*copter.tasks, *fmuv5.tasks)]
    table, own = plain[: len(copter.tasks)], plain[len(copter.tasks) :]
    assert own[: len(table)] == table
    assert [
        (task.name, task.class_name, task.period, task.budget, task.phase)
        for task in own[len(table) :]
    ] == [
        (name, "low", *(own_task(source)[key] for key in ("period", "budget", "phase")))
        for name, source in (("Log", "log.c"), ("Telemetry", "telemetry.c"))
    ]


def test_the_boards_tasks_hold(fmuv5: TaskSet) -> None:
    found = analyse(fmuv5)
    assert found.schedulable
    assert not found.collisions
    assert {chain.name for chain in found.chains} == {
        "IMU, rate",
        "IMU, angle",
        "Magnetometer",
        "Radio",
    }
    for chain in found.chains:
        assert chain.safe is not None
        assert chain.safe <= chain.reaction_limit


@pytest.mark.parametrize(("name", "phase"), [("Telemetry", 1900), ("Log", 2100)])
def test_across_a_release_of_real_time_tasks_there_is_no_room(
    fmuv5: TaskSet, name: str, phase: int
) -> None:
    """Background IMU is due at every millisecond."""
    tasks = tuple(replace(task, phase=phase) if task.name == name else task for task in fmuv5.tasks)
    assert analyse(replace(fmuv5, tasks=tasks)).collisions


def promoted_us(task: Task) -> float:
    """How long a task may wait that no gap is long enough for: eq. 3."""
    return 15 * task.period / task.priority


def shortest_loss_us() -> int:
    """The least time of silence after which a pilot may be taken for lost."""
    table = tomllib.loads((ROOT / "specs/parameters/copter.toml").read_text(encoding="utf-8"))
    every = [one for group in table["group"] for one in group["parameter"]]
    return int(next(one["range"][0] for one in every if one["name"] == "FS_LOSS_TIME"))


def test_the_pilot_is_not_lost_when_a_task_waits_for_its_promotion(copter: TaskSet) -> None:
    """Whichever of them waits, the others' periods and a frame of 20 ms come on top."""
    tasks = {task.name: task for task in copter.tasks}
    periods = sum(tasks[name].period for name in HEARD_BY)
    waits = {name: promoted_us(tasks[name]) + periods + 20_000 for name in HEARD_BY}
    assert waits == {
        "Background radio": 145_000,
        "Foreground radio": 145_000,
        "State machine": 145_000,
    }
    assert max(waits.values()) < shortest_loss_us()


def test_by_the_papers_priorities_the_pilot_would_be_lost() -> None:
    paper = read(ROOT / "specs/tasksets/urpilot.toml")
    [machine] = [task for task in paper.tasks if task.name == "State machine"]
    assert promoted_us(machine) == 300_000 > shortest_loss_us()
