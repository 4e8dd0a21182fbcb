// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_field_step widen_range are_within one_up
// covers: model_calibration_field_step all_lie_in lies_in counted_once
//
// Any calibration at all, any bit pattern for what was measured: the same as the model's, bit for
// bit; what was seen only widens, and a valid calibration stays valid.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

static float lower(float seen, float value, bool heeds)
{
    return (heeds && (value < seen)) ? value : seen;
}

static float higher(float seen, float value, bool heeds)
{
    return (heeds && (value > seen)) ? value : seen;
}

void keel_calibration_field_step_harness(void)
{
    keel_calibration_vector_t sample = nondet_vector();
    const keel_calibration_vector_t said = sample;
    keel_calibration_field_t field = any_field_at_all();
    const keel_calibration_field_t before = field;
    keel_calibration_field_t model = field;
    const bool valid = field_valid(&field);
    const bool collects = field.state == KEEL_CALIBRATION_COLLECTING;
    const bool sane = three_within(said.axis, before.config.lowest, before.config.highest);
    const bool heeds = collects && sane;

    __CPROVER_assume(field_finite(&field.config));

    keel_calibration_field_step(&field, sample.axis);
    model_calibration_field_step(&model, said.axis);

    __CPROVER_assert(field_same(&field, &model),
                     "CAL_010_model: every field is what the model says");
    __CPROVER_assert(three_same(sample.axis, said.axis),
                     "CAL_010_frame: the sample is not written");
    __CPROVER_assert(collects || field_same(&field, &before),
                     "CAL_010_only: nothing happens when nothing was begun");
    __CPROVER_assert(!collects || sane || (field.dropped == up_to_end(before.dropped)),
                     "CAL_010_dropped: what cannot be is dropped, and counted");
    __CPROVER_assert(!heeds || (field.dropped == before.dropped), "CAL_010_heeded: nothing else");
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        __CPROVER_assert(float_same(field.lowest[k], lower(before.lowest[k], said.axis[k], heeds)),
                         "CAL_010_lowest: the lower one");
        __CPROVER_assert(float_same(field.highest[k],
                                    higher(before.highest[k], said.axis[k], heeds)),
                         "CAL_010_highest: the higher one");
    }
    __CPROVER_assert(!valid || field_valid(&field), "CAL_013_field: a step keeps it valid");
}
