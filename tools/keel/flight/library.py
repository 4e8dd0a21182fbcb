# SPDX-License-Identifier: Apache-2.0
"""The copter as a shared library: built, loaded, and its memory seen through numpy.

What may be called stands in examples/copter_in_plant/sim.h, and is read from there: a field that is
added needs no change here. There is one copter in a process.
"""

from __future__ import annotations

import functools
import hashlib
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cffi
import numpy as np

from keel.base.build import Build
from keel.base.errors import ROOT, ToolError
from keel.base.files import read_text
from keel.flight.board_tasks import BoardTask
from keel.install import Toolchain

SIM = "examples/copter_in_plant/sim.h"
MODE = "include/keel/flight/mode.h"
SETTINGS = "examples/copter/settings.h"
FLAGS = (
    "-std=c99",
    "-O2",
    "-fPIC",
    "-ffp-contract=off",
    "-Wall",
    "-Wextra",
    "-Iinclude",
    "-Ibsp",
    "-Iexamples/urpilot",
    "-Iexamples/copter",
    "-Iexamples/copter_in_plant",
)
SOURCES = (
    "src",
    "examples/urpilot/urpilot_tasks.c",
    "bsp/common/slots.c",
    "bsp/common/task_table.c",
    "bsp/common/trace.c",
    "bsp/common/trace_log.c",
    "bsp/host/host_board.c",
)
FOLDERS = ("examples/copter", "examples/copter_in_plant")  # Without what lies below them.
NAME = "libcopter.so"
LINE_BYTES = 4096  # At most so many wait in a link.
KINDS = {"float": "<f4", "uint32_t": "<u4", "int32_t": "<i4", "int16_t": "<i2", "uint16_t": "<u2"}


def sources(root: Path = ROOT) -> list[str]:
    """What the library is made of."""
    own = [
        path.relative_to(root).as_posix()
        for folder in FOLDERS
        for path in sorted((root / folder).glob("*.c"))
    ]
    return [*SOURCES, *own]


def build(tools: Toolchain, folder: Path, width: int = 2, more: Sequence[str] = ()) -> Path:
    """The library, made anew of what is there now, with more flags."""
    make = Build(tools, "gcc", [*FLAGS, *more], folder, link_flags=("-shared", *more))
    return make.link(NAME, make.objects(sources(), width=width), ("-lm",))


def digest_of(root: Path = ROOT) -> str:
    """SHA-256 of everything in C that a flight depends on."""
    total = hashlib.sha256(" ".join(FLAGS).encode())
    for name in ("src", "include", "bsp/common", "bsp/host", "examples/urpilot", *FOLDERS):
        for path in sorted((root / name).rglob("*.[ch]")):
            total.update(path.relative_to(root).as_posix().encode())
            total.update(path.read_bytes())
    return total.hexdigest()


def declarations(text: str) -> str:
    """A header as cffi reads it: without comments, and of the preprocessor's lines only numbers."""
    plain = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    lines = [
        line
        for line in plain.splitlines()
        if not line.startswith("#") or re.match(r"#define\s+\w+\s+\d+\s*$", line)
    ]
    return "\n".join(lines)


def layout(kind: Any) -> Any:
    """numpy's type for a type of C."""
    if kind.kind == "array":
        return layout(kind.item), (kind.length,)
    if kind.kind == "primitive":
        return KINDS[kind.cname]
    names = [name for name, _ in kind.fields]
    return {
        "names": names,
        "formats": [layout(item.type) for _, item in kind.fields],
        "offsets": [item.offset for _, item in kind.fields],
        "itemsize": kind_size(kind),
    }


def kind_size(kind: Any) -> int:
    """Bytes of a structure whose members are words."""
    last = kind.fields[-1][1]
    return int(last.offset) + int(np.dtype(layout(last.type)).itemsize)


def declared(headers: Sequence[str] = (SIM,)) -> Any:
    """cffi with all that headers have."""
    ffi = cffi.FFI()
    for header in headers:
        ffi.cdef(declarations(read_text(ROOT / header)))
    return ffi


# Why sim_set does not take a parameter.
REFUSED = (
    "",
    "there is no such parameter",
    "it is not of its type, or out of its range",
    "it contradicts another",
    "it could not be kept",
)


# Why the host's copter does not fly a scenario.
NO_BOARD = "fault {} is a board's own, which the host's copter does not have: BOARD=fmuv5 flies it"


@dataclass(frozen=True)
class Link:
    """A link of the copter's telemetry."""

    bytes_per_s: int = 20_000
    commands: bool = True  # What comes by it may arm, and set modes and parameters.


@dataclass(frozen=True)
class Key:
    """What frames of telemetry are signed with."""

    key: bytes  # 32 of them.
    timestamp: int  # In 10 us since 2015 began (UTC): a minute later than any frame was signed.


class Copter:
    """The library in this process."""

    headers: Sequence[str] = (SIM,)  # Of what may be called.
    has_board = False
    boot_us = 0  # From power-up to the first turn, of the host's copter: a board takes its own.

    def __init__(self, path: Path) -> None:
        self._ffi = declared(self.headers)
        try:
            self._library: Any = self._ffi.dlopen(str(path))
        except OSError as error:
            raise ToolError(f"{path}: {error}") from error
        self.view_type = np.dtype(layout(self._ffi.typeof("sim_view_t")))
        self.sensors: Any = self._memory(self._library.sim_sensors(), "sim_sensors_t")
        self.run_until: Any = self._library.sim_run_until
        self.look: Any = self._library.sim_view
        pointer = self.look()
        self.view: Any = self._memory(pointer, "sim_view_t")
        self.view_bytes: Any = self._ffi.buffer(pointer, self.view_type.itemsize)
        self.motor: Any = self.view["motor"]
        count = int(self._library.SIM_TASKS)
        kind = np.dtype(layout(self._ffi.typeof("sim_task_t")))
        done = self._ffi.buffer(self._library.sim_tasks(), count * kind.itemsize)
        self._bytes: Any = self._ffi.new("uint8_t[]", LINE_BYTES)
        self._hash = self._ffi.callback("sim_hash_t", self._sha256)
        self.links = int(self._library.SIM_LINKS)
        self._trace = False  # Whether the next flight's log has each run of a task.
        self._done: Any = np.frombuffer(done, dtype=kind)
        self.tasks = [
            self._ffi.string(self._library.sim_task_name(number)).decode()
            for number in range(count)
        ]

    def _memory(self, pointer: Any, name: str) -> Any:
        """A structure as numpy sees it, in place."""
        kind = np.dtype(layout(self._ffi.typeof(name)))
        if kind.itemsize != self._ffi.sizeof(name):
            raise ToolError(f"{SIM}: {name} is not made of words alone")
        return np.frombuffer(self._ffi.buffer(pointer, kind.itemsize), dtype=kind)[0]

    def log(self, path: Path | None, trace: bool = False) -> None:
        """Where the next flight's log goes, with each run of a task or without; what was open is
        closed."""
        self._trace = trace
        if self._library.sim_log(str(path or "").encode()):
            raise ToolError("the flight's log could not be written")

    def start(
        self,
        costs_percent: int,
        plain_mean: bool,
        links: Sequence[Link] = (),
        key: Key | None = None,
        memory: Path | None = None,
        imus: int = 3,
    ) -> None:
        """Power up; all devices are silent and zero."""
        size = self.sensors.dtype.itemsize
        self._ffi.memmove(self._library.sim_sensors(), bytes(size), size)
        options = self._ffi.new("sim_options_t *")
        options.costs_percent, options.plain_mean = costs_percent, int(plain_mean)
        options.imus, options.trace = imus, int(self._trace)
        options.boot_us = self.boot_us
        for number, link in enumerate(links):
            options.bytes_per_s[number] = link.bytes_per_s
            options.listens[number] = int(not link.commands)
        if memory is not None:
            self._memory_name = options.memory = self._ffi.new("char[]", str(memory).encode())
        if key is not None:
            options.key, options.hash = key.key, self._hash
            options.timestamp = key.timestamp
        if status := self._library.sim_start(options):
            raise ToolError(f"the copter does not start: status {status}")
        self.look()

    def hear(self, radio: str) -> None:
        """How the pilot's receiver sends: the host's copter sees bytes, not their bits."""

    def why(self, status: int) -> str:
        """Why it did not go on."""
        return f"the scheduler refused to go on: status {status}"

    def set(self, name: str, value: float) -> None:
        """Set a parameter, which the memory keeps for the next start."""
        if status := int(self._library.sim_set(name.encode(), float(value))):
            raise ToolError(f"parameters: {name} = {value:g}: {REFUSED[status]}")

    def _sha256(self, data: Any, size: int, digest: Any) -> None:
        """As C calls it."""
        self._ffi.memmove(digest, hashlib.sha256(bytes(self._ffi.buffer(data, size))).digest(), 32)

    def done(self) -> Any:
        """What became of each task until now."""
        self._library.sim_tasks()
        return self._done.copy()

    def timed(self) -> list[BoardTask]:
        """How long each task took at most: here none takes another time than it declares."""
        return []

    def console(self, typed: str) -> str:
        """What the copter answers to a command; what is no character of ASCII is none here."""
        text = self._library.sim_console(typed.encode("ascii", "replace"))
        return str(self._ffi.string(text).decode())

    def overrun(self, task: int, runs: int, extra_us: int) -> None:
        """Make a task's next runs longer."""
        self._library.sim_overrun(task, runs, extra_us)

    def breaks(self, fault: str, which: int, amount: int, on: bool) -> None:
        """Break something of the board, or mend it."""
        raise ToolError(NO_BOARD.format(fault))

    def edges(self) -> Any:
        """Each change of the board's outputs; None: there is no board."""
        return None

    def send(self, link: int, data: bytes) -> int:
        """Bytes for the copter, by a link of telemetry; tells how many it has room for."""
        return int(self._library.sim_link_send(link, data, len(data)))

    def receive(self, link: int) -> bytes:
        """What the copter sent by a link of telemetry since."""
        size = int(self._library.sim_link_receive(link, self._bytes, len(self._bytes)))
        return bytes(self._ffi.buffer(self._bytes, size))

    def mode_channel(self, mode: int) -> int:
        """Where the mode switch must stand."""
        return int(self._library.sim_mode_channel(mode))


@functools.cache
def numbered(prefix: str, kind: str = "u", header: str = MODE) -> dict[str, int]:
    """Constants of a header in lower case, without their prefix: angle is 2."""
    text = read_text(ROOT / header)
    found = re.findall(rf"#define {prefix}(\w+)\s+(0x[0-9A-Fa-f]+|\d+){kind}", text)
    return {name.lower(): int(value, 0) for name, value in found}


@functools.cache
def mode_header() -> str:
    """Where states and modes have their numbers."""
    return read_text(ROOT / MODE)


def states() -> list[str]:
    """The states' names, by their numbers."""
    return named("States")


def modes() -> list[str]:
    """The modes' names, by their numbers."""
    return named("Modes")


def named(group: str) -> list[str]:
    """A group of consecutive numbers of mode.h."""
    found = re.findall(r"#define KEEL_MODE_(\w+)\s+\d+u /\*\*", lines_of(f"{group}."))
    return [name.lower() for name in found]


def lines_of(group: str) -> str:
    """What mode.h says between the beginning of a group, by its first words, and its end."""
    return mode_header().partition(f"@name {group}")[2].partition("/** @} */")[0]


def checks_of(bits: int) -> Sequence[str]:
    """What stands in the way of arming, in words."""
    known = {**numbered("KEEL_MODE_CHECK_"), **numbered("COPTER_CHECK_", header=SETTINGS)}
    return [name for name, bit in known.items() if bits & bit]


def facts_of(bits: int) -> Sequence[str]:
    """The same for facts."""
    part = lines_of("Facts of the pilot:") + lines_of("Facts of the aircraft:")
    known = re.findall(r"#define KEEL_MODE_(\w+)\s+(0x[0-9A-Fa-f]+)u /\*\*", part)
    return [name.lower() for name, bit in known if bits & int(bit, 0)]
