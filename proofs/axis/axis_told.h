/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file axis_told.h
 * @brief A step of an axis that comes to anything that its contract allows: what the model asks of
 *        one is recorded, the code must ask the same of the same axis, and is told the same.
 */
#ifndef AXIS_TOLD_H
#define AXIS_TOLD_H

#include "axis_proof.h"

#include <stdint.h>

/* No unit has more axes. */
#define AXES_TOLD 2u

/* A step of an axis: what was asked, and what came of it. */
typedef struct axis_step {
    keel_axis_t before;
    keel_axis_t after;
    keel_axis_sample_t sample;
} axis_step_t;

static axis_step_t axis_step[AXES_TOLD];
static uint32_t asked;
static uint32_t told;

void model_axis_step(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    axis_step_t *const one = &axis_step[asked];

    __CPROVER_assume(asked < AXES_TOLD);
    one->before = *axis;
    one->sample = *sample;
    one->after = any_axis_at_all();
    one->after.config = axis->config;
    one->after.step = axis->step;
    one->after.half_step = axis->half_step;
    *axis = one->after;
    asked++;
}

void keel_axis_step_stand_in(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    const axis_step_t *const one = &axis_step[told];

    __CPROVER_assert(told < asked, "AXI_004_steps: as many steps as the model makes");
    __CPROVER_assert(keel_axis_step_may(axis), "precondition: keel_axis_step");
    __CPROVER_assert(axis_same(axis, &one->before), "AXI_004_state: of the same axis");
    __CPROVER_assert(axis_sample_same(sample, &one->sample),
                     "AXI_004_sample: the same was measured");
    *axis = one->after;
    __CPROVER_assume(keel_axis_step_does(axis, sample));
    told++;
}

#endif
