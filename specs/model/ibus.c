/* SPDX-License-Identifier: Apache-2.0 */
#include "ibus.h"

#include "framing.h"

/* IBU-001, IBU-002 */
keel_status_t model_ibus_init(keel_ibus_t *ibus, const keel_ibus_config_t *config)
{
    const uint8_t headers[4] = {0x20u, 0x20u, 0x20u, 0x20u};
    keel_ibus_t fresh = {.config = *config, .age_us = UINT32_MAX};

    if (config->highest > 4095u) {
        return KEEL_ERR_LIMITS;
    }
    if (config->highest < config->lowest) {
        return KEEL_ERR_LIMITS;
    }
    if (config->gap_us == 0u) {
        return KEEL_ERR_AGE;
    }
    model_framing_begin(&fresh.framing, config->gap_us, headers);
    *ibus = fresh;
    return KEEL_OK;
}

/* IBU-005: the upper half of a channel's high byte. */
static uint32_t upper_bits(const uint8_t *frame, uint32_t index)
{
    return (uint32_t)frame[3u + (2u * index)] >> 4;
}

/* IBU-005 */
uint16_t model_ibus_channel(const uint8_t *frame, uint32_t index, bool extended)
{
    uint32_t value = 0u;

    if (index < 14u) {
        const uint32_t high = frame[3u + (2u * index)];

        value = frame[2u + (2u * index)] | ((extended ? (high & 0x0Fu) : high) << 8);
    } else if (extended) {
        const uint32_t first = 3u * (index - 14u);

        value = upper_bits(frame, first) | (upper_bits(frame, first + 1u) << 4) |
                (upper_bits(frame, first + 2u) << 8);
    }
    return (uint16_t)value;
}

/* IBU-004: the last two bytes are what is left of 0xFFFF when the others are taken off. */
static bool sum_right(const uint8_t *frame)
{
    uint32_t sum = 0u;

    for (uint32_t i = 0u; i < 30u; i++) {
        sum += frame[i];
    }
    return (0xFFFFu - sum) == (frame[30] + (256u * frame[31]));
}

/* IBU-004: of those that are there and judged. */
static bool range_right(const uint8_t *frame, const keel_ibus_config_t *config)
{
    uint32_t judged = config->judged;

    for (uint32_t i = 0u; i < 18u; i++) {
        const uint16_t value = model_ibus_channel(frame, i, config->extended);

        if (((judged % 2u) == 1u) && ((i < 14u) || config->extended) &&
            ((value < config->lowest) || (value > config->highest))) {
            return false;
        }
        judged /= 2u;
    }
    return true;
}

/* IBU-004 */
bool model_ibus_right(const uint8_t *frame, const keel_ibus_config_t *config)
{
    return (frame[0] == 0x20u) && (frame[1] == 0x40u) && sum_right(frame) &&
           range_right(frame, config);
}

/* IBU-008 */
void model_ibus_pass_time(keel_ibus_t *ibus, uint32_t elapsed_us)
{
    ibus->age_us = model_framing_sum(ibus->age_us, elapsed_us);
    model_framing_pass_time(&ibus->framing, elapsed_us);
}

/* IBU-005, IBU-007 */
static void words_said(keel_ibus_t *ibus)
{
    for (uint32_t i = 0u; i < 18u; i++) {
        ibus->channel[i] = model_ibus_channel(ibus->framing.byte, i, ibus->config.extended);
    }
    ibus->age_us = 0u;
    ibus->count.frames = model_framing_sum(ibus->count.frames, 1u);
}

/* IBU-007: the first reason that applies. */
static void reason_counted(keel_ibus_t *ibus)
{
    if (!sum_right(ibus->framing.byte)) {
        ibus->count.sums = model_framing_sum(ibus->count.sums, 1u);
    } else {
        ibus->count.ranges = model_framing_sum(ibus->count.ranges, 1u);
    }
}

/* IBU-003 to IBU-010 */
bool model_ibus_take(keel_ibus_t *ibus, uint8_t byte, uint32_t elapsed_us)
{
    model_ibus_pass_time(ibus, elapsed_us);
    model_framing_take(&ibus->framing, byte, 0u); /* IBU-009 */
    if (ibus->framing.held < 2u) {
        return false;
    }
    if (ibus->framing.byte[1] != 0x40u) { /* IBU-007, IBU-010 */
        ibus->count.headers = model_framing_sum(ibus->count.headers, 1u);
        model_framing_drop(&ibus->framing, 1u);
        return false;
    }
    if (ibus->framing.held < 32u) {
        return false;
    }
    if (sum_right(ibus->framing.byte) &&
        range_right(ibus->framing.byte, &ibus->config)) { /* IBU-004 */
        words_said(ibus);
        model_framing_drop(&ibus->framing, 32u);
        return true;
    }
    reason_counted(ibus);
    model_framing_drop(&ibus->framing, 1u); /* IBU-010 */
    return false;
}
