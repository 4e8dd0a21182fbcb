// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/axis.c
// covers: keel_axis_step
//
// Any bit pattern for all that was measured and for the state: the contract of a step, clause by
// clause. One step of the induction that keeps every state a number and within its limits. What is
// no number is computed with and refused by the gates or clamped: overflow is not checked here, but
// for valid axes in keel_axis_step__valid_harness.
#include "axis_proof.h"

static uint32_t counted_to(uint32_t count, uint32_t most)
{
    return (count < most) ? (count + 1u) : most;
}

void keel_axis_step__any_harness(void)
{
    const keel_axis_sample_t sample = any_axis_sample();
    keel_axis_t axis = any_axis_at_all();
    const keel_axis_t before = axis;
    const keel_axis_config_t *const config = &before.config;
    bool fixed;
    bool begun;
    bool jumped;
    bool again;

    __CPROVER_assume(keel_axis_step_may(&axis));

    keel_axis_step(&axis, &sample);
    fixed = is_told(&axis, KEEL_AXIS_FIXED);
    begun = is_told(&axis, KEEL_AXIS_BEGUN);
    jumped = is_told(&axis, KEEL_AXIS_JUMPED);
    again = is_told(&axis, KEEL_AXIS_AGAIN);

    __CPROVER_assert(keel_axis_step_does(&axis, &sample), "AXI_006_does: what callers know");
    __CPROVER_assert(sample.has_fix || float_same(axis.bias, before.bias),
                     "AXI_004_bias: without a fix the bias stays");
    __CPROVER_assert(sample.has_fix || !is_told(&axis, KEEL_AXIS_BLIND) ||
                         !within(before.velocity, -KEEL_AXIS_VELOCITY_LIMIT,
                                 KEEL_AXIS_VELOCITY_LIMIT) ||
                         !within(before.step, -FLT_MAX, FLT_MAX) ||
                         (axis.velocity == before.velocity),
                     "AXI_004_velocity: without an acceleration, the velocity, too");
    __CPROVER_assert(is_told(&axis, KEEL_AXIS_BLIND) !=
                         (sample.has_acceleration &&
                          within(sample.acceleration, -KEEL_AXIS_ACCELERATION_LIMIT,
                                 KEEL_AXIS_ACCELERATION_LIMIT)),
                     "AXI_005_blind: no acceleration is told");
    __CPROVER_assert(within(axis.position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT),
                     "AXI_006_position: within its limit");
    __CPROVER_assert(within(axis.velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT),
                     "AXI_006_velocity: within its limit");
    __CPROVER_assert(!within(before.bias, -config->bias_limit, config->bias_limit) ||
                         within(axis.bias, -config->bias_limit, config->bias_limit),
                     "AXI_006_bias: within its limit");
    __CPROVER_assert(is_told(&axis, KEEL_AXIS_UNUSABLE) == (sample.has_fix && !counts(&sample)),
                     "AXI_007_unusable: a fix that does not count is told");
    __CPROVER_assert(counts(&sample) == (fixed || jumped), "AXI_008_counts: any other is judged");
    __CPROVER_assert(!(fixed && jumped), "AXI_008_either: taken or a jump");
    __CPROVER_assert(!begun || (fixed && (axis.position == sample.position) &&
                                (axis.velocity == (sample.has_velocity ? sample.velocity : 0.0f))),
                     "AXI_009_set: what is believed is taken over");
    __CPROVER_assert(!counts(&sample) || ((before.age + 1u) < config->lost_steps) || begun,
                     "AXI_009_lost: when nothing is known, a fix is believed");
    __CPROVER_assert(!begun || ((before.age + 1u) >= config->lost_steps) ||
                         (config->jump_fixes <= 1u) ||
                         (again && ((before.jumped + 1u) >= config->jump_fixes)),
                     "AXI_009_only: or after as many jumps, else not");
    __CPROVER_assert(axis.jumped == (fixed     ? 0u
                                     : !jumped ? before.jumped
                                     : again   ? (before.jumped + 1u)
                                               : 1u),
                     "AXI_009_jumped: jumps that agree are counted");
    __CPROVER_assert(!again || ((before.jumped > 0u) && (jumped || begun)),
                     "AXI_013_again: only behind a jump");
    __CPROVER_assert(float_same(axis.jump, jumped ? sample.position : before.jump),
                     "AXI_013_jump: where the last one was");
    __CPROVER_assert(!jumped || (axis.jumped < config->jump_fixes),
                     "AXI_009_believed: and no more than are believed");
    __CPROVER_assert(axis.age == (fixed ? 0u : counted_to(before.age, config->lost_steps)),
                     "AXI_010_age: steps since a fix was taken");
    __CPROVER_assert(!(jumped || is_told(&axis, KEEL_AXIS_UNUSABLE) || begun) ||
                         (axis.agreed == 0u),
                     "AXI_011_disagreed: what does not agree begins the count anew");
    __CPROVER_assert(!fixed || begun ||
                         (axis.agreed == counted_to(before.agreed, config->settle_fixes)),
                     "AXI_011_agreed: what agrees is counted");
    __CPROVER_assert(sample.has_fix || (axis.agreed == before.agreed),
                     "AXI_011_kept: without a fix the count stays");
    __CPROVER_assert((axis.quality == KEEL_AXIS_NONE) == (axis.age >= config->lost_steps),
                     "AXI_012_none: nothing is known when fixes are lost");
    __CPROVER_assert((axis.quality == KEEL_AXIS_GOOD) ==
                         ((axis.age < config->late_steps) && (axis.age < config->lost_steps) &&
                          (axis.agreed >= config->settle_fixes) &&
                          !is_told(&axis, KEEL_AXIS_BLIND)),
                     "AXI_012_good: good is what came lately, agrees, and was carried on");
    __CPROVER_assert(axis.quality <= KEEL_AXIS_GOOD, "AXI_012_one: one of three");
}
