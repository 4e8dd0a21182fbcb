"""The units of Keel and the files that belong to each, found by their names."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from common.errors import ToolError

from . import csource

ROOT = Path(__file__).resolve().parents[2]
STATE = "_state.h"
# How long each job took where it was recorded, in seconds.
RECORDED_TIMES = "proofs/times.json"


class ProjectError(ToolError):
    """The tree is not as the driver needs it; the message says what to change."""


@dataclass(frozen=True)
class Unit:
    """One unit: `include/keel/LAYER/NAME.h`, `src/LAYER/NAME.c`, `proofs/NAME/`.

    A unit's state and the logic about it may stand in a header of their own, `NAME_state.h`.
    """

    root: Path
    layer: str
    name: str

    @property
    def header(self) -> Path:
        """Contract of the unit."""
        return self.root / "include" / "keel" / self.layer / f"{self.name}.h"

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

    @cached_property
    def wrong_bodies(self) -> list[Path]:
        """Wrong bodies, which the harnesses must refute."""
        files = sorted(set((self.folder / "wrong").glob("*")) - set(self.wrong_statements))
        for path in files:
            if path.suffix != ".toml":
                raise ProjectError(f"{path.relative_to(self.root)}: a wrong body is a .toml file")
        return files

    @cached_property
    def statements(self) -> list[Path]:
        """Bounds of rounding errors, for Gappa."""
        return sorted(self.folder.glob("*.g"))

    @cached_property
    def wrong_statements(self) -> list[Path]:
        """Bounds that Gappa must not prove."""
        return sorted((self.folder / "wrong").glob("*.g"))

    @property
    def own_files(self) -> list[Path]:
        """Headers and source."""
        return [path for path in (self.state, self.header, self.source) if path.is_file()]


def find_units(root: Path = ROOT) -> dict[str, Unit]:
    """All units by name, in the order of layers and names."""
    units: dict[str, Unit] = {}
    for header in sorted((root / "include" / "keel").glob("*/*.h")):
        if header.name.endswith(STATE):
            continue
        unit = Unit(root, header.parent.name, header.stem)
        if unit.name in units:
            raise ProjectError(
                f"two units are called {unit.name}: {units[unit.name].header}, {header}"
            )
        units[unit.name] = unit
    return units


def resolve(root: Path, including: Path, name: str) -> Path:
    """The project's file behind an #include with quotation marks."""
    for folder in (including.parent, root / "include"):
        if (folder / name).is_file():
            return (folder / name).resolve()
    raise ProjectError(f"{including.relative_to(root)} includes {name}, which is not there")


def closure(root: Path, files: list[Path]) -> list[Path]:
    """The files and all that they include from the project, each once, sorted."""
    seen: set[Path] = set()
    waiting = [path.resolve() for path in files]
    while waiting:
        path = waiting.pop()
        if path not in seen:
            seen.add(path)
            waiting += [resolve(root, path, name) for name in csource.includes(path.read_text())]
    return sorted(seen)
