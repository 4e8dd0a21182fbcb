// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 307 --unwindset place_of_stream.0:9,new_enough.0:9
// cbmc: --external-sat-solver cadical
// sources: src/middleware/signing.c specs/model/signing.c
// covers: keel_signing_accepts count_signed byte_in place_of_stream is_fresh put_frame
// covers: is_sealed note_frame
// covers: model_signing_accepts note_one byte_of put_signed new_enough
// covers: rightly_signed
//
// Any valid state, any frame, any hash: the same as the model's in every field, asked for the hash
// of the same bytes.
#include "signing_proof.h"

void keel_signing_accepts_harness(void)
{
    const uint32_t at = any_below(KEEL_SIGNING_TEXT_MAX);
    keel_signing_t signing = any_valid_signing();
    keel_signing_t model = signing;
    const keel_mavlink_frame_t frame = any_frame();
    uint32_t model_asked;
    uint32_t model_size;
    uint8_t model_byte;
    bool expected;
    bool accepted;

    ask_for(&model);
    expected = model_signing_accepts(&model, &frame);
    model_asked = asked;
    model_size = asked_size;
    model_byte = asked_byte;

    ask_for(&signing);
    accepted = keel_signing_accepts(&signing, &frame);

    __CPROVER_assert((asked == model_asked) && (asked_size == model_size) && asked_own,
                     "SGN_008_asked: the hash is asked for as the model says");
    __CPROVER_assert(asked_byte == model_byte, "SGN_008_bytes: of the bytes that the model says");
    __CPROVER_assert(accepted == expected, "SGN_008_model: accepted or not as the model says");
    __CPROVER_assert(signing_count_same(&signing.count, &model.count),
                     "SGN_005_model: what is counted is what the model counts");
    __CPROVER_assert(signing_same(&signing, &model, at),
                     "SGN_010_model: every field is what the model says");
}
