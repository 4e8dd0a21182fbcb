# SPDX-License-Identifier: Apache-2.0
"""The units of a project and the files that belong to each, found by their names.

The project is Keel, or one that uses Keel and is laid out alike: `include/LAYER/NAME.h`,
`src/LAYER/NAME.c`, `proofs/NAME/`. Headers and sources of Keel are then found in Keel.

A header has the contracts of its functions, or leaves them to `include/internal/LAYER/NAME.h`,
which declares the functions again, with their contracts. A unit that no user calls may have the
latter alone.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from keel.base.errors import ToolError
from keel.c import source as csource

KEEL = Path(__file__).resolve().parents[3]
STATE = "_state.h"
INTERNAL = "internal"
# How long each job took where it was recorded, in seconds.
RECORDED_TIMES = "proofs/times.json"


class ProjectError(ToolError):
    """The tree is not as the driver needs it; the message says what to change."""


@dataclass(frozen=True)
class Unit:
    """One unit: `include/PACKAGE/LAYER/NAME.h`, `src/LAYER/NAME.c`, `proofs/NAME/`.

    Its contracts may stand in `include/PACKAGE/internal/LAYER/NAME.h`.

    A unit's state and the logic about it may stand in a header of their own, `NAME_state.h`.
    """

    root: Path
    layer: str
    name: str
    package: str = "keel"

    @property
    def prefix(self) -> str:
        """What the names of public functions start with, and those of their models do not."""
        return f"{self.package}_" if self.package else ""

    @property
    def header(self) -> Path:
        """The header that users include, or the only one of a unit that none calls."""
        path = self.root / "include" / self.package / self.layer / f"{self.name}.h"
        return path if path.is_file() or not self.internal.is_file() else self.internal

    @property
    def internal(self) -> Path:
        """The contracts of the unit, and the functions that no user calls."""
        folder = self.root / "include" / self.package / INTERNAL / self.layer
        return folder / f"{self.name}.h"

    @property
    def state(self) -> Path:
        """The unit's structure and what holds of it, where that is apart from the contracts."""
        return self.header.with_name(f"{self.name}{STATE}")

    @property
    def source(self) -> Path:
        """Code of the unit; a unit of inline functions has none."""
        return self.root / "src" / self.layer / f"{self.name}.c"

    @property
    def folder(self) -> Path:
        """Proofs of the unit."""
        return self.root / "proofs" / self.name

    @property
    def goal_list(self) -> Path:
        """The goals that must be proved, no more and no fewer."""
        return self.folder / "goals.txt"

    @cached_property
    def theorems(self) -> list[Path]:
        """Extra files for WP, which call the unit through its contracts."""
        files = sorted(self.folder.glob("*.c"))
        return [path for path in files if "wp: theorem" in path.read_text()[:500]]

    @cached_property
    def harnesses(self) -> list[Path]:
        """The harnesses for CBMC."""
        return sorted(self.folder.glob("*_harness.c"))

    @property
    def wrong_list(self) -> Path:
        """Wrong bodies, which the harnesses must refute."""
        return self.folder / "wrong.toml"

    @property
    def wrong_folder(self) -> Path:
        """What holds the bounds that Gappa must not prove, a file each."""
        return self.folder / "wrong"

    @cached_property
    def statements(self) -> list[Path]:
        """Bounds of rounding errors, for Gappa."""
        return sorted(self.folder.glob("*.g"))

    @cached_property
    def wrong_statements(self) -> list[Path]:
        """Bounds that Gappa must not prove."""
        return sorted(self.wrong_folder.glob("*.g"))

    @property
    def own_files(self) -> list[Path]:
        """Headers and source."""
        return [path for path in (*self.headers, self.source) if path.is_file()]

    @property
    def headers(self) -> list[Path]:
        """Those that there are: of the state and of the unit, each with its contracts behind it."""
        words = self.internal.with_name(self.state.name)
        every = (self.state, words, self.header, self.internal)
        return [path for path in dict.fromkeys(every) if path.is_file()]


def find_units(root: Path = KEEL) -> dict[str, Unit]:
    """All units by name, in the order of layers and names."""
    package = "keel" if (root / "include" / "keel").is_dir() else ""
    units: dict[str, Unit] = {}
    folder = root / "include" / package
    headers = [*folder.glob("*/*.h"), *(folder / INTERNAL).glob("*/*.h")]
    for header in sorted(headers, key=lambda path: path.parts[-2:]):
        if header.name.endswith(STATE):
            continue
        unit = Unit(root, header.parent.name, header.stem, package)
        if units.setdefault(unit.name, unit) != unit:
            raise ProjectError(
                f"two units are called {unit.name}: {units[unit.name].header}, {header}"
            )
    return units


def include_folders(root: Path) -> list[Path]:
    """Where headers are looked for; a project that has none of Keel's takes them from Keel."""
    own = root / "include"
    return [own] if (own / "keel").is_dir() else [own, KEEL / "include"]


def include_options(root: Path) -> list[str]:
    """The same for a compiler that runs in the project's folder."""
    return [
        f"-I{os.path.relpath(path, root) if path.is_relative_to(root) else path}"
        for path in include_folders(root)
    ]


def shown(path: Path, root: Path) -> str:
    """A file as messages and keys name it, wherever project and Keel are."""
    for folder, start in ((root, ""), (KEEL, "keel:")):
        if path.is_relative_to(folder):
            return f"{start}{path.relative_to(folder)}"
    return str(path)


def find_file(root: Path, name: str) -> Path:
    """A file of the project, or else of Keel."""
    own = root / name
    return own if own.exists() or not (KEEL / name).is_file() else KEEL / name


def resolve(root: Path, including: Path, name: str, quoted: bool = True) -> Path | None:
    """The project's file behind an #include; None for a header of the compiler's own.

    The order is the preprocessor's: a header of the project hides the compiler's of that name.
    """
    if Path(name).is_absolute() or (not quoted and ".." in Path(name).parts):
        raise ProjectError(f"{shown(including, root)} includes {name}: give a place below include/")
    for folder in (*([including.parent] if quoted else []), *include_folders(root)):
        if (folder / name).is_file():
            return (folder / name).resolve()
    if not quoted:
        return None
    raise ProjectError(f"{shown(including, root)} includes {name}, which is not there")


def closure(
    root: Path, files: list[Path], included: dict[Path, list[Path]] | None = None
) -> list[Path]:
    """The files and all that they include from the project, each once, sorted.

    Who asks often, while no file changes, keeps in `included` what each file names.
    """
    known = {} if included is None else included
    seen: set[Path] = set()
    waiting = [path.resolve() for path in files]
    while waiting:
        path = waiting.pop()
        if path in seen:
            continue
        seen.add(path)
        if path not in known:
            named = csource.includes(csource.read(path))
            known[path] = [found for one in named if (found := resolve(root, path, *one))]
        waiting += known[path]
    return sorted(seen)
