/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file asked_axes.h
 * @brief What a stage asks of its axes, where what they do is unknown: the model's axis does
 *        anything that the contract allows; the code must ask the same of the same axis in the same
 *        state, and is told the same.
 */
#ifndef ASKED_AXES_H
#define ASKED_AXES_H

#include "cascade_proof.h"

typedef struct asked {
    keel_cascade_input_t input;
    keel_cascade_axis_t before;
    keel_cascade_axis_t after;
} asked_t;

static asked_t asked_of[AXES];
static keel_cascade_t cascade;
static keel_cascade_t model;

static uint32_t index_of(const keel_cascade_t *whole, const keel_cascade_axis_t *axis)
{
    uint32_t index = 0u;

    for (uint32_t i = 0u; i < AXES; i++) {
        index = (axis == &whole->axis[i]) ? i : index;
    }
    return index;
}

void model_cascade_axis_step(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    asked_t *const ask = &asked_of[index_of(&model, axis)];

    ask->input = *input;
    ask->before = *axis;
    ask->after = any_axis();
    __CPROVER_assume(keel_cascade_axis_step_does(&ask->after, axis, input));
    *axis = ask->after;
}

void keel_cascade_axis_step_stand_in(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    const asked_t *const ask = &asked_of[index_of(&cascade, axis)];

    __CPROVER_assert(keel_cascade_axis_step_may(axis), "precondition: keel_cascade_axis_step");
    __CPROVER_assert(axis_same(axis, &ask->before), "CAS_004_state: in the same state");
    __CPROVER_assert(input_same(input, &ask->input), "CAS_004_input: told the same");
    *axis = ask->after;
    __CPROVER_assume(keel_cascade_axis_step_does(axis, &ask->before, input));
}

/* Any valid cascade, and the model's, which is the same. */
static void begin_alike(void)
{
    any_cascade(&cascade);
    __CPROVER_assume(cascade_valid_here(&cascade));
    model = cascade;
}

#endif
