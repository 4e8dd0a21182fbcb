/* SPDX-License-Identifier: Apache-2.0 */
#include "position.h"

#include "axis.h"

#include <stdbool.h>
#include <stdint.h>

/* No comparison with NaN holds. */
static bool good_to(float accuracy, float worst)
{
    return (accuracy >= 0.0f) && (accuracy <= worst);
}

keel_status_t model_position_init(keel_position_t *position, const keel_position_config_t *config)
{
    keel_position_t made = *position;
    const keel_status_t status = model_axis_init(&made.north, &config->axis);

    /* POS-001: a refusal changes nothing. */
    if (!(good_to(config->accuracy, KEEL_POSITION_ACCURACY_LIMIT) &&
          good_to(config->speed_accuracy, KEEL_POSITION_SPEED_ACCURACY_LIMIT))) {
        return KEEL_ERR_LIMITS;
    }
    if (status != KEEL_OK) {
        return status;
    }
    /* POS-002: both directions alike, and no origin. */
    made.config = *config;
    made.east = made.north;
    made.latitude = 0;
    made.longitude = 0;
    made.north_scale = 0.0f;
    made.east_scale = 0.0f;
    made.has_origin = false;
    made.quality = KEEL_AXIS_NONE;
    *position = made;
    return KEEL_OK;
}

/* POS-004: 1 - f^2/2! + f^4/4! - ... + f^8/8! - f^10/10!, in Horner's order. */
static float cosine_by_series(float f)
{
    const float s = f * f;
    const float sum = 0.5f -
                      (s *
                       (0x1.555556p-5f -
                        (s * (0x1.6c16c2p-10f - (s * (0x1.a01a02p-16f - (s * 0x1.27e4fcp-22f)))))));

    return 1.0f - (s * sum);
}

keel_status_t model_position_set_origin(keel_position_t *position, int32_t latitude,
                                        int32_t longitude)
{
    const float c = cosine_by_series((float)latitude * 0x1.dfc0ap-30f);

    /* POS-003: a refusal changes nothing. */
    if ((latitude < -800000000) || (latitude > 800000000) || (longitude < -1800000000) ||
        (longitude > 1800000000)) {
        return KEEL_ERR_VALUE;
    }
    position->latitude = latitude;
    position->longitude = longitude;
    /* POS-004: the formulas of position.h, for 1e-7 of a degree: its numbers and pi / 180 times
     * 1e-7, rounded. */
    position->north_scale = 0x1.6c2914p-7f - (0x1.d59cdcp-15f * ((2.0f * (c * c)) - 1.0f));
    position->east_scale = c * (0x1.6d13dep-7f - (0x1.39bbe4p-17f * ((4.0f * (c * c)) - 3.0f)));
    position->has_origin = true;
    model_axis_restart(&position->north);
    model_axis_restart(&position->east);
    position->quality = KEEL_AXIS_NONE;
    return KEEL_OK;
}

/* POS-006: the nearer way around. */
static int64_t way_east(int64_t from, int64_t to)
{
    const int64_t way = to - from;

    if (way > 1800000000) {
        return way - 3600000000;
    }
    return (way < -1800000000) ? (way + 3600000000) : way;
}

static bool way_fits(int64_t way)
{
    return (way >= -16777216) && (way <= 16777216);
}

static float way_in_metres(int64_t way, float scale)
{
    return way_fits(way) ? ((float)(int32_t)way * scale) : 0.0f;
}

void model_position_step(keel_position_t *position, const keel_position_sample_t *sample)
{
    const keel_position_fix_t *const fix = &sample->fix;
    const int64_t north = (int64_t)fix->latitude - (int64_t)position->latitude;
    const int64_t east = way_east(position->longitude, fix->longitude);
    keel_axis_sample_t along_north;
    keel_axis_sample_t along_east;

    /* POS-005: what of a fix can be used. */
    along_north.has_fix = sample->has_fix;
    along_north.is_usable = fix->is_valid && position->has_origin && way_fits(north) &&
                            way_fits(east) && good_to(fix->accuracy, position->config.accuracy);
    along_north.has_velocity = good_to(fix->speed_accuracy, position->config.speed_accuracy);
    along_north.has_acceleration = sample->has_acceleration;
    along_east = along_north;
    /* POS-006, POS-007 */
    along_north.position = way_in_metres(north, position->north_scale);
    along_north.velocity = fix->north;
    along_north.acceleration = sample->north;
    along_east.position = way_in_metres(east, position->east_scale);
    along_east.velocity = fix->east;
    along_east.acceleration = sample->east;
    model_axis_step(&position->north, &along_north);
    model_axis_step(&position->east, &along_east);
    /* POS-009 */
    position->quality = (position->north.quality < position->east.quality) ? position->north.quality
                                                                           : position->east.quality;
}
