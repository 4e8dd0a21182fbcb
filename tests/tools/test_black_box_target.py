# SPDX-License-Identifier: Apache-2.0
"""The black box with FatFs builds for the target, as an image's own sources do, without a heap."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from keel.base.run import output_of
from keel.boards.firmware import FLAGS, WARNINGS
from keel.install import TARGET_FLAGS, Toolchain

ROOT = Path(__file__).resolve().parents[2]

PROGRAM = """\
#include "fatfs/black_box.h"
static keel_black_box_t box;
static const keel_disk_t disk;
int main(void)
{
    const keel_black_box_config_t config = {&disk, 1048576u, 4u};
    (void)keel_black_box_init(&box, &config);
    (void)keel_black_box_open(&box, 0u);
    (void)keel_black_box_write(&box, (const uint8_t *)"log", keel_black_box_room(&box));
    (void)keel_black_box_step(&box, 0u);
    return (int)keel_black_box_close(&box);
}
"""
SOURCES = ("bsp/fatfs/black_box.c", "bsp/fatfs/card_file.c")


class Target(unittest.TestCase):
    """What docs/copter.md says of its size."""

    def test_it_builds_without_a_heap(self) -> None:
        tools = Toolchain()
        tools.ensure("firmware", "fatfs")
        fatfs = Path(tools.command("fatfs")[0]) / "fatfs/source"
        compiler = tools.command("arm-none-eabi-gcc")
        flags = [
            *TARGET_FLAGS,
            *FLAGS,
            "-Os",
            f"-I{ROOT}/include",
            f"-I{ROOT}/bsp",
            f"-I{ROOT}/bsp/fatfs",
            "-isystem",
            str(fatfs),
        ]
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "main.c").write_text(PROGRAM)
            objects = []
            for source, more in (
                (folder / "main.c", WARNINGS),
                (fatfs / "ff.c", ("-w",)),
                *((ROOT / one, WARNINGS) for one in SOURCES),
            ):
                objects.append(folder / f"{source.stem}.o")
                output_of([*compiler, *flags, *more, "-c", source, "-o", objects[-1]])
            image = folder / "image.elf"
            output_of(
                [
                    *compiler,
                    *TARGET_FLAGS,
                    "-nostartfiles",
                    "-Wl,--gc-sections,-e,main",
                    *objects,
                    "-lc",
                    "-o",
                    image,
                ]
            )
            symbols = output_of(["arm-none-eabi-nm", image]).split()
            self.assertIn("f_expand", symbols)
            self.assertEqual({"malloc", "calloc", "free", "_sbrk", "f_mkfs"} & set(symbols), set())
            text, _, zeros = output_of(["arm-none-eabi-size", image]).splitlines()[1].split()[:3]
        self.assertLess(int(text), 10_000)
        self.assertLess(int(zeros), 9_500)
