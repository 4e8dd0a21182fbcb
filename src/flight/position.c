/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/position.h"

#include "keel/middleware/range.h"

/* 1e-7 degrees in rad, 1.7453293e-9. */
#define RADIANS 0x1.dfc0ap-30f

/* The series of position.h, per 1e-7 degrees: 0.0111132954, 5.59822e-5, 0.011141284, 9.35e-6. */
#define NORTH_EVEN   0x1.6c2914p-7f
#define NORTH_DOUBLE 0x1.d59cdcp-15f
#define EAST_SINGLE  0x1.6d13dep-7f
#define EAST_TRIPLE  0x1.39bbe4p-17f

/* 1 / 4!, 1 / 6!, 1 / 8! and 1 / 10!. */
#define PER_4  0x1.555556p-5f
#define PER_6  0x1.6c16c2p-10f
#define PER_8  0x1.a01a02p-16f
#define PER_10 0x1.27e4fcp-22f

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> position_accuracies(*config);
  @*/
static bool accuracies_fit(const keel_position_config_t *config)
{
    return keel_range_contains(config->accuracy, 0.0f, KEEL_POSITION_ACCURACY_LIMIT) &&
           keel_range_contains(config->speed_accuracy, 0.0f, KEEL_POSITION_SPEED_ACCURACY_LIMIT);
}

keel_status_t keel_position_init(keel_position_t *position, const keel_position_config_t *config)
{
    keel_status_t status;

    if (!accuracies_fit(config)) {
        return KEEL_ERR_LIMITS;
    }
    status = keel_axis_init(&position->north, &config->axis);
    if (status != KEEL_OK) {
        return status;
    }
    position->config = *config;
    position->east = position->north;
    position->latitude = 0;
    position->longitude = 0;
    position->north_scale = 0.0f;
    position->east_scale = 0.0f;
    position->has_origin = false;
    position->quality = KEEL_AXIS_NONE;
    return KEEL_OK;
}

/* The cosine of an angle up to 80 degrees, to 2^-22: its series to the tenth power. */
/*@ assigns \nothing; */
static float cosine_of(float angle)
{
    const float s = angle * angle;
    const float rest = 0.5f - (s * (PER_4 - (s * (PER_6 - (s * (PER_8 - (s * PER_10)))))));

    return 1.0f - (s * rest);
}

keel_status_t keel_position_set_origin(keel_position_t *position, int32_t latitude,
                                       int32_t longitude)
{
    float c;

    if ((latitude < -KEEL_POSITION_LATITUDE_LIMIT) || (latitude > KEEL_POSITION_LATITUDE_LIMIT) ||
        (longitude < -KEEL_POSITION_HALF_TURN) || (longitude > KEEL_POSITION_HALF_TURN)) {
        return KEEL_ERR_VALUE;
    }
    c = cosine_of((float)latitude * RADIANS);
    keel_axis_restart(&position->north);
    keel_axis_restart(&position->east);
    position->latitude = latitude;
    position->longitude = longitude;
    position->north_scale = NORTH_EVEN - (NORTH_DOUBLE * ((2.0f * (c * c)) - 1.0f));
    position->east_scale = c * (EAST_SINGLE - (EAST_TRIPLE * ((4.0f * (c * c)) - 3.0f)));
    position->has_origin = true;
    position->quality = KEEL_AXIS_NONE;
    return KEEL_OK;
}

/* How far a longitude is east of another, across the 180th meridian where that is nearer. */
/*@ assigns \nothing; */
static int64_t longitude_eastwards(int32_t from, int32_t to)
{
    int64_t way = (int64_t)to - (int64_t)from;

    if (way > KEEL_POSITION_HALF_TURN) {
        way -= KEEL_POSITION_FULL_TURN;
    } else if (way < -(int64_t)KEEL_POSITION_HALF_TURN) {
        way += KEEL_POSITION_FULL_TURN;
    } else {
        /* It is the nearer way. */
    }
    return way;
}

/*@ assigns \nothing;
  @ ensures \result <==> -KEEL_POSITION_NEAR <= way <= KEEL_POSITION_NEAR;
  @*/
static bool is_near(int64_t way)
{
    return (way >= -KEEL_POSITION_NEAR) && (way <= KEEL_POSITION_NEAR);
}

/* Near ways are exact as floats. */
/*@ assigns \nothing; */
static float metres_of(int64_t way, float scale)
{
    return is_near(way) ? ((float)(int32_t)way * scale) : 0.0f;
}

void keel_position_step(keel_position_t *position, const keel_position_sample_t *sample)
{
    const keel_position_config_t *const config = &position->config;
    const keel_position_fix_t *const fix = &sample->fix;
    const int64_t north = (int64_t)fix->latitude - (int64_t)position->latitude;
    const int64_t east = longitude_eastwards(position->longitude, fix->longitude);
    keel_axis_sample_t measured = {
        .acceleration = sample->north,
        .position = metres_of(north, position->north_scale),
        .velocity = fix->north,
        .has_acceleration = sample->has_acceleration,
        .has_fix = sample->has_fix,
        .has_velocity = keel_range_contains(fix->speed_accuracy, 0.0f, config->speed_accuracy),
        .is_usable = fix->is_valid && position->has_origin && is_near(north) && is_near(east) &&
                     keel_range_contains(fix->accuracy, 0.0f, config->accuracy),
    };

    keel_axis_step(&position->north, &measured);
    measured.acceleration = sample->east;
    measured.position = metres_of(east, position->east_scale);
    measured.velocity = fix->east;
    keel_axis_step(&position->east, &measured);
    position->quality = (position->north.quality < position->east.quality) ? position->north.quality
                                                                           : position->east.quality;
}
