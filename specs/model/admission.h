/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file admission.h
 * @brief What the functions of keel/rtos/admission.h do.
 */
#ifndef MODEL_ADMISSION_H
#define MODEL_ADMISSION_H

#include "keel/internal/rtos/admission.h"

void model_admission_init(keel_admission_t *admission, uint32_t guard_us,
                          uint32_t utilisation_limit_ppm);
keel_status_t model_admission_admit(keel_admission_t *admission, uint32_t priority,
                                    uint32_t period_us, uint32_t budget_us);
keel_status_t model_admission_queue(keel_admission_t *admission, const keel_queue_t *queue);

#endif
