# SPDX-License-Identifier: Apache-2.0
"""The harnesses of a project, and what each may call: who can notice a mutant of a function."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from keel.c import source as csource
from keel.c.project import Unit, closure, find_units
from keel.judge.harness import Harness, read_harness


@dataclass(frozen=True)
class Seen:
    """A harness, the files that its binary is made of, and the functions that it may call."""

    harness: Harness
    files: frozenset[Path]
    reached: frozenset[str]

    @property
    def command(self) -> list[object]:
        """How CBMC is asked about it, but for the places of files."""
        one = self.harness
        sources = [path.relative_to(one.unit.root).as_posix() for path in one.sources]
        return [
            one.name,
            one.options,
            sources,
            one.covers,
            one.defines,
            one.timeout,
            one.replaces,
            one.assertions_only,
        ]


def survey(root: Path) -> list[Seen]:
    """All harnesses of all units."""
    read = [
        read_harness(unit, path) for unit in find_units(root).values() for path in unit.harnesses
    ]
    found = []
    for harness in read:
        files = closure(root, [harness.path, *harness.sources])
        found.append(Seen(harness, frozenset(files), _reached(harness, files)))
    return found


def _reached(harness: Harness, files: Sequence[Path]) -> frozenset[str]:
    """The functions that a harness may call, in whichever of its files."""
    bodies: dict[str, str] = {}
    for path in files:
        text = csource.read(path)
        code = csource.code_only(text)
        for function in csource.defined(text):
            if function.body:
                bodies[function.name] = bodies.get(function.name, "") + code[slice(*function.body)]
    seen: set[str] = set()
    waiting = [harness.name]
    while waiting:
        for name in re.findall(r"\b\w+\b", bodies.get(waiting.pop(), "")):
            if name in bodies and name not in seen and name not in harness.replaces:
                seen.add(name)
                waiting.append(name)
    return frozenset(seen)


def in_tree(harness: Harness, root: Path) -> Harness:
    """The same harness in another tree."""
    unit = Unit(root, harness.unit.layer, harness.unit.name)
    return read_harness(unit, unit.folder / harness.path.name)
