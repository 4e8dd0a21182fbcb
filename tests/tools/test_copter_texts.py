# SPDX-License-Identifier: Apache-2.0
"""The copter's words on attempts to arm and on its satellite receiver, run by run."""

from __future__ import annotations

import ctypes
import unittest
from typing import ClassVar

from copter_shim import copter_of

# State machine, GPS and telemetry behind functions of plain numbers, on a clock of 20 ms a step.
SHIM = """\
#include "copter.h"
#include "obstacle.h"
#include "telemetry.h"
#include <string.h>
static copter_t copter;
static copter_telemetry_t telemetry;
static copter_port_t port;
static uint32_t bytes_left;
static bool safe;
static bool held;
static char text[COPTER_TEXT_LENGTH + 1u];
static bool read_byte(void *context, uint32_t receiver, copter_byte_t *byte)
{
    (void)context;
    if ((receiver != COPTER_GPS) || (bytes_left == 0u)) { return false; }
    bytes_left--;
    *byte = (copter_byte_t){.value = 0x55u, .elapsed_us = 100u};
    return true;
}
static bool is_ready_of_test(void *context)
{
    (void)context;
    return !safe;
}
/* Of the checks three: the battery, the pressure of the ground, and the safety switch. */
int start(void)
{
    memset(&copter, 0, sizeof copter);
    memset(&telemetry, 0, sizeof telemetry);
    port = (copter_port_t){.read_byte = read_byte, .is_ready = is_ready_of_test};
    copter.port = &port;
    copter.telemetry = &telemetry;
    copter.scheduler.clock.now_us = 7000000u; /* A card may take so long before. */
    copter_settings = copter_defaults;
    copter_settings.safety_switch = true;
    copter_settings.mode.required = KEEL_MODE_CHECK_BATTERY_LEVEL | COPTER_CHECK_GROUND_PRESSURE |
                                    COPTER_CHECK_SAFETY_SWITCH;
    copter.estimate.is_landed = true;
    copter.imu.attitude.phase = KEEL_ATTITUDE_RUNNING;
    copter.power.battery.level = KEEL_BATTERY_OK;
    copter.pilot.asked = KEEL_MODE_ANGLE;
    safe = false;
    held = false;
    bytes_left = 0u;
    return (int)copter_state_machine_init(&copter.state) + (int)copter_gps_init(&copter.gps);
}
void step(int links, int on, int throttle_low, int kill, int bytes)
{
    copter.scheduler.clock.now_us += 20000u;
    copter.pilot.facts = KEEL_MODE_RC_LINKED |
                         (on ? KEEL_MODE_ARM_SWITCH_ON : KEEL_MODE_ARM_SWITCH_OFF) |
                         (throttle_low ? KEEL_MODE_THROTTLE_LOW : 0u) |
                         (kill ? KEEL_MODE_KILL_SWITCH_ON : 0u);
    copter.pilot.frames += links ? 1u : 0u;
    bytes_left = (uint32_t)bytes;
    copter_state_machine(&copter.state, &copter.request, &copter);
    copter_gps(&copter.gps, &copter);
    for (int i = 0; (i < 5) && !held; i++) { copter_telemetry(&copter); }
}
void spoil(int battery, int pressure, int at_safe)
{
    copter.power.battery.level = battery ? KEEL_BATTERY_LOW : KEEL_BATTERY_OK;
    copter.barometer.samples = 1u;
    copter.barometer.pressure_pa = pressure ? 50000.0f : 100000.0f;
    safe = at_safe != 0;
}
void hold_telemetry(int on) { held = on != 0; }
void ask(void)
{
    copter_action_request_arm(&copter.request, true);
    telemetry.arm_waiter.command = 400u;
}
void expect_satellites(void)
{
    copter_settings.mode.required |= KEEL_MODE_CHECK_POSITION_ESTIMATE;
}
void land(int is_landed) { copter.estimate.is_landed = is_landed != 0; }
int state(void) { return copter.state.mode.state; }
void fly(void) { copter.state.mode.motors = true; telemetry.has_flown = true; }
int texts(void) { return (int)telemetry.texts; }
int severity(int i) { return telemetry.text[(uint32_t)i % COPTER_TEXTS].severity; }
const char *text_of(int i)
{
    memcpy(text, telemetry.text[(uint32_t)i % COPTER_TEXTS].text, COPTER_TEXT_LENGTH);
    return text;
}
const char *words_of(int is_check, int bit)
{
    keel_mode_t mode = {.state = KEEL_MODE_DISARMED};
    if (is_check) { mode.refused.checks = 1u << bit; } else { mode.refused.facts = 1u << bit; }
    return copter_obstacle_first(&mode);
}
int all_required(void) { return (int)copter_defaults.mode.required; }
"""

DISARMED, ARMED, FLYING, LANDING, TERMINATED = 0, 1, 2, 5, 6
A_SECOND = 50  # Steps.
REFUSED = "not armed: "
WARNING, INFO = 4, 6  # Of MAVLink's MAV_SEVERITY.
SILENT, AGAIN = "GPS: nothing comes from the receiver", "GPS: the receiver sends again"


class CopterTexts(unittest.TestCase):
    """A pilot with a switch, a station that asks, and a receiver that may be silent."""

    copter: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.copter = copter_of(cls, SHIM)
        cls.copter.text_of.restype = ctypes.c_char_p
        cls.copter.words_of.restype = ctypes.c_char_p

    def setUp(self) -> None:
        self.assertEqual(self.copter.start(), 0)
        self.read = 0
        self.run_for(1.5)
        self.new()

    def run_for(
        self,
        seconds: float,
        *,
        link: bool = True,
        on: bool = False,
        low: bool = True,
        kill: bool = False,
        sends: bool = True,
    ) -> None:
        """The pilot's frames, and bytes of satellites, for so long."""
        for _ in range(round(seconds * A_SECOND)):
            self.copter.step(link, on, low, kill, 3 if sends else 0)

    def new(self, begin: str = "") -> list[str]:
        """The texts since this was asked last."""
        texts = self.copter.texts()
        found = [self.copter.text_of(i).decode() for i in range(self.read, texts)]
        self.read = texts
        return [text for text in found if text.startswith(begin)]

    # --- Attempts to arm. ---

    def test_HEA_007_one_text_for_an_attempt(self) -> None:
        """A switch that stays on is one attempt; off and on again is another."""
        for _ in range(3):
            self.run_for(5.0, on=True, low=False)
            self.assertEqual(self.new(), [f"{REFUSED}throttle not low"])
            self.assertEqual(self.copter.severity(self.read - 1), WARNING)
            self.run_for(1.0, low=False)
            self.assertEqual((self.new(), self.copter.state()), ([], DISARMED))

    def test_HEA_007_the_first_of_several(self) -> None:
        """Checks stand before facts, in the order of their bits."""
        for spoilt, low, told in (
            ((1, 1, 1), False, "battery"),
            ((0, 1, 1), False, "pressure not of the ground: an MS5607?"),
            ((0, 0, 1), False, "safety switch at safe, or none"),
            ((0, 0, 0), False, "throttle not low"),
        ):
            self.copter.spoil(*spoilt)
            self.run_for(1.0, low=low)
            self.run_for(1.0, on=True, low=low)
            self.assertEqual(self.new(REFUSED), [REFUSED + told])

    def test_HEA_007_a_switch_that_is_on_since_the_start_is_no_attempt(self) -> None:
        self.copter.start()
        self.read = 0
        self.run_for(5.0, on=True, low=False)
        self.assertEqual(self.new(REFUSED), [])

    def test_HEA_007_what_succeeds_is_no_refusal(self) -> None:
        self.run_for(1.0, on=True)
        self.assertEqual((self.new(), self.copter.state()), (["armed"], ARMED))
        self.run_for(1.0)
        self.assertEqual((self.new(), self.copter.state()), (["disarmed"], DISARMED))

    def test_HEA_007_a_link_that_is_lost_is_no_attempt(self) -> None:
        """The switch is no longer ready then, either."""
        for on in (False, True):
            self.run_for(1.0, link=False, on=on, low=False)
            self.run_for(3.0, on=on, low=False)
            self.assertEqual(self.new(REFUSED), [])

    def test_HEA_007_a_switch_in_flight_is_no_attempt(self) -> None:
        """What stood in the way of the last attempt is not told in flight, nor at its end."""
        self.run_for(1.0, on=True, low=False)
        self.run_for(1.0)
        self.run_for(1.0, on=True)
        self.copter.land(0)
        self.run_for(2.0, on=True, low=False)
        self.assertEqual(self.copter.state(), FLYING)
        self.new()
        for on in (False, True, False, True):
            self.run_for(1.0, on=on, low=False)
        self.assertEqual(self.new(REFUSED), [])

    def test_HEA_007_a_switch_that_moves_while_it_lands_is_no_attempt(self) -> None:
        """The battery makes it land, and would refuse; it disarms by itself. Whenever the switch
        goes on around that, no text comes in a step that began with motors."""
        told = 0
        for early in range(25, 50):
            self.setUp()
            self.run_for(1.0, on=True)
            self.copter.land(0)
            self.run_for(1.0, on=True, low=False)
            self.copter.spoil(1, 0, 0)
            self.run_for(1.5)
            self.assertEqual(self.copter.state(), LANDING)
            self.copter.land(1)
            self.new()
            for step in range(80):
                before = self.copter.state()
                self.run_for(1 / A_SECOND, on=step >= early)
                texts = self.new(REFUSED)
                told += len(texts)
                self.assertTrue(not texts or before == DISARMED, (early, step))
            self.assertEqual(self.copter.state(), DISARMED)
        self.assertGreater(told, 0)

    def test_HEA_007_whoever_asks_by_a_command_is_told_all_and_once(self) -> None:
        """His words are the switch's."""
        self.copter.spoil(0, 1, 0)
        self.copter.ask()
        self.run_for(2.0, low=False)
        told = ["pressure not of the ground: an MS5607?", "throttle not low"]
        self.assertEqual(self.new(REFUSED), [REFUSED + it for it in told])
        self.run_for(1.0, on=True, low=False)
        self.assertEqual(self.new(REFUSED), [REFUSED + told[0]])

    def test_HEA_007_the_words_are_of_the_attempt_however_late_telemetry_runs(self) -> None:
        """What was in the way has gone since, and something else has come."""
        for asks in (False, True):
            self.copter.hold_telemetry(1)
            if asks:
                self.copter.ask()
            self.run_for(0.5, on=not asks, low=False)
            self.copter.spoil(1, 0, 0)
            self.run_for(0.5, on=not asks)
            self.copter.hold_telemetry(0)
            self.run_for(0.02, on=not asks)
            self.assertEqual(self.new(REFUSED), [f"{REFUSED}throttle not low"])
            self.copter.spoil(0, 0, 0)
            self.run_for(1.0)

    def test_HEA_007_a_command_that_the_link_ends_is_not_told_an_older_reason(self) -> None:
        self.run_for(1.0, on=True, low=False)
        self.run_for(1.0)
        self.new()
        self.copter.ask()
        self.run_for(0.1)
        self.run_for(2.0, link=False)
        told = self.new(REFUSED)
        self.assertIn(f"{REFUSED}no radio link", told)
        self.assertEqual(len(set(told)), len(told))

    def test_HEA_007_nothing_arms_behind_termination(self) -> None:
        self.run_for(1.0, on=True)
        self.run_for(1.0, on=True, kill=True)
        self.assertEqual(self.copter.state(), TERMINATED)
        self.run_for(1.0)
        self.new()
        self.run_for(3.0, on=True)
        self.assertEqual(self.new(), [f"{REFUSED}terminated until the power is off"])

    def test_HEA_007_each_obstacle_has_words_that_fit(self) -> None:
        """A text of MAVLink has 50 letters. NEEDED and FORBIDDEN of the machine are what facts
        can stand in the way: bits 0, 2 to 6 and 11 to 13."""
        checks = [(1, bit) for bit in range(32) if self.copter.all_required() >> bit & 1]
        facts = [(0, bit) for bit in (0, 2, 3, 4, 5, 6, 11, 12, 13)]
        words = [self.copter.words_of(*it).decode() for it in checks + facts]
        self.assertEqual(len(set(words)), 12 + 9)
        for text in words:
            self.assertTrue(0 < len(text) <= 50 - len(REFUSED), text)

    # --- The satellite receiver. ---

    def test_HEA_008_a_silent_receiver_is_told_each_ten_seconds_until_motors_turn(self) -> None:
        self.copter.expect_satellites()
        self.run_for(1.9, sends=False)
        self.assertEqual(self.new(), [])
        self.run_for(0.2, sends=False)
        self.assertEqual(self.new(), [SILENT])
        self.assertEqual(self.copter.severity(self.read - 1), WARNING)
        self.run_for(29.0, sends=False)
        self.assertEqual(self.new(), [SILENT] * 2)
        self.copter.fly()
        self.run_for(29.0, sends=False)
        self.assertEqual(self.new("GPS"), [])

    def test_HEA_008_it_is_told_from_the_start_on(self) -> None:
        """Two seconds behind the first run, not at once."""
        self.copter.start()
        self.copter.expect_satellites()
        self.read = 0
        self.run_for(1.9, sends=False)
        self.assertEqual(self.new("GPS"), [])
        self.run_for(0.3, sends=False)
        self.assertEqual(self.new("GPS"), [SILENT])

    def test_HEA_008_its_return_is_told_once(self) -> None:
        """Whatever the bytes say; and only behind a silence that was told."""
        self.copter.expect_satellites()
        self.run_for(1.9, sends=False)
        self.run_for(1.0)
        self.assertEqual(self.new(), [])
        self.run_for(3.0, sends=False)
        self.run_for(5.0)
        self.assertEqual(self.new(), [SILENT, AGAIN])
        self.assertEqual(self.copter.severity(self.read - 1), INFO)

    def test_HEA_008_once_for_each_silence_in_flight(self) -> None:
        self.copter.expect_satellites()
        self.copter.fly()
        self.run_for(30.0, sends=False)
        self.assertEqual(self.new("GPS"), [SILENT])
        self.run_for(1.0)
        self.assertEqual(self.new("GPS"), [AGAIN])
        self.run_for(30.0, sends=False)
        self.assertEqual(self.new("GPS"), [SILENT])

    def test_HEA_008_a_loose_wire_does_not_flood(self) -> None:
        """2.5 s of silence, then a byte: told each ten seconds at most."""
        self.copter.expect_satellites()
        for _ in range(24):
            self.run_for(2.5, sends=False)
            self.run_for(0.02)
        self.assertLessEqual(len(self.new("GPS")), 2 * 7)

    def test_HEA_008_who_needs_no_place_expects_no_receiver(self) -> None:
        self.run_for(30.0, sends=False)
        self.assertEqual(self.new(), [])
        self.run_for(1.0)
        self.assertEqual(self.new(), [])

    def test_HEA_008_the_texts_fit(self) -> None:
        for text in (SILENT, AGAIN):
            self.assertLessEqual(len(text), 50)
