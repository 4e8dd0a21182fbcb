# SPDX-License-Identifier: Apache-2.0
"""Refuses files that a compiler or a prover would read and that no audit looks at.

Audits look at the headers below include/, the sources and headers below src/ and proofs/, and those
in specs/model. So nothing there is a link to something else, an #include names one header of these,
and code that is built includes only headers that are built. A header that belongs to no unit has
nothing to prove, as no unit's proof would be of it. And no module that Frama-C would load in place
of its own lies where it runs.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from keel.c import source as csource
from keel.c.project import KEEL, ProjectError, Unit, include_folders, resolve

FOLDERS = ("include", "src", "specs/model", "proofs")
BUILT = ("include/**/*.h", "src/**/*.[ch]")
PROOFS = ("specs/model/*.[ch]", "proofs/**/*.[ch]")
THEOREM = "wp: theorem"
PLAIN_NAME = re.compile(r"[\w.-]+", re.ASCII)
INCLUDE = re.compile(r"[ \t]*#[ \t]*include\b")
ONE_HEADER = re.compile(
    r"""[ \t]*\#[ \t]*include[ \t]*
    (?: <(?P<angled>(?:[\w.-]+/)*[\w.-]+\.h)> | "(?P<quoted>(?:[\w.-]+/)*[\w.-]+\.h)" )
    [ \t]*(?: //.* | /\*.* )?""",
    re.ASCII | re.VERBOSE,
)
# The plug-ins of Frama-C that proofs, or those plug-ins themselves, may load.
PLUG_INS = frozenset(
    "rtegen rte wp qed eva value variadic report inout from scope server callgraph metrics"
    " instantiate markdown_report alias constant_propagation e_acsl sparecode slicing users".split()
)
MODULES = frozenset(
    (".ml", ".mli", ".mll", ".mly", ".cmi", ".cmo", ".cmx", ".cma", ".cmxa", ".cmxs", ".cmt")
)


def plug_ins(root: Path) -> list[str]:
    """Modules in a project's folder: Frama-C runs there, and loads such a file before its own."""
    return [
        f"{path.name}: Frama-C would load it in place of a plug-in of its own; remove it"
        for path in sorted(root.iterdir())
        if path.suffix.lower() in MODULES
        and path.stem.lower().replace("-", "_").removeprefix("frama_c_") in PLUG_INS
    ]


def problems(root: Path, units: Iterable[Unit]) -> list[str]:
    """Whatever is wrong with where the files of a project are, and with those that they include."""
    return [*_out_of_place(root), *_included(root), *_of_no_unit(root, units)]


def _out_of_place(root: Path) -> Iterator[str]:
    """Links, folders that hide Keel's headers, and names that an #include cannot say."""
    for folder in FOLDERS:
        for path in (root / folder, *_below(root / folder)):
            shown = path.relative_to(root)
            if path.is_symlink():
                yield f"{shown}: a symbolic link, and audits look at nothing that lies elsewhere"
            elif path.is_dir() and path.name == "keel" and shown != Path("include/keel"):
                yield f"{shown}: a folder of this name hides the headers of include/keel"
            elif (path.is_dir() or path.suffix in (".c", ".h")) and not PLAIN_NAME.fullmatch(
                path.name
            ):
                yield f"{shown}: a name of more than letters, digits, '.', '_' and '-'"


def _below(folder: Path) -> Iterator[Path]:
    """All that is in a folder; what links lead to is left out."""
    for place, folders, files in os.walk(folder):
        for name in sorted((*folders, *files)):
            yield Path(place, name)


def _files(root: Path, patterns: Iterable[str]) -> list[Path]:
    """The files of these names, in order; links are left out, as they are refused anyway."""
    return [
        path
        for pattern in patterns
        for path in sorted(root.glob(pattern))
        if path.is_file() and not path.is_symlink()
    ]


@dataclass(frozen=True)
class _Known:
    """The files that audits look at, of a project and of Keel, and those of them that are built."""

    every: frozenset[Path]
    built: frozenset[Path]


def _known(root: Path) -> _Known:
    built = {path.resolve() for path in _files(root, BUILT)}
    kernel = {path.resolve() for path in _files(KEEL, ("include/**/*.h",))}
    every = built | kernel | {path.resolve() for path in _files(root, PROOFS)}
    if root.resolve() != KEEL:
        every |= {path.resolve() for path in _files(KEEL, PROOFS)}
    return _Known(frozenset(every), frozenset(built | kernel))


def _included(root: Path) -> Iterator[str]:
    """Each #include that names no header, or one that it may not."""
    known = _known(root)
    for path in _files(root, (*BUILT, *PROOFS)):
        text = csource.read(path)
        bare = csource.without_comments(text).split("\n")
        is_built = path.resolve() in known.built or THEOREM in text[:500]
        for number, line in enumerate(text.split("\n"), 1):
            if INCLUDE.match(bare[number - 1]):
                for what in _wrong_include(root, path, line, known, is_built):
                    yield f"{path.relative_to(root)}:{number}: {what}"


def _wrong_include(
    root: Path, path: Path, line: str, known: _Known, is_built: bool
) -> Iterator[str]:
    """What is wrong with a line that includes a file."""
    named = ONE_HEADER.fullmatch(line)
    if not named:
        yield "an #include names one header, NAME.h, and nothing else stands on its line"
        return
    name, quoted = named["angled"] or named["quoted"], bool(named["quoted"])
    try:
        found = resolve(root, path, name, quoted)
    except ProjectError as error:
        yield str(error)
        return
    if found is None:
        return
    if found not in known.every:
        yield f"{name}: no audit looks at that file"
    elif is_built and (found not in known.built or ".." in Path(name).parts):
        yield f"{name}: what is built includes headers below include/, or beside it"
    if any((folder / name).is_file() for folder in include_folders(root)) and not any(
        (folder / name).resolve() == found for folder in include_folders(root)
    ):
        yield f"{name}: a file of that name hides the one below include/"


def _of_no_unit(root: Path, units: Iterable[Unit]) -> Iterator[str]:
    """Headers whose code, or lemmas, no unit's proof would be of."""
    own = {path for unit in units for path in unit.own_files}
    for path in _files(root, ("include/**/*.h",)):
        if path not in own:
            text = csource.read(path)
            opened = csource.with_ghosts(text)
            for line, what in (
                *((one.line, f"the function {one.name}") for one in csource.functions(opened)),
                *_lemmas(text),
                *((line, f"`{word}`") for line, word in csource.forbidden(text)),
            ):
                place = f"{path.relative_to(root)}:{line}"
                yield f"{place}: {what}, in a header of no unit: nobody proves it"
    for path in _files(root, ("specs/model/*.h", "proofs/**/*.h")):
        for line, what in _lemmas(csource.read(path)):
            place = f"{path.relative_to(root)}:{line}"
            yield f"{place}: {what}, in a header of no unit: nobody proves it"


def _lemmas(text: str) -> Iterator[tuple[int, str]]:
    for line, inner in csource.acsl(text):
        for match in csource.LEMMA.finditer(inner):
            yield line + inner.count("\n", 0, match.start()), f"the lemma {match[1]}"
