/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file lockstep.h
 * @brief The kernel's functions, each called beside its executable specification (specs/model).
 *
 * Each calls the kernel on a scheduler, and the specification on a copy of it as it was before;
 * what they leave and answer must be the same in every field. A difference is remembered until it
 * is asked for. The reference model (model.h) shares nothing with either of them.
 */
#ifndef KEEL_TESTS_PROPERTY_LOCKSTEP_H
#define KEEL_TESTS_PROPERTY_LOCKSTEP_H

#include "keel/rtos/scheduler.h"

keel_status_t lockstep_check(const keel_scheduler_t *scheduler, uint32_t *admitted);
keel_status_t lockstep_add(keel_scheduler_t *scheduler, const keel_task_config_t *task);
keel_status_t lockstep_remove(keel_scheduler_t *scheduler, const keel_task_config_t *task);
keel_status_t lockstep_start(keel_scheduler_t *scheduler);
keel_status_t lockstep_resync(keel_scheduler_t *scheduler);
uint32_t lockstep_idle(keel_scheduler_t *scheduler, uint32_t latency_us, uint32_t longest_us);
keel_status_t lockstep_begin(keel_scheduler_t *scheduler, uint32_t raw_us);
const keel_task_config_t *lockstep_next(keel_scheduler_t *scheduler);
keel_status_t lockstep_finish(keel_scheduler_t *scheduler, uint32_t raw_us);

/** The function at which the first difference showed, or null; asking forgets it. */
const char *lockstep_difference(void);

#endif
