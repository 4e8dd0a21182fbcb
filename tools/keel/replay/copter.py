# SPDX-License-Identifier: Apache-2.0
"""Runs a recording through the copter: its devices hold, millisecond by millisecond, what was
recorded, and its tasks do with it what they do in flight."""

from __future__ import annotations

import struct
import tempfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from keel.base.errors import ToolError
from keel.flight import device_frames
from keel.flight.library import Copter, Link
from keel.flight.receivers import SATELLITES, Receiver
from keel.replay.recording import Recording, Series

TICK_S = 0.001  # Background IMU's period.
EVERY = 2  # Of foreground IMU's.
FIELD_MS, FIELD_AT = 10, 3  # When a magnetometer, and a barometer, are asked: as in make fly.
AIR_MS, AIR_AT = 20, 7
LINK_MS = 50
AIR_CDEG = 2500
SILENT_S, SILENT_STEPS = 0.02, 5.0  # A unit is silent after so long and so many steps.
STX, STATUSTEXT, HEAD, TAIL = 0xFD, 253, 10, 2  # Of a frame of MAVLink.


@dataclass
class Track:
    """What became of a recording: a row every two milliseconds, and what the pilot was told."""

    time: Any
    view: Any
    words: list[tuple[float, str]]

    @property
    def attitude(self) -> Series:
        """From body to Earth."""
        return Series(self.time, self.view["quaternion"].astype(float))

    def since(self, time_s: float) -> Track:
        """Without what is before."""
        keep = self.time >= time_s
        return Track(self.time[keep], self.view[keep], self.words)


def stored(parameters: Mapping[str, float]) -> bytes:
    """A memory whose first slot has parameters, as bsp/common/slots.h lays it out."""
    image = b"".join(
        name.encode().ljust(16, b"\0") + struct.pack("<Bf", 0, value)
        for name, value in parameters.items()
    )
    head = struct.pack("<II", 1, len(image))
    return b"\x4b" + head + image + struct.pack("<I", zlib.crc32(head + image))


def at_ticks(unit: Series, ticks: Any) -> tuple[Any, Any]:
    """A unit's samples: the mean of each millisecond, interpolated linearly where it has fewer; and
    whether it spoke."""
    step = float(np.median(np.diff(unit.time)))
    middle = ticks - TICK_S / 2.0
    value = np.stack([np.interp(middle, unit.time, column) for column in unit.value.T], 1)
    if step < TICK_S:
        edges = np.searchsorted(unit.time, np.append(ticks - TICK_S, ticks[-1]), side="right")
        total = np.vstack([np.zeros(6), np.cumsum(unit.value, axis=0)])
        count = np.diff(edges)[:, None]
        value = np.where(count > 0, np.diff(total[edges], axis=0) / np.maximum(count, 1), value)
    place = np.searchsorted(unit.time, middle)
    inside = (place > 0) & (place < len(unit.time))
    gap = np.diff(unit.time)[np.clip(place - 1, 0, len(unit.time) - 2)]
    # A gap is silent from a step behind the sample before it to the sample behind it.
    late = middle - unit.time[np.clip(place - 1, 0, None)] > step
    return value, inside & ~((gap > max(SILENT_S, SILENT_STEPS * step)) & late)


def asked(series: Series | None, ticks: Any, every: int, phase: int) -> dict[int, Any]:
    """What a slow device says when it is asked: its last sample, if that is a new one."""
    found: dict[int, Any] = {}
    if series is None:
        return found
    last = -1
    for tick in range(phase, len(ticks), every):
        place = int(np.searchsorted(series.time, ticks[tick], side="right")) - 1
        if place > last:
            found[tick], last = series.value[place], place
    return found


def fixes_at(series: Series | None, ticks: Any) -> dict[int, bytes]:
    """What the satellite receiver sends, by its tick."""
    found: dict[int, bytes] = {}
    for time, row in zip(*series, strict=True) if series else ():
        tick = int(np.searchsorted(ticks, time))
        latitude, longitude, height, north, east, down, accuracy, pace = (float(one) for one in row)
        found[tick] = device_frames.nav_pvt(
            tick, (latitude, longitude), height, (north, east, down), accuracy, pace
        )
    return found


def texts(data: bytes) -> list[str]:
    """The texts in frames of MAVLink 2, one behind the other."""
    found = []
    while len(data) >= HEAD + TAIL and data[0] == STX:
        size = data[1]
        if int.from_bytes(data[7:10], "little") == STATUSTEXT:
            text = data[HEAD + 1 : HEAD + size][:50]
            found.append(text.rstrip(b"\0").decode("ascii", "replace"))
        data = data[HEAD + size + TAIL :]
    return found


class Replay:
    """One run of the copter. Three units are its: one recorded unit stands for all of them, beside
    two the third is silent."""

    def __init__(self, copter: Copter, recording: Recording, units: list[Series]) -> None:
        self._copter, self._recording = copter, recording
        begin = min(float(unit.time[0]) for unit in units)
        count = int(np.ceil((max(float(unit.time[-1]) for unit in units) - begin) / TICK_S)) + 1
        self.ticks = begin + TICK_S * np.arange(1, count + 1)
        chosen = [at_ticks(unit, self.ticks) for unit in units[:3]]
        if len(chosen) == 1:
            chosen *= 3
        elif len(chosen) == 2:  # Nobody else may outvote either.
            chosen.append((np.zeros_like(chosen[0][0]), np.zeros(count, bool)))
        value = np.stack([one[0] for one in chosen], 1).astype(np.float32)
        self._force, self._rate = value[:, :, :3].copy(), value[:, :, 3:].copy()
        self._spoke = np.stack([one[1] for one in chosen], 1).astype(np.uint32)
        self._field = asked(recording.field, self.ticks, FIELD_MS, FIELD_AT)
        self._air = asked(recording.pressure, self.ticks, AIR_MS, AIR_AT)
        self._fixes = fixes_at(recording.fixes, self.ticks)

    def run(self) -> Track:
        """To its end."""
        with tempfile.TemporaryDirectory(prefix="keel-replay-") as folder:
            memory = Path(folder) / "memory"
            north, east = self._recording.expected or (0.0, 0.0)
            memory.write_bytes(stored({"MAG_NORTH": north, "MAG_EAST": east}))
            self._copter.start(100, False, [Link()], memory=memory)
            return self._run()

    def _run(self) -> Track:
        copter, imu = self._copter, self._copter.sensors["imu"]
        force, rate, count = imu["accelerometer"], imu["gyroscope"], imu["count"]
        receiver = Receiver(copter.sensors, SATELLITES, np.random.Generator(np.random.PCG64(0)))
        size = copter.view_type.itemsize
        views = bytearray(size * len(self.ticks[::EVERY]))
        words: list[tuple[float, str]] = []
        for tick in range(len(self.ticks)):
            force[:], rate[:] = self._force[tick], self._rate[tick]
            count += self._spoke[tick]
            self._slow(tick, receiver)
            if status := copter.run_until(1000 * (tick + 1)):
                raise ToolError(f"the copter's scheduler refused to go on: status {status}")
            if tick % EVERY == 0:
                copter.look()
                row = size * (tick // EVERY)
                views[row : row + size] = copter.view_bytes
            if tick % LINK_MS == 0:
                now = float(self.ticks[tick])
                words += [(now, text) for text in texts(copter.receive(0))]
        view = np.frombuffer(views, copter.view_type)
        return Track(self.ticks[::EVERY], view, words)

    def _slow(self, tick: int, receiver: Receiver) -> None:
        """Magnetometer, barometer and satellites."""
        sensors = self._copter.sensors
        if tick in self._field:
            sensors["magnetometer"]["field"] = self._field[tick]
            sensors["magnetometer"]["count"] += 1
        if tick in self._air:
            sensors["barometer"]["pressure"] = self._air[tick]
            sensors["barometer"]["temperature"] = AIR_CDEG
            sensors["barometer"]["count"] += 1
        if tick in self._fixes:
            receiver.send(1000 * tick, self._fixes[tick])


def replayed(copter: Copter, recording: Recording, units: list[Series] | None = None) -> Track:
    """The copter's track of a recording, or of other units in place of its own."""
    return Replay(copter, recording, units or recording.units[:3]).run()
