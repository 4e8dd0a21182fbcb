// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/ibus.c src/middleware/framing.c specs/model/ibus.c specs/model/framing.c
// replaces: keel_framing_drop
// covers: keel_ibus_take keel_ibus_pass_time word_of extra_of channel_us adds_up all_in_range judges
// covers: take_words take_held
// covers: model_ibus_take model_ibus_pass_time upper_bits model_ibus_channel sum_right range_right
// covers: words_said reason_counted
//
// Any valid decoder, any byte, any time: the same as the model's in every field.
#include "ibus_proof.h"

void keel_ibus_take_harness(void)
{
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);
    keel_ibus_t ibus = any_ibus();
    keel_ibus_t model = ibus;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    bool expected;
    bool right;

    __CPROVER_assume(ibus_valid_here(&ibus));
    expected = model_ibus_take(&model, byte, elapsed_us);

    right = keel_ibus_take(&ibus, byte, elapsed_us);

    __CPROVER_assert(right == expected, "IBU_004_model: a frame ends where the model says");
    __CPROVER_assert(ibus_channels_alike(ibus.channel, model.channel),
                     "IBU_005_model: what it says");
    __CPROVER_assert(ibus_count_same(&ibus.count, &model.count), "IBU_007_model: what is counted");
    __CPROVER_assert(ibus_same(&ibus, &model, at),
                     "IBU_003_model: every field is what the model says");
    __CPROVER_assert(ibus_valid_here(&ibus), "IBU_003_valid: it stays valid");
}
