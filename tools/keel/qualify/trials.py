# SPDX-License-Identifier: Apache-2.0
"""How each tool is asked about a text: as the commands of the project ask it.

A trial gives what the tool complains about, piece by piece; nothing if it finds all well.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from unittest import mock

from keel.analyse.analysis import Eva
from keel.audit import disguises
from keel.base.build import BuildError
from keel.base.errors import ToolError
from keel.base.files import read_text, write_text
from keel.base.jobs import Runner
from keel.base.run import output_of, run
from keel.boards.call_graph import Graph, StackError, parse
from keel.boards.stack_bounds import Bounds
from keel.c import source as csource
from keel.c.project import Unit, find_units
from keel.c.syntax import SyntaxProblem
from keel.engines.cbmc import CHECKS as CBMC_CHECKS
from keel.engines.wp import OWN, SMOKE, SMOKE_OF_FLOATS
from keel.install import MACHDEP_FILE, TARGET_FLAGS, Toolchain, small_environment
from keel.install.provers import CLOCK_PER_PROCESSOR
from keel.judge import wp_targets
from keel.judge.wp_log import read_log
from keel.test.emulated import EmulatedBoard

Trial = Callable[[Toolchain, Path, str], list[str]]  # The tools, the text's file, the option.

GOAL = re.compile(r"Goal (\S+) : (?!Valid|Trivial)", re.MULTILINE)
PROVED = re.compile(r"Proved goals: +\d+ */ *\d+")
ANSWER = re.compile(r"Valid|Invalid|Timeout|I don't know")
FAILED = re.compile(r"^\[([\w.]+)\] .*: FAILURE$", re.MULTILINE)
SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")
PROVER_SECONDS = 2  # Of the processor. A right goal takes a moment, a wrong one all of them.
UNWIND = "6"
ASSUMPTIONS = OWN / "find_assumptions.ml"
CONTRADICTIONS = OWN / "find_contradictions.ml"
ENDINGS = {"gappa": "g", "alt-ergo": "why"}


def wp(tools: Toolchain, file: Path, prover: str) -> list[str]:
    """The goals that WP does not prove with a prover."""
    words = [
        "-wp-prover",
        prover,
        "-wp-timeout",
        str(PROVER_SECONDS * CLOCK_PER_PROCESSOR),
        "-wp-status-all",
    ]
    said = _said_by_wp(tools, file, words)
    if not PROVED.search(said):
        raise ToolError(f"frama-c: no verdict:\n{said.strip()}")
    return GOAL.findall(said)


def smoke(tools: Toolchain, file: Path, prover: str) -> list[str]:
    """The smoke tests that fail, of those that `make prove` asks of the file's last function."""
    stage = next(one for one in (SMOKE, SMOKE_OF_FLOATS) if one.provers == (prover,))
    function = csource.defined(file.read_text(encoding="utf-8"))[-1].name
    script = shutil.copyfile(CONTRADICTIONS, file.with_name(CONTRADICTIONS.name))
    words = ["-load-script", str(script), "-wp-rte", "-wp-no-pruning"]
    words += ["-wp-smoke-timeout", str(stage.seconds * CLOCK_PER_PROCESSOR)]
    told = {"KEEL_SMOKE": f"{prover} {stage.steps} {function}"}
    log = read_log(said_by_frama_c(tools, file, words, told))
    if not log.smoke:
        raise ToolError("frama-c: no smoke test")
    return [name for name, passed in log.smoke.items() if not passed]


def _said_by_wp(tools: Toolchain, file: Path, options: list[str]) -> str:
    return said_by_frama_c(tools, file, ["-wp", "-wp-rte", "-wp-cache", "none", *options])


def said_by_frama_c(
    tools: Toolchain, file: Path, options: list[str], told: Mapping[str, str] | None = None
) -> str:
    """What Frama-C says of a file, in whose folder its scripts are; `told` are variables."""
    tools.ensure("prove", say=lambda _: None)  # Another clone may have made why3's file anew.
    command = tools.frama_c()
    script = file.with_name(MACHDEP_FILE.name)  # Frama-C compiles it beside its source.
    shutil.copyfile(MACHDEP_FILE, script)
    command[command.index(str(MACHDEP_FILE))] = str(script)
    environment = {**tools.environment(), **(told or {}), "PWD": str(file.parent), "LC_ALL": "C"}
    return output_of([*command, *options, file.name], cwd=file.parent, environment=environment)


def assumptions(tools: Toolchain, file: Path, option: str) -> list[str]:
    """What the annotations take for granted."""
    script = shutil.copyfile(ASSUMPTIONS, file.with_name(ASSUMPTIONS.name))
    log = read_log(said_by_frama_c(tools, file, ["-load-script", str(script), "-rte"]))
    if not log.surveyed:
        raise ToolError(f"frama-c: no verdict: {'; '.join(map(str, log.messages))}")
    return log.assumed


def hidden(tools: Toolchain, file: Path, option: str) -> list[str]:
    """What a header may show to one tool and not to another."""
    text = file.read_text(encoding="utf-8")
    found: list[disguises.Finding] = []
    # A text that is no C that can be parsed is refused before; what it is besides is said first.
    with contextlib.suppress(SyntaxProblem):
        for one in disguises.everywhere(text):
            found.append(one)
        found += disguises.in_what_is_built(text, file.name, ())
    return [f"{line}: {what}" for line, what in found]


def environment(tools: Toolchain, file: Path, option: str) -> list[str]:
    """What the preprocessor says where the caller's variables name a folder of headers."""
    folder = file.with_name("stray")
    folder.mkdir()
    (folder / "stray.h").touch()
    stray = dict.fromkeys(("CPATH", "C_INCLUDE_PATH"), str(folder))
    with mock.patch.dict(os.environ, stray):
        runner = Runner(small_environment(tools.environment()), file.parent)
    return runner.run([*tools.command("arm-none-eabi-gcc"), "-E", str(file)]).output.splitlines()


def keys(tools: Toolchain, file: Path, option: str) -> list[str]:
    """Whether a verdict's key has a header that the unit includes in <...>."""
    root = file.with_name("project")
    unit = write_project(root)
    made = []
    for state in file.read_text(encoding="utf-8").split("-----\n"):
        write_text(root / "include/limit.h", state)
        [function] = [one for one in wp_targets.targets(unit) if one.function]
        made.append(wp_targets.dependencies(function, root))
    return ["another key"] if made[0] != made[1] else []


def write_project(root: Path) -> Unit:
    """A project of one unit that includes a header of its own in <...>."""
    write_text(root / "include/box/box.h", "#include <limit.h>\nint box(int x);\n")
    write_text(
        root / "src/box/box.c",
        '#include "box/box.h"\nint box(int x)\n{\n    return x + LIMIT;\n}\n',
    )
    return find_units(root)["box"]


def alt_ergo(tools: Toolchain, file: Path, option: str) -> list[str]:
    """The answers but "Valid"."""
    done = run([*tools.command("alt-ergo"), "-timelimit", str(PROVER_SECONDS), file])
    answers = ANSWER.findall(done.output)
    if not answers:
        raise ToolError(f"alt-ergo: no verdict:\n{done.output.strip()}")
    return [answer for answer in answers if answer != "Valid"]


def eva(tools: Toolchain, file: Path, option: str) -> list[str]:
    """The alarms, and the contracts that do not name what is written."""
    found = Eva(tools, file.parent).analyse([file.name], ["."], ["main"])["main"]
    writes = [
        f"assigns of {one.function}: {one.status}"
        for one in found.properties
        if one.kind == "assigns clause" and one.status == "Unknown"
    ]
    return [*(one.kind for one in found.alarms), *writes]


def cbmc(tools: Toolchain, file: Path, solver: str) -> list[str]:
    """The properties that fail."""
    binary = file.with_suffix(".gb")
    output_of([*tools.goto_cc(), file, "--function", "harness", "-o", binary])
    words = [*CBMC_CHECKS, "--unwind", UNWIND]
    words += ["--external-sat-solver", *tools.command(solver)] if solver else []
    done = run([*tools.command("cbmc"), *words, binary], environment=tools.environment())
    if "VERIFICATION SUCCESSFUL" not in done.output and "VERIFICATION FAILED" not in done.output:
        raise ToolError(f"cbmc: no verdict:\n{done.output.strip()}")
    return FAILED.findall(done.output)


def gappa(tools: Toolchain, file: Path, option: str) -> list[str]:
    """What Gappa does not prove."""
    done = run([*tools.command("gappa"), file])
    return done.output.splitlines() if not done.good else []


def cppcheck(tools: Toolchain, file: Path, option: str) -> list[str]:
    """The checks that find something."""
    report = file.with_suffix(".sarif")
    words = [
        "--addon=misra",
        "--quiet",
        "--std=c99",
        "--enable=warning,style",
        "--check-level=exhaustive",
        "--output-format=sarif",
    ]
    output_of([*tools.command("cppcheck"), *words, f"--output-file={report}", file])
    results = json.loads(read_text(report))["runs"][0]["results"]
    return [result["ruleId"] for result in results]


def stack(tools: Toolchain, file: Path, option: str) -> list[str]:
    """Why the stack of `left` has no bound."""
    words = ["-std=c99", "-O2", *TARGET_FLAGS, "-fcallgraph-info=su,da", "-c", file.name]
    output_of([*tools.command("arm-none-eabi-gcc"), *words], cwd=file.parent)
    graph: Graph = {}
    try:
        parse(read_text(file.with_suffix(".ci")), graph, file.name)
        Bounds(graph).of("left")
    except StackError as error:
        return [str(error)]
    return []


def sanitizers(tools: Toolchain, file: Path, option: str) -> list[str]:
    """What the sanitizers say while the program runs."""
    program = file.with_suffix("")
    output_of([*tools.command("gcc"), "-std=c99", "-O1", *SANITIZERS, file, "-o", program])
    done = run([program])
    return [] if done.good else [done.evidence]


def coverage(tools: Toolchain, file: Path, option: str) -> list[str]:
    """The lines with a branch that the program does not take."""
    program, raw, data = (file.with_suffix(end) for end in ("", ".profraw", ".profdata"))
    flags = ["-fprofile-instr-generate", "-fcoverage-mapping"]
    output_of([*tools.command("clang-19"), *flags, file, "-o", program])
    run([program], environment={**os.environ, "LLVM_PROFILE_FILE": str(raw)})
    output_of([*tools.command("llvm-profdata-19"), "merge", raw, "-o", data])
    told = output_of([*tools.command("llvm-cov-19"), "export", program, f"-instr-profile={data}"])
    branches = json.loads(told)["data"][0]["files"][0]["branches"]
    return [f"line {branch[0]}: not taken" for branch in branches if 0 in branch[4:6]]


def emulated(tools: Toolchain, file: Path, option: str) -> list[str]:
    """What the unit tests of an image say when it runs."""
    board = EmulatedBoard(tools)
    test = board.builder.object(str(file), [*board.unity_flags(), "-w"])
    image = board.builder.link(f"qualify-{file.parent.name}", [board.unity(), test])
    ended = board.run(image)
    if not re.search(r"^\d+ Tests", ended.output, re.MULTILINE):
        raise ToolError(f"qemu: {ended.how}\n{ended.evidence}")
    return [line for line in ended.output.splitlines() if ":FAIL" in line]


TRIALS: dict[str, Trial] = {
    "wp": wp,
    "smoke": smoke,
    "alt-ergo": alt_ergo,
    "eva": eva,
    "cbmc": cbmc,
    "gappa": gappa,
    "cppcheck": cppcheck,
    "stack": stack,
    "sanitizers": sanitizers,
    "coverage": coverage,
    "emulated": emulated,
    "assumptions": assumptions,
    "disguises": hidden,
    "environment": environment,
    "keys": keys,
}


def ask(tools: Toolchain, trial: str, text: str, option: str, folder: Path) -> list[str]:
    """What a tool says of a text."""
    folder.mkdir(parents=True)
    file = folder / f"seed.{ENDINGS.get(trial, 'c')}"
    file.write_text(text, encoding="utf-8")
    try:
        return TRIALS[trial](tools, file, option)
    except BuildError as error:
        raise ToolError(f"{trial}: {error}") from error
