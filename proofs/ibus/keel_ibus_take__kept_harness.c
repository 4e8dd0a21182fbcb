// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/ibus.c src/middleware/framing.c specs/model/ibus.c specs/model/framing.c
// replaces: keel_framing_drop
// covers: keel_ibus_take keel_ibus_pass_time word_of extra_of channel_us adds_up all_in_range judges
// covers: take_words take_held
// covers: model_ibus_right
//
// The clauses, without the model: what is published was right as a whole, and nothing else is. The
// bytes that may be a frame: those held, and the one that comes.
#include "ibus_proof.h"

void keel_ibus_take__kept_harness(void)
{
    keel_ibus_t ibus = any_ibus();
    const keel_ibus_t before = ibus;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    uint8_t frame[KEEL_IBUS_BYTES];
    bool came_right;
    bool right;

    __CPROVER_assume(ibus_valid_here(&ibus));
    for (uint32_t i = 0u; i < KEEL_IBUS_BYTES; i++) {
        frame[i] = (i < before.framing.held) ? before.framing.byte[i] : byte;
    }
    came_right = (before.framing.held == 31u) && model_ibus_right(frame, &before.config);

    right = keel_ibus_take(&ibus, byte, elapsed_us);

    __CPROVER_assert(ibus_config_same(&ibus.config, &before.config),
                     "IBU_006_config: the configuration stays");
    if (right) {
        __CPROVER_assert(came_right, "IBU_004_right: these bytes came, and are a right frame");
        __CPROVER_assert(says(&ibus, frame), "IBU_005_says: and this is what it says");
        __CPROVER_assert(ibus.age_us == 0u, "IBU_008_new: and it is new");
    } else {
        __CPROVER_assert(ibus_channels_alike(ibus.channel, before.channel),
                         "IBU_006_kept: without a right frame the last one stays");
        __CPROVER_assert(ibus.age_us >= before.age_us, "IBU_008_older: and it is no newer");
    }
}
