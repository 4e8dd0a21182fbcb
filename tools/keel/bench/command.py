# SPDX-License-Identifier: Apache-2.0
"""Measure what Keel costs: instructions per pass and per step, code size, RAM.

    python3 tools/keel bench            # measure, print tables, write build/bench/report.json
    python3 tools/keel bench --check    # the same; exit status 1 when a goal is missed
    python3 tools/keel bench --accept   # the same; what the Cortex-M7 takes becomes its budget

Instructions are counted by valgrind's callgrind in a host build (gcc -O2), which repeats to the
instruction: everything is measured twice, and two results that differ are an error. A pass is one
call of keel_scheduler_step. Counted are the instructions of the layer's own functions (the symbols
of the objects built from src/rtos); the virtual clock, the bodies of the tasks and the harness
(bench/bench_scheduler.c) are not.

The passes of 100 ms of polling, one every 5 us of virtual time beside what the tasks take, are told
apart: waited (before the wake-up time), idle (no task can run; computes the wake-up time), realtime
and other (exactly one task, of that kind), several (more than one task).

Code size and RAM are those of the Cortex-M7 build.

The steps of the layers above (bench/bench_steps.c) are counted the same way. In their Cortex-M7
objects no function that a step reaches may have an instruction in double precision or call anything
but the kernel: that is an error, not a missed goal.

What the same passes and steps take on the Cortex-M7 is counted on an emulated one, and held against
a budget. bench/budget.toml says which figures there are, with their goals and budgets.

Exit status: 0 when everything was measured, 1 when something is above its budget (or, with --check,
a goal is missed), 2 when something could not be measured.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.build import Build
from keel.base.errors import ROOT, ToolError, program
from keel.base.run import output_of
from keel.base.source import write_report
from keel.bench import emulated, tables
from keel.bench.assembly import read_code, refuse_slow_code
from keel.bench.budget import Budget, accept, read_budget
from keel.bench.callgrind import read_dumps, sum_dumps
from keel.bench.kinds import KINDS, NO_TASK, ONE_TASK, Kind, Kinds, all_of, merged, twice
from keel.bench.tables import FOR_SCALE, Goal, Target, verdict
from keel.install import TARGET_FLAGS, Toolchain

BUILD = ROOT / "build" / "bench"
REPORT = BUILD / "report.json"
LAYER = "src/rtos"
HARNESS = ("bench/bench_scheduler.c", "examples/urpilot/urpilot_tasks.c")
INCLUDES = ("-Iinclude", "-Iexamples/urpilot")
HOST_FLAGS = ("-std=c99", "-O2", "-Wall", "-Wextra", "-Werror")
ARM_FLAGS = ("-std=c99", "-O2", *TARGET_FLAGS, "-ffreestanding", "-ffunction-sections")

# The sizes of the task set, each with the queue capacity that it is built with.
SETS = {8: 32, 21: 32, 64: 128, 128: 128}
GOAL_SET = 21

# What a task takes of the scheduler's memory is the difference of these two, the first as shipped.
CAPACITIES = (32, 64)

STEP_HARNESS = "bench/bench_steps.c"


@dataclass(frozen=True)
class Host:
    """A program of the host build, and the functions of the layer in it."""

    program: Path
    layer: frozenset[str]


@dataclass(frozen=True)
class Measured:
    """What the host has counted, and what the Cortex-M7's objects have."""

    sets: dict[int, Kinds]
    target: Target
    steps: Kinds
    goals: list[Goal]


def functions_of(nm: Sequence[str], objects: Sequence[Path]) -> frozenset[str]:
    """The functions that objects define, static ones included."""
    words = [line.split() for line in output_of([*nm, *map(str, objects)]).splitlines()]
    return frozenset(parts[2] for parts in words if len(parts) == 3 and parts[1] in "tT")


def build_host(
    tools: Toolchain, name: str, layer: str, harness: Sequence[str], extra: Sequence[str] = ()
) -> Host:
    """A layer with a harness that calls it."""
    build = Build(tools, "gcc", [*HOST_FLAGS, *INCLUDES, *extra], BUILD / name)
    objects = build.objects([layer])
    program = build.link("bench", [*objects, *build.objects(harness)])
    return Host(program, functions_of(tools.command("nm"), objects))


def callgrind(
    tools: Toolchain, host: Host, name: str, arguments: Sequence[str], kinds: Iterable[str]
) -> Kinds:
    """One run of a program under callgrind."""
    output = BUILD / f"callgrind-{name}.out"
    output.unlink(missing_ok=True)
    options = ["--collect-atstart=no", "--combine-dumps=yes", "--compress-strings=no"]
    options += ["--compress-pos=no", f"--callgrind-out-file={output}"]
    valgrind = [*tools.command("valgrind"), "--tool=callgrind", *options]
    output_of([*valgrind, str(host.program), *arguments])
    with output.open() as lines:
        return sum_dumps(read_dumps(lines), host.layer, kinds)


def count(tools: Toolchain, host: Host, tasks: int) -> Kinds:
    """One simulation under callgrind."""
    return callgrind(tools, host, str(tasks), [str(tasks)], KINDS)


def measure_set(tools: Toolchain, host: Host, tasks: int) -> Kinds:
    """Measured twice, to the instruction; not each set has both kinds of passes with one task."""
    kinds = twice(lambda: count(tools, host, tasks), f"with {tasks} tasks")
    all_of({**kinds, "one task": merged(kinds, ONE_TASK)}, (*NO_TASK, "one task"))
    return kinds


def read_sizes(text: str) -> dict[str, tuple[int, int]]:
    """Text (constants included) and data per object, from the program size."""
    rows = [line.split() for line in text.splitlines()[1:]]
    return {Path(row[5]).stem: (int(row[0]), int(row[1]) + int(row[2])) for row in rows}


def read_symbols(text: str) -> dict[str, int]:
    """The sizes of the objects of bench/sizes.c, from nm -S."""
    found = re.findall(r"^\w+ (\w+) \w bench_size_(\w+)$", text, re.MULTILINE)
    return {name: int(size, 16) for size, name in found}


def target_build(tools: Toolchain, name: str, extra: Sequence[str] = ()) -> Build:
    """A build for the Cortex-M7."""
    flags = [*ARM_FLAGS, *INCLUDES, *extra]
    return Build(tools, "arm-none-eabi-gcc", flags, BUILD / name)


def measure_sizes(tools: Toolchain, capacity: int) -> dict[str, int]:
    """The sizes of the objects of bench/sizes.c for one capacity of the queue."""
    extra = ["-fno-common", f"-DKEEL_QUEUE_CAPACITY={capacity}u"]
    probe = target_build(tools, f"sizes-{capacity}", extra).object("bench/sizes.c")
    return read_symbols(output_of([*tools.command("arm-none-eabi-nm"), "-S", str(probe)]))


def size_of_task(less: int, more: int) -> int:
    """What a task takes of a scheduler, from its sizes for both CAPACITIES."""
    size, rest = divmod(more - less, CAPACITIES[1] - CAPACITIES[0])
    if rest or size <= 0:
        raise ToolError(f"a scheduler of {less} bytes does not grow to {more} by whole tasks")
    return size


def measure_target(tools: Toolchain) -> Target:
    """Code size and RAM on the Cortex-M7."""
    objects = target_build(tools, "target").objects([LAYER])
    listing = output_of([*tools.command("arm-none-eabi-size"), *map(str, objects)])
    sizes = read_sizes(listing)
    symbols = [measure_sizes(tools, capacity) for capacity in CAPACITIES]
    return Target(
        {name: text for name, (text, _) in sizes.items()},
        {name: data for name, (_, data) in sizes.items() if data},
        {**symbols[0], "task": size_of_task(symbols[0]["scheduler"], symbols[1]["scheduler"])},
    )


def check_target_steps(tools: Toolchain, budget: Budget) -> None:
    """The Cortex-M7 objects of the steps."""
    extra = ["-Wdouble-promotion", "-Werror"]
    objects = target_build(tools, "target-steps", extra).objects(["src"])
    dump = [*tools.command("arm-none-eabi-objdump"), "-dr"]
    code = read_code(output_of([*dump, *map(str, objects)]))
    for figure in budget.steps.values():
        refuse_slow_code(code, figure.step or "")


def measure_steps(tools: Toolchain, budget: Budget) -> Kinds:
    """Instructions of each step in a host build, counted twice."""
    host = build_host(tools, "host-steps", "src", [STEP_HARNESS])
    steps = twice(lambda: callgrind(tools, host, "steps", [], budget.steps), "of the steps")
    all_of(steps, [*budget.steps])
    return steps


def together(kinds: Mapping[str, Kind]) -> Kinds:
    """What a host build has of the figures of passes."""
    return {"no_task": merged(kinds, NO_TASK), "one_task": merged(kinds, ONE_TASK)}


def goals_of(kinds: Mapping[str, Kind], target: Target, budget: Budget) -> list[Goal]:
    means = {name: kind.mean for name, kind in together(kinds).items()}
    return [
        Goal("instructions, no task", means["no_task"], budget.goal("no_task")),
        Goal(f"instructions, one task of {GOAL_SET}", means["one_task"], budget.goal("one_task")),
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
    both = {**kinds, **together(kinds)}
    return {name: kind_report(kind) for name, kind in both.items() if kind.passes}


def host_report(tools: Toolchain, host: Measured) -> dict[str, object]:
    versions = {name: found.version for name, found in tools.versions("bench", "test").items()}
    used = ("gcc", "valgrind", "binutils", "arm-none-eabi-gcc")
    target = host.target
    return {
        "schema": 1,
        "tools": {name: versions[name] for name in used if name in versions},
        "host_flags": list(HOST_FLAGS),
        "target_flags": list(ARM_FLAGS),
        "capacity": {str(tasks): SETS[tasks] for tasks in host.sets},
        "sets": {str(tasks): set_report(kinds) for tasks, kinds in host.sets.items()},
        "steps": {name: kind_report(kind) for name, kind in host.steps.items()},
        "for_scale": {name: list(pair) for name, pair in FOR_SCALE.items()},
        "target": {**asdict(target), "total_text": target.total, "per_task": target.per_task},
        "goals": [{**asdict(goal), "met": goal.met} for goal in host.goals],
    }


def target_report(tools: Toolchain, counted: Kinds, budget: Budget) -> dict[str, object]:
    return {
        "emulator": tools.versions("target")["qemu"].version,
        "figures": {
            name: {
                "passes": kind.passes,
                "instructions": kind.instructions,
                "mean": round(kind.mean, 2),
                "longest": kind.longest,
                "budget": budget.figures[name].budget,
                "goal": budget.figures[name].goal,
            }
            for name, kind in counted.items()
        },
        "over_budget": budget.exceeded(counted),
    }


def measure_host(tools: Toolchain, budget: Budget) -> Measured:
    """What callgrind counts, and what the Cortex-M7's objects have."""
    hosts = {
        capacity: build_host(
            tools, f"host-{capacity}", LAYER, HARNESS, [f"-DKEEL_QUEUE_CAPACITY={capacity}u"]
        )
        for capacity in sorted(set(SETS.values()))
    }
    sets = {tasks: measure_set(tools, hosts[SETS[tasks]], tasks) for tasks in SETS}
    target = measure_target(tools)
    check_target_steps(tools, budget)
    steps = measure_steps(tools, budget)
    return Measured(sets, target, steps, goals_of(sets[GOAL_SET], target, budget))


def print_host(host: Measured, budget: Budget) -> None:
    print("Instructions of a pass, host build, scheduler code only")
    for tasks, kinds in host.sets.items():
        tables.print_set(tasks, SETS[tasks], kinds)
    tables.print_scale()
    tables.print_hot(GOAL_SET, host.sets[GOAL_SET])
    tables.print_target(host.target, CAPACITIES[0])
    tables.print_steps(budget, host.steps)
    tables.print_goals(host.goals)


def judge(tools: Toolchain, host: Measured, counted: Kinds, check: bool) -> int:
    """Write the report, print the figures of the Cortex-M7 and the verdict; the exit status."""
    budget = read_budget()
    over = budget.exceeded(counted)
    report = {**host_report(tools, host), "cortex_m7": target_report(tools, counted, budget)}
    write_report(REPORT, report, good=not over)
    tables.print_figures(budget, {**together(host.sets[GOAL_SET]), **host.steps}, counted)
    if over:
        print(f"bench: over the budget of bench/budget.toml: {'; '.join(over)}.")
        return 1
    print(verdict(host.goals))
    return 1 if check and not all(goal.met for goal in host.goals) else 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = Parser("Measure what Keel costs.", "bench")
    parser.add_argument("--check", action="store_true", help="fail when a goal is missed")
    parser.add_argument("--accept", action="store_true", help="make what is measured the budget")
    options = parser.parse_args(arguments)

    def work() -> int:
        REPORT.unlink(missing_ok=True)
        budget = read_budget()
        tools = Toolchain()
        tools.ensure("bench", "target")
        host = measure_host(tools, budget)
        print_host(host, budget)
        counted = emulated.measure(tools, budget)
        if options.accept:
            accept(counted)
        return judge(tools, host, counted, options.check)

    return program("bench", work)
