#!/usr/bin/env python3
"""Measure what Keel costs: instructions per pass and per step, code size, RAM.

    python3 tools/bench.py            # measure, print tables, write build/bench/report.json
    python3 tools/bench.py --check    # the same; exit status 1 when a goal is missed
    python3 tools/bench.py --accept   # the same; what the Cortex-M7 takes becomes its budget

Instructions are counted by valgrind's callgrind in a host build (gcc -O2), which repeats to the
instruction: everything is measured twice, and two results that differ are an error. A pass is one
call of keel_scheduler_step. Counted are the instructions of the layer's own functions (the symbols
of the objects built from src/rtos); the virtual clock, the bodies of the tasks and the harness
(tests/bench/bench_scheduler.c) are not.

The passes of 100 ms of polling, one every 5 us of virtual time beside what the tasks take, are told
apart: waited (before the wake-up time), idle (no task can run; computes the wake-up time), realtime
and other (exactly one task, of that kind), several (more than one task).

Code size and RAM are those of the Cortex-M7 build.

The steps of the layers above (STEPS, tests/bench/bench_steps.c) are counted the same way. In their
Cortex-M7 objects no function that a step reaches may have an instruction in double precision or
call anything but the kernel: that is an error, not a missed goal.

What the same passes and steps take on the Cortex-M7 is counted on an emulated one, and held against
a budget (tools/bench_target.py).

Exit status: 0 when everything was measured, 1 when something could not be, or is above its budget
(or, with --check, a goal is missed), 2 for a wrong command line.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path

import bench_target
from toolchain import TARGET_FLAGS, Toolchain, ToolchainError, write_atomically

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "bench"
REPORT = BUILD / "report.json"
LAYER = "src/rtos"
HARNESS = ("tests/bench/bench_scheduler.c", "examples/urpilot/urpilot_tasks.c")
INCLUDES = ("-Iinclude", "-Iexamples/urpilot")
HOST_FLAGS = ("-std=c99", "-O2", "-Wall", "-Wextra", "-Werror")
ARM_FLAGS = ("-std=c99", "-O2", *TARGET_FLAGS, "-ffreestanding", "-ffunction-sections")

# The sizes of the task set, each with the queue capacity that it is built with.
SETS = {8: 32, 21: 32, 64: 128, 128: 128}
GOAL_SET = 21

# What a task takes of the scheduler's memory is the difference of these two, the first as shipped.
CAPACITIES = (32, 64)

# Steps by their labels: what they are, the function, and the goal on the Cortex-M7.
STEPS: dict[str, tuple[str, str, int]] = {
    "filter": ("filter", "keel_filter_step", 30),
    "pid": ("PID", "keel_pid_step", 110),
    "imu": ("virtual IMU, 3 x 6, all agree", "keel_virtual_imu_step", 900),
    "imu_worst": ("virtual IMU, 3 x 6, one outvoted", "keel_virtual_imu_step", 900),
}
STEP_HARNESS = "tests/bench/bench_steps.c"

KINDS = ("waited", "idle", "realtime", "other", "several")
NO_TASK = ("waited", "idle")
ONE_TASK = ("realtime", "other")

# Functions whose instructions may be in a dump without being the layer's.
HARNESS_FUNCTION = re.compile(r"^(bench_\w+|main)(\.\w+)*$")

# The same set and the same method with the schedulers that flight firmware flies: instructions
# of a pass that runs no task, and of one that runs one.
FOR_SCALE = {"Cleanflight": (526, 563), "Betaflight": (564, 662)}

TIMEOUT_S = 300


class BenchError(Exception):
    """Something could not be measured; the message says what and why."""


# --- What callgrind wrote ------------------------------------------------------------------------


@dataclass
class Dump:
    """One dump: passes of one kind, and each function's own instructions in them."""

    kind: str
    passes: int
    own: Counter[str] = field(default_factory=Counter)


TRIGGER = re.compile(r"^desc: Trigger: Client Request: keel (\w+) (\d+)$")
COST = re.compile(r"^\d+ (\d+)$")


def read_dumps(lines: Iterable[str]) -> Iterator[Dump]:
    """The labelled dumps of a combined callgrind file without compressed names.

    The line behind a "calls=" line holds the cost of the called function, which is not its
    caller's own.
    """
    dump: Dump | None = None
    function = ""
    called = False
    for line in (line.rstrip("\n") for line in lines):
        if trigger := TRIGGER.match(line):
            dump = Dump(trigger[1], int(trigger[2]))
        elif line.startswith("part:"):
            if dump:
                yield dump
            dump = None
        elif line.startswith("fn="):
            function = line[len("fn=") :]
        elif line.startswith("calls="):
            called = True
        elif cost := COST.match(line):
            if dump and not called:
                dump.own[function] += int(cost[1])
            called = False
    if dump:
        yield dump


@dataclass
class Kind:
    """All passes of one kind. The longest is of those that have a dump of their own."""

    passes: int = 0
    instructions: int = 0
    longest: int = 0
    functions: Counter[str] = field(default_factory=Counter)

    @property
    def mean(self) -> float:
        return self.instructions / self.passes if self.passes else 0.0

    def add(self, other: Kind) -> None:
        self.passes += other.passes
        self.instructions += other.instructions
        self.longest = max(self.longest, other.longest)
        self.functions += other.functions


def kind_of(dump: Dump, layer: frozenset[str]) -> Kind:
    """The layer's part of a dump."""
    own = Counter({name: cost for name, cost in dump.own.items() if name in layer})
    cost = own.total()
    return Kind(dump.passes, cost, cost if dump.passes == 1 else 0, own)


def refuse_strangers(dump: Dump, layer: frozenset[str]) -> None:
    """No instruction may be lost: each belongs to the layer or to the harness."""
    for name, cost in dump.own.items():
        if cost and name not in layer and not HARNESS_FUNCTION.match(name):
            raise BenchError(f"{name} runs within a pass, but is neither the layer's nor ours")


def sum_dumps(
    dumps: Iterable[Dump], layer: frozenset[str], names: Iterable[str] = KINDS
) -> dict[str, Kind]:
    """The passes by kind."""
    kinds = {name: Kind() for name in names}
    for dump in dumps:
        if dump.kind not in kinds:
            raise BenchError(f"the harness names an unknown kind of pass: {dump.kind}")
        if dump.passes:
            refuse_strangers(dump, layer)
            kinds[dump.kind].add(kind_of(dump, layer))
    return kinds


def merged(kinds: Mapping[str, Kind], names: Sequence[str]) -> Kind:
    """Several kinds taken together."""
    total = Kind()
    for name in names:
        total.add(kinds[name])
    return total


# --- Building and running ------------------------------------------------------------------------


def run(command: Sequence[str]) -> str:
    """What a command prints; an error when it fails."""
    try:
        done = subprocess.run(
            command, cwd=ROOT, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
        )
    except subprocess.TimeoutExpired:
        raise BenchError(f"{command[0]} does not end within {TIMEOUT_S} s") from None
    if done.returncode != 0:
        raise BenchError(f"{' '.join(command)}:\n{done.stderr.strip()}")
    return done.stdout


def layer_sources(layer: str = LAYER) -> list[str]:
    """The C files of a layer, or of all below a folder, relative to the root."""
    return sorted(str(path.relative_to(ROOT)) for path in (ROOT / layer).rglob("*.c"))


def compile_layer(
    compiler: Sequence[str], flags: Sequence[str], folder: Path, layer: str = LAYER
) -> list[str]:
    """One object per unit."""
    folder.mkdir(parents=True, exist_ok=True)
    objects = []
    for source in layer_sources(layer):
        target = folder / f"{Path(source).stem}.o"
        run([*compiler, *flags, *INCLUDES, "-c", source, "-o", str(target)])
        objects.append(str(target))
    return objects


def functions_of(nm: Sequence[str], objects: Sequence[str]) -> frozenset[str]:
    """The functions that objects define, static ones included."""
    words = [line.split() for line in run([*nm, *objects]).splitlines()]
    return frozenset(parts[2] for parts in words if len(parts) == 3 and parts[1] in "tT")


@dataclass(frozen=True)
class Host:
    """The host build for one queue capacity."""

    program: Path
    layer: frozenset[str]


def build_host(tools: Toolchain, capacity: int) -> Host:
    folder = BUILD / f"host-{capacity}"
    flags = [*HOST_FLAGS, f"-DKEEL_QUEUE_CAPACITY={capacity}u"]
    gcc = tools.command("gcc")
    objects = compile_layer(gcc, flags, folder)
    program = folder / "bench_scheduler"
    run([*gcc, *flags, *INCLUDES, *objects, *HARNESS, "-o", str(program)])
    return Host(program, functions_of(tools.command("nm"), objects))


def callgrind(
    tools: Toolchain, host: Host, name: str, arguments: Sequence[str], kinds: Iterable[str]
) -> dict[str, Kind]:
    """One run of a program under callgrind."""
    output = BUILD / f"callgrind-{name}.out"
    output.unlink(missing_ok=True)
    options = ["--collect-atstart=no", "--combine-dumps=yes", "--compress-strings=no"]
    options += ["--compress-pos=no", f"--callgrind-out-file={output}"]
    valgrind = [*tools.command("valgrind"), "--tool=callgrind", *options]
    run([*valgrind, str(host.program), *arguments])
    with output.open() as lines:
        return sum_dumps(read_dumps(lines), host.layer, kinds)


def count(tools: Toolchain, host: Host, tasks: int) -> dict[str, Kind]:
    """One simulation under callgrind."""
    return callgrind(tools, host, str(tasks), [str(tasks)], KINDS)


def measure_set(tools: Toolchain, host: Host, tasks: int) -> dict[str, Kind]:
    """Measured twice, to the instruction."""
    first, second = count(tools, host, tasks), count(tools, host, tasks)
    if first != second:
        raise BenchError(f"two runs with {tasks} tasks differ")
    empty = [name for name in NO_TASK if not first[name].passes]
    if empty or not merged(first, ONE_TASK).passes:
        raise BenchError(f"no pass was measured of the kind {', '.join(empty) or 'one task'}")
    return first


# --- The target ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Target:
    """The Cortex-M7 build, in bytes."""

    text: dict[str, int]
    data: dict[str, int]
    sizes: dict[str, int]

    @property
    def total(self) -> int:
        return sum(self.text.values())

    @property
    def per_task(self) -> int:
        return self.sizes["task"]


def read_sizes(text: str) -> dict[str, tuple[int, int]]:
    """Text (constants included) and data per object, from the program size."""
    rows = [line.split() for line in text.splitlines()[1:]]
    return {Path(row[5]).stem: (int(row[0]), int(row[1]) + int(row[2])) for row in rows}


def read_symbols(text: str) -> dict[str, int]:
    """The sizes of the objects of tests/bench/sizes.c, from nm -S."""
    found = re.findall(r"^\w+ (\w+) \w bench_size_(\w+)$", text, re.MULTILINE)
    return {name: int(size, 16) for size, name in found}


def measure_sizes(tools: Toolchain, folder: Path, capacity: int) -> dict[str, int]:
    """The sizes of the objects of tests/bench/sizes.c for one capacity of the queue."""
    probe = str(folder / "sizes.o.probe")
    flags = [*ARM_FLAGS, "-fno-common", f"-DKEEL_QUEUE_CAPACITY={capacity}u"]
    gcc = tools.command("arm-none-eabi-gcc")
    run([*gcc, *flags, *INCLUDES, "-c", "tests/bench/sizes.c", "-o", probe])
    return read_symbols(run([*tools.command("arm-none-eabi-nm"), "-S", probe]))


def size_of_task(less: int, more: int) -> int:
    """What a task takes of a scheduler, from its sizes for both CAPACITIES."""
    size, rest = divmod(more - less, CAPACITIES[1] - CAPACITIES[0])
    if rest or size <= 0:
        raise BenchError(f"a scheduler of {less} bytes does not grow to {more} by whole tasks")
    return size


def measure_target(tools: Toolchain) -> Target:
    folder = BUILD / "target"
    gcc = tools.command("arm-none-eabi-gcc")
    objects = compile_layer(gcc, ARM_FLAGS, folder)
    sizes = read_sizes(run([*tools.command("arm-none-eabi-size"), *objects]))
    symbols = [measure_sizes(tools, folder, capacity) for capacity in CAPACITIES]
    return Target(
        {name: text for name, (text, _) in sizes.items()},
        {name: data for name, (_, data) in sizes.items() if data},
        {**symbols[0], "task": size_of_task(symbols[0]["scheduler"], symbols[1]["scheduler"])},
    )


# --- Steps of the layers above -------------------------------------------------------------------

FUNCTION = re.compile(r"^[0-9a-f]+ <([^>]+)>:$")
CALL = re.compile(r"R_ARM_THM_(?:CALL|JUMP24)\s+(\S+)")
INSTRUCTION = re.compile(r"^\s+[0-9a-f]+:\t")
DOUBLE = re.compile(r"\bv\w+(?:\.\w+)*\.f64\b")


@dataclass
class Code:
    """A function in an object file: what it calls, its instructions, those in double precision."""

    calls: set[str] = field(default_factory=set)
    instructions: int = 0
    doubles: list[str] = field(default_factory=list)


def read_code(listing: str) -> dict[str, Code]:
    """The functions of a disassembly with relocations (objdump -dr)."""
    found: dict[str, Code] = {}
    code = Code()
    for line in listing.splitlines():
        if function := FUNCTION.match(line):
            code = found.setdefault(function[1], Code())
        elif call := CALL.search(line):
            code.calls.add(call[1])
        elif INSTRUCTION.match(line):
            code.instructions += 1
            if DOUBLE.search(line):
                code.doubles.append(" ".join(line.split("\t")[2:]).strip())
    return found


def refuse_slow_code(code: Mapping[str, Code], step: str) -> None:
    """No double precision and no library call in what a step reaches."""
    waiting, seen = [step], set()
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        if name not in code:
            raise BenchError(f"{step} reaches {name}, which is not the kernel's")
        if code[name].doubles:
            first = code[name].doubles[0]
            raise BenchError(f"{step}: {name} computes in double precision: {first}")
        waiting += code[name].calls


def check_target_steps(tools: Toolchain) -> None:
    """The Cortex-M7 objects of the steps."""
    flags = [*ARM_FLAGS, "-Wdouble-promotion", "-Werror"]
    gcc = tools.command("arm-none-eabi-gcc")
    objects = compile_layer(gcc, flags, BUILD / "target-steps", "src")
    dump = [*tools.command("arm-none-eabi-objdump"), "-dr"]
    code = read_code(run([*dump, *objects]))
    for _, step, _ in STEPS.values():
        refuse_slow_code(code, step)


def measure_steps(tools: Toolchain) -> dict[str, Kind]:
    """Instructions of each step in a host build, counted twice."""
    folder = BUILD / "host-steps"
    gcc = tools.command("gcc")
    objects = compile_layer(gcc, HOST_FLAGS, folder, "src")
    program = folder / "bench_steps"
    run([*gcc, *HOST_FLAGS, *INCLUDES, *objects, STEP_HARNESS, "-o", str(program)])
    host = Host(program, functions_of(tools.command("nm"), objects))
    first, second = (callgrind(tools, host, "steps", [], STEPS) for _ in range(2))
    if first != second:
        raise BenchError("two runs of the steps differ")
    for name, kind in first.items():
        if not kind.passes:
            raise BenchError(f"no step of {name} was measured")
    return first


def print_steps(steps: Mapping[str, Kind]) -> None:
    print("\nInstructions of a step, host build    mean   goal on the Cortex-M7")
    for name, kind in steps.items():
        label, _, goal = STEPS[name]
        print(f"  {label:34}{kind.mean:7.1f}{goal:7}")
    print("  On the Cortex-M7 none of them has double precision or calls a library.")


# --- Goals and report ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Goal:
    """What a figure should at most be."""

    name: str
    value: float
    limit: int

    @property
    def met(self) -> bool:
        return self.value <= self.limit


def goals_of(sets: Mapping[int, Mapping[str, Kind]], target: Target) -> list[Goal]:
    kinds = sets[GOAL_SET]
    return [
        Goal("instructions, no task", merged(kinds, NO_TASK).mean, 25),
        Goal(f"instructions, one task of {GOAL_SET}", merged(kinds, ONE_TASK).mean, 200),
        Goal("text in bytes", target.total, 2048),
        Goal("RAM per task in bytes", target.per_task, 40),
    ]


def kind_report(kind: Kind) -> dict[str, object]:
    costs = {name: cost / kind.passes for name, cost in kind.functions.most_common()}
    return {
        "passes": kind.passes,
        "instructions": kind.instructions,
        "mean": round(kind.mean, 2),
        "longest": kind.longest or None,
        "mean_by_function": {name: round(cost, 2) for name, cost in costs.items()},
    }


def set_report(kinds: Mapping[str, Kind]) -> dict[str, object]:
    together = {"no_task": merged(kinds, NO_TASK), "one_task": merged(kinds, ONE_TASK)}
    both = {**kinds, **together}
    return {name: kind_report(kind) for name, kind in both.items() if kind.passes}


def report_of(
    tools: Toolchain, sets: Mapping[int, Mapping[str, Kind]], target: Target,
    steps: Mapping[str, Kind],
) -> dict[str, object]:  # fmt: skip
    versions = {name: found.version for name, found in tools.versions("bench", "test").items()}
    used = ("gcc", "valgrind", "binutils", "arm-none-eabi-gcc")
    return {
        "schema": 1,
        "tools": {name: versions[name] for name in used if name in versions},
        "host_flags": list(HOST_FLAGS),
        "target_flags": list(ARM_FLAGS),
        "capacity": {str(tasks): SETS[tasks] for tasks in sets},
        "sets": {str(tasks): set_report(kinds) for tasks, kinds in sets.items()},
        "steps": {name: kind_report(kind) for name, kind in steps.items()},
        "for_scale": {name: list(pair) for name, pair in FOR_SCALE.items()},
        "target": {**asdict(target), "total_text": target.total, "per_task": target.per_task},
        "goals": [{**asdict(goal), "met": goal.met} for goal in goals_of(sets, target)],
    }


# --- Tables --------------------------------------------------------------------------------------


def row(label: str, kind: Kind, indent: str = "  ") -> str:
    longest = f"{kind.longest:9}" if kind.longest else ""
    return f"{indent}{label:28}{kind.passes:8}{kind.mean:10.1f}{longest}"


def print_set(tasks: int, kinds: Mapping[str, Kind]) -> None:
    print(f"\n{tasks} tasks (queue of {SETS[tasks]})          passes      mean  longest")
    print(row("no task", merged(kinds, NO_TASK)))
    print(row("waiting", kinds["waited"], "    "))
    print(row("first after work, wake-up", kinds["idle"], "    "))
    print(row("one task", merged(kinds, ONE_TASK)))
    for label, name in (("real-time", "realtime"), ("other", "other")):
        if kinds[name].passes:
            print(row(label, kinds[name], "    "))
    print(row("several tasks", kinds["several"]))


def print_scale() -> None:
    print("\nFor scale (measured before, same set, same method)    no task  one task")
    for name, (none, one) in FOR_SCALE.items():
        print(f"  {name:50}{none:8}{one:10}")


def print_hot(kinds: Mapping[str, Kind]) -> None:
    print(f"\nInstructions by function, mean per pass, {GOAL_SET} tasks")
    for label, names in (("no task", NO_TASK), ("one task", ONE_TASK)):
        kind = merged(kinds, names)
        parts = [f"{name} {cost / kind.passes:.1f}" for name, cost in kind.functions.most_common()]
        print(f"  {label}: {', '.join(parts)}")


def print_target(target: Target) -> None:
    print("\nCortex-M7, bytes of text")
    for name, size in target.text.items():
        print(f"  {name:28}{size:8}")
    print(f"  {'sum':28}{target.total:8}")
    print(f"Writable data of the layer: {sum(target.data.values())} bytes")
    sizes = target.sizes
    print(f"RAM per task: {target.per_task} bytes; its declaration, which may be constant, takes "
          f"{sizes['config']}")
    print(f"The scheduler, its queue of {CAPACITIES[0]} included: {sizes['scheduler']} bytes")


def print_goals(goals: Sequence[Goal]) -> None:
    print("\nGoals                                value     limit")
    for goal in goals:
        met = "met" if goal.met else "MISSED"
        print(f"  {goal.name:30}{goal.value:10.1f}{goal.limit:10}  {met}")


def verdict(goals: Sequence[Goal]) -> str:
    missed = [f"{goal.name} {goal.value:.1f} > {goal.limit}" for goal in goals if not goal.met]
    if not missed:
        return f"bench: all {len(goals)} goals met, two runs equal to the instruction."
    return f"bench: {len(missed)} of {len(goals)} goals missed: {'; '.join(missed)}."


def measure(tools: Toolchain) -> list[Goal]:
    """Measure, report, print."""
    hosts = {capacity: build_host(tools, capacity) for capacity in sorted(set(SETS.values()))}
    sets = {tasks: measure_set(tools, hosts[SETS[tasks]], tasks) for tasks in SETS}
    target = measure_target(tools)
    check_target_steps(tools)
    steps = measure_steps(tools)
    goals = goals_of(sets, target)
    write_atomically(REPORT, json.dumps(report_of(tools, sets, target, steps), indent=1) + "\n")
    print("Instructions of a pass, host build, scheduler code only")
    for tasks, kinds in sets.items():
        print_set(tasks, kinds)
    print_scale()
    print_hot(sets[GOAL_SET])
    print_target(target)
    print_steps(steps)
    print_goals(goals)
    return goals


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description="Measure what Keel costs.")
    parser.add_argument("--check", action="store_true", help="fail when a goal is missed")
    parser.add_argument("--accept", action="store_true", help="make what is measured the budget")
    options = parser.parse_args(arguments)
    try:
        tools = Toolchain()
        tools.ensure("bench")
        goals = measure(tools)
        over = bench_target.add(tools, REPORT, options.accept)
    except (BenchError, bench_target.BenchTargetError, ToolchainError) as error:
        print(f"bench: {error}", file=sys.stderr)
        return 1
    if over:
        print(f"bench: over the budget of tests/bench/budget.toml: {'; '.join(over)}.")
        return 1
    print(verdict(goals))
    return 1 if options.check and not all(goal.met for goal in goals) else 0


if __name__ == "__main__":
    sys.exit(main())
