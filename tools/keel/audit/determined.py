# SPDX-License-Identifier: Apache-2.0
"""Is the outcome of every public function determined? Lists by what, and fails where by nothing.

By equality: specs/model/UNIT.h declares model_x with the types of keel_x, and a harness of keel_x
shows that both do the same (equality.py), in every field of what is written (sameness.py): for
every valid state, or within a bound (inputs.py). A harness of chosen points shows neither.
By wp: proofs/units.toml says so, with the reason why no harness does, and every field that the
function assigns is named by a clause of its contract (clauses.py).
By nothing: proofs/units.toml says why.

A unit without specs/model/UNIT.h is open: its functions are listed as such, and do not fail.

The table is kept in proofs/determined.md, with all that harnesses assume: what narrows a harness
shows there, and in a review.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from keel.audit import clauses, harness_inputs, similarity
from keel.audit.harness_equality import Reader, Reading, loops
from keel.audit.harness_inputs import BOUND, CHOSEN, EVERY, Inputs
from keel.base.files import write_text
from keel.c import source as csource
from keel.c.declarations import Signature, Structures, macros, signatures, structures
from keel.c.project import Unit, find_units
from keel.judge.harness import MODELS, Harness, harnesses_of, read_harness
from keel.judge.settings import Exceptions, read_exceptions

EQUALITY, WP, NOTHING, OPEN, UNDETERMINED = "equality", "wp", "nothing", "open", "undetermined"
WAYS = (WP, NOTHING)
KEPT = "proofs/determined.md"


@dataclass
class Outcome:
    """What determines the outcome of a function."""

    unit: str
    function: str
    by: str
    # For which states a harness shows it.
    extent: str = ""
    # The harnesses that show it, each with what it narrows.
    harnesses: dict[str, list[str]] = field(default_factory=dict)
    # Those of chosen points.
    points: list[str] = field(default_factory=list)
    # Whose assumptions make a state valid, and whose contracts take part.
    assumes: list[str] = field(default_factory=list)
    # The fields that a contract determines, each with the labels of its clauses.
    fields: dict[str, list[str]] = field(default_factory=dict)
    # Whether WP proves clauses on every field, whatever the bound.
    beyond: bool = False
    reason: str = ""
    problems: list[str] = field(default_factory=list)

    def as_dict(self) -> dict[str, Any]:
        """For the report."""
        return asdict(self)


def public_functions(unit: Unit, exceptions: Exceptions) -> dict[str, Signature]:
    """The functions that a unit offers, those aside that nobody defines."""
    found: dict[str, Signature] = {}
    for path in unit.headers:
        found |= signatures(csource.read(path))
    return {
        name: signature
        for name, signature in found.items()
        if name.startswith(unit.prefix) and name not in exceptions.no_body
    }


def model_of(unit: Unit) -> Path:
    """Where a unit's model is declared."""
    return unit.root / MODELS / f"{unit.name}.h"


class Decider:
    """Decides what determines the functions of a project's units."""

    def __init__(self, root: Path) -> None:
        headers = clauses.header_texts(root)
        self._root = root
        self._units = find_units(root)
        self._exceptions = read_exceptions(root / "proofs" / "units.toml", list(self._units))
        self._known = structures(headers)
        self._parts = harness_inputs.read_preconditions(root / harness_inputs.TABLE)
        self._reader = harness_inputs.Reader(root, macros(headers), self._parts)
        self._signatures: dict[str, Signature] = {}
        for text in headers:
            self._signatures |= signatures(text)
        self._read: dict[Path, Inputs] = {}

    def every(self) -> list[Outcome]:
        """All functions of all units."""
        return [one for unit in self._units.values() for one in self.outcomes(unit)]

    def outcomes(self, unit: Unit) -> list[Outcome]:
        """Every public function of a unit, with what determines it."""
        exceptions = self._exceptions[unit.name]
        functions = public_functions(unit, exceptions)
        model = model_of(unit)
        declared = signatures(csource.read(model)) if model.is_file() else None
        chosen = {
            key.split()[0]: (key.split()[1], why) for key, why in exceptions.determined.items()
        }
        found = []
        for name, signature in functions.items():
            outcome = self._by_equality(unit, name, signature, declared)
            if name in chosen:
                outcome = _by_choice(
                    unit, outcome, chosen[name], signature, self._known, exceptions.not_by_wp
                )
            elif outcome.extent == BOUND and name not in exceptions.not_by_wp:
                said = clauses.coverage(unit, name, signature, self._known)
                outcome.beyond = not said.problems
            found.append(outcome)
        found += [
            Outcome(
                unit.name,
                name,
                UNDETERMINED,
                problems=[f"units.toml: [{unit.name}] determined: there is no function {name}"],
            )
            for name in chosen
            if name not in functions
        ]
        return found

    def _by_equality(
        self, unit: Unit, name: str, signature: Signature, declared: Mapping[str, Signature] | None
    ) -> Outcome:
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
            readings = _readings(unit, name, signature, self._known)
            self._judge(outcome, unit, readings)
            if not outcome.harnesses and not outcome.points:
                outcome.problems = _complaints(name, model, readings)
        return outcome

    def _judge(self, outcome: Outcome, unit: Unit, readings: Sequence[Reading]) -> None:
        """For which states the harnesses show it that compare."""
        for one in readings:
            if one.problems:
                continue
            handed = self._inputs(read_harness(unit, unit.folder / f"{one.harness}.c"))
            if handed.kind == CHOSEN:
                outcome.points.append(one.harness)
            else:
                outcome.harnesses[one.harness] = handed.bounds
                outcome.assumes += handed.assumes
        outcome.assumes = list(dict.fromkeys(outcome.assumes))
        if outcome.harnesses:
            outcome.by = EQUALITY
            whole = any(not bounds for bounds in outcome.harnesses.values())
            outcome.extent = EVERY if whole else BOUND
        elif outcome.points:
            outcome.extent = CHOSEN
            outcome.problems.append(
                f"{outcome.function}: only harnesses of chosen points compare it with the model:"
                f" {', '.join(outcome.points)}"
            )

    def _inputs(self, harness: Harness) -> Inputs:
        """What a harness hands in, and within what its parts keep their contracts."""
        if harness.path in self._read:
            return self._read[harness.path]
        body = csource.body_of(csource.read(harness.path), harness.name)
        calls = csource.calls(body, harness.function)
        signature = self._signatures.get(harness.function, Signature("void", ()))
        handed = (
            self._reader.read(harness, calls[0], signature, loops(calls[0].node) or ())
            if calls
            else Inputs()
        )
        self._read[harness.path] = handed
        for name in harness.replaces:
            narrow = self._contract(name)
            handed.bounds += [f"{name} by its contract, shown within {narrow}"] if narrow else []
            handed.assumes += [] if narrow else [f"{name} by its contract"]
        if handed.kind == EVERY and handed.bounds:
            handed.kind = BOUND
        return handed

    def _contract(self, name: str) -> str:
        """Within what a function is shown to keep the contract that stands in for it, or ""."""
        narrowest = f"nothing: no harness asserts {name}_does"
        for path in harnesses_of(self._root, name):
            text = csource.body_of(csource.read(path), path.stem)
            unit = self._units.get(path.parent.name)
            if not unit or f"__CPROVER_assert({name}_does(" not in text:
                continue
            handed = self._inputs(read_harness(unit, path))
            if handed.kind == EVERY:
                return ""
            narrowest = "; ".join(handed.bounds) if handed.kind == BOUND else handed.kind
        return narrowest

    def problems(self) -> list[str]:
        """What is wrong with the tables; all units must have been looked at."""
        table = similarity.read_table(self._root)
        found = self._parts.unused()
        found += [
            f"{similarity.TABLE}: there is no unit {name}"
            for name in table
            if name not in self._units
        ]
        for name, unit in self._units.items():
            alike = similarity.similarity(unit)
            if alike >= similarity.ALIKE and name not in table:
                found.append(
                    f"{similarity.TABLE}: [{name}]: its model is its code under other"
                    f" names ({alike:.2f}); say what else would see a slip"
                )
        return found

    def notes(self, units: Iterable[str]) -> dict[str, str]:
        """Of units whose models are their code under other names, what else would see a slip."""
        table = similarity.read_table(self._root)
        return {
            name: f"The model is the same term, under other names; a slip in both is seen by:"
            f" {table[name]}."
            for name in units
            if name in table
        }

    def said(self, units: Iterable[str]) -> dict[str, list[str]]:
        """What the functions say that make a state valid, for units."""
        every: dict[str, list[str]] = {}
        for path, handed in self._read.items():
            if path.parent.name in units and handed.kind != CHOSEN:
                for name, lines in handed.said.items():
                    every[name] = list(dict.fromkeys([*every.get(name, []), *lines]))
        return every


def _readings(unit: Unit, name: str, signature: Signature, known: Structures) -> list[Reading]:
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
    unit: Unit,
    seen: Outcome,
    chosen: tuple[str, str],
    signature: Signature,
    known: Structures,
    left: Mapping[str, str],
) -> Outcome:
    """What units.toml says determines a function, checked."""
    way, reason = chosen
    start = f"units.toml: [{unit.name}] determined: {seen.function}"
    outcome = Outcome(
        unit.name,
        seen.function,
        way,
        seen.extent,
        seen.harnesses,
        seen.points,
        seen.assumes,
        reason=reason,
    )
    if way not in WAYS:
        outcome.problems = [f"{start}: `by` is one of {', '.join(WAYS)}"]
    elif seen.extent == EVERY:
        outcome.problems = [f"{start} is no exception any more, remove it"]
    elif way == WP:
        said = clauses.coverage(unit, seen.function, signature, known)
        outcome.fields, outcome.problems = said.fields, said.problems
        if seen.function in left:
            outcome.problems.append(f"{start}: WP leaves its postconditions to CBMC")
    return outcome


def of_tree(root: Path) -> list[Outcome]:
    """All functions of all units."""
    return Decider(root).every()


def bounds_of(root: Path) -> dict[str, list[str]]:
    """The bounds within which functions are shown, their own; of a unit, those of all of its."""
    every: dict[str, list[str]] = {}
    for outcome in of_tree(root):
        own = [
            text
            for bounds in outcome.harnesses.values()
            for text in bounds
            if outcome.extent == BOUND and " by its contract" not in text
        ]
        every[outcome.function] = own
        every.setdefault(outcome.unit, []).extend(own)
    return every


def summary(found: Iterable[Outcome]) -> str:
    """How many functions are determined, in a line."""
    every = list(found)
    good = [one for one in every if not one.problems]
    equal = [one for one in good if one.by == EQUALITY]
    bound = [one for one in equal if one.extent == BOUND]
    beyond = sum(one.beyond for one in bound)
    whole = len(equal) - len(bound)
    text = f"determined: {whole} of {len(every)} functions for every valid state"
    if bound:
        text += f", {len(bound)} within a bound"
        text += f" ({beyond} of them with WP's clauses on every field beyond it)" if beyond else ""
    for way, words in (
        (WP, "by WP's clauses alone"),
        (NOTHING, "excepted"),
        (OPEN, "open: their units have no model"),
    ):
        count = sum(one.by == way for one in good)
        text += f", {count} {words}" if count else ""
    wrong = len(every) - len(good)
    return text + (f", {wrong} NOT" if wrong else "")


HEAD = """\
# What determines the outcome of each function

Written by make prove (--update-goals), and compared by it. A harness shows that result and every
field written are a model's (specs/model): for every valid state, or within the bounds of the last
column. What makes a state valid is assumed by the functions named there; below stands what each of
them says. Harnesses of chosen points show nothing of other points, and count for nothing. WP:
clauses of the contract name every field; whether they leave a choice is for people to judge. The
capacity of a queue and the number of sensors are the shipped ones where none is named.
"""
COLUMNS = """
| function | shown for | by | within, or assumed |
|---|---|---|---|
"""


def as_markdown(
    found: Iterable[Outcome],
    said: Mapping[str, Sequence[str]] | None = None,
    notes: Mapping[str, str] | None = None,
) -> str:
    """The table, for people."""
    every = list(found)
    parts = [HEAD]
    for unit in dict.fromkeys(one.unit for one in every):
        note = (notes or {}).get(unit)
        parts += [f"\n## {unit}\n", *([f"\n{note}\n"] if note else []), COLUMNS]
        parts += [f"{_row(one)}\n" for one in every if one.unit == unit]
    parts.append(f"\n{summary(every)}\n")
    problems = [f"- {text}\n" for outcome in every for text in outcome.problems]
    parts += ["\n## Not determined\n\n", *problems] if problems else []
    return "".join(parts) + _assumptions(said or {})


SAID = "\n# What makes a state valid\n"


def _assumptions(said: Mapping[str, Sequence[str]]) -> str:
    """What the functions say that make a state valid."""
    if not said:
        return ""
    parts = [SAID]
    for name in sorted(said):
        parts.append(f"\n{name}\n\n")
        parts += [f"    {line}\n" for line in said[name]]
    return "".join(parts)


def _row(outcome: Outcome) -> str:
    shown = [
        *outcome.harnesses,
        *(f"{name}: {', '.join(labels)}" for name, labels in outcome.fields.items() if labels),
        *(f"({name}: chosen points)" for name in outcome.points),
    ]
    within = [text for bounds in outcome.harnesses.values() for text in bounds]
    extent = UNDETERMINED if outcome.problems else outcome.extent if outcome.by == EQUALITY else ""
    extent = extent or ("WP's clauses alone" if outcome.by == WP else outcome.by)
    if outcome.beyond and not outcome.problems:
        extent += "; WP's clauses name every field beyond it"
    assumed = [f"assumed: {', '.join(outcome.assumes)}"] if outcome.assumes else []
    reason = [f"why not by equality: {outcome.reason}"] if outcome.reason else []
    last = [*dict.fromkeys(within), *assumed]
    cells = [outcome.function, extent, "; ".join([*shown, *reason]), "; ".join(last)]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _kept_words(kept: str, name: str) -> set[str]:
    """What a function says as proofs/determined.md has it: of all units that it has a form for."""
    block = kept.partition(f"\n{name}\n\n")[2].partition("\n\n")[0]
    return {line.strip() for line in block.splitlines()}


def kept_problems(root: Path, decider: Decider, found: Sequence[Outcome], whole: bool) -> list[str]:
    """How proofs/determined.md differs from what was found now, of all units or of some."""
    path = root / KEPT
    advice = "review, and run --update-goals"
    if not path.is_file():
        return [f"{KEPT} is missing: {advice}"] if any(one.by != OPEN for one in found) else []
    kept = path.read_text(encoding="utf-8")
    lines = set(kept.splitlines())
    problems = [
        f"{KEPT}: {one.function} is shown otherwise now: {advice}"
        for one in found
        if _row(one) not in lines
    ]
    own = decider.said({one.unit for one in found})
    for name in sorted(own):
        if not set(own[name]) <= _kept_words(kept, name):
            problems.append(f"{KEPT}: {name} says something else now: {advice}")
    notes = decider.notes(dict.fromkeys(one.unit for one in found))
    problems += [
        f"{KEPT}: what is said of the model of {unit} has changed: {advice}"
        for unit, note in notes.items()
        if note not in kept
    ]
    if whole and not problems and kept != as_markdown(found, own, notes):
        problems.append(f"{KEPT} names what is not there any more: {advice}")
    return problems + (decider.problems() if whole else [])


def update_kept(root: Path) -> bool:
    """Write proofs/determined.md anew, for all units; whether it has changed."""
    path = root / KEPT
    decider = Decider(root)
    found = decider.every()
    units = dict.fromkeys(one.unit for one in found)
    text = as_markdown(found, decider.said(units), decider.notes(units))
    if path.is_file() and path.read_text(encoding="utf-8") == text:
        return False
    write_text(path, text)
    return True
