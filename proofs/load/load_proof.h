/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file load_proof.h
 * @brief What the harnesses of keel/rtos/load.h share.
 */
#ifndef LOAD_PROOF_H
#define LOAD_PROOF_H

#include "../common/keel_proof.h"
#include "keel/rtos/load.h"

static bool load_same(const keel_load_t *a, const keel_load_t *b)
{
    return (a->start_us == b->start_us) && (a->busy_us == b->busy_us);
}

#endif
