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

from keel.base.run import Ended, run
from keel.boards.board import Board
from keel.boards.conditions import Conditional
from keel.install import Toolchain
from keel.test.emulated import emulator

TIMEOUT_S = 300.0
LOOK_S = 0.5
REGISTER = re.compile(rb"\bR(\d\d)=([0-9a-f]{8})\b")
STATUS = re.compile(rb"[0-9a-f]{8}\b")
REGISTER_B = len(b"R00=00000000")
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


def outcomes_of(log: BinaryIO, at: Mapping[int, Conditional], chunk_b: int = CHUNK_B) -> Outcomes:
    """The outcomes that a log of registers shows.

    A log has millions of instructions: registers are read only where an outcome is yet to be seen,
    and the condition is on what it was not on before.
    """
    seen: Outcomes = {address: set() for address in at}
    waiting = {f"{address:08x}".encode(): at[address] for address in at}
    known: set[tuple[int, bytes]] = set()
    registers = b""
    for part in parts_of(log, chunk_b):
        item = waiting.get(registers[PC])
        if item is not None and (status := STATUS.match(part)):
            case = (item.address, _decisive(item, registers, part))
            if case not in known:
                known.add(case)
                values = {int(name): int(word, 16) for name, word in REGISTER.findall(registers)}
                seen[item.address].add(item.holds(values, int(status[0], 16)))
                if len(seen[item.address]) == 2:
                    del waiting[registers[PC]]
        registers = part
    return seen


def _decisive(item: Conditional, registers: bytes, status: bytes) -> bytes:
    """What a condition depends on: the word of its register, or else the flags, the first digit."""
    if item.register < 0:
        return status[:1]
    begin = registers.find(b"R%02d=" % item.register)
    return registers[begin : begin + REGISTER_B]


def traced(
    tools: Toolchain, board: Board, elf: Path, conditionals: Sequence[Conditional]
) -> tuple[Ended, Outcomes]:
    """Run an image; how it ended, and the outcomes of its conditional instructions.

    The time goes into loops, logged over and over with outcomes that are known. So the run is begun
    several times and broken off, as long as that shows something, and what has had both outcomes is
    logged no more. Every run of an image is the same: these are beginnings of the last.
    """
    seen: Outcomes = {item.address: set() for item in conditionals}
    left, limit_s = list(conditionals), LOOK_S
    while True:
        ended, more = _logged(tools, board, elf, left, limit_s)
        for address, outcomes in more.items():
            seen[address] |= outcomes
        if not ended.timed_out or limit_s == TIMEOUT_S:
            return ended, seen
        rest = [item for item in left if len(seen[item.address]) < 2]
        limit_s = LOOK_S if len(rest) < len(left) else TIMEOUT_S
        left = rest


def _logged(
    tools: Toolchain, board: Board, elf: Path, items: Sequence[Conditional], limit_s: float
) -> tuple[Ended, Outcomes]:
    """Run an image, to its end or for a while, and log these instructions. What is broken off may
    not have begun to."""
    command = emulator(tools, board, elf)
    if not items:
        return run(command, limit_s), {}
    log = elf.with_suffix(".log")
    log.unlink(missing_ok=True)
    places = ",".join(f"0x{item.address:x}+0x2" for item in items)
    words = [*one_by_one(tools.versions("target")["qemu"].version), "-d", "cpu,nochain"]
    ended = run([*command, *words, "-dfilter", places, "-D", str(log)], limit_s)
    if ended.timed_out and not log.is_file():
        return ended, {}
    with log.open("rb") as stream:
        seen = outcomes_of(stream, {item.address: item for item in items})
    log.unlink()
    return ended, seen
