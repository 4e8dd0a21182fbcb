/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file deviation.h
 * @brief What the functions of keel/rtos/deviation.h do.
 */
#ifndef MODEL_DEVIATION_H
#define MODEL_DEVIATION_H

#include "keel/rtos/deviation.h"

keel_status_t model_deviation_add(keel_deviation_t *deviation, uint64_t start_us,
                                  uint32_t period_us);

uint64_t model_deviation_variance_us2(const keel_deviation_t *deviation);

#endif
