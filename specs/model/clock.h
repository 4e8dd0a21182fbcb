/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file clock.h
 * @brief What the functions of keel/rtos/clock.h do.
 */
#ifndef MODEL_CLOCK_H
#define MODEL_CLOCK_H

#include "keel/rtos/clock.h"

uint32_t model_clock_elapsed_us(uint32_t from_us, uint32_t to_us);

void model_clock_init(keel_clock_t *clock, uint32_t raw_us);

keel_status_t model_clock_advance(keel_clock_t *clock, uint32_t raw_us);

#endif
