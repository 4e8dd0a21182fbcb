// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/axis.c specs/model/axis.c
// covers: keel_axis_init axis_gains_fit axis_limits_fit keel_axis_restart
// covers: model_axis_init model_axis_restart axis_config_taken lies_in
//
// Any bit pattern for all of a configuration: the same as the model's, bit for bit. The solver sees
// that both compute the same only where nothing else is asked: overflow and NaN are checked in
// keel_axis_init__valid_harness and keel_axis_init__exact_harness.
#include "../../specs/model/axis.h"
#include "axis_proof.h"

void keel_axis_init_harness(void)
{
    keel_axis_config_t config = nondet_axis_config();
    const keel_axis_config_t before = config;
    keel_axis_t axis = any_axis_at_all();
    keel_axis_t model = axis;
    const keel_status_t status = keel_axis_init(&axis, &config);

    __CPROVER_assert(status == model_axis_init(&model, &before),
                     "AXI_001_model: taken or refused as the model says");
    __CPROVER_assert(axis_same(&axis, &model), "AXI_002_model: every field is what the model says");
    __CPROVER_assert(axis_config_same(&config, &before),
                     "AXI_002_frame: the configuration is not written");
}
