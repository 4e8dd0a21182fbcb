// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --refine
// checks: assertions
// sources: src/flight/calibration.c
// covers: keel_calibration_rest_step
//
// Any bit pattern for what was measured and for the state: the contract of a step, clause by
// clause; what is near is in keel_calibration_rest_step__near_harness. Overflow is not checked
// here, but for valid calibrations in keel_calibration_rest_step__valid_harness.
#include "calibration_proof.h"

void keel_calibration_rest_step__any_harness(void)
{
    const keel_calibration_vector_t sample = nondet_vector();
    keel_calibration_rest_t rest = any_rest_at_all();
    const keel_calibration_rest_t before = rest;
    const bool collects = before.state == KEEL_CALIBRATION_COLLECTING;
    const bool sane = three_within(sample.axis, -LIMIT, LIMIT);
    bool taken;

    __CPROVER_assume(rest_counts(&rest));

    keel_calibration_rest_step(&rest, sample.axis);
    taken = collects && (rest.state == KEEL_CALIBRATION_DONE);

    __CPROVER_assert(collects || rest_same(&rest, &before),
                     "CAL_004_only: nothing happens when nothing was begun");
    __CPROVER_assert(!collects || (rest.count == (before.count + 1u)) || (rest.count == 0u),
                     "CAL_004_counted: a sample belongs to a run, or ends it");
    __CPROVER_assert(!collects || (before.count != 0u) || !sane ||
                         ((rest.count == 1u) && three_same(rest.first, sample.axis)),
                     "CAL_004_first: a run begins with any number");
    __CPROVER_assert(!collects || sane || (rest.count == 0u), "CAL_005_none: and ends with none");
    __CPROVER_assert(!collects || (rest.restarts == (((rest.count == 0u) && (before.count != 0u))
                                                         ? up_to_end(before.restarts)
                                                         : before.restarts)),
                     "CAL_005_told: runs that end so are counted");
    __CPROVER_assert(!collects || (((rest.state == KEEL_CALIBRATION_COLLECTING) ==
                                    (rest.count < rest.config.samples)) &&
                                   (rest.state != KEEL_CALIBRATION_IDLE)),
                     "CAL_006_ends: with as many samples as configured, and not before");
    __CPROVER_assert(!taken || ((rest.beyond == 0u) &&
                                three_within(rest.offset, -rest.config.limit, rest.config.limit)),
                     "CAL_007_limit: an offset that is taken is believed");
    __CPROVER_assert(!collects || (rest.state != KEEL_CALIBRATION_REFUSED) ||
                         ((rest.beyond >= 1u) && (rest.beyond <= 7u)),
                     "CAL_007_refused: an axis is named");
    __CPROVER_assert(taken || three_same(rest.offset, before.offset),
                     "CAL_007_kept: else the offset stays");
}
