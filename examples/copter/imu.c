/* SPDX-License-Identifier: Apache-2.0 */
/* Background and foreground IMU: three units are oversampled, voted on, and become an attitude. */
#include "copter.h"

#define OVERSAMPLING   2u    /* Background runs in a foreground period. */
#define VOTE_PERIOD_US 2000u /* Table 2: foreground IMU. */
#define BLOCK          10u   /* Votes in a period of navigation. */
#define ACCELEROMETER  KEEL_VIRTUAL_IMU_ACCELEROMETER
#define FIELD_APART    0.5f  /* In microtesla: a degree or so of the heading. */
#define SLOW           10u   /* Votes to one of what drifts. */
#define DOUBT_VOTES    1000u /* What was so within 2 s is told as it is. */

/* The settings of a vote, among so many units. */
static keel_virtual_imu_config_t config_among(keel_virtual_imu_config_t config, uint32_t units)
{
    config.accelerometer.sensors = (uint8_t)units;
    config.gyroscope.sensors = (uint8_t)units;
    return config;
}

keel_status_t copter_imu_init(copter_imu_t *imu, uint32_t units)
{
    const keel_virtual_imu_config_t fast = config_among(copter_settings.imu, units);
    const keel_virtual_imu_config_t slow = config_among(copter_settings.slow, units);
    keel_status_t status = keel_virtual_imu_init(&imu->virtual_imu, &fast);

    imu->units = units;
    if (status == KEEL_OK) {
        status = keel_virtual_imu_init(&imu->slow, &slow);
    }
    if (status == KEEL_OK) {
        status = keel_attitude_init(&imu->attitude, &copter_settings.attitude);
    }
    for (uint32_t unit = 0u; unit < units; unit++) {
        for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
            const float cutoff_hz = (k < ACCELEROMETER) ? copter_settings.accelerometer_hz
                                                        : copter_settings.gyroscope_hz;

            (void)keel_oversample_init(&imu->channel[unit][k], OVERSAMPLING);
            if (status == KEEL_OK) {
                status = keel_filter_init(&imu->filter[unit][k], COPTER_VOTE_HZ, cutoff_hz);
            }
        }
        imu->unit[unit].present = false; /* So that its filters begin with what it says. */
    }
    return status;
}

void copter_background_imu(copter_imu_t *self, const copter_t *copter)
{
    for (uint32_t unit = 0u; unit < self->units; unit++) {
        copter_imu_sample_t sample;

        if (copter->port->read_imu(copter->port->context, unit, &sample)) {
            for (uint32_t k = 0u; k < ACCELEROMETER; k++) {
                (void)keel_oversample_add(&self->channel[unit][k], sample.accelerometer[k]);
                (void)keel_oversample_add(&self->channel[unit][ACCELEROMETER + k],
                                          sample.gyroscope[k]);
            }
            self->sampled_us[unit] = copter->scheduler.clock.now_us;
            self->temperature[unit] = sample.temperature;
        }
    }
}

/* A sample of a unit since the last vote; it is absent unless all its channels have, and rests if
 * all say what they said before. */
static void take_sample(copter_imu_t *self, uint32_t unit, uint64_t now_us)
{
    keel_virtual_imu_sample_t *const sample = &self->unit[unit];
    bool rests = sample->present;

    sample->age_us = (uint32_t)(now_us - self->sampled_us[unit]);
    sample->present = true;
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        const float before = sample->value[k];

        if (keel_oversample_take(&self->channel[unit][k], &sample->value[k]) != KEEL_OK) {
            sample->present = false;
        }
        rests = rests && (sample->value[k] == before);
    }
    self->rests[unit] = rests && sample->present;
}

/* The filter's output after a value; a value that it refuses, as it is: the voter sees to it. */
static float filtered(keel_filter_t *filter, float value, bool goes_on)
{
    const keel_status_t status = goes_on ? keel_filter_step(filter, value)
                                         : keel_filter_reset(filter, value);

    return (status == KEEL_OK) ? filter->output : value;
}

/* A unit votes with its sample as calibrations correct it, filtered, as vibration differs from unit
 * to unit. Filters start anew behind a gap. They rest while the unit does: a unit that repeats
 * itself gave no sample, and the voter is to see it. */
static void prepare_vote(copter_imu_t *self, uint32_t unit, const copter_calibration_t *calibration,
                         bool goes_on, keel_virtual_imu_sample_t *sample)
{
    keel_filter_t *const filter = self->filter[unit];

    *sample = self->unit[unit];
    copter_calibration_correct(calibration, unit, sample->value);
    for (uint32_t k = 0u; (k < KEEL_VIRTUAL_IMU_CHANNELS) && sample->present; k++) {
        sample->value[k] = self->rests[unit] ? filter[k].output
                                             : filtered(&filter[k], sample->value[k], goes_on);
    }
}

/* A drift within the vote's thresholds, which are as wide as units differ while they move and
 * shake, would carry the mean away for long. It shows where motion and vibration are averaged out:
 * there thresholds are narrow, and what is voted out is not heard in the vote that flies. */
static void vote_on_drift(copter_imu_t *self, keel_virtual_imu_sample_t unit[])
{
    for (uint32_t i = 0u; i < self->units; i++) {
        keel_virtual_imu_sample_t *const slow = &self->slow_unit[i];

        for (uint32_t k = 0u; (k < KEEL_VIRTUAL_IMU_CHANNELS) && unit[i].present && !self->rests[i];
             k++) {
            slow->value[k] += copter_settings.slow_gain * (unit[i].value[k] - slow->value[k]);
        }
        slow->present = unit[i].present;
        slow->age_us = unit[i].age_us;
    }
    if ((self->votes % SLOW) == 0u) {
        keel_virtual_imu_step(&self->slow, self->slow_unit, SLOW * VOTE_PERIOD_US);
    }
    self->votes++;
    for (uint32_t i = 0u; i < self->units; i++) {
        unit[i].present = unit[i].present && (self->slow.latched[i] == 0u);
    }
}

/* The worst state of three channels' votes, for as long as it is to be told. */
static void keep_doubt(copter_doubt_t *self, const keel_voter_t channel[])
{
    uint8_t worst = KEEL_VOTER_MEAN;

    for (uint32_t k = 0u; k < ACCELEROMETER; k++) {
        const uint8_t state = channel[k].vote.state;

        worst = (state > worst) ? state : worst;
    }
    if ((worst >= self->state) || (self->votes == 0u)) {
        self->state = worst;
        self->votes = DOUBT_VOTES;
    } else {
        self->votes--;
    }
}

/* The sample of an aircraft without a voter: the mean of what its units last said. */
static void take_mean(const copter_imu_t *self, keel_attitude_sample_t *sample,
                      const keel_virtual_imu_sample_t unit[])
{
    float mean[KEEL_VIRTUAL_IMU_CHANNELS] = {0.0f};

    for (uint32_t i = 0u; i < self->units; i++) {
        for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
            mean[k] += unit[i].value[k] / (float)self->units;
        }
    }
    sample->has_accelerometer = true;
    sample->has_gyroscope = true;
    sample->accelerometer = (keel_attitude_vector_t){mean[0], mean[1], mean[2]};
    sample->gyroscope = (keel_attitude_vector_t){mean[3], mean[4], mean[5]};
}

/* Navigation looks once in a block of steps: it gets their mean. */
static void keep_force(copter_imu_t *self, const keel_attitude_sample_t *sample)
{
    copter_force_t *const block = &self->force[self->blocks % COPTER_BLOCKS];

    if (sample->has_accelerometer) {
        self->force_sum.x += sample->accelerometer.x;
        self->force_sum.y += sample->accelerometer.y;
        self->force_sum.z += sample->accelerometer.z;
        self->forces++;
    }
    self->steps++;
    if (self->steps < BLOCK) {
        return;
    }
    block->is_known = self->forces > 0u;
    if (block->is_known) {
        const float count = (float)self->forces;

        block->mean = (keel_attitude_vector_t){self->force_sum.x / count, self->force_sum.y / count,
                                               self->force_sum.z / count};
    }
    self->force_sum = (keel_attitude_vector_t){0.0f, 0.0f, 0.0f};
    self->forces = 0u;
    self->steps = 0u;
    self->blocks++;
}

/* With other offsets of the gyroscopes their common bias is another one. */
static void heed_calibration(copter_imu_t *self, const copter_calibration_t *calibration)
{
    if (self->calibrations != calibration->done) {
        self->calibrations = calibration->done;
        keel_attitude_restart(&self->attitude);
    }
}

static bool is_apart(float one, float other)
{
    return ((one - other) > FIELD_APART) || ((other - one) > FIELD_APART);
}

/* Where the field's direction is another than was taken, heading is found anew; on the ground. */
static void heed_field(copter_imu_t *self, const copter_estimate_t *estimate)
{
    keel_attitude_config_t config = self->attitude.config;

    if (self->fields == estimate->fields) {
        return;
    }
    self->fields = estimate->fields;
    if (is_apart(config.north, estimate->field.north) ||
        is_apart(config.east, estimate->field.east)) {
        config.north = estimate->field.north;
        config.east = estimate->field.east;
        /* Too near to a magnetic pole it is refused, and there is no heading. */
        (void)keel_attitude_init(&self->attitude, &config);
    }
}

void copter_foreground_imu(copter_imu_t *self, const copter_t *copter)
{
    const copter_gps_t *const gps = &copter->gps;
    keel_virtual_imu_sample_t unit[COPTER_IMUS];
    keel_attitude_sample_t sample = {.has_magnetometer = false};

    heed_calibration(self, &copter->calibration);
    heed_field(self, &copter->estimate);
    for (uint32_t i = 0u; i < self->units; i++) {
        const bool goes_on = self->unit[i].present;

        take_sample(self, i, copter->scheduler.clock.now_us);
        prepare_vote(self, i, &copter->calibration, goes_on, &unit[i]);
    }
    vote_on_drift(self, unit);
    keel_virtual_imu_step(&self->virtual_imu, unit, VOTE_PERIOD_US);
    keep_doubt(&self->accelerometer, &self->virtual_imu.channel[0]);
    keep_doubt(&self->gyroscope, &self->virtual_imu.channel[ACCELEROMETER]);
    keel_attitude_take(&sample, &self->virtual_imu);
    if (copter->plain_mean) {
        take_mean(self, &sample, unit);
    }
    sample.has_magnetometer = copter->magnetometer.samples != self->field_taken;
    sample.magnetometer = copter->magnetometer.field;
    sample.has_acceleration = gps->is_accelerated && self->attitude.heading_valid;
    sample.acceleration = gps->acceleration;
    self->field_taken = copter->magnetometer.samples;
    keel_attitude_step(&self->attitude, &sample);
    self->down = keel_attitude_down(&self->attitude);
    keep_force(self, &sample);
}
