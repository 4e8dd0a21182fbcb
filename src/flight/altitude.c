/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/altitude.h"

#include "keel/middleware/range.h"

keel_status_t keel_altitude_init(keel_altitude_t *altitude, const keel_axis_config_t *config)
{
    const keel_status_t status = keel_axis_init(&altitude->axis, config);

    if (status == KEEL_OK) {
        altitude->reference = 0.0f;
        altitude->zero = 0.0f;
        altitude->height = 0.0f;
        altitude->has_reference = false;
    }
    return status;
}

void keel_altitude_zero(keel_altitude_t *altitude)
{
    altitude->zero = altitude->axis.position;
    altitude->height = 0.0f;
}

/* How much higher it is where a pressure is measured than at the reference. */
/*@ assigns \nothing; */
static float height_between(float reference, float pressure)
{
    const float x = (reference - pressure) / (reference + pressure);
    const float even = KEEL_ALTITUDE_TWICE_SCALE * (x + (x * ((x * x) * KEEL_ALTITUDE_THIRD)));

    return even * (1.0f - (even * KEEL_ALTITUDE_PER_LAPSE));
}

void keel_altitude_step(keel_altitude_t *altitude, const keel_altitude_sample_t *sample)
{
    const bool counts = sample->has_pressure &&
                        keel_range_contains(sample->pressure, KEEL_ALTITUDE_PRESSURE_MIN,
                                            KEEL_ALTITUDE_PRESSURE_MAX);
    keel_axis_sample_t up = {
        .acceleration = sample->acceleration,
        .position = 0.0f,
        .velocity = 0.0f,
        .has_acceleration = sample->has_acceleration,
        .has_fix = sample->has_pressure,
        .has_velocity = false,
        .is_usable = counts,
    };

    if (counts) {
        if (!altitude->has_reference) {
            altitude->reference = sample->pressure;
            altitude->has_reference = true;
        }
        up.position = height_between(altitude->reference, sample->pressure);
    }
    keel_axis_step(&altitude->axis, &up);
    altitude->height = altitude->axis.position - altitude->zero;
}
