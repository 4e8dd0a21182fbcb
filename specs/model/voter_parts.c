/* SPDX-License-Identifier: Apache-2.0 */
#include "voter.h"

#include "range.h"

/* Eq. 16: VOT-003, VOT-004 */
float model_voter_agreement(float x, float y, float agree, float disagree)
{
    const float distance = (x > y) ? (x - y) : (y - x);

    if (distance <= agree) {
        return 1.0f;
    }
    if (distance >= disagree) {
        return 0.0f;
    }
    return (disagree - distance) / (disagree - agree);
}

/* Eq. 17: VOT-006 */
float model_voter_weight(const float agreement[], uint32_t others)
{
    float total = 0.0f;

    for (uint32_t i = 0u; i < (KEEL_VOTER_SENSORS - 1u); i++) {
        if (i < others) {
            total = total + agreement[i];
        }
    }
    return total / (float)others;
}

/* The quotient of eq. 18 within the samples: VOT-005 */
float model_voter_mean(float sum, float weights, float least, float most)
{
    return model_range_clamp(sum / weights, least, most);
}

/* Eq. 18, of samples that all have the weight 1: VOT-018 */
float model_voter_plain_mean(const keel_voter_sample_t sample[], uint32_t sensors, float least,
                             float most)
{
    float sum = 0.0f;

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if (i < sensors) {
            sum = sum + sample[i].value;
        }
    }
    return model_voter_mean(sum, (float)sensors, least, most);
}

/* VOT-018 */
bool model_voter_within(float least, float most, float agree)
{
    return (most - least) <= agree;
}

/* Eq. 18, of the samples that have a weight: VOT-005, VOT-016 (the order of the operations) */
float model_voter_combine(const keel_voter_sample_t sample[], const float weight[],
                          uint32_t sensors)
{
    float sum = 0.0f;
    float weights = 0.0f;
    float least = KEEL_VOTER_RANGE;
    float most = -KEEL_VOTER_RANGE;

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if ((i < sensors) && (weight[i] > 0.0f)) {
            sum = sum + (weight[i] * sample[i].value);
            weights = weights + weight[i];
            least = (sample[i].value < least) ? sample[i].value : least;
            most = (sample[i].value > most) ? sample[i].value : most;
        }
    }
    return model_voter_mean(sum, weights, least, most);
}
