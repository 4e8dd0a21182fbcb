// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_readmit
#include "../common/unchanged.h"
#include "../common/voter_proof.h"

void keel_voter_readmit_harness(void)
{
    keel_voter_t voter;
    keel_voter_t before;
    const uint32_t sensor = nondet_u32();
    const uint32_t i = nondet_u32();
    keel_status_t status;

    any_voter(&voter, 1.0f, 3.0f);
    before = voter;
    __CPROVER_assume(i < SENSORS);

    status = keel_voter_readmit(&voter, sensor);

    if (sensor >= before.config.sensors) {
        __CPROVER_assert(status == KEEL_ERR_SENSORS, "VOT_014_unknown: there is no such sensor");
    } else if (!before.sensor[sensor].latched) {
        __CPROVER_assert(status == KEEL_ERR_STATE, "VOT_014_healthy: it is not latched");
    } else {
        __CPROVER_assert((status == KEEL_OK) && !voter.sensor[sensor].latched &&
                             (voter.sensor[sensor].null == 0u) &&
                             (voter.sensor[sensor].density == 0u) &&
                             (voter.sensor[sensor].same == 0u),
                         "VOT_014_readmitted: it votes again, with no counts");
        __CPROVER_assert(voter.sensor[sensor].last == before.sensor[sensor].last,
                         "VOT_014_last: what it last said is kept");
    }
    __CPROVER_assert(voter.sensor[i].latched || healthy_here(&voter.config, &voter.sensor[i]),
                     "VOT_014_healthy: below its counts, or latched");
    __CPROVER_assert(!voter.unanimous || unanimous_here(&voter),
                     "VOT_014_unanimous: no vote with a latched sensor was");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&voter, &before, sizeof(voter)),
                     "STA_001_kept: a refusal changes nothing");
    __CPROVER_assert(((status == KEEL_OK) && (i == sensor)) ||
                         sensor_same(&voter.sensor[i], &before.sensor[i]),
                     "VOT_014_frame: other sensors, and all in a refusal, stay");
}
