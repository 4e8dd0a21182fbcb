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

The steps of the layers above (STEPS, bench/bench_steps.c) are counted the same way. In their
Cortex-M7 objects no function that a step reaches may have an instruction in double precision or
call anything but the kernel: that is an error, not a missed goal.

What the same passes and steps take on the Cortex-M7 is counted on an emulated one, and held against
a budget (tools/keel/bench/emulated.py).

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
from keel.bench.callgrind import KINDS, NO_TASK, ONE_TASK, Kind, merged, read_dumps, sum_dumps
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

# Steps by their labels: what they are, the function, and the goal on the Cortex-M7.
STEPS: dict[str, tuple[str, str, int]] = {
    "filter": ("filter", "keel_filter_step", 30),
    "pid": ("PID", "keel_pid_step", 110),
    "reference": ("reference generator, four sticks", "keel_reference_step", 150),
    "mixer": ("mixer, 4 motors, all fits", "keel_mixer_step", 200),
    "mixer_worst": ("mixer, 4 motors, all gives way", "keel_mixer_step", 200),
    "mode": ("mode, in flight", "keel_mode_step", 250),
    "mode_worst": ("mode, all facts waiting", "keel_mode_step", 250),
    "attitude": ("attitude, all sensors in each", "keel_attitude_step", 600),
    "altitude": ("altitude, a pressure in each", "keel_altitude_step", 250),
    "position": ("position, a fix in each", "keel_position_step", 500),
    "cascade": ("cascade, all four stages", "keel_cascade_rate_step", 3000),
    "battery": ("battery, two modules", "keel_battery_step", 400),
    "calibration": ("calibration at rest", "keel_calibration_rest_step", 250),
    "sbus": ("SBUS, a byte of right frames", "keel_sbus_take", 100),
    "sbus_worst": ("SBUS, a byte of nothing but headers", "keel_sbus_take", 300),
    "ms5611": ("MS5611, a reading in frost", "keel_ms5611_compensate", 300),
    "ubx": ("UBX, a byte of right messages", "keel_ubx_take", 200),
    "mavlink": ("MAVLink, a byte of right frames", "keel_mavlink_take", 200),
    "signing": ("signatures, a right frame", "keel_signing_accepts", 1500),
    "log_ring": ("log ring, a record of 36 bytes", "keel_log_ring_write", 1200),
    "ulog": ("ULog, 36 bytes of data", "keel_ulog_add", 1000),
    "crsf": ("CRSF, a byte of right frames", "keel_crsf_take", 200),
    "ibus": ("IBUS, a byte of right frames", "keel_ibus_take", 200),
    "ppm": ("PPM, an edge of right frames", "keel_ppm_take", 200),
    "imu": ("virtual IMU, 3 x 6, all agree", "keel_virtual_imu_step", 900),
    "imu_worst": ("virtual IMU, 3 x 6, one outvoted", "keel_virtual_imu_step", 900),
}
STEP_HARNESS = "bench/bench_steps.c"


@dataclass(frozen=True)
class Host:
    """A program of the host build, and the functions of the layer in it."""

    program: Path
    layer: frozenset[str]


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
) -> dict[str, Kind]:
    """One run of a program under callgrind."""
    output = BUILD / f"callgrind-{name}.out"
    output.unlink(missing_ok=True)
    options = ["--collect-atstart=no", "--combine-dumps=yes", "--compress-strings=no"]
    options += ["--compress-pos=no", f"--callgrind-out-file={output}"]
    valgrind = [*tools.command("valgrind"), "--tool=callgrind", *options]
    output_of([*valgrind, str(host.program), *arguments])
    with output.open() as lines:
        return sum_dumps(read_dumps(lines), host.layer, kinds)


def count(tools: Toolchain, host: Host, tasks: int) -> dict[str, Kind]:
    """One simulation under callgrind."""
    return callgrind(tools, host, str(tasks), [str(tasks)], KINDS)


def measure_set(tools: Toolchain, host: Host, tasks: int) -> dict[str, Kind]:
    """Measured twice, to the instruction."""
    first, second = count(tools, host, tasks), count(tools, host, tasks)
    if first != second:
        raise ToolError(f"two runs with {tasks} tasks differ")
    empty = [name for name in NO_TASK if not first[name].passes]
    if empty or not merged(first, ONE_TASK).passes:
        raise ToolError(f"no pass was measured of the kind {', '.join(empty) or 'one task'}")
    return first


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


def check_target_steps(tools: Toolchain) -> None:
    """The Cortex-M7 objects of the steps."""
    extra = ["-Wdouble-promotion", "-Werror"]
    objects = target_build(tools, "target-steps", extra).objects(["src"])
    dump = [*tools.command("arm-none-eabi-objdump"), "-dr"]
    code = read_code(output_of([*dump, *map(str, objects)]))
    for _, step, _ in STEPS.values():
        refuse_slow_code(code, step)


def measure_steps(tools: Toolchain) -> dict[str, Kind]:
    """Instructions of each step in a host build, counted twice."""
    host = build_host(tools, "host-steps", "src", [STEP_HARNESS])
    first, second = (callgrind(tools, host, "steps", [], STEPS) for _ in range(2))
    if first != second:
        raise ToolError("two runs of the steps differ")
    for name, kind in first.items():
        if not kind.passes:
            raise ToolError(f"no step of {name} was measured")
    return first


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
    tools: Toolchain,
    sets: Mapping[int, Mapping[str, Kind]],
    target: Target,
    steps: Mapping[str, Kind],
) -> dict[str, object]:
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


def measure(tools: Toolchain) -> list[Goal]:
    """Measure, report, print."""
    hosts = {
        capacity: build_host(
            tools, f"host-{capacity}", LAYER, HARNESS, [f"-DKEEL_QUEUE_CAPACITY={capacity}u"]
        )
        for capacity in sorted(set(SETS.values()))
    }
    sets = {tasks: measure_set(tools, hosts[SETS[tasks]], tasks) for tasks in SETS}
    target = measure_target(tools)
    check_target_steps(tools)
    steps = measure_steps(tools)
    goals = goals_of(sets, target)
    # No verdict yet: the budgets are of the figures that benchmark.emulated adds.
    write_report(REPORT, report_of(tools, sets, target, steps), good=False)
    print("Instructions of a pass, host build, scheduler code only")
    for tasks, kinds in sets.items():
        tables.print_set(tasks, SETS[tasks], kinds)
    tables.print_scale()
    tables.print_hot(GOAL_SET, sets[GOAL_SET])
    tables.print_target(target, CAPACITIES[0])
    tables.print_steps(STEPS, steps)
    tables.print_goals(goals)
    return goals


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = Parser("Measure what Keel costs.", "bench")
    parser.add_argument("--check", action="store_true", help="fail when a goal is missed")
    parser.add_argument("--accept", action="store_true", help="make what is measured the budget")
    options = parser.parse_args(arguments)

    def work() -> int:
        REPORT.unlink(missing_ok=True)
        tools = Toolchain()
        tools.ensure("bench")
        goals = measure(tools)
        if over := emulated.add(tools, REPORT, options.accept):
            print(f"bench: over the budget of bench/budget.toml: {'; '.join(over)}.")
            return 1
        print(verdict(goals))
        return 1 if options.check and not all(goal.met for goal in goals) else 0

    return program("bench", work)
