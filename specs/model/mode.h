/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mode.h
 * @brief What the functions of keel/flight/mode.h do.
 */
#ifndef MODEL_MODE_H
#define MODEL_MODE_H

#include "keel/flight/mode.h"

keel_status_t model_mode_init(keel_mode_t *mode, const keel_mode_config_t *config);
void model_mode_step(keel_mode_t *mode, const keel_mode_input_t *input);

#endif
