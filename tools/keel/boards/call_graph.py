# SPDX-License-Identifier: Apache-2.0
"""Who calls whom, and how much stack a frame takes: from the compiler (*.ci), and for functions of
its libraries, which have no such file, from their instructions."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from keel.base.errors import ToolError
from keel.base.files import read_text
from keel.boards.built import BuiltImage
from keel.boards.elf import Contents, Symbol
from keel.boards.packages import load
from keel.install import Toolchain

INDIRECT = "__indirect_call"


class StackError(ToolError):
    """A stack has no bound; the message says why."""

    status = 1


# --- What the compiler says ----------------------------------------------------------------------


@dataclass
class Function:
    """A function: its name in the image, its frame in bytes (None: unknown), whom it calls."""

    name: str
    file: str = ""  # Of a function that only its own file sees.
    frame: int | None = None
    calls: set[str] = field(default_factory=set)
    indirect: bool = False


Graph = dict[str, Function]  # By title: the name, behind the file if only that sees it.

NODE = re.compile(r'^node: \{ title: "([^"]+)" label: "([^"]*)"')
EDGE = re.compile(r'^edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')
FRAME = re.compile(r"(\d+) bytes \(([a-z,]+)\)")


def titled(graph: Graph, title: str) -> Function:
    """The function of that title, which is added when it is new."""
    file, _, name = title.rpartition(":")
    return graph.setdefault(title, Function(name, file))


def parse(text: str, graph: Graph, where: str = "") -> None:
    """Add a file's functions and calls to the graph."""
    for line in text.splitlines():
        if (node := NODE.match(line)) and node[1] != INDIRECT:
            function = titled(graph, node[1])
            frame = FRAME.search(node[2].replace("\\n", "\n"))
            if frame and frame[2] not in ("static", "dynamic,bounded"):
                raise StackError(f"{where}: the frame of {function.name} has no bound ({frame[2]})")
            if frame and function.frame is not None:
                raise StackError(f"{where}: {function.name} is defined twice")
            function.frame = int(frame[1]) if frame else function.frame
        elif edge := EDGE.match(line):
            caller = titled(graph, edge[1])
            if edge[2] == INDIRECT:
                caller.indirect = True
            else:
                caller.calls.add(edge[2])


def read_graph(image: BuiltImage) -> Graph:
    """The call graph of an image's sources."""
    graph: Graph = {}
    for source, made in sorted(image.objects.items()):
        parse(read_text((image.folder / made).with_suffix(".ci")), graph, source)
    return graph


# --- What the instructions say -------------------------------------------------------------------

VENEER = re.compile(r"__(\w+)_veneer")  # A jump between memories that the linker put in; no frame.
RELEASES = ("pop", "vpop", "add", "ldm", "ldr")


@dataclass
class Code:
    """A function's instructions: all that they may push, and the functions they branch to."""

    pushed: int = 0
    calls: set[str] = field(default_factory=set)
    unbounded: str = ""  # An instruction that moves the stack pointer by nobody knows how much.


class Disassembler:
    """Reads the functions of an image, instruction by instruction."""

    def __init__(self, tools: Toolchain, contents: Contents) -> None:
        self.capstone = load(tools, "capstone", "capstone")
        self.arm = load(tools, "capstone", "capstone.arm")
        self.machine = self.capstone.Cs(
            self.capstone.CS_ARCH_ARM, self.capstone.CS_MODE_THUMB | self.capstone.CS_MODE_MCLASS
        )
        self.machine.detail = True
        self.contents = contents
        self.names: dict[int, str] = {}
        self.symbols = sorted(contents.functions, key=lambda symbol: symbol.name)
        for symbol in self.symbols:
            veneer = VENEER.fullmatch(symbol.name)
            self.names.setdefault(symbol.address, veneer[1] if veneer else symbol.name)

    def functions(self) -> dict[str, Code]:
        """Every function of the image, one object for all names of one; the linker's own detours
        count as what they lead to."""
        found: dict[str, Code] = {}
        for symbol in self.symbols:
            name = self.names[symbol.address]
            if VENEER.fullmatch(symbol.name):
                continue
            if name == symbol.name:
                found[name] = self.read(symbol)
            else:
                found[symbol.name] = found[name]
        return found

    def read(self, symbol: Symbol) -> Code:
        """A function's instructions. Every push counts, whatever the path."""
        code = Code()
        for address, data in self.contents.instructions_of(symbol):
            end = address
            for instruction in self.machine.disasm(data, address):
                end = instruction.address + instruction.size
                self.add(code, instruction)
            if end != address + len(data):
                raise StackError(f"{symbol.name}: unknown instruction at 0x{end:08x}")
        code.calls.discard(symbol.name)
        return code

    def add(self, code: Code, instruction: Any) -> None:
        """Add what an instruction pushes, and where it branches to."""
        pushed = self.pushed(instruction)
        if pushed is None:
            code.unbounded = f"{instruction.mnemonic} {instruction.op_str}"
        code.pushed += pushed or 0
        jumps = instruction.group(self.capstone.CS_GRP_JUMP)
        if jumps or instruction.group(self.capstone.CS_GRP_CALL):
            target = instruction.operands[-1]
            if target.type == self.arm.ARM_OP_IMM and target.imm in self.names:
                code.calls.add(self.names[target.imm])

    def pushed(self, instruction: Any) -> int | None:
        """By how many bytes an instruction moves the stack pointer down; None: not known."""
        arm, operands, name = self.arm, instruction.operands, instruction.mnemonic
        # For the disassembler vpush writes no stack pointer.
        if arm.ARM_REG_SP not in instruction.regs_access()[1] and name != "vpush":
            return 0
        if name.startswith(("push", "vpush", "stmdb")):
            registers = [instruction.reg_name(item.reg) for item in operands]
            return sum(8 if word.startswith("d") else 4 for word in registers if word != "sp")
        if name.startswith("sub") and operands[-1].type == arm.ARM_OP_IMM:
            return int(operands[-1].imm)
        if name.startswith("str") and operands[-1].type == arm.ARM_OP_MEM:
            return max(0, -int(operands[-1].mem.disp))
        return 0 if name.startswith(RELEASES) else None


def complete(graph: Graph, code: Mapping[str, Code]) -> list[str]:
    """Give the functions of libraries their frames, and their calls; the names of those."""
    library: list[str] = []
    open_titles = [title for title, function in graph.items() if function.frame is None]
    while open_titles:
        title = open_titles.pop()
        function = graph[title]
        if function.name not in code:
            raise StackError(f"{title}: neither the compiler nor the image knows its frame")
        known = code[function.name]
        if known.unbounded:
            raise StackError(f"{function.name}: the frame has no bound ({known.unbounded})")
        function.frame, function.calls = known.pushed, set(known.calls)
        library.append(function.name)
        for target in function.calls - graph.keys():
            graph[target] = Function(target)
            open_titles.append(target)
    return sorted(library)
