# SPDX-License-Identifier: Apache-2.0
"""Writes the site of a package: HTML that needs nothing but its own files and any browser."""

from __future__ import annotations

import json
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from keel.base.files import write_text
from keel.evidence import measured
from keel.evidence.assemble import REFERENCE, Assembled, Entry
from keel.evidence.site.addresses import PLACE, Address, addresses, group_of, slug
from keel.evidence.site.model import IN_MATRIX, Model, by_kind, count, plural
from keel.evidence.site.traces import Tracer
from keel.gather.part import Part

HERE = Path(__file__).resolve().parent
ASSETS = ("style.css", "site.js")
BELOW = "../"  # From a page of the site to the package's folder.


def day(seconds: int) -> str:
    """A time as people read it, the same everywhere."""
    return datetime.fromtimestamp(seconds, UTC).strftime("%Y-%m-%d %H:%M UTC") if seconds else ""


class Site:
    """The pages of one package."""

    def __init__(
        self,
        folder: Path,
        made: Assembled,
        stamp: Mapping[str, str],
        seconds: int,
        took: Mapping[str, measured.Measured],
    ) -> None:
        self.folder = folder
        self.made = made
        self.took = took
        self.model = Model(made)
        self.places = addresses(made.entries)
        self.tracer = Tracer(self.model, self.places, BELOW)
        self.pages = Environment(
            loader=FileSystemLoader(HERE / "templates"),
            autoescape=True,
            trim_blocks=True,
            lstrip_blocks=True,
            undefined=StrictUndefined,
        )
        kinds = {kind: plural(kind) for kind in by_kind(made.entries.values())}
        self.pages.globals.update(
            made=made,
            stamp=stamp,
            time=day(seconds),
            kinds=kinds,
            plural=plural,
            count=count,
            model=self.model,
            slug=slug,
            part_names={p.name: p.title for p in made.parts},
        )
        self.pages.filters["paragraphs"] = lambda text: text.strip().split("\n\n")

    def write(self) -> None:
        """Every page."""
        for name in ASSETS:
            write_text(self.folder / PLACE / name, (HERE / name).read_text(encoding="utf-8"))
        write_text(self.folder / PLACE / "search.js", self._search())
        self._page("index.html", "index.html", "", matrix=self.model.matrix(), kinds_of=IN_MATRIX)
        for part in self.made.parts:
            self._page(
                "part.html",
                f"{PLACE}/part-{slug(part.name)}.html",
                BELOW,
                part=part,
                parted=by_kind(self._of(part)),
            )
        for kind, entries in by_kind(self.made.entries.values()).items():
            self._page(
                "kind.html", f"{PLACE}/all-{plural(kind)}.html", BELOW, kind=kind, entries=entries
            )
        self._traces()
        self._things()
        self._times()

    def _of(self, part: Part) -> list[Entry]:
        return [self.made.entries[f"{item.kind}:{item.id}"] for item in part.items]

    def _traces(self) -> None:
        """The graphs: all units, and each one."""
        drawn = Markup(self.tracer.of_all(lambda unit: f"trace-{slug(unit)}.html"))
        self._page("trace.html", f"{PLACE}/graph.html", BELOW, unit="", drawn=drawn)
        for unit in self.model.units:
            drawn = Markup(self.tracer.of_unit(unit))
            self._page(
                "trace.html", f"{PLACE}/trace-{slug(unit)}.html", BELOW, unit=unit, drawn=drawn
            )

    def _things(self) -> None:
        """A page for each thing, or for each group of them."""
        groups: dict[str, list[Entry]] = {}
        for key, entry in self.made.entries.items():
            if group := group_of(key):
                groups.setdefault(group, []).append(entry)
            elif entry.kind != "part":  # Its page is made above.
                self._page(
                    "thing.html",
                    self.places[key].page,
                    BELOW,
                    entry=entry,
                    related=self.model.related(entry),
                    drawn=Markup(self.tracer.around(entry)),
                )
        for group, entries in groups.items():
            page = self.places[entries[0].key].page
            self._page("group.html", page, BELOW, group=group, entries=entries)

    def _times(self) -> None:
        """What was measured, the longest first: the one page that is not the same every time."""
        rows = {
            name: sorted(took.items(), key=lambda one: (-one[1], one[0]))
            for name, took in self.took.items()
            if took
        }
        self._page("measured.html", measured.PAGE, BELOW, rows=rows, file=measured.FILE)

    def _page(self, template: str, page: str, root: str, **facts: Any) -> None:
        def link(key: str) -> Markup:
            """A link to a thing; its key as text where a draft has none."""
            if key not in self.places:
                return Markup('<span class="dangling">{}</span>').format(key)
            entry = self.made.entries[key]
            return Markup('<a class="id {}" href="{}">{}</a>').format(
                entry.state, self.places[key].seen_from(root), entry.id
            )

        def cell(text: str) -> str | Markup:
            """A table's cell: a link if it names a thing."""
            return link(text) if REFERENCE.fullmatch(text) else text

        def at(key: str) -> Address:
            return self.places[key]

        text = self.pages.get_template(template).render(
            root=root, link=link, cell=cell, at=at, page=page, **facts
        )
        write_text(self.folder / page, text)

    def _search(self) -> str:
        """What can be found: kind, id, title and address of each thing."""
        found = [
            [entry.kind, entry.id, entry.title, self.places[key].seen_from("")]
            for key, entry in self.made.entries.items()
        ]
        return f"window.found({json.dumps(found, ensure_ascii=False, separators=(',', ':'))});\n"


def write_site(
    folder: Path,
    made: Assembled,
    stamp: Mapping[str, str],
    seconds: int,
    took: Mapping[str, measured.Measured],
) -> None:
    """Write the site of what was assembled, and of the seconds that each part measured."""
    Site(folder, made, stamp, seconds, took).write()
