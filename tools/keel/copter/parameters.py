# SPDX-License-Identifier: Apache-2.0
"""The table of parameters, from one file: in C, as a page, and as MAVLink's metadata.

The metadata is in C, too, for ground stations that load it from the vehicle.

    python3 tools/keel parameters          # writes what has changed
    python3 tools/keel parameters --check  # only sees whether all are up to date

Exit status: 0 when all is well, 1 when a file is stale, 2 when the file cannot be read.
"""

from __future__ import annotations

import argparse
import json
import re
import struct
import sys
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal, Self

from keel.base.errors import ROOT, ToolError
from keel.base.files import read_text, write_text
from keel.config import ConfigError, Field, Mistake, Table, model_validator, parse_toml

SOURCE = "specs/parameters/copter.toml"
# examples/copter/parameters.h: KEEL_PARAMETER_NAME_LENGTH, and how many an index can tell apart.
NAME_LENGTH = 16
MOST = 1000
INT32 = range(-(2**31), 2**31)
LARGEST: float = struct.unpack("<f", b"\xff\xff\x7f\x7f")[0]
# "fields" are of C: a path, its indices constants; before it a factor, if it is not 1.
FIELD = re.compile(
    r"(?:(-?\d+(?:\.\d+)?) \* )?([a-z][a-z0-9_]*(?:(?:\.|\[[A-Z0-9_]+\]\.?)[a-z0-9_]*)*)"
)

Name = Annotated[str, Field(pattern=rf"^[A-Z][A-Z0-9_]{{0,{NAME_LENGTH - 1}}}$")]
Words = Annotated[str, Field(pattern=r"^[A-Z][ -;=?-{}~]*$", max_length=160)]
Unit = Annotated[str, Field(pattern=r"^[A-Za-z0-9/^]{1,12}$")]
Number = int | float


class Parameter(Table):
    """A parameter as written."""

    name: Name
    type: Literal["float", "int32", "bool"]
    unit: Unit | None = None
    range: Annotated[list[Number], Field(min_length=2, max_length=2)] | None = None
    default: bool | int | float
    description: Words
    fields: Annotated[list[str], Field(min_length=1)]
    restart: bool = False
    as_: Literal["uint8_t", "uint16_t", "uint32_t", "int32_t"] = Field("uint32_t", alias="as")

    @property
    def bounds(self) -> tuple[Number, Number]:
        """The least value and the greatest."""
        return (self.range[0], self.range[1]) if self.range else (0, 1)

    @model_validator(mode="after")
    def is_consistent(self) -> Self:
        numbers = [*(self.range or []), self.default]
        if (self.range is None) != (self.type == "bool"):
            raise ValueError("a range is what a float and an int32 have, and a bool has not")
        for number in numbers:
            if not fits(number, self.type):
                raise ValueError(f"{number} is no {self.type}")
        low, high = self.bounds
        if not low <= self.default <= high:
            raise ValueError(f"the default {self.default} is not within {low} to {high}")
        held = least_of(self.as_) <= low and high <= greatest_of(self.as_)
        if self.type == "int32" and not held:
            raise ValueError(f"the range does not fit into {self.as_}")
        return self


class Group(Table):
    """Parameters that belong together."""

    name: Words
    parameter: Annotated[list[Parameter], Field(min_length=1)]


class File(Table):
    """A file."""

    name: Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]{0,31}$")]
    group: Annotated[list[Group], Field(min_length=1)]

    @property
    def parameters(self) -> list[Parameter]:
        """All of them, in their order."""
        return [one for group in self.group for one in group.parameter]


def least_of(type_: str) -> int:
    """The least number of a type of C."""
    return 0 if type_.startswith("u") else INT32.start


def greatest_of(type_: str) -> int:
    """Its greatest, of those that an int32 has."""
    return min(1 << int(re.sub(r"\D", "", type_)), INT32.stop) - 1


def fits(number: Number, type_: str) -> bool:
    """Whether a number is of a type of a parameter."""
    if type_ == "bool" or isinstance(number, bool):
        return type_ == "bool" and isinstance(number, bool)
    if type_ == "int32":
        return isinstance(number, int) and number in INT32
    return abs(number) <= LARGEST


def unit_of(field: str) -> str:
    """Whose settings a field is of: what it is made anew with."""
    return field.partition(".")[0]


def mistakes(file: File) -> Iterator[Mistake]:
    """What a single parameter does not show: names and fields that there are twice."""
    names: set[str] = set()
    taken: set[str] = set()
    restarts: dict[str, bool] = {}
    for g, group in enumerate(file.group):
        for p, one in enumerate(group.parameter):
            place = ("group", g, "parameter", p)
            if one.name in names:
                yield (*place, "name"), f"there is another {one.name}"
            names.add(one.name)
            for text in one.fields:
                match = FIELD.fullmatch(text)
                if not match:
                    yield (*place, "fields"), f"{text!r} is no field, nor a number times one"
                elif match[1] and one.type != "float":
                    yield (*place, "fields"), f"{text!r}: a factor is for floats"
                elif match[2] in taken:
                    yield (*place, "fields"), f"{match[2]} is set by another parameter"
                elif restarts.setdefault(unit_of(match[2]), one.restart) != one.restart:
                    yield (*place, "restart"), f"another parameter of {unit_of(match[2])} differs"
                else:
                    taken.add(match[2])
    if len(names) > MOST:
        yield ("group",), f"there are more than {MOST} parameters"


def read(text: str, shown: str) -> File:
    """A file; a ConfigError says what is wrong with it."""
    return parse_toml(text, File, shown, mistakes)


def real(number: Number) -> str:
    """A float of C."""
    return f"{float(number)!r}f"


def value(kind: str, number: Number) -> str:
    """A value of C."""
    member = f".real = {real(number)}" if kind == "float" else f".whole = {int(number)}"
    return f"{{.type = KEEL_PARAMETER_{kind.upper()}, {member}}}"


HEADER = """\
/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file parameter_table.h
 * @brief The {count} parameters of {source}, as data.
 *
 * Generated by `make generate NAME=tables`; do not edit. docs/parameters.md lists them.
 */
#ifndef {upper}_PARAMETER_TABLE_H
#define {upper}_PARAMETER_TABLE_H

#include "parameters.h"
#include "settings.h"

#define {upper}_PARAMETER_COUNT {count}u

/** Their names, ranges and defaults. */
extern const keel_parameter_t {name}_parameter[{upper}_PARAMETER_COUNT];

/**
 * Sets the fields that parameters set.
 *
 * @param settings the settings; the other fields stay
 * @param entry    each parameter's value
 */
void {name}_apply_parameters({name}_settings_t *settings, const keel_parameter_entry_t *entry);

#endif
"""

CODE = """\
/* SPDX-License-Identifier: Apache-2.0 */
/* Generated by `make generate NAME=tables` from {source}; do not edit. */
#include "parameter_table.h"

/* clang-format off */
const keel_parameter_t {name}_parameter[{upper}_PARAMETER_COUNT] = {{
{rows}
}};

void {name}_apply_parameters({name}_settings_t *settings, const keel_parameter_entry_t *entry)
{{
{assignments}
}}
/* clang-format on */
"""


RESTARTS = ",\n     .restarts = true"


def row(one: Parameter) -> str:
    """The row of a parameter."""
    low, high = one.bounds
    return (
        f'    {{.name = "{one.name}",\n'
        f"     .initial = {value(one.type, one.default)},\n"
        f"     .lowest = {value(one.type, low)},\n"
        f"     .highest = {value(one.type, high)}{RESTARTS if one.restart else ''}}},"
    )


def assignments(one: Parameter, index: int) -> Iterator[str]:
    """What a parameter sets."""
    given = f"entry[{index}].value.{'real' if one.type == 'float' else 'whole'}"
    for text in one.fields:
        match = FIELD.fullmatch(text)
        if not match:
            raise ToolError(f"{one.name}: {text} is no field")
        word = {"float": given, "bool": f"{given} != 0"}.get(one.type, f"({one.as_}){given}")
        if match[1]:
            word = f"-{given}" if match[1] == "-1" else f"{real(float(match[1]))} * {given}"
        yield f"    settings->{match[2]} = {word};"


def code(file: File, source: str) -> tuple[str, str]:
    """The header and the source."""
    words = {
        "name": file.name,
        "upper": file.name.upper(),
        "source": source,
        "count": len(file.parameters),
        "rows": "\n".join(row(one) for one in file.parameters),
        "assignments": "\n".join(
            line for index, one in enumerate(file.parameters) for line in assignments(one, index)
        ),
    }
    return HEADER.format(**words), CODE.format(**words)


def shown(number: Number, kind: str) -> str:
    """A number as a reader wants it."""
    if kind == "bool":
        return "on" if number else "off"
    return f"{number:g}" if kind == "float" else str(number)


PAGE = """\
The copter takes a value only when it is within its range and all units accept the resulting
configuration; otherwise nothing changes, and a text gives the reason. It saves the value on the
ground, and a power cut leaves the set that was saved before, or this one.

On the ground it is in force at once; set in flight, it is so once the copter is disarmed.
Where the table says "restart" it is in force from the next start on: a text says so when it is
set, again when the copter is armed, and whenever a station asks for the list.

## How ground stations see them

On a link each parameter is a float, `MAV_PARAM_TYPE_REAL32`. MAVLink has two ways to write an
integer: the bits of it, or its number. A client that expects the other way shows 7.0e-39 where 5
is meant. All clients agree on a float, so whole numbers are sent as one, and a switch as 0 or 1.

- pymavlink and MAVProxy show and set numbers, and MAVProxy's `param save` and `param load` keep
  them.
- In MAVSDK, `get_param_float` and `set_param_float` are for all parameters; `get_param_int` and
  `set_param_int` answer WRONG_TYPE.
- A value of another type, that is no number, or with a fraction where none can be is refused: with
  a text, PARAM_ERROR, and the value as it is.
- A float has 24 bits: whole numbers above 16 777 216 are rounded, by at most 64.
"""


def page(file: File, source: str) -> str:
    """The page of the documentation."""
    lines = [
        "# Parameters",
        "",
        f"These can be set without compiling again: {len(file.parameters)} parameters of",
        f"`examples/{file.name}`. This page, the C table and the metadata for ground stations are",
        f"made from `{source}` by `make generate NAME=tables`.",
        "",
        *PAGE.splitlines(),
        "",
    ]
    for group in file.group:
        lines += [f"## {group.name}", ""]
        lines += ["| name | default | range | unit | in force | |", "|---|---|---|---|---|---|"]
        for one in group.parameter:
            low, high = (shown(number, one.type) for number in one.bounds)
            span = "on, off" if one.type == "bool" else f"{low} to {high}"
            lines.append(
                f"| `{one.name}` | {shown(one.default, one.type)} | {span} |"
                f" {one.unit or ''} | {'restart' if one.restart else 'at once'} |"
                f" {one.description} |"
            )
        lines.append("")
    return "\n".join(lines)


def decimals(one: Parameter) -> int:
    """How many places a value needs."""
    if one.type != "float":
        return 0
    texts = [f"{float(number)!r}" for number in (*one.bounds, one.default)]
    return max(len(text.partition(".")[2].rstrip("0")) for text in texts) + 1


def metadata(file: File) -> str:
    """MAVLink's component metadata for parameters."""
    entries = []
    for group in file.group:
        for one in group.parameter:
            low, high = one.bounds
            entry: dict[str, object] = {
                "name": one.name,
                "type": "Float",  # As it is sent.
                "shortDesc": one.description,
                "group": group.name,
                "default": int(one.default) if one.type == "bool" else one.default,
                "min": low,
                "max": high,
                "rebootRequired": one.restart,
                "decimalPlaces": decimals(one),
            }
            if one.unit:
                entry["units"] = one.unit
            if one.type != "float":
                entry["increment"] = 1
            if one.type == "bool":
                entry["values"] = [
                    {"value": 0, "description": "off"},
                    {"value": 1, "description": "on"},
                ]
            entries.append(entry)
    return json.dumps({"version": 1, "parameters": entries}, indent=2) + "\n"


FILES = """\
/* SPDX-License-Identifier: Apache-2.0 */
/* The files that ground stations may load: MAVLink's metadata of the component and of its
 * parameters. Generated by `make generate NAME=tables` from {source}; do not
 * edit. */
#include "ftp.h"

/* clang-format off */
{arrays}

const copter_file_t copter_file[COPTER_FILES] = {{
{rows}
}};
/* clang-format on */
"""
BYTES_IN_LINE = 16
PARAMETER_METADATA = 1  # COMP_METADATA_TYPE_PARAMETER.
INVERTED = 0xFFFFFFFF


def crc32(data: bytes) -> int:
    """CRC-32 as MAVLink has it: it begins with 0, and the result is not inverted."""
    return zlib.crc32(data, INVERTED) ^ INVERTED


def compact(data: object) -> bytes:
    """JSON without what only people need."""
    return json.dumps(data, separators=(",", ":")).encode("ascii")


def component_files(file: File) -> dict[str, bytes]:
    """The files by their names, the one first that names the other."""
    parameters = compact(json.loads(metadata(file)))
    entry = {
        "type": PARAMETER_METADATA,
        "uri": "mftp://[;comp=1]/parameters.json",
        "fileCrc": crc32(parameters),
    }
    general = compact({"version": 1, "metadataTypes": [entry]})
    return {"general.json": general, "parameters.json": parameters}


def byte_array(name: str, data: bytes) -> str:
    """An array of C."""
    lines = [
        ", ".join(f"0x{byte:02X}" for byte in data[start : start + BYTES_IN_LINE])
        for start in range(0, len(data), BYTES_IN_LINE)
    ]
    body = ",\n    ".join(lines)
    return f"static const uint8_t {name}[{len(data)}] = {{\n    {body}}};"


def embedded(file: File, source: str) -> str:
    """The files in C."""
    made = component_files(file)
    names = {name: name.partition(".")[0] for name in made}
    rows = [
        f'    {{"{name}", "F{name}\\t{len(data)}", {names[name]}, {len(data)}u,'
        f" 0x{crc32(data):08X}u}},"
        for name, data in made.items()
    ]
    arrays = [byte_array(names[name], data) for name, data in made.items()]
    return FILES.format(source=source, arrays="\n\n".join(arrays), rows="\n".join(rows))


def files(file: File, source: str) -> dict[str, str]:
    """All that is made, by path."""
    header, table = code(file, source)
    folder = f"examples/{file.name}"
    return {
        f"{folder}/parameter_table.h": header,
        f"{folder}/parameter_table.c": table,
        f"{folder}/parameters.json": metadata(file),
        f"{folder}/files.c": embedded(file, source),
        "docs/parameters.md": page(file, source),
    }


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--check", action="store_true", help="only see whether all are up to date")
    parser.add_argument("--root", type=Path, default=ROOT, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    try:
        made = files(read(read_text(options.root / SOURCE), SOURCE), SOURCE)
    except (ConfigError, ToolError) as error:
        print(error, file=sys.stderr)
        return 2
    stale = [
        path
        for path, text in made.items()
        if not (options.root / path).is_file()
        or (options.root / path).read_text(encoding="utf-8") != text
    ]
    if options.check:
        for path in stale:
            made_by = "`make generate NAME=tables` does"
            print(f"{path}: is not what {SOURCE} makes; {made_by}", file=sys.stderr)
        return 1 if stale else 0
    for path in stale:
        write_text(options.root / path, made[path])
    print(f"parameters: {', '.join(stale) or 'nothing'} changed")
    return 0
