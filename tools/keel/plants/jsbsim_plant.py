# SPDX-License-Identifier: Apache-2.0
"""JSBSim's F450: its aerodynamics, propellers, motors, ground, sensors, atmosphere and Earth."""

from __future__ import annotations

import atexit
import ctypes
import functools
import os
import re
import shutil
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import jsbsim

from keel.base.errors import ToolError
from keel.plants.plants import (
    EAST_M,
    HOME_ALTITUDE_M,
    HOME_LATITUDE,
    HOME_LONGITUDE,
    NORTH_M,
    STEP_S,
    Airframe,
    Truth,
)

FOOT = 0.3048
LEGS_M = 0.1524 - 0.0011  # Of the centre of gravity above the ground, the springs pressed.
SETTLING = 1200  # Steps: it sinks onto its legs, and its magnetometer takes the place's field.
FLUSH = ctypes.CDLL(None).fflush
WHEELS, SKIDS = 'type="BOGEY"', 'type="STRUCTURE"'
CENTRE = re.compile(r'<contact name="Front_Center".*?<y>( 0\.0 )</y>.*?</contact>', re.DOTALL)
SIDES = {"Left": " -0.1016 ", "Right": " 0.1016 "}  # As its legs behind.
COMMANDS = ("FR", "AR", "AL", "FL")
# JSBSim's own reader says on stdout that it is told something twice.
jsbsim.FGJSBBase().debug_lvl = 0  # type: ignore[no-untyped-call]


class JsbsimPlant:
    """The F450 on the ground, its motors standing."""

    def __init__(self, airframe: Airframe, heading_deg: float) -> None:
        self._fdm = loaded(airframe)
        self._start(heading_deg)
        manager = self._fdm.get_property_manager()

        def node(name: str) -> Any:
            found = manager.get_node(name)
            if found is None:
                raise ToolError(f"JSBSim's F450 has no property {name}")
            return found

        def readers(*names: str) -> list[Callable[[], float]]:
            return [node(name).get_double_value for name in names]

        self._inertial = readers(
            *(f"sensor/imu/accel{axis}_true_mps2" for axis in "XYZ"),
            *(f"sensor/imu/gyro{axis}_rps" for axis in "XYZ"),
        )
        self._field = readers(*(f"sensor/imu/mag{axis}_nT" for axis in "XYZ"))
        (self._pressure,) = readers("sensor/baro/presStatic_true_Pa")
        self._place = readers("position/lat-geod-deg", "position/long-gc-deg", "position/h-sl-ft")
        self._speed = readers(*(f"velocities/v-{way}-fps" for way in ("north", "east", "down")))
        self._angles = readers("attitude/phi-rad", "attitude/theta-rad", "attitude/psi-rad")
        self._commands = [node(f"fcs/cmd{name}_ext_nd").set_double_value for name in COMMANDS]
        self._wind = [
            node(f"atmosphere/wind-{way}-fps").set_double_value for way in ("north", "east", "down")
        ]
        self._run = self._fdm.run
        for _ in range(SETTLING):
            self._run()

    def _start(self, heading_deg: float) -> None:
        """Put it on the ground."""
        conditions = {
            "ic/lat-geod-deg": HOME_LATITUDE,
            "ic/long-gc-deg": HOME_LONGITUDE,
            "ic/terrain-elevation-ft": HOME_ALTITUDE_M / FOOT,
            "ic/h-agl-ft": LEGS_M / FOOT,
            "ic/psi-true-deg": heading_deg,
        }
        for name, value in conditions.items():
            self._fdm.set_property_value(name, value)
        if not self._fdm.run_ic():
            raise ToolError("JSBSim does not accept where the F450 begins")
        for number in range(4):
            self._fdm.set_property_value(f"propulsion/engine[{number}]/set-running", 1.0)

    def step(self, motors: Sequence[float]) -> None:
        """1 ms."""
        for command, motor in zip(self._commands, motors, strict=True):
            command(motor)
        self._run()

    def inertial(self) -> list[float]:
        """What its accelerometer and its gyroscope would say if they were perfect."""
        return [read() for read in self._inertial]

    def field(self) -> list[float]:
        """In microtesla."""
        return [1e-3 * read() for read in self._field]

    def pressure(self) -> float:
        """In Pa."""
        return self._pressure()

    def truth(self) -> Truth:
        """From its geodetic position."""
        latitude, longitude, height = (read() for read in self._place)
        north, east, down = (FOOT * read() for read in self._speed)
        place = (
            NORTH_M * (latitude - HOME_LATITUDE),
            EAST_M * (longitude - HOME_LONGITUDE),
            FOOT * height - HOME_ALTITUDE_M - LEGS_M,
        )
        roll, pitch, yaw = (read() for read in self._angles)
        return Truth(place, (north, east, -down), (roll, pitch, yaw), latitude, longitude)

    def blow(self, north: float, east: float, down: float) -> None:
        """Its atmosphere takes feet per second."""
        for set_wind, value in zip(self._wind, (north, east, down), strict=True):
            set_wind(value / FOOT)


def loaded(airframe: Airframe) -> Any:
    """JSBSim with the F450 in it; it tells more on stdout than anybody wants."""
    folder = described(airframe)
    with quiet():
        fdm = jsbsim.FGFDMExec(str(folder))
        fdm.set_debug_level(0)
        fdm.set_dt(STEP_S)
        if not fdm.load_model("F450"):
            raise ToolError("JSBSim does not load its F450")
    return fdm


class quiet:
    """Nothing that a library in C++ writes reaches stdout, not even later, from its buffer."""

    def __enter__(self) -> None:
        FLUSH(None)
        self._kept = os.dup(1)
        self._null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(self._null, 1)

    def __exit__(self, *_: object) -> None:
        FLUSH(None)
        os.dup2(self._kept, 1)
        os.close(self._kept)
        os.close(self._null)


@functools.lru_cache(maxsize=4)
def described(airframe: Airframe) -> Path:
    """A folder with the F450's files, changed as the airframe differs.

    It stands on three wheels, and the wind rolls it away or blows it over an edge that is 4.5 cm
    from its centre. Here it stands on four skids, as the aircraft does: JSBSim's way to find where
    it rests, for which its authors took one leg, is not asked.
    """
    own = Path(jsbsim.__file__).parent
    folder = Path(tempfile.mkdtemp(prefix="keel-f450-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    shutil.copytree(own / "aircraft/F450", folder / "aircraft/F450")
    (folder / "engine").mkdir()
    (folder / "systems").symlink_to(own / "systems")
    frame = folder / "aircraft/F450"
    gear = frame / "Gear.xml"
    gear.write_text(on_skids(gear.name, gear.read_text()))
    scaled(frame / "Mass.xml", frame / "Mass.xml", r'<emptywt unit="KG">', airframe.mass)
    for axis, metres in (("x", -airframe.forward_m), ("y", airframe.right_m)):  # x points aft.
        moved(frame / "Mass.xml", rf'<location name="CG" unit="M">.*?<{axis}>', metres)
    for axis in ("ixx", "iyy", "izz"):
        scaled(frame / "Mass.xml", frame / "Mass.xml", rf'<{axis} unit="KG\*M2">', airframe.inertia)
    scaled(frame / "Metrics.xml", frame / "Metrics.xml", r'<wingarea unit="M2">', airframe.drag)
    motor, propeller = "engine/DJI_E305.xml", "engine/DJI_9450.xml"
    scaled(own / motor, folder / motor, "<velocityconstant>", airframe.motor_speed)
    scaled(own / propeller, folder / propeller, r'<ixx unit="KG\*M2">', airframe.motor_lag)
    return folder


def on_skids(name: str, legs: str) -> str:
    """Its ground reactions with a skid at each corner."""
    centre = CENTRE.search(legs)
    if WHEELS not in legs or not centre:
        raise ToolError(f"{name} of JSBSim's F450 has no {WHEELS}, or no Front_Center")
    front = [
        centre[0].replace("Center", side).replace(centre[1], away) for side, away in SIDES.items()
    ]
    return legs.replace(centre[0], "\n\t".join(front)).replace(WHEELS, SKIDS)


def scaled(source: Path, target: Path, before: str, factor: float) -> None:
    """A file with the number behind a text multiplied."""
    target.write_text(changed(source, before, lambda number: factor * number))


def moved(path: Path, before: str, by: float) -> None:
    """A file with something added to the number behind a text."""
    path.write_text(changed(path, before, lambda number: number + by))


def changed(source: Path, before: str, change: Callable[[float], float]) -> str:
    """A file's text with the one number behind a text changed."""
    text, count = re.subn(
        rf"({before}\s*)([-+.\deE]+)",
        lambda match: f"{match[1]}{change(float(match[2]))!r}",
        source.read_text(),
        flags=re.DOTALL,
    )
    if count != 1:
        raise ToolError(f"{source.name} of JSBSim's F450 has {count} times {before}")
    return text
