// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_take keel_ubx_pass_time sum_up_to_end count_event signed_of advances
// covers: shifted add_to_sums gather take_data publish_fix take_message go_on_with let_in
// covers: look_for_header kind_of begin_message
// covers: model_ubx_take model_ubx_pass_time ubx_end whole_of time_moves sum_with put_field
// covers: end_message start_message compare add_byte
//
// Any valid decoder, any byte, any time: the same as the model's in every field, and valid.
#include "ubx_proof.h"

void keel_ubx_take_harness(void)
{
    keel_ubx_t ubx = any_ubx();
    keel_ubx_t model = ubx;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    bool expected;
    bool is_fix;

    __CPROVER_assume(ubx_valid_here(&ubx));
    expected = model_ubx_take(&model, byte, elapsed_us);

    is_fix = keel_ubx_take(&ubx, byte, elapsed_us);

    __CPROVER_assert(is_fix == expected, "UBX_004_model: a fix ends where the model says");
    __CPROVER_assert(ubx_fix_same(&ubx.pending, &model.pending), "UBX_005_model: what it says");
    __CPROVER_assert(ubx_count_same(&ubx.count, &model.count), "UBX_007_model: what is counted");
    __CPROVER_assert(ubx_same(&ubx, &model), "UBX_003_model: every field is what the model says");
    __CPROVER_assert(ubx_valid_here(&ubx), "UBX_003_valid: it stays valid");
}
