// cbmc: --unwind 2
// covers: keel_clock_elapsed_us
#include "../common/keel_proof.h"

void keel_clock_elapsed_us_harness(void)
{
    const uint32_t from_us = nondet_u32();
    const uint32_t to_us = nondet_u32();
    const uint32_t elapsed_us = keel_clock_elapsed_us(from_us, to_us);
    const uint64_t wrap = (to_us >= from_us) ? 0u : 0x100000000u;

    __CPROVER_assert(((uint64_t)from_us + elapsed_us) == (wrap + to_us),
                     "CLK_001: the earlier reading and the difference make the later, modulo 2^32");
}
