# SPDX-License-Identifier: Apache-2.0
"""Logs as other autopilots write them, and damaged ones: pyulog reads the former alike, and of the
latter a message costs itself. The logs are made here, message by message."""

from __future__ import annotations

import random
import struct
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pyulog import ULog

from keel.base.errors import ToolError
from keel.logs import log as log_tool
from keel.logs import log_plots
from keel.timeline import ulog

FLIPS = 1500
SYNC = bytes.fromhex("2f731320250cbb12")
# As PX4's: formats in formats, arrays of them, and bytes that fill up the end of each.
FORMATS = (
    "vehicle_attitude:uint64_t timestamp;uint64_t timestamp_sample;float[4] q;uint8_t count;"
    "uint8_t[7] _padding0;",
    "esc_report:uint64_t timestamp;int32_t rpm;float voltage;uint8_t[3] state;"
    "uint8_t[5] _padding0;",
    "esc_status:uint64_t timestamp;uint16_t counter;bool armed;char kind;uint8_t[4] _padding0;"
    "esc_report[2] esc;",
    "vehicle_local_position:uint64_t timestamp;float x;float y;float z;double ref_lat;int64_t far;"
    "int8_t a;int16_t b;uint32_t c;uint8_t[1] _padding0;",
    "sensor_combined:uint64_t timestamp;float[3] gyro_rad;float[3] accelerometer_m_s2;",
    "cpuload:uint64_t timestamp;float load;",
    "actuator_outputs:uint64_t timestamp;uint32_t noutputs;float[8] output;",
)
ATTITUDE, ESC, PLACE, COMBINED, LOAD, OUTPUTS, LATE = 0, 1, 2, 3, 4, 5, 700


def message(kind: str, body: bytes) -> bytes:
    """A whole message."""
    return struct.pack("<HB", len(body), ord(kind)) + body


def keyed(kind: str, key: str, value: bytes, before: bytes = b"") -> bytes:
    """Information or a parameter."""
    return message(kind, before + bytes([len(key)]) + key.encode() + value)


def begun(topic: int, name: str, instance: int = 0) -> bytes:
    """A topic begins."""
    return message("A", bytes([instance]) + struct.pack("<H", topic) + name.encode())


def head(flags: int = 0, offsets: Iterable[int] = (0, 0, 0)) -> bytes:
    """The file's first bytes, with the message of flags."""
    bits_of_flags = bytes([1, *[0] * 7, flags, *[0] * 7])
    return (
        bytes.fromhex("554c6f6701123501")
        + struct.pack("<Q", 123456)
        + message("B", bits_of_flags + struct.pack("<3Q", *offsets))
    )


def definitions() -> list[bytes]:
    """What comes before data."""
    return [
        *(message("F", text.encode()) for text in reversed(FORMATS)),
        keyed("I", "char[3] sys_name", b"PX4"),
        keyed("I", "uint32_t ver_release", struct.pack("<I", 0x010D0000)),
        keyed("I", "int32_t time_ref_utc", struct.pack("<i", -3600)),
        keyed("I", "double drift", struct.pack("<d", 0.25)),
        keyed("M", "char[5] perf", b"first", b"\0"),
        keyed("M", "char[4] perf", b"more", b"\1"),
        keyed("M", "char[5] perf", b"again", b"\0"),
        keyed("M", "uint8_t[2] events", b"\0\xff", b"\0"),
        keyed("P", "float MC_ROLL_P", struct.pack("<f", 6.5)),
        keyed("P", "int32_t SYS_AUTOSTART", struct.pack("<i", 4001)),
        keyed("P", "int64_t WIDE", struct.pack("<q", -(1 << 40))),
        keyed("Q", "float MC_ROLL_P", struct.pack("<f", 7.0), b"\3"),
        keyed("Q", "int32_t SYS_AUTOSTART", struct.pack("<i", 0), b"\1"),
    ]


def attitude(time_us: int, number: int) -> bytes:
    """A sample without the bytes that fill up its end, as PX4 writes it."""
    return struct.pack("<QQ4fB", time_us, time_us - 5, 1.0, 0.01 * number, -0.5, 0.0, number % 256)


def esc(time_us: int, number: int) -> bytes:
    """A sample with two formats in it."""
    parts = b"".join(
        struct.pack("<Qif3B5x", time_us - at, 1000 * number - at, 11.5 + at, at, 2, 3)
        for at in range(2)
    )
    return struct.pack("<QH?c4x", time_us, number, number % 2 == 1, b"x") + parts


def place(time_us: int, number: int) -> bytes:
    """A sample with numbers of many lengths."""
    return struct.pack(
        "<Q3fdqbhI", time_us, number, -number, -2.0, 47.4, -(1 << 50), -7, -300, 1 << 31
    )


def data(topic: int, body: bytes) -> bytes:
    """A sample."""
    return message("D", struct.pack("<H", topic) + body)


def samples(count: int) -> Iterator[bytes]:
    """Of all topics, five milliseconds apart."""
    for number in range(count):
        time_us = 20_000_000 + 5000 * number
        shake = 0.2 * np.sin(0.9 * number)
        yield data(ATTITUDE, attitude(time_us, number))
        yield data(ESC, esc(time_us + 1, number))
        yield data(PLACE, place(time_us + 2, number))
        yield data(COMBINED, struct.pack("<Q6f", time_us + 3, shake, 0, 0, 0, shake, -9.8))
        yield data(LOAD, struct.pack("<Qf", time_us + 4, 0.37))
        yield data(OUTPUTS, struct.pack("<QI8f", time_us + 5, 4, *(1100.0 + at for at in range(8))))


def recording(count: int = 100) -> list[bytes]:
    """A log, message by message; with all kinds of them."""
    every = list(samples(count))
    half = len(every) // 2
    return [
        head(),
        *definitions(),
        begun(ATTITUDE, "vehicle_attitude"),
        begun(ESC, "esc_status", 1),
        begun(PLACE, "vehicle_local_position"),
        begun(COMBINED, "sensor_combined"),
        begun(LOAD, "cpuload"),
        begun(OUTPUTS, "actuator_outputs"),
        *every[:half],
        message("L", b"4" + struct.pack("<Q", 20_100_000) + b"[commander] takeoff"),
        message("C", b"6" + struct.pack("<HQ", 9, 20_100_007) + "[tag] 20 µs".encode()),
        message("S", SYNC),
        message("O", struct.pack("<H", 120)),
        keyed("P", "float MC_ROLL_P", struct.pack("<f", 5.5)),
        message("R", struct.pack("<H", LOAD)),
        begun(LATE, "cpuload", 1),
        data(LATE, struct.pack("<Qf", 20_100_009, 0.5)),
        *(one for one in every[half:] if one[3:5] != struct.pack("<H", LOAD)),
    ]


def written(folder: Path, content: bytes) -> Path:
    """The file."""
    path = folder / "other.ulg"
    path.write_bytes(content)
    return path


def flat(before: str, rows: Any) -> dict[str, Any]:
    """Fields by pyulog's names: esc[1].rpm."""
    found: dict[str, Any] = {}
    for name in rows.dtype.names:
        shape = rows.dtype[name].shape
        parts = (
            {f"{before}{name}[{at}]": rows[name][:, at] for at in range(shape[0])}
            if shape
            else {f"{before}{name}": rows[name]}
        )
        for path, part in parts.items():
            found.update(flat(f"{path}.", part) if part.dtype.names else {path: part})
    return found


def bits(values: Any) -> Any:
    """As pyulog has truths and letters: whole numbers."""
    return np.frombuffer(values.tobytes(), "i1") if values.dtype.kind in "bS" else values


def compare(path: Path) -> ulog.Log:
    """All that both readers have."""
    ours, theirs = ulog.read(path), ULog(str(path))
    assert not theirs.file_corruption and not ours.damage and not ours.cut
    assert {topic for topic, rows in ours.data.items() if len(rows)} == {
        (topic.name, topic.multi_id) for topic in theirs.data_list
    }
    for topic in theirs.data_list:
        fields = flat("", ours.topic(topic.name, topic.multi_id))
        assert list(fields) == list(topic.data)
        for name, column in topic.data.items():
            np.testing.assert_array_equal(bits(fields[name]), column)
    assert ours.parameters == theirs.initial_parameters
    assert ours.changed == theirs.changed_parameters
    assert ours.defaults == {bit: theirs.get_default_parameters(bit) for bit in ours.defaults}
    assert ours.information == theirs.msg_info_dict
    assert ours.lists == theirs.msg_info_multiple_dict
    assert ours.dropouts == [(one.timestamp, one.duration) for one in theirs.dropouts]
    tagged = [one for some in theirs.logged_messages_tagged.values() for one in some]
    assert [(text.time_us, text.text, ord(text.level), text.tag) for text in ours.texts] == [
        (one.timestamp, one.message, one.log_level, getattr(one, "tag", None))
        for one in [*theirs.logged_messages, *tagged]
    ]
    return ours


def test_it_reads_what_pyulog_reads(tmp_path: Path) -> None:
    log = compare(written(tmp_path, b"".join(recording())))
    assert log.start_us == 123456 and len(log.data) == 7
    assert log.information == {
        "sys_name": "PX4",
        "ver_release": 0x010D0000,
        "time_ref_utc": -3600,
        "drift": 0.25,
    }
    assert log.lists == {"perf": [["first", "more"], ["again"]], "events": [[b"\0\xff"]]}
    assert log.parameters == {"MC_ROLL_P": 6.5, "SYS_AUTOSTART": 4001, "WIDE": -(1 << 40)}
    assert [each[1:] for each in log.changed] == [("MC_ROLL_P", 5.5)]
    assert log.defaults == {0: {"MC_ROLL_P": 7.0, "SYS_AUTOSTART": 0}, 1: {"MC_ROLL_P": 7.0}}
    assert [(text.text, text.tag) for text in log.texts] == [
        ("[commander] takeoff", None),
        ("[tag] 20 µs", 9),
    ]
    assert [length for _, length in log.dropouts] == [120]
    reports = log.topic("esc_status", 1)["esc"]
    np.testing.assert_array_equal(reports["rpm"][:, 1], 1000 * np.arange(100) - 1)
    assert log.topic("vehicle_local_position")["ref_lat"][3] == 47.4
    assert len(log.topic("cpuload")) == 50 and len(log.topic("cpuload", 1)) == 1


def test_bytes_that_fill_up_the_end_may_be_there(tmp_path: Path) -> None:
    more = [data(ATTITUDE, attitude(30_000_000, 7) + bytes(7))]
    log = ulog.read(written(tmp_path, b"".join([*recording(4), *more])))
    assert not log.damage and log.topic("vehicle_attitude")["count"].tolist() == [0, 1, 2, 3, 7]


def test_what_was_appended_is_read_though_the_last_message_before_it_is_cut(tmp_path: Path) -> None:
    messages = recording(20)
    end = sum(len(one) for one in messages) - 11
    more = [data(ATTITUDE, attitude(30_000_000, 77)), keyed("M", "char[4] dump", b"hard", b"\0")]
    messages[0] = head(1, (end, 0, 0))
    path = written(tmp_path, b"".join(messages)[:end] + b"".join(more))
    log = ulog.read(path)
    assert log.topic("vehicle_attitude")["count"].tolist() == [*range(20), 77]
    assert log.lists["dump"] == ULog(str(path)).msg_info_multiple_dict["dump"] == [["hard"]]
    assert log.cut == len(messages[-1]) - 11 and not log.damage


def test_flags_that_a_reader_must_know_are_refused(tmp_path: Path) -> None:
    path = written(tmp_path, head(2) + b"".join(recording(2)[1:]))
    with pytest.raises(ToolError, match=r"other\.ulg: byte 27: the flags 02 00"):
        ulog.read(path)


@pytest.mark.parametrize(
    "text",
    [
        "loop:uint64_t timestamp;loop[2] self;",
        "none:uint64_t timestamp;missing more;",
        "huge:uint64_t timestamp;float[70000] much;",
        "zero:float[0] nothing;",
        "empty:",
        "twice:float a;float a;",
        "_only:uint8_t[4] _padding0;",
        f"long:char[{'9' * 5000}] x;",
    ],
)
def test_formats_that_cannot_be_are_told(tmp_path: Path, text: str) -> None:
    wrong = [message("F", text.encode()), begun(9, text.partition(":")[0])]
    messages = [*recording(4), *wrong, data(ATTITUDE, attitude(30_000_000, 5))]
    log = ulog.read(written(tmp_path, b"".join(messages)))
    assert len(log.damage) >= 1 and len(log.topic("vehicle_attitude")) == 5


def test_formats_in_formats_in_formats_end(tmp_path: Path) -> None:
    chain = [message("F", f"f{at}:f{at + 1} x;".encode()) for at in range(3000)]
    log = ulog.read(written(tmp_path, b"".join([head(), *chain, begun(9, "f0")])))
    assert [damage.reason for damage in log.damage][-1].endswith("too deep in others, or in itself")


def counts(log: ulog.Log) -> int:
    """How many samples there are."""
    return sum(len(rows) for rows in log.data.values())


def test_a_damaged_message_costs_itself(tmp_path: Path) -> None:
    """Each bit of each head, and of each number of a topic, of the data."""
    messages = recording(6)
    whole = ulog.read(written(tmp_path, b"".join(messages)))
    at = 0
    for one in messages:
        for bit in range(40 if one[2:3] == b"D" else 0):
            content = bytearray(b"".join(messages))
            content[at + bit // 8] ^= 1 << bit % 8
            log = ulog.read(written(tmp_path, bytes(content)))
            assert counts(log) == counts(whole) - 1, (at, bit)
            assert [damage.at for damage in log.damage] == [at] or log.cut, (at, bit)
            assert log.texts == whole.texts and log.parameters == whole.parameters
        at += len(one)


def test_a_damaged_topic_costs_its_samples(tmp_path: Path) -> None:
    """Also where it comes with each other sample."""
    one = [data(LOAD, struct.pack("<Qf", at, 0.1)) for at in range(9)]
    other = [data(LATE, struct.pack("<Qf", at, 0.2)) for at in range(9)]
    both = [each for pair in zip(one, other, strict=True) for each in pair]
    for wrong in (begun(LATE, "cpulead", 1), begun(LATE + 1, "cpuload", 1)):
        parts = [head(), *definitions(), begun(LOAD, "cpuload"), wrong, *both, *one]
        log = ulog.read(written(tmp_path, b"".join(parts)))
        assert len(log.topic("cpuload")) == 18 and len(log.damage) >= 9


def test_garbage_between_messages_costs_nothing_else(tmp_path: Path) -> None:
    draw, messages = random.Random(20261127), recording(12)
    whole = ulog.read(written(tmp_path, b"".join(messages)))
    first = next(at for at, one in enumerate(messages) if one[2:3] == b"D")
    for _ in range(200):
        before = draw.randrange(first, len(messages))
        noise = draw.randbytes(draw.randrange(1, 300))
        parts = [*messages[:before], noise, *messages[before:]]
        log = ulog.read(written(tmp_path, b"".join(parts)))
        assert counts(log) >= counts(whole) - 1
        assert log.damage[0].at == sum(len(one) for one in messages[:before])


def look(path: Path) -> None:
    """All of `make log` but the picture; errors are for users."""
    try:
        log = ulog.read(path)
    except ToolError as error:
        assert str(path) in str(error)
        return
    for table in (log_plots.topics(log), log_plots.tasks(log, []), log_plots.vibration(log)):
        assert table is None or table.columns
    for find, _ in log_plots.OVER_TIME:
        find(log)


def test_no_flipped_bit_ends_in_a_traceback(tmp_path: Path) -> None:
    draw, content = random.Random(20261128), b"".join(recording(70))
    for _ in range(FLIPS):
        flipped = bytearray(content)
        for _ in range(draw.choice((1, 1, 1, 2, 20))):
            flipped[draw.randrange(len(flipped))] ^= 1 << draw.randrange(8)
        look(written(tmp_path, bytes(flipped)))


def test_make_log_shows_what_another_has_and_where_it_is_damaged(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    messages = recording()
    at = sum(len(one) for one in messages[:40])
    messages[40] = b"\xff" + messages[40][1:]
    path = written(tmp_path, b"".join(messages))
    assert log_tool.main([str(path), "--picture", str(tmp_path / "other.svg")]) == 0
    told = capsys.readouterr().out
    assert "esc_status 1" in told and "sensor_combined 0" in told and "takeoff" in told
    assert f"other.ulg: byte {at}: " in told and "1 places are damaged" in told
    drawn = (tmp_path / "other.svg").read_text()
    assert all(word in drawn for word in ("roll", "north", "motors", "load, %", "frequency, Hz"))


def test_damaged_logs_are_drawn(tmp_path: Path) -> None:
    draw, content = random.Random(20261129), b"".join(recording(70))
    for _ in range(6):
        flipped = bytearray(content)
        for _ in range(30):
            flipped[draw.randrange(64, len(flipped))] ^= 1 << draw.randrange(8)
        path = written(tmp_path, bytes(flipped))
        assert log_tool.main([str(path), "--picture", str(tmp_path / "other.svg")]) == 0


def test_a_log_with_nothing_to_draw(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path, head() + b"".join(definitions()))
    assert log_tool.main([str(path), "--picture", str(tmp_path / "none.svg")]) == 0
    assert "nothing that a picture shows" in capsys.readouterr().out
    assert not (tmp_path / "none.svg").exists()
