# SPDX-License-Identifier: Apache-2.0
"""What is printed of replays."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

Result = Mapping[str, Any]
TOLD = 30  # Events of a recording.


def number(value: float | None, digits: int = 1) -> str:
    """A figure, or nothing."""
    return "" if value is None else f"{value:.{digits}f}"


def table_of(title: str, first: str, headings: Iterable[str]) -> Table:
    """An empty one."""
    table = Table(title=title, title_justify="left")
    table.add_column(first, no_wrap=True)
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    return table


def error_of(result: Result, who: str, what: str, where: str, size: str = "rms") -> float | None:
    """A figure of an estimator."""
    found = result["attitude"].get(who)
    value: float | None = found[what][where][size] if found else None
    return value


def estimators(results: Sequence[Result]) -> list[str]:
    """Whoever stands in the tables."""
    return list(dict.fromkeys(name for result in results for name in result["attitude"]))


def attitudes(results: Sequence[Result]) -> Table:
    """Inclination: a row for each recording with a reference, and for all of them."""
    names = estimators(results)
    table = table_of(
        "Inclination error, degrees, rms",
        "recording",
        [
            *(f"{name},\nall" for name in names),
            *(f"{name},\nmoving" for name in names),
            "keel,\nmost",
            "by",
        ],
    )
    places = [(name, where) for where in ("all", "moving") for name in names]
    for result in results:
        table.add_row(
            Path(result["file"]).name,
            *(number(error_of(result, name, "inclination_deg", where)) for name, where in places),
            number(error_of(result, "keel", "inclination_deg", "all", "max")),
            result["judge"],
        )
    known = [result for result in results if result["judge"] == "reference"]
    if len(known) > 1:
        table.add_row(
            "rms of all with a reference",
            *(
                number(
                    together(error_of(result, name, "inclination_deg", where) for result in known)
                )
                for name, where in places
            ),
        )
    return table


def headings(results: Sequence[Result]) -> Table:
    """Heading, height, and how long Keel's attitude and heading were valid."""
    names = estimators(results)
    table = table_of(
        "Heading error, degrees, rms (Keel's where it is valid); height",
        "recording",
        [*names, "keel,\nmost", "running,\n%", "heading\nvalid, %", "height, m,\nrms", "most"],
    )
    for result in results:
        spent, height = result["phases_s"], result["height_m"] or {"rms": None, "max": None}
        table.add_row(
            Path(result["file"]).name,
            *(number(error_of(result, name, "heading_deg", "all")) for name in names),
            number(error_of(result, "keel", "heading_deg", "all", "max")),
            number(100.0 * spent["running"] / max(1e-9, sum(spent.values()))),
            number(100.0 * result["heading_valid"]),
            number(height["rms"], 2),
            number(height["max"], 2),
        )
    return table


def together(values: Iterable[float | None]) -> float | None:
    """The root of the mean square of figures."""
    found = [value for value in values if value is not None]
    return math.sqrt(sum(value * value for value in found) / len(found)) if found else None


def votes(results: Sequence[Result]) -> Table:
    """A row for each recording of more than one unit."""
    states = list(results[0]["votes"]["states"]["gyroscope"])
    table = table_of(
        "Votes: percent by state; distance to the mean of all units, rms, worst axis",
        "recording",
        [
            *(f"force,\n{name}" for name in states),
            *(f"rate,\n{name}" for name in states),
            "force, m/s^2:\nvote",
            "mean of\nthree",
            "rate, rad/s:\nvote",
            "mean of\nthree",
            "latch",
        ],
    )
    for result in results:
        found = result["votes"]
        cells = [
            number(100.0 * found["states"][kind][name])
            for kind in ("accelerometer", "gyroscope")
            for name in states
        ]
        cells += [
            number(found[who][kind], digits)
            for kind, digits in (("accelerometer", 2), ("gyroscope", 4))
            for who in ("from_mean_of_all", "plain_mean_of_three")
        ]
        units = sorted({span["unit"] for span in found["latched"]})
        table.add_row(Path(result["file"]).name, *cells, ", ".join(map(str, units)))
    return table


def latches(result: Result) -> list[str]:
    """When a unit was latched, in words."""
    return [
        f"unit {span['unit']} latched from {span['from_s']:.2f} to {span['to_s']:.2f} s"
        for span in result["votes"]["latched"]
    ]


def details(result: Result) -> list[str]:
    """Of one recording: how it was read, and what happened."""
    lines = [f"  {note}" for note in result["notes"]]
    spent = ", ".join(f"{name} {seconds:.1f} s" for name, seconds in result["phases_s"].items())
    lines.append(f"  attitude: {spent}")
    if result["height_m"]:
        rms, most = (number(result["height_m"][size], 2) for size in ("rms", "max"))
        lines.append(f"  height, apart from the recorder's: {rms} m rms, {most} m at most")
    lines += [f"  {line}" for line in latches(result)[:TOLD]]
    lines += [f"  {time:8.2f} s  {text}" for time, text in result["events"][:TOLD]]
    if len(result["events"]) > TOLD:
        lines.append(f"  and {len(result['events']) - TOLD} more events: in report.json")
    return lines


def tell(console: Console, results: Sequence[Result]) -> None:
    """The tables; of one recording all there is; whatever looks wrong."""
    good = [result for result in results if "refused" not in result]
    seen = [result for result in good if result["judge"]]
    several = [result for result in good if "from_mean_of_all" in result["votes"]]
    if seen:
        console.print(attitudes(seen))
        console.print(headings(seen))
    if several:
        console.print(votes(several))
    for result in good:
        if len(results) == 1:
            print("\n".join(details(result)))
        for doubt in result["doubts"]:
            print(f"{result['file']}: {doubt}")
