// cbmc: --unwind 34
// sources: src/rtos/task.c
// covers: keel_task_is_realtime
#include "../common/keel_proof.h"

void keel_task_is_realtime_harness(void)
{
    const bool realtime = nondet_bool();
    bool result;

    any_task(0u, realtime);

    result = keel_task_is_realtime(proof_task[0]);

    __CPROVER_assert(result == (proof_config[0]->priority == 16u),
                     "TSK_001: real-time is what has the real-time priority");
}
