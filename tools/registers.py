#!/usr/bin/env python3
"""Hold the project's register headers against two independent register databases.

    python3 tools/registers.py      # every difference, one a line

The headers (bsp/cortex_m7/core.h, bsp/stm32f767/registers/*.h) state facts: the base address of a
peripheral, the offset of a register, the position and width of a field, a reset value, an interrupt
number, a memory. The names are read from the headers, the values from a program that the compiler
builds with them, so that what is compared is what the drivers get. The databases are two crates,
fetched with their checksums and read as data:

    stm32ral        from the vendor's machine-readable description, with the community's corrections
    stm32-metapac   from the vendor's configuration tool and hand-made register descriptions

A fact without a counterpart is a difference, unless specs/registers.toml says with a reason why it
has none, or what the database calls it. An entry there that nothing needs is a difference too.
The signals of the boards' pins (bsp/*/pins.c) and what the boards' files say of memories and
interrupts (bsp/*/board.toml, and their base) are compared as well.

build/registers/report.json has every fact. Exit status: 0 without differences, 1 with, 2 for a
wrong command line.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from toolchain import Toolchain, ToolchainError, write_atomically

ROOT = Path(__file__).resolve().parents[1]
HEADERS = ("bsp/cortex_m7/core.h", "bsp/stm32f767/registers/*.h")
PINS = "bsp/*/pins.c"
EXCEPTIONS = "specs/registers.toml"
REPORT = Path("build/registers/report.json")


class RegistersError(Exception):
    """Something could not be compared; the message says what and why."""


# --- The headers ---------------------------------------------------------------------------------

STRUCT = re.compile(r"typedef struct (keel_(\w+)) \{(.*?)\} keel_\w+_t;", re.DOTALL)
MEMBER = re.compile(r"volatile uint32_t (\w+)(?:\[\d+\])?;")
DEFINE = re.compile(r"^#define (\w+) +(?!\\)(.+?)(?: */\*.*)?$", re.MULTILINE)


@dataclass(frozen=True)
class Header:
    """The names in one header: register blocks with their registers, and macros."""

    path: str
    blocks: dict[str, list[str]]
    macros: list[str]


def read_header(root: Path, path: Path) -> Header:
    """The names of a header."""
    text = path.read_text(encoding="utf-8")
    blocks = {
        match[2].upper(): [name for name in MEMBER.findall(match[3]) if "reserved" not in name]
        for match in STRUCT.finditer(text)
    }
    macros = [name for name, _ in DEFINE.findall(text)]
    return Header(path.relative_to(root).as_posix(), blocks, macros)


@dataclass(frozen=True)
class Fact:
    """One statement of a header: its kind, its name, and the numbers that it gives."""

    kind: str
    name: str
    where: str
    block: str = ""
    register: str = ""
    values: tuple[int, ...] = ()


def split_macro(name: str, header: Header) -> tuple[str, str, str]:
    """Block, register and rest of a macro such as RCC_CR_HSEON; empty texts if it is no such."""
    for block, registers in header.blocks.items():
        for register in sorted(registers, key=len, reverse=True):
            prefix = f"{block}_{register}_"
            if name.startswith(prefix):
                return block, register, name.removeprefix(prefix)
    return "", "", ""


def block_of(instance: str, header: Header) -> str:
    """The register block that a peripheral has."""
    if instance in header.blocks or len(header.blocks) != 1:
        return instance if instance in header.blocks else ""
    return next(iter(header.blocks))


def facts_of(header: Header) -> Iterator[Fact]:
    """What a header states, still without the numbers."""
    for name in header.macros:
        block, register, rest = split_macro(name, header)
        if rest == "KEY":
            continue
        if match := re.fullmatch(r"MEMORY_(\w+)_(?:BASE|SIZE)", name):
            yield Fact("memory", name, header.path, match[1])
        elif name.endswith("_IRQ"):
            yield Fact("interrupt", name, header.path, name.removesuffix("_IRQ"))
        elif rest == "RESET":
            for instance in instances_of(block, header):
                if f"{instance}_{register}_RESET" not in header.macros or instance == block:
                    yield Fact("reset", name, header.path, instance, register)
        elif match := re.fullmatch(r"(\w+?)_(\w+)_RESET", name):
            yield Fact("reset", name, header.path, match[1], match[2])
        elif rest:
            yield Fact("field", name, header.path, block, register)
        elif name.endswith("_BASE"):
            instance = name.removesuffix("_BASE")
            yield Fact("base", name, header.path, instance)
            for member in header.blocks.get(block_of(instance, header), []):
                yield Fact("register", f"{instance}.{member}", header.path, instance, member)


def instances_of(block: str, header: Header) -> list[str]:
    """The peripherals that have a register block."""
    bases = [name.removesuffix("_BASE") for name in header.macros if name.endswith("_BASE")]
    return [name for name in bases if block_of(name, header) == block]


def expression(fact: Fact, header: Header) -> list[str]:
    """C expressions for the numbers of a fact."""
    if fact.kind != "register":
        return [fact.name]
    block = block_of(fact.block, header).lower()
    return [f"{fact.block}_BASE + offsetof(keel_{block}_t, {fact.register})"]


def evaluate(tools: Toolchain, root: Path, pairs: Sequence[tuple[Fact, Header]]) -> list[Fact]:
    """The facts with their numbers, from a program that includes the headers."""
    includes = sorted({header.path.removeprefix("bsp/") for _, header in pairs})
    lines = ["#include <stddef.h>", "#include <stdio.h>"]
    lines += [f'#include "{name}"' for name in includes]
    lines += ["int main(void) {"]
    for fact, header in pairs:
        for text in expression(fact, header):
            lines.append(f'    printf("%llu\\n", (unsigned long long)({text}));')
    lines.append("    return 0; }")
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "facts.c"
        source.write_text("\n".join(lines) + "\n")
        program = Path(folder) / "facts"
        command = [*tools.command("gcc"), "-std=c99", f"-I{root / 'bsp'}", str(source)]
        done = subprocess.run(
            [*command, "-o", str(program)], capture_output=True, text=True, check=False
        )
        if done.returncode != 0:
            raise RegistersError(f"the headers do not compile:\n{done.stderr.strip()}")
        numbers = subprocess.run([program], capture_output=True, text=True, check=True).stdout
    values = [int(word) for word in numbers.split()]
    facts = []
    for (fact, _), value in zip(pairs, values, strict=True):
        low, width = position(value), value.bit_count()
        shape: tuple[int, ...] = (low, width) if fact.kind == "field" else (value,)
        if fact.kind == "field" and value != ((1 << width) - 1) << low:
            raise RegistersError(f"{fact.where}: {fact.name}: not one run of bits: {value:#x}")
        facts.append(Fact(fact.kind, fact.name, fact.where, fact.block, fact.register, shape))
    return facts


def position(mask: int) -> int:
    """The number of the lowest bit of a mask."""
    return (mask & -mask).bit_length() - 1


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
RAL_PERIPHERAL = re.compile(r"::peripherals::(\w+)::\{?(?:.*?)RegisterBlock")
RAL_FIELD = re.compile(
    r"pub mod (\w+) \{\s*/// Offset.*?const offset: u32 = (\d+);.*?const mask: u32 = (\w+) <<",
    re.DOTALL,
)
RAL_MEMBER = re.compile(
    r"^    (?:pub (\w+): \w+<u(\d+)>|_reserved\d+: \[u8; (\d+)\]|pub (\w+): (\w+)),$", re.MULTILINE
)


def ral_peripheral(path: Path) -> tuple[dict[str, int], dict[str, Fields]]:
    """Offsets and fields of a register block."""
    text = path.read_text(encoding="utf-8")
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
    files = [chip / f"{name}.rs" for name in ("tim1", "tim8")]
    for listing, folder in ((chip / "mod.rs", chip.parent), (core / "armv7em/mod.rs", core)):
        names = RAL_REEXPORT.findall(listing.read_text(encoding="utf-8"))
        files += [folder / "instances" / f"{name}.rs" for name in names]
    for path in files:
        text = path.read_text(encoding="utf-8")
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
    text = (root / "src/stm32f7/stm32f7x7/interrupts.rs").read_text(encoding="utf-8")
    return {
        name: int(number) for name, number in re.findall(r"^ +(\w+) = (\d+),", text, re.MULTILINE)
    }


# --- stm32-metapac -------------------------------------------------------------------------------


@dataclass
class Metapac:
    """What is read of stm32-metapac."""

    bases: dict[str, int]
    interrupts: dict[str, int]
    memories: list[tuple[str, int, int]]
    signals: set[tuple[str, str, str, int]]  # peripheral, pin, signal, alternate function
    fields: dict[tuple[str, str], Fields] = field(default_factory=dict)


def read_metapac(root: Path) -> Metapac:
    """The STM32F767ZI."""
    chip = root / "src/chips/stm32f767zi"
    pac = (chip / "pac.rs").read_text(encoding="utf-8")
    bases = re.findall(r"^pub const (\w+): .*?(0x[0-9a-f_]+)usize", pac, re.MULTILINE)
    interrupts = re.findall(r'doc = "(\d+) - (\w+)"', pac)
    memory = re.sub(r"\s+", " ", (chip / "metadata.rs").read_text(encoding="utf-8"))
    regions = re.findall(r'name: "(\w+)", kind: \S+, address: (\w+), size: (\d+)', memory)
    found = Metapac(
        {name: int(value.replace("_", ""), 16) for name, value in bases},
        {name: int(number) for number, name in interrupts},
        [(name, int(address, 16), int(size)) for name, address, size in regions],
        set(),
    )
    text = (root / "src/chips/metadata_0254.rs").read_text(encoding="utf-8")
    for part in re.split(r"^    Peripheral \{$", text, flags=re.MULTILINE)[1:]:
        metapac_peripheral(root, text, re.sub(r"\s+", " ", part), found)
    return found


def metapac_peripheral(root: Path, text: str, part: str, found: Metapac) -> None:
    """Add the signals and fields of one peripheral."""
    name = str(re.search(r'name: "(\w+)"', part)[1])  # type: ignore[index]
    pins = re.findall(r'pin: "(\w+)", signal: "(\w+)", af: Some\( ?(\d+),? ?\)', part)
    found.signals |= {(name, pin, signal, int(number)) for pin, signal, number in pins}
    kind = re.search(r"ir: &(\w+)::REGISTERS", part)
    path = kind and re.search(rf'path = "\.\./(\S+)"\]\s+pub mod {kind[1]};', text)
    if not path:
        return
    registers = re.sub(r"\s+", " ", (root / "src" / path[1]).read_text(encoding="utf-8"))
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


# --- The comparison ------------------------------------------------------------------------------


@dataclass
class Exceptions:
    """specs/registers.toml: other names, and facts without a counterpart; what was used of it."""

    names: dict[str, str]
    absent: dict[str, str]
    used: set[str] = field(default_factory=set)

    @classmethod
    def read(cls, path: Path) -> Exceptions:
        """Read and check the file."""
        raw = tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
        names, absent = {}, {}
        for entry in raw.get("name", []):
            names[str(entry["fact"])] = str(entry["database"])
        for entry in raw.get("absent", []):
            if not str(entry.get("reason", "")).strip():
                raise RegistersError(f"{EXCEPTIONS}: {entry.get('fact')}: no reason")
            absent[str(entry["fact"])] = str(entry["reason"])
        return cls(names, absent)

    def called(self, name: str) -> str:
        """The database's name."""
        if name in self.names:
            self.used.add(name)
        return self.names.get(name, name)

    def excuses(self, name: str) -> bool:
        """Whether a fact may be without a counterpart."""
        if name in self.absent:
            self.used.add(name)
        return name in self.absent

    def unused(self) -> list[str]:
        """Entries that nothing needed."""
        return sorted((self.names.keys() | self.absent.keys()) - self.used)


@dataclass
class Comparison:
    """What was compared, and what differs."""

    compared: dict[str, int] = field(default_factory=dict)
    excused: list[str] = field(default_factory=list)
    differences: list[str] = field(default_factory=list)
    facts: list[dict[str, object]] = field(default_factory=list)

    def check(self, fact: Fact, found: list[tuple[str, tuple[int, ...]]], excused: bool) -> None:
        """Compare a fact with what the databases say."""
        shown = " ".join(f"{value:#x}" for value in fact.values)
        self.facts.append({"fact": fact.name, "of": fact.block, "kind": fact.kind, "value": shown,
                           "databases": [database for database, _ in found]})  # fmt: skip
        for database, values in found:
            self.compared[fact.kind] = self.compared.get(fact.kind, 0) + 1
            if values != fact.values:
                other = " ".join(f"{value:#x}" for value in values)
                text = f"{fact.where}: {fact.name} ({fact.block}): {shown}, {database} has {other}"
                self.differences.append(text)
        if not found and excused:
            self.excused.append(fact.name)
        elif not found:
            self.differences.append(f"{fact.where}: {fact.name} ({fact.block}): no counterpart")


class Databases:
    """Both databases, asked for one fact."""

    def __init__(self, ral: Path, metapac: Path) -> None:
        self.ral = read_ral(ral)
        self.irq = ral_interrupts(ral)
        self.metapac = read_metapac(metapac)

    def at(self, address: int) -> Iterator[tuple[Instance, str]]:
        """The registers of stm32ral at an address."""
        for instance in self.ral.values():
            for name, offset in instance.offsets.items():
                if instance.base + offset == address:
                    yield instance, name

    def find(self, fact: Fact, names: Exceptions, owners: Sequence[str]) -> Iterator[
        tuple[str, tuple[int, ...]]
    ]:  # fmt: skip
        """What each database says about a fact."""
        if fact.kind == "base":
            found = self.ral.get(names.called(fact.block))
            if found:
                yield "stm32ral", (found.base,)
            if fact.block in self.metapac.bases:
                yield "stm32-metapac", (self.metapac.bases[fact.block],)
        elif fact.kind == "interrupt":
            for database, numbers in (("stm32ral", self.irq),
                                      ("stm32-metapac", self.metapac.interrupts)):  # fmt: skip
                if fact.block in numbers:
                    yield database, (numbers[fact.block],)
        elif fact.kind == "register":
            wanted = names.called(fact.name)
            wanted = wanted.rpartition(".")[2]
            there = [name for _, name in self.at(fact.values[0])]
            if wanted in there:
                yield "stm32ral", fact.values
            elif there:
                owner = self.ral.get(names.called(fact.block))
                offset = owner.offsets.get(wanted) if owner else None
                yield "stm32ral", (owner.base + offset if owner and offset is not None else -1,)
        elif fact.kind == "reset":
            owner = self.ral.get(names.called(fact.block))
            register = names.called(f"{fact.block}.{fact.register}").rpartition(".")[2]
            if owner and register in owner.resets:
                yield "stm32ral", (owner.resets[register],)
        elif fact.kind == "field":
            yield from self.find_field(fact, names, owners)
        elif fact.kind == "memory":
            yield from self.find_memory(fact)

    def find_field(
        self, fact: Fact, names: Exceptions, owners: Sequence[str]
    ) -> Iterator[tuple[str, tuple[int, ...]]]:
        """A field, in every peripheral that has the block."""
        wanted = names.called(fact.name)
        register, rest = fact.register, fact.name.removeprefix(f"{fact.block}_{fact.register}_")
        if wanted != fact.name:
            place, _, entry = wanted.rpartition("/")
            register, rest = entry.split(".")
            owners = [place] if place else owners
        for owner in owners:
            other = names.called(owner)
            for key in (other, *(k for k, i in self.ral.items() if k.startswith(f"{other}_"))):
                known = self.ral[key].fields if key in self.ral else {}
                shape = known.get(register, {}).get(rest)
                if shape:
                    yield f"stm32ral {key}", shape
            shape = self.metapac.fields.get((owner, register), {}).get(rest)
            if shape:
                yield f"stm32-metapac {owner}", shape

    def find_memory(self, fact: Fact) -> Iterator[tuple[str, tuple[int, ...]]]:
        """Base or size of a memory; flash is given in regions of equal sectors."""
        prefix = "BANK_" if fact.block == "FLASH" else fact.block
        regions = [entry for entry in self.metapac.memories if entry[0].startswith(prefix)]
        if regions and fact.name.endswith("_BASE"):
            yield "stm32-metapac", (min(base for _, base, _ in regions),)
        elif regions:
            yield "stm32-metapac", (sum(size for _, _, size in regions),)


PIN_LINE = re.compile(r"KEEL_ALTERNATE\((\w), (\d+)u, (\d+)u, (\w+), (\w+)\)")


def compare_pins(root: Path, metapac: Metapac, result: Comparison) -> None:
    """The alternate functions in the boards' pin tables."""
    for path in sorted(root.glob(PINS)):
        where = path.relative_to(root).as_posix()
        for port, number, function, peripheral, signal in PIN_LINE.findall(path.read_text()):
            pin = f"P{port}{number}"
            name = f"{pin} AF{function} {peripheral}_{signal}"
            result.compared["pin"] = result.compared.get("pin", 0) + 1
            result.facts.append({"fact": name, "of": where, "kind": "pin"})
            if (peripheral, pin, signal, int(function)) not in metapac.signals:
                result.differences.append(f"{where}: {name}: stm32-metapac has no such function")


CHIP = "bsp/stm32f767"
VECTORS = re.compile(r"KEEL_BOARD_INTERRUPTS=(\d+)u?")


def compare_boards(root: Path, databases: Databases, result: Comparison) -> None:
    """The boards' files: how many interrupts the vector table has, and where the memories lie."""
    wanted = {"stm32ral": databases.irq, "stm32-metapac": databases.metapac.interrupts}
    base = f"{CHIP}/chip.toml"
    for path in (root / base, *sorted(root.glob("bsp/*/board.toml"))):
        board = tomllib.loads(path.read_text(encoding="utf-8"))
        where = path.relative_to(root).as_posix()
        if where != base and board.get("base") != base and CHIP not in board["sources"]:
            continue
        number = VECTORS.search(" ".join(board.get("defines", [])))
        if number or where == base:
            fact = Fact("interrupt", "KEEL_BOARD_INTERRUPTS", where, "vectors", "",
                        (int(number[1]) if number else 0,))  # fmt: skip
            found: list[tuple[str, tuple[int, ...]]] = [
                (name, (max(numbers.values()) + 1,)) for name, numbers in wanted.items()
            ]
            result.check(fact, found, False)
        for region in board.get("region", []):
            known = {name: (base, size) for name, base, size in databases.metapac.memories}
            if region["name"] in known:
                values = (int(region["origin"]), int(region["size"]))
                fact = Fact("memory", f"region {region['name']}", where, "", "", values)
                result.check(fact, [("stm32-metapac", known[region["name"]])], False)


def compare(tools: Toolchain, root: Path, databases: Databases) -> Comparison:
    """Compare everything."""
    paths = sorted(path for pattern in HEADERS for path in root.glob(pattern))
    headers = [read_header(root, path) for path in paths]
    pairs = [(fact, header) for header in headers for fact in facts_of(header)]
    if not pairs:
        raise RegistersError("no header states a fact")
    by_where = {header.path: header for header in headers}
    exceptions = Exceptions.read(root / EXCEPTIONS)
    result = Comparison()
    for fact in evaluate(tools, root, pairs):
        owners = instances_of(fact.block, by_where[fact.where]) if fact.kind == "field" else []
        found = list(databases.find(fact, exceptions, owners))
        result.check(fact, found, not found and exceptions.excuses(fact.name))
    compare_pins(root, databases.metapac, result)
    compare_boards(root, databases, result)
    for name in exceptions.unused():
        result.differences.append(f"{EXCEPTIONS}: {name}: nothing needs this entry")
    return result


def write_report(root: Path, result: Comparison) -> None:
    """Write the report in one go."""
    content = {"compared": result.compared, "without_counterpart": result.excused,
               "differences": result.differences, "facts": result.facts}  # fmt: skip
    write_atomically(root / REPORT, json.dumps(content, indent=1) + "\n")


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Compare register headers with databases.")
    parser.parse_args(arguments)
    try:
        tools = Toolchain()
        tools.ensure("registers")
        places = [Path(tools.command(name)[0]) for name in ("stm32ral", "stm32-metapac")]
        result = compare(tools, root, Databases(*places))
    except (RegistersError, ToolchainError) as error:
        print(f"registers: {error}", file=sys.stderr)
        return 1
    write_report(root, result)
    for line in result.differences:
        print(line)
    kinds = ", ".join(f"{count} of {kind}" for kind, count in sorted(result.compared.items()))
    total = sum(result.compared.values())
    print(f"registers: {len(result.facts)} facts, {total} comparisons ({kinds}), "
          f"{len(result.excused)} without a counterpart (reasons in {EXCEPTIONS}), "
          f"{len(result.differences)} differences")  # fmt: skip
    return 1 if result.differences else 0


if __name__ == "__main__":
    sys.exit(main())
