// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_mean
//
// Quotients that are whole numbers, and the clamp.
#include "../common/voter_contracts.h"

void keel_voter_mean__exact_harness(void)
{
    const uint32_t quotient = nondet_u8() & 7u;
    const uint32_t weights = (nondet_u8() & 3u) + 1u;
    const uint32_t least = nondet_u8() & 7u;
    const uint32_t most = nondet_u8() & 7u;
    float mean;

    __CPROVER_assume(least <= most);

    mean = keel_voter_mean((float)(quotient * weights), (float)weights, (float)least, (float)most);

    __CPROVER_assert(mean == (float)((quotient < least)  ? least
                                     : (quotient > most) ? most
                                                         : quotient),
                     "VOT_005_mean: the quotient, or the sample next to it");
}
