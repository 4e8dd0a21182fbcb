/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file rivals.h
 * @brief Schedulers to compare Keel's with. They share its interface, queue, clock and statistics:
 * set up a keel_scheduler_t as usual, then call one of these instead of keel_scheduler_step.
 */
#ifndef KEEL_EXPERIMENTS_RIVALS_H
#define KEEL_EXPERIMENTS_RIVALS_H

#include "keel/rtos/scheduler.h"

/** One step of a scheduler. */
typedef keel_status_t (*rival_step_t)(keel_scheduler_t *scheduler);

/** Plain EDF, non-preemptive: the released task with the earliest deadline, whatever its class. */
keel_status_t rival_edf_step(keel_scheduler_t *scheduler);

/** Keel without its guard: FCFS first, then the highest dynamic priority, whatever the slack. */
keel_status_t rival_unguarded_step(keel_scheduler_t *scheduler);

/** The paper's rule, read so that it works: FCFS first, then the highest dynamic priority of eq. 3
 * among the released tasks that fit the slack to the next real-time release, never any other. */
keel_status_t rival_paper_step(keel_scheduler_t *scheduler);

/** The paper's eq. 3 to the letter, with the task's own t_r: a task that is due never fits. */
keel_status_t rival_literal_step(keel_scheduler_t *scheduler);

/** The paper's eq. 3 without a release: the highest dynamic priority runs, due or not, if it fits
 * the slack; the task's next period begins when it starts. */
keel_status_t rival_ungated_step(keel_scheduler_t *scheduler);

#endif
