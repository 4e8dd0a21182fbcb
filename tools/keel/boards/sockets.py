# SPDX-License-Identifier: Apache-2.0
"""What others say of a board's sockets (specs/outputs.toml), and what its pin table says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from keel.base.files import read_text
from keel.config import Table, Text, read_toml

SOCKETS = "specs/outputs.toml"
PINS = "bsp/*/pins.c"
OUTPUT_LINE = re.compile(r"KEEL_OUTPUT\((\w), (\d+)u, \d+u, (\w+), (\w+)\)")
MOUNTING_LINE = re.compile(r"KEEL_MOUNTING\((-?\d), (-?\d), (-?\d)\)")
ARMED_LINE = re.compile(r"KEEL_ARMED\((\w), (\d+)u\)")
LEVEL_LINE = re.compile(r"KEEL_LEVEL\((\w), (\d+)u, (true|false)\)")


class Sockets(Table):
    """The sockets of a board."""

    name: Text
    source: Text
    mounting: list[int]
    outputs: list[Text]
    levels: list[Text]
    armed: Text | None = None

    @property
    def watched(self) -> list[str]:
        """The pins whose states mean something: the outputs, and the one that tells of them."""
        return [*self.outputs, *([self.armed] if self.armed else [])]


class SocketsFile(Table):
    """specs/outputs.toml."""

    board: list[Sockets]


def read_sockets(root: Path) -> dict[str, Sockets]:
    """The sockets of each board."""
    return {board.name: board for board in read_toml(root / SOCKETS, SocketsFile).board}


def pin_of(text: str) -> tuple[int, int]:
    """Port and number of a pin, as PE14 is (4, 14)."""
    return ord(text[1]) - ord("A"), int(text[2:])


def stated(text: str) -> tuple[list[str], list[str]]:
    """The outputs and the levels of a pin table."""
    outputs = [
        f"P{port}{number} {timer}_{channel}"
        for port, number, timer, channel in OUTPUT_LINE.findall(text)
    ]
    levels = [
        f"P{port}{number} {'high' if high == 'true' else 'low'}"
        for port, number, high in LEVEL_LINE.findall(text)
    ]
    return outputs, levels


def socket_differences(root: Path) -> Iterator[tuple[str, int, list[str]]]:
    """Each pin table, how much of it was compared, and what is not as others say. The order of
    levels means nothing, that of outputs is that of the motors."""
    known = read_sockets(root)
    for path in sorted(root.glob(PINS)):
        where = path.relative_to(root).as_posix()
        board = known.pop(path.parent.name, None)
        if board is None:
            yield where, 0, [f"{where}: {SOCKETS} does not have this board"]
            continue
        text = read_text(path)
        outputs, levels = stated(text)
        wrong = []
        mounted = [[int(axis) for axis in found] for found in MOUNTING_LINE.findall(text)]
        if mounted != [board.mounting]:
            wrong.append(f"{where}: mounting {mounted}; {SOCKETS} has {board.mounting}")
        if outputs != board.outputs:
            wrong.append(
                f"{where}: outputs {', '.join(outputs)}; {SOCKETS} has {', '.join(board.outputs)}"
            )
        if sorted(levels) != sorted(board.levels):
            wrong.append(
                f"{where}: levels {', '.join(sorted(levels))}; {SOCKETS} has "
                f"{', '.join(sorted(board.levels))}"
            )
        armed = [f"P{port}{number}" for port, number in ARMED_LINE.findall(text)]
        if armed != ([board.armed] if board.armed else []):
            wrong.append(f"{where}: armed {', '.join(armed)}; {SOCKETS} has {board.armed}")
        yield where, len(outputs) + len(levels) + len(mounted) + len(armed), wrong
    for name in known:
        yield SOCKETS, 0, [f"{SOCKETS}: {name}: there is no bsp/{name}/pins.c"]
