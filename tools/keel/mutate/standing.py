# SPDX-License-Identifier: Apache-2.0
"""Whether the results of mutation that specs/mutation keeps are of what is there."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.errors import ToolError
from keel.base.files import read_text
from keel.c.project import Unit
from keel.install import Found
from keel.mutate import records as mutant_records
from keel.mutate.verdicts import score

Record = Mapping[str, Any]

NOT_RUN = "not run"
CURRENT = "current"
HEAD = ("unit", "made_of", "problems", "summary", "mutants")
MUTANT = ("function", "kind", "line", "original", "mutant", "status", "engines")


@dataclass(frozen=True)
class Standing:
    """A unit, the result that is kept of it, and what of it is stale."""

    unit: str
    record: Record | None
    stale: tuple[str, ...] = ()

    @property
    def shown(self) -> str:
        """The file."""
        return f"{mutant_records.FOLDER}/{self.unit}.json"

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
        return f"{self.unit:<12} {score(self.record['summary'])}; {self.how}"

    @property
    def counted(self) -> list[Record]:
        """The mutants that compile and make a difference."""
        every = self.record["mutants"] if self.record else []
        return [one for one in every if one["status"] not in ("stillborn", "equivalent")]

    def with_status(self, *statuses: str) -> list[Record]:
        """The mutants with a status."""
        every = self.record["mutants"] if self.record else []
        return [one for one in every if one["status"] in statuses]


def read_record(path: Path) -> Record:
    """A result that is kept; one that is not whole is refused."""
    shown = f"{mutant_records.FOLDER}/{path.name}"
    try:
        read = json.loads(read_text(path))
    except ValueError as error:
        raise ToolError(f"{shown}: is not whole: {error}") from error
    lacking = [name for name in HEAD if not isinstance(read, dict) or name not in read]
    lacking += [name for one in ([] if lacking else read["mutants"]) for name in MUTANT
                if name not in one][:1]  # fmt: skip
    if lacking:
        raise ToolError(f"{shown}: lacks {lacking[0]}: write it with make mutate ARGS=--record")
    record: Record = read
    return record


def standings(
    root: Path, units: Iterable[Unit], tools: Mapping[str, Found], problems: list[str]
) -> Iterator[Standing]:
    """Every unit with proofs, beside these tools; what cannot be read is a problem."""
    harnesses = mutant_records.all_harnesses(root)
    for unit in units:
        path = mutant_records.record_of(unit)
        if not unit.folder.is_dir():
            continue
        record, stale = None, []
        try:
            record = read_record(path) if path.is_file() else None
        except ToolError as error:
            problems.append(str(error))
        if record:
            judges = mutant_records.killers(one["engines"] for one in record["mutants"])
            now = mutant_records.origin(unit, harnesses, tools, judges)
            then = record["made_of"]
            stale = [name for name in {**now, **then} if then.get(name) != now.get(name)]
        yield Standing(unit.name, record, tuple(stale))
