# SPDX-License-Identifier: Apache-2.0
"""What the receivers of the radio and of the satellites send: a frame of SBUS, a NAV-PVT of UBX.

Nothing but the standard library is in here, so that tests of other parts can use it.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

SBUS_CHANNELS = 16
SBUS_FAILSAFE = 0x08
SBUS_LEAST_US, SBUS_STEP_US, SBUS_MIDDLE = 880.0, 0.625, 992

# Time of week; date and time, and what of them holds; their accuracy; kind of fix, flags,
# satellites; longitude, latitude, two heights; accuracies; velocities, speed, course; accuracies
# of these; dilution of precision, flags; heading and declination.
NAV_PVT = struct.Struct("<I H6B I i 4B 4i 2I 5i 2I 2H 4x i h H")
WEEK_MS = 604_800_000

# When a flight begins, and that the receiver is sure of it.
BEGUN = datetime(2026, 11, 24, 12, tzinfo=UTC)
DATED = 0x07


def sbus(pulses_us: Sequence[int], failsafe: bool = False) -> bytes:
    """A frame whose first channels have these pulses; the others are in the middle."""
    channels = [round((pulse - SBUS_LEAST_US) / SBUS_STEP_US) for pulse in pulses_us]
    channels += [SBUS_MIDDLE] * (SBUS_CHANNELS - len(channels))
    number = sum(value << (11 * index) for index, value in enumerate(channels))
    flags = SBUS_FAILSAFE if failsafe else 0
    return bytes([0x0F]) + number.to_bytes(22, "little") + bytes([flags, 0])


def ubx(group: int, identity: int, payload: bytes) -> bytes:
    """A message of UBX."""
    body = struct.pack("<2BH", group, identity, len(payload)) + payload
    first = second = 0
    for byte in body:
        first = (first + byte) % 256
        second = (second + first) % 256
    return b"\xb5\x62" + body + bytes([first, second])


def nav_pvt(
    tow_ms: int,
    degrees: tuple[float, float],
    height_m: float,
    speed: tuple[float, float, float],
    accuracy_m: float,
    speed_accuracy: float,
    is_fixed: bool = True,
) -> bytes:
    """A fix: latitude and longitude, height above the sea, velocity north, east and down in m/s."""
    latitude, longitude = (round(1e7 * angle) for angle in degrees)
    north, east, down = (round(1e3 * part) for part in speed)
    height, place, pace = (round(1e3 * part) for part in (height_m, accuracy_m, speed_accuracy))
    kind, flags, satellites = (3, 1, 14) if is_fixed else (0, 0, 0)
    now = BEGUN + timedelta(milliseconds=tow_ms)
    second = (now + timedelta(milliseconds=500)).replace(microsecond=0)  # The nearest one.
    nano = 1000 * round((now - second) / timedelta(microseconds=1))
    payload = NAV_PVT.pack(
        tow_ms % WEEK_MS, second.year, second.month, second.day, second.hour, second.minute,
        second.second, DATED, 50, nano, kind, flags, 0, satellites,
        longitude, latitude, height, height, place, place, north, east, down,
        round((north**2 + east**2) ** 0.5), 0, pace, 0, 150, 0, 0, 0, 0,
    )  # fmt: skip
    return ubx(0x01, 0x07, payload)
