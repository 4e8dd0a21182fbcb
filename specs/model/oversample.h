/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file oversample.h
 * @brief What the functions of keel/middleware/oversample.h do.
 */
#ifndef MODEL_OVERSAMPLE_H
#define MODEL_OVERSAMPLE_H

#include "keel/middleware/oversample.h"

keel_status_t model_oversample_init(keel_oversample_t *oversample, uint16_t factor);
keel_status_t model_oversample_add(keel_oversample_t *oversample, float value);
keel_status_t model_oversample_take(keel_oversample_t *oversample, float *mean);

#endif
