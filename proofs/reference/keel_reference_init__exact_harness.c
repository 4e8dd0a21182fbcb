// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/flight/reference.c specs/model/reference.c
// covers: keel_reference_init curve_of set_curve
//
// Chosen configurations: four curves that are all different, dead bands that are round numbers and
// such that 1 / (1 - d) and its product with 1 - d are rounded down; all limits as large as they
// may be; bad ones. Wrong bodies are refuted here, for where floats differ z3 finds no example.
#include "../../specs/model/reference.h"
#include "reference_proof.h"

#define POINTS 14u

/* The same with every limit as large as it may be. */
static keel_reference_config_t greatest(keel_reference_config_t config)
{
    const keel_reference_limits_t limits = {
        KEEL_REFERENCE_RATE_MAX,  KEEL_REFERENCE_RATE_MAX,  KEEL_REFERENCE_RATE_MAX,
        KEEL_REFERENCE_RATE_MAX,  KEEL_REFERENCE_TILT_MAX,  KEEL_REFERENCE_SPEED_MAX,
        KEEL_REFERENCE_SPEED_MAX, KEEL_REFERENCE_SPEED_MAX,
    };

    config.limits = limits;
    return config;
}

/* Four curves that are all different; the last three are refused. */
static keel_reference_config_t configuration(unsigned point)
{
    static const float dead_bands[POINTS] = {
        KEEL_REFERENCE_DEAD_BAND_MIN, 0.01f, 0.03f, 0.05f, 0.07f, 0.1f, 0.13f, 0.2f, 0.3f, 0.45f,
        KEEL_REFERENCE_DEAD_BAND_MAX, 0.1f,  0.1f,  0.6f};
    const keel_reference_config_t config = {
        .roll = {dead_bands[point], 0.25f},
        .pitch = {0.25f, 1.0f},
        .yaw = {0.0625f, (point == (POINTS - 3u)) ? -0.5f : 0.5f},
        .climb = {0.125f, 0.0f},
        .limits = {2.0f, 3.0f, 5.0f, 7.0f, (point == (POINTS - 2u)) ? 1.6f : 1.0f, 11.0f, 13.0f,
                   17.0f}};

    return (point == 0u) ? greatest(config) : config;
}

static void is_made(const keel_reference_t *reference, float dead_band)
{
    const keel_reference_setpoints_t zero = {0.0f};

    __CPROVER_assert(((1.0f - dead_band) * reference->roll.scale) >= 1.0f,
                     "REF_003_end: the end of the stick is reached");
    __CPROVER_assert(((1.0f - dead_band) * reference->roll.scale) <= 1.000001f,
                     "REF_003_scale: and not long before");
    __CPROVER_assert(reference->roll.linear == 0.75f, "REF_003_linear: 1 - e");
    __CPROVER_assert(setpoints_same(&reference->setpoints, &zero),
                     "REF_002_zero: as if the sticks were centred");
}

void keel_reference_init__exact_harness(void)
{
    for (unsigned i = 0u; i < POINTS; i++) {
        const keel_reference_config_t config = configuration(i);
        keel_reference_t reference = nondet_reference();
        keel_reference_t model = reference;
        const keel_status_t status = keel_reference_init(&reference, &config);

        __CPROVER_assert(status == model_reference_init(&model, &config),
                         "REF_001_model: taken or refused as the model says");
        __CPROVER_assert(reference_same(&reference, &model),
                         "REF_002_model: every field is what the model says");
        if (status == KEEL_OK) {
            is_made(&reference, config.roll.dead_band);
        }
    }
}
