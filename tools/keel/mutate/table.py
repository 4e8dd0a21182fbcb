# SPDX-License-Identifier: Apache-2.0
"""specs/mutation.toml: what mutation last said of each unit, as having it takes hours.

    [tools.0f3c9a1e]                # with these versions the mutants of some units were tried
    cbmc = "6.6.0; cbmc 6.6.0-4"

    [unit.queue]
    source = "…"                    # of what the result is: mutant_records.origin
    proofs = "…"
    tools = "0f3c9a1e"
    killers = ["keel_queue_add_harness"]            # the harnesses that refuted some mutant
    mutants = 64
    killed = {executed = 57, solved = 1, wp = 1}    # by executions of harnesses, by CBMC, by WP
    stillborn = 2                                   # these do not compile
    same_code = {open_slot = [51]}                  # these compile to the same code: their lines
    accepted = [{entry = 1, line = 57}]             # reasons: in proofs/UNIT/equivalent.toml
    open = [{function = "f", line = 9, original = "a", mutant = "b", status = "survived"}]
    problems = []

`make mutate ARGS=--record` writes a unit's table. A person who changes one by hand has to keep the
numbers in step, or the file is refused. Every mutant with its verdict stands in
build/mutate/UNIT.json after a run.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

from keel.base.files import read_text, write_text
from keel.base.verdict_cache import digest
from keel.c.project import ProjectError, Unit
from keel.config import Field, Mistake, Table, Text, parse_toml
from keel.mutate import records as mutant_records
from keel.mutate.verdicts import EXECUTED, SAME_CODE, STATUSES, Verdict, read_equivalent

FILE = "specs/mutation.toml"
HEAD = """\
# SPDX-License-Identifier: Apache-2.0
# The last result of mutation for each unit. make mutate ARGS=--record writes the tables;
# tools/keel/mutate/table.py says what the keys mean.
"""
WIDTH = 100  # A list that makes its line longer than this has a line for each member.
OF_TOOLS = 8  # So many digits of a digest name a set of tools.

Digest = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
Count = Annotated[int, Field(ge=0)]
Line = Annotated[int, Field(ge=1)]


class Killed(Table):
    """How many mutants were killed, by what."""

    executed: Count
    solved: Count
    wp: Count

    @property
    def by_harnesses(self) -> int:
        """By a counterexample to a harness, however it was found."""
        return self.executed + self.solved

    @property
    def total(self) -> int:
        """By anything."""
        return self.by_harnesses + self.wp


class Accepted(Table):
    """A survivor that a person has explained: which entry of equivalent.toml, and where it is."""

    entry: Line
    line: Line


class Open(Table):
    """A survivor that nobody has explained."""

    function: Text
    line: Line
    original: str
    mutant: str
    status: Literal["survived", "undecided"]


class Record(Table):
    """The result on a unit."""

    source: Digest
    proofs: Digest
    tools: Text
    killers: list[Text]
    mutants: Annotated[int, Field(ge=1)]
    killed: Killed
    stillborn: Count
    same_code: dict[Text, Annotated[list[Line], Field(min_length=1)]]
    accepted: list[Accepted]
    open: list[Open]
    problems: list[Text]

    @property
    def same(self) -> int:
        """How many compile to the same object code."""
        return sum(map(len, self.same_code.values()))

    @property
    def equivalent(self) -> int:
        """How many make no difference."""
        return self.same + len(self.accepted)

    @property
    def counted(self) -> int:
        """How many compile and make a difference."""
        return self.killed.total + len(self.open)

    @property
    def summary(self) -> dict[str, int]:
        """How many became what."""
        found = dict.fromkeys(STATUSES, 0)
        found |= {
            "killed": self.killed.total,
            "equivalent": self.equivalent,
            "stillborn": self.stillborn,
        }
        for one in self.open:
            found[one.status] += 1
        return found


class Results(Table):
    """The file."""

    tools: dict[Text, dict[Text, Text]] = {}
    unit: dict[Text, Record] = {}

    def made_of(self, unit: str) -> dict[str, str]:
        """What the result on a unit is of, as mutant_records.origin has it."""
        record = self.unit[unit]
        return {"source": record.source, "proofs": record.proofs, **self.tools[record.tools]}


# --- Reading --------------------------------------------------------------------------------------


def read(root: Path) -> Results:
    """All results that are kept; a file that is not whole is refused."""
    path = root / FILE
    if not path.is_file():
        return Results()
    return parse_toml(read_text(path), Results, FILE, mistakes)


def mistakes(results: Results) -> Iterator[Mistake]:
    """What does not fit together."""
    for name, record in results.unit.items():
        for key, reason in _slips(record):
            yield ("unit", name, key), reason
        if record.tools not in results.tools:
            yield ("unit", name, "tools"), f"there is no table [tools.{record.tools}]"
    for name in set(results.tools) - {record.tools for record in results.unit.values()}:
        yield ("tools", name), "no unit names it"


def _slips(record: Record) -> Iterator[tuple[str, str]]:
    parts = sum(record.summary.values())
    if record.mutants != parts:
        yield "mutants", f"{record.mutants}, but those that are counted below add up to {parts}"
    if bool(record.killers) != bool(record.killed.by_harnesses):
        yield (
            "killers",
            (
                f"{len(record.killers)} harnesses, but {record.killed.by_harnesses}"
                " mutants are killed by one"
            ),
        )
    for key, names in (
        ("killers", record.killers),
        ("accepted", [one.entry for one in record.accepted]),
    ):
        if len(set(names)) != len(names):
            yield key, "names something twice"


# --- Writing --------------------------------------------------------------------------------------


def keep(
    unit: Unit, verdicts: Sequence[Verdict], problems: Sequence[str], made_of: Mapping[str, str]
) -> str:
    """Put a unit's result into the file, in place of an older one; what was done, in words."""
    if not _whole(verdicts):
        return f"{unit.name}: {FILE} left alone: not every mutant was tried"
    results = read(unit.root)
    versions = {name: text for name, text in made_of.items() if name not in ("source", "proofs")}
    named = digest(versions)[:OF_TOOLS]
    record = Record(
        source=made_of["source"],
        proofs=made_of["proofs"],
        tools=named,
        killers=sorted(mutant_records.killers(one.engines for one in verdicts)),
        mutants=len(verdicts),
        killed=_killed(verdicts),
        stillborn=sum(one.status == "stillborn" for one in verdicts),
        same_code=_same_code(verdicts),
        accepted=_accepted(unit, verdicts),
        open=_open(verdicts),
        problems=list(problems),
    )
    units = {**results.unit, unit.name: record}
    write_text(
        unit.root / FILE, text_of(Results(tools={**results.tools, named: versions}, unit=units))
    )
    return f"{unit.name}: {FILE} written"


def _whole(verdicts: Sequence[Verdict]) -> bool:
    """Whether every mutant was tried."""
    return bool(verdicts) and not any(one.status == "skipped" for one in verdicts)


def _killed(verdicts: Iterable[Verdict]) -> Killed:
    dead = [one.engines for one in verdicts if one.status == "killed"]
    by_harnesses = [
        said for said in (engines.get("cbmc", "") for engines in dead) if said.startswith("killed")
    ]
    executed = sum(EXECUTED in said for said in by_harnesses)
    solved = len(by_harnesses) - executed
    return Killed(executed=executed, solved=solved, wp=len(dead) - len(by_harnesses))


def _same_code(verdicts: Iterable[Verdict]) -> dict[str, list[int]]:
    found: dict[str, list[int]] = {}
    for one in verdicts:
        if one.status == "equivalent" and one.reason == SAME_CODE:
            found.setdefault(one.mutant.function, []).append(one.mutant.line)
    return found


def _accepted(unit: Unit, verdicts: Iterable[Verdict]) -> list[Accepted]:
    """References to the reasons, which stand in equivalent.toml alone."""
    place = unit.folder / "equivalent.toml"
    entries = {identity: number for number, identity in enumerate(read_equivalent(place), 1)}
    found = []
    for one in verdicts:
        if one.status != "equivalent" or one.reason == SAME_CODE:
            continue
        if one.mutant.identity not in entries:
            raise ProjectError(f"{unit.name}: {place.name} has no reason for {one.mutant}")
        found.append(Accepted(entry=entries[one.mutant.identity], line=one.mutant.line))
    return sorted(found, key=lambda one: one.entry)


def _open(verdicts: Iterable[Verdict]) -> list[Open]:
    return [
        Open.model_validate(
            {
                "function": one.mutant.function,
                "line": one.mutant.line,
                "original": one.mutant.before,
                "mutant": one.mutant.after,
                "status": one.status,
            }
        )
        for one in verdicts
        if one.status in ("survived", "undecided")
    ]


def text_of(results: Results) -> str:
    """The file's text, in an order that does not depend on who was recorded first."""
    used = {record.tools for record in results.unit.values()}
    tables = {f"tools.{name}": dict(results.tools[name]) for name in sorted(used)}
    tables |= {f"unit.{name}": record.model_dump() for name, record in sorted(results.unit.items())}
    return HEAD + "".join(
        f"\n[{name}]\n" + "".join(_assigned(key, value) for key, value in table.items())
        for name, table in tables.items()
    )


def _assigned(key: str, value: Any) -> str:
    line = f"{key} = {_written(value)}\n"
    if not isinstance(value, list) or len(line) <= WIDTH:
        return line
    return f"{key} = [\n{''.join(f'    {_written(one)},{chr(10)}' for one in value)}]\n"


def _written(value: Any) -> str:
    """A value as TOML has it; JSON has the same strings and numbers."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_written(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_written, value)) + "]"
    return json.dumps(value, ensure_ascii=False)
