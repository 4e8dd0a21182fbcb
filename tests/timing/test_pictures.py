# SPDX-License-Identifier: Apache-2.0
"""The pictures of the documents: what was drawn is what is committed, and they stay small."""

from __future__ import annotations

from pathlib import Path

import pytest

from keel.base.errors import ToolError
from keel.timing import campaign, pictures
from keel.timing.campaign_plots import Flight, plot_faults, plot_figure14

ROOT = Path(__file__).resolve().parents[2]


def flight(fault: str, limit: int, latched_s: float, worst: float) -> Flight:
    """A flight as the campaign's program writes it."""
    return {"fault": fault, "density_limit": limit, "all_latched_s": latched_s, "worst_a": worst}


FLIGHTS = [
    flight("stuck", 0, 0.2, 0.44),
    flight("stuck", 100, 0.2, 0.44),
    flight("burst", 0, -1.0, 0.13),
    flight("burst", 100, 0.1, 0.08),
    flight("two equal", 0, -1.0, 9.87),
]


def test_the_committed_drawing_is_not_stale(tmp_path: Path) -> None:
    pictures.plot_layers(tmp_path / "layers.svg")
    drawn = (tmp_path / "layers.svg").read_bytes()
    assert drawn == (ROOT / pictures.FOLDER / "layers.svg").read_bytes()


def test_faults_are_drawn_with_bound_and_latch(tmp_path: Path) -> None:
    path = tmp_path / "faults.svg"
    plot_faults(campaign.single_faults(FLIGHTS), 0.5, path)
    text = path.read_text(encoding="utf-8")
    for shown in ("proved bound: 0.5 a", ">stuck<", ">never<", ">0.13<", ">0.08<"):
        assert shown in text
    assert "9.87" not in text and "two equal" not in text
    first = path.read_bytes()
    plot_faults(campaign.single_faults(FLIGHTS), 0.5, path)
    assert path.read_bytes() == first


def test_figure_14_is_the_same_bytes_for_the_same_flight(tmp_path: Path) -> None:
    trace = [[0.01 * i, 0.0, 0.001, 0.0001 * i, -0.0001 * i] for i in range(1200)]
    plot_figure14(trace, 8.0, tmp_path / "first.svg")
    plot_figure14(trace, 8.0, tmp_path / "second.svg")
    first = (tmp_path / "first.svg").read_bytes()
    assert first == (tmp_path / "second.svg").read_bytes()
    assert b"error of pitch, degrees" in first and b"dc:date" not in first


def test_a_large_picture_is_refused(tmp_path: Path) -> None:
    plot = tmp_path / "plot.svg"
    plot.write_text("x" * pictures.MOST_BYTES)
    pictures.take(plot, tmp_path / "docs")
    plot.write_text("x" * (pictures.MOST_BYTES + 1))
    with pytest.raises(ToolError, match=r"plot\.svg: larger than"):
        pictures.take(plot, tmp_path / "docs")


def test_a_missing_plot_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert pictures.main([], tmp_path) == 2
    assert "faults.svg: missing" in capsys.readouterr().err


def test_committed_pictures_are_small() -> None:
    for path in (ROOT / pictures.FOLDER).iterdir():
        assert path.stat().st_size <= pictures.MOST_BYTES, path
