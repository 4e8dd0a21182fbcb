# SPDX-License-Identifier: Apache-2.0
"""The table of parameters: is all that is made of it up to date, and are wrong files refused?"""

from __future__ import annotations

import json
import re
import struct
import unittest
from pathlib import Path
from typing import Any

from keel.config import ConfigError
from keel.copter import parameters

ROOT = Path(__file__).resolve().parents[2]

GOOD = """\
name = "copter"

[[group]]
name = "Battery"

[[group.parameter]]
name = "BAT_CELLS"
type = "int32"
as = "uint8_t"
range = [1, 14]
default = 4
restart = true
description = "Cells in series."
fields = ["battery.cells"]

[[group.parameter]]
name = "BAT_LOW"
type = "float"
unit = "V"
range = [2.5, 4.2]
default = 3.5
description = "A voltage."
fields = ["warning.low_voltage", "0.5 * other[KEEL_ROLL].value", "-1 * less"]

[[group.parameter]]
name = "RETURNS"
type = "bool"
default = true
description = "Whether it returns."
fields = ["mode.returns"]
"""

# What is changed in it, and what is said: the line, the key and the reason.
WRONG: list[tuple[str, str, str]] = [
    ('name = "BAT_LOW"', 'name = "BAT_LOW_VOLTAGE_X"', "x.toml:17: group Battery: parameter"),
    ('name = "BAT_LOW"', 'name = "bat_low"', ": name: expected to match pattern"),
    (
        'name = "BAT_LOW"',
        'name = "BAT_CELLS"',
        "x.toml:17: group Battery: parameter BAT_CELLS: name: there is another BAT_CELLS",
    ),
    (
        'type = "float"',
        'type = "double"',
        "x.toml:18: group Battery: parameter BAT_LOW: type: "
        "expected to be 'float', 'int32' or 'bool'",
    ),
    ("range = [2.5, 4.2]\n", "", "x.toml:16: group Battery: parameter BAT_LOW: a range is what"),
    ("range = [2.5, 4.2]", "range = [2.5]", "x.toml:20: group Battery: parameter BAT_LOW: range:"),
    ("default = 3.5", "default = 2.4", "the default 2.4 is not within 2.5 to 4.2"),
    ("default = 3.5", "default = nan", "parameter BAT_LOW: nan is no float"),
    ("default = 3.5", "default = true", "True is no float"),
    ("range = [2.5, 4.2]", "range = [2.5, 1e39]", "parameter BAT_LOW: 1e+39 is no float"),
    ("default = 4\n", "default = 4.0\n", "parameter BAT_CELLS: 4.0 is no int32"),
    ("range = [1, 14]", "range = [1, 256]", "the range does not fit into uint8_t"),
    ("range = [1, 14]", "range = [-1, 14]", "the range does not fit into uint8_t"),
    ("range = [1, 14]", "range = [1, 2147483648]", "2147483648 is no int32"),
    ("default = true", "default = 1", "1 is no bool"),
    ("default = true", "range = [0, 1]\ndefault = true", "and a bool has not"),
    (
        '"mode.returns"',
        '"battery.cells"',
        "x.toml:30: group Battery: parameter RETURNS: fields: "
        "battery.cells is set by another parameter",
    ),
    ('"mode.returns"', '"mode.returns; x"', "fields: 'mode.returns; x' is no field"),
    ('"mode.returns"', '"2 * mode.returns"', "a factor is for floats"),
    ('fields = ["mode.returns"]', "fields = []", "x.toml:30: group Battery: parameter RETURNS: "),
    (
        '"0.5 * other[KEEL_ROLL].value"',
        '"battery.cells_2"',
        "parameter BAT_LOW: restart: another parameter of battery differs",
    ),
    ("restart = true", "restart = 1", "parameter BAT_CELLS: restart: expected to be"),
    ('unit = "V"', 'units = "V"', "x.toml:19: group Battery: parameter BAT_LOW: units: unknown"),
    ('description = "A voltage."\n', "", "parameter BAT_LOW: description: is missing"),
    ('description = "A voltage."', 'description = "A | voltage"', "description: expected to match"),
    ("[[group]]", "[[groups]]", "x.toml:3: groups: unknown key; did you mean group?"),
    ('name = "copter"', 'name = "copter', "x.toml:1: no TOML"),
]


class Files(unittest.TestCase):
    """What is read, and what is refused."""

    def test_PAR_009_a_right_file(self) -> None:
        file = parameters.read(GOOD, "x.toml")
        self.assertEqual([one.name for one in file.parameters], ["BAT_CELLS", "BAT_LOW", "RETURNS"])

    def test_PAR_009_wrong_files_are_refused_with_line_key_and_reason(self) -> None:
        for before, after, said in WRONG:
            with self.subTest(after or before):
                self.assertEqual(GOOD.count(before), 1, before)
                with self.assertRaises(ConfigError) as refused:
                    parameters.read(GOOD.replace(before, after), "x.toml")
                self.assertIn(said, str(refused.exception))
                self.assertRegex(str(refused.exception), r"^x\.toml:\d+: ")


class Made(unittest.TestCase):
    """What is made of a file."""

    def setUp(self) -> None:
        self.file = parameters.read(GOOD, "x.toml")

    def test_PAR_009_all_is_up_to_date(self) -> None:
        self.assertEqual(parameters.main(["--check"]), 0)

    def test_PAR_009_the_table(self) -> None:
        header, code = parameters.code(self.file, "x.toml")
        self.assertIn("#define COPTER_PARAMETER_COUNT 3u\n", header)
        self.assertIn(
            '{.name = "BAT_LOW",\n     .initial = {.type = KEEL_PARAMETER_FLOAT, .real = 3.5f},\n'
            "     .lowest = {.type = KEEL_PARAMETER_FLOAT, .real = 2.5f},\n"
            "     .highest = {.type = KEEL_PARAMETER_FLOAT, .real = 4.2f}},",
            code,
        )
        self.assertIn(
            ".highest = {.type = KEEL_PARAMETER_INT32, .whole = 14},\n     .restarts = true},", code
        )
        self.assertEqual(code.count(".restarts"), 1)
        self.assertIn("settings->battery.cells = (uint8_t)entry[0].value.whole;", code)
        self.assertIn("settings->other[KEEL_ROLL].value = 0.5f * entry[1].value.real;", code)
        self.assertIn("settings->less = -entry[1].value.real;", code)
        self.assertIn("settings->mode.returns = entry[2].value.whole != 0;", code)

    def test_PAR_009_the_page(self) -> None:
        page = parameters.page(self.file, "x.toml")
        self.assertIn("| `BAT_LOW` | 3.5 | 2.5 to 4.2 | V | at once | A voltage. |", page)
        self.assertIn("| `RETURNS` | on | on, off |  | at once | Whether it returns. |", page)

    def test_PAR_009_the_metadata(self) -> None:
        cells, low, returns = json.loads(parameters.metadata(self.file))["parameters"]
        self.assertEqual({one["type"] for one in (cells, low, returns)}, {"Float"})  # As sent.
        self.assertEqual([one.get("increment") for one in (cells, low, returns)], [1, None, 1])
        self.assertEqual([one["decimalPlaces"] for one in (cells, low, returns)], [0, 2, 0])
        self.assertEqual(
            [one["rebootRequired"] for one in (cells, low, returns)], [True, False, False]
        )
        self.assertEqual((low["default"], low["min"], low["max"]), (3.5, 2.5, 4.2))
        self.assertEqual((low["units"], low["group"]), ("V", "Battery"))
        self.assertEqual([one["value"] for one in returns["values"]], [0, 1])

    def test_PAR_009_the_files_that_ground_stations_load(self) -> None:
        made = parameters.component_files(self.file)
        self.assertEqual(list(made), ["general.json", "parameters.json"])
        self.assertEqual(
            json.loads(made["parameters.json"]), json.loads(parameters.metadata(self.file))
        )
        general = json.loads(made["general.json"])
        self.assertEqual(general["version"], 1)
        self.assertEqual(
            general["metadataTypes"],
            [
                {
                    "type": 1,
                    "uri": "mftp://[;comp=1]/parameters.json",
                    "fileCrc": parameters.crc32(made["parameters.json"]),
                }
            ],
        )
        code = parameters.embedded(self.file, "x.toml")
        held = re.findall(r"static const uint8_t (\w+)\[(\d+)\] = \{([^}]*)\}", code)
        self.assertEqual(
            [
                (f"{name}.json", bytes(int(one, 16) for one in text.split(",")))
                for name, _, text in held
            ],
            list(made.items()),
        )
        self.assertEqual([int(size) for _, size, _ in held], [len(data) for data in made.values()])

    def test_PAR_009_sums_are_mavlinks(self) -> None:
        # By hand: eight shifts of a byte of 1 are the table's entry 1, and those of 0 keep 0.
        self.assertEqual(parameters.crc32(b"\x00\x00"), 0)
        self.assertEqual(parameters.crc32(b"\x01"), 0x77073096)

    def test_PAR_009_the_limits_are_the_kernels(self) -> None:
        header = (ROOT / "examples/copter/parameters.h").read_text(encoding="utf-8")
        self.assertIn(f"#define KEEL_PARAMETER_NAME_LENGTH {parameters.NAME_LENGTH}\n", header)


# What MAVLink's schema for the metadata of parameters says of each entry, in its words for types.
ENTRY: dict[str, type | tuple[type, ...]] = {
    "name": str,
    "type": str,
    "shortDesc": str,
    "units": str,
    "group": str,
    "values": list,
    "default": (int, float),
    "min": (int, float),
    "max": (int, float),
    "decimalPlaces": int,
    "increment": int,
    "rebootRequired": bool,
}


class Metadata(unittest.TestCase):
    """The metadata of the copter, by what MAVLink asks for."""

    def setUp(self) -> None:
        path = ROOT / "examples/copter/parameters.json"
        self.data: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))

    def test_PAR_009_it_has_the_form_that_ground_stations_read(self) -> None:
        self.assertEqual(set(self.data), {"version", "parameters"})
        self.assertEqual(self.data["version"], 1)
        for entry in self.data["parameters"]:
            self.assertLessEqual(set(entry), set(ENTRY))
            for key, found in entry.items():
                self.assertIsInstance(found, ENTRY[key], f"{entry['name']}: {key}")
            self.assertRegex(entry["name"], r"^[-.a-zA-Z0-9_]{1,16}$")
            self.assertEqual(entry["type"], "Float")
            self.assertLessEqual(entry["min"], entry["default"])
            self.assertLessEqual(entry["default"], entry["max"])

    def test_PAR_009_what_is_shown_is_what_is_meant(self) -> None:
        for entry in self.data["parameters"]:
            shown = round(entry["default"], entry["decimalPlaces"])
            self.assertEqual(struct.pack("f", shown), struct.pack("f", entry["default"]))

    def test_PAR_009_the_defaults_are_those_of_the_settings(self) -> None:
        text = (ROOT / "examples/copter/settings.c").read_text(encoding="utf-8")
        given = {entry["name"]: entry["default"] for entry in self.data["parameters"]}
        hover = re.search(r"#define HOVER +([0-9.]+)f", text)
        self.assertEqual(given["THR_HOVER"], float(hover[1]) if hover else None)
        self.assertIn(f".stop_s = {given['STOP_TIME']}f,", text)
        self.assertIn(f".cells = {given['BAT_CELLS']}u,", text)
