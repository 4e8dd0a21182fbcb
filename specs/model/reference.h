/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file reference.h
 * @brief What the functions of keel/flight/reference.h do.
 */
#ifndef MODEL_REFERENCE_H
#define MODEL_REFERENCE_H

#include "keel/flight/reference.h"

keel_status_t model_reference_init(keel_reference_t *reference,
                                   const keel_reference_config_t *config);

keel_status_t model_reference_step(keel_reference_t *reference,
                                   const keel_reference_sticks_t *sticks);

#endif
