# SPDX-License-Identifier: Apache-2.0
"""The images of the real boards on the model of their chip, and what the model itself refuses.

The images are built first; each run is some tenths of a second of the board's time.
"""

from __future__ import annotations

import contextlib
import io
import re
import shutil
import struct
import tempfile
import unittest
from itertools import pairwise
from pathlib import Path
from unittest import mock

from keel.boards import firmware, stack
from keel.boards.rebuilt import SOURCES
from keel.boards.sockets import pin_of, read_sockets
from keel.boards.stack_bounds import EXCEPTION_FRAME_B
from keel.emulator import chip, chip_model
from keel.emulator.card import SdCard
from keel.emulator.chip import PWR, RCC, Chip, ModelError
from keel.emulator.fram import Fram
from keel.emulator.ms5611 import check_of
from keel.emulator.pulses import Pulse, State
from keel.emulator.wiring import WIRINGS
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

IMU_SLOT = 10  # Of the background task of the inertial unit, in the order of table 2.
LATER_S = {"cuav_v5": 0.15}  # What a third inertial unit takes at the start.


class ImageTest(unittest.TestCase):
    """Every fault ends in the safe state, with the outputs off and its record told."""

    tools: Toolchain
    root: Path  # A copy: its images do not replace the user's.

    @classmethod
    def setUpClass(cls) -> None:
        cls.tools = Toolchain()
        cls.tools.ensure("firmware", "stack", "model")
        folder = cls.enterClassContext(tempfile.TemporaryDirectory(prefix="keel-test-"))
        cls.root = Path(folder)
        for part in (*SOURCES, "specs"):
            shutil.copytree(ROOT / part, cls.root / part)
        for board in WIRINGS:
            with contextlib.redirect_stdout(io.StringIO()):
                firmware.build(cls.tools, board, [], cls.root)

    def run_image(
        self,
        seconds: float = 0.2,
        keys: str = "",
        board: str = "nucleo_f767zi",
        broken: str = "",
        step_us: int = 4,
        first_us: int = 160_000,
    ) -> Chip:
        """Run an image; keys come a millisecond apart from a time on, by which a board with one
        inertial unit has started. A board that starts later has as much more time."""
        later_s = LATER_S.get(board, 0.0)
        first_us += round(1e6 * later_s)
        pressed = [(first_us + 1000 * i, key) for i, key in enumerate(keys)]
        return chip_model.simulate(
            self.tools, self.root, board, seconds + later_s, pressed, broken, step_us
        )

    def safe(self, board: Chip, *parts: str) -> None:
        self.assertRegex(board.text, "(?s)safe state: fault 1 .*outputs are off")
        for part in parts:
            self.assertIn(part, board.text)
        self.assertFalse(board.armed_us[-1][1])

    def test_nothing_of_a_boot_loader_is_left(self) -> None:
        """Its timer stops, and nothing pends, before the image uses either."""
        first: dict[int, int] = {}

        def write(board: Chip, address: int, value: int) -> None:
            first.setdefault(address, value)
            right(board, address, value)

        right = Chip.write
        with mock.patch.object(Chip, "write", write):
            self.run_image(0.05)
        self.assertEqual(first[chip.SYSTICK], 0)
        for word in range(4):  # 110 interrupts, disabled and not pending.
            self.assertEqual(first[chip.NVIC + 0x80 + 4 * word], 0xFFFF_FFFF)
            self.assertEqual(first[chip.NVIC + 0x180 + 4 * word], 0xFFFF_FFFF)
        self.assertEqual(first[chip.SCB + 4], 1 << 25 | 1 << 27)

    def test_all_boards_start_and_read_their_sensor(self) -> None:
        for name in WIRINGS:
            board = self.run_image(board=name)
            self.assertIn(f"Keel on {name}: 21 tasks\r\nsensor 1 status 0\r\n", board.text)
            # A thousand samples a second from 0.13 s on, when the sensor was started.
            self.assertGreater(board.sensor.samples, 50)
            self.assertEqual(board.resets, 0)
            self.assertNotIn(True, [on for _, on in board.armed_us])

    def test_every_task_meets_its_releases_within_its_bound_of_stack(self) -> None:
        board = self.run_image(0.65, keys="t", step_us=1)
        table = re.findall(r"(?m)^[A-Z][A-Za-z ]{23}([ \d.]+)\r$", board.text)
        rows = [line.split() for line in table]
        self.assertEqual(len(rows), 21)
        for row in rows:
            late = [int(number) for number in row[6:13]]
            self.assertEqual(sum(late), int(row[1]), row)
            self.assertEqual(row[13:], ["0", "0", "0"], row)  # Overruns, promotions, skipped.
            self.assertLessEqual(int(row[3]), int(row[4]), row)
        # The tasks start behind the sensor, 0.13 s after the reset; the key comes at 0.16 s, and a
        # line takes 12 ms.
        fast = [int(row[1]) for row in rows if row[0] == "1000"]
        self.assertTrue(fast and all(30 <= runs <= 350 for runs in fast), rows)
        used = re.search(r"stack used (\d+) bytes", board.text)
        assert used is not None
        stacks = stack.measure(self.tools, self.root, "nucleo_f767zi")["stacks"]
        assert isinstance(stacks, dict)
        self.assertLessEqual(int(used[1]), stacks["main"]["bound"] - EXCEPTION_FRAME_B)

    def test_the_runs_of_tasks_are_sent_as_a_log(self) -> None:
        """Recorded for an eighth of a second; then its beginning comes at the line's pace."""
        board = self.run_image(0.5, keys="r", step_us=2)
        lines = [bytes.fromhex(line) for line in re.findall(r"(?m)^log ([0-9a-f]+)\r$", board.text)]
        self.assertEqual(lines[0][:4], b"ULog")
        kinds = [chr(line[2]) for line in lines[1:6]]
        self.assertEqual(kinds, ["B", "F", "F", "A", "A"])
        data = [struct.unpack_from("<HQIIHBB", line, 3) for line in lines[6:-1] if len(line) == 25]
        self.assertGreater(len(data), 8)
        starts = [one[1] for one in data]
        self.assertEqual(starts, sorted(starts))
        fast = [start for _, start, late, _, skipped, slot, _ in data if slot == IMU_SLOT]
        self.assertGreater(len(fast), 2)
        self.assertTrue(all(900 <= b - a <= 1100 for a, b in pairwise(fast)), fast)

    def test_the_brown_out_level_is_set_by_hand_and_once(self) -> None:
        delivered = 0xFFFF_AAFD
        board = chip_model.simulate(
            self.tools,
            self.root,
            "nucleo_f767zi",
            0.2,
            [(170_000, "b")],
            step_us=4,
            options=delivered,
        )
        self.assertIn("b within 2 s sets 2.7 V for good\r\nbrown-out status 0", board.text)
        self.assertEqual(board.options, 0xFFFF_AAF1)  # The level, and nothing else.
        board = chip_model.simulate(
            self.tools, self.root, "nucleo_f767zi", 0.16, [], step_us=4, options=delivered
        )
        self.assertEqual(board.options, delivered)
        self.assertNotIn("brown-out", self.run_image().text)

    def test_outputs_are_armed_by_hand_and_off_after_a_fault(self) -> None:
        board = self.run_image(keys="pu")
        self.assertEqual([on for _, on in board.armed_us], [False, True, False])
        self.safe(board, "exception 6", "cfsr 0x00010000", "stacked pc 0x0800")

    def test_outputs_are_low_but_while_they_are_armed(self) -> None:
        """Over a fault by the code, and over one that the watchdog finds."""
        for name in WIRINGS:
            for key in "uh":
                board = self.run_image(0.6, keys=f"pppp{key}", board=name, first_us=250_000)
                self.assertEqual(board.resets, 1 if key == "u" else 2)
                for log in board.outputs.log:
                    self.check_log(log, key == "h")

    def check_log(self, log: list[tuple[float, State]], bitten: bool) -> None:
        states = [state for _, state in log]
        last = ["low", "floats", "low"]  # The image ends them itself, before it resets.
        self.assertEqual(
            states, ["floats", "low", Pulse(1000, 2500), *(["floats", *last] if bitten else last)]
        )
        self.assertEqual(log[1][0], 0)  # No time goes by between the reset and low outputs.
        self.assertGreaterEqual(log[-2][0] - log[-3][0], 6000)
        self.assertEqual(log[-1][0], log[-2][0])

    def test_levels_of_supplies(self) -> None:
        sockets = read_sockets(ROOT)
        for name in WIRINGS:
            board = self.run_image(0.05, board=name)
            for text in sockets[name].levels:
                pin, level = text.split()
                self.assertEqual(board.level(pin_of(pin)), level, text)

    def test_a_null_pointer_meets_the_guard(self) -> None:
        self.safe(self.run_image(keys="n"), "exception 4", "cfsr 0x00000082 ", "mmfar 0x00000000")

    def test_a_stack_that_overflows_meets_the_guard(self) -> None:
        self.safe(self.run_image(keys="s"), "exception 4", "cfsr 0x00000082 ", "mmfar 0x200003ff")

    def test_the_memory_counts_the_starts_where_that_does_not_wear_it_out(self) -> None:
        fram = Fram()
        for told in ("load 2 save 0 starts 1", "load 0 save 0 starts 2", "load 0 save 0 starts 3"):
            board = chip_model.simulate(
                self.tools, self.root, "fmuv5", 0.2, [], step_us=4, fram=fram
            )
            self.assertIn(f"memory status 0 {told}\r\n", board.text)
        self.assertIn("memory status 0 load 2 starts 0\r\n", self.run_image().text)

    def test_without_its_memory_a_board_runs_all_the_same(self) -> None:
        board = self.run_image(0.65, keys="t", board="fmuv5", broken="memory")
        self.assertIn("memory status 5\r\n", board.text)
        self.assertEqual(len(re.findall(r"(?m)^[A-Z][A-Za-z ]{23}[ \d.]+ 0\r$", board.text)), 21)

    def test_a_task_that_hangs_starves_the_watchdog(self) -> None:
        board = self.run_image(0.45, keys="h")
        self.safe(board, "code 0xb0a20200")
        self.assertEqual(board.resets, 2)  # The watchdog's, and the one behind the record.

    def test_clocks_that_do_not_start_are_told(self) -> None:
        for broken, code in (("hse", 6), ("pll", 9)):
            board = self.run_image(0.05, board="fmuv5", broken=broken)
            self.safe(board, f"code 0xb0a2010{code}")
            self.assertEqual(board.resets, 1, broken)

    def test_without_its_sensor_a_board_runs_all_the_same(self) -> None:
        self.assertIn("sensor 1 status 5", self.run_image(broken="sensor").text)
        self.assertIn("sensor 1 status 6", self.run_image(broken="other-sensor").text)

    # The model's raw numbers: the reference counts 1519, 1502 when it was calibrated; the
    # temperature 1000, and 943 at 30, 1186 at 110 degrees. So the supply is
    #     3300 mV * 1502 / 1519 = 3263.07 mV,
    # 1000 counts of 3263 mV are 988.788 of 3300 mV, and the temperature is
    #     30 + 80 * (988.788 - 943) / (1186 - 943) = 45.074 degrees.
    MEASURED = " chip 4507 supply 3263"
    # The pins count 1026, 200, 0, 4095, 3138 and 2071, each of 3263 / 4096 mV: 817.34, 159.33, 0,
    # 3262.20, 2499.83 and 1649.82 mV.
    PINS = " v1 817 i1 159 v2 0 i2 3262 5v 2500 sensors 1650"

    def test_both_boards_measure_temperature_supply_and_their_pins(self) -> None:
        board = self.run_image(2.3, board="fmuv5")
        first, second = re.findall(r"^t .* g \S+ \S+ \S+(.*)\r$", board.text, re.MULTILINE)
        self.assertEqual(first, self.MEASURED + self.PINS)
        self.assertEqual(second, first)
        # All at the start, and then one a second.
        start = [17, 18, 0, 1, 2, 3, 10, 11]
        self.assertEqual(board.converted, [*start, 17, 18, 0])
        board = self.run_image(1.2)
        self.assertIn(f"{self.MEASURED}\r\n", board.text)
        self.assertEqual(board.converted[:3], [17, 18, 17])

    def test_a_converter_that_never_ends_is_told_and_changes_nothing_else(self) -> None:
        for name in WIRINGS:
            good = self.run_image(1.2, board=name).text
            bad = self.run_image(1.2, board=name, broken="adc").text
            self.assertIn(" g 106 0 1 adc status 2\r\n", bad)
            # All else is the same, but for the load, of which the retries are a part.
            rest = [re.sub(r"load \d+|( chip | adc ).*", "", text) for text in (good, bad)]
            self.assertEqual(*rest)


KEEPER = """\
#include "board.h"
#include "common/slots.h"
#include "console.h"
#include "stm32f767/target/chip.h"

/* Counts its starts, and starts again; says the chip's number. */
int main(void)
{
    uint8_t uid[KEEL_CHIP_UID_BYTES];
    static keel_slots_t slots KEEL_REALTIME_ZERO;
    keel_slots_config_t config = {.room = 8u};
    static uint8_t starts[8];
    uint32_t length = 0u;
    keel_slots_result_t result = KEEL_SLOTS_BUSY;

    keel_console_text("medium ");
    keel_console_number((uint64_t)keel_chip_memory(&config.medium, &config.address[1]));
    (void)keel_slots_init(&slots, &config);
    keel_console_text(" load ");
    keel_console_number((uint64_t)keel_slots_load(&slots, starts, &length));
    keel_console_text(" starts ");
    keel_console_number((length == 1u) ? starts[0] : 0u);
    starts[0] = (uint8_t)(((length == 1u) ? starts[0] : 0u) + 1u);
    (void)keel_slots_begin(&slots, starts, 1u);
    while (result == KEEL_SLOTS_BUSY) {
        result = keel_slots_step(&slots);
    }
    keel_console_text(" save ");
    keel_console_number((uint64_t)result);
    keel_console_text(" uid");
    keel_chip_uid(uid);
    for (uint32_t i = 0u; i < KEEL_CHIP_UID_BYTES; i++) {
        keel_console_text(" ");
        keel_console_number(uid[i]);
    }
    keel_console_text("\\n");
    if (result != KEEL_SLOTS_DONE) {
        keel_board_halt(1);
    }
    (void)keel_board_clock_us(NULL);
    keel_chip_reset();
}
"""


class KeptTest(unittest.TestCase):
    """What is kept in the chip's flash, or the board's memory, is there after a reset."""

    tools: Toolchain
    root: Path  # A copy of the sources, with the program.

    @classmethod
    def setUpClass(cls) -> None:
        cls.tools = Toolchain()
        cls.tools.ensure("firmware", "model")
        cls.root = Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        for part in SOURCES:
            shutil.copytree(ROOT / part, cls.root / part)
        (cls.root / "examples/keeper").mkdir()
        (cls.root / "examples/keeper/main.c").write_text(KEEPER)
        for board in WIRINGS:
            with contextlib.redirect_stdout(io.StringIO()):
                firmware.build(cls.tools, board, ["examples/keeper"], cls.root)

    def test_sets_are_kept_over_resets(self) -> None:
        for name in WIRINGS:
            with self.subTest(name):
                self.check(chip_model.simulate(self.tools, self.root, name, 0.12, step_us=4))

    def check(self, board: Chip) -> None:
        uid = " ".join(str(byte) for byte in chip.UID)
        found = re.findall(rf"medium 0 load (\d) starts (\d+) save 0 uid {uid}", board.text)
        self.assertGreater(len(found), 3)
        self.assertEqual(found[0], ("2", "0"))  # None is there yet.
        self.assertEqual(found[1:], [("0", str(starts)) for starts in range(1, len(found))])
        # The run may end within the hold before a reset.
        self.assertIn(board.text.count("save 0") - board.resets, (0, 1))


class BoardTest(unittest.TestCase):
    """The model's own rules."""

    def setUp(self) -> None:
        self.board = Chip(WIRINGS["fmuv5"])
        self.board.write(RCC, 0x0005_0083)  # The oscillator, by a clock from outside.
        self.board.write(RCC + 4, 0x2940_3604)
        self.board.write(RCC, self.board.read(RCC) | 1 << 24)
        self.board.write(PWR, 0x3_C000)
        self.board.write(chip.FLASHR, 7)

    def test_a_right_change_to_the_pll(self) -> None:
        self.board.write(RCC + 8, 0x9402)
        self.assertEqual(self.board.read(RCC + 8), 0x940A)

    def refuses(self, address: int, value: int, reason: str) -> None:
        self.board.words[address] = value
        with self.assertRaisesRegex(ModelError, reason):
            self.board.write(RCC + 8, 0x9402)

    def test_a_change_that_is_not_allowed(self) -> None:
        self.refuses(chip.FLASHR, 6, "too few wait states")
        self.refuses(PWR + 4, 0x1_0000, "over-drive is not on")
        self.refuses(RCC, 0x0107_0083, "has not locked")

    def test_a_wrong_frequency(self) -> None:
        self.refuses(RCC + 4, 0x2940_3608, "at 108 MHz")

    def test_buses_that_are_too_fast(self) -> None:
        with self.assertRaisesRegex(ModelError, "a bus would be too fast"):
            self.board.write(RCC + 8, 0x0002)

    def test_factors_may_not_change_while_the_pll_runs(self) -> None:
        with self.assertRaisesRegex(ModelError, "factors are changed"):
            self.board.write(RCC + 4, 0x2940_3608)

    def test_what_is_not_there(self) -> None:
        with self.assertRaisesRegex(ModelError, "0x40001000 is no register"):
            self.board.read(0x4000_1000)

    def output(self, name: str) -> None:
        """An output whose timer runs at 400 Hz, from 16 MHz, as a plain pin that is low."""
        self.board = Chip(WIRINGS["nucleo_f767zi"], "", [name])
        port, pin = pin_of(name.split()[0])
        self.port = chip.GPIOA + 0x400 * port
        self.pin = pin
        self.board.write(self.port, 1 << 2 * pin)
        self.board.write(RCC + 0x40, 1 << 2 | 1 << 6)
        self.board.write(RCC + 0x44, 1)
        self.timer = {"TIM1": chip.TIM1, "TIM4": chip.TIM4, "TIM12": chip.TIM12}[
            name.split()[1].split("_")[0]
        ]
        for offset, value in (
            (0x18, 0x6868),
            (0x20, 0x11),
            (0x28, 15),
            (0x2C, 2499),
            (0x14, 1),
            (0, 1),
        ):
            self.board.write(self.timer + offset, value)

    def give(self, function: int) -> None:
        """The pin to its timer."""
        self.board.write(self.port + 0x20 + 4 * (self.pin // 8), function << 4 * (self.pin % 8))
        self.board.write(self.port, 2 << 2 * self.pin)

    def test_pulses(self) -> None:
        self.output("PD13 TIM4_CH2")
        self.give(2)
        self.board.tick(100)
        self.board.write(self.timer + 0x38, 1500)
        self.board.tick(2399)
        self.assertEqual(self.board.outputs.log[0][-1][1], "low")  # Not before the next period.
        self.board.tick(1)
        self.assertEqual(self.board.outputs.log[0][-1], (2500, Pulse(1500, 2500)))
        self.board.write(self.port, 1 << 2 * self.pin)
        self.assertEqual(self.board.outputs.log[0][-1], (2500, "low"))
        self.board.write(self.port + 0x18, 1 << self.pin)
        self.assertEqual(self.board.outputs.log[0][-1], (2500, "high"))
        self.board.write(self.port, 0)
        self.assertEqual(self.board.outputs.log[0][-1], (2500, "floats"))

    def test_pulses_of_a_timer_with_a_gate(self) -> None:
        self.output("PE9 TIM1_CH1")
        self.give(1)
        self.assertEqual(self.board.outputs.log[0][-1][1], "floats")
        self.board.write(self.timer + 0x44, 1 << 10)
        self.assertEqual(self.board.outputs.log[0][-1][1], "low")
        self.board.write(self.timer + 0x44, 1 << 15)
        self.board.write(self.timer + 0x34, 1000)
        self.board.tick(2500)
        self.assertEqual(self.board.outputs.log[0][-1][1], Pulse(1000, 2500))

    def test_outputs_that_must_not_be(self) -> None:
        self.output("PD13 TIM4_CH2")
        self.board.write(self.timer + 0x38, 1500)
        self.board.tick(2500)  # It counts, and nobody sees it.
        self.assertEqual(self.board.outputs.log[0][-1][1], "low")
        with self.assertRaisesRegex(ModelError, "output 1 puts out a part of a pulse"):
            self.give(2)
        self.output("PH6 TIM12_CH1")
        for offset in (4, 0x1C, 0x30, 0x3C, 0x40, 0x44):
            with self.assertRaisesRegex(ModelError, "is no register of this timer"):
                self.board.write(self.timer + offset, 0)

    def test_a_timer_or_a_pin_that_is_not_set_up(self) -> None:
        for offset, value in ((0x18, 0x7878), (0x20, 0x33), (0, 0)):
            self.output("PD13 TIM4_CH2")
            self.board.write(self.timer + offset, value)
            self.give(2)
            self.assertEqual(self.board.outputs.log[0][-1][1], "other")
        self.output("PD13 TIM4_CH2")
        self.give(3)
        self.assertEqual(self.board.outputs.log[0][-1][1], "other")
        self.output("PD13 TIM4_CH2")
        self.board.write(RCC + 0x40, 0)
        self.board.write(self.timer + 0x20, 0)  # Without its clock it takes nothing.
        self.give(2)
        self.assertEqual(self.board.outputs.log[0][-1][1], "low")

    def test_the_watchdog(self) -> None:
        for address, value in ((0, 0xCCCC), (0, 0x5555), (4, 0), (8, 399), (0, 0xAAAA)):
            self.board.write(chip.IWDG + address, value)
        self.board.tick(50_000)
        self.assertFalse(self.board.reset_wanted)
        self.board.tick(1)
        self.assertTrue(self.board.reset_wanted)

    def test_a_watchdog_that_was_not_started_or_unlocked(self) -> None:
        self.board.write(chip.IWDG, 0xAAAA)
        self.board.tick(10_000_000)
        self.assertFalse(self.board.reset_wanted)
        with self.assertRaisesRegex(ModelError, "while they are locked"):
            self.board.write(chip.IWDG + 8, 399)

    def test_stores_to_the_flash_that_must_not_be(self) -> None:
        key, control = chip.FLASHR + 4, chip.FLASHR + 0x10
        with self.assertRaisesRegex(ModelError, "used while it is locked"):
            self.board.write(control, 1)
        with self.assertRaisesRegex(ModelError, "not being programmed"):
            self.board.program(1, 0xFF, 0)
        for value in chip.FLASH_KEYS:
            self.board.write(key, value)
        self.board.write(control, 1)
        self.board.program(1, 0xF0, 0x10)
        self.board.write(control, 0x252)
        with self.assertRaisesRegex(ModelError, "not of a sector, by words"):
            self.board.write(control, 0x1_0052)
        self.board.write(control, 1)
        for size, before, reason in ((4, 0xFFFF_FFFF, "another size"), (1, 0x0F, "not erased")):
            with self.assertRaisesRegex(ModelError, reason):
                self.board.program(size, before, 0x10)
        self.board.write(chip.SCB + 0x94, 1)
        with self.assertRaisesRegex(ModelError, "protection is on"):
            self.board.program(1, 0xFF, 0x10)

    def memory(self) -> None:
        """SPI 2 and its pins as they should be."""
        self.board.write(RCC + 0x40, 1 << 14)
        self.board.write(chip.GPIOA + 8 * 0x400, 0b10_10_10_00)
        self.board.write(chip.GPIOA + 8 * 0x400 + 0x20, 0x5550)
        self.board.write(chip.GPIOA + 5 * 0x400, 1 << 10)
        self.board.write(chip.SPI2 + 4, 0x1700)
        self.board.write(chip.SPI2, 0x347)

    def test_bytes_to_the_memory_that_must_not_be(self) -> None:
        self.memory()
        self.board.write(chip.SPI2 + 0xC, 0x9F)
        port = chip.GPIOA + 8 * 0x400
        for address, value, reason in (
            (RCC + 0x40, 0, "no clock"),
            (port, 0b10_10_00_00, "pin is not its own"),
            (port + 0x20, 0x5560, "pin is not its own"),
            (chip.SPI2, 0x345, "mode 0 or 3"),
            (chip.SPI2 + 4, 0x1F00, "not of eight bits"),
            (chip.SPI2 + 4, 0x0700, "FRXTH"),
            (chip.GPIOA + 5 * 0x400, 0, "select of the memory floats"),
            (chip.SPI2, 0x307, "is off"),
        ):
            self.memory()
            self.board.write(address, value)
            with self.assertRaisesRegex(ModelError, reason):
                self.board.write(chip.SPI2 + 0xC, 0)

    def barometer(self) -> None:
        """SPI 4 and its pins as they should be, and the barometer selected."""
        port = chip.GPIOA + 4 * 0x400
        self.board.write(RCC + 0x44, 1 << 13)
        self.board.write(port, 2 << 4 | 2 << 12 | 2 << 26)
        self.board.write(port + 0x20, 5 << 8 | 5 << 24)
        self.board.write(port + 0x24, 5 << 20)
        self.board.write(chip.GPIOA + 4 * 0x400 + 0x18, 1 << 3)  # Its supply.
        self.board.write(chip.GPIOA + 5 * 0x400, 1 << 20)
        self.board.write(chip.SPI4 + 4, 0x1700)
        self.board.write(chip.SPI4, 0x357)
        for high in (False, True, False):  # Deselected in between.
            self.board.write(chip.GPIOA + 5 * 0x400 + 0x18, 1 << (10 if high else 26))

    def ask(self, command: int, count: int) -> int:
        """What the barometer answers."""
        self.barometer()
        self.board.write(chip.SPI4 + 0xC, command)
        value = 0
        for _ in range(count):
            self.board.write(chip.SPI4 + 0xC, 0)
            value = value << 8 | self.board.read(chip.SPI4 + 0xC)
        return value

    def test_a_barometer(self) -> None:
        self.ask(0x1E, 0)
        self.board.tick(2800)
        words = [self.ask(0xA0 + 2 * i, 2) for i in range(8)]
        self.assertEqual(words[1:7], [40127, 36924, 23317, 23282, 33464, 28312])
        self.ask(0x48, 0)
        self.board.tick(9039)
        self.assertEqual(self.ask(0, 3), 0)  # Too early, and lost.
        self.board.tick(1)
        self.ask(0x48, 0)
        self.ask(0x48, 0)  # Not while it converts.
        self.board.tick(9040)
        self.assertIn(self.ask(0, 3), range(9085466, 9085474))
        self.assertEqual(self.ask(0, 3), 0)  # Once.

    def test_the_check_of_a_barometers_prom(self) -> None:
        """The example of AN520, whose check is 0xB."""
        words = [0x3132, 0x3334, 0x3536, 0x3738, 0x3940, 0x4142, 0x4344, 0x450B]
        self.assertEqual(check_of(words), 0xB)

    def test_bytes_to_the_barometer_that_must_not_be(self) -> None:
        port = chip.GPIOA + 4 * 0x400
        for address, value, reason in (
            (RCC + 0x44, 0, "no clock"),
            (port, 2 << 4 | 2 << 12, "pin is not its own"),
            (port + 0x24, 6 << 20, "pin is not its own"),
            (chip.SPI4, 0x355, "mode 0 or 3"),
            (chip.SPI4, 0x34F, "at 27 MHz"),
            (chip.SPI4, 0x317, "is off"),
            (port + 0x18, 1 << 19, "no supply"),
        ):
            self.barometer()
            self.board.write(address, value)
            with self.assertRaisesRegex(ModelError, reason):
                self.board.write(chip.SPI4 + 0xC, 0)

    def converter(self) -> None:
        """ADC1 as it should be: an eighth of 16 MHz, 144 cycles for all channels, pins analogue."""
        for port in range(3):
            self.board.write(chip.GPIOA + 0x400 * port, 0xFFFF_FFFF)
        self.board.write(RCC + 0x44, 1 << 8)
        self.board.write(chip.ADC_COMMON + 4, 0x83_0000)
        self.board.write(chip.ADC1 + 0xC, 0x06DB_6DB6)
        self.board.write(chip.ADC1 + 0x10, 0x36DB_6DB6)
        self.board.write(chip.ADC1 + 8, 0x401)
        self.board.tick(10)

    def convert(self, channel: int) -> None:
        self.board.write(chip.ADC1 + 0x34, channel)
        self.board.write(chip.ADC1 + 8, 0x4000_0401)

    def test_conversions(self) -> None:
        self.converter()
        for channel, count in chip.COUNTS.items():
            self.assertEqual(self.board.read(chip.ADC1) & 2, 0)
            self.convert(channel)
            self.assertEqual(self.board.read(chip.ADC1), 0x12)
            self.assertEqual(self.board.read(chip.ADC1 + 0x4C), count)
            self.board.write(chip.ADC1, 0)
        self.board.write(chip.ADC_COMMON + 4, 0xC3_0000)  # The battery takes the channel.
        self.convert(18)
        self.assertEqual(self.board.read(chip.ADC1 + 0x4C), chip.BATTERY)
        self.convert(17)
        self.convert(17)
        self.assertEqual(self.board.read(chip.ADC1) & 0x20, 0x20)  # Nobody took the first.

    def test_conversions_that_must_not_be(self) -> None:
        adc, common = chip.ADC1, chip.ADC_COMMON
        cases: list[tuple[int, list[tuple[int, int]], str]] = [
            (0, [(RCC + 0x44, 0)], "has no clock"),
            (0, [(adc + 8, 0x4000_0400)], "is off"),
            (0, [(adc + 8, 0), (adc + 8, 0x401)], "is not up yet"),
            (0, [(RCC + 8, 0x9402), (common + 4, 0x80_0000)], "its clock is 54 MHz"),
            (0, [(adc + 0x2C, 1 << 20)], "more than one"),
            (16, [], "joined to nothing"),
            (10, [(chip.GPIOA + 0x800, 0)], "pin is not analogue"),
            (17, [(common + 4, 0x3_0000)], "sensors are not up"),
            (18, [(common + 4, 0x3_0000), (common + 4, 0x83_0000)], "sensors are not up"),
            (18, [(RCC + 8, 0x9402), (adc + 0xC, 0x05DB_6DB6)], r"sampled for 8\.29"),
        ]
        for channel, changes, reason in cases:
            with self.subTest(reason):
                self.setUp()
                self.converter()
                with self.assertRaisesRegex(
                    ModelError, f"conversion of channel {channel} .*{reason}"
                ):
                    for address, value in changes:
                        self.board.write(address, value)
                    self.board.tick(2)
                    self.convert(channel)

    def test_a_conversion_that_never_ends_is_ended_by_switching_off(self) -> None:
        self.board = Chip(WIRINGS["nucleo_f767zi"], "adc")
        self.converter()
        self.convert(0)
        self.assertEqual(self.board.read(chip.ADC1), 0)
        with self.assertRaisesRegex(ModelError, "another has not ended"):
            self.convert(0)
        self.board.write(chip.ADC1 + 8, 0)
        self.board.write(chip.ADC1 + 8, 0x401)
        self.board.tick(3)
        self.convert(0)

    def slot(self) -> None:
        """SDMMC1 as it should be, for a card that is not known yet."""
        self.board = Chip(WIRINGS["fmuv5"])
        self.board.card = SdCard(bytearray(512 * 1024))
        self.board.write(RCC, 0x0001_0083)
        self.board.write(RCC + 4, 0x2940_3608)  # 16 / 8 * 216 / 9 = 48 MHz.
        self.board.write(RCC + 0x44, 1 << 11)
        for port, modes, functions in ((2, 0x02AA_0000, 0x000C_CCCC), (3, 0x20, 0xC00)):
            self.board.write(chip.GPIOA + 0x400 * port, modes)
            self.board.write(chip.GPIOA + 0x400 * port + (0x24 if port == 2 else 0x20), functions)
        self.board.write(chip.GPIOA + 0x400 * 6 + 0x18, 1 << 7)
        self.board.write(chip.SDMMC1, 3)
        self.board.write(chip.SDMMC1 + 4, 0x176)

    def order(self, index: int, argument: int = 0, answer: int = 1) -> int:
        """A command; the flags then, which are cleared."""
        self.board.write(chip.SDMMC1 + 8, argument)
        self.board.write(chip.SDMMC1 + 0xC, 1 << 10 | answer << 6 | index)
        flags = self.board.read(chip.SDMMC1 + 0x34)
        self.board.write(chip.SDMMC1 + 0x38, 0x5FF)
        return flags

    def identified(self) -> None:
        """A card in its transfer state, on four lines."""
        self.slot()
        self.assertEqual(self.order(0, answer=0), 1 << 7)
        self.assertEqual(self.order(8, 0x1AA), 1 << 6)
        for _ in range(3):
            self.order(55)
            self.assertEqual(self.order(41, 0x4030_0000), 1 << 0)  # It has no checksum.
        self.order(2, answer=3)
        self.order(3)
        self.order(7, 0xB368_0000)
        self.order(55, 0xB368_0000)
        self.order(6, 2)
        self.board.write(chip.SDMMC1 + 4, 0x0901)

    def test_a_card(self) -> None:
        self.identified()
        self.assertEqual(self.order(13, 0xB368_0000), 1 << 6)
        self.assertEqual(self.board.read(chip.SDMMC1 + 0x14), 0x900)  # Ready, in transfer.
        self.assertEqual(self.order(13, 0), 1 << 2)  # Not its address.
        self.assertEqual(self.order(3), 1 << 2)  # Not in this state,
        self.order(13, 0xB368_0000)
        self.assertEqual(self.board.read(chip.SDMMC1 + 0x14), 0x40_0900)  # as it says.

    def begin(self, blocks: int, direction: int, lines: int = 0x901) -> None:
        """Makes ready for a transfer."""
        self.board.write(chip.SDMMC1 + 4, lines)
        self.board.write(chip.SDMMC1 + 0x24, 1000)
        self.board.write(chip.SDMMC1 + 0x28, 512 * blocks)
        self.board.write(chip.SDMMC1 + 0x2C, 0x91 | direction)

    def test_blocks(self) -> None:
        self.identified()
        self.order(24, 7)
        self.begin(1, 0)
        for word in range(128):
            self.board.write(chip.SDMMC1 + 0x80, word)
        self.assertEqual(self.board.read(chip.SDMMC1 + 0x34), 1 << 8 | 1 << 10)
        self.board.write(chip.SDMMC1 + 0x38, 0x5FF)
        for ready in (0xE00, 0xE00, 0x900):  # It programs for two looks.
            self.order(13, 0xB368_0000)
            self.assertEqual(self.board.read(chip.SDMMC1 + 0x14), ready)
        self.begin(1, 2)
        self.order(17, 7)
        self.assertEqual(
            [self.board.read(chip.SDMMC1 + 0x80) for _ in range(128)], list(range(128))
        )
        self.assertEqual(self.board.read(chip.SDMMC1 + 0x34), 1 << 8 | 1 << 10)

    def test_a_slot_that_is_not_as_it_must_be(self) -> None:
        cases = (
            (RCC + 0x44, 0, "it has no clock"),
            (RCC + 0x90, 1 << 28, "not that of the PLL"),
            (chip.GPIOA + 0x800, 0x00AA_0000, "a pin is not its own"),
            (chip.GPIOA + 0x800 + 0x24, 0x0000_CCCC, "a pin is not its own"),
            (chip.GPIOA + 0x1800 + 0x18, 1 << 23, "the card has no supply"),
            (chip.SDMMC1, 0, "its supply is off"),
            (chip.SDMMC1 + 4, 0x076, "its clock is off"),
            (chip.SDMMC1 + 4, 0x175, "its clock is 403361 Hz"),
        )
        for address, value, reason in cases:
            with self.subTest(reason):
                self.slot()
                self.board.write(address, value)
                with self.assertRaisesRegex(ModelError, reason):
                    self.order(0, answer=0)
        self.slot()
        self.board.write(RCC, 0x83)
        self.board.words[RCC + 4] = 0x2840_3608
        with self.assertRaisesRegex(ModelError, "its clock is 54 MHz"):
            self.order(0, answer=0)

    def test_transfers_that_must_not_be(self) -> None:
        def write(address: int, value: int) -> None:
            self.board.write(chip.SDMMC1 + address, value)

        cases = (
            ("not of whole sectors", lambda: [write(0x28, 500), write(0x2C, 0x91)]),
            ("has no time", lambda: [write(0x28, 512), write(0x2C, 0x91)]),
            ("nothing is sent", lambda: write(0x80, 1)),
            ("while it is empty", lambda: self.board.read(chip.SDMMC1 + 0x80)),
            ("expects none", lambda: [self.begin(1, 0), write(0x80, 1)]),
            (
                "use other lines",
                lambda: [self.order(24, 7), self.begin(1, 0, 0x101), write(0x80, 1)],
            ),
            ("of another length", lambda: self.order(13, 0xB368_0000, 3)),
            (
                "data of the one before",
                lambda: [self.begin(1, 2), self.order(17, 7), self.order(13, 0xB368_0000)],
            ),
            ("last sector", lambda: [self.begin(2, 2), self.order(18, 1023)]),
        )
        for reason, wrong in cases:
            with self.subTest(reason):
                self.identified()
                with self.assertRaisesRegex(ModelError, reason):
                    wrong()

    def test_a_card_of_no_size(self) -> None:
        with (
            tempfile.TemporaryDirectory() as folder,
            contextlib.redirect_stderr(io.StringIO()) as err,
        ):
            path = Path(folder) / "card.img"
            self.assertEqual(chip_model.main(["fmuv5", "--card", str(path)]), 2)
            path.write_bytes(bytes(1000))
            self.assertEqual(chip_model.main(["fmuv5", "--card", str(path)]), 2)
        self.assertIn("No such file", err.getvalue())
        self.assertIn("card.img: a card has a multiple of 524288 bytes, not 1000", err.getvalue())

    def test_an_unknown_board(self) -> None:
        with contextlib.redirect_stderr(io.StringIO()) as err:
            self.assertEqual(chip_model.main(["mps2_an500"]), 2)
        self.assertIn("there is no model mps2_an500", err.getvalue())
