// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 26 --external-sat-solver cadical
// sources: src/middleware/sbus.c specs/model/sbus.c
// covers: keel_sbus_init model_sbus_init
#include "../common/unchanged.h"
#include "sbus_proof.h"

void keel_sbus_init_harness(void)
{
    const uint32_t at = any_below(KEEL_SBUS_BYTES);
    const keel_sbus_config_t config = nondet_sbus_config();
    keel_sbus_t sbus = any_sbus();
    keel_sbus_t model = sbus;
    const keel_sbus_t before = sbus;
    const keel_status_t expected = model_sbus_init(&model, &config);
    const keel_status_t status = keel_sbus_init(&sbus, &config);

    __CPROVER_assert(status == expected, "RAD_001_model: taken or refused as the model says");
    __CPROVER_assert(sbus_same(&sbus, &model, at),
                     "RAD_002_model: every field is what the model says");
    __CPROVER_assert((status == KEEL_OK) == sbus_config_valid(&config),
                     "RAD_001_taken: all that is in order is taken");
    if (status == KEEL_OK) {
        __CPROVER_assert(sbus_valid_here(&sbus), "RAD_002_valid: what is made is valid");
    } else {
        __CPROVER_assert(unchanged(&sbus, &before, sizeof(sbus)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
