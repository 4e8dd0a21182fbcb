/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file stats.h
 * @brief What the functions of keel/rtos/stats.h do.
 */
#ifndef MODEL_STATS_H
#define MODEL_STATS_H

#include "keel/rtos/stats.h"

void model_stats_record(keel_stats_t *stats, uint32_t elapsed_us, uint32_t budget_us);

void model_stats_promote(keel_stats_t *stats);

uint64_t model_stats_mean_us(const keel_stats_t *stats);

#endif
