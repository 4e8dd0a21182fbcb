// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/crsf.c src/middleware/framing.c
// checks: assertions
// replaces: keel_crsf_crc keel_framing_drop
// covers: keel_crsf_init
//
// Each clause of the contract, without the model, for every configuration.
#include "crsf_proof.h"

void keel_crsf_init__clauses_harness(void)
{
    const keel_crsf_config_t config = nondet_crsf_config();
    const bool made = (config.gap_us > 0u) && (config.channels_us > 0u);
    keel_crsf_t crsf = nondet_crsf();
    const keel_status_t status = keel_crsf_init(&crsf, &config);

    __CPROVER_assert(((config.gap_us != 0u) && (config.channels_us != 0u)) ||
                         (status == KEEL_ERR_AGE),
                     "CRF_001_age: a time that is 0 is refused");
    __CPROVER_assert(!made || ((status == KEEL_OK) && crsf_valid_here(&crsf) &&
                               (crsf.framing.held == 0u) && (crsf.framing.gap_us == config.gap_us)),
                     "CRF_002_made: what is made is valid, holds nothing, and knows its gap");
    __CPROVER_assert(!made || crsf_config_same(&crsf.config, &config),
                     "CRF_002_config: the configuration is copied");
    __CPROVER_assert(!made || ((crsf.channels_age_us == UINT32_MAX) &&
                               (crsf.link_age_us == UINT32_MAX) && (crsf.link.quality == 0u) &&
                               (crsf.count.channels == 0u) && (crsf.count.links == 0u)),
                     "CRF_002_none: no frame came yet");
}
