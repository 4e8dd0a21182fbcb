// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 8 --external-sat-solver cadical
// sources: src/flight/calibration.c
// covers: keel_calibration_six sides_fit scale_of
//
// Any sides at all: the contract, clause by clause, with all checks.
#include "../common/unchanged.h"
#include "calibration_proof.h"

void keel_calibration_six__any_harness(void)
{
    const keel_calibration_sides_t sides = nondet_sides();
    keel_calibration_correction_t correction = nondet_correction();
    const keel_calibration_correction_t before = correction;
    const keel_status_t status = keel_calibration_six(&sides, &correction);

    __CPROVER_assert(sides_fit_here(&sides) == (status != KEEL_ERR_VALUE),
                     "CAL_017_value: gravity and limit are looked at first");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&correction, &before, sizeof(correction)),
                     "CAL_017_kept: a refusal changes nothing");
    __CPROVER_assert((status != KEEL_OK) ||
                         (correction_valid(&correction) &&
                          three_within(correction.offset, -sides.limit, sides.limit)),
                     "CAL_017_taken: a correction that is taken is believed");
}
