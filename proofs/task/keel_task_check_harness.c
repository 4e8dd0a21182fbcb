// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2
// sources: src/rtos/task.c specs/model/task.c
// covers: keel_task_check priority_is_valid model_task_check
#include "../../specs/model/task.h"
#include "../common/keel_proof.h"

void keel_task_check_harness(void)
{
    keel_task_config_t config;
    keel_task_config_t before;
    const bool given = nondet_bool();
    keel_status_t status;

    any_config(&config);
    before = config;

    status = keel_task_check(given ? &config : NULL);

    __CPROVER_assert(status == model_task_check(given ? &before : NULL),
                     "TSK_002_model: the first reason that applies");
    __CPROVER_assert(config_same(&config, &before),
                     "TSK_002_frame: the declaration is not written");
}
