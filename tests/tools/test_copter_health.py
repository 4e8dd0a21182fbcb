# SPDX-License-Identifier: Apache-2.0
"""What the copter keeps and tells of its barometer and of its chip, task by task, by hand."""

from __future__ import annotations

import ctypes
import struct
import unittest
from pathlib import Path
from typing import ClassVar

from copter_shim import copter_of

ROOT = Path(__file__).resolve().parents[2]

# The tasks behind functions of plain numbers, with a port that says what it is told to.
SHIM = """\
#include "copter.h"
#include "telemetry.h"
#include <string.h>
static copter_t copter;
static copter_link_t link_of_test;
static copter_port_t port;
static copter_barometer_sample_t breath;
static copter_chip_t chip;
static bool breathes;
static bool ready;
static int asked;
const int PRESSURE = SENT_SCALED_PRESSURE, NAMED = SENT_NAMED_VALUE_INT;
static bool read_breath(void *context, copter_barometer_sample_t *sample)
{
    (void)context;
    if (breathes) { *sample = breath; }
    return breathes;
}
static void read_chip_of_test(void *context, copter_chip_t *to)
{
    (void)context;
    asked++;
    if (chip.has_supply) { to->supply_mv = chip.supply_mv; to->has_supply = true; }
    if (chip.has_temperature) { to->temperature = chip.temperature; to->has_temperature = true; }
}
int start(int measures)
{
    memset(&copter, 0, sizeof copter);
    memset(&link_of_test, 0, sizeof link_of_test);
    port = (copter_port_t){.read_barometer = read_breath,
                           .read_chip = measures ? read_chip_of_test : NULL};
    copter.port = &port;
    asked = 0;
    return (int)copter_barometer_init(&copter.barometer);
}
void at(double seconds) { copter.scheduler.clock.now_us = (uint64_t)(1e6 * seconds); }
void background(int there, double pressure, int temperature)
{
    breathes = there != 0;
    breath = (copter_barometer_sample_t){(float)pressure, (int16_t)temperature};
    copter_background_barometer(&copter.barometer, &copter);
}
void foreground(void) { copter_foreground_barometer(&copter.barometer); }
int air_temperature(void) { return copter.barometer.temperature; }
double air_pressure(void) { return copter.barometer.pressure_pa; }
int blocks_by_pressure(void)
{
    copter_settings = copter_defaults;
    (void)copter_state_machine_init(&copter.state);
    copter_state_machine(&copter.state, &copter.request, &copter);
    return (copter.state.mode.blocking.checks & COPTER_CHECK_GROUND_PRESSURE) != 0u;
}
static bool is_ready_of_test(void *context)
{
    (void)context;
    return ready;
}
int blocks_by_switch(int uses, int has, int is_ready)
{
    copter_settings = copter_defaults;
    copter_settings.safety_switch = uses != 0;
    port.is_ready = (has != 0) ? is_ready_of_test : NULL;
    ready = is_ready != 0;
    (void)copter_state_machine_init(&copter.state);
    copter_state_machine(&copter.state, &copter.request, &copter);
    return (copter.state.mode.blocking.checks & COPTER_CHECK_SAFETY_SWITCH) != 0u;
}
int uses_by_default(void) { return copter_defaults.safety_switch; }
int healthy_barometer(void)
{
    uint8_t payload[KEEL_MAVLINK_PAYLOAD_MAX] = {0};
    copter.estimate.altitude.axis.quality = KEEL_AXIS_GOOD;
    (void)copter_mavlink_report(&copter, &link_of_test, SENT_SYS_STATUS, payload);
    return (payload[8] & MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE) != 0;
}
int measure(int has_supply, int supply, int has_temperature, int temperature)
{
    chip = (copter_chip_t){(uint16_t)supply, (int16_t)temperature, has_supply != 0,
                           has_temperature != 0};
    copter_adc(&copter.health, &copter);
    return asked;
}
int has_supply(void) { return copter.health.chip.has_supply; }
int has_temperature(void) { return copter.health.chip.has_temperature; }
int supply(void) { return copter.health.chip.supply_mv; }
int temperature(void) { return copter.health.chip.temperature; }
void battery(double volts) { copter.power.battery.voltage = (float)volts; }
void stack(uint32_t bytes) { copter.health.stack_free = bytes; }
int report(int sent, uint8_t *payload)
{
    memset(payload, 0, KEEL_MAVLINK_PAYLOAD_MAX);
    return copter_mavlink_report(&copter, &link_of_test, (uint32_t)sent, payload);
}
"""
OK = 0


class CopterHealth(unittest.TestCase):
    """Barometer and chip."""

    copter: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.copter = copter_of(cls, SHIM)
        cls.copter.air_pressure.restype = ctypes.c_double

    def setUp(self) -> None:
        self.assertEqual(self.copter.start(1), OK)

    def breathe(self, pressure: float, temperature: int) -> None:
        """Two samples of the barometer, of which a pressure is made."""
        for _ in range(2):
            self.copter.background(1, ctypes.c_double(pressure), temperature)
        self.copter.foreground()

    def at(self, seconds: float) -> None:
        """The time is this."""
        self.copter.at(ctypes.c_double(seconds))

    def payload(self, name: str) -> bytes:
        """Of a message; empty when there is nothing to say."""
        sent = ctypes.c_int.in_dll(self.copter, name).value
        payload = (ctypes.c_uint8 * 255)()
        return bytes(payload) if self.copter.report(sent, payload) else b""

    def pressure(self) -> tuple[int, float, float, int, int]:
        """SCALED_PRESSURE: time, both pressures, both temperatures."""
        one = struct.unpack_from("<Iffhh", self.payload("PRESSURE"))
        return one[0], one[1], one[2], one[3], one[4]

    def named(self) -> tuple[str, int]:
        """NAMED_VALUE_INT: name and value."""
        _, value, name = struct.unpack_from("<Ii10s", self.payload("NAMED"))
        return name.rstrip(b"\0").decode(), value

    def turns(self, count: int) -> list[tuple[str, int]]:
        """So many of them."""
        return [self.named() for _ in range(count)]

    def test_HEA_001_pressure_and_temperature_of_the_barometer(self) -> None:
        self.at(2.5)
        self.breathe(96325.0, 2154)
        self.assertEqual(self.pressure(), (2500, 963.25, 0.0, 2154, 0))
        self.assertEqual(
            (self.copter.air_pressure(), self.copter.air_temperature()), (96325.0, 2154)
        )

    def test_HEA_001_ends_of_the_scale(self) -> None:
        for told in (-4000, -1, 0, 1, 8500, -32768, 32767):
            self.breathe(100000.0, told)
            self.assertEqual(self.pressure()[3], told)

    def test_HEA_001_it_is_that_of_the_last_sample(self) -> None:
        self.breathe(96325.0, 2154)
        self.copter.background(1, ctypes.c_double(96000.0), 2160)
        self.copter.background(1, ctypes.c_double(96200.0), 2170)
        self.copter.foreground()
        self.assertEqual(self.pressure()[1], 961.0)  # The mean of both.
        self.assertEqual(self.copter.air_temperature(), 2170)

    def test_HEA_001_a_pressure_that_does_not_count_brings_no_temperature(self) -> None:
        self.breathe(96325.0, 2154)
        for pressure in (float("nan"), float("inf"), 2.0e9):
            self.copter.background(1, ctypes.c_double(pressure), 9999)
            self.assertEqual(self.copter.air_temperature(), 2154)

    def test_HEA_002_nothing_before_the_first_pressure(self) -> None:
        self.assertFalse(self.payload("PRESSURE"))
        self.copter.background(1, ctypes.c_double(96325.0), 2154)
        self.assertFalse(self.payload("PRESSURE"))  # The foreground has not run.
        self.copter.foreground()
        self.assertTrue(self.payload("PRESSURE"))

    def test_HEA_002_nothing_after_a_second_of_silence(self) -> None:
        self.at(10.0)
        self.breathe(96325.0, 2154)
        for seconds, told in ((10.5, True), (11.0, True), (11.0000015, False), (4000.0, False)):
            self.at(seconds)
            self.copter.background(0, ctypes.c_double(0.0), 0)
            self.copter.foreground()
            self.assertEqual(bool(self.payload("PRESSURE")), told, seconds)
        self.breathe(96000.0, 2100)
        self.assertEqual(self.pressure()[1:4], (960.0, 0.0, 2100))

    def test_HEA_002_pressures_that_do_not_count_are_silence(self) -> None:
        self.breathe(96325.0, 2154)
        self.at(1.5)
        self.breathe(float("nan"), 2154)
        self.assertFalse(self.payload("PRESSURE"))

    def test_HEA_003_each_is_known_when_the_last_run_measured_it(self) -> None:
        copter = self.copter
        self.assertEqual((copter.has_supply(), copter.has_temperature()), (0, 0))
        for run, (supply, temperature) in enumerate([(1, 1), (1, 0), (0, 1), (0, 0), (1, 1)], 1):
            asked = copter.measure(supply, 3300 + run, temperature, 4000 - run)
            self.assertEqual(asked, run)  # Once a run.
            self.assertEqual((copter.has_supply(), copter.has_temperature()), (supply, temperature))
            self.assertEqual(copter.supply(), 3300 + run if supply else 0)
            self.assertEqual(copter.temperature(), 4000 - run if temperature else 0)

    def test_HEA_003_a_port_that_measures_nothing(self) -> None:
        self.assertEqual(self.copter.start(0), OK)
        self.assertEqual(self.copter.measure(1, 3300, 1, 4000), 0)
        self.assertEqual((self.copter.has_supply(), self.copter.has_temperature()), (0, 0))
        self.assertEqual([self.named()[0] for _ in range(3)], ["stack_free"] * 3)

    def test_HEA_003_the_supply_is_not_the_batterys(self) -> None:
        self.copter.battery(ctypes.c_double(16.0))
        self.copter.measure(1, 3287, 0, 0)
        self.assertEqual(self.turns(2), [("stack_free", 0), ("chip_mv", 3287)])

    def test_HEA_004_ends_of_the_supply(self) -> None:
        for told in (1700, 3600, 0, 65535):
            self.copter.measure(1, told, 0, 0)
            self.assertEqual(self.turns(2), [("stack_free", 0), ("chip_mv", told)])

    def test_HEA_004_ends_of_the_stack(self) -> None:
        for free, told in (
            (0, 0),
            (2**31 - 2,) * 2,
            (2**31 - 1,) * 2,
            (2**31, 2**31 - 1),
            (2**32 - 1, 2**31 - 1),
        ):
            self.copter.stack(ctypes.c_uint32(free))
            self.assertEqual(self.named(), ("stack_free", told))

    def test_HEA_004_named_values_in_turn(self) -> None:
        self.breathe(96325.0, 2154)  # Of another sensor.
        self.copter.stack(724)
        self.copter.measure(1, 3287, 1, -1250)
        stack, supply, chip = ("stack_free", 724), ("chip_mv", 3287), ("chip_cdeg", -1250)
        self.assertEqual(self.turns(7), [stack, supply, chip, stack, supply, chip, stack])
        self.copter.measure(1, 3011, 1, 12500)
        self.assertEqual(self.turns(3), [("chip_mv", 3011), ("chip_cdeg", 12500), stack])

    def test_HEA_004_what_is_not_known_is_left_out_of_the_turn(self) -> None:
        self.copter.stack(724)
        stack = ("stack_free", 724)
        for supply, temperature, told in (
            (1, 1, [stack, ("chip_mv", 3300), ("chip_cdeg", 4000), stack]),
            (0, 1, [("chip_cdeg", 4000), stack, ("chip_cdeg", 4000), stack]),
            (1, 0, [("chip_mv", 3300), stack, ("chip_mv", 3300), stack]),
            (0, 0, [stack] * 4),
            (1, 1, [("chip_mv", 3300), ("chip_cdeg", 4000), stack]),
        ):
            self.copter.measure(supply, 3300, temperature, 4000)
            self.assertEqual(self.turns(len(told)), told)

    def blocked(self, pressure: float) -> bool:
        """Whether this pressure stands in the way of arming; SYS_STATUS says the same."""
        self.breathe(pressure, 2154)
        blocked = bool(self.copter.blocks_by_pressure())
        self.assertEqual(bool(self.copter.healthy_barometer()), not blocked, pressure)
        return blocked

    def test_HEA_005_ends_of_what_a_ground_has(self) -> None:
        for pressure, blocked in (
            (54999.0, True),
            (55000.0, False),
            (101325.0, False),
            (110000.0, False),
            (110001.0, True),
        ):
            self.assertEqual(self.blocked(pressure), blocked, pressure)

    def test_HEA_005_half_of_any_grounds_pressure(self) -> None:
        """From the highest airport (4411 m) to the shore of the Dead Sea and to the highest that
        was measured at a level of the sea."""
        for pressure in (58600.0, 65000.0, 101325.0, 106500.0, 108480.0):
            self.assertFalse(self.blocked(pressure), pressure)
            self.assertTrue(self.blocked(pressure / 2.0), pressure)

    def test_HEA_005_nothing_is_said_before_the_first_pressure(self) -> None:
        self.assertFalse(self.copter.blocks_by_pressure())

    def test_HEA_006_the_safety_switch(self) -> None:
        """By whether it is used, whether the board has one, and whether that is ready."""
        for uses, has, ready, blocks in (
            (0, 0, 0, False),
            (0, 1, 0, False),
            (0, 1, 1, False),
            (1, 0, 0, True),
            (1, 1, 0, True),
            (1, 1, 1, False),
        ):
            blocked = bool(self.copter.blocks_by_switch(uses, has, ready))
            self.assertEqual(blocked, blocks, (uses, has, ready))

    def test_HEA_006_it_is_not_used_by_default(self) -> None:
        """Who has no button arms all the same."""
        self.assertFalse(self.copter.uses_by_default())
