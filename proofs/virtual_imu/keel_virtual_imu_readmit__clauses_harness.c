// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 7 --no-array-field-sensitivity
// sources: src/middleware/virtual_imu.c src/middleware/voter.c
// checks: assertions
// covers: keel_virtual_imu_readmit
//
// Each clause of the contract, without the model: every virtual unit of 2 to 4 units, be its
// channels valid or not, and every index. All other checks: keel_virtual_imu_readmit_harness.c.
#include "virtual_imu_proof.h"

/* virtual_imu_valid, of the number of units */
static bool units_valid_here(uint8_t units)
{
    return (2u <= units) && (units <= SENSORS);
}

/* What a readmission must leave as it was in a channel, whatever it returns. */
static void check_channel(const keel_voter_t *voter, const keel_voter_t *before, uint32_t unit)
{
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert((i == unit) || voter_sensor_same(&voter->sensor[i], &before->sensor[i]),
                         "IMU_004_others: sensors of other units stay as they were");
        __CPROVER_assert(vote_same(&voter->vote, &before->vote, i),
                         "IMU_004_votes: the last vote stays");
    }
}

void keel_virtual_imu_readmit__clauses_harness(void)
{
    const uint8_t units = nondet_u8();
    const uint32_t unit = nondet_u32();
    keel_virtual_imu_t imu;
    keel_virtual_imu_t before;
    bool some = false;
    keel_status_t status;

    __CPROVER_assume(units_valid_here(units));
    any_virtual_imu(&imu, units);
    before = imu;
    for (uint32_t k = 0u; k < CHANNELS; k++) {
        for (uint32_t i = 0u; i < SENSORS; i++) {
            some = some || ((i == unit) && imu.channel[k].sensor[i].latched);
        }
    }

    status = keel_virtual_imu_readmit(&imu, unit);

    __CPROVER_assert((unit >= units) == (status == KEEL_ERR_SENSORS),
                     "IMU_004_unknown: refused as unknown when there is no such unit");
    __CPROVER_assert((status == KEEL_OK) == ((unit < units) && some),
                     "IMU_004_accepted: readmitted when it is there and any channel is latched");
    for (uint32_t k = 0u; k < CHANNELS; k++) {
        check_channel(&imu.channel[k], &before.channel[k], unit);
    }
    for (uint32_t i = 0u; i < SENSORS; i++) {
        for (uint32_t k = 0u; k < CHANNELS; k++) {
            __CPROVER_assert((status != KEEL_OK) || (i != unit) ||
                                 !imu.channel[k].sensor[i].latched,
                             "IMU_004_readmitted: no channel of it is latched");
        }
        __CPROVER_assert((status != KEEL_OK) || (i != unit) || (imu.latched[i] == 0u),
                         "IMU_004_noted: none is noted as latched");
        __CPROVER_assert((i == unit) || (imu.latched[i] == before.latched[i]),
                         "IMU_004_others: what is noted of other units stays");
        __CPROVER_assert(imu.used[i] == before.used[i],
                         "IMU_004_used: the channels that contributed stay noted");
        __CPROVER_assert((status == KEEL_OK) || virtual_imu_same(&imu, &before, i),
                         "IMU_004_kept: a refusal changes nothing");
    }
}
