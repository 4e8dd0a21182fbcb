# SPDX-License-Identifier: Apache-2.0
"""The fault campaign's plots: fig. 14, and what each fault does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Any

from keel.base.plotting import BLUE, GREY, ORANGE, RED, grid_along, new_figure, write_svg

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Flight = dict[str, Any]
# Flights by fault, under the name of the rule by which a unit is latched.
Campaign = Mapping[str, Mapping[str, Sequence[Flight]]]

HEIGHT = 0.36  # Of a bar; faults are 1 apart.
LEAST_MS, MOST_MS = 50.0, 12_000.0


def plot_figure14(trace: Sequence[Sequence[float]], fault_s: float, path: Path) -> None:
    """Errors of roll and pitch over time, with the voter and with a plain mean."""
    figure = new_figure(7.0, 4.2)
    times = [row[0] for row in trace]
    upper, lower = figure.subplots(2, 1, sharex=True)
    for column, (axes, angle) in enumerate(((upper, "roll"), (lower, "pitch"))):
        for label, first, colour in (("plain mean", 3, RED), ("voter", 1, BLUE)):
            errors = [degrees(row[first + column]) for row in trace]
            axes.plot(times, errors, color=colour, label=label)
        axes.axvline(fault_s, color=GREY, linestyle="--", linewidth=0.8)
        axes.set(ylabel=f"error of {angle}, degrees", xlim=(0.0, 12.0))
    upper.set_title("Attitude from three inertial units; one of them freezes in flight (fig. 14)")
    middle = sum(upper.get_ylim()) / 2
    upper.text(fault_s - 0.1, middle, "unit 3 freezes", ha="right", va="center", color=GREY)
    upper.legend(loc="center left")
    lower.set_xlabel("time, s")
    write_svg(path, figure)


def worst_error(flights: Sequence[Flight]) -> float:
    """How far an output left the hull of the healthy units, in units of a."""
    return max(0.0, *(float(flight["worst_a"]) for flight in flights))


def draw_errors(axes: Axes, campaign: Campaign, bound: float) -> None:
    """The worst error of each fault beside the bound."""
    for number, (rule, groups) in enumerate(campaign.items()):
        errors = [worst_error(flights) for flights in groups.values()]
        places = [place + (number - 0.5) * HEIGHT for place in range(len(errors))]
        axes.barh(places, errors, HEIGHT, color=(BLUE, ORANGE)[number], label=rule)
        for place, error in zip(places, errors, strict=True):
            axes.text(error + 0.01, place, f"{error:.2f}", va="center", fontsize=7)
    axes.axvline(bound, color=RED, linewidth=1.2)
    axes.text(bound, -0.75, f"proved bound: {bound} a ", color=RED, ha="right", va="bottom")
    axes.set(
        xlabel="worst error of the output; a: how far healthy units may differ",
        xlim=(0.0, 1.16 * bound),
    )


def draw_latencies(axes: Axes, campaign: Campaign) -> None:
    """From when to when the flights' faulty units were latched in all channels."""
    for number, groups in enumerate(campaign.values()):
        for place, flights in enumerate(groups.values()):
            y = place + (number - 0.5) * HEIGHT
            seen = [1000.0 * flight["all_latched_s"] for flight in flights]
            seen = [value for value in seen if value >= 0.0]
            if seen:
                colour = (BLUE, ORANGE)[number]
                axes.plot([min(seen), max(seen)], [y, y], color=colour, marker="o", markersize=4)
            else:
                axes.text(LEAST_MS * 1.1, y, "never", va="center", fontsize=7, color=GREY)
    axes.set(
        xscale="log",
        xlim=(LEAST_MS, MOST_MS),
        xlabel="from the fault to its latch in all channels, ms",
    )
    axes.minorticks_off()
    axes.set_xticks([100, 1000, 10_000], ["100", "1000", "10 000"])


def plot_faults(campaign: Campaign, bound: float, path: Path) -> None:
    """Each single fault: how far it moved the output, and when it was latched."""
    figure = new_figure(9.0, 4.4)
    left, right = figure.subplots(1, 2, sharey=True)
    faults = list(next(iter(campaign.values())))
    draw_errors(left, campaign, bound)
    draw_latencies(right, campaign)
    left.set_yticks(range(len(faults)), faults)
    left.set_ylim(len(faults) - 0.4, -0.8)
    for axes in (left, right):
        grid_along(axes, "x")
    figure.suptitle("A fault in one of three inertial units: 12 flights each", x=0.01, ha="left")
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    write_svg(path, figure)
