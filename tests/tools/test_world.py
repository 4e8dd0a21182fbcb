# SPDX-License-Identifier: Apache-2.0
"""The Earth's field by place, held against the World Magnetic Model and against what is
published.
"""

from __future__ import annotations

import ctypes
import json
import math
import random
import sys
import unittest
from pathlib import Path
from typing import ClassVar

from copter_shim import copter_of

from keel.base.run import output_of

ROOT = Path(__file__).resolve().parents[2]

SHIM = """\
#include "wmm.h"
void field(int latitude, int longitude, double *out)
{
    const copter_wmm_field_t found = copter_wmm_field(latitude, longitude);
    out[0] = found.north; out[1] = found.east; out[2] = found.down;
}
"""
MODEL = """\
import json, sys
from pygeomag import GeoMag
model = GeoMag(coefficients_file="wmm/WMM_2025.COF")
year, places = float(sys.argv[1]), json.loads(sys.argv[2])
found = [model.calculate(glat=a, glon=b, alt=0, time=year) for a, b in places]
print(json.dumps([(one.x / 1e3, one.y / 1e3, one.z / 1e3) for one in found]))
"""
# Declination in degrees, inclination in degrees and strength in uT of some towns in the middle of
# 2027, by IGRF-14 (International Association of Geomagnetism and Aeronomy), another model of other
# authors, evaluated with ppigrf 2.1.0.
TOWNS = {
    "Zurich": (47.3977, 8.5456, 3.73, 63.52, 48.42),
    "Singapore": (1.3521, 103.8198, 0.27, -12.67, 42.08),
    "Cape Town": (-33.9249, 18.4241, -26.92, -64.49, 24.94),
    "Tromso": (69.6492, 18.9553, 11.47, 78.46, 53.93),
    "Sao Paulo": (-23.5505, -46.6333, -21.96, -41.18, 22.78),
    "Sydney": (-33.8688, 151.2093, 12.82, -64.38, 56.94),
    "Denver": (39.7392, -104.9903, 7.43, 65.80, 50.90),
    "Tokyo": (35.6762, 139.6503, -7.97, 49.57, 46.91),
    "Nairobi": (-1.2921, 36.8219, 0.20, -22.39, 33.50),
}
Vector = tuple[float, float, float]


def declination(field: Vector) -> float:
    """In degrees, east positive."""
    return math.degrees(math.atan2(field[1], field[0]))


def inclination(field: Vector) -> float:
    """In degrees, down positive."""
    return math.degrees(math.atan2(field[2], math.hypot(field[0], field[1])))


def apart(one: float, other: float) -> float:
    """Of two angles, in degrees."""
    return abs((one - other + 180.0) % 360.0 - 180.0)


class World(unittest.TestCase):
    """The table and what lies between its places."""

    library: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.library = copter_of(cls, SHIM)

    def field(self, latitude: float, longitude: float) -> Vector:
        """Of the code, in uT."""
        out = (ctypes.c_double * 3)()
        self.library.field(round(latitude * 1e7), round(longitude * 1e7), out)
        return out[0], out[1], out[2]

    @staticmethod
    def model(places: list[tuple[float, float]], year: float = 2027.5) -> list[Vector]:
        """Of the model, in uT."""
        asked = json.dumps(places)
        command = [
            sys.executable,
            ROOT / "tools/keel",
            "with",
            "world",
            "-c",
            MODEL,
            str(year),
            asked,
        ]
        said = output_of(command)
        return [(one[0], one[1], one[2]) for one in json.loads(said.splitlines()[-1])]

    @staticmethod
    def places() -> list[tuple[float, float]]:
        """Drawn evenly between 65 degrees south and north."""
        drawn = random.Random(1)
        most = math.sin(math.radians(65.0))
        return [
            (
                round(math.degrees(math.asin(drawn.uniform(-most, most))), 4),
                round(drawn.uniform(-180, 180), 4),
            )
            for _ in range(3000)
        ]

    def test_between_the_places_of_the_table(self) -> None:
        places = self.places()
        errors, dips, strengths = [], [], []
        for place, true in zip(places, self.model(places), strict=True):
            found = self.field(*place)
            if math.hypot(true[0], true[1]) >= 8.0:
                errors.append(apart(declination(found), declination(true)))
                dips.append(abs(inclination(found) - inclination(true)))
                strengths.append(abs(math.hypot(*found) / math.hypot(*true) - 1.0))
        self.assertGreater(len(errors), 2900)
        self.assertLess(max(errors), 1.2)
        self.assertLess(math.sqrt(sum(one * one for one in errors) / len(errors)), 0.25)
        self.assertLess(max(dips), 1.6)
        self.assertLess(max(strengths), 0.022)

    def test_north_drifts_by_as_much_as_the_header_says(self) -> None:
        places = self.places()
        pairs = zip(self.model(places, 2025.0), self.model(places, 2029.5), strict=True)
        drifts = sorted(
            apart(declination(now), declination(then)) / 4.5
            for now, then in pairs
            if min(math.hypot(now[0], now[1]), math.hypot(then[0], then[1])) >= 8.0
        )
        self.assertLess(drifts[-1], 0.4)
        self.assertLess(drifts[len(drifts) // 2], 0.1)

    def test_at_the_places_of_the_table_it_is_the_model(self) -> None:
        places = [(float(a), float(b)) for a in range(-80, 81, 20) for b in range(-180, 180, 30)]
        for place, true in zip(places, self.model(places), strict=True):
            for one, other in zip(self.field(*place), true, strict=True):
                self.assertAlmostEqual(one, other, delta=0.0016)

    def test_across_the_180th_meridian(self) -> None:
        self.assertEqual(self.field(10.0, 180.0), self.field(10.0, -180.0))
        east, west = self.field(10.0, 179.999), self.field(10.0, -179.999)
        for one, other in zip(east, west, strict=True):
            self.assertAlmostEqual(one, other, delta=0.01)

    def test_beyond_the_table_it_is_its_end(self) -> None:
        self.assertEqual(self.field(89.0, 20.0), self.field(80.0, 20.0))
        self.assertEqual(self.field(-90.0, 20.0), self.field(-80.0, 20.0))
        self.assertEqual(self.field(0.0, 200.0), self.field(0.0, 180.0))

    def test_towns_by_another_model(self) -> None:
        self.assertGreater(len(TOWNS), 5)
        for name, (latitude, longitude, east, dip, strength) in TOWNS.items():
            found = self.field(latitude, longitude)
            self.assertLess(apart(declination(found), east), 1.2, name)
            self.assertLess(abs(inclination(found) - dip), 1.6, name)
            self.assertLess(abs(math.hypot(*found) / strength - 1.0), 0.025, name)

    def test_the_table_is_what_the_tool_makes(self) -> None:
        command = [sys.executable, ROOT / "tools/keel", "world", "--check"]
        self.assertIn("is up to date", output_of(command))
