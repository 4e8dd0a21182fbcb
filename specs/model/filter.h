/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file filter.h
 * @brief What the functions of keel/flight/filter.h do.
 */
#ifndef MODEL_FILTER_H
#define MODEL_FILTER_H

#include "keel/flight/filter.h"

keel_status_t model_filter_init(keel_filter_t *filter, float rate_hz, float cutoff_hz);

keel_status_t model_filter_reset(keel_filter_t *filter, float value);

keel_status_t model_filter_step(keel_filter_t *filter, float input);

#endif
