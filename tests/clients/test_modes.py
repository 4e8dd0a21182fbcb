# SPDX-License-Identifier: Apache-2.0
"""Modes and commands, as stations have them: none does another thing than its name says.

What each should do stands in the tables below, by hand: of MAVLink's standard, of docs/telemetry.md
and of the names in the tables of pymavlink, which are others'.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
from pymavlink import mavutil
from pymavlink.dialects.v20 import development as mavlink
from test_telemetry import ANGLE, FLYING, LOW, MODE_SWITCH, REAL32, THROTTLE, Rig, in_flight

from keel.flight import library
from keel.flight.library import Copter, Link

ROOT = Path(__file__).resolve().parents[2]
ACCEPTED, REJECTED, DENIED, UNSUPPORTED, FAILED = 0, 1, 2, 3, 4
DISARMED, RETURNING, LANDING = 0, 4, 5
HOLD, RETURN, LAND, TAKE_OFF = 17, 20, 21, 22
ARM, SET_MODE, STANDARD, REBOOT, REQUEST = 400, 176, 262, 246, 512
AVAILABLE_MODES = 435
NAN = float("nan")
CUSTOM, AUTO, STABILIZE, MANUAL, ARMED = 1, 4, 16, 64, 128
# docs/telemetry.md: number, MAVLink's standard mode, properties, name.
ADVANCED, NOT_ASKED = 1, 2
MODES = {
    "acro": (5 << 16, 0, NOT_ASKED | ADVANCED, "Acro"),
    "land": (4 << 16 | 6 << 24, 7, 0, ""),
    "angle": (7 << 16, 0, NOT_ASKED, "Angle"),
    "altitude": (2 << 16, 4, 0, ""),
    "position": (3 << 16, 1, 0, ""),
    "return": (4 << 16 | 5 << 24, 5, 0, ""),
}
NUMBER = {name: row[0] for name, row in MODES.items()}
NONE = 0xFF0000
GEOFENCE = mavlink.MAV_SYS_STATUS_GEOFENCE


def last(rig: Rig, kind: str, link: int = 0) -> Any:
    """The last message of a kind."""
    return [one for one in rig.seen[link] if one.get_type() == kind][-1]


def mode_of(rig: Rig) -> str:
    """What flies."""
    rig.copter.look()
    return library.modes()[int(rig.copter.view["mode"])]


def away_from_home(copter: Copter) -> Rig:
    """A flight in position hold: at home a return would be a landing."""
    rig = in_flight(copter)
    rig.channels[1] = 1000
    rig.run(5000)
    rig.channels[1] = 1500
    rig.run(3000)
    rig.copter.look()
    assert math.hypot(*rig.copter.view["position"][:2]) > 5.0
    return rig


def foreign() -> Iterator[tuple[str, int]]:
    """Names and numbers of all tables that pymavlink has for autopilots that are not PX4."""
    for table in mavutil.AP_MAV_TYPE_MODE_MAP_DEFAULT.values():
        for number, name in table.items():
            yield name, number


def test_no_name_of_another_program_is_one_of_keels_numbers() -> None:
    numbers = {number for _, number in foreign()}
    assert len(numbers) >= 30
    assert not numbers & {*NUMBER.values(), NONE}


def test_px4s_names_mean_the_same() -> None:
    """As MAVSDK reads numbers of an autopilot that is neither."""
    same = {
        "acro": "ACRO",
        "land": "LAND",
        "angle": "STABILIZED",
        "altitude": "ALTCTL",
        "position": "POSCTL",
        "return": "RTL",
    }
    for name, number in NUMBER.items():
        assert mavutil.interpret_px4_mode(0, number) == same[name]
    assert mavutil.interpret_px4_mode(0, NONE) == "UNKNOWN"


def test_the_table_for_pymavlink_has_names_that_mean_the_same() -> None:
    table = json.loads((ROOT / "examples/copter/custom_mode_map.json").read_text())
    same = {
        "acro": "ACRO",
        "land": "LAND",
        "angle": "STABILIZE",
        "altitude": "ALT_HOLD",
        "position": "POSHOLD",
        "return": "RTL",
    }
    quadrotor = str(mavlink.MAV_TYPE_QUADROTOR)
    assert table == {quadrotor: {str(NUMBER[mode]): name for mode, name in same.items()}}


def test_other_programs_numbers_change_nothing_in_flight(copter: Copter) -> None:
    rig = in_flight(copter)
    for number in sorted({number for _, number in foreign()}):
        said = len(rig.texts())
        assert rig.ask(SET_MODE, 1, number) == DENIED, number
        rig.run(100)
        assert rig.texts()[said:] == ["mode: there is no such one"], number
        assert (rig.state(), mode_of(rig)) == (FLYING, "position")


# PX4's main mode and sub-mode, as MAVSDK and pymavlink's table for PX4 have them.
PX4: dict[str, tuple[int, str, str]] = {
    "LAND": (ACCEPTED, "land", ""),
    "RTL": (ACCEPTED, "return", ""),
    "LOITER": (ACCEPTED, "position", ""),
    "MISSION": (DENIED, "position", "mode: there is no such one"),
    "RTGS": (DENIED, "position", "mode: there is no such one"),
    "FOLLOWME": (DENIED, "position", "mode: there is no such one"),
    "TAKEOFF": (DENIED, "position", "mode: there is no such one"),
}


def test_every_pair_of_px4s_has_its_row() -> None:
    assert set(PX4) == {name for name, (_, _, sub) in mavutil.px4_map.items() if sub}


@pytest.mark.parametrize("name", PX4)
def test_px4s_pairs_do_what_they_say(copter: Copter, name: str) -> None:
    result, mode, text = PX4[name]
    base, main, sub = mavutil.px4_map[name]
    rig = away_from_home(copter)
    assert rig.ask(SET_MODE, base, main, sub, NAN, NAN, NAN, NAN) == result
    rig.run(200)
    assert mode_of(rig) == mode
    assert not text or rig.texts()[-1] == text


def test_px4s_main_modes_alone_are_refused(copter: Copter) -> None:
    """They may be ArduCopter's numbers."""
    rig = in_flight(copter)
    for name, (base, main, sub) in mavutil.px4_map.items():
        if not sub:
            assert rig.ask(SET_MODE, base, main, sub) == DENIED, name
    assert (rig.state(), mode_of(rig)) == (FLYING, "position")


def test_hold_is_refused_while_the_pilot_flies(copter: Copter) -> None:
    rig = in_flight(copter)
    rig.channels[0] = 1900
    rig.run(100)
    assert rig.ask(SET_MODE, 1, 4, 3) == REJECTED and rig.ask(HOLD) == REJECTED
    rig.run(100)
    assert rig.texts()[-2:] == ["mode: hold: sticks not centred"] * 2


# What each command does to a flight in mode altitude, and on the ground.
COMMANDS: list[tuple[str, tuple[float, ...], int, str, int, str]] = [
    ("land", (LAND,), ACCEPTED, "land", REJECTED, "mode: not flying"),
    (
        "land, no place",
        (LAND, 0, 0, 0, NAN, NAN, NAN, NAN),
        ACCEPTED,
        "land",
        REJECTED,
        "mode: not flying",
    ),
    (
        "land there",
        (LAND, 0, 0, 0, 0, 47.4, 8.5),
        DENIED,
        "altitude",
        DENIED,
        "mode: it lands where it is",
    ),
    ("land on a beacon", (LAND, 0, 2), DENIED, "altitude", DENIED, "mode: it lands where it is"),
    ("return", (RETURN,), ACCEPTED, "return", REJECTED, "mode: not flying"),
    ("hold", (HOLD,), ACCEPTED, "position", REJECTED, "mode: hold: sticks not centred"),
    (
        "hold there",
        (HOLD, 0, 0, 0, 0, 47.4, 8.5),
        DENIED,
        "altitude",
        DENIED,
        "mode: it holds where it is",
    ),
    (
        "take off",
        (TAKE_OFF, 0, 0, 0, 0, 0, 0, 5),
        UNSUPPORTED,
        "altitude",
        UNSUPPORTED,
        "take-off: only by the pilot's throttle",
    ),
    ("standard position", (STANDARD, 1), ACCEPTED, "position", ACCEPTED, ""),
    ("standard altitude", (STANDARD, 4), ACCEPTED, "altitude", ACCEPTED, ""),
    ("standard recovery", (STANDARD, 5), ACCEPTED, "return", REJECTED, "mode: not flying"),
    ("standard land", (STANDARD, 7), ACCEPTED, "land", REJECTED, "mode: not flying"),
    *(
        (
            f"standard {number}",
            (STANDARD, number),
            FAILED,
            "altitude",
            FAILED,
            "mode: there is no such one",
        )
        for number in (0, 2, 3, 6, 8, 9, 1.5, -1, NAN)
    ),
    ("own land", (SET_MODE, 1, NUMBER["land"]), ACCEPTED, "land", REJECTED, "mode: not flying"),
    (
        "own return",
        (SET_MODE, 1, NUMBER["return"]),
        ACCEPTED,
        "return",
        REJECTED,
        "mode: not flying",
    ),
    ("own position", (SET_MODE, 1, NUMBER["position"]), ACCEPTED, "position", ACCEPTED, ""),
    (
        "own acro",
        (SET_MODE, 1, NUMBER["acro"]),
        DENIED,
        "altitude",
        DENIED,
        "mode: only by the pilot's switch",
    ),
    (
        "own angle",
        (SET_MODE, 1, NUMBER["angle"]),
        DENIED,
        "altitude",
        DENIED,
        "mode: only by the pilot's switch",
    ),
    ("no mode", (SET_MODE, 1, NONE), DENIED, "altitude", DENIED, "mode: there is no such one"),
    (
        "half a mode",
        (SET_MODE, 1, NUMBER["position"] + 0.5),
        DENIED,
        "altitude",
        DENIED,
        "mode: there is no such one",
    ),
    (
        "no custom mode",
        (SET_MODE, 220, NUMBER["position"]),
        DENIED,
        "altitude",
        DENIED,
        "mode: only custom modes",
    ),
    ("guided", (SET_MODE, 88), DENIED, "altitude", DENIED, "mode: only custom modes"),
]


@pytest.mark.parametrize(
    ("asked", "result", "mode"),
    [(asked, result, mode) for _, asked, result, mode, _, _ in COMMANDS],
    ids=[row[0] for row in COMMANDS],
)
def test_commands_in_flight(
    copter: Copter, asked: tuple[float, ...], result: int, mode: str
) -> None:
    rig = away_from_home(copter) if mode == "return" else in_flight(copter)
    assert rig.ask(SET_MODE, 1, NUMBER["altitude"]) == ACCEPTED
    assert rig.ask(int(asked[0]), *asked[1:]) == result
    rig.run(200)
    assert mode_of(rig) == mode
    assert rig.state() == {"land": LANDING, "return": RETURNING}.get(mode, FLYING)


def test_commands_on_the_ground(copter: Copter) -> None:
    rig = Rig(copter)
    for name, asked, _, _, result, text in COMMANDS:
        said = len(rig.texts())
        assert rig.ask(int(asked[0]), *asked[1:]) == result, name
        rig.run(200)
        assert rig.texts()[said:] == ([text] if text else []), name
        assert rig.state() == DISARMED, name
    assert rig.ask(ARM, 1) == ACCEPTED  # None of them is in the way.


def test_a_place_in_command_int_is_one(copter: Copter) -> None:
    rig = in_flight(copter)
    for x, expected in ((474000000, DENIED), (2**31 - 1, ACCEPTED)):
        begun = len(rig.seen[0])
        rig.send(mavlink.MAVLink_command_int_message(1, 1, 6, LAND, 0, 0, 0, 0, 0, NAN, x, x, 0))
        rig.run(1000)
        answers = [one.result for one in rig.seen[0][begun:] if one.get_type() == "COMMAND_ACK"]
        assert answers == [expected]


def test_the_pilot_takes_over_from_a_landing(copter: Copter) -> None:
    rig = in_flight(copter)
    assert rig.ask(LAND) == ACCEPTED
    rig.channels[MODE_SWITCH] = copter.mode_channel(3)
    rig.run(1500)
    assert (rig.state(), mode_of(rig)) == (FLYING, "altitude")


def test_who_cannot_return_says_why(copter: Copter) -> None:
    rig = in_flight(copter)
    assert rig.ask(SET_MODE, 1, NUMBER["altitude"]) == ACCEPTED
    with mock.patch.object(rig.flight._slow, "_satellites"):
        rig.run(20_000)
        assert rig.ask(RETURN) == REJECTED
        rig.run(300)
    assert rig.texts()[-2:] == ["mode: the aircraft cannot", "mode: no position"]
    assert mode_of(rig) == "altitude"


def available(rig: Rig, begun: int) -> list[tuple[Any, ...]]:
    """AVAILABLE_MODES that came since."""
    return [
        (one.mode_index, one.custom_mode, one.standard_mode, one.properties, one.mode_name)
        for one in rig.seen[0][begun:]
        if one.get_type() == "AVAILABLE_MODES"
    ]


def test_modes_are_listed(copter: Copter) -> None:
    rig = Rig(copter)
    begun = len(rig.seen[0])
    assert rig.ask(REQUEST, AVAILABLE_MODES) == ACCEPTED
    rig.run(1000)
    told = available(rig, begun)
    assert [row[0] for row in told] == [1, 2, 3, 4, 5, 6]
    assert {row[1:] for row in told} == set(MODES.values())
    assert last(rig, "AVAILABLE_MODES").number_modes == 6
    for row in told:
        begun = len(rig.seen[0])
        assert rig.ask(REQUEST, AVAILABLE_MODES, row[0]) == ACCEPTED
        rig.run(300)
        assert available(rig, begun) == [row]
    for index in (7, -1, 1.5, NAN, 1e9):
        assert rig.ask(REQUEST, AVAILABLE_MODES, index) == DENIED
    assert rig.ask(511, AVAILABLE_MODES, 100_000) == DENIED  # Nobody wants them for ever.


def test_modes_are_listed_on_a_slow_link(copter: Copter) -> None:
    rig = Rig(copter, [Link(300)])
    begun = len(rig.seen[0])
    rig.send(mavlink.MAVLink_command_long_message(1, 1, REQUEST, 0, AVAILABLE_MODES, *[0] * 6))
    rig.run(20_000)
    assert sorted(row[0] for row in available(rig, begun)) == [1, 2, 3, 4, 5, 6]


def test_the_mode_in_force_is_told(copter: Copter) -> None:
    rig = in_flight(copter)
    begun = len(rig.seen[0])
    assert rig.ask(SET_MODE, 1, NUMBER["altitude"]) == ACCEPTED
    rig.run(100)
    told = [one for one in rig.seen[0][begun:] if one.get_type() == "CURRENT_MODE"]
    now = told[-1]  # At once: HEARTBEAT may still be to come.
    assert (now.standard_mode, now.custom_mode) == (4, NUMBER["altitude"])
    assert now.intended_custom_mode == NUMBER["altitude"]
    rig.without_radio(1000)  # It holds, without a mode that anybody asks for.
    now = last(rig, "CURRENT_MODE")
    assert (now.custom_mode, now.intended_custom_mode) == (NUMBER["position"], 0)
    before = rig.counts()["CURRENT_MODE"]
    rig.run(10_000)
    assert 4 <= rig.counts()["CURRENT_MODE"] - before <= 7


def test_flags_say_who_flies(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=0)
    with_radio = MANUAL | STABILIZE | CUSTOM
    rig.without_radio(3000)
    beat = last(rig, "HEARTBEAT")
    assert (beat.base_mode, beat.custom_mode) == (CUSTOM, NONE)
    rig.run(12_000)
    beat = last(rig, "HEARTBEAT")
    assert (beat.base_mode, beat.custom_mode) == (with_radio, NUMBER["position"])
    rig = in_flight(copter)
    rig.run(1100)
    assert last(rig, "HEARTBEAT").base_mode == with_radio | ARMED
    rig.channels[MODE_SWITCH] = copter.mode_channel(0)
    rig.run(1600)
    beat = last(rig, "HEARTBEAT")
    assert (beat.base_mode, beat.custom_mode) == (MANUAL | CUSTOM | ARMED, NUMBER["acro"])
    rig.channels[MODE_SWITCH] = copter.mode_channel(4)
    rig.run(1000)
    assert rig.ask(LAND) == ACCEPTED
    rig.run(1100)
    assert last(rig, "HEARTBEAT").base_mode == AUTO | STABILIZE | CUSTOM | ARMED


def test_the_fence_is_there_and_whole(copter: Copter) -> None:
    rig = Rig(copter)
    statuses = [one for one in rig.seen[0] if one.get_type() == "SYS_STATUS"]
    assert len(statuses) > 5  # From the power-up on.
    for status in statuses:
        assert status.onboard_control_sensors_present & GEOFENCE
        assert status.onboard_control_sensors_enabled & GEOFENCE
        assert status.onboard_control_sensors_health & GEOFENCE


def fence_of(one: Any) -> tuple[int, int, int]:
    """Whether it is outside, how often it was, and where."""
    return (one.breach_status, one.breach_count, one.breach_type)


def test_going_out_of_the_fence_and_coming_back_is_told_at_once(copter: Copter) -> None:
    """Upwards, by the pilot's throttle in angle mode, where the fence stops nobody."""
    rig = Rig(copter)
    assert fence_of(last(rig, "FENCE_STATUS")) == (0, 0, mavlink.FENCE_BREACH_NONE)
    rig.send(mavlink.MAVLink_param_set_message(1, 1, b"FENCE_HEIGHT", 10.0, REAL32))
    assert rig.ask(ARM, 1) == ACCEPTED
    rig.channels[MODE_SWITCH] = copter.mode_channel(ANGLE)
    rig.channels[THROTTLE] = 1600
    for _ in range(1000):
        rig.run(10)
        told = last(rig, "FENCE_STATUS")
        if told.breach_status:
            break
    rig.copter.look()
    assert abs(rig.copter.view["position"][2] - 10.0) < 1.0
    assert fence_of(told) == (1, 1, mavlink.FENCE_BREACH_MAXALT)
    assert 0 <= rig.now_ms - told.breach_time < 100  # It would come anyway each 2 s.
    rig.channels[THROTTLE] = 1500
    rig.run(1000)
    assert not last(rig, "SYS_STATUS").onboard_control_sensors_health & GEOFENCE
    rig.run(40_000)  # It comes back by itself.
    assert fence_of(last(rig, "FENCE_STATUS")) == (0, 1, mavlink.FENCE_BREACH_MAXALT)
    assert last(rig, "FENCE_STATUS").breach_time == told.breach_time
    assert last(rig, "SYS_STATUS").onboard_control_sensors_health & GEOFENCE


def test_the_chips_number_is_told(copter: Copter) -> None:
    rig = Rig(copter)
    assert rig.ask(REQUEST, 148) == ACCEPTED
    rig.run(200)
    version = last(rig, "AUTOPILOT_VERSION")
    uid = b"Keel\0sim"
    assert bytes(version.uid2) == uid.ljust(18, b"\0")
    assert version.uid == int.from_bytes(uid, "little")


def set_system(rig: Rig, system: int) -> None:
    """The parameter, and until it is saved."""
    real = mavlink.MAV_PARAM_TYPE_REAL32
    rig.send(mavlink.MAVLink_param_set_message(1, 1, b"MAV_SYS_ID", float(system), real))
    rig.run(3000)
    assert last(rig, "PARAM_VALUE").param_value == system


def test_it_answers_to_its_own_number(copter: Copter, tmp_path: Path) -> None:
    """From the next start on, which a station may ask for."""
    rig = Rig(copter, memory=tmp_path / "memory")
    set_system(rig, 7)
    assert last(rig, "HEARTBEAT").get_srcSystem() == 1
    assert rig.ask(REBOOT, 1) == ACCEPTED
    rig.run(15_000)
    assert last(rig, "HEARTBEAT").get_srcSystem() == 7
    begun = len(rig.seen[0])
    for system in (1, 2, 8):
        rig.send(mavlink.MAVLink_command_long_message(system, 1, ARM, 0, 1, *[0] * 6))
        rig.send(mavlink.MAVLink_set_mode_message(system, 1, NUMBER["altitude"]))
        rig.run(1500)
    assert rig.state() == DISARMED
    assert not [one for one in rig.seen[0][begun:] if one.get_type() == "COMMAND_ACK"]
    assert last(rig, "HEARTBEAT").custom_mode == NUMBER["position"]
    rig.send(mavlink.MAVLink_command_long_message(7, 1, ARM, 0, 1, *[0] * 6))
    rig.run(1500)
    assert rig.state() == 1


def test_it_starts_anew_on_the_ground(copter: Copter, tmp_path: Path) -> None:
    rig = Rig(copter, memory=tmp_path / "memory")
    before = last(rig, "ATTITUDE").time_boot_ms
    begun = len(rig.seen[0])
    assert rig.ask(REBOOT, 1) == ACCEPTED
    rig.run(3000)
    assert before > 10_000 > last(rig, "ATTITUDE").time_boot_ms
    answers = [one.result for one in rig.seen[0][begun:] if one.get_type() == "COMMAND_ACK"]
    assert answers == [ACCEPTED]
    rig.run(12_000)
    assert rig.ask(ARM, 1) == ACCEPTED  # All of it has started.


def test_it_does_not_start_anew_otherwise(copter: Copter) -> None:
    rig = in_flight(copter)
    assert rig.ask(REBOOT, 1) == REJECTED
    rig.run(3000)
    assert rig.texts()[-1] == "not rebooted: armed" and rig.state() == FLYING
    rig = Rig(copter)
    for params in ((0,), (2,), (3,), (NAN,), (1, 1), (1, 0, 1), (1, 0, 0, 0, 0, 20190226)):
        assert rig.ask(REBOOT, *params) == DENIED, params
    rig.run(3000)
    assert last(rig, "ATTITUDE").time_boot_ms > 15_000
    assert rig.texts()[-1] == "not rebooted: only the autopilot, not by force"


def test_who_is_armed_meanwhile_does_not_start_anew(copter: Copter) -> None:
    rig = Rig(copter)
    assert rig.ask(REBOOT, 1) == ACCEPTED
    rig.channels[4] = 2000  # The pilot's own switch.
    rig.run(3000)
    assert "not rebooted: armed meanwhile" in rig.texts() and rig.state() == 1
    assert rig.channels[THROTTLE] == LOW and last(rig, "ATTITUDE").time_boot_ms > 14_000
