/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sizes.c
 * @brief Objects as large as the kernel's own: tools/keel bench reads their sizes from the symbols,
 *        so that the target's compiler answers without the target.
 */
#include "keel/rtos/scheduler.h"

char bench_size_config[sizeof(keel_task_config_t)];
char bench_size_scheduler[sizeof(keel_scheduler_t)];
