# SPDX-License-Identifier: Apache-2.0
"""Run unit tests with contracts executable: Frama-C's E-ACSL makes C of the ACSL.

    python3 tools/keel contracts-run

A contract that is proved may still say something else than its author thinks. Here each clause that
E-ACSL can translate is evaluated on what the unit tests do: the tests call the function through its
contract, and the first clause that does not hold ends the run with its name and place.

specs/contracts_run.toml says for each function that src/ defines whether it runs so, and why not:
E-ACSL of Frama-C 25 aborts on some contracts, or does not end. Of the functions that run, the
clauses that it leaves out are listed in the report, by construct: assigns, predicates that read
memory, and others. Pointers are compared with null alone, for the tests' own memory is not
instrumented; the address sanitizer looks at it in make test.

build/contracts-run/report.json has the clauses that ran and those that did not, by place. Exit
status: 0 when no clause was violated, 1 otherwise, 2 when it could not be run.
"""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

from keel.base.arguments import Parser
from keel.base.build import Build, source_files
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import read_text
from keel.base.run import Ended, output_of, run
from keel.base.source import write_report
from keel.config import Field, Mistake, Table, Text, read_toml
from keel.install import Toolchain
from keel.test.outcomes import unity_outcome

BUILD = ROOT / "build/contracts-run"
REPORT = BUILD / "report.json"
CHOICE = ROOT / "specs/contracts_run.toml"
GROUPS = ("prove", "test", "contracts-run")
TIMEOUT_S = 300.0

# The tests run on this host, so the contracts are those of its data model.
MACHINE = "gcc_x86_64"
# E-ACSL, and those whose annotations the source has: all others would take half as long once more.
PLUGINS = ("rtegen", "wp", "e_acsl")
# A violated clause is told by its name and place. To keep the values at hand that it speaks of made
# a program of two seconds take half a minute.
E_ACSL = ("-e-acsl", "-e-acsl-no-assert-print-data")
FLAGS = ("-std=c99", "-O1", "-g", "-w", "-Iinclude")
RUNTIME = ("-D_DEFAULT_SOURCE", "-DE_ACSL_SEGMENT_MMODEL")
LIBRARY = "/usr/lib/frama-c/e-acsl/libeacsl-dlmalloc.a"
WRAPPED = ("__e_acsl_valid", "__e_acsl_valid_read")
START = "".join(
    f"int __wrap_{name}(void *p, size_t size, void *base, void *from)\n"
    "{\n    (void)size;\n    (void)base;\n    (void)from;\n    return p != NULL;\n}\n"
    for name in WRAPPED
)
START = f"""#include <stddef.h>
void __e_acsl_memory_init(int *count, char ***words, size_t size);
__attribute__((constructor)) static void begin(void)
{{
    __e_acsl_memory_init(NULL, NULL, sizeof(void *));
}}
{START}"""

CHECK = re.compile(r'\.kind = "([^"]+)"')
IGNORED = re.compile(
    r"^\[e-acsl\] (\S+?):(\d+): Warning: *\n\s+E-ACSL construct\s+`([^']+)'", re.MULTILINE
)
DEFINITION = re.compile(
    r"^(?!static|typedef|//)\w[\w \*]*?\b(keel_\w+)\([^;{]*\)\n\{", re.MULTILINE
)
VIOLATION = re.compile(r"^(.*: Error: .* failed:)\n\s*(.*)$", re.MULTILINE)


class Executed(Table):
    """Functions of a file whose contracts run."""

    unit: Text
    functions: Annotated[list[Text], Field(min_length=1)]


class LeftOut(Executed):
    """Functions of a file whose contracts do not run, and why."""

    reason: Text


class Choice(Table):
    """What runs, and what does not."""

    executed: Annotated[list[Executed], Field(min_length=1)]
    left_out: list[LeftOut] = []


def mistakes(choice: Choice) -> Iterator[Mistake]:
    """Every public function that src/ defines must be named once, and no other."""
    named: list[tuple[str, str]] = []
    defined = {(unit, name) for unit in source_files(["src"]) for name in public(unit)}
    for kind, items in (("executed", choice.executed), ("left_out", choice.left_out)):
        for number, item in enumerate(items):
            for name in item.functions:
                if (item.unit, name) not in defined or (item.unit, name) in named:
                    yield (kind, number, "functions"), f"{name} is not of {item.unit}, or twice"
                named.append((item.unit, name))
    if absent := sorted(name for unit, name in defined - set(named)):
        yield ("executed",), f"nothing is said of {', '.join(absent)}"


def public(unit: str) -> list[str]:
    """The public functions that a file defines."""
    return DEFINITION.findall(read_text(ROOT / unit))


@dataclass
class Run:
    """How the contracts of one file went."""

    functions: list[str] = field(default_factory=list)  # through whose contracts the tests called
    checks: Counter[str] = field(default_factory=Counter)  # in the instrumented code, by kind
    ignored: list[dict[str, object]] = field(default_factory=list)
    passed: int = 0  # tests, once for each function
    failures: list[str] = field(default_factory=list)

    def add(self, function: str, one: Run) -> None:
        """Count what one function's run gave."""
        self.functions.append(function)
        self.checks += one.checks
        self.ignored += [{"function": function, **item} for item in one.ignored]
        self.passed += one.passed
        self.failures += [f"{function}: {failure}" for failure in one.failures]
        if not one.passed and not one.failures:
            self.failures.append(f"{function}: no test ran")


class Runner:
    """Instruments, builds and runs."""

    def __init__(self, tools: Toolchain, folder: Path = BUILD, root: Path = ROOT) -> None:
        self.tools = tools
        self.root = root
        self.folder = folder
        self.build = Build(tools, "gcc", FLAGS, folder, root)
        share = output_of([*tools.command("frama-c"), "-print-share-path"]).strip()
        self.share = f"{share}/e-acsl"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "start.c").write_text(START, encoding="utf-8")

    def instrument(self, unit: str, function: str) -> tuple[Path, str]:
        """The file with a function's contract as code, and what E-ACSL says about it."""
        target = self.folder / "instrumented" / f"{function}.c"
        target.parent.mkdir(exist_ok=True)
        target.unlink(missing_ok=True)
        ended = run(
            [
                *self.tools.command("frama-c"),
                "-no-autoload-plugins",
                "-load-module",
                ",".join(PLUGINS),
                "-machdep",
                MACHINE,
                "-cpp-extra-args=-Iinclude",
                unit,
                *E_ACSL,
                "-e-acsl-functions",
                function,
                "-then-last",
                "-print",
                "-ocode",
                target,
            ],
            TIMEOUT_S,
        )
        if not ended.good or not target.is_file():
            raise ToolError(f"{function}: E-ACSL: {ended.how}\n{ended.evidence}")
        return target, ended.output

    def link(self, unit: str, instrumented: Path, function: str) -> Path:
        """The unit's tests, calling through the contract; the other files are as they are."""
        name = Path(unit).stem
        unity = self.tools.command("unity")[0]
        through = [f"-D{function}=__gen_e_acsl_{function}"]
        runtime = [*RUNTIME, "-isystem", self.share]
        objects = [
            self.build.object(instrumented.relative_to(self.root).as_posix(), runtime),
            self.build.object(f"tests/unit/test_{name}.c", [*through, "-isystem", unity]),
            self.build.object(f"{unity}/unity.c", ["-isystem", unity]),
            self.build.object(f"{self.share}/e_acsl_rtl.c", runtime),
            self.build.object((self.folder / "start.c").relative_to(self.root).as_posix()),
            *self.build.objects(
                other
                for other in source_files(["src"], self.root)
                if Path(other).name != Path(unit).name
            ),
        ]
        wraps = ",".join(f"--wrap={item}" for item in WRAPPED)
        return self.build.link(
            function, objects, [LIBRARY, f"-Wl,{wraps}", "-lgmp", "-lm", "-lpthread"]
        )

    def run(self, unit: Executed) -> Run:
        """Run a file's tests through the contract of each of its functions in turn."""
        whole = Run()
        for function in unit.functions:
            whole.add(function, self.run_one(unit.unit, function))
        return whole

    def run_one(self, unit: str, function: str) -> Run:
        """Instrument a function, and run the tests of its file."""
        instrumented, said = self.instrument(unit, function)
        text = instrumented.read_text(encoding="utf-8")
        checks = Counter(CHECK.findall(text))
        if f"__gen_e_acsl_{function}(" not in text or not checks:
            raise ToolError(f"{function}: E-ACSL made nothing of its contract")
        ended = run([self.link(unit, instrumented, function)], TIMEOUT_S)
        outcome = unity_outcome(f"contracts/{function}", ended)
        failures = [violation(ended)] if VIOLATION.search(ended.output) else outcome.failures
        return Run([], checks, ignored_in(said), outcome.passed, failures)


def ignored_in(said: str) -> list[dict[str, object]]:
    """The clauses that E-ACSL left out, each with its place and the construct that it lacks."""
    clauses = {
        (file, int(line), " ".join(construct.split()))
        for file, line, construct in IGNORED.findall(said)
        if file.startswith(("src/", "include/"))
    }
    return [
        {"file": file, "line": line, "construct": construct}
        for file, line, construct in sorted(clauses)
    ]


def violation(ended: Ended) -> str:
    """The clause that did not hold."""
    match = VIOLATION.search(ended.output)
    assert match
    return f"{match[1].strip()} {match[2].strip()}"


def tell(unit: str, found: Run) -> None:
    """A line for each file, and one for each failure."""
    checks = ", ".join(f"{count} {kind.lower()}" for kind, count in found.checks.items())
    print(
        f"{unit:<32} {found.passed:>3} tests through {len(found.functions)} contracts: {checks}; "
        f"{len(found.ignored)} clauses left out",
        flush=True,
    )
    for failure in found.failures:
        print(failure, flush=True)


def judge(runs: dict[str, Run], choice: Choice, versions: dict[str, str]) -> int:
    """Write the report, print the verdict, give the exit status."""
    failed = sum(len(found.failures) for found in runs.values())
    good = bool(runs) and not failed
    write_report(
        REPORT,
        {
            "units": {unit: vars(found) for unit, found in runs.items()},
            "left_out": [item.model_dump() for item in choice.left_out],
            "tools": versions,
        },
        good=good,
    )
    functions = sum(len(found.functions) for found in runs.values())
    print(f"contracts-run: {functions} contracts of {len(runs)} files ran, {failed} failures")
    return 0 if good else 1


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    Parser("Run unit tests with contracts executable.", "contracts-run").parse_args(arguments)

    def work() -> int:
        REPORT.unlink(missing_ok=True)
        choice = read_toml(CHOICE, Choice, mistakes)
        tools = Toolchain()
        tools.ensure(*GROUPS)
        runner = Runner(tools)
        runs = {}
        with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
            for unit, one in zip(
                choice.executed, pool.map(runner.run, choice.executed), strict=True
            ):
                runs[unit.unit] = one
                tell(unit.unit, one)
        found = tools.versions("prove", "test")
        return judge(runs, choice, {name: found[name].version for name in ("frama-c", "gcc")})

    return program("contracts-run", work)
