// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// checks: assertions
// sources: src/flight/attitude.c
// covers: keel_attitude_init
//
// Any bit pattern for all of a configuration: the contract of init, clause by clause. Overflow and
// NaN are checked in keel_attitude_init__valid_harness.
#include "../common/unchanged.h"
#include "attitude_proof.h"

static bool is_rate(const keel_attitude_config_t *c)
{
    return within(c->rate_hz, KEEL_ATTITUDE_RATE_MIN_HZ, KEEL_ATTITUDE_RATE_MAX_HZ);
}

static bool are_gains(const keel_attitude_config_t *c)
{
    return within(c->tilt_gain, 0.0f, KEEL_ATTITUDE_GAIN_LIMIT) &&
           within(c->heading_gain, 0.0f, KEEL_ATTITUDE_GAIN_LIMIT) &&
           within(c->align_gain, 0.0f, KEEL_ATTITUDE_GAIN_LIMIT) &&
           within(c->bias_gain, 0.0f, KEEL_ATTITUDE_GAIN_LIMIT) &&
           within(c->force_gain, 0.0f, KEEL_ATTITUDE_GAIN_LIMIT) &&
           within(c->field_share, 0.0f, 1.0f);
}

static bool are_limits(const keel_attitude_config_t *c)
{
    return within(c->bias_limit, 0.0f, KEEL_ATTITUDE_BIAS_LIMIT) &&
           within(c->clip_rate, 0.0f, KEEL_ATTITUDE_RATE_LIMIT) &&
           within(c->quiet_rate, 0.0f, c->clip_rate) &&
           within(c->still_rate, 0.0f, KEEL_ATTITUDE_STILL_RATE_LIMIT) &&
           within(c->still_acceleration, 0.0f, KEEL_ATTITUDE_STILL_ACCELERATION_LIMIT) &&
           within(c->tolerance, 0.0f, 1.0f);
}

static bool are_steps(const keel_attitude_config_t *c)
{
    return (c->still_steps > 0u) && (c->settle_steps > 0u) && (c->lost_steps > 0u) &&
           (c->field_steps > 0u);
}

void keel_attitude_init__clauses_harness(void)
{
    const keel_attitude_config_t config = nondet_attitude_config();
    keel_attitude_t attitude = any_attitude_at_all();
    const keel_attitude_t before = attitude;
    const bool rate = is_rate(&config);
    const bool gains = are_gains(&config);
    const bool limits = are_limits(&config) && are_steps(&config);
    const keel_status_t status = keel_attitude_init(&attitude, &config);

    __CPROVER_assert(rate || (status == KEEL_ERR_RATE),
                     "ATT_001_rate: a rate out of range is refused");
    __CPROVER_assert(!rate || gains || (status == KEEL_ERR_GAIN),
                     "ATT_001_gains: then a gain out of range");
    __CPROVER_assert(!rate || !gains || limits || (status == KEEL_ERR_LIMITS),
                     "ATT_001_limits: then limits and numbers of steps");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&attitude, &before, sizeof(attitude)),
                     "ATT_001_kept: a refusal changes nothing");
    __CPROVER_assert((status != KEEL_OK) || attitude_config_same(&attitude.config, &config),
                     "ATT_002_taken: the configuration is taken over");
}
