#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of the figures in the documents: each is what the repository holds, or a command makes it.

    python3 tests/tools/test_docs_figures.py             # compare
    python3 tests/tools/test_docs_figures.py --update    # write into the documents what is true

FIGURES says where a figure stands and what it must be. MADE names the others, which were measured,
with the command that does so, or how: the document has these words, too. Minutes in a row of a
table that begins with a command are that command's.
"""

from __future__ import annotations

import re
import sys
import tomllib
import unittest
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).resolve().parents[2]
UPDATE = "--update"
SOUNDNESS = "specs/soundness.md"
DETERMINED = "proofs/determined.md"
URPILOT = "specs/tasksets/urpilot.toml"
BENCH = "bench/budget.toml"
BENCH_PART = 0.02  # A document may differ from the accepted instructions by this part, and by one.
CLOCK_HZ = 216e6


# --- What the repository holds -------------------------------------------------------------------


@cache
def text_of(name: str) -> str:
    """A file."""
    return (ROOT / name).read_text(encoding="utf-8")


def documents() -> list[str]:
    """All documents for readers, but those that a command writes as a whole."""
    written = {"docs/status.md", "docs/parameters.md"}
    pages = [path.relative_to(ROOT).as_posix() for path in sorted((ROOT / "docs").glob("*.md"))]
    return ["README.md", "CONTRIBUTING.md", SOUNDNESS, *(p for p in pages if p not in written)]


def spaced(number: int) -> str:
    """As documents write it: 10 000."""
    return f"{number:,}".replace(",", " ") if number >= 10_000 else str(number)


def number_in(name: str, pattern: str) -> str:
    """The one number that a pattern finds in a file, or the same one each time."""
    found = set(re.findall(pattern, text_of(name), re.MULTILINE))
    assert len(found) == 1, (name, pattern, found)
    return str(found.pop()).replace("_", "").removesuffix("u")


def macro(name: str, symbol: str) -> str:
    """The number that a macro stands for."""
    return number_in(name, rf"^# *define +{symbol} +(\w+)\b")


def set_in(name: str, symbol: str) -> str:
    """The number that the head of a harness sets a macro to."""
    return number_in(name, rf"-D{symbol}=(\d+)u")


def capacity() -> str:
    return macro("include/keel/rtos/queue.h", "KEEL_QUEUE_CAPACITY")


def sensors() -> str:
    return macro("include/keel/middleware/voter.h", "KEEL_VOTER_SENSORS")


def option(symbol: str) -> tuple[str, str]:
    """The least and the greatest number that CMake takes for a size."""
    found = re.search(rf"keel_number\({symbol} \S+ (\d+) (\d+)", text_of("CMakeLists.txt"))
    assert found is not None
    return found[1], found[2]


class Unit(NamedTuple):
    """What the lists and folders of a unit's proofs have."""

    goals: int
    harnesses: int
    mistakes: int


def wrong_bodies(folder: Path) -> int:
    """How many faults the harnesses of a unit must refute."""
    path = folder / "wrong.toml"
    return len(tomllib.loads(path.read_text(encoding="utf-8"))["wrong"]) if path.is_file() else 0


@cache
def units() -> dict[str, Unit]:
    """The units that are proved."""
    folders = sorted(path.parent for path in (ROOT / "proofs").glob("*/goals.txt"))
    return {
        folder.name: Unit(
            len([line for line in text_of(f"proofs/{folder.name}/goals.txt").splitlines() if line]),
            len(list(folder.glob("*_harness.c"))),
            wrong_bodies(folder) + len(list(folder.glob("wrong/*.g"))),
        )
        for folder in folders
    }


def kinds_of_functions() -> tuple[str, ...]:
    """Functions that are determined for every valid state, within a bound and by clauses beyond it,
    or by clauses alone, and within a bound only."""
    line = re.search(
        r"(\d+) of \d+ functions for every valid state(?:, (\d+) within a bound)?"
        r"(?: \((\d+) of them with WP's clauses[^)]*\))?(?:, (\d+) by WP's clauses alone)?",
        text_of(DETERMINED),
    )
    assert line is not None, DETERMINED
    whole, bounded, named, alone = (int(number or 0) for number in line.groups())
    return str(whole), str(named + alone), str(bounded - named)


def open_functions() -> tuple[str, ...]:
    """The functions in the table of those that are known to be open beyond their bounds."""
    rows = re.findall(r"^\| `keel_.*?\|", text_of("docs/proved.md"), re.MULTILINE)
    return (str(sum(row.count("`keel_") for row in rows)),)


def status_rows() -> dict[str, list[str]]:
    """The rows of the status page, by unit; `all` is their sum."""
    rows = re.findall(r"^\| `?(\w+)`? \| (\d.*) \|$", text_of("docs/status.md"), re.MULTILINE)
    return {name: rest.split(" | ") for name, rest in rows}


def functions() -> tuple[str, ...]:
    """How many public functions there are, as the status page counts them."""
    return (re.findall(r"\d+", status_rows()["all"][0])[-1],)


@cache
def mutants() -> tuple[str, ...]:
    """Units with a result, and all; mutants that compile, killed, by a harness and by WP alone, and
    the others, by their object code and by a reason."""
    records = toml_of("specs/mutation.toml")["unit"].values()
    killed = sum(sum(one["killed"].values()) for one in records)
    same = sum(len(lines) for one in records for lines in one["same_code"].values())
    accepted = sum(len(one["accepted"]) for one in records)
    units = len(list((ROOT / "proofs").glob("*/goals.txt")))
    left = same + accepted
    by_wp = sum(one["killed"]["wp"] for one in records)
    by = (killed, killed - by_wp, by_wp)
    return tuple(map(str, (len(records), units, killed + left, *by, left, same, accepted)))


@cache
def toml_of(name: str) -> dict[str, Any]:
    """A TOML file."""
    return tomllib.loads(text_of(name))


def tasks() -> tuple[str, ...]:
    """How many tasks the paper's table 2 has."""
    return (str(len(toml_of(URPILOT)["task"])),)


def utilisation(*classes: bool) -> float:
    """Of its real-time tasks (True) and the others."""
    return sum(
        task["budget_us"] / task["period_us"]
        for task in toml_of(URPILOT)["task"]
        if (task.get("class") == "real-time") in classes
    )


def utilisations() -> tuple[str, ...]:
    return tuple(f"{utilisation(*of):.3f}" for of in ((True,), (False,), (True, False)))


def budgets() -> dict[str, float]:
    """The instructions that were accepted."""
    return {name: one["budget"] for name, one in toml_of(BENCH)["figures"].items()}


def bodies() -> tuple[str, ...]:
    """Instructions a second of all tasks' bodies in millions, and their part of the processor."""
    budget = budgets()
    each = sum(
        budget["task_" + re.sub(r"\W+", "_", task["name"].lower())] * 1e6 / task["period_us"]
        for task in toml_of(URPILOT)["task"]
    )
    return f"{each / 1e6:.1f}", f"{100.0 * each / CLOCK_HZ:.1f}"


def faults() -> tuple[str, ...]:
    body = re.search(r"^FAULTS = \{\n(.*?)^\}", text_of("tools/keel/test/faults.py"), re.M | re.S)
    assert body is not None
    return (str(len(re.findall(r'^    "\w+": Fault\(', body[1], re.MULTILINE))),)


def rounded_units() -> tuple[str, ...]:
    """The units with bounds of roundings for Gappa."""
    names = sorted({path.parent.name for path in (ROOT / "proofs").glob("*/*.g")})
    quoted = [f"`{name}`" for name in names]
    return (f"{', '.join(quoted[:-1])} and {quoted[-1]}",)


def ulog_sizes() -> tuple[str, ...]:
    """Bytes of a message, characters of a name and fields, in the harnesses of ULog."""
    name = "proofs/ulog/keel_ulog_format__two_harness.c"
    sizes = ("KEEL_ULOG_MESSAGE_BYTES", "KEEL_ULOG_NAME_LENGTH", "KEEL_ULOG_FIELDS")
    return tuple(set_in(name, symbol) for symbol in sizes)


def payloads() -> tuple[str, ...]:
    """The longest payload that is written."""
    return (macro("proofs/mavlink/keel_mavlink_write_harness.c", "PAYLOAD"),)


def looked_at() -> tuple[str, ...]:
    """The most messages and the longest payload of which a look of MAVLink's decoder is known."""
    harness = "proofs/mavlink/keel_mavlink_look_harness.c"
    return (number_in(harness, r"known <= (\d+)u"), number_in(harness, r"bytes\[1\] <= (\d+)u"))


def dropped_from() -> tuple[str, ...]:
    """The most bytes of which some are dropped."""
    return (number_in("proofs/mavlink/keel_mavlink_drop_harness.c", r"held <= (\d+)u"),)


def ring_bytes() -> tuple[str, ...]:
    return (set_in("proofs/log_ring/keel_log_ring_write_harness.c", "KEEL_LOG_RING_BYTES"),)


def random_sets() -> tuple[str, ...]:
    found = number_in("tests/timing/test_soundness.py", r'"KEEL_RANDOM_SETS", "(\d+)"')
    return (spaced(int(found)),)


def isolation_sets() -> tuple[str, ...]:
    found = number_in("tests/timing/test_isolation.py", r'"KEEL_RANDOM_SETS", "(\d+)"\)\) // 10')
    return (spaced(int(found) // 10),)


def asks_z3() -> tuple[str, ...]:
    """Goals of WP that Z3 proves, and harnesses that ask it."""
    goals = [
        line
        for path in (ROOT / "proofs").glob("*/goals.txt")
        for line in path.read_text(encoding="utf-8").splitlines()
        if line.endswith(" z3")
    ]
    harnesses = [
        path
        for path in (ROOT / "proofs").glob("*/*_harness.c")
        if "--z3" in path.read_text(encoding="utf-8")
    ]
    return str(len(goals)), str(len(harnesses))


def left_to_cbmc() -> tuple[str, ...]:
    """Functions whose postconditions WP leaves to CBMC."""
    units = toml_of("proofs/units.toml").values()
    return (str(sum(len(one.get("not_by_wp", [])) for one in units if isinstance(one, dict))),)


def vectors() -> tuple[str, ...]:
    return (spaced(int(number_in("tools/keel/test/emulated_tests.py", r"^VECTORS = ([\d_]+)"))),)


def confirmed() -> tuple[str, ...]:
    return (number_in("tools/keel/mutate/mutation.py", r"^CONFIRM = (\d+)"),)


def half_turn() -> tuple[str, ...]:
    """How long half a turn of the counter lasts, in minutes."""
    return (f"{2**31 / 60e6:.1f}",)


def shards() -> tuple[str, ...]:
    found = re.search(r"shard: \[(.*)\]", text_of(".github/workflows/ci.yml"))
    assert found is not None
    return (str(len(found[1].split(","))),)


# --- Where it is said ----------------------------------------------------------------------------


def about(number: int, unit: int) -> str:
    """A number of lines or files, as rough as it is of use."""
    return spaced(round(number / unit) * unit)


def lines_of(*patterns: str) -> int:
    """Lines of the Python below these places, of no build's."""
    places = [path for pattern in patterns for path in ROOT.glob(pattern)]
    files = {one for place in places for one in ([place] if place.is_file() else tree(place))}
    return sum(path.read_bytes().count(b"\n") for path in files if path.suffix == ".py")


NOT_OURS = ("build", "__pycache__", ".mypy_cache", ".ruff_cache")


@cache
def tree(folder: Path) -> tuple[Path, ...]:
    """The files below a folder, without what is built, fetched or hidden."""
    found: list[Path] = []
    for path in folder.iterdir():
        if path.name in NOT_OURS or path.name.startswith(".git"):
            continue
        found += tree(path) if path.is_dir() and not path.is_symlink() else [path]
    return tuple(found)


def rooms(names: str) -> int:
    """Lines of some rooms of the tools."""
    return lines_of(*(f"tools/keel/{name}" for name in names.split()))


def sizes() -> tuple[str, ...]:
    """Lines of Python, of judge and engines, and of the largest room."""
    largest = max(lines_of(str(room.relative_to(ROOT))) for room in ROOT.glob("tools/keel/*/"))
    python = lines_of("tools", "tests", "packaging")
    return about(python, 1000), about(rooms("judge engines"), 100), about(largest, 100)


def files() -> tuple[str, ...]:
    """Files of the project; and of harnesses, and of models."""
    harnesses = len(list(ROOT.glob("proofs/*/*_harness.c")))
    models = len(tree(ROOT / "specs" / "model"))
    return about(len(tree(ROOT)), 100), str(harnesses), str(models)


def long_headers() -> tuple[str, ...]:
    """Public headers above 150 lines."""
    headers = [text_of(str(path.relative_to(ROOT))) for path in ROOT.glob("include/keel/*/*.h")]
    return (str(sum(text.count("\n") > 150 for text in headers)),)


def parts() -> tuple[str, ...]:
    """Lines of Python by what it is for."""
    numbers = (
        rooms("base install c judge engines prove audit mutate config.py cli"),
        lines_of("tests/tools"),
        rooms("boards emulator plants flight logs replay copter"),
        lines_of("tests/flight", "tests/clients"),
        rooms("trace qualify gather evidence release"),
        lines_of("tools/keel/timing", "tools/keel/timeline", "tests/timing"),
        rooms("test bench lint analyse"),
    )
    return tuple(about(number, 1000) for number in numbers)


class Figure(NamedTuple):
    """Numbers in a document: a pattern with a group for each, and what they are."""

    document: str
    pattern: str
    numbers: Callable[[], tuple[str, ...]]


def both() -> tuple[str, ...]:
    return capacity(), sensors()


def of_capacity() -> tuple[str, ...]:
    return (capacity(),)


def of_sensors() -> tuple[str, ...]:
    return (sensors(),)


TASKS = r"(?:paper's|the|its|767zi:|The) (\d+)\s+tasks(?! with|\.)"
LINES = r"(\d[\d ]*?)"
FIGURES: tuple[Figure, ...] = (
    Figure(
        "CONTRIBUTING.md",
        rf"\| lines of Python, with their tests \| 42 000 \| {LINES} \|.*?"
        rf"\| lines of `judge` and `engines` \| 4200 \| {LINES} \|.*?"
        rf"\| lines of the largest room \| 5000 \| {LINES} \|",
        sizes,
    ),
    Figure(
        "CONTRIBUTING.md",
        rf"\| files \| 1400 \| {LINES} \| Each of the (\d+) harnesses has a file, as each of the "
        r"(\d+) files of models",
        files,
    ),
    Figure("CONTRIBUTING.md", r"\| public headers above 150 lines \| 0 \| (\d+) \|", long_headers),
    Figure(
        "CONTRIBUTING.md",
        rf"\| proofs: [^|]*\| {LINES} \|.*?\| their tests[^|]*\| {LINES} \|.*?"
        rf"\| boards and flights: [^|]*\| {LINES} \|.*?\| tests of flights[^|]*\| {LINES} \|.*?"
        rf"\| evidence: [^|]*\| {LINES} \|.*?\| schedulability[^|]*\| {LINES} \|.*?"
        rf"\| test runs[^|]*\| {LINES} \|",
        parts,
    ),
    Figure("README.md", r"of the (\d+) public functions", functions),
    Figure("README.md", r"queues of (\d+) tasks and (\d+) sensors", both),
    Figure("README.md", r"CI proves (\d+), as if", of_capacity),
    Figure(
        "docs/proved.md",
        r"Of (\d+) functions it is known that something is left open",
        open_functions,
    ),
    Figure("docs/proved.md", r"each of the (\d+) public functions", functions),
    Figure("docs/proved.md", r"queues of (\d+) tasks, (\d+) sensors;", both),
    Figure(
        "docs/proved.md",
        r"now for (\d+) of the (\d+) units\. Of their (\d+) mutants.*?notice (\d+): harnesses "
        r"refute (\d+) by a counterexample, and of (\d+) WP no longer proves a goal\. Of the "
        r"other (\d+), (\d+) compile to the same object code, and (\d+) mean",
        mutants,
    ),
    Figure(
        "docs/proved.md",
        r"tables of up to (\d+) messages, payloads of up to (\d+) bytes",
        looked_at,
    ),
    Figure("docs/proved.md", r"of up to (\d+) bytes that are held", dropped_from),
    Figure("docs/proved.md", r"\| payloads of up to (\d+) bytes \|", payloads),
    Figure("docs/proved.md", r"CBMC for (\d+) bytes\)", ring_bytes),
    Figure("docs/proved.md", r"\((\d+\.\d)\s+minutes\)", half_turn),
    Figure(SOUNDNESS, r"queues of (\d+) tasks and up to (\d+) sensors", both),
    Figure(SOUNDNESS, r"CBMC, a ring of (\d+) bytes", ring_bytes),
    Figure(
        SOUNDNESS,
        r"tables of up to (\d+) messages and frames with payloads of up to (\d+)",
        looked_at,
    ),
    Figure(SOUNDNESS, r"of up to (\d+) bytes that are held", dropped_from),
    Figure(SOUNDNESS, r"payloads of up to (\d+) bytes; the checksum is", payloads),
    Figure(
        SOUNDNESS,
        r"messages of up to (\d+) bytes, names of up to (\d+) characters, formats "
        r"of up to (\d+) fields",
        ulog_sizes,
    ),
    Figure(SOUNDNESS, r"(\d[\d ]*) random sets on the virtual board", random_sets),
    Figure(SOUNDNESS, r"promotes; (\d[\d ]*) random sets", isolation_sets),
    Figure(SOUNDNESS, r"same numbers of (\d[\d ]*) random sets", isolation_sets),
    Figure(SOUNDNESS, r"Z3, which (\d+) goals of WP and (\d+) of", asks_z3),
    Figure("docs/proved.md", r"except for the results of (\d+) functions", left_to_cbmc),
    Figure(SOUNDNESS, r"CBMC is shown one in (\d+)", confirmed),
    Figure(SOUNDNESS, r"\((\d+\.\d) minutes\)", half_turn),
    Figure("CONTRIBUTING.md", r"CBMC must see the same in one of (\d+)", confirmed),
    Figure("docs/finding_a_proof.md", r"for Gappa: (.*) have them", rounded_units),
    Figure(
        "docs/integration.md",
        r"into a queue, (\d+) to (\d+);",
        lambda: option("KEEL_QUEUE_CAPACITY"),
    ),
    Figure("docs/integration.md", r"into a queue, [^;]*; (\d+) unless set", of_capacity),
    Figure(
        "docs/integration.md",
        r"that can vote, (\d+) to (\d+);",
        lambda: option("KEEL_VOTER_SENSORS"),
    ),
    Figure("docs/integration.md", r"that can vote, [^;]*; (\d+) unless set", of_sensors),
    Figure("docs/integration.md", r"numbers of the headers, (\d+) tasks and (\d+) sensors", both),
    Figure("docs/integration.md", r"Of the (\d+) units", lambda: (str(len(units())),)),
    Figure("include/keel/rtos/queue.h", r"The proofs are for (\d+)\.", of_capacity),
    Figure("include/keel/middleware/voter.h", r"The proofs are for (\d+),", of_sensors),
    Figure("zephyr/Kconfig", r"The proofs are for (\d+)\.", of_capacity),
    Figure("zephyr/Kconfig", r"The proofs are for (\d+),", of_sensors),
    Figure("docs/emulator.md", r"\*\*(\d+) faults", faults),
    Figure("docs/emulator.md", r"\*\*(\d[\d ]*) random vectors", vectors),
    Figure("docs/timing.md", r"(\d[\d ]*) random sets", random_sets),
    Figure("docs/timing.md", r"A queue holds (\d+) tasks unless", of_capacity),
    Figure(
        "docs/timing.md",
        r"another number, up to (\d+), for",
        lambda: option("KEEL_QUEUE_CAPACITY")[1:],
    ),
    Figure("docs/timing.md", r"The proofs are for (\d+)\.", of_capacity),
    Figure(
        "docs/timing.md",
        r"utilisation of real-time tasks, others, all \| [^|]* \| (\S+), (\S+), (\S+) by",
        utilisations,
    ),
    Figure("docs/paper.md", r"table 2's sums are (\S+) and (\S+) \|", lambda: utilisations()[:2]),
    Figure(
        "docs/first_flight.md",
        r"(\S+) % declared",
        lambda: (f"{100.0 * utilisation(True, False):.1f}",),
    ),
    Figure(
        "docs/copter.md",
        r"together are (\S+) million instructions a second;.*?be (\S+) % of",
        bodies,
    ),
    Figure(
        "docs/boards.md",
        r"(\d+) facts have no counterpart",
        lambda: (str(len(toml_of("specs/registers.toml")["absent"])),),
    ),
    Figure(
        "docs/boards.md",
        r"tries (\d+) mistakes in the boards' code",
        lambda: (str(len(toml_of("tests/target/mistakes.toml")["mistake"])),),
    ),
    Figure("docs/ci.md", r"(\d+) machines prove a part each", shards),
    Figure(
        "docs/fuzzing.md",
        r"`SECONDS=(\d+)`",
        lambda: (number_in("Makefile", r"^SECONDS := (\d+)"),),
    ),
    Figure(
        "docs/fuzzing.md",
        r"`\.ci/run` fuzzes each for (\d+) seconds",
        lambda: (number_in(".ci/run", r"check NAME=fuzz SECONDS=(\d+)"),),
    ),
    *(
        Figure(name, TASKS, tasks)
        for name in (
            "docs/README.md",
            "docs/building.md",
            "docs/copter.md",
            "docs/boards.md",
            "docs/emulator.md",
        )
    ),
)

if (ROOT / DETERMINED).is_file():
    KINDS = r"^\| (\d+) \| (?:in )?every valid state[^|]*\|\n\| (\d+) \| .*?\n\| (\d+) \| "
    FIGURES += tuple(
        Figure(name, KINDS, kinds_of_functions) for name in ("README.md", "docs/proved.md")
    )

# What a command measures, and nothing in the repository repeats; the command is in the document.
MADE = {
    SOUNDNESS: {},
    "docs/boards.md": {
        "1026 facts": "`make check NAME=registers`",
        "1593 comparisons": "`make check NAME=registers`",
    },
    # Limits and minutes of proofs: tests/tools/test_workflow.py compares them.
    "docs/ci.md": {
        "120 min": "at most",
        "60 min": "at most",
        "30 min": "at most",
        "196 minutes": "`proofs/times.json`",
        "16 minutes": "`proofs/times.json`",
        "19 minutes": "`build/test/report.json`",
    },
    "docs/copter.md": {"12 minutes": "92 kB a second"},
    "docs/cost.md": {"430 instructions": "`make bench`", "38 instructions": "`make bench`"},
    "docs/first_flight.md": {"10 min": "by design", "1 min": "by design", "72 min": "by design"},
    "docs/fuzzing.md": {
        "100 000 000 executions": "make check NAME=fuzz ARGS=",
        "3 minutes": "of a core",
    },
    # tests/tools/test_primer.py compares what these commands say.
    "docs/primer.md": {"69 goals": "--update-goals", "3 functions": "keel.mk prove"},
    "docs/telemetry.md": {"14 500 instructions": "x86-64"},
    "docs/timing.md": {
        "3086 random paths": "`make test`",
        "308 instructions": "`make bench`",
        "88 instructions": "`make bench`",
    },
}
COUNTED = re.compile(
    r"(?<![\d.])(\d[\d ]*\d|\d+)\s+(public functions|functions|goals|mutants|harnesses|mistakes|"
    r"facts|comparisons|random (?:sets|paths|vectors)|faults|executions|instructions|minutes|min)\b"
)

# The rows of the table of costs, by what the budget calls them.
COSTS = {
    "a pass that runs no task": "no_task",
    "a pass that runs one task of 21": "one_task",
    "a pass that runs two or three tasks": "several_tasks",
    "a pass that runs four tasks": "four_tasks",
    "the virtual IMU, 3 units of 6 channels that agree": "imu",
    "the virtual IMU when one unit is outvoted": "imu_worst",
    "a filter's step": "filter",
    "a PID step, its filter included": "pid",
    "a reference generator's step, four sticks": "reference",
    "a mode's step in flight, a frame in each": "mode",
    "a mode's step while all facts settle": "mode_worst",
    "a mixer's step, 4 motors, all fits": "mixer",
    "a mixer's step, 4 motors, all gives way": "mixer_worst",
    "an attitude's step, all sensors in each": "attitude",
    "an altitude's step, a pressure in each": "altitude",
    "a position's step, a fix in each": "position",
    "a cascade's four stages, 11 controllers": "cascade",
    "a battery's step, two modules": "battery",
    "a calibration's step, at rest": "calibration",
    "a byte of SBUS, of right frames": "sbus",
    "a byte of SBUS, when all are headers": "sbus_worst",
    "a byte of CRSF, of right frames": "crsf",
    "a byte of IBUS, of right frames": "ibus",
    "an edge of PPM": "ppm",
    "a byte of UBX, of right messages": "ubx",
    "a byte of MAVLink, of right frames": "mavlink",
    "a frame's signature": "signing",
    "a reading of the barometer MS5611 in frost": "ms5611",
    "a record of 36 bytes into the log's ring": "log_ring",
    "a log's message of 36 bytes of data": "ulog",
    "a traced run of a task": "trace",
    "a run of a task whose lateness is counted": "lateness",
    "a task's line of the table": "table_line",
    "`keel_scheduler_spread` of 21 tasks, once, before the start": "spread",
}


def matches(figure: Figure) -> list[re.Match[str]]:
    """Where a figure stands; a space of the pattern stands for any."""
    pattern = figure.pattern.replace(" ", r"\s+").replace(r"[\d\s+]", r"[\d ]")
    return list(re.finditer(pattern, text_of(figure.document), re.DOTALL | re.MULTILINE))


def wrong_in(figure: Figure) -> Iterator[str]:
    """What a document says otherwise."""
    found = matches(figure)
    if not found:
        yield f"{figure.document}: nothing is like {figure.pattern}"
    for match in found:
        if match.groups() != figure.numbers():
            line = text_of(figure.document).count("\n", 0, match.start()) + 1
            yield (
                f"{figure.document}:{line}: {', '.join(match.groups())}: "
                f"it is {', '.join(figure.numbers())}"
            )


def uncovered(name: str) -> Iterator[str]:
    """What is counted in a document, and neither compared nor made by a command that it names."""
    text = text_of(name)
    spans = [
        match.span(group)
        for figure in FIGURES
        if figure.document == name
        for match in matches(figure)
        for group in range(1, len(match.groups()) + 1)
    ]
    for match in COUNTED.finditer(text):
        words = " ".join(match[0].split())
        command = MADE.get(name, {}).get(words)
        compared = any(first <= match.start(1) < last for first, last in spans)
        row = text[text.rfind("\n", 0, match.start()) + 1 :]
        timed = match[2] in ("min", "minutes") and row.startswith("| `make ")
        if not (compared or timed or (command is not None and command in text)):
            line = text.count("\n", 0, match.start()) + 1
            yield f"{name}:{line}: {words}: compared with nothing, made by no command"


def measured(name: str, head: str, column: int) -> dict[str, float]:
    """The instructions in a column of the table with that head, by row."""
    table = text_of(name).split(head, 1)[1].split("\n\n", 1)[0].splitlines()[2:]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table]
    found = {row[0]: re.match(r"[\d.]+(?![\d.]* (?:KiB|bytes))", row[column]) for row in rows}
    return {row: float(match[0]) for row, match in found.items() if match}


class Figures(unittest.TestCase):
    """Every figure that can be worked out."""

    def none(self, found: list[str]) -> None:
        self.assertEqual([], found, "\n" + "\n".join(found))

    def test_documents_say_what_the_repository_holds(self) -> None:
        self.none([text for figure in FIGURES for text in wrong_in(figure)])

    def test_every_figure_is_compared_or_made(self) -> None:
        self.none([text for name in documents() for text in uncovered(name)])

    def test_what_is_made_is_there(self) -> None:
        said = {name: " ".join(text_of(name).split()) for name in MADE}
        self.none(
            [
                f"{name}: {words}"
                for name, made in MADE.items()
                for words in made
                if words not in said[name]
            ]
        )

    def test_the_status_is_of_these_proofs(self) -> None:
        rows = status_rows()
        said = {name: Unit(int(row[1]), int(row[2]), int(row[5])) for name, row in rows.items()}
        total = Unit(*(sum(column) for column in zip(*units().values(), strict=True)))
        true = {**units(), "all": total}
        self.none(
            [
                f"docs/status.md: {name}: {said.get(name)}: it is {true.get(name)}; make "
                "prove-all, then make generate NAME=status"
                for name in sorted({*true, *said})
                if true.get(name) != said.get(name)
            ]
        )

    def test_kinds_of_functions_are_all_functions(self) -> None:
        for name in ("README.md", "docs/proved.md"):
            kinds = re.findall(r"^\| (\d+) \| ", text_of(name), re.MULTILINE)
            self.assertEqual((3, int(functions()[0])), (len(kinds), sum(map(int, kinds))), name)

    def test_instructions_are_those_that_were_accepted(self) -> None:
        budget = budgets()
        costs = measured("docs/cost.md", "| instructions, unless said", 3)
        tasks_ = measured("docs/copter.md", "| task | instructions", 1)
        said = {COSTS[row]: number for row, number in costs.items()}
        said |= {f"task_{re.sub(r'[^a-z]+', '_', row.lower())}": n for row, n in tasks_.items()}
        wrong = {
            name: (number, budget[name])
            for name, number in said.items()
            if abs(number - budget[name]) > 1.0 + BENCH_PART * budget[name]
        }
        self.assertEqual({}, wrong)
        self.assertEqual(set(), set(budget) - set(said) - {"signing"})


class WrongFigures(unittest.TestCase):
    """A figure that is wrong is told."""

    def test_a_number_that_differs(self) -> None:
        figure = Figure("README.md", r"of the (\d+) public functions", lambda: ("172",))
        self.assertRegex(next(wrong_in(figure)), r"README.md:\d+: \d+: it is 172")

    def test_words_that_are_gone(self) -> None:
        figure = Figure("README.md", r"exactly (\d+) unicorns", lambda: ("1",))
        self.assertRegex(next(wrong_in(figure)), "nothing is like")


def update() -> int:
    """Write the true figures into the documents."""
    for figure in FIGURES:
        text = text_of(figure.document)
        for match in reversed(matches(figure)):
            for group, number in reversed([*enumerate(figure.numbers(), 1)]):
                first, last = match.span(group)
                text = text[:first] + number + text[last:]
        (ROOT / figure.document).write_text(text, encoding="utf-8")
        text_of.cache_clear()
    return 0


if __name__ == "__main__":
    sys.exit(update()) if UPDATE in sys.argv else unittest.main()
