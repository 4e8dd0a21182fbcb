# SPDX-License-Identifier: Apache-2.0
"""The black box on a card: the power is cut behind each sector that a flight's log writes, and what
another's file system and another's reader find there is all but the last second of the log."""

from __future__ import annotations

import ctypes
import io
import struct
import tempfile
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shared_builds
from pyulog import ULog

from keel.base.errors import ROOT
from keel.base.run import output_of
from keel.flight import loop, scenario
from keel.flight.card import file_system, format_card, opened
from keel.flight.library import Copter
from keel.flight.loop import Order
from keel.install import Toolchain

SECTOR, STEP_US, SYNC_US, SECOND_US = 512, 10_000, 500_000, 1_000_000
CHUNK = 1536  # What the log's task hands over in a run.
BYTES_PER_S = 92_000
MIB = 1 << 20
SOURCES = ["bsp/fatfs/black_box.c", "bsp/fatfs/card_file.c"]
FLIGHT = """description = "up and down"
duration_s = 8.0
mode = "altitude"

[[pilot]]
at_s = 0.5
height_m = 4.0

[[pilot]]
at_s = 5.0
mode = "land"

[limits]
from_s = 0.0
tilt_max_deg = 20.0
end = { on_ground = false, motors_on = true }
"""
SHIM = """\
#include "simulated/card.c"
#include "fatfs/black_box.h"
#include <stdlib.h>
static simulated_card_t card;
static keel_disk_t disk;
static keel_black_box_t box;
static uint8_t *bytes, *written;
static uint32_t *places;
static size_t count, room_for;
static void note(uint32_t sector, const uint8_t *from)
{
    if (count == room_for) {
        room_for = 2u * room_for + 64u;
        written = realloc(written, room_for * 512u);
        places = realloc(places, room_for * sizeof *places);
    }
    memcpy(written + count * 512u, from, 512u);
    places[count++] = sector;
}
int begin(const uint8_t *image, uint32_t sectors, uint32_t allocation, uint32_t burst,
          uint32_t busy)
{
    const keel_black_box_config_t config = {&disk, allocation, burst};
    bytes = realloc(bytes, (size_t)sectors * 512u);
    memcpy(bytes, image, (size_t)sectors * 512u);
    simulated_card_init(&card, bytes, sectors);
    card.watch = note;
    card.busy_looks = busy;
    disk = simulated_card_disk(&card);
    count = 0u;
    return (int)keel_black_box_init(&box, &config);
}
int open_box(uint32_t now_us) { return (int)keel_black_box_open(&box, now_us); }
uint32_t room(void) { return keel_black_box_room(&box); }
int put(const uint8_t *data, uint32_t length)
{
    return keel_black_box_write(&box, data, length) ? 1 : 0;
}
int step(uint32_t now_us)
{
    const uint32_t before = card.reads + card.waits;
    const size_t already = count;
    const keel_black_box_state_t state = keel_black_box_step(&box, now_us);
    return (card.reads + card.waits != before) || (count - already > box.config.burst) ? -1
                                                                                       : (int)state;
}
int close_box(void) { return (int)keel_black_box_close(&box); }
uint32_t number(void) { return box.file.number; }
uint32_t writes(void) { return (uint32_t)count; }
uint32_t place(uint32_t n) { return places[n]; }
const uint8_t *sector(uint32_t n) { return written + (size_t)n * 512u; }
"""


# --- A card, as another's file system makes and reads it -----------------------------------------


@pytest.fixture(scope="module")
def pyfatfs() -> tuple[Any, Any]:
    """Another's file system: the class that formats, and the one that reads."""
    return file_system(Toolchain())


OTHERS = {
    "/README.TXT": b"Not a log.\n",
    "/PHOTOS/ONE.JPG": bytes(range(256)) * 37,
    "/LOG00004.ULG": b"another flight's" * 999,
    "/LOG0001.ULG": b"not one of ours",
}


class Memory(io.BytesIO):
    """It can be read when it is closed."""

    def close(self) -> None:
        """Not at all."""


def new_card(pyfatfs: tuple[Any, Any], kind: str, size: int) -> bytes:
    """A card with some files of others."""
    fat, system = pyfatfs
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        path = Path(folder) / "card.img"
        format_card(fat, path, kind, size)
        memory = Memory(path.read_bytes())
        card = system(memory)
        card.makedir("/PHOTOS")
        for name, data in OTHERS.items():
            card.writebytes(name, data)
        card.close()
        return memory.getvalue()


def files_of(pyfatfs: tuple[Any, Any], image: bytes, offset: int = 0) -> dict[str, bytes]:
    """All files of a card, as pyfatfs reads them."""
    with opened(pyfatfs[1], io.BytesIO(image), offset) as card:
        return {name: card.readbytes(name) for name in card.walk.files()}


@dataclass
class Volume:
    """The same by a reader of our own, which is strict: whatever is not consistent is an error."""

    image: Any
    base: int = 0  # The first sector.
    reserved: int = field(init=False)

    def __post_init__(self) -> None:
        boot = bytes(self.image[self.base * SECTOR : self.base * SECTOR + SECTOR])
        (self.cluster, self.reserved, fats, self.entries, small) = struct.unpack_from(
            "<BHBHH", boot, 13
        )
        (short,), (large, long) = (
            struct.unpack_from("<H", boot, 22),
            struct.unpack_from("<II", boot, 32),
        )
        self.per_fat = short or long
        self.is_32 = self.entries == 0
        self.data = self.reserved + fats * self.per_fat + self.entries // 16
        self.count = ((small or large) - self.data) // self.cluster
        (self.root,) = struct.unpack_from("<I", boot, 44) if self.is_32 else (0,)

    def part(self, first: int, sectors: int) -> memoryview:
        """Sectors of the volume."""
        return memoryview(self.image)[(self.base + first) * SECTOR :][: sectors * SECTOR]

    def fat(self) -> Any:
        """The table, by cluster."""
        kind = "<u4" if self.is_32 else "<u2"
        whole = np.frombuffer(self.part(self.reserved, self.per_fat), dtype=kind)
        return (whole & 0x0FFFFFFF if self.is_32 else whole)[: self.count + 2]

    def copies_differ(self) -> bool:
        """Whether the second table is another one."""
        first, second = (self.part(self.reserved + n * self.per_fat, self.per_fat) for n in (0, 1))
        return bytes(first) != bytes(second)

    def chain(self, fat: Any, first: int) -> Any:
        """The clusters of a file."""
        end = 0x0FFFFFF8 if self.is_32 else 0xFFF8
        run = np.flatnonzero(fat[first:] != np.arange(first + 1, len(fat) + 1))
        length = int(run[0]) + 1  # In a row.
        following = int(fat[first + length - 1])
        clusters = np.arange(first, first + length)
        if following >= end:
            return clusters
        assert 2 <= following < len(fat), "a chain that leads nowhere"
        assert following < first or following >= first + length, "a chain that is a ring"
        return np.concatenate([clusters, self.chain(fat, following)])

    def data_of(self, clusters: Any) -> bytes:
        return b"".join(
            bytes(self.part(self.data + (int(one) - 2) * self.cluster, self.cluster))
            for one in clusters
        )

    def entries_of(self, raw: bytes) -> Iterator[tuple[str, int, int, int]]:
        for at in range(0, len(raw), 32):
            name, kind, high, low, size = struct.unpack_from("<11sB8xH4xHI", raw, at)
            if name[0] == 0:
                return
            if name[0] != 0xE5 and kind != 0x0F and not kind & 8 and name[:1] != b".":
                text = name[:8].decode().rstrip() + ("." + name[8:].decode()).rstrip(" .")
                yield text, kind, high << 16 | low, size

    def walk(self) -> Iterator[tuple[str, int, int]]:
        """Each file: its name, its first cluster and its size; folders as "/NAME/"."""
        fat = self.fat()
        own = self.entries // 16
        root = (
            self.data_of(self.chain(fat, self.root))
            if self.is_32
            else bytes(self.part(self.data - own, own))
        )
        folders = [("/", root)]
        while folders:
            at, raw = folders.pop()
            for name, kind, first, size in self.entries_of(raw):
                if kind & 16:
                    yield f"{at}{name}/", first, 0
                    folders.append((f"{at}{name}/", self.data_of(self.chain(fat, first))))
                else:
                    yield f"{at}{name}", first, size

    def check(self) -> tuple[dict[str, tuple[int, int, int]], int]:
        """First cluster, clusters and size of each file, and clusters that nobody has."""
        fat = self.fat()
        owner = np.zeros(len(fat), dtype=bool)
        if self.is_32:
            owner[self.chain(fat, self.root)] = True
        found = {}
        for name, first, size in self.walk():
            clusters = self.chain(fat, first) if first else np.zeros(0, dtype=int)
            assert not owner[clusters].any(), f"{name}: a cluster of two files"
            assert len(clusters) * self.cluster * SECTOR >= size, f"{name}: longer than its chain"
            owner[clusters] = True
            found[name] = (first, len(clusters), size)
        lost = int(((fat[2:] != 0) & ~owner[2:]).sum())
        assert not (owner[2:] & (fat[2:] == 0)).any()
        return found, lost

    def read(self, name: str) -> bytes:
        """A file's bytes, when its clusters are in a row."""
        first, clusters, size = self.check()[0][name]
        assert list(self.chain(self.fat(), first)) == list(range(first, first + clusters))
        start = self.data + (first - 2) * self.cluster
        return bytes(self.part(start, clusters * self.cluster)[:size])


# --- A flight's log on the card ------------------------------------------------------------------


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """What the copter's log hands to its port in a short flight."""
    folder = tmp_path_factory.mktemp("flight")
    (folder / "flight.toml").write_text(FLIGHT)
    copter = Copter(shared_builds.copter_library(Toolchain()))
    loop.fly(copter, Order(scenario.read("flight", folder), "mujoco", 1), folder / "flight.ulg")
    copter.log(None)
    return (folder / "flight.ulg").read_bytes()


@pytest.fixture(scope="module")
def box(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    """The black box with FatFs and a simulated card."""
    tools = Toolchain()
    tools.ensure("card")
    folder = tmp_path_factory.mktemp("box")
    (folder / "shim.c").write_text(SHIM)
    fatfs = Path(tools.command("fatfs")[0]) / "fatfs/source"
    output_of(
        [
            *tools.command("gcc"),
            "-std=c99",
            "-O1",
            "-shared",
            "-fPIC",
            f"-I{ROOT}/include",
            f"-I{ROOT}/bsp",
            f"-I{ROOT}/bsp/fatfs",
            "-isystem",
            fatfs,
            folder / "shim.c",
            *[ROOT / name for name in SOURCES],
            fatfs / "ff.c",
            "-o",
            folder / "box.so",
        ]
    )
    loaded = ctypes.CDLL(str(folder / "box.so"))
    for name in ("room", "number", "writes", "place"):
        getattr(loaded, name).restype = ctypes.c_uint32
    loaded.sector.restype = ctypes.POINTER(ctypes.c_ubyte)
    return loaded


@dataclass
class Record:
    """What was written, sector by sector, each with its time; and when which bytes were taken."""

    image: bytes
    name: str
    stream: bytes
    writes: list[tuple[int, int, bytes]]  # Time in us, sector, bytes.
    taken: list[tuple[int, int]]  # Time in us, bytes until then.
    late_us: int  # No byte is kept later.
    opened: int  # Writes until the file was open,
    closing: int  # and until it was to be closed.

    def time_of_cut(self, writes: int) -> int:
        """The latest time of a cut behind so many writes."""
        return self.writes[writes][0] if writes < len(self.writes) else self.taken[-1][0]

    def taken_until(self, time_us: int) -> int:
        return max((count for at, count in self.taken if at <= time_us), default=0)


def definitions(log: bytes) -> list[int]:
    """Where what a log begins with may be cut: the copter hands it over message by message."""
    ends = [16]
    while log[ends[-1] + 2 : ends[-1] + 3] in b"BIFPA":
        ends.append(ends[-1] + 3 + int.from_bytes(log[ends[-1] : ends[-1] + 2], "little"))
    return ends


def fly(
    box: ctypes.CDLL,
    image: bytes,
    log: bytes,
    allocation: int = 2 * MIB,
    burst: int = 4,
    busy: int = 0,
) -> Record:
    """Hands a log over as the copter does, and closes the file."""
    assert box.begin(image, len(image) // SECTOR, allocation, burst, busy) == 0
    assert box.open_box(0) == 0
    times, opened = [0] * box.writes(), box.writes()
    at = now = 0
    taken, ends = [], definitions(log)
    assert len(log) <= allocation
    while at < len(log):
        now += STEP_US
        there = min(len(log), now * BYTES_PER_S // SECOND_US)
        for _ in range(8 if at < ends[-1] else 1):
            end = (
                next(end for end in ends if end > at)
                if at < ends[-1]
                else min(there, at + CHUNK, at + box.room())
            )
            if at < end <= there and end - at <= box.room():
                assert box.put(log[at:end], end - at) == 1
                at = end
        taken.append((now, at))
        assert box.step(now) == 1, "a step that reads, waits, writes too much, or fails"
        times += [now] * (box.writes() - len(times))
    closing = box.writes()
    assert box.close_box() == 0
    times += [now] * (box.writes() - len(times))
    writes = [(time, box.place(n), bytes(box.sector(n)[:SECTOR])) for n, time in enumerate(times)]
    flush = (16 // burst + 3) * (busy + 1) * STEP_US
    late = max(SYNC_US, flush) + flush
    return Record(image, f"/LOG{box.number():05}.ULG", log, writes, taken, late, opened, closing)


def cuts(record: Record) -> Iterator[tuple[int, bytearray]]:
    """The card behind each number of writes; it is changed further on."""
    image = bytearray(record.image)
    yield 0, image
    for number, (_, sector, data) in enumerate(record.writes, 1):
        image[sector * SECTOR : (sector + 1) * SECTOR] = data
        yield number, image


def is_log(data: bytes, folder: Path) -> None:
    """Another's reader takes it whole, and finds flight in it."""
    path = folder / "cut.ulg"
    path.write_bytes(data)
    read = ULog(str(path))
    assert not read.file_corruption
    assert read.start_timestamp >= 0 and read.msg_info_dict["sys_name"] == "Keel"
    if len(data) > BYTES_PER_S:
        assert {"imu", "vote", "attitude"} <= {one.name for one in read.data_list}


def check_cut(record: Record, cut: int, image: bytearray, others: dict[str, Any]) -> int:
    """Consistent, others untouched, and no more lost than a second; the size of the log."""
    volume = Volume(image)
    found, lost = volume.check()
    first, clusters, size = found.pop(record.name, (0, 0, 0))
    assert found == others
    assert lost == 0 or cut < record.opened or record.closing <= cut < len(record.writes)
    assert cut < record.opened or first
    assert not volume.copies_differ() or not record.opened <= cut <= record.closing
    if cut == len(record.writes):
        assert size == len(record.stream) and not volume.copies_differ()
        assert clusters == -(-size // (volume.cluster * SECTOR)), "allocated in vain"
    if size:
        assert volume.read(record.name) == record.stream[:size]
    assert size >= record.taken_until(record.time_of_cut(cut) - record.late_us)
    return size


def check_all_cuts(
    record: Record, pyfatfs: tuple[Any, Any], folder: Path, asks: Callable[[int, int], bool]
) -> None:
    """At every cut by our own reader, and by pyfatfs where it is asked; each log by pyulog."""
    volume = Volume(record.image)
    others = volume.check()[0]
    sizes = set()
    for cut, image in cuts(record):
        size = check_cut(record, cut, image, others)
        if size and size not in sizes:
            is_log(record.stream[:size], folder)
        sizes.add(size)
        if asks(cut, record.writes[cut - 1][1] if cut else 0):
            read = files_of(pyfatfs, bytes(image))
            assert read.pop(record.name, b"") == record.stream[:size]
            assert read == OTHERS
    assert len(record.stream) in sizes and 0 in sizes
    assert len(sizes) > record.taken[-1][0] // max(SECOND_US, record.late_us)


def test_every_cut_of_a_short_log_by_pyfatfs(
    box: ctypes.CDLL, pyfatfs: tuple[Any, Any], log: bytes, tmp_path: Path
) -> None:
    record = fly(box, new_card(pyfatfs, "FAT16", 8 * MIB), log[: 2 * BYTES_PER_S])
    assert record.name == "/LOG00005.ULG" and len(record.writes) > 400
    check_all_cuts(record, pyfatfs, tmp_path, lambda *_: True)


def is_not_data(record: Record) -> Callable[[int, int], bool]:
    """Whether a write was of the root directory in flight; of those of tables, some before it and
    behind it."""
    data = Volume(record.image).data + 8
    return lambda cut, sector: (
        sector < data and (record.opened <= cut < record.closing or cut % 5 == 0)
    )


def test_every_cut_of_a_flight(
    box: ctypes.CDLL, pyfatfs: tuple[Any, Any], log: bytes, tmp_path: Path
) -> None:
    """FAT32; pyfatfs reads behind each write of the directory."""
    record = fly(box, new_card(pyfatfs, "FAT32", 40 * MIB), log)
    assert record.late_us < SECOND_US
    check_all_cuts(record, pyfatfs, tmp_path, is_not_data(record))


@pytest.mark.parametrize(("burst", "busy"), [(1, 0), (16, 5), (2, 18)])
def test_every_cut_with_other_cards(
    box: ctypes.CDLL, pyfatfs: tuple[Any, Any], log: bytes, tmp_path: Path, burst: int, busy: int
) -> None:
    """One sector in a step, or a card that is busy for 50 or 180 ms behind each write: so it takes
    fewer bytes."""
    stream = log if busy == 0 else log[: 2 * BYTES_PER_S]
    record = fly(box, new_card(pyfatfs, "FAT16", 8 * MIB), stream, 2 * MIB, burst, busy)
    check_all_cuts(record, pyfatfs, tmp_path, lambda cut, _: cut % 100 == 0)


@pytest.mark.parametrize("kind", ["FAT16", "FAT32"])
def test_the_next_start_cuts_what_was_left(
    box: ctypes.CDLL, pyfatfs: tuple[Any, Any], log: bytes, kind: str
) -> None:
    """A start behind a cut: the log of before stays, and gives back what it had in vain."""
    image = new_card(pyfatfs, kind, (8 if kind == "FAT16" else 40) * MIB)
    record = fly(box, image, log[: 2 * BYTES_PER_S])
    others = Volume(record.image).check()[0]
    asks = is_not_data(record)
    checked = 0
    for cut, image_then in cuts(record):
        if not asks(cut, record.writes[cut - 1][1] if cut else 0):
            continue
        found, lost = Volume(image_then).check()
        size = found.get(record.name, (0, 0, 0))[2]
        assert box.begin(bytes(image_then), len(image) // SECTOR, MIB, 4, 0) == 0
        assert box.open_box(0) == 0 and box.put(b"next", 4) == 1 and box.close_box() == 0
        again = bytearray(image_then)
        for n in range(box.writes()):
            at = box.place(n) * SECTOR
            again[at : at + SECTOR] = bytes(box.sector(n)[:SECTOR])
        after, lost_then = Volume(again).check()
        assert lost_then == lost, "what was lost before may stay, no more"
        assert after.pop(f"/LOG{box.number():05}.ULG")[2] == 4
        assert box.number() == (6 if size else 5)
        if size:
            volume = Volume(again)
            assert after.pop(record.name)[1:] == (-(-size // (volume.cluster * SECTOR)), size)
            assert volume.read(record.name) == log[:size]
        assert after == others
        checked += 1
    assert checked > 10


@pytest.mark.parametrize(("kind", "size"), [("FAT12", 4), ("FAT16", 8), ("FAT32", 40)])
def test_a_card_with_a_partition(
    box: ctypes.CDLL, pyfatfs: tuple[Any, Any], log: bytes, kind: str, size: int
) -> None:
    """As cards are sold: a table, and the volume behind it."""
    first, volume = 2048, new_card(pyfatfs, kind, size * MIB)
    entry = struct.pack("<B3sB3sII", 0, bytes(3), 6, bytes(3), first, len(volume) // SECTOR)
    table = bytes(446) + entry + bytes(48) + b"\x55\xaa"
    record = fly(box, table + bytes((first - 1) * SECTOR) + volume, log)
    *_, (_, image) = cuts(record)
    read = files_of(pyfatfs, bytes(image), first * SECTOR)
    assert read.pop(record.name) == log
    assert read == OTHERS
    assert image[: first * SECTOR] == record.image[: first * SECTOR]
