/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file same.h
 * @brief Whether two objects are the same in every field: what the code leaves and what the model
 *        (specs/model) leaves.
 *
 * One function for each structure; each compares every field of it (make prove checks that none is
 * left out). Padding has no meaning and is not compared.
 */
#ifndef SAME_H
#define SAME_H

#include <stdbool.h>

/* Bit for bit, so that 0 and -0 differ. It is what the solvers take equality for: where both sides
 * are the same term, z3 sees it without looking into it (IEEE's comparison is an operation). */
static inline bool float_same(float a, float b)
{
    return __CPROVER_equal(a, b);
}

#endif
