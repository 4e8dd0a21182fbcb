// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/flight/mode.c
// checks: assertions
// covers: keel_mode_step look_at_facts settle_facts read_frame forget_stale_facts
//
// What the pilot says counts only from the third frame in a row that says it, and after its time:
// by induction, with a count of these frames and the time since the first beside the machine. Any
// valid machine, any of the pilot's facts, any input.
#include "mode_proof.h"

/* Frames in a row, up to 3, that have said so, and how long ago the first was. */
typedef struct witness {
    uint8_t frames;
    uint32_t us;
} witness_t;

static bool witnessed(const keel_mode_t *mode, uint32_t i, const witness_t *witness)
{
    const bool seen = is_set(mode->seen, 1u << i);
    const bool counts = is_set(mode->settled, 1u << i);

    return (seen == (witness->frames > 0u)) && (witness->frames <= 3u) &&
           (!counts || ((witness->frames == 3u) && (witness->us >= mode->settle_us[i]))) &&
           (!seen || (mode->silence_us < mode->config.loss_us)) &&
           (!seen || counts || (mode->held_us[i] <= witness->us)) &&
           ((witness->frames != 1u) || (mode->held_us[i] <= mode->silence_us));
}

/* Whether a frame says so. */
static bool said(const keel_mode_t *before, const keel_mode_input_t *input, uint32_t i)
{
    const uint32_t both = KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_ARM_SWITCH_OFF;
    const bool neither = (input->facts & both) == both;

    if ((1u << i) == KEEL_MODE_SWITCH_UNMOVED) {
        return input->asked == before->rests_at;
    }
    return is_set(input->facts, 1u << i) && (!is_set(both, 1u << i) || !neither);
}

void keel_mode_step__frames_harness(void)
{
    const keel_mode_input_t input = nondet_mode_input();
    const uint32_t i = nondet_u32();
    keel_mode_t mode = any_mode();
    witness_t witness = {nondet_u8(), nondet_u32()};
    bool frame;
    bool broken;
    bool says;

    __CPROVER_assume(i < 6u);
    __CPROVER_assume(valid_here(&mode) && witnessed(&mode, i, &witness));
    frame = frame_here(&input);
    broken = sum_here(mode.silence_us, input.elapsed_us) >= mode.config.loss_us;
    says = frame && said(&mode, &input, i);
    witness.frames = (broken || (frame && !says)) ? 0u : witness.frames;
    witness.us = (witness.frames == 0u) ? 0u : sum_here(witness.us, input.elapsed_us);
    witness.frames = (says && (witness.frames < 3u)) ? (witness.frames + 1u) : witness.frames;

    keel_mode_step(&mode, &input);

    __CPROVER_assert(witnessed(&mode, i, &witness),
                     "MOD_003_frames: three frames in a row, and the whole time");
    __CPROVER_assert(is_set(mode.seen, 1u << i) == (witness.frames > 0u),
                     "MOD_003_seen: the last frame said so, and is not too old");
    __CPROVER_assert(!is_set(mode.settled, 1u << i) || (witness.frames == 3u),
                     "MOD_003_third: no fact of one or two frames counts");
    __CPROVER_assert(!is_set(mode.settled, 1u << i) || (witness.us >= mode.settle_us[i]),
                     "MOD_003_time: none counts before its time");
}
