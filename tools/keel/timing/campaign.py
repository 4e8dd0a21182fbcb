# SPDX-License-Identifier: Apache-2.0
"""The voter's fault campaign, and the paper's fig. 14: build, run, print tables, plot.

    python3 tools/keel campaign

build/campaign gets campaign.json (every flight), figure14.svg (errors of roll and pitch with the
voter and with a plain mean) and faults.svg (of each fault the worst error of the output beside the
proved bound, and when the faulty unit was latched).

Exit status: 0 when every single fault stays within the bound and no healthy unit was latched by
one, 1 when not, 2 when it could not be flown.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from math import degrees
from pathlib import Path
from typing import Any

from keel.base.arguments import Parser
from keel.base.build import Build
from keel.base.errors import ROOT, program
from keel.base.files import write_text
from keel.base.run import output_of
from keel.install import Toolchain
from keel.timing.campaign_plots import Flight, plot_faults, plot_figure14

BUILD = Path("build/campaign")
SOURCES = ("src/middleware/voter.c", "src/middleware/virtual_imu.c")
# Two roundings of the float's mean and of its distance, in units of a: VOT-016 at 100 m/s^2.
ROUNDING_A = 1e-3
FAULT_S = 8.0  # When unit 3 freezes in fig. 14.


def build(tools: Toolchain) -> Path:
    """Build the campaign's program."""
    c = Build(tools, "gcc", ["-std=c99", "-O2", "-Iinclude"], ROOT / BUILD / "obj")
    eigen = tools.command("eigen")[0]
    flags = ["-std=c++17", "-O1", "-Iinclude", "-isystem", eigen]
    cpp = Build(tools, "g++", flags, ROOT / BUILD)
    return cpp.link("campaign", [cpp.object("tests/reference/campaign.cpp"), *c.objects(SOURCES)])


def by_fault(flights: Sequence[Flight]) -> dict[str, list[Flight]]:
    """The flights of each fault, in the order of their first."""
    groups: dict[str, list[Flight]] = {}
    for flight in flights:
        groups.setdefault(flight["fault"], []).append(flight)
    return groups


def by_limit(flights: Sequence[Flight]) -> dict[int, list[Flight]]:
    """The flights with each limit of the density rule; 0 is without."""
    groups: dict[int, list[Flight]] = {}
    for flight in flights:
        groups.setdefault(int(flight["density_limit"]), []).append(flight)
    return groups


def latency(flights: Sequence[Flight], key: str) -> str:
    """The range of a latency in ms, or that not all flights have one."""
    values = [1000.0 * flight[key] for flight in flights if flight[key] >= 0.0]
    if not values:
        return "never"
    text = f"{min(values):.0f} to {max(values):.0f}"
    return text if len(values) == len(flights) else f"{text} ({len(values)} of {len(flights)})"


def table(groups: dict[str, list[Flight]], bound: float) -> list[str]:
    """The campaign's table; latencies are from the fault's start to the latch."""
    lines = [
        f"{'fault':<14} {'flights':>7} {'first channel, ms':>18} {'all channels, ms':>18}"
        f" {'worst error, a':>15}  bound {bound}"
    ]
    for fault, flights in groups.items():
        worst = max(flight["worst_a"] for flight in flights)
        told = "outvotes the healthy one" if is_double(fault) else verdict(worst, bound)
        lines.append(
            f"{fault:<14} {len(flights):>7} {latency(flights, 'first_latch_s'):>18}"
            f" {latency(flights, 'all_latched_s'):>18} {worst:>15.4f}  {told}"
        )
    return lines


def verdict(worst: float, bound: float) -> str:
    """Whether an error is within the bound."""
    return "within" if worst <= bound + ROUNDING_A else "EXCEEDED"


def is_double(fault: str) -> bool:
    """Whether two units are faulty, which no bound covers."""
    return fault.startswith("two")


def rule_of(limit: int) -> str:
    """By what a unit is latched, in words."""
    row = "latched by 100 bad votes in a row"
    return f"{row}, or by a leaky count of {limit}" if limit else row


def single_faults(flights: Sequence[Flight]) -> dict[str, dict[str, list[Flight]]]:
    """The flights with one faulty unit: by rule, then by fault."""
    single = [flight for flight in flights if not is_double(flight["fault"])]
    return {rule_of(limit): by_fault(group) for limit, group in by_limit(single).items()}


def errors(trace: Sequence[Sequence[float]], start_s: float) -> str:
    """The largest errors after the fault."""
    after = [row for row in trace if row[0] >= start_s]
    most = [degrees(max(abs(row[column]) for row in after)) for column in range(1, 5)]
    return (
        f"largest error, degrees: roll {most[0]:.2f}, pitch {most[1]:.2f} with the voter; "
        f"roll {most[2]:.2f}, pitch {most[3]:.2f} with a plain mean"
    )


def is_good(flights: Sequence[Flight], bound: float) -> bool:
    """Whether no single fault left the bound or had a healthy unit latched."""
    single = [flight for flight in flights if not is_double(flight["fault"])]
    return all(f["worst_a"] <= bound + ROUNDING_A and not f["healthy_latched"] for f in single)


def tell(campaign: dict[str, Any]) -> None:
    """Print the tables and what fig. 14 shows."""
    bound, shown = float(campaign["bound"]), campaign["figure14"]
    for limit, group in by_limit(campaign["flights"]).items():
        print(f"\n{rule_of(limit)}:\n" + "\n".join(table(by_fault(group), bound)))
    print(
        f"\nfig. 14: unit 3 frozen at {FAULT_S:.0f} s, all six channels latched after "
        f"{1000.0 * shown['all_latched_s']:.0f} ms"
    )
    print(f"fig. 14: {errors(shown['trace'], FAULT_S)}")
    print(f"written: {BUILD}/campaign.json, figure14.svg, faults.svg")


def fly() -> int:
    """Build, run, write, tell."""
    tools = Toolchain()
    tools.ensure("test")
    text = output_of([build(tools)])
    campaign = json.loads(text)
    flights, bound, shown = campaign["flights"], float(campaign["bound"]), campaign["figure14"]
    write_text(ROOT / BUILD / "campaign.json", text)
    plot_figure14(shown["trace"], FAULT_S, ROOT / BUILD / "figure14.svg")
    plot_faults(single_faults(flights), bound, ROOT / BUILD / "faults.svg")
    tell(campaign)
    return 0 if is_good(flights, bound) and shown["all_latched_s"] >= 0.0 else 1


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    Parser("Break sensors one by one, and plot what the voter makes of it.", "campaign").parse_args(
        arguments
    )
    return program("campaign", fly)
