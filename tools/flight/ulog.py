# SPDX-License-Identifier: Apache-2.0
"""Reads a log in ULog: formats, parameters, texts, dropouts, and each topic's data as an array."""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from common.errors import ToolError

MAGIC = bytes([0x55, 0x4C, 0x6F, 0x67, 0x01, 0x12, 0x35])
BEGIN, HEAD = 16, 3
KINDS = {"int8_t": "i1", "uint8_t": "u1", "int16_t": "<i2", "uint16_t": "<u2", "int32_t": "<i4",
         "uint32_t": "<u4", "int64_t": "<i8", "uint64_t": "<u8", "float": "<f4", "double": "<f8",
         "bool": "?", "char": "S1"}  # fmt: skip
FIELD = re.compile(r"(\w+?)(?:\[(\d+)\])? (\w+)$")
Topic = tuple[str, int]  # A name, and which of those with it.


@dataclass
class Log:
    """What a log has. Times are in us since power-up."""

    start_us: int
    data: dict[Topic, Any] = field(default_factory=dict)
    parameters: dict[str, float] = field(default_factory=dict)
    information: dict[str, str] = field(default_factory=dict)
    texts: list[tuple[int, str]] = field(default_factory=list)
    dropouts: list[tuple[int, int]] = field(default_factory=list)  # After which time; how many ms.
    cut: int = 0  # Bytes at its end that are no whole message.

    def topic(self, name: str, instance: int = 0) -> Any:
        """A topic's data, in order; `timestamp` and so on."""
        if (name, instance) not in self.data:
            raise ToolError(f"the log has no topic {name}, instance {instance}")
        return self.data[name, instance]


def layout(text: str) -> Any:
    """numpy's type for a format's fields."""
    names, formats = [], []
    for part in filter(None, text.split(";")):
        found = FIELD.match(part)
        if not found or found[1] not in KINDS:
            raise ToolError(f"a field that is not known: {part!r}")
        names.append(found[3])
        formats.append((KINDS[found[1]], (int(found[2]),)) if found[2] else KINDS[found[1]])
    return np.dtype({"names": names, "formats": formats}, align=False)


class Reader:
    """A log that is being read."""

    def __init__(self, content: bytes) -> None:
        self._formats: dict[str, Any] = {}
        self._topics: dict[int, Topic] = {}
        self._rows: dict[Topic, list[bytes]] = {}
        self._now_us = 0
        self.log = Log(struct.unpack_from("<Q", content, 8)[0])

    def take(self, kind: str, body: bytes) -> None:
        """A message."""
        if kind == "F":
            name, _, fields = body.decode().partition(":")
            self._formats[name] = layout(fields)
        elif kind == "A":
            name = body[3:].decode()
            self._topics[int.from_bytes(body[1:3], "little")] = (name, body[0])
            self._rows[name, body[0]] = []
        elif kind == "D":
            self._now_us = int.from_bytes(body[2:10], "little")
            self._rows[self._topics[int.from_bytes(body[:2], "little")]].append(body[2:])
        elif kind in "IP":
            self._take_key(body)
        elif kind == "L":
            self.log.texts.append((int.from_bytes(body[1:9], "little"), body[9:].decode()))
        elif kind == "O":
            self.log.dropouts.append((self._now_us, int.from_bytes(body[:2], "little")))

    def _take_key(self, body: bytes) -> None:
        """Information or a parameter."""
        kind, _, name = body[1 : 1 + body[0]].decode().partition(" ")
        value = body[1 + body[0] :]
        if kind in ("float", "int32_t"):
            self.log.parameters[name] = struct.unpack("<f" if kind == "float" else "<i", value)[0]
        else:
            self.log.information[name] = value.decode()

    def finish(self) -> Log:
        """What was read, each topic as one array."""
        for topic, rows in self._rows.items():
            kind = self._formats[topic[0]]
            self.log.data[topic] = np.frombuffer(b"".join(rows), dtype=kind)
        return self.log


def read(path: Path) -> Log:
    """Read a log. One that ends within a message, as after a power cut, is read up to there."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ToolError(f"{path}: {error.strerror}") from error
    if content[: len(MAGIC)] != MAGIC or len(content) < BEGIN:
        raise ToolError(f"{path}: is no log in ULog")
    reader, at = Reader(content), BEGIN
    while at + HEAD <= len(content):
        end = at + HEAD + int.from_bytes(content[at : at + 2], "little")
        if end > len(content):
            break
        try:
            reader.take(chr(content[at + 2]), content[at + HEAD : end])
        except (KeyError, ValueError, struct.error) as error:
            raise ToolError(f"{path}: byte {at}: {error}") from error
        at = end
    log = reader.finish()
    log.cut = len(content) - at
    return log
