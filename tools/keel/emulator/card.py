# SPDX-License-Identifier: Apache-2.0
"""A model of SDMMC1 and of an SD card of high capacity behind it, strict about what each is told.

By the STM32F767's reference manual (RM0410, chapter 39), and by the SD Physical Layer Simplified
Specification: its commands (4.7.4), states (4.8) and status (4.10.1). The card's content is an
image, as a PC would read it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from keel.base.errors import ToolError

SECTOR, UNIT = 512, 512 * 1024
IDLE, READY, IDENTIFY, STANDBY, TRANSFER, SENDING, RECEIVING, PROGRAMMING = range(8)
CONDITIONS, IS_READY, IS_HIGH = 0x00FF_8000, 1 << 31, 1 << 30
ILLEGAL, OUT_OF_RANGE = 1 << 22, 1 << 31
SILENT, SHORT, LONG = 0, 1, 3
ADDRESS = 0xB368

# Bits of SDMMC_STA.
CHECKSUM, TIMEOUT, DATA_TIMEOUT, ANSWERED, SENT = 1 << 0, 1 << 2, 1 << 3, 1 << 6, 1 << 7
DATA_END, BLOCK_END = 1 << 8, 1 << 10
SENDS, RECEIVES, HALF_EMPTY, HALF_FULL = 1 << 12, 1 << 13, 1 << 14, 1 << 15
STATIC = 0x0000_05FF
HALF = 32  # Bytes of half the FIFO.
IDENTIFY_HZ, TRANSFER_HZ = 400_000, 25_000_000


class CardError(ToolError):
    """The host did what must not be; the message says what."""

    status = 1


@dataclass
class SdCard:
    """The card."""

    image: bytearray
    there: bool = True
    busy_looks: int = 2  # For so many questions it programs behind each write.
    ready_after: int = 2  # Questions until it is ready.
    state: int = IDLE
    address: int = 0
    errors: int = 0
    wide: bool = False
    at: int = 0  # The next sector of a transfer.
    single: bool = False
    written: int = 0  # Sectors.
    _application: bool = False
    _questions: int = 0
    _busy: int = 0

    def __post_init__(self) -> None:
        if not self.image or len(self.image) % UNIT:
            raise ToolError(f"a card has a multiple of {UNIT} bytes, not {len(self.image)}")

    @property
    def data(self) -> list[int]:
        """Its card-specific data, version 2."""
        size = len(self.image) // UNIT - 1
        return [0x400E_0032, 0x5B59_0000 | size >> 16, (size & 0xFFFF) << 16 | 0x7F80, 0x0A40_0001]

    def obey(self, index: int, argument: int) -> list[int] | None:
        """The words of its answer; None when it does not answer."""
        application, self._application = self._application, False
        if not self.there or (index in (7, 9, 13, 55) and argument >> 16 != self.address):
            return None
        if application and index in (6, 41):
            return self._question(argument) if index == 41 else self._lines(argument)
        commands = {
            0: self._idle,
            2: self._identify,
            3: self._name,
            7: self._select,
            8: self._condition,
            9: self._describe,
            12: self._stop,
            13: self._look,
            55: self._announce,
        }
        if index in (17, 18, 24, 25):
            return self._begin(index, argument)
        return commands[index](argument) if index in commands else self._refuse()

    def _status(self) -> list[int]:
        word = self.errors | self.state << 9 | (0x100 if self.state == TRANSFER else 0)
        self.errors = 0
        return [word]

    def _refuse(self) -> list[int] | None:
        self.errors |= ILLEGAL
        return None  # No answer.

    def _move(self, state: int, following: int) -> list[int] | None:
        if self.state != state:
            return self._refuse()
        words = self._status()  # Of the state that it comes from.
        self.state = following
        return words

    def _idle(self, _: int) -> list[int]:
        self.state, self.address, self.errors, self.wide = IDLE, 0, 0, False
        self._questions = 0
        return []

    def _identify(self, _: int) -> list[int] | None:
        if self.state != READY:
            return self._refuse()
        self.state = IDENTIFY
        return [0x0353_4453, 0x4C30_3847, 0x8012_3456, 0x7801_2301]

    def _name(self, _: int) -> list[int] | None:
        if self.state != IDENTIFY:
            return self._refuse()
        self.state, self.address = STANDBY, ADDRESS
        return [ADDRESS << 16]

    def _select(self, _: int) -> list[int] | None:
        return self._move(STANDBY, TRANSFER)

    def _condition(self, argument: int) -> list[int] | None:
        return [argument & 0xFFF] if self.state == IDLE else self._refuse()

    def _describe(self, _: int) -> list[int] | None:
        return self.data if self.state == STANDBY else self._refuse()

    def _announce(self, _: int) -> list[int]:
        self._application = True
        return [self._status()[0] | 0x20]

    def _question(self, argument: int) -> list[int] | None:
        if self.state != IDLE:
            return self._refuse()
        self._questions += 1
        if not argument & IS_HIGH or not argument & CONDITIONS:
            return [CONDITIONS]
        if self._questions <= self.ready_after:
            return [CONDITIONS]
        self.state = READY
        return [CONDITIONS | IS_READY | IS_HIGH]

    def _lines(self, argument: int) -> list[int] | None:
        if self.state != TRANSFER:
            return self._refuse()
        self.wide = argument == 2
        return self._status()

    def _look(self, _: int) -> list[int] | None:
        if self.state < STANDBY:
            return self._refuse()
        if self.state == PROGRAMMING:
            if self._busy == 0:
                self.state = TRANSFER
            self._busy -= 1
        return self._status()

    def _begin(self, index: int, argument: int) -> list[int] | None:
        if self.state != TRANSFER:
            return self._refuse()
        if argument >= len(self.image) // SECTOR:
            self.errors |= OUT_OF_RANGE
            return self._status()
        self.at, self.single = argument, index in (17, 24)
        return self._move(TRANSFER, SENDING if index < 20 else RECEIVING)

    def _stop(self, _: int) -> list[int] | None:
        if self.state == RECEIVING:
            words = self._status()
            self._program()
            return words
        return self._move(SENDING, TRANSFER)

    def _program(self) -> None:
        self.state, self._busy = PROGRAMMING, self.busy_looks

    def _place(self) -> slice:
        if self.at >= len(self.image) // SECTOR:
            raise CardError("a transfer goes on behind the card's last sector")
        self.at += 1
        return slice((self.at - 1) * SECTOR, self.at * SECTOR)

    def send(self) -> bytes:
        """A block to the host."""
        block = bytes(self.image[self._place()])
        if self.single:
            self.state = TRANSFER
        return block

    def receive(self, block: bytes) -> None:
        """A block of the host."""
        self.image[self._place()] = block
        self.written += 1
        if self.single:
            self._program()


@dataclass
class CardHost:
    """SDMMC1, by the offsets of its registers. Commands and blocks take no time."""

    card: SdCard | None = None
    clock_hz: int = 48_000_000
    words: dict[int, int] = field(default_factory=dict)
    flags: int = 0
    waiting: bytes = b""  # Bytes that the processor has not read, or the card has not got.
    left: int = 0  # Bytes of a transfer.
    rates: set[tuple[int, bool]] = field(default_factory=set)  # Those that were used, and lines.

    def read(self, offset: int) -> int:
        """What a register reads."""
        if offset == 0x34:
            return self.flags | self._levels()
        if offset == 0x80:
            return self._take()
        return self.words.get(offset, 0)

    def write(self, offset: int, value: int) -> None:
        """What writing a register does."""
        self.words[offset] = value
        if offset == 0x0C and value & 1 << 10:
            self._command(value & 0x3F, value >> 6 & 3)
        elif offset == 0x2C:
            self._arm(value)
        elif offset == 0x38:
            self.flags &= ~(value & STATIC)
        elif offset == 0x80:
            self._give(value)

    def _armed(self, to_host: bool) -> bool:
        control = self.words.get(0x2C, 0)
        return bool(control & 1) and bool(control & 2) == to_host

    def _levels(self) -> int:
        """The flags that nobody clears."""
        if self._armed(to_host=True):
            return (HALF_FULL if len(self.waiting) >= HALF else 0) | (RECEIVES if self.left else 0)
        return HALF_EMPTY | SENDS if self._armed(to_host=False) and self.left else 0

    def _rules(self) -> None:
        """What must hold for a command."""
        clock = self.words.get(4, 0)
        rate = self.clock_hz // ((clock & 0xFF) + 2)
        unknown = self.card is not None and self.card.there and self.card.state < STANDBY
        limit = IDENTIFY_HZ if unknown else TRANSFER_HZ
        for reason, held in {
            "its supply is off": self.words.get(0, 0) & 3 == 3,
            "its clock is off": bool(clock & 1 << 8),
            f"its clock is {rate} Hz": rate <= limit,
            "it is told while there are data of the one before": not self.waiting,
        }.items():
            if not held:
                raise CardError(f"a command goes to the card, but {reason}")
        self.rates.add((rate, bool(clock >> 11 & 3)))

    def _command(self, index: int, answer: int) -> None:
        self._rules()
        words = self.card.obey(index, self.words.get(8, 0)) if self.card else None
        if answer == SILENT:
            self.flags |= SENT
            return
        if words is None:
            self.flags |= TIMEOUT
            return
        if (answer == LONG) != (len(words) == 4):
            raise CardError(f"command {index} expects an answer of another length")
        self.words[0x10] = 0x3F if index == 41 else index  # An answer without an index has ones.
        for i, word in enumerate(words):
            self.words[0x14 + 4 * i] = word & ~1 if len(words) == 4 and i == 3 else word
        self.flags |= CHECKSUM if index == 41 else ANSWERED  # And without a checksum.
        self._fill()

    def _arm(self, control: int) -> None:
        if control & 1:
            length = self.words.get(0x28, 0)
            if length == 0 or length % SECTOR or control >> 4 & 0xF != 9:
                raise CardError("a transfer is not of whole sectors")
            if self.words.get(0x24, 0) == 0:
                raise CardError("a transfer has no time")
            self.left = length
        else:
            self.left = 0
        self.waiting = b""

    def _lines(self) -> None:
        wide = self.words.get(4, 0) >> 11 & 3 == 1
        if self.card is None or self.card.wide != wide:
            raise CardError("host and card use other lines")

    def _fill(self) -> None:
        """The card sends what was asked for."""
        if self._armed(to_host=True) and self.card is not None and self.card.state == SENDING:
            self._lines()
            while self.left > len(self.waiting) and self.card.state == SENDING:
                self.waiting += self.card.send()

    def _take(self) -> int:
        if len(self.waiting) < 4:
            raise CardError("the FIFO is read while it is empty")
        word, self.waiting = int.from_bytes(self.waiting[:4], "little"), self.waiting[4:]
        self.left -= 4
        if self.left == 0:
            self.flags |= DATA_END | BLOCK_END
        return word

    def _give(self, word: int) -> None:
        if not self._armed(to_host=False) or self.left == 0:
            raise CardError("the FIFO is written while nothing is sent")
        if self.card is None or self.card.state != RECEIVING:
            raise CardError("data go to a card that expects none")
        self._lines()
        self.waiting += word.to_bytes(4, "little")
        self.left -= 4
        if len(self.waiting) == SECTOR:
            block, self.waiting = self.waiting, b""
            self.card.receive(block)
            self.flags |= BLOCK_END | (0 if self.left else DATA_END)
