# SPDX-License-Identifier: Apache-2.0
"""What the emulated board must record of each fault that tests/target/faults.c makes."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

SAFE_STATUS = 70
GUARD = range(0x2000_0000, 0x2000_0400)
CODE = 0xC0DE_0042
TASK = "breaker"

# Exceptions, and bits of the fault status (ARMv7-M Architecture Reference Manual, B1.5 and B3.2).
NMI, MEMORY, BUS, USAGE, INTERRUPT_3 = 2, 4, 5, 6, 19
IACCVIOL, DACCVIOL, MSTKERR, MMARVALID = 1 << 0, 1 << 1, 1 << 4, 1 << 7
PRECISERR, BFARVALID = 1 << 9, 1 << 15
UNDEFINSTR, DIVBYZERO = 1 << 16, 1 << 25


@dataclass(frozen=True)
class Fault:
    """What must have been recorded of a fault."""

    exception: int
    status: int  # CFSR: these bits and no others but `allowed`
    allowed: int = 0
    address: range | None = None  # MMFAR or BFAR
    code: int = 0
    function: str = ""  # where it happened, if not in fault_<kind>; "-" when nowhere
    stacked: bool = True
    task: str = TASK


FAULTS = {
    "undefined": Fault(USAGE, UNDEFINSTR),
    "bus": Fault(BUS, PRECISERR | BFARVALID, address=range(0x7000_0000, 0x7000_0001)),
    "stack": Fault(
        MEMORY, MSTKERR, DACCVIOL | MMARVALID, address=GUARD, function="-", stacked=False
    ),
    "division": Fault(USAGE, DIVBYZERO),
    "null": Fault(MEMORY, DACCVIOL | MMARVALID, address=range(0x10, 0x11)),
    "execute": Fault(MEMORY, IACCVIOL, function="-"),
    "jump": Fault(MEMORY, IACCVIOL, function="-"),
    "jump_far": Fault(MEMORY, IACCVIOL, function="-"),
    "write": Fault(MEMORY, DACCVIOL | MMARVALID, address=range(0x20_0000, 0x20_0001)),
    "stop": Fault(USAGE, UNDEFINSTR, code=CODE, function="keel_fault_stop"),
    "interrupt": Fault(INTERRUPT_3, 0),
    "hang": Fault(NMI, 0),
    "lost_slot": Fault(USAGE, UNDEFINSTR, task="-"),
    "lost_task": Fault(USAGE, UNDEFINSTR, task="-"),
    "lost_name": Fault(USAGE, UNDEFINSTR, task="-"),
}

WORD = re.compile(r"\b([a-z_0-9]+) (0x[0-9a-f]{8}|\d+)\b")
RECORD = re.compile(r"^safe state: (fault .*)\n((?: .*\n)+)", re.MULTILINE)


def read_record(output: str) -> dict[str, str]:
    """What the board printed of its fault record, by names."""
    match = RECORD.search(output)
    if not match:
        return {}
    found = dict(WORD.findall(match[0]))
    task = re.search(r"\btask (\S+)", match[1])
    found["task"] = task[1] if task else ""
    found["stacked"] = "no" if "not stacked" in match[2] else "yes"
    return found


def judge_fault(fault: Fault, found: Mapping[str, str], span: range) -> list[str]:
    """How a record differs from what must be in it; span is the function's code."""
    if not found:
        return ["no record was printed"]
    number = {name: int(text, 0) for name, text in found.items() if WORD.match(f"x {text}")}
    status = number.get("cfsr", -1)
    address = number.get("bfar" if fault.exception == BUS else "mmfar", -1)
    wrong = [
        f"{name} is {found.get(name)}, not {want}"
        for name, want in (
            ("fault", "1"),
            ("exception", str(fault.exception)),
            ("code", f"0x{fault.code:08x}"),
            ("task", fault.task),
            ("stacked", "yes" if fault.stacked else "no"),
        )
        if found.get(name) != want
    ]
    if status & ~fault.allowed != fault.status:
        wrong.append(f"cfsr is 0x{status:08x}, not 0x{fault.status:08x}")
    if fault.address and status & (MMARVALID | BFARVALID) and address not in fault.address:
        wrong.append(f"the address is 0x{address:08x}, not 0x{fault.address.start:08x}")
    if span and number.get("pc", -1) not in span:
        wrong.append(f"pc is {found.get('pc')}, not in 0x{span.start:08x} to 0x{span.stop:08x}")
    return wrong
