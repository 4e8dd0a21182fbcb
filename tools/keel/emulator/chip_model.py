# SPDX-License-Identifier: Apache-2.0
"""Run the image of a real board on a model of the STM32F767.

    python3 tools/keel model nucleo_f767zi                   # two seconds of the board's time
    python3 tools/keel model fmuv5 --seconds 5 --keys 1.5:t  # and a key on the console at 1.5 s
    python3 tools/keel model nucleo_f767zi --broken hse      # a clock that never becomes ready
    python3 tools/keel model fmuv5 --card card.img           # with an SD card in its slot

An emulator of the processor's instructions (Unicorn) runs the very image that is flashed. Modelled
around it, register by register, is what the image uses: clocks with over-drive and flash latency,
timers, the console, the watchdog, the pulse outputs pin by pin, an SPI with an ICM-20689, the
converter, a slot with an SD card (an image of it, into which the run's writes go), the memory
protection's guards, faults and resets, and the memories, of which the backup memory keeps its
content. The model checks as well: that the core changes to the PLL only when that is allowed, and
that nothing writes to what is not there.

What it cannot tell: anything about time. Its clock moves on by a microsecond with each reading of
the time base, so code between two readings takes none. Caches and wait states have no effect.

build/model/<board>.json says what happened. Exit status: 0 when the run went to its end and the
board printed what it is, 1 when not, 2 when there is no image or no model of the board.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program, unknown
from keel.base.files import write_bytes, write_json
from keel.boards.built import read_built
from keel.boards.sockets import read_sockets
from keel.emulator.card import SdCard
from keel.emulator.chip import BROKEN, OPTIONS, Chip
from keel.emulator.fram import Fram
from keel.emulator.processor import Processor
from keel.emulator.wiring import WIRINGS
from keel.install import Toolchain

REPORT = "build/model"


def simulate(
    tools: Toolchain,
    root: Path,
    name: str,
    seconds: float,
    keys: Sequence[tuple[int, str]] = (),
    broken: str = "",
    step_us: int = 1,
    options: int = OPTIONS,
    card: SdCard | None = None,
    fram: Fram | None = None,
) -> Chip:
    """Run a board's image; the chip afterwards. Longer steps make a shorter, coarser run."""
    if name not in WIRINGS:
        raise ToolError(unknown("model", name, WIRINGS))
    image = read_built(root, name)
    # The sockets' order is told by others than the board's table, and does not come with its image.
    chip = Chip(WIRINGS[name], broken, read_sockets(ROOT)[name].outputs, fram)
    chip.keys = sorted(keys)
    chip.step_us = step_us
    chip.options = options
    chip.card = card
    Processor(tools, image.binary.read_bytes(), image.address, chip).run(int(seconds * 1e6))
    return chip


def read_key(text: str) -> tuple[int, str]:
    """A key with its time, as 1.5:t."""
    when, _, key = text.partition(":")
    try:
        if len(key) == 1:
            return int(float(when) * 1e6), key
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"{text!r} is no SECONDS:KEY")


def read_card(path: Path) -> SdCard:
    """A card with the content of a file."""
    try:
        return SdCard(bytearray(path.read_bytes()))
    except OSError as error:
        raise ToolError(f"{path}: {error.strerror}") from error
    except ToolError as error:
        raise ToolError(f"{path}: {error}") from error


def conclude(board: str, seconds: float, chip: Chip, root: Path) -> int:
    """Print what the board said, write the report; the exit status."""
    print(chip.text.replace("\r", ""), end="")
    content = {
        "board": board,
        "seconds": seconds,
        "resets": chip.resets,
        "sensor_samples": chip.sensor.samples,
        "armed_us": chip.armed_us,
        "outputs": chip.outputs.log,
        "console": chip.text,
    }
    write_json(root / REPORT / f"{board}.json", content)
    good = f"Keel on {board}" in chip.text or "safe state" in chip.text
    print(
        f"model: {board}: {seconds:g} s of its time, {chip.resets} resets"
        f"{'' if good else ', but it did not say what it is'}."
    )
    return 0 if good else 1


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = Parser("Run a board's image on a model of its chip.", "model")
    parser.add_argument("board", help="the board, a folder of bsp")
    parser.add_argument("--seconds", type=float, default=2.0, help="of the board's time")
    parser.add_argument("--keys", type=read_key, nargs="*", default=[], metavar="SECONDS:KEY")
    parser.add_argument("--card", type=Path, metavar="IMAGE", help="what is in the slot")
    parser.add_argument("--broken", choices=BROKEN, default="", help="what does not work")
    options = parser.parse_args(arguments)

    def work() -> int:
        (root / REPORT / f"{options.board}.json").unlink(missing_ok=True)
        tools = Toolchain()
        tools.ensure("model")
        card = read_card(options.card) if options.card else None
        what = (options.board, options.seconds, options.keys, options.broken)
        chip = simulate(tools, root, *what, card=card)
        if card:
            write_bytes(options.card, bytes(card.image))
        return conclude(options.board, options.seconds, chip, root)

    return program("model", work)
