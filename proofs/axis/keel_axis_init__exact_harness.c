// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/flight/axis.c specs/model/axis.c
// covers: keel_axis_init keel_axis_restart model_axis_restart
//
// Chosen configurations: one that is taken, and one for each reason to refuse. Wrong bodies are
// refuted here, for where floats differ z3 finds no example.
#include "../../specs/model/axis.h"
#include "axis_points.h"

static keel_axis_config_t configuration(unsigned point)
{
    keel_axis_config_t config = known_axis().config;

    switch (point) {
    case 1u:
        config.rate_hz = 5.0f;
        break;
    case 2u:
        config.rate_gain = 1.5f;
        break;
    case 3u:
        config.late_steps = 201u;
        break;
    default:
        break;
    }
    return config;
}

void keel_axis_init__exact_harness(void)
{
    for (unsigned point = 0u; point < 4u; point++) {
        const keel_axis_config_t config = configuration(point);
        keel_axis_t axis = any_axis_at_all();
        keel_axis_t model = axis;
        const keel_status_t status = keel_axis_init(&axis, &config);

        __CPROVER_assert(status == model_axis_init(&model, &config),
                         "AXI_001_exact: taken or refused as the model says");
        __CPROVER_assert(axis_same(&axis, &model),
                         "AXI_002_exact: every field is what the model says");
        __CPROVER_assert((status != KEEL_OK) ||
                             ((axis.step == 0.01f) && (axis.half_step == 0.005f)),
                         "AXI_002_step: the step is 1 / rate_hz");
    }
}
