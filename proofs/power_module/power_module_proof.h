/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file power_module_proof.h
 * @brief What the harnesses of the power module share.
 */
#ifndef POWER_MODULE_PROOF_H
#define POWER_MODULE_PROOF_H

#include "../../specs/model/power_module.h"

#include <stdbool.h>

uint16_t nondet_u16(void);
keel_power_module_t nondet_power_module(void);
keel_power_module_config_t nondet_power_module_config(void);
keel_power_module_reading_t nondet_power_module_reading(void);

/* power_module_valid */
static bool power_module_valid_here(const keel_power_module_t *m)
{
    return (m->voltage <= 5000000000000u) && (m->current <= 5000000000000u);
}

static bool power_module_same(const keel_power_module_t *a, const keel_power_module_t *b)
{
    return (a->voltage == b->voltage) && (a->current == b->current) && (a->open_mv == b->open_mv);
}

static bool power_module_reading_same(const keel_power_module_reading_t *a,
                                      const keel_power_module_reading_t *b)
{
    return (a->voltage_mv == b->voltage_mv) && (a->current_ma == b->current_ma) &&
           (a->told == b->told);
}

#endif
