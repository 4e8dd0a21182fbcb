// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c specs/model/cascade.c
// covers: keel_cascade_enter axes_flown is_flown command_nothing model_cascade_enter axes_of
//
// Any cascade at all, and any mode.
#include "cascade_proof.h"

void keel_cascade_enter_harness(void)
{
    const uint8_t mode = nondet_u8();
    const uint32_t axis = nondet_uint();
    keel_cascade_t cascade;
    keel_cascade_t before;
    keel_cascade_t model;

    __CPROVER_assume(axis < AXES);
    any_cascade(&cascade);
    before = cascade;
    model = cascade;
    model_cascade_enter(&model, mode);

    keel_cascade_enter(&cascade, mode);

    __CPROVER_assert(cascade_same(&cascade, &model),
                     "CAS_003_model: every field is what the model says");
    __CPROVER_assert(!cascade.axis[axis].running ||
                         (before.axis[axis].running && (((cascade.axes >> axis) & 1u) != 0u)),
                     "CAS_003_stopped: what the mode does not fly stops");
    __CPROVER_assert((cascade.axes != 0u) || command_valid_here(&cascade.command),
                     "CAS_003_none: nothing is commanded");
}
