# SPDX-License-Identifier: Apache-2.0
"""Whether the results of mutation that specs/mutation.toml keeps are of what is there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from keel.base.errors import ToolError
from keel.c import source as csource
from keel.c.project import Unit, find_units
from keel.install import Found
from keel.mutate import records as mutant_records
from keel.mutate import table as mutant_table
from keel.mutate.table import Record, Results
from keel.mutate.verdicts import read_equivalent, score

NOT_RUN = "not run"
CURRENT = "current"
ACCEPTED = "makes no difference"


@dataclass(frozen=True)
class Survivor:
    """A mutant that no proof notices; with the reason if a person has given one."""

    function: str
    line: int
    original: str
    mutant: str
    status: str
    reason: str = ""


@dataclass(frozen=True)
class Standing:
    """A unit, the result that is kept of it, what of it is stale, and who survived.

    The survivors that were accepted are among them only while the reasons are those that the result
    refers to.
    """

    unit: str
    record: Record | None
    stale: tuple[str, ...] = ()
    survivors: tuple[Survivor, ...] = ()

    @property
    def shown(self) -> str:
        """Where the result stands."""
        return f"{mutant_table.FILE}: {self.unit}"

    @property
    def current(self) -> bool:
        """Whether there is a result, about what is there now."""
        return self.record is not None and not self.stale

    @property
    def how(self) -> str:
        """For people."""
        if self.record is None:
            return NOT_RUN
        return f"STALE: {', '.join(self.stale)} changed since" if self.stale else CURRENT

    @property
    def line(self) -> str:
        """For the console."""
        if self.record is None:
            return f"{self.unit:<12} no result is kept"
        return f"{self.unit:<12} {score(self.record.summary)}; {self.how}"


def accepted(unit: Unit, record: Record) -> list[Survivor]:
    """The survivors that people have explained, from the entries that the result refers to."""
    entries = list(read_equivalent(unit.folder / "equivalent.toml").items())
    found = []
    for one in record.accepted:
        if one.entry > len(entries):
            raise ToolError(
                f"{mutant_table.FILE}: {unit.name}: accepted: there is no entry"
                f" {one.entry} in proofs/{unit.name}/equivalent.toml"
            )
        (function, original, mutant, _), reason = entries[one.entry - 1]
        found.append(Survivor(function, one.line, original, mutant, ACCEPTED, reason))
    return found


def strays(unit: Unit) -> Iterator[str]:
    """The entries about mutants of lines that the unit has no more."""
    sources = [csource.essence(path.read_text(encoding="utf-8")) for path in unit.own_files]
    text = " ".join(" ".join(sources).split())
    place = f"proofs/{unit.name}/equivalent.toml"
    for number, (function, original, _, _) in enumerate(
        read_equivalent(unit.folder / "equivalent.toml"), 1
    ):
        if original not in text:
            gone = f"{function} has no line `{original}` any more, remove it"
            yield f"{place}: entry {number}: {gone}"


def standings(
    root: Path, units: Iterable[Unit], tools: Mapping[str, Found], problems: list[str]
) -> Iterator[Standing]:
    """Every unit with proofs, beside these tools; what cannot be read is a problem."""
    harnesses = mutant_records.all_harnesses(root)
    proved = {name for name, unit in find_units(root).items() if unit.folder.is_dir()}
    try:
        results = mutant_table.read(root)
    except ToolError as error:
        problems += str(error).splitlines()
        results = Results()
    problems += [
        f"{mutant_table.FILE}: there is no unit {name} with proofs"
        for name in results.unit
        if name not in proved
    ]
    for unit in units:
        if unit.name not in proved:
            continue
        record, stale, survivors = results.unit.get(unit.name), [], []
        try:
            problems += strays(unit)
        except ToolError as error:
            problems.append(str(error))
        if record:
            now = mutant_records.origin(unit, harnesses, tools, record.killers)
            then = results.made_of(unit.name)
            stale = [name for name in {**now, **then} if then.get(name) != now.get(name)]
            try:
                survivors = accepted(unit, record) if "proofs" not in stale else []
            except ToolError as error:
                problems.append(str(error))
            survivors += [Survivor(**one.model_dump()) for one in record.open]
        yield Standing(unit.name, record, tuple(stale), tuple(survivors))
