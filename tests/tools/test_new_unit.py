# SPDX-License-Identifier: Apache-2.0
"""Tests of keel.mk's `new`: a unit proved as it stands, and harnesses of a header's prototypes.

The provers are the real ones; what they prove is kept in the user's cache.
"""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from makefile import make_in

ROOT = Path(__file__).resolve().parents[2]
HEADER = """\
#ifndef MOTOR_VALVE_H
#define MOTOR_VALVE_H

#include <stdbool.h>
#include <stdint.h>

#define VALVE_STEPS 2u

typedef struct valve_part {
    float gain;
    bool on;
} valve_part_t;

typedef struct valve {
    valve_part_t part;
    int16_t step[VALVE_STEPS];
} valve_t;

/*@ requires \\valid(valve);
  @ assigns valve->part;
  @ ensures VLV_004_on: valve->part.on == on;
  @*/
void valve_set(valve_t *valve, bool on);

/*@ requires \\valid_read(valve) && \\valid(step);
  @ assigns *step;
  @ ensures VLV_005_step: *step == valve->step[0];
  @*/
bool valve_get(const valve_t *valve, int16_t *step);

#endif
"""
SOURCE = """\
#include "motor/valve.h"

void valve_set(valve_t *valve, bool on)
{
    valve->part.gain = on ? 1.0f : 0.0f;
    valve->part.on = on;
}

bool valve_get(const valve_t *valve, int16_t *step)
{
    *step = valve->step[0];
    return valve->part.on;
}
"""
MODEL = SOURCE.replace("valve_set", "model_valve_set").replace("valve_get", "model_valve_get")


class New(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.project = Path(folder.name).resolve()

    def good(self, *words: str) -> str:
        """What make says that succeeds."""
        status, output = make_in(self.project, *words)
        self.assertEqual(status, 0, output)
        return output

    def refused(self, *words: str) -> str:
        """What make says that refuses, and leaves every file as it was."""
        before = self.files()
        status, output = make_in(self.project, "new", *words)
        self.assertNotEqual(status, 0, output)
        self.assertEqual(self.files(), before)
        return output

    def files(self) -> dict[str, str]:
        """The project's files."""
        return {
            str(path.relative_to(self.project)): path.read_text(encoding="utf-8")
            for path in self.project.rglob("*")
            if path.is_file() and "build" not in path.parts
        }

    def put(self, place: str, text: str) -> None:
        """Write a file of the project."""
        (self.project / place).parent.mkdir(parents=True, exist_ok=True)
        (self.project / place).write_text(text, encoding="utf-8")

    def test_a_new_unit_is_proved_and_tested_as_it_stands(self) -> None:
        self.good("new", "UNIT=rate_counter", "ARGS=--layer comms")
        self.assertIn("void rate_counter_init(", self.files()["include/comms/rate_counter.h"])
        self.assertIn("ensures RAT_001_limit", self.files()["include/comms/rate_counter.h"])
        for name, text in self.files().items():
            self.assertNotRegex(f"{name}\n{text}".replace(str(ROOT), ""), r"(?i)limiter|LIM[-_]")
        self.assertIn("determined: 2 of 2 functions for every valid state", self.good("prove"))
        self.assertTrue(self.good("test").endswith("4 of 4 tests passed\n"))

    def test_a_second_unit_stands_beside_the_first(self) -> None:
        self.good("new", "UNIT=counter")
        self.good("new", "UNIT=gate")
        self.assertIn("determined: 4 of 4 functions for every valid state", self.good("prove"))
        self.assertIn('id = "COU-001"', self.files()["specs/requirements.toml"])
        self.assertIn('id = "GAT-002"', self.files()["specs/requirements.toml"])

    def test_what_is_there_is_named_and_nothing_is_written(self) -> None:
        self.put("tests/unit/test_gate.c", "mine\n")
        self.assertIn("there is already: tests/unit/test_gate.c", self.refused("UNIT=gate"))
        self.put("specs/requirements.toml", '[[requirement]]\nid = "GAR-007"\n')
        self.assertIn("GAR-… is there already", self.refused("UNIT=garage"))

    def test_a_name_that_is_none_is_refused(self) -> None:
        for words, why in (
            ([], "unit=: expected a name"),
            (["UNIT=Gate"], "unit=Gate: expected"),
            (["UNIT=while"], "unit=while: expected"),
            (["UNIT=up"], "--id UP: expected three or four capitals"),
            (["UNIT=gate", "ARGS=--layer ../x"], "layer=../x: expected"),
        ):
            self.assertIn(why, self.refused(*words))

    def test_prototypes_become_harnesses_that_hold_when_the_rest_is_written(self) -> None:
        self.put("include/motor/valve.h", HEADER)
        output = self.good("new", "UNIT=valve")
        self.assertIn("written src/motor/valve.c", output)
        self.assertIn("0 of 2 tests passed", make_in(self.project, "test")[1])
        self.put("src/motor/valve.c", SOURCE)
        self.put("specs/model/valve.c", MODEL.replace("motor/valve.h", "valve.h"))
        output = make_in(self.project, "prove", "ARGS=--engine cbmc")[1]
        self.assertIn("determined: 2 of 2 functions for every valid state", output)
        self.assertNotIn("REFUTED", output)
        listed = self.files()["proofs/valve/valve_get_harness.c"]
        for label in ("VLV_005_result", "VLV_005_step"):
            self.assertIn(label, listed)
        for slip, told in (
            ("1.0f", "VLV_004_valve"),
            ("step[0]", "VLV_005_step"),
            ("part.on;", "VLV_005_result"),
        ):
            wrong = {"1.0f": "2.0f", "step[0]": "step[1]", "part.on;": "part.on ? false : true;"}
            self.put("src/motor/valve.c", SOURCE.replace(slip, wrong[slip]))
            output = make_in(self.project, "prove", "ARGS=--engine cbmc")[1]
            self.assertIn(f"{told}: as the model says: REFUTED", output)

    def test_an_array_of_unknown_length_is_told(self) -> None:
        self.put("include/motor/valve.h", "void valve_all(const int *data);\n")
        output = self.refused("UNIT=valve")
        self.assertIn("include/motor/valve.h: data: const int *: of how many elements?", output)

    def test_a_header_without_a_prototype_is_told(self) -> None:
        self.put("include/motor/valve.h", "#define VALVE 1\n")
        self.assertIn("include/motor/valve.h: there is no prototype", self.refused("UNIT=valve"))
