# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel px4: the container, and uploads to a simulated boot loader at a terminal.

The simulation is written from the description of the protocol, not from the uploader; its checksum
goes bit by bit.
"""

from __future__ import annotations

import base64
import contextlib
import io
import json
import os
import pty
import select
import tempfile
import threading
import tty
import unittest
import zlib
from pathlib import Path

from keel.boards import px4
from keel.boards.px4 import Container, Px4Error
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

IMAGE = bytes(range(256)) * 5 + b"\x01\x02\x03"  # Several commands, and not whole words.


def crc(data: bytes) -> int:
    """CRC-32 with the polynomial 0xEDB88320, bit by bit, beginning with 0 and ending as it is."""
    state = 0
    for byte in data:
        state ^= byte
        for _ in range(8):
            state = (state >> 1) ^ (0xEDB88320 if state & 1 else 0)
    return state


class Simulation:
    """A boot loader at the other end of a pseudo-terminal, with what can go wrong."""

    def __init__(self) -> None:
        self.flash = bytearray(4096)
        self.flash[:] = b"\x55" * len(self.flash)
        self.at = -1  # Nothing can be written before the flash was erased.
        self.board_id = 50
        self.revision = 5
        self.erase_status = 0x10
        self.breaks_at = -1  # The flash keeps another byte than was written here.
        self.silent_after = -1  # It answers no more after so many commands.
        self.noise = b""  # What it says first.
        self.booted = False
        self.answers_boot = True
        self.commands: list[int] = []
        self._ours, self._theirs = pty.openpty()
        tty.setraw(self._ours)
        tty.setraw(self._theirs)
        self.name = os.ttyname(self._theirs)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self) -> Simulation:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stop.set()
        self._thread.join()
        os.close(self._ours)
        os.close(self._theirs)

    def _byte(self) -> int:
        while not self._stop.is_set():
            if select.select([self._ours], [], [], 0.02)[0]:
                return os.read(self._ours, 1)[0]
        raise InterruptedError

    def _answer(self, data: bytes, status: int = 0x10) -> None:
        if self.silent_after < 0 or len(self.commands) <= self.silent_after:
            os.write(self._ours, data + bytes([0x12, status]))

    def _run(self) -> None:
        os.write(self._ours, self.noise)
        with contextlib.suppress(InterruptedError):
            while True:
                self._command(self._byte())

    def _ends(self) -> bool:
        """A command must end with its last byte, or it is invalid."""
        good = self._byte() == 0x20
        if not good:
            self._answer(b"", 0x13)
        return good

    def _command(self, code: int) -> None:
        self.commands.append(code)
        if code == 0x27:
            length = self._byte()
            data = bytes(self._byte() for _ in range(length))
            if self._ends():
                self._program(data)
        elif code == 0x22:
            what = self._byte()
            if self._ends():
                numbers = {1: self.revision, 2: self.board_id, 3: 0, 4: len(self.flash)}
                self._answer(numbers[what].to_bytes(4, "little"))
        elif self._ends():
            self._simple(code)

    def _simple(self, code: int) -> None:
        if code == 0x21:
            self._answer(b"")
        elif code == 0x23:
            self.flash[:] = b"\xff" * len(self.flash)
            self.at = 0
            self._answer(b"", self.erase_status)
        elif code == 0x29:
            self._answer(crc(bytes(self.flash)).to_bytes(4, "little"))
        elif code == 0x30:
            self.booted = True
            if self.answers_boot:
                self._answer(b"")
        else:
            self._answer(b"", 0x13)

    def _program(self, data: bytes) -> None:
        if len(data) % 4 or self.at < 0 or self.at + len(data) > len(self.flash):
            self._answer(b"", 0x11)
            return
        self.flash[self.at : self.at + len(data)] = data
        if self.at <= self.breaks_at < self.at + len(data):
            self.flash[self.breaks_at] ^= 1
        self.at += len(data)
        self._answer(b"")


class ContainerTest(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        self.path = self.folder / "image.px4"

    def test_what_other_programs_read(self) -> None:
        Container(50, IMAGE).write(self.path)
        raw = json.loads(self.path.read_text())
        self.assertEqual(raw["magic"], "PX4FWv1")
        self.assertEqual(raw["board_id"], 50)
        self.assertEqual(raw["image_size"], 1283)
        self.assertEqual(raw["image_maxsize"], 1283)  # Uploaders want a number.
        self.assertEqual(zlib.decompress(base64.b64decode(raw["image"])), IMAGE)

    def test_the_same_image_makes_the_same_container(self) -> None:
        self.assertEqual(Container(50, IMAGE).text(), Container(50, IMAGE).text())

    def test_round_trip(self) -> None:
        Container(50, IMAGE, "Keel", 4096).write(self.path)
        self.assertEqual(Container.read(self.path), Container(50, IMAGE, "Keel", 4096))

    def test_whole_words_with_ones(self) -> None:
        self.assertEqual(Container(50, b"\x01\x02\x03\x04\x05").padded[4:], b"\x05\xff\xff\xff")
        self.assertEqual(Container(50, b"\x01\x02\x03\x04").padded, b"\x01\x02\x03\x04")

    def refuses(self, text: str, reason: str) -> None:
        self.path.write_text(text)
        with self.assertRaisesRegex(Px4Error, reason):
            Container.read(self.path)

    def test_what_is_no_container_is_refused(self) -> None:
        good = json.loads(Container(50, IMAGE).text())
        self.refuses("no JSON", "no container")
        self.refuses("[1]", "no container")
        self.refuses(json.dumps({**good, "magic": "other"}), "magic word")
        self.refuses(json.dumps({**good, "image": "!"}), "no container")
        self.refuses(json.dumps({**good, "image": base64.b64encode(b"x").decode()}), "no container")
        self.refuses(json.dumps({**good, "image_size": 1}), "not 1 as it says")
        del good["board_id"]
        self.refuses(json.dumps(good), "no container")

    def test_pack_from_the_command_line(self) -> None:
        (self.folder / "keel.bin").write_bytes(IMAGE)
        words = ["pack", str(self.folder / "keel.bin"), str(self.path), "--board-id", "50"]
        with contextlib.redirect_stdout(io.StringIO()) as out:
            self.assertEqual(px4.main(words), 0)
        self.assertIn("1283 bytes for board 50", out.getvalue())
        self.assertEqual(Container.read(self.path).image, IMAGE)


class ChecksumTest(unittest.TestCase):
    def test_it_is_the_boot_loaders(self) -> None:
        for size in (0, 1, 4, 1283, 3000):
            padded = IMAGE[:size] + b"\xff" * (3000 - min(size, len(IMAGE)))
            self.assertEqual(px4.checksum(IMAGE[:size], 3000), crc(padded), size)

    def test_a_known_value(self) -> None:
        # The check value of CRC-32/JAMCRC is for a start with ones; with zeros, by hand for one
        # byte 0x01: eight shifts of 0x01 are 0x77073096, the second entry of every CRC-32 table.
        self.assertEqual(px4.checksum(b"\x01", 1), 0x77073096)


class UploadTest(unittest.TestCase):
    tools: Toolchain

    @classmethod
    def setUpClass(cls) -> None:
        cls.tools = Toolchain()
        cls.tools.ensure("flash-px4")

    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        self.path = self.folder / "image.px4"
        Container(50, IMAGE).write(self.path)
        self.board = Simulation()
        self.said: list[str] = []

    def upload(self) -> None:
        with self.board:
            px4.upload(self.tools, self.path, self.board.name, 1.0, self.said.append)

    def fails(self, reason: str) -> None:
        with self.assertRaisesRegex(Px4Error, reason):
            self.upload()
        self.assertFalse(self.board.booted)

    def test_the_image_is_written_and_started(self) -> None:
        self.upload()
        self.assertEqual(bytes(self.board.flash[:1284]), IMAGE + b"\xff")
        self.assertEqual(bytes(self.board.flash[1284:]), b"\xff" * (4096 - 1284))
        self.assertTrue(self.board.booted)
        self.assertIn("  100 % written", self.said)

    def test_it_finds_the_beginning_of_a_command(self) -> None:
        self.board.noise = b"\x12\x13garbage"
        self.upload()
        self.assertTrue(self.board.booted)

    def test_another_board_is_left_alone(self) -> None:
        self.board.board_id = 9
        self.fails("board's id is 9, the image is for 50")
        self.assertNotIn(0x23, self.board.commands)

    def test_an_unknown_protocol_is_left_alone(self) -> None:
        self.board.revision = 6
        self.fails("revision 6")
        self.assertNotIn(0x23, self.board.commands)

    def test_an_image_that_is_too_large_is_not_begun(self) -> None:
        self.board.flash = self.board.flash[:1280]
        self.fails("has 1284 bytes, the flash 1280")
        self.assertNotIn(0x23, self.board.commands)

    def test_an_erase_that_fails(self) -> None:
        self.board.erase_status = 0x11
        self.fails("failed .command 0x23")
        self.assertNotIn(0x27, self.board.commands)

    def test_a_flash_that_keeps_something_else_is_noticed(self) -> None:
        self.board.breaks_at = 700
        self.fails("flash does not hold the image")

    def test_a_boot_loader_that_falls_silent(self) -> None:
        self.board.silent_after = 7  # In the middle of programming.
        self.fails("does not answer: 0 of 2 bytes")

    def test_a_board_that_starts_without_a_word_is_written_all_the_same(self) -> None:
        self.board.answers_boot = False
        self.upload()
        self.assertTrue(self.board.booted)
        self.assertTrue(any("did not confirm" in line for line in self.said))

    def test_no_board_says_what_to_check(self) -> None:
        with self.assertRaisesRegex(Px4Error, "no such port.*Check that.*USB.*reset the board"):
            px4.upload(self.tools, self.path, str(self.folder / "tty"), 0.1, self.said.append)

    def test_a_port_without_a_boot_loader(self) -> None:
        self.board.silent_after = 0
        with self.assertRaisesRegex(Px4Error, "no boot loader within 1 s .*does not answer"):
            self.upload()

    def test_the_command_line(self) -> None:
        words = ["upload", str(self.path), "--port", self.board.name, "--wait", "1"]
        with contextlib.redirect_stdout(io.StringIO()) as out, self.board:
            self.assertEqual(px4.main(words), 0)
        self.assertIn("checksum of the flash is that of the image", out.getvalue())
        with contextlib.redirect_stderr(io.StringIO()) as err:
            self.assertEqual(px4.main(["upload", str(self.folder / "none")]), 2)
        self.assertIn("px4:", err.getvalue())
