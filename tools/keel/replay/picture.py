# SPDX-License-Identifier: Apache-2.0
"""Draws a replay: errors of each estimator, heading, the vote beside the mean, votes by state."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from keel.base.plotting import BLUE, GREY, ORANGE, RED, SKY, new_figure, write_png
from keel.replay.copter import Track
from keel.replay.figures import attitude_errors, judge_of, vote_states
from keel.replay.recording import Recording, Series, moving_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = {"keel": BLUE, "vqf": ORANGE, "mahony": SKY, "recorder": GREY}
POINTS = 3000


def thin(values: Any) -> Any:
    """What is drawn of a curve."""
    return values[:: max(1, len(values) // POINTS)]


def draw_errors(
    axes: tuple[Axes, Axes], recording: Recording, estimates: Mapping[str, Series]
) -> None:
    """Inclination and heading of each estimator, and where it moves."""
    for name, estimate in estimates.items():
        found = attitude_errors(recording, estimate)
        if found is None:
            return
        for one, error in zip(axes, found[1:], strict=True):
            one.plot(thin(found[0]), thin(error), color=COLOURS[name], label=name, linewidth=0.9)
    times = np.linspace(0.0, recording.duration_s, POINTS)
    moves = moving_of(recording, times)
    for one in axes:
        one.fill_between(
            times,
            0,
            1,
            where=moves.tolist(),
            color="#eeeeee",
            zorder=0,
            transform=one.get_xaxis_transform(),
            linewidth=0,
        )
    axes[0].legend(ncols=4, loc="upper left")
    axes[0].set_ylabel("inclination error,\ndegrees")
    axes[1].set_ylabel("heading error,\ndegrees")


def draw_votes(axes: tuple[Axes, Axes], track: Track, mean: Track | None) -> None:
    """The gyroscopes' output, and the share of the channels by the state of their vote."""
    for number, colour in enumerate((BLUE, ORANGE, SKY)):
        rate = track.view["vote"][:, 3 + number]
        axes[0].plot(thin(track.time), thin(rate), color=colour, label="xyz"[number], linewidth=0.7)
        if mean:
            axes[0].plot(
                thin(mean.time), thin(mean.view["vote"][:, 3 + number]), color=GREY, linewidth=0.4
            )
    axes[0].legend(ncols=3, loc="upper left")
    axes[0].set_ylabel("voted rate, rad/s" + ("\n(grey: mean of all)" if mean else ""))
    axes[1].set_ylabel("share of votes")
    axes[1].set_ylim(0.0, 1.0)
    step = max(1, len(track.time) // 300)
    rows = len(track.time) // step * step
    parts = [
        (track.view["vote_state"][:rows] == number).mean(1).reshape(-1, step).mean(1)
        for number in range(len(vote_states()))
    ]
    axes[1].stackplot(
        track.time[:rows:step],
        parts,
        labels=vote_states(),
        linewidth=0,
        colors=(SKY, ORANGE, RED, GREY, BLUE, "black"),
    )
    axes[1].legend(ncols=5, loc="lower left")


def draw(
    path: Path, recording: Recording, track: Track, others: Mapping[str, Series], mean: Track | None
) -> None:
    """The whole picture."""
    judge = {
        None: "no reference",
        "recorder": "against the recorder's estimate",
        "reference": "against the reference",
    }[judge_of(recording)]
    first = 2 if recording.judge else 0  # Where the votes' axes are.
    figure = new_figure(10.0, 4.5 + 2.25 * first)
    axes = figure.subplots(first + 2, 1, sharex=True)
    seen = track.since(0.0)
    if recording.judge:
        draw_errors((axes[0], axes[1]), recording, {"keel": seen.attitude, **others})
    draw_votes((axes[first], axes[first + 1]), seen, mean.since(0.0) if mean else None)
    axes[0].set_title(f"{recording.path.name}: {judge}; grey: it moves")
    axes[first + 1].set_xlabel("time, s")
    write_png(path, figure)
