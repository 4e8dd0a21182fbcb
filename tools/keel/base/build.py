# SPDX-License-Identifier: Apache-2.0
"""Builds C and C++, for the host and for the target: each file at most once with the same flags."""

from __future__ import annotations

import hashlib
import threading
from collections import defaultdict
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from keel.base.errors import ROOT, ToolError
from keel.base.run import output_of

SOURCE_ENDINGS = (".c", ".S")


class BuildError(ToolError):
    """Something could not be built; below the first line stand the compiler's words."""


class Commands(Protocol):
    """Whoever knows how to start a compiler: a Toolchain."""

    def command(self, tool: str) -> list[str]:
        """The words that start a tool."""


def source_files(names: Iterable[str], root: Path = ROOT) -> list[str]:
    """The files that a list of files and folders stands for, each once, from the root."""
    files: dict[str, None] = {}
    for name in names:
        path = root / name
        if path.is_file():
            files[name] = None
            continue
        below = [item for item in path.rglob("*") if item.suffix in SOURCE_ENDINGS]
        if not below:
            raise BuildError(f"there is no source file {name}, and no folder with some")
        files.update(dict.fromkeys(sorted(item.relative_to(root).as_posix() for item in below)))
    return list(files)


@dataclass
class Build:
    """A compiler with its flags, and a folder for what it makes. Threads may share it: who asks for
    an object that another one is compiling waits for it."""

    tools: Commands
    compiler: str
    flags: Sequence[str]
    folder: Path
    root: Path = ROOT
    link_flags: Sequence[str] = ()
    made: dict[tuple[str, ...], Path] = field(default_factory=dict)
    _makers: defaultdict[tuple[str, ...], threading.Lock] = field(
        default_factory=lambda: defaultdict(threading.Lock), repr=False
    )
    _lock: threading.Lock = field(default_factory=threading.Lock, repr=False)

    def object(self, source: str, extra: Sequence[str] = ()) -> Path:
        """Compile a file; the object's path ends as the source's does. One outside of the root is
        named `foreign`."""
        key = (source, *extra)
        with self._lock:
            maker = self._makers[key]
        with maker:
            if key not in self.made:
                self.made[key] = self._compiled(source, extra)
            return self.made[key]

    def _compiled(self, source: str, extra: Sequence[str]) -> Path:
        """The object of a file, made now."""
        kind = hashlib.sha256(" ".join(extra).encode()).hexdigest()[:8] if extra else "obj"
        foreign = Path(source).is_absolute()
        inner = Path("foreign", Path(source).name) if foreign else Path(source)
        target = (self.folder / kind / inner).with_suffix(".o")
        target.parent.mkdir(parents=True, exist_ok=True)
        self.compile([*self.flags, *extra, "-c", source, "-o", self.shown(target)])
        return target

    def objects(
        self, names: Iterable[str], extra: Sequence[str] = (), width: int = 1
    ) -> list[Path]:
        """Compile files and folders, `width` files at a time."""
        files = source_files(names, self.root)
        with ThreadPoolExecutor(width) as pool:
            return list(pool.map(lambda file: self.object(file, extra), files))

    def link(self, name: str, objects: Iterable[Path], libraries: Sequence[str] = ()) -> Path:
        """Link a program; it appears when it is whole."""
        program = self.folder / name
        draft = program.with_name(f"{program.name}.tmp")
        program.parent.mkdir(parents=True, exist_ok=True)
        program.unlink(missing_ok=True)
        words = [self.shown(path) for path in objects]
        self.compile([*self.link_flags, *words, *libraries, "-o", self.shown(draft)])
        draft.rename(program)
        return program

    def program(self, name: str, sources: Iterable[str], libraries: Sequence[str] = ()) -> Path:
        """Compile and link files and folders."""
        return self.link(name, self.objects(sources), libraries)

    def sources(self) -> dict[Path, str]:
        """The source file of each object that was compiled."""
        return {path: key[0] for key, path in dict(self.made).items()}

    def compile(self, words: Sequence[str]) -> None:
        """Start the compiler."""
        try:
            output_of([*self.tools.command(self.compiler), *words], cwd=self.root)
        except ToolError as error:
            raise BuildError(str(error)) from error

    def shown(self, path: Path) -> str:
        """A path from the root: what is built does not depend on where the root lies."""
        return str(path.relative_to(self.root)) if path.is_relative_to(self.root) else str(path)
