/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file position.h
 * @brief What the functions of keel/flight/position.h do.
 */
#ifndef MODEL_POSITION_H
#define MODEL_POSITION_H

#include "keel/flight/position.h"

keel_status_t model_position_init(keel_position_t *position, const keel_position_config_t *config);

keel_status_t model_position_set_origin(keel_position_t *position, int32_t latitude,
                                        int32_t longitude);

void model_position_step(keel_position_t *position, const keel_position_sample_t *sample);

#endif
