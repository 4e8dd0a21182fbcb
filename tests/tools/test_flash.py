# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel flash: it says that an image was written only when a tool has verified it.

Debug probes and their tools are small scripts that say what the real ones say.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import shutil
import tempfile
import unittest
from pathlib import Path
from typing import cast
from unittest import mock

from keel.base.errors import ToolError
from keel.boards import flash, px4
from keel.boards.built import FIRMWARE
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]


class Tools:
    """Takes the place of the toolchain: every command is a script of the test's own."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.ensured: list[str] = []

    def ensure(self, *groups: str) -> None:
        self.ensured += groups

    def command(self, tool: str) -> list[str]:
        return [str(self.folder / tool)]

    def script(self, name: str, says: str, status: int = 0) -> None:
        path = self.folder / name
        path.write_text(
            f'#!/bin/sh\necho "$0 $@" >> {self.folder}/ran\n'
            f"cat <<'END'\n{says}\nEND\nexit {status}\n"
        )
        path.chmod(0o755)

    @property
    def ran(self) -> list[str]:
        path = self.folder / "ran"
        return path.read_text().splitlines() if path.exists() else []


class FlashTest(unittest.TestCase):
    def setUp(self) -> None:
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        for board in ("nucleo_f767zi", "fmuv5"):
            (self.root / "bsp" / board).mkdir(parents=True)
            shutil.copy(ROOT / f"bsp/{board}/flash.toml", self.root / f"bsp/{board}/flash.toml")
        (self.root / "bin").mkdir()
        self.tools = Tools(self.root / "bin")
        self.image("nucleo_f767zi", 0x0800_0000)
        self.image("fmuv5", 0x0800_8000)

    def image(self, board: str, address: int) -> None:
        folder = self.root / FIRMWARE / board
        folder.mkdir(parents=True)
        report: dict[str, object] = {
            "load_address": address,
            "regions": {"FLASH": {"size": 0x1F8000}},
            "sources": {},
            "objects": {},
        }
        for kind, name, data in (("elf", "keel.elf", b"elf"), ("binary", "keel.bin", b"12345678")):
            (folder / name).write_bytes(data)
            report[kind] = {"file": name, "sha256": hashlib.sha256(data).hexdigest()}
        (folder / "report.json").write_text(json.dumps(report))

    def flash(self, board: str = "nucleo_f767zi", tool: str = "") -> str:
        with contextlib.redirect_stdout(io.StringIO()):
            return flash.flash(cast(Toolchain, self.tools), self.root, board, tool)

    def fails(self, reason: str, board: str = "nucleo_f767zi", tool: str = "") -> None:
        with self.assertRaisesRegex(ToolError, reason):
            self.flash(board, tool)
        self.assertFalse((self.root / flash.REPORT).exists())

    def test_openocd_is_the_default_and_verifies(self) -> None:
        self.tools.script("openocd", "** Programming Finished **\n** Verified OK **")
        line = self.flash()
        self.assertRegex(line, "8 bytes at 0x08000000 written with openocd and verified")
        self.assertEqual(self.tools.ensured, ["flash-openocd"])
        self.assertRegex(
            self.tools.ran[0], "-f board/st_nucleo_f7.cfg -c program .*keel.elf verify reset exit"
        )
        report = json.loads((self.root / flash.REPORT).read_text())
        self.assertEqual(report["verified"], "** Verified OK")
        self.assertEqual(report["binary_sha256"], hashlib.sha256(b"12345678").hexdigest())

    def test_a_good_exit_status_alone_is_not_believed(self) -> None:
        self.tools.script("openocd", "** Programming Finished **")
        self.fails("ends without having verified")
        self.tools.script("st-flash", "Flash written")
        self.fails("ends without having verified", tool="st-flash")

    def test_verified_words_of_a_failed_run_are_not_believed(self) -> None:
        self.tools.script("openocd", "** Verified OK **\nError: reset failed", 1)
        self.fails("openocd fails .exit status 1.*\n.*Verified")

    def test_without_a_probe_it_says_what_to_check(self) -> None:
        for tool, words, status in (
            ("openocd", "Error: open failed\n** OpenOCD init failed **", 0),
            ("st-flash", "WARN usb.c: Couldn't find any ST-Link devices", 255),
            ("pyocd", "No connected debug probes", 1),
        ):
            self.tools.script(tool, words, status)
            self.fails(f"(?s){tool} finds no board.*Check that the board is connected", tool=tool)

    def test_st_flash_writes_the_binary_to_its_address(self) -> None:
        self.tools.script("st-flash", "INFO common.c: Flash written and verified! jolly good!")
        self.flash(tool="st-flash")
        self.assertRegex(self.tools.ran[0], "--reset write .*/keel.bin 0x08000000$")

    def test_pyocd_compares_what_it_wrote(self) -> None:
        self.tools.script("pyocd", "All 8 bytes match.")
        self.flash(tool="pyocd")
        self.assertEqual(
            [line.split()[1] for line in self.tools.ran], ["load", "commander", "reset"]
        )
        self.assertIn("compare 0x08000000", self.tools.ran[1])

    def test_pyocd_that_finds_a_difference(self) -> None:
        self.tools.script("pyocd", "Mismatched byte at 0x08000004")
        self.fails("ends without having verified", tool="pyocd")
        self.assertEqual(len(self.tools.ran), 2)

    def test_a_boot_loader_gets_a_container_for_its_board(self) -> None:
        with mock.patch.object(px4, "upload") as upload:
            line = self.flash("fmuv5")
        self.assertRegex(line, "0x08008000 written with px4 and verified .checksum")
        container = px4.Container.read(upload.call_args.args[1])
        self.assertEqual((container.board_id, container.image), (50, b"12345678"))
        self.assertEqual(container.room, 2064384)

    def test_a_boot_loader_that_fails(self) -> None:
        with (
            mock.patch.object(px4, "upload", side_effect=px4.Px4Error("checksum")),
            self.assertRaisesRegex(px4.Px4Error, "checksum"),
        ):
            self.flash("fmuv5")
        self.assertFalse((self.root / flash.REPORT).exists())

    def test_the_image_must_be_what_its_report_says(self) -> None:
        (self.root / FIRMWARE / "nucleo_f767zi/keel.bin").write_bytes(b"other")
        self.fails("not what its report says; run: make firmware BOARD=nucleo_f767zi")
        shutil.rmtree(self.root / FIRMWARE)
        self.fails("no whole image of nucleo_f767zi .*; run: make firmware")
        self.assertEqual(self.tools.ran, [])

    def test_unknown_boards_and_tools(self) -> None:
        told = "did you mean nucleo_f767zi\\? .boards: fmuv5, nucleo_f767zi"
        with self.assertRaisesRegex(ToolError, told):
            self.flash("nucleo")
        self.fails("cannot be written with px4; with: openocd, pyocd, st-flash", tool="px4")

    def board_file_fails(self, text: str, reason: str) -> None:
        (self.root / "bsp/fmuv5/flash.toml").write_text(text)
        self.fails(reason, "fmuv5")

    def test_a_bad_board_file(self) -> None:
        self.board_file_fails("tools = 3", "toml:1: tools: expected to be a valid list, found 3")
        self.board_file_fails('tools = ["dfu"]', "toml:1: tools number 1: .*'st-flash' or 'px4'")
        self.board_file_fails("tools = []", "toml:1: tools: .* at least 1 item")
        self.board_file_fails('tools = ["px4"]', "toml:1: tools number 1: px4 needs board_id")
        self.board_file_fails('tools = ["st-flash"]\nspeed = 1', "toml:2: speed: unknown key")
        self.board_file_fails("tools = [", "bsp/fmuv5/flash.toml:1: no TOML: ")

    def test_exit_statuses(self) -> None:
        with contextlib.redirect_stderr(io.StringIO()) as err:
            self.assertEqual(flash.main(["none"], self.root), 2)
            shutil.rmtree(self.root / FIRMWARE)
            self.assertEqual(flash.main(["nucleo_f767zi"], self.root), 2)
        self.assertIn("flash: NOT written: there is no whole image", err.getvalue())
