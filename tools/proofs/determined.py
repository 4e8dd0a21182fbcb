# SPDX-License-Identifier: Apache-2.0
"""Is the outcome of every public function determined? Lists by what, and fails where by nothing.

By equality: specs/model/UNIT.h declares model_x with the types of keel_x, and a harness of keel_x
shows that both do the same (equality.py), in every field of what is written (sameness.py).
By wp: proofs/units.toml says so, with the reason why no harness does, and every field that the
function assigns is named by a clause of its contract (clauses.py).
By nothing: proofs/units.toml says why.

A unit without specs/model/UNIT.h is open: its functions are listed as such, and do not fail.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from . import clauses, csource
from .declarations import Signature, Structures, signatures, structures
from .equality import Reader, Reading
from .harness import MODELS, read_harness
from .project import Unit, find_units
from .settings import Exceptions, read_exceptions

EQUALITY, WP, NOTHING, OPEN, UNDETERMINED = "equality", "wp", "nothing", "open", "undetermined"
WAYS = (WP, NOTHING)


@dataclass
class Outcome:
    """What determines the outcome of a function."""

    unit: str
    function: str
    by: str
    # The harnesses that show it, each with what it narrows.
    harnesses: dict[str, list[str]] = field(default_factory=dict)
    # The fields that a contract determines, each with the labels of its clauses.
    fields: dict[str, list[str]] = field(default_factory=dict)
    reason: str = ""
    problems: list[str] = field(default_factory=list)

    def as_dict(self) -> dict[str, Any]:
        """For the report."""
        return asdict(self)


def public_functions(unit: Unit, exceptions: Exceptions) -> dict[str, Signature]:
    """The functions that a unit offers, those aside that nobody defines."""
    found: dict[str, Signature] = {}
    for path in unit.own_files:
        if path.suffix == ".h":
            found |= signatures(csource.read(path))
    return {
        name: signature
        for name, signature in found.items()
        if name.startswith(unit.prefix) and name not in exceptions.no_body
    }


def model_of(unit: Unit) -> Path:
    """Where a unit's model is declared."""
    return unit.root / MODELS / f"{unit.name}.h"


def outcomes(unit: Unit, exceptions: Exceptions, known: Structures) -> list[Outcome]:
    """Every public function of a unit, with what determines it."""
    functions = public_functions(unit, exceptions)
    model = model_of(unit)
    declared = signatures(csource.read(model)) if model.is_file() else None
    chosen = {key.split()[0]: (key.split()[1], why) for key, why in exceptions.determined.items()}
    found = []
    for name, signature in functions.items():
        outcome = _by_equality(unit, name, signature, declared, known)
        if name in chosen:
            outcome = _by_choice(
                unit, outcome, chosen[name], signature, known, exceptions.not_by_wp
            )
        found.append(outcome)
    found += [
        Outcome(unit.name, name, UNDETERMINED,
                problems=[f"units.toml: [{unit.name}] determined: there is no function {name}"])
        for name in chosen
        if name not in functions
    ]  # fmt: skip
    return found


def _by_equality(
    unit: Unit, name: str, signature: Signature, declared: Mapping[str, Signature] | None,
    known: Structures,
) -> Outcome:  # fmt: skip
    """What harnesses show of a function."""
    if declared is None:
        return Outcome(unit.name, name, OPEN)
    outcome = Outcome(unit.name, name, UNDETERMINED)
    model = "model_" + name.removeprefix(unit.prefix)
    where = model_of(unit).relative_to(unit.root)
    if model not in declared:
        outcome.problems.append(f"{name}: {where} declares no {model}")
    elif declared[model].types != signature.types:
        outcome.problems.append(f"{name}: {where}: {model} has other types than {name}")
    else:
        readings = _readings(unit, name, signature, known)
        outcome.harnesses = {one.harness: one.bounds for one in readings if not one.problems}
        outcome.by = EQUALITY if outcome.harnesses else UNDETERMINED
        outcome.problems = [] if outcome.harnesses else _complaints(name, model, readings)
    return outcome


def _readings(
    unit: Unit, name: str, signature: Signature, known: Structures
) -> list[Reading]:  # fmt: skip
    """What the harnesses show that call the model."""
    reader = Reader(name, "model_" + name.removeprefix(unit.prefix), signature, known)
    own = [
        path
        for path in unit.harnesses
        if path.stem == f"{name}_harness" or path.stem.startswith(f"{name}__")
    ]
    read = [reader.read(read_harness(unit, path)) for path in own]
    return [one for one in read if one.compares]


def _complaints(name: str, model: str, readings: Iterable[Reading]) -> list[str]:
    found = [f"{one.harness}: {text}" for one in readings for text in one.problems]
    return found or [f"{name}: no harness of it calls {model}"]


def _by_choice(
    unit: Unit, seen: Outcome, chosen: tuple[str, str], signature: Signature, known: Structures,
    left: Mapping[str, str],
) -> Outcome:  # fmt: skip
    """What units.toml says determines a function, checked."""
    way, reason = chosen
    start = f"units.toml: [{unit.name}] determined: {seen.function}"
    outcome = Outcome(unit.name, seen.function, way, seen.harnesses, reason=reason)
    if way not in WAYS:
        outcome.problems = [f"{start}: `by` is one of {', '.join(WAYS)}"]
    elif any(not bounds for bounds in seen.harnesses.values()):
        outcome.problems = [f"{start} is no exception any more, remove it"]
    elif way == WP:
        said = clauses.coverage(unit, seen.function, signature, known)
        outcome.fields, outcome.problems = said.fields, said.problems
        if seen.function in left:
            outcome.problems.append(f"{start}: WP leaves its postconditions to CBMC")
    return outcome


def of_tree(root: Path) -> list[Outcome]:
    """All functions of all units."""
    units = find_units(root)
    exceptions = read_exceptions(root / "proofs" / "units.toml", list(units))
    known = structures(clauses.header_texts(root))
    return [
        outcome
        for name, unit in units.items()
        for outcome in outcomes(unit, exceptions[name], known)
    ]


def summary(found: Iterable[Outcome]) -> str:
    """How many functions are determined, in a line."""
    every = list(found)
    counts = {way: sum(one.by == way and not one.problems for one in every)
              for way in (EQUALITY, WP, NOTHING, OPEN)}  # fmt: skip
    good = counts[EQUALITY] + counts[WP]
    text = f"determined: {good} of {len(every)} functions"
    text += f" (equality {counts[EQUALITY]}, WP {counts[WP]})"
    text += f", {counts[NOTHING]} excepted" if counts[NOTHING] else ""
    return text + (f", {counts[OPEN]} open: their units have no model" if counts[OPEN] else "")


HEAD = """\
# What determines the outcome of each function

Written by make prove. Equality: a harness shows that result and every field written are a model's
(specs/model), within what the harness narrows. WP: clauses of the contract name every field.

| function | by | shown by | within |
|---|---|---|---|
"""


def as_markdown(found: Iterable[Outcome]) -> str:
    """The table, for people."""
    every = list(found)
    lines = [_row(outcome) for outcome in every]
    problems = [f"- {text}" for outcome in every for text in outcome.problems]
    tail = ["", "## Not determined", "", *problems] if problems else []
    return HEAD + "\n".join([*lines, "", summary(every), *tail]) + "\n"


def _row(outcome: Outcome) -> str:
    shown = [*outcome.harnesses, *(
        f"{name}: {', '.join(labels)}" for name, labels in outcome.fields.items() if labels
    )]  # fmt: skip
    within = [text for bounds in outcome.harnesses.values() for text in bounds]
    reason = [f"why not by equality: {outcome.reason}"] if outcome.reason else []
    by = UNDETERMINED if outcome.problems else outcome.by
    cells = [outcome.function, by, "; ".join([*shown, *reason]), "; ".join(dict.fromkeys(within))]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
