// cbmc: --external-sat-solver cadical
// sources: src/flight/filter.c
// covers: keel_filter_reset is_sample
#include "../common/keel_flight_proof.h"
#include "../common/unchanged.h"

void keel_filter_reset_harness(void)
{
    const float value = nondet_float();
    keel_filter_t filter;
    keel_filter_t expected;
    keel_filter_t before;
    keel_status_t status;

    any_filter(&filter);
    expected = filter;
    before = filter;

    status = keel_filter_reset(&filter, value);

    if (filter_input_here(value)) {
        expected.s1 = 0.0f;
        expected.s2 = value;
        expected.output = value;
    }
    __CPROVER_assert(status == (filter_input_here(value) ? KEEL_OK : KEEL_ERR_INPUT),
                     "FLT_004_ok: a value in range is taken, others refused");
    __CPROVER_assert(filter_same(&filter, &expected), "FLT_004_rest: at rest there, or unchanged");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&filter, &before, sizeof(filter)),
                     "STA_001_kept: a refusal changes nothing");
    __CPROVER_assert(filter_coefficients_here(&filter) && filter_bounded_here(&filter),
                     "FLT_004_valid: the filter stays valid");
}
