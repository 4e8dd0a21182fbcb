# SPDX-License-Identifier: Apache-2.0
"""The board's own faults, on the model of FMUv5: what its image makes of them, and what its outputs
do meanwhile.

All scenarios begin alike, so one flight goes up to the faults; each scenario goes on from there in
a process of its own, as if it had flown alone.
"""

from __future__ import annotations

import json
import os
import pickle
import re
import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from test_board_flight import counts, flown, made, rest

from keel.base.errors import ToolError
from keel.boards.dwarf import Variables
from keel.boards.packages import load
from keel.config import ConfigError
from keel.flight import board, scenario
from keel.flight import command as fly
from keel.flight.board import BoardCopter
from keel.flight.faults import Faults
from keel.flight.library import Copter
from keel.flight.loop import Flight, Order, Trace, state_names
from keel.flight.pins import CAUSES, HIGH, NMI, RESET
from keel.install import Toolchain
from keel.plants.power import Battery

__all__ = ["flown", "made"]  # Fixtures.

NAMES = [name for name in scenario.names() if scenario.of_board(scenario.read(name))]
STARTS_S = 4.9  # Just before the faults.
WATCHDOG_US = 50_000  # With an oscillator of 32 kHz, which the model has.
PERIOD_US = 20_000  # Of the task that hangs.


@dataclass(frozen=True)
class Result:
    """What a process tells."""

    trace: Trace
    text: str


class Common(Flight):
    """A flight up to the faults, which then becomes that of a scenario."""

    def rise(self) -> int:
        now_ms = 0
        while self._time_s(now_ms) < STARTS_S:
            now_ms += 1
            self.step(now_ms)
        return now_ms

    def go_on(self, found: scenario.Scenario, now_ms: int) -> Trace:
        self._scenario = self._pilot.scenario = found
        self._faults = Faults(found.fault, self._copter, self._battery, found.first_fix)
        return self.fly_on(now_ms)


def apart(work: Callable[[], Result]) -> Result:
    """In another process, which has all that this one has."""
    reads, writes = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reads)
        with os.fdopen(writes, "wb") as told:
            told.write(pickle.dumps(work()))
        os._exit(0)
    os.close(writes)
    with os.fdopen(reads, "rb") as told:
        text = told.read()
    os.waitpid(child, 0)
    return cast(Result, pickle.loads(text))


@pytest.fixture(scope="module")
def flies(made: Path) -> Iterator[Callable[[str, float], Result]]:
    """Goes on with a scenario, for so long."""
    copter = BoardCopter(made)
    first = scenario.read(NAMES[0]).model_copy(update={"fault": []})
    flight = Common(copter, Order(first, "jsbsim", first.seed))
    now_ms = flight.rise()
    known: dict[str, Result] = {}

    def fly(name: str, until_s: float) -> Result:
        if name not in known:
            found = scenario.read(name).model_copy(update={"duration_s": until_s})
            known[name] = apart(lambda: Result(flight.go_on(found, now_ms), copter.text()))
        return known[name]

    yield fly


def numbers(result: Result) -> dict[str, int]:
    """The last line that tells how it goes."""

    class Said:
        def text(self) -> str:
            return result.text

    return counts(cast(BoardCopter, Said()))


def column(result: Result, name: str, from_s: float) -> Any:
    """What the view had, from a time on."""
    trace = result.trace
    return trace.view[name][trace.column("time") >= from_s]


def check_flown(result: Result) -> None:
    """All the way, without a mistake of the outputs or a late task."""
    trace = result.trace
    assert not trace.problem and not trace.crash
    assert trace.pins is not None and not trace.pins.mistakes
    assert trace.pins.pulses > 1000
    assert not (trace.done[1]["skipped"] - trace.done[0]["skipped"]).any()
    assert not (trace.done[1]["overruns"] - trace.done[0]["overruns"]).any()


# --- Scenarios. ---


def test_they_begin_alike() -> None:
    """Else one start would not do for all."""
    assert len(NAMES) == len(scenario.BOARD_FAULTS) + len(scenario.CHIP_FAULTS)
    first = scenario.read(NAMES[0])
    for found in map(scenario.read, NAMES):
        assert (found.mode, found.options, found.seed) == (first.mode, first.options, first.seed)
        assert found.pilot[0] == first.pilot[0]
        assert all(hand.at_s > STARTS_S for hand in found.pilot[1:])
        assert all(fault.at_s > STARTS_S for fault in found.fault)


@pytest.mark.parametrize("name", NAMES)
def test_the_host_refuses_them(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Before anything is built; and a flight that somebody else begins, as `make sim` does."""
    assert fly.main(["--scenario", name]) == 2
    told = capsys.readouterr().err
    assert re.search(rf"{name}: fault \w+ is a board's own, .* BOARD=fmuv5 flies it", told)
    host = cast(Copter, SimpleNamespace(tasks=[], has_board=False))
    with pytest.raises(ToolError, match="is a board's own"):
        Faults(scenario.read(name).fault, host, Battery())


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ('kind = "imu_unplugged"', "unit: is missing: imu_unplugged needs unit"),
        ('kind = "spi_low"\nbus = 3', "bus: "),
        ('kind = "spi_low"\nbus = 1\nunit = 1', "unit: is nothing that spi_low has"),
        ('kind = "i2c_low"\nclocks = 0', "clocks: "),
        ('kind = "core_stops"\nuntil_s = 3.0', "until_s: is nothing that core_stops has"),
        ('kind = "task_hangs"', "task: is missing: task_hangs needs task"),
        ('kind = "brown_out"\nsaved_bytes = 40000', "saved_bytes: "),
    ],
)
def test_keys_that_are_refused(tmp_path: Path, fault: str, told: str) -> None:
    text = f'description = "x"\nduration_s = 9.0\n[[fault]]\nat_s = 1.0\n{fault}\n'
    (tmp_path / "own.toml").write_text(text)
    with pytest.raises(ConfigError, match=told):
        scenario.read("own", tmp_path)


def test_a_unit_that_the_board_does_not_have(flown: BoardCopter) -> None:
    with pytest.raises(ToolError, match="the board has no number 3 of it"):
        flown.breaks("imu_unplugged", 3, 0, True)


# --- What breaks, and the aircraft flies on or lands. ---


def test_one_unit_of_two_is_unplugged(flies: Callable[[str, float], Result]) -> None:
    """Nobody drives the line, which the pin's resistor holds high: no sample, and it lands."""
    result = flies("board_imu_unplugged", 7.5)
    check_flown(result)
    assert 400 <= numbers(result)["failed2"] and numbers(result)["failed1"] == 0
    assert state_names(result.trace)[:3] == ["armed", "flying", "landing"]


def test_a_bus_that_is_low(flies: Callable[[str, float], Result]) -> None:
    """Both units for 0.3 s, at a thousand samples a second; then the barometer."""
    result = flies("board_spi_low", 12.0)
    check_flown(result)
    assert 290 <= numbers(result)["failed1"] <= 310
    assert 290 <= numbers(result)["failed2"] <= 310
    assert state_names(result.trace) == ["armed", "flying"]
    up = result.trace.column("up")[result.trace.column("time") >= 5.0]
    assert up.max() - up.min() <= 1.0


def test_a_magnetometer_that_holds_its_bus(flies: Callable[[str, float], Result]) -> None:
    """Five clocks free it; when nothing does, the flight goes on without it, and with it again."""
    result = flies("board_i2c_low", 10.0)
    check_flown(result)
    fields = [
        int(line.split(" fields ")[1].split()[0])
        for line in result.text.splitlines()
        if " fields " in line
    ]
    gained = [after - before for before, after in zip(fields, fields[1:], strict=False)]
    assert min(gained) == 0 and gained[-1] >= 20  # Of 50 a second, from 0.74 s before.
    assert state_names(result.trace) == ["armed", "flying"]


def test_satellites_fall_silent(flies: Callable[[str, float], Result]) -> None:
    result = flies("board_gps_silent", 10.0)
    check_flown(result)
    modes = column(result, "mode", 5.0)
    number = int(modes[0])
    assert number != int(modes[-1])  # From position to altitude.
    assert state_names(result.trace) == ["armed", "flying"]


def test_a_radio_that_is_unplugged(flies: Callable[[str, float], Result]) -> None:
    result = flies("board_radio_unplugged", 8.0)
    check_flown(result)
    assert state_names(result.trace)[:3] == ["armed", "flying", "holding"]


def test_a_line_with_noise(flies: Callable[[str, float], Result]) -> None:
    result = flies("board_radio_line_noise", 8.0)
    check_flown(result)
    assert set(state_names(result.trace)) <= {"armed", "flying", "holding"}


# --- What breaks, and the chip starts anew. ---


@pytest.mark.parametrize(
    ("name", "begins", "within_us", "known_by", "times"),
    [
        ("board_task_hangs", "reset by watchdog", WATCHDOG_US + PERIOD_US, "code 0xb0a20200", 1),
        ("board_core_stops", "reset by watchdog", WATCHDOG_US, "code 0xb0a20200", 1),
        ("board_oscillator_lost", "NMI", 0, "exception 2", 1),
        ("board_brown_out", "reset by supply", 0, "Keel on fmuv5", 2),
    ],
)
def test_the_chip_starts_anew_and_motors_stand(
    flies: Callable[[str, float], Result],
    name: str,
    begins: str,
    within_us: int,
    known_by: str,
    times: int,
) -> None:
    result = flies(name, 6.5)
    pins = result.trace.pins
    assert not result.trace.problem and not result.trace.crash
    assert pins is not None and not pins.mistakes
    assert len(pins.armed) == 1
    fault = pins.events[1]
    assert fault.name == begins
    since_us = fault.at_us - 1e6 * (result.trace.armed_s + 5.0)
    assert -2000.0 <= since_us <= within_us + 2000.0
    assert pins.low_after_us[begins] <= 1000.0
    assert not column(result, "motors_on", 5.2).any()
    assert state_names(result.trace)[-1] == "disarmed"
    assert result.text.count(known_by) == times


# --- A brown-out while parameters are saved. ---


def test_a_brown_out_within_a_save_leaves_the_old_set_or_the_new(
    made: Path, flown: BoardCopter, tmp_path: Path
) -> None:
    """A ground station sets a parameter; the supply goes behind so many bytes of the save."""
    common = load(Toolchain(), "mavlink-packages", "pymavlink.dialects.v20.common")
    station = common.MAVLink(None, srcSystem=255)
    taken, value = kept(made)
    seen = set()
    for number, saved_bytes in enumerate((1, 12, 20)):
        memory = tmp_path / f"memory{number}"
        flown.start(100, False, memory=memory)
        flown.set("MAG_CUR_X", 0.25)
        flown.start(100, False, memory=memory)
        assert rest(flown, 0, 1000) == 0
        assert real(flown, value) == 0.25
        order = station.param_set_encode(1, 1, b"MAG_CUR_X", 0.5, common.MAV_PARAM_TYPE_REAL32)
        flown.breaks("brown_out", 0, saved_bytes, True)
        flown.send(0, order.pack(station))
        assert rest(flown, 1000, 2500) == 0
        assert resets(flown) == ["supply"]
        assert flown.text().count("Keel on fmuv5") == 2
        assert flown.number_at(taken) == 1
        seen.add(real(flown, value))
    assert seen <= {0.25, 0.5} and 0.25 in seen


def kept(made: Path) -> tuple[Any, Any]:
    """Where the image has how many parameters it loaded, and the one that is set."""
    image = json.loads((made.parent / board.IMAGE).read_text())
    variables = Variables(Toolchain(), Path(image["elf"]))
    try:
        taken = variables.find(board.MAIN, "copter").part("parameters.loaded.taken")
        place = variables.find("examples/copter/parameter_store.c", "copter_settings")
        return taken, place.part("field_per_ampere[0]")
    finally:
        variables.close()


def real(copter: BoardCopter, place: Any) -> float:
    """A number of the image."""
    return float(struct.unpack("<f", struct.pack("<I", copter.number_at(place)))[0])


def resets(copter: BoardCopter) -> list[str]:
    """Why the chip was reset since power-up."""
    edges = copter.edges()
    found = edges[(edges["line"] == 9) & (edges["level"] >= RESET)]["level"].tolist()
    return [CAUSES[it - RESET] for it in found[1:]]


# --- On the ground, without motors. ---


def test_no_edge_before_arming(flown: BoardCopter) -> None:
    """Each output goes from floating to low, once, within a millisecond of power-up."""
    flown.start(100, False)
    assert rest(flown, 0, 300) == 0
    edges = flown.edges()
    for output in range(8):
        own = edges[edges["line"] == output]
        assert own["level"].tolist() == [0, 1]
        assert own["at"][1] <= 432 * 100
    assert not (edges["level"][edges["line"] < 8] == HIGH).any()


def test_the_clock_security_system_is_an_nmi(flown: BoardCopter) -> None:
    flown.start(100, False)
    assert rest(flown, 0, 1200) == 0
    flown.breaks("oscillator_lost", 0, 0, True)
    assert rest(flown, 1200, 2600) == 0
    edges = flown.edges()
    assert NMI in edges[edges["line"] == 9]["level"].tolist()
    assert resets(flown)[0] in ("software", "watchdog")
    assert "safe state: fault" in flown.text()
