# SPDX-License-Identifier: Apache-2.0
"""Are the numbers of the public headers what they should be? Bits, names of cases, and standards'.

Code and model read one header, so each proof of equality holds with any numbers there. A set of
bits is three or more constants, line by line, written in hexadecimal, most of which are single
bits: then all of them are, and no two of a header are equal, unless WORDS says that they are bits
of another word. Of three or more whole numbers that stand line by line no two are equal, either;
where the first is 0, they count up.
Numbers of physics and protocols are worked out here from what their standards say.
"""

from __future__ import annotations

import math
import re
import struct
import unittest
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from keel.c.declarations import macros
from keel.c.source import read
from keel.c.syntax import found, parse, written

ROOT = Path(__file__).resolve().parents[2]

HEADERS = sorted((ROOT / "include").glob("keel/*/*.h"))
# Names of bits that are told in a word of their own.
WORDS = ("KEEL_MODE_CHECK_",)
WHOLE = re.compile(r"\(?(-?(?:0x[0-9A-Fa-f]+|[0-9]+))[uU]?\)?")
FEW = 3  # A pair may be anything.
BITWISE = ("&", "|", "&=", "|=")


@dataclass(frozen=True)
class Constant:
    """A whole number with a name."""

    name: str
    text: str
    value: int
    row: int

    @property
    def is_hexadecimal(self) -> bool:
        """Whether it is written so."""
        return self.text.startswith("0x")

    @property
    def is_bit(self) -> bool:
        """Whether it is a power of two."""
        return self.value > 0 and self.value & (self.value - 1) == 0

    @property
    def word(self) -> str:
        """Which word its bit is of: one a header, and those of WORDS."""
        return next((start for start in WORDS if self.name.startswith(start)), "")


def constants(text: str) -> Iterator[Constant]:
    """The whole numbers of a header."""
    known = macros([text])
    for node in found(parse(text), "preproc_def"):
        name = written(node.child_by_field_name("name"))
        match = WHOLE.fullmatch(known[name][1]) if name in known else None
        if match:
            yield Constant(name, match[1], int(match[1], 0), node.start_point.row)


def groups(text: str) -> list[list[Constant]]:
    """Those that stand line by line, three or more."""
    every: list[list[Constant]] = []
    for one in constants(text):
        if every and one.row == every[-1][-1].row + 1:
            every[-1].append(one)
        else:
            every.append([one])
    return [group for group in every if len(group) >= FEW]


def sets(text: str) -> list[list[Constant]]:
    """The sets of bits."""
    hexadecimal = ([one for one in group if one.is_hexadecimal] for group in groups(text))
    return [
        group
        for group in hexadecimal
        if len(group) >= FEW and 2 * sum(one.is_bit for one in group) > len(group)
    ]


def equal(group: list[Constant], kind: str) -> Iterator[str]:
    """Which are equal to one before."""
    seen: dict[tuple[str, int], str] = {}
    for one in group:
        first = seen.setdefault((one.word, one.value), one.name)
        if first != one.name:
            yield f"{first} and {one.name} are one {kind}"


def uncounted(group: list[Constant]) -> Iterator[str]:
    """Which do not follow the one before, where the first is 0."""
    for one, before in zip(group[1:], group, strict=False):
        if group[0].value == 0 and one.value != before.value + 1:
            yield f"{one.name} is not one more than {before.name}"


def problems(text: str) -> list[str]:
    """What is wrong with the numbers of a header."""
    bits = [one for group in sets(text) for one in group]
    wrong = [f"{one.name} is no single bit" for one in bits if not one.is_bit]
    numbers = [line for group in groups(text) for line in equal(group, "number")]
    rows = [line for group in groups(text) for line in uncounted(group)]
    return [*wrong, *equal(bits, "bit"), *numbers, *rows]


def combined(text: str) -> set[str]:
    """The names that code combines with others bit by bit."""
    names = set()
    for node in found(parse(text), "binary_expression", "assignment_expression"):
        if written(node.child_by_field_name("operator")) in BITWISE:
            sides = [node.child_by_field_name(side) for side in ("left", "right")]
            names |= {written(one) for one in sides if one and one.type == "identifier"}
    return names


class HeadersTest(unittest.TestCase):
    """The public headers."""

    def test_the_numbers_differ_where_they_must(self) -> None:
        for header in HEADERS:
            with self.subTest(header.name):
                self.assertEqual(problems(read(header)), [])

    def test_the_twelve_checks_before_arming_are_a_set(self) -> None:
        [checks] = [
            group
            for group in sets(read(ROOT / "include/keel/flight/mode.h"))
            if group[0].name.startswith("KEEL_MODE_CHECK_")
        ]
        self.assertEqual([one.value for one in checks], [1 << bit for bit in range(12)])

    def test_what_code_takes_for_bits_is_in_a_set(self) -> None:
        known = {one.name for header in HEADERS for one in constants(read(header))}
        bits = {one.name for header in HEADERS for group in sets(read(header)) for one in group}
        taken = set()
        for path in (*ROOT.glob("src/**/*.c"), *ROOT.glob("examples/copter/*.c")):
            taken |= combined(read(path))
        self.assertGreater(len(taken & bits), 20)
        self.assertEqual(taken & known - bits, set())

    def test_bits_of_a_battery_module_leave_room_for_the_other(self) -> None:
        text = (ROOT / "include/keel/flight/battery.h").read_text("utf-8")
        [flags] = sets(text)
        first = re.findall(r"#define (\w+) .*/\*\*< Of module 0:", text)
        shifted = [one.value << 1 for one in flags if one.name in first]
        self.assertEqual(len(shifted), 4)
        self.assertFalse(set(shifted) & {one.value for one in flags})


def reversed_bits(polynomial: int, degree: int) -> int:
    """A polynomial with its lowest power first."""
    return sum(1 << (degree - 1 - bit) for bit in range(degree) if polynomial >> bit & 1)


def single(value: float) -> float:
    """The nearest number of single precision."""
    [nearest] = struct.unpack("f", struct.pack("f", value))
    return float(nearest)


def number_of(text: str) -> float:
    """The number that a constant's text says; a float's is exact."""
    plain = re.sub(r"^U?INT[0-9]+_C\((.*)\)$", r"\1", text).strip("()")
    if WHOLE.fullmatch(plain):
        return int(plain.rstrip("uU"), 0)
    digits = plain.removesuffix("f")
    return float.fromhex(digits) if digits.startswith("0x") else single(float(digits))


# ISO 2533: gravity, the gas constant of air, the temperature at sea level, and how it falls.
GRAVITY, GAS, WARMTH, LAPSE = 9.80665, 287.05287, 288.15, 0.0065
# MAVLink 2's header: magic, length, two sets of flags, sequence, system, component, message.
MAVLINK_HEADER = 1 + 1 + 2 + 1 + 1 + 1 + 3
# Its signature: the link, 48 bits of time, 48 of a hash.
MAVLINK_SIGNATURE = 1 + 6 + 6
# UBX: two bytes of sync, class, id, two of length; two of checksum behind the payload.
UBX_HEADER, UBX_SUMS = b"\xb5\x62\x01\x07" + struct.pack("<H", 92), 2
UBX_HEADER_14 = b"\xb5\x62\x01\x07" + struct.pack("<H", 84)

# What a number is by its source.
SOURCES: dict[str, float] = {
    # ISO 2533. M = WARMTH / LAPSE; 1 / (2 M).
    "KEEL_ALTITUDE_PER_LAPSE": single(LAPSE / (2 * WARMTH)),
    "KEEL_ALTITUDE_THIRD": single(1 / 3),
    "KEEL_CASCADE_GRAVITY": single(GRAVITY),
    "KEEL_CASCADE_PER_GRAVITY": single(1 / GRAVITY),
    # Bounds of states and outputs that a proof was made for, as the headers' comments say them.
    "KEEL_FILTER_LOW_STATE_LIMIT": 2**22,
    "KEEL_FILTER_HIGH_STATE_LIMIT": 2**45,
    "KEEL_FILTER_LOW_OUTPUT_LIMIT": 8 * 2**22,
    "KEEL_FILTER_HIGH_OUTPUT_LIMIT": 8 * 2**45,
    "KEEL_FILTER_LOW_ENERGY_LIMIT": 2**22 * 2**22,
    "KEEL_FILTER_HIGH_ENERGY_LIMIT": 2**45 * 2**45,
    "KEEL_PID_INTEGRAL_GAIN_LIMIT": 2**30,
    "KEEL_PID_DERIVATIVE_LIMIT": 2**70,
    "KEEL_ATTITUDE_NORM_MIN": 1 - 2.0**-12,
    "KEEL_ATTITUDE_NORM_MAX": 1 + 2.0**-12,
    "KEEL_REFERENCE_REACH": 1 + 2.0**-22,
    # A week of GPS; turns in units of 1e-7 degrees; a minute in units of 10 us; parts per million.
    "KEEL_UBX_WEEK_MS": 7 * 24 * 60 * 60 * 1000,
    "KEEL_POSITION_HALF_TURN": 180 * 10**7,
    "KEEL_POSITION_FULL_TURN": 360 * 10**7,
    "KEEL_SIGNING_MINUTE": 60 * 10**5,
    "KEEL_UTILISATION_FULL_PPM": 10**6,
    "KEEL_LOAD_FULL_PPM": 10**6,
    # Floats: the largest, and up to where all whole numbers are there.
    "KEEL_RANGE_LARGEST": (2 - 2.0**-23) * 2.0**127,
    "KEEL_POSITION_NEAR": 2**24,
    # Time wraps at 2^32 us, and half of it is the future.
    "KEEL_CLOCK_STEP_LIMIT_US": 2**31,
    "KEEL_PERIOD_LIMIT_US": 2**31,
    "KEEL_CLOCK_TIME_LIMIT_US": 2**62,
    # Two sensors of three axes.
    "KEEL_VIRTUAL_IMU_CHANNELS": 2 * 3,
    "KEEL_VIRTUAL_IMU_ACCELEROMETER": 3,
    "KEEL_VIRTUAL_IMU_ALL": 2**6 - 1,
    # DVB-S2's polynomial, CRC-16/MCRF4XX and IEEE 802.3.
    "KEEL_CRC8_POLYNOMIAL": (1 << 7) + (1 << 6) + (1 << 4) + (1 << 2) + 1,
    "KEEL_CRC8_FIRST": 0,
    "KEEL_CRC16_POLYNOMIAL": reversed_bits((1 << 12) + (1 << 5) + 1, 16),
    "KEEL_CRC16_FIRST": 2**16 - 1,
    "KEEL_CRC32_POLYNOMIAL": reversed_bits(0x04C11DB7, 32),
    "KEEL_CRC32_FIRST": 2**32 - 1,
    # CRSF: 16 channels of 11 bits, or ten bytes, with type and CRC; 64 bytes in all at most.
    "KEEL_CRSF_HEADER": 0xC8,
    "KEEL_CRSF_HEADER_ALL": 0x00,
    "KEEL_CRSF_HEADER_RECEIVER": 0xEC,
    "KEEL_CRSF_HEADER_MODULE": 0xEE,
    "KEEL_CRSF_CHANNELS": 16,
    "KEEL_CRSF_TYPE_CHANNELS": 0x16,
    "KEEL_CRSF_LENGTH_CHANNELS": 1 + 16 * 11 // 8 + 1,
    "KEEL_CRSF_TYPE_LINK": 0x14,
    "KEEL_CRSF_LENGTH_LINK": 1 + 10 + 1,
    "KEEL_CRSF_LENGTH_MIN": 1 + 1,
    "KEEL_CRSF_LENGTH_MAX": 64 - 2,
    "KEEL_FRAMING_BYTES": 64,
    # IBUS: length, command, 14 words, a sum; three words have 12 bits more: a channel.
    "KEEL_IBUS_BYTES": 1 + 1 + 14 * 2 + 2,
    "KEEL_IBUS_HEADER": 1 + 1 + 14 * 2 + 2,
    "KEEL_IBUS_COMMAND": 0x40,
    "KEEL_IBUS_WORDS": 14,
    "KEEL_IBUS_EXTRAS": 14 // 3,
    "KEEL_IBUS_CHANNELS": 14 + 14 // 3,
    "KEEL_IBUS_CHANNEL_MAX": 2**12 - 1,
    # SBUS: header, 16 channels of 11 bits, flags, end; a count is 5/8 us.
    "KEEL_SBUS_HEADER": 0x0F,
    "KEEL_SBUS_BYTES": 1 + 16 * 11 // 8 + 1 + 1,
    "KEEL_SBUS_CHANNELS": 16,
    "KEEL_SBUS_CHANNEL_MAX": 2**11 - 1,
    "KEEL_SBUS_US_MAX": 880 + (2**11 - 1) * 5 // 8,
    # MAVLink 2, and its signatures.
    "KEEL_MAVLINK_FIRST": 0xFD,
    "KEEL_MAVLINK_PAYLOAD_MAX": 2**8 - 1,
    "KEEL_MAVLINK_HEADER_BYTES": MAVLINK_HEADER,
    "KEEL_MAVLINK_CHECKSUM_BYTES": 2,
    "KEEL_MAVLINK_SIGNATURE_BYTES": MAVLINK_SIGNATURE,
    "KEEL_MAVLINK_SEAL_BYTES": 6,
    "KEEL_MAVLINK_FRAME_MAX": MAVLINK_HEADER + 255 + 2 + MAVLINK_SIGNATURE,
    "KEEL_MAVLINK_ID_MAX": 2**24 - 1,
    "KEEL_SIGNING_KEY_BYTES": 32,
    "KEEL_SIGNING_DIGEST_BYTES": 256 // 8,
    "KEEL_SIGNING_TIME_MAX": 2**48 - 1,
    "KEEL_SIGNING_TEXT_MAX": 32 + MAVLINK_HEADER + 255 + 2 + MAVLINK_SIGNATURE - 6,
    # UBX's NAV-PVT, of protocols from 15 on and of 14; fixType 3 is a fix in three dimensions.
    "KEEL_UBX_HEADER": int.from_bytes(UBX_HEADER, "little"),
    "KEEL_UBX_HEADER_14": int.from_bytes(UBX_HEADER_14, "little"),
    "KEEL_UBX_PAYLOAD": 92,
    "KEEL_UBX_PAYLOAD_LEAST": 84,
    "KEEL_UBX_BYTES": len(UBX_HEADER) + 92 + UBX_SUMS,
    "KEEL_UBX_3D": 3,
    # The longest message that is written is CFG-PRT, with a payload of 20 bytes.
    "KEEL_UBX_MESSAGE_BYTES": len(UBX_HEADER) + 20 + UBX_SUMS,
    # ULog: magic, version and time; size and kind; a dropout's two bytes; syslog's levels in ASCII.
    "KEEL_ULOG_BEGIN_BYTES": 7 + 1 + 8,
    "KEEL_ULOG_HEAD_BYTES": 2 + 1,
    "KEEL_ULOG_DROPOUT_BYTES": 2 + 1 + 2,
    "KEEL_ULOG_ERROR": ord("3"),
    "KEEL_ULOG_WARNING": ord("4"),
    "KEEL_ULOG_INFORMATION": ord("6"),
    # MS5611's data sheet: a PROM of 8 words, readings of 24 bits, 10 to 1200 mbar, -40 to 85 degC.
    "KEEL_MS5611_WORDS": 8,
    "KEEL_MS5611_READING_MAX": 2**24 - 1,
    "KEEL_MS5611_PRESSURE_MIN": 10 * 100,
    "KEEL_MS5611_PRESSURE_MAX": 1200 * 100,
    "KEEL_MS5611_TEMPERATURE_MIN": -40 * 100,
    "KEEL_MS5611_TEMPERATURE_MAX": 85 * 100,
    # A converter of 12 bits.
    "KEEL_POWER_MODULE_COUNT_MAX": 2**12 - 1,
}


# What is rounded in a direction, or to digits: least and most.
SCALE = 2 * GAS * WARMTH / GRAVITY
DIAGONAL = GRAVITY / math.sqrt(2)
CORNER = 1 - 1 / math.sqrt(2)
ROUNDED: dict[str, tuple[float, float]] = {
    "KEEL_ALTITUDE_TWICE_SCALE": (SCALE - 0.5, SCALE + 0.5),
    "KEEL_CASCADE_DIAGONAL": (DIAGONAL * (1 - 2.0**-11), DIAGONAL),
    "KEEL_REFERENCE_CORNER": (CORNER, CORNER * (1 + 2.0**-22)),
}


class SourcesTest(unittest.TestCase):
    """Numbers that somebody else decided."""

    known: dict[str, float]

    @classmethod
    def setUpClass(cls) -> None:
        every = macros([read(path) for path in HEADERS])
        cls.known = {name: number_of(every[name][1]) for name in (*SOURCES, *ROUNDED)}

    def test_numbers_are_their_sources(self) -> None:
        for name, value in SOURCES.items():
            with self.subTest(name):
                self.assertEqual(self.known[name], value)

    def test_numbers_that_are_rounded(self) -> None:
        for name, (least, most) in ROUNDED.items():
            with self.subTest(name):
                self.assertTrue(least <= self.known[name] <= most)


def header(*values: str) -> str:
    """A header with these constants, line by line."""
    return "".join(f"#define KEEL_SIDE_{chr(65 + n)} {value}\n" for n, value in enumerate(values))


class RulesTest(unittest.TestCase):
    """What the rules see."""

    def test_equal_bits(self) -> None:
        text = header("0x01u", "0x02u", "0x02u", "0x08u")
        self.assertIn("KEEL_SIDE_B and KEEL_SIDE_C are one bit", problems(text))

    def test_equal_bits_of_two_sets(self) -> None:
        text = header("0x01u", "0x02u", "0x04u")
        other = header("0x08u", "0x10u", "0x04u").replace("SIDE", "EDGE")
        self.assertEqual(problems(f"{text}\n{other}"), ["KEEL_SIDE_C and KEEL_EDGE_C are one bit"])

    def test_but_not_of_two_words(self) -> None:
        text = header("0x01u", "0x02u", "0x04u")
        self.assertEqual(problems(f"{text}\n{text.replace('KEEL_SIDE_', WORDS[0])}"), [])

    def test_what_is_no_single_bit(self) -> None:
        for wrong in ("0x03u", "0x00u"):
            text = header("0x01u", "0x02u", wrong, "0x08u")
            self.assertIn("KEEL_SIDE_C is no single bit", problems(text))

    def test_equal_numbers(self) -> None:
        self.assertEqual(
            problems(header("5", "1u", "2", "1")), ["KEEL_SIDE_B and KEEL_SIDE_D are one number"]
        )

    def test_a_gap(self) -> None:
        [only] = problems(header("0", "1u", "3"))
        self.assertEqual(only, "KEEL_SIDE_C is not one more than KEEL_SIDE_B")
        self.assertEqual(problems(header("1", "2", "16")), [])

    def test_limits_may_be_equal(self) -> None:
        self.assertEqual(problems(header("1.0f", "1.0f", "16.0f") + header("8u", "8u")), [])

    def test_what_is_combined(self) -> None:
        text = "void f(unsigned *x) { *x |= A; if ((*x & B) != 0u) { *x = 1u + C; } }"
        self.assertEqual(combined(text), {"A", "B"})
