# SPDX-License-Identifier: Apache-2.0
"""Bound the stack of every task and of main(), from the compiler's call graph.

    python3 tools/keel stack nucleo_f767zi     # of the image that 'make firmware' built

The compiler writes for each function how much stack its frame takes and whom it calls (*.ci beside
the objects). What it cannot know stands in specs/stack.toml:

    tasks         the bodies of tasks, which the scheduler calls
    running       what the main loop calls while tasks run
    [[indirect]]  a function that calls through a pointer, and all that it may call, or nothing if
                  the pointer is null; "tasks" stands for the bodies
    [[entry]]     a function that hardware or assembly enters, and with how many bytes on its stack
                  already; stack = "fault" when that is not the main stack

Functions of the compiler's library have no such data; their frames are read from the image's
instructions. An error is: an indirect call without an entry, a function without data, a frame
without a bound, recursion, and a function of the image that nothing reaches, since then a call is
missing here. An error is also a function in ITCM that nobody calls while tasks run: what is for the
start alone does not belong there. To the deepest path comes what the core stacks for an exception,
with the registers of the FPU: no interrupt is enabled, so there is at most one, a fault, whose
handler has a stack of its own. Where the application ran on the emulated board (make test-target)
since the image was built, its painted stack must not have been deeper than the bound.

build/stack/<board>.json has the bound of each task and the deepest path of each stack. Exit
status: 0 when every bound holds, 1 when not or when there is none, 2 when none could be sought.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, program
from keel.base.files import sha256_of
from keel.base.source import write_report
from keel.boards.board import board_folder, read_board
from keel.boards.built import read_built
from keel.boards.call_graph import Disassembler, StackError, read_graph
from keel.boards.elf import Contents, read_contents
from keel.boards.stack_bounds import (
    EXCEPTION_FRAME_B,
    TABLE,
    StackTable,
    analyse,
    idle_code,
    mistakes,
)
from keel.config import read_toml
from keel.install import Toolchain

REPORT = "build/stack"
PAINTED = "build/test-target/report.json"
STACKS = {
    "main": ("keel_stack_bottom", "keel_stack_top"),
    "fault": ("keel_stack_top", "keel_fault_stack_top"),
}


def stack_sizes(contents: Contents) -> dict[str, int]:
    """The room of each stack."""
    return {
        name: contents.symbol(top).address - contents.symbol(bottom).address
        for name, (bottom, top) in STACKS.items()
    }


def painted(root: Path, board: str, elf: Path) -> int | None:
    """How deep the painted stack of this very image was when it last ran on the emulated board;
    None when it did not run there."""
    path = root / PAINTED
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
        used = report["painted_stack"]["used"].get("demo")
        same = report["painted_stack"]["demo_sha256"] == sha256_of(elf)
    except (OSError, ValueError, KeyError, AttributeError, TypeError):
        return None
    return int(used) if used is not None and same and report.get("board") == board else None


def measure(tools: Toolchain, root: Path, board: str) -> dict[str, object]:
    """Analyse a board's image; the report."""
    image = read_built(root, board)
    contents = read_contents(tools, image.elf)
    fast = read_board(root, board).memory("ITCM")
    code = Disassembler(tools, contents).functions()
    table = read_toml(root / TABLE, StackTable, mistakes)
    graph = read_graph(image)
    stacks, tasks, library = analyse(graph, code, table, stack_sizes(contents))
    names = [item.name for item in contents.functions if fast.holds(item.address, item.size)]
    idle = idle_code(graph, code, table.running, names)
    if idle:
        raise StackError(f"in ITCM, but nobody calls them while tasks run: {', '.join(idle)}")
    return {
        "board": board,
        "exception_frame_bytes": EXCEPTION_FRAME_B,
        "stacks": {
            stack.name: {"size": stack.size, "bound": stack.bytes, "path": list(stack.path)}
            for stack in stacks
        },
        "tasks": {
            name: {"bound": path.bytes, "path": list(path.functions)}
            for name, path in tasks.items()
        },
        "frames_from_instructions": library,
        "painted": painted(root, board, image.elf),
        "functions": len({id(item) for item in code.values()}),  # Some have two names.
    }


def conclude(report: Mapping[str, object], root: Path) -> int:
    """Print the bounds, write the report; the exit status."""
    stacks, tasks = report["stacks"], report["tasks"]
    assert isinstance(stacks, dict)
    assert isinstance(tasks, dict)
    for name, task in tasks.items():
        print(f"  task {name:<28} {task['bound']:6d} bytes")
    for name, stack in stacks.items():
        print(
            f"  stack {name:<27} {stack['bound']:6d} of {stack['size']} bytes: "
            f"{' > '.join(item.rpartition(':')[2] for item in stack['path'])}"
        )
    short = [name for name, stack in stacks.items() if stack["bound"] > stack["size"]]
    verdict = f"TOO LITTLE ROOM: {', '.join(short)}" if short else "every stack has room"
    deepest = report.get("painted")
    if deepest is None:
        print("  painted stack: not compared, for this image did not run on the emulated board")
    if isinstance(deepest, int):  # No exception came while it ran.
        limit = stacks["main"]["bound"] - EXCEPTION_FRAME_B
        print(f"  painted stack on the emulated board: {deepest} of the {limit} bytes bounded")
        if deepest > limit:
            short.append("main")
            verdict = "THE BOUND IS WRONG: the painted stack was deeper"
    write_report(root / REPORT / f"{report['board']}.json", report, root, good=not short)
    print(
        f"stack: {report['functions']} functions of {report['board']}, {len(tasks)} bodies of "
        f"tasks: {verdict}."
    )
    return 1 if short else 0


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = Parser("Bound the stacks of a board's image.", "stack")
    parser.add_argument("board", help="the board, a folder of bsp")
    board = parser.parse_args(arguments).board

    def work() -> int:
        board_folder(root, board)
        (root / REPORT / f"{board}.json").unlink(missing_ok=True)
        tools = Toolchain()
        tools.ensure("stack")
        return conclude(measure(tools, root, board), root)

    return program("stack", work)
