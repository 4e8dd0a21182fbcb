/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ppm_proof.h
 * @brief What the harnesses of the PPM decoder share: arbitrary decoders, valid ones, and when two
 *        are the same.
 */
#ifndef PPM_PROOF_H
#define PPM_PROOF_H

#include "../../specs/model/ppm.h"

bool nondet_bool(void);
uint32_t nondet_u32(void);
keel_ppm_t nondet_ppm(void);
keel_ppm_config_t nondet_ppm_config(void);

/* framing_sum */
static uint32_t sum_here(uint32_t a, uint32_t b)
{
    return ((UINT32_MAX - a) < b) ? UINT32_MAX : (a + b);
}

/* ppm_right */
static bool ppm_right_here(const keel_ppm_t *s, uint32_t i, uint32_t us)
{
    return ((((uint32_t)s->config.judged >> i) & 1u) == 0u) ||
           ((s->config.lowest_us <= us) && (us <= s->config.highest_us));
}

/* Whether all of so many channels are right. */
static bool all_right_here(const keel_ppm_t *s, const uint16_t *channel, uint32_t count)
{
    bool all = true;

    for (uint32_t i = 0u; i < KEEL_PPM_CHANNELS; i++) {
        all = all && ((i >= count) || ppm_right_here(s, i, channel[i]));
    }
    return all;
}

/* ppm_limits */
static bool ppm_limits_here(const keel_ppm_config_t *c)
{
    return (c->lowest_us <= c->highest_us) && (c->highest_us < c->sync_us) &&
           (c->sync_us < c->lost_us);
}

/* ppm_valid */
static bool ppm_valid_here(const keel_ppm_t *s)
{
    return ppm_limits_here(&s->config) && (s->come <= 16u) && (s->channels <= 16u) &&
           (s->row <= s->config.frames_to_take) && (s->config.frames_to_take > 0u) &&
           (s->begun || (s->row == 0u)) && (!s->begun || all_right_here(s, s->next, s->come));
}

static bool ppm_config_same(const keel_ppm_config_t *a, const keel_ppm_config_t *b)
{
    return (a->lost_us == b->lost_us) && (a->lowest_us == b->lowest_us) &&
           (a->highest_us == b->highest_us) && (a->sync_us == b->sync_us) &&
           (a->judged == b->judged) && (a->least == b->least) &&
           (a->frames_to_take == b->frames_to_take);
}

static bool ppm_count_same(const keel_ppm_count_t *a, const keel_ppm_count_t *b)
{
    return (a->frames == b->frames) && (a->pulses == b->pulses) && (a->numbers == b->numbers) &&
           (a->gaps == b->gaps);
}

/* Whether these are the same channels. */
static bool ppm_channels_alike(const uint16_t *a, const uint16_t *b)
{
    bool alike = true;

    for (uint32_t i = 0u; i < KEEL_PPM_CHANNELS; i++) {
        alike = alike && (a[i] == b[i]);
    }
    return alike;
}

static bool ppm_same(const keel_ppm_t *a, const keel_ppm_t *b, uint32_t i)
{
    return ppm_config_same(&a->config, &b->config) && ppm_count_same(&a->count, &b->count) &&
           (a->age_us == b->age_us) && (a->quiet_us == b->quiet_us) &&
           (a->channels == b->channels) && (a->come == b->come) && (a->row_of == b->row_of) &&
           (a->row == b->row) && (a->begun == b->begun) && (a->channel[i] == b->channel[i]) &&
           (a->next[i] == b->next[i]);
}

/* Any bits, but that a bool is one. */
static keel_ppm_t any_ppm(void)
{
    keel_ppm_t ppm = nondet_ppm();

    ppm.begun = nondet_bool();
    return ppm;
}

#endif
