// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 8 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_rest_init set_axes keel_calibration_rest_begin
// covers: model_calibration_rest_init model_calibration_rest_begin
//
// Chosen configurations: two that are taken, and one for each reason to refuse. Wrong bodies are
// refuted here, for where floats differ z3 finds no example.
#include "../../specs/model/calibration.h"
#include "calibration_points.h"

static keel_calibration_rest_config_t configuration(unsigned point)
{
    keel_calibration_rest_config_t config = known_rest().config;

    switch (point) {
    case 1u:
        config.samples = 65536u;
        break;
    case 2u:
        config.expected[1] = -33000.0f;
        break;
    case 3u:
        config.samples = 65537u;
        break;
    case 4u:
        config.samples = 0u;
        break;
    case 5u:
        config.spread = -1.0f;
        break;
    case 6u:
        config.limit = -1.0f;
        break;
    default:
        break;
    }
    return config;
}

void keel_calibration_rest_init__exact_harness(void)
{
    for (unsigned point = 0u; point < 7u; point++) {
        const keel_calibration_rest_config_t config = configuration(point);
        keel_calibration_rest_t rest = any_rest_at_all();
        keel_calibration_rest_t model = rest;
        const keel_status_t status = keel_calibration_rest_init(&rest, &config);

        __CPROVER_assert(status == model_calibration_rest_init(&model, &config),
                         "CAL_001_exact: taken or refused as the model says");
        __CPROVER_assert(rest_same(&rest, &model),
                         "CAL_002_exact: every field is what the model says");
        __CPROVER_assert((status != KEEL_OK) ||
                             (rest.per_sample == ((point == 0u) ? 0.25f : 0x1p-16f)),
                         "CAL_002_part: what a sample is of the mean");
    }
}
