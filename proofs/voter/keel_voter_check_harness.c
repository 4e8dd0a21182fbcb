// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_check is_cutoff_valid is_above
#include "../common/voter_proof.h"

void keel_voter_check_harness(void)
{
    const keel_voter_config_t config = any_voter_config();
    const bool sensors = (2u <= config.sensors) && (config.sensors <= SENSORS);
    const bool agreement = agreement_valid_here(&config);
    const bool factor = agreement && (config.cutoff > 1.0f) &&
                        (config.cutoff <= (KEEL_VOTER_RANGE / KEEL_VOTER_AGREE_MIN));
    const float none = factor ? (config.cutoff * config.agree) : 0.0f;
    const bool cutoff = factor && (none > config.agree) && (none <= KEEL_VOTER_RANGE);
    const bool limits = limits_valid_here(&config);
    const bool initial = initial_valid_here(&config);
    keel_status_t status;

    status = keel_voter_check(&config);

    __CPROVER_assert((status == KEEL_OK) == (sensors && agreement && cutoff && limits && initial &&
                                             (config.max_age_us > 0u) && (config.latch_count > 0u)),
                     "VOT_001_accepted: just the valid configurations are accepted");
    __CPROVER_assert((status == KEEL_ERR_SENSORS) == !sensors, "VOT_001_sensors: the count");
    __CPROVER_assert((status == KEEL_ERR_AGREEMENT) == (sensors && !agreement),
                     "VOT_001_agreement: a");
    __CPROVER_assert((status == KEEL_ERR_CUTOFF) == (sensors && agreement && !cutoff),
                     "VOT_001_cutoff: n");
    __CPROVER_assert((status == KEEL_ERR_LIMITS) == (sensors && agreement && cutoff && !limits),
                     "VOT_001_limits: the plausibility limits");
    __CPROVER_assert((status == KEEL_ERR_INITIAL) ==
                         (sensors && agreement && cutoff && limits && !initial),
                     "VOT_001_initial: the initial output");
    __CPROVER_assert((status == KEEL_ERR_AGE) == (sensors && agreement && cutoff && limits &&
                                                  initial && (config.max_age_us == 0u)),
                     "VOT_001_age: the age");
    __CPROVER_assert((status == KEEL_ERR_LATCH) ==
                         (sensors && agreement && cutoff && limits && initial &&
                          (config.max_age_us > 0u) && (config.latch_count == 0u)),
                     "VOT_001_latch: the latch count");
}
