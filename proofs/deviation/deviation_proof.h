/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file deviation_proof.h
 * @brief What the harnesses of keel/rtos/deviation.h share.
 */
#ifndef DEVIATION_PROOF_H
#define DEVIATION_PROOF_H

#include "../common/keel_proof.h"
#include "keel/rtos/deviation.h"

static bool deviation_same(const keel_deviation_t *a, const keel_deviation_t *b)
{
    return (a->sum_us2 == b->sum_us2) && (a->start_us == b->start_us) && (a->starts == b->starts);
}

#endif
