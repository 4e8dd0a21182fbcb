// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// checks: assertions
// sources: src/flight/attitude.c
// covers: keel_attitude_init
//
// What follows from a configuration whose quotients are exact in single precision, and that each
// number of steps must be at least 1, after rate and gains, before the field. Wrong bodies are
// refuted here: where floats differ, z3 finds no example.
#include "attitude_proof.h"

void keel_attitude_init__exact_harness(void)
{
    const bool rate = nondet_bool();
    const bool gain = nondet_bool();
    const bool north = nondet_bool();
    const bool still = nondet_bool();
    const bool settle = nondet_bool();
    const bool lost = nondet_bool();
    const bool field = nondet_bool();
    const keel_attitude_config_t config = {.rate_hz = rate ? 512.0f : 499.0f,
                                           .tilt_gain = gain ? 1.0f : 9.0f,
                                           .heading_gain = 2.0f,
                                           .align_gain = 4.0f,
                                           .bias_gain = 0.5f,
                                           .bias_limit = 0.25f,
                                           .force_gain = 2.0f,
                                           .field_share = 0.25f,
                                           .quiet_rate = 0.5f,
                                           .clip_rate = 32.0f,
                                           .still_rate = 0.25f,
                                           .still_acceleration = 0.5f,
                                           .tolerance = 0.25f,
                                           .north = north ? 4.0f : 2000.0f,
                                           .east = -4.0f,
                                           .still_steps = still ? 2u : 0u,
                                           .settle_steps = settle ? 3u : 0u,
                                           .lost_steps = lost ? 4u : 0u,
                                           .field_steps = field ? 5u : 0u};
    keel_attitude_t attitude = any_attitude_at_all();
    const keel_status_t status = keel_attitude_init(&attitude, &config);

    __CPROVER_assert(status == (!rate                                 ? KEEL_ERR_RATE
                                : !gain                               ? KEEL_ERR_GAIN
                                : !(still && settle && lost && field) ? KEEL_ERR_LIMITS
                                : !north                              ? KEEL_ERR_INPUT
                                                                      : KEEL_OK),
                     "ATT_001_exact: no number of steps may be 0, nor another be out of range");
    if (status == KEEL_OK) {
        __CPROVER_assert((attitude.scale.step == 0x1p-9f) &&
                             (attitude.scale.half_step == 0x1p-10f) &&
                             (attitude.scale.bias_step == 0x1p-10f) &&
                             (attitude.scale.quiet == 0.25f) &&
                             (attitude.scale.tolerance == 0.0625f) &&
                             (attitude.scale.north == 0.125f) && (attitude.scale.east == -0.125f) &&
                             (attitude.scale.still == 0.5f),
                         "ATT_002_exact: the quotients and the squares");
    }
}
