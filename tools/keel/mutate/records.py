# SPDX-License-Identifier: Apache-2.0
"""What a result of mutation is of, so that it is known when it says nothing about what is there.

Digests of the sources and the proofs that the result was had from, and the versions of the tools.
Where one of these has changed, the result is stale. Of the proofs, the harnesses count that killed
a mutant: whatever becomes of others, these kill the same, and what nobody killed has its reason.
How they search does not count: an execution that fails is one however it was found. Other builds of
the same versions are the same tools here: a distribution makes them anew for each release, and no
commit could follow. `proofs.mutant_table` keeps the results.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path

from keel.base.verdict_cache import digest
from keel.c import source as csource
from keel.c.places import read_by_provers
from keel.c.project import Unit, closure, find_units
from keel.install import Found
from keel.judge.goals import read_goals
from keel.judge.harness import Harness, read_harness

# These judge no mutant; the last says where provers lie.
NO_JUDGES = ("gcc", "newlib", "ocamlfind", "why3-config")


def all_harnesses(root: Path) -> list[tuple[Harness, frozenset[Path]]]:
    """The harnesses of all units, each with the files that it is made of."""
    read = [
        read_harness(unit, path) for unit in find_units(root).values() for path in unit.harnesses
    ]
    included: dict[Path, list[Path]] = {}
    return [(one, frozenset(closure(root, [one.path, *one.sources], included))) for one in read]


def killers(answers: Iterable[Mapping[str, str]]) -> frozenset[str]:
    """The harnesses that killed a mutant; `answers` is what each engine said, mutant by mutant."""
    said = (engines.get("cbmc", "").partition("killed: ") for engines in answers)
    return frozenset(how.partition(":")[0] for before, kills, how in said if kills and not before)


def origin(
    unit: Unit,
    harnesses: Sequence[tuple[Harness, frozenset[Path]]],
    tools: Mapping[str, Found],
    judges: Collection[str],
) -> dict[str, str]:
    """Digests of what a result on a unit depends on, and each tool's version; `judges` are the
    names of the harnesses that killed.

    The sources count with their contracts, but not with the words of other comments; harnesses and
    models without any comment. Neither the prover that proved a goal last nor the wrong bodies
    matter.
    """
    root = unit.root
    own = {path.resolve() for path in unit.own_files}
    linked = [(one, files) for one, files in harnesses if own & files and one.name in judges]
    source = set(closure(root, unit.own_files))
    apart = set().union(*(files for _, files in linked)) - source
    texts = {path: path.read_text(encoding="utf-8") for path in (*source, *apart)}
    equivalent = unit.folder / "equivalent.toml"
    return {
        "source": digest({_shown(path, root): _counted(texts[path]) for path in source}),
        "proofs": digest(
            {
                "texts": {_shown(path, root): csource.essence(texts[path]) for path in apart},
                "options": {
                    one.name: [*one.defines, *one.replaces, *one.covers] for one, _ in linked
                },
                "goals": read_goals(unit.goal_list, unit.goal_list.name).names,
                "equivalent": equivalent.read_text(encoding="utf-8")
                if equivalent.is_file()
                else "",
            }
        ),
        **{name: version_of(tool) for name, tool in tools.items() if name not in NO_JUDGES},
    }


def _counted(text: str) -> str:
    """A source as it counts: the places of lines do where functions are, for results name them."""
    return csource.without_prose(text) if csource.defined(text) else read_by_provers(text)


def version_of(tool: Found) -> str:
    """A tool's version, with those of the packages that it is of."""
    packages = [f"{part.get('name')} {part.get('version')}" for part in tool.parts]
    return "; ".join([tool.version, *packages])


def _shown(path: Path, root: Path) -> str:
    return path.relative_to(root.resolve()).as_posix()
