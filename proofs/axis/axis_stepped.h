/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file axis_stepped.h
 * @brief A step of an axis that comes to anything that its contract allows.
 */
#ifndef AXIS_STEPPED_H
#define AXIS_STEPPED_H

#include "axis_proof.h"

void keel_axis_step_stand_in(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    keel_axis_t after = any_axis_at_all();

    __CPROVER_assert(keel_axis_step_may(axis), "precondition: keel_axis_step");
    after.config = axis->config;
    after.step = axis->step;
    after.half_step = axis->half_step;
    __CPROVER_assume(keel_axis_step_does(&after, sample));
    *axis = after;
}

#endif
