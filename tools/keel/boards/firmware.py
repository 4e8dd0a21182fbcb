# SPDX-License-Identifier: Apache-2.0
"""Build the firmware of a board, and check from the ELF that everything lies where it must.

    python3 tools/keel firmware mps2_an500                     # the board's application
    python3 tools/keel firmware nucleo_f767zi --app my/folder  # another application
    python3 tools/keel firmware fmuv5 --app examples/recorder --with fatfs
    python3 tools/keel firmware fmuv5 --named copter

A board is a folder bsp/<board> with a file board.toml:

    description   one line
    linker_script the script, relative to the root as all paths here
    sources       files, or folders whose *.c and *.S (below them too) belong to the image
    include       folders with headers, besides include and bsp
    defines       macros, as NAME or NAME=VALUE
    application   the files or folders with main(); --app takes others
    [[named]]     name, application, libraries: other applications, for --named
    load_address  the address of the binary file's first byte: the load address of the image
    [[region]]    name, origin, size: the memories that an image may use; none else is used
    [[place]]     region, and one of sections, symbols (names, with * and ?) or code_of (source
                  files or folders: each function of theirs, but for names of the list but); load,
                  optional: the region that holds the copy from which the startup code fills it. A
                  name that matches nothing is an error, unless optional = true.
    base          optional: a file with what boards share. The board's lists come behind those of
                  the base, and its regions replace those of the same name.

--with fatfs adds FatFs, and the black box on it (bsp/fatfs), to what an application may use.

build/firmware/<board> then holds keel.elf, keel.bin, keel.map, report.json, and beside each object
what the compiler knows about stacks (*.su, *.ci). An image does not depend on the folder it was
built in. A failed build leaves no report.

Exit status: 0 when the image is whole, 1 when it is not as the board's file asks, 2 when it could
not be built.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.build import Build
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import sha256_of
from keel.base.run import output_of
from keel.base.source import write_report
from keel.boards.board import BOARD_FILE, Board, application_of, read_board
from keel.boards.built import FIRMWARE
from keel.boards.elf import Contents, read_contents
from keel.boards.placement import Check, check_image, usage
from keel.install import TARGET_FLAGS, Toolchain

WARNINGS = ("-Wall", "-Wextra", "-Werror", "-Wconversion", "-Wdouble-promotion", "-Wundef")
# No contraction: a fused multiply-add would round once where the proofs and the host round twice.
FLAGS = (
    "-std=c99",
    "-O2",
    "-g",
    "-ffreestanding",
    "-ffunction-sections",
    "-fdata-sections",
    "-fno-common",
    "-ffp-contract=off",
    "-fstack-usage",
    "-fcallgraph-info=su,da",
)
LINK_FLAGS = (
    "-nostartfiles",
    "-static",
    "-Wl,--gc-sections",
    "-Wl,--fatal-warnings",
    "-Wl,--orphan-handling=error",
)
LIBRARIES = ("-lm", "-lc", "-lgcc")
COMMON_INCLUDE = ("include", "bsp")
FATFS = "bsp/fatfs"


class FirmwareError(ToolError):
    """An image is not what its board's file asks for."""

    status = 1


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
        include = [f"-I{name}" for name in (*COMMON_INCLUDE, *board.include)]
        self.flags = [*TARGET_FLAGS, *FLAGS, *include, *(f"-D{item}" for item in board.defines)]
        self.link_flags = [*TARGET_FLAGS, *LINK_FLAGS, f"-T{board.linker_script}"]
        # Hides the folder; so it is not among the flags that the report tells.
        flags = [*self.flags, f"-ffile-prefix-map={root}=.", *WARNINGS]
        self.build = Build(tools, "arm-none-eabi-gcc", flags, folder, root, self.link_flags)

    def object(self, source: str, extra: Sequence[str] = ()) -> Path:
        """Compile a file."""
        hidden = [f"-ffile-prefix-map={Path(source).parent}=foreign"]
        return self.build.object(source, [*extra, *(hidden if Path(source).is_absolute() else ())])

    def objects(self, names: Sequence[str], extra: Sequence[str] = ()) -> list[Path]:
        """Compile files and folders."""
        return self.build.objects(names, extra, 2)

    def fatfs(self) -> list[Path]:
        """FatFs, without the warnings that are for our own code, and the black box on it."""
        folder = f"{self.tools.command('fatfs')[0]}/fatfs/source"
        flags = [f"-I{FATFS}", "-isystem", folder, f"-ffile-prefix-map={folder}=foreign"]
        return [*self.objects([FATFS], flags), self.object(f"{folder}/ff.c", [*flags, "-w"])]

    def link(self, name: str, objects: Sequence[Path]) -> Image:
        """Link the board's own objects and these to <name>.elf, .bin and .map."""
        binary, map_file = (self.folder / f"{name}.{end}" for end in ("bin", "map"))
        for file in (binary, map_file):
            file.unlink(missing_ok=True)
        whole = (*objects, *self.objects(self.board.sources))
        words = (f"-Wl,-Map={self.build.shown(map_file)}", *LIBRARIES)
        elf = self.build.link(f"{name}.elf", whole, words)
        draft = binary.with_suffix(".tmp")
        objcopy = self.tools.command("arm-none-eabi-objcopy")
        output_of([*objcopy, "-O", "binary", elf, draft])
        draft.rename(binary)
        return Image(elf, binary, map_file, whole)


def examine(builder: Builder, image: Image) -> tuple[Contents, list[Check]]:
    """Read an image and check it; what is wrong is an error."""
    source = builder.build.sources()
    own = {source[path]: read_contents(builder.tools, path) for path in image.objects}
    contents = read_contents(builder.tools, image.elf)
    checks = check_image(builder.board, contents, own, builder.root)
    bad = [item for item in checks if item.wrong]
    if bad:
        asked = f"bsp/{builder.board.name}/{BOARD_FILE}"
        wrong = [f"  0x{item.address:08x} {item.what}: {item.wrong}" for item in bad]
        raise FirmwareError("\n".join([f"{image.elf.name} is not as {asked} asks:", *wrong]))
    return contents, checks


def report_of(
    builder: Builder, image: Image, contents: Contents, checks: Sequence[Check]
) -> dict[str, object]:
    """What is kept of a build."""
    board = builder.board
    versions = {name: found.version for name, found in builder.tools.versions("firmware").items()}
    made = {
        path: Path("foreign", Path(name).name).as_posix() if Path(name).is_absolute() else name
        for path, name in builder.build.sources().items()
    }
    sources = {
        made[path]: sha256_of(builder.root / name) for path, name in builder.build.sources().items()
    }
    used = usage(board, contents)
    return {
        "schema": 1,
        "board": board.name,
        "tools": versions,
        "flags": builder.flags,
        "link_flags": list(LINK_FLAGS),
        "load_address": board.load_address,
        "elf": {"file": image.elf.name, "sha256": sha256_of(image.elf)},
        "binary": {
            "file": image.binary.name,
            "sha256": sha256_of(image.binary),
            "size": image.binary.stat().st_size,
        },
        "regions": {
            region.name: {"origin": region.origin, "size": region.size, "used": used[region.name]}
            for region in board.region
        },
        "sections": [asdict(section) for section in contents.sections],
        "sources": dict(sorted(sources.items())),
        "objects": {
            name: path.relative_to(builder.folder).as_posix() for path, name in sorted(made.items())
        },
        "checks": [asdict(check) for check in checks],
    }


def print_usage(board: Board, contents: Contents) -> None:
    """How full each memory is."""
    print("  region        used      size")
    for region, used in zip(board.region, usage(board, contents).values(), strict=True):
        print(f"  {region.name:10}{used:8}{region.size:10}  {100 * used / region.size:5.1f} %")


def build(
    tools: Toolchain, name: str, application: Sequence[str], root: Path = ROOT, fatfs: bool = False
) -> Path:
    """Build a board's image; the folder it is in."""
    board = read_board(root, name)
    folder = root / FIRMWARE / name
    report = folder / "report.json"
    report.unlink(missing_ok=True)
    builder = Builder(tools, board, folder, root)
    objects = builder.objects(application or board.application)
    image = builder.link("keel", [*objects, *(builder.fatfs() if fatfs else [])])
    contents, checks = examine(builder, image)
    # What is wrong has raised an error. Another application than the board's is not its firmware.
    write_report(
        report, report_of(builder, image, contents, checks), root, good=True, whole=not application
    )
    print_usage(board, contents)
    size = image.binary.stat().st_size
    print(
        f"firmware: {FIRMWARE}/{name}/keel.elf, {size} bytes to load at "
        f"0x{board.load_address:08x}, {len(checks)} checks of places passed."
    )
    return folder


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = Parser("Build the firmware of a board.", "firmware")
    parser.add_argument("board", help="the board, a folder of bsp")
    parser.add_argument(
        "--app",
        action="append",
        default=[],
        metavar="PATH",
        help="a file or folder with the application, instead of the board's own",
    )
    parser.add_argument(
        "--with",
        dest="libraries",
        action="append",
        default=[],
        choices=("fatfs",),
        help="a library that the application uses",
    )
    parser.add_argument(
        "--named", metavar="NAME", help="an application that the board's file names, instead"
    )
    options = parser.parse_args(arguments)

    def work() -> int:
        board = read_board(root, options.board)
        named = application_of(board, options.named) if options.named else None
        tools = Toolchain()
        fatfs = "fatfs" in (named.libraries if named else options.libraries)
        tools.ensure("firmware")
        if fatfs:
            tools.ensure("fatfs")
        build(tools, options.board, named.application if named else options.app, root, fatfs)
        return 0

    return program("firmware", work)
