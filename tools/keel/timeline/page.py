# SPDX-License-Identifier: Apache-2.0
"""A schedule as one page of HTML that needs nothing else: a timeline to zoom, pan and search."""

from __future__ import annotations

import base64
import html
import json
from pathlib import Path
from typing import Any

from keel.base.files import read_text, write_text
from keel.timeline.runs import Schedule, slack

TEMPLATE = Path(__file__).with_name("page.html")
SCRIPT = Path(__file__).with_name("page.js")
# Typed arrays of the page's script, by their names, and how numpy has their elements.
ARRAYS = {
    "task": "<u2",
    "start": "<f8",
    "length": "<u4",
    "late": "<f8",
    "deadline": "<f8",
    "skipped": "<u2",
    "promoted": "u1",
    "slack": "<i4",
    "slack_after": "<i4",
}


def packed(values: Any, kind: str) -> str:
    """An array's bytes as text."""
    return base64.b64encode(values.astype(kind).tobytes()).decode()


def data_of(schedule: Schedule) -> dict[str, Any]:
    """What the page's script draws."""
    runs = schedule.runs
    columns = {
        "task": runs["task"],
        "start": runs["start"],
        "length": runs["end"] - runs["start"],
        "late": runs["start"] - runs["release"],
        "deadline": runs["deadline"],
        "skipped": runs["skipped"],
        "promoted": runs["promoted"],
        "slack": runs["slack"],
        "slack_after": slack(runs, schedule.tasks, runs["end"]),
    }
    return {
        "guard": schedule.guard_us,
        "dropouts": schedule.dropouts,
        "tasks": [
            {
                "name": task.name,
                "sort": task.sort,
                "period": task.period_us,
                "budget": task.budget_us,
            }
            for task in schedule.tasks
        ],
        "runs": {name: packed(columns[name], kind) for name, kind in ARRAYS.items()},
    }


def page_of(schedule: Schedule, title: str) -> str:
    """The page."""
    data = json.dumps(data_of(schedule)).replace("<", "\\u003c")  # Nothing may end the script.
    text = read_text(TEMPLATE)
    for mark, filled in (
        ("{{title}}", html.escape(title)),
        ("{{script}}", read_text(SCRIPT)),
        ("{{data}}", data),
    ):
        text = text.replace(mark, filled)
    return text


def write(path: Path, schedule: Schedule, title: str) -> None:
    """A file for any browser."""
    write_text(path, page_of(schedule, title))
