// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/load.c
// covers: keel_load_ppm
//
// Bounded to windows below 2^3 us, where the solver comes to the end of the
// division; the harness of equality with the model has no such bound, nor has the contract under
// WP.
#include "load_proof.h"

void keel_load_ppm__exact_harness(void)
{
    keel_load_t load = {.start_us = any_bits64(63u), .busy_us = any_bits64(63u)};
    const keel_load_t before = load;
    const uint64_t window_us = any_bits64(3u);
    const uint64_t spent_us = any_bits64(3u);
    uint64_t load_ppm;

    __CPROVER_assume(spent_us <= window_us);

    load_ppm = keel_load_ppm(&load, load.start_us + window_us, load.busy_us + spent_us);

    __CPROVER_assert(load_ppm <= 1000000u, "LOD_007_range: at most 100 %");
    if (window_us == 0u) {
        __CPROVER_assert(load_ppm == 0u, "LOD_007_empty: an empty window has no load");
    } else {
        __CPROVER_assert((load_ppm * window_us) <= (spent_us * 1000000u),
                         "LOD_007_load: not more than the time spent");
        __CPROVER_assert((spent_us * 1000000u) < ((load_ppm + 1u) * window_us),
                         "LOD_007_load: and less by no more than the rounding");
    }
    __CPROVER_assert((load.start_us == before.start_us) && (load.busy_us == before.busy_us),
                     "LOD_007_frame: nothing changed");
}
