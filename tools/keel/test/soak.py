# SPDX-License-Identifier: Apache-2.0
"""Run the code beside its executable specification for a very long time: 10^9 random calls each of
the scheduler (at its capacity, and at one that is often full), the voter, the filter and the PID.

    python3 tools/keel soak                    # an hour on one core
    python3 tools/keel soak --steps 10000000   # fewer

`make test` runs the same programs for 10^6 calls each, with sanitizers; here they are optimised,
and begin with another seed. Results and objects are compared after each call, bit for bit. Writes
build/soak/report.json.

Exit status: 0 when nothing differs, 1 when something does, 2 when the programs cannot be built.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.build import Build
from keel.base.errors import ROOT, ToolError, program
from keel.base.run import Ended, run
from keel.base.source import write_report
from keel.install import Toolchain
from keel.test.command import CAPACITIES, PROPERTIES
from keel.test.sources import KERNEL, with_code

BUILD = Path("build/soak")
STEPS = 10**9
FEWEST = 10**6  # With fewer, not everything happens that the programs wait for.
MOST = 2**32 - 1  # The programs count in 32 bits.
SEED = 20261122
FLAGS = ["-std=c99", "-O2", "-ffp-contract=off", "-Iinclude"]


def scheduler(tools: Toolchain, size: str, steps: int) -> list[str | Path]:
    """The command that drives the scheduler, at one capacity of its queue."""
    build = Build(tools, "gcc", [*FLAGS, *CAPACITIES[size][1]], ROOT / BUILD / size)
    return [
        build.program("scheduler", [*KERNEL, *with_code(PROPERTIES)]),
        "--seed",
        str(SEED),
        "--steps",
        str(steps),
    ]


def floats(tools: Toolchain, steps: int) -> list[str | Path]:
    """The command that drives the voter, the filter and the PID, each as often."""
    unity = tools.command("unity")[0]
    extra = [f"-DSTEPS={steps}u", f"-DSEED={SEED}u", "-isystem", unity, "-w"]
    build = Build(tools, "gcc", [*FLAGS, *extra], ROOT / BUILD / f"floats-{steps}")
    return [
        build.program(
            "specified", [*KERNEL, "tests/unit/test_specified.c", f"{unity}/unity.c"], ["-lm"]
        )
    ]


def soak(name: str, command: Sequence[str | Path]) -> tuple[Ended, float]:
    """Run one program to its end, however long that is."""
    print(f"soak: {name} ...", flush=True)
    began = time.monotonic()
    ended = run(command, None)
    seconds = time.monotonic() - began
    print(
        f"soak: {name}: {'no difference' if ended.good else ended.how} ({seconds:.0f} s)",
        flush=True,
    )
    if not ended.good:
        print(ended.evidence, flush=True)
    return ended, seconds


def work(steps: int) -> int:
    """Build and run all; the exit status."""
    tools = Toolchain()
    tools.ensure("test")
    report = ROOT / BUILD / "report.json"
    report.unlink(missing_ok=True)
    commands = {
        **{f"scheduler/{size}": scheduler(tools, size, steps) for size in CAPACITIES},
        "voter, filter, pid and reference": floats(tools, steps),
    }
    results = {name: soak(name, command) for name, command in commands.items()}
    good = all(ended.good for ended, _ in results.values())
    write_report(
        report,
        {
            "steps": steps,
            "seed": SEED,
            "programs": {
                name: {"good": ended.good, "seconds": round(seconds)}
                for name, (ended, seconds) in results.items()
            },
        },
        good=good,
    )
    calls = f"{steps:,} calls of each".replace(",", " ")
    print(f"soak: {'no difference' if good else 'code and specification DIFFER'}, {calls}")
    return 0 if good else 1


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = Parser("Run the code beside its specification for long.", "soak")
    parser.add_argument("--steps", type=int, default=STEPS, metavar="N", help="calls of each")
    options = parser.parse_args(arguments)

    def checked() -> int:
        if not FEWEST <= options.steps <= MOST:
            raise ToolError(f"--steps {options.steps}: expected {FEWEST} to {MOST}")
        return work(options.steps)

    return program("soak", checked)
