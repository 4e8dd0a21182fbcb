# SPDX-License-Identifier: Apache-2.0
"""Write the image of a board to the board.

    python3 tools/keel flash nucleo_f767zi                      # what 'make firmware' built
    python3 tools/keel flash nucleo_f767zi --tool st-flash      # with another tool
    python3 tools/keel flash fmuv5 --port /dev/ttyACM0          # through its boot loader

bsp/<board>/flash.toml says what the board can be written with, the first being the default:

    openocd     a debug probe, with the configuration files given there
    pyocd       a debug probe, with the target's name given there
    st-flash    an ST-LINK
    px4         the boot loader of a flight controller by USB, with the board's id given there

The image must be whole: its checksum is the one in the build's report. It counts as written only
when the tool has read it back and says so; an exit status alone is not believed.

build/flash/report.json says what was written, with which tool, and how it was verified; a failed
run leaves none. Exit status: 0 when the image was written and verified, 2 when not.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import sha256_of, write_json
from keel.base.run import run
from keel.boards import px4
from keel.boards.board import board_folder
from keel.boards.built import BuiltImage, read_built
from keel.config import Field, Mistake, Table, Text, read_toml
from keel.install import Toolchain

REPORT = "build/flash/report.json"
FLASH_FILE = "flash.toml"
LAST_LINES = 15

CHECK = (
    "Check that the board is connected by USB, that the cable carries data and is at the connector "
    "of the debug probe, that no other program uses the probe, and that you may: as root, or by "
    "the udev rules that come with the tool."
)
ABSENT = re.compile(
    r"open failed|no device found|couldn't find any st-?link|no connected debug probes|"
    r"no target device available|unable to find a matching|unable to open",
    re.IGNORECASE,
)


class FlashError(ToolError):
    """An image was not written; the message says why."""


# --- The board -----------------------------------------------------------------------------------

Tool = Literal["openocd", "pyocd", "st-flash", "px4"]
NEEDS = {"openocd": "openocd", "pyocd": "pyocd", "px4": "board_id"}


class FlashFile(Table):
    """What a board can be written with; the first tool is the default."""

    tools: Annotated[list[Tool], Field(min_length=1)]
    openocd: list[Text] = []
    pyocd: Text = "-"
    board_id: int = 0


def mistakes(file: FlashFile) -> Iterator[Mistake]:
    """Tools without what they need to know."""
    for number, tool in enumerate(file.tools):
        if tool in NEEDS and NEEDS[tool] not in file.model_fields_set:
            yield ("tools", number), f"{tool} needs {NEEDS[tool]}"


def read_board(root: Path, name: str) -> FlashFile:
    """What bsp/<board>/flash.toml says, checked."""
    return read_toml(board_folder(root, name, FLASH_FILE) / FLASH_FILE, FlashFile, mistakes)


# --- The tools -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Step:
    """A command, and what it writes when it has verified the image (empty: nothing is asked)."""

    command: tuple[str, ...]
    proof: str = ""


def openocd_steps(tools: Toolchain, board: FlashFile, image: BuiltImage) -> list[Step]:
    words = [word for name in board.openocd for word in ("-f", name)]
    write = f"program {image.elf} verify reset exit"
    return [Step((*tools.command("openocd"), *words, "-c", write), r"\*\*\s*Verified OK\b")]


def pyocd_steps(tools: Toolchain, board: FlashFile, image: BuiltImage) -> list[Step]:
    pyocd = tools.command("pyocd")
    target = ("--no-wait", "--target", board.pyocd)
    compare = f"compare 0x{image.address:08x} {image.binary}"
    proof = rf"All {image.binary.stat().st_size} bytes match"
    return [
        Step((*pyocd, "load", *target, str(image.elf))),
        Step((*pyocd, "commander", *target, "-c", compare), proof),
        Step((*pyocd, "reset", *target)),
    ]


def st_flash_steps(tools: Toolchain, _: FlashFile, image: BuiltImage) -> list[Step]:
    words = ("--reset", "write", str(image.binary), f"0x{image.address:08x}")
    return [Step((*tools.command("st-flash"), *words), r"Flash written and verified")]


STEPS: Mapping[str, Callable[[Toolchain, FlashFile, BuiltImage], list[Step]]] = {
    "openocd": openocd_steps,
    "pyocd": pyocd_steps,
    "st-flash": st_flash_steps,
}


def run_step(step: Step) -> str:
    """Run a command; what it said as a proof that the image was verified."""
    name = Path(step.command[0]).name
    print(f"$ {' '.join(step.command)}", flush=True)
    ended = run(step.command)
    if ended.timed_out:
        raise FlashError(f"{name} {ended.how}. {CHECK}")
    last = "\n".join(f"  {line}" for line in ended.output.strip().splitlines()[-LAST_LINES:])
    proof = re.search(step.proof, ended.output)
    if ABSENT.search(ended.output):
        raise FlashError(f"{name} finds no board.\n{last}\n{CHECK}")
    if not ended.good:
        raise FlashError(f"{name} fails ({ended.how}).\n{last}")
    if not proof:
        raise FlashError(f"{name} ends without having verified the image.\n{last}")
    return proof[0]


def write_px4(
    tools: Toolchain, name: str, board_id: int, image: BuiltImage, port: str, wait_s: float
) -> str:
    """Make the container and send it to the boot loader."""
    path = image.binary.with_suffix(".px4")
    container = px4.Container(board_id, image.binary.read_bytes(), f"Keel on {name}", image.room)
    container.write(path)
    print(f"{path.name}: container for board id {board_id}", flush=True)
    px4.upload(tools, path, port, wait_s, px4.tell)
    return "checksum of the flash by the boot loader"


def flash(
    tools: Toolchain, root: Path, name: str, tool: str, port: str = "", wait_s: float = 30.0
) -> str:
    """Write a board's image; how it was verified."""
    board = read_board(root, name)
    chosen = tool or board.tools[0]
    if chosen not in board.tools:
        raise FlashError(f"{name} cannot be written with {chosen}; with: {', '.join(board.tools)}")
    report = root / REPORT
    report.unlink(missing_ok=True)
    image = read_built(root, name)
    tools.ensure(f"flash-{chosen}")
    if chosen == "px4":
        proof = write_px4(tools, name, board.board_id, image, port, wait_s)
    else:
        proofs = [run_step(step) for step in STEPS[chosen](tools, board, image)]
        proof = " ".join(filter(None, proofs))
    write_json(
        report,
        {
            "board": name,
            "tool": chosen,
            "verified": proof,
            "elf_sha256": sha256_of(image.elf),
            "binary_sha256": sha256_of(image.binary),
        },
    )
    return (
        f"flash: {name}: {image.binary.stat().st_size} bytes at 0x{image.address:08x} written "
        f"with {chosen} and verified ({proof})."
    )


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = Parser("Write the image of a board to the board.", "flash")
    parser.add_argument("board", help="the board, a folder of bsp")
    parser.add_argument("--tool", default="", help="openocd, pyocd, st-flash or px4")
    parser.add_argument("--port", default="", help="serial port of the boot loader (px4)")
    parser.add_argument(
        "--wait",
        type=float,
        default=30.0,
        metavar="SECONDS",
        help="how long to look for the boot loader (px4)",
    )
    options = parser.parse_args(arguments)

    def work() -> int:
        words = (options.board, options.tool, options.port, options.wait)
        print(flash(Toolchain(), root, *words))
        return 0

    return program("flash: NOT written", work)
