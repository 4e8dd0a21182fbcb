#!/usr/bin/env python3
"""Bound the stack of every task and of main(), from the compiler's call graph.

    python3 tools/stack.py nucleo_f767zi     # of the image that 'make firmware' built

The compiler writes for each function how much stack its frame takes and whom it calls (*.ci beside
the objects). What it cannot know stands in specs/stack.toml:

    tasks         the bodies of tasks, which the scheduler calls
    [[indirect]]  a function that calls through a pointer, and all that it may call, or nothing if
                  the pointer is null; "tasks" stands for the bodies
    [[entry]]     a function that hardware or assembly enters, and with how many bytes on its stack
                  already; stack = "fault" when that is not the main stack

Functions of the compiler's library have no such data; their frames are read from the image's
instructions. An error is: an indirect call without an entry, a function without data, a frame
without a bound, recursion, and a function of the image that nothing reaches, since then a call is
missing here. To the deepest path comes what the core stacks for an exception, with the registers of
the FPU: no interrupt is enabled, so there is at most one, a fault, whose handler has a stack of its
own. Where the application ran on the emulated board (make test-target) since the image was built,
its painted stack must not have been deeper than the bound.

build/stack/<board>.json has the bound of each task and the deepest path of each stack. Exit
status: 0 when every bound holds, 1 when not, 2 for a wrong command line.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path

from toolchain import Toolchain, ToolchainError, write_atomically

ROOT = Path(__file__).resolve().parents[1]
FIRMWARE = "build/firmware"
TABLE = "specs/stack.toml"
REPORT = "build/stack"
PAINTED = "build/test-target/report.json"
INDIRECT = "__indirect_call"
TASKS = "tasks"

# Eight registers, the FPU's sixteen, its status and a reserved word, and the word that aligns them
# (ARMv7-M Architecture Reference Manual, B1.5.7).
EXCEPTION_FRAME_B = 8 * 4 + 18 * 4 + 4


class StackError(Exception):
    """A stack has no bound, or too little room; the message says why."""


# --- The call graph ------------------------------------------------------------------------------


@dataclass
class Function:
    """A function: its name in the image, its frame in bytes (None: unknown), whom it calls."""

    name: str
    file: str = ""  # Of a function that only its own file sees.
    frame: int | None = None
    calls: set[str] = field(default_factory=set)
    indirect: bool = False


NODE = re.compile(r'^node: \{ title: "([^"]+)" label: "([^"]*)"')
EDGE = re.compile(r'^edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')
FRAME = re.compile(r"(\d+) bytes \(([a-z,]+)\)")


def parse(text: str, graph: dict[str, Function], where: str = "") -> None:
    """Add a file's functions and calls to the graph. Names of static functions hold their file."""
    for line in text.splitlines():
        if node := NODE.match(line):
            title, label = node.groups()
            if title == INDIRECT:
                continue
            file, _, name = title.rpartition(":")
            function = graph.setdefault(title, Function(name, file))
            frame = FRAME.search(label.replace("\\n", "\n"))
            if frame and frame[2] not in ("static", "dynamic,bounded"):
                raise StackError(f"{where}: the frame of {name} has no bound ({frame[2]})")
            if frame and function.frame is not None:
                raise StackError(f"{where}: {name} is defined twice")
            if frame:
                function.frame = int(frame[1])
        elif edge := EDGE.match(line):
            source, target = edge.groups()
            file, _, name = source.rpartition(":")
            caller = graph.setdefault(source, Function(name, file))
            if target == INDIRECT:
                caller.indirect = True
            else:
                caller.calls.add(target)


def read_graph(root: Path, board: str) -> tuple[dict[str, Function], Path]:
    """The call graph of the image that was built, and the image."""
    folder = root / FIRMWARE / board
    try:
        report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
        sources, elf = list(report["sources"]), folder / report["elf"]["file"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise StackError(
            f"no image of {board} ({error}); run: make firmware BOARD={board}"
        ) from error
    graph: dict[str, Function] = {}
    for source in sources:
        path = (folder / "obj" / source).with_suffix(".ci")
        try:
            parse(path.read_text(encoding="utf-8"), graph, source)
        except OSError as error:
            raise StackError(f"no call graph of {source}: {error}") from error
    return graph, elf


# --- The image -----------------------------------------------------------------------------------

HEADING = re.compile(r"^([0-9a-f]+) <([^>]+)>:$")
INSTRUCTION = re.compile(r"^\s*[0-9a-f]+:\s+(\S+)\s*([^;@]*)")
VENEER = re.compile(r"__(\w+)_veneer")  # A jump between memories that the linker put in; no frame.
BRANCH = re.compile(r"[0-9a-f]+ <([^>+]+)>")


def registers(text: str) -> int:
    """The number of registers in a list such as {r4, r6-r8, lr}."""
    count = 0
    for item in re.findall(r"[a-z]+\d*(?:-[a-z]+\d+)?", text):
        first, _, last = item.partition("-")
        count += int(re.sub(r"\D", "", last)) - int(re.sub(r"\D", "", first)) + 1 if last else 1
    return count


def taken(name: str, operation: str, operands: str) -> int:
    """The bytes by which an instruction moves the stack pointer down."""
    code = operation.removesuffix(".w").removesuffix(".n")
    listed = operands.partition("{")[2].partition("}")[0]
    if code == "push" or (code in ("stmdb", "stmfd") and operands.startswith("sp!")):
        return 4 * registers(listed)
    if code == "vpush":
        return (8 if listed.lstrip().startswith("d") else 4) * registers(listed)
    if code in ("sub", "subs", "subw") and operands.startswith("sp"):
        amount = re.search(r"#(\d+)", operands)
        if not amount:
            raise StackError(f"{name}: the frame has no bound ({operation} {operands.strip()})")
        return int(amount[1])
    if code.startswith(("str", "strd")) and (amount := re.search(r"\[sp, #-(\d+)\]!", operands)):
        return int(amount[1])
    return 0


@dataclass
class Code:
    """A function's instructions: all that they may push, and the functions they branch to."""

    pushed: int = 0
    calls: set[str] = field(default_factory=set)


def read_code(listing: str) -> dict[str, Code]:
    """What objdump -d shows, function by function. Every push is counted, whatever the path."""
    found: dict[str, Code] = {}
    name = ""
    for line in listing.splitlines():
        if heading := HEADING.match(line):
            name = heading[2]
            found[name] = Code()
        elif name and (instruction := INSTRUCTION.match(line)):
            operation, operands = instruction.groups()
            found[name].pushed += taken(name, operation, operands)
            branch = BRANCH.search(operands)
            if branch and operation.startswith("b") and branch[1] != name:
                veneer = VENEER.fullmatch(branch[1])
                found[name].calls.add(veneer[1] if veneer else branch[1])
    return found


def complete(graph: dict[str, Function], code: Mapping[str, Code]) -> list[str]:
    """Give the functions of libraries their frames, and their calls; the names of those."""
    library: list[str] = []
    open_titles = [title for title, function in graph.items() if function.frame is None]
    while open_titles:
        title = open_titles.pop()
        function = graph[title]
        if function.name not in code:
            raise StackError(f"{title}: neither the compiler nor the image knows its frame")
        function.frame = code[function.name].pushed
        function.calls = set(code[function.name].calls)
        library.append(function.name)
        for target in function.calls - graph.keys():
            graph[target] = Function(target)
            open_titles.append(target)
    return sorted(library)


# --- The table -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Entry:
    """Where hardware or assembly enters: bytes on the stack already, and which stack it is."""

    function: str
    bytes: int
    stack: str


@dataclass(frozen=True)
class Table:
    """What the compiler cannot know."""

    tasks: tuple[str, ...]
    indirect: dict[str, tuple[str, ...]]
    entries: tuple[Entry, ...]


def read_table(path: Path) -> Table:
    """Read and check the table."""
    try:
        raw = tomllib.loads(path.read_text(encoding="utf-8"))
        indirect: dict[str, tuple[str, ...]] = {}
        for item in raw.pop("indirect", []):
            caller = str(item["caller"])
            if caller in indirect:
                raise StackError(f"{path.name}: {caller} has two entries")
            if set(item) != {"caller", "calls", "reason"}:
                raise StackError(f"{path.name}: {caller}: caller, calls and reason are needed")
            indirect[caller] = tuple(map(str, item["calls"]))
        entries = tuple(
            Entry(str(item["function"]), int(item.get("bytes", 0)), str(item.get("stack", "main")))
            for item in raw.pop("entry", [])
        )
        tasks = tuple(map(str, raw.pop("tasks", [])))
    except (OSError, KeyError, TypeError, ValueError, AttributeError) as error:
        raise StackError(f"{path.name}: {error}") from error
    if raw:
        raise StackError(f"{path.name}: unknown key {min(raw)}")
    if not entries:
        raise StackError(f"{path.name}: no entry: nothing would be bounded")
    return Table(tasks, indirect, entries)


def resolve(graph: dict[str, Function], table: Table) -> list[str]:
    """Put the table's calls into the graph; the titles of the tasks' bodies that are there."""

    def titles(name: str) -> list[str]:
        return [title for title, item in graph.items() if item.name == name]

    tasks = [title for name in table.tasks for title in titles(name)]
    for caller in sorted(name for name, function in graph.items() if function.indirect):
        name = graph[caller].name.partition(".")[0]  # A clone calls what its original calls.
        if name not in table.indirect:
            raise StackError(f"{caller} calls through a pointer: {TABLE} does not say whom")
        targets: set[str] = set()
        for target in table.indirect[name]:
            targets.update(tasks if target == TASKS else titles(target))
        if table.indirect[name] and not targets:
            raise StackError(f"{caller}: none of what {TABLE} says it calls is in the image")
        graph[caller].calls |= targets
    return tasks


# --- Bounds --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Deepest:
    """The deepest path from a function: its bytes, and the functions on it."""

    bytes: int
    functions: tuple[str, ...]


class Bounds:
    """The deepest path from each function; computed once each."""

    def __init__(self, graph: Mapping[str, Function]) -> None:
        self.graph = graph
        self._known: dict[str, Deepest] = {}
        self._open: list[str] = []

    def of(self, title: str) -> Deepest:
        """The deepest path from a function."""
        if title in self._known:
            return self._known[title]
        if title in self._open:
            circle = [*self._open[self._open.index(title) :], title]
            raise StackError(f"recursion: {' -> '.join(circle)}")
        function = self.graph.get(title)
        if function is None or function.frame is None:
            raise StackError(f"{title}: its frame is not known")
        self._open.append(title)
        below = [self.of(target) for target in sorted(function.calls)]
        self._open.pop()
        deepest = max(below, key=lambda path: path.bytes, default=Deepest(0, ()))
        found = Deepest(function.frame + deepest.bytes, (title, *deepest.functions))
        self._known[title] = found
        return found

    @property
    def reached(self) -> set[str]:
        """The functions whose bounds were needed."""
        return set(self._known)


def check_reached(graph: Mapping[str, Function], reached: set[str], image: set[str]) -> None:
    """Every function of the image must be on some path; else a call is missing in the graph."""
    names = {graph[title].name for title in reached}
    missing = sorted(image - names)
    if missing:
        raise StackError(f"in the image, but nobody calls them: {', '.join(missing)}; a call "
                         f"through a pointer or an entry is missing in {TABLE}")  # fmt: skip


@dataclass(frozen=True)
class Stack:
    """A stack with its room and its deepest path, the exception's frame included."""

    name: str
    size: int
    bytes: int
    path: tuple[str, ...]


def analyse(
    graph: dict[str, Function], code: Mapping[str, Code], table: Table, sizes: Mapping[str, int]
) -> tuple[list[Stack], dict[str, Deepest], list[str]]:
    """The stacks, the bound of each task and the functions of libraries."""
    # Only what is in the image counts: the compiler also lists what the linker left out.
    for title in [title for title, item in graph.items() if item.name not in code]:
        del graph[title]
    for function in graph.values():
        function.calls &= graph.keys()
    library = complete(graph, code)
    tasks = resolve(graph, table)
    bounds = Bounds(graph)
    stacks: list[Stack] = []
    for name, size in sizes.items():
        extra = EXCEPTION_FRAME_B if name == "main" else 0
        found = [
            Stack(name, size, entry.bytes + path.bytes + extra, path.functions)
            for entry in table.entries if entry.stack == name and entry.function in graph
            for path in [bounds.of(entry.function)]
        ]  # fmt: skip
        if not found:
            raise StackError(f"{TABLE} names no entry of this image on the stack {name}")
        stacks.append(max(found, key=lambda stack: stack.bytes))
    check_reached(graph, bounds.reached, set(code))
    return stacks, {graph[title].name: bounds.of(title) for title in tasks}, library


# --- The image of a board ------------------------------------------------------------------------

SYMBOLS = {
    "main": ("keel_stack_bottom", "keel_stack_top"),
    "fault": ("keel_stack_top", "keel_fault_stack_top"),
}


def run(command: Sequence[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    if done.returncode != 0:
        raise StackError(f"{command[0]} fails: {done.stderr.strip()}")
    return done.stdout


def stack_sizes(symbols: str) -> dict[str, int]:
    """The room of each stack, from what nm prints."""
    address = {
        name: int(value, 16) for value, name in re.findall(r"^(\w+) \w (\w+)$", symbols, re.M)
    }
    try:
        return {name: address[top] - address[bottom] for name, (bottom, top) in SYMBOLS.items()}
    except KeyError as error:
        raise StackError(f"the image has no symbol {error}") from error


def functions_of(symbols: str) -> Iterator[str]:
    """The functions in the image, from what objdump -t prints; not the linker's own detours."""
    for name in re.findall(r"^\w+ ......F \S+\t\w+ (?:\.\w+ )?(\S+)$", symbols, re.MULTILINE):
        if not VENEER.fullmatch(name):
            yield name


def painted(root: Path, board: str, elf: Path) -> int | None:
    """How deep the painted stack of this very image was when it last ran on the emulated board;
    None when it did not run there."""
    path = root / PAINTED
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
        used = report["painted_stack"]["used"].get("demo")
        same = report["painted_stack"]["demo_sha256"] == sha256(elf.read_bytes()).hexdigest()
    except (OSError, ValueError, KeyError, AttributeError, TypeError):
        return None
    return int(used) if used is not None and same and report.get("board") == board else None


def measure(tools: Toolchain, root: Path, board: str) -> dict[str, object]:
    """Analyse a board's image; the report."""
    graph, elf = read_graph(root, board)
    listing = run([*tools.command("arm-none-eabi-objdump"), "-d", "--no-show-raw-insn", str(elf)])
    symbols = run([*tools.command("arm-none-eabi-nm"), str(elf)])
    names = set(functions_of(run([*tools.command("arm-none-eabi-objdump"), "-t", str(elf)])))
    code = {name: item for name, item in read_code(listing).items() if name in names}
    stacks, tasks, library = analyse(graph, code, read_table(root / TABLE), stack_sizes(symbols))
    return {
        "board": board,
        "exception_frame_bytes": EXCEPTION_FRAME_B,
        "stacks": {
            stack.name: {"size": stack.size, "bound": stack.bytes, "path": list(stack.path)}
            for stack in stacks
        },
        "tasks": {name: {"bound": path.bytes, "path": list(path.functions)}
                  for name, path in tasks.items()},
        "frames_from_instructions": library,
        "painted": painted(root, board, elf),
        "functions": len(code),
    }  # fmt: skip


def conclude(report: Mapping[str, object], root: Path) -> int:
    """Print the bounds, write the report; the exit status."""
    stacks, tasks = report["stacks"], report["tasks"]
    assert isinstance(stacks, dict)
    assert isinstance(tasks, dict)
    for name, task in tasks.items():
        print(f"  task {name:<28} {task['bound']:6d} bytes")
    for name, stack in stacks.items():
        print(f"  stack {name:<27} {stack['bound']:6d} of {stack['size']} bytes: "
              f"{' > '.join(item.rpartition(':')[2] for item in stack['path'])}")  # fmt: skip
    path = root / REPORT / f"{report['board']}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(path, json.dumps(report, indent=1) + "\n")
    short = [name for name, stack in stacks.items() if stack["bound"] > stack["size"]]
    verdict = f"TOO LITTLE ROOM: {', '.join(short)}" if short else "every stack has room"
    deepest = report.get("painted")
    if deepest is None:
        print("  painted stack: not compared, for this image did not run on the emulated board")
    if isinstance(deepest, int):  # No exception came while it ran.
        limit = stacks["main"]["bound"] - EXCEPTION_FRAME_B
        print(f"  painted stack on the emulated board: {deepest} of the {limit} bytes bounded")
        if deepest > limit:
            short.append("main")
            verdict = "THE BOUND IS WRONG: the painted stack was deeper"
    print(f"stack: {report['functions']} functions of {report['board']}, {len(tasks)} bodies of "
          f"tasks: {verdict}.")  # fmt: skip
    return 1 if short else 0


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Bound the stacks of a board's image.")
    parser.add_argument("board", help="the board, a folder of bsp")
    options = parser.parse_args(arguments)
    (root / REPORT / f"{options.board}.json").unlink(missing_ok=True)
    try:
        tools = Toolchain()
        tools.ensure("firmware")
        return conclude(measure(tools, root, options.board), root)
    except (StackError, ToolchainError, OSError) as error:
        print(f"stack: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
