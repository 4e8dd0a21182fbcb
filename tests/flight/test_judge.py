# SPDX-License-Identifier: Apache-2.0
"""The judge, on traces that were written by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from keel.flight import alike, judge
from keel.flight.library import modes, states
from keel.flight.loop import TRUTH, Trace
from keel.flight.montecarlo import by_fault, ranks
from keel.flight.scenario import Hand, Limits, Scenario

VIEW = [
    ("quaternion", "<f4", (4,)),
    ("asked_tilt", "<f4", (2,)),
    ("asked_rate", "<f4", (3,)),
    ("position", "<f4", (3,)),
    ("state", "<u4"),
    ("mode", "<u4"),
    ("motors_on", "<u4"),
]
DONE = [("skipped", "<u4"), ("runs", "<u4")]
ROWS = 100


def flight(**columns: Any) -> Trace:
    """Ten seconds of standing level at home; columns of the truth may be given."""
    truth = np.zeros((ROWS, len(TRUTH)))
    truth[:, 0] = np.arange(ROWS) / 10.0
    for name, values in columns.items():
        truth[:, TRUTH.index(name)] = values
    view = np.zeros(ROWS, dtype=VIEW)
    view["quaternion"][:, 0] = 1.0
    done = np.zeros(1, dtype=DONE)
    return Trace(truth, view, tasks=["Foreground IMU"], done=(done, done.copy()))


def told(limits: dict[str, Any], trace: Trace, **more: Any) -> list[judge.Finding]:
    """What the judge finds."""
    made = Scenario(description="x", duration_s=10.0, limits=Limits.model_validate(limits), **more)
    return judge.judged(made, trace, None)


def value(name: str, trace: Trace, **window: float) -> float:
    """One number."""
    finding = told({name: 1000.0, **window}, trace)[0]
    assert finding.name == name and finding.number is not None
    return finding.number


def test_attitude_errors() -> None:
    trace = flight(roll=math.radians(2.0), pitch=[math.radians(-6.0)] + [0.0] * (ROWS - 1))
    assert value("attitude_rms_deg", trace) == pytest.approx(2.0)
    assert value("attitude_max_deg", trace) == pytest.approx(6.0)
    assert value("attitude_max_deg", trace, from_s=1.0) == pytest.approx(2.0)


def test_states_that_it_may_be_in() -> None:
    trace = flight()
    trace.view["state"] = states().index("flying")
    trace.view["state"][50:60] = states().index("holding")
    named = ["flying", "armed"]
    assert not told({"stays": named}, trace)[0].good
    assert told({"stays": named}, trace)[0].value == "flying, holding, flying"
    assert told({"stays": named, "from_s": 6.0}, trace)[0].good
    assert told({"stays": [*named, "holding"]}, trace)[0].good
    assert all(one.name != "stays" for one in told({}, trace))


def test_belief_is_the_quaternion() -> None:
    trace = flight(roll=math.radians(20.0), yaw=math.radians(350.0))
    half = math.radians(10.0)
    trace.view["quaternion"] = (math.cos(half), math.sin(half), 0.0, 0.0)
    assert value("attitude_max_deg", trace) == pytest.approx(0.0, abs=1e-4)
    assert value("heading_max_deg", trace) == pytest.approx(10.0, abs=1e-3)


def test_tracking_takes_sines() -> None:
    trace = flight(pitch=math.radians(30.0))
    trace.view["asked_tilt"] = (0.0, 0.5)
    assert value("tracking_rms_deg", trace) == pytest.approx(0.0, abs=1e-4)


def test_turning_is_beside_what_was_asked() -> None:
    """The nose turns by 50 degrees a second, through north; 40 are asked, of the yaw alone."""
    turned = np.radians(330.0 + 50.0 * np.arange(ROWS) / 10.0) % (2.0 * np.pi)
    trace = flight(yaw=turned)
    trace.view["asked_rate"] = np.radians((7.0, 8.0, 40.0))
    assert value("turning_rms_dps", trace) == pytest.approx(10.0, abs=1e-4)


def test_holding_is_from_where_the_limits_begin() -> None:
    north = np.where(np.arange(ROWS) < 50, 10.0, 13.0)
    trace = flight(north=north, east=np.where(np.arange(ROWS) < 60, 0.0, 4.0))
    assert value("hold_max_m", trace) == pytest.approx(5.0)
    assert value("hold_max_m", trace, from_s=5.0) == pytest.approx(4.0)


def test_touch_down_counts_only_after_a_flight() -> None:
    up = np.concatenate([np.zeros(20), np.full(30, 2.0), np.full(50, 0.05)])
    trace = flight(up=up, v_up=np.where(np.arange(ROWS) == 50, -0.7, 0.0))
    assert value("sink_max", trace) == pytest.approx(0.7)
    assert value("sink_max", flight(v_up=-3.0)) == 0.0


def test_left_out_runs() -> None:
    trace = flight()
    trace.done[1]["skipped"] = 3
    limits = [told({"skipped_max": most}, trace)[0] for most in (2, 3)]
    assert [finding.good for finding in limits] == [False, True]


def test_states_in_time() -> None:
    trace = flight()
    trace.view["state"][40:] = states().index("landing")
    early = told({"reach": [{"state": "landing", "from_s": 0.0, "by_s": 4.0}]}, trace)[0]
    late = told({"reach": [{"state": "landing", "from_s": 0.0, "by_s": 3.9}]}, trace)[0]
    never = told({"reach": [{"mode": "acro", "from_s": 5.0, "by_s": 6.0}]}, flight())[0]
    assert early.good and not late.good and never.good  # Mode 0 is acro.
    assert modes()[0] == "acro"


def test_the_end() -> None:
    assert all(finding.good for finding in told({"end": {"state": "disarmed"}}, flight()))
    in_air = told({}, flight(up=2.0))
    assert [finding.name for finding in in_air if not finding.good] == ["ends on the ground"]
    on_its_back = told({}, flight(roll=math.pi))
    assert not next(finding for finding in on_its_back if finding.name == "ends upright").good
    trace = flight(north=3.0)
    trace.view["motors_on"] = 1
    bad = [finding.name for finding in told({"end": {"home_m": 2.0}}, trace) if not finding.good]
    assert bad == ["ends with", "ends at home"]


def test_a_flight_that_stays_on_the_ground_is_no_hover() -> None:
    limits = {"rises_m": 2.5, "attitude_max_deg": 1.0, "hold_max_m": 0.5}
    bad = [finding.name for finding in told(limits, flight()) if not finding.good]
    assert bad == ["rises_m"]
    risen = np.minimum(np.arange(ROWS), np.arange(ROWS)[::-1]) / 19.0  # 2.58 m in the middle.
    assert all(finding.good for finding in told(limits, flight(up=risen)))


def test_a_pilot_who_asks_for_a_height_must_get_near_it() -> None:
    asked = [Hand(at_s=1.0, height_m=4.0), Hand(at_s=2.0, height_m=2.0), Hand(at_s=3.0, lands=True)]
    usual = Scenario(description="x", duration_s=10.0, pilot=asked)
    assert usual.rises_m == 3.0
    for up, bad in ((2.9, ["rises_m"]), (3.1, [])):
        trace = flight(up=np.where(np.arange(ROWS) == 20, up, 0.0))
        assert [one.name for one in judge.judged(usual, trace, None) if not one.good] == bad
    assert Scenario(description="x", duration_s=10.0).rises_m == 0.0
    grounded = usual.model_copy(update={"limits": Limits(rises_m=0.0)})
    assert all(one.good for one in judge.judged(grounded, flight(), None))


def test_what_is_good() -> None:
    usual = Scenario(description="x", duration_s=10.0)
    fails = usual.model_copy(update={"expects_failure": True})
    kept, broken = told({}, flight()), told({}, flight(up=2.0))
    assert judge.is_good(usual, flight(), kept) and not judge.is_good(usual, flight(), broken)
    assert judge.is_good(fails, flight(), broken) and not judge.is_good(fails, flight(), kept)
    crashed, refused = Trace(crash="crashed at 1.00 s"), Trace(problem="not armed")
    assert judge.is_good(fails, crashed, judge.judged(fails, crashed, None))
    assert not judge.is_good(usual, crashed, judge.judged(usual, crashed, None))
    assert not judge.is_good(fails, refused, judge.judged(fails, refused, None))


def test_a_number_that_is_none_is_not_good() -> None:
    finding = told({"attitude_rms_deg": 1.0}, flight(roll=np.nan))[0]
    assert not finding.good


def test_percentiles_and_faults() -> None:
    flights = [
        {"measured": {"sink_max": float(number)}, "fault": "imu_freeze" if number else "no fault"}
        for number in range(101)
    ]
    assert ranks(flights) == {"sink_max": {"p50": 50.0, "p90": 90.0, "p99": 99.0, "p100": 100.0}}
    assert list(by_fault(flights)) == ["no fault", "imu_freeze"]


def two_states(roll_deg: Any, begins: int) -> Trace:
    """Flying, then landing from a row on; the roll angle may change."""
    trace = flight(roll=np.radians(roll_deg))
    trace.view["state"] = states().index("flying")
    trace.view["state"][begins:] = states().index("landing")
    return trace


def test_two_flights_are_as_far_apart_as_their_states_row_by_row() -> None:
    level = np.zeros(ROWS)
    tilted = np.where(np.arange(ROWS) == 70, 1.5, 0.0)
    assert all(one.good for one in alike.differences(two_states(level, 50), two_states(level, 50)))
    begin, roll, pitch, place, _ = alike.differences(two_states(level, 50), two_states(tilted, 50))
    assert (begin.good, roll.good, pitch.good, place.good) == (True, False, True, True)
    assert roll.value == "1.50 deg"
    moved = flight(north=0.6)
    assert alike.differences(flight(), moved)[3].value == "0.60 m"
    assert not alike.differences(flight(), moved)[3].good


def test_what_a_turn_later_explains_is_no_difference_and_two_turns_are() -> None:
    """A turn of the state machine is four rows."""
    slope = np.arange(ROWS) * 0.5  # In degrees: 2 a turn.
    for later, good in ((0, True), (4, True), (8, False)):
        shifted = two_states(slope + 0.5 * later, 50)
        assert alike.differences(two_states(slope, 50), shifted)[1].good == good
    # Each state counts from its begin; 100 ms are 20 rows.
    for begins, good in ((70, True), (71, False)):
        found = alike.differences(
            two_states(np.zeros(ROWS), 50), two_states(np.zeros(ROWS), begins)
        )
        assert found[0].good == good


def landed(row: int) -> Trace:
    """It lands, and is disarmed from a row on."""
    view = np.zeros(2 * ROWS, dtype=VIEW)
    view["state"] = states().index("landing")
    view["state"][row:] = states().index("disarmed")
    return Trace(np.zeros((2 * ROWS, len(TRUTH))), view)


def test_a_touch_that_begins_anew_is_no_difference() -> None:
    """600 ms are 120 rows."""
    for later, good in ((120, True), (121, False)):
        begin, *_, lands = alike.differences(landed(30), landed(30 + later))
        assert (begin.good, lands.good) == (True, good)
        assert lands.value == f"{5 * later} ms apart"
