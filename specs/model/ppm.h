/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ppm.h
 * @brief What the functions of keel/middleware/ppm.h do.
 */
#ifndef MODEL_PPM_H
#define MODEL_PPM_H

#include "keel/middleware/ppm.h"

keel_status_t model_ppm_init(keel_ppm_t *ppm, const keel_ppm_config_t *config);
bool model_ppm_take(keel_ppm_t *ppm, uint32_t elapsed_us);
void model_ppm_pass_time(keel_ppm_t *ppm, uint32_t elapsed_us);
bool model_ppm_is_lost(const keel_ppm_t *ppm);

#endif
