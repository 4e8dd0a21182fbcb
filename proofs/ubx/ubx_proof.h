/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ubx_proof.h
 * @brief What the harnesses of the UBX decoder share: arbitrary decoders, valid ones, and when two
 *        are the same.
 */
#ifndef UBX_PROOF_H
#define UBX_PROOF_H

#include "../../specs/model/ubx.h"
#include "../common/any_below.h"

#include <stdbool.h>

bool nondet_bool(void);
uint8_t nondet_u8(void);
uint16_t nondet_u16(void);
uint32_t nondet_u32(void);
keel_ubx_t nondet_ubx(void);
keel_ubx_config_t nondet_ubx_config(void);
keel_ubx_message_t nondet_ubx_message(void);

/* ubx_valid */
static bool ubx_valid_here(const keel_ubx_t *u)
{
    return (u->step <= 3u) && ((u->window >> 48) == 0u) && (u->left <= u->length) &&
           ((u->step != 1u) || (u->left > 0u)) && ((u->kind != 1u) || (u->length >= 84u));
}

/* ubx_config */
static bool ubx_config_valid(const keel_ubx_config_t *c)
{
    return (c->accuracy_mm > 0u) && (c->speed_accuracy > 0u) && (c->gap_us > 0u) &&
           (c->max_age_us > 0u);
}

static bool ubx_config_same(const keel_ubx_config_t *a, const keel_ubx_config_t *b)
{
    return (a->gap_us == b->gap_us) && (a->max_age_us == b->max_age_us) &&
           (a->accuracy_mm == b->accuracy_mm) && (a->speed_accuracy == b->speed_accuracy);
}

static bool ubx_fix_same(const keel_ubx_fix_t *a, const keel_ubx_fix_t *b)
{
    return (a->tow_ms == b->tow_ms) && (a->longitude == b->longitude) &&
           (a->latitude == b->latitude) && (a->height_mm == b->height_mm) &&
           (a->accuracy_mm == b->accuracy_mm) && (a->height_accuracy == b->height_accuracy) &&
           (a->north == b->north) && (a->east == b->east) && (a->down == b->down) &&
           (a->speed_accuracy == b->speed_accuracy) && (a->type == b->type) &&
           (a->satellites == b->satellites) && (a->is_ok == b->is_ok) &&
           (a->is_invalid == b->is_invalid);
}

static bool ubx_count_same(const keel_ubx_count_t *a, const keel_ubx_count_t *b)
{
    return (a->bytes == b->bytes) && (a->fixes == b->fixes) && (a->acks == b->acks) &&
           (a->naks == b->naks) && (a->others == b->others) && (a->checksums == b->checksums) &&
           (a->cut == b->cut);
}

static bool ubx_same(const keel_ubx_t *a, const keel_ubx_t *b)
{
    return ubx_config_same(&a->config, &b->config) && ubx_fix_same(&a->fix, &b->fix) &&
           ubx_count_same(&a->count, &b->count) && (a->is_advancing == b->is_advancing) &&
           (a->age_us == b->age_us) && (a->quiet_us == b->quiet_us) &&
           ubx_fix_same(&a->pending, &b->pending) && (a->window == b->window) &&
           (a->length == b->length) && (a->left == b->left) && (a->sum_a == b->sum_a) &&
           (a->sum_b == b->sum_b) && (a->kind == b->kind) && (a->step == b->step);
}

static bool ubx_message_same(const keel_ubx_message_t *a, const keel_ubx_message_t *b, uint32_t i)
{
    return (a->size == b->size) && (a->bytes[i] == b->bytes[i]);
}

/* Any bits, but that a bool is one. */
static keel_ubx_t any_ubx(void)
{
    keel_ubx_t ubx = nondet_ubx();

    ubx.fix.is_ok = nondet_bool();
    ubx.fix.is_invalid = nondet_bool();
    ubx.pending.is_ok = nondet_bool();
    ubx.pending.is_invalid = nondet_bool();
    ubx.is_advancing = nondet_bool();
    return ubx;
}

/* Whether a byte so much later comes after a gap. */
static bool is_gap(const keel_ubx_t *u, uint32_t elapsed_us)
{
    const uint64_t quiet_us = (uint64_t)u->quiet_us + elapsed_us;

    return ((quiet_us > UINT32_MAX) ? UINT32_MAX : quiet_us) > u->config.gap_us;
}

#endif
