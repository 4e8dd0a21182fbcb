// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_init
#include "../common/unchanged.h"
#include "../common/voter_proof.h"

void keel_voter_init_harness(void)
{
    keel_voter_t voter;
    keel_voter_t before;
    const keel_voter_config_t config = any_voter_config();
    const uint32_t i = nondet_u32();
    keel_status_t status;

    any_voter(&voter, 1.0f, 3.0f);
    before = voter;
    __CPROVER_assume(i < SENSORS);

    status = keel_voter_init(&voter, &config);

    __CPROVER_assert(status == keel_voter_check(&config),
                     "VOT_002_refused: for the reason that the check gives");
    if (status == KEEL_OK) {
        __CPROVER_assert(agreement_valid_here(&config) && limits_valid_here(&config) &&
                             initial_valid_here(&config) && (config.latch_count > 0u),
                         "VOT_002_refused: nothing invalid is accepted");
        __CPROVER_assert((voter.config.agree == config.agree) &&
                             (voter.config.cutoff == config.cutoff) &&
                             (voter.config.lowest == config.lowest) &&
                             (voter.config.highest == config.highest) &&
                             (voter.config.initial == config.initial) &&
                             (voter.config.max_age_us == config.max_age_us) &&
                             (voter.config.latch_count == config.latch_count) &&
                             (voter.config.stale_count == config.stale_count) &&
                             (voter.config.density_limit == config.density_limit) &&
                             (voter.config.sensors == config.sensors),
                         "VOT_002_ready: the configuration is kept");
        __CPROVER_assert((voter.none == (config.cutoff * config.agree)) &&
                             (voter.none > voter.config.agree) && (voter.none <= KEEL_VOTER_RANGE),
                         "VOT_002_ready: n a");
        __CPROVER_assert((voter.vote.output == config.initial) && (voter.vote.held == 0u) &&
                             (voter.vote.held_us == 0u) && (voter.vote.state == KEEL_VOTER_NONE) &&
                             (voter.vote.contributing == 0u),
                         "VOT_002_output: the initial output");
        __CPROVER_assert(!voter.sensor[i].latched && (voter.sensor[i].null == 0u) &&
                             (voter.sensor[i].density == 0u) && (voter.sensor[i].same == 0u) &&
                             (voter.sensor[i].last == config.initial) &&
                             (voter.vote.weight[i] == 0.0f) && (voter.vote.reason[i] == 0u) &&
                             !voter.unanimous,
                         "VOT_002_fresh: nothing is remembered");
        __CPROVER_assert(healthy_here(&voter.config, &voter.sensor[i]),
                         "VOT_002_healthy: below its counts");
    } else {
        __CPROVER_assert(unchanged(&voter, &before, sizeof(voter)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
