# SPDX-License-Identifier: Apache-2.0
"""Reads a log in ULog, of this copter or of PX4: each topic's data as an array, parameters, texts.

Not by pyulog, which the tests hold this beside: it does not say where a log is damaged, and a log
of a card may be. What a message is worth does not rest on its length alone: each kind is checked as
far as it can be, so that one that makes no sense costs itself and what it hides; reading goes on
where messages make sense again, and `Log.damage` tells the place.
"""

from __future__ import annotations

import itertools
import re
import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from keel.base.errors import ToolError

MAGIC = bytes([0x55, 0x4C, 0x6F, 0x67, 0x01, 0x12, 0x35])
SYNC = bytes([0x2F, 0x73, 0x13, 0x20, 0x25, 0x0C, 0xBB, 0x12])
BEGIN, HEAD = 16, 3
LARGEST = 65535 - 2  # Of a sample: what a message's length can say, less its topic.
DEEPEST = 16  # Formats in formats.
APPENDED, KNOWN_FLAGS = 1, 1  # Of the flags that a reader must know.
KINDS = {
    "int8_t": "i1",
    "uint8_t": "u1",
    "int16_t": "<i2",
    "uint16_t": "<u2",
    "int32_t": "<i4",
    "uint32_t": "<u4",
    "int64_t": "<i8",
    "uint64_t": "<u8",
    "float": "<f4",
    "double": "<f8",
    "bool": "?",
    "char": "S1",
}
FORMAT = re.compile(r"([\w/-]+):((?:\w+(?:\[\d+\])? \w+;)*\w+(?:\[\d+\])? \w+);?", re.ASCII)
FIELD = re.compile(r"(\w+)(?:\[(\d+)\])? (\w+)", re.ASCII)
KEY = re.compile(r"(\w+)(?:\[(\d+)\])? ([!-~]+)", re.ASCII)
LETTER = re.compile(rb"[ACDFILMOPQRS]")  # That a message's kind may be.
Topic = tuple[str, int]  # A name, and which of those with it.
Step = Callable[[], object]  # What a message that makes sense changes.


class Nonsense(Exception):
    """A message makes none; the reason."""


class WrongLength(Nonsense):
    """Its length does not go with what it is, so it need not end there."""


class TooLong(WrongLength):
    """Nor can it: the file was cut off, or its length is wrong."""


class Text(NamedTuple):
    """What was said."""

    time_us: int
    text: str
    level: str = "6"  # As syslog's, in ASCII.
    tag: int | None = None  # Of which source, if it says so.


class Damage(NamedTuple):
    """A part of the file that was left out."""

    at: int  # Bytes from its begin.
    size: int
    reason: str


@dataclass
class Log:
    """What a log has. Times are in us since power-up."""

    start_us: int
    data: dict[Topic, Any] = field(default_factory=dict)
    parameters: dict[str, Any] = field(default_factory=dict)  # At the start.
    changed: list[tuple[int, str, Any]] = field(default_factory=list)  # When, which, to what.
    defaults: dict[int, dict[str, Any]] = field(default_factory=dict)  # By the bit of their kind.
    information: dict[str, Any] = field(default_factory=dict)
    lists: dict[str, list[list[Any]]] = field(default_factory=dict)  # Information in many parts.
    texts: list[Text] = field(default_factory=list)
    dropouts: list[tuple[int, int]] = field(default_factory=list)  # After which time; how many ms.
    damage: list[Damage] = field(default_factory=list)
    cut: int = 0  # Bytes at its end, or before what was appended, that are no whole message.

    def topic(self, name: str, instance: int = 0) -> Any:
        """A topic's data, in order; `timestamp` and so on."""
        if (name, instance) not in self.data:
            raise ToolError(f"the log has no topic {name}, instance {instance}")
        return self.data[name, instance]


class Layout(NamedTuple):
    """How a topic's samples lie in messages."""

    kind: Any  # numpy's type, without what only fills up its end.
    most: int  # Bytes with that, which a message has as a whole or not at all.


class Column(NamedTuple):
    """Where a topic's samples go."""

    topic: Topic
    layout: Layout
    rows: list[bytes]


def value_of(kind: str, count: str | None, data: bytes) -> Any:
    """A number, a text, bytes, or a list of numbers."""
    if kind not in KINDS:
        raise Nonsense(f"a value of type {kind!r}, which is not known")
    if len(data) != np.dtype(KINDS[kind]).itemsize * int(count or 1):
        raise WrongLength(f"a value of type {kind} in {len(data)} bytes")
    if kind == "char":
        return data.decode(errors="replace")
    if kind == "uint8_t" and count:
        return data
    values = np.frombuffer(data, KINDS[kind]).tolist()
    return values if count else values[0]


def keyed(body: bytes) -> tuple[str, Any]:
    """The name and the value that a message has behind a length."""
    key, data = body[1 : 1 + body[0]], body[1 + body[0] :]
    found = KEY.fullmatch(key.decode())
    if not found or len(key) < body[0]:
        raise Nonsense(f"a key that is none: {key!r}")
    return found[3], value_of(found[1], found[2], data)


def text_of(data: bytes) -> str:
    """Another message in it has a byte of 0, which no text has."""
    text = data.rstrip(b"\0")
    if b"\0" in text:
        raise WrongLength("a text with a byte of 0")
    return text.decode(errors="replace")


def level_of(byte: int) -> str:
    """One of syslog's eight."""
    if chr(byte) not in "01234567":
        raise Nonsense(f"a text of level {byte}")
    return chr(byte)


class Reader:
    """A log that is being read. What a message of a kind means is said by `_kind`, which changes
    nothing, but returns what to do: so it can be asked as well whether something is a message."""

    def __init__(self, content: bytes) -> None:
        self._content = content
        self._formats: dict[str, list[tuple[str, str, str]]] = {}
        self._topics: dict[int, Column] = {}
        self._columns: dict[Topic, Column] = {}
        self._now_us = 0
        self._has_begun = False  # The data have; parameters are changed from here on.
        self.log = Log(struct.unpack_from("<Q", content, 8)[0])
        self._means: dict[str, Callable[[bytes], Step]] = {
            "A": self._topic,
            "C": self._tagged,
            "D": self._data,
            "F": self._format,
            "I": self._information,
            "L": self._text,
            "M": self._list,
            "O": self._dropout,
            "P": self._parameter,
            "Q": self._default,
            "R": self._end,
            "S": self._sync,
        }

    def _step(self, kind: str, body: bytes) -> Step:
        if kind not in self._means:
            raise Nonsense(f"a message of kind {kind!r}, which is not known here")
        try:
            return self._means[kind](body)
        except (IndexError, ValueError, struct.error) as error:
            raise Nonsense(f"a message of kind {kind} that cannot be: {error}") from error

    def _format(self, body: bytes) -> Step:
        found = FORMAT.fullmatch(body.decode())
        if not found:
            raise Nonsense("a format that is none")
        fields = [FIELD.fullmatch(part) for part in found[2].split(";")]
        known = [(one[1], one[2], one[3]) for one in fields if one]
        return lambda: self._formats.update({found[1]: known})

    def _numpy(self, name: str, within: tuple[str, ...] = ()) -> list[Any]:
        """The fields of a format, those that have a format themselves with theirs."""
        if name not in self._formats:
            raise Nonsense(f"the format {name} is not there")
        if len(within) == DEEPEST:
            raise Nonsense(f"the format {name} lies too deep in others, or in itself")
        fields: list[Any] = []
        for kind, count, field_name in self._formats[name]:
            one = KINDS.get(kind) or np.dtype(self._numpy(kind, (*within, name)))
            if np.dtype(one).itemsize * int(count or 1) not in range(1, LARGEST + 1):
                raise Nonsense(f"the format {name} has a field of no size, or too large")
            fields.append((field_name, one, (int(count),)) if count else (field_name, one))
        return fields

    def _layout(self, name: str) -> Layout:
        fields = self._numpy(name)
        most = np.dtype(fields).itemsize
        while fields and fields[-1][0].startswith("_padding"):
            fields.pop()
        if not fields or most > LARGEST:
            raise Nonsense(f"the format {name} has nothing, or too much")
        return Layout(np.dtype(fields), most)

    def _topic(self, body: bytes) -> Step:
        instance, number, name = body[0], int.from_bytes(body[1:3], "little"), body[3:].decode()
        topic, layout = (name, instance), self._layout(name)
        column = self._columns.get(topic) or Column(topic, layout, [])
        if column.layout != layout:
            raise Nonsense(f"the topic {name} once more, with another format")

        def step() -> None:
            self._has_begun = True
            self._topics[number] = self._columns[topic] = column

        return step

    def _end(self, body: bytes) -> Step:
        number = struct.unpack("<H", body)[0]
        if number not in self._topics:
            raise Nonsense(f"the end of topic {number}, which has not begun")
        return lambda: self._topics.pop(number)

    def _data(self, body: bytes) -> Step:
        number = int.from_bytes(body[:2], "little")
        if number not in self._topics:
            raise Nonsense(f"data of topic {number}, which has not begun")
        column = self._topics[number]
        kind, most = column.layout
        if len(body) - 2 not in (kind.itemsize, most):
            raise WrongLength(
                f"{len(body) - 2} bytes of {column.topic[0]}, which has {kind.itemsize}"
            )
        row = body[2 : 2 + kind.itemsize]

        def step() -> None:
            column.rows.append(row)
            if "timestamp" in kind.fields:
                part, at = kind.fields["timestamp"][:2]
                time_us = int.from_bytes(row[at : at + part.itemsize], "little")
                self._now_us = max(self._now_us, time_us)

        return step

    def _information(self, body: bytes) -> Step:
        name, value = keyed(body)
        return lambda: self.log.information.update({name: value})

    def _list(self, body: bytes) -> Step:
        name, value = keyed(body[1:])
        if body[0] > 1:
            raise Nonsense("information that is neither the first of its kind nor a later one")
        lists = self.log.lists

        def step() -> None:
            if body[0] and name in lists:
                lists[name][-1].append(value)
            else:
                lists.setdefault(name, []).append([value])

        return step

    def _parameter(self, body: bytes) -> Step:
        name, value = keyed(body)

        def step() -> None:
            if self._has_begun:
                self.log.changed.append((self._now_us, name, value))
            else:
                self.log.parameters[name] = value

        return step

    def _default(self, body: bytes) -> Step:
        name, value = keyed(body[1:])
        bits = [bit for bit in range(8) if body[0] >> bit & 1]

        def step() -> None:
            for bit in bits:
                self.log.defaults.setdefault(bit, {})[name] = value

        return step

    def _say(self, text: Text) -> None:
        self._has_begun = True
        self.log.texts.append(text)

    def _text(self, body: bytes) -> Step:
        level, time_us = struct.unpack_from("<BQ", body)
        text = Text(time_us, text_of(body[9:]), level_of(level))
        return lambda: self._say(text)

    def _tagged(self, body: bytes) -> Step:
        level, tag, time_us = struct.unpack_from("<BHQ", body)
        text = Text(time_us, text_of(body[11:]), level_of(level), tag)
        return lambda: self._say(text)

    def _dropout(self, body: bytes) -> Step:
        length_ms = struct.unpack("<H", body)[0]
        return lambda: self.log.dropouts.append((self._now_us, length_ms))

    def _sync(self, body: bytes) -> Step:
        if body != SYNC:
            raise Nonsense("a mark to synchronise by that is none")
        return lambda: None

    def _whole(self, at: int, end: int) -> tuple[Step, int]:
        """What the message here changes, and where it ends."""
        size = int.from_bytes(self._content[at : at + 2], "little")
        stop = at + HEAD + size
        if at + HEAD > end or stop > end:
            raise TooLong("a message that is longer than the rest")
        return self._step(chr(self._content[at + 2]), self._content[at + HEAD : stop]), stop

    def _makes_sense(self, at: int, end: int) -> bool:
        """Whether there is a message here, or nothing behind the last."""
        try:
            return at == end or bool(self._whole(at, end))
        except Nonsense:
            return False

    def _resume(self, at: int, end: int, error: Nonsense) -> int | None:
        """Where messages make sense again: behind this one, if its length may be right and there is
        one, or where two are in a row."""
        stop = at + HEAD + int.from_bytes(self._content[at : at + 2], "little")
        if not isinstance(error, WrongLength) and stop < end and self._makes_sense(stop, end):
            return stop
        for found in LETTER.finditer(self._content, at + HEAD, end):
            try:
                if self._makes_sense(self._whole(found.start() - 2, end)[1], end):
                    return found.start() - 2
            except Nonsense:
                continue
        return None

    def read(self, at: int, end: int) -> None:
        """The messages of a part of the file."""
        while at < end:
            try:
                step, stop = self._whole(at, end)
                step()
            except Nonsense as error:
                found = self._resume(at, end, error)
                if found is None and isinstance(error, TooLong):
                    self.log.cut += end - at
                    return
                stop = end if found is None else found
                self.log.damage.append(Damage(at, stop - at, str(error)))
            at = stop

    def finish(self) -> Log:
        """What was read, each topic as one array."""
        for topic, column in self._columns.items():
            self.log.data[topic] = np.frombuffer(b"".join(column.rows), column.layout.kind)
        return self.log


def parts_of(content: bytes) -> list[int]:
    """Where the file's parts begin, and its end: what was appended begins one, whatever is before.
    Raises Nonsense when the log has something that a reader must know and this one does not."""
    size = int.from_bytes(content[BEGIN : BEGIN + 2], "little")
    begin = BEGIN + HEAD + size
    if content[BEGIN + 2 : BEGIN + 3] != b"B" or size < 40 or begin > len(content):
        return [BEGIN, len(content)]
    musts = content[BEGIN + HEAD + 8 : BEGIN + HEAD + 16]
    if musts[0] & ~KNOWN_FLAGS or any(musts[1:]):
        raise Nonsense(
            f"byte {BEGIN + HEAD + 8}: the flags {musts.hex(' ')} ask for a reader that "
            "knows more than this one"
        )
    offsets = struct.unpack_from("<QQQ", content, BEGIN + HEAD + 16) if musts[0] & APPENDED else ()
    return [begin, *sorted(each for each in offsets if begin < each < len(content)), len(content)]


def read(path: Path) -> Log:
    """Read a log. One that ends within a message, as after a power cut, is read up to there."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ToolError(f"{path}: {error.strerror}") from error
    if content[: len(MAGIC)] != MAGIC or len(content) < BEGIN:
        raise ToolError(f"{path}: is no log in ULog")
    try:
        parts = parts_of(content)
    except Nonsense as error:
        raise ToolError(f"{path}: {error}") from error
    reader = Reader(content)
    for begin, end in itertools.pairwise(parts):
        reader.read(begin, end)
    return reader.finish()
