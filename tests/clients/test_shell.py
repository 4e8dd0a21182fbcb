# SPDX-License-Identifier: Apache-2.0
"""The copter's console by MAVLink, on the virtual clock: what a station types, what it is answered,
and that each figure of the table of tasks is what the log of the same flight says.

Equal runs are equal: nothing here waits.
"""

from __future__ import annotations

import os
import pty
import re
import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pymavlink.dialects.v20 import common as mavlink
from test_telemetry import Rig

from keel.flight.keyboard import Keyboard
from keel.flight.library import Copter, Key, Link
from keel.timeline import runs

SHELL, OTHER_DEVICE = 10, 0
REPLY, RESPOND, EXCLUSIVE, MULTI = 1, 2, 4, 16
ROOM = 70
PROMPT = "keel> "
# docs/timing.md: a run counts where it lies from one up to below the next.
EDGES = (0, 10, 30, 100, 300, 1000, 3000)
HELP = "help: these commands\ntasks: how each task has run since the start\n"


def typed(text: str, flags: int = EXCLUSIVE | RESPOND, device: int = SHELL) -> Any:
    """A message as PX4's mavlink_shell.py sends it."""
    data = [*text.encode(), *([0] * (ROOM - len(text)))]
    return mavlink.MAVLink_serial_control_message(device, flags, 0, 0, len(text), data)


def addressed(rig: Rig, text: str, system: int, component: int, count: int = -1) -> bytes:
    """The same with the two fields behind it that QGroundControl sends, and pymavlink does not."""
    message = typed(text)
    size = len(text) if count < 0 else count
    payload = struct.pack(
        "<IHBBB70sBB", 0, 0, SHELL, RESPOND | MULTI, size, text.encode(), system, component
    )
    return bytes(message._pack(rig.station, message.crc_extra, payload))


def target_of(message: Any) -> tuple[int, int]:
    """Whom an answer names: zeros at a payload's end are not sent."""
    frame = bytes(message.get_msgbuf())
    payload = frame[10 : 10 + frame[1]].ljust(81, b"\0")
    return payload[79], payload[80]


def said(rig: Rig, begun: int = 0, link: int = 0, station: tuple[int, int] = (255, 190)) -> str:
    """What a station was told since."""
    text = ""
    for message in rig.seen[link][begun:]:
        if message.get_type() == "SERIAL_CONTROL" and target_of(message) == station:
            assert (message.device, message.flags) == (SHELL, REPLY)
            assert 0 < message.count <= ROOM and not any(message.data[message.count :])
            text += bytes(message.data[: message.count]).decode("ascii")
    return text


def answer(rig: Rig, message: Any, within_ms: int = 100) -> str:
    """What comes at once."""
    begun = len(rig.seen[0])
    rig.send(message)
    rig.run(within_ms)
    return said(rig, begun)


def test_what_is_typed_is_shown_answered_and_followed_by_a_prompt(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    assert answer(rig, typed("\n")) == f"\n{PROMPT}"
    assert answer(rig, typed("help\n")) == f"help\n{HELP}{PROMPT}"
    assert answer(rig, typed("help\r\n", RESPOND | MULTI)) == f"help\n{HELP}{PROMPT}"  # MAVProxy's.
    assert answer(rig, typed("  help \n")) == f"  help \n{HELP}{PROMPT}"


@pytest.mark.parametrize("command", ["reboot", "Tasks", "tasks now", "help; tasks", "hel", "helpx"])
def test_an_unknown_command_is_told_which_there_are(copter: Copter, command: str) -> None:
    rig = Rig(copter, warm_ms=500)
    assert answer(rig, typed(f"{command}\n")) == (
        f"{command}\nno such command: {command}; there are: help, tasks\n{PROMPT}"
    )


def test_a_line_may_come_in_parts_and_several_at_once(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    for part in "hel":
        assert answer(rig, typed(part)) == ""
    assert answer(rig, typed("p\n")) == f"help\n{HELP}{PROMPT}"
    assert answer(rig, typed("help\n\nno\n"), 200) == (
        f"help\n{HELP}{PROMPT}\n{PROMPT}no\nno such command: no; there are: help, tasks\n{PROMPT}"
    )


def test_what_is_too_long_is_no_command_and_the_next_one_is(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    rig.send(typed("x" * ROOM))
    assert f"no such command: {'x' * 31}; there" in answer(rig, typed("x" * ROOM), 200)
    assert answer(rig, typed("\nhelp\n"), 200).endswith(f"help\n{HELP}{PROMPT}")


def test_bytes_that_are_no_characters_are_left_out(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    data = [0x1B, 0x00, *b"he", 0xFF, 0x7F, *b"lp", 0x08, 0x0A]
    message = mavlink.MAVLink_serial_control_message(
        SHELL, RESPOND, 0, 0, len(data), data + [0] * (ROOM - len(data))
    )
    assert answer(rig, message) == f"help\n{HELP}{PROMPT}"


def test_nothing_else_is_answered(copter: Copter) -> None:
    """Other devices, replies, questions whether there is more, and other aircraft."""
    rig = Rig(copter, warm_ms=500)
    for message in (
        typed("help\n", device=OTHER_DEVICE),
        typed("help\n", REPLY | RESPOND),
        typed("", RESPOND | MULTI),
        typed("help\n", 0),
        typed("help\n", EXCLUSIVE),
    ):
        assert answer(rig, message) == "", message
    for system, component, meant in (
        (1, 1, True),
        (0, 0, True),
        (1, 0, True),
        (2, 1, False),
        (1, 7, False),
        (2, 0, False),
    ):
        begun = len(rig.seen[0])
        rig.copter.send(0, addressed(rig, "help\n", system, component))
        rig.run(100)
        assert (said(rig, begun) != "") == meant, (system, component)
    begun = len(rig.seen[0])
    rig.copter.send(0, addressed(rig, "help\n", 1, 1, count=ROOM + 1))
    rig.run(100)
    assert said(rig, begun) == ""


def test_who_goes_away_is_told_no_more(copter: Copter) -> None:
    """As mavlink_shell.py does when it ends; who comes back begins anew."""
    rig = Rig(copter)
    begun = len(rig.seen[0])
    rig.send(typed("tasks\n"))
    rig.run(60)
    assert said(rig, begun)
    rig.send(typed("", 0))
    rig.run(20)
    begun = len(rig.seen[0])
    rig.run(1000)
    assert said(rig, begun) == ""
    rig.send(typed("hel"))
    rig.send(typed("", 0))
    assert answer(rig, typed("help\n")) == f"help\n{HELP}{PROMPT}"


def test_who_may_not_command_may_look_and_who_must_sign_must(copter: Copter) -> None:
    rig = Rig(copter, [Link(commands=False)], warm_ms=500)
    assert answer(rig, typed("help\n")) == f"help\n{HELP}{PROMPT}"
    rig = Rig(copter, warm_ms=500, key=Key(b"\x5a" * 32, 1000))
    assert answer(rig, typed("help\n")) == ""


def test_it_cannot_be_asked_for_as_other_messages_are(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    assert rig.ask(511, 126, 100_000) == rig.ask(512, 126) == 2  # Denied.


@dataclass(frozen=True)
class Row:
    """A line of the table, and when it was made."""

    period_us: int
    runs: int
    mean_us: float
    longest_us: int
    budget_us: int
    load: float
    late: tuple[int, ...]
    overruns: int
    promotions: int
    skipped: int
    at_ms: int


def rows_of(text: str, at_ms: Callable[[int], int]) -> dict[str, Row]:
    """The table, read; and when the character at each row's beginning was made."""
    lines = re.search(r"^up .*\n(task .*)\n((?:.+\n)+?)(?=keel> |\Z)", text, re.MULTILINE)
    assert lines, text
    late = [f"<{edge}" for edge in EDGES[1:]]
    assert lines[1].split() == [
        "task",
        "period",
        "runs",
        "mean",
        "longest",
        "budget",
        "load",
        "%",
        *late,
        "more",
        "over",
        "prom",
        "skip",
    ]
    rows = {}
    begin = lines.start(2)
    for line in lines[2].splitlines(keepends=True):
        assert len(line) == len(lines[1]) + 1, line
        numbers = line[24:].split()
        rows[line[:24].rstrip()] = Row(
            int(numbers[0]),
            int(numbers[1]),
            float(numbers[2]),
            int(numbers[3]),
            int(numbers[4]),
            float(numbers[5]),
            tuple(int(one) for one in numbers[6:13]),
            int(numbers[13]),
            int(numbers[14]),
            int(numbers[15]),
            at_ms(begin),
        )
        begin += len(line)
    return rows


def table(rig: Rig, link: int = 0) -> dict[str, Row]:
    """By MAVLink: each row with the millisecond in which telemetry made it."""
    rig.send(typed("tasks\n"), link)
    text, times = "", list[int]()
    while not text.endswith(f"\n{PROMPT}"):
        begun = len(rig.seen[link])
        rig.run(1)
        new = said(rig, begun, link)
        assert len(new) <= ROOM  # One message a run.
        text += new
        times += [rig.now_ms] * len(new)
        assert len(times) < 10_000
    assert text.startswith("tasks\nup ")
    return rows_of(text, lambda begin: times[begin])


def troubled(rig: Rig) -> None:
    """Runs that take long, of real-time tasks and others; so some are late, promoted or skipped."""
    names = rig.copter.tasks
    for name, count, extra_us in (
        ("Background IMU", 3, 900),
        ("Navigation", 2, 6000),
        ("GPS", 4, 1500),
        ("Angle rate control", 1, 4500),
    ):
        number = names.index(name)
        rig.copter.overrun(number, count, extra_us)
        rig.run(2500)


def counted(own: Any, budget_us: int) -> tuple[int, tuple[int, ...], int, int, int]:
    """What the log's runs of a task come to."""
    late, lengths = own["start"] - own["release"], own["end"] - own["start"]
    found, _ = np.histogram(late, [*EDGES, np.inf])
    return (
        len(own),
        tuple(int(one) for one in found),
        int((lengths > budget_us).sum()),
        int(own["promoted"].sum()),
        int(own["skipped"].sum()),
    )


def grown(before: Row, behind: Row) -> tuple[int, tuple[int, ...], int, int, int]:
    """By how much a row has grown."""
    late = tuple(b - a for a, b in zip(before.late, behind.late, strict=True))
    return (
        behind.runs - before.runs,
        late,
        behind.overruns - before.overruns,
        behind.promotions - before.promotions,
        behind.skipped - before.skipped,
    )


def telemetry_at(schedule: runs.Schedule, ms: int) -> int:
    """When the run of telemetry began that ended in the millisecond before this time."""
    names = [task.name for task in schedule.tasks]
    own = schedule.of(names.index("Telemetry"))
    (run,) = own[(own["end"] > 1000 * (ms - 1)) & (own["end"] <= 1000 * ms)]
    return int(run["start"])


def test_each_figure_is_what_the_log_of_the_same_flight_says(
    copter: Copter, tmp_path: Path
) -> None:
    """Each row tells of the moment in which telemetry made it: runs that ended before, and no
    others."""
    log = tmp_path / "flight.ulg"
    copter.log(log, trace=True)
    rig = Rig(copter)
    before = table(rig)
    troubled(rig)
    behind = table(rig)
    rig.run(100)  # The last runs go into the file.
    copter.log(None)
    schedule = runs.read(log)
    assert not schedule.dropouts
    assert sorted(before) == sorted(behind) == sorted(task.name for task in schedule.tasks)
    total: list[int] = [0, 0, 0, 0]
    for number, task in enumerate(schedule.tasks):
        old, new = before[task.name], behind[task.name]
        own = schedule.of(number)
        since, until = (telemetry_at(schedule, row.at_ms) for row in (old, new))
        between = own[(own["start"] >= since) & (own["start"] < until)]
        assert grown(old, new) == counted(between, task.budget_us), task.name
        assert (new.period_us, new.budget_us) == (task.period_us, task.budget_us)
        assert old.runs == sum(old.late) and new.runs == sum(new.late), task.name
        lengths = own["end"] - own["start"]
        assert new.longest_us == max(old.longest_us, int(lengths[own["start"] < until].max()))
        busy = int((between["end"] - between["start"]).sum())
        slack = 0.1 * (old.runs + new.runs)  # A mean is rounded down.
        assert abs(new.mean_us * new.runs - old.mean_us * old.runs - busy) <= slack, task.name
        assert new.load == pytest.approx(new.mean_us * new.runs / until * 100.0, abs=0.02)
        total = [
            a + b for a, b in zip(total, (sum(new.late[4:]), *grown(old, new)[2:]), strict=True)
        ]
    assert min(total) > 0, "nothing was late, too long, promoted or skipped: the test tests nothing"


def test_the_terminal_of_a_simulation_shows_the_same(copter: Copter) -> None:
    """At once, so all rows are of one moment."""
    rig = Rig(copter)
    here = rows_of(copter.console("tasks"), lambda _: rig.now_ms)
    by_link = table(rig)
    assert list(here) == list(by_link)
    for name, row in here.items():
        periods = 1 + 1000 * (by_link[name].at_ms - rig.now_ms + 2000) // row.period_us
        assert 0 <= by_link[name].runs - row.runs <= periods
    assert copter.console("help") == HELP
    assert copter.console("") == ""
    assert copter.console("\xe4 x" * 3000).startswith("no such command: ? x? x")


def full(text: str) -> bool:
    """Whether it is one whole table."""
    return len(rows_of(text, lambda _: 0)) == 23


def test_two_stations_do_not_disturb_one_another(copter: Copter) -> None:
    """By two links; and by one, as behind a router, where they take turns. Regular messages
    go on."""
    for links in ([Link(), Link()], [Link()]):
        rig = Rig(copter, links)
        other = mavlink.MAVLink(None, srcSystem=254, srcComponent=190)
        begun = rig.counts()
        rig.send(typed("tasks\n"))
        rig.copter.send(len(links) - 1, typed("tasks\n").pack(other))
        rig.run(3000)
        first, second = said(rig), said(rig, 0, len(links) - 1, (254, 190))
        assert full(first) and full(second)
        assert first.endswith(PROMPT) and second.endswith(PROMPT)
        assert (rig.counts() - begun)["ATTITUDE"] > 50  # Of 60.


def test_of_five_stations_by_one_link_the_first_is_gone(copter: Copter) -> None:
    rig = Rig(copter)
    for system in range(250, 255):
        packer = mavlink.MAVLink(None, srcSystem=system, srcComponent=190)
        rig.copter.send(0, typed("tasks\n").pack(packer))
        rig.run(20)
    rig.run(8000)
    whole = [said(rig, 0, 0, (system, 190)).endswith(f"\n{PROMPT}") for system in range(250, 255)]
    assert whole == [False, True, True, True, True]


def test_a_slow_link_carries_all_of_it(copter: Copter) -> None:
    rig = Rig(copter, [Link(1200)])
    rig.send(typed("tasks\n"))
    rig.run(120_000)
    assert full(said(rig))
    assert rig.counts()["HEARTBEAT"] > 60


def test_flights_are_the_same_with_it_and_without(copter: Copter) -> None:
    """It costs no time of another task's."""

    def flown(texts: Sequence[str]) -> bytes:
        rig = Rig(copter)
        for text in texts:
            rig.send(typed(text))
        rig.run(2000)
        rig.copter.look()
        return bytes(rig.copter.view_bytes)

    assert flown(["tasks\n"]) == flown([])


def test_lines_of_a_pipe_come_as_they_are_typed() -> None:
    reads, writes = os.pipe()
    keyboard = Keyboard(reads)
    assert keyboard.lines() == []
    os.write(writes, b"tas")
    assert keyboard.lines() == []
    os.write(writes, b"ks\r\n\nhelp\nla")
    assert keyboard.lines() == ["tasks", "", "help"]
    os.write(writes, b"st")
    os.close(writes)
    assert keyboard.lines() == []
    assert keyboard.lines() == ["last"]  # With the end.
    os.close(reads)
    assert keyboard.lines() == []


def test_a_terminal_of_others_is_left_alone() -> None:
    """Who is not in its foreground would be stopped."""
    ours, theirs = pty.openpty()
    os.write(ours, b"tasks\n")
    assert Keyboard(theirs).lines() == []
    os.close(ours)
    os.close(theirs)
    assert Keyboard(theirs).lines() == []
