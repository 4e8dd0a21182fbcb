/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/load.h"

/* A time of at most some number of windows comes to at most that number. */
/*@ lemma LOD_quotient: \forall integer a, w, most;
  @     0 <= a ==> 0 < w ==> a <= w * most ==> a / w <= most;
  @*/

void keel_load_begin(keel_load_t *load, uint64_t now_us, uint64_t busy_us)
{
    load->start_us = now_us;
    load->busy_us = busy_us;
}

uint32_t keel_load_ppm(const keel_load_t *load, uint64_t now_us, uint64_t busy_us)
{
    const uint64_t window_us = now_us - load->start_us;

    if (window_us == 0u) {
        return 0u;
    }
    /*@ assert share: (busy_us - load->busy_us) * KEEL_LOAD_FULL_PPM <=
      @     window_us * KEEL_LOAD_FULL_PPM; */
    /*@ assert quotient: ((busy_us - load->busy_us) * KEEL_LOAD_FULL_PPM) / window_us <=
      @     KEEL_LOAD_FULL_PPM; */
    return (uint32_t)(((busy_us - load->busy_us) * KEEL_LOAD_FULL_PPM) / window_us);
}
