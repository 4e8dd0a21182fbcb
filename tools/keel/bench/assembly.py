# SPDX-License-Identifier: Apache-2.0
"""What a step must not have in its Cortex-M7 objects: double precision, and calls of a library."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from keel.base.errors import ToolError

FUNCTION = re.compile(r"^[0-9a-f]+ <([^>]+)>:$")
CALL = re.compile(r"R_ARM_THM_(?:CALL|JUMP24)\s+(\S+)")
INSTRUCTION = re.compile(r"^\s+[0-9a-f]+:\t")
DOUBLE = re.compile(r"\bv\w+(?:\.\w+)*\.f64\b")


@dataclass
class Code:
    """A function in an object file: what it calls, its instructions, those in double precision."""

    calls: set[str] = field(default_factory=set)
    instructions: int = 0
    doubles: list[str] = field(default_factory=list)


def read_code(listing: str) -> dict[str, Code]:
    """The functions of a disassembly with relocations (objdump -dr)."""
    found: dict[str, Code] = {}
    code = Code()
    for line in listing.splitlines():
        if function := FUNCTION.match(line):
            code = found.setdefault(function[1], Code())
        elif call := CALL.search(line):
            code.calls.add(call[1])
        elif INSTRUCTION.match(line):
            code.instructions += 1
            if DOUBLE.search(line):
                code.doubles.append(" ".join(line.split("\t")[2:]).strip())
    return found


def refuse_slow_code(code: Mapping[str, Code], step: str) -> None:
    """No double precision and no library call in what a step reaches."""
    waiting, seen = [step], set()
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        if name not in code:
            raise ToolError(f"{step} reaches {name}, which is not the kernel's")
        if code[name].doubles:
            first = code[name].doubles[0]
            raise ToolError(f"{step}: {name} computes in double precision: {first}")
        waiting += code[name].calls
