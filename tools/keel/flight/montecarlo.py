# SPDX-License-Identifier: Apache-2.0
"""Flies many seeds on a Dask cluster and tells how errors are distributed.

    python3 tools/keel flights --flights 1000

build/flights gets a file for each seed, written when it is flown: what was interrupted goes on
where it was, and a seed is flown anew only when something that it depends on has changed.
flights.json has the distribution; it is the same whatever the number of workers.

Exit status: 0 when every flight keeps its limits, 1 when one does not, 2 when they could not be
flown.
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from keel.base import cluster_worker
from keel.base.arguments import Parser
from keel.base.cluster import archive
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import write_json
from keel.flight import library
from keel.flight.orders import BUILD, library_of
from keel.flight.tables import console
from keel.flight.varied import HEALTHY, digest_of

SENT = ("include", "src", "bsp", "examples", "tools")
PROGRAM = ["tools/keel", "with", "fly", "-m", "keel.flight.orders"]
ORDER = 5  # Flights in an order.
RANKS = (50.0, 90.0, 99.0, 100.0)
TOLD = {
    "attitude_rms_deg": "attitude, rms, deg",
    "attitude_max_deg": "attitude, worst, deg",
    "tilt_max_deg": "tilt, most, deg",
    "place_max_m": "place, belief less truth, m",
    "height_error_max_m": "height, belief less truth, m",
    "sink_max": "touch-down, m/s",
}
Answer = Mapping[str, Any]


def parsed(arguments: Sequence[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = Parser("Fly many seeds and tell how errors are distributed.", "flights")
    parser.add_argument("--flights", type=int, default=100, metavar="N", help="seeds 1 to N")
    parser.add_argument(
        "--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="workers of this machine"
    )
    parser.add_argument("--seed", type=int, metavar="N", help="this one alone, with its picture")
    found = parser.parse_args(arguments)
    for name in ("flights", "jobs"):
        if getattr(found, name) < 1:
            raise ToolError(f"--{name}: expected 1 or more, found {getattr(found, name)}")
    return found


def file_of(seed: int) -> Path:
    """Where the flight of a seed is kept."""
    return BUILD / f"{seed:06d}.json"


def kept(seed: int, digest: str) -> Answer | None:
    """The flight of a seed, if it was flown with all as it is now."""
    try:
        answer: Answer = json.loads(file_of(seed).read_text())
    except (OSError, ValueError):
        return None
    return answer if answer.get("digest") == digest and answer.get("seed") == seed else None


def cluster(address: str, width: int) -> Any:
    """A client of the cluster of that address, or of one on this machine."""
    # A worker's flight ends by itself; what Dask says of its own work is nobody's business here.
    os.environ.setdefault("DASK_LOGGING__DISTRIBUTED", "error")
    try:
        distributed = importlib.import_module("distributed")
        importlib.import_module("cloudpickle").register_pickle_by_value(cluster_worker)
    except ImportError as error:
        raise ToolError(f"there is no {error.name}") from error
    try:
        if address:
            return distributed.Client(address, timeout=20, set_as_default=False)
        return distributed.Client(
            n_workers=width, threads_per_worker=1, dashboard_address=None, set_as_default=False
        )
    except (OSError, ValueError) as error:
        raise ToolError(f"no cluster answers at {address or 'this machine'}: {error}") from error


def answers(client: Any, seeds: Sequence[int]) -> Iterator[Answer]:
    """The flights as they come."""
    distributed = importlib.import_module("distributed")
    sent = client.scatter(archive(ROOT, SENT), broadcast=True, hash=True)
    orders = [list(seeds[start : start + ORDER]) for start in range(0, len(seeds), ORDER)]
    futures = [
        client.submit(cluster_worker.carry_out, sent, PROGRAM, order, pure=False)
        for order in orders
    ]
    try:
        done = distributed.as_completed(futures, with_results=True, loop=client.loop)
        for _, order in done:
            yield from order
    except RuntimeError as error:
        raise ToolError(str(error)) from error
    finally:
        client.cancel(futures)


def all_flown(seeds: Sequence[int], digest: str, width: int) -> list[Answer]:
    """Fly what was not flown yet; each is kept as soon as it is known."""
    found = {seed: answer for seed in seeds if (answer := kept(seed, digest))}
    left = [seed for seed in seeds if seed not in found]
    if found:
        print(f"flights: {len(found)} of {len(seeds)} were flown before")
    if left:
        library_of(library.digest_of())  # An error in C is told once, by whoever starts.
        client = cluster(os.environ.get("DASK", ""), width)
        try:
            began = time.monotonic()
            for answer in answers(client, left):
                if answer["digest"] != digest:
                    raise ToolError("a worker has other sources or tools than there are here")
                write_json(file_of(answer["seed"]), answer)
                found[answer["seed"]] = answer
                progress(len(found), len(seeds), answer, time.monotonic() - began)
        finally:
            client.close()
    return [found[seed] for seed in seeds]


def progress(done: int, count: int, answer: Answer, seconds: float) -> None:
    """A line for each flight that is not good, and for each tenth one."""
    if not answer["good"] or done % 10 == 0 or done == count:
        word = "good" if answer["good"] else "NOT GOOD"
        print(
            f"[{done}/{count}] {seconds:.0f} s: {answer['name']}, {answer['fault']}, in "
            f"{answer['plant']}: {word}"
        )


def ranks(flights: Sequence[Answer]) -> dict[str, dict[str, float]]:
    """Of each number its percentiles over the flights."""
    found = {}
    for name in TOLD:
        values = [flight["measured"][name] for flight in flights if name in flight["measured"]]
        if values:
            cuts = np.percentile(values, RANKS)
            found[name] = {
                f"p{rank:g}": round(float(cut), 4) for rank, cut in zip(RANKS, cuts, strict=True)
            }
    return found


def by_fault(flights: Sequence[Answer]) -> dict[str, list[Answer]]:
    """The flights of each fault, the unbroken first."""
    names = {flight["fault"] for flight in flights}
    ordered = sorted(names, key=lambda name: (name != HEALTHY, name))
    return {name: [flight for flight in flights if flight["fault"] == name] for name in ordered}


def distribution(flights: Sequence[Answer]) -> Table:
    """Percentiles over all flights."""
    table = Table(title=f"{len(flights)} flights: percentiles", title_justify="left")
    table.add_column("")
    for rank in RANKS:
        table.add_column("worst" if rank == 100.0 else f"{rank:g} %", justify="right")
    for name, cuts in ranks(flights).items():
        table.add_row(TOLD[name], *(f"{cut:.3f}" for cut in cuts.values()))
    return table


def faults_table(flights: Sequence[Answer]) -> Table:
    """What each fault does."""
    table = Table(title="By fault", title_justify="left")
    table.add_column("fault")
    for heading in ("flights", "good", "attitude, worst, deg: 50 %", "99 %"):
        table.add_column(heading, justify="right")
    table.add_column("seeds not good")
    for name, group in by_fault(flights).items():
        cuts = ranks(group).get("attitude_max_deg", {})
        bad = [str(flight["seed"]) for flight in group if not flight["good"]]
        shown = " ".join(bad[:12]) + (" ..." if len(bad) > 12 else "")
        half, most = (f"{cuts.get(rank, 0.0):.2f}" for rank in ("p50", "p99"))
        table.add_row(name, str(len(group)), str(len(group) - len(bad)), half, most, shown)
    return table


def report_of(flights: Sequence[Answer], digest: str) -> dict[str, object]:
    """What flights.json says."""
    groups = by_fault(flights)
    return {
        "schema": 1,
        "digest": digest,
        "flights": len(flights),
        "good": sum(bool(flight["good"]) for flight in flights),
        "percentiles": ranks(flights),
        "by_fault": {
            name: {
                "flights": len(group),
                "good": sum(bool(flight["good"]) for flight in group),
                "percentiles": ranks(group),
            }
            for name, group in groups.items()
        },
        "not_good": [
            {
                "seed": flight["seed"],
                "plant": flight["plant"],
                "fault": flight["fault"],
                "limits": [limit for limit in flight["limits"] if not limit["good"]],
            }
            for flight in flights
            if not flight["good"]
        ],
    }


def fly_all(options: argparse.Namespace) -> int:
    """Fly, keep, tell."""
    digest = digest_of()
    report = BUILD / "flights.json"
    report.unlink(missing_ok=True)
    flights = all_flown(range(1, options.flights + 1), digest, options.jobs)
    write_json(report, report_of(flights, digest))
    screen = console()
    screen.print(distribution(flights))
    screen.print(faults_table(flights))
    bad = [flight for flight in flights if not flight["good"]]
    for flight in bad[:20]:
        what = "; ".join(
            f"{limit['name']} {limit['value']}, wanted {limit['limit']}"
            for limit in flight["limits"]
            if not limit["good"]
        )
        print(f"seed {flight['seed']}, {flight['fault']}, in {flight['plant']}: {what}")
    again = f"; make fly SEED={bad[0]['seed']} flies the first of them again" if bad else ""
    print(f"flights: {len(flights)} flown, {len(flights) - len(bad)} good, {len(bad)} not{again}")
    return 1 if bad else 0


def run(arguments: Sequence[str] | None) -> int:
    """One seed, or many."""
    options = parsed(arguments)
    if options.seed is None:
        return fly_all(options)
    from keel.flight import command as fly

    return int(fly.main(["--seed", str(options.seed)]))


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("flights", lambda: run(arguments))
