# SPDX-License-Identifier: Apache-2.0
"""The register headers against the register databases, and that a slip in a header is noticed.

Needs the group "registers" of the toolchain: two crates, fetched once with their checksums.
"""

from __future__ import annotations

import re
import shutil
import tempfile
import unittest
from pathlib import Path

from keel.boards import registers
from keel.boards.register_databases import Databases
from keel.boards.register_headers import RegistersError
from keel.boards.registers import Comparison
from keel.boards.sockets import SOCKETS
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

RCC = "bsp/stm32f767/registers/rcc.h"
UART = "bsp/stm32f767/registers/uart.h"
DMA = "bsp/stm32f767/registers/dma.h"


class RegistersTest(unittest.TestCase):
    tools: Toolchain
    databases: Databases

    @classmethod
    def setUpClass(cls) -> None:
        cls.tools = Toolchain()
        cls.tools.ensure("registers")
        places = [Path(cls.tools.command(name)[0]) for name in ("stm32ral", "stm32-metapac")]
        cls.databases = Databases(*places)

    def setUp(self) -> None:
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        shutil.copytree(ROOT / "bsp", self.root / "bsp")
        shutil.copytree(ROOT / "examples", self.root / "examples")  # Named by the boards' files.
        (self.root / "specs").mkdir()
        for path in (registers.EXCEPTIONS, SOCKETS):
            shutil.copy(ROOT / path, self.root / path)

    def compare(self) -> Comparison:
        return registers.compare(self.tools, self.root, self.databases)

    def change(self, path: str, old: str, new: str) -> None:
        text = re.sub(r" +", " ", (self.root / path).read_text())  # However it is laid out.
        self.assertEqual(text.count(old), 1, old)
        (self.root / path).write_text(text.replace(old, new))

    def finds(self, *parts: str) -> None:
        """Some difference holds all these texts."""
        differences = self.compare().differences
        found = [line for line in differences if all(part in line for part in parts)]
        self.assertTrue(found, differences)

    def test_the_headers_agree_with_the_databases(self) -> None:
        result = self.compare()
        self.assertEqual(result.differences, [])
        # The headers are really read: there are this many facts and more, of every kind.
        self.assertGreater(len(result.facts), 400)
        for kind in ("base", "register", "field", "reset", "interrupt", "memory"):
            self.assertGreater(result.compared[kind], 0, kind)

    def test_a_wrong_base_is_found_in_both_databases(self) -> None:
        self.change(UART, "0x40004800u", "0x40004400u")
        self.finds("USART3_BASE", "0x40004400", "stm32ral has 0x40004800")
        self.finds("USART3_BASE", "0x40004400", "stm32-metapac has 0x40004800")

    def test_a_wrong_offset_is_found(self) -> None:
        self.change(RCC, "volatile uint32_t reserved1[2];", "volatile uint32_t reserved1[3];")
        self.finds("RCC.APB1ENR", "0x40023844", "stm32ral has 0x40023840")

    def test_a_wrong_offset_in_an_array_of_blocks_is_found(self) -> None:
        self.change(DMA, "volatile uint32_t M1AR;\n", "")
        self.finds("DMA1.FCR0", "0x40026020", "stm32ral has 0x40026024")
        self.finds("DMA2.CR7", "0x400264", "stm32ral has 0x400264b8")

    def test_a_wrong_position_and_a_wrong_width_are_found(self) -> None:
        self.change(RCC, "RCC_CR_HSEON BITS(16u, 1u)", "RCC_CR_HSEON BITS(17u, 1u)")
        self.finds("RCC_CR_HSEON", "0x11 0x1", "stm32ral RCC has 0x10 0x1")
        self.change(RCC, "RCC_PLLCFGR_PLLN BITS(6u, 9u)", "RCC_PLLCFGR_PLLN BITS(6u, 8u)")
        self.finds("RCC_PLLCFGR_PLLN", "0x6 0x8", "stm32-metapac RCC has 0x6 0x9")

    def test_a_wrong_reset_value_is_found(self) -> None:
        self.change(RCC, "0x24003010u", "0x24003011u")
        self.finds("RCC_PLLCFGR_RESET", "has 0x24003010")
        self.change("bsp/stm32f767/registers/gpio.h", "0xA8000000u", "0xA8000001u")
        self.finds("GPIOA_MODER_RESET", "has 0xa8000000")

    def test_a_wrong_pin_is_found(self) -> None:
        self.change(
            "bsp/nucleo_f767zi/pins.c", "(D, 8u, 7u, USART3, TX)", "(D, 8u, 8u, USART3, TX)"
        )
        self.finds("PD8 AF8 USART3_TX", "no such function")

    def test_outputs_in_another_order_are_found(self) -> None:
        """As the table was before: the same four pins and channels, from the other end."""
        path = self.root / "bsp/fmuv5/pins.c"
        text = path.read_text()
        lines = {
            name: f"KEEL_OUTPUT({name})"
            for name in (
                "E, 14u, 1u, TIM1, CH4",
                "A, 10u, 1u, TIM1, CH3",
                "E, 11u, 1u, TIM1, CH2",
                "E, 9u, 1u, TIM1, CH1",
            )
        }
        for name, other in zip(lines, reversed(lines), strict=True):
            self.assertEqual(text.count(lines[name]), 1)
            text = text.replace(lines[name], f"@{other}@")
        path.write_text(re.sub("@(.*?)@", r"KEEL_OUTPUT(\1)", text))
        self.finds("bsp/fmuv5: ", "outputs PE9 TIM1_CH1, PE11", "has PE14 TIM1_CH4, PA10")

    def test_an_output_at_a_wrong_timer_is_found(self) -> None:
        self.change("bsp/fmuv5/pins.c", "(H, 6u, 9u, TIM12, CH1)", "(H, 6u, 9u, TIM12, CH2)")
        self.finds("PH6 AF9 TIM12_CH2", "no such function")

    def test_a_supply_that_is_not_switched_on_is_found(self) -> None:
        self.change("bsp/fmuv5/pins.c", "KEEL_LEVEL(G, 4u, false)", "KEEL_LEVEL(G, 4u, true)")
        self.finds("bsp/fmuv5: ", "PG4 high", "PG4 low")

    def test_a_sensor_that_is_mounted_otherwise_is_found(self) -> None:
        self.change("bsp/fmuv5/variant.c", "F, 2u, 2, 1, -3)", "F, 2u, 1, -2, -3)")
        self.finds("bsp/fmuv5: ", "ICM20689 PF2 1 -2 -3", "has ICM20689 PF2 2 1 -3")

    def test_a_unit_with_its_selects_exchanged_is_found(self) -> None:
        self.change("bsp/fmuv5/variant.c", "BMI055, F, 4u, G, 10u", "BMI055, G, 10u, F, 4u")
        self.finds("bsp/fmuv5: ", "BMI055 PG10 PF4", "BMI055 PF4 PG10")

    def test_a_third_unit_at_another_select_is_found(self) -> None:
        self.change("bsp/cuav_v5/variant.c", "ICM20602, F, 3u", "ICM20602, F, 5u")
        self.finds("bsp/cuav_v5: ", "ICM20602 PF5 2 1 -3", "ICM20602 PF3 2 1 -3")

    def test_the_pins_of_the_panel_and_of_ppm_are_compared(self) -> None:
        for old, new, told in (
            ("KEEL_SAFETY(E, 10u, E, 12u)", "KEEL_SAFETY(E, 12u, E, 10u)", "safety PE12 PE10"),
            ("(E, 5u, 3u, TIM9, CH1)", "(E, 6u, 3u, TIM9, CH2)", "buzzer PE6 TIM9_CH2"),
            ("(I, 5u, 3u, TIM8, CH1)", "(I, 6u, 3u, TIM8, CH2)", "ppm PI6 TIM8_CH2"),
        ):
            self.change("bsp/fmuv5/pins.c", old, new)
            self.finds("bsp/fmuv5: ", told)
            self.finds("bsp/cuav_v5: ", told)

    def test_a_board_whose_sockets_nobody_told_is_found(self) -> None:
        path = self.root / SOCKETS
        path.write_text(path.read_text().replace('"nucleo_f767zi"', '"other"'))
        self.finds("bsp/nucleo_f767zi: ", "does not have this board")
        self.finds(SOCKETS, "other: there is no such board")

    def test_a_wrong_analogue_channel_is_found(self) -> None:
        self.change("bsp/fmuv5/pins.c", "(C, 0u, 10u)", "(C, 0u, 8u)")
        self.finds("bsp/fmuv5/pins.c", "PC0 ADC1_IN8", "no such channel")

    def test_a_boards_file_that_is_wrong_is_found(self) -> None:
        path = "bsp/stm32f767/chip.toml"
        self.change(path, "KEEL_BOARD_INTERRUPTS=110u", "KEEL_BOARD_INTERRUPTS=98u")
        self.finds("bsp/fmuv5/board.toml", "KEEL_BOARD_INTERRUPTS", "0x62", "has 0x6e")
        self.change(path, "size = 0x60000", "size = 0x80000")
        self.finds("bsp/fmuv5/board.toml", "region SRAM", "0x20020000 0x60000")

    def test_a_wrong_memory_is_found(self) -> None:
        self.change("bsp/stm32f767/registers/memory.h", "0x00060000u", "0x00080000u")
        self.finds("MEMORY_SRAM_SIZE", "0x80000", "has 0x60000")

    def test_a_fact_without_a_counterpart_is_a_difference(self) -> None:
        self.change(
            RCC, "#define RCC_CR_HSION ", "#define RCC_CR_HSIXX BITS(0u, 1u)\n#define RCC_CR_HSION "
        )
        self.finds("RCC_CR_HSIXX", "no counterpart")

    def test_an_entry_without_use_is_a_difference(self) -> None:
        path = self.root / registers.EXCEPTIONS
        path.write_text(path.read_text() + '[[absent]]\nfact = "RCC.NONE"\nreason = "None."\n')
        self.finds("RCC.NONE", "nothing needs this entry")

    def test_an_excuse_for_what_has_a_counterpart_is_a_difference(self) -> None:
        path = self.root / registers.EXCEPTIONS
        path.write_text(path.read_text() + '[[absent]]\nfact = "RCC.CR"\nreason = "None."\n')
        self.finds("RCC.CR", "nothing needs this entry")

    def test_a_refuted_database_needs_another_that_agrees(self) -> None:
        path = self.root / registers.EXCEPTIONS
        entry = '[[refuted]]\nfact = "{}"\ndatabase = "stm32ral FLASH"\nreason = "None."\n'
        path.write_text(path.read_text() + entry.format("FLASH_CR_SNB"))
        self.finds("FLASH_CR_SNB", "nothing needs this entry")
        flash = "bsp/stm32f767/registers/flash.h"
        self.change(flash, "#define FLASH_CR_SNB BITS(3u, 5u)", "#define FLASH_CR_SNB BITS(3u, 6u)")
        self.finds("FLASH_CR_SNB (FLASH): 0x3 0x6")  # Both are refuted now, and none is right.

    def test_a_mask_with_a_gap_is_refused(self) -> None:
        self.change(RCC, "RCC_CR_PLLON BITS(24u, 1u)", "RCC_CR_PLLON (5u << 24u)")
        with self.assertRaisesRegex(RegistersError, "RCC_CR_PLLON: not one run"):
            self.compare()
