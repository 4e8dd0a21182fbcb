// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 26 --external-sat-solver cadical
// sources: src/middleware/sbus.c specs/model/sbus.c
// covers: keel_sbus_take keel_sbus_pass_time add_up_to_end count_to_end field_of is_footer
// covers: is_judged are_plausible publish search_header take_frame
// covers: model_sbus_take model_sbus_pass_time sum_to_end model_sbus_channel footer_right
// covers: channels_right model_sbus_right hand_out refuse go_on
//
// Any valid decoder, any byte, any time: the same as the model's in every field, and valid.
#include "sbus_proof.h"

void keel_sbus_take_harness(void)
{
    const uint32_t at = any_below(KEEL_SBUS_BYTES);
    keel_sbus_t sbus = any_sbus();
    keel_sbus_t model = sbus;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    bool expected;
    bool right;

    __CPROVER_assume(sbus_valid_here(&sbus));
    expected = model_sbus_take(&model, byte, elapsed_us);

    right = keel_sbus_take(&sbus, byte, elapsed_us);

    __CPROVER_assert(right == expected, "RAD_004_model: a frame ends where the model says");
    __CPROVER_assert(sbus_frame_same(&sbus.frame, &model.frame), "RAD_005_model: what it says");
    __CPROVER_assert(sbus_count_same(&sbus.count, &model.count), "RAD_007_model: what is counted");
    __CPROVER_assert(sbus_same(&sbus, &model, at),
                     "RAD_003_model: every field is what the model says");
    __CPROVER_assert(sbus_valid_here(&sbus), "RAD_003_valid: it stays valid");
}
