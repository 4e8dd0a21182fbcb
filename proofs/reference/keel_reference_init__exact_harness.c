// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --external-sat-solver cadical
// sources: src/flight/reference.c specs/model/reference.c
// covers: keel_reference_init are_expos is_expo are_dead_bands is_dead_band are_limits is_limit
// covers: curve_of model_reference_init
//
// Chosen configurations: four curves that are all different, dead bands that are round numbers and
// such that 1 / (1 - d) and its product with 1 - d are rounded down; bad ones. Wrong bodies are
// refuted here, for where floats differ z3 finds no example.
#include "../../specs/model/reference.h"
#include "reference_proof.h"

static keel_reference_config_t configuration(float dead_band)
{
    const keel_reference_config_t config = {
        .roll = {dead_band, 0.25f},
        .pitch = {0.25f, 1.0f},
        .yaw = {0.0625f, 0.5f},
        .climb = {0.125f, 0.0f},
        .limits = {2.0f, 3.0f, 5.0f, 7.0f, 1.0f, 11.0f, 13.0f, 17.0f}};

    return config;
}

/* The same as the model's, taken or not. */
static keel_reference_t made(const keel_reference_config_t *config, keel_status_t expected)
{
    keel_reference_t reference = nondet_reference();
    keel_reference_t model = reference;
    const keel_status_t status = keel_reference_init(&reference, config);

    __CPROVER_assert((status == expected) && (model_reference_init(&model, config) == expected),
                     "REF_001_model: taken or refused as the model says");
    __CPROVER_assert(reference_same(&reference, &model),
                     "REF_002_model: every field is what the model says");
    return reference;
}

static void is_made(float dead_band)
{
    const keel_reference_config_t config = configuration(dead_band);
    const keel_reference_t reference = made(&config, KEEL_OK);
    const keel_reference_setpoints_t zero = {0.0f};

    __CPROVER_assert(((1.0f - dead_band) * reference.roll.scale) >= 1.0f,
                     "REF_003_end: the end of the stick is reached");
    __CPROVER_assert(((1.0f - dead_band) * reference.roll.scale) <= 1.000001f,
                     "REF_003_scale: and not long before");
    __CPROVER_assert(reference.roll.linear == 0.75f, "REF_003_linear: 1 - e");
    __CPROVER_assert(setpoints_same(&reference.setpoints, &zero),
                     "REF_002_zero: as if the sticks were centred");
}

void keel_reference_init__exact_harness(void)
{
    const float dead_bands[11] = {
        KEEL_REFERENCE_DEAD_BAND_MIN, 0.01f, 0.03f, 0.05f, 0.07f, 0.1f, 0.13f, 0.2f, 0.3f, 0.45f,
        KEEL_REFERENCE_DEAD_BAND_MAX};
    keel_reference_config_t config = configuration(0.5f);

    for (unsigned i = 0u; i < 11u; i++) {
        is_made(dead_bands[i]);
    }
    config.limits.tilt = 1.6f;
    (void)made(&config, KEEL_ERR_LIMITS);
    config.yaw.expo = -0.1f;
    (void)made(&config, KEEL_ERR_GAIN);
}
