/* SPDX-License-Identifier: Apache-2.0 */
/* The log: topics, their tasks, and at which of their runs. */
#include "copter.h"

#include <stddef.h>

#define SIZE_OF(member) sizeof(((copter_t *)0)->member)

#define FIELD(text, kind, size, member)                                                            \
    {.is = {.name = {text}, .type = (kind), .count = (uint8_t)(SIZE_OF(member) / (size))},         \
     .offset = (uint32_t)offsetof(copter_t, member)}

/* A number or an array of them; a structure of floats is an array, too. */
#define FLOATS(text, member) FIELD(text, KEEL_ULOG_FLOAT, 4u, member)
#define BYTES(text, member)  FIELD(text, KEEL_ULOG_UINT8, 1u, member)
#define HALVES(text, member) FIELD(text, KEEL_ULOG_UINT16, 2u, member)
#define WORDS(text, member)  FIELD(text, KEEL_ULOG_UINT32, 4u, member)
#define LONGS(text, member)  FIELD(text, KEEL_ULOG_UINT64, 8u, member)
#define SHORTS(text, member) FIELD(text, KEEL_ULOG_INT16, 2u, member)
#define PLACES(text, member) FIELD(text, KEEL_ULOG_INT32, 4u, member)
#define BOOLS(text, member)  FIELD(text, KEEL_ULOG_BOOL, 1u, member)

#define VOTE(text, number) FLOATS(text, imu.virtual_imu.channel[number].vote.output)

/* Units, vote and attitude are foreground IMU's; angle control, which runs behind it in each of its
 * periods, writes them: so no real-time budget pays for that. */
#define IMU(number)                                                                                \
    {                                                                                              \
        .name = {"imu"}, .instance = (number), .row = URPILOT_ANGLE_CONTROL, .every = 1u,          \
        .gives_way = true, .fields = 4u, .field = {                                                \
            FLOATS("value", imu.unit[number].value),                                               \
            WORDS("age_us", imu.unit[number].age_us),                                              \
            SHORTS("temperature_cdeg", imu.temperature[number]),                                   \
            BOOLS("present", imu.unit[number].present)                                             \
        }                                                                                          \
    }

#define SETPOINT(text, number) FLOATS(text, control.cascade.axis[number].pid.setpoint)

const copter_topic_t copter_topic[] = {
    IMU(0),
    IMU(1),
    IMU(2),
    {.name = {"vote"},
     .row = URPILOT_ANGLE_CONTROL,
     .every = 5u,
     .fields = 10u,
     .field = {VOTE("force_x", 0), VOTE("force_y", 1), VOTE("force_z", 2), VOTE("rate_x", 3),
               VOTE("rate_y", 4), VOTE("rate_z", 5), BYTES("used", imu.virtual_imu.used),
               BYTES("latched", imu.virtual_imu.latched),
               BYTES("force_state", imu.accelerometer.state),
               BYTES("rate_state", imu.gyroscope.state)}},
    {.name = {"attitude"},
     .row = URPILOT_ANGLE_CONTROL,
     .every = 5u,
     .fields = 7u,
     .field = {FLOATS("q", imu.attitude.quaternion), FLOATS("bias", imu.attitude.bias),
               FLOATS("rate", imu.attitude.rate),
               FLOATS("heading_error", imu.attitude.heading_error),
               WORDS("flags", imu.attitude.flags),
               BOOLS("heading_valid", imu.attitude.heading_valid),
               BYTES("phase", imu.attitude.phase)}},
    {.name = {"control"},
     .row = URPILOT_ANGLE_RATE_CONTROL,
     .every = 5u,
     .fields = 9u,
     .field = {SETPOINT("tilt_roll", KEEL_CASCADE_ROLL), SETPOINT("tilt_pitch", KEEL_CASCADE_PITCH),
               SETPOINT("rate_roll", KEEL_CASCADE_ROLL_RATE),
               SETPOINT("rate_pitch", KEEL_CASCADE_PITCH_RATE),
               SETPOINT("rate_yaw", KEEL_CASCADE_YAW_RATE),
               FLOATS("command", control.cascade.command), FLOATS("motor", control.mixer.output),
               WORDS("limited", control.mixer.limited), WORDS("axes", control.cascade.axes)}},
    {.name = {"place"},
     .row = URPILOT_POSITION_CONTROL,
     .every = 5u,
     .fields = 2u,
     .field = {FLOATS("asked", control.place), FLOATS("asked_velocity", control.asked)}},
    {.name = {"compass"},
     .row = URPILOT_FOREGROUND_MAGNETOMETER,
     .every = 1u,
     .fields = 3u,
     .field = {FLOATS("raw", magnetometer.raw), FLOATS("field", magnetometer.field),
               WORDS("samples", magnetometer.samples)}},
    {.name = {"air"},
     .row = URPILOT_FOREGROUND_BAROMETER,
     .every = 1u,
     .fields = 3u,
     .field = {FLOATS("pressure_pa", barometer.pressure_pa), WORDS("samples", barometer.samples),
               SHORTS("temperature_cdeg", barometer.temperature)}},
    {.name = {"satellites"},
     .row = URPILOT_GPS,
     .every = 5u,
     .fields = 10u,
     .field = {LONGS("utc_us", gps.date.utc_us), PLACES("latitude", gps.fix.latitude),
               PLACES("longitude", gps.fix.longitude), FLOATS("velocity_north", gps.fix.north),
               FLOATS("velocity_east", gps.fix.east), FLOATS("accuracy", gps.fix.accuracy),
               FLOATS("speed_accuracy", gps.fix.speed_accuracy), WORDS("fixes", gps.fixes),
               BOOLS("valid", gps.fix.is_valid), BOOLS("silent", gps.is_silent)}},
    {.name = {"pilot"},
     .row = URPILOT_FOREGROUND_RADIO,
     .every = 5u,
     .fields = 9u,
     .field = {HALVES("channel_us", pilot.rc.channel), WORDS("frames", pilot.frames),
               WORDS("received", pilot.rc.frames), WORDS("refused", pilot.ear.refused),
               WORDS("facts", pilot.facts), BYTES("asked", pilot.asked),
               BYTES("heard", pilot.ear.heard), BYTES("protocol", pilot.rc.protocol),
               BOOLS("lost", pilot.rc.is_lost)}},
    {.name = {"energy"},
     .row = URPILOT_FOREGROUND_POWER_MODULE,
     .every = 1u,
     .fields = 7u,
     .field = {FLOATS("voltage", power.battery.voltage), FLOATS("current", power.battery.current),
               FLOATS("cell_voltage", power.battery.cell_voltage),
               FLOATS("charge_c", power.battery.charge_c),
               FLOATS("remaining", power.battery.remaining),
               FLOATS("remaining_s", power.battery.remaining_s),
               BYTES("level", power.battery.level)}},
    {.name = {"estimate"},
     .row = URPILOT_NAVIGATION,
     .every = 1u,
     .fields = 6u,
     .field = {FLOATS("position", estimate.here.position),
               FLOATS("velocity", estimate.here.velocity), WORDS("resets", estimate.resets),
               BOOLS("landed", estimate.is_landed),
               BYTES("place_quality", estimate.position.quality),
               BYTES("height_quality", estimate.altitude.axis.quality)}},
    {.name = {"state"},
     .row = URPILOT_STATE_MACHINE,
     .every = 5u,
     .fields = 7u,
     .field = {BYTES("state", state.mode.state), BYTES("mode", state.mode.mode),
               BOOLS("motors", state.mode.motors), WORDS("cause", state.mode.cause),
               WORDS("settled", state.mode.settled),
               WORDS("blocking_checks", state.mode.blocking.checks),
               WORDS("blocking_facts", state.mode.blocking.facts)}},
    {.name = {"calibration"},
     .row = URPILOT_CALIBRATION_IMU,
     .every = 20u,
     .fields = 2u,
     .field = {WORDS("done", calibration.done), WORDS("checks", calibration.checks)}},
    {.name = {"health"},
     .row = URPILOT_SCHEDULER_ANALYSIS,
     .every = 1u,
     .fields = 9u,
     .field = {WORDS("load_ppm", health.load_ppm), WORDS("overruns", health.overruns),
               WORDS("skipped", health.skipped), WORDS("stack_free", health.stack_free),
               WORDS("checks", health.checks), HALVES("supply_mv", health.chip.supply_mv),
               SHORTS("chip_cdeg", health.chip.temperature),
               BOOLS("has_supply", health.chip.has_supply),
               BOOLS("has_chip", health.chip.has_temperature)}},
    {.name = {"tasks"},
     .row = COPTER_LOG_ROW,
     .every = 1u,
     .fields = 4u,
     .field = {WORDS("runs", log.runs), WORDS("busy_us", log.busy_us),
               WORDS("longest_us", log.longest_us), HALVES("skipped", log.skipped)}}};

const uint32_t copter_topics = sizeof copter_topic / sizeof copter_topic[0];
