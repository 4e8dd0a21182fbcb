// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// defines: -DKEEL_VOTER_SENSORS=3u
// covers: keel_voter_step watch_changes inspect inspect_all compare weigh add_saturated judge
// covers: one_more is_readable is_within keel_voter_agreement
//
// What becomes of each sensor. Bounded as the harness of the output.
#include "../common/voter_proof.h"

static void check_counts(const keel_voter_config_t *config, const keel_voter_sensor_t *was,
                         const keel_voter_sensor_t *is, uint8_t reason, uint32_t usable)
{
    const bool condemned = (reason >= KEEL_VOTER_MISSING) ||
                           ((reason == KEEL_VOTER_OUTVOTED) && (usable > 2u));

    __CPROVER_assert((reason != KEEL_VOTER_USED) || (is->null == 0u),
                     "VOT_010_clear: an agreement clears the count");
    __CPROVER_assert(!condemned ||
                         (is->null == ((was->null < UINT16_MAX) ? (was->null + 1) : UINT16_MAX)),
                     "VOT_010_condemned: a condemning vote is counted");
    __CPROVER_assert(condemned || (reason == KEEL_VOTER_USED) || (is->null == was->null),
                     "VOT_010_count: any other neither counts nor clears");
    __CPROVER_assert(is->latched ==
                         ((is->null >= config->latch_count) ||
                          ((config->density_limit > 0u) && (is->density >= config->density_limit))),
                     "VOT_011_latch: latched at the count, and only then");
    __CPROVER_assert(!condemned || (is->density == ((was->density < UINT16_MAX) ? (was->density + 1)
                                                                                : UINT16_MAX)),
                     "VOT_012_fill: the leaky count rises");
    __CPROVER_assert((reason != KEEL_VOTER_USED) ||
                         (is->density == ((was->density > 0u) ? (was->density - 1) : 0)),
                     "VOT_012_density: and leaks");
}

void keel_voter_step__verdicts_harness(void)
{
    keel_voter_t voter;
    keel_voter_t before;
    keel_voter_sample_t sample[SENSORS];
    bool readable[SENSORS] = {false};
    uint32_t usable = 0u;
    uint32_t others = 0u;
    uint32_t moved = 0u;

    any_voter(&voter, 1.0f, 3.0f);
    any_samples(sample);
    narrow_voter(&voter, sample);
    before = voter;

    keel_voter_step(&voter, sample, nondet_u32());

    for (uint32_t i = 0u; i < SENSORS; i++) {
        if (i < voter.config.sensors) {
            usable += (voter.vote.reason[i] <= KEEL_VOTER_OUTVOTED) ? 1u : 0u;
            readable[i] = !before.sensor[i].latched && sample[i].present &&
                          finite_here(sample[i].value);
            others += readable[i] ? 1u : 0u;
            moved += (readable[i] && (sample[i].value != before.sensor[i].last)) ? 1u : 0u;
        }
    }
    for (uint32_t i = 0u; i < SENSORS; i++) {
        const keel_voter_sensor_t *const was = &before.sensor[i];
        const keel_voter_sensor_t *const is = &voter.sensor[i];
        const uint8_t reason = voter.vote.reason[i];

        if (i < voter.config.sensors) {
            const bool changed = readable[i] && (sample[i].value != was->last);
            const bool alone = readable[i] && !changed && (moved > 0u) && ((moved + 1u) == others);

            __CPROVER_assert(((reason == KEEL_VOTER_OUTVOTED) ? KEEL_VOTER_USED : reason) ==
                                 reason_of(&voter.config, was, is->same, &sample[i]),
                             "VOT_007_reason: the reason is the first that applies");
            __CPROVER_assert((voter.vote.weight[i] >= 0.0f) && (voter.vote.weight[i] <= 1.0f),
                             "VOT_006_weights: weights lie in [0, 1]");
            __CPROVER_assert(is->last == (changed ? sample[i].value : was->last),
                             "VOT_013_last: the last finite sample is kept");
            __CPROVER_assert(is->same == (changed                               ? 0
                                          : (alone && (was->same < UINT16_MAX)) ? (was->same + 1)
                                                                                : was->same),
                             "VOT_013_stale: counted when it alone did not change");
            if (was->latched) {
                __CPROVER_assert(sensor_same(was, is), "VOT_011_stays: a latched one stays so");
            } else {
                check_counts(&voter.config, was, is, reason, usable);
            }
        } else {
            __CPROVER_assert(sensor_same(was, is), "VOT_011_frame: no other slot is touched");
        }
    }
}
