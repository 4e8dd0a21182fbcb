# SPDX-License-Identifier: Apache-2.0
"""Python packages: pip fetches them, as it is configured here, and holds them to their pins."""

from __future__ import annotations

import shlex
import stat
import sys
from collections.abc import Sequence
from pathlib import Path

from keel.install.lock import TOOLS_DIR, ToolchainError
from keel.install.unpack import Tree, write_starter

SOURCE = "Python package index, pinned"
OPTIONS = ("--require-hashes", "--no-deps", "--only-binary=:all:", "--no-compile")


def install(tree: Tree, python: Sequence[str]) -> None:
    """Whatever the lock file has for pip: one wheel, or all that a requirements file lists."""
    spec = tree.spec
    if spec.kind == "packages":
        # For the Python that runs this program, whichever one pip belongs to.
        version = f"--python-version={sys.version_info.major}.{sys.version_info.minor}"
        pip_install(tree, python, pinned_file(tree, TOOLS_DIR.parent / spec.path), version)
    elif spec.requirements:
        pip_install(tree, python, pinned_file(tree, TOOLS_DIR / spec.requirements))
        for command in spec.commands:
            start = f'PYTHONPATH="$root" exec {shlex.join(python)} -m {spec.program} "$@"'
            write_starter(tree, command, start)
    else:
        one = tree.scratch / "requirements.txt"
        one.write_text(f"{spec.package}=={spec.pin} --hash=sha256:{spec.sha256}\n")
        pip_install(tree, python, one)
        tree.parts.append({"name": spec.package, "version": spec.pin, "source": SOURCE,
                           "sha256": spec.sha256})  # fmt: skip
        for command in spec.commands:
            program = tree.root / spec.program
            program.chmod(program.stat().st_mode | stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH)
            write_starter(tree, command)


def pinned_file(tree: Tree, file: Path) -> Path:
    """A requirements file, which pins what it lists and is itself pinned."""
    tree.check_pin(file)
    tree.add_part(tree.spec.path or file.name, tree.spec.pin, SOURCE, file)
    return file


def pip_install(tree: Tree, python: Sequence[str], file: Path, *options: str) -> None:
    """Have pip install a requirements file into the tree."""
    where = ["--target", str(tree.root), "-r", str(file)]
    if tree.log.run([*python, "-m", "pip", "install", *OPTIONS, *options, *where]) != 0:
        what = tree.spec.path or tree.spec.requirements or f"{tree.spec.package} {tree.spec.pin}"
        raise ToolchainError(
            f"{tree.spec.name}: pip does not install {what}; pip says:{tree.log.tail()}"
        )
