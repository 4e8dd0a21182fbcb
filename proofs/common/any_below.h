/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file any_below.h
 * @brief A number below another one, for arrays: an index at which two of them are compared.
 */
#ifndef ANY_BELOW_H
#define ANY_BELOW_H

#include <stdint.h>

uint32_t nondet_u32(void);

static uint32_t any_below(uint32_t limit)
{
    const uint32_t value = nondet_u32();

    __CPROVER_assume(value < limit);
    return value;
}

#endif
