// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/position.c src/flight/axis.c
// covers: keel_position_set_origin cosine_of
//
// Any valid estimator, any latitude and longitude: the contract, clause by clause; the estimator
// stays valid, and no operation overflows or gives a NaN.
#include "../common/unchanged.h"
#include "position_proof.h"

static bool is_origin(int32_t latitude, int32_t longitude)
{
    return (-KEEL_POSITION_LATITUDE_LIMIT <= latitude) &&
           (latitude <= KEEL_POSITION_LATITUDE_LIMIT) && (-KEEL_POSITION_HALF_TURN <= longitude) &&
           (longitude <= KEEL_POSITION_HALF_TURN);
}

void keel_position_set_origin__valid_harness(void)
{
    const int32_t latitude = nondet_s32();
    const int32_t longitude = nondet_s32();
    keel_position_t position = any_position_at_all();
    const keel_position_t before = position;
    const bool fits = is_origin(latitude, longitude);
    keel_status_t status;

    __CPROVER_assume(position_valid(&position));

    status = keel_position_set_origin(&position, latitude, longitude);

    __CPROVER_assert(fits || ((status == KEEL_ERR_VALUE) &&
                              unchanged(&position, &before, sizeof(position))),
                     "POS_003_refused: what is none is refused, and changes nothing");
    __CPROVER_assert(!fits || (status == KEEL_OK), "POS_003_ok: all else is taken");
    __CPROVER_assert(!fits || (position.has_origin && (position.latitude == latitude) &&
                               (position.longitude == longitude)),
                     "POS_003_set: there is an origin");
    __CPROVER_assert(!fits || ((position.quality == KEEL_AXIS_NONE) &&
                               (position.north.quality == KEEL_AXIS_NONE) &&
                               (position.east.quality == KEEL_AXIS_NONE)),
                     "POS_003_forgotten: nothing is known");
    __CPROVER_assert(position_valid(&position), "POS_004_valid: it stays valid");
}
