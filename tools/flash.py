#!/usr/bin/env python3
"""Write the image of a board to the board.

    python3 tools/flash.py nucleo_f767zi                      # what 'make firmware' built
    python3 tools/flash.py nucleo_f767zi --tool st-flash      # with another tool
    python3 tools/flash.py fmuv5 --port /dev/ttyACM0          # through its boot loader

bsp/<board>/flash.toml says what the board can be written with, the first being the default:

    openocd     a debug probe, with the configuration files given there
    pyocd       a debug probe, with the target's name given there
    st-flash    an ST-LINK
    px4         the boot loader of a flight controller by USB, with the board's id given there

The image must be whole: its checksum is the one in the build's report. It counts as written only
when the tool has read it back and says so; an exit status alone is not believed.

build/flash/report.json says what was written, with which tool, and how it was verified; a failed
run leaves none. Exit status: 0 when the image was written and verified, 1 when not, 2 for a wrong
command line or an unknown board.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import re
import subprocess
import sys
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import px4
from toolchain import Toolchain, ToolchainError, write_atomically

ROOT = Path(__file__).resolve().parents[1]
FIRMWARE = "build/firmware"
REPORT = "build/flash/report.json"
TIMEOUT_S = 300
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


class FlashError(Exception):
    """An image was not written; the message says why."""


class UnknownBoardError(FlashError):
    """There is no such board, or it cannot be written to."""


@dataclass(frozen=True)
class Image:
    """What is written, and where."""

    elf: Path
    binary: Path
    address: int
    room: int  # Bytes of flash from that address on.


@dataclass(frozen=True)
class Step:
    """A command, and what it writes when it has verified the image (empty: nothing is asked)."""

    command: tuple[str, ...]
    proof: str = ""


# --- The board and its image ---------------------------------------------------------------------

KEYS: Mapping[str, type] = {"tools": list, "openocd": list, "pyocd": str, "board_id": int}


def read_board(root: Path, name: str) -> dict[str, object]:
    """What bsp/<board>/flash.toml says, checked."""
    known = sorted(path.parent.name for path in (root / "bsp").glob("*/flash.toml"))
    if name not in known:
        there = ", ".join(known) or "none"
        raise UnknownBoardError(f"no board {name or '(none named)'} to write to; boards: {there}")
    where = f"bsp/{name}/flash.toml"
    try:
        raw = tomllib.loads((root / where).read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise FlashError(f"{where}: {error}") from error
    for key, value in raw.items():
        if key not in KEYS or not isinstance(value, KEYS[key]):
            raise FlashError(f"{where}: {key} is unknown or has the wrong type")
    tools = raw.get("tools")
    if not isinstance(tools, list) or not tools or not set(tools) <= STEPS.keys() | {"px4"}:
        raise FlashError(f"{where}: tools must be some of {', '.join([*STEPS, 'px4'])}")
    needs = {"openocd": "openocd", "pyocd": "pyocd", "px4": "board_id"}
    for tool in tools:
        if tool in needs and needs[tool] not in raw:
            raise FlashError(f"{where}: {tool} needs {needs[tool]}")
    return raw


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def read_image(root: Path, board: str) -> Image:
    """What the build left for the board; nothing but what its report vouches for."""
    folder = root / FIRMWARE / board
    try:
        report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
        image = Image(
            folder / report["elf"]["file"], folder / report["binary"]["file"],
            int(report["load_address"]), int(report["regions"]["FLASH"]["size"]),
        )  # fmt: skip
        sums = (report["elf"]["sha256"], report["binary"]["sha256"])
        same = (sha256(image.elf), sha256(image.binary)) == sums
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise FlashError(
            f"there is no whole image of {board} ({error}); run: make firmware BOARD={board}"
        ) from error
    if not same:
        raise FlashError(f"{folder.relative_to(root)} is not what its report says; run: "
                         f"make firmware BOARD={board}")  # fmt: skip
    return image


# --- The tools -----------------------------------------------------------------------------------


def openocd_steps(tools: Toolchain, board: Mapping[str, object], image: Image) -> list[Step]:
    files = board["openocd"]
    assert isinstance(files, list)
    words = [word for name in files for word in ("-f", str(name))]
    program = f"program {image.elf} verify reset exit"
    command = (*tools.command("openocd"), *words, "-c", program)
    return [Step(command, r"\*\*\s*Verified OK\b")]


def pyocd_steps(tools: Toolchain, board: Mapping[str, object], image: Image) -> list[Step]:
    pyocd = tools.command("pyocd")
    target = ("--no-wait", "--target", str(board["pyocd"]))
    size = image.binary.stat().st_size
    compare = f"compare 0x{image.address:08x} {image.binary}"
    return [
        Step((*pyocd, "load", *target, str(image.elf))),
        Step((*pyocd, "commander", *target, "-c", compare), rf"All {size} bytes match"),
        Step((*pyocd, "reset", *target)),
    ]


def st_flash_steps(tools: Toolchain, _: Mapping[str, object], image: Image) -> list[Step]:
    words = ("--reset", "write", str(image.binary), f"0x{image.address:08x}")
    return [Step((*tools.command("st-flash"), *words), r"Flash written and verified")]


STEPS: Mapping[str, Callable[[Toolchain, Mapping[str, object], Image], list[Step]]] = {
    "openocd": openocd_steps,
    "pyocd": pyocd_steps,
    "st-flash": st_flash_steps,
}


def run_step(step: Step) -> str:
    """Run a command; what it said as a proof that the image was verified."""
    name = Path(step.command[0]).name
    print(f"$ {' '.join(step.command)}", flush=True)
    try:
        done = subprocess.run(
            step.command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, errors="replace", timeout=TIMEOUT_S, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise FlashError(f"{name} does not end within {TIMEOUT_S} s. {CHECK}") from None
    last = "\n".join(f"  {line}" for line in done.stdout.strip().splitlines()[-LAST_LINES:])
    proof = re.search(step.proof, done.stdout) if step.proof else None
    absent = ABSENT.search(done.stdout)
    if done.returncode == 0 and not absent and (proof or not step.proof):
        return proof[0] if proof else ""
    if absent:
        raise FlashError(f"{name} finds no board.\n{last}\n{CHECK}")
    if done.returncode == 0:
        raise FlashError(f"{name} ends without having verified the image.\n{last}")
    raise FlashError(f"{name} fails (exit status {done.returncode}).\n{last}")


def write_px4(
    tools: Toolchain, name: str, board: Mapping[str, object], image: Image, port: str, wait_s: float
) -> str:
    """Make the container and send it to the boot loader."""
    board_id = board["board_id"]
    assert isinstance(board_id, int)
    path = image.binary.with_suffix(".px4")
    container = px4.Container(board_id, image.binary.read_bytes(), f"Keel on {name}", image.room)
    px4.write_container(container, path)
    print(f"{path.name}: container for board id {board_id}", flush=True)
    px4.upload(tools, path, port, wait_s, px4.tell)
    return "checksum of the flash by the boot loader"


def flash(
    tools: Toolchain, root: Path, name: str, tool: str, port: str = "", wait_s: float = 30.0
) -> str:
    """Write a board's image; how it was verified."""
    board = read_board(root, name)
    offered = board["tools"]
    assert isinstance(offered, list)
    chosen = tool or str(offered[0])
    if chosen not in offered:
        raise FlashError(f"{name} cannot be written with {chosen}; with: {', '.join(offered)}")
    report = root / REPORT
    report.unlink(missing_ok=True)
    image = read_image(root, name)
    tools.ensure(f"flash-{chosen}")
    if chosen == "px4":
        proof = write_px4(tools, name, board, image, port, wait_s)
    else:
        proofs = [run_step(step) for step in STEPS[chosen](tools, board, image)]
        proof = " ".join(filter(None, proofs))
    content = {"board": name, "tool": chosen, "verified": proof,
               "elf_sha256": sha256(image.elf), "binary_sha256": sha256(image.binary)}  # fmt: skip
    write_atomically(report, json.dumps(content, indent=1) + "\n")
    return f"flash: {name}: {image.binary.stat().st_size} bytes at 0x{image.address:08x} written " \
           f"with {chosen} and verified ({proof})."  # fmt: skip


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Write the image of a board to the board.")
    parser.add_argument("board", help="the board, a folder of bsp")
    parser.add_argument("--tool", default="", help="openocd, pyocd, st-flash or px4")
    parser.add_argument("--port", default="", help="serial port of the boot loader (px4)")
    parser.add_argument("--wait", type=float, default=30.0, metavar="SECONDS",
                        help="how long to look for the boot loader (px4)")  # fmt: skip
    options = parser.parse_args(arguments)
    try:
        line = flash(Toolchain(), root, options.board, options.tool, options.port, options.wait)
    except UnknownBoardError as error:
        print(f"flash: {error}", file=sys.stderr)
        return 2
    except (FlashError, px4.Px4Error, ToolchainError, OSError) as error:
        print(f"flash: NOT written: {error}", file=sys.stderr)
        return 1
    print(line)
    return 0


if __name__ == "__main__":
    sys.exit(main())
