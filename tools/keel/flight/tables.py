# SPDX-License-Identifier: Apache-2.0
"""What is printed of flights."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.console import Console
from rich.table import Table

if TYPE_CHECKING:
    from keel.flight.board_tasks import BoardTask
    from keel.flight.crew import Outcome
    from keel.flight.judge import Finding

WIDTH = 170  # What the table of all flights needs, also in a log.
# Columns of the table of all flights: a limit's name, and the heading.
SHOWN = {
    "attitude_rms_deg": "attitude,\nrms, deg",
    "attitude_max_deg": "worst,\ndeg",
    "without_fault_deg": "from un-\nbroken",
    "tracking_rms_deg": "tracking,\nrms",
    "hold_max_m": "hold,\nm",
    "height_max_m": "height,\nm",
    "sink_max": "touch-\ndown",
}


def console() -> Console:
    """One that is wide enough."""
    return Console(width=max(WIDTH, shutil.get_terminal_size().columns), highlight=False)


def cell(outcome: Outcome, name: str) -> str:
    """A number, with its limit where it has one."""
    limited = next((finding for finding in outcome.findings if finding.name == name), None)
    if limited is None:
        return ""
    colour = "green" if limited.good else "red"
    return f"[{colour}]{limited.value}[/] / {limited.limit}"


def verdict(outcome: Outcome) -> str:
    """In a word."""
    if outcome.good:
        return "[green]fails, as it must[/]" if outcome.expects_failure else "[green]good[/]"
    return "[red]holds, and should not[/]" if outcome.expects_failure else "[red]NOT GOOD[/]"


def all_flights(outcomes: Sequence[Outcome]) -> Table:
    """A row for each flight."""
    table = Table(title="Errors / limits", title_justify="left")
    table.add_column("scenario", no_wrap=True)
    table.add_column("plant", no_wrap=True)
    for heading in SHOWN.values():
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    for outcome in outcomes:
        cells = [cell(outcome, name) for name in SHOWN]
        table.add_row(outcome.name, outcome.plant, *cells, verdict(outcome))
    return table


def one_flight(outcome: Outcome) -> Table:
    """A row for each limit."""
    title = f"{outcome.name} in {outcome.plant}, seed {outcome.seed}: {' > '.join(outcome.states)}"
    return limits(title, outcome.findings)


def limits(title: str, findings: Sequence[Finding]) -> Table:
    """A row for each limit."""
    table = Table(title=title, title_justify="left")
    for heading in ("limit", "flight", "at most, or wanted", ""):
        table.add_column(heading)
    for finding in findings:
        word = "[green]holds[/]" if finding.good else "[red]BROKEN[/]"
        table.add_row(finding.name, finding.value, finding.limit, word)
    return table


def task_times(tasks: Sequence[BoardTask]) -> Table:
    """A row for each task of a board's image."""
    table = Table(title="Tasks of the image, from power-on, in us", title_justify="left")
    for heading in ("task", "period", "runs", "longest", "budget", ""):
        table.add_column(heading, justify="left" if heading in ("task", "") else "right")
    for task in tasks:
        word = "[green]fits[/]" if task.fits else "[red]OVER[/]"
        numbers = (task.period_us, task.runs, task.longest_us, task.budget_us)
        table.add_row(task.name, *map(str, numbers), word)
    return table


def in_words(finding: Finding) -> str:
    """A broken limit."""
    return f"{finding.name} {finding.value}, wanted {finding.limit}"


def failures(outcomes: Sequence[Outcome]) -> list[str]:
    """A line for each flight that is not good."""
    lines = []
    for outcome in outcomes:
        if not outcome.good:
            what = "; ".join(in_words(finding) for finding in outcome.broken)
            why = "keeps all limits, but must not" if outcome.expects_failure else what
            lines.append(f"{outcome.name} in {outcome.plant}: {why}")
    return lines
