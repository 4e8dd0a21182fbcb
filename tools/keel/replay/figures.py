# SPDX-License-Identifier: Apache-2.0
"""Measures a replay: errors, phases, votes, height, and what looks wrong in the recording."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from keel.base.errors import ROOT
from keel.base.files import read_text
from keel.replay import turns
from keel.replay.copter import Track
from keel.replay.recording import GRAVITY, Recording, Series, moving_of

VOTER = "include/keel/middleware/voter.h"
PHASES = ("still", "aligning", "running")
RUNNING = 2
CHANNELS = {"accelerometer": slice(0, 3), "gyroscope": slice(3, 6)}
WINDOW_S = 0.1  # Of which axes are compared,
LEAST_TURN = 0.02  # when they turn by so much in it (rms, in rad),
LIKE, RATIO = 0.7, (0.8, 1.25)  # and so alike they must be: correlation, ratio.
UP_S, UP_DEG = 4.0, 20.0  # Of the specific force, seen from the Earth, in means of so long.


def vote_states() -> list[str]:
    """The names of a vote's states, by their numbers: as the header has them."""
    part = read_text(ROOT / VOTER).partition("keel_vote_t, state.")[2].partition("typedef")[0]
    return [name.lower() for name in re.findall(r"#define KEEL_VOTER_(\w+)\s+\d+u /\*\*", part)]


def size_of(values: Any) -> dict[str, float | None]:
    """Root of the mean square, and the greatest; None when there are none."""
    found = np.abs(values[np.isfinite(values)])
    if not len(found):
        return {"rms": None, "max": None}
    return {"rms": float(np.sqrt((found**2).mean())), "max": float(found.max())}


def attitude_errors(recording: Recording, estimate: Series) -> tuple[Any, Any, Any] | None:
    """When, and by how many degrees inclination and heading are off; None without a judge."""
    judge = recording.judge
    if judge is None:
        return None
    inside = (judge.time >= 0.0) & (judge.time <= estimate.time[-1])
    time = judge.time[inside]
    there = turns.between(estimate.value, estimate.time, time)
    return (time, *turns.apart(there, judge.value[inside]))


def attitude(recording: Recording, estimate: Series, valid: Any = None) -> dict[str, Any] | None:
    """Errors of an estimate over all and over what moves; of its heading only where it is valid."""
    found = attitude_errors(recording, estimate)
    if found is None:
        return None
    time, tilt, heading = found
    moves = moving_of(recording, time)
    if recording.field is None or recording.expected is None:
        heading = np.full(len(heading), np.nan)
    elif valid is not None:
        heading = np.where(np.interp(time, estimate.time, valid) > 0.5, heading, np.nan)
    return {
        name: {"all": size_of(error), "moving": size_of(error[moves])}
        for name, error in (("inclination_deg", tilt), ("heading_deg", heading))
    }


def spans(time: Any, flags: Any) -> list[tuple[float, float]]:
    """From when to when something holds."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], flags.astype(int), [0]])))
    last = len(time) - 1
    return [
        (float(time[first]), float(time[min(end, last)]))
        for first, end in zip(edges[::2], edges[1::2], strict=True)
    ]


def votes(track: Track, count: int) -> dict[str, Any]:
    """Shares of the votes by state; of each unit those it counted in, and when it was latched."""
    names, view = vote_states(), track.view
    found: dict[str, Any] = {
        "units": count,
        "states": {
            kind: {
                name: float((view["vote_state"][:, part] == number).mean())
                for number, name in enumerate(names)
            }
            for kind, part in CHANNELS.items()
        },
    }
    bits = view["used"][:, :, None] >> np.arange(6) & 1
    found["counted"] = [
        [float(bits[:, unit, part].mean()) for part in CHANNELS.values()] for unit in range(3)
    ]
    found["latched"] = [
        {"unit": unit + 1, "from_s": begin, "to_s": end}
        for unit in range(3)
        for begin, end in spans(track.time, view["latched"][:, unit] > 0)
    ]
    return found


def distance(track: Track, mean: Track) -> dict[str, float]:
    """How far the votes' output is from another track's: rms, on the worst axis."""
    apart = track.view["vote"].astype(float) - mean.view["vote"].astype(float)
    return {
        kind: float(np.sqrt((apart[:, part] ** 2).mean(0)).max()) for kind, part in CHANNELS.items()
    }


def phases(track: Track) -> dict[str, float]:
    """Seconds in each."""
    step = float(np.median(np.diff(track.time)))
    return {
        name: step * float((track.view["phase"] == number).sum())
        for number, name in enumerate(PHASES)
    }


def events(track: Track) -> Iterator[tuple[float, str]]:
    """What detectors said: in the copter's own words, or by what they changed."""
    yield from ((time, text) for time, text in track.words if not text.startswith("radio: "))
    for name, words in (
        ("phase", [f"attitude {phase}" for phase in PHASES]),
        ("heading_valid", ["heading not valid", "heading valid"]),
    ):
        value = track.view[name]
        for row in np.flatnonzero(np.diff(value.astype(int))) + 1:
            yield float(track.time[row]), words[int(value[row])]


def height(recording: Recording, track: Track) -> dict[str, float | None] | None:
    """How far Keel's height and the recorder's go apart, in m, once Keel's is good: both from their
    mean on."""
    if recording.height is None or recording.pressure is None:
        return None
    good = np.interp(recording.height.time, track.time, track.view["height_quality"]) >= RUNNING
    keel = np.interp(recording.height.time, track.time, track.view["position"][:, 2])
    apart = (keel - recording.height.value)[good & (recording.height.time >= 0.0)]
    return size_of(apart - apart.mean()) if len(apart) else None


def windows(series: Series, time: Any) -> Any:
    """Means of windows; NaN where there is no sample."""
    place = np.searchsorted(time, series.time) - 1
    inside = (place >= 0) & (place < len(time) - 1)
    count = np.bincount(place[inside], minlength=len(time) - 1).astype(float)
    count[count == 0.0] = np.nan
    return np.stack(
        [
            np.bincount(place[inside], column[inside], len(time) - 1) / count
            for column in series.value.T
        ],
        1,
    )


def alike(said: Any, true: Any) -> tuple[float, float] | None:
    """How like two series of small turns are: correlation and ratio; None when little moves."""
    whole = np.isfinite(said).all(1) & np.isfinite(true).all(1)
    said, true = said[whole], true[whole]
    power, theirs = float((said**2).sum()), float((true**2).sum())
    if len(said) < 20 or max(power, theirs) / len(said) < LEAST_TURN**2:
        return None
    common = float((said * true).sum())
    return common / (power * theirs or 1.0) ** 0.5, common / (power or 1.0)


def field_turns(unit: Series, seen: Series) -> tuple[float, float] | None:
    """How like the field's turns are, as they were seen and as the gyroscope says."""
    time = np.arange(0.0, unit.time[-1], WINDOW_S)
    rate = windows(Series(unit.time, unit.value[:, 3:]), time)
    there = windows(seen, time)
    there = there / np.linalg.norm(there, axis=1, keepdims=True)
    turn = small_turn(-WINDOW_S * (rate[1:] + rate[:-1]) / 2.0)
    return alike(turns.turned(turn, there[:-1]) - there[:-1], np.diff(there, axis=0))


def small_turn(angle: Any) -> Any:
    """The quaternion of a turn about an axis by its length."""
    half = np.linalg.norm(angle, axis=1, keepdims=True) / 2.0
    return np.hstack([np.cos(half), angle / 2.0 * np.sinc(half / np.pi)])


def known_turns(unit: Series, judge: Series) -> tuple[float, float] | None:
    """The same of the carrier's turns, as the reference has them."""
    time = np.arange(judge.time[0], min(judge.time[-1], unit.time[-1]), WINDOW_S)
    if len(time) < 2:
        return None
    rate = windows(Series(unit.time, unit.value[:, 3:]), time)
    there = turns.between(judge.value, judge.time, time)
    step = turns.times(turns.back(there[:-1]), there[1:])
    seen = np.diff(np.searchsorted(judge.time, time)) > 0  # Else it was not seen.
    true = 2.0 * step[:, 1:] * np.where(step[:, :1] < 0.0, -1.0, 1.0)
    return alike(WINDOW_S * rate, np.where(seen[:, None], true, np.nan))


def off_upright(unit: Series, judge: Series) -> float | None:
    """By how many degrees the specific force, seen from the Earth, is not upright: the median of
    means of seconds, as accelerations come and go."""
    inside = (unit.time >= judge.time[0]) & (unit.time <= judge.time[-1])
    time = unit.time[inside]
    if not len(time) or time[-1] - time[0] < 2.0 * UP_S:
        return None
    turn = turns.between(judge.value, judge.time, time)
    force = Series(time, turns.turned(turn, unit.value[inside, :3]))
    mean = windows(force, np.arange(time[0], time[-1], UP_S))
    off = np.degrees(np.arctan2(np.hypot(mean[:, 0], mean[:, 1]), -mean[:, 2]))
    return float(np.nanmedian(off))


def unlike(found: tuple[float, float] | None) -> str:
    """What is told of turns that are not alike."""
    if found is None or (found[0] >= LIKE and RATIO[0] <= found[1] <= RATIO[1]):
        return ""
    return (
        f"do not turn alike (correlation {found[0]:.2f}, ratio {found[1]:.2f}): swapped or "
        "reversed axes, or another unit of measurement?"
    )


def doubts(recording: Recording) -> list[str]:
    """What does not go together in a recording: units or axes that are other ones than it says."""
    found, judge = [], recording.judge
    for number, unit in enumerate(recording.units, 1):
        force = float(np.median(np.linalg.norm(unit.value[:, :3], axis=1)))
        if not 0.7 < force / GRAVITY < 1.4:
            found.append(
                f"unit {number}: half of the specific forces are above {force:.2f} m/s^2, "
                f"expected {GRAVITY:.1f}: another unit of measurement?"
            )
        if judge and (words := unlike(known_turns(unit, judge))):
            found.append(f"unit {number}: gyroscope and {judge_of(recording)} {words}")
        if judge and (off := off_upright(unit, judge)) is not None and off > UP_DEG:
            found.append(
                f"unit {number}: the accelerometer is {off:.0f} degrees off what the "
                f"{judge_of(recording)} has upright: swapped or reversed axes?"
            )
        if recording.field and (words := unlike(field_turns(unit, recording.field))):
            found.append(f"unit {number}: gyroscope and magnetometer {words}")
    return found


def judge_of(recording: Recording) -> str | None:
    """By what errors are measured."""
    return "reference" if recording.reference else "recorder" if recording.estimate else None


def measured(
    recording: Recording,
    track: Track,
    others: Mapping[str, Series],
    means: tuple[Track, Track] | None,
) -> dict[str, Any]:
    """All figures of a replay; from 0 s on."""
    seen = track.since(0.0)
    vote = votes(seen, len(recording.units))
    if means:
        vote["from_mean_of_all"] = distance(seen, means[0].since(0.0))
        vote["plain_mean_of_three"] = distance(means[1].since(0.0), means[0].since(0.0))
    return {
        "file": str(recording.path),
        "duration_s": recording.duration_s,
        "judge": judge_of(recording),
        "expected_field_ut": recording.expected,
        "notes": recording.notes,
        "doubts": doubts(recording),
        "phases_s": phases(seen),
        "heading_valid": float(seen.view["heading_valid"].mean()),
        "attitude": {
            "keel": attitude(recording, seen.attitude, seen.view["heading_valid"]),
            **{name: attitude(recording, one) for name, one in others.items()},
        },
        "votes": vote,
        "height_m": height(recording, seen),
        "events": sorted([time, text] for time, text in events(track)),
    }
