# SPDX-License-Identifier: Apache-2.0
"""Reads recordings out of logs: of PX4, and of this copter."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from keel.base.errors import ToolError
from keel.replay.recording import Recording, Series, checked, unit_quaternions
from keel.timeline import ulog

INVALID = np.iinfo(np.int32).max  # What PX4 has for a time that is none.
LEAST_HZ = 50.0  # A unit that was logged more seldom is no recording of it.
MICRO = 1e-6
RUNNING = 2  # KEEL_ATTITUDE_RUNNING.
GAUSS = 100.0  # In uT.


class Topics:
    """A log, and what its topics have."""

    def __init__(self, path: Path) -> None:
        self.path, self.log = path, ulog.read(path)
        for damage in self.log.damage:
            raise ToolError(f"{path}: byte {damage.at}: {damage.reason}")

    def data(self, name: str, instance: int = 0) -> Any:
        """A topic's rows, of which there are two at least; or None."""
        rows = self.log.data.get((name, instance))
        return rows if rows is not None and len(rows) > 1 else None

    def series(
        self, name: str, fields: Sequence[str], instance: int = 0, keep: Any = None, late: str = ""
    ) -> Series | None:
        """Fields of a topic side by side; `late` names how long after its time they were so."""
        rows = self.data(name, instance)
        if rows is None:
            return None
        missing = [one for one in fields if one not in rows.dtype.names]
        if missing:
            raise ToolError(f"{self.path}: the topic {name} has no field {missing[0]}")
        rows = rows if keep is None else rows[keep(rows)]
        sampled = "timestamp_sample" in rows.dtype.names and bool(rows["timestamp_sample"].all())
        time = rows["timestamp_sample" if sampled else "timestamp"].astype(float)
        if late:
            rows, time = rows[rows[late] != INVALID], time[rows[late] != INVALID]
            time = np.maximum.accumulate(time + rows[late])  # It was told again and again.
        if len(rows) < 2:
            return None
        value = np.hstack([rows[one].reshape(len(rows), -1).astype(float) for one in fields])
        return checked(
            self.path, name, MICRO * time, value, lambda index: f"message {index} of {name}"
        )

    def quaternions(self, name: str, keep: Any = None) -> Series | None:
        """An attitude."""
        found = self.series(name, ["q"], keep=keep)
        return found and unit_quaternions(self.path, name, found)


def flat(series: Series | None, factor: float = 1.0) -> Series | None:
    """Of rows of one number these."""
    return series and Series(series.time, factor * series.value[:, 0])


def read_ulog(path: Path) -> Recording:
    """Of whom it is, is seen by its topics."""
    topics = Topics(path)
    found = keel(topics) if topics.data("imu") is not None else px4(topics)
    found.notes.insert(0, "frames are Keel's already: forward, right, down; north, east, down")
    if topics.log.cut:
        found.notes.append(f"the log was cut off: its last {topics.log.cut} bytes are left out")
    return found


def keel(topics: Topics) -> Recording:
    """The copter's log. Its samples of units are without calibration, as it gets them."""
    units = [
        one
        for number in range(3)
        if (one := topics.series("imu", ["value"], number, lambda rows: rows["present"]))
    ]
    if not units:
        raise ToolError(f"{topics.path}: the topic imu has no sample that is present")
    parameters = topics.log.parameters
    expected = None
    if "MAG_NORTH" in parameters and "MAG_EAST" in parameters:
        expected = float(parameters["MAG_NORTH"]), float(parameters["MAG_EAST"])
    place = topics.series("estimate", ["position"])
    return Recording(
        topics.path,
        units,
        field=topics.series("compass", ["raw"]),
        estimate=topics.quaternions("attitude", is_known),
        pressure=flat(topics.series("air", ["pressure_pa"])),
        height=place and Series(place.time, place.value[:, 2]),
        expected=expected,
        notes=["a log of Keel; the recorder's estimate is Keel's in flight, where it was valid"],
    )


def is_known(rows: Any) -> Any:
    """Whether tilt and heading were valid."""
    return (rows["phase"] == RUNNING) & rows["heading_valid"]


def px4(topics: Topics) -> Recording:
    """PX4's: the units by themselves if they were logged as they came, or what was made of them."""
    units = [one for number in range(4) if (one := px4_unit(topics, number))]
    note = f"{len(units)} units by sensor_gyro and sensor_accel"
    if not units:
        one = topics.series("sensor_combined", ["accelerometer_m_s2", "gyro_rad"])
        if one is None:
            raise ToolError(
                f"{topics.path}: the topic sensor_combined is missing, and so are "
                f"sensor_gyro and sensor_accel at {LEAST_HZ:g} Hz or more"
            )
        units, note = [one], "one unit: PX4's choice, sensor_combined"
    height = topics.series("vehicle_local_position", ["z"])
    return Recording(
        topics.path,
        units,
        field=px4_field(topics),
        estimate=topics.quaternions("vehicle_attitude"),
        pressure=px4_pressure(topics),
        height=flat(height, -1.0),
        fixes=px4_fixes(topics),
        notes=[f"a log of PX4; {note}; the recorder's estimate is PX4's"],
    )


def px4_unit(topics: Topics, number: int) -> Series | None:
    """A unit as it came, at its gyroscope's times."""
    gyro = topics.series("sensor_gyro", ["x", "y", "z"], number)
    accel = topics.series("sensor_accel", ["x", "y", "z"], number)
    if gyro is None or accel is None:
        return None
    for each in (gyro, accel):
        if len(each.time) < LEAST_HZ * (each.time[-1] - each.time[0]):
            return None
    force = [np.interp(gyro.time, accel.time, column) for column in accel.value.T]
    return Series(gyro.time, np.hstack([np.stack(force, 1), gyro.value]))


def px4_field(topics: Topics) -> Series | None:
    """In uT."""
    rows = topics.data("sensor_combined")
    found = topics.series("vehicle_magnetometer", ["magnetometer_ga"])
    if found is None and rows is not None and "magnetometer_ga" in rows.dtype.names:
        found = topics.series(
            "sensor_combined", ["magnetometer_ga"], late="magnetometer_timestamp_relative"
        )
    found = found or topics.series("sensor_mag", ["x", "y", "z"])
    return found and Series(found.time, GAUSS * found.value)


def px4_pressure(topics: Topics) -> Series | None:
    """In Pa; an old log has the height in the standard atmosphere instead."""
    rows = topics.data("sensor_combined")
    if rows is not None and "baro_alt_meter" in rows.dtype.names:
        old = topics.series("sensor_combined", ["baro_alt_meter"], late="baro_timestamp_relative")
        return old and Series(old.time, 101325.0 * (1.0 - old.value[:, 0] / 44330.77) ** 5.255876)
    return flat(topics.series("vehicle_air_data", ["baro_pressure_pa"]))


def px4_fixes(topics: Topics) -> Series | None:
    """What the satellite receiver told, where it had a fix."""
    rows = topics.data("vehicle_gps_position")
    if rows is None:
        return None
    old = "lat" in rows.dtype.names
    place = ["lat", "lon", "alt"] if old else ["latitude_deg", "longitude_deg", "altitude_msl_m"]
    speed = ["vel_n_m_s", "vel_e_m_s", "vel_d_m_s", "eph", "s_variance_m_s"]
    found = topics.series(
        "vehicle_gps_position", [*place, *speed], keep=lambda rows: rows["fix_type"] >= 3
    )
    scale = (1e-7, 1e-7, 1e-3) if old else (1.0, 1.0, 1.0)
    return found and Series(found.time, found.value * (*scale, 1.0, 1.0, 1.0, 1.0, 1.0))
