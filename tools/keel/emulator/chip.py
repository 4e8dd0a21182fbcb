# SPDX-License-Identifier: Apache-2.0
"""A model of the STM32F767 around its processor: register by register, what our images use."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from keel.base.errors import ToolError
from keel.emulator.attached import DMAS, I2C3, Attached, ClockError
from keel.emulator.bmi055 import ACCELEROMETER_ID, GYROSCOPE_ID, Bmi055Part
from keel.emulator.capture import TIM8, Capture
from keel.emulator.card import CardError, CardHost, SdCard
from keel.emulator.dma_uart import UARTS, DmaUartError
from keel.emulator.fram import Fram
from keel.emulator.i2c import CR2 as I2C_CR2
from keel.emulator.i2c import START, I2c, I2cError
from keel.emulator.icm20689 import IDENTITY, OTHER, Icm20689
from keel.emulator.ist8310 import ADDRESS as IST8310_ADDRESS
from keel.emulator.ist8310 import Ist8310
from keel.emulator.ms5611 import Ms5611
from keel.emulator.pulses import Outputs, PulseError, State, timers
from keel.emulator.spi import DATA, SPI1, SPI2, SPI4, Device, Registers, SpiError, Spis
from keel.emulator.wiring import BMI055, UART7, USART3, Wiring

# Bases of the peripherals (RM0410, table 1).
TIM5, IWDG, PWR, TIM1, TIM4 = 0x4000_0C00, 0x4000_3000, 0x4000_7000, 0x4001_0000, 0x4000_0800
GPIOA, RCC, FLASHR, TIM12 = 0x4002_0000, 0x4002_3800, 0x4002_3C00, 0x4000_1800
TIM9 = 0x4001_4000
SYSTICK, NVIC, SCB, DBGMCU = 0xE000_E010, 0xE000_E100, 0xE000_ED00, 0xE004_2000
ADC1, ADC_COMMON, SDMMC1 = 0x4001_2000, 0x4001_2300, 0x4001_2C00
BLOCKS = {
    TIM5: 0x54,
    IWDG: 0x14,
    USART3: 0x2C,
    PWR: 0x10,
    UART7: 0x2C,
    TIM1: 0x68,
    SPI1: 0x24,
    SPI2: 0x24,
    SPI4: 0x24,
    RCC: 0x98,
    FLASHR: 0x1C,
    SCB: 0x2A4,
    DBGMCU: 0x10,
    SYSTICK: 0x10,
    TIM4: 0x54,
    TIM12: 0x54,
    TIM9: 0x54,
    TIM8: 0x68,
    NVIC: 0x200,
    ADC1: 0x50,
    ADC_COMMON: 0xC,
    SDMMC1: 0x84,
    I2C3: 0x2C,
    **dict.fromkeys(DMAS.values(), 0xD0),
    **{uart.base: 0x2C for uart in UARTS.values()},
    **{GPIOA + 0x400 * port: 0x2C for port in range(11)},
}
# By each address of a byte.
BASE_OF = {base + i: base for base, size in BLOCKS.items() for i in range(size)}
RESETS = {
    FLASHR + 0x10: 1 << 31,
    RCC: 0x83,
    RCC + 4: 0x2400_3010,
    RCC + 0x30: 0x0010_0000,
    RCC + 0x74: 0x0E00_0000,
    PWR: 0xC000,
    USART3 + 0x1C: 0xC0,
    UART7 + 0x1C: 0xC0,
    SPI1 + 4: 0x700,
    SPI1 + 8: 2,
    SPI2 + 4: 0x700,
    SPI2 + 8: 2,
    SPI4 + 4: 0x700,
    SPI4 + 8: 2,
    IWDG + 8: 0xFFF,
    FLASHR + 0x14: 0xFFFF_AAF1,
    GPIOA: 0xA800_0000,
    GPIOA + 0x400: 0x280,
    SCB + 0x80: 0xF00F_E019,  # 128 sets of 4 ways of 32 bytes, by Arm's manual for 16 KiB.
    SCB + 0x90: 0x800,
}

TIME_BASE = TIM5 + 0x24  # Its counter.
SPI_DATA = (SPI1 + 0xC, SPI2 + 0xC, SPI4 + 0xC)
# Peripherals that the model knows to need their clocks: the register, and the bit.
CLOCKED = {timer.base: timer.enable for timer in timers().values()}
OPTION_KEYS = [0x0819_2A3B, 0x4C5D_6E7F]
FLASH_KEYS, FLASH_LOCK = [0x4567_0123, 0xCDEF_89AB], 1 << 31
OPTIONS = RESETS[FLASHR + 0x14]  # Option bytes: brown-out level 2.7 V, and locked.
CORE_MHZ = 216
I2C_FUNCTION = 4  # Of the pins of I2C 3.
PPM_FUNCTION = 3  # Of the pin that timer 8 captures at.
# Without the first, with another one in its place, …
SENSORS = ("sensor", "other-sensor", "second-sensor", "third-sensor")
BROKEN = ("hse", "pll", "overdrive", "adc", "memory", "barometer", "magnetometer", *SENSORS)


# What RCC_CSR tells of a reset (RM0410, 5.3.21); each pulls the reset pin, too.
BOR, PIN, POR, SOFTWARE, WATCHDOG = (1 << bit for bit in range(25, 30))
REMOVE_FLAGS = 1 << 24
NMI, USAGE_FAULT = 2, 6
# Mishaps of a board: the exception, or the reset's cause. A clock that is lost is an exception, and
# may be there again behind it, or not.
EXCEPTIONS = {"fault": USAGE_FAULT, "clock": NMI, "clock for good": NMI}
MISHAPS = {"brown-out": BOR | PIN, "pin": PIN, "watchdog": 0, **dict.fromkeys(EXCEPTIONS, 0)}

# A card's slot: clock, command and data, by port and pin, and what switches its supply.
CARD_PINS, CARD_POWER = ((2, 12), (3, 2), (2, 8), (2, 9), (2, 10), (2, 11)), (6, 7)


class ModelError(ToolError):
    """The image did what must not be; the message says what and where."""

    status = 1


# What the maker counted: the reference at 3.3 V, the temperature at 30 and at 110 degrees.
SYSTEM, CALIBRATION = 0x1FF0_F44A, (1502, 943, 1186)
# The chip's own number, 96 bits.
UID_PLACE, UID = 0x1FF0_F420, bytes(range(0x41, 0x4D))
# What ADC1 counts on each channel: pins 0 to 15, the reference, and temperature or battery.
COUNTS = {0: 1026, 1: 200, 2: 0, 3: 4095, 10: 3138, 11: 2071, 17: 1519, 18: 1000}
BATTERY = 950
CYCLES = (3, 15, 28, 56, 84, 112, 144, 480)  # To sample, by their code.
PIN_OF = {
    **{i: (0, i) for i in range(8)},
    8: (1, 0),
    9: (1, 1),
    **{10 + i: (2, i) for i in range(6)},
}


@dataclass
class Converter:
    """ADC1: what its registers do not keep."""

    flags: int = 0
    on_us: int | None = None  # Since when it is on, and the chip's own sensors.
    sensors_us: int | None = None
    converting: bool = False


class Chip:
    """The chip around the processor."""

    def __init__(
        self,
        wiring: Wiring,
        broken: str = "",
        outputs: Sequence[str] = (),
        fram: Fram | None = None,
    ) -> None:
        self.console = wiring.console
        self.broken = broken
        identity = OTHER if broken == "other-sensor" else IDENTITY
        self.sensor = Icm20689(identity, there=broken != "sensor")
        self.third = Icm20689(OTHER, there=broken != "third-sensor")  # The ICM-20602.
        self.gyroscope = Bmi055Part(GYROSCOPE_ID, there=broken != "second-sensor")
        self.accelerometer = Bmi055Part(ACCELEROMETER_ID, there=broken != "second-sensor")
        self.step_us = 1  # By how much a reading of the time base moves time on.
        self.time_us = 0
        self.text = ""
        self.keys: list[tuple[int, str]] = []  # When, and which.
        self.resets = 0
        self.reset_wanted = False
        self.cause = POR | BOR | PIN  # Of the reset.
        self.flags = 0  # Those of resets, until the image clears them.
        self.mishaps: list[tuple[int, str]] = []  # When, and which of MISHAPS.
        self.raised = 0  # The exception that one of them is.
        self.reset_us: list[int] = []  # When it was reset, …
        self.begun_us: list[int] = []  # … and when the watchdog was started: all is ready.
        self.armed_us: list[tuple[int, bool]] = []
        self.outputs = Outputs(outputs)
        self.counts = dict(COUNTS)
        self.converted: list[int] = []  # Channels of the converter, in their order.
        self.exception = 0
        self.fram = fram or Fram(there=broken != "memory")
        self.barometer = Ms5611(there=broken != "barometer")
        devices: dict[str, Device] = {
            "ICM-20689": self.sensor,
            "ICM-20602": self.third,
            "memory": self.fram,
            "barometer": self.barometer,
            **dict(zip(BMI055, (self.gyroscope, self.accelerometer), strict=True)),
        }
        self.spis = Spis(wiring.buses, [(seat, devices[seat.name]) for seat in wiring.seats])
        self.i2c_pins = wiring.i2c
        self.button = wiring.button
        self.presses: list[tuple[int, int]] = []  # From when to when the button is held, in us.
        self.magnetometer = Ist8310(there=broken != "magnetometer")
        self.i2c = I2c({IST8310_ADDRESS: self.magnetometer})
        self.store: Callable[[int, int], None] = lambda *_: None  # The processor has the memory.
        self.ppm = Capture(
            lambda address, byte: self.store(address, byte),
            lambda: timers()["TIM9"].mhz(self.words),
            lambda: wiring.ppm is not None and self._is_pulled_up(wiring.ppm, PPM_FUNCTION),
        )
        self.attached = Attached(
            wiring.lines,
            self.i2c if wiring.i2c else None,
            self.ppm if wiring.ppm else None,
            lambda clock: self.words.get(clock[0], 0) >> clock[1] & 1 != 0,
            self._function_of,
            lambda address, byte: self.store(address, byte),
        )
        self.lines = self.attached.lines
        self.handlers: dict[int, Callable[[int, int], None]] = {
            RCC: self._rcc,
            PWR: self._pwr,
            IWDG: self._iwdg,
            **{spi: partial(self._spi, spi) for spi in (SPI1, SPI2, SPI4)},
            TIM1: self._tim1,
            TIM5: self._tim5,
            self.console: self._uart,
            SCB: self._scb,
            FLASHR: self._flash,
            ADC1: self._adc,
            ADC_COMMON: self._adc_common,
            SDMMC1: self._sdmmc,
            SYSTICK: self._systick,
        }
        self.card: SdCard | None = None  # In the slot.
        self.slot = CardHost()
        self.words: dict[int, int] = {}
        self.options = OPTIONS
        self.unlocking: list[int] = []
        self.unlocking_flash: list[int] = []
        self.erase: Callable[[int], None] = lambda _: None  # The processor has the memory.
        self.reset()

    def reset(self) -> None:
        """The registers as a reset leaves them."""
        self.flags |= self.cause
        self.words = {**RESETS, RCC + 0x74: self.flags}
        self.words[FLASHR + 0x14] = self.options
        self.reset_wanted = False
        self.is_fed = True  # By whoever tries to.
        self.exception = 0
        self.watchdog_us = 0  # Its time-out; 0: it does not run.
        self.fed_us = self.time_us
        self.counter_from_us = 0
        self.spis.reset()
        self.attached.reset()
        self.adc = Converter()
        self.slot = CardHost(self.card)
        self.flash_is_open = False
        self.unlocking_flash = []
        self.high: dict[tuple[int, int], int] = {}  # Pins that were set, with when.
        self.outputs.reset(self.time_us)

    def tick(self, us: int) -> None:
        """Time passes."""
        self.time_us += us
        if self.watchdog_us and self.time_us - self.fed_us > self.watchdog_us:
            self._reset_by(WATCHDOG | PIN)
        if self.mishaps and self.time_us >= self.mishaps[0][0]:
            self._befall(self.mishaps.pop(0)[1])
        if self.outputs.due_us is not None and self.time_us >= self.outputs.due_us:
            self.outputs.advance(self.time_us, self.words)
            self.outputs.note(self.time_us, self.words, self.high, at_period=True)

    def _reset_by(self, cause: int) -> None:
        if not self.reset_wanted:
            self.reset_us.append(self.time_us)
        self.cause, self.reset_wanted = cause, True

    def _befall(self, mishap: str) -> None:
        if mishap == "watchdog":
            self.is_fed = False
        elif mishap in EXCEPTIONS:
            self.raised = EXCEPTIONS[mishap]
            self.broken = "hse" if mishap == "clock for good" else self.broken
        else:
            self._reset_by(MISHAPS[mishap])

    def level(self, pin: tuple[int, int]) -> State:
        """What a pin does that no timer has."""
        mode = self.words.get(GPIOA + 0x400 * pin[0], 0) >> 2 * pin[1] & 3
        return ("high" if pin in self.high else "low") if mode == 1 else "floats"

    # Registers.

    def block(self, address: int) -> int:
        """The peripheral that has a register; there must be one."""
        base = BASE_OF.get(address)
        if base is None:
            raise ModelError(f"0x{address:08x} is no register of a peripheral that is modelled")
        return base

    def read(self, address: int) -> int:
        """What a register reads."""
        if address == TIME_BASE:  # First, as nothing is read so often.
            self.tick(self.step_us)
            return (self.time_us - self.counter_from_us) & 0xFFFF_FFFF
        base = self.block(address)
        if base in self.attached.blocks:
            return self._read_attached(base, address - base)
        if address == self.console + 0x1C:
            due = bool(self.keys) and self.keys[0][0] <= self.time_us
            return self.words[address] | (0x20 if due else 0)
        if address == self.console + 0x24 and self.keys:
            return ord(self.keys.pop(0)[1])
        if address in SPI_DATA:
            self.words[address - 4] &= ~1
        if address in (ADC1, ADC1 + 0x4C):
            return self._adc_read(address - ADC1)
        if SDMMC1 <= address < SDMMC1 + 0x84:
            return self._sdmmc_read(address - SDMMC1)
        if GPIOA <= base < GPIOA + 11 * 0x400 and address - base == 0x10:
            return self._inputs((base - GPIOA) // 0x400)
        if address == SCB + 4:
            pending = self.words.get(address, 0) & 1 << 26
            return pending | self.exception | (0x800 if self.exception else 0)  # RETTOBASE.
        return self.words.get(address, 0)

    def write(self, address: int, value: int) -> None:
        """What writing a register does."""
        base = self.block(address)
        if base in CLOCKED and not self.words.get(CLOCKED[base][0], 0) >> CLOCKED[base][1] & 1:
            return  # Without its clock a peripheral takes nothing.
        if base in self.attached.blocks:
            self._write_attached(base, address - base, value)
            return
        self.words[address] = value
        handler = self.handlers.get(base)
        if handler:
            handler(address - base, value)
        elif GPIOA <= base < GPIOA + 11 * 0x400:
            self._gpio((base - GPIOA) // 0x400, address - base, value)
        if base in CLOCKED or (base in self.outputs.ports and address - base < 0x28):
            self._outputs(base, address - base)

    def _read_attached(self, base: int, offset: int) -> int:
        """What a register of a peripheral reads that is a model of its own."""
        try:
            return self.attached.read(base, offset, self.time_us)
        except (ClockError, DmaUartError, I2cError) as error:
            raise ModelError(str(error)) from error

    def _write_attached(self, base: int, offset: int, value: int) -> None:
        """What writing a register of such a peripheral does."""
        try:
            if base == I2C3 and offset == I2C_CR2 and value & START:
                self._check_i2c_pins()
            self.attached.write(base, offset, value, self.time_us)
        except (ClockError, DmaUartError, I2cError) as error:
            raise ModelError(str(error)) from error

    def _check_i2c_pins(self) -> None:
        for pin in self.i2c_pins or ():
            open_drain = self.words.get(GPIOA + 0x400 * pin[0] + 4, 0) >> pin[1] & 1
            if self._function_of(pin) != I2C_FUNCTION or not open_drain:
                raise ModelError("a transfer begins, but a pin is not the I2C's, or pushes")

    def _inputs(self, port: int) -> int:
        """What pins read, as far as anything is joined to them: the lines of the I2C, and the
        button of the safety switch."""
        levels = dict(zip(self.i2c_pins or (), self.i2c.lines(), strict=False))
        if self.button and self.button[0] == port:
            levels[self.button] = self._is_pressed(self.button)
        return sum(high << pin[1] for pin, high in levels.items() if pin[0] == port)

    def _is_pressed(self, pin: tuple[int, int]) -> bool:
        """A button joins its pin to the supply; open, the pin is what it is pulled to."""
        base, place = GPIOA + 0x400 * pin[0], 2 * pin[1]
        if self.words.get(base, 0) >> place & 3 or self.words.get(base + 0xC, 0) >> place & 3 != 2:
            raise ModelError("the button is read, but its pin is no input that is pulled down")
        return any(begin <= self.time_us < end for begin, end in self.presses)

    def _outputs(self, base: int, offset: int) -> None:
        """A timer of the outputs, or a port, has changed."""
        try:
            begins = base in CLOCKED and self.outputs.write(base, offset, self.time_us, self.words)
            self.outputs.note(self.time_us, self.words, self.high, begins)
        except PulseError as error:
            raise ModelError(str(error)) from error

    def _systick(self, offset: int, value: int) -> None:
        """Whoever starts it sleeps until its end, which is at once: the time has gone by."""
        if offset == 0 and value & 1:
            self.tick((self.words[SYSTICK + 4] + 1) // CORE_MHZ)
            self.words[SYSTICK + 8] = self.words[SYSTICK + 4]  # It counts anew.
            self.words[SCB + 4] = 1 << 26  # PENDSTSET.

    def _follow(self, word: int, control: int, flag: int, broken: bool) -> int:
        return word | flag if word & control and not broken else word & ~flag

    def _rcc(self, offset: int, value: int) -> None:
        self.spis.changed()
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
            self.words[RCC + 0x74] = self.flags = 0

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
        """What is erased, or programmed into option bytes, is so at once, if it was unlocked."""
        if offset == 4:
            self.unlocking_flash = [*self.unlocking_flash[-1:], value]
            if self.unlocking_flash == FLASH_KEYS:
                self.flash_is_open = True
                self.words[FLASHR + 0x10] &= ~FLASH_LOCK
        elif offset == 0xC:
            self.words[FLASHR + 0xC] = 0  # Ones clear, and nothing sets them here.
        elif offset == 0x10:
            self._flash_control(value)
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

    def _flash_control(self, value: int) -> None:
        """A sector is erased; locked, nothing changes."""
        self.words[FLASHR + 0x10] = value & ~(1 << 16)
        if value & FLASH_LOCK:
            self.flash_is_open = False
            return
        if not self.flash_is_open:
            self.words[FLASHR + 0x10] = FLASH_LOCK
            raise ModelError("the flash is used while it is locked")
        if value & 1 << 16:
            if value & 0x307 != 0x202:
                raise ModelError("an erasure is not of a sector, by words")
            self.erase(value >> 3 & 0x1F)

    def program(self, size: int, before: int, value: int) -> None:
        """A store to the flash: what must hold, and that no bit rises."""
        control = self.words.get(FLASHR + 0x10, 0)
        for reason, held in {
            "it is not being programmed": control & 1 and not control & FLASH_LOCK,
            "by another size than was set": size == 1 << (control >> 8 & 3),
            "where it is not erased": value & ~before == 0,
            "while the protection is on": not self.words.get(SCB + 0x94, 0) & 1,
        }.items():
            if not held:
                raise ModelError(f"something is stored to the flash, but {reason}")

    def _iwdg(self, offset: int, value: int) -> None:
        """A key starts it, feeds it, or lets its registers be written until the next one."""
        if offset in (4, 8) and self.words.get(IWDG) != 0x5555:
            raise ModelError("the watchdog's registers are written while they are locked")
        feeds = value == 0xAAAA and self.watchdog_us and self.is_fed
        if offset == 0 and value == 0xCCCC:
            self.begun_us.append(self.time_us)
        if offset == 0 and (value == 0xCCCC or feeds):
            divisor = 4 << self.words.get(IWDG + 4, 0)
            self.watchdog_us = (self.words[IWDG + 8] + 1) * divisor * 1000 // 32
            self.fed_us = self.time_us

    def _spi(self, base: int, offset: int, value: int) -> None:
        if offset != DATA:
            self.spis.changed()
            return
        registers = Registers(self.words, self.high, self._function_of, self._is_output)
        try:
            self.words[base + DATA] = self.spis.exchange(
                base, value & 0xFF, self.time_us, registers
            )
        except SpiError as error:
            raise ModelError(str(error)) from error
        self.words[base + 8] |= 1

    def _is_output(self, pin: tuple[int, int]) -> bool:
        return self.words.get(GPIOA + 0x400 * pin[0], 0) >> 2 * pin[1] & 3 == 1

    def _function_of(self, pin: tuple[int, int]) -> int | None:
        """Which alternate function a pin has; None when it has none."""
        base, number = GPIOA + 0x400 * pin[0], pin[1]
        if self.words.get(base, 0) >> 2 * number & 3 != 2:
            return None
        return self.words.get(base + 0x20 + 4 * (number // 8), 0) >> 4 * (number % 8) & 0xF

    def _is_pulled_up(self, pin: tuple[int, int], function: int) -> bool:
        """Whether a pin has an alternate function, and a pull-up for who only pulls it low."""
        pull = self.words.get(GPIOA + 0x400 * pin[0] + 0xC, 0) >> 2 * pin[1] & 3
        return pull == 1 and self._function_of(pin) == function

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
            self._reset_by(SOFTWARE | PIN)

    def _gpio(self, port: int, offset: int, value: int) -> None:
        if offset != 0x18:
            self.spis.changed()
            return
        for bit in range(16):
            if not value >> bit & 0x1_0001:
                continue
            pin = (port, bit)
            if value >> bit & 1:
                self.high.setdefault(pin, self.time_us)
                self.spis.select(pin, False)
            else:
                self.high.pop(pin, None)
                self.spis.select(pin, True)
        if self.i2c_pins and all(map(self._is_output, self.i2c_pins)):
            scl, sda = (pin in self.high for pin in self.i2c_pins)
            self.i2c.drive(scl, sda)

    # The slot.

    def _sdmmc_read(self, offset: int) -> int:
        try:
            return self.slot.read(offset)
        except CardError as error:
            raise ModelError(str(error)) from error

    def _sdmmc(self, offset: int, value: int) -> None:
        if offset == 0xC and value & 1 << 10:
            self._check_slot()
        self.slot.card = self.card
        try:
            self.slot.write(offset, value)
        except CardError as error:
            raise ModelError(str(error)) from error

    def _check_slot(self) -> None:
        """What must hold around SDMMC1 before its first command."""
        pll = self.words[RCC + 4]
        hse_mhz = 8 if self.words[RCC] & 1 << 18 else 16
        usb_mhz = hse_mhz // (pll & 0x3F) * (pll >> 6 & 0x1FF) // max(pll >> 24 & 0xF, 1)
        rules = {
            "it has no clock": self.words.get(RCC + 0x44, 0) & 1 << 11,
            "its clock is not that of the PLL": not self.words.get(RCC + 0x90, 0) & 3 << 27,
            f"its clock is {usb_mhz} MHz": usb_mhz == 48,
            "a pin is not its own": all(self._function_of(pin) == 12 for pin in CARD_PINS),
            "the card has no supply": CARD_POWER in self.high,
        }
        for reason, held in rules.items():
            if not held:
                raise ModelError(f"a command goes to the card, but {reason}")

    # The converter: one conversion of one channel at a time, done at once.

    def _adc_read(self, offset: int) -> int:
        """The flags, or the data, whose reading takes the end back."""
        if offset == 0:
            return self.adc.flags
        self.adc.flags &= ~2
        return self.words.get(ADC1 + 0x4C, 0)

    def _adc(self, offset: int, value: int) -> None:
        if offset == 0:
            self.adc.flags &= value
        elif offset == 8:
            self._adc_power(bool(value & 1))
            if value & 1 << 30:
                self._convert()

    def _adc_power(self, on: bool) -> None:
        """Off ends a conversion."""
        if not on:
            self.adc.on_us = None
            self.adc.converting = False
        elif self.adc.on_us is None:
            self.adc.on_us = self.time_us

    def _adc_common(self, offset: int, value: int) -> None:
        if offset == 4 and not value & 1 << 23:
            self.adc.sensors_us = None
        elif offset == 4 and self.adc.sensors_us is None:
            self.adc.sensors_us = self.time_us

    def _convert(self) -> None:
        """A conversion, or none that ends."""
        channel = self.words.get(ADC1 + 0x34, 0) & 0x1F
        for reason, held in self._conversion_rules(channel).items():
            if not held:
                raise ModelError(f"a conversion of channel {channel} is started, but {reason}")
        self.converted.append(channel)
        if self.broken == "adc":
            self.adc.converting = True
            return
        battery = channel == 18 and self.words[ADC_COMMON + 4] & 1 << 22
        resolution = self.words.get(ADC1 + 4, 0) >> 24 & 3
        self.words[ADC1 + 0x4C] = (BATTERY if battery else self.counts[channel]) >> 2 * resolution
        self.words[ADC1 + 8] &= ~(1 << 30)
        self.adc.flags |= 0x32 if self.adc.flags & 2 else 0x12  # An end that nobody took: overrun.

    def _adc_mhz(self) -> float:
        """The converter's clock."""
        control = self.words.get(RCC + 8, 0)
        core_mhz = 216 if control & 0xC == 8 else 16
        prescaler = control >> 13 & 7
        bus_mhz = core_mhz / (2 << prescaler - 4 if prescaler >= 4 else 1)
        return bus_mhz / (2 * (self.words.get(ADC_COMMON + 4, 0) >> 16 & 3) + 2)

    def _conversion_rules(self, channel: int) -> dict[str, bool]:
        """What must hold when a conversion starts (RM0410, 15.3 to 15.10, and the data sheet)."""
        on_us, sensors_us = self.adc.on_us, self.adc.sensors_us
        mhz = self._adc_mhz()
        times = self.words.get(ADC1 + (0xC if channel > 9 else 0x10), 0)
        sampled_us = CYCLES[times >> 3 * (channel % 10) & 7] / mhz
        port, pin = PIN_OF.get(channel, (0, 0))
        mode = self.words.get(GPIOA + 0x400 * port, 0) >> 2 * pin & 3
        return {
            "the converter has no clock": bool(self.words.get(RCC + 0x44, 0) & 1 << 8),
            "the converter is off": on_us is not None,
            "the converter is not up yet": on_us is None or self.time_us - on_us >= 3,
            f"its clock is {mhz:g} MHz": 0.6 <= mhz <= 36,
            "another has not ended": not self.adc.converting,
            "there would be more than one": not self.words.get(ADC1 + 0x2C, 0) >> 20 & 0xF,
            "that is joined to nothing": channel in COUNTS,
            "its pin is not analogue": channel not in PIN_OF or mode == 3,
            "the sensors are not up": channel in PIN_OF
            or (sensors_us is not None and self.time_us - sensors_us >= 10),
            f"it is sampled for {sampled_us:g} us": channel in PIN_OF or sampled_us >= 10,
        }
