/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file stats_contracts.h
 * @brief keel_stats_record does what the model does; in the harness of a pass it stands in.
 */
#ifndef STATS_CONTRACTS_H
#define STATS_CONTRACTS_H

#include "keel/rtos/stats.h"
#include "keel_proof.h"

static bool keel_stats_record_may(const keel_stats_t *stats)
{
    return stats != NULL;
}

static bool keel_stats_record_does(const keel_stats_t *stats, const keel_stats_t *modelled)
{
    return stats_same(stats, modelled);
}

#endif
