// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/flight/mixer.c
// covers: keel_mixer_step stop_motors set_tilt fit_tilt fit_thrust put_out_all put_out_part
// covers: part_of_yaw kept_yaw
//
// What gives way in which order, by hand: a quadcopter's X whose outputs are from 1/4 to 3/4, with
// commands that lead to exact sums.
#include "mixer_proof.h"

#define CASES 14u

typedef struct example {
    keel_mixer_command_t command;
    float output[4];
    uint8_t limited;
    float yaw_share;
} example_t;

static const example_t examples[CASES] = {
    /* Upwards there is 1/8, half of the yaw; beside a roll; with the other sign. */
    {{0.0f, 0.0f, 0.25f, 0.75f}, {0.75f, 0.5f, 0.75f, 0.5f}, KEEL_MIXER_YAW},
    {{0.125f, 0.0f, 0.25f, 0.5f}, {0.5f, 0.25f, 0.75f, 0.5f}, KEEL_MIXER_YAW},
    {{0.125f, 0.0f, -0.25f, 0.5f}, {0.25f, 0.5f, 0.5f, 0.75f}, KEEL_MIXER_YAW},
    /* Thrust gives way to roll and pitch, but not to yaw. */
    {{0.125f, 0.0f, 0.0f, 0.0f}, {0.25f, 0.25f, 0.5f, 0.5f}, KEEL_MIXER_RAISED},
    {{0.0f, 0.125f, 0.0f, 1.0f}, {0.75f, 0.5f, 0.5f, 0.75f}, KEEL_MIXER_LOWERED},
    {{0.0f, 0.0f, 0.5f, 1.0f}, {0.75f, 0.75f, 0.75f, 0.75f}, KEEL_MIXER_YAW},
    /* Roll and pitch need 2, of 1/2 there are: a quarter of each, whatever the thrust. */
    {{0.75f, 0.25f, 0.0f, 0.5f}, {0.375f, 0.25f, 0.625f, 0.75f}, KEEL_MIXER_TILT},
    {{0.75f, 0.25f, 0.5f, 1.0f},
     {0.375f, 0.25f, 0.625f, 0.75f},
     KEEL_MIXER_TILT | KEEL_MIXER_LOWERED | KEEL_MIXER_YAW},
    {{0.75f, 0.25f, 0.5f, 0.0f},
     {0.375f, 0.25f, 0.625f, 0.75f},
     KEEL_MIXER_TILT | KEEL_MIXER_RAISED | KEEL_MIXER_YAW},
    /* Exactly what there is. */
    {{0.1875f, 0.0625f, 0.0f, 0.5f}, {0.375f, 0.25f, 0.625f, 0.75f}, 0u},
    /* At full thrust 1/8 of a yaw of 1/4 is kept; at none, all of one of 1/16 the other way; beside
     * a roll that leaves 1/8 of the span, half of that. */
    {{0.0f, 0.0f, 0.25f, 1.0f},
     {0.75f, 0.5f, 0.75f, 0.5f},
     KEEL_MIXER_LOWERED | KEEL_MIXER_YAW,
     0.125f},
    {{0.0f, 0.0f, -0.0625f, 0.0f}, {0.25f, 0.375f, 0.25f, 0.375f}, KEEL_MIXER_RAISED, 0.125f},
    {{0.1875f, 0.0f, 0.25f, 1.0f},
     {0.375f, 0.25f, 0.75f, 0.625f},
     KEEL_MIXER_LOWERED | KEEL_MIXER_YAW,
     0.125f},
    /* Disarmed. */
    {{0.0f, 0.0f, 0.25f, 0.75f}, {0.0f, 0.0f, 0.0f, 0.0f}, 0u},
};

static bool as_expected(const keel_mixer_t *mixer, const example_t *expected)
{
    bool same = mixer->limited == expected->limited;

    for (uint32_t i = 0u; i < 4u; i++) {
        same = same && (mixer->output[i] == expected->output[i]);
    }
    return same;
}

void keel_mixer_step__exact_harness(void)
{
    for (uint32_t n = 0u; n < CASES; n++) {
        keel_mixer_t mixer = {.config = {keel_mixer_quad_x, 0.25f, 0.75f, examples[n].yaw_share},
                              .output = {0.5f}};

        keel_mixer_step(&mixer, &examples[n].command, n < (CASES - 1u));

        if (n < 3u) {
            __CPROVER_assert(as_expected(&mixer, &examples[n]), "MIX_008_part: what fits of yaw");
        } else if (n < 6u) {
            __CPROVER_assert(as_expected(&mixer, &examples[n]), "MIX_007_moved: thrust gives way");
        } else if (n < 10u) {
            __CPROVER_assert(as_expected(&mixer, &examples[n]), "MIX_006_ratio: one factor");
        } else if (n < (CASES - 1u)) {
            __CPROVER_assert(as_expected(&mixer, &examples[n]), "MIX_009_share: a share of yaw");
        } else {
            __CPROVER_assert(as_expected(&mixer, &examples[n]), "MIX_003_stopped: nothing turns");
        }
    }
}
