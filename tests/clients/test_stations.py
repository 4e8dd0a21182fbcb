# SPDX-License-Identifier: Apache-2.0
"""Ground stations that connect, on the virtual clock, by QGroundControl's sequence and time-outs,
with losses and without; and that whatever is asked is answered at once.

Equal runs are equal: nothing here waits.
"""

from __future__ import annotations

import json
import random
import struct
from collections import Counter
from collections.abc import Iterable
from datetime import UTC, datetime
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
from pymavlink.dialects.v20 import common as mavlink
from qgroundcontrol import Driver, Met, QGroundControl, Reply, kind_of, payload_of
from test_telemetry import Rig

from keel.flight import device_frames
from keel.flight.library import Copter, Link
from keel.timeline import ulog

ROOT = Path(__file__).resolve().parents[2]
ACCEPTED, UNSUPPORTED, INVALID_SEQUENCE, DENIED = 0, 3, 13, 2
MISSION, FENCE, RALLY, ALL = 0, 1, 2, 255
AT_ONCE_MS = 100
EVERYBODY, OTHERS = 0, 7


class Meeting:
    """Stations that meet a copter, each by its own link, of which datagrams may be lost."""

    def __init__(self, rig: Rig, lost: float = 0.0, noise: int = 0, seed: int = 5) -> None:
        self.rig, self._lost, self._noise, self._seed = rig, lost, noise, seed
        self._rng = random.Random(seed)
        self._chances: dict[str, random.Random] = {}
        self.asked: Counter[int] = Counter()  # Parameters that were asked for, and not in vain.
        self._driver = Driver()
        self._links: list[int] = []

    def loses(self, kind: str) -> bool:
        """Whether the next message of a kind is lost. Each kind has its own chances, so that one
        that is sent more often takes nothing from the others."""
        chances = self._chances.setdefault(kind, random.Random(f"{self._seed} {kind}"))
        return chances.random() < self._lost

    def station(self, link: int, system: int = 255) -> Met:
        """One that begins to connect."""
        packer = mavlink.MAVLink(None, srcSystem=system, srcComponent=190)

        def send(message: Any) -> None:
            if self._noise:
                self.rig.copter.send(link, self._rng.randbytes(self._noise))
            if not self.loses(f"to the copter: {message.get_type()}"):
                self.rig.copter.send(link, message.pack(packer))
                if message.get_type() == "PARAM_REQUEST_READ":
                    self.asked[message.param_index] += 1

        made = QGroundControl(send, system)
        self._driver.add(made.connect(), self.rig.now_ms)
        self._links.append(link)
        return made.met

    def until_done(self, most_ms: int) -> int:
        """All have ended; tells how long it took."""
        rig, begun = self.rig, self.rig.now_ms
        seen = {link: len(rig.seen[link]) for link in self._links}
        while min(self._driver.done) < 0:
            assert rig.now_ms - begun < most_ms, "it does not end"
            rig.run(1)
            for number, link in enumerate(self._links):
                new = [m for m in rig.seen[link][seen[link] :] if not self.loses(m.get_type())]
                self._driver.hear(number, new, rig.now_ms)
            seen = {link: len(rig.seen[link]) for link in self._links}
        return rig.now_ms - begun


def is_whole(met: Met) -> None:
    """All that there is to know was told, and is right."""
    assert met.version.flight_sw_version > 0
    assert met.protocol == (200, 200, 200)
    told = json.loads(met.files["parameters"])
    assert told == json.loads((ROOT / "examples/copter/parameters.json").read_text("utf-8"))
    names = [met.parameters[index].param_id for index in sorted(met.parameters)]
    assert names == [one["name"] for one in told["parameters"]]
    assert met.plans == {"mission": 0, "fence": 0, "rally": 0}


def test_it_connects_from_cold_without_a_time_out(copter: Copter) -> None:
    meeting = Meeting(Rig(copter, warm_ms=0))
    met = meeting.station(0)
    took_ms = meeting.until_done(20_000)
    assert not met.late and not met.errors
    is_whole(met)
    assert took_ms < 5000


def test_it_connects_again_after_silence(copter: Copter) -> None:
    meeting = Meeting(Rig(copter, warm_ms=0))
    meeting.station(0)
    meeting.until_done(20_000)
    meeting.rig.run(30_000)
    met = meeting.station(0)
    meeting.until_done(20_000)
    assert not met.late and not met.errors
    is_whole(met)


def test_two_connect_at_once(copter: Copter) -> None:
    """By two links; and by one, as behind a router."""
    meeting = Meeting(Rig(copter, [Link(), Link()], warm_ms=0))
    both = [meeting.station(0, 255), meeting.station(1, 254)]
    meeting.until_done(30_000)
    shared = Meeting(Rig(copter, warm_ms=0))
    both += [shared.station(0, 255), shared.station(0, 254)]
    shared.until_done(30_000)
    for met in both:
        assert not met.late and not met.errors
        is_whole(met)


def test_it_connects_by_a_modem(copter: Copter) -> None:
    """As much as 57600 baud carry."""
    meeting = Meeting(Rig(copter, [Link(5760)], warm_ms=0))
    met = meeting.station(0)
    took_ms = meeting.until_done(60_000)
    assert not met.late and not met.errors
    is_whole(met)
    assert took_ms < 20_000


@pytest.mark.parametrize(
    ("lost", "most_s", "missing", "seed"), [(0.05, 60, 0, 5), (0.3, 120, 3, 5)]
)
def test_it_connects_over_a_bad_link(
    copter: Copter, lost: float, most_s: int, missing: int, seed: int
) -> None:
    """It ends. Files may be given up, and so may a parameter that QGroundControl has asked for in
    vain six times: how many it lacks then is chance. The copter answers whatever reaches it."""
    meeting = Meeting(Rig(copter, warm_ms=0), lost, seed=seed)
    met = meeting.station(0)
    meeting.until_done(1000 * most_s)
    assert met.late  # Something was lost.
    assert not [
        error
        for error in met.errors
        if "mftp" not in error and (not missing or "missing" not in error)
    ]
    count = next(iter(met.parameters.values())).param_count
    assert len(met.parameters) >= count - missing
    assert met.plans == {"mission": 0, "fence": 0, "rally": 0}
    told = Counter(
        message.param_index
        for message in meeting.rig.seen[0]
        if message.get_type() == "PARAM_VALUE"
    )
    assert meeting.asked and all(told[one] > times for one, times in meeting.asked.items())


def test_it_connects_between_noise(copter: Copter) -> None:
    """A thousand bytes before each request; and behind 10^5 of them, of which the last may seem to
    begin a frame, so that a request is lost."""
    rig = Rig(copter, [Link(100_000)], warm_ms=0)
    meeting = Meeting(rig, noise=1000)
    met = meeting.station(0)
    meeting.until_done(120_000)
    assert not [error for error in met.errors if "mftp" not in error]
    assert met.plans == {"mission": 0, "fence": 0, "rally": 0}
    rest = random.Random(1)
    for _ in range(100):
        rig.copter.send(0, rest.randbytes(1000))
        rig.run(100)
    meeting = Meeting(rig)
    met = meeting.station(0)
    meeting.until_done(20_000)
    assert not met.errors
    is_whole(met)


def asked(rig: Rig, message: Any, *kinds: str, within_ms: int = AT_ONCE_MS) -> list[Any]:
    """What of these kinds comes at once."""
    begun = len(rig.seen[0])
    rig.send(message)
    rig.run(within_ms)
    return [one for one in rig.seen[0][begun:] if one.get_type() in kinds]


def plans(kind: int, system: int = 1, component: int = 1) -> Iterable[tuple[Any, str, int]]:
    """Each message about missions, its answer, and the result in it."""
    item = (0, 0, 0, 0, 0)
    yield (
        mavlink.MAVLink_mission_request_list_message(system, component, kind),
        "MISSION_COUNT",
        0,
    )
    yield (
        mavlink.MAVLink_mission_clear_all_message(system, component, kind),
        "MISSION_ACK",
        ACCEPTED,
    )
    for count, result in ((0, ACCEPTED), (3, UNSUPPORTED)):
        yield (
            mavlink.MAVLink_mission_count_message(system, component, count, kind),
            "MISSION_ACK",
            result,
        )
    for request in (
        mavlink.MAVLink_mission_request_message,
        mavlink.MAVLink_mission_request_int_message,
    ):
        yield request(system, component, 0, kind), "MISSION_ACK", INVALID_SEQUENCE
    yield (
        mavlink.MAVLink_mission_request_partial_list_message(system, component, 0, 1, kind),
        "MISSION_ACK",
        INVALID_SEQUENCE,
    )
    yield (
        mavlink.MAVLink_mission_write_partial_list_message(system, component, 0, 1, kind),
        "MISSION_ACK",
        UNSUPPORTED,
    )
    for write, place in (
        (mavlink.MAVLink_mission_item_message, (47.0, 8.0, 5.0)),
        (mavlink.MAVLink_mission_item_int_message, (47, 8, 5.0)),
    ):
        yield (
            write(system, component, 0, 3, 16, *item, 0, *place, kind),
            "MISSION_ACK",
            UNSUPPORTED,
        )


@pytest.mark.parametrize("kind", [MISSION, FENCE, RALLY])
def test_each_request_about_missions_is_answered_at_once(copter: Copter, kind: int) -> None:
    rig = Rig(copter, warm_ms=500)
    for message, name, result in plans(kind):
        answers = asked(rig, message, "MISSION_COUNT", "MISSION_ACK")
        assert len(answers) == 1, message
        answer = answers[0]
        assert (answer.target_system, answer.target_component) == (255, 190)
        assert answer.get_type() == name and answer.mission_type == kind, message
        assert (answer.count if name == "MISSION_COUNT" else answer.type) == result, message


def test_missions_of_no_kind_are_refused(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    for message, _, _ in plans(3):
        (answer,) = asked(rig, message, "MISSION_COUNT", "MISSION_ACK")
        assert (answer.get_type(), answer.type) == ("MISSION_ACK", UNSUPPORTED), message
    (answer,) = asked(rig, mavlink.MAVLink_mission_clear_all_message(1, 1, ALL), "MISSION_ACK")
    assert (answer.type, answer.mission_type) == (ACCEPTED, ALL)
    assert asked(rig, mavlink.MAVLink_mission_set_current_message(1, 1, 0), "STATUSTEXT")


def test_logs_are_answered_at_once(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    (entry,) = asked(rig, mavlink.MAVLink_log_request_list_message(1, 1, 0, 0xFFFF), "LOG_ENTRY")
    assert (entry.id, entry.num_logs, entry.size) == (0, 0, 0)
    (data,) = asked(rig, mavlink.MAVLink_log_request_data_message(1, 1, 9, 70_000, 90), "LOG_DATA")
    assert (data.id, data.ofs, data.count) == (9, 70_000, 0)
    assert asked(rig, mavlink.MAVLink_log_erase_message(1, 1), "STATUSTEXT")


def test_requests_in_a_row_are_all_answered(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    for kind in (MISSION, FENCE, RALLY):
        rig.send(mavlink.MAVLink_mission_request_list_message(1, 1, kind))
    rig.send(mavlink.MAVLink_mission_clear_all_message(1, 1, ALL))
    rig.send(mavlink.MAVLink_log_request_list_message(1, 1, 0, 0xFFFF))
    rig.run(300)
    counts = rig.counts()
    assert (counts["MISSION_COUNT"], counts["MISSION_ACK"], counts["LOG_ENTRY"]) == (3, 1, 1)


def test_who_is_meant_answers_and_nobody_else(copter: Copter) -> None:
    """A system and a component that are 0 are all; others are others."""
    rig = Rig(copter, warm_ms=500)
    for system, component, meant in (
        (1, 1, True),
        (EVERYBODY, EVERYBODY, True),
        (1, EVERYBODY, True),
        (EVERYBODY, 1, True),
        (OTHERS, 1, False),
        (1, OTHERS, False),
        (OTHERS, EVERYBODY, False),
    ):
        messages = [message for message, _, _ in plans(MISSION, system, component)]
        messages += [
            mavlink.MAVLink_log_request_list_message(system, component, 0, 9),
            mavlink.MAVLink_log_request_data_message(system, component, 0, 0, 9),
            mavlink.MAVLink_log_erase_message(system, component),
            mavlink.MAVLink_mission_set_current_message(system, component, 0),
            file_message(Reset, system=system, component=component),
        ]
        for message in messages:
            answers = asked(
                rig,
                message,
                "MISSION_COUNT",
                "MISSION_ACK",
                "LOG_ENTRY",
                "LOG_DATA",
                "STATUSTEXT",
                "FILE_TRANSFER_PROTOCOL",
            )
            # Nobody has asked whether the pilot's receiver is heard; that is told all the same.
            answers = [one for one in answers if "radio" not in getattr(one, "text", "")]
            assert len(answers) == int(meant), (system, component, message)


# Files

Nothing, Terminate, Reset, List, Open, Read, Crc, Burst = 0, 1, 2, 3, 4, 5, 14, 15
Ack, Nak = 128, 129
INVALID_SIZE, INVALID_SESSION, EOF, UNKNOWN, PROTECTED, NOT_FOUND = 3, 4, 6, 7, 9, 10
PARAMETERS_FILE = json.dumps(
    json.loads((ROOT / "examples/copter/parameters.json").read_text("utf-8")), separators=(",", ":")
).encode()


def file_message(
    opcode: int,
    session: int = 0,
    offset: int = 0,
    size: int = 0,
    data: bytes = b"",
    sequence: int = 40,
    system: int = 1,
    component: int = 1,
) -> Any:
    """A request of a file server."""
    head = struct.pack("<HBBBBBBI", sequence, session, opcode, size or len(data), 0, 0, 0, offset)
    payload = list((head + data).ljust(251, b"\0"))
    return mavlink.MAVLink_file_transfer_protocol_message(0, system, component, payload)


def files(rig: Rig, message: Any, within_ms: int = AT_ONCE_MS) -> list[Reply]:
    """Its answers."""
    kind = "FILE_TRANSFER_PROTOCOL"
    return [Reply.of(bytes(one.payload)) for one in asked(rig, message, kind, within_ms=within_ms)]


def error_of(rig: Rig, message: Any) -> int:
    """With which it is refused."""
    (reply,) = files(rig, message)
    assert (reply.opcode, reply.size, reply.sequence) == (Nak, 1, 41)
    return reply.data[0]


def crc_of(data: bytes) -> int:
    """CRC-32 by the book, a bit at a time: 0 before the first, and as it is behind the last."""
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ (0xEDB88320 if crc & 1 else 0)
    return crc


def test_files_are_read(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    for path in (b"/parameters.json", b"parameters.json", b"//parameters.json\0rest"):
        (opened,) = files(rig, file_message(Open, data=path))
        assert (opened.opcode, opened.request, opened.size, opened.sequence) == (Ack, Open, 4, 41)
        assert struct.unpack("<I", opened.data[:4])[0] == len(PARAMETERS_FILE)
    (read,) = files(rig, file_message(Read, opened.session, 1000, 100, sequence=0xFFFF))
    assert (read.opcode, read.sequence, read.offset, read.size) == (Ack, 0, 1000, 100)
    assert read.data[:100] == PARAMETERS_FILE[1000:1100]
    left = len(PARAMETERS_FILE) % 100
    (last,) = files(rig, file_message(Read, opened.session, len(PARAMETERS_FILE) - left, 255))
    assert last.data[: last.size] == PARAMETERS_FILE[-left:]
    (whole,) = files(rig, file_message(Read, opened.session, 0, 255))
    assert (whole.size, whole.data[:239]) == (239, PARAMETERS_FILE[:239])


def test_bursts_are_whole_and_others_are_not_held_up(copter: Copter) -> None:
    rig = Rig(copter)
    (opened,) = files(rig, file_message(Open, data=b"/parameters.json"))
    before = rig.counts()
    replies = files(rig, file_message(Burst, opened.session, 0, 239), within_ms=3000)
    assert b"".join(one.data[: one.size] for one in replies) == PARAMETERS_FILE
    assert [one.sequence for one in replies] == [41 + n for n in range(len(replies))]
    assert [one.complete for one in replies] == [0] * (len(replies) - 1) + [1]
    assert (rig.counts() - before)["ATTITUDE"] > 45  # Of 60.
    assert error_of(rig, file_message(Burst, opened.session, len(PARAMETERS_FILE), 239)) == EOF


def test_a_burst_ends_when_its_reader_asks_for_something_else(copter: Copter) -> None:
    for opcode in (Terminate, Reset):
        rig = Rig(copter, warm_ms=500)
        (opened,) = files(rig, file_message(Open, data=b"/parameters.json"))
        some = files(rig, file_message(Burst, opened.session, 0, 60), within_ms=200)
        assert 3 < len(some) and not some[-1].complete
        (done,) = [
            one
            for one in files(rig, file_message(opcode, opened.session), within_ms=500)
            if one.request == opcode
        ]
        assert done.opcode == Ack
        rig.seen[0].clear()
        rig.run(1000)
        assert rig.counts()["FILE_TRANSFER_PROTOCOL"] == 0


def test_the_directory_and_sums(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    for path in (b"/", b"", b"."):
        (listed,) = files(rig, file_message(List, data=path))
        entries = listed.data[: listed.size].split(b"\0")[:-1]
        assert [entry.split(b"\t")[0] for entry in entries] == [
            b"Fgeneral.json",
            b"Fparameters.json",
        ]
    assert entries[1].split(b"\t")[1] == str(len(PARAMETERS_FILE)).encode()
    (second,) = files(rig, file_message(List, offset=1, data=b"/"))
    assert second.data[: second.size] == entries[1] + b"\0"
    assert error_of(rig, file_message(List, offset=2, data=b"/")) == EOF
    assert error_of(rig, file_message(List, data=b"/logs")) == NOT_FOUND
    (summed,) = files(rig, file_message(Crc, data=b"/parameters.json"))
    assert struct.unpack("<I", summed.data[:4])[0] == crc_of(PARAMETERS_FILE)


def test_what_files_refuse(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    for opcode in (Open, Crc):
        for path in (b"/nothing", b"/parameters.jso", b"/parameters.jsonx", b"/", b""):
            assert error_of(rig, file_message(opcode, data=path)) == NOT_FOUND
    for opcode in (Read, Burst):
        assert error_of(rig, file_message(opcode, 0, 0, 9)) == INVALID_SESSION
    files(rig, file_message(Open, data=b"/parameters.json"))
    assert error_of(rig, file_message(Burst, 1, 0, 0)) == INVALID_SIZE
    assert error_of(rig, file_message(Read, 1, len(PARAMETERS_FILE), 9)) == EOF
    assert error_of(rig, file_message(Read, 1, 0xFFFFFFFF, 9)) == EOF
    for opcode in range(6, 14):
        assert error_of(rig, file_message(opcode, data=b"/parameters.json")) == PROTECTED
    for opcode in (16, 100, Ack, Nak, 255):
        assert error_of(rig, file_message(opcode)) == UNKNOWN
    for opcode in (Nothing, Terminate, Reset):
        files(rig, file_message(Open, data=b"/parameters.json"))
        (reply,) = files(rig, file_message(opcode))
        assert (reply.opcode, reply.size, reply.request) == (Ack, 0, opcode)
        (read,) = files(rig, file_message(Read, 0, 0, 9))
        assert read.opcode == (Ack if opcode == Nothing else Nak)


def test_each_station_has_its_own_file(copter: Copter) -> None:
    """Whatever numbers they give to their sessions; of five that read by one link, the first one
    must open its file again."""
    rig = Rig(copter, warm_ms=500)
    stations = [mavlink.MAVLink(None, srcSystem=250 + number) for number in range(5)]

    def told(number: int, message: Any) -> Reply:
        rig.station = stations[number]
        (reply,) = files(rig, message)
        return reply

    for number in range(2):
        path = (b"/general.json", b"/parameters.json")[number]
        assert told(number, file_message(Open, session=number, data=path)).session == number
    assert told(0, file_message(Read, 9, 0, 12)).data[:12] == b'{"version":1'
    assert told(1, file_message(Read, 9, 1000, 50)).data[:50] == PARAMETERS_FILE[1000:1050]
    for number in range(2, 5):
        told(number, file_message(Open, data=b"/parameters.json"))
    assert told(0, file_message(Read, 0, 0, 9)).data[0] == INVALID_SESSION
    for number in range(1, 5):
        assert told(number, file_message(Read, 0, 5, 50)).data[:50] == PARAMETERS_FILE[5:55]


def test_any_request_of_files_may_come(copter: Copter) -> None:
    rig = Rig(copter, [Link(200_000)], warm_ms=500)
    rng = random.Random(3)
    for _ in range(400):
        payload = bytearray(rng.randbytes(251))
        payload[3] = rng.choice([rng.randrange(256), Open, Read, List, Burst, Crc])
        payload[2] = rng.choice([0, 1, 2, payload[2]])
        payload[8:12] = struct.pack("<I", rng.choice([0, 100, 11_000, rng.randrange(1 << 32)]))
        rig.send(mavlink.MAVLink_file_transfer_protocol_message(0, 1, 1, list(payload)))
        rig.run(20)
    rig.run(3000)
    (opened,) = files(rig, file_message(Open, data=b"/general.json"))
    assert opened.opcode == Ack


# What is shown


def test_what_instruments_show(copter: Copter) -> None:
    rig = Rig(copter)
    told = {message.get_type(): message for message in rig.seen[0]}
    hud, height, turned = told["VFR_HUD"], told["ALTITUDE"], told["ATTITUDE_QUATERNION"]
    truth = rig.flight._plant.truth()
    assert abs(hud.alt - 430.0) < 5.0 and abs(hud.climb) < 0.3 and hud.throttle == 0
    assert hud.groundspeed < 0.3
    assert 0 <= hud.heading <= 360
    away = (hud.heading - truth.angles[2] * 57.29578) % 360.0
    assert min(away, 360.0 - away) < 7.0
    assert abs(height.altitude_amsl - 430.0) < 5.0 and abs(height.altitude_relative) < 2.0
    assert height.altitude_terrain < -1000.0 and height.bottom_clearance < 0.0
    norm = turned.q1**2 + turned.q2**2 + turned.q3**2 + turned.q4**2
    assert abs(norm - 1.0) < 1e-4
    assert told["SYSTEM_TIME"].time_boot_ms > 11_000


def told_time(rig: Rig) -> tuple[int, float]:
    """The last date that was told, in s since 1970 began, and when, in s since power-up."""
    last = [message for message in rig.seen[0] if message.get_type() == "SYSTEM_TIME"][-1]
    return last.time_unix_usec / 1e6, last.time_boot_ms / 1e3


@pytest.mark.parametrize(
    "begun",
    [
        datetime(2026, 11, 24, 12, tzinfo=UTC),
        datetime(2026, 12, 31, 23, 59, 57, tzinfo=UTC),
        datetime(2028, 2, 28, 23, 59, 57, tzinfo=UTC),
        datetime(2028, 2, 29, 23, 59, 57, tzinfo=UTC),
        datetime(2027, 2, 28, 23, 59, 57, 750_000, tzinfo=UTC),
        datetime(2099, 12, 31, 23, 59, tzinfo=UTC),
        datetime(2017, 1, 1, tzinfo=UTC),
    ],
)
def test_the_date_is_the_receivers(copter: Copter, begun: datetime) -> None:
    """As Python's calendar has it; late by what the receiver takes."""
    with mock.patch.object(device_frames, "BEGUN", begun):
        rig = Rig(copter, warm_ms=5500)
    date, boot = told_time(rig)
    assert 0.0 <= begun.timestamp() + boot - date < 0.35
    with mock.patch.object(rig.flight._slow, "_satellites"):  # It goes on without the receiver.
        rig.run(3000)
    later, boot = told_time(rig)
    assert later - date > 2.0 and 0.0 <= begun.timestamp() + boot - later < 0.35


def test_the_log_has_the_date(copter: Copter, tmp_path: Path) -> None:
    copter.log(tmp_path / "log.ulg")
    Rig(copter, warm_ms=4000)
    copter.log(None)
    topic = ulog.read(tmp_path / "log.ulg").topic("satellites")
    date, boot = int(topic["utc_us"][-1]) / 1e6, int(topic["timestamp"][-1]) / 1e6
    assert 0.0 <= device_frames.BEGUN.timestamp() + boot - date < 0.35


@pytest.mark.parametrize(
    ("begun", "dated"),
    [
        (device_frames.BEGUN, 0x03),
        (device_frames.BEGUN, 0x05),
        (device_frames.BEGUN, 0x06),
        (device_frames.BEGUN, 0),
        (datetime(1980, 1, 6, tzinfo=UTC), 0x07),
        (datetime(2100, 1, 1, tzinfo=UTC), 0x07),
    ],
)
def test_a_date_that_is_not_sure_is_not_told(copter: Copter, begun: datetime, dated: int) -> None:
    with (
        mock.patch.object(device_frames, "BEGUN", begun),
        mock.patch.object(device_frames, "DATED", dated),
    ):
        rig = Rig(copter, warm_ms=3000)
    assert told_time(rig)[0] == 0.0


def test_metadata_and_protocol_are_told_when_asked_for(copter: Copter) -> None:
    rig = Rig(copter, warm_ms=500)
    assert rig.ask(512, 300) == ACCEPTED and rig.ask(512, 397) == ACCEPTED
    rig.run(200)
    told = {kind_of(message): payload_of(message) for message in rig.seen[0]}
    assert struct.unpack("<3H", told[300][:6]) == (200, 200, 200)
    assert told[397][8:108].rstrip(b"\0") == b"mftp://[;comp=1]/general.json"
    (opened,) = files(rig, file_message(Open, data=b"/general.json"))
    (read,) = files(rig, file_message(Read, opened.session, 0, 239))
    assert struct.unpack("<I", told[397][4:8])[0] == crc_of(read.data[: read.size])
    entry = json.loads(read.data[: read.size])["metadataTypes"][0]
    assert (entry["type"], entry["fileCrc"]) == (1, crc_of(PARAMETERS_FILE))
    for answer in (44, 47, 118, 120, 110):
        assert rig.ask(512, answer) == DENIED
