# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel firmware: what it reads of a board, what it checks in an image, and that an
image does not depend on the folder it was built in.
"""

from __future__ import annotations

import contextlib
import io
import json
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from keel.base.build import source_files
from keel.base.errors import ToolError
from keel.boards import firmware
from keel.boards.board import Board, Place, Region, application_of, read_board
from keel.boards.elf import Contents, Section, Symbol
from keel.boards.placement import check_image, usage

ROOT = Path(__file__).resolve().parents[2]

GOOD = """\
description = "a board"
linker_script = "bsp/toy/toy.ld"
sources = ["bsp/toy"]
application = ["app"]
load_address = 0x8000

[[region]]
name = "FLASH"
origin = 0x8000
size = 0x1000

[[region]]
name = "RAM"
origin = 0x20000000
size = 0x100

[[place]]
region = "FLASH"
sections = [".text"]
"""

BASE = """\
sources = ["src"]
application = ["app"]
[[region]]
name = "FLASH"
origin = 0
size = 0x2000

[[region]]
name = "RAM"
origin = 0x20000000
size = 0x100

[[place]]
region = "RAM"
sections = [".data"]
"""

OWN = """\
base = "bsp/chip/chip.toml"
description = "a board"
linker_script = "bsp/toy/toy.ld"
sources = ["bsp/toy"]
load_address = 0x8000

[[region]]
name = "FLASH"
origin = 0x8000
size = 0x1000

[[place]]
region = "FLASH"
sections = [".text"]
"""

FLASH = Region(name="FLASH", origin=0x8000, size=0x1000)
RAM = Region(name="RAM", origin=0x2000_0000, size=0x100)


def toy(*places: Place) -> Board:
    """A board with two memories."""
    text = Place(region="FLASH", sections=[".text"])
    return Board(
        name="toy",
        description="a board",
        linker_script="toy.ld",
        sources=[],
        application=[],
        load_address=0x8000,
        region=[FLASH, RAM],
        place=[*places] or [text],
    )


def image(*sections: Section, symbols: tuple[Symbol, ...] = (), entry: int = 0x8001) -> Contents:
    """An image whose entry is a function at the start of .text."""
    start = Symbol("start", 0x8000, 4, True, ".text", "")
    return Contents(entry, list(sections), [start, *symbols])


TEXT = Section(".text", 0x8000, 0x80, 0x8000)
DATA = Section(".data", 0x2000_0000, 0x10, 0x8080)


def wrong(board: Board, contents: Contents) -> list[str]:
    """What the checks find."""
    checks = check_image(board, contents, {})
    return [f"{check.what}: {check.wrong}" for check in checks if check.wrong]


class Folder(unittest.TestCase):
    """A test with a root of its own."""

    def setUp(self) -> None:
        self._temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self._temporary.cleanup)
        self.root = Path(self._temporary.name)

    def write(self, name: str, text: str = "") -> Path:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path


class Reading(Folder):
    """A test that reads a board's file."""

    def read(self, text: str) -> Board:
        self.write("bsp/toy/board.toml", text)
        self.write("bsp/toy/toy.ld")
        return read_board(self.root, "toy")

    def refused(self, text: str, reason: str) -> None:
        with self.assertRaises(ToolError) as caught:
            self.read(text)
        self.assertIn(f"bsp/toy/board.toml:{reason}", str(caught.exception))


class BoardFile(Reading):
    """What a board's file may say."""

    def test_a_whole_file(self) -> None:
        board = self.read(GOOD)
        self.assertEqual((board.name, board.load_address), ("toy", 0x8000))
        self.assertEqual(board.region, [FLASH, RAM])
        self.assertEqual(board.place, [Place(region="FLASH", sections=[".text"])])

    def test_an_unknown_board_names_those_that_there_are(self) -> None:
        self.read(GOOD)
        with self.assertRaises(ToolError) as caught:
            read_board(self.root, "toi")
        told = "there is no board toi; did you mean toy? (boards: toy)"
        self.assertIn(told, str(caught.exception))

    def test_an_unknown_board_on_the_command_line(self) -> None:
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertEqual(firmware.main(["nothing"], ROOT), 2)
        self.assertIn("mps2_an500", said.getvalue())

    def test_an_unknown_key(self) -> None:
        self.refused("colour = 'red'\n" + GOOD, "1: colour: unknown key")

    def test_an_unknown_key_of_a_region(self) -> None:
        text = GOOD.replace("size = 0x100\n", "size = 0x100\nlength = 1\n")
        self.refused(text, "16: region RAM: length: unknown key")

    def test_a_missing_key(self) -> None:
        self.refused(GOOD.replace("load_address = 0x8000\n", ""), "1: load_address: is missing")

    def test_a_wrong_type(self) -> None:
        text = GOOD.replace("= 0x8000\n", "= 'here'\n", 1)
        self.refused(text, "5: load_address: expected to be a valid integer")

    def test_a_number_beyond_32_bits(self) -> None:
        text = GOOD.replace("0x20000000", "0x100000000")
        self.refused(text, "14: region RAM: origin: expected to be less than or")

    def test_a_place_in_no_region(self) -> None:
        text = GOOD.replace('[[place]]\nregion = "FLASH"', '[[place]]\nregion = "ROM"')
        self.refused(text, "18: place number 1: region: there is no region ROM")

    def test_a_place_of_two_kinds(self) -> None:
        kinds = "17: place number 1: one of sections, symbols and code_of"
        self.refused(GOOD + "symbols = ['x']\n", kinds)

    def test_a_missing_linker_script(self) -> None:
        text = GOOD.replace("toy.ld", "other.ld")
        self.refused(text, "2: linker_script: there is no bsp/toy/other.ld")

    def test_no_toml(self) -> None:
        self.refused("= 3", "1: no TOML: ")

    def test_a_list_that_is_missing(self) -> None:
        self.refused(GOOD.replace('sources = ["bsp/toy"]\n', ""), "1: sources: is missing")
        self.refused(GOOD[: GOOD.index("[[place]]")], "1: place: is missing")


class Bases(Reading):
    """What a board's file takes from its base."""

    def shared(self, text: str) -> None:
        self.write("bsp/chip/chip.toml", text)

    def test_lists_are_joined_and_regions_replaced_by_name(self) -> None:
        self.shared(BASE)
        board = self.read(OWN)
        self.assertEqual(board.sources, ["src", "bsp/toy"])
        self.assertEqual(board.application, ["app"])
        own = Region(name="FLASH", origin=0x8000, size=0x1000)
        self.assertEqual(board.region, [own, RAM])
        self.assertEqual([place.region for place in board.place], ["RAM", "FLASH"])

    def test_named_applications(self) -> None:
        self.shared(BASE + '[[named]]\nname = "other"\napplication = ["a", "b"]\n')
        board = self.read(OWN)
        self.assertEqual(application_of(board, "other").application, ["a", "b"])
        with self.assertRaisesRegex(ToolError, "there is no application othr; did you mean other"):
            application_of(board, "othr")

    def test_a_missing_base(self) -> None:
        self.refused(OWN, "1: base: there is no bsp/chip/chip.toml")

    def test_a_mistake_of_the_base_is_told_of_the_base(self) -> None:
        for old, new, told in (
            ('region = "RAM"', 'region = "ROM"', "14: place number 1: region: there is no region"),
            ('["src"]', "[3]", "1: sources number 1: expected to be a valid string"),
            ("sources", "load_address = 1\nsources", "1: load_address: unknown key"),
        ):
            self.shared(BASE.replace(old, new))
            with self.assertRaisesRegex(ToolError, f"bsp/chip/chip.toml:{told}"):
                self.read(OWN)


class Sources(Folder):
    """Files and folders of sources."""

    def test_files_and_folders_each_once(self) -> None:
        for name in ("a/b.c", "a/sub/c.S", "a/a.h", "d.c"):
            self.write(name)
        found = source_files(["d.c", "a", "a/b.c"], self.root)
        self.assertEqual(found, ["d.c", "a/b.c", "a/sub/c.S"])

    def test_nothing_there(self) -> None:
        with self.assertRaisesRegex(ToolError, "no source file x"):
            source_files(["x"], self.root)


class Checks(unittest.TestCase):
    """What is found in an image that is not as its board asks."""

    def test_a_good_image(self) -> None:
        self.assertEqual(wrong(toy(), image(TEXT, DATA)), [])

    def test_a_section_across_the_end_of_its_region(self) -> None:
        large = Section(".bss", 0x2000_00F8, 9, None)
        self.assertEqual(
            wrong(toy(), image(TEXT, large)), ["section .bss: 9 bytes lie in no region"]
        )

    def test_a_section_up_to_the_end_of_its_region(self) -> None:
        self.assertEqual(wrong(toy(), image(TEXT, Section(".bss", 0x2000_00F8, 8, None))), [])

    def test_a_section_loaded_nowhere(self) -> None:
        lost = Section(".data", 0x2000_0000, 4, 0x9000)
        self.assertEqual(
            wrong(toy(), image(TEXT, lost)), ["load of .data: 4 bytes are loaded into no region"]
        )

    def test_sections_that_overlap_at_run_time(self) -> None:
        second = Section(".more", 0x807F, 4, 0x8100)
        self.assertEqual(wrong(toy(), image(TEXT, second)), [".more: overlaps .text"])

    def test_sections_that_overlap_in_the_image(self) -> None:
        second = Section(".data", 0x2000_0000, 4, 0x807F)
        self.assertEqual(wrong(toy(), image(TEXT, second)), ["load of .data: overlaps .text"])

    def test_an_image_that_begins_elsewhere(self) -> None:
        moved = Section(".text", 0x8000, 0x80, 0x8004)
        self.assertEqual(
            wrong(toy(), image(moved)), ["load address: the image begins at 0x00008004"]
        )

    def test_an_entry_that_is_no_function(self) -> None:
        self.assertEqual(wrong(toy(), image(TEXT, entry=0x8011)), ["entry: is no Thumb function"])

    def test_an_entry_without_the_thumb_bit(self) -> None:
        self.assertEqual(wrong(toy(), image(TEXT, entry=0x8000)), ["entry: is no Thumb function"])

    def test_a_symbol_elsewhere(self) -> None:
        place = Place(region="RAM", symbols=["hot_*"])
        hot = Symbol("hot_loop", 0x8010, 8, True, ".text", "")
        self.assertEqual(
            wrong(toy(place), image(TEXT, symbols=(hot,))),
            ["symbol hot_*: hot_loop: lies elsewhere"],
        )

    def test_a_symbol_half_outside(self) -> None:
        place = Place(region="RAM", symbols=["table"])
        table = Symbol("table", 0x2000_00FC, 8, False, ".bss", "")
        self.assertEqual(
            wrong(toy(place), image(TEXT, symbols=(table,))), ["symbol table: lies elsewhere"]
        )

    def test_a_name_that_matches_nothing(self) -> None:
        place = Place(region="RAM", symbols=["cold"])
        self.assertEqual(
            wrong(toy(place), image(TEXT)), ["symbol cold: the image holds no such thing"]
        )

    def test_a_name_that_may_match_nothing(self) -> None:
        place = Place(region="RAM", symbols=["cold"], optional=True)
        self.assertEqual(wrong(toy(place), image(TEXT)), [])

    def test_a_load_address_elsewhere(self) -> None:
        place = Place(region="RAM", load="FLASH", sections=[".data"])
        unloaded = Section(".data", 0x2000_0000, 4, None)
        self.assertEqual(
            wrong(toy(place), image(TEXT, unloaded)), ["load of section .data: lies elsewhere"]
        )

    def test_code_that_may_lie_elsewhere(self) -> None:
        """All functions of a file but some, by a pattern."""
        (source,) = source_files(["bsp/console.c"], ROOT)
        inits = Symbol("x_init", 0x8040, 8, True, ".text", "")
        step = Symbol("x_step", 0x2000_0000, 8, True, ".fast", "")
        fast = Section(".fast", 0x2000_0000, 8, None)
        whole = image(TEXT, fast, symbols=(inits, step))
        for but, found in (([], ["x_init: lies elsewhere"]), (["*_init"], [])):
            place = Place(region="RAM", code_of=[source], but=but)
            checks = check_image(toy(place), whole, {source: image(TEXT, symbols=(inits, step))})
            bad = [
                f"{check.what.rpartition(': ')[2]}: {check.wrong}"
                for check in checks
                if check.wrong and "x_" in check.what
            ]
            self.assertEqual(bad, found)

    def test_usage_counts_what_is_copied_twice(self) -> None:
        self.assertEqual(usage(toy(), image(TEXT, DATA)), {"FLASH": 0x90, "RAM": 0x10})


PARTS = ("bsp", "examples", "include", "src")


class Images(Folder):
    """Images that are really built."""

    def build(self, name: str) -> Path:
        """The board's image, built in a folder of that name."""
        root = self.root / name
        for part in PARTS:
            shutil.copytree(ROOT / part, root / part)
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            status = firmware.main(["mps2_an500"], root)
        self.assertEqual(status, 0, said.getvalue())
        return root / "build/firmware/mps2_an500"

    def test_every_image_that_the_documents_name_is_whole(self) -> None:
        root = self.root / "documents"
        for part in PARTS:
            shutil.copytree(ROOT / part, root / part)
        found = [
            [board, *shlex.split(words.replace("\\\n", " "))]
            for path in sorted((ROOT / "docs").glob("*.md"))
            for board, words in re.findall(
                r'^make firmware BOARD=(\w+) ARGS="(--app [^"]*)"', path.read_text(), re.MULTILINE
            )
        ]
        found += [
            [board, "--named", name]
            for path in sorted((ROOT / "docs").glob("*.md"))
            for board, name in re.findall(
                r"^make firmware BOARD=(\w+) APP=(\w+)$", path.read_text(), re.MULTILINE
            )
        ]
        self.assertGreaterEqual(len(found), 4)
        for words in found:
            said = io.StringIO()
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
                status = firmware.main(words, root)
            self.assertEqual(status, 0, f"{words}: {said.getvalue()}")

    def test_two_folders_give_the_same_bits(self) -> None:
        first, second = self.build("one"), self.build("another/and/deeper")
        for file in ("keel.elf", "keel.bin", "report.json"):
            self.assertEqual((first / file).read_bytes(), (second / file).read_bytes(), file)

    def test_what_an_image_consists_of(self) -> None:
        folder = self.build("here")
        report = json.loads((folder / "report.json").read_text())
        self.assertEqual(report["binary"]["size"], (folder / "keel.bin").stat().st_size)
        self.assertIn("src/rtos/scheduler.c", report["sources"])
        self.assertTrue(all(not check["wrong"] for check in report["checks"]))
        placed = {check["what"]: check["region"] for check in report["checks"]}
        places = [
            region
            for what, region in placed.items()
            if re.fullmatch("code of src/rtos, .*: keel_scheduler_step", what)
        ]
        self.assertEqual(places, ["ITCM"])
        stacks = folder / "obj/src/rtos/scheduler.su"
        self.assertIn("keel_scheduler_step", stacks.read_text())
        self.assertTrue(stacks.with_suffix(".ci").is_file())

    def test_code_that_the_script_puts_elsewhere(self) -> None:
        root = self.root / "moved"
        for part in PARTS:
            shutil.copytree(ROOT / part, root / part)
        script = root / "bsp/mps2_an500/mps2_an500.ld"
        script.write_text(script.read_text().replace("*src/rtos/*.o(.text .text.*)", ""))
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertEqual(firmware.main(["mps2_an500"], root), 1)
        self.assertIn("keel_scheduler_step: lies elsewhere", said.getvalue())
        self.assertFalse((root / "build/firmware/mps2_an500/report.json").exists())


class CommandLine(unittest.TestCase):
    """The program as make calls it."""

    def test_a_missing_board(self) -> None:
        command = [sys.executable, str(ROOT / "tools/keel"), "firmware", ""]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("(boards: ", done.stderr)
