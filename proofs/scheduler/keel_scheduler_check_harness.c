// cbmc: --unwind 34
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/load.c
// replaces: keel_admission_queue
// covers: keel_scheduler_check admit_queue model_scheduler_check admit_all
#include "../common/scheduler_parts.h"

void keel_scheduler_check_harness(void)
{
    uint32_t admitted = nondet_u32();
    uint32_t expected_admitted = admitted;
    keel_status_t modelled;
    keel_status_t status;

    any_parts(CAPACITY);
    modelled = model_scheduler_check(&expected, &expected_admitted);

    status = keel_scheduler_check(&scheduler, &admitted);

    __CPROVER_assert((status == modelled) && (admitted == expected_admitted) && is_as_modelled(),
                     "SCH_003_model: as the model says");
}
