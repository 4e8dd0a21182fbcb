# SPDX-License-Identifier: Apache-2.0
"""Python packages: pip fetches them, as it is configured here, and holds them to their pins."""

from __future__ import annotations

import shlex
import stat
import sys
from collections.abc import Sequence
from pathlib import Path

from keel.install.groups import requirements_of
from keel.install.lock import ToolchainError
from keel.install.unpack import Tree, write_starter

SOURCE = "Python package index, pinned"
OPTIONS = ("--require-hashes", "--no-deps", "--only-binary=:all:", "--no-compile")


def install(tree: Tree, python: Sequence[str]) -> None:
    """Whatever the lock file has for pip: one wheel, or all packages of a group."""
    spec = tree.spec
    if spec.kind == "packages":
        # For the Python that runs this program, whichever one pip belongs to.
        version = f"--python-version={sys.version_info.major}.{sys.version_info.minor}"
        pip_install(tree, python, requirements_file(tree), version)
    elif spec.group:
        pip_install(tree, python, requirements_file(tree))
        for command in spec.commands:
            start = f'PYTHONPATH="$root" exec {shlex.join(python)} -m {spec.program} "$@"'
            write_starter(tree, command, start)
    else:
        one = tree.scratch / "requirements.txt"
        one.write_text(f"{spec.package}=={spec.pin} --hash=sha256:{spec.sha256}\n")
        pip_install(tree, python, one)
        tree.parts.append(
            {"name": spec.package, "version": spec.pin, "source": SOURCE, "sha256": spec.sha256}
        )
        for command in spec.commands:
            program = tree.root / spec.program
            program.chmod(program.stat().st_mode | stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH)
            write_starter(tree, command)


def requirements_file(tree: Tree) -> Path:
    """What pip is to install of a group: names, versions, and the SHA-256 of the files."""
    file = tree.scratch / f"{tree.spec.group}.txt"
    file.write_text(requirements_of(tree.spec.group), encoding="utf-8")
    tree.add_part(f"group {tree.spec.group}", tree.spec.pin or "1", SOURCE, file)
    return file


def pip_install(tree: Tree, python: Sequence[str], file: Path, *options: str) -> None:
    """Have pip install a requirements file into the tree."""
    where = ["--target", str(tree.root), "-r", str(file)]
    if tree.log.run([*python, "-m", "pip", "install", *OPTIONS, *options, *where]) != 0:
        what = tree.spec.group or f"{tree.spec.package} {tree.spec.pin}"
        raise ToolchainError(
            f"{tree.spec.name}: pip does not install {what}; pip says:{tree.log.tail()}"
        )
