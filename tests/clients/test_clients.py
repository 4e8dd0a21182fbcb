# SPDX-License-Identifier: Apache-2.0
"""A copter in real time, and three programs of others that talk to it over UDP, all at once.

Nothing here depends on how fast this machine is: each step waits for what it expects, for long.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from other_values import defaults, others
from pymavlink import mavparm, mavutil
from qgroundcontrol import Driver, QGroundControl

from keel.cli.commands import READY
from keel.timeline import ulog

TOOLS = Path(__file__).resolve().parents[2] / "tools"
PARAMETERS = json.loads((TOOLS.parent / "examples/copter/parameters.json").read_text("utf-8"))
LONG_S = 60.0
# docs/telemetry.md.
LAND, POSITION, ALTITUDE, ACRO = 100925440, 196608, 131072, 327680
ARM, SET_MODE = 400, 176
ACCEPTED, REJECTED, DENIED, UNSUPPORTED = 0, 1, 2, 3
ARMED = 128


def free_ports(count: int) -> list[int]:
    """Ports that nobody listens at."""
    sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def wait_for(what: Callable[[], Any], reason: str) -> Any:
    """Until it is so."""
    end = time.monotonic() + LONG_S
    while time.monotonic() < end:
        if found := what():
            return found
        time.sleep(0.05)
    raise AssertionError(f"not in {LONG_S:.0f} s: {reason}")


class Station:
    """A ground station by pymavlink."""

    def __init__(self, port: int) -> None:
        self.link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=255)
        self.texts: list[str] = []

    def see(self, *kinds: str) -> Any:
        """The next message of these kinds."""
        end = time.monotonic() + LONG_S
        while time.monotonic() < end:
            message = self.link.recv_match(blocking=True, timeout=1)
            if message is None:
                continue
            if message.get_type() == "STATUSTEXT":
                self.texts.append(message.text)
            if message.get_type() in kinds:
                return message
        raise AssertionError(f"not in {LONG_S:.0f} s: {kinds}")

    def until(self, kind: str, good: Callable[[Any], bool]) -> Any:
        """The next message of a kind that is so."""
        while not good(message := self.see(kind)):
            pass
        return message

    def ask(self, command: int, *params: float) -> int:
        """A command's answer. What is lost on the way is asked again."""
        numbers = [*params, *([0.0] * (7 - len(params)))]
        for attempt in range(10):
            self.link.mav.command_long_send(1, 1, command, attempt, *numbers)
            end = time.monotonic() + 3.0
            while time.monotonic() < end:
                answer = self.link.recv_match(
                    type=["COMMAND_ACK", "STATUSTEXT"], blocking=True, timeout=1
                )
                if answer is not None and answer.get_type() == "STATUSTEXT":
                    self.texts.append(answer.text)
                elif answer is not None and answer.command == command:
                    return int(answer.result)
        raise AssertionError(f"command {command}: no answer")

    def hear(self, text: str) -> None:
        """Until it was said."""
        while not any(text in said for said in self.texts):
            self.see("STATUSTEXT")

    def rest(self) -> None:
        """Whatever it does, it ends on the ground with its motors off."""

        def at_rest() -> bool:
            if not self.until("HEARTBEAT", lambda message: message.type == 2).base_mode & ARMED:
                return True
            self.ask(SET_MODE, 1, LAND)
            return False

        wait_for(at_rest, "at rest")

    def ready(self) -> None:
        """Until it may be armed."""
        self.until("SYS_STATUS", lambda m: m.onboard_control_sensors_health & 0x10000000)


@contextlib.contextmanager
def powered_up(ports: list[int], folder: Path, *options: str) -> Iterator[subprocess.Popen[bytes]]:
    """A copter with a link to each of these ports."""
    addresses = [part for port in ports for part in ("--address", f"127.0.0.1:{port}")]
    with (folder / "log").open("w") as out:
        sim = subprocess.Popen(
            [
                sys.executable,
                str(TOOLS / "keel"),
                "sim",
                "--cold",
                "--build",
                str(folder),
                *addresses,
                *options,
            ],
            stdin=subprocess.PIPE,
            stdout=out,
            stderr=subprocess.STDOUT,
            env={**os.environ, READY: "sim"},  # These tests have all packages of that group.
        )
        try:
            wait_for(
                lambda: "Ctrl-C" in (folder / "log").read_text() or sim.poll() is not None,
                "the copter's start",
            )
            yield sim
        finally:
            sim.send_signal(signal.SIGINT)
            try:
                assert sim.wait(LONG_S) == 0, (folder / "log").read_text()
            finally:
                sim.kill()


@pytest.fixture(scope="module")
def ports(tmp_path_factory: pytest.TempPathFactory) -> Iterator[list[int]]:
    """A copter that has just been powered up: the ports at which its three links arrive."""
    found, folder = free_ports(3), tmp_path_factory.mktemp("sim")
    with powered_up(found, folder):
        yield found
    assert len(ulog.read(folder / "sim.ulg").topic("attitude")) > 100


@pytest.fixture(scope="module")
def station(ports: list[int]) -> Iterator[Station]:
    """Who looks on."""
    made = Station(ports[0])
    yield made
    made.link.close()


def test_who_has_just_been_powered_up_is_not_armed(station: Station) -> None:
    station.see("HEARTBEAT")
    assert station.ask(ARM, 1) == REJECTED
    station.hear("not armed: ")


def test_pymavlink_reads(station: Station) -> None:
    station.ready()
    assert abs(station.see("ATTITUDE").roll) < 0.1
    place = station.see("GLOBAL_POSITION_INT")
    assert abs(place.lat / 1e7 - 47.3977) < 0.001 and abs(place.lon / 1e7 - 8.5456) < 0.001
    assert 14000 < station.see("BATTERY_STATUS").voltages[0] < 17500
    assert station.see("SYS_STATUS").battery_remaining > 90
    assert station.see("GPS_RAW_INT").fix_type == 3
    assert station.see("RC_CHANNELS").chan3_raw < 1080


def test_pymavlink_lists_and_sets_parameters(station: Station) -> None:
    mav = station.link.mav
    known: dict[str, float] = {}
    mav.param_request_list_send(1, 1)
    while True:
        value = station.see("PARAM_VALUE")
        known[value.param_id] = value.param_value
        if len(known) == value.param_count:
            break
    assert abs(known["POS_P"] - 0.8) < 1e-6 and len(known) > 50
    real = mavutil.mavlink.MAV_PARAM_TYPE_REAL32
    mav.param_set_send(1, 1, b"HEIGHT_P", 1.25, real)
    assert station.until("PARAM_VALUE", lambda m: m.param_id == "HEIGHT_P").param_value == 1.25
    for value, kind in (
        (1.0e9, real),
        (float("nan"), real),
        (5.0, mavutil.mavlink.MAV_PARAM_TYPE_INT32),
    ):
        mav.param_set_send(1, 1, b"HEIGHT_P", value, kind)
        same = station.until("PARAM_VALUE", lambda m: m.param_id == "HEIGHT_P")
        assert same.param_value == 1.25
        assert station.see("PARAM_ERROR").param_id == "HEIGHT_P"
    mav.param_request_read_send(1, 1, b"HEIGHT_P", -1)
    assert station.until("PARAM_VALUE", lambda m: m.param_id == "HEIGHT_P").param_value == 1.25


def values_seen(station: Station) -> dict[str, float]:
    """All parameters, as pymavlink reads them; what is lost on the way is asked for again."""
    station.link.mav.param_request_list_send(1, 1)
    known: dict[str, float] = {}
    missing = range(len(defaults()))
    for _ in range(10):
        for index in missing if known else ():
            station.link.mav.param_request_read_send(1, 1, b"", index)
        while value := station.link.recv_match(type="PARAM_VALUE", blocking=True, timeout=1):
            known[value.param_id] = value.param_value
            missing = [index for index in missing if index != value.param_index]
            if not missing:
                return known
    raise AssertionError(f"parameters {missing}: not told")


def test_pymavlink_keeps_parameters_in_a_file(station: Station, tmp_path: Path) -> None:
    kept = mavparm.MAVParmDict()
    kept.update(values_seen(station))
    kept.save(str(tmp_path / "kept.parm"))
    asked = others()
    for name, value in asked.items():
        assert kept.mavset(station.link, name, value)
    assert values_seen(station) == asked
    assert kept.load(str(tmp_path / "kept.parm"), mav=station.link)
    expected = {**defaults(), "HEIGHT_P": 1.25}  # As a test before has set it.
    assert values_seen(station) == expected


def test_pymavlink_is_refused_what_must_be(station: Station) -> None:
    station.ready()
    assert station.ask(ARM, 1, 21196) == DENIED  # By force.
    assert station.ask(ARM, 0.5) == DENIED
    assert station.ask(ARM, float("nan")) == DENIED
    assert station.ask(SET_MODE, 1, ACRO) == DENIED
    assert station.ask(SET_MODE, 1, 4) == DENIED  # ArduCopter's "guided".
    assert station.ask(SET_MODE, 0, POSITION) == DENIED
    assert station.ask(511, 77, 100000) == DENIED  # Intervals of answers.
    assert station.ask(22) == UNSUPPORTED
    assert not station.until("HEARTBEAT", lambda m: m.type == 2).base_mode & ARMED


class Shell:
    """A terminal as PX4's mavlink_shell.py makes one of pymavlink: what is typed goes out in
    messages of up to 70 bytes, and what comes is looked for every 30 ms."""

    def __init__(self, link: Any) -> None:
        self._link = link
        self.text = ""

    def write(self, text: str) -> None:
        """Type."""
        mav = mavutil.mavlink
        for start in range(0, len(text), 70):
            part = [ord(one) for one in text[start : start + 70]]
            self._link.mav.serial_control_send(
                mav.SERIAL_CONTROL_DEV_SHELL,
                mav.SERIAL_CONTROL_FLAG_EXCLUSIVE | mav.SERIAL_CONTROL_FLAG_RESPOND,
                0,
                0,
                len(part),
                part + [0] * (70 - len(part)),
            )

    def until(self, text: str) -> None:
        """Until it is there."""

        def there() -> bool:
            found = self._link.recv_match(
                condition="SERIAL_CONTROL.count!=0",
                type="SERIAL_CONTROL",
                blocking=True,
                timeout=0.03,
            )
            if found is not None:
                self.text += "".join(chr(byte) for byte in found.data[: found.count])
            return text in self.text

        wait_for(there, f"{text!r} in {self.text!r}")

    def close(self) -> None:
        """Ctrl-C."""
        self._link.mav.serial_control_send(
            mavutil.mavlink.SERIAL_CONTROL_DEV_SHELL, 0, 0, 0, 0, [0] * 70
        )


def test_pymavlink_has_a_shell(station: Station) -> None:
    shell = Shell(station.link)
    shell.write("\n")  # So that there is one.
    shell.until("\nkeel> ")
    shell.write("tasks\n")
    shell.until("Telemetry ")
    shell.until("\nkeel> ")
    rows = [line.split() for line in shell.text.splitlines() if line.startswith("Background IMU")]
    assert len(rows) == 1 and rows[0][2] == "1000" and int(rows[0][3]) > 1000
    shell.write("reboot\n")
    shell.until("reboot\nno such command: reboot; there are: help, tasks\nkeel> ")
    shell.close()


def test_pymavlink_flies(station: Station) -> None:
    station.ready()
    assert station.ask(ARM, 1) == ACCEPTED
    station.until("HEARTBEAT", lambda m: m.base_mode & ARMED)
    station.until("EXTENDED_SYS_STATE", lambda m: m.landed_state == 2)
    assert station.ask(ARM, 0) == DENIED  # In flight.
    assert station.ask(ARM, 0, 21196) == DENIED
    station.until("LOCAL_POSITION_NED", lambda m: m.z < -1.5)
    assert station.ask(SET_MODE, 1, ALTITUDE) == ACCEPTED
    station.until("HEARTBEAT", lambda m: m.custom_mode == ALTITUDE)
    assert station.ask(SET_MODE, 1, LAND) == ACCEPTED
    station.until("HEARTBEAT", lambda m: not m.base_mode & ARMED)
    station.hear("disarmed")
    assert {"armed", "flying", "landing"} <= set(station.texts)


def mavsdk_sets_parameters(param: Any) -> None:
    """All of them by the functions for floats; those for integers say that it is no integer."""
    from mavsdk.plugins.param.param import ParamError, ParamResult

    known = param.get_all_params()
    before = {one.name: one.value for one in known.float_params}
    assert set(before) == set(defaults()) and not known.int_params
    for name, value in others().items():
        param.set_param_float(name, value)
        assert param.get_param_float(name) == value
        param.set_param_float(name, before[name])
    with pytest.raises(ParamError) as refused:
        param.set_param_float("FS_RETURN", 0.5)
    for wrong in (
        lambda: param.get_param_int("BAT_CELLS"),
        lambda: param.set_param_int("BAT_CELLS", 5),
    ):
        with pytest.raises(ParamError) as refused:
            wrong()
        assert ParamResult.WRONG_TYPE.name in str(refused.value)
    after = {one.name: one.value for one in param.get_all_params().float_params}
    assert after == before


def test_mavsdk(station: Station, ports: list[int]) -> None:
    from mavsdk.component_type import ComponentType
    from mavsdk.mavsdk import Configuration, Mavsdk
    from mavsdk.plugins.action import Action
    from mavsdk.plugins.action.action import ActionError
    from mavsdk.plugins.param import Param
    from mavsdk.plugins.telemetry import Telemetry

    station.rest()
    station.ready()
    kind = Configuration.create_with_component_type(ComponentType.GROUND_STATION)
    with Mavsdk(kind) as sdk:
        sdk.add_any_connection(f"udpin://127.0.0.1:{ports[1]}")
        system = sdk.first_autopilot(LONG_S)
        assert system is not None
        seen, param, action = Telemetry(system), Param(system), Action(system)
        wait_for(lambda: abs(seen.position().latitude_deg - 47.3977) < 0.001, "a position")
        wait_for(lambda: abs(seen.attitude_euler().roll_deg) < 5.0, "an attitude")
        wait_for(lambda: 14.0 < seen.battery().voltage_v < 17.5, "a battery")
        wait_for(lambda: seen.health().is_global_position_ok, "its health")
        mavsdk_sets_parameters(param)
        for refused in (action.arm_force, action.kill, action.return_to_launch, action.land):
            with pytest.raises(ActionError):
                refused()
        assert not seen.armed()
        action.arm()
        wait_for(seen.armed, "armed")
    station.rest()


def mavproxy_keeps_parameters(station: Station, says: Callable[..., None], folder: Path) -> None:
    """It shows them, saves them to a file, loads others, and hears why it cannot set one."""
    before, count = values_seen(station), len(defaults())
    says("param save before.parm", f"Saved {count} parameters to before.parm")
    says("param show FS_RETURN", "FS_RETURN        1.0")
    asked = {**others(), "BAT_CELLS": 6.0}
    lines = [f"{name} {value:.9g}\n" for name, value in asked.items()]
    (folder / "asked.parm").write_text("".join(lines))
    says("param load asked.parm", f"Loaded {count} parameters from asked.parm")
    wait_for(lambda: values_seen(station) == asked, "what MAVProxy has loaded")
    says("param fetch BAT_CELLS", "BAT_CELLS = 6.0")
    says("param save after.parm", f"Saved {count} parameters to after.parm")
    saved = dict(line.split() for line in (folder / "after.parm").read_text().splitlines())
    assert {name: float(value) for name, value in saved.items()} == pytest.approx(asked, abs=1e-6)
    says("param load before.parm", f"Loaded {count} parameters from before.parm")
    wait_for(lambda: values_seen(station) == before, "what it had before")
    says(
        "param set BAT_CELLS 4.5",
        "BAT_CELLS: not set, not a whole number",
        "Failed to set BAT_CELLS to 4.5 (invalid returned value 4.0)",
    )
    assert values_seen(station) == before


def test_mavsdk_reads_files_and_empty_lists(
    station: Station, ports: list[int], tmp_path: Path
) -> None:
    from mavsdk.component_type import ComponentType
    from mavsdk.mavsdk import Configuration, Mavsdk
    from mavsdk.plugins.component_metadata import ComponentMetadata
    from mavsdk.plugins.component_metadata.component_metadata import MetadataType
    from mavsdk.plugins.ftp import Ftp
    from mavsdk.plugins.ftp.ftp import FtpResult
    from mavsdk.plugins.log_files import LogFiles
    from mavsdk.plugins.log_files.log_files import LogFilesError
    from mavsdk.plugins.mission_raw import MissionRaw
    from mavsdk.plugins.mission_raw.mission_raw import MissionRawError

    kind = Configuration.create_with_component_type(ComponentType.GROUND_STATION)
    with Mavsdk(kind) as sdk:
        sdk.add_any_connection(f"udpin://127.0.0.1:{ports[1]}")
        system = sdk.first_autopilot(LONG_S)
        assert system is not None
        files = Ftp(system)
        listed = files.list_directory("/").entries
        assert [one.name for one in listed] == ["general.json", "parameters.json"]
        for use_burst in (True, False):
            folder = tmp_path / str(use_burst)
            folder.mkdir()
            ended: list[int] = []
            files.download_async(
                "/parameters.json",
                str(folder),
                use_burst,
                lambda result, _progress, _data: ended.append(int(result)),
            )
            wait_for(lambda: any(one != FtpResult.NEXT for one in ended), "a file")
            assert ended[-1] == FtpResult.SUCCESS
            assert json.loads((folder / "parameters.json").read_text()) == PARAMETERS
            assert files.are_files_identical(str(folder / "parameters.json"), "/parameters.json")
        metadata = ComponentMetadata(system)
        updates: list[str] = []
        metadata.subscribe_metadata_available(lambda one, _: updates.append(one.json_metadata))
        metadata.request_autopilot_component()
        wait_for(lambda: updates, "metadata")
        found = metadata.get_metadata(1, int(MetadataType.PARAMETER)).json_metadata
        assert json.loads(found) == PARAMETERS
        with pytest.raises(LogFilesError, match="NO_LOGFILES"):
            LogFiles(system).get_entries()
        plans = MissionRaw(system)
        begun = time.monotonic()
        plans.clear_mission()
        for download in (
            plans.download_mission,
            plans.download_geofence,
            plans.download_rallypoints,
        ):
            try:
                assert download() == []
            except MissionRawError as error:
                assert "NO_MISSION" in str(error), error
        assert time.monotonic() - begun < 5.0  # Without a time-out.


def test_qgroundcontrol(station: Station, ports: list[int]) -> None:
    """Its sequence (see qgroundcontrol.py), in real time."""
    link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{ports[2]}", source_system=253)
    link.wait_heartbeat()
    driver, begun = Driver(), time.monotonic()
    made = QGroundControl(link.mav.send, 253)
    driver.add(made.connect(), 0)
    while driver.done[0] < 0:
        assert time.monotonic() - begun < LONG_S
        message = link.recv_match(blocking=True, timeout=0.1)
        now_ms = round(1000.0 * (time.monotonic() - begun))
        driver.hear(0, [] if message is None else [message], now_ms)
    link.close()
    assert not made.met.errors
    assert json.loads(made.met.files["parameters"]) == PARAMETERS
    assert made.met.plans == {"mission": 0, "fence": 0, "rally": 0}


def test_mavproxy(station: Station, ports: list[int], tmp_path: Path) -> None:
    station.rest()
    station.ready()
    found = mavproxy_program()
    log = tmp_path / "log"
    with log.open("w") as out:
        proxy = subprocess.Popen(
            [
                sys.executable,
                str(found),
                f"--master=udpin:127.0.0.1:{ports[2]}",
                "--default-modules=param,arm,mode,ftp,wp,log,nsh",
                f"--state-basedir={tmp_path}",
            ],
            stdin=subprocess.PIPE,
            stdout=out,
            stderr=subprocess.STDOUT,
            cwd=tmp_path,
            text=True,
            env={**os.environ, "HOME": str(tmp_path)},
        )
        try:

            def says(line: str, *expected: str) -> None:
                assert proxy.stdin is not None
                proxy.stdin.write(line + "\n")
                proxy.stdin.flush()
                for text in expected:
                    wait_for(lambda: text in log.read_text(), f"{text} in {log.read_text()}")

            says("", f"Received {len(defaults())} parameters")
            says("param set RTL_HEIGHT 12")
            station.until("PARAM_VALUE", lambda m: m.param_id == "RTL_HEIGHT")
            says("param fetch RTL_HEIGHT", "RTL_HEIGHT = 12.0")
            mavproxy_keeps_parameters(station, says, tmp_path)
            says(f"mode {ALTITUDE}", "DO_SET_MODE: ACCEPTED")
            says("arm throttle", "COMPONENT_ARM_DISARM: ACCEPTED", "ARMED")
            says(f"mode {ACRO}", "DO_SET_MODE: DENIED")
            says("status ATTITUDE", "ATTITUDE {")
            says("ftp list /", "general.json", "parameters.json")
            says("wp list", "Requesting 0 waypoints")
            says("nsh start")
            says("tasks", "Background IMU              1000 ", "Telemetry                   4000 ")
            says("reboot", "no such command: reboot; there are: help, tasks\nkeel> ")
            says(".")
        finally:
            proxy.kill()  # It does not heed SIGTERM for long.
            proxy.wait(LONG_S)
    station.rest()


def mavproxy_program() -> Path:
    """MAVProxy's own starter, among the packages."""
    for folder in sys.path:
        starter = Path(folder) / "bin/mavproxy.py"
        if starter.is_file():
            return starter
    raise AssertionError("mavproxy.py: is not there")


def test_what_is_typed_is_answered_in_the_terminal(tmp_path: Path) -> None:
    """And a pipe that ends, ends nothing else."""
    with powered_up(free_ports(1), tmp_path) as sim:
        assert sim.stdin is not None
        for typed, expected in (
            ("tasks", "\nTelemetry                   4000 "),
            ("nothing", "\nno such command: nothing; there are: help, tasks\n"),
        ):
            sim.stdin.write(f"{typed}\n".encode())
            sim.stdin.flush()
            wait_for(lambda: expected in (tmp_path / "log").read_text(), typed)
        sim.stdin.close()
        time.sleep(0.5)
        assert sim.poll() is None


def test_a_restart_with_signatures_and_parameters(tmp_path: Path) -> None:
    """By one key: the station goes on, what was set is there, and a frame that was recorded before
    the restart does not count again."""
    (tmp_path / "key").write_text("5A" * 32)
    port = free_ports(1)
    station = Station(port[0])
    options = ("--key", str(tmp_path / "key"))
    try:
        with powered_up(port, tmp_path, *options):
            station.see("HEARTBEAT")  # pymavlink forgets keys that it has before the first frame.
            station.link.setup_signing(b"\x5a" * 32)
            station.link.param_set_send("HEIGHT_P", 1.25)
            station.until("PARAM_VALUE", lambda m: m.param_value == 1.25)
            set_to_2 = station.link.mav.param_set_encode(1, 1, b"HEIGHT_P", 2.0, 9)
            frame = set_to_2.pack(station.link.mav)  # Signed, and sent twice below.
            station.link.write(frame)
            station.until("PARAM_VALUE", lambda m: m.param_value == 2.0)
            station.link.param_set_send("HEIGHT_P", 1.25)
            station.until("PARAM_VALUE", lambda m: m.param_value == 1.25)
            station.until("SYS_STATUS", lambda m: True)
            time.sleep(2.0)  # It is saved.
        while station.link.recv_match(blocking=True, timeout=0.5):
            pass  # Of before the restart.
        with powered_up(port, tmp_path, *options):
            station.see("HEARTBEAT")
            station.link.write(frame)
            time.sleep(1.0)
            station.link.param_fetch_one("HEIGHT_P")
            assert station.see("PARAM_VALUE").param_value == 1.25
            assert station.see("HEARTBEAT").get_signed()
    finally:
        station.link.close()
