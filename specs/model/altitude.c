/* SPDX-License-Identifier: Apache-2.0 */
#include "altitude.h"

#include "axis.h"

#include <stdbool.h>

keel_status_t model_altitude_init(keel_altitude_t *altitude, const keel_axis_config_t *config)
{
    keel_altitude_t made = *altitude;
    const keel_status_t status = model_axis_init(&made.axis, config);

    /* ALT-001: a refusal changes nothing. */
    if (status != KEEL_OK) {
        return status;
    }
    /* ALT-002 */
    made.reference = 0.0f;
    made.zero = 0.0f;
    made.height = 0.0f;
    made.has_reference = false;
    *altitude = made;
    return KEEL_OK;
}

/* ALT-003 */
void model_altitude_zero(keel_altitude_t *altitude)
{
    altitude->zero = altitude->axis.position;
    altitude->height = 0.0f;
}

/* ALT-005: no comparison with NaN holds. */
static bool pressure_counts(const keel_altitude_sample_t *sample)
{
    return sample->has_pressure && (sample->pressure >= KEEL_ALTITUDE_PRESSURE_MIN) &&
           (sample->pressure <= KEEL_ALTITUDE_PRESSURE_MAX);
}

/* ALT-007: the formulas of altitude.h. */
static float height_above(float r, float p)
{
    const float x = (r - p) / (r + p);
    const float y = KEEL_ALTITUDE_TWICE_SCALE * (x + (x * ((x * x) * KEEL_ALTITUDE_THIRD)));

    return y * (1.0f - (y * KEEL_ALTITUDE_PER_LAPSE));
}

void model_altitude_step(keel_altitude_t *altitude, const keel_altitude_sample_t *sample)
{
    const bool counts = pressure_counts(sample);
    keel_axis_sample_t fix;

    /* ALT-004: the first pressure that counts. */
    if (counts && !altitude->has_reference) {
        altitude->reference = sample->pressure;
        altitude->has_reference = true;
    }
    fix.acceleration = sample->acceleration;
    fix.has_acceleration = sample->has_acceleration;
    fix.position = counts ? height_above(altitude->reference, sample->pressure) : 0.0f;
    fix.velocity = 0.0f;
    fix.has_velocity = false;
    fix.has_fix = sample->has_pressure;
    fix.is_usable = counts;
    model_axis_step(&altitude->axis, &fix);
    /* ALT-006 */
    altitude->height = altitude->axis.position - altitude->zero;
}
