/* SPDX-License-Identifier: Apache-2.0 */
#include "sbus.h"

/* RAD-001, RAD-002 */
keel_status_t model_sbus_init(keel_sbus_t *sbus, const keel_sbus_config_t *config)
{
    const keel_sbus_t fresh = {.config = *config,
                               .frame = {.failsafe = true},
                               .age_us = UINT32_MAX,
                               .quiet_us = UINT32_MAX};

    if (config->highest > 2047u) {
        return KEEL_ERR_LIMITS;
    }
    if (config->highest < config->lowest) {
        return KEEL_ERR_LIMITS;
    }
    if (config->gap_us == 0u) {
        return KEEL_ERR_AGE;
    }
    *sbus = fresh;
    return KEEL_OK;
}

/* What is counted and timed stays at its end (RAD-007, RAD-008). */
static uint32_t sum_to_end(uint32_t a, uint32_t b)
{
    const uint64_t sum = (uint64_t)a + b;

    return (sum > UINT32_MAX) ? UINT32_MAX : (uint32_t)sum;
}

/* RAD-005: bit by bit; bit 0 is the lowest of the byte behind the header. */
uint16_t model_sbus_channel(const uint8_t *frame, uint32_t index)
{
    uint32_t value = 0u;

    for (uint32_t i = 0u; i < 11u; i++) {
        const uint32_t bit = (11u * index) + i;

        if ((((uint32_t)frame[1u + (bit / 8u)] >> (bit % 8u)) & 1u) != 0u) {
            value += (uint32_t)1u << i;
        }
    }
    return (uint16_t)value;
}

/* RAD-004: 0x00, and of SBUS2 four more. */
static bool footer_right(uint8_t footer)
{
    bool right = false;

    switch (footer) {
    case 0x00:
    case 0x04:
    case 0x14:
    case 0x24:
    case 0x34:
        right = true;
        break;
    default:
        break;
    }
    return right;
}

/* RAD-004: of those that are judged. */
static bool channels_right(const uint8_t *frame, const keel_sbus_config_t *config)
{
    uint32_t judged = config->judged;

    for (uint32_t i = 0u; i < 16u; i++) {
        const uint16_t value = model_sbus_channel(frame, i);

        if (((judged % 2u) == 1u) && ((value < config->lowest) || (value > config->highest))) {
            return false;
        }
        judged /= 2u;
    }
    return true;
}

/* RAD-004 */
bool model_sbus_right(const uint8_t *frame, const keel_sbus_config_t *config)
{
    return (frame[0] == 0x0Fu) && ((frame[23] & 0xF0u) == 0u) && footer_right(frame[24]) &&
           channels_right(frame, config);
}

/* RAD-005, RAD-007, RAD-010: the frame is handed out; nothing is left of it to be taken again. */
static void hand_out(keel_sbus_t *sbus)
{
    const uint8_t flags = sbus->buffer[23];

    for (uint32_t i = 0u; i < 16u; i++) {
        sbus->frame.channel[i] = model_sbus_channel(sbus->buffer, i);
    }
    sbus->frame.digital_17 = (flags % 2u) == 1u;
    sbus->frame.digital_18 = ((flags / 2u) % 2u) == 1u;
    sbus->frame.lost = ((flags / 4u) % 2u) == 1u;
    sbus->frame.failsafe = ((flags / 8u) % 2u) == 1u;
    sbus->count.frames = sum_to_end(sbus->count.frames, 1u);
    sbus->age_us = 0u;
    sbus->held = 0u;
}

/* RAD-007: the first reason that applies. */
static void refuse(keel_sbus_t *sbus)
{
    if (!footer_right(sbus->buffer[24])) {
        sbus->count.footers = sum_to_end(sbus->count.footers, 1u);
    } else if ((sbus->buffer[23] & 0xF0u) != 0u) {
        sbus->count.flags = sum_to_end(sbus->count.flags, 1u);
    } else {
        sbus->count.ranges = sum_to_end(sbus->count.ranges, 1u);
    }
}

/* RAD-011: what is left begins with the first header behind the one that was no frame's. */
static void go_on(keel_sbus_t *sbus)
{
    const keel_sbus_t old = *sbus;
    uint32_t header = 25u;

    for (uint32_t i = 24u; i > 0u; i--) {
        if (old.buffer[i] == 0x0Fu) {
            header = i;
        }
    }
    sbus->held = (uint8_t)(25u - header);
    for (uint32_t i = 0u; i < 25u; i++) {
        if (i < sbus->held) {
            sbus->buffer[i] = old.buffer[header + i];
        }
    }
}

/* RAD-008 */
void model_sbus_pass_time(keel_sbus_t *sbus, uint32_t elapsed_us)
{
    sbus->age_us = sum_to_end(sbus->age_us, elapsed_us);
    sbus->quiet_us = sum_to_end(sbus->quiet_us, elapsed_us);
}

bool model_sbus_take(keel_sbus_t *sbus, uint8_t byte, uint32_t elapsed_us)
{
    model_sbus_pass_time(sbus, elapsed_us);
    if (sbus->quiet_us > sbus->config.gap_us) { /* RAD-009 */
        if (sbus->held != 0u) {
            sbus->count.gaps = sum_to_end(sbus->count.gaps, 1u);
        }
        sbus->held = 0u;
    }
    sbus->quiet_us = 0u;
    if ((sbus->held == 0u) && (byte != 0x0Fu)) { /* RAD-010 */
        sbus->count.headers = sum_to_end(sbus->count.headers, 1u);
        return false;
    }
    sbus->buffer[sbus->held] = byte;
    sbus->held = (uint8_t)(sbus->held + 1u);
    if (sbus->held < 25u) {
        return false;
    }
    if (model_sbus_right(sbus->buffer, &sbus->config)) {
        hand_out(sbus);
        return true;
    }
    refuse(sbus);
    go_on(sbus);
    return false;
}

/* RAD-012: 0.625 us a step from 880 us on. */
uint16_t model_sbus_us(uint16_t raw)
{
    const uint32_t step = (raw > 2047u) ? 2047u : raw;

    return (uint16_t)(((625u * step) + 880500u) / 1000u);
}
