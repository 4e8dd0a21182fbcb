# SPDX-License-Identifier: Apache-2.0
"""The part `plans`: what is verified and how, how changes and problems are handled, from docs."""

from __future__ import annotations

from keel.base.files import read_text
from keel.gather.markdown import paragraphs, sections, tables
from keel.gather.part import Context, Part, Table

PLAN = "docs/plan.md"
SECTIONS = (
    "Verification",
    "Configuration management",
    "Problem reporting",
    "Tools",
    "Roles and independence",
)
# What the plan refers to, and a reviewer without the repository asks for.
DOCUMENTS = (
    PLAN,
    "CONTRIBUTING.md",
    "SECURITY.md",
    "CHANGELOG.md",
    "specs/soundness.md",
    "docs/proved.md",
    "docs/evidence.md",
)


def tables_of(title: str, text: str) -> list[Table]:
    """The tables of a section."""
    return [
        Table(title=title, columns=tuple(rows[0]), rows=tuple(tuple(row.values()) for row in rows))
        for rows in tables(text)
        if rows
    ]


def make(context: Context) -> Part:
    """The plan, section by section, and the documents that it rests on."""
    text = read_text(context.root / PLAN)
    found = sections(text)
    problems = [f"{PLAN}: there is no section {name}" for name in SECTIONS if not found.get(name)]
    words = [f"{name}\n\n{paragraphs(found[name])}" for name in found]
    files = {name: context.root / name for name in DOCUMENTS}
    return Part(
        name="plans",
        title="Plans",
        text="\n\n".join(words),
        problems=tuple(problems),
        tables=tuple(table for name in found for table in tables_of(name, found[name])),
        files=files,
        summary={"sections": str(len(found)), "documents": str(len(files))},
    )
