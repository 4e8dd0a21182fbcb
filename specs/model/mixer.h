/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mixer.h
 * @brief What the functions of keel/flight/mixer.h do.
 */
#ifndef MODEL_MIXER_H
#define MODEL_MIXER_H

#include "keel/flight/mixer.h"

keel_status_t model_mixer_check(const keel_mixer_config_t *config);

keel_status_t model_mixer_init(keel_mixer_t *mixer, const keel_mixer_config_t *config);

void model_mixer_step(keel_mixer_t *mixer, const keel_mixer_command_t *command, bool armed);

#endif
