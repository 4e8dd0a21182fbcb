/* SPDX-License-Identifier: Apache-2.0 */
/* Telemetry's reports: each message is made from the copter's structures. */
#include "keel/middleware/range.h"
#include "keel/version.h"
#include "mavlink_modes.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define MILLI      1000.0f
#define CENTI      100.0f
#define PERCENT    100.0f
#define US_PER_MS  1000u
#define DEGREES    57.29578f
#define FULL_TURN  360.0f
#define FAR_M      1.0e6f
#define UNKNOWN_16 65535u
#define UNKNOWN_8  255u
#define WORD       32u
#define MAVLINK_2  200u

/* What ALTITUDE says of what is not known. */
#define NO_TERRAIN   (-1001.0f)
#define NO_CLEARANCE (-1.0f)

/* A pressure that is older is not told, in us. */
#define FRESH_US 1000000u

/* The standard atmosphere. */
#define SEA_LEVEL_PA 101325.0f
#define SCALE_M      44330.8f
#define EXPONENT     0.190263f

static int16_t as_int16(float value)
{
    return (int16_t)keel_range_clamp(value, -32767.0f, 32767.0f);
}

static uint16_t as_uint16(float value)
{
    return (uint16_t)keel_range_clamp(value, 0.0f, 65534.0f);
}

static int32_t millimetres(float metres)
{
    return (int32_t)(keel_range_clamp(metres, -FAR_M, FAR_M) * MILLI);
}

static uint32_t now_ms(const copter_t *copter)
{
    return (uint32_t)(copter->scheduler.clock.now_us / US_PER_MS);
}

static uint32_t bit_when(bool condition, uint32_t bit)
{
    return condition ? bit : 0u;
}

/* Above the sea, as the first pressure and the standard atmosphere have it. */
static float sea_level_of_reference(const keel_altitude_t *altitude)
{
    return altitude->has_reference
               ? (SCALE_M * (1.0f - powf(altitude->reference / SEA_LEVEL_PA, EXPONENT)))
               : 0.0f;
}

static int32_t along(int32_t origin, float metres, float scale)
{
    return origin + (int32_t)(keel_range_clamp(metres, -FAR_M, FAR_M) / scale);
}

/* Roll, pitch, yaw, in rad. */
static void angles_of(const keel_attitude_quaternion_t *q, float angle[3])
{
    const float sine = keel_range_clamp(2.0f * ((q->w * q->y) - (q->z * q->x)), -1.0f, 1.0f);

    angle[0] = atan2f(2.0f * ((q->w * q->x) + (q->y * q->z)),
                      1.0f - (2.0f * ((q->x * q->x) + (q->y * q->y))));
    angle[1] = asinf(sine);
    angle[2] = atan2f(2.0f * ((q->w * q->z) + (q->x * q->y)),
                      1.0f - (2.0f * ((q->y * q->y) + (q->z * q->z))));
}

static bool is_alone(uint8_t state)
{
    return (state == KEEL_MODE_HOLDING) || (state == KEEL_MODE_RETURNING) ||
           (state == KEEL_MODE_LANDING);
}

static uint8_t status_of(const copter_t *copter)
{
    const keel_mode_t *const mode = &copter->state.mode;
    const uint32_t alarms = KEEL_MODE_RC_LOST | KEEL_MODE_FENCE_BREACHED |
                            KEEL_MODE_BATTERY_CRITICAL | KEEL_MODE_BATTERY_EMPTY;

    if (mode->state == KEEL_MODE_TERMINATED) {
        return (uint8_t)MAV_STATE_FLIGHT_TERMINATION;
    }
    if (is_alone(mode->state) && ((mode->cause & alarms) != 0u)) {
        return (uint8_t)MAV_STATE_CRITICAL;
    }
    if (mode->motors) {
        return (uint8_t)MAV_STATE_ACTIVE;
    }
    return (uint8_t)((copter->imu.attitude.phase == KEEL_ATTITUDE_RUNNING) ? MAV_STATE_STANDBY
                                                                           : MAV_STATE_BOOT);
}

/* What flies: the pilot's sticks, or the aircraft by itself; and whether it is stabilised. */
static uint32_t flags_of(const keel_mode_t *machine, uint8_t told)
{
    const bool alone = is_alone(machine->state) || (told == KEEL_MODE_LAND) ||
                       (told == KEEL_MODE_RETURN);

    if (told == KEEL_MODE_NONE) {
        return 0u;
    }
    return (alone ? MAV_MODE_FLAG_AUTO_ENABLED : MAV_MODE_FLAG_MANUAL_INPUT_ENABLED) |
           bit_when(told != KEEL_MODE_ACRO, MAV_MODE_FLAG_STABILIZE_ENABLED);
}

static void heartbeat(const copter_t *copter, uint8_t *payload)
{
    const keel_mode_t *const machine = &copter->state.mode;
    const uint8_t told = copter_mavlink_mode_told(copter);
    const message_heartbeat_t message = {
        .custom_mode = copter_mavlink_mode_number(told),
        .type = (uint8_t)MAV_TYPE_QUADROTOR,
        .autopilot = (uint8_t)MAV_AUTOPILOT_GENERIC,
        .base_mode = (uint8_t)(MAV_MODE_FLAG_CUSTOM_MODE_ENABLED |
                               bit_when(machine->motors, MAV_MODE_FLAG_SAFETY_ARMED) |
                               flags_of(machine, told)),
        .system_status = status_of(copter),
        .mavlink_version = 3u};

    message_heartbeat_pack(&message, payload);
}

static uint16_t volts(const copter_t *copter)
{
    return as_uint16(copter->power.battery.voltage * MILLI);
}

static int8_t charge_left(const keel_battery_t *battery)
{
    return (battery->level == KEEL_BATTERY_UNKNOWN)
               ? (int8_t)-1
               : (int8_t)keel_range_clamp(battery->remaining * PERCENT, 0.0f, PERCENT);
}

/* A count that fits. */
static uint16_t at_most(uint32_t count)
{
    return (uint16_t)((count < UNKNOWN_16) ? count : UNKNOWN_16);
}

static uint32_t healthy_sensors(const copter_t *copter)
{
    const uint32_t blocking = copter->state.mode.blocking.checks;
    const keel_mode_t *const mode = &copter->state.mode;

    return bit_when((blocking & KEEL_MODE_CHECK_GYROSCOPE) == 0u, MAV_SYS_STATUS_SENSOR_3D_GYRO) |
           bit_when((blocking & KEEL_MODE_CHECK_ACCELEROMETER) == 0u,
                    MAV_SYS_STATUS_SENSOR_3D_ACCEL) |
           bit_when((blocking & KEEL_MODE_CHECK_MAGNETOMETER) == 0u, MAV_SYS_STATUS_SENSOR_3D_MAG) |
           bit_when((copter->estimate.altitude.axis.quality == KEEL_AXIS_GOOD) &&
                        ((blocking & COPTER_CHECK_GROUND_PRESSURE) == 0u),
                    MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE) |
           bit_when(copter->estimate.position.quality == KEEL_AXIS_GOOD,
                    MAV_SYS_STATUS_SENSOR_GPS) |
           bit_when((mode->settled & KEEL_MODE_RC_LINKED) != 0u,
                    MAV_SYS_STATUS_SENSOR_RC_RECEIVER) |
           bit_when(copter->power.battery.level == KEEL_BATTERY_OK, MAV_SYS_STATUS_SENSOR_BATTERY) |
           bit_when((mode->seen & KEEL_MODE_FENCE_BREACHED) == 0u, MAV_SYS_STATUS_GEOFENCE) |
           bit_when(mode->motors || ((blocking == 0u) && (mode->blocking.facts == 0u)),
                    MAV_SYS_STATUS_PREARM_CHECK);
}

static void sys_status(const copter_t *copter, const copter_link_t *link, uint8_t *payload)
{
    const uint32_t present = MAV_SYS_STATUS_SENSOR_3D_GYRO | MAV_SYS_STATUS_SENSOR_3D_ACCEL |
                             MAV_SYS_STATUS_SENSOR_3D_MAG |
                             MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE | MAV_SYS_STATUS_SENSOR_GPS |
                             MAV_SYS_STATUS_SENSOR_RC_RECEIVER | MAV_SYS_STATUS_SENSOR_BATTERY |
                             MAV_SYS_STATUS_GEOFENCE | MAV_SYS_STATUS_PREARM_CHECK;
    const uint32_t errors = link->decoder.count.checksums + link->decoder.count.lengths;
    const message_sys_status_t message = {
        .onboard_control_sensors_present = present,
        .onboard_control_sensors_enabled = present,
        .onboard_control_sensors_health = healthy_sensors(copter),
        .load = (uint16_t)(copter->health.load_ppm / US_PER_MS),
        .voltage_battery = volts(copter),
        .current_battery = as_int16(copter->power.battery.current * CENTI),
        .battery_remaining = charge_left(&copter->power.battery),
        .errors_comm = at_most(errors),
        .errors_count1 = at_most(copter->health.overruns),
        .errors_count2 = at_most(copter->health.skipped),
        .errors_count3 = at_most(copter->log.lost)};

    message_sys_status_pack(&message, payload);
}

/* Whether the aircraft is outside, and how it last went out. */
static void fence_status(const copter_state_t *state, uint8_t *payload)
{
    static const uint8_t type[] = {[COPTER_SIDE_NONE] = FENCE_BREACH_NONE,
                                   [COPTER_SIDE_LOW] = FENCE_BREACH_MINALT,
                                   [COPTER_SIDE_HIGH] = FENCE_BREACH_MAXALT,
                                   [COPTER_SIDE_AROUND] = FENCE_BREACH_BOUNDARY};
    const bool is_outside = (state->mode.seen & KEEL_MODE_FENCE_BREACHED) != 0u;
    const message_fence_status_t message = {
        .breach_time = (uint32_t)(state->breach.last_us / US_PER_MS),
        .breach_count = at_most(state->breach.count),
        .breach_status = is_outside ? 1u : 0u,
        .breach_type = type[state->breach.side]};

    message_fence_status_pack(&message, payload);
}

/* The sample of one unit, in thousandths of g and of rad/s; 0 stands for no temperature there, so a
 * hundredth of a degree for 0. The messages of all three units are alike. */
static bool scaled_imu(const copter_t *copter, uint32_t unit, uint8_t *payload)
{
    const keel_virtual_imu_sample_t *const sample = &copter->imu.unit[unit];
    const int16_t temperature = copter->imu.temperature[unit];
    const float *const value = sample->value;
    const float milli_g = MILLI / KEEL_CASCADE_GRAVITY;
    const message_scaled_imu_t message = {.time_boot_ms = now_ms(copter),
                                          .xacc = as_int16(value[0] * milli_g),
                                          .yacc = as_int16(value[1] * milli_g),
                                          .zacc = as_int16(value[2] * milli_g),
                                          .xgyro = as_int16(value[3] * MILLI),
                                          .ygyro = as_int16(value[4] * MILLI),
                                          .zgyro = as_int16(value[5] * MILLI),
                                          .temperature = (temperature == 0) ? (int16_t)1
                                                                            : temperature};

    message_scaled_imu_pack(&message, payload);
    return sample->present;
}

/* Pressure and the barometer's temperature, as long as it measures. */
static bool scaled_pressure(const copter_t *copter, uint8_t *payload)
{
    const copter_barometer_t *const barometer = &copter->barometer;
    const uint64_t age_us = copter->scheduler.clock.now_us - barometer->sampled_us;
    const message_scaled_pressure_t message = {.time_boot_ms = now_ms(copter),
                                               .press_abs = barometer->pressure_pa / CENTI,
                                               .temperature = barometer->temperature};

    message_scaled_pressure_pack(&message, payload);
    return (barometer->samples > 0u) && (age_us <= FRESH_US);
}

/* Values that no message of MAVLink's is for. The chip's supply, of 3.3 V, is not the Vcc of
 * POWER_STATUS: that is a rail of 5 V, and stations warn when it has less. */
typedef struct named {
    const char *name; /* 10 characters at most. */
    int32_t value;
    bool is_known;
} named_t;

/* The next of them that is known: how deep the stack has been always is. */
static void named_value_int(const copter_t *copter, copter_link_t *link, uint8_t *payload)
{
    const uint32_t bytes = copter->health.stack_free;
    const copter_chip_t *const chip = &copter->health.chip;
    const named_t named[COPTER_NAMED] = {
        {"stack_free", (bytes < (uint32_t)INT32_MAX) ? (int32_t)bytes : INT32_MAX, true},
        {"chip_mv", (int32_t)chip->supply_mv, chip->has_supply},
        {"chip_cdeg", chip->temperature, chip->has_temperature}};
    message_named_value_int_t message = {.time_boot_ms = now_ms(copter)};
    uint32_t next = link->named;

    for (uint32_t i = 1u; (i < COPTER_NAMED) && !named[next].is_known; i++) {
        next = (next + 1u) % COPTER_NAMED;
    }
    link->named = (next + 1u) % COPTER_NAMED;
    message.value = named[next].value;
    for (uint32_t i = 0u; (i < sizeof message.name) && (named[next].name[i] != '\0'); i++) {
        message.name[i] = named[next].name[i];
    }
    message_named_value_int_pack(&message, payload);
}

static bool gps_raw_int(const copter_t *copter, uint8_t *payload)
{
    const copter_gps_t *const gps = &copter->gps;
    const copter_fix_t *const fix = &gps->fix;
    const keel_ubx_fix_t *const received = &gps->receiver.fix;
    const float speed = sqrtf((fix->north * fix->north) + (fix->east * fix->east));
    const float course = atan2f(fix->east, fix->north) * DEGREES;
    const message_gps_raw_int_t message = {
        .time_usec = gps->fixed_us,
        .lat = fix->latitude,
        .lon = fix->longitude,
        .alt = received->height_mm,
        .eph = (uint16_t)UNKNOWN_16,
        .epv = (uint16_t)UNKNOWN_16,
        .vel = as_uint16(speed * CENTI),
        .cog = as_uint16(((course < 0.0f) ? (course + FULL_TURN) : course) * CENTI),
        .fix_type = (uint8_t)(fix->is_valid ? GPS_FIX_TYPE_3D_FIX : GPS_FIX_TYPE_NO_FIX),
        .satellites_visible = received->satellites,
        .h_acc = (uint32_t)millimetres(keel_range_clamp(fix->accuracy, 0.0f, FAR_M)),
        .v_acc = received->height_accuracy,
        .vel_acc = (uint32_t)millimetres(keel_range_clamp(fix->speed_accuracy, 0.0f, FAR_M))};

    message_gps_raw_int_pack(&message, payload);
    return gps->fixes > 0u;
}

static bool attitude(const copter_t *copter, uint8_t *payload)
{
    const keel_attitude_t *const from = &copter->imu.attitude;
    float angle[3];

    angles_of(&from->quaternion, angle);
    {
        const message_attitude_t message = {.time_boot_ms = now_ms(copter),
                                            .roll = angle[0],
                                            .pitch = angle[1],
                                            .yaw = angle[2],
                                            .rollspeed = from->rate.x,
                                            .pitchspeed = from->rate.y,
                                            .yawspeed = from->rate.z};

        message_attitude_pack(&message, payload);
    }
    return from->phase == KEEL_ATTITUDE_RUNNING;
}

static bool attitude_quaternion(const copter_t *copter, uint8_t *payload)
{
    const keel_attitude_t *const from = &copter->imu.attitude;
    const message_attitude_quaternion_t message = {.time_boot_ms = now_ms(copter),
                                                   .q1 = from->quaternion.w,
                                                   .q2 = from->quaternion.x,
                                                   .q3 = from->quaternion.y,
                                                   .q4 = from->quaternion.z,
                                                   .rollspeed = from->rate.x,
                                                   .pitchspeed = from->rate.y,
                                                   .yawspeed = from->rate.z};

    message_attitude_quaternion_pack(&message, payload);
    return from->phase == KEEL_ATTITUDE_RUNNING;
}

/* The values of instruments. There is no speed through the air but that over the ground. */
static bool vfr_hud(const copter_t *copter, uint8_t *payload)
{
    const keel_cascade_estimate_t *const here = &copter->estimate.here;
    const keel_altitude_t *const altitude = &copter->estimate.altitude;
    const float north = here->velocity.north;
    const float east = here->velocity.east;
    const float thrust = copter->state.mode.motors ? copter->control.cascade.command.thrust : 0.0f;
    const float speed = here->has_place ? sqrtf((north * north) + (east * east)) : 0.0f;
    float angle[3];
    float heading;

    angles_of(&copter->imu.attitude.quaternion, angle);
    heading = angle[2] * DEGREES;
    {
        const message_vfr_hud_t message = {
            .airspeed = speed,
            .groundspeed = speed,
            .alt = sea_level_of_reference(altitude) + altitude->zero + here->position.up,
            .climb = here->velocity.up,
            .heading = as_int16((heading < 0.0f) ? (heading + FULL_TURN) : heading),
            .throttle = (uint16_t)keel_range_clamp(thrust * PERCENT, 0.0f, PERCENT)};

        message_vfr_hud_pack(&message, payload);
    }
    return here->has_height && (copter->imu.attitude.phase == KEEL_ATTITUDE_RUNNING);
}

/* Nothing looks down: terrain and clearance are what stands for unknown. */
static bool altitude_of(const copter_t *copter, uint8_t *payload)
{
    const keel_altitude_t *const altitude = &copter->estimate.altitude;
    const keel_cascade_estimate_t *const here = &copter->estimate.here;
    const float up = altitude->zero + here->position.up;
    const message_altitude_t message = {.time_usec = copter->scheduler.clock.now_us,
                                        .altitude_monotonic = up,
                                        .altitude_amsl = sea_level_of_reference(altitude) + up,
                                        .altitude_local = up,
                                        .altitude_relative = here->position.up,
                                        .altitude_terrain = NO_TERRAIN,
                                        .bottom_clearance = NO_CLEARANCE};

    message_altitude_pack(&message, payload);
    return here->has_height;
}

/* The date is 0 where it is not known. */
static void system_time(const copter_t *copter, uint8_t *payload)
{
    const message_system_time_t message = {
        .time_unix_usec = copter_utc_us(&copter->gps.date, copter->scheduler.clock.now_us),
        .time_boot_ms = now_ms(copter)};

    message_system_time_pack(&message, payload);
}

/* As MAVLink counts: 100 times its own version, of the latest and of the least that is heard. */
static void protocol_version(uint8_t *payload)
{
    const message_protocol_version_t message = {
        .version = MAVLINK_2, .min_version = MAVLINK_2, .max_version = MAVLINK_2};

    message_protocol_version_pack(&message, payload);
}

static void component_metadata(const copter_t *copter, uint8_t *payload)
{
    static const char begin[] = "mftp://[;comp=1]/";
    const copter_file_t *const file = &copter_file[COPTER_FILE_MAIN];
    message_component_metadata_t message = {.time_boot_ms = now_ms(copter), .file_crc = file->crc};
    const size_t length = sizeof begin - 1u;

    (void)memcpy(message.uri, begin, length);
    for (size_t i = 0u; (file->name[i] != '\0') && ((length + i) < sizeof message.uri); i++) {
        message.uri[length + i] = file->name[i];
    }
    message_component_metadata_pack(&message, payload);
}

static bool local_position_ned(const copter_t *copter, uint8_t *payload)
{
    const keel_cascade_estimate_t *const here = &copter->estimate.here;
    const message_local_position_ned_t message = {.time_boot_ms = now_ms(copter),
                                                  .x = here->position.north,
                                                  .y = here->position.east,
                                                  .z = -here->position.up,
                                                  .vx = here->velocity.north,
                                                  .vy = here->velocity.east,
                                                  .vz = -here->velocity.up};

    message_local_position_ned_pack(&message, payload);
    return here->has_place && here->has_height;
}

static bool global_position_int(const copter_t *copter, uint8_t *payload)
{
    const keel_position_t *const position = &copter->estimate.position;
    const keel_altitude_t *const altitude = &copter->estimate.altitude;
    const keel_cascade_estimate_t *const here = &copter->estimate.here;
    const float sea_m = sea_level_of_reference(altitude);
    message_global_position_int_t message = {
        .time_boot_ms = now_ms(copter),
        .alt = millimetres(sea_m + altitude->zero + here->position.up),
        .relative_alt = millimetres(here->position.up),
        .vx = as_int16(position->north.velocity * CENTI),
        .vy = as_int16(position->east.velocity * CENTI),
        .vz = as_int16(-here->velocity.up * CENTI),
        .hdg = (uint16_t)UNKNOWN_16};
    float angle[3];

    if (!position->has_origin) {
        return false;
    }
    angles_of(&copter->imu.attitude.quaternion, angle);
    if (copter->imu.attitude.heading_valid) {
        const float heading = angle[2] * DEGREES;

        message.hdg = as_uint16(((heading < 0.0f) ? (heading + FULL_TURN) : heading) * CENTI);
    }
    message.lat = along(position->latitude, position->north.position, position->north_scale);
    message.lon = along(position->longitude, position->east.position, position->east_scale);
    message_global_position_int_pack(&message, payload);
    return true;
}

/* A motor as if it were a servo. */
static uint16_t pulse_of(float output)
{
    return (uint16_t)(1000.0f + keel_range_clamp(output * 1000.0f, 0.0f, 1000.0f));
}

static void servo_output_raw(const copter_t *copter, uint8_t *payload)
{
    const float *const output = copter->control.mixer.output;
    const message_servo_output_raw_t message = {
        .time_usec = (uint32_t)(copter->scheduler.clock.now_us & UINT32_MAX),
        .servo1_raw = pulse_of(output[0]),
        .servo2_raw = pulse_of(output[1]),
        .servo3_raw = pulse_of(output[2]),
        .servo4_raw = pulse_of(output[3])};

    message_servo_output_raw_pack(&message, payload);
}

static bool rc_channels(const copter_t *copter, uint8_t *payload)
{
    const uint16_t none = (uint16_t)UNKNOWN_16;
    const uint16_t *const channel = copter->pilot.rc.channel;
    message_rc_channels_t message;

    message = (message_rc_channels_t){.time_boot_ms = now_ms(copter),
                                      .chan1_raw = channel[0],
                                      .chan2_raw = channel[1],
                                      .chan3_raw = channel[2],
                                      .chan4_raw = channel[3],
                                      .chan5_raw = channel[4],
                                      .chan6_raw = channel[5],
                                      .chan7_raw = channel[6],
                                      .chan8_raw = channel[7],
                                      .chan9_raw = channel[8],
                                      .chan10_raw = channel[9],
                                      .chan11_raw = channel[10],
                                      .chan12_raw = channel[11],
                                      .chan13_raw = channel[12],
                                      .chan14_raw = channel[13],
                                      .chan15_raw = channel[14],
                                      .chan16_raw = channel[15],
                                      .chan17_raw = none,
                                      .chan18_raw = none,
                                      .chancount = (uint8_t)COPTER_CHANNELS,
                                      .rssi = (uint8_t)UNKNOWN_8};

    message_rc_channels_pack(&message, payload);
    return copter->pilot.rc.frames > 0u;
}

static uint8_t charge_of(keel_battery_level_t level)
{
    uint32_t state = MAV_BATTERY_CHARGE_STATE_UNDEFINED;

    if (level == KEEL_BATTERY_OK) {
        state = MAV_BATTERY_CHARGE_STATE_OK;
    } else if (level == KEEL_BATTERY_LOW) {
        state = MAV_BATTERY_CHARGE_STATE_LOW;
    } else if (level == KEEL_BATTERY_CRITICAL) {
        state = MAV_BATTERY_CHARGE_STATE_CRITICAL;
    } else {
        /* It is not known. */
    }
    return (uint8_t)state;
}

static void battery_status(const copter_t *copter, uint8_t *payload)
{
    const keel_battery_t *const battery = &copter->power.battery;
    const bool known = battery->level != KEEL_BATTERY_UNKNOWN;
    message_battery_status_t message = {
        .current_consumed = known ? (int32_t)keel_range_clamp(battery->charge_c / 3.6f, 0.0f, FAR_M)
                                  : -1,
        .energy_consumed = known ? (int32_t)keel_range_clamp(battery->energy_j / CENTI, 0.0f, FAR_M)
                                 : -1,
        .temperature = INT16_MAX,
        .current_battery = as_int16(battery->current * CENTI),
        .battery_function = (uint8_t)MAV_BATTERY_FUNCTION_ALL,
        .type = (uint8_t)MAV_BATTERY_TYPE_LIPO,
        .battery_remaining = charge_left(battery),
        .time_remaining = known ? (int32_t)keel_range_clamp(battery->remaining_s, 0.0f, FAR_M) : 0,
        .charge_state = charge_of(battery->level)};

    for (uint32_t i = 0u; i < (sizeof message.voltages / sizeof message.voltages[0]); i++) {
        message.voltages[i] = (uint16_t)UNKNOWN_16;
    }
    message.voltages[0] = volts(copter); /* Of all cells: each one's is not measured. */
    message_battery_status_pack(&message, payload);
}

/* Older clients know 64 bits: all of the chip's are in them. */
static uint64_t short_uid(const uint8_t uid[COPTER_UID_BYTES])
{
    uint64_t bits = 0u;

    for (uint32_t i = 0u; i < COPTER_UID_BYTES; i++) {
        bits ^= (uint64_t)uid[i] << (8u * (i % 8u));
    }
    return bits;
}

static void autopilot_version(const copter_t *copter, uint8_t *payload)
{
    const uint8_t *const uid = copter->port->uid;
    const uint32_t version = ((uint32_t)KEEL_VERSION_MAJOR << 24) |
                             ((uint32_t)KEEL_VERSION_MINOR << 16) |
                             ((uint32_t)KEEL_VERSION_PATCH << 8);
    message_autopilot_version_t message = {
        .capabilities = MAV_PROTOCOL_CAPABILITY_MAVLINK2 |
                        MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE |
                        MAV_PROTOCOL_CAPABILITY_FTP | MAV_PROTOCOL_CAPABILITY_MISSION_INT,
        .uid = (uid != NULL) ? short_uid(uid) : 0u,
        .flight_sw_version = version,
        .middleware_sw_version = version};

    for (uint32_t i = 0u; (uid != NULL) && (i < COPTER_UID_BYTES); i++) {
        message.uid2[i] = uid[i];
    }
    message_autopilot_version_pack(&message, payload);
}

static void estimator_status(const copter_t *copter, uint8_t *payload)
{
    const copter_estimate_t *const estimate = &copter->estimate;
    const bool has_place = estimate->position.quality != KEEL_AXIS_NONE;
    const bool has_height = estimate->here.has_height;
    const message_estimator_status_t message = {
        .time_usec = copter->scheduler.clock.now_us,
        .pos_horiz_accuracy = copter->gps.fix.accuracy,
        .pos_vert_accuracy = 1.0f,
        .flags = (uint16_t)(bit_when(copter->imu.attitude.phase == KEEL_ATTITUDE_RUNNING,
                                     ESTIMATOR_ATTITUDE) |
                            bit_when(has_place, ESTIMATOR_VELOCITY_HORIZ | ESTIMATOR_POS_HORIZ_REL |
                                                    ESTIMATOR_POS_HORIZ_ABS) |
                            bit_when(has_height,
                                     ESTIMATOR_VELOCITY_VERT | ESTIMATOR_POS_VERT_ABS))};

    message_estimator_status_pack(&message, payload);
}

static bool home_position(const copter_t *copter, uint8_t *payload)
{
    const copter_estimate_t *const estimate = &copter->estimate;
    const keel_position_t *const position = &estimate->position;
    message_home_position_t message = {
        .time_usec = copter->scheduler.clock.now_us,
        .altitude = millimetres(sea_level_of_reference(&estimate->altitude) +
                                estimate->altitude.zero),
        .q = {1.0f, 0.0f, 0.0f, 0.0f}};

    if (!position->has_origin) {
        return false;
    }
    message.latitude = along(position->latitude, estimate->home_north, position->north_scale);
    message.longitude = along(position->longitude, estimate->home_east, position->east_scale);
    message_home_position_pack(&message, payload);
    return true;
}

static void extended_sys_state(const copter_t *copter, uint8_t *payload)
{
    uint32_t landed = MAV_LANDED_STATE_IN_AIR;

    if (copter->estimate.is_landed) {
        landed = MAV_LANDED_STATE_ON_GROUND;
    } else if (copter->state.mode.state == KEEL_MODE_LANDING) {
        landed = MAV_LANDED_STATE_LANDING;
    } else {
        /* It flies. */
    }
    {
        const message_extended_sys_state_t message = {.landed_state = (uint8_t)landed};

        message_extended_sys_state_pack(&message, payload);
    }
}

/* The next text; those that were overwritten are missed. */
static bool statustext(const copter_telemetry_t *telemetry, copter_link_t *link, uint8_t *payload)
{
    const uint32_t behind = telemetry->texts - link->texts;
    message_statustext_t message = {0};

    if (behind == 0u) {
        return false;
    }
    if (behind > COPTER_TEXTS) {
        link->missed += behind - COPTER_TEXTS;
        link->texts = telemetry->texts - COPTER_TEXTS;
    }
    message.severity = telemetry->text[link->texts % COPTER_TEXTS].severity;
    for (uint32_t i = 0u; i < COPTER_TEXT_LENGTH; i++) {
        message.text[i] = telemetry->text[link->texts % COPTER_TEXTS].text[i];
    }
    link->texts++;
    message_statustext_pack(&message, payload);
    return true;
}

static bool command_ack(copter_link_t *link, uint8_t *payload)
{
    if (link->acks == 0u) {
        return false;
    }
    message_command_ack_pack(&link->ack[0], payload);
    for (uint32_t i = 1u; i < link->acks; i++) {
        link->ack[i - 1u] = link->ack[i];
    }
    link->acks--;
    return true;
}

/* A whole number is sent as a float, too; above 2^24 it is rounded to one. */
static float sent_as(keel_parameter_value_t value)
{
    return (value.type == KEEL_PARAMETER_FLOAT) ? value.real : (float)value.whole;
}

/* The next one that is wanted behind the one that was sent last; or none. */
static uint32_t next_wanted(const copter_link_t *link)
{
    uint32_t next = COPTER_PARAMETER_COUNT;

    for (uint32_t i = COPTER_PARAMETER_COUNT; i > 0u; i--) {
        const uint32_t index = (link->parameter + i) % COPTER_PARAMETER_COUNT;

        if ((link->wanted[index / WORD] & ((uint32_t)1u << (index % WORD))) != 0u) {
            next = index;
        }
    }
    return next;
}

static bool param_value(const keel_parameters_t *parameters, copter_link_t *link, uint8_t *payload)
{
    const uint32_t index = next_wanted(link);
    message_param_value_t message = {.param_count = (uint16_t)COPTER_PARAMETER_COUNT,
                                     .param_index = (uint16_t)index};

    if (index < COPTER_PARAMETER_COUNT) {
        const keel_parameter_value_t value = keel_parameters_get(parameters, (uint16_t)index);
        const char *const name = keel_parameters_name(parameters, (uint16_t)index);

        link->wanted[index / WORD] &= ~((uint32_t)1u << (index % WORD));
        link->parameter = index;
        for (uint32_t i = 0u; (i < sizeof message.param_id) && (name[i] != '\0'); i++) {
            message.param_id[i] = name[i];
        }
        message.param_value = sent_as(value);
        message.param_type = (uint8_t)MAV_PARAM_TYPE_REAL32;
        message_param_value_pack(&message, payload);
    }
    return index < COPTER_PARAMETER_COUNT;
}

static bool param_error(copter_link_t *link, uint8_t *payload)
{
    if (link->errors == 0u) {
        return false;
    }
    message_param_error_pack(&link->error[0], payload);
    for (uint32_t i = 1u; i < link->errors; i++) {
        link->error[i - 1u] = link->error[i];
    }
    link->errors--;
    return true;
}

static bool file_transfer(copter_link_t *link, uint8_t *payload)
{
    message_file_transfer_protocol_t message;
    const bool said = copter_ftp_report(&link->ftp, &message);

    if (said) {
        message_file_transfer_protocol_pack(&message, payload);
    }
    return said;
}

static bool serial_control(const copter_t *copter, copter_link_t *link, uint8_t *payload)
{
    message_serial_control_t message;
    const bool said = copter_shell_report(copter, &link->shell, &message);

    if (said) {
        message_serial_control_pack(&message, payload);
    }
    return said;
}

/* Messages that a station shows, or asks for as it connects. */
static bool fill_for_station(const copter_t *copter, copter_link_t *link, uint32_t sent,
                             uint8_t *payload)
{
    bool said = true;

    switch (sent) {
    case SENT_ATTITUDE_QUATERNION:
        said = attitude_quaternion(copter, payload);
        break;
    case SENT_VFR_HUD:
        said = vfr_hud(copter, payload);
        break;
    case SENT_ALTITUDE:
        said = altitude_of(copter, payload);
        break;
    case SENT_SYSTEM_TIME:
        system_time(copter, payload);
        break;
    case SENT_PROTOCOL_VERSION:
        protocol_version(payload);
        break;
    case SENT_COMPONENT_METADATA:
        component_metadata(copter, payload);
        break;
    case SENT_FILE_TRANSFER_PROTOCOL:
        said = file_transfer(link, payload);
        break;
    case SENT_SERIAL_CONTROL:
        said = serial_control(copter, link, payload);
        break;
    default:
        said = copter_mavlink_report_list(link, sent, payload);
        break;
    }
    return said;
}

static bool fill_answer(const copter_t *copter, copter_link_t *link, uint32_t sent,
                        uint8_t *payload)
{
    bool said = true;

    switch (sent) {
    case SENT_COMMAND_ACK:
        said = command_ack(link, payload);
        break;
    case SENT_PARAM_VALUE:
        said = param_value(&copter->parameters.table, link, payload);
        break;
    case SENT_PARAM_ERROR:
        said = param_error(link, payload);
        break;
    case SENT_STATUSTEXT:
        said = statustext(copter->telemetry, link, payload);
        break;
    case SENT_PING:
        message_ping_pack(&link->ping, payload);
        break;
    case SENT_TIMESYNC:
        message_timesync_pack(&link->timesync, payload);
        break;
    case SENT_AVAILABLE_MODES:
        said = copter_mavlink_modes_available(link, payload);
        break;
    default:
        said = fill_for_station(copter, link, sent, payload);
        break;
    }
    return said;
}

static bool fill_place(const copter_t *copter, copter_link_t *link, uint32_t sent, uint8_t *payload)
{
    bool said = true;

    switch (sent) {
    case SENT_ATTITUDE:
        said = attitude(copter, payload);
        break;
    case SENT_LOCAL_POSITION_NED:
        said = local_position_ned(copter, payload);
        break;
    case SENT_GLOBAL_POSITION_INT:
        said = global_position_int(copter, payload);
        break;
    case SENT_GPS_RAW_INT:
        said = gps_raw_int(copter, payload);
        break;
    case SENT_HOME_POSITION:
        said = home_position(copter, payload);
        break;
    case SENT_SCALED_IMU:
        said = scaled_imu(copter, 0u, payload);
        break;
    case SENT_SCALED_IMU2:
        said = scaled_imu(copter, 1u, payload);
        break;
    case SENT_SCALED_IMU3:
        said = scaled_imu(copter, 2u, payload);
        break;
    case SENT_SCALED_PRESSURE:
        said = scaled_pressure(copter, payload);
        break;
    case SENT_RC_CHANNELS:
        said = rc_channels(copter, payload);
        break;
    default:
        said = fill_answer(copter, link, sent, payload);
        break;
    }
    return said;
}

bool copter_mavlink_report(const copter_t *copter, copter_link_t *link, uint32_t sent,
                           uint8_t *payload)
{
    bool said = true;

    switch (sent) {
    case SENT_HEARTBEAT:
        heartbeat(copter, payload);
        break;
    case SENT_SYS_STATUS:
        sys_status(copter, link, payload);
        break;
    case SENT_FENCE_STATUS:
        fence_status(&copter->state, payload);
        break;
    case SENT_SERVO_OUTPUT_RAW:
        servo_output_raw(copter, payload);
        break;
    case SENT_BATTERY_STATUS:
        battery_status(copter, payload);
        break;
    case SENT_AUTOPILOT_VERSION:
        autopilot_version(copter, payload);
        break;
    case SENT_CURRENT_MODE:
        copter_mavlink_modes_current(copter, payload);
        break;
    case SENT_ESTIMATOR_STATUS:
        estimator_status(copter, payload);
        break;
    case SENT_EXTENDED_SYS_STATE:
        extended_sys_state(copter, payload);
        break;
    case SENT_NAMED_VALUE_INT:
        named_value_int(copter, link, payload);
        break;
    default:
        said = fill_place(copter, link, sent, payload);
        break;
    }
    return said;
}
