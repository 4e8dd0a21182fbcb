/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file load.h
 * @brief What the functions of keel/rtos/load.h do.
 */
#ifndef MODEL_LOAD_H
#define MODEL_LOAD_H

#include "keel/rtos/load.h"

void model_load_begin(keel_load_t *load, uint64_t now_us, uint64_t busy_us);

uint32_t model_load_ppm(const keel_load_t *load, uint64_t now_us, uint64_t busy_us);

#endif
