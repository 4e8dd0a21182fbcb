/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file priority.h
 * @brief What the functions of keel/rtos/priority.h do.
 */
#ifndef MODEL_PRIORITY_H
#define MODEL_PRIORITY_H

#include "keel/rtos/priority.h"

bool model_priority_promoted(uint32_t sp, uint64_t age_us, uint32_t period_us);

uint32_t model_priority_dynamic(uint32_t sp, uint64_t age_us, uint32_t period_us);

uint64_t model_priority_promotion_age_us(uint32_t sp, uint32_t period_us);

#endif
