# SPDX-License-Identifier: Apache-2.0
"""Tests of the part `object` of the evidence package: each fault is put into a report or an image,
and must show as a problem that names it.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import shutil
import tempfile
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

from evidence_sample import STAMP, PartTest

from keel.base.source import STAMP as MADE_FROM
from keel.boards import firmware
from keel.boards.board import board_names
from keel.boards.rebuilt import SOURCES, differences
from keel.boards.semantics import COMPILED_AS_PROVED, flag_problems
from keel.gather.parts import object as part_object
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

IMAGE = b"image"
FLAGS = [*COMPILED_AS_PROVED, "-O2"]


def firmware_report() -> dict[str, Any]:
    """A small image."""
    digest = hashlib.sha256(IMAGE).hexdigest()
    return {
        "tools": {"arm-none-eabi-gcc": "12.2.1"},
        "flags": FLAGS,
        "link_flags": ["-static"],
        "load_address": 0x8000,
        "sources": {"src/x.c": "0"},
        "checks": [],
        "elf": {"file": "keel.elf", "sha256": digest},
        "binary": {"file": "keel.bin", "sha256": digest, "size": 5},
        "regions": {"FLASH": {"origin": 0x8000, "size": 4096, "used": 5}},
    }


def target_report() -> dict[str, Any]:
    """One unit that was compared."""
    tests = {"differential/queue": "passed"}
    return {"vectors_per_unit": 100000, "suites": {"differential": {"tests": tests}}}


class Object(PartTest):
    """A build folder with good reports, into which each test puts one fault."""

    maker = staticmethod(part_object.make)

    def setUp(self) -> None:
        super().setUp()
        self.write("prove/report.json", {"verdict": "proved"})
        for name in board_names(ROOT):
            self.write(f"firmware/{name}/report.json", firmware_report())
            for file in ("keel.elf", "keel.bin"):
                (self.build / "firmware" / name / file).write_bytes(IMAGE)
        self.write("test-target/report.json", target_report())
        self.same = self.enterContext(mock.patch.object(part_object, "differences"))
        self.same.return_value = []

    def test_good_reports_give_a_part_without_problems(self) -> None:
        part = self.make()
        self.assertEqual(part.problems, ())
        names = [item.id for item in part.items]
        self.assertIn("mps2_an500/keel.elf", names)
        self.assertEqual(len(names), 2 * len(board_names(ROOT)))
        self.assertEqual(part.summary["units with the same bits on host and target"], "1 of 1")

    def test_a_source_that_changed_after_its_proof(self) -> None:
        self.write("prove/report.json", {MADE_FROM: {**STAMP, "product": "older"}})
        told = f"the source built ({STAMP['product'][:12]}) is not the source proved (older)"
        problems = list(self.make().problems)
        self.assertEqual(problems, [f"{name}: {told}" for name in board_names(ROOT)])

    def test_proofs_that_are_missing(self) -> None:
        (self.build / "prove/report.json").unlink()
        told = "build/prove/report.json: does not tell which source was proved"
        self.assertEqual(self.problem(), told)

    def test_images_that_differ(self) -> None:
        self.same.side_effect = lambda tools, root, board, *rest: (
            [f"{board}/keel.bin: another folder gives other bits"] if board == "fmuv5" else []
        )
        self.assertIn("fmuv5/keel.bin: another folder gives other bits", self.problem())

    def test_an_image_that_its_report_does_not_vouch_for(self) -> None:
        (self.build / "firmware/fmuv5/keel.bin").write_bytes(b"imagf")
        self.assertIn("firmware/fmuv5/keel.bin: is not what its report says", self.problem())

    def test_a_flag_that_is_forbidden(self) -> None:
        report = {**firmware_report(), "flags": [*FLAGS, "-ffast-math"]}
        self.write("firmware/fmuv5/report.json", report)
        self.assertIn("fmuv5: the flag -ffast-math is forbidden: changes fl", self.problem())

    def test_host_and_target_that_differ(self) -> None:
        report = target_report()
        report["suites"]["differential"]["tests"]["differential/pid"] = "failed"
        self.write("test-target/report.json", report)
        self.assertEqual(
            self.problem(), "pid: the host's build and the target's give different bits"
        )

    def test_host_and_target_that_were_not_compared(self) -> None:
        self.write("test-target/report.json", {**target_report(), "suites": {}})
        self.assertIn("host and target were not compared", self.problem())

    def test_a_report_of_another_source(self) -> None:
        stamp = {**STAMP, "tree": "other"}
        self.write("firmware/fmuv5/report.json", {**firmware_report(), MADE_FROM: stamp})
        self.assertIn("build/firmware/fmuv5/report.json: speaks of another", self.problem())


class Flags(unittest.TestCase):
    """What flags the proofs bear."""

    def test_the_flags_of_every_board_are_good(self) -> None:
        for flags in ([*FLAGS], [*FLAGS, "-DKEEL_BOARD_INTERRUPTS=32u", "-Ibsp", "-g"]):
            self.assertEqual(list(flag_problems(flags)), [])

    def test_a_flag_that_is_missing(self) -> None:
        for flag in COMPILED_AS_PROVED:
            left = [one for one in FLAGS if one != flag]
            self.assertEqual(len(list(flag_problems(left))), 1, flag)

    def test_flags_that_are_forbidden(self) -> None:
        for flag in (
            "-Ofast",
            "-ffinite-math-only",
            "-ffp-contract=fast",
            "-mcpu=cortex-m4",
            "-mfpu=fpv4-sp-d16",
            "-fno-short-enums",
            "-fsigned-char",
            "-std=gnu99",
            "-DKEEL_QUEUE_CAPACITY=8u",
            "-flto",
            "-mbig-endian",
        ):
            (problem,) = flag_problems([*FLAGS, flag])
            self.assertIn(f"the flag {flag} is forbidden", problem)


class Rebuilt(unittest.TestCase):
    """Images that are really built."""

    def test_an_image_that_is_not_what_its_source_gives(self) -> None:
        root = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        for part in SOURCES:
            shutil.copytree(ROOT / part, root / part)
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(firmware.main(["mps2_an500"], root), 0)
        folder = root / "build/firmware/mps2_an500"

        def found() -> list[str]:
            return [*differences(Toolchain(), root, "mps2_an500", folder, root / "work")]

        self.assertEqual(found(), [])
        data = bytearray((folder / "keel.bin").read_bytes())
        data[-1] ^= 1
        (folder / "keel.bin").write_bytes(data)
        (difference,) = found()
        self.assertIn("mps2_an500/keel.bin: another folder gives other bits", difference)
