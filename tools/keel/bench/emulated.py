# SPDX-License-Identifier: Apache-2.0
"""What passes and steps cost on the Cortex-M7: instructions, counted on the emulated machine.

The image (bench/bench_target.c) runs twice and must print the same both times.
"""

from __future__ import annotations

import re

from keel.base.errors import ToolError
from keel.bench.budget import BUDGET, Budget
from keel.bench.kinds import Kind, Kinds, all_of, twice
from keel.config import place_of
from keel.install import Toolchain
from keel.test.emulated import EmulatedBoard

SOURCES = (
    "bench/bench_target.c",
    "examples/urpilot/urpilot_tasks.c",
    "examples/copter",
    "examples/copter_on_target/desk.c",
)
SHIFT = 10  # An instruction takes 1024 ns: more than a tick of the counter, which so sees each one.
LINE = re.compile(r"^bench (\w+) passes (\d+) instructions (\d+) longest (\d+)$", re.MULTILINE)
TIMEOUT_S = 120.0
KNOWN = "known"  # Assembly of known length, by which the image checks how it counts.


def read_kinds(output: str) -> Kinds:
    """What the image printed, by kind of pass."""
    if "\nbench ended\n" not in output:
        last = output.strip().splitlines()[-1:] or ["nothing"]
        raise ToolError(f"the target's bench did not end well; last it said: {last[0]}")
    return {
        name: Kind(int(passes), int(instructions), int(longest))
        for name, passes, instructions, longest in LINE.findall(output)
    }


def figures_of(kinds: Kinds, budget: Budget) -> Kinds:
    """What was counted of each figure; nothing is counted that is none."""
    named = {kind for name in budget.figures for kind in budget.kinds(name)}
    if strange := sorted(kinds.keys() - named - {KNOWN}):
        raise ToolError(f"{place_of(BUDGET)}: figures: {strange[0]}: is counted, but missing")
    return {name: all_of(kinds, budget.kinds(name)) for name in budget.figures}


def measure(tools: Toolchain, budget: Budget) -> Kinds:
    """Build, run twice, compare; what was counted of each figure."""
    board = EmulatedBoard(tools)
    image = board.builder.link("bench", board.builder.objects(SOURCES))

    def run() -> Kinds:
        ended = board.run(image, TIMEOUT_S, SHIFT)
        if not ended.good:
            raise ToolError(f"the target's bench: {ended.how}\n{ended.evidence}")
        return read_kinds(ended.output)

    return figures_of(twice(run, "on the emulated machine"), budget)
