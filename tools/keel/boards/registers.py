# SPDX-License-Identifier: Apache-2.0
"""Hold the project's register headers against two independent register databases.

    python3 tools/keel registers      # every difference, one a line

The headers (bsp/cortex_m7/core.h, bsp/stm32f767/registers/*.h) state facts: the base address of a
peripheral, the offset of a register, the position and width of a field, a reset value, an interrupt
number, a memory. The names are read from the headers, the values from a program that the compiler
builds with them, so that what is compared is what the drivers get. The databases are two crates,
fetched with their checksums and read as data:

    stm32ral        from the vendor's machine-readable description, with the community's corrections
    stm32-metapac   from the vendor's configuration tool and hand-made register descriptions

A fact without a counterpart is a difference, unless specs/registers.toml says with a reason why it
has none, or what the database calls it. An entry there that nothing needs is a difference too.
The signals of the boards' pins (bsp/*/pins.c, bsp/*/variant.c) and what the boards' files say of
memories and interrupts (bsp/*/board.toml, and their base) are compared as well. Which pin comes
out at which socket, and which supply a pin switches, no database of a chip can know: that is
compared with specs/outputs.toml, which has it from others' firmware.

build/registers/report.json has every fact. Exit status: 0 without differences, 1 with, 2 when
nothing could be compared.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, program
from keel.base.files import read_text, write_json
from keel.boards.board import BOARD_FILE, Board, read_board
from keel.boards.register_databases import Databases, Metapac
from keel.boards.register_headers import Fact, instances_of, read_facts, read_headers
from keel.boards.sockets import socket_differences, tables
from keel.config import Table, Text, read_toml
from keel.install import Toolchain

EXCEPTIONS = "specs/registers.toml"
REPORT = Path("build/registers/report.json")


class Renamed(Table):
    """What the databases call a fact."""

    fact: Text
    database: Text


class Absent(Table):
    """A fact without a counterpart."""

    fact: Text
    reason: Text


class Refuted(Table):
    """A database that is wrong about a fact: others are not."""

    fact: Text
    database: Text
    reason: Text


class ExceptionsFile(Table):
    """specs/registers.toml."""

    name: list[Renamed] = []
    absent: list[Absent] = []
    refuted: list[Refuted] = []


class Exceptions:
    """Other names, and facts without a counterpart; what was used of them."""

    def __init__(self, file: ExceptionsFile) -> None:
        self.names = {entry.fact: entry.database for entry in file.name}
        self.absent = {entry.fact: entry.reason for entry in file.absent}
        self.refuted = {(entry.fact, entry.database) for entry in file.refuted}
        self.used: set[str] = set()
        self.met: set[tuple[str, str]] = set()

    def trusted(
        self, fact: Fact, found: list[tuple[str, tuple[int, ...]]]
    ) -> list[tuple[str, tuple[int, ...]]]:
        """What the databases say, but for those that are known to be wrong; one at least agrees."""
        wrong = {(fact.name, database) for database, values in found if values != fact.values}
        left = [item for item in found if (fact.name, item[0]) not in wrong & self.refuted]
        if not left:
            return found
        self.met |= wrong & self.refuted
        return left

    def called(self, name: str) -> str:
        """The database's name."""
        self.used |= {name} & self.names.keys()
        return self.names.get(name, name)

    def excuses(self, name: str) -> bool:
        """Whether a fact may be without a counterpart."""
        self.used |= {name} & self.absent.keys()
        return name in self.absent

    def unused(self) -> list[str]:
        """Entries that nothing needed."""
        needless = (self.names.keys() | self.absent.keys()) - self.used
        return sorted(needless | {fact for fact, _ in self.refuted - self.met})


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
        self.facts.append(
            {
                "fact": fact.name,
                "of": fact.block,
                "kind": fact.kind,
                "value": shown,
                "databases": [database for database, _ in found],
            }
        )
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


PIN_LINE = re.compile(r"KEEL_(?:ALTERNATE|OUTPUT|BUZZER|PPM)\((\w), (\d+)u, (\d+)u, (\w+), (\w+)\)")
ANALOGUE_LINE = re.compile(r"KEEL_ANALOGUE\((\w), (\d+)u, (\d+)u\)")


def compare_analogue(where: str, text: str, package: Metapac, result: Comparison) -> None:
    """The channels of ADC1 in a board's pin table."""
    for port, number, channel in ANALOGUE_LINE.findall(text):
        name = f"P{port}{number} ADC1_IN{channel}"
        result.compared["pin"] = result.compared.get("pin", 0) + 1
        result.facts.append({"fact": name, "of": where, "kind": "pin"})
        if ("ADC1", f"P{port}{number}", f"IN{channel}") not in package.analogue:
            result.differences.append(f"{where}: {name}: stm32-metapac has no such channel")


def compare_pins(root: Path, databases: Databases, result: Comparison) -> None:
    """The alternate functions and analogue channels in the boards' pin tables."""
    for path, package in [
        (path, databases.packages[name]) for name, paths in tables(root) for path in paths
    ]:
        where = path.relative_to(root).as_posix()
        text = read_text(path)
        compare_analogue(where, text, package, result)
        for port, number, function, peripheral, signal in PIN_LINE.findall(text):
            pin = f"P{port}{number}"
            name = f"{pin} AF{function} {peripheral}_{signal}"
            result.compared["pin"] = result.compared.get("pin", 0) + 1
            result.facts.append({"fact": name, "of": where, "kind": "pin"})
            if (peripheral, pin, signal, int(function)) not in package.signals:
                result.differences.append(f"{where}: {name}: stm32-metapac has no such function")


def compare_sockets(root: Path, result: Comparison) -> None:
    """The order of outputs, and the levels, in the boards' pin tables."""
    for _, count, wrong in socket_differences(root):
        result.compared["socket"] = result.compared.get("socket", 0) + count
        result.differences += wrong


VECTORS = re.compile(r"KEEL_BOARD_INTERRUPTS=(\d+)u?")


def board_facts(board: Board, where: str) -> Iterator[Fact]:
    """What a board's file says of the chip: how large the vector table is, where memories lie."""
    number = VECTORS.search(" ".join(board.defines))
    count = int(number[1]) if number else 0
    yield Fact("interrupt", "KEEL_BOARD_INTERRUPTS", where, "vectors", values=(count,))
    for region in board.region:
        values = (region.origin, region.size)
        yield Fact("memory", f"region {region.name}", where, register=region.name, values=values)


def compare_boards(root: Path, databases: Databases, result: Comparison) -> None:
    """The boards' files."""
    vectors = [(name, (max(known.values()) + 1,)) for name, known in databases.interrupts.items()]
    memories = {name: (base, size) for name, base, size in databases.metapac.memories}
    for path in sorted(root.glob(f"bsp/*/{BOARD_FILE}")):
        board = read_board(root, path.parent.name)
        if "bsp/stm32f767" not in board.sources:
            continue
        for fact in board_facts(board, path.relative_to(root).as_posix()):
            if fact.kind == "interrupt":
                result.check(fact, [*vectors], False)
            elif fact.register in memories:
                result.check(fact, [("stm32-metapac", memories[fact.register])], False)


def compare(tools: Toolchain, root: Path, databases: Databases) -> Comparison:
    """Compare everything."""
    headers = read_headers(root)
    by_where = {header.path: header for header in headers}
    exceptions = Exceptions(read_toml(root / EXCEPTIONS, ExceptionsFile))
    result = Comparison()
    for fact in read_facts(tools, root, headers):
        owners = instances_of(fact.block, by_where[fact.where]) if fact.kind == "field" else []
        found = exceptions.trusted(fact, list(databases.find(fact, exceptions.called, owners)))
        result.check(fact, found, not found and exceptions.excuses(fact.name))
    compare_pins(root, databases, result)
    compare_boards(root, databases, result)
    compare_sockets(root, result)
    for name in exceptions.unused():
        result.differences.append(f"{EXCEPTIONS}: {name}: nothing needs this entry")
    return result


def conclude(root: Path, result: Comparison) -> int:
    """Write the report, print the differences; the exit status."""
    content = {
        "compared": result.compared,
        "without_counterpart": result.excused,
        "differences": result.differences,
        "facts": result.facts,
    }
    write_json(root / REPORT, content)
    for line in result.differences:
        print(line)
    kinds = ", ".join(f"{count} of {kind}" for kind, count in sorted(result.compared.items()))
    total = sum(result.compared.values())
    print(
        f"registers: {len(result.facts)} facts, {total} comparisons ({kinds}), "
        f"{len(result.excused)} without a counterpart (reasons in {EXCEPTIONS}), "
        f"{len(result.differences)} differences"
    )
    return 1 if result.differences else 0


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    Parser("Compare register headers with databases.", "registers").parse_args(arguments)

    def work() -> int:
        tools = Toolchain()
        tools.ensure("registers")
        places = [Path(tools.command(name)[0]) for name in ("stm32ral", "stm32-metapac")]
        return conclude(root, compare(tools, root, Databases(*places)))

    return program("registers", work)
