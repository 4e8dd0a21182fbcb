// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// sources: specs/model/cascade.c specs/model/cascade_parts.c specs/model/pid.c specs/model/filter.c
// covers: keel_cascade_init model_cascade_init make_axis command_nothing
//
// Chosen configurations: one that is good, and one with two axes that are not. All of them are
// dealt with in keel_cascade_init_harness; wrong bodies are refuted here.
#include "cascade_points.h"

static keel_cascade_config_t config;
static keel_cascade_t cascade;
static keel_cascade_t model;

void keel_cascade_init__points_harness(void)
{
    for (uint32_t bad = 0u; bad < 2u; bad++) {
        keel_status_t status;

        any_cascade(&cascade);
        model = cascade;
        good_config(&config);
        if (bad == 1u) {
            config.pid[KEEL_CASCADE_CLIMB].gains.kp = -1.0f;
            config.reach[KEEL_CASCADE_HEIGHT] = -1.0f;
        }

        status = keel_cascade_init(&cascade, &config);

        __CPROVER_assert(status == model_cascade_init(&model, &config),
                         "CAS_002_taken: taken or refused as the model says");
        __CPROVER_assert(cascade_same(&cascade, &model),
                         "CAS_002_points: every field is what the model says");
        __CPROVER_assert(status == ((bad == 1u) ? KEEL_ERR_GAIN : KEEL_OK),
                         "CAS_002_first: the first axis that is not good is told");
    }
}
