#!/usr/bin/env python3
"""The voter's fault campaign, and the paper's fig. 14: build, run, print tables, plot.

    python3 tools/campaign.py

build/campaign gets campaign.json (every flight), figure14.svg (errors of roll and pitch with and
without the voter) and faults.svg (the worst output error of each fault against the proved bound).

Exit status: 0 when every single fault stays within the bound and no healthy unit was latched by
one, 1 otherwise.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools"))

from proofs.cache import write_atomically  # noqa: E402
from toolchain import Toolchain, ToolchainError  # noqa: E402

BUILD = Path("build/campaign")
SOURCES = ("src/middleware/voter.c", "src/middleware/virtual_imu.c")
# Two roundings of the float's mean and of its distance, in units of a: VOT-016 at 100 m/s^2.
ROUNDING_A = 1e-3

Flight = dict[str, Any]


def build(tools: Toolchain) -> Path:
    """Build the campaign's program."""
    (ROOT / BUILD).mkdir(parents=True, exist_ok=True)
    objects = []
    for source in SOURCES:
        objects.append(str(BUILD / f"{Path(source).stem}.o"))
        flags = ["-std=c99", "-O2", "-Iinclude", "-c", source, "-o", objects[-1]]
        run([*tools.command("gcc"), *flags])
    program = BUILD / "campaign"
    eigen = tools.command("eigen")[0]
    run([*tools.command("g++"), "-std=c++17", "-O1", "-Iinclude", "-isystem", eigen,
         "tests/reference/campaign.cpp", *objects, "-o", str(program)])  # fmt: skip
    return ROOT / program


def run(command: Sequence[str]) -> str:
    """Run a program at the root; its output."""
    done = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
    return done.stdout


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


def svg(width: int, height: int, parts: Sequence[str]) -> str:
    """A drawing."""
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}"'
    style = 'font-family="sans-serif" font-size="12"'
    return "\n".join([f"{head} {style}>", '<rect width="100%" height="100%" fill="white"/>',
                      *parts, "</svg>", ""])  # fmt: skip


def curve(times: Sequence[float], values: Sequence[float], top: float, scale: float,
          colour: str) -> str:  # fmt: skip
    """A curve over 12 s, 780 wide; the value 0 lies at top."""
    points = " ".join(f"{60 + 65 * t:.1f},{top - scale * v:.1f}" for t, v in zip(times, values))
    return f'<polyline fill="none" stroke="{colour}" points="{points}"/>'


def figure14(trace: Sequence[Sequence[float]]) -> str:
    """Errors of roll and pitch over time, in degrees."""
    degree = 57.29578
    times = [row[0] for row in trace]
    largest = degree * max(abs(value) for row in trace for value in row[1:])
    scale = 110.0 / max(largest, 1e-9)
    parts = []
    for number, name in enumerate(("roll", "pitch")):
        top = 150 + 260 * number
        axis = f'x1="60" x2="840" y1="{top}" y2="{top}"'
        parts.append(f'<line {axis} stroke="#bbb"/>')
        legend = f"full scale {largest:.1f} degrees: blue with the voter, red plain mean"
        parts.append(f'<text x="60" y="{top - 120}">error of {name}, {legend}</text>')
        for column, colour in ((3 + number, "#c33"), (1 + number, "#36c")):
            values = [degree * row[column] for row in trace]
            parts.append(curve(times, values, top, scale, colour))
    dashed = 'stroke="#888" stroke-dasharray="4"'
    parts.append(f'<line x1="580" x2="580" y1="20" y2="530" {dashed}/>')
    parts.append('<text x="585" y="545">unit 3 freezes at 8 s</text>')
    return svg(880, 560, parts)


def faults(groups: dict[str, list[Flight]], bound: float) -> str:
    """A bar per single fault, and the bound."""
    single = {fault: flights for fault, flights in groups.items() if not is_double(fault)}
    parts = []
    for number, (fault, flights) in enumerate(single.items()):
        y = 20 + 30 * number
        length = 600.0 * max(flight["worst_a"] for flight in flights)
        parts.append(f'<text x="10" y="{y + 14}">{fault}</text>')
        parts.append(f'<rect x="120" y="{y}" width="{length:.1f}" height="18" fill="#36c"/>')
    end = 30 * len(single) + 20
    x = 120 + 600 * bound
    parts.append(f'<line x1="{x}" x2="{x}" y1="10" y2="{end}" stroke="#c33"/>')
    parts.append(f'<text x="{x - 60}" y="{end + 16}">bound: {bound} a</text>')
    return svg(520, end + 30, parts)


def errors(trace: Sequence[Sequence[float]], start_s: float) -> str:
    """The largest errors after the fault."""
    after = [row for row in trace if row[0] >= start_s]
    most = [57.29578 * max(abs(row[column]) for row in after) for column in range(1, 5)]
    return (f"largest error, degrees: roll {most[0]:.2f}, pitch {most[1]:.2f} with the voter; "
            f"roll {most[2]:.2f}, pitch {most[3]:.2f} with a plain mean")  # fmt: skip


def main() -> int:
    """Entry point."""
    try:
        tools = Toolchain()
        tools.ensure("test")
        text = run([str(build(tools))])
    except (ToolchainError, subprocess.CalledProcessError) as error:
        print(f"campaign: {error}\n{getattr(error, 'stderr', '')}", file=sys.stderr)
        return 1
    campaign = json.loads(text)
    groups, bound = by_fault(campaign["flights"]), float(campaign["bound"])
    shown = campaign["figure14"]
    folder = ROOT / BUILD
    write_atomically(folder / "campaign.json", text)
    write_atomically(folder / "figure14.svg", figure14(shown["trace"]))
    write_atomically(folder / "faults.svg", faults(groups, bound))
    for limit, flights in by_limit(campaign["flights"]).items():
        rule = f"leaky count to {limit} besides" if limit else "100 votes in a row alone latch"
        print(f"\n{rule}:\n" + "\n".join(table(by_fault(flights), bound)))
    print(f"\nfig. 14: unit 3 frozen at 8 s, all six channels latched after "
          f"{1000.0 * shown['all_latched_s']:.0f} ms")  # fmt: skip
    print(f"fig. 14: {errors(shown['trace'], 8.0)}")
    print(f"written: {BUILD}/campaign.json, figure14.svg, faults.svg")
    single = [flight for flight in campaign["flights"] if not is_double(flight["fault"])]
    good = all(f["worst_a"] <= bound + ROUNDING_A and not f["healthy_latched"] for f in single)
    return 0 if good and shown["all_latched_s"] >= 0.0 else 1


if __name__ == "__main__":
    sys.exit(main())
