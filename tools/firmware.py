#!/usr/bin/env python3
"""Build the firmware of a board, and check from the ELF that everything lies where it must.

    python3 tools/firmware.py mps2_an500                     # the board's application
    python3 tools/firmware.py nucleo_f767zi --app my/folder  # another application

A board is a folder bsp/<board> with a file board.toml:

    description   one line
    linker_script the script, relative to the root as all paths here
    sources       files, or folders whose *.c and *.S (below them too) belong to the image
    include       folders with headers, besides include and bsp
    defines       macros, as NAME or NAME=VALUE
    application   the files or folders with main(); --app takes others
    load_address  the address of the binary file's first byte: the load address of the image
    [[region]]    name, origin, size: the memories that an image may use; none else is used
    [[place]]     region, and one of sections, symbols (names, with * and ?) or code_of (source
                  files or folders: each function of theirs); load, optional: the region that
                  holds the copy from which the startup code fills it. A name that matches nothing
                  is an error, unless optional = true.

build/firmware/<board> then holds keel.elf, keel.bin, keel.map, report.json, and beside each object
what the compiler knows about stacks (*.su, *.ci). An image does not depend on the folder it was
built in. A failed build leaves no report.

Exit status: 0 when the image is whole, 1 when not, 2 for a wrong command line or an unknown board.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib
import json
import subprocess
import sys
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, TypeVar

from toolchain import TARGET_FLAGS, Toolchain, ToolchainError, write_atomically

ROOT = Path(__file__).resolve().parents[1]
BUILD = "build/firmware"
BOARD_FILE = "board.toml"
WARNINGS = ("-Wall", "-Wextra", "-Werror", "-Wconversion", "-Wdouble-promotion", "-Wundef")
# No contraction: a fused multiply-add would round once where the proofs and the host round twice.
FLAGS = (
    "-std=c99", "-O2", "-g", "-ffreestanding", "-ffunction-sections", "-fdata-sections",
    "-fno-common", "-ffp-contract=off", "-fstack-usage", "-fcallgraph-info=su,da",
)  # fmt: skip
LINK_FLAGS = (
    "-nostartfiles", "-static", "-Wl,--gc-sections", "-Wl,--fatal-warnings",
    "-Wl,--orphan-handling=error",
)  # fmt: skip
COMMON_INCLUDE = ("include", "bsp")
TIMEOUT_S = 300


class FirmwareError(Exception):
    """An image could not be built, or is not what its board asks for."""


class UnknownBoardError(FirmwareError):
    """There is no such board."""


# --- Boards --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Region:
    """A memory of the board."""

    name: str
    origin: int
    size: int

    @property
    def end(self) -> int:
        return self.origin + self.size

    def holds(self, address: int, size: int = 0) -> bool:
        """Whether all of these bytes lie in it; an empty thing may lie at its end."""
        return self.origin <= address and address + size <= self.end


@dataclass(frozen=True)
class Place:
    """Something of the image that must lie in a region."""

    region: str
    load: str = ""
    sections: tuple[str, ...] = ()
    symbols: tuple[str, ...] = ()
    code_of: tuple[str, ...] = ()
    optional: bool = False


@dataclass(frozen=True)
class Board:
    """What a board's file says."""

    name: str
    description: str
    linker_script: str
    sources: tuple[str, ...]
    application: tuple[str, ...]
    load_address: int
    regions: tuple[Region, ...]
    places: tuple[Place, ...]
    include: tuple[str, ...] = ()
    defines: tuple[str, ...] = ()

    def region(self, name: str) -> Region:
        return next(region for region in self.regions if region.name == name)


Kind = TypeVar("Kind")


class Entry:
    """A table of the file, read key by key: what is missing, mistyped or unknown is an error."""

    def __init__(self, where: str, raw: Mapping[str, object]) -> None:
        self.where = where
        self._raw = dict(raw)

    def text(self, key: str, default: str | None = None) -> str:
        return self._take(key, str, default)

    def number(self, key: str) -> int:
        value = self._take(key, int, None)
        if not 0 <= value <= 0xFFFF_FFFF:
            raise FirmwareError(f"{self.where}: {key} is no 32-bit number")
        return value

    def flag(self, key: str) -> bool:
        return self._take(key, bool, False)

    def texts(self, key: str) -> tuple[str, ...]:
        values = self._take(key, list, [])
        if not all(isinstance(value, str) for value in values):
            raise FirmwareError(f"{self.where}: {key} is no list of texts")
        return tuple(str(value) for value in values)

    def tables(self, key: str) -> list[Entry]:
        values = self._take(key, list, [])
        if not values or not all(isinstance(value, dict) for value in values):
            raise FirmwareError(f"{self.where}: at least one [[{key}]] is needed")
        tables = [value for value in values if isinstance(value, dict)]
        return [Entry(f"{self.where}: {key} {n}", value) for n, value in enumerate(tables, 1)]

    def end(self) -> None:
        """Everything must have been read."""
        if self._raw:
            raise FirmwareError(f"{self.where}: unknown key {min(self._raw)}")

    def _take(self, key: str, kind: type[Kind], default: Kind | None) -> Kind:
        value = self._raw.pop(key, default)
        if value is None:
            raise FirmwareError(f"{self.where}: {key} is missing")
        if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
            raise FirmwareError(f"{self.where}: {key} has the wrong type")
        return value


def read_region(entry: Entry) -> Region:
    region = Region(entry.text("name"), entry.number("origin"), entry.number("size"))
    entry.end()
    return region


def read_place(entry: Entry, regions: Sequence[Region]) -> Place:
    place = Place(
        entry.text("region"), entry.text("load", ""), entry.texts("sections"),
        entry.texts("symbols"), entry.texts("code_of"), entry.flag("optional"),
    )  # fmt: skip
    entry.end()
    known = {region.name for region in regions}
    for name in (place.region, place.load):
        if name and name not in known:
            raise FirmwareError(f"{entry.where}: there is no region {name}")
    if sum(map(bool, (place.sections, place.symbols, place.code_of))) != 1:
        raise FirmwareError(f"{entry.where}: one of sections, symbols and code_of is needed")
    return place


def read_board(root: Path, name: str) -> Board:
    """Read and check a board's file."""
    known = board_names(root)
    if name not in known:
        there = ", ".join(known) or "none"
        raise UnknownBoardError(f"there is no board {name or '(none named)'}; boards: {there}")
    path = root / "bsp" / name / BOARD_FILE
    where = path.relative_to(root).as_posix()
    try:
        entry = Entry(where, tomllib.loads(path.read_text(encoding="utf-8")))
    except tomllib.TOMLDecodeError as error:
        raise FirmwareError(f"{where}: {error}") from error
    regions = tuple(read_region(item) for item in entry.tables("region"))
    board = Board(
        name, entry.text("description"), entry.text("linker_script"), entry.texts("sources"),
        entry.texts("application"), entry.number("load_address"), regions,
        tuple(read_place(item, regions) for item in entry.tables("place")),
        entry.texts("include"), entry.texts("defines"),
    )  # fmt: skip
    entry.end()
    for file in (board.linker_script, *board.include):
        if not (root / file).exists():
            raise FirmwareError(f"{where}: there is no {file}")
    return board


def board_names(root: Path) -> list[str]:
    """The boards that there are."""
    return sorted(path.parent.name for path in (root / "bsp").glob(f"*/{BOARD_FILE}"))


def source_files(root: Path, names: Sequence[str]) -> list[str]:
    """The files that a list of files and folders stands for, each once."""
    files: dict[str, None] = {}
    for name in names:
        path = root / name
        if path.is_file():
            files[name] = None
            continue
        below = [item for item in path.rglob("*") if item.suffix in (".c", ".S")]
        if not below:
            raise FirmwareError(f"there is no source file {name}, and no folder with some")
        files.update(dict.fromkeys(sorted(item.relative_to(root).as_posix() for item in below)))
    return list(files)


# --- Building ------------------------------------------------------------------------------------


def run(command: Sequence[str], root: Path) -> str:
    """What a command prints; its error is ours."""
    try:
        done = subprocess.run(
            command, cwd=root, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
        )
    except subprocess.TimeoutExpired:
        raise FirmwareError(f"{command[0]} does not end within {TIMEOUT_S} s") from None
    if done.returncode != 0:
        raise FirmwareError(f"{Path(command[0]).name} fails:\n{done.stderr.strip()}")
    return done.stdout


@dataclass(frozen=True)
class Image:
    """A linked image."""

    elf: Path
    binary: Path
    map: Path
    objects: tuple[Path, ...]


class Builder:
    """Builds images of one board into one folder; compiles a file at most once for all of them."""

    def __init__(self, tools: Toolchain, board: Board, folder: Path, root: Path = ROOT) -> None:
        self.tools = tools
        self.board = board
        self.folder = folder
        self.root = root
        self._objects: dict[tuple[str, ...], Path] = {}

    @property
    def flags(self) -> list[str]:
        """The compiler's flags for the board, but for the folder that they hide."""
        include = [f"-I{name}" for name in (*COMMON_INCLUDE, *self.board.include)]
        defines = [f"-D{item}" for item in self.board.defines]
        return [*TARGET_FLAGS, *FLAGS, *include, *defines]

    def object(self, source: str, extra: Sequence[str] = (), warn: bool = True) -> Path:
        """Compile a file; the object's path ends as the source's does, for the linker script."""
        key = (source, str(warn), *extra)
        if key not in self._objects:
            kind = hashlib.sha256(" ".join(key[1:]).encode()).hexdigest()[:8] if extra else "obj"
            foreign = Path(source).is_absolute()
            inner = Path("foreign", Path(source).name) if foreign else Path(source)
            target = (self.folder / kind / inner).with_suffix(".o")
            target.parent.mkdir(parents=True, exist_ok=True)
            flags = [*self.flags, f"-ffile-prefix-map={self.root}=.", *extra]
            flags += [f"-ffile-prefix-map={Path(source).parent}=foreign"] if foreign else []
            flags += WARNINGS if warn else ["-w"]
            out = str(target.relative_to(self.root))
            gcc = self.tools.command("arm-none-eabi-gcc")
            run([*gcc, *flags, "-c", source, "-o", out], self.root)
            self._objects[key] = target
        return self._objects[key]

    def sources(self) -> dict[Path, str]:
        """The source file of each object that was compiled."""
        return {path: key[0] for key, path in self._objects.items()}

    def objects(self, names: Sequence[str], extra: Sequence[str] = ()) -> list[Path]:
        """Compile files and folders."""
        with ThreadPoolExecutor(2) as pool:
            files = source_files(self.root, names)
            return list(pool.map(lambda file: self.object(file, extra), files))

    def link(self, name: str, objects: Sequence[Path]) -> Image:
        """Link the board's own objects and these to <name>.elf, .bin and .map, checked."""
        elf, binary, map_file = (self.folder / f"{name}.{end}" for end in ("elf", "bin", "map"))
        for file in (elf, binary, map_file):
            file.unlink(missing_ok=True)
        whole = (*objects, *self.objects(self.board.sources))
        words = [str(path.relative_to(self.root)) for path in whole]
        script = self.board.linker_script
        flags = [
            *TARGET_FLAGS,
            *LINK_FLAGS,
            f"-Wl,-Map={map_file.relative_to(self.root)}",
            f"-T{script}",
        ]
        gcc = self.tools.command("arm-none-eabi-gcc")
        draft = elf.with_suffix(".tmp")
        run([*gcc, *flags, *words, "-lm", "-lc", "-lgcc", "-o", str(draft)], self.root)
        draft.rename(elf)
        objcopy = self.tools.command("arm-none-eabi-objcopy")
        run([*objcopy, "-O", "binary", str(elf), str(draft)], self.root)
        draft.rename(binary)
        return Image(elf, binary, map_file, whole)


# --- What is in an image -------------------------------------------------------------------------


@dataclass(frozen=True)
class Section:
    """A section that takes memory, with its addresses at run time and in the image."""

    name: str
    address: int
    size: int
    load: int | None  # None: nothing of it is in the image.


@dataclass(frozen=True)
class Symbol:
    """A function or object."""

    name: str
    address: int
    size: int
    function: bool
    section: str
    file: str  # of a local symbol: the name of its source file.


@dataclass
class Contents:
    """Sections and symbols of an ELF file."""

    entry: int
    sections: list[Section] = field(default_factory=list)
    symbols: list[Symbol] = field(default_factory=list)

    def symbol(self, name: str) -> Symbol:
        for symbol in self.symbols:
            if symbol.name == name:
                return symbol
        raise FirmwareError(f"the image has no symbol {name}")


def elf_file(tools: Toolchain) -> Any:
    """The reader of ELF files."""
    folder = tools.command("pyelftools")[0]
    if folder not in sys.path:
        sys.path.insert(0, folder)
    return importlib.import_module("elftools.elf.elffile").ELFFile


def load_address_of(section: Any, segments: Sequence[Any]) -> int | None:
    """Where the image holds a section's bytes."""
    if section["sh_type"] == "SHT_NOBITS":
        return None
    for segment in segments:
        offset = section["sh_addr"] - segment["p_vaddr"]
        if segment["p_type"] == "PT_LOAD" and 0 <= offset < max(segment["p_filesz"], 1):
            return int(segment["p_paddr"] + offset)
    return None


def read_contents(reader: Any, path: Path) -> Contents:
    """Read an ELF file: of a linked image, or of an object (whose addresses mean nothing)."""
    with path.open("rb") as stream:
        elf = reader(stream)
        segments = list(elf.iter_segments())
        contents = Contents(int(elf["e_entry"]))
        names = [section.name for section in elf.iter_sections()]
        for section in elf.iter_sections():
            if section["sh_flags"] & 2 and section["sh_size"]:  # SHF_ALLOC
                load = load_address_of(section, segments)
                size = int(section["sh_size"])
                contents.sections.append(Section(section.name, section["sh_addr"], size, load))
        contents.symbols = list(read_symbols(elf, names))
    return contents


def read_symbols(elf: Any, sections: Sequence[str]) -> Iterator[Symbol]:
    """Functions, objects and the linker script's names."""
    file = ""
    for symbol in elf.get_section_by_name(".symtab").iter_symbols():
        kind, where = symbol["st_info"]["type"], symbol["st_shndx"]
        if kind == "STT_FILE":
            file = Path(symbol.name).name
        elif kind in ("STT_FUNC", "STT_OBJECT", "STT_NOTYPE") and symbol.name:
            section = sections[where] if isinstance(where, int) else str(where)
            local = symbol["st_info"]["bind"] == "STB_LOCAL"
            function = kind == "STT_FUNC"
            address = int(symbol["st_value"]) & (~1 if function else ~0)
            if section != "SHN_UNDEF" and not symbol.name.startswith("$"):
                size = int(symbol["st_size"])
                name = symbol.name
                yield Symbol(name, address, size, function, section, file if local else "")


# --- Checks --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Check:
    """One thing that was looked at, and what is wrong with it."""

    what: str
    address: int
    region: str
    wrong: str = ""


def check_sections(board: Board, contents: Contents) -> Iterator[Check]:
    """Every section lies within one region, and so do its bytes in the image."""
    for section in contents.sections:
        homes = [item.name for item in board.regions if item.holds(section.address, section.size)]
        wrong = "" if homes else f"{section.size} bytes lie in no region"
        yield Check(f"section {section.name}", section.address, "".join(homes[:1]), wrong)
        if section.load is not None:
            homes = [item.name for item in board.regions if item.holds(section.load, section.size)]
            wrong = "" if homes else f"{section.size} bytes are loaded into no region"
            yield Check(f"load of {section.name}", section.load, "".join(homes[:1]), wrong)


def check_overlap(contents: Contents) -> Iterator[Check]:
    """No two sections share bytes, at run time or in the image."""
    at_run = [(s.address, s.address + s.size, s.name) for s in contents.sections]
    loaded = [(s.load, s.load + s.size, s.name) for s in contents.sections if s.load is not None]
    for kind, spans in (("", sorted(at_run)), ("load of ", sorted(loaded))):
        for (_, end, first), (start, _, second) in zip(spans, spans[1:], strict=False):
            if start < end:
                yield Check(f"{kind}{second}", start, "", f"overlaps {first}")


def functions_of(
    place: Place, contents: Contents, own: Mapping[str, Contents], root: Path
) -> list[Symbol]:
    """The functions in the image that come from the source files of a place."""
    wanted = set(source_files(root, place.code_of))
    found = []
    for source, made in own.items():
        if source in wanted:
            names = {(item.name, item.file) for item in made.symbols if item.function}
            code = [item for item in contents.symbols if item.function]
            found += [item for item in code if (item.name, item.file) in names]
    return found


def placed(
    place: Place, contents: Contents, own: Mapping[str, Contents], root: Path
) -> Iterator[tuple[str, list[Section | Symbol]]]:
    """Each name of a place with what it stands for in the image."""
    for pattern in place.sections:
        found = [item for item in contents.sections if fnmatchcase(item.name, pattern)]
        yield f"section {pattern}", [*found]
    for pattern in place.symbols:
        named = [item for item in contents.symbols if fnmatchcase(item.name, pattern)]
        yield f"symbol {pattern}", [*named]
    if place.code_of:
        yield f"code of {', '.join(place.code_of)}", [*functions_of(place, contents, own, root)]


def load_of(item: Section | Symbol, contents: Contents) -> int | None:
    """Where the image holds a thing."""
    if isinstance(item, Section):
        return item.load
    for section in contents.sections:
        if section.name == item.section and section.load is not None:
            return section.load + item.address - section.address
    return None


def check_places(
    board: Board, contents: Contents, own: Mapping[str, Contents], root: Path = ROOT
) -> Iterator[Check]:
    """What the board's file places lies there."""
    for place in board.places:
        region = board.region(place.region)
        for name, found in placed(place, contents, own, root):
            if not found and not place.optional:
                yield Check(name, 0, place.region, "the image holds no such thing")
            for item in found:
                what = f"{name}: {item.name}" if item.name not in name.split() else name
                inside = region.holds(item.address, item.size)
                yield Check(what, item.address, place.region, "" if inside else "lies elsewhere")
                if place.load:
                    load = load_of(item, contents)
                    good = load is not None and board.region(place.load).holds(load, item.size)
                    yield Check(
                        f"load of {what}", load or 0, place.load, "" if good else "lies elsewhere"
                    )


def check_start(board: Board, contents: Contents) -> Iterator[Check]:
    """The image begins at the load address, and its entry is code in the image."""
    loads = [section.load for section in contents.sections if section.load is not None]
    first = min(loads, default=0)
    wrong = "" if first == board.load_address else f"the image begins at 0x{first:08x}"
    yield Check("load address", board.load_address, "", wrong)
    code = [
        item for item in contents.symbols
        if item.function and item.address == contents.entry & ~1 and contents.entry & 1
    ]  # fmt: skip
    yield Check("entry", contents.entry, "", "" if code else "is no Thumb function")


def check_image(
    board: Board, contents: Contents, own: Mapping[str, Contents], root: Path = ROOT
) -> list[Check]:
    """All checks."""
    return [
        *check_start(board, contents),
        *check_sections(board, contents),
        *check_overlap(contents),
        *check_places(board, contents, own, root),
    ]


def usage(board: Board, contents: Contents) -> dict[str, int]:
    """How much of each region is taken, the copies of what runs elsewhere included."""
    used = dict.fromkeys((region.name for region in board.regions), 0)
    for section in contents.sections:
        for region in board.regions:
            if region.holds(section.address, section.size):
                used[region.name] += section.size
            if (
                section.load is not None
                and section.load != section.address
                and region.holds(section.load, section.size)
            ):
                used[region.name] += section.size
    return used


def own_contents(builder: Builder, image: Image) -> dict[str, Contents]:
    """The contents of the objects, by source file."""
    reader = elf_file(builder.tools)
    source = builder.sources()
    return {source[path]: read_contents(reader, path) for path in image.objects}


def examine(builder: Builder, image: Image) -> tuple[Contents, list[Check]]:
    """Read an image and check it; what is wrong is an error."""
    contents = read_contents(elf_file(builder.tools), image.elf)
    checks = check_image(builder.board, contents, own_contents(builder, image), builder.root)
    bad = [item for item in checks if item.wrong]
    if bad:
        asked = f"bsp/{builder.board.name}/{BOARD_FILE}"
        wrong = [f"  0x{item.address:08x} {item.what}: {item.wrong}" for item in bad]
        raise FirmwareError("\n".join([f"{image.elf.name} is not as {asked} asks:", *wrong]))
    return contents, checks


# --- Report --------------------------------------------------------------------------------------


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def report_of(
    builder: Builder, image: Image, contents: Contents, checks: Sequence[Check]
) -> dict[str, object]:
    board = builder.board
    versions = {name: found.version for name, found in builder.tools.versions("firmware").items()}
    return {
        "schema": 1,
        "board": board.name,
        "tools": versions,
        "flags": builder.flags,
        "link_flags": list(LINK_FLAGS),
        "load_address": board.load_address,
        "elf": {"file": image.elf.name, "sha256": sha256(image.elf)},
        "binary": {
            "file": image.binary.name,
            "sha256": sha256(image.binary),
            "size": image.binary.stat().st_size,
        },
        "regions": {
            region.name: {"origin": region.origin, "size": region.size, "used": used}
            for region, used in zip(board.regions, usage(board, contents).values(), strict=True)
        },
        "sections": [asdict(section) for section in contents.sections],
        "sources": {
            source: sha256(builder.root / source) for source in sorted(builder.sources().values())
        },
        "checks": [asdict(check) for check in checks],
    }


def print_usage(board: Board, contents: Contents) -> None:
    print("  region        used      size")
    for region, used in zip(board.regions, usage(board, contents).values(), strict=True):
        print(f"  {region.name:10}{used:8}{region.size:10}  {100 * used / region.size:5.1f} %")


def build(tools: Toolchain, name: str, application: Sequence[str], root: Path = ROOT) -> Path:
    """Build a board's image; the folder it is in."""
    board = read_board(root, name)
    folder = root / BUILD / name
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "report.json").unlink(missing_ok=True)
    builder = Builder(tools, board, folder, root)
    image = builder.link("keel", builder.objects(application or board.application))
    contents, checks = examine(builder, image)
    text = json.dumps(report_of(builder, image, contents, checks), indent=1) + "\n"
    write_atomically(folder / "report.json", text)
    print_usage(board, contents)
    size = image.binary.stat().st_size
    shown = folder.relative_to(root)
    print(f"firmware: {shown}/keel.elf, {size} bytes to load at 0x{board.load_address:08x}, "
          f"{len(checks)} checks of places passed.")  # fmt: skip
    return folder


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Build the firmware of a board.")
    parser.add_argument("board", help="the board, a folder of bsp")
    parser.add_argument(
        "--app", action="append", default=[], metavar="PATH",
        help="a file or folder with the application, instead of the board's own",
    )  # fmt: skip
    options = parser.parse_args(arguments)
    try:
        tools = Toolchain()
        read_board(root, options.board)
        tools.ensure("firmware")
        build(tools, options.board, options.app, root)
    except UnknownBoardError as error:
        print(f"firmware: {error}", file=sys.stderr)
        return 2
    except (FirmwareError, ToolchainError, OSError) as error:
        print(f"firmware: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
