# SPDX-License-Identifier: Apache-2.0
"""Write the MAVLink messages that the copter sends and takes, as C, from MAVLink's definitions.

    python3 tools/keel messages [--check]

The definitions are those that the pinned pymavlink carries, and
examples/copter/mavlink_messages.xml has those of MAVLink's messages that it leaves out. Only facts
are taken of them: names, numbers, types, and the order on the wire. The text that it writes is
Keel's own; see examples/copter.

Exit status: 0 when done; 1 when --check finds a file that is not up to date; 2 when it cannot read
the definitions.
"""

from __future__ import annotations

import importlib.util
import subprocess
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import read_text, write_text
from keel.install import Toolchain

FOLDER = ROOT / "examples/copter"
DEFINITIONS = ("minimal", "standard", "common", "development")
LEFT_OUT = FOLDER / "mavlink_messages.xml"

SENT = (
    "HEARTBEAT",
    "SYS_STATUS",
    "PING",
    "PARAM_VALUE",
    "GPS_RAW_INT",
    "ATTITUDE",
    "LOCAL_POSITION_NED",
    "GLOBAL_POSITION_INT",
    "SERVO_OUTPUT_RAW",
    "RC_CHANNELS",
    "COMMAND_ACK",
    "TIMESYNC",
    "BATTERY_STATUS",
    "AUTOPILOT_VERSION",
    "ESTIMATOR_STATUS",
    "HOME_POSITION",
    "EXTENDED_SYS_STATE",
    "STATUSTEXT",
    "SCALED_IMU",
    "SCALED_IMU2",
    "SCALED_IMU3",
    "NAMED_VALUE_INT",
    "SCALED_PRESSURE",
    "PARAM_ERROR",
    "AVAILABLE_MODES",
    "CURRENT_MODE",
    "SYSTEM_TIME",
    "ATTITUDE_QUATERNION",
    "VFR_HUD",
    "ALTITUDE",
    "PROTOCOL_VERSION",
    "COMPONENT_METADATA",
    "MISSION_COUNT",
    "MISSION_ACK",
    "LOG_ENTRY",
    "LOG_DATA",
    "FILE_TRANSFER_PROTOCOL",
    "FENCE_STATUS",
    "SERIAL_CONTROL",
)
TAKEN = (
    "PING",
    "SET_MODE",
    "PARAM_REQUEST_READ",
    "PARAM_REQUEST_LIST",
    "PARAM_SET",
    "COMMAND_INT",
    "COMMAND_LONG",
    "TIMESYNC",
    "MISSION_REQUEST_LIST",
    "MISSION_REQUEST_PARTIAL_LIST",
    "MISSION_REQUEST",
    "MISSION_REQUEST_INT",
    "MISSION_COUNT",
    "MISSION_WRITE_PARTIAL_LIST",
    "MISSION_ITEM",
    "MISSION_ITEM_INT",
    "MISSION_CLEAR_ALL",
    "MISSION_SET_CURRENT",
    "LOG_REQUEST_LIST",
    "LOG_REQUEST_DATA",
    "LOG_ERASE",
    "FILE_TRANSFER_PROTOCOL",
    "SERIAL_CONTROL",
)
CONSTANTS = (
    "MAV_TYPE_QUADROTOR",
    "MAV_AUTOPILOT_GENERIC",
    "MAV_COMP_ID_AUTOPILOT1",
    "MAV_MODE_FLAG_CUSTOM_MODE_ENABLED",
    "MAV_MODE_FLAG_SAFETY_ARMED",
    "MAV_MODE_FLAG_MANUAL_INPUT_ENABLED",
    "MAV_MODE_FLAG_STABILIZE_ENABLED",
    "MAV_MODE_FLAG_AUTO_ENABLED",
    "MAV_STATE_BOOT",
    "MAV_STATE_CALIBRATING",
    "MAV_STATE_STANDBY",
    "MAV_STATE_ACTIVE",
    "MAV_STATE_CRITICAL",
    "MAV_STATE_FLIGHT_TERMINATION",
    "MAV_SYS_STATUS_SENSOR_3D_GYRO",
    "MAV_SYS_STATUS_SENSOR_3D_ACCEL",
    "MAV_SYS_STATUS_SENSOR_3D_MAG",
    "MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE",
    "MAV_SYS_STATUS_SENSOR_GPS",
    "MAV_SYS_STATUS_SENSOR_RC_RECEIVER",
    "MAV_SYS_STATUS_SENSOR_MOTOR_OUTPUTS",
    "MAV_SYS_STATUS_SENSOR_BATTERY",
    "MAV_SYS_STATUS_GEOFENCE",
    "MAV_SYS_STATUS_PREARM_CHECK",
    "MAV_RESULT_ACCEPTED",
    "MAV_RESULT_TEMPORARILY_REJECTED",
    "MAV_RESULT_DENIED",
    "MAV_RESULT_UNSUPPORTED",
    "MAV_RESULT_FAILED",
    "MAV_RESULT_IN_PROGRESS",
    "MAV_CMD_DO_SET_MODE",
    "MAV_CMD_COMPONENT_ARM_DISARM",
    "MAV_CMD_SET_MESSAGE_INTERVAL",
    "MAV_CMD_REQUEST_MESSAGE",
    "MAV_CMD_NAV_LOITER_UNLIM",
    "MAV_CMD_NAV_RETURN_TO_LAUNCH",
    "MAV_CMD_NAV_LAND",
    "MAV_CMD_NAV_TAKEOFF",
    "MAV_CMD_DO_SET_STANDARD_MODE",
    "MAV_CMD_PREFLIGHT_CALIBRATION",
    "MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN",
    "MAV_STANDARD_MODE_NON_STANDARD",
    "MAV_STANDARD_MODE_POSITION_HOLD",
    "MAV_STANDARD_MODE_ALTITUDE_HOLD",
    "MAV_STANDARD_MODE_SAFE_RECOVERY",
    "MAV_STANDARD_MODE_LAND",
    "MAV_MODE_PROPERTY_ADVANCED",
    "MAV_MODE_PROPERTY_NOT_USER_SELECTABLE",
    "REBOOT_SHUTDOWN_ACTION_REBOOT",
    "MAV_PARAM_TYPE_REAL32",
    "MAV_PARAM_ERROR_DOES_NOT_EXIST",
    "MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE",
    "MAV_PARAM_ERROR_PERMISSION_DENIED",
    "MAV_SEVERITY_CRITICAL",
    "MAV_SEVERITY_WARNING",
    "MAV_SEVERITY_INFO",
    "MAV_LANDED_STATE_ON_GROUND",
    "MAV_LANDED_STATE_IN_AIR",
    "MAV_LANDED_STATE_LANDING",
    "MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE",
    "MAV_PROTOCOL_CAPABILITY_MAVLINK2",
    "ESTIMATOR_ATTITUDE",
    "ESTIMATOR_VELOCITY_HORIZ",
    "ESTIMATOR_VELOCITY_VERT",
    "ESTIMATOR_POS_HORIZ_REL",
    "ESTIMATOR_POS_HORIZ_ABS",
    "ESTIMATOR_POS_VERT_ABS",
    "GPS_FIX_TYPE_NO_FIX",
    "GPS_FIX_TYPE_3D_FIX",
    "MAV_BATTERY_FUNCTION_ALL",
    "MAV_BATTERY_TYPE_LIPO",
    "MAV_BATTERY_CHARGE_STATE_UNDEFINED",
    "MAV_BATTERY_CHARGE_STATE_OK",
    "MAV_BATTERY_CHARGE_STATE_LOW",
    "MAV_BATTERY_CHARGE_STATE_CRITICAL",
    "MAV_PROTOCOL_CAPABILITY_FTP",
    "MAV_PROTOCOL_CAPABILITY_MISSION_INT",
    "MAV_MISSION_TYPE_RALLY",
    "MAV_MISSION_TYPE_ALL",
    "MAV_MISSION_ACCEPTED",
    "MAV_MISSION_UNSUPPORTED",
    "MAV_MISSION_INVALID_SEQUENCE",
    "MAV_FTP_OPCODE_NONE",
    "MAV_FTP_OPCODE_TERMINATESESSION",
    "MAV_FTP_OPCODE_RESETSESSION",
    "MAV_FTP_OPCODE_LISTDIRECTORY",
    "MAV_FTP_OPCODE_OPENFILERO",
    "MAV_FTP_OPCODE_READFILE",
    "MAV_FTP_OPCODE_CREATEFILE",
    "MAV_FTP_OPCODE_RENAME",
    "MAV_FTP_OPCODE_CALCFILECRC",
    "MAV_FTP_OPCODE_BURSTREADFILE",
    "MAV_FTP_OPCODE_ACK",
    "MAV_FTP_OPCODE_NAK",
    "MAV_FTP_ERR_NONE",
    "MAV_FTP_ERR_INVALIDDATASIZE",
    "MAV_FTP_ERR_INVALIDSESSION",
    "MAV_FTP_ERR_EOF",
    "MAV_FTP_ERR_UNKNOWNCOMMAND",
    "MAV_FTP_ERR_FILEPROTECTED",
    "MAV_FTP_ERR_FILENOTFOUND",
    "FENCE_BREACH_NONE",
    "FENCE_BREACH_MINALT",
    "FENCE_BREACH_MAXALT",
    "FENCE_BREACH_BOUNDARY",
    "SERIAL_CONTROL_DEV_SHELL",
    "SERIAL_CONTROL_FLAG_REPLY",
    "SERIAL_CONTROL_FLAG_RESPOND",
)
BYTES = {
    "char": 1,
    "int8_t": 1,
    "uint8_t": 1,
    "int16_t": 2,
    "uint16_t": 2,
    "int32_t": 4,
    "uint32_t": 4,
    "float": 4,
    "int64_t": 8,
    "uint64_t": 8,
    "double": 8,
}
NOTE = "/* Generated by `make generate NAME=messages` from MAVLink's definitions; do not edit. */"


@dataclass(frozen=True)
class Field:
    """A field of a message."""

    name: str
    type: str
    count: int  # Of an array; 0 of a single value.
    is_extension: bool

    @property
    def size(self) -> int:
        """Bytes on the wire."""
        return BYTES[self.type] * max(1, self.count)


@dataclass(frozen=True)
class Message:
    """A message, its fields in their order on the wire."""

    name: str
    id: int
    fields: list[Field] = field(default_factory=list)

    @property
    def length(self) -> int:
        """Bytes of all fields."""
        return sum(one.size for one in self.fields)

    @property
    def crc_extra(self) -> int:
        """What stands for the layout in the checksum."""
        text = bytearray(f"{self.name} ".encode())
        for one in self.fields:
            if not one.is_extension:
                text += f"{one.type} {one.name} ".encode()
                text += bytes([one.count]) if one.count else b""
        crc = crc16(bytes(text))
        return (crc & 0xFF) ^ (crc >> 8)

    @property
    def stem(self) -> str:
        """As C's names have it."""
        return f"message_{self.name.lower()}"


def crc16(data: bytes) -> int:
    """CRC-16/MCRF4XX."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ (0x8408 if crc & 1 else 0)
    return crc


def field_of(node: ET.Element, is_extension: bool) -> Field:
    """A field as the definitions have it."""
    kind, _, rest = node.attrib["type"].partition("[")
    kind = "uint8_t" if kind == "uint8_t_mavlink_version" else kind
    return Field(node.attrib["name"], kind, int(rest.rstrip("]") or 0), is_extension)


def message_of(node: ET.Element) -> Message:
    """A message: fields by the size of their type, extensions behind them as they stand."""
    extended, fields = False, []
    for child in node:
        extended = extended or child.tag == "extensions"
        if child.tag == "field":
            fields.append(field_of(child, extended))
    base = sorted((one for one in fields if not one.is_extension), key=lambda one: -BYTES[one.type])
    return Message(
        node.attrib["name"],
        int(node.attrib["id"]),
        base + [one for one in fields if one.is_extension],
    )


def definitions() -> Path:
    """Where the package has them."""
    found = importlib.util.find_spec("pymavlink")
    if found is None or not found.submodule_search_locations:
        raise ToolError("pymavlink: is not there; see the head of this program")
    return Path(found.submodule_search_locations[0]) / "dialects/v20"


def read(folder: Path) -> tuple[dict[str, Message], dict[str, int]]:
    """All messages and constants."""
    messages: dict[str, Message] = {}
    constants: dict[str, int] = {}
    for path in (*(folder / f"{name}.xml" for name in DEFINITIONS), LEFT_OUT):
        try:
            root = ET.parse(path).getroot()
        except (OSError, ET.ParseError) as error:
            raise ToolError(f"{path}: {error}") from error
        for node in root.iter("message"):
            messages[node.attrib["name"]] = message_of(node)
        for node in root.iter("entry"):
            constants[node.attrib["name"]] = value_of(node.attrib.get("value", "0"))
    return messages, constants


def value_of(text: str) -> int:
    """A number, or a power of two as 2**3."""
    base, _, power = text.partition("**")
    return int(base, 0) ** int(power, 0) if power else int(base, 0)


def chosen(known: dict[str, Message], names: Sequence[str]) -> list[Message]:
    """Messages by their ids."""
    if missing := [name for name in names if name not in known]:
        raise ToolError(f"{missing[0]}: no such message")
    return sorted((known[name] for name in names), key=lambda message: message.id)


def declaration(message: Message) -> Iterator[str]:
    """The structure."""
    yield f"/** {message.name}. */"
    yield f"typedef struct {message.stem} {{"
    for one in message.fields:
        yield f"    {one.type} {one.name}{f'[{one.count}]' if one.count else ''};"
    yield f"}} {message.stem}_t;"
    yield ""


def short(kind: str) -> str:
    """As put_ and get_ name it."""
    if kind == "char":
        return "u8"
    return kind.removesuffix("_t").replace("uint", "u").replace("int", "i")


def accesses(message: Message, packs: bool) -> Iterator[str]:
    """A line for each field: into the payload, or out of it."""
    offset = 0
    for one in message.fields:
        size = BYTES[one.type]
        place = f"payload[{offset}]"
        index = ""
        if one.count:
            index, place = "[i]", f"payload[{offset}u + ({size}u * i)]"
            yield f"    for (uint32_t i = 0u; i < {one.count}u; i++) {{"
        pad = "        " if one.count else "    "
        value = f"{'from' if packs else 'to'}->{one.name}{index}"
        if packs:
            value = f"(uint8_t){value}" if one.type == "char" else value
            yield f"{pad}put_{short(one.type)}(&{place}, {value});"
        else:
            cast = "(char)" if one.type == "char" else ""
            yield f"{pad}{value} = {cast}get_{short(one.type)}(&{place});"
        if one.count:
            yield "    }"
        offset += one.size


def signature(message: Message, packs: bool) -> str:
    """Of the packer, or the unpacker."""
    if packs:
        return (
            f"void {message.stem}_pack(const {message.stem}_t *from,\n"
            f"    uint8_t payload[MESSAGE_{message.name}_LENGTH])"
        )
    return (
        f"void {message.stem}_unpack({message.stem}_t *to,\n"
        f"    const uint8_t payload[MESSAGE_{message.name}_LENGTH])"
    )


def header(
    all_of: list[Message], sent: list[Message], taken: list[Message], constants: dict[str, int]
) -> str:
    """mavlink_messages.h."""
    lines = [
        "/* SPDX-License-Identifier: Apache-2.0 */",
        "/**",
        " * @file mavlink_messages.h",
        " * @brief The messages of MAVLink that the copter sends and takes.",
        " *",
        " * Fields stand as on the wire: the largest types first, extensions behind them. Packers",
        " * and unpackers are for payloads of their full length, little-endian.",
        " *",
        " * Generated by `make generate NAME=messages` from MAVLink's definitions; do not edit.",
        " */",
        "#ifndef COPTER_MAVLINK_MESSAGES_H",
        "#define COPTER_MAVLINK_MESSAGES_H",
        "",
        '#include "keel/middleware/mavlink.h"',
        "",
        "#include <stdint.h>",
        "",
        "/** @name Numbers of MAVLink. */",
        "/** @{ */",
    ]
    lines += [f"#define {name} {constants[name]}u" for name in CONSTANTS]
    lines += [
        "/** @} */",
        "",
        "/** @name Messages: their numbers, and bytes of all fields. */",
        "/** @{ */",
    ]
    for message in all_of:
        lines += [
            f"#define MESSAGE_{message.name} {message.id}u",
            f"#define MESSAGE_{message.name}_LENGTH {message.length}u",
        ]
    lines += [
        "/** @} */",
        "",
        "/** Messages that are sent. */",
        f"#define MESSAGES_SENT {len(sent)}u",
        "extern const keel_mavlink_message_t messages_sent[MESSAGES_SENT];",
        "",
        "/** Messages that are taken, from senders who know more fields too. */",
        f"#define MESSAGES_TAKEN {len(taken)}u",
        "extern const keel_mavlink_message_t messages_taken[MESSAGES_TAKEN];",
        "",
        "/** The places in messages_sent. */",
        "typedef enum message_sent {",
        ",\n".join(f"    SENT_{message.name}" for message in sent),
        "} message_sent_t;",
        "",
    ]
    for message in all_of:
        lines += declaration(message)
    lines += ["/** @name Payloads. */", "/** @{ */"]
    lines += [f"{signature(message, True)};" for message in sent]
    lines += [f"{signature(message, False)};" for message in taken]
    lines += ["/** @} */", "", "#endif", ""]
    return "\n".join(lines)


HELPERS = r"""
/* Numbers, the lowest byte first. */
static void put_u8(uint8_t to[1], uint8_t value)
{
    to[0] = value;
}

static void put_u16(uint8_t to[2], uint16_t value)
{
    to[0] = (uint8_t)(value & 0xFFu);
    to[1] = (uint8_t)(value >> 8);
}

static void put_u32(uint8_t to[4], uint32_t value)
{
    put_u16(&to[0], (uint16_t)(value & 0xFFFFu));
    put_u16(&to[2], (uint16_t)(value >> 16));
}

static void put_u64(uint8_t to[8], uint64_t value)
{
    put_u32(&to[0], (uint32_t)(value & 0xFFFFFFFFu));
    put_u32(&to[4], (uint32_t)(value >> 32));
}

static void put_i8(uint8_t to[1], int8_t value)
{
    put_u8(to, (uint8_t)value);
}

static void put_i16(uint8_t to[2], int16_t value)
{
    put_u16(to, (uint16_t)value);
}

static void put_i32(uint8_t to[4], int32_t value)
{
    put_u32(to, (uint32_t)value);
}

static void put_i64(uint8_t to[8], int64_t value)
{
    put_u64(to, (uint64_t)value);
}

static void put_float(uint8_t to[4], float value)
{
    uint32_t bits;

    (void)memcpy(&bits, &value, sizeof bits);
    put_u32(to, bits);
}

static uint8_t get_u8(const uint8_t from[1])
{
    return from[0];
}

static uint16_t get_u16(const uint8_t from[2])
{
    return (uint16_t)(from[0] | ((uint32_t)from[1] << 8));
}

static uint32_t get_u32(const uint8_t from[4])
{
    return get_u16(&from[0]) | ((uint32_t)get_u16(&from[2]) << 16);
}

static uint64_t get_u64(const uint8_t from[8])
{
    return get_u32(&from[0]) | ((uint64_t)get_u32(&from[4]) << 32);
}

static int16_t get_i16(const uint8_t from[2])
{
    return (int16_t)get_u16(from);
}

static int32_t get_i32(const uint8_t from[4])
{
    return (int32_t)get_u32(from);
}

static int64_t get_i64(const uint8_t from[8])
{
    return (int64_t)get_u64(from);
}

static float get_float(const uint8_t from[4])
{
    const uint32_t bits = get_u32(from);
    float value;

    (void)memcpy(&value, &bits, sizeof value);
    return value;
}
"""


def source(sent: list[Message], taken: list[Message]) -> str:
    """mavlink_messages.c."""
    lines = [
        "/* SPDX-License-Identifier: Apache-2.0 */",
        NOTE,
        '#include "mavlink_messages.h"',
        "",
        "#include <string.h>",
        "",
        "const keel_mavlink_message_t messages_sent[MESSAGES_SENT] = {",
    ]
    lines += [
        f"    {{MESSAGE_{one.name}, {one.crc_extra}u, 1u, MESSAGE_{one.name}_LENGTH}},"
        for one in sent
    ]
    lines += ["};", "", "const keel_mavlink_message_t messages_taken[MESSAGES_TAKEN] = {"]
    lines += [
        f"    {{MESSAGE_{one.name}, {one.crc_extra}u, 1u, KEEL_MAVLINK_PAYLOAD_MAX}},"
        for one in taken
    ]
    lines += ["};", HELPERS]
    for messages, packs in ((sent, True), (taken, False)):
        for message in messages:
            lines += [signature(message, packs), "{", *accesses(message, packs), "}", ""]
    return "\n".join(lines)


def written() -> dict[Path, str]:
    """The files as they should be."""
    known, constants = read(definitions())
    sent, taken = chosen(known, SENT), chosen(known, TAKEN)
    all_of = chosen(known, sorted({*SENT, *TAKEN}))
    return {
        FOLDER / "mavlink_messages.h": header(all_of, sent, taken, constants),
        FOLDER / "mavlink_messages.c": source(sent, taken),
    }


def laid_out(text: str, tools: Toolchain) -> str:
    """As all C here is."""
    name = str(FOLDER / "mavlink_messages.c")
    command = [*tools.command("clang-format-19"), "--assume-filename", name]
    done = subprocess.run(command, input=text, text=True, capture_output=True, check=False)
    if done.returncode != 0:
        raise ToolError(f"clang-format: {done.stderr.strip()}")
    return done.stdout


def write(arguments: Sequence[str] | None) -> int:
    """Write the files, or compare them."""
    parser = Parser("Write the messages that the copter sends and takes, as C.", "messages")
    parser.add_argument("--check", action="store_true", help="only see whether they are up to date")
    options = parser.parse_args(arguments)
    tools = Toolchain()
    files = {path: laid_out(text, tools) for path, text in written().items()}
    if not options.check:
        for path, text in files.items():
            write_text(path, text)
        return 0
    old = [path for path, text in files.items() if not path.is_file() or read_text(path) != text]
    for path in old:
        print(f"{path.relative_to(ROOT)}: not up to date; make generate NAME=messages writes it")
    return 1 if old else 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("messages", lambda: write(arguments))
