# SPDX-License-Identifier: Apache-2.0
"""Fuzzes by libFuzzer: the kernel against its models, decoders against those of others, too.

Each tests/fuzz/fuzz_NAME.c is a target; what it includes says which models it is linked with, and
whether somebody else's decoder judges it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from keel.base.build import Build
from keel.base.errors import ROOT
from keel.base.run import run
from keel.install import Toolchain
from keel.test import oracles
from keel.test.outcomes import Outcome, program_outcome
from keel.test.sources import KERNEL, SMALL, with_code
from keel.test.suites import Suite

BUILD = Path("build/fuzz")

FINDING = re.compile(
    r"^.*(?:DIFFER|runtime error:|ERROR: AddressSanitizer|Test unit written to).*$", re.MULTILINE
)
EXECUTED = re.compile(r"number_of_executed_units:\s+(\d+)")


@dataclass(frozen=True)
class Fuzzing:
    """How much of it: so many seconds a target, with models and sanitizers; or so many executions,
    without, of those whose verdict somebody else's decoder gives."""

    seconds: int
    runs: int = 0

    @property
    def options(self) -> list[str]:
        """As libFuzzer calls them."""
        if self.runs:
            return [f"-runs={self.runs}", "-max_len=128"]
        return [f"-max_total_time={self.seconds}", "-max_len=4096"]

    @property
    def sanitizers(self) -> list[str]:
        """How targets are built."""
        if self.runs:
            return ["-O2", "-DKEEL_ORACLE_ALONE", "-fsanitize=fuzzer"]
        return ["-O1", "-fsanitize=fuzzer,address,undefined", "-fno-sanitize-recover=all"]

    @property
    def limit_s(self) -> float:
        """After which a target hangs; it executes 1000 a second at the least."""
        return max(self.seconds, self.runs / 1000) + 120.0


def fuzz_program(tools: Toolchain, name: str, fuzzer: list[str]) -> Path:
    """Build a target: its file with the kernel and what that is compared with."""
    flags = ["-std=c99", "-g", "-Iinclude", SMALL, *fuzzer]
    link = [flag for flag in fuzzer if flag.startswith("-f")]
    build = Build(tools, "clang-19", flags, ROOT / BUILD / "built", ROOT, link)
    objects = build.objects([*KERNEL, *with_code(oracles.source_of(name))])
    return build.link(name, [*objects, *oracles.of(tools, build, name)], ["-lm"])


def fuzz_suite(tools: Toolchain, fuzzing: Fuzzing, name: str) -> Outcome:
    """Let libFuzzer look for bytes on which the kernel and what it is compared with differ."""
    program = fuzz_program(tools, name, fuzzing.sanitizers)
    folder = BUILD / name  # The corpus stays there, and helps the next run.
    (ROOT / folder / "corpus").mkdir(parents=True, exist_ok=True)
    options = [*fuzzing.options, "-timeout=10", "-print_final_stats=1"]
    options += [f"-artifact_prefix={folder}/"]
    ended = run([program, *options, folder / "corpus"], fuzzing.limit_s)
    said = EXECUTED.search(ended.output)
    print(f"{name}: {int(said.group(1)) if said else 0:,} executions", flush=True)
    told = FINDING.findall(ended.output) or [ended.evidence]
    again = f"to see it again: {program.relative_to(ROOT)} FILE"
    return program_outcome(name, ended, "\n".join([*told, again]))


def fuzz_suites(tools: Toolchain, fuzzing: Fuzzing, root: Path = ROOT) -> list[Suite]:
    """One for each target; when executions are counted, for each that somebody else judges."""
    judges = {name: oracles.groups(name, root) for name in oracles.targets(root)}
    return [
        Suite(name, ("fuzz", *groups), partial(fuzz_suite, tools, fuzzing, name))
        for name, groups in judges.items()
        if groups or not fuzzing.runs
    ]
