/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file spread.h
 * @brief What the function of keel/rtos/spread.h does.
 */
#ifndef MODEL_SPREAD_H
#define MODEL_SPREAD_H

#include "keel/rtos/spread.h"

keel_status_t model_scheduler_spread(keel_scheduler_t *scheduler, uint32_t *crowded);

#endif
