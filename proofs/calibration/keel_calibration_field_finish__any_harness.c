// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/calibration.c
// covers: keel_calibration_field_finish
//
// Any calibration at all: the contract of finish, clause by clause.
#include "../common/unchanged.h"
#include "calibration_proof.h"

void keel_calibration_field_finish__any_harness(void)
{
    keel_calibration_field_t field = any_field_at_all();
    const keel_calibration_field_t before = field;
    const bool collects = before.state == KEEL_CALIBRATION_COLLECTING;
    keel_status_t status;

    __CPROVER_assume(field_finite(&field.config));

    status = keel_calibration_field_finish(&field);

    __CPROVER_assert(collects == (status != KEEL_ERR_STATE),
                     "CAL_012_state: nothing ends that was not begun");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&field, &before, sizeof(field)),
                     "CAL_012_kept: a refusal changes nothing");
    __CPROVER_assert((status != KEEL_OK) ||
                         ((field.state == KEEL_CALIBRATION_DONE) &&
                          three_within(field.offset, -field.config.limit, field.config.limit)),
                     "CAL_012_taken: an offset that is taken is believed");
}
