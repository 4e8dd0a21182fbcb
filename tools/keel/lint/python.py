# SPDX-License-Identifier: Apache-2.0
"""The Python of the tools and of their tests: pyproject.toml says how.

ruff finds mistakes and lays out; import-linter holds the order of the rooms of tools/keel, and what
the judge of the proofs may import.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path

from keel.base.errors import ToolError
from keel.base.run import run
from keel.install import Toolchain
from keel.lint.texts import Finding

SETTINGS = "pyproject.toml"
PLACES = ("tools", "tests")
NOT_LAID_OUT = re.compile(r"^(.+?):\d+:\d+: unformatted", re.MULTILINE)
# As import-linter tells a chain: the importer, what it imports, and the line.
CHAIN = re.compile(r"^-?\s*(keel[\w.]*) -> (keel[\w.]*) \(l\.(\d+)", re.MULTILINE)


def ruff(tools: Toolchain) -> list[str]:
    """How ruff is started."""
    return [str(Path(tools.command("python-packages")[0]) / "bin/ruff")]


def lay_out(tools: Toolchain, root: Path) -> None:
    """Lay out all Python, and sort what it imports."""
    if not (root / SETTINGS).is_file():
        return
    for words in (["check", "--quiet", "--select", "I", "--fix-only"], ["format", "--quiet"]):
        done = run([*ruff(tools), *words, *PLACES], cwd=root)
        if not done.good:
            raise ToolError(f"ruff fails:\n{done.output.strip()}")


def check_python(tools: Toolchain, root: Path) -> list[Finding]:
    """Every finding."""
    if not (root / SETTINGS).is_file():
        return []
    return [*_mistakes(tools, root), *_layout(tools, root), *_imports(tools, root)]


def _mistakes(tools: Toolchain, root: Path) -> Iterator[Finding]:
    """The rules of ruff."""
    done = run([*ruff(tools), "check", "--output-format", "json", *PLACES], cwd=root, apart=True)
    try:
        found = json.loads(done.output)
    except ValueError as error:
        raise ToolError(f"ruff fails:\n{done.errors.strip()}") from error
    for one in found:
        place = Path(one["filename"]).relative_to(root).as_posix()
        yield Finding(place, one["location"]["row"], f"{one['code']}: {one['message']}")


def _layout(tools: Toolchain, root: Path) -> Iterator[Finding]:
    """The files that ruff would lay out differently."""
    done = run([*ruff(tools), "format", "--check", "--output-format", "concise", *PLACES], cwd=root)
    names = NOT_LAID_OUT.findall(done.output)
    if not done.good and not names:
        raise ToolError(f"ruff fails:\n{done.output.strip()}")
    for name in names:
        yield Finding(name, 1, "not laid out as ruff does (--fix does it)")


def _imports(tools: Toolchain, root: Path) -> Iterator[Finding]:
    """Where a room imports one above it, or the judge what it must not."""
    places = [tools.command("python-packages")[0], str(root / "tools")]
    variables = {**os.environ, "PYTHONPATH": os.pathsep.join(places)}
    command = [sys.executable, "-c", "from importlinter.cli import lint_imports_command as m; m()"]
    done = run([*command, "--no-cache", "--config", SETTINGS], cwd=root, environment=variables)
    if done.good:
        return
    chains = CHAIN.findall(done.output)
    if not chains:
        raise ToolError(f"import-linter fails:\n{done.output.strip()}")
    for importer, imported, line in chains:
        path = f"tools/{importer.replace('.', '/')}"
        file = f"{path}.py" if (root / f"{path}.py").is_file() else f"{path}/__init__.py"
        yield Finding(file, int(line), f"imports {imported}, against the order in {SETTINGS}")
