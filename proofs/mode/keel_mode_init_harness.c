// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/flight/mode.c specs/model/mode.c
// covers: keel_mode_init are_times_valid are_pilot_times_valid are_aircraft_times_valid is_settling
// covers: is_between settle_us_of bit_of
// covers: model_mode_init
//
// Every bit pattern of the configuration, and of what the machine was before.
#include "mode_proof.h"

void keel_mode_init_harness(void)
{
    const keel_mode_config_t config = any_config();
    keel_mode_t mode = any_mode();
    keel_mode_t model = mode;
    const keel_status_t expected = model_mode_init(&model, &config);
    const keel_status_t status = keel_mode_init(&mode, &config);

    __CPROVER_assert(status == expected, "MOD_001_model: as the model says");
    for (uint32_t i = 0u; i < FACTS; i++) {
        __CPROVER_assert(mode_same(&mode, &model, i), "MOD_001_model: in every field");
    }
    __CPROVER_assert((status == KEEL_OK) == config_valid_here(&config),
                     "MOD_001_accepted: exactly the valid configurations");
    __CPROVER_assert((status == KEEL_ERR_LIMITS) == !times_valid_here(&config),
                     "MOD_001_times: a time that is out of its range is told first");
    __CPROVER_assert((status == KEEL_ERR_INPUT) ==
                         (times_valid_here(&config) && (config.required == 0u)),
                     "MOD_001_required: then that no check is required");
    __CPROVER_assert((status != KEEL_OK) || mode_config_same(&mode.config, &config),
                     "MOD_001_made: the configuration is kept");
    __CPROVER_assert((status != KEEL_OK) || valid_here(&mode), "MOD_002_valid: it is valid");
    __CPROVER_assert((status != KEEL_OK) || (!mode.motors && (mode.state == KEEL_MODE_DISARMED)),
                     "MOD_002_still: disarmed, and motors stand still");
    __CPROVER_assert((status != KEEL_OK) ||
                         ((mode.seen == 0u) && (mode.settled == 0u) && !mode.ready),
                     "MOD_002_unseen: nothing is seen, nor the switch off");
}
