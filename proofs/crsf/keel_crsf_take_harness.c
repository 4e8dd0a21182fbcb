// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/crsf.c src/middleware/framing.c specs/model/crsf.c specs/model/framing.c
// replaces: keel_crsf_crc keel_framing_drop
// covers: keel_crsf_take keel_crsf_pass_time take_first take_or_refuse take_whole take_channels
// covers: take_link channel_of model_crsf_take model_crsf_pass_time model_crsf_channel
// covers: crc_right channels_said link_said said
//
// Any valid decoder, any byte, any time, and any CRC: the same as the model's in every field, and
// valid. The code must ask about the bytes that the model asked about, or be told anything.
#include "crsf_proof.h"

void keel_crsf_take_harness(void)
{
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);
    keel_crsf_t crsf = nondet_crsf();
    keel_crsf_t model = crsf;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    keel_crsf_taken_t expected;
    keel_crsf_taken_t taken;

    __CPROVER_assume(crsf_valid_here(&crsf));
    expected = model_crsf_take(&model, byte, elapsed_us);

    taken = keel_crsf_take(&crsf, byte, elapsed_us);

    __CPROVER_assert(taken == expected, "CRF_004_model: a frame ends where the model says");
    __CPROVER_assert(crsf_channels_alike(crsf.channel, model.channel),
                     "CRF_005_model: what it says");
    __CPROVER_assert(crsf_link_same(&crsf.link, &model.link), "CRF_006_model: of the link, too");
    __CPROVER_assert(crsf_count_same(&crsf.count, &model.count), "CRF_008_model: what is counted");
    __CPROVER_assert(crsf_same(&crsf, &model, at),
                     "CRF_003_model: every field is what the model says");
    __CPROVER_assert(crsf_valid_here(&crsf), "CRF_003_valid: it stays valid");
}
