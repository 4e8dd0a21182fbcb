// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 18 --external-sat-solver cadical
// sources: src/flight/filter.c specs/model/filter.c
// covers: keel_filter_init set_coefficients tangent model_filter_init tan_of
//
// The coefficients for some cut-offs at 1000 Hz, of which 250 Hz (g = 1) is the last below the
// change of formula; the lowest and the highest rate, the lowest cut-off of a rate, and what is just
// beyond them. The numbers are those of filter.h in double precision; how near the coefficients are
// everywhere else is tested. Wrong bodies are refuted here: where floats differ, z3 finds no
// example.
#include "../../specs/model/filter.h"
#include "../common/keel_flight_proof.h"

#define POINTS 17u

typedef struct point {
    keel_status_t status;
    float rate_hz;
    float cutoff_hz;
    float a;
    float b;
    float c;
    float energy_limit;
} point_t;

static const point_t points[POINTS] = {
    {KEEL_OK, 1000.0f, 1.0f, 0.000009826f, 0.004423202f, 0.991133944f,
     KEEL_FILTER_LOW_ENERGY_LIMIT},
    {KEEL_OK, 1000.0f, 10.0f, 0.000944692f, 0.042512083f, 0.913086451f,
     KEEL_FILTER_LOW_ENERGY_LIMIT},
    {KEEL_OK, 1000.0f, 100.0f, 0.067455274f, 0.293599201f, 0.277891050f,
     KEEL_FILTER_LOW_ENERGY_LIMIT},
    {KEEL_OK, 1000.0f, 200.0f, 0.206572084f, 0.402092144f, -0.217328455f,
     KEEL_FILTER_LOW_ENERGY_LIMIT},
    {KEEL_OK, 1000.0f, 250.0f, 0.292893219f, 0.414213562f, -0.414213562f,
     KEEL_FILTER_LOW_ENERGY_LIMIT},
    {KEEL_OK, 1000.0f, 300.0f, 0.391335773f, 0.402092144f, -0.586855832f,
     KEEL_FILTER_HIGH_ENERGY_LIMIT},
    {KEEL_OK, 1000.0f, 375.0f, 0.569035594f, 0.333333333f, -0.804737854f,
     KEEL_FILTER_HIGH_ENERGY_LIMIT},
    {KEEL_OK, 1000.0f, 450.0f, 0.800592403f, 0.179324231f, -0.959833269f,
     KEEL_FILTER_HIGH_ENERGY_LIMIT},
    {KEEL_OK, 1000.0f, 499.0f, 0.995566972f, 0.004423202f, -0.999980348f,
     KEEL_FILTER_HIGH_ENERGY_LIMIT},
    {KEEL_OK, KEEL_FILTER_RATE_MIN_HZ, 0.000244140625f, 0.292893219f, 0.414213562f, -0.414213562f,
     KEEL_FILTER_LOW_ENERGY_LIMIT},
    {KEEL_OK, KEEL_FILTER_RATE_MAX_HZ, 250000.0f, 0.292893219f, 0.414213562f, -0.414213562f,
     KEEL_FILTER_LOW_ENERGY_LIMIT},
    {KEEL_OK, 524288.0f, 0.5f, 0.0f, 0.000004237f, 0.999991526f, KEEL_FILTER_LOW_ENERGY_LIMIT},
    {KEEL_ERR_CUTOFF, 524288.0f, 0.49999997f, 0.0f, 0.0f, 0.0f, 0.0f},
    {KEEL_ERR_RATE, 0.00097656244f, 0.000244140625f, 0.0f, 0.0f, 0.0f, 0.0f},
    {KEEL_ERR_RATE, 1000000.0625f, 250000.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {KEEL_ERR_RATE, 0.0f, 100.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {KEEL_ERR_CUTOFF, 1000.0f, 500.0f, 0.0f, 0.0f, 0.0f, 0.0f},
};

static bool near(float value, float expected)
{
    return within(value, expected - 0x1p-20f, expected + 0x1p-20f);
}

void keel_filter_init__exact_harness(void)
{
    for (unsigned i = 0u; i < POINTS; i++) {
        const point_t *const point = &points[i];
        keel_filter_t filter = nondet_filter();
        keel_filter_t model = filter;
        const keel_status_t status = keel_filter_init(&filter, point->rate_hz, point->cutoff_hz);

        __CPROVER_assert(status == model_filter_init(&model, point->rate_hz, point->cutoff_hz),
                         "FLT_001_model: taken or refused as the model says");
        __CPROVER_assert(filter_same(&filter, &model),
                         "FLT_002_model: coefficients and states are what the model says");
        __CPROVER_assert(status == point->status, "FLT_001_ok: taken or refused");
        if (status == KEEL_OK) {
            __CPROVER_assert(near(filter.a, point->a) && near(filter.b, point->b) &&
                                 near(filter.c, point->c),
                             "FLT_002_near: within 2^-20");
            __CPROVER_assert(filter.energy_limit == point->energy_limit,
                             "FLT_003_limit: by the cut-off");
        }
    }
}
