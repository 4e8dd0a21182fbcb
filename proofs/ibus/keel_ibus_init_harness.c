// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/ibus.c src/middleware/framing.c specs/model/ibus.c specs/model/framing.c
// replaces: keel_framing_drop
// covers: keel_ibus_init model_ibus_init
#include "../common/unchanged.h"
#include "ibus_proof.h"

void keel_ibus_init_harness(void)
{
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);
    const keel_ibus_config_t config = any_ibus_config();
    keel_ibus_t ibus = any_ibus();
    keel_ibus_t model = ibus;
    const keel_ibus_t before = ibus;
    const keel_status_t expected = model_ibus_init(&model, &config);
    const keel_status_t status = keel_ibus_init(&ibus, &config);

    __CPROVER_assert(status == expected, "IBU_001_model: taken or refused as the model says");
    __CPROVER_assert(ibus_same(&ibus, &model, at),
                     "IBU_002_model: every field is what the model says");
    __CPROVER_assert((status == KEEL_OK) == ibus_config_valid(&config),
                     "IBU_001_taken: all that is in order is taken");
    if (status == KEEL_OK) {
        __CPROVER_assert(ibus_valid_here(&ibus), "IBU_002_valid: what is made is valid");
    } else {
        __CPROVER_assert(unchanged(&ibus, &before, sizeof(ibus)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
