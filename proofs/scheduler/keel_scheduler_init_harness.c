// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/stats.c
// sources: specs/model/admission.c specs/model/admission_queue.c
// covers: keel_scheduler_init config_is_valid model_scheduler_init
#include "../../specs/model/scheduler.h"
#include "../common/keel_scheduler_proof.h"

keel_scheduler_t nondet_scheduler(void);

void keel_scheduler_init_harness(void)
{
    keel_scheduler_t scheduler = nondet_scheduler();
    keel_scheduler_config_t config;
    const uint32_t x = any_below(CAPACITY);
    const bool given = nondet_bool();
    const bool configured = nondet_bool();
    keel_scheduler_config_t as_given;
    keel_scheduler_t expected;
    keel_status_t modelled;
    keel_status_t status;

    config.read_clock = nondet_bool() ? any_clock : NULL;
    config.clock_context = nondet_bool() ? &config : NULL;
    config.guard_us = nondet_u32();
    config.utilisation_limit_ppm = nondet_u32();
    config.without_promotion = nondet_bool();
    as_given = config;
    expected = scheduler;
    modelled = model_scheduler_init(given ? &expected : NULL, configured ? &config : NULL);

    status = keel_scheduler_init(given ? &scheduler : NULL, configured ? &config : NULL);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, x),
                     "SCH_001_model: as the model says");
    __CPROVER_assert(setup_same(&config, &as_given), "SCH_001_frame: the argument is not written");
}
