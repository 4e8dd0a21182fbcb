// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 8 --external-sat-solver cadical
// sources: src/flight/filter.c specs/model/filter.c
// covers: keel_filter_step model_filter_step
//
// Chosen filters and inputs, where sums are rounded: the same as the model's. All of them are dealt
// with in keel_filter_step_harness; wrong bodies are refuted here, for where floats differ z3 finds
// no example.
#include "../../specs/model/filter.h"
#include "../common/keel_flight_proof.h"

#define POINTS 7u

typedef struct point {
    keel_filter_t filter;
    float input;
} point_t;

/* A tenth of the rate, and 0.45 of it; the energy limit is met, and passed; no input. */
static const point_t points[POINTS] = {
    {{0.067455274f, 0.293599201f, 0.277891050f, KEEL_FILTER_LOW_ENERGY_LIMIT, 0.3f, 0.7f, 0.5f},
     1.1f},
    {{0.067455274f, 0.293599201f, 0.277891050f, KEEL_FILTER_LOW_ENERGY_LIMIT, -1.3f, 2.9f, 3.1f},
     -7.7f},
    {{0.800592403f, 0.179324231f, -0.959833269f, KEEL_FILTER_HIGH_ENERGY_LIMIT, 0.1f, -0.9f, 0.2f},
     123.4f},
    {{0.0f, 0.0f, 1.0f, KEEL_FILTER_LOW_ENERGY_LIMIT, KEEL_FILTER_LOW_STATE_LIMIT, 0.0f, 0.5f},
     1.0f},
    {{1.0f, 1.0f, 1.0f, KEEL_FILTER_LOW_ENERGY_LIMIT, KEEL_FILTER_LOW_STATE_LIMIT, 0.0f, 0.5f},
     1.0f},
    {{0.067455274f, 0.293599201f, 0.277891050f, KEEL_FILTER_LOW_ENERGY_LIMIT, 0.3f, 0.7f, 0.5f},
     1.0e7f},
    {{0.067455274f, 0.293599201f, 0.277891050f, KEEL_FILTER_LOW_ENERGY_LIMIT, 0.3f, 0.7f, 0.5f},
     -1.0e7f},
};

void keel_filter_step__points_harness(void)
{
    for (unsigned i = 0u; i < POINTS; i++) {
        keel_filter_t filter = points[i].filter;
        keel_filter_t model = filter;
        const keel_status_t status = keel_filter_step(&filter, points[i].input);

        __CPROVER_assert(status == model_filter_step(&model, points[i].input),
                         "FLT_009_model: taken or refused as the model says");
        __CPROVER_assert(filter_same(&filter, &model),
                         "FLT_006_model: states and output are what the model says");
    }
}
