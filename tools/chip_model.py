#!/usr/bin/env python3
"""Run the image of a real board on a model of the STM32F767.

    python3 tools/chip_model.py nucleo_f767zi                   # two seconds of the board's time
    python3 tools/chip_model.py fmuv5 --seconds 5 --keys 1.5:t  # and a key on the console at 1.5 s
    python3 tools/chip_model.py nucleo_f767zi --broken hse      # a clock that never becomes ready

An emulator of the processor's instructions (Unicorn) runs the very image that is flashed. Modelled
around it, register by register, is what the image uses: clocks with over-drive and flash latency,
timers, the console, the watchdog, the pulse outputs, an SPI with an ICM-20689, the memory
protection's guards, faults and resets, and the memories, of which the backup memory keeps its
content. The model checks as well: that the core changes to the PLL only when that is allowed, and
that nothing writes to what is not there.

What it cannot tell: anything about time. Its clock moves on by a microsecond with each reading of
the time base, so code between two readings takes none. Caches and wait states have no effect.

build/model/<board>.json says what happened. Exit status: 0 when the run went to its end and the
board printed what it is, 1 when not, 2 for a wrong command line.
"""

from __future__ import annotations

import argparse
import importlib
import json
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from flash import FlashError, read_image
from toolchain import Toolchain, ToolchainError, write_atomically

ROOT = Path(__file__).resolve().parents[1]
REPORT = "build/model"

ITCM, FLASH, DTCM, SRAM, BACKUP = 0x0, 0x0800_0000, 0x2000_0000, 0x2002_0000, 0x4002_4000
SIZES = {ITCM: 0x4000, FLASH: 0x20_0000, DTCM: 0x2_0000, SRAM: 0x6_0000, BACKUP: 0x1000}
KEPT = (FLASH, BACKUP)  # Over a reset; the others are filled with noise.
NOISE = b"\xa5\x5a\x3c\xc3"

# Bases of the peripherals (RM0410, table 1).
TIM5, IWDG, USART3, PWR, UART7 = 0x4000_0C00, 0x4000_3000, 0x4000_4800, 0x4000_7000, 0x4000_7800
TIM1, SPI1, GPIOA, RCC, FLASHR = 0x4001_0000, 0x4001_3000, 0x4002_0000, 0x4002_3800, 0x4002_3C00
SYSTICK, NVIC, SCB, DBGMCU = 0xE000_E010, 0xE000_E100, 0xE000_ED00, 0xE004_2000
BLOCKS = {
    TIM5: 0x54, IWDG: 0x14, USART3: 0x2C, PWR: 0x10, UART7: 0x2C, TIM1: 0x68, SPI1: 0x24,
    RCC: 0x98, FLASHR: 0x1C, SCB: 0x2A4, DBGMCU: 0x10, SYSTICK: 0x10,
    NVIC: 0x200,
    **{GPIOA + 0x400 * port: 0x2C for port in range(11)},
}  # fmt: skip
RESETS = {
    RCC: 0x83, RCC + 4: 0x2400_3010, RCC + 0x30: 0x0010_0000, RCC + 0x74: 0x0E00_0000,
    PWR: 0xC000, USART3 + 0x1C: 0xC0, UART7 + 0x1C: 0xC0, SPI1 + 4: 0x700, SPI1 + 8: 2,
    IWDG + 8: 0xFFF, FLASHR + 0x14: 0xFFFF_AAF1, GPIOA: 0xA800_0000, GPIOA + 0x400: 0x280,
    SCB + 0x80: 0x0FE0_0019 | 127 << 13,  # 128 sets of 4 ways of 32 bytes.
    SCB + 0x90: 0x800,
}  # fmt: skip

OPTION_KEYS = [0x0819_2A3B, 0x4C5D_6E7F]

MEMORY, BUS, USAGE = 4, 5, 6
SLICE = 500_000  # Instructions without a reading of the clock after which time moves on by itself.
SLICE_US = 2_000
EXC_RETURN = 0xFFFF_FFF9
BROKEN = ("hse", "pll", "overdrive", "sensor", "other-sensor")


class ModelError(Exception):
    """The image did what must not be; the message says what and where."""


@dataclass
class Sensor:
    """An ICM-20689 on the SPI: its registers, and where it is in an exchange."""

    identity: int = 0x98
    there: bool = True
    registers: bytearray = field(default_factory=lambda: bytearray(128))
    selected: bool = False
    address: int = -1
    samples: int = 0

    def select(self, selected: bool) -> None:
        self.selected = selected
        self.address = -1

    def exchange(self, byte: int) -> int:
        """One byte each way."""
        if not self.selected or not self.there:
            return 0xFF
        if self.address < 0:
            self.address = byte
            return 0
        place = self.address & 0x7F
        answer = self._read(place)
        if not self.address & 0x80:
            self._write(place, byte)
        self.address = (self.address & 0x80) | ((place + 1) & 0x7F)
        return answer

    def _read(self, place: int) -> int:
        if place == 0x75:
            return self.identity
        if place == 0x3B:  # A new sample with each burst: 1 g on the third axis, turning slowly.
            self.samples += 1
            values = (0, 0, 2048, 327, self.samples & 0x7F, 0, 1)
            data = b"".join(value.to_bytes(2, "big") for value in values)
            self.registers[0x3B : 0x3B + 14] = data
        return self.registers[place]

    def _write(self, place: int, value: int) -> None:
        if place == 0x6B and value & 0x80:
            self.registers[:] = bytes(128)
            self.registers[0x6B] = 0x40
        else:
            self.registers[place] = value


class Board:
    """The chip around the processor."""

    def __init__(self, console: int, select: tuple[int, int], broken: str = "") -> None:
        self.console = console
        self.select = select  # Port and pin of the sensor's chip select.
        self.broken = broken
        self.sensor = Sensor(
            0x12 if broken == "other-sensor" else 0x98, there=broken != "sensor"
        )  # fmt: skip
        self.step_us = 1  # By how much a reading of the time base moves time on.
        self.time_us = 0
        self.text = ""
        self.keys: list[tuple[int, str]] = []  # When, and which.
        self.resets = 0
        self.reset_wanted = False
        self.starved = False
        self.armed_us: list[tuple[int, bool]] = []
        self.exception = 0
        self.words: dict[int, int] = {}
        self.options = RESETS[FLASHR + 0x14]  # Option bytes: brown-out level 2.7 V, and locked.
        self.unlocking: list[int] = []
        self.reset()

    def reset(self) -> None:
        """The registers as a reset leaves them."""
        flags = (1 << 29) if self.starved else (1 << 28) if self.resets else 0x0E00_0000
        self.words = {**RESETS, RCC + 0x74: flags}
        self.words[FLASHR + 0x14] = self.options
        self.reset_wanted = False
        self.starved = False
        self.exception = 0
        self.watchdog_us = 0  # Its time-out; 0: it does not run.
        self.fed_us = self.time_us
        self.counter_from_us = 0
        self.sensor.select(False)

    def tick(self, us: int) -> None:
        """Time passes."""
        self.time_us += us
        if self.watchdog_us and self.time_us - self.fed_us > self.watchdog_us:
            self.starved = True
            self.reset_wanted = True

    # Registers.

    def block(self, address: int) -> int:
        """The peripheral that has a register; there must be one."""
        for base, size in BLOCKS.items():
            if base <= address < base + size:
                return base
        raise ModelError(f"0x{address:08x} is no register of a peripheral that is modelled")

    def read(self, address: int) -> int:
        """What a register reads."""
        self.block(address)
        if address == TIM5 + 0x24:
            self.tick(self.step_us)
            return (self.time_us - self.counter_from_us) & 0xFFFF_FFFF
        if address == self.console + 0x1C:
            due = bool(self.keys) and self.keys[0][0] <= self.time_us
            return self.words[address] | (0x20 if due else 0)
        if address == self.console + 0x24 and self.keys:
            return ord(self.keys.pop(0)[1])
        if address == SPI1 + 0xC:
            self.words[SPI1 + 8] &= ~1
        if address == SCB + 4:
            return self.exception | (0x800 if self.exception else 0)  # RETTOBASE.
        return self.words.get(address, 0)

    def write(self, address: int, value: int) -> None:
        """What writing a register does."""
        base = self.block(address)
        self.words[address] = value
        handler: Callable[[int, int], None] | None = {
            RCC: self._rcc, PWR: self._pwr, IWDG: self._iwdg, SPI1: self._spi, TIM1: self._tim1,
            TIM5: self._tim5, self.console: self._uart, SCB: self._scb, FLASHR: self._flash,
        }.get(base)  # fmt: skip
        if handler:
            handler(address - base, value)
        elif GPIOA <= base < GPIOA + 11 * 0x400:
            self._gpio((base - GPIOA) // 0x400, address - base, value)

    def _follow(self, word: int, control: int, flag: int, broken: bool) -> int:
        return word | flag if word & control and not broken else word & ~flag

    def _rcc(self, offset: int, value: int) -> None:
        if offset == 0:
            word = self._follow(value, 1, 2, False)
            word = self._follow(word, 1 << 16, 1 << 17, self.broken == "hse")
            if word & 1 << 24 and not word & 1 << 17:
                raise ModelError("the PLL is switched on without its oscillator")
            self.words[RCC] = self._follow(word, 1 << 24, 1 << 25, self.broken == "pll")
        elif offset == 4 and self.words[RCC] & 1 << 24:
            raise ModelError("the PLL's factors are changed while it runs")
        elif offset == 8:
            if value & 3 == 2:
                self._check_switch(value)
            self.words[RCC + 8] = (value & ~0xC) | (value & 3) << 2
        elif offset == 0x74 and value & 1 << 24:
            self.words[RCC + 0x74] = 0

    def _check_switch(self, value: int) -> None:
        """What must hold when the core changes to the PLL (RM0410, 3.3.2, 4.1.4 and 5.2)."""
        pll = self.words[RCC + 4]
        hse_mhz = 8 if self.words[RCC] & 1 << 18 else 16
        core_mhz = hse_mhz // (pll & 0x3F) * (pll >> 6 & 0x1FF) // (2 * (pll >> 16 & 3) + 2)
        rules = {
            "the PLL has not locked": self.words[RCC] & 1 << 25,
            "over-drive is not on": self.words.get(PWR + 4, 0) & 0x3_0000 == 0x3_0000,
            "the flash has too few wait states": self.words.get(FLASHR, 0) & 0xF >= 7,
            f"the core would run at {core_mhz} MHz": core_mhz == 216,
            "a bus would be too fast": value >> 10 & 7 == 5 and value >> 13 & 7 == 4,
        }
        for reason, held in rules.items():
            if not held:
                raise ModelError(f"the core changes to the PLL, but {reason}")

    def _pwr(self, offset: int, value: int) -> None:
        if offset == 0 and self.broken != "overdrive":
            self.words[PWR + 4] = self.words.get(PWR + 4, 0) | value & 0x3_0000

    def _flash(self, offset: int, value: int) -> None:
        """Option bytes are programmed at once, if they were unlocked."""
        if offset == 8:
            self.unlocking.append(value)
            if self.unlocking == OPTION_KEYS:
                self.words[FLASHR + 0x14] &= ~1
        elif offset == 0x14:
            if self.unlocking != OPTION_KEYS:
                raise ModelError("option bytes are written while they are locked")
            if value & 2:
                self.options = (value & ~2) | 1
            if value & 1:
                self.unlocking = []
            self.words[FLASHR + 0x14] = value & ~2

    def _iwdg(self, offset: int, value: int) -> None:
        """A key starts it, feeds it, or lets its registers be written until the next one."""
        if offset in (4, 8) and self.words.get(IWDG) != 0x5555:
            raise ModelError("the watchdog's registers are written while they are locked")
        if offset == 0 and (value == 0xCCCC or (value == 0xAAAA and self.watchdog_us)):
            divisor = 4 << self.words.get(IWDG + 4, 0)
            self.watchdog_us = (self.words[IWDG + 8] + 1) * divisor * 1000 // 32
            self.fed_us = self.time_us

    def _spi(self, offset: int, value: int) -> None:
        if offset == 0xC:
            if not self.words.get(SPI1, 0) & 0x40:
                raise ModelError("a byte is sent while the SPI is off")
            self.words[SPI1 + 0xC] = self.sensor.exchange(value & 0xFF)
            self.words[SPI1 + 8] |= 1

    def _tim1(self, offset: int, value: int) -> None:
        if offset == 0x44:
            armed = bool(value & 1 << 15)
            if not self.armed_us or self.armed_us[-1][1] != armed:
                self.armed_us.append((self.time_us, armed))

    def _tim5(self, offset: int, value: int) -> None:
        if offset == 0x14 and value & 1:
            self.counter_from_us = self.time_us

    def _uart(self, offset: int, value: int) -> None:
        if offset == 0x28:
            self.text += chr(value & 0xFF)

    def _scb(self, offset: int, value: int) -> None:
        if offset == 0xC and value >> 16 == 0x05FA and value & 4:
            self.reset_wanted = True

    def _gpio(self, port: int, offset: int, value: int) -> None:
        number, pin = self.select
        if offset == 0x18 and port == number and value >> pin & 0x1_0001:
            self.sensor.select(bool(value >> 16 >> pin & 1))


class Machine:
    """The processor with its memories, and the board around it."""

    def __init__(self, unicorn: Any, image: bytes, address: int, board: Board) -> None:
        self.u = unicorn
        self.board = board
        self.entry = address
        self.pending: tuple[int, int, int] | None = None  # Exception, its status, its address.
        self.error: Exception | None = None
        arm = unicorn.arm_const
        self.r = arm
        self.uc = unicorn.Uc(unicorn.UC_ARCH_ARM, unicorn.UC_MODE_THUMB)
        self.uc.ctl_set_cpu_model(arm.UC_CPU_ARM_CORTEX_M7)
        for base, size in SIZES.items():
            self.uc.mem_map(base, size)
            self.uc.mem_write(base, (b"\xff" if base == FLASH else NOISE[:1]) * size)
        self.uc.mem_write(address, image)
        for start, end in ((0x4000_0000, BACKUP), (BACKUP + 0x1000, 0x4008_0000),
                           (0xE000_0000, 0xE010_0000)):  # fmt: skip
            self.uc.mmio_map(start, end - start, self._read, start, self._write, start)
        u = unicorn
        guarded = u.UC_HOOK_MEM_READ | u.UC_HOOK_MEM_WRITE
        self.uc.hook_add(guarded, self._guard, begin=0, end=0xFF)
        self.uc.hook_add(guarded, self._guard, begin=DTCM, end=DTCM + 0x3FF)
        self.uc.hook_add(u.UC_HOOK_MEM_INVALID, self._unmapped)

    # What the processor meets.

    def _read(self, _: object, offset: int, size: int, start: int) -> int:
        try:
            word = self.board.read((start + offset) & ~3)
            if self.board.reset_wanted:
                self.uc.emu_stop()
            return word >> 8 * (offset & 3) & ((1 << 8 * size) - 1)
        except ModelError as error:
            self._stop(error)
            return 0

    def _write(self, _: object, offset: int, size: int, value: int, start: int) -> None:
        try:
            self.board.write(start + offset, value)
            if self.board.reset_wanted:
                self.uc.emu_stop()
        except ModelError as error:
            self._stop(error)

    def _stop(self, error: Exception) -> None:
        self.error = error
        self.uc.emu_stop()

    def _guard(
        self, _: object, access: int, address: int, size: int, value: int, data: object
    ) -> None:
        del access, size, value, data
        if self.board.words.get(SCB + 0x94, 0) & 1 and not self.pending:  # The MPU is on.
            self.pending = (MEMORY, 0x82, address)  # DACCVIOL, MMARVALID.
            self.uc.emu_stop()

    def _unmapped(
        self, _: object, access: int, address: int, size: int, value: int, data: object
    ) -> bool:
        del access, size, value, data
        self.pending = (BUS, 0x8200, address)  # PRECISERR, BFARVALID.
        self.uc.emu_stop()
        return False

    # Reset, faults, and the run.

    def word(self, address: int) -> int:
        return int.from_bytes(self.uc.mem_read(address, 4), "little")

    def start(self) -> int:
        """A reset; where the program begins."""
        for base, size in SIZES.items():
            if base not in KEPT:
                self.uc.mem_write(base, NOISE * (size // 4))
        self.board.reset()
        self.uc.reg_write(self.r.UC_ARM_REG_SP, self.word(self.entry))
        self.uc.reg_write(self.r.UC_ARM_REG_LR, 0xFFFF_FFFF)
        return self.word(self.entry + 4)

    def enter(self, pending: tuple[int, int, int]) -> int:
        """The entry of an exception; where its handler begins."""
        number, status, address = pending
        r = self.r
        if self.board.exception:
            raise ModelError(
                f"exception {number} in the handler of {self.board.exception}: lock-up"
            )
        names = (r.UC_ARM_REG_R0, r.UC_ARM_REG_R1, r.UC_ARM_REG_R2, r.UC_ARM_REG_R3,
                 r.UC_ARM_REG_R12, r.UC_ARM_REG_LR, r.UC_ARM_REG_PC, r.UC_ARM_REG_CPSR)  # fmt: skip
        values = [int(self.uc.reg_read(name)) & 0xFFFF_FFFF for name in names]
        values[7] |= 1 << 24
        sp = int(self.uc.reg_read(r.UC_ARM_REG_SP)) - 32 & ~7
        self.uc.mem_write(sp, b"".join(value.to_bytes(4, "little") for value in values))
        self.uc.reg_write(r.UC_ARM_REG_SP, sp)
        self.uc.reg_write(r.UC_ARM_REG_LR, EXC_RETURN)
        self.board.words[SCB + 0x28] = status
        self.board.words[SCB + (0x34 if number == MEMORY else 0x38)] = address
        self.board.exception = number
        return self.word(self.board.words[SCB + 8] + 4 * number)

    def run(self, until_us: int) -> None:
        """Run until the board's time has come."""
        pc = self.start()
        while self.board.time_us < until_us:
            before = self.board.time_us
            try:
                self.uc.emu_start(pc | 1, 0, count=SLICE)
            except self.u.UcError as error:
                if error.errno == self.u.UC_ERR_INSN_INVALID:
                    self.pending = (USAGE, 0x1_0000, 0)  # UNDEFINSTR.
                elif not self.pending:
                    at = int(self.uc.reg_read(self.r.UC_ARM_REG_PC))
                    raise ModelError(f"at 0x{at:08x}: {error}") from error
            if self.error:
                at = int(self.uc.reg_read(self.r.UC_ARM_REG_PC))
                raise ModelError(f"at 0x{at:08x}: {self.error}")
            pc = int(self.uc.reg_read(self.r.UC_ARM_REG_PC))
            if self.board.time_us == before:
                self.board.tick(SLICE_US)
            if self.board.reset_wanted:
                self.board.resets += 1
                self.pending = None
                pc = self.start()
            elif self.pending:
                pc, self.pending = self.enter(self.pending), None


CONSOLES = {"nucleo_f767zi": (USART3, (3, 14)), "fmuv5": (UART7, (5, 2))}


def simulate(
    tools: Toolchain, root: Path, name: str, seconds: float,
    keys: Sequence[tuple[int, str]] = (), broken: str = "", step_us: int = 1,
    options: int = RESETS[FLASHR + 0x14],
) -> Board:  # fmt: skip
    """Run a board's image; the board afterwards. Longer steps make a shorter, coarser run."""
    if name not in CONSOLES:
        raise ModelError(f"no model of {name}; there are: {', '.join(CONSOLES)}")
    image = read_image(root, name)
    folder = tools.command("unicorn")[0]
    if folder not in sys.path:
        sys.path.insert(0, folder)
    unicorn = importlib.import_module("unicorn")
    importlib.import_module("unicorn.arm_const")
    board = Board(*CONSOLES[name], broken)
    board.keys = sorted(keys)
    board.step_us = step_us
    board.options = options
    machine = Machine(unicorn, image.binary.read_bytes(), image.address, board)
    machine.run(int(seconds * 1e6))
    return board


def read_key(text: str) -> tuple[int, str]:
    """A key with its time, as 1.5:t."""
    when, _, key = text.partition(":")
    try:
        if len(key) == 1:
            return int(float(when) * 1e6), key
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"{text!r} is no SECONDS:KEY")


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Run a board's image on a model of its chip.")
    parser.add_argument("board", help="the board, a folder of bsp")
    parser.add_argument("--seconds", type=float, default=2.0, help="of the board's time")
    parser.add_argument("--keys", type=read_key, nargs="*", default=[], metavar="SECONDS:KEY")
    parser.add_argument("--broken", choices=BROKEN, default="", help="what does not work")
    options = parser.parse_args(arguments)
    report = root / REPORT / f"{options.board}.json"
    report.unlink(missing_ok=True)
    try:
        tools = Toolchain()
        tools.ensure("model")
        board = simulate(
            tools, root, options.board, options.seconds, options.keys, options.broken
        )  # fmt: skip
    except (ModelError, FlashError, ToolchainError, OSError) as error:
        print(f"model: {error}", file=sys.stderr)
        return 1
    print(board.text.replace("\r", ""), end="")
    report.parent.mkdir(parents=True, exist_ok=True)
    content = {"board": options.board, "seconds": options.seconds, "resets": board.resets,
               "sensor_samples": board.sensor.samples, "armed_us": board.armed_us,
               "console": board.text}  # fmt: skip
    write_atomically(report, json.dumps(content, indent=1) + "\n")
    good = f"Keel on {options.board}" in board.text or "safe state" in board.text
    print(f"model: {options.board}: {options.seconds:g} s of its time, {board.resets} resets"
          f"{'' if good else ', but it did not say what it is'}.")  # fmt: skip
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
