// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 17 --external-sat-solver cadical
// sources: src/middleware/ppm.c specs/model/ppm.c specs/model/framing.c
// covers: keel_ppm_take keel_ppm_pass_time take_next close_frame is_right add_channel
// covers: model_ppm_take model_ppm_pass_time refused row_with published ended judged
// covers: went_on
//
// Any valid decoder, any time: the same as the model's in every field, and valid.
#include "ppm_proof.h"

void keel_ppm_take_harness(void)
{
    keel_ppm_t ppm = any_ppm();
    keel_ppm_t model = ppm;
    const uint32_t elapsed_us = nondet_u32();
    bool expected;
    bool taken;

    __CPROVER_assume(ppm_valid_here(&ppm));
    expected = model_ppm_take(&model, elapsed_us);

    taken = keel_ppm_take(&ppm, elapsed_us);

    __CPROVER_assert(taken == expected, "PPM_004_model: channels are taken when the model says");
    __CPROVER_assert((ppm.channels == model.channels) &&
                         ppm_channels_alike(ppm.channel, model.channel),
                     "PPM_005_model: those that it says");
    __CPROVER_assert(ppm_count_same(&ppm.count, &model.count), "PPM_007_model: what is counted");
    for (uint32_t i = 0u; i < KEEL_PPM_CHANNELS; i++) {
        __CPROVER_assert(ppm_same(&ppm, &model, i),
                         "PPM_003_model: every field is what the model says");
    }
    __CPROVER_assert(ppm_valid_here(&ppm), "PPM_003_valid: it stays valid");
}
