/**
 * @file load.h
 * @brief What the functions of keel/rtos/load.h do.
 */
#ifndef MODEL_LOAD_H
#define MODEL_LOAD_H

#include "keel/rtos/load.h"

void model_stats_record(keel_stats_t *stats, uint32_t elapsed_us, uint32_t budget_us);

void model_stats_promote(keel_stats_t *stats);

uint64_t model_stats_mean_us(const keel_stats_t *stats);

void model_load_begin(keel_load_t *load, uint64_t now_us, uint64_t busy_us);

uint32_t model_load_milli_percent(const keel_load_t *load, uint64_t now_us, uint64_t busy_us);

keel_status_t model_deviation_add(keel_deviation_t *deviation, uint64_t start_us,
                                  uint32_t period_us);

uint64_t model_deviation_variance_us2(const keel_deviation_t *deviation);

#endif
