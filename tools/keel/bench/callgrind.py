# SPDX-License-Identifier: Apache-2.0
"""Instructions of passes and steps in a host build, from what callgrind wrote."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from keel.base.errors import ToolError
from keel.bench.kinds import KINDS, Kind

# Functions whose instructions may be in a dump without being the layer's.
HARNESS_FUNCTION = re.compile(r"^(bench_\w+|main)(\.\w+)*$")


@dataclass
class Dump:
    """One dump: passes of one kind, and each function's own instructions in them."""

    kind: str
    passes: int
    own: Counter[str] = field(default_factory=Counter)


TRIGGER = re.compile(r"^desc: Trigger: Client Request: keel (\w+) (\d+)$")
COST = re.compile(r"^\d+ (\d+)$")


def read_dumps(lines: Iterable[str]) -> Iterator[Dump]:
    """The labelled dumps of a combined callgrind file without compressed names.

    The line behind a "calls=" line holds the cost of the called function, which is not its
    caller's own.
    """
    dump: Dump | None = None
    function = ""
    called = False
    for line in (line.rstrip("\n") for line in lines):
        if trigger := TRIGGER.match(line):
            dump = Dump(trigger[1], int(trigger[2]))
        elif line.startswith("part:"):
            if dump:
                yield dump
            dump = None
        elif line.startswith("fn="):
            function = line[len("fn=") :]
        elif line.startswith("calls="):
            called = True
        elif cost := COST.match(line):
            if dump and not called:
                dump.own[function] += int(cost[1])
            called = False
    if dump:
        yield dump


def kind_of(dump: Dump, layer: frozenset[str]) -> Kind:
    """The layer's part of a dump."""
    own = Counter({name: cost for name, cost in dump.own.items() if name in layer})
    cost = own.total()
    return Kind(dump.passes, cost, cost if dump.passes == 1 else 0, own)


def refuse_strangers(dump: Dump, layer: frozenset[str]) -> None:
    """No instruction may be lost: each belongs to the layer or to the harness."""
    for name, cost in dump.own.items():
        if cost and name not in layer and not HARNESS_FUNCTION.match(name):
            raise ToolError(f"{name} runs within a pass, but is neither the layer's nor ours")


def sum_dumps(
    dumps: Iterable[Dump], layer: frozenset[str], names: Iterable[str] = KINDS
) -> dict[str, Kind]:
    """The passes by kind."""
    kinds = {name: Kind() for name in names}
    for dump in dumps:
        if dump.kind not in kinds:
            raise ToolError(f"the harness names an unknown kind of pass: {dump.kind}")
        if dump.passes:
            refuse_strangers(dump, layer)
            kinds[dump.kind].add(kind_of(dump, layer))
    return kinds
