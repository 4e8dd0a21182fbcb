# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel soak: what it refuses, and that a difference is not lost."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from keel.test import soak

FEW = 1_000_000


@pytest.fixture(autouse=True)
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Reports and programs of a test do not replace the user's; one capacity is enough."""
    monkeypatch.setattr(soak, "BUILD", tmp_path)
    monkeypatch.setattr(soak, "CAPACITIES", {"small": soak.CAPACITIES["small"]})
    return tmp_path


@pytest.mark.parametrize("steps", ["999999", "4294967296"])
def test_a_number_that_shows_nothing_or_wraps_is_refused(
    steps: str, own_folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert soak.main(["--steps", steps]) == 2
    assert f"--steps {steps}: expected" in capsys.readouterr().err
    assert not (own_folder / "report.json").exists()


def test_a_difference_is_told_and_reported(
    own_folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # The PID's integral without its lower limit: the specification keeps to it.
    broken = own_folder / "broken.c"
    source = (soak.ROOT / "src/flight/pid.c").read_text(encoding="utf-8")
    changed = source.replace("pid->config.integral_min", "-pid->config.integral_max")
    assert changed != source
    broken.write_text(changed, encoding="utf-8")
    others = [
        path.relative_to(soak.ROOT).as_posix()
        for path in (soak.ROOT / "src").rglob("*.c")
        if path.name != "pid.c"
    ]
    monkeypatch.setattr(soak, "KERNEL", [*others, str(broken)])
    assert soak.main(["--steps", str(FEW)]) == 1
    report = json.loads((own_folder / "report.json").read_text(encoding="utf-8"))
    assert report["verdict"] == "failed"
    assert [name for name, one in report["programs"].items() if not one["good"]] == [
        "voter, filter, pid and reference"
    ]
    assert "PID_008" in capsys.readouterr().out


def test_the_code_as_it_is_passes(own_folder: Path) -> None:
    assert soak.main(["--steps", str(FEW)]) == 0
    report = json.loads((own_folder / "report.json").read_text(encoding="utf-8"))
    assert report["verdict"] == "good"
    assert report["steps"] == FEW
