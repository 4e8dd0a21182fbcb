# SPDX-License-Identifier: Apache-2.0
"""What users type, in flight and on the ground: every mode that pymavlink and MAVProxy list, and
every action of MAVSDK's that moves the aircraft.

The copter flies in real time, as in test_clients.py. What should happen stands here, by hand.
"""

from __future__ import annotations

import math
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from test_clients import LONG_S, Station, free_ports, mavproxy_program, powered_up, wait_for

ROOT = Path(__file__).resolve().parents[2]
ARM, SET_MODE = 400, 176
ACCEPTED, DENIED, UNSUPPORTED = 0, 2, 3
POSITION = 196608  # docs/telemetry.md.


@pytest.fixture(scope="module")
def ports(tmp_path_factory: pytest.TempPathFactory) -> Iterator[list[int]]:
    """A copter that has just been powered up: the ports at which its three links arrive."""
    found = free_ports(3)
    with powered_up(found, tmp_path_factory.mktemp("sim")):
        yield found


@pytest.fixture(scope="module")
def station(ports: list[int]) -> Iterator[Station]:
    """Who looks on, and flies where the others do not."""
    made = Station(ports[0])
    yield made
    made.link.close()


def catch_up(station: Station) -> None:
    """What came while it did not look is read, and is past."""
    while (message := station.link.recv_match(blocking=False)) is not None:
        if message.get_type() == "STATUSTEXT":
            station.texts.append(message.text)


def rest(station: Station) -> None:
    """It ends on the ground."""
    catch_up(station)
    station.rest()


def take_off(station: Station) -> None:
    """Armed; the pilot climbs to 5 m, and lets go of the sticks."""
    rest(station)
    station.ready()
    assert station.ask(ARM, 1) == ACCEPTED
    station.until("LOCAL_POSITION_NED", lambda m: m.z < -4.0)
    station.until("RC_CHANNELS", lambda m: 1490 < m.chan3_raw < 1510)
    station.until("LOCAL_POSITION_NED", lambda m: abs(m.vz) < 0.2)


def hovers(station: Station) -> None:
    """Nothing has happened to it."""
    catch_up(station)
    assert station.until("HEARTBEAT", lambda m: m.type == 2).custom_mode == POSITION
    assert station.see("EXTENDED_SYS_STATE").landed_state == 2
    assert station.see("LOCAL_POSITION_NED").z < -3.5


def said_since(station: Station, begun: int, text: str) -> None:
    """Until it was said."""
    while not any(text in said for said in station.texts[begun:]):
        station.see("STATUSTEXT")


def answer_to(station: Station, command: int) -> int:
    """To the command that was sent last."""
    return int(station.until("COMMAND_ACK", lambda m: m.command == command).result)


def names_of(station: Station) -> list[str]:
    """Those that pymavlink lists for this aircraft."""
    station.see("HEARTBEAT")
    names = sorted(station.link.mode_mapping())
    assert {"RTL", "LAND", "LOITER", "ACRO", "GUIDED"} <= set(names)
    return names


def try_names(station: Station) -> None:
    """Each is refused, and says so."""
    for name in names_of(station):
        begun = len(station.texts)
        station.link.set_mode(name)
        assert answer_to(station, SET_MODE) == DENIED, name
        said_since(station, begun, "mode: there is no such one")


def test_pymavlinks_names_on_the_ground(station: Station) -> None:
    try_names(station)
    assert not station.until("HEARTBEAT", lambda m: m.type == 2).base_mode & 128


def test_pymavlinks_names_in_flight(station: Station) -> None:
    take_off(station)
    try_names(station)
    hovers(station)


def test_pymavlinks_own_commands_in_flight(station: Station) -> None:
    """set_mode_...: what their names say, or nothing."""
    take_off(station)
    link = station.link
    for order in (link.set_mode_manual, link.set_mode_fbwa):
        begun = len(station.texts)
        order()
        assert answer_to(station, SET_MODE) == DENIED
        said_since(station, begun, "mode: only custom modes")
    link.set_mode_auto()
    assert answer_to(station, 300) == UNSUPPORTED
    link.set_mode_loiter()
    assert answer_to(station, 17) == ACCEPTED
    hovers(station)
    link.set_mode_rtl()
    assert answer_to(station, 20) == ACCEPTED
    station.hear("returning")
    rest(station)


class Proxy:
    """MAVProxy at a terminal."""

    def __init__(self, port: int, home: Path) -> None:
        self._log = home / "log"
        self._process = subprocess.Popen(
            [
                sys.executable,
                str(mavproxy_program()),
                f"--master=udpin:127.0.0.1:{port}",
                "--default-modules=param,arm,mode,cmdlong,misc,fence,link",
                f"--state-basedir={home}",
            ],
            stdin=subprocess.PIPE,
            stdout=self._log.open("w"),
            stderr=subprocess.STDOUT,
            cwd=home,
            text=True,
            env={**os.environ, "HOME": str(home)},
        )

    def shown(self) -> str:
        """All that it has shown."""
        return self._log.read_text()

    def types(self, line: str, *expected: str) -> str:
        """A line; what it shows from then on, once that has all that is expected."""
        begun = len(self.shown())
        assert self._process.stdin is not None
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()
        for text in expected:
            wait_for(lambda: text in self.shown()[begun:], f"{line}: {text} in {self.shown()}")
        return self.shown()[begun:]

    def close(self) -> None:
        """It does not heed SIGTERM for long."""
        self._process.kill()
        self._process.wait(LONG_S)


@pytest.fixture
def proxy(ports: list[int], station: Station, tmp_path: Path) -> Iterator[Callable[[bool], Proxy]]:
    """MAVProxy, with Keel's table of modes or without."""
    made: list[Proxy] = []

    def start(with_table: bool) -> Proxy:
        if with_table:
            (tmp_path / ".pymavlink").mkdir()
            shutil.copy(ROOT / "examples/copter/custom_mode_map.json", tmp_path / ".pymavlink")
        made.append(Proxy(ports[2], tmp_path))
        wait_for(lambda: "Received" in made[0].shown(), "parameters")
        return made[0]

    yield start
    for one in made:
        one.close()
    rest(station)


def listed(shown: str) -> list[str]:
    """The names behind "Available modes"."""
    names = shown.partition("Available modes:")[2].splitlines()[0]
    return [name.strip() for name in names.split(",")]


def test_mavproxys_names(station: Station, proxy: Callable[[bool], Proxy]) -> None:
    """On the ground, and in flight: each is refused, and what MAVProxy shows is no name."""
    rest(station)
    at = proxy(False)
    names = listed(at.types("mode", "Available modes:"))
    assert names and set(names) == set(names_of(station))
    for name in names:  # MAVProxy shows the same text once in a while.
        at.types(f"mode {name}", "DO_SET_MODE: DENIED")
    assert "mode: there is no such one" in at.shown()
    take_off(station)
    for name in names:
        at.types(f"mode {name}", "DO_SET_MODE: DENIED")
    at.types("rtl", "DO_SET_MODE: DENIED")
    hovers(station)
    assert f"Mode({POSITION})" in at.shown()
    assert "fence breach" not in at.shown() and "fence present" in at.shown()
    at.types("takeoff 5", "NAV_TAKEOFF: UNSUPPORTED", "take-off: only by the pilot's throttle")
    at.types("reboot", "PREFLIGHT_REBOOT_SHUTDOWN: TEMPORARILY_REJECTED", "not rebooted: armed")
    hovers(station)
    at.types("long NAV_RETURN_TO_LAUNCH", "NAV_RETURN_TO_LAUNCH: ACCEPTED", "returning")
    at.types("long NAV_LAND", "NAV_LAND: ACCEPTED")


# With Keel's table: what a name is answered on the ground and in flight, and what is shown then.
OWN = {
    "ACRO": ("DENIED", "DENIED", ""),
    "STABILIZE": ("DENIED", "DENIED", ""),
    "ALT_HOLD": ("ACCEPTED", "ACCEPTED", "Mode ALT_HOLD"),
    "POSHOLD": ("ACCEPTED", "ACCEPTED", "Mode POSHOLD"),
    "RTL": ("TEMPORARILY_REJECTED", "ACCEPTED", "returning"),
    "LAND": ("TEMPORARILY_REJECTED", "ACCEPTED", "Mode LAND"),
}


def test_mavproxys_names_with_keels_table(station: Station, proxy: Callable[[bool], Proxy]) -> None:
    rest(station)
    at = proxy(True)
    assert set(listed(at.types("mode", "Available modes:"))) == set(OWN)
    for name, (result, _, _) in OWN.items():
        at.types(f"mode {name}", f"DO_SET_MODE: {result}")
    assert "only by the pilot's switch" in at.shown() and "mode: not flying" in at.shown()
    take_off(station)
    for name, (_, result, text) in OWN.items():
        at.types(f"mode {name}", f"DO_SET_MODE: {result}", text)


def test_mavsdks_actions(station: Station, ports: list[int]) -> None:
    from mavsdk.component_type import ComponentType
    from mavsdk.mavsdk import Configuration, Mavsdk
    from mavsdk.plugins.action import Action
    from mavsdk.plugins.action.action import ActionError
    from mavsdk.plugins.info import Info
    from mavsdk.plugins.telemetry import Telemetry

    rest(station)
    station.ready()
    kind = Configuration.create_with_component_type(ComponentType.GROUND_STATION)
    with Mavsdk(kind) as sdk:
        sdk.add_any_connection(f"udpin://127.0.0.1:{ports[1]}")
        system = sdk.first_autopilot(LONG_S)
        assert system is not None
        seen, action, info = Telemetry(system), Action(system), Info(system)

        def refused(order: Callable[[], Any], result: str, text: str) -> None:
            begun = len(station.texts)
            with pytest.raises(ActionError, match=result):
                order()
            said_since(station, begun, text)

        def mode(name: str) -> None:
            wait_for(lambda: seen.flight_mode().name == name, f"{name}: {seen.flight_mode()}")

        wait_for(lambda: info.get_identification().legacy_uid != 0, "the chip's number")
        mode("POSCTL")
        for order in (action.land, action.return_to_launch):
            refused(order, "COMMAND_DENIED", "mode: not flying")
        refused(action.hold, "COMMAND_DENIED", "hold: sticks not centred")
        refused(action.takeoff, "UNSUPPORTED", "take-off: only by the pilot's throttle")
        refused(action.shutdown, "COMMAND_DENIED", "not rebooted: only the autopilot")
        take_off(station)
        refused(action.reboot, "COMMAND_DENIED", "not rebooted: armed")
        refused(action.takeoff, "UNSUPPORTED", "take-off: only by the pilot's throttle")
        action.hold()
        mode("POSCTL")
        hovers(station)
        begun = len(station.texts)
        action.return_to_launch()
        said_since(station, begun, "returning")  # At home, where it lands.
        action.land()
        mode("LAND")
        for number in (
            seen.position().relative_altitude_m,
            seen.heading().heading_deg,
            seen.velocity_ned().down_m_s,
            seen.battery().voltage_v,
            seen.attitude_euler().roll_deg,
            seen.attitude_quaternion().w,
            seen.altitude().altitude_relative_m,
            seen.fixedwing_metrics().climb_rate_m_s,
            seen.raw_gps().hdop,
            seen.position_velocity_ned().position.down_m,
        ):
            assert math.isfinite(number)
        rest(station)
        begun = station.see("ATTITUDE").time_boot_ms
        action.reboot()
        station.until("ATTITUDE", lambda m: m.time_boot_ms < begun)
    station.ready()
