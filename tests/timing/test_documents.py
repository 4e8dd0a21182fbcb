# SPDX-License-Identifier: Apache-2.0
"""The figures of docs/timing.md that the analyser computes are those that it computes."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pytest

from keel.timing.analysis import Analysis, analyse
from keel.timing.phases import without_phases
from keel.timing.taskset import read

ROOT = Path(__file__).resolve().parents[2]
JUDGED = ("IMU, rate", "IMU, angle", "Magnetometer", "Radio")


@pytest.fixture(scope="module")
def shipped() -> Analysis:
    """Table 2 with its phases."""
    return analyse(read(ROOT / "specs/tasksets/urpilot.toml"))


@pytest.fixture(scope="module")
def unphased() -> Analysis:
    """Table 2, all tasks released together."""
    return analyse(without_phases(read(ROOT / "specs/tasksets/urpilot.toml")))


def said(row: str) -> str:
    """Keel's cell in the row of the table that begins so."""
    lines = (ROOT / "docs/timing.md").read_text(encoding="utf-8").splitlines()
    (line,) = (line for line in lines if line.startswith(f"| {row}"))
    return line.strip("|").split("|")[-1].strip()


def paths(numbers: Iterable[int | None]) -> str:
    """Those of the judged paths as the table has them: both of the IMU, then the others."""
    rate, angle, magnetometer, radio = (f"{(number or 0) / 1000:.1f}" for number in numbers)
    return f"{rate} to {angle}, {magnetometer}, {radio} ms"


def test_responses_of_table_2(shipped: Analysis) -> None:
    apart = ", ".join(str(row.bound_apart) for row in shipped.realtime_rows)
    assert said("response of τ11, τ12, τ18").startswith(f"{apart} us:")
    (first, *_) = shipped.realtime_rows
    assert {(row.bound, row.bound_promotion) for row in shipped.realtime_rows} == {
        (first.bound, first.bound_promotion)
    }
    assert said("the same whatever the phases").startswith(
        f"{first.bound} us; {first.bound_promotion} us behind a promoted task"
    )
    others = [(row.bound_apart or 0, row.bound or 0) for row in shipped.other_rows]
    most, whatever = map(max, zip(*others, strict=True))
    assert said("response of every other task").startswith(
        f"at most {most} us; {whatever} us whatever the phases"
    )


def test_paths_of_table_2(shipped: Analysis, unphased: Analysis) -> None:
    rows, bare = ({row.name: row for row in one.chains} for one in (shipped, unphased))
    assert said("reaction of the IMU").startswith(paths(rows[name].reaction for name in JUDGED))
    assert said("the same from an event").startswith(paths(rows[name].safe for name in JUDGED))
    assert said("the same without phases").startswith(paths(bare[name].safe for name in JUDGED))
