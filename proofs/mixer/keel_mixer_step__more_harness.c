// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 13 --external-sat-solver cadical
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_step set_tilt put_out_part
//
// Chosen commands to five, seven and eight motors, each with factors of its own: the same as the
// model's, and no operation overflows or gives a NaN: that is shown for these commands alone. Every
// command is dealt with in keel_mixer_step__three_harness and its like; wrong bodies that go wrong
// beyond four motors are refuted here.
#include "mixer_proof.h"

#define POINTS 4u

/* The last motor's roll and pitch, of all the most; its yaw, which fits least; both. The last time
 * disarmed. */
static const keel_mixer_command_t points[POINTS] = {
    {0.31f, 0.17f, 0.0f, 0.5f},
    {0.02f, -0.01f, 0.7f, 0.6f},
    {0.01f, 0.03f, -0.9f, 0.35f},
    {-0.9f, 0.6f, 0.8f, 0.2f},
};

static keel_mixer_t mixer_of(uint8_t motors)
{
    keel_mixer_t mixer = four_motors(0.055f);

    mixer.config.geometry.motors = motors;
    for (uint32_t i = 4u; i < KEEL_MIXER_MOTORS; i++) {
        mixer.config.geometry.motor[i].roll = (i < motors) ? (0.95f - (0.01f * (float)i)) : 0.0f;
        mixer.config.geometry.motor[i].pitch = (i < motors) ? (-0.9f + (0.01f * (float)i)) : 0.0f;
        mixer.config.geometry.motor[i].yaw = (((i % 2u) == 0u) ? 1.0f : -1.0f) *
                                             (0.6f + (0.05f * (float)i));
        mixer.output[i] = 0.0f;
    }
    return mixer;
}

void keel_mixer_step__more_harness(void)
{
    for (uint32_t n = 0u; n < (3u * POINTS); n++) {
        const uint32_t kind = n % 3u;
        keel_mixer_t mixer = mixer_of((kind == 0u) ? 5u : ((kind == 1u) ? 7u : 8u));
        keel_mixer_t model = mixer;
        const bool armed = n < ((3u * POINTS) - 1u);

        model_mixer_step(&model, &points[n / 3u], armed);

        keel_mixer_step(&mixer, &points[n / 3u], armed);

        __CPROVER_assert(mixer_same(&mixer, &model),
                         "MIX_004_model: outputs and flags are what the model says");
        __CPROVER_assert(mixer_valid_here(&mixer), "MIX_004_valid: the mixer stays valid");
    }
}
