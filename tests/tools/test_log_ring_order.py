# SPDX-License-Identifier: Apache-2.0
"""The log's ring in the memory model of C11: a small ring, every execution of a few calls.

The calls are what proofs/log_ring/*__order_harness.c show of the code: the other side's index is
loaded once, then bytes are written or read, then the own index is stored once. A load may see any
store that is not older than what its thread has seen; a load with acquire that sees a store with
release knows all that the other thread did before that (C11, 5.1.2.4). Two accesses to a byte, one
of them a write, of which neither is known to be before the other, are a data race.
"""

from __future__ import annotations

import unittest
from dataclasses import dataclass, replace

PLACES = 3  # Of the ring, one of which stays free.
WRITTEN = (1, 2, 1, 2, 2, 1)  # Bytes of each record.
READ = (1, 2, 1, 2, 2)  # The most that each call of the reader takes.
WRITER, READER = 0, 1
Clock = tuple[int, int]


@dataclass(frozen=True)
class Rules:
    """What is told of the order, all as it should be."""

    writer_acquires: bool = True
    writer_releases: bool = True
    reader_acquires: bool = True
    reader_releases: bool = True
    head_last: bool = True
    tail_last: bool = True


@dataclass(frozen=True)
class Byte:
    """A place of the buffer, and when each side was there last, by its own clock."""

    value: int = -1
    write: int = 0
    read: int = 0


@dataclass(frozen=True)
class Side:
    """A thread: what it knows, what it does next in this call, and its calls to come."""

    clock: Clock
    calls: tuple[int, ...]
    own: int = 0  # All bytes that it wrote, or read, ever.
    seen: int = 0  # Which store of the other's index it saw last.
    steps: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True)
class State:
    """Both sides, all stores of each side's index (its value, and what a release tells)."""

    sides: tuple[Side, Side]
    stores: tuple[tuple[tuple[int, Clock], ...], ...] = (((0, (0, 0)),), ((0, (0, 0)),))
    buffer: tuple[Byte, ...] = (Byte(),) * PLACES


class Wrong(Exception):
    """A data race, or a byte that is not the one that was written."""


def begin(side: Side, who: int, other: int, rules: Rules) -> Side:
    """The accesses of a call behind its load, now that the other's index is known."""
    asked, calls = side.calls[0], side.calls[1:]
    if who == WRITER:
        count = asked if (side.own + asked - other) < PLACES else 0
        last = rules.head_last
    else:
        count = min(asked, other - side.own)
        last = rules.tail_last
    bytes_ = tuple(("byte", side.own + i) for i in range(count))
    store = (("store", side.own + count),) if count else ()
    return replace(side, calls=calls, steps=(*bytes_, *store) if last else (*store, *bytes_))


def loads(state: State, who: int, rules: Rules) -> list[Side]:
    """What a side may know behind its load: one for each store that it may see."""
    side, stores = state.sides[who], state.stores[1 - who]
    acquires = rules.writer_acquires if who == WRITER else rules.reader_acquires
    found = []
    for at in range(side.seen, len(stores)):
        value, told = stores[at]
        first, second = (max(side.clock[i], told[i] if acquires else 0) for i in (WRITER, READER))
        found.append(begin(replace(side, clock=(first, second), seen=at), who, value, rules))
    return found


def access(state: State, who: int, number: int) -> State:
    """A byte is written or read."""
    side, place = state.sides[who], number % PLACES
    byte, clock = state.buffer[place], state.sides[who].clock
    if who == WRITER:
        if byte.read > clock[READER]:
            raise Wrong(f"byte {number} is written while it is read")
        byte = replace(byte, value=number, write=clock[WRITER])
    else:
        if byte.write > clock[WRITER]:
            raise Wrong(f"byte {number} is read while it is written")
        if byte.value != number:
            raise Wrong(f"byte {number} is taken, and is {byte.value}")
        byte = replace(byte, read=clock[READER])
    buffer = (*state.buffer[:place], byte, *state.buffer[place + 1 :])
    return with_side(replace(state, buffer=buffer), who, replace(side, steps=side.steps[1:]))


def store(state: State, who: int, value: int, rules: Rules) -> State:
    """An index is handed over, and with release all that was done before."""
    side = state.sides[who]
    releases = rules.writer_releases if who == WRITER else rules.reader_releases
    told = side.clock if releases else (0, 0)
    stores = list(state.stores)
    stores[who] = (*stores[who], (value, told))
    now = list(side.clock)
    now[who] += 1
    side = replace(side, own=value, steps=side.steps[1:], clock=(now[0], now[1]))
    return with_side(replace(state, stores=tuple(stores)), who, side)


def with_side(state: State, who: int, side: Side) -> State:
    """The state with another side."""
    sides = (side, state.sides[READER]) if who == WRITER else (state.sides[WRITER], side)
    return replace(state, sides=sides)


def after(state: State, rules: Rules) -> list[State]:
    """All states one access later."""
    found = []
    for who in (WRITER, READER):
        side = state.sides[who]
        if side.steps:
            kind, number = side.steps[0]
            if kind == "byte":
                found.append(access(state, who, number))
            else:
                found.append(store(state, who, number, rules))
        elif side.calls:
            found += [with_side(state, who, known) for known in loads(state, who, rules)]
    return found


def explore(rules: Rules) -> tuple[int, int]:
    """How many states there are, and the most bytes that are taken in the end."""
    start = State((Side((1, 0), WRITTEN), Side((0, 1), READ)))
    seen, waiting, most = {start}, [start], 0
    while waiting:
        state = waiting.pop()
        most = max(most, state.sides[READER].own)
        for one in after(state, rules):
            if one not in seen:
                seen.add(one)
                waiting.append(one)
    return len(seen), most


class Order(unittest.TestCase):
    """In every execution."""

    def test_bytes_cross_without_a_race(self) -> None:
        states, most = explore(Rules())
        self.assertGreater(states, 500)
        self.assertEqual(most, sum(READ), "each place was used, and used again")

    def test_each_rule_is_needed(self) -> None:
        for rule, complaint in (
            ("writer_acquires", "is written while"),
            ("writer_releases", "is read while"),
            ("reader_acquires", "is read while"),
            ("reader_releases", "is written while"),
            ("head_last", "byte 0 is "),
            ("tail_last", "byte"),
        ):
            with self.subTest(rule), self.assertRaisesRegex(Wrong, complaint):
                explore(Rules(**{rule: False}))
