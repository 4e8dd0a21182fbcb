/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file unchanged.h
 * @brief Whether an object is what it was, bit for bit: what a refusal must not change (STA-001).
 */
#ifndef UNCHANGED_H
#define UNCHANGED_H

#include <stdbool.h>
#include <stddef.h>

size_t nondet_size(void);

/* Compares one arbitrary byte, so all of them: NaN is the same as itself here. */
static bool unchanged(const void *is, const void *was, size_t size)
{
    const size_t i = nondet_size();

    __CPROVER_assume(i < size);
    return ((const unsigned char *)is)[i] == ((const unsigned char *)was)[i];
}

#endif
