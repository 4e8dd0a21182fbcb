# SPDX-License-Identifier: Apache-2.0
"""Margins by the model, against textbook loops and against flights with late samples."""

from __future__ import annotations

import re

import numpy as np
import pytest

from keel.base.errors import ROOT
from keel.flight import margins, scenario
from keel.flight.library import Copter
from keel.flight.loop import Flight, Order
from keel.flight.scenario import Quality

CALM_DEG, SWINGS_DEG = 2.0, 8.0


def test_an_integrator_with_a_delay_has_the_margins_of_the_textbook() -> None:
    """k e^(-Ts)/s: crosses over at k; pi/2 - k T in phase, pi/(2 k T) in gain."""
    rate, delay = 5.0, 0.1
    found = margins.margins_of("", rate / (1j * margins.RADIANS) * margins.late(delay))
    assert found.crossover == pytest.approx(rate, rel=1e-3)
    assert found.phase_deg == pytest.approx(90.0 - np.degrees(rate * delay), abs=0.05)
    assert found.gain == pytest.approx(np.pi / (2.0 * rate * delay), rel=1e-3)
    assert found.delay_ms == pytest.approx(1000.0 * (np.pi / 2.0 - rate * delay) / rate, rel=1e-3)


def test_the_filter_is_3_dB_down_at_its_cut_off() -> None:
    response = margins.low_pass(50.0, 0.002)
    at = int(np.argmin(np.abs(margins.RADIANS - 2.0 * np.pi * 50.0)))
    assert abs(response[at]) == pytest.approx(np.sqrt(0.5), rel=1e-3)
    assert np.degrees(np.angle(response[at])) == pytest.approx(-90.0, abs=0.1)


def test_constants_are_those_of_the_settings() -> None:
    text = (ROOT / "examples/copter/settings.c").read_text()
    assert f"CONTROL_HZ, {margins.DERIVATIVE_HZ}f" in text
    assert f"#define HOVER {margins.HOVER}f" in text
    told = re.search(r"about\s+\*?\s*490 rad/s\^2, of yaw with about 44 rad/s\^2", text)
    turns = margins.authority()
    assert told and turns["roll"] == pytest.approx(490, rel=0.1)
    assert turns["yaw"] == pytest.approx(44, rel=0.1)


def tilt_with(copter: Copter, extra_ms: int) -> float:
    """The greatest tilt of a hover behind its start, with samples so much later."""
    short = scenario.read("hover").model_copy(update={"duration_s": 14.0})
    flown = Flight(copter, Order(short, "mujoco", 7, quality=Quality(imu_delay_ms=1 + extra_ms)))
    trace = flown.fly()
    assert not trace.problem
    if trace.crash:
        return 180.0
    later = trace.truth[:, 0] > 8.0
    return float(np.degrees(np.hypot(trace.column("roll"), trace.column("pitch"))[later].max()))


def test_the_delay_that_is_told_is_the_delay_that_it_stands(copter: Copter) -> None:
    """The model's plant, flown: calm at 3/4 of the margin, swings at 5/4."""
    told = {item.loop: item for item in margins.all_margins()}["roll at the motors"].delay_ms
    assert tilt_with(copter, int(0.75 * told)) < CALM_DEG
    assert tilt_with(copter, int(1.25 * told)) > SWINGS_DEG
