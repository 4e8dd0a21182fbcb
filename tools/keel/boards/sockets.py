# SPDX-License-Identifier: Apache-2.0
"""What others say of a board's sockets (specs/outputs.toml), and what its pin table says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from keel.base.files import read_text
from keel.boards.board import BOARD_FILE, BoardFile, board_names
from keel.config import Table, Text, read_toml

SOCKETS = "specs/outputs.toml"
TABLE = "keel_board_pins = {"  # The beginning of a board's pin table.
OUTPUT_LINE = re.compile(r"KEEL_OUTPUT\((\w), (\d+)u, \d+u, (\w+), (\w+)\)")
AXES = r"(-?\d), (-?\d), (-?\d)\)"
INERTIAL_LINE = re.compile(r"KEEL_INERTIAL(?:_PAIR)?\((\w+), ((?:\w, \d+u, )+)" + AXES)
MAGNETOMETER_LINE = re.compile(r"KEEL_MAGNETOMETER\(" + AXES)
UART_LINE = re.compile(r"\[KEEL_LINE_(\w+)\] = \{KEEL_UART\((\w+),")
ARMED_LINE = re.compile(r"KEEL_ARMED\((\w), (\d+)u\)")
SAFETY_LINE = re.compile(r"KEEL_SAFETY\((\w), (\d+)u, (\w), (\d+)u\)")
PPM_LINE = re.compile(r"KEEL_PPM\((\w), (\d+)u, \d+u, (\w+), (\w+)\)")
BUZZER_LINE = re.compile(r"KEEL_BUZZER\((\w), (\d+)u, \d+u, (\w+), (\w+)\)")
LEVEL_LINE = re.compile(r"KEEL_LEVEL\((\w), (\d+)u, (true|false)\)")


class Sockets(Table):
    """The sockets of a board."""

    name: Text
    source: Text
    inertial: list[Text]
    outputs: list[Text]
    levels: list[Text]
    magnetometer: Text | None = None
    lines: list[Text] = []
    armed: Text | None = None
    safety: Text | None = None
    ppm: Text | None = None
    buzzer: Text | None = None

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


def pins_in(text: str) -> list[str]:
    """Pins as PE14, of letters and numbers as a pin table has them."""
    return [f"P{port}{number}" for port, number in re.findall(r"(\w), (\d+)u", text)]


def channels_in(line: re.Pattern[str], text: str) -> list[str]:
    """Pins with their timers' channels."""
    return [f"P{port}{number} {timer}_{name}" for port, number, timer, name in line.findall(text)]


def stated(text: str) -> dict[str, list[str]]:
    """What a pin table says, by the names of specs/outputs.toml."""
    return {
        "inertial": [
            " ".join([kind, *pins_in(pins), *axes])
            for kind, pins, *axes in INERTIAL_LINE.findall(text)
        ],
        "outputs": channels_in(OUTPUT_LINE, text),
        "levels": sorted(
            f"P{port}{number} {'high' if high == 'true' else 'low'}"
            for port, number, high in LEVEL_LINE.findall(text)
        ),
        "magnetometer": [" ".join(axes) for axes in MAGNETOMETER_LINE.findall(text)],
        "lines": [" ".join(line) for line in UART_LINE.findall(text)],
        "armed": [f"P{port}{number}" for port, number in ARMED_LINE.findall(text)],
        "safety": [
            f"P{port}{number} P{other}{another}"
            for port, number, other, another in SAFETY_LINE.findall(text)
        ],
        "ppm": channels_in(PPM_LINE, text),
        "buzzer": channels_in(BUZZER_LINE, text),
    }


def expected(board: Sockets) -> dict[str, list[str]]:
    """The same, as others say it. The order of levels means nothing, that of outputs is that of the
    motors."""
    return {
        "inertial": board.inertial,
        "outputs": board.outputs,
        "levels": sorted(board.levels),
        "magnetometer": [board.magnetometer] if board.magnetometer else [],
        "lines": board.lines,
        "armed": [board.armed] if board.armed else [],
        "safety": [board.safety] if board.safety else [],
        "ppm": [board.ppm] if board.ppm else [],
        "buzzer": [board.buzzer] if board.buzzer else [],
    }


def tables(root: Path) -> Iterator[tuple[str, list[Path]]]:
    """The boards with a pin table, with the files of their own: boards may share one."""
    for name in board_names(root):
        own = read_toml(root / f"bsp/{name}/{BOARD_FILE}", BoardFile).sources
        paths = [
            path
            for source in own
            for path in (sorted((root / source).glob("*.c")) or [root / source])
        ]
        if any(path.suffix == ".c" and TABLE in read_text(path) for path in paths):
            yield name, paths


def socket_differences(root: Path) -> Iterator[tuple[str, int, list[str]]]:
    """Each board with a pin table, how much of it was compared, and what is not as others say."""
    known = read_sockets(root)
    for name, paths in tables(root):
        where = f"bsp/{name}"
        board = known.pop(name, None)
        if board is None:
            yield where, 0, [f"{where}: {SOCKETS} does not have this board"]
            continue
        others, own = expected(board), stated("".join(map(read_text, paths)))
        wrong = [
            f"{where}: {key} {', '.join(own[key])}; {SOCKETS} has {', '.join(others[key])}"
            for key in others
            if own[key] != others[key]
        ]
        yield where, sum(map(len, own.values())), wrong
    for name in known:
        yield SOCKETS, 0, [f"{SOCKETS}: {name}: there is no such board with a pin table"]
