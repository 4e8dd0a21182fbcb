#!/usr/bin/env python3
"""Run Keel's tests on a Cortex-M7 that QEMU emulates.

    python3 tools/target.py                   # everything
    python3 tools/target.py --filter fault/   # the suites whose name contains this

Suites, each one image or more of the board mps2_an500, built as its firmware is:

    unit/<unit>          the unit tests of tests/unit, and tests/target/test_core.c
    fault/<kind>         tests/target/faults.c: the fault is recorded as the processor's manual
                         says, and the board comes back in its safe state
    demo                 the firmware with the 21 tasks of table 2, ten seconds of simulated
                         time: each task has run once for each of its periods, in time; the
                         inertial unit that froze is latched, and hardly moved the voted values
    differential/<unit>  tests/target/differential.c: 10^5 random vectors of each unit give the same
                         bits in the host's build and in the target's

The emulator counts instructions, four nanoseconds each, so that every run is the same. A program
that hangs is killed and counts as failed. Each image tells how deep its stack was: the painted
stack. build/test-target/report.json has it all; an unfinished run leaves none.

Exit status: 0 when at least one test ran and none failed, 1 otherwise, 2 for a wrong command line.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
import time
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from hashlib import sha256
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools"))

from boards.board import Board, read_board  # noqa: E402
from boards.elf import read_contents  # noqa: E402
from common.build import source_files  # noqa: E402
from common.errors import ToolError  # noqa: E402
from common.run import output_of  # noqa: E402
from firmware import Builder, Image, examine  # noqa: E402
from run_tests import Ended, Outcome, run, tell, unity_outcome  # noqa: E402
from toolchain import Toolchain, ToolchainError, write_atomically  # noqa: E402

BOARD = "mps2_an500"
BUILD = Path("build/test-target")
REPORT = BUILD / "report.json"
SHIFT = 2  # An instruction takes 2^2 ns: 250 million a second, about the STM32F767's pace.
TIMEOUT_S = 120.0
LONG_TIMEOUT_S = 900.0
STACK_LINE = re.compile(r"^stack: (\d+) of (\d+) bytes used$", re.MULTILINE)


class TargetError(Exception):
    """Something could not be run; the message says what and why."""


def emulator(tools: Toolchain, board: Board, elf: Path, shift: int = SHIFT) -> list[str]:
    """The command that runs an image: its console is the standard output, its end the status."""
    return [
        *tools.command("qemu-system-arm"), "-machine", "mps2-an500",
        "-icount", f"shift={shift},sleep=off", "-display", "none", "-monitor", "none",
        "-serial", "stdio", "-semihosting-config", "enable=on,target=native",
        "-global", f"armv7m.init-nsvtor=0x{board.load_address:08x}", "-kernel", str(elf),
    ]  # fmt: skip


@dataclass
class Bench:
    """Builds images of the board, each file at most once, and runs them."""

    tools: Toolchain
    root: Path = ROOT
    stacks: dict[str, int] = field(default_factory=dict)  # by image, in bytes
    stack_size: int = 0
    demo_sha256: str = ""

    def __post_init__(self) -> None:
        self.board = read_board(self.root, BOARD)
        folder = self.root / BUILD
        folder.mkdir(parents=True, exist_ok=True)
        self.builder = Builder(self.tools, self.board, folder, self.root)

    def unity(self) -> Path:
        """Unity, writing to the board's console."""
        folder = self.tools.command("unity")[0]
        return self.builder.object(f"{folder}/unity.c", [*self.unity_flags(), "-w"])

    def unity_flags(self) -> list[str]:
        """What makes a file find Unity, and Unity the console."""
        return [
            "-isystem", self.tools.command("unity")[0],
            "-DUNITY_SUPPORT_64", "-DUNITY_INCLUDE_DOUBLE",
            "-DUNITY_OUTPUT_CHAR(c)=keel_board_put((char)(c))",
            "-DUNITY_OUTPUT_CHAR_HEADER_DECLARATION=keel_board_put(char c)",
        ]  # fmt: skip

    def run(self, image: Image, timeout_s: float = TIMEOUT_S, shift: int = SHIFT) -> Ended:
        """Run an image to its end, or to its time limit; remember its stack."""
        ended = run(emulator(self.tools, self.board, image.elf, shift), timeout_s)
        if told := STACK_LINE.search(ended.output):
            self.stacks[image.elf.stem] = int(told[1])
            self.stack_size = int(told[2])
        return ended


# --- Unit tests ----------------------------------------------------------------------------------


def unit_image(bench: Bench, name: str, source: str) -> Image:
    """The image of one file of unit tests."""
    test = bench.builder.object(source, [*bench.unity_flags(), "-w"])
    return bench.builder.link(name.replace("/", "-"), [bench.unity(), test])


def unit_suite(bench: Bench, name: str, source: str) -> Outcome:
    """The tests of one file."""
    return unity_outcome(name, bench.run(unit_image(bench, name, source)))


# --- Faults --------------------------------------------------------------------------------------

SAFE_STATUS = 70
GUARD = range(0x2000_0000, 0x2000_0400)
CODE = 0xC0DE_0042
TASK = "breaker"

# Exceptions, and bits of the fault status (ARMv7-M Architecture Reference Manual, B1.5 and B3.2).
NMI, MEMORY, BUS, USAGE, INTERRUPT_3 = 2, 4, 5, 6, 19
IACCVIOL, DACCVIOL, MSTKERR, MMARVALID = 1 << 0, 1 << 1, 1 << 4, 1 << 7
PRECISERR, BFARVALID = 1 << 9, 1 << 15
UNDEFINSTR, DIVBYZERO = 1 << 16, 1 << 25


@dataclass(frozen=True)
class Fault:
    """What must have been recorded of a fault."""

    exception: int
    status: int  # CFSR: these bits and no others but `allowed`
    allowed: int = 0
    address: range | None = None  # MMFAR or BFAR
    code: int = 0
    function: str = ""  # where it happened, if not in fault_<kind>; "-" when nowhere
    stacked: bool = True
    task: str = TASK


FAULTS = {
    "undefined": Fault(USAGE, UNDEFINSTR),
    "bus": Fault(BUS, PRECISERR | BFARVALID, address=range(0x7000_0000, 0x7000_0001)),
    "stack": Fault(
        MEMORY, MSTKERR, DACCVIOL | MMARVALID, address=GUARD, function="-", stacked=False
    ),
    "division": Fault(USAGE, DIVBYZERO),
    "null": Fault(MEMORY, DACCVIOL | MMARVALID, address=range(0x10, 0x11)),
    "execute": Fault(MEMORY, IACCVIOL, function="-"),
    "jump": Fault(MEMORY, IACCVIOL, function="-"),
    "jump_far": Fault(MEMORY, IACCVIOL, function="-"),
    "write": Fault(MEMORY, DACCVIOL | MMARVALID, address=range(0x20_0000, 0x20_0001)),
    "stop": Fault(USAGE, UNDEFINSTR, code=CODE, function="keel_fault_stop"),
    "interrupt": Fault(INTERRUPT_3, 0),
    "hang": Fault(NMI, 0),
    "lost_slot": Fault(USAGE, UNDEFINSTR, task="-"),
    "lost_task": Fault(USAGE, UNDEFINSTR, task="-"),
    "lost_name": Fault(USAGE, UNDEFINSTR, task="-"),
}

WORD = re.compile(r"\b([a-z_0-9]+) (0x[0-9a-f]{8}|\d+)\b")
RECORD = re.compile(r"^safe state: (fault .*)\n((?: .*\n)+)", re.MULTILINE)


def read_record(output: str) -> dict[str, str]:
    """What the board printed of its fault record, by names."""
    match = RECORD.search(output)
    if not match:
        return {}
    found = dict(WORD.findall(match[0]))
    task = re.search(r"\btask (\S+)", match[1])
    found["task"] = task[1] if task else ""
    found["stacked"] = "no" if "not stacked" in match[2] else "yes"
    return found


def judge_fault(fault: Fault, found: Mapping[str, str], span: range) -> list[str]:
    """How a record differs from what must be in it; span is the function's code."""
    if not found:
        return ["no record was printed"]
    number = {name: int(text, 0) for name, text in found.items() if WORD.match(f"x {text}")}
    status = number.get("cfsr", -1)
    address = number.get("bfar" if fault.exception == BUS else "mmfar", -1)
    wrong = [
        f"{name} is {found.get(name)}, not {want}"
        for name, want in (
            ("fault", "1"), ("exception", str(fault.exception)), ("code", f"0x{fault.code:08x}"),
            ("task", fault.task), ("stacked", "yes" if fault.stacked else "no"),
        )
        if found.get(name) != want
    ]  # fmt: skip
    if status & ~fault.allowed != fault.status:
        wrong.append(f"cfsr is 0x{status:08x}, not 0x{fault.status:08x}")
    if fault.address and status & (MMARVALID | BFARVALID) and address not in fault.address:
        wrong.append(f"the address is 0x{address:08x}, not 0x{fault.address.start:08x}")
    if span and number.get("pc", -1) not in span:
        wrong.append(f"pc is {found.get('pc')}, not in 0x{span.start:08x} to 0x{span.stop:08x}")
    return wrong


def code_of(bench: Bench, image: Image, function: str) -> range:
    """Where a function of an image lies."""
    contents = read_contents(bench.tools, image.elf)
    symbol = contents.symbol(function)
    return range(symbol.address, symbol.address + symbol.size)


def fault_suite(bench: Bench, name: str, kind: str) -> Outcome:
    """Break one thing; look at what was recorded."""
    fault = FAULTS[kind]
    define = f"-DFAULT=fault_{kind}"
    image = bench.builder.link(
        name.replace("/", "-"), [bench.builder.object("tests/target/faults.c", [define])]
    )
    function = fault.function or f"fault_{kind}"
    span = range(0) if function == "-" else code_of(bench, image, function)
    ended = bench.run(image)
    wrong = judge_fault(fault, read_record(ended.output), span)
    if ended.status != SAFE_STATUS or ended.timed_out:
        wrong.insert(0, f"{ended.how}, not {SAFE_STATUS}")
    if ended.output.count("breaking\n") != 1:
        wrong.append("the program was not started exactly once")
    outcome = Outcome()
    outcome.add(name, f"{name}: {'; '.join(wrong)}\n{ended.evidence}" if wrong else "")
    return outcome


# --- The demo ------------------------------------------------------------------------------------

DEMO_US = 10_000_000
DEMO_LINE = re.compile(
    r"^task (.+): period (\d+) runs (\d+) longest (\d+) skipped (\d+) overruns (\d+) "
    r"promotions (\d+)$",
    re.MULTILINE,
)
# In ten seconds 5000 votes and steps; the unit that froze is latched in all six channels. The voted
# values stay within the units' own spread (0.02) and what one faulty unit may move them, half of
# a = 0.1 (VOT-015).
FLIGHT_LINE = re.compile(
    r"^flight votes 5000 steps 5000 refused 0 worst (\d+) used 63 latched 0 used 63 latched 0 "
    r"used 0 latched 63$",
    re.MULTILINE,
)
WORST_MILLIONTHS = 70_000
TASK_SET = "specs/tasksets/urpilot.toml"


def demo_periods(text: str) -> dict[str, int]:
    """The tasks of table 2 with their periods in us, from the task set."""
    return {task["name"]: task["period_us"] for task in tomllib.loads(text)["task"]}


def judge_demo(periods: Mapping[str, int], output: str) -> list[str]:
    """What is not as the periods ask."""
    wrong = []
    lines = {match[1]: [int(word) for word in match.groups()[1:]] for match in
             DEMO_LINE.finditer(output)}  # fmt: skip
    for name in periods.keys() ^ lines.keys():
        wrong.append(f"{name}: is only in the {'table' if name in periods else 'output'}")
    for name, (period, runs, _, skipped, overruns, promotions) in lines.items():
        wanted = DEMO_US // periods.get(name, DEMO_US)
        if (period, runs) != (periods.get(name), wanted):
            wrong.append(f"{name}: period {period}, {runs} runs, not {wanted}")
        if skipped or overruns or promotions:
            wrong.append(f"{name}: skipped {skipped}, overruns {overruns}, promoted {promotions}")
    flight = FLIGHT_LINE.search(output)
    if not flight or int(flight[1]) > WORST_MILLIONTHS:
        told = re.search(r"^flight .*$", output, re.MULTILINE)
        wrong.append(f"votes and control: {told[0] if told else 'nothing was told'}")
    if "\ndemo ended\n" not in output:
        wrong.append("it did not come to its end")
    return wrong


def demo_suite(bench: Bench, name: str) -> Outcome:
    """The board's own application, for ten simulated seconds."""
    image = bench.builder.link("demo", bench.builder.objects(bench.board.application))
    examine(bench.builder, image)
    bench.demo_sha256 = sha256(image.elf.read_bytes()).hexdigest()
    periods = demo_periods((bench.root / TASK_SET).read_text(encoding="utf-8"))
    ended = bench.run(image, LONG_TIMEOUT_S)
    wrong = judge_demo(periods, ended.output)
    if len(periods) != 21:
        wrong.append(f"table 2 has {len(periods)} tasks")
    if ended.status != 0 or ended.timed_out:
        wrong.insert(0, ended.how)
    outcome = Outcome()
    outcome.add(name, f"{name}: {'; '.join(wrong)}\n{ended.evidence}" if wrong else "")
    return outcome


# --- The same results as on the host -------------------------------------------------------------

DRIVER = "tests/target/differential.c"
UNITS = ("queue", "priority", "voter", "filter", "pid")
VECTORS = 100_000  # of each unit
BLOCKS = 50
HOST_FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-Iinclude", "-Ibsp")
HOST_SOURCES = ("tests/target/host_console.c", "bsp/console.c")
BLOCK = re.compile(r"^(\w+) block (\d+) (0x\w+)$", re.MULTILINE)
VECTOR = re.compile(r"^\w+ vector (\d+) (0x\w+)$", re.MULTILINE)


def digests(output: str) -> dict[tuple[str, int], str]:
    """The digests of the blocks."""
    return {(unit, int(block)): text for unit, block, text in BLOCK.findall(output)}


def first_difference(host: Mapping[tuple[str, int], str], target: Mapping[tuple[str, int], str],
                     unit: str) -> int | None:  # fmt: skip
    """The first block of a unit in which the two differ; one that is missing differs."""
    for block in range(BLOCKS):
        ours = host.get((unit, block))
        if ours is None or ours != target.get((unit, block)):
            return block
    return None


def run_host(bench: Bench, defines: Sequence[str] = ()) -> str:
    """What the driver prints on this host."""
    program = bench.root / BUILD / "differential-host"
    sources = [*source_files(["src"], bench.root), DRIVER, *HOST_SOURCES]
    gcc = bench.tools.command("gcc")
    output_of([*gcc, *HOST_FLAGS, *defines, *sources, "-o", str(program)], cwd=bench.root)
    ended = run([program], LONG_TIMEOUT_S)
    if ended.status != 0:
        raise TargetError(f"the host's build of {DRIVER}: {ended.how}")
    return ended.output


def run_target(bench: Bench, defines: Sequence[str] = ()) -> Ended:
    """What the driver prints on the target."""
    name = "differential-detail" if defines else "differential"
    image = bench.builder.link(name, [bench.builder.object(DRIVER, defines)])
    return bench.run(image, LONG_TIMEOUT_S)


def differing_vector(bench: Bench, unit: str, block: int) -> str:
    """The first vector of a block on which the two differ, with both digests."""
    defines = [f"-DDETAIL_UNIT={UNITS.index(unit)}u", f"-DDETAIL_BLOCK={block}u"]
    host = VECTOR.findall(run_host(bench, defines))
    target = VECTOR.findall(run_target(bench, defines).output)
    for ours, theirs in zip(host, target, strict=False):
        if ours != theirs:
            return f"vector {ours[0]}: the host has {ours[1]}, the target {theirs[1]}"
    return f"block {block}: the target printed {len(target)} vectors, the host {len(host)}"


def differential_suite(bench: Bench, name: str) -> Outcome:
    """All units, each a test of its own."""
    host = digests(run_host(bench))
    ended = run_target(bench)
    target = digests(ended.output)
    outcome = Outcome()
    for unit in UNITS:
        block = first_difference(host, target, unit)
        what = "" if block is None else differing_vector(bench, unit, block)
        outcome.add(f"{name}/{unit}", f"{name}/{unit}: {what}" if what else "")
    counted = f"all vectors {len(UNITS) * VECTORS} " in ended.output
    if ended.status != 0 or ended.timed_out or not counted:
        outcome.add(name, f"{name}: {ended.how}\n{ended.evidence}")
    return outcome


# --- All of them ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Suite:
    """A named set of tests."""

    name: str
    run: Callable[[Bench], Outcome]


def all_suites(root: Path = ROOT) -> list[Suite]:
    """Every suite, the fastest first."""
    suites = []
    files = [*sorted((root / "tests/unit").glob("test_*.c")), root / "tests/target/test_core.c"]
    for path in files:
        name, source = f"unit/{path.stem.removeprefix('test_')}", str(path.relative_to(root))
        suites.append(Suite(name, partial(unit_suite, name=name, source=source)))
    for kind in FAULTS:
        name = f"fault/{kind}"
        suites.append(Suite(name, partial(fault_suite, name=name, kind=kind)))
    suites.append(Suite("differential", partial(differential_suite, name="differential")))
    suites.append(Suite("demo", partial(demo_suite, name="demo")))
    return suites


def run_suite(bench: Bench, suite: Suite) -> Outcome:
    """Run one suite; whatever keeps it from running is its failure."""
    began = time.monotonic()
    try:
        outcome = suite.run(bench)
    except (ToolError, TargetError, ToolchainError, OSError) as error:
        outcome = Outcome()
        outcome.add(suite.name, f"{suite.name}: {error}")
    if not outcome.passed and not outcome.failures:
        outcome.add(suite.name, f"{suite.name}: no test was run")
    outcome.seconds = time.monotonic() - began
    return outcome


def write_report(bench: Bench, outcomes: Mapping[str, Outcome], chosen: str) -> tuple[int, int]:
    """Write the report in one go, and give the totals."""
    passed = sum(outcome.passed for outcome in outcomes.values())
    failed = sum(len(outcome.failures) for outcome in outcomes.values())
    versions = {name: item.version for name, item in bench.tools.versions("target").items()}
    report = {
        "schema": 1,
        "passed": passed,
        "failed": failed,
        "filter": chosen,
        "board": BOARD,
        "tools": versions,
        "flags": bench.builder.flags,
        "nanoseconds_per_instruction": 1 << SHIFT,
        "vectors_per_unit": VECTORS,
        "painted_stack": {
            "size": bench.stack_size,
            "used": bench.stacks,
            "demo_sha256": bench.demo_sha256,
        },
        "suites": {name: outcome.as_dict() for name, outcome in outcomes.items()},
    }
    write_atomically(bench.root / REPORT, json.dumps(report, indent=1) + "\n")
    return passed, failed


def print_stacks(bench: Bench) -> None:
    """The deepest stacks."""
    if bench.stacks:
        deepest = max(bench.stacks, key=lambda name: bench.stacks[name])
        main = f", the demo's main {bench.stacks['demo']}" if "demo" in bench.stacks else ""
        print(f"painted stack of {bench.stack_size} bytes: at most {bench.stacks[deepest]} used "
              f"({deepest}){main}")  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Run Keel's tests on an emulated Cortex-M7.")
    parser.add_argument("--filter", default="", metavar="TEXT", help="suites whose name has this")
    options = parser.parse_args(arguments)
    (ROOT / REPORT).unlink(missing_ok=True)
    try:
        tools = Toolchain()
        tools.ensure("target")
        bench = Bench(tools)
    except (ToolError, ToolchainError, OSError) as error:
        print(f"test-target: {error}", file=sys.stderr)
        return 1
    outcomes: dict[str, Outcome] = {}
    for suite in all_suites():
        if options.filter in suite.name:
            outcomes[suite.name] = run_suite(bench, suite)
            tell(suite.name, outcomes[suite.name])
    passed, failed = write_report(bench, outcomes, options.filter)
    if not outcomes:
        print(f"test-target: no suite's name contains {options.filter!r}", file=sys.stderr)
    print_stacks(bench)
    print(f"{passed} passed, {failed} failed")
    return 0 if passed > 0 and failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
