// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_field_init field_range_fits field_limits_fit
// covers: keel_calibration_field_begin model_calibration_field_init model_calibration_field_begin
// covers: set_axes lies_in
//
// Any bit pattern for all of a configuration: the same as the model's, bit for bit, and the
// contract of init, clause by clause; what is made is valid, as every step keeps it.
#include "../../specs/model/calibration.h"
#include "../common/unchanged.h"
#include "calibration_proof.h"

void keel_calibration_field_init_harness(void)
{
    keel_calibration_field_config_t config = nondet_field_config();
    const keel_calibration_field_config_t before = config;
    keel_calibration_field_t field = any_field_at_all();
    const keel_calibration_field_t old = field;
    keel_calibration_field_t model = field;
    const keel_status_t status = keel_calibration_field_init(&field, &config);

    __CPROVER_assert(status == model_calibration_field_init(&model, &before),
                     "CAL_008_model: taken or refused as the model says");
    __CPROVER_assert(field_same(&field, &model),
                     "CAL_009_made: every field is what the model says");
    __CPROVER_assert(field_config_same(&config, &before),
                     "CAL_008_frame: the configuration is not written");
    __CPROVER_assert(field_range(&config) || (status == KEEL_ERR_VALUE),
                     "CAL_008_range: a range that is none is refused");
    __CPROVER_assert(!field_range(&config) || field_limits(&config) || (status == KEEL_ERR_LIMITS),
                     "CAL_008_limits: then the other numbers");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&field, &old, sizeof(field)),
                     "CAL_008_kept: a refusal changes nothing");
    __CPROVER_assert(!field_range(&config) || !field_limits(&config) ||
                         ((status == KEEL_OK) && field_config_same(&field.config, &config) &&
                          field_valid(&field) && field_finite(&field.config)),
                     "CAL_008_taken: all others are taken, and what is made is valid");
    __CPROVER_assert((status != KEEL_OK) || field_valid(&field),
                     "CAL_013_new: and so within bounds");
    __CPROVER_assert((status != KEEL_OK) || ((field.state == KEEL_CALIBRATION_IDLE) &&
                                             three_within(field.offset, 0.0f, 0.0f)),
                     "CAL_009_idle: nothing is begun, nothing taken off");
}
