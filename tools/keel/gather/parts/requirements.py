# SPDX-License-Identifier: Apache-2.0
"""What is wanted: the requirements of both levels, where they come from, and how each stands."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import cast

from keel.base.errors import ToolError
from keel.gather.part import Context, Item, Part, State, Table
from keel.gather.traced import Traced, read
from keel.trace import strictdoc
from keel.trace.packages import packages
from keel.trace.requirements import Requirement
from keel.trace.verdicts import problems

TEXT = """\
High-level requirements say what Keel is for. Each cites the paper that Keel implements (Hardware \
and RTOS Design of a Flight Controller for Professional Applications), or says why it is derived; \
where Keel does something else than the paper, DEPARTURE has the reason. Low-level requirements \
say what the code shall do, so precisely that the clauses of contracts can bear their ids. Each \
names the high-level ones that it serves, or says why it is derived.

How a requirement stands follows from the reports of the provers and the tests: good, when all \
that bears its id holds, and there is a goal or an assertion of it, or a harness that compares \
the code with a model that names it, where it is to be proved, or a test where it is to be \
tested. Told means a theorem that people have put together from proved parts; specs/soundness.md \
has the argument. A high-level requirement stands as the worst below it. Whether the low-level \
requirements together are enough for their parent no tool can say: that is for a review."""


def text_of(one: Requirement) -> str:
    """A requirement's texts, as paragraphs."""
    named = {
        "RATIONALE": "Rationale",
        "DEPARTURE": "Departure from the paper",
        "DERIVED": "Derived",
        "COMMENT": "Comment",
    }
    rest = [f"{title}: {one.of(name)}" for name, title in named.items() if one.of(name)]
    return "\n\n".join([one.of("STATEMENT"), *rest])


def item_of(one: Requirement, traced: Traced) -> Item:
    """A requirement with all that speaks of it."""
    verdicts = traced.verdicts
    own = verdicts.of(one)
    count = Counter(verdict.by for verdict in own)
    facts = {
        "level": "high" if one.high else "low",
        "document": f"specs/requirements/{one.document}.sdoc",
        "source": one.of("SOURCE") or ("derived" if one.of("DERIVED") else "its parents"),
        "verification": ", ".join(one.verification),
    }
    if count:
        facts["evidence"] = ", ".join(f"{by} {number}" for by, number in sorted(count.items()))
    links = [f"requirement:{uid}" for uid in one.parents]
    links += [f"requirement:{low.uid}" for low in traced.below.get(one.uid, ())]
    links += [f"function:{function.name}" for function in verdicts.bearing(one.uid)]
    links += [verdict.key for verdict in own]
    return Item(
        kind="requirement",
        id=one.uid,
        title=one.of("TITLE"),
        text=text_of(one),
        state=cast("State", traced.state[one.uid]),
        facts=facts,
        links=tuple(links),
    )


def documents(known: Iterable[Requirement], state: Mapping[str, str]) -> Table:
    """Each document with how many of its requirements stand how."""
    rows: dict[str, Counter[str]] = {}
    for one in known:
        rows.setdefault(one.document, Counter())[state[one.uid]] += 1
    return Table(
        title="Requirements by document",
        columns=("document", "requirements", "good", "told", "open", "bad"),
        rows=tuple(
            (
                f"specs/requirements/{name}.sdoc",
                str(counts.total()),
                *(str(counts[one]) for one in ("good", "told", "open", "bad")),
            )
            for name, counts in rows.items()
        ),
    )


def listing(title: str, name: str, known: Iterable[Requirement], note: str = "") -> Table:
    """All requirements that have a certain text."""
    rows = tuple(
        (f"requirement:{one.uid}", one.of("TITLE"), one.of("SOURCE") or "none", one.of(name))
        for one in known
        if one.of(name)
    )
    return Table(
        title=title, columns=("requirement", "title", "source", "reason"), rows=rows, note=note
    )


def of_the_paper(known: Iterable[Requirement]) -> Table:
    """The high-level requirements by what they take from the paper."""
    return Table(
        title="From the paper to the requirements",
        columns=("source", "requirement", "title"),
        rows=tuple(
            (one.of("SOURCE"), f"requirement:{one.uid}", one.of("TITLE"))
            for one in known
            if one.of("SOURCE")
        ),
        note="No requirement names what the paper describes and Keel does not have: the flight"
        " modes, the cascade, the mixer, the black box, parameters, USB, the other sensors,"
        " and the hardware.",
    )


def levels(
    known: Mapping[str, Requirement],
    below: Mapping[str, list[Requirement]],
    state: Mapping[str, str],
) -> Table:
    """Each high-level requirement with those that serve it."""
    return Table(
        title="From high-level to low-level requirements",
        columns=("high-level", "title", "low-level", "state"),
        rows=tuple(
            (
                f"requirement:{uid}",
                one.of("TITLE"),
                " ".join(f"requirement:{low.uid}" for low in below[uid])
                or f"none; tests: {one.of('TESTS')}",
                state[uid],
            )
            for uid, one in known.items()
            if one.high
        ),
    )


def written(context: Context, problems: list[str]) -> dict[str, Path]:
    """The requirements as StrictDoc writes them."""
    try:
        return strictdoc.export(context.root, context.work, packages())
    except ToolError as error:
        problems.append(str(error).splitlines()[0])
        return {}


def make(context: Context) -> Part:
    """The part."""
    trouble: list[str] = []
    traced = read(context, trouble)
    known, state = traced.trace.requirements, traced.state
    if not trouble:  # Without a report all would be open.
        trouble += problems(known, traced.verdicts)
    files = written(context, trouble)
    if not known:
        trouble.append("specs/requirements: has no requirement")
    every = list(known.values())
    derived = "Derived requirements are given to the assessment of safety, with their reasons."
    return Part(
        name="requirements",
        title="Requirements",
        text=TEXT,
        summary={
            "high-level requirements": str(sum(one.high for one in every)),
            "low-level requirements": str(sum(not one.high for one in every)),
            **{
                f"{name}": str(list(state.values()).count(name))
                for name in ("good", "told", "open", "bad")
            },
        },
        tables=(
            documents(every, state),
            levels(known, traced.below, state),
            of_the_paper(every),
            listing("Departures from the paper", "DEPARTURE", every),
            listing("Derived requirements", "DERIVED", every, derived),
        ),
        items=tuple(item_of(one, traced) for one in every),
        files=files,
        problems=tuple(trouble),
    )
