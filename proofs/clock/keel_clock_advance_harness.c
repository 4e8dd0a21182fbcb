// cbmc: --unwind 2
// covers: keel_clock_advance keel_clock_elapsed_us
#include "../common/keel_proof.h"

void keel_clock_advance_harness(void)
{
    keel_clock_t clock = {.now_us = nondet_u64(), .raw_us = nondet_u32()};
    const keel_clock_t before = clock;
    const uint32_t raw_us = nondet_u32();
    const uint64_t step_us = ((uint64_t)raw_us + ((raw_us >= before.raw_us) ? 0u : 0x100000000u)) -
                             before.raw_us;
    keel_status_t status;

    __CPROVER_assume(clock.now_us <= KEEL_CLOCK_TIME_LIMIT_US);

    status = keel_clock_advance(&clock, raw_us);

    if (step_us >= KEEL_CLOCK_STEP_LIMIT_US) {
        __CPROVER_assert(status == KEEL_ERR_CLOCK, "CLK_004: a step of 2^31 or more is refused");
        __CPROVER_assert((clock.now_us == before.now_us) && (clock.raw_us == before.raw_us),
                         "CLK_004_unchanged: a refusal keeps the clock");
    } else {
        __CPROVER_assert(status == KEEL_OK, "CLK_003_ok: a shorter step is taken");
        __CPROVER_assert(clock.now_us == (before.now_us + step_us),
                         "CLK_003: time moves on by the step");
        __CPROVER_assert(clock.raw_us == raw_us, "CLK_003_raw: the reading is kept");
    }
}
