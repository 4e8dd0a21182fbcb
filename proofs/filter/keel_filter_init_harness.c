// cbmc: --external-sat-solver cadical
// sources: src/flight/filter.c
// covers: keel_filter_init set_coefficients tangent
//
// Any bit pattern for both frequencies.
#include "../common/keel_flight_proof.h"
#include "../common/unchanged.h"

void keel_filter_init_harness(void)
{
    const float rate_hz = nondet_float();
    const float cutoff_hz = nondet_float();
    const bool good_rate = within(rate_hz, KEEL_FILTER_RATE_MIN_HZ, KEEL_FILTER_RATE_MAX_HZ);
    const bool good_cutoff = good_rate && (cutoff_hz < (rate_hz * 0.5f)) &&
                             ((rate_hz * KEEL_FILTER_RATIO_MIN) <= cutoff_hz);
    keel_filter_t filter = nondet_filter();
    const keel_filter_t before = filter;
    keel_status_t status;

    status = keel_filter_init(&filter, rate_hz, cutoff_hz);

    if (!good_rate) {
        __CPROVER_assert(status == KEEL_ERR_RATE, "FLT_001_rate: a bad rate is refused");
    } else if (!good_cutoff) {
        __CPROVER_assert(status == KEEL_ERR_CUTOFF, "FLT_001_cutoff: a bad cut-off is refused");
    } else {
        __CPROVER_assert(status == KEEL_OK, "FLT_001_ok: all others are taken");
        __CPROVER_assert(filter_coefficients_here(&filter), "FLT_002_coefficients: in range");
        __CPROVER_assert((filter.s1 == 0.0f) && (filter.s2 == 0.0f) && (filter.output == 0.0f),
                         "FLT_003_rest: at rest at 0");
        __CPROVER_assert(filter_bounded_here(&filter), "FLT_003_valid: and valid");
    }
    __CPROVER_assert((status == KEEL_OK) || filter_same(&filter, &before),
                     "FLT_001_unchanged: a refusal changes nothing");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&filter, &before, sizeof(filter)),
                     "STA_001_kept: a refusal changes nothing");
}
