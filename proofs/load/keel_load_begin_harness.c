// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/load.c
// covers: keel_load_begin
#include "../common/keel_proof.h"

void keel_load_begin_harness(void)
{
    keel_load_t load;
    const uint64_t now_us = nondet_u64();
    const uint64_t busy_us = nondet_u64();

    keel_load_begin(&load, now_us, busy_us);

    __CPROVER_assert((load.start_us == now_us) && (load.busy_us == busy_us),
                     "LOD_006: the window begins here");
}
