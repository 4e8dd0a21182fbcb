# SPDX-License-Identifier: Apache-2.0
"""Which outcomes conditional instructions have in an emulated run.

QEMU executes each instruction by itself and logs the registers before those that are asked for. So
the condition is evaluated on what the processor had, and a skipped instruction of an IT block is
seen as well as a branch.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from boards.board import Board
from boards.conditions import Conditional
from common.run import Ended, run
from toolchain import Toolchain

from suites.emulated import emulator

TIMEOUT_S = 300.0
REGISTER = re.compile(r"\bR(\d\d)=([0-9a-f]{8})\b")
STATUS = re.compile(r"^XPSR=([0-9a-f]{8})\b")
PC = 15

Outcomes = dict[int, set[bool]]  # By address: whether the condition held.


def one_by_one(version: str) -> list[str]:
    """What makes QEMU execute one instruction at a time; the word has changed with version 8.1."""
    major, minor = (int(part) for part in version.split(".")[:2])
    return ["-singlestep"] if (major, minor) < (8, 1) else ["-accel", "tcg,one-insn-per-tb=on"]


def outcomes_of(log: Iterable[str], at: Mapping[int, Conditional]) -> Outcomes:
    """The outcomes that a log of registers shows."""
    seen: Outcomes = {address: set() for address in at}
    registers: dict[int, int] = {}
    for line in log:
        if status := STATUS.match(line):
            address = registers.get(PC, -1)
            if address in at and len(seen[address]) < 2:
                seen[address].add(at[address].holds(registers, int(status[1], 16)))
            registers = {}
        else:
            registers |= {int(name): int(word, 16) for name, word in REGISTER.findall(line)}
    return seen


def traced(
    tools: Toolchain, board: Board, elf: Path, conditionals: Sequence[Conditional]
) -> tuple[Ended, Outcomes]:  # fmt: skip
    """Run an image; how it ended, and the outcomes of its conditional instructions."""
    log = elf.with_suffix(".log")
    log.unlink(missing_ok=True)
    places = ",".join(f"0x{item.address:x}+0x2" for item in conditionals)
    version = tools.versions("target")["qemu"].version
    words = [*one_by_one(version), "-d", "cpu,nochain", "-dfilter", places, "-D", str(log)]
    ended = run([*emulator(tools, board, elf), *words], TIMEOUT_S)
    with log.open(encoding="utf-8", errors="replace") as stream:
        seen = outcomes_of(stream, {item.address: item for item in conditionals})
    log.unlink()
    return ended, seen
