/* SPDX-License-Identifier: Apache-2.0 */
#include "voter.h"

#include "range.h"

/* VOT-001. The product n a comes last: with the factors in their ranges it is finite. */
static bool cutoff_is_valid(const keel_voter_config_t *config)
{
    return model_range_contains(config->cutoff, 1.0f, KEEL_VOTER_RANGE / KEEL_VOTER_AGREE_MIN) &&
           ((config->cutoff * config->agree) > config->agree) &&
           ((config->cutoff * config->agree) <= KEEL_VOTER_RANGE);
}

keel_status_t model_voter_check(const keel_voter_config_t *config)
{
    if ((config->sensors < 2u) || (KEEL_VOTER_SENSORS < config->sensors)) {
        return KEEL_ERR_SENSORS;
    }
    if (!model_range_contains(config->agree, KEEL_VOTER_AGREE_MIN, KEEL_VOTER_AGREE_MAX) ||
        !model_range_contains(config->slope, 0.0f, 1.0f)) {
        return KEEL_ERR_AGREEMENT;
    }
    if (!cutoff_is_valid(config)) {
        return KEEL_ERR_CUTOFF;
    }
    if (!model_range_contains(config->lowest, -KEEL_VOTER_RANGE, KEEL_VOTER_RANGE) ||
        !model_range_contains(config->highest, config->lowest, KEEL_VOTER_RANGE)) {
        return KEEL_ERR_LIMITS;
    }
    if (!model_range_contains(config->initial, config->lowest, config->highest)) {
        return KEEL_ERR_INITIAL;
    }
    if (config->max_age_us == 0u) {
        return KEEL_ERR_AGE;
    }
    if (config->latch_count == 0u) {
        return KEEL_ERR_LATCH;
    }
    return KEEL_OK;
}

/* VOT-002 */
keel_status_t model_voter_init(keel_voter_t *voter, const keel_voter_config_t *config)
{
    const keel_status_t status = model_voter_check(config);

    if (status != KEEL_OK) {
        return status;
    }
    voter->config = *config;
    voter->agree = config->agree;
    voter->disagree = config->cutoff * config->agree;
    voter->vote.output = config->initial;
    voter->vote.held = 0u;
    voter->vote.held_us = 0u;
    voter->vote.state = KEEL_VOTER_NONE;
    voter->vote.contributing = 0u;
    voter->unanimous = false;
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        voter->sensor[i].last = config->initial;
        voter->sensor[i].unchanged_votes = 0u;
        voter->sensor[i].condemned_votes = 0u;
        voter->sensor[i].density = 0u;
        voter->sensor[i].probation = 0u;
        voter->sensor[i].latched = false;
        voter->vote.weight[i] = 0.0f;
        voter->vote.reason[i] = KEEL_VOTER_USED;
    }
    return KEEL_OK;
}

/* VOT-019: a of the next vote, and n a; those of the configuration where n a is too much. */
void model_voter_scale(keel_voter_t *voter)
{
    const keel_voter_config_t config = voter->config;
    const float magnitude = (voter->vote.output < 0.0f) ? -voter->vote.output : voter->vote.output;
    const float wished = config.agree + (config.slope * magnitude);
    const float agree = (wished < KEEL_VOTER_AGREE_MAX) ? wished : KEEL_VOTER_AGREE_MAX;
    const float disagree = config.cutoff * agree;
    const bool is_valid = (disagree > agree) && (disagree <= KEEL_VOTER_RANGE);

    voter->agree = is_valid ? agree : config.agree;
    voter->disagree = is_valid ? disagree : (config.cutoff * config.agree);
}

static uint16_t one_more(uint16_t count)
{
    return (count < UINT16_MAX) ? (uint16_t)(count + 1u) : UINT16_MAX;
}

/* Why a sample is of no use, the first reason that applies, be its sensor latched or not; staleness
 * comes later. VOT-007 */
static uint8_t first_reason(const keel_voter_config_t *config, const keel_voter_sample_t *sample)
{
    if (!sample->present) {
        return KEEL_VOTER_MISSING;
    }
    if (!model_range_contains(sample->value, -KEEL_RANGE_LARGEST, KEEL_RANGE_LARGEST)) {
        return KEEL_VOTER_NOT_FINITE;
    }
    if (!model_range_contains(sample->value, config->lowest, config->highest)) {
        return KEEL_VOTER_OUT_OF_RANGE;
    }
    if (sample->age_us > config->max_age_us) {
        return KEEL_VOTER_LATE;
    }
    return KEEL_VOTER_USED;
}

/* Whether a sample can be compared with the sensor's last one: it is finite, plausible or not. */
static bool is_readable(uint8_t reason)
{
    return (reason == KEEL_VOTER_USED) || (reason == KEEL_VOTER_OUT_OF_RANGE) ||
           (reason == KEEL_VOTER_LATE);
}

/* Reasons of all samples. A change is kept, and votes without one are counted: VOT-013. 0 and -0
 * are no change. */
static void look(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if (i < voter->config.sensors) {
            const uint8_t reason = first_reason(&voter->config, &sample[i]);
            const bool changed = sample[i].value != voter->sensor[i].last;

            if (is_readable(reason)) {
                voter->sensor[i].unchanged_votes = changed
                                                       ? 0u
                                                       : one_more(voter->sensor[i].unchanged_votes);
                voter->sensor[i].last = changed ? sample[i].value : voter->sensor[i].last;
            }
            voter->vote.reason[i] = voter->sensor[i].latched ? KEEL_VOTER_LATCHED : reason;
        }
    }
}

/* Whether a sensor has repeated itself for too long: VOT-013 */
static bool is_stale(const keel_voter_config_t *config, const keel_voter_sensor_t *sensor)
{
    return (config->stale_count != 0u) && (config->stale_count <= sensor->unchanged_votes);
}

/* Of the usable samples, those whose sensor has not changed for too long: VOT-013 */
static void exclude_stale(keel_voter_t *voter)
{
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if ((i < voter->config.sensors) && (voter->vote.reason[i] == KEEL_VOTER_USED) &&
            is_stale(&voter->config, &voter->sensor[i])) {
            voter->vote.reason[i] = KEEL_VOTER_STALE;
        }
    }
}

/* How many samples have the reason KEEL_VOTER_USED. */
static uint32_t used(const keel_voter_t *voter)
{
    uint32_t count = 0u;

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if ((i < voter->config.sensors) && (voter->vote.reason[i] == KEEL_VOTER_USED)) {
            count++;
        }
    }
    return count;
}

/* The agreements of all pairs; 0 where one of the two is not usable. */
typedef struct agreements {
    float of[KEEL_VOTER_SENSORS][KEEL_VOTER_SENSORS];
} agreements_t;

static agreements_t compare(const keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    agreements_t agreements = {{{0.0f}}};

    for (uint32_t j = 0u; j < KEEL_VOTER_SENSORS; j++) {
        for (uint32_t i = 0u; i < j; i++) {
            if ((j < voter->config.sensors) && (voter->vote.reason[i] == KEEL_VOTER_USED) &&
                (voter->vote.reason[j] == KEEL_VOTER_USED)) {
                agreements.of[i][j] = model_voter_agreement(sample[i].value, sample[j].value,
                                                            voter->agree, voter->disagree);
                agreements.of[j][i] = agreements.of[i][j];
            }
        }
    }
    return agreements;
}

/* The weight of sample i: the mean of its agreements with all others. VOT-006 */
static float weight_of(const agreements_t *agreements, uint32_t i, uint32_t sensors)
{
    float agreement[KEEL_VOTER_SENSORS - 1u] = {0.0f};
    uint32_t others = 0u;

    for (uint32_t j = 0u; j < KEEL_VOTER_SENSORS; j++) {
        if ((j < sensors) && (j != i)) {
            agreement[others] = agreements->of[i][j];
            others++;
        }
    }
    return model_voter_weight(agreement, others);
}

/* Weights of all samples: 0 for what is not usable, 1 for what alone is (VOT-009). */
static void weigh(keel_voter_t *voter, const keel_voter_sample_t sample[], uint32_t usable)
{
    const uint32_t sensors = voter->config.sensors;
    const agreements_t agreements = compare(voter, sample);

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if (i < sensors) {
            voter->vote.weight[i] = 0.0f;
            if (voter->vote.reason[i] == KEEL_VOTER_USED) {
                voter->vote.weight[i] = (usable == 1u) ? 1.0f : weight_of(&agreements, i, sensors);
            }
        }
    }
}

/* Whether any sample has a weight. */
static bool has_weight(const keel_voter_t *voter)
{
    bool has = false;

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        has = has || ((i < voter->config.sensors) && (voter->vote.weight[i] > 0.0f));
    }
    return has;
}

/* Whether one usable sample lies below a value, and one above it. */
static bool lies_between(const keel_voter_t *voter, const keel_voter_sample_t sample[], float value)
{
    bool below = false;
    bool above = false;

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if ((i < voter->config.sensors) && (voter->vote.reason[i] == KEEL_VOTER_USED)) {
            below = below || (sample[i].value < value);
            above = above || (value < sample[i].value);
        }
    }
    return below && above;
}

/* The usable samples in the middle of three or four have the weight 1: VOT-020 */
static void weigh_middle(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if ((i < voter->config.sensors) && (voter->vote.reason[i] == KEEL_VOTER_USED) &&
            lies_between(voter, sample, sample[i].value)) {
            voter->vote.weight[i] = 1.0f;
        }
    }
}

/* What is usable and has no weight was outvoted: VOT-006 */
static void outvote(keel_voter_t *voter)
{
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if ((i < voter->config.sensors) && (voter->vote.reason[i] == KEEL_VOTER_USED) &&
            (voter->vote.weight[i] <= 0.0f)) {
            voter->vote.reason[i] = KEEL_VOTER_OUTVOTED;
        }
    }
}

/* Whether a vote condemns a sensor: VOT-010. Where nothing is usable, or nobody agrees, nobody
 * knows which is wrong. */
static bool is_condemned(uint8_t reason, uint32_t usable, bool agreed)
{
    const bool unusable = (reason == KEEL_VOTER_MISSING) || (reason == KEEL_VOTER_NOT_FINITE) ||
                          (reason == KEEL_VOTER_OUT_OF_RANGE) || (reason == KEEL_VOTER_LATE) ||
                          (reason == KEEL_VOTER_STALE);

    return (unusable && (usable > 0u)) || ((reason == KEEL_VOTER_OUTVOTED) && agreed);
}

/* What the vote means for a sensor: VOT-010 (condemned_votes), VOT-011 (latched), VOT-012
 * (density) */
static void count(const keel_voter_config_t *config, keel_voter_sensor_t *sensor, uint8_t reason,
                  uint32_t usable, bool agreed)
{
    if (reason == KEEL_VOTER_USED) {
        sensor->condemned_votes = 0u;
        sensor->density = (sensor->density > 0u) ? (uint16_t)(sensor->density - 1u) : 0u;
    }
    if (is_condemned(reason, usable, agreed)) {
        sensor->condemned_votes = one_more(sensor->condemned_votes);
        sensor->density = one_more(sensor->density);
        sensor->latched = (sensor->condemned_votes >= config->latch_count) ||
                          ((config->density_limit > 0u) &&
                           (sensor->density >= config->density_limit));
    }
}

/* The output of a vote to which some contributed (VOT-005, VOT-009, VOT-020), else none
 * (VOT-008). */
static void conclude(keel_vote_t *vote, const keel_voter_sample_t sample[], uint32_t sensors,
                     uint32_t usable, bool agreed, uint32_t elapsed_us)
{
    const uint64_t held_us = (uint64_t)vote->held_us + elapsed_us;

    if (vote->contributing > 0u) {
        vote->state = (usable == 1u) ? KEEL_VOTER_SINGLE
                                     : (agreed ? KEEL_VOTER_MEAN : KEEL_VOTER_MEDIAN);
        vote->output = model_voter_combine(sample, vote->weight, sensors);
        vote->held = 0u;
        vote->held_us = 0u;
    } else {
        vote->state = (usable == 0u) ? KEEL_VOTER_NONE : KEEL_VOTER_DISAGREE;
        vote->held = (vote->held < UINT32_MAX) ? (vote->held + 1u) : UINT32_MAX;
        vote->held_us = (held_us < UINT32_MAX) ? (uint32_t)held_us : UINT32_MAX;
    }
}

/* Whether all weights are 1 and nothing is counted against any sensor: VOT-018 */
static bool is_unanimous(const keel_voter_t *voter)
{
    bool unanimous = voter->vote.contributing == voter->config.sensors;

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if (i < voter->config.sensors) {
            unanimous = unanimous && (voter->vote.weight[i] >= 1.0f) &&
                        (voter->sensor[i].unchanged_votes == 0u) &&
                        (voter->sensor[i].density == 0u);
        }
    }
    return unanimous;
}

void model_voter_step(keel_voter_t *voter, const keel_voter_sample_t sample[], uint32_t elapsed_us)
{
    uint32_t usable;
    bool agreed;

    look(voter, sample);
    exclude_stale(voter);
    usable = used(voter);
    weigh(voter, sample, usable);
    agreed = has_weight(voter);
    if (!agreed && (usable >= 3u)) {
        weigh_middle(voter, sample);
    }
    outvote(voter);
    voter->vote.contributing = (uint8_t)used(voter);
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if (i < voter->config.sensors) {
            count(&voter->config, &voter->sensor[i], voter->vote.reason[i], usable, agreed);
        }
    }
    conclude(&voter->vote, sample, voter->config.sensors, usable, agreed, elapsed_us);
    voter->unanimous = is_unanimous(voter);
}

/* VOT-018: the vote is taken when the last was unanimous, none of the samples is late, all are
 * plausible and within a of each other, and all have changed. */
bool model_voter_step_unanimous(keel_voter_t *voter, const keel_voter_sample_t sample[],
                                uint32_t oldest_us)
{
    const uint32_t sensors = voter->config.sensors;
    uint32_t plausible = 0u;
    uint32_t changed = 0u;
    float least = KEEL_VOTER_RANGE;
    float most = -KEEL_VOTER_RANGE;
    bool taken;

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if ((i < sensors) &&
            model_range_contains(sample[i].value, voter->config.lowest, voter->config.highest)) {
            plausible++;
            changed += (sample[i].value != voter->sensor[i].last) ? 1u : 0u;
            least = (sample[i].value < least) ? sample[i].value : least;
            most = (sample[i].value > most) ? sample[i].value : most;
        }
    }
    taken = voter->unanimous && (oldest_us <= voter->config.max_age_us) && (plausible == sensors) &&
            (changed == sensors) && model_voter_within(least, most, voter->agree);
    if (taken) {
        for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
            if (i < sensors) {
                voter->sensor[i].last = sample[i].value;
            }
        }
        voter->vote.output = model_voter_plain_mean(sample, sensors, least, most);
    }
    return taken;
}

/* VOT-014 */
keel_status_t model_voter_readmit(keel_voter_t *voter, uint32_t sensor)
{
    if (sensor >= voter->config.sensors) {
        return KEEL_ERR_SENSORS;
    }
    if (!voter->sensor[sensor].latched) {
        return KEEL_ERR_STATE;
    }
    voter->sensor[sensor].latched = false;
    voter->sensor[sensor].condemned_votes = 0u;
    voter->sensor[sensor].density = 0u;
    voter->sensor[sensor].unchanged_votes = 0u;
    voter->sensor[sensor].probation = 0u;
    return KEEL_OK;
}

/* A vote after which a latched sensor's count of good ones in a row rises; any other ends the row.
 * VOT-021 */
static bool is_good(const keel_voter_t *voter, uint32_t i, const keel_voter_sample_t *sample)
{
    const float output = voter->vote.output;
    const bool usable = (first_reason(&voter->config, sample) == KEEL_VOTER_USED) &&
                        !is_stale(&voter->config, &voter->sensor[i]);
    bool agrees = true;

    if (usable && (voter->vote.contributing > 0u)) {
        agrees = (sample->value < output) ? model_voter_within(sample->value, output, voter->agree)
                                          : model_voter_within(output, sample->value, voter->agree);
    }
    return usable && agrees;
}

/* Probation of latched sensors: VOT-021 */
void model_voter_reconsider(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if ((i < voter->config.sensors) && voter->sensor[i].latched) {
            const uint16_t row = one_more(voter->sensor[i].probation);

            voter->sensor[i].probation = is_good(voter, i, &sample[i]) ? row : 0u;
            if ((voter->config.readmit_count != 0u) &&
                (voter->config.readmit_count <= voter->sensor[i].probation)) {
                (void)model_voter_readmit(voter, i);
            }
        }
    }
}
