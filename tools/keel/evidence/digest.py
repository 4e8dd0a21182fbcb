# SPDX-License-Identifier: Apache-2.0
"""The package in one short table, for a pull request's page or a job's summary."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from keel.evidence.assemble import Assembled

SHOWN = 20  # Problems; the console has all.


def escaped(text: str) -> str:
    """Text for a cell of a table."""
    return text.replace("|", "\\|").replace("\n", " ")


def lines(made: Assembled, problems: Sequence[str]) -> Iterator[str]:
    """The verdict, a row for each part, and the first problems."""
    yield "## Evidence"
    yield ""
    yield f"**Failed: {len(problems)} problems.**" if problems else "**Complete.**"
    yield ""
    yield "| part | figures |"
    yield "|---|---|"
    for part in made.parts:
        figures = "; ".join(f"{name}: {value}" for name, value in part.summary.items())
        yield f"| {escaped(part.title)} | {escaped(figures) or 'none'} |"
    if problems:
        yield ""
        yield from (f"- {escaped(problem)}" for problem in problems[:SHOWN])
    if len(problems) > SHOWN:
        yield f"- and {len(problems) - SHOWN} more"


def as_markdown(made: Assembled, problems: Sequence[str]) -> str:
    """The whole text."""
    return "\n".join(lines(made, problems)) + "\n"
