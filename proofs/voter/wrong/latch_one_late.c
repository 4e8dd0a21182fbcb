// harness: keel_voter_step__verdicts_harness
// expect: VOT_011_latch
//
// Latched one vote after the count is reached.
#include "keel/middleware/voter.h"

/* The largest finite float. */
#define LARGEST 0x1.fffffep+127f

/* Comparisons with NaN are false, so this is false for NaN, too. */
static bool is_within(float value, float lowest, float highest)
{
    return (value >= lowest) && (value <= highest);
}

static bool is_above(float none, float agree)
{
    return (none > agree) && (none <= KEEL_VOTER_RANGE);
}

static bool is_cutoff_valid(const keel_voter_config_t *config)
{
    /* The factor first: its product with a is then finite. */
    return is_within(config->cutoff, 1.0f, KEEL_VOTER_RANGE / KEEL_VOTER_AGREE_MIN) &&
           is_above((config->cutoff * config->agree), config->agree);
}

keel_status_t keel_voter_check(const keel_voter_config_t *config)
{
    if ((config->sensors < 2u) || (config->sensors > KEEL_VOTER_SENSORS)) {
        return KEEL_ERR_SENSORS;
    }
    if (!is_within(config->agree, KEEL_VOTER_AGREE_MIN, KEEL_VOTER_AGREE_MAX)) {
        return KEEL_ERR_AGREEMENT;
    }
    if (!is_cutoff_valid(config)) {
        return KEEL_ERR_CUTOFF;
    }
    if (!is_within(config->lowest, -KEEL_VOTER_RANGE, KEEL_VOTER_RANGE) ||
        !is_within(config->highest, config->lowest, KEEL_VOTER_RANGE)) {
        return KEEL_ERR_LIMITS;
    }
    if (!is_within(config->initial, config->lowest, config->highest)) {
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
    voter->none = config->cutoff * config->agree;
    voter->vote.output = config->initial;
    voter->vote.held = 0u;
    voter->vote.held_us = 0u;
    voter->vote.state = KEEL_VOTER_NONE;
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        voter->sensor[i].last = config->initial;
        voter->sensor[i].same = 0u;
        voter->sensor[i].null = 0u;
        voter->sensor[i].density = 0u;
        voter->sensor[i].latched = false;
        voter->vote.weight[i] = 0.0f;
        voter->vote.reason[i] = KEEL_VOTER_USED;
    }
    return KEEL_OK;
}

float keel_voter_agreement(float distance, float agree, float none)
{
    if (distance <= agree) {
        return 1.0f;
    }
    return (distance >= none) ? 0.0f : ((none - distance) / (none - agree));
}

float keel_voter_weight(const float agreement[], uint32_t others)
{
    float total = 0.0f;

    for (uint32_t i = 0u; i < others; i++) {
        total += agreement[i];
    }
    return total / (float)others;
}

float keel_voter_combine(const keel_voter_sample_t sample[], const float weight[], uint32_t sensors)
{
    float sum = 0.0f;
    float weights = 0.0f;
    float least = KEEL_VOTER_RANGE;
    float most = -KEEL_VOTER_RANGE;
    float mean;

    for (uint32_t i = 0u; i < sensors; i++) {
        if (weight[i] > 0.0f) {
            const float value = sample[i].value;

            sum += weight[i] * value;
            weights += weight[i];
            least = (value < least) ? value : least;
            most = (value > most) ? value : most;
        }
    }
    mean = sum / weights;
    mean = (mean > least) ? mean : least;
    return (mean < most) ? mean : most;
}

static uint16_t one_more(uint16_t value)
{
    return (value < UINT16_MAX) ? (uint16_t)(value + 1u) : value;
}

/* Whether a sample can be compared with others at all. */
static bool is_readable(const keel_voter_sensor_t *sensor, const keel_voter_sample_t *sample)
{
    return !sensor->latched && sample->present && is_within(sample->value, -LARGEST, LARGEST);
}

/* Counts the votes in which a sensor alone did not change (VOT-013). That all others changed is
 * asked for, so that one sensor gone wild does not make the others, at rest, look stale. */
static void watch_changes(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    uint32_t readable = 0u;
    uint32_t moved = 0u;
    uint32_t unmoved = 0u;

    for (uint32_t i = 0u; i < voter->config.sensors; i++) {
        keel_voter_sensor_t *const sensor = &voter->sensor[i];

        if (is_readable(sensor, &sample[i])) {
            readable++;
            if (sample[i].value != sensor->last) {
                moved++;
                sensor->last = sample[i].value;
                sensor->same = 0u;
            } else {
                unmoved = i;
            }
        }
    }
    if ((moved > 0u) && ((moved + 1u) == readable)) {
        voter->sensor[unmoved].same = one_more(voter->sensor[unmoved].same);
    }
}

/* Why a sample cannot be used, or KEEL_VOTER_USED (VOT-007). */
static uint8_t inspect(const keel_voter_config_t *config, const keel_voter_sensor_t *sensor,
                       const keel_voter_sample_t *sample)
{
    if (sensor->latched) {
        return KEEL_VOTER_LATCHED;
    }
    if (!sample->present) {
        return KEEL_VOTER_MISSING;
    }
    if (!is_within(sample->value, -LARGEST, LARGEST)) {
        return KEEL_VOTER_NOT_FINITE;
    }
    if (!is_within(sample->value, config->lowest, config->highest)) {
        return KEEL_VOTER_OUT_OF_RANGE;
    }
    if (sample->age_us > config->max_age_us) {
        return KEEL_VOTER_LATE;
    }
    return ((config->stale_count > 0u) && (sensor->same >= config->stale_count)) ? KEEL_VOTER_STALE
                                                                                 : KEEL_VOTER_USED;
}

/* Looks at every sample; how many are usable. */
static uint32_t inspect_all(keel_voter_t *voter, const keel_voter_sample_t sample[])
{
    uint32_t usable = 0u;

    for (uint32_t i = 0u; i < voter->config.sensors; i++) {
        const uint8_t reason = inspect(&voter->config, &voter->sensor[i], &sample[i]);

        voter->vote.reason[i] = reason;
        if (reason == KEEL_VOTER_USED) {
            usable++;
        }
    }
    return usable;
}

/* The agreement of two usable samples. */
static float compare(const keel_voter_t *voter, float x, float y)
{
    return keel_voter_agreement((x > y) ? (x - y) : (y - x), voter->config.agree, voter->none);
}

/* The weights of usable samples. One that is alone has nobody to agree with. */
static void weigh(keel_voter_t *voter, const keel_voter_sample_t sample[], uint32_t usable)
{
    keel_vote_t *const vote = &voter->vote;
    const uint32_t sensors = voter->config.sensors;
    float agreement[KEEL_VOTER_SENSORS][KEEL_VOTER_SENSORS - 1u];

    for (uint32_t i = 0u; i < sensors; i++) {
        for (uint32_t j = i + 1u; j < sensors; j++) {
            const bool both = (vote->reason[i] == KEEL_VOTER_USED) &&
                              (vote->reason[j] == KEEL_VOTER_USED);
            const float s = both ? compare(voter, sample[i].value, sample[j].value) : 0.0f;

            agreement[i][j - 1u] = s;
            agreement[j][i] = s;
        }
    }
    for (uint32_t i = 0u; i < sensors; i++) {
        const bool alone = (usable == 1u) && (vote->reason[i] == KEEL_VOTER_USED);

        vote->weight[i] = alone ? 1.0f : keel_voter_weight(agreement[i], sensors - 1u);
    }
}

/* A usable sample without weight was outvoted; how many contribute. */
static uint32_t find_outvoted(keel_voter_t *voter)
{
    uint32_t contributing = 0u;

    for (uint32_t i = 0u; i < voter->config.sensors; i++) {
        if (voter->vote.weight[i] > 0.0f) {
            contributing++;
        } else if (voter->vote.reason[i] == KEEL_VOTER_USED) {
            voter->vote.reason[i] = KEEL_VOTER_OUTVOTED;
        } else {
            /* Unusable, and the reason says why. */
        }
    }
    return contributing;
}

static uint32_t add_saturated(uint32_t a, uint32_t b)
{
    return (a <= (UINT32_MAX - b)) ? (a + b) : UINT32_MAX;
}

/* The output, or another vote without one (VOT-008). */
static void conclude(keel_voter_t *voter, const keel_voter_sample_t sample[], uint32_t usable,
                     uint32_t elapsed_us)
{
    keel_vote_t *const vote = &voter->vote;

    if (find_outvoted(voter) > 0u) {
        vote->state = (usable == 1u) ? KEEL_VOTER_SINGLE : KEEL_VOTER_MEAN;
        vote->output = keel_voter_combine(sample, vote->weight, voter->config.sensors);
        vote->held = 0u;
        vote->held_us = 0u;
    } else {
        vote->state = (usable > 0u) ? KEEL_VOTER_DISAGREE : KEEL_VOTER_NONE;
        vote->held = add_saturated(vote->held, 1u);
        vote->held_us = add_saturated(vote->held_us, elapsed_us);
    }
}

/* What a vote means for a sensor that is not latched (VOT-010 to VOT-012). */
static void judge(const keel_voter_config_t *config, keel_voter_sensor_t *sensor, uint8_t reason,
                  uint32_t usable)
{
    if (reason == KEEL_VOTER_USED) {
        sensor->null = 0u;
        sensor->density = (sensor->density > 0u) ? (uint16_t)(sensor->density - 1u) : 0u;
    } else if ((reason != KEEL_VOTER_OUTVOTED) || (usable > 2u)) {
        sensor->null = one_more(sensor->null);
        sensor->density = one_more(sensor->density);
    } else {
        /* Two that disagree: nobody knows which of them is wrong. */
    }
    sensor->latched = (sensor->null > config->latch_count) ||
                      ((config->density_limit > 0u) && (sensor->density >= config->density_limit));
}

void keel_voter_step(keel_voter_t *voter, const keel_voter_sample_t sample[], uint32_t elapsed_us)
{
    uint32_t usable;

    watch_changes(voter, sample);
    usable = inspect_all(voter, sample);
    weigh(voter, sample, usable);
    conclude(voter, sample, usable, elapsed_us);
    for (uint32_t i = 0u; i < voter->config.sensors; i++) {
        if (!voter->sensor[i].latched) {
            judge(&voter->config, &voter->sensor[i], voter->vote.reason[i], usable);
        }
    }
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
    voter->sensor[sensor].null = 0u;
    voter->sensor[sensor].density = 0u;
    voter->sensor[sensor].same = 0u;
    return KEEL_OK;
}
