// cbmc: --unwind 34
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/load.c
// replaces: keel_admission_queue
// covers: keel_scheduler_start admit_queue read_clock model_scheduler_start
#include "../common/scheduler_parts.h"

void keel_scheduler_start_harness(void)
{
    keel_scheduler_t *const given = nondet_bool() ? &scheduler : NULL;
    keel_status_t modelled;
    keel_status_t status;

    any_parts(CAPACITY);
    modelled = model_scheduler_start((given != NULL) ? &expected : NULL);
    read_again();

    status = keel_scheduler_start(given);

    __CPROVER_assert((status == modelled) && is_as_modelled() && is_read_as_often(),
                     "SCH_009_model: as the model says");
}
