# SPDX-License-Identifier: Apache-2.0
"""How many inertial units the copter takes, and that it lands when no two of them agree."""

from __future__ import annotations

import ctypes
import unittest
from typing import ClassVar

from copter_shim import SILENT, copter_of

# The state machine behind functions of plain numbers: what votes say is set.
SHIM = """\
#include "telemetry.h"
#include <string.h>
static copter_t copter;
static copter_telemetry_t telemetry;
static copter_port_t port;
const int MEAN = KEEL_VOTER_MEAN, SINGLE = KEEL_VOTER_SINGLE, MEDIAN = KEEL_VOTER_MEDIAN,
          DISAGREE = KEEL_VOTER_DISAGREE, NONE = KEEL_VOTER_NONE, SENSORS = KEEL_ERR_SENSORS,
          LAND = KEEL_MODE_LAND, ARMED = KEEL_MODE_ARMED, FLYING = KEEL_MODE_FLYING,
          HOLDING = KEEL_MODE_HOLDING, RETURNING = KEEL_MODE_RETURNING,
          LANDING = KEEL_MODE_LANDING, TERMINATED = KEEL_MODE_TERMINATED;
static void agree(keel_virtual_imu_t *imu)
{
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        imu->channel[k].vote.state = KEEL_VOTER_MEAN;
    }
}
/* Behind a first vote in which all agree. */
int start(uint32_t units)
{
    keel_status_t status;
    port = (copter_port_t){.read_clock = read_clock, .read_byte = read_byte, .imus = units};
    memset(&telemetry, 0, sizeof telemetry);
    status = copter_start(&copter, &port, false);
    agree(&copter.imu.virtual_imu);
    agree(&copter.imu.slow);
    return (int)status;
}
int sensors(int slow)
{
    const keel_virtual_imu_t *const imu = slow ? &copter.imu.slow : &copter.imu.virtual_imu;
    return imu->channel[0].config.sensors * 10 + imu->channel[5].config.sensors;
}
void vote(int slow, int channel, int state)
{
    keel_virtual_imu_t *const imu = slow ? &copter.imu.slow : &copter.imu.virtual_imu;
    imu->channel[channel].vote.state = (uint8_t)state;
}
void wait_for_another(int waits)
{
    copter.request.mode.answer = waits ? COPTER_ANSWER_WAITS : COPTER_ANSWER_NONE;
}
/* Whether a run of the state machine, in this state, has asked to land; with a frame, the radio is
 * linked. */
int run_in(int state, int frame)
{
    copter.state.mode.state = (uint8_t)state;
    copter.state.mode.settled = (frame != 0) ? KEEL_MODE_RC_LINKED : 0u;
    copter.state.mode.motors = true;
    copter.request.mode.is_moved = false;
    copter.pilot.frames += (frame != 0) ? 1u : 0u;
    copter_state_machine(&copter.state, &copter.request, &copter);
    return copter.state.lands_unconfirmed;
}
int asks_for(void) { return copter.request.asked; }
int said(void)
{
    const uint32_t before = telemetry.texts;
    copter.telemetry = &telemetry;
    copter_telemetry(&copter);
    for (uint32_t i = before; i < telemetry.texts; i++) {
        if (strcmp(telemetry.text[i % COPTER_TEXTS].text, "landing: no two inertial units agree") ==
            0) {
            return 1;
        }
    }
    return 0;
}
"""
OK = 0
RUNS = 25  # Half a second of the state machine, at 50 Hz.


class CopterUnits(unittest.TestCase):
    """Two or three inertial units."""

    copter: ClassVar[ctypes.CDLL]

    @classmethod
    def setUpClass(cls) -> None:
        cls.copter = copter_of(cls, SILENT + SHIM)

    def number(self, name: str) -> int:
        return ctypes.c_int.in_dll(self.copter, name).value

    def setUp(self) -> None:
        self.assertEqual(self.copter.start(2), OK)

    def runs_until_it_lands(self, state: str = "FLYING", most: int = 60) -> int:
        """How many runs it takes, or none."""
        for count in range(1, most):
            if self.copter.run_in(self.number(state), 1):
                return count
        return 0

    def test_two_or_three_units_vote_and_no_other_number(self) -> None:
        for units in (2, 3):
            self.assertEqual(self.copter.start(units), OK)
            self.assertEqual([self.copter.sensors(slow) for slow in (0, 1)], [11 * units] * 2)
        for units in (0, 1, 4, 0xFFFFFFFF):
            self.assertEqual(self.copter.start(units), self.number("SENSORS"))

    def test_it_lands_when_no_two_agree_in_any_channel_of_either_vote(self) -> None:
        for slow in (0, 1):
            for channel in range(6):
                for name, runs in (
                    ("MEAN", 0),
                    ("MEDIAN", 0),
                    ("SINGLE", RUNS),
                    ("DISAGREE", RUNS),
                    ("NONE", RUNS),
                ):
                    with self.subTest(slow=slow, channel=channel, state=name):
                        self.copter.start(2)
                        self.copter.vote(slow, channel, self.number(name))
                        self.assertEqual(self.runs_until_it_lands(), runs)

    def test_it_asks_once_for_land_and_says_so(self) -> None:
        self.copter.vote(0, 4, self.number("SINGLE"))
        self.assertEqual(self.copter.said(), 0)
        self.assertEqual(self.runs_until_it_lands(), RUNS)
        self.assertEqual(self.copter.asks_for(), self.number("LAND"))
        self.assertEqual([self.copter.said(), self.copter.said()], [1, 0])

    def test_a_vote_in_between_begins_anew(self) -> None:
        for _ in range(3):
            self.copter.vote(0, 0, self.number("SINGLE"))
            self.assertEqual(self.runs_until_it_lands(most=RUNS), 0)
            self.copter.vote(0, 0, self.number("MEAN"))
            self.assertEqual(self.runs_until_it_lands(most=2), 0)
        self.copter.vote(0, 0, self.number("SINGLE"))
        self.assertEqual(self.runs_until_it_lands(), RUNS)

    def test_it_asks_in_each_state_that_would_fly_on(self) -> None:
        for state, runs in (
            ("ARMED", 0),
            ("FLYING", RUNS),
            ("HOLDING", RUNS),
            ("RETURNING", RUNS),
            ("LANDING", 0),
            ("TERMINATED", 0),
        ):
            with self.subTest(state=state):
                self.copter.start(2)
                self.copter.vote(0, 0, self.number("NONE"))
                self.assertEqual(self.runs_until_it_lands(state), runs)

    def test_it_waits_for_the_link_and_for_the_answer_to_another(self) -> None:
        """A request counts with frames: one that is made without a link would be lost."""
        self.copter.vote(0, 0, self.number("NONE"))
        for _ in range(2 * RUNS):
            self.assertEqual(self.copter.run_in(self.number("RETURNING"), 0), 0)
        self.copter.wait_for_another(1)
        self.assertEqual(self.copter.run_in(self.number("RETURNING"), 1), 0)
        self.copter.wait_for_another(0)
        self.assertEqual(self.copter.run_in(self.number("RETURNING"), 1), 1)


if __name__ == "__main__":
    unittest.main()
