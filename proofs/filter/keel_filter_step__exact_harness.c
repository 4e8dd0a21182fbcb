// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/filter.c
// covers: keel_filter_step is_sample
//
// What a step computes, on numbers whose sums and products are exact in single precision: the
// coefficients are eighths, states and input small whole numbers.
#include "../common/keel_flight_proof.h"

static int any_small(void)
{
    return (int)(nondet_u8() & 3u) - 1;
}

/* At the energy limit and just beyond: with a = b = 0 and c = 1 a step leads to the states that it
 * came from. */
static keel_filter_t at_limit(bool beyond)
{
    const keel_filter_t filter = {.c = 1.0f,
                                  .energy_limit = KEEL_FILTER_LOW_ENERGY_LIMIT,
                                  .s1 = KEEL_FILTER_LOW_STATE_LIMIT,
                                  .s2 = beyond ? KEEL_FILTER_LOW_STATE_LIMIT : 0.0f};

    return filter;
}

void keel_filter_step__exact_harness(void)
{
    const int a = any_small();
    const int b = any_small();
    const int c = any_small();
    const int s1 = any_small();
    const int s2 = any_small();
    const int x = any_small();
    const int rise = (b * s1) + (a * (x - s2)); /* in eighths */
    const bool limit = nondet_bool();
    const bool beyond = nondet_bool();
    const bool far = nondet_bool();
    keel_filter_t filter = {.a = (float)a * 0.125f,
                            .b = (float)b * 0.125f,
                            .c = (float)c * 0.125f,
                            .energy_limit = KEEL_FILTER_LOW_ENERGY_LIMIT,
                            .s1 = (float)s1,
                            .s2 = (float)s2};
    keel_status_t status;

    if (limit) {
        filter = at_limit(beyond);
    }

    status = keel_filter_step(&filter, far ? 2.0e6f : (float)x);

    __CPROVER_assert((status == KEEL_OK) == (!far && !(limit && beyond)),
                     "FLT_009_taken: as much energy as the limit is taken, more is refused");
    if (!limit && !far) {
        __CPROVER_assert((filter.output * 8.0f) == (float)((8 * s2) + rise), "FLT_009_output: y");
        __CPROVER_assert((filter.s1 * 8.0f) == (float)((c * s1) + (b * (x - s2))),
                         "FLT_009_s1: s1");
        __CPROVER_assert((filter.s2 * 8.0f) == (float)((8 * s2) + (2 * rise)), "FLT_009_s2: s2");
    }
}
