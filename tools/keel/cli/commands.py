# SPDX-License-Identifier: Apache-2.0
"""The sub-commands: the module of each, and the Python packages that it needs.

python3 tools/keel prove --unit queue
python3 tools/keel with timing -m pytest tests/timing    # any program, with the packages of a group

Exit status: the sub-command's; 2 for a name that is none, or when its packages cannot be had.
"""

from __future__ import annotations

import ast
import importlib
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from keel.base.errors import CANNOT, unknown
from keel.install import Toolchain, ToolchainError

TOOLS = Path(__file__).resolve().parents[2]
READY = "KEEL_WITH"  # The group whose packages this process has.
WITH = "with"
HELP = ("", "help", "-h", "--help")


@dataclass(frozen=True)
class Command:
    """Where a sub-command is, and the group of tools whose packages its modules import."""

    module: str
    group: str = ""


COMMANDS = {
    "bench": Command("keel.bench.command"),
    "campaign": Command("keel.timing.campaign", "timing"),
    "contracts-run": Command("keel.test.contracts_run"),
    "coverage": Command("keel.test.coverage"),
    "coverage-target": Command("keel.test.object_coverage"),
    "dist": Command("keel.release.dist"),
    "eva": Command("keel.analyse.eva"),
    "evidence": Command("keel.evidence.command"),
    "firmware": Command("keel.boards.firmware"),
    "flash": Command("keel.boards.flash"),
    "flight-picture": Command("keel.flight.figure", "fly"),
    "flights": Command("keel.flight.montecarlo", "flights"),
    "fly": Command("keel.flight.command", "fly"),
    "fuzz": Command("keel.test.fuzz"),
    "lint": Command("keel.lint.command"),
    "log": Command("keel.logs.log", "fly"),
    "margins": Command("keel.flight.margins", "fly"),
    "messages": Command("keel.copter.messages", "messages"),
    "model": Command("keel.emulator.chip_model"),
    "mutate": Command("keel.mutate.command"),
    "names": Command("keel.cli.names"),
    "new": Command("keel.prove.new_unit"),
    "opinion": Command("keel.gather.third_opinion"),
    "parameters": Command("keel.copter.parameters"),
    "pictures": Command("keel.timing.pictures", "timing"),
    "prove": Command("keel.prove.command"),
    "px4": Command("keel.boards.px4"),
    "qualify": Command("keel.qualify.command"),
    "registers": Command("keel.boards.registers"),
    "replay": Command("keel.replay.command", "replay"),
    "review": Command("keel.gather.review"),
    "schedule": Command("keel.timeline.command", "schedule"),
    "sim": Command("keel.flight.sim", "sim"),
    "soak": Command("keel.test.soak"),
    "stack": Command("keel.boards.stack"),
    "status": Command("keel.release.status"),
    "test": Command("keel.test.command"),
    "test-project": Command("keel.test.own_tests"),
    "test-target": Command("keel.test.emulated_tests"),
    "timing": Command("keel.timing.command", "timing"),
    "tools": Command("keel.install.command"),
    "trace": Command("keel.trace.command"),
    "world": Command("keel.copter.world", "world"),
}


def start_with(group: str, program: Sequence[str]) -> int:
    """Start Python anew with the packages of a group; returns only when they cannot be had."""
    try:
        tools = Toolchain()
        tools.ensure(group)
        groups = [name for name in tools.lock.groups[group] if name.endswith("-packages")]
        packages = [tools.command(name)[0] for name in groups]
    except ToolchainError as error:
        print(f"{group}: {error}", file=sys.stderr)
        return CANNOT
    variables = {**os.environ, "PYTHONPATH": os.pathsep.join([*packages, str(TOOLS)]), READY: group}
    os.execve(sys.executable, [sys.executable, *program], variables)


def source_of(command: Command) -> Path:
    """The file of a sub-command."""
    return (TOOLS / command.module.replace(".", "/")).with_suffix(".py")


def summary_of(command: Command) -> str:
    """The first line of its description; the module is not imported, as it may lack packages."""
    said = ast.get_docstring(ast.parse(source_of(command).read_text(encoding="utf-8"))) or ""
    return said.partition("\n\n")[0].replace("\n", " ")


def print_help() -> None:
    """Every sub-command, a line each."""
    print("usage: python3 tools/keel COMMAND [ARGUMENT ...]; COMMAND --help has its arguments\n")
    for name, command in COMMANDS.items():
        print(f"  {name:<16} {summary_of(command)}")
    print(f"  {WITH:<16} Runs Python with the packages of a group: {WITH} GROUP PROGRAM")


def main(arguments: Sequence[str]) -> int:
    """Entry point."""
    name, *words = arguments or [""]
    if name in HELP:
        print_help()
        return 0
    if name == WITH:
        if len(words) < 2:
            print("usage: keel with GROUP PROGRAM [ARGUMENT ...]", file=sys.stderr)
            return CANNOT
        return start_with(words[0], words[1:])
    if name not in COMMANDS:
        print(f"keel: {unknown('command', name, sorted(COMMANDS))}", file=sys.stderr)
        return CANNOT
    command = COMMANDS[name]
    if command.group and os.environ.get(READY) != command.group:
        return start_with(command.group, [str(TOOLS / "keel"), name, *words])
    sys.argv = [f"keel {name}", *words]  # By this name a command shows how it is used.
    status: int = importlib.import_module(command.module).main(words)
    return status
