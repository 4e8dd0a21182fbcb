// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/calibration.c
// covers: keel_calibration_field_finish keel_calibration_field_axis middle_of
//
// Any valid calibration: it stays valid, and no operation overflows or gives a NaN.
#include "calibration_proof.h"

void keel_calibration_field_finish__valid_harness(void)
{
    keel_calibration_field_t field = any_field_at_all();

    __CPROVER_assume(field_valid(&field));

    (void)keel_calibration_field_finish(&field);

    __CPROVER_assert(field_valid(&field), "CAL_013_finish: it stays valid");
}
