# SPDX-License-Identifier: Apache-2.0
"""What receivers send: of the radio SBUS, CRSF or IBUS, of the satellites a NAV-PVT of UBX.

Nothing but the standard library is in here, so that tests of other parts can use it.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

SBUS_CHANNELS = 16
SBUS_FAILSAFE = 0x08
SBUS_LEAST_US, SBUS_STEP_US, SBUS_MIDDLE = 880.0, 0.625, 992
CRSF_SYNC, CRSF_CHANNELS, CRSF_POLYNOMIAL = 0xC8, 0x16, 0xD5
IBUS_CHANNELS, IBUS_MIDDLE_US = 14, 1500

# Time of week; date and time, and what of them holds; their accuracy; kind of fix, flags,
# satellites; longitude, latitude, two heights; accuracies; velocities, speed, course; accuracies
# of these; dilution of precision, flags; heading and declination.
NAV_PVT = struct.Struct("<I H6B I i 4B 4i 2I 5i 2I 2H 4x i h H")
WEEK_MS = 604_800_000

# When a flight begins, and that the receiver is sure of it.
BEGUN = datetime(2026, 11, 24, 12, tzinfo=UTC)
DATED = 0x07


def packed(pulses_us: Sequence[int]) -> bytes:
    """16 channels of 11 bits; those that are not given are in the middle."""
    channels = [round((pulse - SBUS_LEAST_US) / SBUS_STEP_US) for pulse in pulses_us]
    channels += [SBUS_MIDDLE] * (SBUS_CHANNELS - len(channels))
    number = sum(value << (11 * index) for index, value in enumerate(channels))
    return number.to_bytes(22, "little")


def sbus(pulses_us: Sequence[int], failsafe: bool = False) -> bytes:
    """A frame whose first channels have these pulses."""
    flags = SBUS_FAILSAFE if failsafe else 0
    return bytes([0x0F]) + packed(pulses_us) + bytes([flags, 0])


def crsf(pulses_us: Sequence[int], failsafe: bool = False) -> bytes:
    """The same of CRSF, with a status byte behind; nothing when the radio is lost."""
    content = bytes([CRSF_CHANNELS]) + packed(pulses_us) + b"\x00"
    rest = int.from_bytes(content + b"\x00", "big")
    for bit in range(8 * len(content) - 1, -1, -1):
        rest ^= ((1 << 8) | CRSF_POLYNOMIAL) << bit if rest >> (bit + 8) & 1 else 0
    return b"" if failsafe else bytes([CRSF_SYNC, len(content) + 1]) + content + bytes([rest])


def ibus(pulses_us: Sequence[int], failsafe: bool = False) -> bytes:
    """The same of IBUS, of 14 channels; nothing when the radio is lost."""
    channels = [*pulses_us, *[IBUS_MIDDLE_US] * (IBUS_CHANNELS - len(pulses_us))]
    content = b"\x20\x40" + struct.pack(f"<{IBUS_CHANNELS}H", *channels)
    return b"" if failsafe else content + struct.pack("<H", 0xFFFF - sum(content))


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
        tow_ms % WEEK_MS,
        second.year,
        second.month,
        second.day,
        second.hour,
        second.minute,
        second.second,
        DATED,
        50,
        nano,
        kind,
        flags,
        0,
        satellites,
        longitude,
        latitude,
        height,
        height,
        place,
        place,
        north,
        east,
        down,
        round((north**2 + east**2) ** 0.5),
        0,
        pace,
        0,
        150,
        0,
        0,
        0,
        0,
    )
    return ubx(0x01, 0x07, payload)
