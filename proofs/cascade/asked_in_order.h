/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file asked_in_order.h
 * @brief What the velocity stage asks of its axes, one after another, where what they do is
 *        unknown: as in asked_axes.h, but the model's axis does anything at all, and nothing is
 *        found by its address, so that a solver for floats has terms to compare and nothing else.
 */
#ifndef ASKED_IN_ORDER_H
#define ASKED_IN_ORDER_H

#include "cascade_proof.h"

#define ASKED_MOST 3u

typedef struct step_asked {
    keel_cascade_input_t input;
    keel_cascade_axis_t before;
    keel_cascade_axis_t after;
} step_asked_t;

static step_asked_t step_asked[ASKED_MOST];
static uint32_t asked_for;
static uint32_t told;
static keel_cascade_t cascade;
static keel_cascade_t model;

void model_cascade_axis_step(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    step_asked_t *const one = &step_asked[asked_for];

    __CPROVER_assume(asked_for < ASKED_MOST);
    one->input = *input;
    one->before = *axis;
    one->after = any_axis();
    *axis = one->after;
    asked_for++;
}

void keel_cascade_axis_step_stand_in(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    const step_asked_t *const one = &step_asked[told];

    __CPROVER_assert(told < asked_for, "CAS_004_steps: as many axes as the model steps");
    __CPROVER_assert(keel_cascade_axis_step_may(axis), "precondition: keel_cascade_axis_step");
    __CPROVER_assert(axis_same(axis, &one->before), "CAS_004_state: in the same state");
    __CPROVER_assert(input_same(input, &one->input), "CAS_004_input: told the same");
    *axis = one->after;
    __CPROVER_assume(keel_cascade_axis_step_does(axis, &one->before, input));
    told++;
}

#endif
