# SPDX-License-Identifier: Apache-2.0
"""A schedule as a trace for Perfetto (ui.perfetto.dev), by Perfetto's own definitions.

Each task is a track with its runs, and below it one with the time from each release to its run and
the deadlines. Slack and guard are counters. Names are written once and then told by number."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from perfetto.protos.perfetto.trace.perfetto_trace_pb2 import Trace, TrackDescriptor, TrackEvent

from keel.base.files import write_bytes
from keel.timeline.runs import Schedule, Task, slack

SEQUENCE = 1
CLEARED, NEEDED = 1, 2  # Of the numbers for names: what stands before does not count, and does.
ALL, SLACK, GUARD, LOST, FIRST_TASK = 1, 2, 3, 4, 16  # Tracks.
RUNS, WAITS, DEADLINE, MISSED, LOST_RUNS = 1, 2, 3, 4, 5  # Events' names, by number.
EVENTS = {WAITS: "waits", DEADLINE: "deadline", MISSED: "deadline missed", LOST_RUNS: "runs lost"}
DETAILS = ("late_us", "length_us", "slack_us", "skipped", "promoted", "over_budget")
NS = 1000


def track_of(task: int) -> int:
    """The track of a task's runs; that of its waits is the next."""
    return FIRST_TASK + 2 * task


def title_of(task: Task) -> str:
    """A track's name."""
    return f"{task.name} ({task.sort}, {task.period_us / 1000:g} ms)"


class Writer:
    """A trace that grows."""

    def __init__(self) -> None:
        self.trace = Trace()

    def packet(self, flags: int = NEEDED) -> Any:
        """Another packet."""
        packet = self.trace.packet.add()
        packet.trusted_packet_sequence_id = SEQUENCE
        packet.sequence_flags = flags
        return packet

    def track(self, uuid: int, name: str, parent: int = 0, rank: int = 0) -> Any:
        """A track; those below it keep their order."""
        descriptor = self.packet().track_descriptor
        descriptor.uuid, descriptor.name = uuid, name
        descriptor.child_ordering = TrackDescriptor.EXPLICIT
        if parent:
            descriptor.parent_uuid, descriptor.sibling_order_rank = parent, rank
        return descriptor

    def event(self, time_us: int, track: int, kind: Any) -> Any:
        """An event of a track."""
        packet = self.packet()
        packet.timestamp = time_us * NS
        packet.track_event.type, packet.track_event.track_uuid = kind, track
        return packet.track_event

    def slice(self, track: int, name: int, start_us: int, end_us: int) -> Any:
        """From then to then; returns its first event."""
        event = self.event(start_us, track, TrackEvent.TYPE_SLICE_BEGIN)
        event.name_iid = name
        self.event(end_us, track, TrackEvent.TYPE_SLICE_END)
        return event

    def count(self, track: int, time_us: int, value: int) -> None:
        """A counter's value from then on."""
        self.event(time_us, track, TrackEvent.TYPE_COUNTER).counter_value = value


def begin(writer: Writer, schedule: Schedule) -> None:
    """Names and tracks."""
    first = writer.packet(CLEARED)
    names = {**EVENTS, **{FIRST_TASK + n: one.name for n, one in enumerate(schedule.tasks)}}
    for number, name in names.items():
        first.interned_data.event_names.add(iid=number, name=name)
    for number, name in enumerate(DETAILS, 1):
        first.interned_data.debug_annotation_names.add(iid=number, name=name)
    writer.track(ALL, "Keel's scheduler")
    for rank, (uuid, name) in enumerate(((SLACK, "slack"), (GUARD, "guard"))):
        writer.track(uuid, name, ALL, rank).counter.unit_name = "us"
    for number, task in enumerate(schedule.tasks):
        writer.track(track_of(number), title_of(task), ALL, FIRST_TASK + number)
        writer.track(track_of(number) + 1, "releases and deadlines", track_of(number))


def add_run(writer: Writer, schedule: Schedule, run: Any) -> None:
    """A run, its wait and its deadline."""
    number, track = int(run["task"]), track_of(int(run["task"]))
    start, end, release = int(run["start"]), int(run["end"]), int(run["release"])
    if start > release:
        writer.slice(track + 1, WAITS, release, start)
    event = writer.slice(track, FIRST_TASK + number, start, end)
    over = end - start > schedule.tasks[number].budget_us
    values = (
        start - release,
        end - start,
        int(run["slack"]),
        int(run["skipped"]),
        bool(run["promoted"]),
        over,
    )
    for iid, value in enumerate(values, 1):
        detail = event.debug_annotations.add(name_iid=iid)
        if isinstance(value, bool):
            detail.bool_value = value
        else:
            detail.int_value = value
    deadline = int(run["deadline"])
    told = writer.event(deadline, track + 1, TrackEvent.TYPE_INSTANT)
    told.name_iid = MISSED if end > deadline else DEADLINE


def add_counters(writer: Writer, schedule: Schedule) -> None:
    """Slack at each choice and at each end, and the guard."""
    runs = schedule.runs
    for times in (runs["start"], runs["end"]):
        values = slack(runs, schedule.tasks, times)
        for time_us, value in zip(times.tolist(), values.tolist(), strict=True):
            if value >= 0:
                writer.count(SLACK, time_us, value)
    for time_us in (int(runs["start"][0]), int(runs["end"][-1])):
        writer.count(GUARD, time_us, schedule.guard_us)


def add_dropouts(writer: Writer, schedule: Schedule) -> None:
    """Where runs are missing, if there are such."""
    if schedule.dropouts:
        writer.track(LOST, "lost", ALL, LOST)
    for after_us, length_ms in schedule.dropouts:
        writer.slice(LOST, LOST_RUNS, after_us, after_us + length_ms * 1000)


def trace_of(schedule: Schedule) -> Trace:
    """All of it."""
    writer = Writer()
    begin(writer, schedule)
    for run in schedule.runs:
        add_run(writer, schedule, run)
    add_counters(writer, schedule)
    add_dropouts(writer, schedule)
    return writer.trace


def write(path: Path, schedule: Schedule) -> None:
    """A file that ui.perfetto.dev opens."""
    write_bytes(path, trace_of(schedule).SerializeToString())
