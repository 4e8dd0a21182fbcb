# SPDX-License-Identifier: Apache-2.0
"""What two independent databases say of the STM32F767's registers: two crates, read as data."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from keel.base.files import read_text
from keel.boards.register_headers import Fact, RegistersError

Answers = Iterator[tuple[str, tuple[int, ...]]]  # The database, and its numbers.

# --- stm32ral ------------------------------------------------------------------------------------

Fields = dict[str, tuple[int, int]]


@dataclass
class Instance:
    """A peripheral in stm32ral."""

    base: int
    offsets: dict[str, int]
    fields: dict[str, Fields]
    resets: dict[str, int]


RAL_REEXPORT = re.compile(r"^pub use super::instances::(\w+)(?: as \w+)?;", re.MULTILINE)
RAL_INSTANCE = re.compile(
    r"^pub mod (\w+) \{.*?addr: (0x[0-9a-fA-F]+),.*?reset: ResetValues = ResetValues \{(.*?)\};",
    re.MULTILINE | re.DOTALL,
)
RAL_FIELD = re.compile(
    r"pub mod (\w+) \{\s*/// Offset.*?const offset: u32 = (\d+);.*?const mask: u32 = (\w+) <<",
    re.DOTALL,
)
RAL_MEMBER = re.compile(
    r"^    (?:pub (\w+): \w+<u(\d+)>|_reserved\d+: \[u8; (\d+)\]|pub (\w+): (\w+)),$", re.MULTILINE
)


def ral_peripheral(path: Path) -> tuple[dict[str, int], dict[str, Fields]]:
    """Offsets and fields of a register block."""
    text = read_text(path)
    fields: dict[str, Fields] = {}
    for match in re.finditer(r"^pub mod (\w+) \{\n(.*?)^\}", text, re.MULTILINE | re.DOTALL):
        found = RAL_FIELD.findall(match[2])
        fields[match[1]] = {
            name: (int(offset), int(mask, 0).bit_length()) for name, offset, mask in found
        }
    body = re.search(r"^pub struct RegisterBlock \{\n(.*?)^\}", text, re.MULTILINE | re.DOTALL)
    if not body:
        raise RegistersError(f"{path.name}: no RegisterBlock")
    offsets: dict[str, int] = {}
    offset = 0
    for name, bits, gap, other, kind in RAL_MEMBER.findall(body[1]):
        if other:
            raise RegistersError(f"{path.name}: {other} has the unknown type {kind}")
        if name:
            offsets[name] = offset
        offset += int(gap) if gap else int(bits) // 8
    return offsets, fields


def read_ral(root: Path) -> dict[str, Instance]:
    """All peripherals of the STM32F7x7 and of its core."""
    instances: dict[str, Instance] = {}
    chip = root / "src/stm32f7/stm32f7x7"
    core = root / "src/cortex_m"
    files = [chip / f"{name}.rs" for name in ("adc", "tim1", "tim8")]
    for listing, folder in ((chip / "mod.rs", chip.parent), (core / "armv7em/mod.rs", core)):
        names = RAL_REEXPORT.findall(read_text(listing))
        files += [folder / "instances" / f"{name}.rs" for name in names]
    for path in files:
        text = read_text(path)
        family = core if core in path.parents else chip.parent
        kinds = re.findall(r"peripherals::(\w+)::", text)
        if not kinds:
            continue
        try:
            offsets, fields = ral_peripheral(family / "peripherals" / f"{kinds[0]}.rs")
        except RegistersError:
            continue  # A block with overlapping registers, none of which the headers name.
        for name, base, resets in RAL_INSTANCE.findall(text):
            values = {key: int(value, 16) for key, value in re.findall(r"(\w+): (0x\w+)", resets)}
            instances[name] = Instance(int(base, 16), offsets, fields, values)
    return instances


def ral_interrupts(root: Path) -> dict[str, int]:
    """Interrupt numbers."""
    text = read_text(root / "src/stm32f7/stm32f7x7/interrupts.rs")
    return {
        name: int(number) for name, number in re.findall(r"^ +(\w+) = (\d+),", text, re.MULTILINE)
    }


# --- stm32-metapac -------------------------------------------------------------------------------


# The chips that are on the boards: one has more pins than the other. Registers, interrupts and
# memories are compared with the first one's.
CHIPS = {"nucleo_f767zi": "stm32f767zi", "fmuv5": "stm32f765ii", "cuav_v5": "stm32f765ii"}
FIRST = "nucleo_f767zi"


@dataclass
class Metapac:
    """What is read of stm32-metapac."""

    bases: dict[str, int]
    interrupts: dict[str, int]
    memories: list[tuple[str, int, int]]
    signals: set[tuple[str, str, str, int]]  # peripheral, pin, signal, alternate function
    analogue: set[tuple[str, str, str]]  # peripheral, pin, signal without a function
    fields: dict[tuple[str, str], Fields] = field(default_factory=dict)


def read_metapac(root: Path, name: str) -> Metapac:
    """A chip, by its name there."""
    chip = root / "src/chips" / name
    pac = read_text(chip / "pac.rs")
    bases = re.findall(r"^pub const (\w+): .*?(0x[0-9a-f_]+)usize", pac, re.MULTILINE)
    interrupts = re.findall(r'doc = "(\d+) - (\w+)"', pac)
    memory = re.sub(r"\s+", " ", read_text(chip / "metadata.rs"))
    included = str(re.search(r'include!\("\.\./(\w+\.rs)"\)', memory)[1])  # type: ignore[index]
    regions = re.findall(r'name: "(\w+)", kind: \S+, address: (\w+), size: (\d+)', memory)
    found = Metapac(
        {name: int(value.replace("_", ""), 16) for name, value in bases},
        {name: int(number) for number, name in interrupts},
        [(name, int(address, 16), int(size)) for name, address, size in regions],
        set(),
        set(),
    )
    text = read_text(root / "src/chips" / included)
    for part in re.split(r"^    Peripheral \{$", text, flags=re.MULTILINE)[1:]:
        metapac_peripheral(root, text, re.sub(r"\s+", " ", part), found)
    return found


def metapac_peripheral(root: Path, text: str, part: str, found: Metapac) -> None:
    """Add the signals and fields of one peripheral."""
    name = str(re.search(r'name: "(\w+)"', part)[1])  # type: ignore[index]
    pins = re.findall(r'pin: "(\w+)", signal: "(\w+)", af: Some\( ?(\d+),? ?\)', part)
    found.signals |= {(name, pin, signal, int(number)) for pin, signal, number in pins}
    direct = re.findall(r'pin: "(\w+)", signal: "(\w+)", af: None', part)
    found.analogue |= {(name, pin, signal) for pin, signal in direct}
    kind = re.search(r"ir: &(\w+)::REGISTERS", part)
    path = kind and re.search(rf'path = "\.\./(\S+)"\]\s+pub mod {kind[1]};', text)
    if not path:
        return
    registers = re.sub(r"\s+", " ", read_text(root / "src" / path[1]))
    for piece in registers.split("FieldSet { ")[1:]:
        register = str(re.match(r'name: "(\w+)"', piece)[1]).upper()  # type: ignore[index]
        entries = re.findall(
            r'Field \{ name: "(\w+)", description: .*?bit_offset: BitOffset::Regular\( ?'
            r"RegularBitOffset \{ offset: (\d+),? \},? ?\), bit_size: (\d+), array: None",
            piece,
        )
        found.fields[(name, register)] = {
            entry.upper(): (int(offset), int(size)) for entry, offset, size in entries
        }


# --- Both ----------------------------------------------------------------------------------------


class Databases:
    """Both databases, asked for one fact. `called` gives their name for one of ours."""

    def __init__(self, ral: Path, metapac: Path) -> None:
        self.ral = read_ral(ral)
        self.packages = {board: read_metapac(metapac, chip) for board, chip in CHIPS.items()}
        self.metapac = self.packages[FIRST]
        self.interrupts = {
            "stm32ral": ral_interrupts(ral),
            "stm32-metapac": self.metapac.interrupts,
        }

    def find(self, fact: Fact, called: Callable[[str], str], owners: Sequence[str]) -> Answers:
        """What each database says; a field is looked for in every peripheral of `owners`."""
        of_block = fact.kind in ("base", "register", "reset")
        owner = self.ral.get(called(fact.block)) if of_block else None
        if fact.kind == "base":
            if owner:
                yield "stm32ral", (owner.base,)
            if fact.block in self.metapac.bases:
                yield "stm32-metapac", (self.metapac.bases[fact.block],)
        elif fact.kind == "interrupt":
            for database, numbers in self.interrupts.items():
                if fact.block in numbers:
                    yield database, (numbers[fact.block],)
        elif fact.kind == "register":
            yield from self.find_register(fact, called(fact.name).rpartition(".")[2], owner)
        elif fact.kind == "reset":
            register = called(f"{fact.block}.{fact.register}").rpartition(".")[2]
            if owner and register in owner.resets:
                yield "stm32ral", (owner.resets[register],)
        elif fact.kind == "field":
            yield from self.find_field(fact, called, owners)
        else:
            yield from self.find_memory(fact)

    def find_register(self, fact: Fact, wanted: str, owner: Instance | None) -> Answers:
        """A register, whichever peripheral the database puts it in."""
        there = [
            name
            for instance in self.ral.values()
            for name, offset in instance.offsets.items()
            if instance.base + offset == fact.values[0]
        ]
        if wanted in there:
            yield "stm32ral", fact.values
        elif there:
            known = owner is not None and wanted in owner.offsets
            yield "stm32ral", (owner.base + owner.offsets[wanted] if owner and known else -1,)

    def find_field(
        self, fact: Fact, called: Callable[[str], str], owners: Sequence[str]
    ) -> Answers:
        """A field, in every peripheral that has the block."""
        wanted = called(fact.name)
        register, rest = fact.register, fact.name.removeprefix(f"{fact.block}_{fact.register}_")
        if wanted != fact.name:
            place, _, entry = wanted.rpartition("/")
            register, rest = entry.split(".")
            owners = [place] if place else owners
        for owner in owners:
            other = called(owner)
            for key in (other, *(name for name in self.ral if name.startswith(f"{other}_"))):
                known = self.ral[key].fields if key in self.ral else {}
                if shape := known.get(register, {}).get(rest):
                    yield f"stm32ral {key}", shape
            if shape := self.metapac.fields.get((owner, register), {}).get(rest):
                yield f"stm32-metapac {owner}", shape

    def find_memory(self, fact: Fact) -> Answers:
        """Base or size of a memory; flash is given in regions of equal sectors."""
        prefix = "BANK_" if fact.block == "FLASH" else fact.block
        regions = [entry for entry in self.metapac.memories if entry[0].startswith(prefix)]
        if regions and fact.name.endswith("_BASE"):
            yield "stm32-metapac", (min(base for _, base, _ in regions),)
        elif regions:
            yield "stm32-metapac", (sum(size for _, _, size in regions),)
