// cbmc: --unwind 2
// sources: src/rtos/decision.c src/rtos/priority.c
// covers: keel_decision_room_us
#include "../common/keel_proof.h"
#include "keel/rtos/decision.h"

void keel_decision_room_us_harness(void)
{
    const uint64_t earliest_us = nondet_u64();
    const uint64_t now_us = nondet_u64();
    const uint32_t guard_us = nondet_u32();
    const uint32_t worst_us = nondet_u32();
    const uint64_t slack_us = (earliest_us > now_us) ? (earliest_us - now_us) : 0u;
    uint32_t room_us;

    room_us = keel_decision_room_us(earliest_us, now_us, guard_us);

    __CPROVER_assert((worst_us == 0u) ||
                         ((worst_us <= room_us) == (((uint64_t)guard_us + worst_us) <= slack_us)),
                     "DEC_005_room: a task fits the room exactly when W + w fits the slack");
}
