// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/axis.c specs/model/axis.c
// covers: keel_axis_restart model_axis_restart
//
// Any axis at all: the same as the model's, bit for bit; one with a valid configuration is valid
// after it.
#include "../../specs/model/axis.h"
#include "axis_proof.h"

void keel_axis_restart_harness(void)
{
    keel_axis_t axis = any_axis_at_all();
    keel_axis_t model = axis;
    const bool valid = axis_valid(&axis);

    keel_axis_restart(&axis);
    model_axis_restart(&model);

    __CPROVER_assert(axis_same(&axis, &model), "AXI_003_model: every field is what the model says");
    __CPROVER_assert(!valid || axis_valid(&axis), "AXI_003_valid: it stays valid");
}
