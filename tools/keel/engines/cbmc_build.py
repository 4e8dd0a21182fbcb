# SPDX-License-Identifier: Apache-2.0
"""Makes goto binaries of harnesses: of the very sources, for the target, a wrong body or none."""

from __future__ import annotations

import hashlib
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from keel.base.files import write_text
from keel.base.jobs import Runner
from keel.base.shared_results import Once
from keel.c.project import closure, include_options
from keel.judge.harness import Harness
from keel.judge.wrong_bodies import WrongBody


class Builder:
    """The compiler for CBMC. Harnesses share what is compiled of the same text in the same way."""

    def __init__(self, goto_cc: Sequence[str], runner: Runner, root: Path, scratch: Path) -> None:
        self._goto_cc = list(goto_cc)
        self._runner = runner
        self._root = root
        self._folder = scratch / "cbmc"
        self._objects = Once()

    def build(
        self, harness: Harness, name: str, wrong: WrongBody | None = None
    ) -> tuple[Path, str]:
        """Compile and link; the binary, and the compiler's complaint if there is one.

        A wrong body takes the place of the file that it changes, be it a source or a header.
        """
        folder = self._folder / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        tree = self._write(wrong) if wrong else None
        objects: list[str] = []
        for source in (*harness.sources, harness.path):
            if wrong and tree and wrong.file.resolve() in closure(self._root, [source]):
                compiled, complaint = self._compiled_in(tree, wrong, source, harness.defines)
            else:
                compiled, complaint = self._compiled(source, harness.defines)
            if complaint:
                return folder, complaint
            objects.append(str(compiled))
        binary = folder / "harness.gb"
        done = self._runner.run(
            [*self._goto_cc, *objects, "--function", harness.name, "-o", str(binary)]
        )
        if done.status != 0 or done.output.strip():
            return binary, f"goto-cc: {done.output.strip()}"
        return self._with_stand_ins(harness, binary) if harness.replaces else (binary, "")

    def _compiled(self, source: Path, defines: tuple[str, ...]) -> tuple[Path, str]:
        """The object of a source as it is."""
        include = include_options(self._root)
        return self._objects.get(
            (source, defines), lambda: self._compile(source, [*include, *defines])
        )

    def _compiled_in(
        self, tree: Path, wrong: WrongBody, source: Path, defines: tuple[str, ...]
    ) -> tuple[Path, str]:
        """The object of a source that is the changed file, or includes it."""
        include = [f"-I{tree / 'include'}", *include_options(self._root)]
        changed = tree / wrong.file.relative_to(self._root) if source == wrong.file else source
        return self._compile(changed, [*include, *defines])

    def _compile(self, source: Path, options: Sequence[str]) -> tuple[Path, str]:
        """Compile a source; the object, and the compiler's complaint if there is one.

        Another compiler of the same folder, that compiles the same, never sees half of it.
        """
        inside = source.is_relative_to(self._root)
        words = [*options, "-c", str(source.relative_to(self._root) if inside else source)]
        name = hashlib.sha256("\0".join(words).encode()).hexdigest()
        compiled = self._folder / f"{name}.gb"
        with tempfile.TemporaryDirectory(dir=self._folder) as folder:
            made = Path(folder) / compiled.name
            done = self._runner.run([*self._goto_cc, *words, "-o", str(made)])
            if done.status != 0 or "warning" in done.output.lower():
                return compiled, f"goto-cc: {done.output.strip()}"
            made.replace(compiled)
        return compiled, ""

    def _with_stand_ins(self, harness: Harness, binary: Path) -> tuple[Path, str]:
        """The binary with calls of stand-ins in the place of those of the replaced functions."""
        replaced = binary.with_name("replaced.gb")
        instrument = str(Path(self._goto_cc[0]).with_name("goto-instrument"))
        calls = [
            word
            for name in harness.replaces
            for word in ("--replace-calls", f"{name}:{name}_stand_in")
        ]
        done = self._runner.run([instrument, *calls, str(binary), str(replaced)])
        if done.status != 0 or "warning" in done.output.lower():
            return replaced, f"goto-instrument: {done.output.strip()}"
        return replaced, ""

    def _write(self, wrong: WrongBody) -> Path:
        """Write the file with the fault in it; the folder in which it has its usual place."""
        tree = self._root / "build" / "prove" / "wrong" / wrong.unit.name / wrong.name
        write_text(tree / wrong.file.relative_to(self._root), wrong.text())
        return tree
