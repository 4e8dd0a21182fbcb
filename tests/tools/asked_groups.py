# SPDX-License-Identifier: Apache-2.0
"""Which groups of tools Python files ask for, read from their source: by `ensure` and `provide`, or
by `command`, whose tool is of some group."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

from keel.install.lock import Lock

# What these ask for, others have told them.
TOLD = (
    "keel/install/packages.py",
    "keel/install/command.py",
    "keel/test/suites.py",
    "keel/cli/commands.py",
)


@cache
def nodes(path: Path) -> list[ast.AST]:
    """The syntax of a file, its module first."""
    return list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))


@cache
def imported(path: Path, folders: tuple[Path, ...]) -> list[Path]:
    """The files below the folders that a file imports."""
    return list(_imported(path, folders))


def _imported(path: Path, folders: tuple[Path, ...]) -> Iterator[Path]:
    for node in nodes(path):
        if isinstance(node, ast.Import):
            yield from files_of([alias.name for alias in node.names], folders)
        elif isinstance(node, ast.ImportFrom):
            module = f"{node.module}." if node.module else ""
            names = [module.rstrip("."), *(f"{module}{alias.name}" for alias in node.names)]
            yield from files_of(names, [path.parents[node.level - 1]] if node.level else folders)


def files_of(modules: Sequence[str], folders: Sequence[Path]) -> Iterator[Path]:
    """The files of modules that lie in one of the folders."""
    for folder in folders:
        for module in filter(None, modules):
            place = folder.joinpath(*module.split("."))
            files = (place.with_suffix(".py"), place / "__init__.py")
            yield from (file for file in files if file.is_file())


def closure(path: Path, folders: tuple[Path, ...]) -> set[Path]:
    """A file, and all below the folders that it imports, or that those import."""
    found: set[Path] = set()
    new = [path]
    while new:
        one = new.pop()
        if one not in found:
            found.add(one)
            new += imported(one, folders)
    return found


def asked(path: Path, lock: Lock) -> set[tuple[str, ...]]:
    """What one file asks for: of each of these groups one, for a tool may be of several."""
    found: set[tuple[str, ...]] = set()
    for node in nodes(path):
        if isinstance(node, ast.Call):
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            if name == "provide" and not node.args:
                found.add(("common",))
            elif name in ("ensure", "provide") and not path.as_posix().endswith(TOLD):
                for argument in node.args:
                    found |= {(group,) for group in groups_of(argument, path, lock)}
            elif name == "command" and isinstance(node.args[0], ast.Constant):
                found.add(groups_with(str(node.args[0].value), lock))
    return found


def groups_of(argument: ast.expr, path: Path, lock: Lock) -> list[str]:
    """The groups that an argument names."""
    if isinstance(argument, ast.Constant):
        return [str(argument.value)]
    if isinstance(argument, ast.JoinedStr) and isinstance(argument.values[0], ast.Constant):
        return [name for name in lock.groups if name.startswith(str(argument.values[0].value))]
    if isinstance(argument, ast.Starred) and isinstance(argument.value, ast.Name):
        name = argument.value.id
        for node in nodes(path):
            if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == name:
                return [str(group) for group in ast.literal_eval(node.value)]
        return []  # Imported: the file that has it asks for it, too.
    raise AssertionError(f"{path}:{argument.lineno}: which group is asked for cannot be told")


def groups_with(command: str, lock: Lock) -> tuple[str, ...]:
    """The groups that bring a command."""
    tool = lock.providing(command).name
    return tuple(name for name, tools in lock.groups.items() if tool in tools)
