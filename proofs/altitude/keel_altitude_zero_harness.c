// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/altitude.c specs/model/altitude.c
// covers: keel_altitude_zero model_altitude_zero
//
// Any estimator at all: the same as the model's, bit for bit; a valid one stays valid.
#include "../../specs/model/altitude.h"
#include "altitude_proof.h"

void keel_altitude_zero_harness(void)
{
    keel_altitude_t altitude = any_altitude_at_all();
    keel_altitude_t model = altitude;
    const bool valid = altitude_valid(&altitude);

    keel_altitude_zero(&altitude);
    model_altitude_zero(&model);

    __CPROVER_assert(altitude_same(&altitude, &model),
                     "ALT_003_model: every field is what the model says");
    __CPROVER_assert(altitude.height == 0.0f, "ALT_003_zero: it is 0 now");
    __CPROVER_assert(float_same(altitude.zero, altitude.axis.position),
                     "ALT_003_here: because of where it is");
    __CPROVER_assert(!valid || altitude_valid(&altitude), "ALT_003_valid: it stays valid");
}
