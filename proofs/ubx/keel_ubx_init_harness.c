// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_init model_ubx_init
#include "../common/unchanged.h"
#include "ubx_proof.h"

void keel_ubx_init_harness(void)
{
    const keel_ubx_config_t config = nondet_ubx_config();
    keel_ubx_t ubx = any_ubx();
    keel_ubx_t model = ubx;
    const keel_ubx_t before = ubx;
    const keel_status_t expected = model_ubx_init(&model, &config);
    const keel_status_t status = keel_ubx_init(&ubx, &config);

    __CPROVER_assert(status == expected, "UBX_001_model: taken or refused as the model says");
    __CPROVER_assert(ubx_same(&ubx, &model), "UBX_002_model: every field is what the model says");
    __CPROVER_assert((status == KEEL_OK) == ubx_config_valid(&config),
                     "UBX_001_taken: all that is in order is taken");
    if (status == KEEL_OK) {
        __CPROVER_assert(ubx_valid_here(&ubx) && (ubx.step == 0u),
                         "UBX_002_made: what is made is valid, and waits for a message");
        __CPROVER_assert(ubx_config_same(&ubx.config, &config),
                         "UBX_002_config: the configuration is copied");
        __CPROVER_assert((ubx.age_us == UINT32_MAX) && (ubx.count.fixes == 0u) && !ubx.is_advancing,
                         "UBX_002_none: no fix came yet");
    } else {
        const bool limits = (config.accuracy_mm == 0u) || (config.speed_accuracy == 0u);

        __CPROVER_assert((status == KEEL_ERR_LIMITS) == limits,
                         "UBX_001_limits: a limit of accuracy that is 0 is named first");
        __CPROVER_assert((status == KEEL_ERR_AGE) == !limits, "UBX_001_age: then a time that is 0");
        __CPROVER_assert(unchanged(&ubx, &before, sizeof(ubx)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
