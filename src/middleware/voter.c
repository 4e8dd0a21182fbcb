/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/voter.h"

#include "keel/middleware/range.h"

/*@ assigns \nothing; */
static bool is_above(float disagree, float agree)
{
    return (disagree > agree) && (disagree <= KEEL_VOTER_RANGE);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @*/
static bool is_cutoff_valid(const keel_voter_config_t *config)
{
    /* The factor first: its product with a is then finite. */
    return keel_range_contains(config->cutoff, 1.0f, KEEL_VOTER_RANGE / KEEL_VOTER_AGREE_MIN) &&
           is_above((config->cutoff * config->agree), config->agree);
}

keel_status_t keel_voter_check(const keel_voter_config_t *config)
{
    if ((config->sensors < 2u) || (config->sensors > KEEL_VOTER_SENSORS)) {
        return KEEL_ERR_SENSORS;
    }
    if (!keel_range_contains(config->agree, KEEL_VOTER_AGREE_MIN, KEEL_VOTER_AGREE_MAX) ||
        !keel_range_contains(config->slope, 0.0f, 1.0f)) {
        return KEEL_ERR_AGREEMENT;
    }
    if (!is_cutoff_valid(config)) {
        return KEEL_ERR_CUTOFF;
    }
    if (!keel_range_contains(config->lowest, -KEEL_VOTER_RANGE, KEEL_VOTER_RANGE) ||
        !keel_range_contains(config->highest, config->lowest, KEEL_VOTER_RANGE)) {
        return KEEL_ERR_LIMITS;
    }
    if (!keel_range_contains(config->initial, config->lowest, config->highest)) {
        return KEEL_ERR_INITIAL;
    }
    if (config->max_age_us == 0u) {
        return KEEL_ERR_AGE;
    }
    return (config->latch_count == 0u) ? KEEL_ERR_LATCH : KEEL_OK;
}

keel_status_t keel_voter_init(keel_voter_t *voter, const keel_voter_config_t *config)
{
    const keel_status_t status = keel_voter_check(config);

    if (status != KEEL_OK) {
        return status;
    }
    voter->config = *config;
    voter->agree = config->agree;
    voter->disagree = config->cutoff * config->agree;
    voter->unanimous = false;
    voter->vote.output = config->initial;
    voter->vote.held = 0u;
    voter->vote.held_us = 0u;
    voter->vote.state = KEEL_VOTER_NONE;
    voter->vote.contributing = 0u;
    /*@ loop invariant 0 <= i <= KEEL_VOTER_SENSORS;
      @ loop assigns i, voter->sensor[0 .. KEEL_VOTER_SENSORS - 1],
      @     voter->vote.weight[0 .. KEEL_VOTER_SENSORS - 1],
      @     voter->vote.reason[0 .. KEEL_VOTER_SENSORS - 1];
      @ loop variant KEEL_VOTER_SENSORS - i;
      @*/
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

void keel_voter_scale(keel_voter_t *voter)
{
    const keel_voter_config_t *const config = &voter->config;
    const float output = voter->vote.output;
    const float magnitude = (output < 0.0f) ? -output : output;
    const float wished = config->agree + (config->slope * magnitude);
    const float agree = (wished < KEEL_VOTER_AGREE_MAX) ? wished : KEEL_VOTER_AGREE_MAX;
    const float disagree = config->cutoff * agree;

    if (is_above(disagree, agree)) {
        voter->agree = agree;
        voter->disagree = disagree;
    } else {
        voter->agree = config->agree;
        voter->disagree = config->cutoff * config->agree;
    }
}

float keel_voter_agreement(float x, float y, float agree, float disagree)
{
    const float distance = (x > y) ? (x - y) : (y - x);

    if (distance <= agree) {
        return 1.0f;
    }
    return (distance >= disagree) ? 0.0f : ((disagree - distance) / (disagree - agree));
}

float keel_voter_weight(const float agreement[], uint32_t others)
{
    float total = 0.0f;

    /*@ loop invariant 0 <= i <= others;
      @ loop assigns i, total;
      @ loop variant others - i;
      @*/
    for (uint32_t i = 0u; i < others; i++) {
        total += agreement[i];
    }
    return total / (float)others;
}

float keel_voter_mean(float sum, float weights, float least, float most)
{
    return keel_range_clamp(sum / weights, least, most);
}

float keel_voter_plain_mean(const keel_voter_sample_t sample[], uint32_t sensors, float least,
                            float most)
{
    float sum = 0.0f; /* As in eq. 18: a sum that starts with -0 could be -0. */

    /*@ loop invariant 0 <= i <= sensors;
      @ loop assigns i, sum;
      @ loop variant sensors - i;
      @*/
    for (uint32_t i = 0u; i < sensors; i++) {
        sum += sample[i].value;
    }
    return keel_voter_mean(sum, (float)sensors, least, most);
}

bool keel_voter_within(float least, float most, float agree)
{
    return (most - least) <= agree;
}

float keel_voter_combine(const keel_voter_sample_t sample[], const float weight[], uint32_t sensors)
{
    float sum = 0.0f;
    float weights = 0.0f;
    float least = KEEL_VOTER_RANGE;
    float most = -KEEL_VOTER_RANGE;

    /*@ loop invariant 0 <= i <= sensors;
      @ loop assigns i, sum, weights, least, most;
      @ loop variant sensors - i;
      @*/
    for (uint32_t i = 0u; i < sensors; i++) {
        if (weight[i] > 0.0f) {
            const float value = sample[i].value;

            sum += weight[i] * value;
            weights += weight[i];
            least = (value < least) ? value : least;
            most = (value > most) ? value : most;
        }
    }
    return keel_voter_mean(sum, weights, least, most);
}

/*@ assigns \nothing;
  @ ensures \result == ((value < UINT16_MAX) ? value + 1 : UINT16_MAX);
  @*/
static uint16_t one_more(uint16_t value)
{
    return (value < UINT16_MAX) ? (uint16_t)(value + 1u) : value;
}

/* Why a sample cannot be used, latch and staleness aside, or KEEL_VOTER_USED (VOT-007). */
/*@ requires \valid_read(config) && \valid_read(sample);
  @ requires \is_finite(config->lowest) && \is_finite(config->highest);
  @ assigns \nothing;
  @*/
static uint8_t inspect_sample(const keel_voter_config_t *config, const keel_voter_sample_t *sample)
{
    if (!sample->present) {
        return KEEL_VOTER_MISSING;
    }
    if (!keel_range_contains(sample->value, config->lowest, config->highest)) {
        return keel_range_contains(sample->value, -KEEL_RANGE_LARGEST, KEEL_RANGE_LARGEST)
                   ? KEEL_VOTER_OUT_OF_RANGE
                   : KEEL_VOTER_NOT_FINITE;
    }
    return (sample->age_us > config->max_age_us) ? KEEL_VOTER_LATE : KEEL_VOTER_USED;
}

/* Whether a sensor has repeated itself for too long (VOT-013). */
/*@ requires \valid_read(config) && \valid_read(sensor);
  @ assigns \nothing;
  @ ensures stale: \result <==> 0 < config->stale_count <= sensor->unchanged_votes;
  @*/
static bool is_stale(const keel_voter_config_t *config, const keel_voter_sensor_t *sensor)
{
    return (config->stale_count > 0u) && (sensor->unchanged_votes >= config->stale_count);
}

/* Keeps a sample that has changed, and counts the votes without a change (VOT-013). */
/*@ requires \valid(sensor);
  @ assigns sensor->last, sensor->unchanged_votes;
  @*/
static void compare_with_last(keel_voter_sensor_t *sensor, float value)
{
    if (value != sensor->last) {
        sensor->last = value;
        sensor->unchanged_votes = 0u;
    } else {
        sensor->unchanged_votes = one_more(sensor->unchanged_votes);
    }
}

/* Looks at every sample, those of latched sensors too; how many are usable (VOT-007, VOT-013). */
/*@ requires \valid(voter) && voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ requires \valid_read(sample + (0 .. voter->config.sensors - 1));
  @ requires \separated(voter, sample + (0 .. voter->config.sensors - 1));
  @ requires \is_finite(voter->config.lowest) && \is_finite(voter->config.highest);
  @ assigns voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].last,
  @     voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].unchanged_votes,
  @     voter->vote.reason[0 .. KEEL_VOTER_SENSORS - 1];
  @*/
static uint32_t inspect_samples(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    const keel_voter_config_t *const config = &voter->config;
    uint32_t usable = 0u;

    /*@ loop invariant 0 <= i <= voter->config.sensors && usable <= i;
      @ loop assigns i, usable, voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].last,
      @     voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].unchanged_votes,
      @     voter->vote.reason[0 .. KEEL_VOTER_SENSORS - 1];
      @ loop variant voter->config.sensors - i;
      @*/
    for (uint32_t i = 0u; i < voter->config.sensors; i++) {
        keel_voter_sensor_t *const sensor = &voter->sensor[i];
        uint8_t reason = inspect_sample(config, &sample[i]);

        if ((reason == KEEL_VOTER_USED) || (reason >= KEEL_VOTER_OUT_OF_RANGE)) {
            compare_with_last(sensor, sample[i].value);
        }
        if ((reason == KEEL_VOTER_USED) && is_stale(config, sensor)) {
            reason = KEEL_VOTER_STALE;
        }
        voter->vote.reason[i] = sensor->latched ? KEEL_VOTER_LATCHED : reason;
        usable += (voter->vote.reason[i] == KEEL_VOTER_USED) ? 1u : 0u;
    }
    return usable;
}

/* Each sample's agreements with the others, in the order of the sensors. */
typedef struct agreements {
    float of[KEEL_VOTER_SENSORS][KEEL_VOTER_SENSORS - 1u];
} agreements_t;

/* Compares each pair; the agreement is 0 where one of the two is not usable. */
/*@ requires \valid_read(voter) && voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ requires \valid_read(sample + (0 .. voter->config.sensors - 1)) && \valid(agreement);
  @ requires \separated(agreement, voter, sample + (0 .. voter->config.sensors - 1));
  @ requires \is_finite(voter->agree) &&
  @     KEEL_VOTER_AGREE_MIN <= voter->agree <= KEEL_VOTER_AGREE_MAX;
  @ assigns agreement->of[0 .. KEEL_VOTER_SENSORS - 1][0 .. KEEL_VOTER_SENSORS - 2];
  @*/
static void compare_samples(const keel_voter_t *voter, const keel_voter_sample_t sample[],
                            agreements_t *agreement)
{
    const uint8_t *const reason = voter->vote.reason;
    const uint32_t sensors = voter->config.sensors;
    const float agree = voter->agree;
    const float disagree = voter->disagree;

    /*@ loop invariant 1 <= j && (sensors >= 1 ==> j <= sensors);
      @ loop assigns j, agreement->of[0 .. KEEL_VOTER_SENSORS - 1][0 .. KEEL_VOTER_SENSORS - 2];
      @ loop variant sensors - j;
      @*/
    for (uint32_t j = 1u; j < sensors; j++) {
        /*@ loop invariant 0 <= i <= j;
          @ loop assigns i,
          @     agreement->of[0 .. KEEL_VOTER_SENSORS - 1][0 .. KEEL_VOTER_SENSORS - 2];
          @ loop variant j - i;
          @*/
        for (uint32_t i = 0u; i < j; i++) {
            float s = 0.0f;

            if ((reason[i] == KEEL_VOTER_USED) && (reason[j] == KEEL_VOTER_USED)) {
                s = keel_voter_agreement(sample[i].value, sample[j].value, agree, disagree);
            }
            agreement->of[i][j - 1u] = s;
            agreement->of[j][i] = s;
        }
    }
}

/*@ assigns \nothing;
  @ ensures \result == \min(a + b, UINT32_MAX);
  @*/
static uint32_t add_saturated(uint32_t a, uint32_t b)
{
    return (a <= (UINT32_MAX - b)) ? (a + b) : UINT32_MAX;
}

/* The output, or another vote without one (VOT-008). */
/*@ requires \valid(voter) && 2 <= voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ requires \valid_read(sample + (0 .. voter->config.sensors - 1));
  @ requires \separated(voter, sample + (0 .. voter->config.sensors - 1));
  @ assigns voter->vote.state, voter->vote.output, voter->vote.held, voter->vote.held_us;
  @*/
static void conclude_vote(keel_voter_t *voter, const keel_voter_sample_t sample[], uint32_t usable,
                          bool agreed, uint32_t elapsed_us)
{
    keel_vote_t *const vote = &voter->vote;

    if (vote->contributing > 0u) {
        if (agreed) {
            vote->state = (usable == 1u) ? KEEL_VOTER_SINGLE : KEEL_VOTER_MEAN;
        } else {
            vote->state = KEEL_VOTER_MEDIAN;
        }
        vote->output = keel_voter_combine(sample, vote->weight, voter->config.sensors);
        vote->held = 0u;
        vote->held_us = 0u;
    } else {
        vote->state = (usable == 0u) ? KEEL_VOTER_NONE : KEEL_VOTER_DISAGREE;
        vote->held = add_saturated(vote->held, 1u);
        vote->held_us = add_saturated(vote->held_us, elapsed_us);
    }
}

/* A vote to which a sensor contributed (VOT-010, VOT-012). */
/*@ requires \valid(sensor);
  @ assigns sensor->condemned_votes, sensor->density;
  @ ensures clear: sensor->condemned_votes == 0;
  @ ensures leak: sensor->density == \max(\old(sensor->density) - 1, 0);
  @*/
static void clear_sensor(keel_voter_sensor_t *sensor)
{
    sensor->condemned_votes = 0u;
    if (sensor->density > 0u) {
        sensor->density--;
    }
}

/* A vote that condemns a sensor (VOT-010 to VOT-012). */
/*@ requires \valid_read(config) && \valid(sensor) && \separated(config, sensor);
  @ assigns sensor->condemned_votes, sensor->density, sensor->latched;
  @ ensures count:
  @     sensor->condemned_votes == \min(\old(sensor->condemned_votes) + 1, UINT16_MAX);
  @ ensures fill: sensor->density == \min(\old(sensor->density) + 1, UINT16_MAX);
  @ ensures latch: sensor->latched <==> (sensor->condemned_votes >= config->latch_count ||
  @     (config->density_limit > 0 && sensor->density >= config->density_limit));
  @*/
static void condemn_sensor(const keel_voter_config_t *config, keel_voter_sensor_t *sensor)
{
    sensor->condemned_votes = one_more(sensor->condemned_votes);
    sensor->density = one_more(sensor->density);
    sensor->latched = (sensor->condemned_votes >= config->latch_count) ||
                      ((config->density_limit > 0u) && (sensor->density >= config->density_limit));
}

/* Those between the least and the most of the usable samples: the median of three, the two in the
 * middle of four (VOT-020). */
/*@ requires \valid(voter) && 2 <= voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ requires \valid_read(sample + (0 .. voter->config.sensors - 1));
  @ requires \separated(voter, sample + (0 .. voter->config.sensors - 1));
  @ assigns voter->vote.weight[0 .. KEEL_VOTER_SENSORS - 1];
  @*/
static void take_middle(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    const uint32_t sensors = voter->config.sensors;
    float least = KEEL_VOTER_RANGE;
    float most = -KEEL_VOTER_RANGE;

    /*@ loop invariant 0 <= i <= sensors;
      @ loop assigns i, least, most;
      @ loop variant sensors - i;
      @*/
    for (uint32_t i = 0u; i < sensors; i++) {
        if (voter->vote.reason[i] == KEEL_VOTER_USED) {
            least = (sample[i].value < least) ? sample[i].value : least;
            most = (sample[i].value > most) ? sample[i].value : most;
        }
    }
    /*@ loop invariant 0 <= i <= sensors;
      @ loop assigns i, voter->vote.weight[0 .. KEEL_VOTER_SENSORS - 1];
      @ loop variant sensors - i;
      @*/
    for (uint32_t i = 0u; i < sensors; i++) {
        if ((voter->vote.reason[i] == KEEL_VOTER_USED) && (least < sample[i].value) &&
            (sample[i].value < most)) {
            voter->vote.weight[i] = 1.0f;
        }
    }
}

/* Weighs each usable sample; whether any has a weight. One that is alone has nobody to agree
 * with. */
/*@ requires \valid(voter) && 2 <= voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ requires \valid_read(agreement) && \separated(voter, agreement);
  @ assigns voter->vote.weight[0 .. KEEL_VOTER_SENSORS - 1];
  @*/
static bool weigh_sensors(keel_voter_t *voter, const agreements_t *agreement, uint32_t usable)
{
    const uint32_t sensors = voter->config.sensors;
    bool agreed = false;

    /*@ loop invariant 0 <= i <= sensors;
      @ loop assigns i, agreed, voter->vote.weight[0 .. KEEL_VOTER_SENSORS - 1];
      @ loop variant sensors - i;
      @*/
    for (uint32_t i = 0u; i < sensors; i++) {
        float weight = 0.0f;

        if (voter->vote.reason[i] == KEEL_VOTER_USED) {
            weight = (usable == 1u) ? 1.0f : keel_voter_weight(agreement->of[i], sensors - 1u);
        }
        voter->vote.weight[i] = weight;
        agreed = agreed || (weight > 0.0f);
    }
    return agreed;
}

/* Tells what the vote means for each sensor. A usable sample without weight was outvoted. Where
 * nobody agrees, or nothing is usable, nobody knows which is wrong. */
/*@ requires \valid(voter) && 2 <= voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ assigns voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].condemned_votes,
  @     voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].density,
  @     voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].latched,
  @     voter->vote.reason[0 .. KEEL_VOTER_SENSORS - 1], voter->vote.contributing;
  @*/
static void judge_sensors(keel_voter_t *voter, uint32_t usable, bool agreed)
{
    keel_vote_t *const vote = &voter->vote;
    const uint32_t sensors = voter->config.sensors;
    uint8_t contributing = 0u;

    /*@ loop invariant 0 <= i <= sensors && contributing <= i;
      @ loop assigns i, contributing, voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].condemned_votes,
      @     voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].density,
      @     voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].latched,
      @     voter->vote.reason[0 .. KEEL_VOTER_SENSORS - 1];
      @ loop variant sensors - i;
      @*/
    for (uint32_t i = 0u; i < sensors; i++) {
        if ((vote->reason[i] == KEEL_VOTER_USED) && (vote->weight[i] <= 0.0f)) {
            vote->reason[i] = KEEL_VOTER_OUTVOTED;
        }
        if (vote->reason[i] == KEEL_VOTER_USED) {
            contributing++;
            clear_sensor(&voter->sensor[i]);
        } else if (((vote->reason[i] >= KEEL_VOTER_MISSING) && (usable > 0u)) ||
                   ((vote->reason[i] == KEEL_VOTER_OUTVOTED) && agreed)) {
            condemn_sensor(&voter->config, &voter->sensor[i]);
        } else {
            /* Latched already, or nobody knows. */
        }
    }
    vote->contributing = contributing;
}

/* Whether all agreed fully, and nothing is counted against any. */
/*@ requires \valid_read(voter) && voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ assigns \nothing;
  @*/
static bool is_unanimous(const keel_voter_t *voter)
{
    const uint32_t sensors = voter->config.sensors;
    bool unanimous = voter->vote.contributing == sensors;

    /*@ loop invariant 0 <= i <= sensors;
      @ loop assigns i, unanimous;
      @ loop variant sensors - i;
      @*/
    for (uint32_t i = 0u; unanimous && (i < sensors); i++) {
        const keel_voter_sensor_t *const sensor = &voter->sensor[i];

        unanimous = (voter->vote.weight[i] >= 1.0f) && (sensor->unchanged_votes == 0u) &&
                    (sensor->density == 0u);
    }
    return unanimous;
}

void keel_voter_step(keel_voter_t *voter, const keel_voter_sample_t sample[], uint32_t elapsed_us)
{
    const uint32_t usable = inspect_samples(voter, sample);
    agreements_t agreement;
    bool agreed;

    compare_samples(voter, sample, &agreement);
    agreed = weigh_sensors(voter, &agreement, usable);
    if (!agreed && (usable > 2u)) {
        take_middle(voter, sample);
    }
    judge_sensors(voter, usable, agreed);
    conclude_vote(voter, sample, usable, agreed, elapsed_us);
    voter->unanimous = is_unanimous(voter);
}

bool keel_voter_step_unanimous(keel_voter_t *voter, const keel_voter_sample_t sample[],
                               uint32_t oldest_us)
{
    const uint32_t sensors = voter->config.sensors;
    const float lowest = voter->config.lowest;
    const float first = sample[0].value;
    float least = first;
    float most = first;

    if (!voter->unanimous || (oldest_us > voter->config.max_age_us) || !(first >= lowest) ||
        (first == voter->sensor[0].last)) {
        return false;
    }
    /*@ loop invariant 1 <= i <= sensors;
      @ loop assigns i, least, most;
      @ loop variant sensors - i;
      @*/
    for (uint32_t i = 1u; i < sensors; i++) {
        const float value = sample[i].value;

        if (!(value >= lowest) || (value == voter->sensor[i].last)) {
            return false; /* NaN, too, is not at least the lowest. */
        }
        least = (least > value) ? value : least;
        most = (value > most) ? value : most;
    }
    if ((most > voter->config.highest) || !keel_voter_within(least, most, voter->agree)) {
        return false;
    }
    voter->sensor[0].last = first;
    /*@ loop invariant 1 <= i <= sensors;
      @ loop assigns i, voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].last;
      @ loop variant sensors - i;
      @*/
    for (uint32_t i = 1u; i < sensors; i++) {
        voter->sensor[i].last = sample[i].value;
    }
    voter->vote.output = keel_voter_plain_mean(sample, sensors, least, most);
    return true;
}

keel_status_t keel_voter_readmit(keel_voter_t *voter, uint32_t sensor)
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

/* Whether a vote speaks for a latched sensor: its sample is usable and lies within a of the output,
 * if there is one (VOT-021). */
/*@ requires \valid_read(voter) && \valid_read(sensor) && \valid_read(sample);
  @ requires \is_finite(voter->config.lowest) && \is_finite(voter->config.highest);
  @ requires \is_finite(voter->agree) &&
  @     KEEL_VOTER_AGREE_MIN <= voter->agree <= KEEL_VOTER_AGREE_MAX;
  @ assigns \nothing;
  @*/
static bool speaks_for(const keel_voter_t *voter, const keel_voter_sensor_t *sensor,
                       const keel_voter_sample_t *sample)
{
    const float output = voter->vote.output;
    const float value = sample->value;

    if ((inspect_sample(&voter->config, sample) != KEEL_VOTER_USED) ||
        is_stale(&voter->config, sensor)) {
        return false;
    }
    if (voter->vote.contributing == 0u) {
        return true;
    }
    return (value < output) ? keel_voter_within(value, output, voter->agree)
                            : keel_voter_within(output, value, voter->agree);
}

void keel_voter_reconsider(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    const uint16_t enough = voter->config.readmit_count;

    /*@ loop invariant 0 <= i <= voter->config.sensors;
      @ loop assigns i, voter->sensor[0 .. KEEL_VOTER_SENSORS - 1];
      @ loop variant voter->config.sensors - i;
      @*/
    for (uint32_t i = 0u; i < voter->config.sensors; i++) {
        keel_voter_sensor_t *const sensor = &voter->sensor[i];

        if (sensor->latched) {
            sensor->probation = speaks_for(voter, sensor, &sample[i]) ? one_more(sensor->probation)
                                                                      : 0u;
            if ((enough > 0u) && (sensor->probation >= enough)) {
                (void)keel_voter_readmit(voter, i); /* It is latched: not refused. */
            }
        }
    }
}
