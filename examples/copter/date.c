/* SPDX-License-Identifier: Apache-2.0 */
/* The date, by the satellite receiver: NAV-PVT says it beside the place.
 *
 * The decoder hands out what it is proved for, and the date is not among that. But a right NAV-PVT
 * is taken with its last byte: so then the last KEEL_UBX_BYTES bytes of the receiver are it. */
#include "copter.h"

/* Where a NAV-PVT has what, from its first byte on. */
#define AT_YEAR   10u
#define AT_MONTH  12u
#define AT_DAY    13u
#define AT_HOUR   14u
#define AT_MINUTE 15u
#define AT_SECOND 16u
#define AT_VALID  17u
#define AT_NANO   22u

/* Flags: date and time are valid, and the second is no guess. */
#define IS_VALID 0x07u

#define BYTE_BITS   8u
#define EPOCH       1970u
#define LEAST       2017u /* Nobody spoke MAVLink 2 before. */
#define MOST        2099u
#define YEAR_DAYS   365u
#define DAY_S       86400u
#define HOUR_S      3600u
#define MINUTE_S    60u
#define MONTHS      12u
#define MONTH_DAYS  31u
#define HOURS       24u
#define MINUTES     60u
#define LEAP_SECOND 60u
#define MILLION     1000000u
#define SECOND_NS   1000000000
#define US_NS       1000

void copter_date_take(copter_date_t *date, uint8_t byte)
{
    date->bytes[date->next] = byte;
    date->next = (date->next + 1u) % (uint32_t)KEEL_UBX_BYTES;
}

/* The bytes of a message that has just come, the next place being its first byte's. */
static uint32_t byte_of(const copter_date_t *date, uint32_t at)
{
    return date->bytes[(date->next + at) % (uint32_t)KEEL_UBX_BYTES];
}

static bool is_leap(uint32_t year)
{
    return (year % 4u) == 0u; /* From LEAST to MOST, and 2000 was one, too. */
}

/* Since 1970 began. */
static uint32_t days_to(uint32_t year, uint32_t month, uint32_t day)
{
    static const uint16_t before[MONTHS] = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
    const uint32_t leaps = ((year - 1u) / 4u) - ((EPOCH - 1u) / 4u);

    return (YEAR_DAYS * (year - EPOCH)) + leaps + before[month - 1u] +
           ((is_leap(year) && (month > 2u)) ? 1u : 0u) + (day - 1u);
}

/* Nanoseconds, of either sign, as microseconds that are added to a second: up to one either way. */
static int32_t fraction_us(const copter_date_t *date)
{
    uint32_t word = 0u;
    int64_t nano;

    for (uint32_t i = 4u; i > 0u; i--) {
        word = (word << BYTE_BITS) | byte_of(date, AT_NANO + i - 1u);
    }
    nano = (word <= (uint32_t)INT32_MAX) ? (int64_t)word
                                         : ((int64_t)word - ((int64_t)UINT32_MAX + 1));
    return ((nano >= -SECOND_NS) && (nano <= SECOND_NS)) ? (int32_t)(nano / US_NS) : 0;
}

void copter_date_read(copter_date_t *date, uint64_t now_us)
{
    const uint32_t year = byte_of(date, AT_YEAR) | (byte_of(date, AT_YEAR + 1u) << BYTE_BITS);
    const uint32_t month = byte_of(date, AT_MONTH);
    const uint32_t day = byte_of(date, AT_DAY);
    const uint32_t hour = byte_of(date, AT_HOUR);
    const uint32_t minute = byte_of(date, AT_MINUTE);
    const uint32_t second = byte_of(date, AT_SECOND);
    const bool is_date = (year >= LEAST) && (year <= MOST) && (month >= 1u) && (month <= MONTHS) &&
                         (day >= 1u) && (day <= MONTH_DAYS);
    const bool is_time = (hour < HOURS) && (minute < MINUTES) && (second <= LEAP_SECOND);

    if (((byte_of(date, AT_VALID) & IS_VALID) == IS_VALID) && is_date && is_time) {
        const uint64_t whole_s = ((uint64_t)days_to(year, month, day) * DAY_S) + (hour * HOUR_S) +
                                 (minute * MINUTE_S) + second;

        date->utc_us = (uint64_t)((int64_t)(whole_s * MILLION) + fraction_us(date));
        date->read_us = now_us;
    }
}

uint64_t copter_utc_us(const copter_date_t *date, uint64_t now_us)
{
    return (date->utc_us == 0u) ? 0u : (date->utc_us + (now_us - date->read_us));
}
