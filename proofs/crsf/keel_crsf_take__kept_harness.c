// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/crsf.c src/middleware/framing.c specs/model/crsf.c specs/model/framing.c
// replaces: keel_crsf_crc keel_framing_drop
// covers: keel_crsf_take keel_crsf_pass_time take_first take_or_refuse take_whole take_channels
// covers: take_link channel_of model_crsf_right begins crc_right
//
// The clauses, without the model: what is published was right as a whole, and nothing else is. The
// bytes that may be a frame: those held, and the one that comes.
#include "crsf_proof.h"

void keel_crsf_take__kept_harness(void)
{
    keel_crsf_t crsf = nondet_crsf();
    const keel_crsf_t before = crsf;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    uint8_t frame[KEEL_FRAMING_BYTES];
    keel_crsf_taken_t taken;
    bool right;

    __CPROVER_assume(crsf_valid_here(&crsf));
    for (uint32_t i = 0u; i < KEEL_FRAMING_BYTES; i++) {
        frame[i] = (i < before.framing.held) ? before.framing.byte[i] : byte;
    }
    right = model_crsf_right(frame);

    taken = keel_crsf_take(&crsf, byte, elapsed_us);

    __CPROVER_assert(crsf_config_same(&crsf.config, &before.config),
                     "CRF_007_config: the configuration stays");
    if (taken != KEEL_CRSF_NOTHING) {
        __CPROVER_assert(right && ((frame[1] + 2u) <= (before.framing.held + 1u)),
                         "CRF_004_right: these bytes came, and are a right frame");
        __CPROVER_assert((taken == kind_of(frame)) && says(&crsf, frame),
                         "CRF_005_says: and this is what it says");
    }
    if (taken != KEEL_CRSF_TOOK_CHANNELS) {
        __CPROVER_assert(
            crsf_channels_alike(crsf.channel, before.channel) &&
                (crsf.channels_age_us >= before.channels_age_us),
            "CRF_007_channels: without a right frame the last channels stay, no newer");
    }
    if (taken != KEEL_CRSF_TOOK_LINK) {
        __CPROVER_assert(crsf_link_same(&crsf.link, &before.link) &&
                             (crsf.link_age_us >= before.link_age_us),
                         "CRF_007_link: and so do the last statistics");
    }
}
