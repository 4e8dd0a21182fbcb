# SPDX-License-Identifier: Apache-2.0
"""Compiles scripts of Frama-C once for all of its processes: each would compile them anew."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

from keel.base.jobs import Runner
from keel.base.shared_results import Once
from keel.c.project import ProjectError


class Modules:
    """The compiled scripts of a run."""

    def __init__(
        self, frama_c: Sequence[str], ocamlfind: Sequence[str], runner: Runner, folder: Path
    ) -> None:
        place = list(frama_c).index("-load-script") if "-load-script" in frama_c else len(frama_c)
        self._frama_c = [*frama_c[:place]]
        self._ocamlfind = list(ocamlfind)
        self._runner = runner
        self._folder = folder
        self._made = Once()
        self._library = Once()

    def compiled(self, script: Path) -> str:
        """The module of a script, for -load-module."""
        return self._made.get(script, lambda: self._compile(script))

    def _compile(self, script: Path) -> str:
        folder = self._folder / script.stem
        folder.mkdir(parents=True, exist_ok=True)
        module = folder / f"{script.stem}.cmxs"
        own = shutil.copyfile(script, folder / script.name)
        library = self._library.get("", self._library_path)
        packages = ["-package", "zarith,ocamlgraph,why3"]
        included = ["-I", library, "-I", f"{library}/plugins"]
        done = self._runner.run(
            [
                *self._ocamlfind,
                "ocamlopt",
                "-shared",
                *packages,
                *included,
                "-o",
                str(module),
                str(own),
            ]
        )
        if done.status != 0:
            raise ProjectError(f"{script.name}: {done.output.strip()}")
        return str(module)

    def _library_path(self) -> str:
        return self._runner.run([*self._frama_c, "-print-lib-path"], merged=False).output.strip()
