/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file attitude_clauses.h
 * @brief Formulas of the contracts of keel_attitude_is_unit and keel_attitude_down, rounded after
 *        each operation.
 */
#ifndef ATTITUDE_CLAUSES_H
#define ATTITUDE_CLAUSES_H

#include "attitude_proof.h"

static bool components_here(keel_attitude_quaternion_t q)
{
    return within(q.w, -COMPONENT_LIMIT, COMPONENT_LIMIT) &&
           within(q.x, -COMPONENT_LIMIT, COMPONENT_LIMIT) &&
           within(q.y, -COMPONENT_LIMIT, COMPONENT_LIMIT) &&
           within(q.z, -COMPONENT_LIMIT, COMPONENT_LIMIT);
}

static bool is_unit_here(keel_attitude_quaternion_t q)
{
    const float n = ((q.w * q.w) + (q.x * q.x)) + ((q.y * q.y) + (q.z * q.z));

    return within(n, KEEL_ATTITUDE_NORM_MIN, KEEL_ATTITUDE_NORM_MAX);
}

/* Twice a number is its sum with itself, which is exact. */
static float down_here(keel_attitude_quaternion_t q)
{
    return 1.0f - ((q.x * (q.x + q.x)) + (q.y * (q.y + q.y)));
}

#endif
