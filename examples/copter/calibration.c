/* SPDX-License-Identifier: Apache-2.0 */
/* Calibration IMU and calibration magnetometer: while the aircraft is disarmed. The gyroscopes are
 * calibrated once after the start, as soon as it lies still and does not turn; the magnetometer
 * when the pilot asks for it, by turning the aircraft about all axes. */
#include "copter.h"

#include <math.h>

/* Of twice the field's strength, as it is seen in a full turn about all axes. */
#define SPAN_LEAST 0.72f
#define SPAN_MOST  1.45f

static void begin_rest(copter_calibration_t *self)
{
    for (uint32_t unit = 0u; unit < self->units; unit++) {
        keel_calibration_rest_begin(&self->gyroscope[unit]);
    }
    keel_calibration_rest_begin(&self->rest);
}

keel_status_t copter_calibration_init(copter_calibration_t *calibration, uint32_t units)
{
    keel_status_t status = keel_calibration_field_init(&calibration->field, &copter_settings.field);

    calibration->units = units;
    for (uint32_t unit = 0u; (unit < units) && (status == KEEL_OK); unit++) {
        status = keel_calibration_rest_init(&calibration->gyroscope[unit],
                                            &copter_settings.gyroscope);
    }
    status = (status == KEEL_OK)
                 ? keel_calibration_rest_init(&calibration->rest, &copter_settings.rest)
                 : status;
    status = (status == KEEL_OK)
                 ? copter_accel_calibration_init(&calibration->accelerometers, units)
                 : status;
    begin_rest(calibration);
    copter_calibration_set(calibration);
    return status;
}

void copter_calibration_set(copter_calibration_t *calibration)
{
    calibration->magnetometer = copter_settings.magnetometer;
    copter_accel_calibration_set(&calibration->accelerometers);
}

void copter_calibration_correct(const copter_calibration_t *calibration, uint32_t unit,
                                float value[KEEL_VIRTUAL_IMU_CHANNELS])
{
    const copter_accel_calibration_t *const accelerometers = &calibration->accelerometers;
    keel_calibration_vector_t force;
    keel_calibration_vector_t rate;

    keel_calibration_correct(&accelerometers->correction[unit], value, &force);
    keel_calibration_apply(calibration->gyroscope[unit].offset,
                           &value[KEEL_VIRTUAL_IMU_ACCELEROMETER], &rate);
    if (accelerometers->is_turned) {
        const keel_calibration_vector_t own_force = force;
        const keel_calibration_vector_t own_rate = rate;

        keel_calibration_turn(&accelerometers->turn, own_force.axis, &force);
        keel_calibration_turn(&accelerometers->turn, own_rate.axis, &rate);
    }
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        value[k] = force.axis[k];
        value[KEEL_VIRTUAL_IMU_ACCELEROMETER + k] = rate.axis[k];
    }
}

static void set_check(copter_calibration_t *self, uint32_t check, bool holds)
{
    self->checks = holds ? (self->checks | check) : (self->checks & ~check);
}

static bool are_taken(const copter_calibration_t *self)
{
    bool taken = true;

    for (uint32_t unit = 0u; unit < self->units; unit++) {
        taken = taken && (self->gyroscope[unit].state == KEEL_CALIBRATION_DONE);
    }
    return taken;
}

/* Where there is a magnetometer, its field has rested, too, from before the gyroscopes' first
 * sample until after their last one. */
static bool are_calibrated(const copter_calibration_t *self, const copter_t *copter)
{
    return are_taken(self) &&
           ((copter->magnetometer.samples == 0u) || (self->rest.state == KEEL_CALIBRATION_DONE));
}

bool copter_has_moved(const keel_calibration_rest_t *rest)
{
    return (rest->restarts > 0u) || (rest->state == KEEL_CALIBRATION_REFUSED);
}

static void step_gyroscopes(copter_calibration_t *self, const copter_t *copter)
{
    for (uint32_t unit = 0u; unit < self->units; unit++) {
        const keel_virtual_imu_sample_t *const sample = &copter->imu.unit[unit];

        if (sample->present) {
            keel_calibration_rest_step(&self->gyroscope[unit],
                                       &sample->value[KEEL_VIRTUAL_IMU_ACCELEROMETER]);
        }
    }
}

static void step_rest(copter_calibration_t *self, const copter_magnetometer_t *magnetometer)
{
    const float calm[KEEL_CALIBRATION_AXES] = {
        magnetometer->calm[0].output, magnetometer->calm[1].output, magnetometer->calm[2].output};

    if (self->rest_taken != magnetometer->samples) {
        self->rest_taken = magnetometer->samples;
        keel_calibration_rest_step(&self->rest, calm);
    }
}

/* All rest together or begin again together: a gyroscope takes an even turn for rest, the field
 * does not. */
static void seek_rest(copter_calibration_t *self, const copter_t *copter)
{
    bool moves = false;

    step_gyroscopes(self, copter);
    step_rest(self, &copter->magnetometer);
    for (uint32_t unit = 0u; unit < self->units; unit++) {
        moves = moves || copter_has_moved(&self->gyroscope[unit]);
    }
    if (!moves && copter_has_moved(&self->rest)) {
        self->turns++;
        moves = true;
    }
    if (moves) {
        begin_rest(self);
    }
}

void copter_calibration_imu(copter_calibration_t *self, const copter_t *copter)
{
    const bool before = are_taken(self);

    if (!copter->state.mode.motors && !are_calibrated(self, copter)) {
        seek_rest(self, copter);
    }
    if (!before && are_taken(self)) {
        self->done++;
    }
    copter_accel_calibration_step(&self->accelerometers, copter);
    set_check(self, KEEL_MODE_CHECK_CALIBRATION,
              are_calibrated(self, copter) &&
                  (self->accelerometers.levelling == (uint8_t)COPTER_LEVELLING_NONE) &&
                  (copter->imu.attitude.phase == KEEL_ATTITUDE_RUNNING));
}

/* An axis that was turned too little can be turned on. All else begins anew. */
static void ask_for_field(copter_calibration_t *self)
{
    const bool goes_on = (self->field.state == KEEL_CALIBRATION_COLLECTING) &&
                         (self->field_end == (uint8_t)KEEL_CALIBRATION_NARROW);

    if (!self->field_asked && !goes_on) {
        keel_calibration_field_begin(&self->field);
    }
    self->field_asked = true;
}

/* The first axis that does not fit says why. */
static keel_calibration_verdict_t verdict_of(const keel_calibration_field_t *field)
{
    keel_calibration_verdict_t verdict = KEEL_CALIBRATION_FIT;

    for (uint32_t k = 0u; (k < KEEL_CALIBRATION_AXES) && (verdict == KEEL_CALIBRATION_FIT); k++) {
        verdict = keel_calibration_field_axis(field, k);
    }
    return verdict;
}

/* Whatever was seen: if that is not enough, nothing changes. */
static void end_field(copter_calibration_t *self)
{
    self->field_asked = false;
    self->field_end = (uint8_t)verdict_of(&self->field);
    if (keel_calibration_field_finish(&self->field) == KEEL_OK) {
        for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
            self->magnetometer.offset[k] = self->field.offset[k];
        }
    }
    self->field_ends++;
}

/* An aircraft that turns about all axes sees a field of twice the strength of the place's. What was
 * calibrated stays. */
static void heed_place(copter_calibration_t *self, const copter_estimate_t *estimate)
{
    const copter_wmm_field_t field = estimate->field;

    if ((self->fields == estimate->fields) || (self->field.state == KEEL_CALIBRATION_COLLECTING)) {
        return;
    }
    self->fields = estimate->fields;
    if (self->field.state != KEEL_CALIBRATION_DONE) {
        const float span = 2.0f * sqrtf((field.north * field.north) + (field.east * field.east) +
                                        (field.down * field.down));
        keel_calibration_field_config_t config = self->field.config;

        config.span_min = SPAN_LEAST * span;
        config.span_max = SPAN_MOST * span;
        (void)keel_calibration_field_init(&self->field, &config);
    }
}

void copter_calibration_magnetometer(copter_calibration_t *self, const copter_t *copter)
{
    const keel_attitude_vector_t raw = copter->magnetometer.raw;
    const float sample[KEEL_CALIBRATION_AXES] = {raw.x, raw.y, raw.z};

    heed_place(self, &copter->estimate);
    if (!copter->state.mode.motors && copter->pilot.calibrates) {
        ask_for_field(self);
        keel_calibration_field_step(&self->field, sample);
    } else if (self->field_asked) {
        end_field(self);
    } else {
        /* Nobody asks. */
    }
    /* The field is what the settings expect when the heading follows it. */
    set_check(self, KEEL_MODE_CHECK_MAGNETOMETER, copter->imu.attitude.heading_valid);
}
