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
    return framing_valid_here(&s->framing) && (s->framing.header == 0x20u) &&
           (s->framing.held < 32u);
}

/* ibus_config */
static bool ibus_config_valid(const keel_ibus_config_t *c)
{
    return (c->lowest <= c->highest) && (c->highest <= 4095u) && (c->gap_us > 0u);
}

static bool ibus_config_same(const keel_ibus_config_t *a, const keel_ibus_config_t *b)
{
    return (a->gap_us == b->gap_us) && (a->lowest == b->lowest) && (a->highest == b->highest) &&
           (a->extended == b->extended);
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

static bool ibus_same(const keel_ibus_t *a, const keel_ibus_t *b)
{
    bool same = ibus_config_same(&a->config, &b->config) &&
                framing_same(&a->framing, &b->framing) && ibus_count_same(&a->count, &b->count) &&
                (a->age_us == b->age_us);

    for (uint32_t i = 0u; i < KEEL_IBUS_CHANNELS; i++) {
        same = same && (a->channel[i] == b->channel[i]);
    }
    return same;
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
