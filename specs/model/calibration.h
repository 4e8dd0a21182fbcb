/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file calibration.h
 * @brief What the functions of keel/flight/calibration.h do.
 */
#ifndef MODEL_CALIBRATION_H
#define MODEL_CALIBRATION_H

#include "keel/flight/calibration.h"

keel_status_t model_calibration_rest_init(keel_calibration_rest_t *rest,
                                          const keel_calibration_rest_config_t *config);

void model_calibration_rest_begin(keel_calibration_rest_t *rest);

void model_calibration_rest_step(keel_calibration_rest_t *rest,
                                 const float sample[KEEL_CALIBRATION_AXES]);

keel_status_t model_calibration_field_init(keel_calibration_field_t *field,
                                           const keel_calibration_field_config_t *config);

void model_calibration_field_begin(keel_calibration_field_t *field);

void model_calibration_field_step(keel_calibration_field_t *field,
                                  const float sample[KEEL_CALIBRATION_AXES]);

keel_calibration_verdict_t model_calibration_field_axis(const keel_calibration_field_t *field,
                                                        uint32_t axis);

keel_status_t model_calibration_field_finish(keel_calibration_field_t *field);

void model_calibration_apply(const float offset[KEEL_CALIBRATION_AXES],
                             const float raw[KEEL_CALIBRATION_AXES],
                             keel_calibration_vector_t *out);

void model_calibration_correct(const keel_calibration_correction_t *correction,
                               const float raw[KEEL_CALIBRATION_AXES],
                               keel_calibration_vector_t *out);

uint32_t model_calibration_side(const float mean[KEEL_CALIBRATION_AXES], float least, float most);

keel_status_t model_calibration_six(const keel_calibration_sides_t *sides,
                                    keel_calibration_correction_t *correction);

void model_calibration_turn(const keel_calibration_rotation_t *turn,
                            const float raw[KEEL_CALIBRATION_AXES], keel_calibration_vector_t *out);

#endif
