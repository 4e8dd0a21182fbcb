# SPDX-License-Identifier: Apache-2.0
"""Writes the Earth's magnetic field by place as a table in C, from the World Magnetic Model.

    python3 tools/keel world          # writes what has changed
    python3 tools/keel world --check  # only sees whether that is so

The model is WMM2025 of NOAA's National Centers for Environmental Information and the British
Geological Survey, which is in the public domain and valid from 2025 to 2030; pygeomag computes it.

Exit status: 0 when all is well, 1 when the table is stale.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from typing import Protocol

from keel.base.errors import ROOT
from keel.base.files import write_text

TABLE = ROOT / "examples/copter/wmm_table.c"

# The middle of the model's years.
YEAR = 2027.5
STEP_DEG = 10
LATITUDES = range(-80, 81, STEP_DEG)
LONGITUDES = range(-180, 180, STEP_DEG)
UNIT_NT = 3  # What an int16_t counts: up to 98 uT.

Vector = tuple[float, float, float]

HEAD = """\
/* SPDX-License-Identifier: Apache-2.0 */
/* Made by tools/keel world. The Earth's field at sea level in the middle of {year:.0f}, by WMM2025
 * (NOAA, BGS): rows are latitudes from -80 degrees, columns longitudes from -180 degrees, {step}
 * apart; north, east and down in {unit} nT. */
#include "wmm.h"

const int16_t copter_wmm_table[COPTER_WMM_ROWS][COPTER_WMM_COLUMNS][3] = {{
"""


class Model(Protocol):
    """North, east and down at a place, in nT."""

    def __call__(self, latitude: float, longitude: float) -> Vector: ...


def wmm() -> Model:
    """The World Magnetic Model, at sea level."""
    from pygeomag import GeoMag

    found = GeoMag(coefficients_file="wmm/WMM_2025.COF")

    def field(latitude: float, longitude: float) -> Vector:
        here = found.calculate(glat=latitude, glon=longitude, alt=0, time=YEAR)
        return float(here.x), float(here.y), float(here.z)

    return field


def rows(model: Model) -> list[list[tuple[int, ...]]]:
    """The table's numbers."""
    return [
        [
            tuple(round(part / UNIT_NT) for part in model(latitude, longitude))
            for longitude in LONGITUDES
        ]
        for latitude in LATITUDES
    ]


def text_of(table: Sequence[Sequence[Sequence[int]]]) -> str:
    """The file in C, as the formatter leaves it."""
    head = HEAD.format(year=math.floor(YEAR), step=STEP_DEG, unit=UNIT_NT)
    lines = [f"{head}    /* clang-format off */"]
    for row in table:
        cells = ["{" + ", ".join(map(str, cell)) + "}" for cell in row]
        body = ",\n     ".join(
            ", ".join(cells[place : place + 4]) for place in range(0, len(cells), 4)
        )
        lines.append("    {" + body + "},")
    return "\n".join([*lines, "    /* clang-format on */", "};", ""])


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--check", action="store_true", help="only see whether it is up to date")
    options = parser.parse_args(arguments)
    shown = TABLE.relative_to(ROOT)
    text = text_of(rows(wmm()))
    if TABLE.is_file() and TABLE.read_text(encoding="utf-8") == text:
        print(f"world: {shown} is up to date")
        return 0
    if options.check:
        print(f"world: {shown} is stale: run make generate NAME=tables", file=sys.stderr)
        return 1
    write_text(TABLE, text)
    print(f"world: {shown} written")
    return 0
