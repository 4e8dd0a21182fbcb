# SPDX-License-Identifier: Apache-2.0
"""Scenario files: which are refused, and with which words."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from keel.base.errors import ToolError
from keel.config import ConfigError
from keel.flight import command as fly
from keel.flight import scenario

GOOD = """description = "x"
duration_s = 20.0

[[pilot]]
at_s = 1.0
height_m = 3.0
"""
FAULT = '\n[[fault]]\nkind = "imu_freeze"\nat_s = 8.0\nunit = 2\n'


def read(folder: Path, text: str, name: str = "own") -> scenario.Scenario:
    """A text as a scenario."""
    (folder / f"{name}.toml").write_text(text)
    return scenario.read(name, folder)


def test_all_of_ours_can_be_read() -> None:
    names = scenario.names()
    assert len(names) >= 20
    for name in names:
        assert scenario.read(name).description


def test_a_good_one(tmp_path: Path) -> None:
    found = read(tmp_path, GOOD + FAULT)
    assert found.pilot[0].height_m == 3.0 and found.fault[0].unit == 2
    assert found.plants == ["jsbsim", "mujoco"]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("duration_s = 20.0\n", r"own.toml:1: description: is missing"),
        (GOOD + "hight_m = 3.0\n", r"own.toml:7: pilot number 1: hight_m: unknown key; did you"),
        (GOOD.replace("20.0", "-1.0"), r"own.toml:2: duration_s: .*greater than 0"),
        (GOOD.replace("20.0", '"20"'), r"own.toml:2: duration_s: .*found '20'"),
        (GOOD.replace("20.0", "nan"), r"own.toml:2: duration_s"),
        (GOOD + 'mode = "fast"\n', r"own.toml:7: pilot number 1: mode: .*'angle'"),
        (GOOD + FAULT.replace("unit = 2", ""), r"own.toml:8: fault number 1: unit: is missing"),
        (GOOD + FAULT.replace("unit = 2", "unit = 4"), r"own.toml:11: fault number 1: unit"),
        (GOOD + FAULT + "pascal = 3.0\n", r"own.toml:12: .*pascal: is nothing that imu_freeze has"),
        (GOOD + FAULT + "until_s = 7.0\n", r"own.toml:12: .*until_s: is not after at_s"),
        (GOOD + FAULT.replace("8.0", "21.0"), r"own.toml:10: .*at_s: is after duration_s, 20.0"),
        (GOOD + "[[pilot]]\nat_s = 0.5\n", r"own.toml:8: pilot number 2: at_s: is before the one"),
        (GOOD + "[limits]\nfrom_s = 20.0\n", r"own.toml:8: limits: from_s: leaves nothing"),
        (GOOD + "[limits]\nwithout_fault_deg = 1.0\n", r"own.toml:8: .*compares with the flight"),
        (GOOD + "[limits]\nreach = [{ by_s = 3.0 }]\n", r"own.toml:8: .*takes a state or a mode"),
        (GOOD + "[wind\n", r"own.toml:7: no TOML"),
        (GOOD + "[ground]\nslope_deg = 5.0\n", r"own.toml:1: plants: JSBSim has level ground only"),
        ('like = "other"\n', r"own.toml: like: there is no scenario other"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, told: str) -> None:
    with pytest.raises(ConfigError) as error:
        read(tmp_path, text)
    assert re.search(told, str(error.value)), error.value


def test_one_that_begins_as_another(tmp_path: Path) -> None:
    read(tmp_path, GOOD + FAULT, "base")
    found = read(tmp_path, 'like = "base"\noptions = { plain_mean = true }\n')
    assert found.options.plain_mean and found.fault[0].kind == "imu_freeze"
    assert found.duration_s == 20.0
    with pytest.raises(ConfigError, match=r"own.toml:2: seed"):
        read(tmp_path, 'like = "base"\nseed = -1\n')
    read(tmp_path, 'like = "base"\n')
    with pytest.raises(ConfigError, match="is itself like another one"):
        read(tmp_path, 'like = "own"\n', "third")


def test_with_two_units_the_last_one_fails() -> None:
    """A fault of unit 3 would break nothing."""
    third = scenario.with_units(scenario.read("imu_freeze"), 2)
    assert [fault.unit for fault in third.fault] == [2]
    assert third.options.imus == 2
    assert third.limits.without_fault_deg is None  # Two without one land.
    both = scenario.with_units(scenario.read("imu_freeze_two"), 2)
    assert [fault.unit for fault in both.fault] == [2]
    second = scenario.read("board_imu_unplugged")
    assert scenario.with_units(second, 2).fault == second.fault
    assert scenario.with_units(second, 2).limits == second.limits


def test_a_boards_flights_have_as_many_units_as_the_board() -> None:
    asked = fly.parsed(["--board", "fmuv5", "--scenario", "imu_freeze", "--plant", "jsbsim"])
    (job,) = fly.jobs_of(asked, Path("library"))
    assert [fault.unit for fault in job.order.scenario.fault] == [2]
    (host,) = fly.jobs_of(
        fly.parsed(["--scenario", "imu_freeze", "--plant", "jsbsim"]), Path("library")
    )
    assert [fault.unit for fault in host.order.scenario.fault] == [3]


@pytest.mark.parametrize(
    ("more", "told"),
    [
        (["--scenario", "hover"], "--compare: with --board and --scenario"),
        (["--board", "fmuv5"], "--compare: with --board and --scenario"),
        (["--board", "fmuv5", "--scenario", "hover", "--logs"], "leaves no log"),
        (["--board", "fmuv5", "--scenario", "hover", "--plant", "mujoco"], "is in JSBSim"),
        (["--board", "fmuv5", "--scenario", "board_i2c_low"], "a board's own"),
    ],
)
def test_what_cannot_be_compared(
    more: list[str], told: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert fly.main(["--compare", "--build", str(tmp_path), *more]) == 2
    assert told in capsys.readouterr().err


def test_an_unknown_name_and_the_nearest(tmp_path: Path) -> None:
    read(tmp_path, GOOD, "hover")
    with pytest.raises(ToolError, match="did you mean hover"):
        scenario.read("hoover", tmp_path)


def test_the_command_line_ends_with_2(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert fly.main(["--scenario", "hoover"]) == 2
    assert "did you mean hover" in capsys.readouterr().err
    (tmp_path / "own.toml").write_text(GOOD + "spede = 1\n")
    folders = ["--scenarios", str(tmp_path), "--build", str(tmp_path / "build")]
    assert fly.main(folders) == 2
    assert "own.toml:7" in capsys.readouterr().err
    assert not (tmp_path / "build").exists()
    assert fly.main(["--jobs", "0"]) == 2
    assert fly.main(["--seed", "1", "--scenario", "hover"]) == 2
