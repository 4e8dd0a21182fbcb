# SPDX-License-Identifier: Apache-2.0
"""Run recorded sensors through the copter's vote, estimators and detectors, and measure them.

    python3 tools/keel replay flight.ulg [--compare]

FILE is a log in ULog, of PX4 or of Keel, a CSV or an npz as docs/replay.md has them, or a folder of
such. build/replay gets a picture of each, and report.json with all figures.

Exit status: 0 when all was replayed, 1 when --limit-degrees does not hold, 2 when a file was
refused, or could not be replayed.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import write_json
from keel.flight import library, tables
from keel.flight.crew import copter_of, leave_ctrl_c
from keel.install import Toolchain
from keel.replay import figures, others, picture, readers, recording, tell
from keel.replay.copter import Track, replayed
from keel.replay.recording import Recording, Series

BUILD = ROOT / "build/replay"
SCHEMA = 1


@dataclass(frozen=True)
class Job:
    """A recording, and how it is replayed."""

    path: Path
    library: Path
    picture: Path | None
    compare: bool
    frame: str
    align: str
    lead_s: float
    expected: tuple[float, float] | None


def prepared(job: Job) -> Recording:
    """A recording as it is replayed."""
    found = readers.read(job.path, job.frame)
    if job.align == "yes" or (
        job.align == "auto" and job.path.suffix == ".npz" and len(found.units) > 1
    ):
        found = recording.aligned(found)
    return recording.with_lead_in(recording.with_expected_field(found, job.expected), job.lead_s)


def means_of(job: Job, found: Recording) -> tuple[Track, Track] | None:
    """What the vote could know at best: the mean of all units, in place of each; and the plain mean
    of the copter's three. Both go the way of a vote, so that its filters do not count."""
    if len(found.units) < 2:
        return None
    copter = copter_of(job.library)
    alone = replace(found, field=None, pressure=None, fixes=None)
    return (
        replayed(copter, alone, [recording.mean_unit(found.units)]),
        replayed(copter, alone, [recording.mean_unit(found.units[:3])]),
    )


def replay_one(job: Job) -> dict[str, Any]:
    """The figures of a recording, or why it was refused."""
    try:
        found = prepared(job)
        track = replayed(copter_of(job.library), found)
        beside: dict[str, Series] = {}
        if job.compare:
            beside = {"vqf": others.vqf(found), "mahony": others.mahony(found)}
        if found.reference and found.estimate:
            beside["recorder"] = found.estimate
        means = means_of(job, found)
        result = figures.measured(found, track, beside, means)
        if job.picture:
            picture.draw(job.picture, found, track, beside, means and means[0])
    except ToolError as error:
        return {"file": str(job.path), "refused": str(error)}
    return result


def parsed(arguments: Sequence[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = Parser("Replay recorded sensors through the copter's estimators.", "replay")
    parser.add_argument("file", metavar="FILE", help="a recording (.ulg, .csv, .npz), or a folder")
    parser.add_argument("--compare", action="store_true", help="VQF and a Mahony filter beside it")
    parser.add_argument(
        "--limit-degrees",
        type=float,
        metavar="D",
        help="exit status 1 when an inclination is off by more, rms, in motion",
    )
    parser.add_argument(
        "--frame",
        choices=("frd", "flu"),
        default="frd",
        help="a CSV's axes: forward, right, down, or forward, left, up",
    )
    parser.add_argument(
        "--align",
        choices=("auto", "yes", "no"),
        default="auto",
        help="turn units onto their mean (auto: those of an npz)",
    )
    parser.add_argument(
        "--lead-in",
        type=float,
        default=recording.LEAD_S,
        metavar="S",
        help="rest that is put before it, in s (8)",
    )
    parser.add_argument(
        "--field",
        type=float,
        nargs=2,
        metavar=("NORTH", "EAST"),
        help="the Earth's field where it was recorded, in uT",
    )
    parser.add_argument(
        "--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="recordings at a time"
    )
    parser.add_argument(
        "--build",
        type=Path,
        default=BUILD,
        metavar="FOLDER",
        help="where the report and the pictures go",
    )
    parser.add_argument("--no-pictures", action="store_true")
    found = parser.parse_args(arguments)
    if not found.file:
        raise ToolError("which recording? make check NAME=replay FILE=flight.ulg")
    if found.jobs < 1:
        raise ToolError(f"--jobs: expected 1 or more, found {found.jobs}")
    if found.limit_degrees is not None and not 0.0 < found.limit_degrees <= 180.0:
        raise ToolError(f"--limit-degrees: expected up to 180, found {found.limit_degrees:g}")
    if not 0.0 <= found.lead_in <= 60.0:
        raise ToolError(f"--lead-in: expected 0 to 60, found {found.lead_in:g}")
    if found.field and not all(abs(part) <= 80.0 for part in found.field):
        raise ToolError(f"--field: expected -80 to 80 uT, found {found.field}")
    return found


def jobs_of(options: argparse.Namespace) -> list[Job]:
    """The file, or all of a folder."""
    path = Path(options.file)
    paths = [path]
    if path.is_dir():
        paths = sorted(one for one in path.iterdir() if one.suffix in readers.SUFFIXES)
    elif not path.exists():
        raise ToolError(f"{path}: there is no such file")
    if not paths:
        raise ToolError(f"{path}: has no file with {', '.join(readers.SUFFIXES)}")
    expected = (options.field[0], options.field[1]) if options.field else None
    return [
        Job(
            one,
            options.build / library.NAME,
            None if options.no_pictures else options.build / f"{one.name}.png",
            options.compare,
            options.frame,
            options.align,
            options.lead_in,
            expected,
        )
        for one in paths
    ]


def all_replayed(jobs: Sequence[Job], width: int) -> list[dict[str, Any]]:
    """In their order; a process for each copter."""
    if len(jobs) == 1:
        return [replay_one(jobs[0])]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(min(width, len(jobs)), context, leave_ctrl_c) as pool:
        return list(pool.map(replay_one, jobs))


def is_beyond(result: Mapping[str, Any], limit: float) -> bool:
    """Whether the inclination in motion is off by more, or is not known at all."""
    found = result["attitude"]["keel"]
    if found is None:
        return True
    inclination = found["inclination_deg"]
    rms = inclination["moving"]["rms"]
    rms = inclination["all"]["rms"] if rms is None else rms
    return rms is None or rms > limit


def replay(arguments: Sequence[str] | None) -> int:
    """Build, replay, write, tell."""
    options = parsed(arguments)
    jobs = jobs_of(options)
    report: Path = options.build / "report.json"
    report.unlink(missing_ok=True)  # What an older run found is not what this one finds.
    for job in jobs:
        if job.picture:
            job.picture.unlink(missing_ok=True)
    copter = library.build(Toolchain(), options.build)
    results = all_replayed([replace(job, library=copter) for job in jobs], options.jobs)
    good = [result for result in results if "refused" not in result]
    limit: float | None = options.limit_degrees
    beyond = [result for result in good if limit is not None and is_beyond(result, limit)]
    write_json(
        report,
        {
            "schema": SCHEMA,
            "sources_sha256": library.digest_of(),
            "limit_degrees": limit,
            "beyond_limit": [one["file"] for one in beyond],
            "recordings": results,
        },
    )
    tell.tell(tables.console(), results)
    for result in results:
        if "refused" in result:
            print(f"replay: {result['refused']}", file=sys.stderr)
    where = report.relative_to(ROOT) if report.is_relative_to(ROOT) else report
    print(
        f"replay: {len(good)} of {len(results)} recordings replayed"
        + (f", {len(beyond)} beyond {limit:g} degrees" if limit is not None else "")
        + f"; {where} has them"
    )
    return 2 if len(good) < len(results) else 1 if beyond else 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("replay", lambda: replay(arguments))
