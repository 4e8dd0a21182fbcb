# SPDX-License-Identifier: Apache-2.0
"""What QGroundControl does when it meets a vehicle, with its own time-outs and numbers of attempts.

QGroundControl itself is a program with windows, which no test here starts. Its sequence and its
limits are those of its sources: InitialConnectStateMachine.h, Vehicle.h, FTPManager.h,
ParameterManager.h and PlanManager.h of 2026. Each step is a generator: it yields what it waits for,
and is sent the message, or None when the time is over.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Generator, Iterable
from dataclasses import dataclass, field
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

COMMAND_MS, COMMAND_TRIES, MESSAGE_MS = 3000, 3, 1000
FTP_MS, FTP_RETRIES = 1000, 3
LIST_MS, LIST_RETRIES, PARAMETER_MS, PARAMETER_TRIES, BATCH = 5000, 4, 3000, 5, 10
PLAN_MS, PLAN_RETRIES = 1500, 5

REQUEST_MESSAGE, SYSTEM, AUTOPILOT = 512, 1, 1
PROTOCOL_VERSION, COMPONENT_METADATA, AUTOPILOT_VERSION, AVAILABLE_MODES = 300, 397, 148, 435
OPEN, READ, BURST, RESET, ACK, NAK, EOF = 4, 5, 15, 2, 128, 129, 6
DATA = 239
PARAMETERS = 1  # COMP_METADATA_TYPE_PARAMETER.
KINDS = {0: "mission", 1: "fence", 2: "rally"}


@dataclass(frozen=True)
class Wait:
    """What a step waits for."""

    good: Callable[[Any], bool]
    timeout_ms: int


Step = Generator[Wait, Any, Any]


def kind_of(message: Any) -> int:
    """A message's number, also of one that pymavlink does not know."""
    return int.from_bytes(bytes(message.get_msgbuf())[7:10], "little")


def payload_of(message: Any) -> bytes:
    """The payload of such a message, as long as it may become."""
    frame = bytes(message.get_msgbuf())
    return frame[10 : 10 + frame[1]].ljust(255, b"\0")


@dataclass
class Met:
    """What QGroundControl knows afterwards, and where its time-outs fired."""

    late: list[str] = field(default_factory=list)  # Time-outs, each named.
    errors: list[str] = field(default_factory=list)  # What it gave up, or its user is told of.
    version: Any = None
    protocol: tuple[int, ...] = ()
    files: dict[str, bytes] = field(default_factory=dict)
    parameters: dict[int, Any] = field(default_factory=dict)
    plans: dict[str, int] = field(default_factory=dict)


class QGroundControl:
    """A station on a line that carries messages."""

    def __init__(self, send: Callable[[Any], None], system: int = 255) -> None:
        self.met = Met()
        self._send, self._system = send, system
        self._sequence = 0

    def connect(self) -> Step:
        """All of it, in its order."""
        met = self.met
        met.version = yield from self._message(AUTOPILOT_VERSION, "version")
        answer = yield from self._message(PROTOCOL_VERSION, "protocol")
        if answer is not None:
            met.protocol = struct.unpack("<3H", payload_of(answer)[:6])
        yield from self._modes()
        yield from self._metadata()
        yield from self._parameters()
        for kind, name in KINDS.items():
            yield from self._plan(kind, name)

    def _mine(self, message: Any) -> bool:
        return bool(message.target_system == self._system)

    def _modes(self) -> Step:
        """One after the other, as long as the vehicle says that there are more."""
        index, count = 1, 1
        while index <= count:
            answer = yield from self._message(AVAILABLE_MODES, "modes", index)
            if answer is None:
                return
            count, index = payload_of(answer)[8], index + 1

    def _message(self, number: int, name: str, which: int = 0) -> Step:
        """REQUEST_MESSAGE: the acknowledgement and the message come in any order."""
        for _ in range(COMMAND_TRIES):
            self._send(
                mavlink.MAVLink_command_long_message(
                    SYSTEM, AUTOPILOT, REQUEST_MESSAGE, 0, number, which, 0, 0, 0, 0, 0
                )
            )
            seen: dict[str, Any] = {}
            while "ack" not in seen:
                got = yield Wait(
                    lambda m: (
                        kind_of(m) == number
                        or (
                            m.get_type() == "COMMAND_ACK"
                            and m.command == REQUEST_MESSAGE
                            and self._mine(m)
                        )
                    ),
                    COMMAND_MS,
                )
                if got is None:
                    break
                seen["message" if kind_of(got) == number else "ack"] = got
            if "ack" in seen:
                break
            self.met.late.append(name)
        if "ack" not in seen:
            self.met.errors.append(f"{name}: not acknowledged")
            return None
        if seen["ack"].result != 0:
            return None  # It is not there.
        if "message" not in seen:
            seen["message"] = yield Wait(lambda m: kind_of(m) == number, MESSAGE_MS)
        if seen["message"] is None:
            self.met.late.append(name)
        return seen["message"]

    # Files

    def _ask(
        self,
        opcode: int,
        session: int,
        offset: int,
        size: int,
        data: bytes = b"",
        again: bool = False,
    ) -> None:
        """Two more with each request, of which the second is the answer's; the same ones again."""
        if not again:
            self._sequence = (self._sequence + 2) & 0xFFFF
        request = (self._sequence - 1) & 0xFFFF
        head = struct.pack("<HBBBBBBI", request, session, opcode, size, 0, 0, 0, offset)
        self._send(
            mavlink.MAVLink_file_transfer_protocol_message(
                0, SYSTEM, AUTOPILOT, list((head + data).ljust(251, b"\0"))
            )
        )

    def _answer(self, opcode: int) -> Step:
        """The next answer to such a request that is not older than what is expected."""
        while True:
            got = yield Wait(
                lambda m: m.get_type() == "FILE_TRANSFER_PROTOCOL" and self._mine(m), FTP_MS
            )
            if got is None:
                return None
            reply = Reply.of(bytes(got.payload))
            if reply.request == opcode and ((reply.sequence - self._sequence) & 0xFFFF) < 0x8000:
                return reply

    def _download(self, uri: str) -> Step:
        """A file, or None."""
        path = uri.removeprefix("mftp://[;comp=1]").encode()
        self._ask(OPEN, 0, 0, len(path), path)
        opened = yield from self._answer(OPEN)
        if opened is None:
            self.met.late.append(f"open {uri}")
            return None
        if opened.opcode != ACK:
            self.met.errors.append(f"{uri}: {opened.data[0]}")
            return None
        size = struct.unpack("<I", opened.data[:4])[0]
        whole = bytearray(size)
        missing: list[tuple[int, int]] = []
        good = yield from self._burst(uri, opened.session, whole, missing)
        if good:
            good = yield from self._fill(uri, opened.session, whole, missing)
        self._ask(RESET, 0, 0, 0)
        if (yield from self._answer(RESET)) is None:
            self.met.late.append("reset")
        return bytes(whole) if good else None

    def _burst(
        self, uri: str, session: int, whole: bytearray, missing: list[tuple[int, int]]
    ) -> Step:
        """Bursts until the end of the file; what is left out is noted."""
        at, tries = 0, 0
        self._ask(BURST, session, at, DATA)
        while True:
            reply = yield from self._answer(BURST)
            if reply is None:
                self.met.late.append(f"burst {uri}")
                tries += 1
                if tries > FTP_RETRIES:
                    self.met.errors.append(f"{uri}: no answer")
                    return False
                self._ask(BURST, session, at, DATA, again=True)
            elif reply.opcode == NAK:
                if reply.data[0] != EOF:
                    self.met.errors.append(f"{uri}: {reply.data[0]}")
                    return False
                if reply.sequence == self._sequence:
                    return True
                self._sequence = reply.sequence
                self._ask(BURST, session, at, DATA)
            elif reply.offset >= at:
                if reply.offset > at:
                    missing.append((at, reply.offset - at))
                whole[reply.offset : reply.offset + reply.size] = reply.data[: reply.size]
                at, tries = reply.offset + reply.size, 0
                self._sequence = (reply.sequence + (0 if reply.complete else 1)) & 0xFFFF
                if reply.complete:
                    self._ask(BURST, session, at, DATA)

    def _fill(
        self, uri: str, session: int, whole: bytearray, missing: list[tuple[int, int]]
    ) -> Step:
        """What the bursts left out, piece by piece."""
        for begin, size in missing:
            for at in range(begin, begin + size, DATA):
                piece = min(DATA, begin + size - at)
                for again in range(FTP_RETRIES + 1):
                    self._ask(READ, session, at, piece, again=again > 0)
                    reply = yield from self._answer(READ)
                    if reply is not None:
                        break
                    self.met.late.append(f"read {uri}")
                if reply is None or reply.opcode != ACK or reply.size != piece:
                    self.met.errors.append(f"{uri}: no answer")
                    return False
                whole[at : at + piece] = reply.data[:piece]
        return True

    def _metadata(self) -> Step:
        """The general file, and that of parameters which it names."""
        answer = yield from self._message(COMPONENT_METADATA, "metadata")
        if answer is None:
            return
        uri = payload_of(answer)[8:108].split(b"\0")[0].decode()
        general = yield from self._download(uri)
        if general is None:
            return
        self.met.files["general"] = general
        for entry in json.loads(general)["metadataTypes"]:
            if entry["type"] == PARAMETERS:
                found = yield from self._download(entry["uri"])
                if found is not None:
                    self.met.files["parameters"] = found

    # Parameters

    def _value(self) -> Step:
        """The next PARAM_VALUE."""
        got = yield Wait(lambda m: m.get_type() == "PARAM_VALUE", PARAMETER_MS)
        if got is not None and got.param_index < got.param_count:
            self.met.parameters[got.param_index] = got
        return got

    def _parameters(self) -> Step:
        """The list; then what is missing by its index, at most ten under way."""
        known = self.met.parameters
        for attempt in range(LIST_RETRIES + 1):
            self._send(mavlink.MAVLink_param_request_list_message(SYSTEM, 0))
            got = yield Wait(lambda m: m.get_type() == "PARAM_VALUE", LIST_MS)
            if got is not None:
                known[got.param_index] = got
                break
            self.met.late.append(f"list of parameters {attempt}")
        if not known:
            self.met.errors.append("parameters: no answer")
            return
        count = next(iter(known.values())).param_count
        tries: dict[int, int] = {}
        while len(known) < count:
            if (yield from self._value()) is not None:
                continue
            self.met.late.append("parameters")
            wanted = [one for one in range(count) if one not in known][:BATCH]
            for one in wanted:
                tries[one] = tries.get(one, 0) + 1
                self._send(mavlink.MAVLink_param_request_read_message(SYSTEM, AUTOPILOT, b"", one))
            if max(tries.values()) > PARAMETER_TRIES:
                self.met.errors.append("parameters: some are missing")
                return

    # Missions

    def _plan(self, kind: int, name: str) -> Step:
        """How many items there are. All that is here has none."""
        for _ in range(PLAN_RETRIES + 2):
            self._send(mavlink.MAVLink_mission_request_list_message(SYSTEM, AUTOPILOT, kind))
            got = yield Wait(
                lambda m: (
                    m.get_type() == "MISSION_COUNT" and self._mine(m) and m.mission_type == kind
                ),
                PLAN_MS,
            )
            if got is not None:
                self.met.plans[name] = got.count
                self._send(mavlink.MAVLink_mission_ack_message(SYSTEM, AUTOPILOT, 0, kind))
                return
            self.met.late.append(name)
        self.met.errors.append(f"{name}: no answer")


@dataclass(frozen=True)
class Reply:
    """An answer of a file server."""

    sequence: int
    session: int
    opcode: int
    size: int
    request: int
    complete: int
    offset: int
    data: bytes

    @classmethod
    def of(cls, payload: bytes) -> Reply:
        """From a payload."""
        sequence, session, opcode, size, request, complete, _, offset = struct.unpack(
            "<HBBBBBBI", payload[:12]
        )
        return cls(sequence, session, opcode, size, request, complete, offset, payload[12:])


class Driver:
    """Runs the steps of stations, all on one clock."""

    def __init__(self) -> None:
        self._steps: list[tuple[Step, list[Any]]] = []
        self.done: list[int] = []  # When each has ended, in ms.

    def add(self, step: Step, now_ms: int) -> int:
        """Begins; tells its number."""
        self._steps.append((step, [next(step), now_ms]))
        self.done.append(-1)
        return len(self._steps) - 1

    def hear(self, number: int, messages: Iterable[Any], now_ms: int) -> None:
        """What came for one of them, and that time has passed."""
        step, state = self._steps[number]
        if self.done[number] >= 0:
            return
        try:
            for message in messages:
                if state[0].good(message):
                    state[0], state[1] = step.send(message), now_ms
            if now_ms - state[1] >= state[0].timeout_ms:
                state[0], state[1] = step.send(None), now_ms
        except StopIteration:
            self.done[number] = now_ms
