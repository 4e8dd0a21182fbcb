# SPDX-License-Identifier: Apache-2.0
"""make check NAME=replay: recordings are made here by a motion of its own, in double precision and
in other frames than Keel's; what is planted in them has to come out, and what is broken is told by
place."""

from __future__ import annotations

import json
import math
import random
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shared_builds

from keel.base.errors import ToolError
from keel.flight import library, loop, scenario
from keel.flight.library import Copter
from keel.flight.loop import Order
from keel.install import Toolchain
from keel.replay import command as replay
from keel.replay import copter as run
from keel.replay import figures, readers, recording, turns

GRAVITY = 9.80665
FIELD = (20.0, -3.0, -40.0)  # In uT: x, y, z up, so Keel's north is 20 and its east 3.
RATE_HZ, REST_S, MOVE_S = 250.0, 10.0, 20.0
SHORT = """description = "up and down"
duration_s = 8.0
mode = "altitude"

[[pilot]]
at_s = 0.5
height_m = 4.0

[limits]
from_s = 0.0
tilt_max_deg = 20.0
end = { on_ground = false, motors_on = true }
"""


def rotation(axis: str, angle: float) -> Any:
    """A matrix, as a book has it."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array(
        {
            "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
            "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
        }[axis],
        float,
    )


def quaternion(matrix: Any) -> Any:
    """Of a matrix of less than half a turn."""
    w = math.sqrt(1.0 + np.trace(matrix)) / 2.0
    return np.array(
        [
            w,
            *(
                np.array(
                    [
                        matrix[2, 1] - matrix[1, 2],
                        matrix[0, 2] - matrix[2, 0],
                        matrix[1, 0] - matrix[0, 1],
                    ]
                )
                / (4.0 * w)
            ),
        ]
    )


class Motion:
    """Forward, left, up; at rest first, then turning about all axes: angles of yaw, pitch and roll
    are sums of sines that begin smoothly, and what is measured follows from them."""

    def __init__(self, rate_hz: float = RATE_HZ, rest_s: float = REST_S) -> None:
        noise = 1e-3  # In rad/s; ten times as much in m/s^2.
        self.time = np.arange(0.0, rest_s + MOVE_S, 1.0 / rate_hz)
        tiny = 1e-5
        matrices = [
            [self._matrix(t - rest_s + shift) for shift in (-tiny, 0.0, tiny)] for t in self.time
        ]
        rng = np.random.default_rng(5)
        gyro, accel, mag, reference = [], [], [], []
        for before, here, after in matrices:
            skew = here.T @ (after - before) / (2.0 * tiny)
            gyro.append([skew[2, 1], skew[0, 2], skew[1, 0]])
            accel.append(here.T @ [0.0, 0.0, GRAVITY])
            mag.append(here.T @ FIELD)
            reference.append(quaternion(here))
        drawn = rng.standard_normal((len(gyro), 6))
        self.gyroscope = np.array(gyro) + noise * drawn[:, :3]
        self.accelerometer = np.array(accel) + 10.0 * noise * drawn[:, 3:]
        self.magnetometer = np.array(mag)
        self.reference = np.array(reference)
        self.rate_hz = rate_hz

    @staticmethod
    def _matrix(t: float) -> Any:
        u = max(0.0, t)
        ease = u * u / (1.0 + u * u)
        yaw, pitch, roll = (
            ease * size * math.sin(pace * u) for size, pace in ((0.6, 0.7), (0.4, 1.9), (0.5, 2.6))
        )
        return rotation("z", yaw) @ rotation("y", pitch) @ rotation("x", roll)

    def arrays(self) -> dict[str, Any]:
        """As an npz has it."""
        return {
            "rate_hz": np.float64(self.rate_hz),
            "gyroscope": self.gyroscope,
            "accelerometer": self.accelerometer,
            "magnetometer": self.magnetometer,
            "reference": self.reference,
        }


@pytest.fixture(scope="module")
def built() -> Path:
    """The library."""
    return shared_builds.copter_library(Toolchain())


@pytest.fixture(scope="module")
def copter(built: Path) -> Copter:
    """The same, loaded."""
    return replay.copter_of(built)


@pytest.fixture(scope="module")
def motion() -> Motion:
    """One for all tests, none of which changes it."""
    return Motion()


Tool = Callable[..., tuple[int, dict[str, Any]]]


@pytest.fixture
def tool(built: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Tool:
    """Runs make check NAME=replay's program; tells its exit status and its report."""
    monkeypatch.setattr(library, "build", lambda *_: built)

    def called(*arguments: object) -> tuple[int, dict[str, Any]]:
        report = tmp_path / "out/report.json"
        status = replay.main([*map(str, arguments), "--build", str(report.parent)])
        return status, json.loads(report.read_text()) if report.exists() else {}

    return called


def saved(folder: Path, arrays: dict[str, Any], name: str = "motion.npz") -> Path:
    """A recording."""
    np.savez(folder / name, **arrays)
    return folder / name


def written(
    folder: Path,
    motion: Motion,
    units: int = 1,
    frozen: int = 0,
    from_s: float = 0.0,
    change: Callable[[list[list[str]]], None] = lambda rows: None,
) -> Path:
    """The same as CSV in Keel's frames, with a unit that repeats itself from some time on."""
    flat = np.array([1.0, -1.0, -1.0])
    rng = np.random.default_rng(9)
    header, columns = ["time_s"], [motion.time]
    for number in range(1, units + 1):
        suffix = f"_{number}" if units > 1 else ""
        noise = (units > 1) * 1e-3 * rng.standard_normal((len(motion.time), 6))
        rows = np.hstack([motion.accelerometer * flat, motion.gyroscope * flat]) + noise
        if number == frozen:
            late = motion.time >= from_s
            rows[late] = rows[late][0]
        header += [f"accel_{axis}_m_s2{suffix}" for axis in "xyz"]
        header += [f"gyro_{axis}_rad_s{suffix}" for axis in "xyz"]
        columns += list(rows.T)
    header += [f"mag_{axis}_ut" for axis in "xyz"] + [f"ref_{axis}" for axis in "wxyz"]
    columns += [*(motion.magnetometer * flat).T, *(motion.reference * (1, 1, -1, -1)).T]
    table = [header, *([f"{cell:.9g}" for cell in row] for row in zip(*columns, strict=True))]
    change(table)
    path = folder / "motion.csv"
    path.write_text("".join(",".join(row) + "\n" for row in table))
    return path


def keel_of(report: dict[str, Any]) -> dict[str, Any]:
    """Keel's errors in the only recording."""
    found: dict[str, Any] = report["recordings"][0]["attitude"]["keel"]
    return found


def test_what_was_measured_well_has_a_small_error(
    tool: Tool, motion: Motion, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status, report = tool(saved(tmp_path, motion.arrays()), "--compare")
    found = report["recordings"][0]
    assert status == 0 and found["judge"] == "reference" and not found["doubts"]
    for name in ("keel", "vqf", "mahony"):
        assert found["attitude"][name]["inclination_deg"]["moving"]["rms"] < 1.0, name
        assert found["attitude"][name]["heading_deg"]["moving"]["rms"] < 2.0, name
    assert found["expected_field_ut"] == pytest.approx([20.0, 3.0], abs=0.05)
    assert found["phases_s"]["running"] == pytest.approx(REST_S + MOVE_S, abs=0.1)
    assert (tmp_path / "out/motion.npz.png").read_bytes().startswith(b"\x89PNG")
    last = capsys.readouterr().out.splitlines()[-1]
    assert last.startswith("replay: 1 of 1 recordings replayed; ")


@pytest.mark.parametrize("rate_hz", [100.0, 1000.0, 4000.0])
def test_any_rate_is_kept_in_time(copter: Copter, rate_hz: float) -> None:
    """An error of 2 ms alone would be 0.2 degrees at this motion's 1.7 rad/s."""
    motion = Motion(rate_hz, rest_s=3.0)
    flat = np.array([1.0, -1.0, -1.0])
    unit = recording.Series(
        motion.time, np.hstack([motion.accelerometer * flat, motion.gyroscope * flat])
    )
    judge = recording.Series(motion.time, motion.reference * (1, 1, -1, -1))
    found = recording.with_lead_in(recording.Recording(Path("x"), [unit], reference=judge), 8.0)
    track = run.replayed(copter, found).since(0.0)
    errors = []
    for late in (-0.004, 0.0, 0.004):
        at = turns.between(track.view["quaternion"].astype(float), track.time, motion.time + late)
        errors.append(np.sqrt((turns.apart(at, judge.value)[0][500:-50] ** 2).mean()))
    assert errors[1] < errors[0] and errors[1] < errors[2]


def test_a_planted_error_comes_out_as_what_it_is(
    tool: Tool, motion: Motion, tmp_path: Path
) -> None:
    """The reference is turned, so the estimate is off by as much: 10 degrees about a level axis are
    inclination, about the vertical heading. The field is given: its first second would hide it."""
    for axis, kind, other in (
        ("x", "inclination_deg", "heading_deg"),
        ("z", "heading_deg", "inclination_deg"),
    ):
        arrays = motion.arrays()
        extra = quaternion(rotation(axis, math.radians(10.0)))
        arrays["reference"] = turns.times(extra, arrays["reference"])
        _, report = tool(saved(tmp_path, arrays), "--no-pictures", "--field", 20, 3)
        assert keel_of(report)[kind]["all"]["rms"] == pytest.approx(10.0, abs=0.6)
        assert keel_of(report)[other]["all"]["rms"] < 1.5


@pytest.mark.parametrize("factor", [10.0, 1e-4])
def test_a_magnetometer_in_another_unit_is_refused(
    tool: Tool, motion: Motion, tmp_path: Path, factor: float, capsys: pytest.CaptureFixture[str]
) -> None:
    arrays = {**motion.arrays(), "magnetometer": factor * motion.magnetometer}
    assert tool(saved(tmp_path, arrays), "--no-pictures")[0] == 2
    assert "is the magnetometer in uT?" in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--limit-degrees", "--lead-in", "--jobs"])
def test_an_option_that_cannot_be_is_refused(
    tool: Tool, motion: Motion, tmp_path: Path, option: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = saved(tmp_path, motion.arrays())
    assert tool(path, option, "-1") == (2, {})
    assert f"replay: {option}: expected" in capsys.readouterr().err


def test_moving_and_unseen_parts_are_told_apart(tool: Tool, motion: Motion, tmp_path: Path) -> None:
    arrays = motion.arrays()
    late = motion.time > REST_S + 5.0
    extra = quaternion(rotation("x", math.radians(10.0)))
    arrays["reference"] = np.where(
        late[:, None], turns.times(extra, arrays["reference"]), arrays["reference"]
    )
    arrays["moving"] = late
    arrays["reference"][(motion.time > 12.0) & (motion.time < 13.0)] = math.nan
    _, report = tool(saved(tmp_path, arrays), "--no-pictures")
    found = keel_of(report)["inclination_deg"]
    assert found["moving"]["rms"] == pytest.approx(10.0, abs=0.6)
    assert found["all"]["rms"] == pytest.approx(10.0 * math.sqrt(15.0 / 29.0), abs=0.6)


def test_the_limit_is_the_exit_status(tool: Tool, motion: Motion, tmp_path: Path) -> None:
    arrays = motion.arrays()
    extra = quaternion(rotation("y", math.radians(10.0)))
    arrays["reference"] = turns.times(extra, arrays["reference"])
    path = saved(tmp_path, arrays)
    status, report = tool(path, "--no-pictures", "--limit-degrees", 9)
    assert status == 1 and report["beyond_limit"] == [str(path)]
    status, report = tool(path, "--no-pictures", "--limit-degrees", 11)
    assert status == 0 and report["beyond_limit"] == []


def test_without_a_reference_a_limit_does_not_hold(
    tool: Tool, motion: Motion, tmp_path: Path
) -> None:
    arrays = motion.arrays()
    del arrays["reference"]
    assert tool(saved(tmp_path, arrays), "--limit-degrees", 90)[0] == 1


def changed_gyroscope(arrays: dict[str, Any]) -> None:
    arrays["gyroscope"] = arrays["gyroscope"][:, [1, 0, 2]]


def changed_accelerometer(arrays: dict[str, Any]) -> None:
    arrays["accelerometer"] = arrays["accelerometer"][:, [0, 2, 1]]


def changed_magnetometer(arrays: dict[str, Any]) -> None:
    arrays["magnetometer"] = arrays["magnetometer"][:, [1, 0, 2]]


def in_degrees(arrays: dict[str, Any]) -> None:
    arrays["gyroscope"] = np.degrees(arrays["gyroscope"])


def in_g(arrays: dict[str, Any]) -> None:
    arrays["accelerometer"] = arrays["accelerometer"] / GRAVITY


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (changed_gyroscope, "gyroscope and reference do not turn alike"),
        (changed_magnetometer, "gyroscope and magnetometer do not turn alike"),
        (changed_accelerometer, "the accelerometer is 90 degrees off"),
        (in_degrees, "gyroscope and reference do not turn alike"),
        (in_g, "expected 9.8: another unit of measurement?"),
    ],
)
def test_other_axes_and_units_are_noticed(
    motion: Motion, tmp_path: Path, change: Callable[[dict[str, Any]], None], words: str
) -> None:
    arrays = motion.arrays()
    change(arrays)
    told = figures.doubts(readers.read(saved(tmp_path, arrays)))
    assert any(words in line for line in told), told


def test_csv_and_npz_of_one_motion_have_one_result(
    tool: Tool, motion: Motion, tmp_path: Path
) -> None:
    _, first = tool(saved(tmp_path, motion.arrays()), "--no-pictures")
    _, second = tool(written(tmp_path, motion), "--no-pictures")
    for kind in ("inclination_deg", "heading_deg"):
        assert keel_of(first)[kind]["all"]["rms"] == pytest.approx(
            keel_of(second)[kind]["all"]["rms"], abs=0.02
        )


def test_a_frozen_unit_is_told(
    tool: Tool, motion: Motion, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path, motion, units=3, frozen=2, from_s=REST_S + 2.0)
    status, report = tool(path, "--no-pictures")
    found = report["recordings"][0]["votes"]
    assert status == 0 and {span["unit"] for span in found["latched"]} == {2}
    assert REST_S + 2.0 < found["latched"][0]["from_s"] < REST_S + 3.5
    assert "unit 2 latched from" in capsys.readouterr().out
    counted = [unit[1] for unit in found["counted"]]
    assert counted[1] < 0.6 and min(counted[0], counted[2]) > 0.95
    assert keel_of(report)["inclination_deg"]["moving"]["rms"] < 1.0


def test_beside_two_units_the_third_is_silent(tool: Tool, motion: Motion, tmp_path: Path) -> None:
    _, report = tool(written(tmp_path, motion, units=2), "--no-pictures")
    votes = report["recordings"][0]["votes"]
    assert votes["counted"][2] == [0.0, 0.0] and votes["states"]["gyroscope"]["mean"] > 0.99
    assert keel_of(report)["inclination_deg"]["moving"]["rms"] < 1.0


def test_the_distance_to_the_mean_of_all_is_as_computed(
    tool: Tool, motion: Motion, tmp_path: Path
) -> None:
    """Unit 4 measures 1.1 times the rate: the mean of all is 1.025 of what the three others say."""
    rows = np.hstack([motion.time[:, None], motion.accelerometer, np.degrees(motion.gyroscope)])
    fast = rows.copy()
    fast[:, 4:] *= 1.1
    path = saved(tmp_path, {"unit_1": rows, "unit_2": rows, "unit_3": rows, "unit_4": fast})
    _, report = tool(path, "--no-pictures", "--align", "no")
    wanted = 0.025 * np.sqrt((motion.gyroscope**2).mean(0)).max()
    votes = report["recordings"][0]["votes"]
    assert votes["plain_mean_of_three"]["gyroscope"] == pytest.approx(wanted, rel=0.02)
    assert votes["from_mean_of_all"]["gyroscope"] == pytest.approx(wanted, rel=0.02)
    assert votes["states"]["gyroscope"]["mean"] == 1.0


def test_units_that_stand_askew_are_aligned(motion: Motion, tmp_path: Path) -> None:
    rows = np.hstack([motion.time[:, None], motion.accelerometer, np.degrees(motion.gyroscope)])
    turn = rotation("z", 0.2) @ rotation("x", -0.1)
    askew = rows.copy()
    askew[:, 1:4] = rows[:, 1:4] @ turn.T + (0.3, -0.2, 0.1)
    askew[:, 4:7] = rows[:, 4:7] @ turn.T
    path = saved(tmp_path, {"unit_1": rows, "unit_2": askew})
    found = recording.aligned(readers.read(path))
    apart = found.units[0].value - found.units[1].value
    assert np.abs(apart).max() < 0.02


def test_a_copters_log_gives_what_it_estimated_in_flight(
    tool: Tool, copter: Copter, tmp_path: Path
) -> None:
    (tmp_path / "short.toml").write_text(SHORT)
    order = Order(scenario.read("short", tmp_path), "mujoco", 1)
    assert not loop.fly(copter, order, tmp_path / "short.ulg").problem
    status, report = tool(tmp_path / "short.ulg")
    found = report["recordings"][0]
    assert status == 0 and found["judge"] == "recorder" and not found["doubts"]
    assert found["votes"]["states"]["gyroscope"]["mean"] > 0.99
    assert keel_of(report)["inclination_deg"]["all"]["max"] < 0.5
    assert keel_of(report)["heading_deg"]["all"]["max"] < 3.0
    assert found["height_m"]["max"] < 0.5


def message(kind: str, body: bytes) -> bytes:
    """Of a log."""
    return struct.pack("<HB", len(body), ord(kind)) + body


def px4(path: Path, motion: Motion, topics: tuple[str, ...]) -> Path:
    """A log as PX4 writes it, with these topics."""
    formats = {
        "sensor_combined": "float[3] gyro_rad;float[3] accelerometer_m_s2;",
        "vehicle_magnetometer": "float[3] magnetometer_ga;",
        "vehicle_attitude": "float[4] q;",
    }
    flat = np.array([1.0, -1.0, -1.0])
    rows = {
        "sensor_combined": np.hstack([motion.gyroscope * flat, motion.accelerometer * flat]),
        "vehicle_magnetometer": motion.magnetometer * flat / 100.0,
        "vehicle_attitude": motion.reference * (1, 1, -1, -1),
    }
    content = bytes.fromhex("554c6f6701123501") + struct.pack("<Q", 0)
    for name in topics:
        content += message("F", f"{name}:uint64_t timestamp;{formats[name]}".encode())
    for number, name in enumerate(topics):
        content += message("A", b"\0" + struct.pack("<H", number) + name.encode())
    for index, time in enumerate(motion.time):
        for number, name in enumerate(topics):
            stamp = struct.pack("<HQ", number, 5_000_000 + round(1e6 * time))
            content += message("D", stamp + rows[name][index].astype("<f4").tobytes())
    path.write_bytes(content)
    return path


ALL = ("sensor_combined", "vehicle_magnetometer", "vehicle_attitude")


def test_a_log_of_px4_is_replayed_beside_its_estimate(
    tool: Tool, motion: Motion, tmp_path: Path
) -> None:
    status, report = tool(px4(tmp_path / "flight.ulg", motion, ALL))
    found = report["recordings"][0]
    assert status == 0 and found["judge"] == "recorder" and not found["doubts"]
    assert keel_of(report)["inclination_deg"]["moving"]["rms"] < 1.0


def test_a_log_that_was_cut_off_says_so(tool: Tool, motion: Motion, tmp_path: Path) -> None:
    path = px4(tmp_path / "flight.ulg", motion, ALL)
    path.write_bytes(path.read_bytes()[:-10])
    status, report = tool(path, "--no-pictures")
    notes = report["recordings"][0]["notes"]
    assert status == 0 and any("was cut off: its last 19 bytes" in note for note in notes), notes


def test_a_start_in_motion_gets_rest_in_its_attitude(
    tool: Tool, motion: Motion, tmp_path: Path
) -> None:
    begin = int(RATE_HZ * (REST_S + 3.0))
    arrays = {
        name: array[begin:] if np.ndim(array) else array for name, array in motion.arrays().items()
    }
    _, report = tool(saved(tmp_path, arrays), "--no-pictures")
    assert any("rest are made up" in note for note in report["recordings"][0]["notes"])
    assert keel_of(report)["inclination_deg"]["all"]["rms"] < 2.0
    del arrays["reference"]
    _, report = tool(saved(tmp_path, arrays), "--no-pictures")
    assert any("no rest is put before it" in note for note in report["recordings"][0]["notes"])


def refusal(path: Path) -> str:
    """Why a file is refused."""
    with pytest.raises(ToolError) as error:
        readers.read(path)
    assert str(error.value).startswith(str(path))
    return str(error.value)[len(str(path)) :]


def test_a_bad_npz_is_refused_by_name_and_row(motion: Motion, tmp_path: Path) -> None:
    path = saved(tmp_path, motion.arrays())
    whole = path.read_bytes()
    for size in (0, 10, len(whole) // 2, len(whole) - 5):
        path.write_bytes(whole[:size])
        assert "is no whole npz" in refusal(path)
    wrong: list[tuple[str, Any, str]] = [
        ("gyroscope", motion.gyroscope[:, :2], "gyroscope: expected rows of 3"),
        ("gyroscope", motion.gyroscope[:-1], "accelerometer has"),
        ("magnetometer", motion.magnetometer[:-1], "magnetometer:"),
        ("gyro", motion.gyroscope, "did you mean gyroscope?"),
        ("rate_hz", np.float64(0.0), "rate_hz: 0"),
        ("reference", 2.0 * motion.reference, ": at 0.000 s: reference is no unit quaternion"),
        ("accelerometer", np.full((5, 3), "a"), "expected numbers"),
    ]
    for name, array, words in wrong:
        assert words in refusal(saved(tmp_path, {**motion.arrays(), name: array})), name
    arrays = motion.arrays()
    arrays["accelerometer"] = arrays["accelerometer"].copy()
    arrays["accelerometer"][77, 1] = math.nan
    assert ": row 77: " in refusal(saved(tmp_path, arrays))
    del arrays["accelerometer"]
    assert "the array accelerometer is missing" in refusal(saved(tmp_path, arrays))
    rows = np.hstack([motion.time[:, None], motion.accelerometer, motion.gyroscope])
    rows[-1, 0] = 9000.0
    assert ": lasts 9000 s" in refusal(saved(tmp_path, {"unit_1": rows}))
    rows[40, 0] = 0.01
    assert ": row 40: time runs backwards in unit_1" in refusal(saved(tmp_path, {"unit_1": rows}))


def test_a_damaged_file_is_refused_or_read(tmp_path: Path) -> None:
    """Nothing else becomes of it, whatever bytes change."""
    rng = random.Random(2)
    short = Motion(50.0)
    rows = np.hstack([short.time[:, None], short.accelerometer, short.gyroscope])
    whole = {
        ".npz": saved(tmp_path, {"unit_1": rows, "unit_2": rows}).read_bytes(),
        ".csv": written(tmp_path, short).read_bytes(),
        ".ulg": px4(tmp_path / "flight.ulg", short, ALL).read_bytes(),
    }
    refused = 0
    for suffix, content in whole.items():
        for _ in range(60):
            damaged = bytearray(content)
            place = rng.randrange(len(damaged))
            damaged[place : place + rng.randrange(40)] = rng.randbytes(rng.randrange(1, 40))
            path = tmp_path / f"damaged{suffix}"
            path.write_bytes(damaged)
            try:
                readers.read(path)
            except ToolError as error:
                refused += 1
                assert str(path) in str(error)
    assert refused > 60


def spoilt(line: int, column: int, text: str) -> Callable[[list[list[str]]], None]:
    """Changes a cell; the header is line 1."""

    def change(rows: list[list[str]]) -> None:
        rows[line - 1][column] = text

    return change


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            spoilt(1, 1, "accel_x"),
            ":1: column 2: there is no column accel_x; did you mean accel_x_m",
        ),
        (spoilt(1, 2, "accel_x_m_s2"), ":1: column 3: accel_x_m_s2 once more"),
        (spoilt(1, 9, "pressure_pa"), ":1: the column mag_z_ut is missing beside mag_x_ut"),
        (spoilt(30, 4, "fast"), ":30: gyro_x_rad_s: 'fast' is no finite number"),
        (spoilt(30, 4, "nan"), ":30: gyro_x_rad_s: 'nan' is no finite number"),
        (
            spoilt(30, 4, ""),
            ": line 30: accel_x_m_s2 or one beside it has a value that is no finite",
        ),
        (spoilt(30, 0, "0.001"), ": line 30: time runs backwards in accel_x_m_s2"),
        (lambda rows: rows[30].pop(), ":31: 13 cells, but 14 columns"),
        (lambda rows: rows.__delitem__(slice(2, None)), ": accel_x_m_s2 or one beside it: 1 rows"),
        (lambda rows: rows.clear(), ":1: the column time_s is missing"),
    ],
)
def test_a_bad_csv_is_refused_by_line(
    motion: Motion, tmp_path: Path, change: Callable[[list[list[str]]], None], words: str
) -> None:
    assert words in refusal(written(tmp_path, motion, change=change))


def test_a_bad_log_is_refused_by_topic_and_byte(motion: Motion, tmp_path: Path) -> None:
    path = tmp_path / "flight.ulg"
    assert "sensor_combined is missing" in refusal(px4(path, motion, ALL[1:]))
    content = bytearray(px4(path, motion, ALL).read_bytes())
    place = len(content) // 2
    content[place : place + 60] = b"\xff" * 60
    path.write_bytes(content)
    assert refusal(path).startswith(": byte ")
    path.write_bytes(b"ULog")
    assert "is no log in ULog" in refusal(path)


def test_a_refused_file_is_status_2_and_the_others_are_replayed(
    tool: Tool, motion: Motion, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "many"
    folder.mkdir()
    saved(folder, motion.arrays(), "good.npz")
    (folder / "bad.csv").write_text("time_s\n")
    status, report = tool(folder, "--no-pictures", "--jobs", 1)
    assert status == 2 and len(report["recordings"]) == 2
    told = capsys.readouterr()
    assert f"replay: {folder}/bad.csv:1: the columns" in told.err
    assert "1 of 2 recordings replayed" in told.out.splitlines()[-1]
    assert tool(tmp_path / "none.npz")[0] == 2
    assert tool("")[0] == 2


def test_what_broke_off_leaves_no_report(
    tool: Tool, motion: Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = saved(tmp_path, motion.arrays())
    assert tool(path)[1] and (tmp_path / "out/motion.npz.png").exists()

    def broken(_: object) -> None:
        raise OSError("the disk is full")

    monkeypatch.setattr(replay, "replay_one", broken)
    assert tool(path) == (2, {})
    assert not (tmp_path / "out/motion.npz.png").exists()
