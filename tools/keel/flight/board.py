# SPDX-License-Identifier: Apache-2.0
"""The copter of a board: its very image on a model of the chip, in the place of the host's library.

The library has what sim.h declares, so that whoever flies the host's copter flies this one, too. It
is told where the image has what the view shows: by the debugger's information, once.
"""

from __future__ import annotations

import json
import mmap
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from keel.base.build import Build
from keel.base.errors import ROOT, ToolError, unknown
from keel.base.files import write_bytes, write_json
from keel.boards import firmware
from keel.boards.board import application_of, read_board
from keel.boards.built import read_built
from keel.boards.dwarf import Place, Variables
from keel.boards.elf import read_contents
from keel.flight import card, library
from keel.flight.board_tasks import BoardTask, BoardTasks
from keel.flight.library import SIM, Copter, Key, Link
from keel.install import Toolchain

BOARDS = {"fmuv5": 2}  # With so many inertial units.
APPLICATION = "copter"
FOLDER = "bsp/model"
HEADER = f"{FOLDER}/board_in_plant.h"
LIBRARY = "libboard.so"
IMAGE = "image.json"  # Beside the library: what it is to load.
HOSTS = ("examples/copter_in_plant/sim.c", "bsp/host/host_board.c")  # Not of this library.
MAIN, TASKS = "examples/copter_on_board/main.c", "examples/copter/copter.c"

# How receivers send their bytes: baud, even parity, two stop bits, inverted.
BITS = {"sbus": (100_000, 1, 1, 1), "crsf": (416_666, 0, 0, 0), "ibus": (115_200, 0, 0, 0)}

# Where the copter has what the view shows: as examples/copter_in_plant/sim.c copies it.
SHOWN = {
    "state": "state.mode.state",
    "mode": "state.mode.mode",
    "motors_on": "state.mode.motors",
    "cause": "state.mode.cause",
    "blocking_checks": "state.mode.blocking.checks",
    "blocking_facts": "state.mode.blocking.facts",
    "phase": "imu.attitude.phase",
    "heading_valid": "imu.attitude.heading_valid",
    "attitude_flags": "imu.attitude.flags",
    "place_quality": "estimate.position.quality",
    "height_quality": "estimate.altitude.axis.quality",
    "limited": "control.mixer.limited",
    "battery_level": "power.battery.level",
    "battery_left": "power.battery.remaining",
    "load_ppm": "health.load_ppm",
}
VECTORS = {
    "quaternion": ("imu.attitude.quaternion", "wxyz"),
    "bias": ("imu.attitude.bias", "xyz"),
    "rate": ("imu.attitude.rate", "xyz"),
    "position": ("estimate.here.position", ("north", "east", "up")),
    "velocity": ("estimate.here.velocity", ("north", "east", "up")),
    "asked_place": ("control.place", ("north", "east", "up")),
    "asked_velocity": ("control.asked", ("north", "east", "up")),
    "command": ("control.cascade.command", ("roll", "pitch", "yaw", "thrust")),
}
ARRAYS = {
    "vote": ("imu.virtual_imu.channel[{}].vote.output", 6),
    "vote_state": ("imu.virtual_imu.channel[{}].vote.state", 6),
    "used": ("imu.virtual_imu.used[{}]", 3),
    "latched": ("imu.virtual_imu.latched[{}]", 3),
}
SETPOINTS = {"asked_tilt": ("roll", "pitch"), "asked_rate": ("roll_rate", "pitch_rate", "yaw_rate")}
CASCADE = "include/keel/flight/cascade.h"


def shown() -> Iterator[tuple[str, int, str]]:
    """Each number of the view: its field, its place there, and where the copter has it."""
    for field, path in SHOWN.items():
        yield field, 0, path
    for field, (path, names) in VECTORS.items():
        for index, name in enumerate(names):
            yield field, index, f"{path}.{name}"
    for field, (path, count) in ARRAYS.items():
        for index in range(count):
            yield field, index, path.format(index)
    axes = library.numbered("KEEL_CASCADE_", header=CASCADE)
    for field, names in SETPOINTS.items():
        for index, name in enumerate(names):
            yield field, index, f"control.cascade.axis[{axes[name]}].pid.setpoint"


def build(tools: Toolchain, name: str, folder: Path, root: Path = ROOT) -> Path:
    """A board's image, and the library that flies it, made anew of what is there now."""
    if name not in BOARDS:
        raise ToolError(unknown("board with a model that flies", name, BOARDS))
    tools.ensure("firmware", "fatfs", "model")
    named = application_of(read_board(root, name), APPLICATION)
    firmware.build(tools, name, named.application, root, "fatfs" in named.libraries)
    return pack(tools, name, folder, root)


def pack(tools: Toolchain, name: str, folder: Path, root: Path = ROOT) -> Path:
    """The library that flies the image that was built, which it is told."""
    image = read_built(root, name)
    told = {"elf": str(image.elf), "binary": str(image.binary), "address": image.address}
    write_json(folder / IMAGE, {"board": name, **told})
    return link(tools, folder)


def link(tools: Toolchain, folder: Path) -> Path:
    """The library alone."""
    unicorn = Path(tools.command("unicorn")[0], "unicorn")
    flags = [*library.FLAGS, f"-I{FOLDER}", "-isystem", str(unicorn / "include")]
    make = Build(tools, "gcc", flags, folder, link_flags=("-shared", "-Wl,-Bsymbolic"))
    own = [source for source in library.sources() if source not in HOSTS]
    words = (str(unicorn / "lib/libunicorn.so.2"), f"-Wl,-rpath,{unicorn / 'lib'}", "-lm")
    return make.link(LIBRARY, make.objects([*own, FOLDER], width=2), words)


class BoardCopter(Copter):
    """The library with a board's image."""

    headers = (SIM, HEADER)
    has_board = True

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        self._card: mmap.mmap | None = None
        self._log: Path | None = None
        image = json.loads((path.parent / IMAGE).read_text(encoding="utf-8"))
        self._load(image)
        self.lack()  # The process has one board: all of it is there again.

    def _load(self, image: dict[str, Any]) -> None:
        """Tells the library of the image."""
        tools, ffi = Toolchain(), self._ffi
        variables = Variables(tools, Path(image["elf"]))
        copter = variables.find(MAIN, "copter")
        places = self._places(copter)
        path = ffi.new("char[]", image["binary"].encode())
        table = ffi.new("board_place_t[]", places)
        told = ffi.new("board_image_t *")
        told.path, told.address = path, image["address"]
        told.end_run = read_contents(tools, Path(image["elf"])).symbol("end_run").address
        told.places, told.place_count = table, len(places)
        declaration = variables.find(TASKS, "declaration")
        self._tell_tasks(told.queue, copter, declaration)
        self._own_tasks = BoardTasks(copter.part("scheduler"), declaration)
        variables.close()
        if self._library.board_load(told):
            raise ToolError(f"{image['binary']}: its path is too long")

    def _places(self, copter: Place) -> list[tuple[int, int, int]]:
        """For each number of the view: its address, its size, and its place there."""
        offsets = self.view_type.fields
        found = []
        for field, index, path in shown():
            place = copter.part(path)
            found.append((place.address, place.size, offsets[field][1] + 4 * index))
        return found

    def _tell_tasks(self, queue: Any, copter: Place, declarations: Place) -> None:
        """Where the scheduler has what became of tasks."""
        own = copter.part("scheduler.queue")
        stats = own.part("stats[0]")
        queue.declarations = declarations.address
        queue.declaration_bytes = declarations.element(0).size
        queue.slots = own.part("task").count
        queue.tasks = own.part("task").address
        queue.skipped = own.part("skipped").address
        queue.stats, queue.stats_bytes = stats.address, stats.size
        queue.runs = stats.part("runs").address - stats.address
        queue.overruns = stats.part("overruns").address - stats.address
        queue.longest = stats.part("longest_us").address - stats.address

    def _said(self, text: Any) -> str:
        return bytes(self._ffi.string(text)).decode("ascii", "replace").replace("\r", "")

    def insert(self, content: mmap.mmap | None) -> None:
        """Put a card into the slot, which the board reads and writes, or take it out."""
        bytes_ = self._ffi.from_buffer("uint8_t[]", content or b"", require_writable=bool(content))
        if self._library.board_insert(bytes_, len(content or b"")):
            raise ToolError("a card has a multiple of 512 KiB")
        self._card = content

    def log(self, path: Path | None, trace: bool = False) -> None:
        """Where the next flight's log goes, by way of a card; that of the last one is read."""
        if trace:
            raise ToolError("the image's log has no runs of tasks")
        if self._log and self._card:
            write_bytes(self._log, card.log_of(Toolchain(), self._card))
        self._log = path
        self.insert(card.new_card(Toolchain()) if path else None)

    def text(self) -> str:
        """What the board said on its console."""
        return self._said(self._library.board_text())

    def start(
        self,
        costs_percent: int,
        plain_mean: bool,
        links: Sequence[Link] = (),
        key: Key | None = None,
        memory: Path | None = None,
        imus: int = 3,
    ) -> None:
        """Power up. How many units there are, the board says."""
        try:
            super().start(costs_percent, plain_mean, links, key, memory, imus)
        except ToolError as error:
            raise ToolError(f"{error}: {self.why(0)}") from error

    def number_at(self, place: Place) -> int:
        """A whole number of the image's memory."""
        return int(self._library.board_number(place.address, place.size))

    def timed(self) -> list[BoardTask]:
        """The image's tasks, with how long each took at most since power-up."""
        return list(self._own_tasks.read(self._library.board_number))

    def lack(self, *devices: str) -> None:
        """Power up without these, from the next start on: imu_1, barometer, memory and so on."""
        bits = [getattr(self._library, f"BOARD_HAS_NO_{device.upper()}") for device in devices]
        self._library.board_lack(sum(bits))

    def hear(self, radio: str) -> None:
        """How the pilot's receiver sends."""
        self._library.board_pilot_sends(*BITS[radio])

    def breaks(self, fault: str, which: int, amount: int, on: bool) -> None:
        """Break something of the board, or mend it."""
        kind = getattr(self._library, f"BOARD_{fault.upper()}")
        if self._library.board_break(kind, which, amount, int(on)):
            raise ToolError(f"fault {fault}: the board has no number {which} of it")

    def edges(self) -> Any:
        """Each change of the outputs since power-up: time in ticks, line, level."""
        count = self._ffi.new("uint32_t *")
        first = self._library.board_edges(count)
        kind = np.dtype([("at", "<u8"), ("line", "<u4"), ("level", "<u4")])
        raw = self._ffi.buffer(first, count[0] * kind.itemsize)
        return np.frombuffer(bytes(raw), dtype=kind)

    def why(self, status: int) -> str:
        """The board's problem, and what it said last."""
        problem = self._said(self._library.board_problem())
        last = self.text().splitlines()[-1:]
        return f"{problem}; it said last: {last[0] if last else 'nothing'}"


def made_of(path: Path) -> Copter:
    """The copter of a library: a board's, or the host's."""
    return BoardCopter(path) if path.name == LIBRARY else Copter(path)
