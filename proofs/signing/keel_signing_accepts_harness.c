// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 275 --external-sat-solver cadical
// sources: src/middleware/signing.c specs/model/signing.c
// covers: keel_signing_accepts count_signed put_timestamp place_of_stream is_fresh put_frame
// covers: is_sealed note_frame
// covers: model_signing_accepts note_one byte_of model_signing_byte model_signing_size new_enough
// covers: rightly_signed
//
// Any state, any frame, any hash: the same as the model's in every field, asked for the hash of the
// same bytes.
#include "signing_proof.h"

void keel_signing_accepts_harness(void)
{
    keel_signing_t signing = any_signing();
    keel_signing_t model = signing;
    const keel_mavlink_frame_t frame = any_frame();
    const bool expected = model_signing_accepts(&model, &frame);
    const uint32_t model_asked = asked;
    const uint32_t model_size = asked_size;
    const uint8_t model_byte = asked_byte;
    bool accepted;

    asked = 0u;

    accepted = keel_signing_accepts(&signing, &frame);

    __CPROVER_assert((asked == model_asked) && (asked_size == model_size),
                     "SGN_008_asked: the hash is asked for as the model says");
    __CPROVER_assert(asked_byte == model_byte, "SGN_008_bytes: of the bytes that the model says");
    __CPROVER_assert(accepted == expected, "SGN_008_model: accepted or not as the model says");
    __CPROVER_assert(signing_count_same(&signing.count, &model.count),
                     "SGN_005_model: what is counted is what the model counts");
    __CPROVER_assert(signing_same(&signing, &model),
                     "SGN_010_model: every field is what the model says");
}
