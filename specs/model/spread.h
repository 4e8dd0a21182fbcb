/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file spread.h
 * @brief What the function of keel/rtos/spread.h does.
 */
#ifndef MODEL_SPREAD_H
#define MODEL_SPREAD_H

#include "keel/rtos/spread.h"

uint32_t model_spread_divisor(uint32_t a, uint32_t b);
keel_status_t model_scheduler_spread(keel_scheduler_t *scheduler, uint32_t *crowded);

#endif
