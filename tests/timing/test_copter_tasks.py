# SPDX-License-Identifier: Apache-2.0
"""Where the copter departs from table 2: what examples/copter/copter.h declares holds."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from timing.analysis import analyse
from timing.taskset import TaskSet, read

ROOT = Path(__file__).resolve().parents[2]
DEFINED = re.compile(r"^#define COPTER_(\w+) +(\d+)u", re.MULTILINE)


@pytest.fixture(scope="module")
def copter() -> TaskSet:
    """Table 2 with the copter's rows in place of the paper's."""
    text = (ROOT / "examples/copter/copter.h").read_text(encoding="utf-8")
    number = {name: int(value) for name, value in DEFINED.findall(text)}
    rows = {
        "Background radio": {
            "budget": number["RADIO_WCET_US"], "phase": number["RADIO_PHASE_US"],
        },
        "Foreground radio": {"phase": number["PILOT_PHASE_US"]},
        "State machine": {"phase": number["STATE_PHASE_US"]},
    }  # fmt: skip
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
