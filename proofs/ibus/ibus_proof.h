/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ibus_proof.h
 * @brief What the harnesses of the IBUS decoder share: arbitrary decoders, valid ones, and when two
 *        are the same.
 */
#ifndef IBUS_PROOF_H
#define IBUS_PROOF_H

#include "../../specs/model/ibus.h"
#include "../common/framing_drop.h"

bool nondet_bool(void);
keel_ibus_t nondet_ibus(void);
keel_ibus_config_t nondet_ibus_config(void);

/* ibus_valid */
static bool ibus_valid_here(const keel_ibus_t *s)
{
    return framing_valid_here(&s->framing) && (s->framing.held < 32u) &&
           (s->framing.header[0] == 0x20u) && (s->framing.header[1] == 0x20u) &&
           (s->framing.header[2] == 0x20u) && (s->framing.header[3] == 0x20u);
}

/* ibus_config */
static bool ibus_config_valid(const keel_ibus_config_t *c)
{
    return (c->lowest <= c->highest) && (c->highest <= 4095u) && (c->gap_us > 0u);
}

static bool ibus_config_same(const keel_ibus_config_t *a, const keel_ibus_config_t *b)
{
    return (a->gap_us == b->gap_us) && (a->lowest == b->lowest) && (a->highest == b->highest) &&
           (a->extended == b->extended) && (a->judged == b->judged);
}

/* Whether these are the same channels. */
static bool ibus_channels_alike(const uint16_t *a, const uint16_t *b)
{
    bool alike = true;

    for (uint32_t i = 0u; i < KEEL_IBUS_CHANNELS; i++) {
        alike = alike && (a[i] == b[i]);
    }
    return alike;
}

static bool ibus_count_same(const keel_ibus_count_t *a, const keel_ibus_count_t *b)
{
    return (a->frames == b->frames) && (a->headers == b->headers) && (a->sums == b->sums) &&
           (a->ranges == b->ranges);
}

static bool ibus_same(const keel_ibus_t *a, const keel_ibus_t *b, uint32_t i)
{
    return ibus_config_same(&a->config, &b->config) && framing_same(&a->framing, &b->framing, i) &&
           ibus_count_same(&a->count, &b->count) && (a->age_us == b->age_us) &&
           (a->channel[0u] == b->channel[0u]) && (a->channel[1u] == b->channel[1u]) &&
           (a->channel[2u] == b->channel[2u]) && (a->channel[3u] == b->channel[3u]) &&
           (a->channel[4u] == b->channel[4u]) && (a->channel[5u] == b->channel[5u]) &&
           (a->channel[6u] == b->channel[6u]) && (a->channel[7u] == b->channel[7u]) &&
           (a->channel[8u] == b->channel[8u]) && (a->channel[9u] == b->channel[9u]) &&
           (a->channel[10u] == b->channel[10u]) && (a->channel[11u] == b->channel[11u]) &&
           (a->channel[12u] == b->channel[12u]) && (a->channel[13u] == b->channel[13u]) &&
           (a->channel[14u] == b->channel[14u]) && (a->channel[15u] == b->channel[15u]) &&
           (a->channel[16u] == b->channel[16u]) && (a->channel[17u] == b->channel[17u]);
}

static keel_ibus_config_t any_ibus_config(void)
{
    keel_ibus_config_t config = nondet_ibus_config();

    config.extended = nondet_bool();
    return config;
}

/* Any bits, but that a bool is one. */
static keel_ibus_t any_ibus(void)
{
    keel_ibus_t ibus = nondet_ibus();

    ibus.config = any_ibus_config();
    return ibus;
}

/* Whether what was published is this frame. */
static bool says(const keel_ibus_t *s, const uint8_t *frame)
{
    bool same = true;

    for (uint32_t i = 0u; i < KEEL_IBUS_CHANNELS; i++) {
        same = same && (s->channel[i] == model_ibus_channel(frame, i, s->config.extended));
    }
    return same;
}

#endif
