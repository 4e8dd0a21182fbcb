# SPDX-License-Identifier: Apache-2.0
"""Where on the site each thing is: a page of its own, or a place on the page of its group."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable
from dataclasses import dataclass

# Of these there are thousands, or each is a line or two: so many parts of the id name their page.
GROUPED = {"goal": 1, "mutant": 1, "test": 2, "file": 1, "objective": 1, "deviation": 0}
PLACE = "site"


def slug(text: str) -> str:
    """A name that a file and an anchor can have on any system."""
    return re.sub(r"[^A-Za-z0-9_.]+", "-", text).strip("-.") or "x"


def group_of(key: str) -> str:
    """The group on whose page a thing is; empty when it has a page of its own."""
    kind, _, name = key.partition(":")
    if kind not in GROUPED:
        return ""
    parts = name.split("/")
    return "/".join([kind, *parts[: min(GROUPED[kind], len(parts) - 1)]])


@dataclass(frozen=True)
class Address:
    """A page, and a place on it; both as the browser takes them."""

    page: str  # site/NAME.html
    anchor: str = ""

    def seen_from(self, root: str) -> str:
        """The link to it from a page whose way to the package's folder is root."""
        return f"{root}{self.page}" + (f"#{self.anchor}" if self.anchor else "")


class Names:
    """Gives each name once, also where a file system takes A for a."""

    def __init__(self) -> None:
        self._given: dict[str, str] = {}

    def unique(self, wanted: str, meant: str) -> str:
        """The wanted name, or one that tells it from that of another meaning."""
        name = wanted
        if self._given.setdefault(name.lower(), meant) != meant:
            name = f"{wanted}-{hashlib.sha256(meant.encode()).hexdigest()[:8]}"
            self._given[name.lower()] = meant
        return name


def addresses(keys: Iterable[str]) -> dict[str, Address]:
    """Where each thing is."""
    pages, anchors = Names(), Names()
    found = {}
    for key in keys:
        group = group_of(key)
        page = pages.unique(slug((group or key).replace(":", "-")), group or key)
        anchor = anchors.unique(slug(key), key) if group else ""
        found[key] = Address(f"{PLACE}/{page}.html", anchor)
    return found
