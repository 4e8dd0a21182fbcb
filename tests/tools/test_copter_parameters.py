# SPDX-License-Identifier: Apache-2.0
"""The copter's settings through its parameters: defaults, what is set, put in force, saved and
loaded again, also when the power fails meanwhile."""

from __future__ import annotations

import ctypes
import shutil
import tempfile
import unittest
from pathlib import Path
from typing import ClassVar

from shim import below, library_of

ROOT = Path(__file__).resolve().parents[2]

# A copter's parameters behind functions of plain numbers.
SHIM = """\
#include "file_medium.h"
#include "parameter_store.h"
#include <string.h>
static copter_parameter_store_t all;
static keel_medium_t memory;
static char path[512];
static keel_medium_t whole;
static uint32_t left = UINT32_MAX; /* Bytes that are written before the power fails. */
static bool cut(void *context, uint32_t address, const uint8_t *bytes, uint32_t count)
{
    const uint32_t now = (count < left) ? count : left;
    left -= now;
    return (now == 0u) || whole.write(context, address, bytes, now);
}
uint32_t power_for(uint32_t bytes)
{
    const uint32_t before = left;
    left = bytes;
    return before;
}
int start(const char *file)
{
    memset(&all, 0x5A, sizeof all);
    memset(&copter_settings, 0x5A, sizeof copter_settings);
    if (file == NULL) { return (int)copter_parameter_store_start(&all, NULL); }
    strncpy(path, file, sizeof path - 1u);
    whole = file_medium(path);
    memory = whole;
    memory.write = cut;
    return (int)copter_parameter_store_start(&all, &memory);
}
int is_default(void)
{
    return memcmp(&copter_settings, &copter_defaults, sizeof copter_settings) == 0;
}
int set(const char *name, int type, double number)
{
    const keel_parameter_value_t value = {(keel_parameter_type_t)type,
                                          type == 0 ? (float)number : 0.0f,
                                          type == 0 ? 0 : (int32_t)number};
    return (int)keel_parameters_set_by_name(&all.table, name, value);
}
int apply(void) { return copter_parameter_store_apply(&all); }
int differs(const char *name)
{
    return copter_parameter_store_differs(&all, keel_parameters_find(&all.table, name));
}
void look(float *number)
{
    for (uint16_t i = 0u; i < keel_parameters_count(&all.table); i++) {
        const keel_parameter_value_t value = keel_parameters_get(&all.table, i);
        number[i] = value.type == KEEL_PARAMETER_FLOAT ? value.real : (float)value.whole;
    }
}
double idle_thrust(void) { return copter_settings.mixer.idle; }
int save(void) { return (int)copter_parameter_store_save(&all); }
int step(void) { copter_parameter_store_step(&all); return (int)all.saved; }
int found(void) { return (int)all.found; }
int taken(void) { return (int)all.loaded.taken; }
double critical(void) { return copter_settings.battery.critical_voltage; }
double thrust(void) { return copter_settings.cascade.hover; }
int cells(void) { return copter_settings.battery.cells; }
int returns(void) { return copter_settings.mode.returns; }
int refused_defaults(void)
{
    int refused = 0;
    for (uint16_t i = 0u; i < keel_parameters_count(&all.table); i++) {
        refused += keel_parameters_set(&all.table, i, copter_parameter[i].initial) != KEEL_OK;
    }
    return refused;
}
"""

OK, NONE, BUSY = 0, 2, 1
NO_MEMORY, UNDER_WAY = 1, 2  # KEEL_ERR_NULL, KEEL_ERR_STATE
FLOAT, INT32, BOOL = 0, 1, 2
ENDLESS = 2**32 - 1


class CopterParameters(unittest.TestCase):
    """What the copter starts with."""

    scratch: ClassVar[str]
    copter: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.scratch = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.scratch)
        folders = ("include", "bsp", "examples/copter", "examples/copter_in_plant")
        names = ("parameters", "parameter_table", "parameter_store", "settings")
        sources = [
            *(f"examples/copter/{name}.c" for name in names),
            "examples/copter_in_plant/file_medium.c",
            "bsp/common/slots.c",
            *below("src/middleware"),
            *below("src/flight"),
        ]
        cls.copter = library_of(cls, SHIM, sources, [f"-I{folder}" for folder in folders])
        for name in ("critical", "thrust", "idle_thrust"):
            getattr(cls.copter, name).restype = ctypes.c_double

    def setUp(self) -> None:
        self.file = Path(self.scratch, f"{self.id()}.fram")

    def start(self) -> None:
        self.assertEqual(self.copter.start(str(self.file).encode()), OK)

    def set(self, name: str, type_: int, number: float) -> int:
        return int(self.copter.set(name.encode(), type_, ctypes.c_double(number)))

    def save(self) -> None:
        self.assertEqual(self.copter.save(), OK)
        while self.copter.step() == BUSY:
            pass

    def test_PAR_010_without_a_stored_set_all_is_as_the_defaults(self) -> None:
        self.assertEqual(self.copter.start(None), OK)
        self.assertTrue(self.copter.is_default())
        self.start()
        self.assertTrue(self.copter.is_default())
        self.assertEqual(self.copter.found(), NONE)
        self.assertEqual(self.copter.refused_defaults(), 0)

    def test_PAR_010_what_was_saved_is_in_force_after_the_next_start(self) -> None:
        self.start()
        self.assertEqual(self.set("BAT_V_CRIT", FLOAT, 3.25), OK)
        self.assertEqual(self.set("THR_HOVER", FLOAT, 0.5), OK)
        self.assertEqual(self.set("BAT_CELLS", INT32, 3), OK)
        self.assertEqual(self.set("FS_RETURN", BOOL, 0), OK)
        self.assertTrue(self.copter.is_default())
        self.save()
        self.start()
        self.assertEqual(self.copter.taken(), 4)
        self.assertEqual(self.copter.critical(), 3.25)
        self.assertEqual(self.copter.thrust(), 0.5)
        self.assertEqual((self.copter.cells(), self.copter.returns()), (3, 0))

    def test_PAR_010_a_value_that_a_unit_does_not_take_with_the_others(self) -> None:
        self.start()
        self.assertNotEqual(self.set("BAT_V_CRIT", FLOAT, 3.6), OK)  # Low is 3.5.
        self.assertEqual(self.set("BAT_V_LOW", FLOAT, 3.7), OK)
        self.assertEqual(self.set("BAT_V_CRIT", FLOAT, 3.6), OK)
        self.save()
        self.start()
        self.assertEqual(self.copter.taken(), 2)

    def test_PAR_011_what_is_set_on_the_ground_is_in_force_at_once(self) -> None:
        self.start()
        self.assertEqual(self.set("MOT_IDLE", FLOAT, 0.125), OK)
        self.assertTrue(self.copter.differs(b"MOT_IDLE"))
        self.assertTrue(self.copter.is_default())
        self.assertTrue(self.copter.apply())
        self.assertEqual(self.copter.idle_thrust(), 0.125)
        self.assertFalse(self.copter.differs(b"MOT_IDLE"))
        self.assertFalse(self.copter.apply())

    def test_PAR_011_what_waits_for_a_restart_is_in_force_after_it(self) -> None:
        self.start()
        self.assertEqual(self.set("BAT_CELLS", INT32, 3), OK)
        self.assertEqual(self.set("THR_HOVER", FLOAT, 0.5), OK)
        self.assertTrue(self.copter.apply())
        self.assertEqual((self.copter.cells(), self.copter.thrust()), (4, 0.5))
        self.assertTrue(self.copter.differs(b"BAT_CELLS"))
        self.save()
        self.start()
        self.assertEqual(self.copter.cells(), 3)
        self.assertFalse(self.copter.differs(b"BAT_CELLS"))

    def look(self) -> list[float]:
        numbers = (ctypes.c_float * 200)()
        self.copter.look(numbers)
        return list(numbers)

    def save_anew(self, saved: bytes, cut: int) -> tuple[list[float], int]:
        """Save other values than a file has, with power for so many bytes; what was to be saved,
        and how many bytes were not needed."""
        self.file.write_bytes(saved)
        self.start()
        for name, number in (("BAT_CELLS", 6), ("RTL_TIME", 130_000_000)):
            self.assertEqual(self.set(name, INT32, number), OK)
        self.assertEqual(self.set("HEIGHT_P", FLOAT, 1.25), OK)
        values = self.look()
        self.copter.power_for(cut)
        self.save()
        return values, int(self.copter.power_for(ENDLESS))

    def test_PAR_012_a_power_cut_leaves_the_old_set_or_the_new_one(self) -> None:
        self.start()
        for name, number in (("BAT_CELLS", 3), ("KILL_TIME", 900_000)):
            self.assertEqual(self.set(name, INT32, number), OK)
        self.save()
        old, saved = self.look(), self.file.read_bytes()
        new, left = self.save_anew(saved, 1000)
        # The slot's mark cleared and set, 8 bytes of its head, 4 records, and 4 bytes of its check.
        self.assertEqual(1000 - left, 1 + 8 + 4 * 21 + 4 + 1)
        for cut in range(1000 - left + 1):
            self.save_anew(saved, cut)
            self.start()
            self.assertEqual(self.look(), new if cut == 1000 - left else old, cut)

    def test_PAR_010_defaults_are_stored_as_nothing(self) -> None:
        self.start()
        self.save()
        self.start()
        self.assertEqual((self.copter.found(), self.copter.taken()), (OK, 0))
        self.assertTrue(self.copter.is_default())

    def test_PAR_010_a_damaged_memory_gives_the_defaults(self) -> None:
        self.start()
        self.set("BAT_CELLS", INT32, 3)
        self.save()
        self.file.write_bytes(bytes(byte ^ 0x10 for byte in self.file.read_bytes()))
        self.start()
        self.assertEqual(self.copter.found(), NONE)
        self.assertTrue(self.copter.is_default())

    def test_PAR_010_saves_that_cannot_be(self) -> None:
        self.assertEqual(self.copter.start(None), OK)
        self.assertEqual(self.copter.save(), NO_MEMORY)
        self.start()
        self.assertEqual(self.copter.save(), OK)
        self.assertEqual(self.copter.save(), UNDER_WAY)
