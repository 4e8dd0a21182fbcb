# SPDX-License-Identifier: Apache-2.0
"""Reads recordings: npz and CSV as docs/replay.md has them. Refusals tell the place."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from keel.base.errors import ToolError, unknown
from keel.base.files import read_text
from keel.replay import ulogs
from keel.replay.recording import FLAT, Recording, Series, begun, checked, unit_quaternions

ARRAYS = {
    "rate_hz": 0,
    "gyroscope": 3,
    "accelerometer": 3,
    "magnetometer": 3,
    "reference": 4,
    "moving": 0,
    **{f"unit_{number}": 7 for number in range(1, 5)},
}
COLUMN = re.compile(
    r"(?P<plain>time_s|moving|pressure_pa|mag_[xyz]_ut|ref_[wxyz])"
    r"|(?P<sensor>accel_[xyz]_m_s2|gyro_[xyz]_(?:rad|deg)_s)(?:_(?P<unit>[1-4]))?"
)
SUFFIXES = (".npz", ".csv", ".ulg")


def flat_turn(quaternions: Any) -> Any:
    """The same turn between frames whose y and z axes point the other way."""
    return quaternions * (1.0, 1.0, -1.0, -1.0)


def row_of(index: int) -> str:
    """A row of an array."""
    return f"row {index}"


def read(path: Path, frame: str = "frd") -> Recording:
    """A recording of any kind."""
    kinds: dict[str, Callable[[], Recording]] = {
        ".npz": lambda: read_npz(path),
        ".csv": lambda: read_csv(path, frame),
        ".ulg": lambda: ulogs.read_ulog(path),
    }
    if path.suffix not in kinds:
        raise ToolError(f"{path}: is none of {', '.join(SUFFIXES)}")
    return begun(kinds[path.suffix]())


def arrays_of(path: Path) -> dict[str, Any]:
    """All arrays of a file, of the shapes that they must have."""
    content = BytesIO(path.read_bytes())
    try:
        with np.load(content, allow_pickle=False) as file:
            arrays = {name: np.asarray(file[name]) for name in file.files}
    except Exception as error:  # A damaged archive or header makes its readers raise anything.
        raise ToolError(f"{path}: is no whole npz: {error}") from error
    for name, array in arrays.items():
        if name not in ARRAYS:
            raise ToolError(f"{path}: {unknown('array', name, ARRAYS)}")
        dimensions = 0 if name == "rate_hz" else 2 if ARRAYS[name] else 1
        if array.ndim != dimensions or (ARRAYS[name] and array.shape[1] != ARRAYS[name]):
            rows = "no dimension" if not dimensions else f"rows of {ARRAYS[name] or 1}"
            raise ToolError(f"{path}: {name}: expected {rows}, found the shape {array.shape}")
        if array.dtype.kind not in "biuf":
            raise ToolError(f"{path}: {name}: expected numbers, found {array.dtype}")
    return arrays


def read_npz(path: Path) -> Recording:
    """Forward, left, up: at rest the accelerometer's z is +g."""
    arrays = arrays_of(path)
    note = "read as forward, left, up with z up in the Earth's frame; turned to Keel's frames"
    many = sorted(name for name in arrays if name.startswith("unit_"))
    if many:
        units = [units_row(path, name, arrays[name]) for name in many]
        return Recording(path, units, notes=[note])
    for name in ("rate_hz", "gyroscope", "accelerometer"):
        if name not in arrays:
            raise ToolError(f"{path}: the array {name} is missing (nor is there unit_1)")
    rate = float(arrays["rate_hz"])
    if not 1.0 <= rate <= 100_000.0:
        raise ToolError(f"{path}: rate_hz: {rate:g}, expected 1 to 100000")
    time = np.arange(len(arrays["gyroscope"])) / rate
    rows = [arrays[name] * FLAT for name in ("accelerometer", "gyroscope")]
    if len(rows[0]) != len(rows[1]):
        raise ToolError(f"{path}: accelerometer has {len(rows[0])} rows, gyroscope {len(rows[1])}")
    found = Recording(
        path,
        [checked(path, "accelerometer or gyroscope", time, np.hstack(rows), row_of)],
        notes=[note],
    )
    if "magnetometer" in arrays:
        found.field = checked(path, "magnetometer", time, arrays["magnetometer"] * FLAT, row_of)
    if "reference" in arrays:
        found.reference = reference_of(path, time, flat_turn(arrays["reference"]), row_of)
    if "moving" in arrays:
        found.moving = checked(path, "moving", time, arrays["moving"], row_of)
    return found


def units_row(path: Path, name: str, array: Any) -> Series:
    """One of several units."""
    value = np.hstack([array[:, 1:4] * FLAT, np.radians(array[:, 4:7].astype(float)) * FLAT])
    return checked(path, name, array[:, 0], value, row_of)


def reference_of(path: Path, time: Any, value: Any, place: Callable[[int], str]) -> Series | None:
    """Quaternions; those that are NaN altogether were not seen."""
    if len(time) != len(value):
        raise ToolError(f"{path}: reference: {len(value)} rows, but {len(time)} times")
    rows = np.flatnonzero(~np.isnan(value).all(1))
    if len(rows) < 2:
        return None

    def there(index: int) -> str:
        return place(int(rows[index]))

    found = checked(path, "reference", time[rows], value[rows], there)
    return unit_quaternions(path, "reference", found)


def numbers_of(path: Path) -> tuple[list[str], Any]:
    """A CSV's header and numbers; an empty cell is NaN."""
    lines = csv.reader(read_text(path).splitlines())
    header = [name.strip() for name in next(lines, [])]
    for column, name in enumerate(header, 1):
        if not COLUMN.fullmatch(name):
            known = [
                "time_s",
                "accel_x_m_s2",
                "gyro_x_rad_s",
                "gyro_x_deg_s",
                "mag_x_ut",
                "ref_w",
                "moving",
                "pressure_pa",
            ]
            raise ToolError(f"{path}:1: column {column}: {unknown('column', name, known)}")
        if header.index(name) + 1 < column:
            raise ToolError(f"{path}:1: column {column}: {name} once more")
    rows = []
    for line, cells in enumerate(lines, 2):
        if len(cells) != len(header):
            raise ToolError(f"{path}:{line}: {len(cells)} cells, but {len(header)} columns")
        rows.append(
            [number_of(path, line, name, cell) for name, cell in zip(header, cells, strict=True)]
        )
    return header, np.array(rows, float).reshape(len(rows), len(header))


def number_of(path: Path, line: int, name: str, cell: str) -> float:
    """A cell's number, or NaN when it is empty."""
    text = cell.strip()
    if not text:
        return math.nan
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ToolError(f"{path}:{line}: {name}: {text[:40]!r} is no finite number")
    return value


class Table:
    """A CSV's columns."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self.header, self._rows = numbers_of(path)
        if "time_s" not in self.header:
            raise ToolError(f"{path}:1: the column time_s is missing")
        self.time = self._rows[:, self.header.index("time_s")]

    def has(self, names: list[str]) -> bool:
        """Whether a group of columns is there: all or none."""
        there = [name for name in names if name in self.header]
        if there and len(there) < len(names):
            missing = next(name for name in names if name not in there)
            raise ToolError(f"{self._path}:1: the column {missing} is missing beside {there[0]}")
        return bool(there)

    def series(self, names: list[str], turn: Callable[[Any], Any] = lambda rows: rows) -> Series:
        """A group of columns, without the lines in which all of it is empty."""
        value = self._rows[:, [self.header.index(name) for name in names]]
        rows = np.flatnonzero(~np.isnan(value).all(1))
        return checked(
            self._path,
            f"{names[0]} or one beside it",
            self.time[rows],
            turn(value[rows]),
            lambda index: f"line {rows[index] + 2}",
        )


def sensor_columns(suffix: str, unit: str) -> list[str]:
    """The six of a unit."""
    return [
        f"{sensor}_{axis}_{unit if sensor == 'gyro' else 'm_s2'}{suffix}"
        for sensor in ("accel", "gyro")
        for axis in "xyz"
    ]


def unit_of(table: Table, suffix: str, axes: Any) -> Series | None:
    """A unit's columns, whatever its rates are in; None when it is not there."""
    for unit, scale in (("rad_s", 1.0), ("deg_s", math.pi / 180.0)):
        names = sensor_columns(suffix, unit)
        if any(name in table.header for name in names[3:]) and table.has(names):
            found = table.series(names)
            return Series(found.time, found.value * np.concatenate([axes, scale * axes]))
    return None


def read_csv(path: Path, frame: str) -> Recording:
    """In Keel's frames, or in forward, left, up with z up in the Earth's frame."""
    table = Table(path)
    axes = FLAT if frame == "flu" else np.ones(3)
    units = [
        unit
        for suffix in ("", "_1", "_2", "_3", "_4")
        if (unit := unit_of(table, suffix, axes)) is not None
    ]
    if not units:
        raise ToolError(
            f"{path}:1: the columns {', '.join(sensor_columns('', 'rad_s'))} are "
            "missing, with and without a unit's number"
        )
    found = Recording(path, units, notes=[f"read as {frame.upper()} by --frame"])
    if table.has(names := [f"mag_{axis}_ut" for axis in "xyz"]):
        found.field = table.series(names, lambda rows: rows * axes)
    if table.has(names := [f"ref_{axis}" for axis in "wxyz"]):
        seen = table.series(names, flat_turn if frame == "flu" else lambda rows: rows)
        found.reference = unit_quaternions(path, "the reference", seen)
    if "moving" in table.header:
        found.moving = table.series(["moving"], lambda rows: rows[:, 0])
    if "pressure_pa" in table.header:
        found.pressure = table.series(["pressure_pa"], lambda rows: rows[:, 0])
    return found
