# SPDX-License-Identifier: Apache-2.0
"""A flight that takes little time."""

from __future__ import annotations

from pathlib import Path

from keel.flight import scenario

SHORT = """description = "up and down"
duration_s = 8.0
mode = "altitude"
wind = { speed = 3.0, turbulence = 0.2 }

[[pilot]]
at_s = 0.5
height_m = 4.0

[[pilot]]
at_s = 5.0
mode = "land"

[limits]
from_s = 0.0
tilt_max_deg = 20.0
end = { on_ground = false, motors_on = true }
"""


def short(folder: Path) -> scenario.Scenario:
    """The flight, read from a file in a folder."""
    (folder / "short.toml").write_text(SHORT)
    return scenario.read("short", folder)
