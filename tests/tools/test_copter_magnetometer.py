# SPDX-License-Identifier: Apache-2.0
"""What the battery's current adds to the magnetic field is taken off, before its calibration."""

from __future__ import annotations

import ctypes
import unittest
from typing import ClassVar

from copter_shim import SILENT, copter_of

# Background and foreground magnetometer behind functions of plain numbers.
SHIM = """\
#include <string.h>
static copter_t copter;
static copter_port_t port;
static float measured[3];
static bool read_magnetometer(void *context, copter_magnetometer_sample_t *sample)
{
    (void)context;
    memcpy(sample->value, measured, sizeof measured);
    return true;
}
int start(void)
{
    port = (copter_port_t){.read_clock = read_clock,
                           .read_byte = read_byte,
                           .read_magnetometer = read_magnetometer,
                           .imus = 3u};
    return (int)copter_start(&copter, &port, false);
}
int set(const char *name, float value)
{
    const keel_parameter_value_t wanted = {.type = KEEL_PARAMETER_FLOAT, .real = value};
    const int status = (int)keel_parameters_set_by_name(&copter.parameters.table, name, wanted);
    copter_parameter_store_apply(&copter.parameters);
    return status;
}
void correct(float offset, float scale)
{
    copter.calibration.magnetometer.offset[0] = offset;
    copter.calibration.magnetometer.scale[0] = scale;
}
void draw(float ampere) { copter.power.battery.current = ampere; }
void measure(float x, float y, float z)
{
    measured[0] = x;
    measured[1] = y;
    measured[2] = z;
    copter_background_magnetometer(&copter.magnetometer, &copter);
    copter_background_magnetometer(&copter.magnetometer, &copter);
    copter_foreground_magnetometer(&copter.magnetometer, &copter);
}
float field(int axis)
{
    const keel_attitude_vector_t *const v = &copter.magnetometer.field;
    return (axis == 0) ? v->x : ((axis == 1) ? v->y : v->z);
}
float raw(int axis)
{
    const keel_attitude_vector_t *const v = &copter.magnetometer.raw;
    return (axis == 0) ? v->x : ((axis == 1) ? v->y : v->z);
}
"""
OK = 0


class OwnFieldTest(unittest.TestCase):
    """Expected values by hand."""

    copter: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.copter = copter_of(cls, SILENT + SHIM)
        for name in ("field", "raw"):
            getattr(cls.copter, name).restype = ctypes.c_float

    def setUp(self) -> None:
        self.assertEqual(self.copter.start(), OK)

    def set(self, name: str, value: float) -> None:
        self.assertEqual(self.copter.set(name.encode(), ctypes.c_float(value)), OK)

    def seen(self, ampere: float, *field: float) -> list[float]:
        """The field in use, from what is measured at this current."""
        self.copter.draw(ctypes.c_float(ampere))
        self.copter.measure(*(ctypes.c_float(value) for value in field))
        return [self.copter.field(axis) for axis in range(3)]

    def test_unknown_it_stays(self) -> None:
        self.assertEqual(self.seen(20.0, 21.0, -3.0, 43.0), [21.0, -3.0, 43.0])

    def test_each_axis_has_its_own_share_of_the_current(self) -> None:
        for name, value in (("MAG_CUR_X", 0.5), ("MAG_CUR_Y", -0.25), ("MAG_CUR_Z", 2.0)):
            self.set(name, value)
        self.assertEqual(self.seen(0.0, 21.0, -3.0, 43.0), [21.0, -3.0, 43.0])
        self.assertEqual(self.seen(8.0, 21.0, -3.0, 43.0), [17.0, -1.0, 27.0])

    def test_it_is_taken_off_before_offset_and_scale(self) -> None:
        self.set("MAG_CUR_X", 0.5)
        self.copter.correct(ctypes.c_float(3.0), ctypes.c_float(1.0625))
        self.assertEqual(self.seen(8.0, 23.0, 0.0, 0.0)[0], 17.0)  # (23 - 4 - 3) 17 / 16

    def test_what_was_measured_is_logged_as_it_was(self) -> None:
        self.set("MAG_CUR_X", 0.5)
        self.seen(8.0, 21.0, -3.0, 43.0)
        self.assertEqual([self.copter.raw(axis) for axis in range(3)], [21.0, -3.0, 43.0])


if __name__ == "__main__":
    unittest.main()
