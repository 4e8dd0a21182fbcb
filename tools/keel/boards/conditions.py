# SPDX-License-Identifier: Apache-2.0
"""The conditional instructions of Cortex-M7 code: where they are, and when their conditions hold.

Counted are conditional branches (b<condition>, cbz, cbnz), the conditional instructions of IT
blocks, and selections (vsel). A jump through a table or a register, which has no two outcomes, is
refused: nobody could say that it was covered.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from keel.base.errors import ToolError
from keel.boards.elf import Contents, Symbol
from keel.boards.packages import load
from keel.install import Toolchain

BRANCH, BLOCK, SELECTION = "branch", "IT block", "selection"
ZERO = {"cbz": True, "cbnz": False}
COMPUTED = ("tbb", "tbh")


class ConditionError(ToolError):
    """Code whose conditions cannot be counted."""


@dataclass(frozen=True)
class Conditional:
    """A conditional instruction: the same in every image but for its address."""

    address: int
    offset: int  # from the start of its function
    kind: str
    text: str
    condition: str  # of the flags: eq, ne, ...; or cbz, cbnz
    register: int = -1  # that cbz and cbnz look at

    def holds(self, registers: Mapping[int, int], status: int) -> bool:
        """Whether the condition holds: the branch is taken, the instruction has an effect."""
        if self.condition in ZERO:
            return (registers[self.register] == 0) == ZERO[self.condition]
        return flags_say(self.condition, status)


def flags_say(condition: str, status: int) -> bool:
    """Whether a condition holds (ARMv7-M Architecture Reference Manual, A7.3)."""
    n, z, c, v = (bool(status >> bit & 1) for bit in (31, 30, 29, 28))
    positive = {
        "eq": z,
        "hs": c,
        "mi": n,
        "vs": v,
        "hi": c and not z,
        "ge": n == v,
        "gt": not z and n == v,
    }
    opposite = {"ne": "eq", "lo": "hs", "pl": "mi", "vc": "vs", "ls": "hi", "lt": "ge", "le": "gt"}
    if condition in opposite:
        return not positive[opposite[condition]]
    return positive[condition]


class Conditions:
    """Finds the conditional instructions of an image's functions."""

    def __init__(self, tools: Toolchain) -> None:
        self.capstone = load(tools, "capstone", "capstone")
        self.arm = load(tools, "capstone", "capstone.arm")
        self.machine = self.capstone.Cs(
            self.capstone.CS_ARCH_ARM, self.capstone.CS_MODE_THUMB | self.capstone.CS_MODE_MCLASS
        )
        self.machine.detail = True
        prefix = "ARM_CC_"
        self.names = {
            value: name.removeprefix(prefix).lower()
            for name, value in vars(self.arm).items()
            if name.startswith(prefix)
        }

    def of(self, contents: Contents, function: Symbol) -> Iterator[Conditional]:
        """Those of one function, in the order of their addresses."""
        for address, data in contents.instructions_of(function):
            end = address
            for instruction in self.machine.disasm(data, address):
                end = instruction.address + instruction.size
                if found := self.conditional(instruction, function):
                    yield found
            if end != address + len(data):
                raise ConditionError(f"{function.name}: unknown instruction at 0x{end:08x}")

    def conditional(self, instruction: Any, function: Symbol) -> Conditional | None:
        """An instruction as a conditional one, if it is that."""
        name, operands = instruction.mnemonic, instruction.operands
        offset = instruction.address - function.address
        condition = self.names.get(instruction.cc, "")
        if name.startswith(COMPUTED) or self.jumps_by_register(instruction):
            raise ConditionError(
                f"{function.name}+0x{offset:x}: {name} {instruction.op_str}: a "
                "computed jump has no two outcomes to count"
            )
        if name in ZERO:
            kind, condition = BRANCH, name
            text = f"{name} {instruction.reg_name(operands[0].reg)}"
            register = int(operands[0].reg) - int(self.arm.ARM_REG_R0)
            return Conditional(instruction.address, offset, kind, text, condition, register)
        if name.startswith("vsel"):
            kind, condition = SELECTION, name[4:6]
        elif name.startswith("it") or condition in ("al", "invalid", ""):
            return None
        else:
            kind = BRANCH if instruction.id == self.arm.ARM_INS_B else BLOCK
        text = name if kind == BRANCH else f"{name} {instruction.op_str}"
        return Conditional(instruction.address, offset, kind, text, condition)

    def jumps_by_register(self, instruction: Any) -> bool:
        """Whether it jumps to where a register says, but for a return and a call."""
        if instruction.id == self.arm.ARM_INS_BX:
            return bool(instruction.operands[0].reg != self.arm.ARM_REG_LR)
        writes = self.arm.ARM_REG_PC in instruction.regs_access()[1]
        return writes and instruction.mnemonic.startswith(("mov", "add"))
