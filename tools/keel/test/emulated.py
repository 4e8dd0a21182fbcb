# SPDX-License-Identifier: Apache-2.0
"""The board that QEMU emulates: building images for it, and running them."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

from keel.base.errors import ROOT
from keel.base.run import Ended, run
from keel.boards.board import Board, read_board
from keel.boards.firmware import Builder, Image
from keel.install import Toolchain
from keel.test.outcomes import EXACT_FLOATS

BOARD = "mps2_an500"
BUILD = Path("build/test-target")
SHIFT = 2  # An instruction takes 2^2 ns: 250 million a second, about the STM32F767's pace.
TIMEOUT_S = 120.0
STACK_LINE = re.compile(r"^stack: (\d+) of (\d+) bytes used$", re.MULTILINE)


def emulator(tools: Toolchain, board: Board, elf: Path, shift: int = SHIFT) -> list[str]:
    """The command that runs an image: its console is the standard output, its end the status."""
    return [
        *tools.command("qemu-system-arm"),
        "-machine",
        "mps2-an500",
        "-icount",
        f"shift={shift},sleep=off",
        "-display",
        "none",
        "-monitor",
        "none",
        "-serial",
        "stdio",
        "-semihosting-config",
        "enable=on,target=native",
        "-global",
        f"armv7m.init-nsvtor=0x{board.load_address:08x}",
        "-kernel",
        str(elf),
    ]


@dataclass
class EmulatedBoard:
    """Builds images of the board, each file at most once, and runs them."""

    tools: Toolchain
    root: Path = ROOT
    folder: Path = BUILD  # Below the root; two runs at once need one each.
    stacks: dict[str, int] = field(default_factory=dict)  # by image, in bytes
    stack_size: int = 0
    demo_sha256: str = ""  # Of the image whose stack is the demo's.

    def __post_init__(self) -> None:
        self.board = read_board(self.root, BOARD)
        folder = self.root / self.folder
        folder.mkdir(parents=True, exist_ok=True)
        self.builder = Builder(self.tools, self.board, folder, self.root)

    def unity(self) -> Path:
        """Unity, writing to the board's console."""
        folder = self.tools.command("unity")[0]
        return self.builder.object(f"{folder}/unity.c", [*self.unity_flags(), "-w"])

    def unity_flags(self) -> list[str]:
        """What makes a file find Unity, and Unity the console."""
        return [
            "-isystem",
            self.tools.command("unity")[0],
            "-DUNITY_SUPPORT_64",
            "-DUNITY_INCLUDE_DOUBLE",
            EXACT_FLOATS,
            "-DUNITY_OUTPUT_CHAR(c)=keel_board_put((char)(c))",
            "-DUNITY_OUTPUT_CHAR_HEADER_DECLARATION=keel_board_put(char c)",
        ]

    def run(self, image: Image, timeout_s: float = TIMEOUT_S, shift: int = SHIFT) -> Ended:
        """Run an image to its end, or to its time limit; remember its stack."""
        ended = run(emulator(self.tools, self.board, image.elf, shift), timeout_s)
        if told := STACK_LINE.search(ended.output):
            self.stacks[image.elf.stem] = int(told[1])
            self.stack_size = int(told[2])
        return ended
