# SPDX-License-Identifier: Apache-2.0
"""Telemetry on the virtual clock, byte by byte, with pymavlink on the other side.

Equal runs are equal: nothing here waits.
"""

from __future__ import annotations

import random
import struct
import zlib
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
from other_values import others
from pymavlink.dialects.v20 import development as mavlink

from keel.flight import judge, scenario, sensors
from keel.flight.library import Copter, Key, Link
from keel.flight.loop import Flight, Order, fly
from keel.flight.pilot import Bystander, Pilot, Sight
from keel.flight.sensors import TEMPERATURES
from keel.plants import mujoco_plant
from keel.timeline import ulog

ACCEPTED, REJECTED, DENIED, UNSUPPORTED = 0, 1, 2, 3
DISARMED, ARMED, FLYING, HOLDING = 0, 1, 2, 3
ANGLE, POSITION = 2, 4  # Of the pilot's switch.
# As ground stations have them: docs/telemetry.md.
TO_LAND, TO_ANGLE, TO_ALTITUDE, TO_POSITION = 100925440, 458752, 131072, 196608
ARM, SET_MODE, INTERVAL, REQUEST = 400, 176, 511, 512
THROTTLE, ARM_SWITCH, MODE_SWITCH, KILL = 2, 4, 5, 6
LOW, ON, OFF = 988, 2000, 1000
MINUTE = 6_000_000  # In 10 us.
REAL32 = mavlink.MAV_PARAM_TYPE_REAL32
BURST = 512
WARM_MS = 12_000
SENT = {
    "HEARTBEAT",
    "SYS_STATUS",
    "GPS_RAW_INT",
    "ATTITUDE",
    "LOCAL_POSITION_NED",
    "GLOBAL_POSITION_INT",
    "SERVO_OUTPUT_RAW",
    "RC_CHANNELS",
    "BATTERY_STATUS",
    "ESTIMATOR_STATUS",
    "HOME_POSITION",
    "EXTENDED_SYS_STATE",
    "SCALED_IMU",
    "SCALED_IMU2",
    "SCALED_IMU3",
    "NAMED_VALUE_INT",
    "SCALED_PRESSURE",
    "ATTITUDE_QUATERNION",
    "VFR_HUD",
    "ALTITUDE",
    "SYSTEM_TIME",
    "CURRENT_MODE",
    "FENCE_STATUS",
}


class Hands(Pilot):
    """A pilot whose channels a test writes; None is silence."""

    channels: list[int] = []

    def frame(self, sight: Sight) -> list[int]:
        """As they are."""
        return list(self.channels)


class Rig:
    """A copter in a plant, with links."""

    def __init__(
        self,
        copter: Copter,
        links: Sequence[Link] = (Link(),),
        warm_ms: int = WARM_MS,
        key: Key | None = None,
        memory: Path | None = None,
    ) -> None:
        order = Order(scenario.read("hover"), "mujoco", 1)
        self.copter = copter
        self.channels = [1500, 1500, LOW, 1500, OFF, copter.mode_channel(POSITION), OFF, 1500]
        Hands.channels = self.channels
        self.flight = Flight(copter, order, Hands, links, key, memory)
        self.links = range(len(links))
        self.open = set(self.links)
        self.now_ms = 0
        self.bytes: list[bytearray] = [bytearray() for _ in links]
        self.parsers = [mavlink.MAVLink(None, srcSystem=255, srcComponent=190) for _ in links]
        self.seen: list[list[Any]] = [[] for _ in links]
        self.station = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
        self.run(warm_ms)

    def run(self, milliseconds: int) -> None:
        """Time passes."""
        for _ in range(milliseconds):
            self.now_ms += 1
            self.flight.step(self.now_ms)
            for link in self.open:
                data = self.copter.receive(link)
                self.bytes[link] += data
                if data:
                    self.seen[link] += self.parsers[link].parse_buffer(data) or []

    def without_radio(self, milliseconds: int) -> None:
        """The same, with the pilot's frames gone."""
        with mock.patch.object(self.flight._radio, "send"):
            self.run(milliseconds)

    def send(self, message: Any, link: int = 0) -> None:
        """A frame for the copter."""
        self.copter.send(link, message.pack(self.station))

    def ask(self, command: int, *params: float, link: int = 0) -> int:
        """What it answers to a command."""
        numbers = [*params, *([0.0] * (7 - len(params)))]
        begun = len(self.seen[link])
        self.send(mavlink.MAVLink_command_long_message(1, 1, command, 0, *numbers), link)
        for _ in range(300):
            self.run(10)
            for message in self.seen[link][begun:]:
                if message.get_type() == "COMMAND_ACK" and message.command == command:
                    assert (message.target_system, message.target_component) == (255, 190)
                    return int(message.result)
        raise AssertionError(f"{command}: no answer")

    def state(self) -> int:
        """The state machine's."""
        self.copter.look()
        return int(self.copter.view["state"])

    def texts(self, link: int = 0) -> list[str]:
        """What was said, but for what the copter tells of its receiver."""
        texts = [message.text for message in self.seen[link] if message.get_type() == "STATUSTEXT"]
        return [text for text in texts if not text.startswith("radio: ")]

    def named(self, link: int = 0) -> dict[str, int]:
        """The last value of each name."""
        return {
            message.name: message.value
            for message in self.seen[link]
            if message.get_type() == "NAMED_VALUE_INT"
        }

    def counts(self, link: int = 0) -> Counter[str]:
        """How often each message came."""
        return Counter(message.get_type() for message in self.seen[link])


def test_every_message_is_as_others_encode_it(copter: Copter) -> None:
    rig = Rig(copter)
    assert rig.ask(REQUEST, 148) == ACCEPTED
    assert rig.ask(REQUEST, 125) == DENIED  # POWER_STATUS: it is about another supply.
    assert rig.ask(9999) == UNSUPPORTED
    rig.send(mavlink.MAVLink_ping_message(7, 9, 0, 0))
    rig.send(mavlink.MAVLink_timesync_message(0, 12345))
    rig.send(mavlink.MAVLink_param_request_list_message(1, 1))
    rig.run(3000)
    kinds = set(rig.counts())
    assert kinds >= SENT | {"AUTOPILOT_VERSION", "PING", "TIMESYNC", "PARAM_VALUE", "COMMAND_ACK"}
    assert not kinds & {"BAD_DATA", "POWER_STATUS"}
    echo = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    for message in rig.seen[0]:
        echo.seq = message.get_seq()
        assert bytes(message.get_msgbuf()) == bytes(message.pack(echo)), message
    by_kind = {message.get_type(): message for message in rig.seen[0]}
    assert (by_kind["PING"].time_usec, by_kind["PING"].seq) == (7, 9)
    assert by_kind["PING"].target_system == 255
    assert by_kind["TIMESYNC"].ts1 == 12345
    assert 0 < by_kind["TIMESYNC"].tc1 <= 1_000_000 * rig.now_ms


def test_what_is_told_is_so(copter: Copter) -> None:
    rig = Rig(copter)
    truth = rig.flight._plant.truth()
    by_kind = {message.get_type(): message for message in rig.seen[0]}
    attitude, place = by_kind["ATTITUDE"], by_kind["GLOBAL_POSITION_INT"]
    assert abs(attitude.roll - truth.angles[0]) < 0.02
    assert abs(attitude.pitch - truth.angles[1]) < 0.02
    assert abs(attitude.yaw - truth.angles[2]) < 0.1
    assert abs(place.lat / 1e7 - truth.latitude) < 3e-5
    assert abs(place.lon / 1e7 - truth.longitude) < 3e-5
    assert abs(place.alt / 1000.0 - 430.0) < 5.0 and abs(place.relative_alt / 1000.0) < 2.0
    fix, radio = by_kind["GPS_RAW_INT"], by_kind["RC_CHANNELS"]
    assert (fix.fix_type, fix.satellites_visible, fix.v_acc) == (3, 14, 800)
    assert abs(fix.alt / 1000.0 - 430.0) < 1.0
    assert (radio.chan3_raw, radio.chan16_raw, radio.chancount) == (LOW, 1500, 16)
    assert by_kind["SERVO_OUTPUT_RAW"].servo1_raw == 1000
    assert by_kind["EXTENDED_SYS_STATE"].landed_state == 1
    rig.copter.look()
    assert by_kind["SYS_STATUS"].battery_remaining == int(100.0 * rig.copter.view["battery_left"])


def test_health_is_told(copter: Copter) -> None:
    """Each unit's own sample and temperature, and what went wrong so far: in a healthy flight,
    nothing."""
    rig = Rig(copter)
    by_kind = {message.get_type(): message for message in rig.seen[0]}
    units = [by_kind[f"SCALED_IMU{number}"] for number in ("", "2", "3")]
    assert tuple(unit.temperature for unit in units) == TEMPERATURES
    for number, unit in enumerate(units):
        measured = rig.copter.sensors["imu"]["accelerometer"][number]
        assert abs(unit.zacc - measured[2] / 9.80665 * 1000.0) < 40.0  # Noise moved meanwhile.
        assert abs(unit.zacc + 1000) < 60
    status = by_kind["SYS_STATUS"]
    assert 0 < status.load < 1000
    assert (status.errors_count1, status.errors_count2, status.errors_count3) == (0, 0, 0)
    assert rig.named()["stack_free"] == 2**31 - 1  # This machine has enough.


def test_temperatures_and_supply_are_told(copter: Copter) -> None:
    """Each of its own sensor: no two are alike."""
    rig = Rig(copter)
    by_kind = {message.get_type(): message for message in rig.seen[0]}
    air = by_kind["SCALED_PRESSURE"]
    # 430 m above the sea: 962.65 hPa and 12.2 degrees in the standard atmosphere.
    assert abs(air.press_abs - 962.65) < 0.1
    assert abs(air.temperature - (1220 + 740)) <= 1
    assert (air.press_diff, air.temperature_press_diff) == (0.0, 0)
    assert (rig.named()["chip_mv"], rig.named()["chip_cdeg"]) == (3287, 5130)


def test_temperatures_and_supply_are_the_last_ones(copter: Copter) -> None:
    rig = Rig(copter)
    with (
        mock.patch.object(sensors, "BAROMETER_WARMER", -3000),
        mock.patch.object(sensors, "CHIP_TEMPERATURE", -512),
        mock.patch.object(sensors, "SUPPLY_MV", 3011),
    ):
        rig.run(7000)
    by_kind = {message.get_type(): message for message in rig.seen[0]}
    assert abs(by_kind["SCALED_PRESSURE"].temperature - (1220 - 3000)) <= 1
    assert (rig.named()["chip_mv"], rig.named()["chip_cdeg"]) == (3011, -512)


def test_what_is_not_measured_is_not_told(copter: Copter) -> None:
    """A barometer and a converter that fall silent; what else is told is told as before."""
    rig = Rig(copter)
    with (
        mock.patch.object(rig.flight._slow, "_barometer"),
        mock.patch.object(rig.flight._slow, "_chip"),
    ):
        rig.run(2100)  # What was measured last is a second old, and telemetry has said so.
        rig.seen[0].clear()
        rig.run(11_000)
    counts = rig.counts()
    assert counts["SCALED_PRESSURE"] == 0
    assert counts["HEARTBEAT"] >= 10 and set(rig.named()) == {"stack_free"}
    rig.run(11_000)
    counts = rig.counts()
    assert counts["SCALED_PRESSURE"] >= 4
    assert set(rig.named()) == {"stack_free", "chip_mv", "chip_cdeg"}


def test_named_values_have_a_fifth_of_a_hertz_each(copter: Copter) -> None:
    rig = Rig(copter)
    rig.seen[0].clear()
    rig.run(30_000)
    names = Counter(
        message.name for message in rig.seen[0] if message.get_type() == "NAMED_VALUE_INT"
    )
    assert set(names) == {"stack_free", "chip_mv", "chip_cdeg"}
    assert all(5 <= count <= 7 for count in names.values()), names


def test_runs_that_take_too_long_are_counted(copter: Copter) -> None:
    rig = Rig(copter)
    task = copter.tasks.index("Navigation")
    copter.overrun(task, 3, 30_000)
    rig.run(3000)
    status = [message for message in rig.seen[0] if message.get_type() == "SYS_STATUS"][-1]
    assert status.errors_count1 == 3
    assert status.errors_count2 > 10  # What waits for 30 ms misses periods.


def test_rates_are_kept_and_frames_are_numbered(copter: Copter) -> None:
    rig = Rig(copter)
    before = rig.counts()
    rig.run(10_000)
    came = rig.counts() - before
    expected = {
        "HEARTBEAT": 10,
        "ATTITUDE": 200,
        "LOCAL_POSITION_NED": 100,
        "RC_CHANNELS": 50,
        "SCALED_PRESSURE": 5,
        "NAMED_VALUE_INT": 6,
        "ATTITUDE_QUATERNION": 100,
        "VFR_HUD": 40,
        "ALTITUDE": 20,
        "SYSTEM_TIME": 10,
        "FENCE_STATUS": 5,
    }
    for name, count in expected.items():
        assert 0.8 * count - 1 <= came[name] <= count + 1, (name, came[name])
    numbers = [message.get_seq() for message in rig.seen[0]]
    assert all(b == (a + 1) % 256 for a, b in zip(numbers, numbers[1:], strict=False))
    assert rig.ask(INTERVAL, 30, 500_000) == ACCEPTED
    before = rig.counts()
    rig.run(5000)
    assert 9 <= (rig.counts() - before)["ATTITUDE"] <= 11
    assert rig.ask(INTERVAL, 30, -1) == ACCEPTED
    before = rig.counts()
    rig.run(2000)
    assert (rig.counts() - before)["ATTITUDE"] == 0


@pytest.mark.parametrize("rate", [150, 600])
def test_a_slow_link_carries_all_and_no_more_than_it_can(copter: Copter, rate: int) -> None:
    rig = Rig(copter, [Link(rate), Link(20_000)], warm_ms=0)
    lengths = []
    for _ in range(300):
        rig.run(100)
        lengths.append(len(rig.bytes[0]))
    for first in range(0, 300, 10):
        for last in range(first, 300, 10):
            allowed = BURST + rate * (last - first) / 10.0
            assert lengths[last] - lengths[first] <= allowed + 1
    assert lengths[-1] > 0.6 * rate * 30  # It is used.
    counts = rig.counts()
    assert set(counts) >= SENT, SENT - set(counts)
    # Those that are wanted each second, from the start on.
    turns = [
        counts[name]
        for name in (
            "HEARTBEAT",
            "SYS_STATUS",
            "BATTERY_STATUS",
            "ESTIMATOR_STATUS",
            "EXTENDED_SYS_STATE",
        )
    ]
    assert min(turns) >= (4 if rate < 600 else 16) and max(turns) <= min(turns) + 2, counts
    assert counts["SERVO_OUTPUT_RAW"] <= (30 if rate < 600 else 80)  # Of 150.
    assert rig.counts(1)["ATTITUDE"] > 300  # The other link does not notice.


def test_a_link_that_nobody_reads_holds_up_nothing(copter: Copter) -> None:
    rig = Rig(copter, [Link(), Link()], warm_ms=0)
    rig.open = {1}
    rig.run(WARM_MS)
    assert rig.counts(1)["ATTITUDE"] > 150
    rig.open = {0, 1}
    rig.run(3000)
    assert rig.counts(0)["BAD_DATA"] == 0 and rig.counts(0)["ATTITUDE"] > 40


def test_a_link_that_is_flooded_is_its_own_trouble(copter: Copter) -> None:
    rig = Rig(copter, [Link(), Link()], warm_ms=WARM_MS)
    before = rig.counts(1)
    flood = b"".join(
        mavlink.MAVLink_param_set_message(1, 1, b"POS_P", float("nan"), 9).pack(rig.station)
        for _ in range(90)
    )
    for _ in range(50):
        rig.copter.send(0, flood)
        rig.run(100)
    came = rig.counts(1) - before
    assert came["ATTITUDE"] > 60 and came["HEARTBEAT"] >= 4
    assert rig.ask(ARM, 1, link=1) == ACCEPTED


def test_parameters_are_listed_under_pressure(copter: Copter) -> None:
    rig = Rig(copter, [Link(1500)])
    rig.send(mavlink.MAVLink_param_request_list_message(1, 1))
    rig.run(25_000)
    values = [message for message in rig.seen[0] if message.get_type() == "PARAM_VALUE"]
    assert [value.param_index for value in values] == list(range(values[0].param_count))
    assert rig.counts()["HEARTBEAT"] > 5


def value_in(rig: Rig, name: str) -> Any:
    """A parameter as it is told, whatever the copter's number."""
    rig.send(mavlink.MAVLink_param_request_read_message(0, 0, name.encode(), -1))
    rig.run(300)
    values = [one for one in rig.seen[0] if one.get_type() == "PARAM_VALUE"]
    assert (values[-1].param_id, values[-1].param_type) == (name, REAL32)
    return values[-1].param_value


def set_to(rig: Rig, name: str, value: float, kind: int = REAL32, link: int = 0) -> list[str]:
    """Set a parameter; what is said meanwhile."""
    begun = len(rig.texts(link))
    rig.send(mavlink.MAVLink_param_set_message(1, 1, name.encode(), value, kind), link)
    rig.run(300)
    return rig.texts(link)[begun:]


def errors_in(rig: Rig, link: int = 0) -> list[tuple[str, int, int]]:
    """Of which parameters there was an error, by name or index, and which."""
    errors = [one for one in rig.seen[link] if one.get_type() == "PARAM_ERROR"]
    assert all((one.target_system, one.target_component) == (255, 190) for one in errors)
    return [(one.param_id, one.param_index, one.error) for one in errors]


def test_each_parameter_is_set_told_and_kept(copter: Copter, tmp_path: Path) -> None:
    rig = Rig(copter, warm_ms=1000, memory=tmp_path / "memory")
    asked = others()
    for name, value in asked.items():
        assert value_in(rig, name) != value
        assert not [text for text in set_to(rig, name, value) if "not set" in text]
        assert value_in(rig, name) == value
    rig.run(16_000)  # The last two saves.
    again = Rig(copter, warm_ms=500, memory=tmp_path / "memory")
    assert {name: value_in(again, name) for name in asked} == asked
    assert not errors_in(rig) and not errors_in(again)


@pytest.mark.parametrize(
    ("name", "value", "kind", "reason"),
    [
        ("POS_P", float("nan"), REAL32, "not a number"),
        ("POS_P", float("inf"), REAL32, "out of its range"),
        ("POS_P", 1.0, 1, "its type is REAL32"),
        ("POS_P", 1.0, 6, "its type is REAL32"),
        ("VEL_P", 11.0, REAL32, "out of its range"),
        ("BAT_CELLS", 4.5, REAL32, "not a whole number"),
        ("BAT_CELLS", float("nan"), REAL32, "not a number"),
        ("BAT_CELLS", 15.0, REAL32, "out of its range"),
        ("BAT_CELLS", float("-inf"), REAL32, "out of its range"),
        ("BAT_CELLS", 1e30, REAL32, "out of its range"),
        ("BAT_CELLS", 2147483648.0, REAL32, "out of its range"),
        ("BAT_CELLS", 6.0, 6, "its type is REAL32"),
        ("FS_RETURN", 0.5, REAL32, "not a whole number"),
        ("FS_RETURN", 2.0, REAL32, "out of its range"),
        ("BAT_V_CRIT", 3.75, REAL32, "contradicts another"),  # The low voltage is 3.5.
    ],
)
def test_what_no_parameter_can_be_is_refused(
    copter: Copter, name: str, value: float, kind: int, reason: str
) -> None:
    rig = Rig(copter, warm_ms=500)
    before = value_in(rig, name)
    told = rig.counts()["PARAM_VALUE"]
    assert set_to(rig, name, value, kind) == [f"{name}: not set, {reason}"]
    assert rig.counts()["PARAM_VALUE"] == told + 1
    assert errors_in(rig) == [(name, -1, mavlink.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE)]
    assert value_in(rig, name) == before


def test_parameters_that_there_are_not(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    none = mavlink.MAV_PARAM_ERROR_DOES_NOT_EXIST
    rig.send(mavlink.MAVLink_param_request_read_message(1, 1, b"SIXTEEN_LETTERS_", -1))
    behind = len(others())
    rig.send(mavlink.MAVLink_param_request_read_message(1, 1, b"", behind))
    rig.send(mavlink.MAVLink_param_request_read_message(1, 1, b"", -2))
    rig.run(300)
    assert errors_in(rig) == [("SIXTEEN_LETTERS_", -1, none), ("", behind, none), ("", -2, none)]
    assert set_to(rig, "SYSID_NONE", 1.0) == ["parameter: there is no such one"]
    assert errors_in(rig)[3:] == [("SYSID_NONE", -1, none)]
    assert rig.counts()["PARAM_VALUE"] == 0


def armed(rig: Rig) -> None:
    """By telemetry."""
    assert rig.ask(ARM, 1) == ACCEPTED
    rig.run(1000)


def idle_of(rig: Rig) -> int:
    """The first motor's pulse, as it is told."""
    told = [one for one in rig.seen[0] if one.get_type() == "SERVO_OUTPUT_RAW"]
    return int(told[-1].servo1_raw)


def test_what_is_set_on_the_ground_is_in_force_at_once(copter: Copter, tmp_path: Path) -> None:
    copter.log(tmp_path / "log.ulg")
    rig = Rig(copter, memory=tmp_path / "memory")
    assert set_to(rig, "MOT_IDLE", 0.125) == []
    armed(rig)
    rig.run(1000)
    assert idle_of(rig) == 1125
    assert set_to(rig, "MOT_IDLE", 0.0625) == ["MOT_IDLE: in force once disarmed"]
    assert idle_of(rig) == 1125 and value_in(rig, "MOT_IDLE") == 0.0625
    assert rig.ask(ARM, 0) == ACCEPTED
    armed(rig)
    rig.run(1000)
    assert idle_of(rig) == 1062
    assert not [text for text in rig.texts() if "restart" in text]
    rig.run(1000)
    copter.log(None)
    log = ulog.read(tmp_path / "log.ulg")
    assert abs(log.parameters["MOT_IDLE"] - 0.05) < 1e-6
    assert [one[1:] for one in log.changed] == [("MOT_IDLE", 0.125), ("MOT_IDLE", 0.0625)]
    assert len(log.parameters) == len(others())


def test_a_barometer_that_falls_silent_is_told_and_so_is_its_return(copter: Copter) -> None:
    rig = Rig(copter)
    rig.run(8000)
    assert not [text for text in rig.texts() if text.startswith("height: ")]
    with mock.patch.object(rig.flight._slow, "_tell_pressure"):
        rig.run(4000)
    rig.run(1000)
    told = [text for text in rig.texts() if text.startswith("height: ")]
    assert told == ["height: barometer fails, by satellites", "height: by the barometer"]


def test_what_waits_for_a_restart_is_told(copter: Copter, tmp_path: Path) -> None:
    rig = Rig(copter, memory=tmp_path / "memory")
    waits = "KILL_TIME: in force after a restart"
    assert set_to(rig, "KILL_TIME", 900_000.0) == [waits]
    assert set_to(rig, "KILL_TIME", 300_000.0) == []  # As it is in force.
    assert set_to(rig, "KILL_TIME", 900_000.0) == [waits]
    begun = len(rig.texts())
    armed(rig)
    assert set(rig.texts()[begun:]) == {"armed", waits}
    assert rig.ask(ARM, 0) == ACCEPTED
    rig.run(4000)
    begun = len(rig.texts())
    rig.send(mavlink.MAVLink_param_request_list_message(1, 1))
    rig.run(2000)
    assert rig.texts()[begun:] == [waits]
    again = Rig(copter, memory=tmp_path / "memory")
    again.send(mavlink.MAVLink_param_request_list_message(1, 1))
    armed(again)
    assert "armed" in again.texts() and waits not in again.texts()
    assert value_in(again, "KILL_TIME") == 900_000.0


def stored(*records: tuple[str, int, bytes]) -> bytes:
    """A memory whose first slot has a set, as slots.h and parameters.h lay it out."""
    image = b"".join(
        name.encode().ljust(16, b"\0") + bytes([kind]) + bits for name, kind, bits in records
    )
    head = struct.pack("<II", 1, len(image))
    return b"\x4b" + head + image + struct.pack("<I", zlib.crc32(head + image))


def test_a_set_of_another_version_is_loaded_and_told(copter: Copter, tmp_path: Path) -> None:
    (tmp_path / "memory").write_bytes(
        stored(
            ("MOT_IDLE", 0, struct.pack("<f", 0.125)),
            ("OF_ANOTHER", 0, struct.pack("<f", 1.0)),
            ("BAT_CELLS", 0, struct.pack("<f", 6.0)),  # It was a float there,
            ("POS_P", 0, struct.pack("<f", 99.0)),  # and this had another range.
        )
    )
    rig = Rig(copter, warm_ms=500, memory=tmp_path / "memory")
    assert [value_in(rig, name) for name in ("MOT_IDLE", "BAT_CELLS")] == [0.125, 4.0]
    assert abs(value_in(rig, "POS_P") - 0.8) < 1e-6
    rig.send(mavlink.MAVLink_param_request_list_message(1, 1))
    rig.run(2000)
    assert rig.texts() == [
        "POS_P: the stored value is not taken",
        "BAT_CELLS: the stored value is not taken",
        "parameters: unknown ones are stored",
    ]
    assert set_to(rig, "BAT_CELLS", 6.0) == ["BAT_CELLS: in force after a restart"]
    set_to(rig, "POS_P", 0.75)
    rig.run(4000)
    again = Rig(copter, warm_ms=500, memory=tmp_path / "memory")
    again.send(mavlink.MAVLink_param_request_list_message(1, 1))
    again.run(2000)
    assert again.texts() == []
    assert [value_in(again, name) for name in ("MOT_IDLE", "BAT_CELLS", "POS_P")] == [
        0.125,
        6.0,
        0.75,
    ]


def test_anything_may_come(copter: Copter) -> None:
    rig = Rig(copter)
    rng = random.Random(1)
    frames = [
        mavlink.MAVLink_command_long_message(1, 1, ARM, 0, 1, 0, 0, 0, 0, 0, 0),
        mavlink.MAVLink_param_set_message(1, 1, b"HEIGHT_P", 2.0, 9),
        mavlink.MAVLink_param_request_read_message(1, 1, b"", 32767),
        mavlink.MAVLink_param_request_read_message(1, 1, b"HEIGHT_PHEIGHT_P", -1),
        mavlink.MAVLink_param_request_read_message(1, 1, b"", -2),
        mavlink.MAVLink_set_mode_message(1, 1, 0xFFFFFFFF),
    ]
    for _ in range(400):
        data = bytearray(rng.choice(frames[2:]).pack(rig.station))
        if rng.random() < 0.7:
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
        rig.copter.send(0, bytes(rng.randbytes(rng.randrange(40))) + bytes(data))
        rig.run(7)
    numbers = [
        float("nan"),
        float("inf"),
        -float("inf"),
        1e30,
        -1e30,
        0.5,
        -1.0,
        1.0,
        176.0,
        4.0,
        435.0,
        float(TO_POSITION),
        4294967040.0,
    ]
    for _ in range(300):
        command = rng.choice([SET_MODE, INTERVAL, REQUEST, rng.randrange(65536)])
        if command == ARM:
            continue
        rig.send(
            mavlink.MAVLink_command_long_message(
                1, 1, command, 0, *(rng.choice(numbers) for _ in range(7))
            )
        )
        rig.run(11)
    assert rig.state() == DISARMED
    rig.run(3000)
    assert rig.ask(ARM, 1) == ACCEPTED


def test_garbage_costs_no_command(copter: Copter) -> None:
    rig = Rig(copter)
    rig.copter.send(0, bytes([0xFD, 0xFF, 0]))  # A frame of 267 bytes seems to begin.
    assert rig.ask(REQUEST, 30) == ACCEPTED
    rig.copter.send(0, bytes([0xFD]) * 100)  # More beginnings than are looked at in a run.
    assert rig.ask(REQUEST, 30) == ACCEPTED


def test_who_is_not_meant_does_nothing(copter: Copter) -> None:
    rig = Rig(copter)
    for system, component in ((2, 1), (1, 190)):
        rig.send(mavlink.MAVLink_command_long_message(system, component, ARM, 0, 1, *[0] * 6))
        rig.run(1500)
    assert rig.state() == DISARMED and rig.counts()["COMMAND_ACK"] == 0


def test_a_link_may_be_for_listening_alone(copter: Copter) -> None:
    rig = Rig(copter, [Link(), Link(commands=False)])
    assert rig.ask(ARM, 1, link=1) == DENIED
    assert rig.ask(SET_MODE, 1, TO_LAND, link=1) == DENIED
    rig.send(mavlink.MAVLink_set_mode_message(1, 1, TO_LAND), 1)
    set_to(rig, "HEIGHT_P", 2.0, link=1)
    assert rig.state() == DISARMED
    assert errors_in(rig, 1) == [("HEIGHT_P", -1, mavlink.MAV_PARAM_ERROR_PERMISSION_DENIED)]
    assert rig.counts()["PARAM_VALUE"] == 0
    rig.send(mavlink.MAVLink_param_request_read_message(1, 1, b"HEIGHT_P", -1), 1)
    rig.run(1000)
    values = [message for message in rig.seen[1] if message.get_type() == "PARAM_VALUE"]
    assert [value.param_value for value in values] == [1.0, 1.0]
    assert rig.ask(ARM, 1) == ACCEPTED


def test_arming_takes_the_state_machines_time(copter: Copter) -> None:
    rig = Rig(copter)
    begun = rig.now_ms
    rig.send(mavlink.MAVLink_command_long_message(1, 1, ARM, 0, 1, *[0] * 6))
    while rig.state() == DISARMED and rig.now_ms - begun < 2000:
        rig.run(1)
    assert rig.state() == ARMED and rig.now_ms - begun >= 300


@pytest.mark.parametrize(
    ("channel", "value", "text"),
    [
        (THROTTLE, 1500, "throttle not low"),
        (KILL, ON, "kill switch"),
        (ARM_SWITCH, ON, "arm switch"),
    ],
)
def test_what_stands_in_the_way_is_named(
    copter: Copter, channel: int, value: int, text: str
) -> None:
    rig = Rig(copter, warm_ms=0)
    rig.channels[channel] = value  # Since the power was switched on.
    rig.run(WARM_MS)
    assert rig.ask(ARM, 1) == REJECTED
    rig.run(500)
    assert rig.state() == DISARMED
    assert any(said.startswith("not armed: ") and text in said for said in rig.texts())


def test_half_of_the_pressure_is_named(copter: Copter) -> None:
    """HEA-005: what an MS5607 shows whose readings are taken for an MS5611's."""
    whole = mujoco_plant.MujocoPlant.pressure
    with mock.patch.object(mujoco_plant.MujocoPlant, "pressure", lambda plant: whole(plant) / 2.0):
        rig = Rig(copter)
        assert rig.ask(ARM, 1) == REJECTED
        rig.run(500)
        assert rig.state() == DISARMED
    assert "not armed: pressure not of the ground: an MS5607?" in rig.texts()
    assert not any("altitude" in said for said in rig.texts())


def test_a_safety_switch_that_is_used_and_not_there_is_named(copter: Copter) -> None:
    """HEA-006: the host has none, so it is never ready."""
    rig = Rig(copter)
    set_to(rig, "SAFETY_SWITCH", 1.0)
    assert rig.ask(ARM, 1) == REJECTED
    rig.run(500)
    assert rig.state() == DISARMED
    assert "not armed: safety switch at safe, or none" in rig.texts()
    set_to(rig, "SAFETY_SWITCH", 0.0)
    assert rig.ask(ARM, 1) == ACCEPTED


def test_an_attempt_by_the_switch_is_told_and_logged(copter: Copter, tmp_path: Path) -> None:
    """HEA-007: the words are those of a command, once for each attempt, also in the log."""
    copter.log(tmp_path / "log.ulg")
    rig = Rig(copter)
    rig.channels[THROTTLE] = 1500
    rig.run(500)
    assert rig.ask(ARM, 1) == REJECTED
    rig.run(500)
    told = [text for text in rig.texts() if text.startswith("not armed: ")]
    assert told == ["not armed: throttle not low"]
    for _ in range(2):
        rig.channels[ARM_SWITCH] = ON
        rig.run(2000)
        rig.channels[ARM_SWITCH] = OFF
        rig.run(1000)
    assert rig.state() == DISARMED
    assert [text for text in rig.texts() if text.startswith("not armed: ")] == 3 * told
    copter.log(None)
    lines = [line.text for line in ulog.read(tmp_path / "log.ulg").texts]
    assert lines == 2 * told  # What a command asks for is no attempt until nothing is in its way.


def test_without_the_pilots_link_nothing_moves(copter: Copter) -> None:
    rig = Rig(copter)
    rig.without_radio(1000)
    assert rig.ask(SET_MODE, 1, TO_LAND) == REJECTED
    rig.without_radio(1000)
    begun = len(rig.seen[0])
    rig.send(mavlink.MAVLink_command_long_message(1, 1, ARM, 0, 1, *[0] * 6))
    rig.without_radio(1500)
    answers = [one.result for one in rig.seen[0][begun:] if one.get_type() == "COMMAND_ACK"]
    assert answers == [REJECTED] and rig.state() == DISARMED
    rig.run(3000)  # The radio is back, and what was asked for is over.
    assert rig.state() == DISARMED


def test_a_throttle_that_is_raised_meanwhile_refuses(copter: Copter) -> None:
    rig = Rig(copter)
    rig.send(mavlink.MAVLink_command_long_message(1, 1, ARM, 0, 1, *[0] * 6))
    rig.run(100)
    rig.channels[THROTTLE] = 1500
    rig.run(2000)
    answers = [one.result for one in rig.seen[0] if one.get_type() == "COMMAND_ACK"]
    assert answers == [REJECTED] and rig.state() == DISARMED
    rig.channels[THROTTLE] = LOW
    rig.run(2000)
    assert rig.state() == DISARMED


def test_the_pilot_takes_the_arm_switch_over(copter: Copter) -> None:
    rig = Rig(copter)
    assert rig.ask(ARM, 1) == ACCEPTED
    rig.channels[ARM_SWITCH] = ON
    rig.run(1000)
    assert rig.state() == ARMED
    rig.channels[ARM_SWITCH] = OFF
    rig.run(1000)
    assert rig.state() == DISARMED


def test_who_was_disarmed_does_not_start_by_a_glitch(copter: Copter) -> None:
    rig = Rig(copter)
    rig.channels[ARM_SWITCH] = ON
    rig.run(1000)
    assert rig.state() == ARMED
    assert rig.ask(ARM, 0) == ACCEPTED
    assert rig.state() == DISARMED
    for _ in range(10):  # The switch is on, and single frames say otherwise.
        rig.channels[ARM_SWITCH] = OFF
        rig.run(25)
        rig.channels[ARM_SWITCH] = ON
        rig.run(500)
        assert rig.state() == DISARMED
    rig.channels[ARM_SWITCH] = OFF
    rig.run(1000)
    rig.channels[ARM_SWITCH] = ON
    rig.run(1000)
    assert rig.state() == ARMED  # The pilot's own.


def in_flight(copter: Copter) -> Rig:
    """Armed by telemetry, and some metres high."""
    rig = Rig(copter)
    assert rig.ask(ARM, 1) == ACCEPTED
    rig.channels[THROTTLE] = 1900
    rig.run(3000)
    rig.channels[THROTTLE] = 1500
    rig.run(1000)
    assert rig.state() == FLYING
    return rig


def test_modes_of_a_flight(copter: Copter) -> None:
    rig = in_flight(copter)
    assert rig.ask(ARM, 0) == DENIED and rig.ask(ARM, 0, 21196) == DENIED
    for mode in (0, TO_ANGLE, 6, 7, 1e9, float("nan")):
        assert rig.ask(SET_MODE, 1, mode) == DENIED
    assert rig.ask(SET_MODE, 1, TO_ALTITUDE) == ACCEPTED
    rig.run(1100)
    told = [one.custom_mode for one in rig.seen[0] if one.get_type() == "HEARTBEAT"]
    assert told[-1] == TO_ALTITUDE
    rig.channels[MODE_SWITCH] = copter.mode_channel(ANGLE)  # The pilot's is the last word.
    rig.run(1000)
    rig.copter.look()
    assert int(rig.copter.view["mode"]) == ANGLE and rig.state() == FLYING
    assert rig.ask(ARM, 1) == ACCEPTED  # It is.


def test_the_link_that_is_lost_counts_more_than_a_mode_that_is_asked_for(copter: Copter) -> None:
    rig = in_flight(copter)
    assert rig.ask(SET_MODE, 1, TO_ALTITUDE) == ACCEPTED
    rig.without_radio(1000)
    assert rig.state() == HOLDING
    begun = len(rig.seen[0])
    rig.send(mavlink.MAVLink_command_long_message(1, 1, SET_MODE, 0, 1, TO_POSITION, *[0] * 5))
    rig.without_radio(1000)
    assert rig.state() == HOLDING
    answers = [one.result for one in rig.seen[0][begun:] if one.get_type() == "COMMAND_ACK"]
    assert answers == [REJECTED]
    assert any("radio link lost" in text for text in rig.texts())


def test_a_mode_ends_with_the_flight(copter: Copter) -> None:
    rig = in_flight(copter)
    assert rig.ask(SET_MODE, 1, TO_LAND) == ACCEPTED
    for _ in range(30):
        rig.run(1000)
        if rig.state() == DISARMED:
            break
    assert rig.state() == DISARMED
    rig.run(2000)
    last = [one for one in rig.seen[0] if one.get_type() == "HEARTBEAT"][-1]
    assert last.custom_mode == TO_POSITION  # Where the pilot's switch is.


def test_a_flight_with_three_links_keeps_its_limits(copter: Copter) -> None:
    made = scenario.read("hover")
    start = copter.start
    try:
        copter.start = lambda cost, mean, *_: start(cost, mean, [Link()] * 3)  # type: ignore
        told = fly(copter, Order(made, "mujoco", 1))
    finally:
        del copter.start
    assert not told.problem
    assert judge.is_good(made, told, judge.judged(made, told, None))


def sign(station: Any, key: bytes, timestamp: int) -> None:
    """From now on it signs."""
    station.signing.secret_key, station.signing.timestamp = key, timestamp
    station.signing.link_id, station.signing.sign_outgoing = 3, True


def test_with_a_key_only_what_is_signed_counts(copter: Copter) -> None:
    now, key = 35_000_000_000_000, bytes(range(32))
    rig = Rig(copter, [Link(), Link()], warm_ms=0, key=Key(key, now))
    for parser in rig.parsers:
        sign(parser, key, now - 1)
    rig.run(WARM_MS)
    assert rig.counts()["ATTITUDE"] > 150 and rig.counts()["BAD_DATA"] == 0
    assert all(message.get_signed() for message in rig.seen[0])
    arm = mavlink.MAVLink_command_long_message(1, 1, ARM, 0, 1, *[0] * 6)
    rig.send(arm)
    sign(rig.station, bytes(32), now + 10)  # Another key.
    rig.send(arm)
    rig.run(1500)
    assert rig.state() == DISARMED and rig.counts()["COMMAND_ACK"] == 0
    sign(rig.station, key, now + 20)
    frame = arm.pack(rig.station)
    rig.copter.send(0, frame)
    rig.run(1500)
    assert rig.state() == ARMED and rig.counts()["COMMAND_ACK"] == 1
    for link in (0, 1):  # Heard before.
        rig.copter.send(link, frame)
        rig.run(500)
    assert rig.counts()["COMMAND_ACK"] == 1 and rig.counts(1)["COMMAND_ACK"] == 0


def test_signing_goes_on_over_a_restart(copter: Copter) -> None:
    """With the time that A-42 asks for, what was signed before does not count again."""
    now, key = 35_000_000_000_000, bytes(range(32))
    rig = Rig(copter, key=Key(key, now))
    sign(rig.station, key, now + 1000)
    old = mavlink.MAVLink_param_set_message(1, 1, b"POS_P", 0.75, REAL32).pack(rig.station)
    rig.copter.send(0, old)
    rig.run(500)
    assert [text for text in rig.texts() if "POS_P" in text] == []
    assert rig.counts()["PARAM_VALUE"] == 1
    later = now + 1000 + MINUTE + 1
    again = Rig(copter, key=Key(key, later))
    sign(again.parsers[0], key, now)
    again.copter.send(0, old)
    again.run(500)
    assert again.counts()["PARAM_VALUE"] == 0  # Heard before the restart.
    sign(again.station, key, later - MINUTE + 100_000)  # Whose clock has the date, a second on.
    again.send(mavlink.MAVLink_param_set_message(1, 1, b"POS_P", 0.75, REAL32))
    again.run(500)
    assert again.counts()["PARAM_VALUE"] == 1 and again.counts()["BAD_DATA"] == 0


def test_the_bystander_flies_when_others_arm(copter: Copter) -> None:
    order = Order(
        scenario.read("hover").model_copy(update={"pilot": [], "mode": "position"}), "mujoco", 1
    )
    flight = Flight(copter, order, Bystander, [Link()])
    station = mavlink.MAVLink(None, srcSystem=255)
    for now_ms in range(1, 26_000):
        flight.step(now_ms)
        copter.receive(0)
        if now_ms == WARM_MS:
            copter.send(
                0, mavlink.MAVLink_command_long_message(1, 1, ARM, 0, 1, *[0] * 6).pack(station)
            )
    assert 3.5 < flight._plant.truth().place[2] < 6.5


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (["--address", "here"], "here: expected host:port"),
        (["--address", "127.0.0.1:99999"], "expected host:port"),
        (["--rate", "0"], "--rate: expected 1 to"),
        (["--key", "nowhere"], "nowhere: cannot be read"),
        (["--scenario", "nothing"], "nothing"),
    ],
)
def test_what_cannot_be_flown_is_said(
    options: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    from keel.flight import sim

    assert sim.main(options) == 2
    assert reason in capsys.readouterr().err


def test_the_messages_are_up_to_date() -> None:
    from keel.copter import messages

    assert messages.main(["--check"]) == 0


def test_definitions_that_are_none_are_refused(tmp_path: Path) -> None:
    from keel.base.errors import ToolError
    from keel.copter import messages

    with pytest.raises(ToolError, match=r"minimal\.xml"):
        messages.read(tmp_path)
    with pytest.raises(ToolError, match="NO_SUCH"):
        messages.chosen({}, ["NO_SUCH"])
