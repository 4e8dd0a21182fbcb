/* SPDX-License-Identifier: Apache-2.0 */
/* How often links are told each message, as parameters. */
#include "keel/middleware/range.h"
#include "telemetry.h"

#include <string.h>

#define MILLION 1000000.0f
#define MOST_HZ 100.0f
#define LEAST_HZ 0.02f

typedef struct rate {
    const char *name;
    uint32_t sent;
} rate_t;

static const rate_t rate[] = {
    {"TEL_SYSTEM", SENT_SYS_STATUS},
    {"TEL_GPS", SENT_GPS_RAW_INT},
    {"TEL_ATTITUDE", SENT_ATTITUDE},
    {"TEL_LOCAL", SENT_LOCAL_POSITION_NED},
    {"TEL_GLOBAL", SENT_GLOBAL_POSITION_INT},
    {"TEL_MOTORS", SENT_SERVO_OUTPUT_RAW},
    {"TEL_RADIO", SENT_RC_CHANNELS},
    {"TEL_BATTERY", SENT_BATTERY_STATUS},
    {"TEL_ESTIMATOR", SENT_ESTIMATOR_STATUS},
    {"TEL_HOME", SENT_HOME_POSITION},
    {"TEL_STATE", SENT_EXTENDED_SYS_STATE},
};

static bool is_rate(float hz)
{
    return keel_range_contains(hz, 0.0f, 0.0f) || keel_range_contains(hz, LEAST_HZ, MOST_HZ);
}

uint32_t copter_interval_us(float rate_hz)
{
    return (is_rate(rate_hz) && (rate_hz > 0.0f)) ? (uint32_t)((MILLION / rate_hz) + 0.5f) : 0u;
}

static void get(void *context, uint32_t index, copter_parameter_t *parameter)
{
    const copter_telemetry_t *const telemetry = context;
    const float hz = telemetry->rate_hz[rate[index].sent];

    *parameter = (copter_parameter_t){.type = (uint8_t)MAV_PARAM_TYPE_REAL32};
    (void)memcpy(parameter->name, rate[index].name, strlen(rate[index].name));
    (void)memcpy(&parameter->bits, &hz, sizeof hz);
}

/* Applies to all links at once. */
static bool set(void *context, uint32_t index, uint8_t type, uint32_t bits)
{
    copter_telemetry_t *const telemetry = context;
    const uint32_t sent = rate[index].sent;
    float hz;

    (void)memcpy(&hz, &bits, sizeof hz);
    if ((type != MAV_PARAM_TYPE_REAL32) || !is_rate(hz)) {
        return false;
    }
    telemetry->rate_hz[sent] = hz;
    for (uint32_t i = 0u; i < COPTER_LINKS; i++) {
        copter_turns_repeat(&telemetry->link[i].turns, sent, copter_interval_us(hz));
    }
    return true;
}

copter_parameters_t copter_rates(copter_telemetry_t *telemetry)
{
    return (copter_parameters_t){
        .context = telemetry, .count = sizeof rate / sizeof rate[0], .get = get, .set = set};
}
