# SPDX-License-Identifier: Apache-2.0
"""The summary as a PDF: what each part shows, in figures, words and tables.

The same parts give the same bytes: its only time is that of the commit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path

from fpdf import FPDF
from fpdf.enums import XPos, YPos
from fpdf.fonts import FontFace

from keel.base.files import write_bytes
from keel.evidence.assemble import REFERENCE, Assembled
from keel.gather.part import Part, Table
from keel.install import Toolchain

NARROW, WIDE = 10, 50  # Characters of a column.
ROWS = 40  # Of a table; the site and the JSON have all.
FONT = "DejaVu"
HEAD = FontFace(emphasis="BOLD", fill_color=(232, 236, 240))


class Paper(FPDF):
    """A4, with the commit and the number at the foot of each page."""

    def __init__(self, foot: str, when: datetime) -> None:
        super().__init__(format="A4")
        self.foot = foot
        self.set_creation_date(when)
        self.set_title(foot)
        self.set_lang("en")
        folder = Path(Toolchain().command("evidence-font")[0])
        for style, file in (("", "DejaVuSans.ttf"), ("B", "DejaVuSans-Bold.ttf")):
            self.add_font(FONT, style, folder / file)
        self.set_auto_page_break(True, 18)
        self.set_margin(18)
        self.add_page()

    def footer(self) -> None:
        """Below each page."""
        self.set_y(-13)
        self.set_font(FONT, size=7)
        self.cell(0, 5, f"{self.foot}   {self.page_no()}", align="R")

    def heading(self, text: str, size: float, level: int) -> None:
        """A heading, which is in the outline, too."""
        self.set_font(FONT, "B", size)
        self.ln(3)
        self.start_section(text, level)
        self.words(text, size / 2)

    def words(self, text: str, height: float = 4.6) -> None:
        """A paragraph in the present font."""
        self.multi_cell(0, height, text, new_x=XPos.LMARGIN, new_y=YPos.NEXT, align="L")

    def plain(self, text: str) -> None:
        """A paragraph of the text."""
        self.set_font(FONT, size=9)
        self.words(text)

    def rows(self, columns: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> None:
        """A table that goes on over pages; an item is named by its id alone."""
        self.set_font(FONT, size=7.5)
        shown = [tuple(shortened(text) for text in row) for row in (columns, *rows)]
        layout = {
            "col_widths": widths(shown),
            "borders_layout": "HORIZONTAL_LINES",
            "line_height": 4,
            "padding": 0.8,
        }
        with self.table(headings_style=HEAD, text_align="LEFT", v_align="TOP", **layout) as grid:
            for row in shown:
                line = grid.row()
                for text in row:
                    line.cell(text)


def shortened(text: str) -> str:
    """A cell as one reads it."""
    return text.partition(":")[2] if REFERENCE.fullmatch(text) else text


def widths(rows: Sequence[tuple[str, ...]]) -> tuple[int, ...]:
    """The columns' shares: by their longest lines, but a long one does not starve the others."""
    longest = [
        max(len(line) for cell in column for line in (cell.splitlines() or [""]))
        for column in zip(*rows, strict=True)
    ]
    return tuple(min(max(length, NARROW), WIDE) for length in longest)


def add_table(paper: Paper, table: Table) -> None:
    """A table, or the begin of a long one."""
    paper.heading(table.title, 10, 1)
    if table.note:
        paper.plain(table.note)
    if table.rows:
        paper.rows(table.columns, table.rows[:ROWS])
    if len(table.rows) > ROWS:
        paper.plain(f"{len(table.rows) - ROWS} more rows are on the site and in the JSON.")


def add_part(paper: Paper, part: Part) -> None:
    """A part, from a new page on."""
    paper.add_page()
    paper.heading(part.title, 15, 0)
    for name, value in part.summary.items():
        paper.plain(f"{name}: {value}")
    if part.text:
        paper.ln(2)
        paper.plain(part.text)
    for table in part.tables:
        add_table(paper, table)


def add_cover(paper: Paper, made: Assembled, source: str, stamp: Mapping[str, str]) -> None:
    """What this is, of what, and what it has."""
    paper.heading(f"{made.product}: what shows that it is right", 20, 0)
    paper.plain(source)
    paper.plain(f"Source, SHA-256: {stamp['tree']}")
    paper.ln(3)
    for problem in made.problems:
        paper.plain(f"Problem: {problem}")
    rows = [(part.title, "\n".join(map(": ".join, part.summary.items()))) for part in made.parts]
    paper.rows(("Part", "Figures"), rows)


def summary_pdf(path: Path, made: Assembled, stamp: Mapping[str, str], seconds: int) -> None:
    """Write the summary."""
    when = datetime.fromtimestamp(seconds, UTC)
    source = f"Commit {stamp['commit']}, {when:%Y-%m-%d %H:%M UTC}"
    if not stamp["commit"]:
        source = "From an archive, without a commit"
    paper = Paper(f"{made.product} evidence, source {stamp['tree'][:16]}", when)
    add_cover(paper, made, source, stamp)
    for part in made.parts:
        add_part(paper, part)
    write_bytes(path, bytes(paper.output()))
