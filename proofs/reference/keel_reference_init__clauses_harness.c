// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// checks: assertions
// sources: src/flight/reference.c
// covers: keel_reference_init
//
// Any bit pattern for all of a configuration: the contract of init, clause by clause. Overflow and
// NaN are checked in keel_reference_init__valid_harness.
#include "reference_proof.h"

static bool expos_here(const keel_reference_config_t *config)
{
    return within(config->roll.expo, 0.0f, KEEL_REFERENCE_EXPO_MAX) &&
           within(config->pitch.expo, 0.0f, KEEL_REFERENCE_EXPO_MAX) &&
           within(config->yaw.expo, 0.0f, KEEL_REFERENCE_EXPO_MAX) &&
           within(config->climb.expo, 0.0f, KEEL_REFERENCE_EXPO_MAX);
}

static bool dead_band_here(float dead_band)
{
    return within(dead_band, KEEL_REFERENCE_DEAD_BAND_MIN, KEEL_REFERENCE_DEAD_BAND_MAX);
}

static bool dead_bands_here(const keel_reference_config_t *config)
{
    return dead_band_here(config->roll.dead_band) && dead_band_here(config->pitch.dead_band) &&
           dead_band_here(config->yaw.dead_band) && dead_band_here(config->climb.dead_band);
}

void keel_reference_init__clauses_harness(void)
{
    const keel_reference_config_t config = nondet_reference_config();
    keel_reference_t reference = nondet_reference();
    const bool expos = expos_here(&config);
    const bool limits = dead_bands_here(&config) && limits_here(&config.limits);
    const keel_status_t status = keel_reference_init(&reference, &config);

    __CPROVER_assert(expos || (status == KEEL_ERR_GAIN), "REF_001_expo: a bad expo is refused");
    __CPROVER_assert(!expos || limits || (status == KEEL_ERR_LIMITS),
                     "REF_001_limits: then a bad dead band or limit");
    __CPROVER_assert(!(expos && limits) || (status == KEEL_OK), "REF_002_ok: all others are taken");
    __CPROVER_assert(!(expos && limits) || limits_same(&reference.limits, &config.limits),
                     "REF_002_limits: the limits are those of the configuration");
}
