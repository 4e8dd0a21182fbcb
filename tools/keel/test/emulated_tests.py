# SPDX-License-Identifier: Apache-2.0
"""Run Keel's tests on a Cortex-M7 that QEMU emulates.

    python3 tools/keel test-target                   # everything
    python3 tools/keel test-target --filter fault/   # the suites whose name contains this
    python3 tools/keel test-target --jobs 1          # one after another, not one on each core

Suites, each one image or more of the board mps2_an500, built as its firmware is:

    unit/<unit>          the unit tests of tests/unit, and tests/target/test_core.c
    fault/<kind>         tests/target/faults.c: the fault is recorded as the processor's manual
                         says, and the board comes back in its safe state
    demo                 the firmware with the 21 tasks of table 2, ten seconds of simulated
                         time: each task has run once for each of its periods, in time; the
                         inertial unit that froze is latched, and hardly moved the voted values
    copter               the copter on a desk, ten seconds: the same of its tasks, and it flies
    radio                tests/target/radio.c: with each receiver, and with noise, no run of
                         background radio is over its budget, and no frame is lost
    differential/<unit>  tests/target/differential.c: 10^5 random vectors of each unit give the same
                         bits on the target as the executable specification (specs/model) does,
                         built for the host

The emulator counts instructions, four nanoseconds each, so that every run is the same. A program
that hangs is killed and counts as failed. Each image tells how deep its stack was: the painted
stack. build/test-target/report.json has it all; an unfinished run leaves none.

Exit status: 0 when at least one test ran and none failed, 1 otherwise, 2 for a wrong command line.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial

from keel.base.arguments import Parser
from keel.base.build import Build
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import read_text, sha256_of
from keel.base.jobs import end_as_by_ctrl_c
from keel.base.run import Ended, run
from keel.boards.elf import read_contents
from keel.boards.firmware import Image, examine
from keel.install import Toolchain
from keel.test import suites as running
from keel.test.emulated import BOARD, BUILD, SHIFT, EmulatedBoard
from keel.test.faults import FAULTS, SAFE_STATUS, judge_fault, read_record
from keel.test.outcomes import Outcome, unity_outcome
from keel.test.suites import Suite

LONG_TIMEOUT_S = 900.0


def unit_image(board: EmulatedBoard, name: str, source: str) -> Image:
    """The image of one file of unit tests."""
    test = board.builder.object(source, [*board.unity_flags(), "-w"])
    return board.builder.link(name.replace("/", "-"), [board.unity(), test])


def unit_suite(board: EmulatedBoard, name: str, source: str) -> Outcome:
    """The tests of one file."""
    return unity_outcome(name, board.run(unit_image(board, name, source)))


def code_of(board: EmulatedBoard, image: Image, function: str) -> range:
    """Where a function of an image lies."""
    contents = read_contents(board.tools, image.elf)
    symbol = contents.symbol(function)
    return range(symbol.address, symbol.address + symbol.size)


def fault_suite(board: EmulatedBoard, name: str, kind: str) -> Outcome:
    """Break one thing; look at what was recorded."""
    fault = FAULTS[kind]
    define = f"-DFAULT=fault_{kind}"
    image = board.builder.link(
        name.replace("/", "-"), [board.builder.object("tests/target/faults.c", [define])]
    )
    function = fault.function or f"fault_{kind}"
    span = range(0) if function == "-" else code_of(board, image, function)
    ended = board.run(image)
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


# A copter that lies on a desk, level: it has been armed, flies by position, and all motors turn.
COPTER = ("examples/copter", "examples/copter_on_target", "examples/urpilot/urpilot_tasks.c")
COPTER_LINE = re.compile(
    r"^copter state 2 mode 4 phase 2 level 1 load \d+ motor (\d+) motor (\d+) motor (\d+) "
    r"motor (\d+)$",
    re.MULTILINE,
)
IDLE_MILLIONTHS = 50_000  # What an armed motor gets at least: examples/copter/settings.c.


def judge_tasks(periods: Mapping[str, int], output: str) -> list[str]:
    """What is not as the periods ask."""
    wrong = []
    lines = {
        match[1]: [int(word) for word in match.groups()[1:]] for match in DEMO_LINE.finditer(output)
    }
    for name in periods.keys() ^ lines.keys():
        wrong.append(f"{name}: is only in the {'table' if name in periods else 'output'}")
    for name, (period, runs, _, skipped, overruns, promotions) in lines.items():
        wanted = DEMO_US // periods.get(name, DEMO_US)
        if (period, runs) != (periods.get(name), wanted):
            wrong.append(f"{name}: period {period}, {runs} runs, not {wanted}")
        if skipped or overruns or promotions:
            wrong.append(f"{name}: skipped {skipped}, overruns {overruns}, promoted {promotions}")
    if "\ndemo ended\n" not in output:
        wrong.append("it did not come to its end")
    return wrong


# Of the streams of tests/target/radio.c, by hand: the protocol that is heard at the end; the run,
# each 10 ms later, in which it is known (SBUS's 20th frame begins at 19 times 6 ms; of 500 frames
# of CRSF a second the fifth has come at 10 ms, but one run does not get to it; IBUS's fifth begins
# at 28 ms; of PPM the eighth train ends at 160 ms); and how many frames come before that one.
RADIOS = {
    "SBUS": (1, 12, 19),
    "CRSF": (2, 2, 4),
    "IBUS": (3, 4, 4),
    "PPM": (4, 16, 7),
    "noise": (0, 0, 0),
    "noise of CRSF": (2, 1, 0),
    "noise of SBUS": (1, 1, 0),
}
RADIO_LINE = re.compile(
    r"^radio (.+): protocol (\d+) found (\d+) sent (\d+) frames (\d+) longest (\d+) "
    r"behind (\d+)$",
    re.MULTILINE,
)
RADIO_BUDGET = re.compile(r"^#define COPTER_RADIO_WCET_US +(\d+)u", re.MULTILINE)
RADIO_SOURCES = ("examples/copter", "examples/urpilot/urpilot_tasks.c")


def judge_radio(budget_us: int, output: str) -> list[str]:
    """What is not as it should be of background radio: no run is over its budget, noise or not, and
    no frame is lost once the protocol is known."""
    lines = RADIO_LINE.findall(output)
    wrong = [] if [line[0] for line in lines] == list(RADIOS) else ["not each stream was told of"]
    for name, *words in lines:
        protocol, found, sent, frames, longest, behind = map(int, words)
        if (protocol, found) != RADIOS[name][:2]:
            wrong.append(f"{name}: protocol {protocol}, known in run {found}")
        if longest > budget_us:
            wrong.append(f"{name}: a run of {longest} us, over {budget_us}")
        if "noise" in name:
            wrong += [f"{name}: {frames} frames"] * (frames > 0)
        elif frames != sent - RADIOS[name][2] or behind >= 10:
            wrong.append(f"{name}: {frames} frames of {sent}, and {behind} ms behind")
    return wrong


def told(label: str, output: str) -> str:
    """The line with a label."""
    line = re.search(rf"^{label} .*$", output, re.MULTILINE)
    return line[0] if line else "nothing was told"


def judge_demo(periods: Mapping[str, int], output: str) -> list[str]:
    """What is not as it should be of the board's own application."""
    wrong = judge_tasks(periods, output)
    flight = FLIGHT_LINE.search(output)
    if not flight or int(flight[1]) > WORST_MILLIONTHS:
        wrong.append(f"votes and control: {told('flight', output)}")
    return wrong


def judge_copter(periods: Mapping[str, int], output: str) -> list[str]:
    """What is not as it should be of the copter on its desk."""
    wrong = judge_tasks(periods, output)
    copter = COPTER_LINE.search(output)
    if not copter or min(map(int, copter.groups())) <= IDLE_MILLIONTHS:
        wrong.append(f"the copter: {told('copter', output)}")
    return wrong


def application_suite(
    board: EmulatedBoard,
    image: Image,
    name: str,
    judge: Callable[[Mapping[str, int], str], list[str]],
) -> Outcome:
    """An application with the 21 tasks, for ten simulated seconds."""
    periods = demo_periods((board.root / TASK_SET).read_text(encoding="utf-8"))
    ended = board.run(image, LONG_TIMEOUT_S)
    wrong = judge(periods, ended.output)
    if len(periods) != 21:
        wrong.append(f"table 2 has {len(periods)} tasks")
    if ended.status != 0 or ended.timed_out:
        wrong.insert(0, ended.how)
    outcome = Outcome()
    outcome.add(name, f"{name}: {'; '.join(wrong)}\n{ended.evidence}" if wrong else "")
    return outcome


def demo_suite(board: EmulatedBoard, name: str) -> Outcome:
    """The board's own application."""
    image = board.builder.link("demo", board.builder.objects(board.board.application))
    examine(board.builder, image)
    board.demo_sha256 = sha256_of(image.elf)
    return application_suite(board, image, name, judge_demo)


def copter_suite(board: EmulatedBoard, name: str) -> Outcome:
    """The copter, on a desk."""
    image = board.builder.link("copter", board.builder.objects(COPTER))
    return application_suite(board, image, name, judge_copter)


def radio_suite(board: EmulatedBoard, name: str) -> Outcome:
    """Background radio alone, with each receiver."""
    header = (board.root / "examples/copter/copter.h").read_text(encoding="utf-8")
    budget = RADIO_BUDGET.search(header)
    objects = [*board.builder.objects(RADIO_SOURCES), board.builder.object("tests/target/radio.c")]
    ended = board.run(board.builder.link("radio", objects))
    wrong = judge_radio(int(budget[1]) if budget else 0, ended.output)
    if ended.status != 0 or ended.timed_out:
        wrong.insert(0, ended.how)
    outcome = Outcome()
    outcome.add(name, f"{name}: {'; '.join(wrong)}\n{ended.evidence}" if wrong else "")
    return outcome


# --- The same results as the executable specification --------------------------------------------

DRIVER = "tests/target/differential.c"
UNIT = re.compile(r'\{"(\w+)", vector_\w+\}')  # In the driver's table.
VECTORS = 100_000  # of each unit
BLOCKS = 50
HOST_FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-Iinclude", "-Ibsp")
# The model of MAVLink takes its check from the kernel, as both are proved to use it alike.
HOST_SOURCES = ("tests/target/host_console.c", "bsp/console.c", "src/middleware/crc.c")
MODELS = "specs/model"
BLOCK = re.compile(r"^(\w+) block (\d+) (0x\w+)$", re.MULTILINE)
VECTOR = re.compile(r"^\w+ vector (\d+) (0x\w+)$", re.MULTILINE)


def units_of(board: EmulatedBoard) -> list[str]:
    """The units of the driver's table, by their numbers."""
    return UNIT.findall(read_text(board.root / DRIVER))


def digests(output: str) -> dict[tuple[str, int], str]:
    """The digests of the blocks."""
    return {(unit, int(block)): text for unit, block, text in BLOCK.findall(output)}


def first_difference(
    model: Mapping[tuple[str, int], str], target: Mapping[tuple[str, int], str], unit: str
) -> int | None:
    """The first block of a unit in which the two differ; one that is missing differs."""
    for block in range(BLOCKS):
        ours = model.get((unit, block))
        if ours is None or ours != target.get((unit, block)):
            return block
    return None


def run_model(board: EmulatedBoard, defines: Sequence[str] = ()) -> str:
    """What the driver prints on this host when it calls the model of each function instead: the
    kernel itself is not linked, but for its checks of bytes."""
    folder = board.root / board.folder / "host"
    build = Build(board.tools, "gcc", [*HOST_FLAGS, *defines], folder, board.root)
    call = re.compile(rf"\bkeel_((?:{'|'.join(units_of(board))})_\w+)\(")
    called = sorted(set(call.findall(read_text(board.root / DRIVER))))
    driver = build.object(DRIVER, [f"-Dkeel_{name}=model_{name}" for name in called])
    program = build.link("differential", [*build.objects([MODELS, *HOST_SOURCES]), driver], ["-lm"])
    ended = run([program], LONG_TIMEOUT_S)
    if not ended.good:
        raise ToolError(f"the host's build of {DRIVER}: {ended.how}")
    return ended.output


def run_target(board: EmulatedBoard, defines: Sequence[str] = ()) -> Ended:
    """What the driver prints on the target."""
    name = "differential-detail" if defines else "differential"
    image = board.builder.link(name, [board.builder.object(DRIVER, defines)])
    return board.run(image, LONG_TIMEOUT_S)


def differing_vector(board: EmulatedBoard, unit: str, block: int) -> str:
    """The first vector of a block on which the two differ, with both digests."""
    defines = [f"-DDETAIL_UNIT={units_of(board).index(unit)}u", f"-DDETAIL_BLOCK={block}u"]
    model = VECTOR.findall(run_model(board, defines))
    target = VECTOR.findall(run_target(board, defines).output)
    for ours, theirs in zip(model, target, strict=False):
        if ours != theirs:
            return f"vector {ours[0]}: the model has {ours[1]}, the target {theirs[1]}"
    return f"block {block}: the target printed {len(target)} vectors, the model {len(model)}"


def differential_suite(board: EmulatedBoard, name: str) -> Outcome:
    """All units, each a test of its own."""
    model = digests(run_model(board))
    ended = run_target(board)
    target = digests(ended.output)
    outcome = Outcome()
    units = units_of(board)
    for unit in units:
        block = first_difference(model, target, unit)
        what = "" if block is None else differing_vector(board, unit, block)
        outcome.add(f"{name}/{unit}", f"{name}/{unit}: {what}" if what else "")
    counted = f"all vectors {len(units) * VECTORS} " in ended.output
    if ended.status != 0 or ended.timed_out or not counted:
        outcome.add(name, f"{name}: {ended.how}\n{ended.evidence}")
    return outcome


# --- All of them ---------------------------------------------------------------------------------

# In seconds, alone: applications, and tests of many random steps; of the others none takes two.
# They begin, so that none is left at the end.
LONG_S = {"demo": 40.0, "copter": 20.0, "differential": 20.0}
MANY_STEPS, MANY_STEPS_S = ("specified", "_motion"), 10.0


def seconds_of(name: str) -> float:
    """How long a suite takes."""
    return LONG_S.get(name, MANY_STEPS_S if name.endswith(MANY_STEPS) else 0.0)


def all_suites(board: EmulatedBoard) -> list[Suite]:
    """Every suite, in the order of the reports."""
    suites = []
    files = [*sorted((ROOT / "tests/unit").glob("test_*.c")), ROOT / "tests/target/test_core.c"]
    for path in files:
        name, source = f"unit/{path.stem.removeprefix('test_')}", path.relative_to(ROOT).as_posix()
        suites.append(Suite(name, (), partial(unit_suite, board, name, source)))
    for kind in FAULTS:
        name = f"fault/{kind}"
        suites.append(Suite(name, (), partial(fault_suite, board, name, kind)))
    suites.append(Suite("differential", (), partial(differential_suite, board, "differential")))
    suites.append(Suite("demo", (), partial(demo_suite, board, "demo")))
    suites.append(Suite("copter", (), partial(copter_suite, board, "copter")))
    suites.append(Suite("radio", (), partial(radio_suite, board, "radio")))
    return [replace(suite, seconds=seconds_of(suite.name)) for suite in suites]


def facts_of(board: EmulatedBoard, words: str) -> dict[str, object]:
    """What the report has beside the suites."""
    versions = {name: item.version for name, item in board.tools.versions("target").items()}
    return {
        "schema": 1,
        "filter": words,
        "board": BOARD,
        "tools": versions,
        "flags": board.builder.flags,
        "nanoseconds_per_instruction": 1 << SHIFT,
        "vectors_per_unit": VECTORS,
        "painted_stack": {
            "size": board.stack_size,
            "used": dict(sorted(board.stacks.items())),
            "demo_sha256": board.demo_sha256,
        },
    }


def print_stacks(board: EmulatedBoard) -> None:
    """The deepest stacks."""
    if board.stacks:
        deepest = max(sorted(board.stacks), key=lambda name: board.stacks[name])
        main = f", the demo's main {board.stacks['demo']}" if "demo" in board.stacks else ""
        print(
            f"painted stack of {board.stack_size} bytes: at most {board.stacks[deepest]} used "
            f"({deepest}){main}"
        )


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    end_as_by_ctrl_c()
    parser = Parser("Run Keel's tests on an emulated Cortex-M7.", "test-target")
    running.add_options(parser)
    options = running.parse(parser, arguments)

    def work() -> int:
        running.begin(ROOT / BUILD)
        tools = Toolchain()
        tools.ensure("target")
        board = EmulatedBoard(tools)
        suites = running.chosen(all_suites(board), options.filter)
        outcomes = running.run_all(tools, suites, options.jobs)
        print_stacks(board)
        return running.end(
            ROOT / BUILD, "Keel, emulated", outcomes, facts_of(board, options.filter)
        )

    return program("test-target", work)
