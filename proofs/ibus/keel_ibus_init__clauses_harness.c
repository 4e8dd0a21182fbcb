// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/ibus.c src/middleware/framing.c
// checks: assertions
// replaces: keel_framing_drop
// covers: keel_ibus_init
//
// Each clause of the contract, without the model, for every configuration.
#include "ibus_proof.h"

static void check_refused(const keel_ibus_config_t *config, keel_status_t status)
{
    const bool limits = (config->lowest <= config->highest) && (config->highest <= 4095u);

    __CPROVER_assert(limits || (status == KEEL_ERR_LIMITS),
                     "IBU_001_limits: a range that is empty, or ends too high, is named first");
    __CPROVER_assert(!limits || (config->gap_us != 0u) || (status == KEEL_ERR_AGE),
                     "IBU_001_gap: then a gap of 0");
}

void keel_ibus_init__clauses_harness(void)
{
    const keel_ibus_config_t config = any_ibus_config();
    const bool made = ibus_config_valid(&config);
    keel_ibus_t ibus = any_ibus();
    const keel_status_t status = keel_ibus_init(&ibus, &config);

    check_refused(&config, status);
    __CPROVER_assert(!made || ((status == KEEL_OK) && ibus_valid_here(&ibus) &&
                               (ibus.framing.held == 0u) && (ibus.framing.gap_us == config.gap_us)),
                     "IBU_002_made: what is made is valid, holds nothing, and knows its gap");
    __CPROVER_assert(!made || ibus_config_same(&ibus.config, &config),
                     "IBU_002_config: the configuration is copied");
    __CPROVER_assert(!made || ((ibus.age_us == UINT32_MAX) && (ibus.count.frames == 0u)),
                     "IBU_002_none: no frame came yet");
}
