// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 17 --external-sat-solver cadical
// sources: src/middleware/ppm.c specs/model/ppm.c specs/model/framing.c
// covers: keel_ppm_take keel_ppm_pass_time take_next close_frame is_right add_channel
//
// The clauses of the contract, without the model, each of them for any valid decoder and any time.
#include "ppm_proof.h"

static keel_ppm_t before;
static uint32_t width;

/* ppm_ends */
static bool ends_here(void)
{
    return (before.config.sync_us <= width) && (width <= before.config.lost_us) && before.begun &&
           (before.come >= before.config.least);
}

/* ppm_goes_on */
static bool goes_on_here(void)
{
    return (width < before.config.sync_us) && before.begun && (before.come < 16u) &&
           ppm_right_here(&before, before.come, width);
}

/* ppm_row */
static uint32_t row_here(void)
{
    const uint32_t more = (before.row < before.config.frames_to_take) ? 1u : 0u;

    return ((before.row > 0u) && (before.row_of == before.come)) ? (before.row + more) : 1u;
}

static void check_taken(const keel_ppm_t *ppm, uint32_t i)
{
    __CPROVER_assert(ends_here(), "PPM_004_ends: the frame was right as a whole, and ended");
    __CPROVER_assert((ppm->config.least <= ppm->channels) && (ppm->channels <= 16u) &&
                         all_right_here(ppm, ppm->channel, ppm->channels),
                     "PPM_004_range: it had enough channels, all right");
    __CPROVER_assert(((uint32_t)before.row + 1u >= before.config.frames_to_take) &&
                         ((before.config.frames_to_take == 1u) || (before.row_of == before.come)),
                     "PPM_009_before: and so had as many before it, with as many channels");
    __CPROVER_assert((ppm->channels == before.come) &&
                         (ppm->channel[i] == ((i < before.come) ? before.next[i] : 0u)),
                     "PPM_005_taken: all that came is taken");
}

static void check_row(const keel_ppm_t *ppm, bool taken, uint32_t i)
{
    if (ends_here()) {
        __CPROVER_assert(
            (ppm->row == row_here()) && (ppm->row_of == before.come) &&
                (taken == (ppm->row == ppm->config.frames_to_take)),
            "PPM_009_row: a right frame is one more of a row, or the first of another");
    } else if (goes_on_here()) {
        __CPROVER_assert(!taken && (ppm->row == before.row) && (ppm->row_of == before.row_of) &&
                             (ppm->come == (before.come + 1u)) && ppm->begun &&
                             (ppm->next[before.come] == width) &&
                             ((i >= before.come) || (ppm->next[i] == before.next[i])),
                         "PPM_009_goes_on: a channel in range is one more of its frame");
    } else {
        __CPROVER_assert(!taken && (ppm->row == 0u), "PPM_009_breaks: all else breaks a row");
    }
    __CPROVER_assert((width < before.config.sync_us) ||
                         ((ppm->come == 0u) && (ppm->begun == (width <= before.config.lost_us))),
                     "PPM_010_begins: a frame begins behind a sync gap, and no longer silence");
}

void keel_ppm_take__kept_harness(void)
{
    keel_ppm_t ppm = any_ppm();
    const uint32_t elapsed_us = nondet_u32();
    const uint32_t i = nondet_u32();
    bool taken;

    before = ppm;
    width = sum_here(before.quiet_us, elapsed_us);
    __CPROVER_assume(ppm_valid_here(&ppm) && (i < KEEL_PPM_CHANNELS));

    taken = keel_ppm_take(&ppm, elapsed_us);

    __CPROVER_assert(ppm_valid_here(&ppm), "PPM_003_valid: it stays valid");
    __CPROVER_assert(ppm_config_same(&ppm.config, &before.config),
                     "PPM_006_config: the configuration stays");
    __CPROVER_assert(taken || ((ppm.channels == before.channels) &&
                               ppm_channels_alike(ppm.channel, before.channel)),
                     "PPM_006_kept: without such a row the last channels stay");
    __CPROVER_assert(ppm.count.frames == sum_here(before.count.frames, taken ? 1u : 0u),
                     "PPM_007_frames: those taken are counted");
    __CPROVER_assert(ppm.age_us == (taken ? 0u : sum_here(before.age_us, elapsed_us)),
                     "PPM_008_age: without it they are older");
    __CPROVER_assert(ppm.quiet_us == 0u, "PPM_008_quiet: an edge came");
    if (taken) {
        check_taken(&ppm, i);
    }
    check_row(&ppm, taken, i);
}
