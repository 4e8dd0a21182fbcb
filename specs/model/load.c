/* SPDX-License-Identifier: Apache-2.0 */
#include "load.h"

/* LOD-006 */
void model_load_begin(keel_load_t *load, uint64_t now_us, uint64_t busy_us)
{
    load->start_us = now_us;
    load->busy_us = busy_us;
}

/* LOD-007: eq. 13 and 14, whose idle time T_nl is all of the window that is not spent in tasks. */
uint32_t model_load_ppm(const keel_load_t *load, uint64_t now_us, uint64_t busy_us)
{
    const uint64_t window_us = now_us - load->start_us;
    const uint64_t spent_us = busy_us - load->busy_us;

    if (window_us == 0u) {
        return 0u;
    }
    return (uint32_t)((spent_us * KEEL_LOAD_FULL_PPM) / window_us);
}
