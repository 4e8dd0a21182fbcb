// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/flight/position.c src/flight/axis.c specs/model/position.c specs/model/axis.c
// covers: keel_position_set_origin cosine_of model_position_set_origin cosine_by_series
//
// Chosen origins, each in a case of its own: the same as the model's. All of them are dealt with in
// keel_position_set_origin_harness; wrong bodies are refuted here, for where floats differ z3 finds
// no example.
#include "../../specs/model/position.h"
#include "position_proof.h"

#define ORIGINS 8u

void keel_position_set_origin__points_harness(void)
{
    static const int32_t latitudes[ORIGINS] = {0,          481000000, -337000000, 800000000,
                                               -800000000, 800000001, -800000001, 100000000};
    static const int32_t longitudes[ORIGINS] = {0,           115000000, 1512000000, 1800000000,
                                                -1800000000, 5,         5,          1800000001};

    for (unsigned point = 0u; point < ORIGINS; point++) {
        keel_position_t position = any_position_at_all();
        keel_position_t model = position;
        const keel_status_t status = keel_position_set_origin(&position, latitudes[point],
                                                              longitudes[point]);

        __CPROVER_assert(status ==
                             model_position_set_origin(&model, latitudes[point], longitudes[point]),
                         "POS_003_points: taken or refused as the model says");
        __CPROVER_assert(position_same(&position, &model),
                         "POS_004_points: every field is what the model says");
    }
}
