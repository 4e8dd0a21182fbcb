# SPDX-License-Identifier: Apache-2.0
"""Which outcomes conditional instructions have in an emulated run.

QEMU executes each instruction by itself and logs the registers before those that are asked for. So
the condition is evaluated on what the processor had, and a skipped instruction of an IT block is
seen as well as a branch.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import BinaryIO

from boards.board import Board
from boards.conditions import Conditional
from common.run import Ended, run
from toolchain import Toolchain

from suites.emulated import emulator

TIMEOUT_S = 300.0
REGISTER = re.compile(rb"\bR(\d\d)=([0-9a-f]{8})\b")
STATUS = re.compile(rb"[0-9a-f]{8}\b")
MARK = b"XPSR="  # The last line that is logged of an instruction; the PC ends the one before.
PC = slice(-9, -1)
CHUNK_B = 1 << 24

Outcomes = dict[int, set[bool]]  # By address: whether the condition held.


def one_by_one(version: str) -> list[str]:
    """What makes QEMU execute one instruction at a time; the word has changed with version 8.1."""
    major, minor = (int(part) for part in version.split(".")[:2])
    return ["-singlestep"] if (major, minor) < (8, 1) else ["-accel", "tcg,one-insn-per-tb=on"]


def parts_of(log: BinaryIO, chunk_b: int) -> Iterator[bytes]:
    """What stands between the marks of a log: a status, and the registers of the next one."""
    rest = b""
    while chunk := log.read(chunk_b):
        *whole, rest = (rest + chunk).split(MARK)
        yield from whole
    yield rest


def outcomes_of(
    log: BinaryIO, at: Mapping[int, Conditional], chunk_b: int = CHUNK_B
) -> Outcomes:  # fmt: skip
    """The outcomes that a log of registers shows.

    A log has millions of instructions: registers are read only where an outcome is yet to be seen.
    """
    seen: Outcomes = {address: set() for address in at}
    waiting = {f"{address:08x}".encode(): address for address in at}
    registers = b""
    for part in parts_of(log, chunk_b):
        address = waiting.get(registers[PC])
        if address is not None and (status := STATUS.match(part)):
            values = {int(name): int(word, 16) for name, word in REGISTER.findall(registers)}
            seen[address].add(at[address].holds(values, int(status[0], 16)))
            if len(seen[address]) == 2:
                del waiting[registers[PC]]
        registers = part
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
    with log.open("rb") as stream:
        seen = outcomes_of(stream, {item.address: item for item in conditionals})
    log.unlink()
    return ended, seen
