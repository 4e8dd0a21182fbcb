# SPDX-License-Identifier: Apache-2.0
"""The images that boards are flashed with: what they are made from and with, that another folder
gives the same bits, and that what was proved is what was built.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from keel.base.files import sha256_of
from keel.base.source import STAMP
from keel.boards.board import board_names
from keel.boards.rebuilt import differences
from keel.boards.semantics import COMPILED_AS_PROVED, flag_problems
from keel.gather.part import Context, Item, Part, Table
from keel.install import Toolchain

PROVED = "prove/report.json"
TARGET = "test-target/report.json"
FILES = ("keel.elf", "keel.bin", "keel.map")

TEXT = """\
From source to object code. The proofs speak of C with the data model of the Cortex-M7; the \
compiler makes of it what is flashed, and is not proved. Three arguments tie the two together:

The proofs read the code that is built: they and every image name one digest of the folders \
include and src, with no code for provers in them, and proof and build read the processor's flags \
from one place in the tools.

The flags allow no rewriting that the proofs do not know: no optimisation that changes \
floating-point results, no contraction of a multiplication and an addition, and the sizes and \
signs of types as the proofs have them. The proofs show that no undefined behaviour happens, so \
that an optimiser may not build on it.

The object code was executed: 100 000 random vectors of each unit give the same bits in the \
host's build and in the build for the target, on a Cortex-M7 that QEMU emulates; the unit tests \
run there, too. That is a test, no proof: a fault of the compiler that these inputs do not show \
stays unseen, and so does one of the processor that the emulator does not have.

An image is built a second time in another folder, and must be the same byte for byte."""

Report = Mapping[str, Any]


def product_of(context: Context, name: str) -> str:
    """The digest of include and src that a report speaks of; "" if it tells none."""
    try:
        told = json.loads((context.build / name).read_text(encoding="utf-8"))[STAMP]["product"]
    except (OSError, ValueError, KeyError, TypeError):
        return ""
    return str(told)


def proof_problems(context: Context, board: str) -> Iterator[str]:
    """Whether an image is made of the source that was proved."""
    proved = product_of(context, PROVED)
    built = product_of(context, f"firmware/{board}/report.json")
    if not proved:
        yield f"build/{PROVED}: does not tell which source was proved"
    elif built != proved:
        yield (
            f"{board}: the source built ({built[:12] or 'unknown'}) is not the source proved "
            f"({proved[:12]})"
        )


def image_problems(context: Context, board: str, report: Report) -> Iterator[str]:
    """What is wrong with a board's image."""
    yield from proof_problems(context, board)
    yield from (f"{board}: {text}" for text in flag_problems(report["flags"]))
    folder = context.build / "firmware" / board
    for part in ("elf", "binary"):
        path = folder / report[part]["file"]
        if not path.is_file() or sha256_of(path) != report[part]["sha256"]:
            yield f"build/firmware/{board}/{path.name}: is not what its report says"
            return
    yield from differences(Toolchain(), context.root, board, folder, context.work)


def image_item(board: str, report: Report, part: str) -> Item:
    """A file that is flashed or examined."""
    file = report[part]["file"]
    tools = ", ".join(f"{name} {version}" for name, version in report["tools"].items())
    return Item(
        kind="image",
        id=f"{board}/{file}",
        title=f"{file} of {board}",
        facts={
            "SHA-256": report[part]["sha256"],
            "load address": f"0x{report['load_address']:08x}",
            "made by": tools,
            "flags": " ".join(report["flags"]),
            "linker's flags": " ".join(report["link_flags"]),
            "checks of places": f"{len(report['checks'])}",
        },
    )


def image_table(reports: Mapping[str, Report]) -> Table:
    """The images with their hashes."""
    return Table(
        title="Images",
        columns=("image", "SHA-256", "bytes to load", "sources"),
        rows=tuple(
            (
                f"image:{board}/{report[part]['file']}",
                report[part]["sha256"],
                str(report["binary"]["size"]),
                str(len(report["sources"])),
            )
            for board, report in reports.items()
            for part in ("elf", "binary")
        ),
        note="Each was built twice, in two folders, with the same bits. The compiler's own "
        "libraries that an image is linked with are known by its version, not by a hash.",
    )


def memory_table(reports: Mapping[str, Report]) -> Table:
    """How full the memories are."""
    return Table(
        title="Memories",
        columns=("board", "region", "origin", "bytes", "used"),
        rows=tuple(
            (board, name, f"0x{region['origin']:08x}", str(region["size"]), str(region["used"]))
            for board, report in reports.items()
            for name, region in report["regions"].items()
        ),
    )


def flag_table(reports: Mapping[str, Report]) -> Table:
    """The flags on which the proofs rest, and which image has them."""
    return Table(
        title="Flags on which the proofs rest",
        columns=("flag", "why", "images"),
        rows=tuple(
            (
                flag,
                why,
                ", ".join(board for board, report in reports.items() if flag in report["flags"]),
            )
            for flag, why in COMPILED_AS_PROVED.items()
        ),
        note="The flags that may not occur, each with its reason: tools/keel/boards/semantics.py.",
    )


def differential_rows(target: Report, problems: list[str]) -> tuple[tuple[str, ...], ...]:
    """The units whose builds for host and target were compared."""
    suite = target["suites"].get("differential", {"tests": {}})
    rows = tuple(
        (
            name.rpartition("/")[2],
            str(target["vectors_per_unit"]),
            "the same bits" if verdict == "passed" else "DIFFER",
        )
        for name, verdict in sorted(suite["tests"].items())
    )
    if not rows:
        problems.append(f"build/{TARGET}: host and target were not compared")
    problems += [
        f"{unit}: the host's build and the target's give different bits"
        for unit, _, verdict in rows
        if verdict == "DIFFER"
    ]
    return rows


def make(context: Context) -> Part:
    """The part."""
    problems: list[str] = []
    names = board_names(context.root)
    found = {name: context.report(f"firmware/{name}/report.json", problems) for name in names}
    reports = {name: report for name, report in found.items() if report}
    for board, report in reports.items():
        context.say(f"object: {board} once more, in another folder")
        problems += image_problems(context, board, report)
    target = context.report(TARGET, problems)
    compared = differential_rows(target, problems) if target else ()
    tables = [
        Table(
            title="The same bits on the host and on the emulated Cortex-M7",
            columns=("unit", "vectors", "verdict"),
            rows=compared,
        )
    ]
    if reports:
        tables[:0] = [image_table(reports), flag_table(reports), memory_table(reports)]
    files = {
        f"{board}/{file}": context.build / "firmware" / board / file
        for board in reports
        for file in (*FILES, "report.json")
    }
    same = sum(row[2] != "DIFFER" for row in compared)
    return Part(
        name="object",
        title="Object code",
        summary={
            "images": ", ".join(reports),
            "digest of the source proved": product_of(context, PROVED),
            "units with the same bits on host and target": f"{same} of {len(compared)}",
        },
        text=TEXT,
        tables=tuple(tables),
        items=tuple(
            image_item(board, report, part)
            for board, report in reports.items()
            for part in ("elf", "binary")
        ),
        files=files,
        problems=tuple(dict.fromkeys(problems)),
    )
