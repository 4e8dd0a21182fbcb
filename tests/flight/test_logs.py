# SPDX-License-Identifier: Apache-2.0
"""The copter's log: another's reader takes it whole, it says what the flight was, and what is
missing; known vibrations are found in it."""

from __future__ import annotations

import csv
import math
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pyulog import ULog
from short_flight import short

from keel.base.errors import ROOT, ToolError
from keel.flight import library, loop
from keel.flight.library import Copter, Link
from keel.flight.loop import Order, Trace
from keel.flight.sensors import TEMPERATURES
from keel.install import Toolchain
from keel.logs import log as log_tool
from keel.logs import log_plots
from keel.logs.spectrum import spectrum
from keel.timeline import runs, ulog

GRAVITY = 9.80665
# Of unit 1's accelerometer and gyroscope: Hz and amplitude. Two samples of the 1000 a second make
# one that is logged, whose amplitude is less by cos(pi f / 1000).
SHAKES = {41.0: 2.0, 87.0: 1.0, 163.0: 1.5}


def order(folder: Path) -> Order:
    """A flight that takes little time."""
    return Order(short(folder), "mujoco", 1)


@pytest.fixture(scope="module")
def flown(copter: Copter, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Trace]:
    """A flight's log, and its trace."""
    folder = tmp_path_factory.mktemp("log")
    path = folder / "short.ulg"
    return path, loop.fly(copter, order(folder), path)


def tool(name: str, *arguments: str | Path) -> str:
    """What a tool of pyulog prints; it must not complain."""
    program = f"import sys; from pyulog.{name} import main; sys.argv[0] = '{name}'; main()"
    done = subprocess.run(
        [sys.executable, "-c", program, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    assert "corrupt" not in done.stdout.lower() and "warning" not in done.stdout.lower()
    return done.stdout


def test_a_log_changes_no_flight(copter: Copter, flown: tuple[Path, Trace], tmp_path: Path) -> None:
    assert not flown[1].problem and not flown[1].crash
    assert loop.fly(copter, order(tmp_path)).digest == flown[1].digest


def test_equal_flights_have_equal_logs(
    copter: Copter, flown: tuple[Path, Trace], tmp_path: Path
) -> None:
    loop.fly(copter, order(tmp_path), tmp_path / "again.ulg")
    assert (tmp_path / "again.ulg").read_bytes() == flown[0].read_bytes()


def test_tools_of_pyulog_read_it(flown: tuple[Path, Trace], tmp_path: Path) -> None:
    told = tool("info", flown[0])
    assert "No Dropouts" in told and "sys_name: Keel" in told
    assert len([line for line in told.splitlines() if " (" in line and "id" not in line]) == 17
    parameters = dict(line.split(",") for line in tool("params", flown[0]).split())
    table = tomllib.loads((ROOT / "specs/parameters/copter.toml").read_text())
    names = {row["name"] for group in table["group"] for row in group["parameter"]}
    assert set(parameters) == names
    assert math.isclose(float(parameters["ROLL_P"]), 7.0)
    assert math.isclose(float(parameters["THR_HOVER"]), 0.37, rel_tol=1e-6)
    texts = tool("messages", flown[0])
    assert texts.index("armed") < texts.index("flying")
    tool("ulog2csv", "-o", tmp_path, flown[0])
    with (tmp_path / "short_attitude_0.csv").open() as file:
        rows = list(csv.DictReader(file))
    first = ulog.read(flown[0]).topic("attitude")[0]
    assert [float(rows[0][f"q[{k}]"]) for k in range(4)] == pytest.approx(first["q"].tolist())


def test_our_reader_reads_what_pyulogs_does(flown: tuple[Path, Trace]) -> None:
    ours, theirs = ulog.read(flown[0]), ULog(str(flown[0]))
    assert not theirs.file_corruption and ours.cut == 0
    assert ours.parameters == theirs.initial_parameters
    assert ours.start_us == theirs.start_timestamp
    assert len(ours.data) == len(theirs.data_list)
    for topic in theirs.data_list:
        data = ours.topic(topic.name, topic.multi_id)
        for name, column in topic.data.items():
            field, _, index = name.partition("[")
            own = data[field][:, int(index[:-1])] if index else data[field]
            np.testing.assert_array_equal(own, column)


def test_it_says_what_the_flight_was(flown: tuple[Path, Trace]) -> None:
    """What a task wrote last before a row of the trace, is in that row; the last 20 ms are still on
    their way to the file when the flight ends."""
    log, trace = ulog.read(flown[0]), flown[1]
    rows_us = np.round((trace.armed_s + trace.column("time")) * 1e6)
    rows_us = rows_us[rows_us < rows_us[-1] - 20000]
    count = len(rows_us)
    assert count > 1500
    for topic, name, seen in (
        ("estimate", "position", "position"),
        ("estimate", "velocity", "velocity"),
        ("health", "load_ppm", "load_ppm"),
    ):
        data = log.topic(topic)
        last = np.searchsorted(data["timestamp"], rows_us) - 1
        np.testing.assert_array_equal(data[name][last], trace.view[seen][:count])
    for unit, said in enumerate(TEMPERATURES):
        assert np.all(log.topic("imu", unit)["temperature_cdeg"][100:] == said)
    control = log.topic("control")
    last = np.searchsorted(control["timestamp"], rows_us) - 1
    fresh = rows_us - control["timestamp"][last] < 1900  # The next run comes after 2000 us.
    motors = control["motor"][last][:, :4]
    motor = trace.view["motor"][:count]
    assert np.mean(np.abs(motors - motor)) < 0.02
    np.testing.assert_array_equal(motors[fresh], motor[fresh])


def test_temperatures_and_supply_are_the_last_ones(copter: Copter, tmp_path: Path) -> None:
    """As another's reader has them, with a barometer that warms up by a hundredth of a degree in
    20 ms, and a chip that is not measured in the third second."""
    path = tmp_path / "warm.ulg"
    copter.log(path)
    copter.start(100, plain_mean=False)
    barometer, chip = copter.sensors["barometer"], copter.sensors["chip"]
    for now_ms in range(1, 5001):
        lie(copter, now_ms)
        if now_ms % 20 == 0:
            barometer["pressure"], barometer["count"] = 96000.0, now_ms
            barometer["temperature"] = now_ms // 20 - 100
        if now_ms % 100 == 0 and not 2000 < now_ms <= 3000:
            chip["supply"], chip["count"] = 3300 - now_ms // 100, now_ms
            chip["temperature"] = 2000 + now_ms // 100
        assert copter.run_until(1000 * now_ms) == 0
    copter.log(None)
    topics = {topic.name: topic.data for topic in ULog(str(path)).data_list if topic.multi_id == 0}
    air, health = topics["air"], topics["health"]
    warm = air["samples"] > 0
    late_ms = air["timestamp"][warm] / 1e3 - 20.0 * (air["temperature_cdeg"][warm] + 100)
    assert len(late_ms) > 230 and late_ms.min() >= 0.0 and late_ms.max() < 40.0
    assert np.all(air["pressure_pa"][warm] == 96000.0)
    measured, known = health["has_supply"].astype(bool), health["has_chip"].astype(bool)
    np.testing.assert_array_equal(measured, known)
    second = health["timestamp"] / 1e6
    asked = np.floor(second[1:][np.diff(measured.astype(int)) != 0])
    assert measured[second > 4.5].all() and not measured[(second > 3.2) & (second < 3.8)].any()
    assert len(asked) >= 2
    told = health["supply_mv"][known] + health["chip_cdeg"][known].astype(int)
    assert np.all(told == 5300)  # Both of the same time,
    age_s = second[known] - (health["chip_cdeg"][known] - 2000) / 10.0
    assert age_s.min() >= 0.0 and age_s.max() < 1.2  # and not older than a run of ADC.
    assert not health["supply_mv"][~known].any() and not health["chip_cdeg"][~known].any()


def test_rates_are_as_stated(flown: tuple[Path, Trace]) -> None:
    log = ulog.read(flown[0])
    for (name, _), period_us in zip(
        log.data,
        [2000] * 3
        + [10000] * 3
        + [50000, 20000, 20000]
        + [100000] * 3
        + [20000, 100000]
        + [1000000, 100000, 1000000],
        strict=True,
    ):
        data = log.data[name, 0]
        assert abs(np.median(np.diff(data["timestamp"].astype(int))) - period_us) <= 400, name


@pytest.fixture(scope="module")
def traced(copter: Copter, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Trace]:
    """The flight again, with each run of each task in its log."""
    folder = tmp_path_factory.mktemp("traced")
    path = folder / "traced.ulg"
    return path, loop.fly(copter, order(folder), path, runs=True)


def test_each_run_in_a_log_changes_no_flight_and_is_taken_whole(
    traced: tuple[Path, Trace], flown: tuple[Path, Trace]
) -> None:
    assert traced[1].digest == flown[1].digest
    told = tool("info", traced[0])
    assert "No Dropouts" in told
    assert {topic.name for topic in ULog(str(traced[0])).data_list} == (
        {name for name, _ in ulog.read(flown[0]).data} - {"imu"} | {"run", "task"}
    )


def test_runs_are_what_the_scheduler_counted(traced: tuple[Path, Trace]) -> None:
    """Between each two of the counts that the log's own task samples once a second."""
    log, names = ulog.read(traced[0]), log_tool.task_names()
    counts, ran = log.topic("tasks"), runs.read(traced[0])
    assert len(counts) > 10 and len(ran.tasks) == 22
    for number, task in enumerate(ran.tasks):
        row, own = names.index(task.name), ran.of(number)
        edges = np.searchsorted(own["start"], counts["timestamp"])
        lengths = own["end"] - own["start"]
        done, busy = np.append(0, np.cumsum(lengths)), counts["busy_us"][:, row].astype(int)
        np.testing.assert_array_equal(np.diff(counts["runs"][:, row].astype(int)), np.diff(edges))
        np.testing.assert_array_equal(np.diff(busy), np.diff(done[edges]))
        assert max(lengths[: edges[-1]]) == counts["longest_us"][-1, row]
        assert own["skipped"].sum() == counts["skipped"][-1, row] == 0
    np.testing.assert_array_equal(ran.runs["start"][1:] >= ran.runs["end"][:-1], True)


def test_a_log_with_each_run_is_drawn(traced: tuple[Path, Trace], tmp_path: Path) -> None:
    assert log_tool.main([str(traced[0]), "--picture", str(tmp_path / "traced.svg")]) == 0
    assert ">aft left<" in (tmp_path / "traced.svg").read_text()


def test_what_does_not_fit_is_a_dropout(tmp_path: Path) -> None:
    built = library.build(Toolchain(), tmp_path, more=("-DKEEL_LOG_RING_BYTES=640u",))
    path = tmp_path / "small.ulg"
    trace = loop.fly(Copter(built), order(tmp_path), path)
    assert not trace.problem and not trace.crash
    theirs, ours = ULog(str(path)), ulog.read(path)
    assert not theirs.file_corruption
    assert len(theirs.dropouts) == len(ours.dropouts) > 10
    whole = trace.armed_s + 8.0
    assert 0.0 < sum(each.duration for each in theirs.dropouts) / 1e3 < whole
    assert len(ours.topic("imu")) < 0.95 * 500.0 * whole
    assert "Dropouts: count" in tool("info", path)


def lie(copter: Copter, now_ms: int, moved: float = 0.0) -> None:
    """What the inertial units measure on the ground, when unit 1 is moved so much."""
    memory: Any = copter.sensors["imu"]
    for unit in range(3):
        value = moved if unit == 0 else 0.0
        memory["accelerometer"][unit] = (value, 0.0, -GRAVITY)
        memory["gyroscope"][unit] = (0.0, 0.1 * value, 0.0)
        memory["count"][unit] = now_ms


def test_log_and_telemetry_go_together(copter: Copter, tmp_path: Path) -> None:
    """No run of either is left out, with telemetry on all its links."""
    path = tmp_path / "both.ulg"
    copter.log(path)
    copter.start(100, plain_mean=False, links=[Link()] * copter.links)
    sent = 0
    for now_ms in range(1, 5001):
        lie(copter, now_ms)
        assert copter.run_until(1000 * now_ms) == 0
        sent += sum(len(copter.receive(link)) for link in range(copter.links))
    copter.log(None)
    log = ulog.read(path)
    last = log.topic("tasks")[-1]
    assert sent > 3_000 and not log.dropouts
    assert not last["skipped"].any()
    runs_per_s = last["runs"][len(copter.tasks) :] / (last["timestamp"] / 1e6)
    assert runs_per_s[:2] == pytest.approx([100.0, 250.0], rel=0.02)


def shaken(copter: Copter, path: Path) -> None:
    """Ten seconds on the ground, with unit 1 shaking."""
    copter.log(path)
    copter.start(100, plain_mean=False)
    for now_ms in range(1, 10001):
        value = sum(
            size * math.sin(2.0 * math.pi * hertz * now_ms / 1000.0)
            for hertz, size in SHAKES.items()
        )
        lie(copter, now_ms, value)
        assert copter.run_until(1000 * now_ms) == 0
    copter.log(None)


def test_known_vibrations_are_found(copter: Copter, tmp_path: Path) -> None:
    shaken(copter, tmp_path / "shaken.ulg")
    log = ulog.read(tmp_path / "shaken.ulg")
    for _, _, first in log_plots.KINDS:
        factor = 1.0 if first == 0 else 0.1
        found = sorted(log_plots.together(log_plots.spectra(log, 0, first)).peaks(3))
        assert [hertz for hertz, _ in found] == pytest.approx(list(SHAKES), abs=0.5)
        wanted = [
            factor * size * math.cos(math.pi * hertz / 1000.0) for hertz, size in SHAKES.items()
        ]
        assert [size for _, size in found] == pytest.approx(wanted, rel=0.15)
        assert log_plots.together(log_plots.spectra(log, 2, first)).amplitude.max() < 1e-3


def test_a_sine_shows_with_its_amplitude() -> None:
    time = np.arange(5000) / 500.0
    seen = spectrum(3.0 * np.sin(2.0 * np.pi * 62.5 * time) + 7.0, 500.0)
    assert seen.peaks(1) == [(pytest.approx(62.5), pytest.approx(3.0, rel=0.01))]


def test_make_log_draws_it(
    flown: tuple[Path, Trace], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "log.svg"
    assert log_tool.main([str(flown[0]), "--picture", str(picture)]) == 0
    told = capsys.readouterr().out
    assert "Angle rate control" in told and "flying" in told and "0 dropouts" in told
    drawn = picture.read_text()
    assert all(word in drawn for word in ("front right", "unit 3", "frequency, Hz", "load, %"))


def test_a_log_that_is_cut_off_is_read_up_to_there(
    flown: tuple[Path, Trace], tmp_path: Path
) -> None:
    content = flown[0].read_bytes()
    whole = ulog.read(flown[0])
    for size in (len(content) - 1, len(content) // 2, len(content) // 3):
        (tmp_path / "cut.ulg").write_bytes(content[:size])
        cut = ulog.read(tmp_path / "cut.ulg")
        assert 0 <= cut.cut < 512 and not cut.damage
        data = cut.topic("imu")
        np.testing.assert_array_equal(data, whole.topic("imu")[: len(data)])


@pytest.mark.parametrize(
    "content", [b"", b"ULog", b"\x55\x4c\x6f\x67\x01\x12\x35\x01", b"GIF89a" + bytes(100)]
)
def test_what_is_no_log_is_refused(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "no.ulg").write_bytes(content)
    with pytest.raises(ToolError, match="is no log in ULog"):
        ulog.read(tmp_path / "no.ulg")
    with pytest.raises(ToolError, match="No such file"):
        ulog.read(tmp_path / "none.ulg")


def test_data_without_a_topic_are_told(tmp_path: Path) -> None:
    begin = bytes.fromhex("554c6f6701123501") + bytes(8)
    (tmp_path / "bad.ulg").write_bytes(begin + bytes([10, 0, 0x44]) + bytes(10))
    [damage] = ulog.read(tmp_path / "bad.ulg").damage
    assert damage == (16, 13, "data of topic 0, which has not begun")
    with pytest.raises(ToolError, match="no topic attitude"):
        ulog.Log(0).topic("attitude")


def test_a_log_that_cannot_be_written_is_told(copter: Copter, tmp_path: Path) -> None:
    with pytest.raises(ToolError, match="could not be written"):
        copter.log(tmp_path / "nowhere" / "x.ulg")
    copter.log(None)
