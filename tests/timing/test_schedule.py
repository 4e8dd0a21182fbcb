# SPDX-License-Identifier: Apache-2.0
"""A schedule as it ran: what the log of the demo and a log made by hand become for Perfetto, read
back by Perfetto's own definitions, beside what the scheduler itself counted."""

from __future__ import annotations

import re
import tomllib
from collections import defaultdict
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from logged import FORMATS, LOOP, LOW, SAMPLE, message, run, task, written

from keel.base.errors import ROOT, ToolError
from keel.install import Toolchain
from keel.install.packages import provide

provide("schedule")
from perfetto.protos.perfetto.trace.perfetto_trace_pb2 import Trace, TrackDescriptor, TrackEvent

from keel.timeline import command as schedule
from keel.timeline import picture, runs, table

SECONDS = 3
COUNTED = re.compile(
    r"task (.+): runs (\d+) busy (\d+) longest (\d+) skipped (\d+) promotions (\d+)"
)
URPILOT = tomllib.loads((ROOT / "specs/tasksets/urpilot.toml").read_text(encoding="utf-8"))
TASKS = {one["name"]: one for one in URPILOT["task"]}


@dataclass
class Track:
    """A track, as a reader of the trace sees it. Times are in us."""

    name: str
    parent: int
    rank: int
    unit: str = ""
    ordered: bool = False  # Whether the tracks below it stand by their ranks.
    slices: list[tuple[str, int, int, dict[str, int]]] = field(default_factory=list)
    instants: list[tuple[str, int]] = field(default_factory=list)
    counts: list[tuple[int, int]] = field(default_factory=list)


def us(packet: Any) -> int:
    """A packet's time."""
    assert packet.timestamp % 1000 == 0
    return int(packet.timestamp) // 1000


def details(event: Any, names: dict[int, str]) -> dict[str, int]:
    """What is told beside an event."""
    return {
        names[one.name_iid]: one.bool_value if one.HasField("bool_value") else one.int_value
        for one in event.debug_annotations
    }


def tracks_of(path: Path) -> dict[int, Track]:
    """Read a trace back. Every slice must end on its track, the inner before the outer."""
    trace = Trace()
    trace.ParseFromString(path.read_bytes())
    first = trace.packet[0].interned_data
    names = {one.iid: one.name for one in first.event_names}
    words = {one.iid: one.name for one in first.debug_annotation_names}
    tracks: dict[int, Track] = {}
    for packet in trace.packet:
        told = packet.track_descriptor
        if packet.HasField("track_descriptor"):
            tracks[told.uuid] = Track(
                told.name,
                told.parent_uuid,
                told.sibling_order_rank,
                told.counter.unit_name,
                told.child_ordering == TrackDescriptor.EXPLICIT,
            )
    open_slices: dict[int, list[Any]] = defaultdict(list)
    events = [packet for packet in trace.packet if packet.HasField("track_event")]
    for packet in sorted(events, key=us):  # As a reader does: by time, else as they stand.
        event, track = packet.track_event, tracks[packet.track_event.track_uuid]
        if event.type == TrackEvent.TYPE_SLICE_BEGIN:
            open_slices[event.track_uuid].append(packet)
        elif event.type == TrackEvent.TYPE_SLICE_END:
            begin = open_slices[event.track_uuid].pop()
            track.slices.append(
                (
                    names[begin.track_event.name_iid],
                    us(begin),
                    us(packet),
                    details(begin.track_event, words),
                )
            )
        elif event.type == TrackEvent.TYPE_INSTANT:
            track.instants.append((names[event.name_iid], us(packet)))
        else:
            assert event.type == TrackEvent.TYPE_COUNTER
            track.counts.append((us(packet), event.counter_value))
    assert not any(open_slices.values())
    return tracks


def called(tracks: dict[int, Track], name: str) -> Track:
    """The track whose name begins so."""
    (found,) = [track for track in tracks.values() if track.name.startswith(name)]
    return found


def below(tracks: dict[int, Track], name: str) -> Track:
    """The track below it."""
    (parent,) = [uuid for uuid, track in tracks.items() if track.name.startswith(name)]
    (found,) = [track for track in tracks.values() if track.parent == parent]
    return found


@dataclass(frozen=True)
class Demo:
    """The demo's log, what its scheduler counted, and its trace."""

    log: Path
    counted: dict[str, tuple[int, ...]]
    tracks: dict[int, Track]


@pytest.fixture(scope="module")
def demo(tmp_path_factory: pytest.TempPathFactory) -> Demo:
    """It ran for some seconds."""
    log, output = schedule.demo(Toolchain(), tmp_path_factory.mktemp("schedule"), SECONDS)
    counted = {found[1]: tuple(map(int, found.groups()[1:])) for found in COUNTED.finditer(output)}
    assert set(counted) == set(TASKS)
    _, files = schedule.written(log)
    return Demo(log, counted, tracks_of(files[0]))


def test_its_slices_are_what_the_scheduler_counted(demo: Demo) -> None:
    for name, (count, busy, longest, *others) in demo.counted.items():
        lengths = [end - start for _, start, end, _ in called(demo.tracks, name).slices]
        assert (len(lengths), sum(lengths), max(lengths)) == (count, busy, longest), name
        assert count == SECONDS * 1_000_000 // TASKS[name]["period_us"], name
        assert others == [0, 0], name


def test_one_task_runs_at_a_time(demo: Demo) -> None:
    tasks = [called(demo.tracks, name) for name in TASKS]
    every = sorted((start, end) for track in tasks for _, start, end, _ in track.slices)
    assert all(before[1] <= after[0] for before, after in pairwise(every))


def test_releases_and_deadlines_lie_on_the_grid_of_the_task_set(demo: Demo) -> None:
    for name, declared in TASKS.items():
        lower, period = below(demo.tracks, name), declared["period_us"]
        grid = [declared.get("phase_us", 0) + k * period for k in range(len(lower.instants) + 1)]
        assert [time for _, time in lower.instants] == grid[1:], name
        assert {told for told, _ in lower.instants} == {"deadline"}, name
        starts = [start for _, start, _, _ in called(demo.tracks, name).slices]
        waits = {start: end for told, start, end, _ in lower.slices if told == "waits"}
        assert [waits.get(release, release) for release in grid[:-1]] == starts, name


def test_what_is_not_real_time_starts_where_it_fits_before_the_next_release(demo: Demo) -> None:
    guard = URPILOT["scheduler"]["guard_us"]
    released = sorted(
        time
        for name, one in TASKS.items()
        if one["class"] == "real-time"
        for _, time in below(demo.tracks, name).instants
    )
    others = [name for name, one in TASKS.items() if one["class"] != "real-time"]
    for name in others:
        for _, start, end, told in called(demo.tracks, name).slices:
            until = next(time for time in released if time > start) - start
            assert told["slack_us"] == until, (name, start)
            assert until >= guard + (end - start), (name, start)


def test_counters(demo: Demo) -> None:
    slack, guard = called(demo.tracks, "slack"), called(demo.tracks, "guard")
    assert slack.unit == guard.unit == "us"
    assert {value for _, value in guard.counts} == {20}
    assert len(slack.counts) == 2 * sum(count for count, *_ in demo.counted.values())
    assert max(value for _, value in slack.counts) == 1000  # No gap is longer.
    assert min(value for _, value in slack.counts) >= 0


def test_tracks_stand_below_one_in_the_order_of_the_first_runs(demo: Demo) -> None:
    (root,) = [uuid for uuid, track in demo.tracks.items() if not track.parent]
    top = sorted((track.rank, track.name) for track in demo.tracks.values() if track.parent == root)
    assert [name for _, name in top][:4] == [
        "slack",
        "guard",
        "Background IMU (realtime, 1 ms)",
        "Foreground IMU (realtime, 2 ms)",
    ]
    assert len(top) == 2 + len(TASKS) and demo.tracks[root].ordered


def test_a_log_made_by_hand(tmp_path: Path) -> None:
    _, files = schedule.written(written(tmp_path / "hand.ulg", SAMPLE))
    tracks = tracks_of(files[0])
    loop, low = called(tracks, "Rate <loop>"), called(tracks, "Telemetry")
    assert [(start, end) for _, start, end, _ in loop.slices] == [
        (1000, 1080),
        (2010, 2100),
        (9100, 9190),
        (12000, 12080),
    ]
    assert loop.slices[2][3] == {
        "late_us": 6100,
        "length_us": 90,
        "slack_us": 2900,
        "skipped": 6,
        "promoted": False,
        "over_budget": False,
    }
    assert [one[3]["slack_us"] for one in low.slices] == [920, 0]
    assert [one[3]["promoted"] for one in low.slices] == [False, True]
    assert [one[3]["over_budget"] for one in low.slices] == [True, True]
    lower = below(tracks, "Telemetry")
    assert lower.slices == [("waits", 1000, 1080, {}), ("waits", 5000, 5100, {})]
    assert lower.instants == [("deadline", 5000), ("deadline missed", 9000)]
    assert [time for _, time in below(tracks, "Rate <loop>").instants] == [2000, 3000, 10000, 13000]
    assert called(tracks, "lost").slices == [("runs lost", 9100, 11100, {})]


def test_the_table_of_a_log_made_by_hand(tmp_path: Path) -> None:
    """The time from the first run to the end of the last is 11080 us."""
    loop, low = table.rows_of(runs.read(written(tmp_path / "hand.ulg", SAMPLE)))
    assert loop == table.Row(
        "Rate <loop>",
        1000,
        4,
        85.0,
        90,
        100,
        pytest.approx(100.0 * 340 / 11080),
        6100,
        (2, 1, 0, 0, 0, 0, 1),
        overruns=0,
        promotions=0,
        skipped=6,
        missed=0,
    )
    assert low == table.Row(
        "Telemetry",
        4000,
        2,
        2175.0,
        4000,
        300,
        pytest.approx(100.0 * 4350 / 11080),
        100,
        (0, 0, 1, 1, 0, 0, 0),
        overruns=2,
        promotions=1,
        skipped=0,
        missed=1,
    )


def test_the_table_of_the_demo_is_what_the_scheduler_counted(demo: Demo) -> None:
    for row in table.rows_of(runs.read(demo.log)):
        count, busy, longest, *_ = demo.counted[row.name]
        assert (row.runs, row.mean_us, row.longest_us) == (count, busy / count, longest)
        assert row.load == pytest.approx(100.0 * busy / (SECONDS * 1e6), rel=0.001)
        assert sum(row.late) == count


def test_a_task_that_takes_the_slot_of_another_has_a_track_of_its_own(tmp_path: Path) -> None:
    other = (2, 2000, 50, 2, "Blackbox")
    messages = [
        task(*LOOP),
        run(0, 0, 0, 50, flags=1),
        task(*LOW),
        run(2, 100, 0, 60),
        run(2, 4100, 0, 60),
        task(*other),
        run(2, 9000, 0, 40, flags=1),
        run(2, 11000, 0, 41),
    ]
    _, files = schedule.written(written(tmp_path / "two.ulg", messages))
    tracks = tracks_of(files[0])
    for name, starts in (
        ("Telemetry (low, 4 ms)", [100, 4100]),
        ("Blackbox (medium, 2 ms)", [9000, 11000]),
    ):
        assert [start for _, start, _, _ in called(tracks, name).slices] == starts


@pytest.mark.parametrize(
    ("messages", "told"),
    [
        ([], "has no runs of tasks; flights log them with ARGS=--trace"),
        ([run(0, 77, 0, 50)], "the run at 77 us is of no task that was told (slot 0)"),
        (
            [task(*LOOP), run(0, 0, 0, 50), run(0, 99, 0, 50, flags=1)],
            "the run at 99 us is of no task",
        ),
        ([task(3, 0, 9, 1, "Odd"), run(3, 0, 0, 5)], "task 'Odd' has no period"),
        ([message("D", b"\x07\x00rest")], "byte "),
    ],
)
def test_a_log_that_cannot_be_shown_is_refused(
    messages: list[bytes], told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = written(tmp_path / "bad.ulg", messages)
    assert schedule.main([str(log)]) == 2
    line = capsys.readouterr().err
    assert line.count("\n") == 1
    assert line.count(str(log)) == 1 and told in line
    assert list(tmp_path.iterdir()) == [log]


def test_a_log_without_the_topics_and_none_at_all_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ToolError, match="has no runs of tasks"):
        runs.read(written(tmp_path / "other.ulg", [], formats=("vote:uint64_t timestamp;",)))
    with pytest.raises(ToolError, match="no topic task"):
        runs.read(written(tmp_path / "half.ulg", [run(0, 0, 0, 5)], formats=FORMATS[:1]))
    (tmp_path / "text.ulg").write_text("no log")
    with pytest.raises(ToolError, match=r"text\.ulg: is no log in ULog"):
        runs.read(tmp_path / "text.ulg")


def test_the_command_tells_what_it_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = written(tmp_path / "hand.ulg", SAMPLE)
    assert schedule.main([str(log)]) == 0
    *rows, last = capsys.readouterr().out.splitlines(keepends=True)
    assert [row.split()[0] for row in rows[2:]] == ["Rate", "Telemetry"]
    assert last == (
        f"schedule: 6 runs of 2 tasks, 1 promoted, 1 behind their deadlines; runs were lost at 1 "
        f"places; {log.with_suffix('.pftrace')} for ui.perfetto.dev, {log.with_suffix('.html')} "
        f"for any browser\n"
    )
    assert schedule.main(["--seconds", "0"]) == 2
    assert "--seconds: expected 1 to 3600, found 0" in capsys.readouterr().err


def console_of(messages: list[bytes], before: str = "") -> str:
    """What a board's console says: a log's messages, a line each, among other lines."""
    lines = "".join(f"log {one.hex()}\r\nt 1 s load 232055 ppm\r\n" for one in messages)
    return f"{before}Keel on fmuv5: 21 tasks\r\n{lines}log ends\r\n"


def parts(log: Path) -> list[bytes]:
    """A log's beginning, and each message of it."""
    content = log.read_bytes()
    found, at = [content[:16]], 16
    while at < len(content):
        end = at + 3 + int.from_bytes(content[at : at + 2], "little")
        found.append(content[at:end])
        at = end
    return found


def test_a_log_comes_from_the_console_of_a_board(tmp_path: Path) -> None:
    """The last one that was sent, whatever else was."""
    log = written(tmp_path / "hand.ulg", SAMPLE)
    text = tmp_path / "board.txt"
    earlier = f"log {parts(log)[0].hex()}\r\nlog 0400440000ff\r\n"  # A reset ended it.
    text.write_text(console_of(parts(log), before=earlier), newline="")
    assert schedule.main([str(text)]) == 0
    assert (tmp_path / "board.ulg").read_bytes() == log.read_bytes()
    assert called(tracks_of(tmp_path / "board.pftrace"), "Telemetry").slices


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("Keel on fmuv5: 21 tasks\n", "board.txt: has no line of a log; a board sends it when `r`"),
        ("log 00\nlog 0g\n", "board.txt:2: expected hexadecimal digits behind `log`: 'log 0g'"),
        ("log 123\n", "board.txt:1: expected hexadecimal digits"),
        ("log 554c\n", "board.ulg: is no log in ULog"),
    ],
)
def test_a_console_without_a_whole_log_is_refused(
    said: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "board.txt").write_text(said)
    assert schedule.main([str(tmp_path / "board.txt")]) == 2
    assert told in capsys.readouterr().err


def test_a_picture_is_the_same_bytes_for_the_same_schedule(demo: Demo, tmp_path: Path) -> None:
    found = runs.read(demo.log)
    for name in ("first.svg", "second.svg"):
        picture.plot(tmp_path / name, found, 1_000_000, 1_006_000)
    first = (tmp_path / "first.svg").read_bytes()
    assert first == (tmp_path / "second.svg").read_bytes()
    assert all(f">{name}<".encode() in first for name in TASKS)
    with pytest.raises(ToolError, match="nothing runs from 5000000 to 5001000 us"):
        picture.plot(tmp_path / "third.svg", found, 5_000_000, 5_001_000)
