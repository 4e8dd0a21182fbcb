# SPDX-License-Identifier: Apache-2.0
"""Tables of one look, and the console that shows them."""

from __future__ import annotations

import shutil
from collections.abc import Sequence

from rich import box
from rich.console import Console
from rich.table import Table

Cell = str | int | float | None


def console() -> Console:
    """A console that is wide enough for our tables, also in a log."""
    width = shutil.get_terminal_size((160, 40)).columns
    return Console(width=max(width, 160), highlight=False)


def shown(cell: Cell) -> str:
    """A cell's text."""
    if cell is None:
        return "-"
    return f"{cell:.3f}" if isinstance(cell, float) else str(cell)


def table(
    title: str, columns: Sequence[str], rows: Sequence[Sequence[Cell]], left: int = 1
) -> Table:
    """A table; the first columns (as many as left says) hold words, the others numbers."""
    result = Table(title=title, box=box.SIMPLE_HEAD, title_justify="left", title_style="bold")
    for number, name in enumerate(columns):
        result.add_column(name, justify="left" if number < left else "right", no_wrap=True)
    for row in rows:
        result.add_row(*map(shown, row))
    return result
