# SPDX-License-Identifier: Apache-2.0
"""The image of FMUv5 on a model of its chip, which flies: what it says of its devices, and equal
flights."""

from __future__ import annotations

import functools
import json
import operator
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shared_builds
from test_board_lines import pymavlink
from test_copter_image import tools

from keel.base.errors import ROOT, ToolError
from keel.boards.dwarf import Variables
from keel.flight import board, scenario
from keel.flight.board import BoardCopter
from keel.flight.library import Link
from keel.flight.loop import Flight, Order
from keel.install import Toolchain
from keel.timing import taskset

__all__ = ["pymavlink", "tools"]  # Fixtures.
READY_MS = 2000
UNKNOWN = 2**32 - 1
# Of MAVLink's common.xml: MAV_SYS_STATUS_SENSOR, and MAV_MODE_FLAG_SAFETY_ARMED.
GYROSCOPE, ACCELEROMETER, MAGNETOMETER, ABSOLUTE_PRESSURE = 0x01, 0x02, 0x04, 0x08
SATELLITES, RECEIVER, ARMED = 0x20, 0x10000, 0x80
# Of each device that can be absent, its name on the console, and what its absence makes unhealthy.
DEVICES = {
    "imu_1": ("imu 1", GYROSCOPE | ACCELEROMETER),
    "imu_2": ("imu 2", GYROSCOPE | ACCELEROMETER),
    "barometer": ("barometer", ABSOLUTE_PRESSURE),
    "magnetometer": ("magnetometer", MAGNETOMETER),
    "memory": ("parameters", 0),
}


@pytest.fixture(scope="module")
def made() -> Path:
    """The image's library."""
    return shared_builds.flying_board(Toolchain(), "fmuv5")


@pytest.fixture
def flown(made: Path) -> BoardCopter:
    """The board's copter, which any other of this process is, too."""
    return BoardCopter(made)


def rest(copter: BoardCopter, from_ms: int, to_ms: int, silent: int | str | None = None) -> int:
    """On the ground, with noise; a unit or another sensor may be silent. The first status that is
    not 0."""
    noise = np.random.default_rng(1)
    for now_ms in range(from_ms + 1, to_ms + 1):
        for unit, imu in enumerate(copter.sensors["imu"]):
            if unit != silent:
                imu["accelerometer"] = (0.0, 0.0, -9.81) + 0.1 * noise.standard_normal(3)
                imu["gyroscope"] = 0.01 * noise.standard_normal(3)
                imu["count"] += 1
        if now_ms % 10 == 0 and silent != "magnetometer":
            field = copter.sensors["magnetometer"]
            field["field"] = (20.0, 1.0, 43.0) + noise.standard_normal(3)
            field["count"] += 1
        if now_ms % 10 == 0 and silent != "barometer":
            air = copter.sensors["barometer"]
            air["pressure"], air["temperature"] = 95_000.0 + 2.0 * noise.standard_normal(), 1520
            air["count"] += 1
        if status := int(copter.run_until(1000 * now_ms)):
            return status
    return 0


def counts(copter: BoardCopter) -> dict[str, int]:
    """The last line of the console that tells how it goes."""
    line = [it for it in copter.text().splitlines() if it.startswith("t ") and " kept " in it][-1]
    words = line.replace(" s ", " ").split()
    return {name: int(value) for name, value in zip(words[::2], words[1::2], strict=True)}


def test_the_board_says_what_is_there_and_measures_what_the_plant_tells(flown: BoardCopter) -> None:
    flown.start(100, False)
    assert rest(flown, 0, 3600) == 0
    said = flown.text().splitlines()
    assert said[:2] == ["Keel on fmuv5: copter", "start by: power"]
    assert said[2:4] == ["imu 1 status 0", "imu 2 status 0"]
    found = counts(flown)
    assert found["imu1"] >= 2900 and found["imu2"] >= 2900
    assert (found["failed1"], found["failed2"], found["skipped"], found["overruns"]) == (0, 0, 0, 0)
    assert abs(found["pa"] - 95_000) <= 10  # Below 20 degrees, with the second order.
    assert found["fields"] > 100
    flown.look()
    down = flown.view["vote"][2]
    assert abs(down + 9.81) < 0.3


def ready_ms(copter: BoardCopter, silent: int | str | None) -> int:
    """When, since power-on, its state machine has made a step, and is disarmed."""
    for now_ms in range(0, READY_MS, 10):
        assert rest(copter, now_ms, now_ms + 10, silent) == 0, copter.why(0)
        copter.look()
        up = copter.view["blocking_checks"] != UNKNOWN
        if up and any(it.runs for it in copter.timed() if it.name == "State machine"):
            assert copter.view["state"] == 0
            return now_ms + 10
    raise AssertionError(f"not ready: {copter.text()}")


def told_by(copter: BoardCopter, pymavlink: Any, silent: int | str | None) -> list[Any]:
    """Each message from its start, which must be in time, until four seconds after power-on."""
    copter.start(100, False)
    ready = ready_ms(copter, silent)
    assert ready < READY_MS
    told = b""
    for now_ms in range(ready, 4000, 10):
        assert rest(copter, now_ms, now_ms + 10, silent) == 0, copter.why(0)
        told += copter.receive(0)
    return list(pymavlink.MAVLink(None).parse_buffer(told))


def check_named(copter: BoardCopter, messages: list[Any], absent: set[str], lacks: int) -> None:
    """Each device that fails is named on the console and by a text, and nothing else is; both
    receivers by texts; and what is not healthy, at least, is not said to be."""
    failing = {
        line.partition(" status ")[0]
        for line in copter.text().splitlines()
        if " status " in line and not line.endswith(" status 0")
    }
    assert failing == {"card"} | absent
    texts = [it.text for it in messages if it.get_type() == "STATUSTEXT"]
    assert sorted(text for text in texts if text.endswith(": fails")) == sorted(
        f"{it}: fails" for it in failing
    )
    assert texts.count("radio: nothing comes from the receiver") == 1
    assert texts.count("GPS: nothing comes from the receiver") == 1
    assert counts(copter)["fixes"] == counts(copter)["radio"] == 0
    health = [it for it in messages if it.get_type() == "SYS_STATUS"][-1]
    missing = ~health.onboard_control_sensors_health & health.onboard_control_sensors_enabled
    assert missing & (SATELLITES | RECEIVER | lacks) == SATELLITES | RECEIVER | lacks
    assert not any(it.base_mode & ARMED for it in messages if it.get_type() == "HEARTBEAT")


@pytest.mark.parametrize(
    "absent",
    [(), *((device,) for device in DEVICES), tuple(DEVICES)],
    ids=["card", *DEVICES, "all"],
)
def test_it_is_disarmed_two_seconds_after_power_on_whatever_is_absent(
    flown: BoardCopter, pymavlink: Any, absent: tuple[str, ...]
) -> None:
    """RST-004, HEA-008. Neither the pilot's receiver nor that of satellites sends, and the slot is
    empty, in all of these; so the last one has nothing but the chip."""
    flown.lack(*absent)
    messages = told_by(flown, pymavlink, None)
    lacks = functools.reduce(operator.or_, (DEVICES[device][1] for device in absent), 0)
    check_named(flown, messages, {DEVICES[device][0] for device in absent}, lacks)


@pytest.mark.parametrize(
    ("silent", "console", "lacks"),
    [
        (0, "imu 1", GYROSCOPE | ACCELEROMETER),
        (1, "imu 2", GYROSCOPE | ACCELEROMETER),
        ("barometer", "", ABSOLUTE_PRESSURE),  # It answers, but never has another sample.
        ("magnetometer", "magnetometer", MAGNETOMETER),
    ],
)
def test_it_is_disarmed_two_seconds_after_power_on_though_one_is_silent(
    flown: BoardCopter, pymavlink: Any, silent: int | str, console: str, lacks: int
) -> None:
    """RST-004. It is at its bus, and gives no sample."""
    messages = told_by(flown, pymavlink, silent)
    check_named(flown, messages, {console} - {""}, lacks)


def test_a_unit_whose_count_stands_is_silent_and_the_other_goes_on(flown: BoardCopter) -> None:
    flown.start(100, False)
    assert rest(flown, 0, 2000) == 0
    assert rest(flown, 2000, 3600, silent=1) == 0
    found = counts(flown)
    assert found["failed1"] == 0 and found["failed2"] > 900


def test_what_the_code_must_not_do_ends_the_flight(made: Path, tmp_path: Path) -> None:
    vectors = b"".join(word.to_bytes(4, "little") for word in (0x2000_4800, 0x0800_8009))
    for code, reason in (
        (bytes.fromhex("00de"), "the processor stopped at 0x08008008"),
        (bytes.fromhex("4ff080400160"), "0x40000000 is no register"),
        (bytes.fromhex("4ff0c0400168"), "reads the page at 0x60000000"),
    ):
        copter = copter_of(made, tmp_path, vectors + code + bytes.fromhex("fee7"))
        copter.start(100, False)
        assert copter.run_until(1000) == 1
        assert reason in copter.why(1)


def copter_of(made: Path, folder: Path, image: bytes) -> BoardCopter:
    """The library with other bytes of an image."""
    if not (folder / board.LIBRARY).exists():  # It is in use from the first time on.
        shutil.copy(made, folder / board.LIBRARY)
    told = json.loads((made.parent / board.IMAGE).read_text())
    (folder / "other.bin").write_bytes(image)
    told["binary"] = str(folder / "other.bin")
    (folder / board.IMAGE).write_text(json.dumps(told))
    return BoardCopter(folder / board.LIBRARY)


def test_what_the_image_does_not_have_is_refused(flown: BoardCopter) -> None:
    with pytest.raises(ToolError, match="the time that they take"):
        flown.start(50, False)
    with pytest.raises(ToolError, match="neither a plain mean"):
        flown.start(100, True)
    with pytest.raises(ToolError, match="one link"):
        flown.start(100, False, [Link(), Link()])


def test_a_parameter_is_in_force_behind_the_next_start(
    made: Path, flown: BoardCopter, tmp_path: Path
) -> None:
    flown.start(100, False, memory=tmp_path / "memory")
    with pytest.raises(ToolError, match="no such parameter"):
        flown.set("NO_SUCH", 1.0)
    flown.set("MAG_CUR_X", 0.25)
    flown.start(100, False, memory=tmp_path / "memory")
    assert rest(flown, 0, 700) == 0
    image = json.loads((made.parent / board.IMAGE).read_text())
    variables = Variables(Toolchain(), Path(image["elf"]))
    taken = variables.find(board.MAIN, "copter").part("parameters.loaded.taken")
    variables.close()
    assert flown.number_at(taken) == 1


def test_the_board_declares_what_is_analysed(flown: BoardCopter) -> None:
    """Row by row, with what a pass and a dispatch cost; Log comes with a card alone."""
    flown.start(100, False)
    assert rest(flown, 0, 1500) == 0
    found = taskset.read(ROOT / "specs/tasksets/fmuv5.toml")
    own = found.costs.pass_us + found.costs.dispatch_us
    assert [
        (task.name, task.class_name, task.period_us, task.phase_us, task.budget_us)
        for task in flown.timed()
    ] == [
        (task.name, task.class_name, task.period, task.phase, task.budget + own)
        for task in found.tasks
        if task.name != "Log"
    ]


def test_equal_flights_are_equal(flown: BoardCopter) -> None:
    hover = scenario.read("hover").model_copy(update={"duration_s": 4.0})
    short = Order(scenario.with_units(hover, board.BOARDS["fmuv5"]), "jsbsim", hover.seed)
    first, again = (Flight(flown, short).fly() for _ in range(2))
    assert first.digest == again.digest
    assert first.column("up").max() > 1.0
    # The bursts of both units alone are 34 bytes of 8 bits at 6.75 MHz: 40.3 us.
    assert next(it for it in flown.timed() if it.name == "Background IMU").longest_us > 40


def test_a_task_that_takes_longer_is_an_overrun(flown: BoardCopter) -> None:
    flown.start(100, False)
    assert rest(flown, 0, 1000) == 0
    before = flown.done()
    task = flown.tasks.index("Foreground radio")
    flown.overrun(task, 3, 500)
    assert rest(flown, 1000, 1200) == 0
    assert (flown.done()["overruns"] - before["overruns"]).tolist() == [
        3 * (number == task) for number in range(len(flown.tasks))
    ]
