# SPDX-License-Identifier: Apache-2.0
"""The processor of the STM32F767 with its memories: Unicorn runs an image within the chip."""

from __future__ import annotations

from keel.boards.packages import load
from keel.emulator.chip import CALIBRATION, SCB, SYSTEM, UID, UID_PLACE, Chip, ModelError
from keel.install import Toolchain

ITCM, FLASH, DTCM, SRAM, BACKUP = 0x0, 0x0800_0000, 0x2000_0000, 0x2002_0000, 0x4002_4000
FACTORY = SYSTEM & ~0xFFF  # The page of the system memory that has the calibration.
SIZES = {
    ITCM: 0x4000,
    FLASH: 0x20_0000,
    DTCM: 0x2_0000,
    SRAM: 0x6_0000,
    BACKUP: 0x1000,
    FACTORY: 0x1000,
}
KEPT = (FLASH, BACKUP, FACTORY)  # Over a reset; the others are filled with noise.
NOISE = b"\xa5\x5a\x3c\xc3"

MEMORY, BUS, USAGE = 4, 5, 6  # Exceptions.
SLICE = 500_000  # Instructions without a reading of the clock after which time moves on by itself.
SLICE_US = 2_000
EXC_RETURN = 0xFFFF_FFF9


class Processor:
    """The processor with its memories, in the chip."""

    def __init__(self, tools: Toolchain, image: bytes, address: int, chip: Chip) -> None:
        unicorn = load(tools, "unicorn", "unicorn")
        self.u = unicorn
        self.chip = chip
        self.entry = address
        self.pending: tuple[int, int, int] | None = None  # Exception, its status, its address.
        self.error: Exception | None = None
        arm = load(tools, "unicorn", "unicorn.arm_const")
        self.r = arm
        self.uc = unicorn.Uc(unicorn.UC_ARCH_ARM, unicorn.UC_MODE_THUMB)
        self.uc.ctl_set_cpu_model(arm.UC_CPU_ARM_CORTEX_M7)
        for base, size in SIZES.items():
            self.uc.mem_map(base, size)
            self.uc.mem_write(base, (b"\xff" if base == FLASH else NOISE[:1]) * size)
        self.uc.mem_write(address, image)
        self.uc.mem_write(UID_PLACE, UID)
        self.uc.mem_write(SYSTEM, b"".join(it.to_bytes(2, "little") for it in CALIBRATION))
        for start, end in (
            (0x4000_0000, BACKUP),
            (BACKUP + 0x1000, 0x4008_0000),
            (0xE000_0000, 0xE010_0000),
        ):
            self.uc.mmio_map(start, end - start, self._read, start, self._write, start)
        u = unicorn
        guarded = u.UC_HOOK_MEM_READ | u.UC_HOOK_MEM_WRITE
        self.uc.hook_add(guarded, self._guard, begin=0, end=0xFF)
        self.uc.hook_add(guarded, self._guard, begin=DTCM, end=DTCM + 0x3FF)
        self.uc.hook_add(guarded, self._guard, begin=FACTORY, end=FACTORY + 0xFFF)
        end = FLASH + SIZES[FLASH] - 1
        self.uc.hook_add(u.UC_HOOK_MEM_WRITE, self._store, begin=FLASH, end=end)
        self.uc.hook_add(u.UC_HOOK_MEM_INVALID, self._unmapped)
        chip.erase = self._erase
        chip.store = lambda place, byte: self.uc.mem_write(place, bytes([byte]))

    # What the processor meets.

    def _read(self, _: object, offset: int, size: int, start: int) -> int:
        chip = self.chip
        try:
            word = chip.read((start + offset) & ~3)
            if chip.raised and not self.pending and not chip.exception:
                self.pending, chip.raised = (chip.raised, 0, 0), 0
            if chip.reset_wanted or self.pending:
                self.uc.emu_stop()
            return word if size == 4 else word >> 8 * (offset & 3) & ((1 << 8 * size) - 1)
        except ModelError as error:
            self._stop(error)
            return 0

    def _write(self, _: object, offset: int, size: int, value: int, start: int) -> None:
        try:
            self.chip.write(start + offset, value)
            if self.chip.reset_wanted:
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
        if self.chip.words.get(SCB + 0x94, 0) & 1 and not self.pending:  # The MPU is on.
            self.pending = (MEMORY, 0x82, address)  # DACCVIOL, MMARVALID.
            self.uc.emu_stop()

    def _store(
        self, _: object, access: int, address: int, size: int, value: int, data: object
    ) -> None:
        """A store to the flash, before it is done."""
        del access, data
        before = int.from_bytes(self.uc.mem_read(address, size), "little")
        try:
            self.chip.program(size, before, value & ((1 << 8 * size) - 1))
        except ModelError as error:
            self._stop(error)

    def _erase(self, sector: int) -> None:
        """A sector of a flash of one bank (RM0410, table 3)."""
        starts = [0, 0x8000, 0x1_0000, 0x1_8000, 0x2_0000, *range(0x4_0000, 0x24_0000, 0x4_0000)]
        if sector > 11:
            raise ModelError(f"there is no sector {sector}")
        start, end = starts[sector], starts[sector + 1]
        self.uc.mem_write(FLASH + start, b"\xff" * (end - start))

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
        self.chip.reset()
        self.uc.reg_write(self.r.UC_ARM_REG_SP, self.word(self.entry))
        self.uc.reg_write(self.r.UC_ARM_REG_LR, 0xFFFF_FFFF)
        return self.word(self.entry + 4)

    def enter(self, pending: tuple[int, int, int]) -> int:
        """The entry of an exception; where its handler begins."""
        number, status, address = pending
        r = self.r
        if self.chip.exception:
            raise ModelError(f"exception {number} in the handler of {self.chip.exception}: lock-up")
        names = (
            r.UC_ARM_REG_R0,
            r.UC_ARM_REG_R1,
            r.UC_ARM_REG_R2,
            r.UC_ARM_REG_R3,
            r.UC_ARM_REG_R12,
            r.UC_ARM_REG_LR,
            r.UC_ARM_REG_PC,
            r.UC_ARM_REG_CPSR,
        )
        values = [int(self.uc.reg_read(name)) & 0xFFFF_FFFF for name in names]
        values[7] |= 1 << 24
        sp = int(self.uc.reg_read(r.UC_ARM_REG_SP)) - 32 & ~7
        self.uc.mem_write(sp, b"".join(value.to_bytes(4, "little") for value in values))
        self.uc.reg_write(r.UC_ARM_REG_SP, sp)
        self.uc.reg_write(r.UC_ARM_REG_LR, EXC_RETURN)
        self.chip.words[SCB + 0x28] = status
        self.chip.words[SCB + (0x34 if number == MEMORY else 0x38)] = address
        self.chip.exception = number
        return self.word(self.chip.words[SCB + 8] + 4 * number)

    def run(self, until_us: int) -> None:
        """Run until the chip's time has come."""
        pc = self.start()
        while self.chip.time_us < until_us:
            before = self.chip.time_us
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
            if self.chip.time_us == before:
                self.chip.tick(SLICE_US)
            if self.chip.reset_wanted:
                self.chip.resets += 1
                self.pending = None
                pc = self.start()
            elif self.pending:
                pc, self.pending = self.enter(self.pending), None
