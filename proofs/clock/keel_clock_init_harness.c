// cbmc: --unwind 2
// covers: keel_clock_init
#include "../common/keel_proof.h"

void keel_clock_init_harness(void)
{
    keel_clock_t clock;
    const uint32_t raw_us = nondet_u32();

    keel_clock_init(&clock, raw_us);

    __CPROVER_assert((clock.now_us == 0u) && (clock.raw_us == raw_us),
                     "CLK_002: time starts at 0 with this reading");
}
