/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/ppm.h"

/*@ requires \valid(ppm) && ppm->come <= KEEL_PPM_CHANNELS;
  @ assigns ppm->channel[0 .. KEEL_PPM_CHANNELS - 1], ppm->channels, ppm->count.frames,
  @     ppm->age_us;
  @ ensures ppm->channels == ppm->come;
  @ ensures \forall integer i; 0 <= i < KEEL_PPM_CHANNELS ==>
  @     ppm->channel[i] == (i < ppm->come ? \at(ppm->next[i], Pre) : 0);
  @ ensures ppm->count.frames == framing_sum(\old(ppm->count.frames), 1);
  @ ensures ppm->age_us == 0;
  @*/
static void take_next(keel_ppm_t *ppm)
{
    /*@ loop invariant 0 <= i <= KEEL_PPM_CHANNELS;
      @ loop invariant \forall integer j; 0 <= j < i ==>
      @     ppm->channel[j] == (j < ppm->come ? \at(ppm->next[j], Pre) : 0);
      @ loop invariant \forall integer j; 0 <= j < KEEL_PPM_CHANNELS ==>
      @     ppm->next[j] == \at(ppm->next[j], Pre);
      @ loop assigns i, ppm->channel[0 .. KEEL_PPM_CHANNELS - 1];
      @ loop variant KEEL_PPM_CHANNELS - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_PPM_CHANNELS; i++) {
        ppm->channel[i] = (i < ppm->come) ? ppm->next[i] : 0u;
    }
    ppm->channels = ppm->come;
    ppm->count.frames = keel_framing_sum(ppm->count.frames, 1u);
    ppm->age_us = 0u;
}

/* A sync gap, behind a frame that was right so far: it is one more of a row, the first of another,
 * or none. */
/*@ requires \valid(ppm) && ppm_valid(ppm);
  @ assigns ppm->channel[0 .. KEEL_PPM_CHANNELS - 1], ppm->channels, ppm->count.frames,
  @     ppm->count.numbers, ppm->age_us, ppm->row, ppm->row_of;
  @ ensures ppm->come < ppm->config.least ==> !\result && ppm->row == 0;
  @ ensures ppm->come >= ppm->config.least ==> ppm->row == ppm_row{Pre}(ppm) &&
  @     ppm->row_of == ppm->come && (\result <==> ppm->row == ppm->config.frames_to_take);
  @ ensures \result ==> ppm->channels == ppm->come && ppm->age_us == 0 &&
  @     \forall integer i; 0 <= i < KEEL_PPM_CHANNELS ==>
  @         ppm->channel[i] == (i < ppm->come ? \at(ppm->next[i], Pre) : 0);
  @ ensures !\result ==> ppm_kept{Pre, Post}(ppm) && ppm->age_us == \old(ppm->age_us);
  @ ensures ppm->count.frames == framing_sum(\old(ppm->count.frames), \result ? 1 : 0);
  @ ensures ppm->row <= ppm->config.frames_to_take;
  @*/
static bool close_frame(keel_ppm_t *ppm)
{
    bool taken = false;

    if (ppm->come < ppm->config.least) {
        ppm->count.numbers = keel_framing_sum(ppm->count.numbers, 1u);
        ppm->row = 0u;
    } else {
        if ((ppm->row == 0u) || (ppm->row_of != ppm->come)) {
            ppm->row = 1u;
        } else if (ppm->row < ppm->config.frames_to_take) {
            ppm->row++;
        } else {
            /* It is as long as is asked for. */
        }
        ppm->row_of = ppm->come;
        taken = ppm->row == ppm->config.frames_to_take;
        if (taken) {
            take_next(ppm);
        }
    }
    return taken;
}

/*@ requires \valid_read(ppm) && index <= KEEL_PPM_CHANNELS;
  @ assigns \nothing;
  @ ensures \result <==> ppm_right(ppm, index, width);
  @*/
static bool is_right(const keel_ppm_t *ppm, uint32_t index, uint32_t width)
{
    const bool judged = (((uint32_t)ppm->config.judged >> index) & 1u) != 0u;

    return !judged || ((ppm->config.lowest_us <= width) && (width <= ppm->config.highest_us));
}

/* One more channel of a frame that was right so far. */
/*@ requires \valid(ppm) && ppm_valid(ppm) && ppm->begun != 0 && width <= UINT16_MAX;
  @ assigns ppm->next[0 .. KEEL_PPM_CHANNELS - 1], ppm->come, ppm->count.pulses,
  @     ppm->count.numbers, ppm->row, ppm->begun;
  @ ensures ppm_valid(ppm);
  @ ensures ppm_right(ppm, \old(ppm->come), width) && \old(ppm->come) < KEEL_PPM_CHANNELS ==>
  @     ppm->row == \old(ppm->row) && ppm->come == \old(ppm->come) + 1 && ppm->begun != 0 &&
  @     ppm->next[ppm->come - 1] == width &&
  @     \forall integer i; 0 <= i < ppm->come - 1 ==>
  @         ppm->next[i] == \at(ppm->next[i], Pre);
  @ ensures !(ppm_right(ppm, \old(ppm->come), width) && \old(ppm->come) < KEEL_PPM_CHANNELS) ==>
  @     ppm->row == 0 && ppm->begun == 0;
  @*/
static void add_channel(keel_ppm_t *ppm, uint32_t width)
{
    if (!is_right(ppm, ppm->come, width)) {
        ppm->count.pulses = keel_framing_sum(ppm->count.pulses, 1u);
        ppm->begun = false;
        ppm->row = 0u;
    } else if (ppm->come == (uint8_t)KEEL_PPM_CHANNELS) {
        ppm->count.numbers = keel_framing_sum(ppm->count.numbers, 1u);
        ppm->begun = false;
        ppm->row = 0u;
    } else {
        ppm->next[ppm->come] = (uint16_t)width;
        ppm->come++;
    }
}

keel_status_t keel_ppm_init(keel_ppm_t *ppm, const keel_ppm_config_t *config)
{
    static const keel_ppm_count_t no_count = {0};

    if ((config->lowest_us > config->highest_us) || (config->highest_us >= config->sync_us) ||
        (config->sync_us >= config->lost_us) || (config->least == 0u) ||
        (config->least > (uint8_t)KEEL_PPM_CHANNELS)) {
        return KEEL_ERR_LIMITS;
    }
    if (config->frames_to_take == 0u) {
        return KEEL_ERR_LATCH;
    }
    ppm->config = *config;
    ppm->count = no_count;
    ppm->age_us = UINT32_MAX;
    ppm->quiet_us = UINT32_MAX;
    /*@ loop invariant 0 <= i <= KEEL_PPM_CHANNELS;
      @ loop assigns i, ppm->channel[0 .. KEEL_PPM_CHANNELS - 1],
      @     ppm->next[0 .. KEEL_PPM_CHANNELS - 1];
      @ loop variant KEEL_PPM_CHANNELS - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_PPM_CHANNELS; i++) {
        ppm->channel[i] = 0u;
        ppm->next[i] = 0u;
    }
    ppm->channels = 0u;
    ppm->come = 0u;
    ppm->row_of = 0u;
    ppm->row = 0u;
    ppm->begun = false;
    return KEEL_OK;
}

void keel_ppm_pass_time(keel_ppm_t *ppm, uint32_t elapsed_us)
{
    ppm->age_us = keel_framing_sum(ppm->age_us, elapsed_us);
    ppm->quiet_us = keel_framing_sum(ppm->quiet_us, elapsed_us);
}

bool keel_ppm_take(keel_ppm_t *ppm, uint32_t elapsed_us)
{
    bool taken = false;
    uint32_t width;

    keel_ppm_pass_time(ppm, elapsed_us);
    width = ppm->quiet_us;
    ppm->quiet_us = 0u;
    if (width > ppm->config.lost_us) {
        ppm->count.gaps = keel_framing_sum(ppm->count.gaps, ppm->begun ? 1u : 0u);
        ppm->row = 0u;
        ppm->begun = false;
        ppm->come = 0u;
    } else if (width >= ppm->config.sync_us) {
        if (ppm->begun) {
            taken = close_frame(ppm);
        }
        ppm->begun = true;
        ppm->come = 0u;
    } else if (ppm->begun) {
        add_channel(ppm, width);
    } else {
        /* It is part of a frame that is refused already, or whose beginning was not seen. */
    }
    return taken;
}

bool keel_ppm_is_lost(const keel_ppm_t *ppm)
{
    return ppm->age_us > ppm->config.lost_us;
}
