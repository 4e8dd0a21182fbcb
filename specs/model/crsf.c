/* SPDX-License-Identifier: Apache-2.0 */
#include "crsf.h"

#include "framing.h"

/* CRF-001, CRF-002 */
keel_status_t model_crsf_init(keel_crsf_t *crsf, const keel_crsf_config_t *config)
{
    const uint8_t headers[4] = {0xC8u, 0x00u, 0xECu, 0xEEu};
    keel_crsf_t fresh = {
        .config = *config, .channels_age_us = UINT32_MAX, .link_age_us = UINT32_MAX};

    if (config->gap_us == 0u) {
        return KEEL_ERR_AGE;
    }
    if (config->channels_us == 0u) {
        return KEEL_ERR_AGE;
    }
    model_framing_begin(&fresh.framing, config->gap_us, headers);
    *crsf = fresh;
    return KEEL_OK;
}

/* CRF-005: bit by bit; bit 0 is the lowest of the byte behind the type. */
uint16_t model_crsf_channel(const uint8_t *frame, uint32_t index)
{
    uint32_t value = 0u;

    for (uint32_t i = 0u; i < 11u; i++) {
        const uint32_t bit = (11u * index) + i;

        if ((((uint32_t)frame[3u + (bit / 8u)] >> (bit % 8u)) & 1u) != 0u) {
            value += (uint32_t)1u << i;
        }
    }
    return (uint16_t)value;
}

/* CRF-004: what CRSF calls the sync byte, of the devices between a pilot and the copter. */
static bool begins(uint8_t byte)
{
    bool is = false;

    switch (byte) {
    case 0xC8:
    case 0x00:
    case 0xEC:
    case 0xEE:
        is = true;
        break;
    default:
        break;
    }
    return is;
}

/* CRF-004 */
static bool crc_right(const uint8_t *frame)
{
    const uint32_t length = frame[1];

    return model_crsf_crc(&frame[2], length - 1u) == frame[length + 1u];
}

/* CRF-004 */
bool model_crsf_right(const uint8_t *frame)
{
    return begins(frame[0]) && (frame[1] >= 2u) && (frame[1] <= 62u) && crc_right(frame);
}

/* CRF-009 */
void model_crsf_pass_time(keel_crsf_t *crsf, uint32_t elapsed_us)
{
    crsf->channels_age_us = model_framing_sum(crsf->channels_age_us, elapsed_us);
    crsf->link_age_us = model_framing_sum(crsf->link_age_us, elapsed_us);
    model_framing_pass_time(&crsf->framing, elapsed_us);
}

/* CRF-005 */
static void channels_said(keel_crsf_t *crsf, const uint8_t *frame)
{
    for (uint32_t i = 0u; i < 16u; i++) {
        crsf->channel[i] = model_crsf_channel(frame, i);
    }
    crsf->channels_age_us = 0u;
    crsf->count.channels = model_framing_sum(crsf->count.channels, 1u);
}

/* CRF-006: the seventh byte is a number in two's complement. */
static void link_said(keel_crsf_t *crsf, const uint8_t *frame)
{
    int32_t snr = 0;

    for (uint32_t i = 0u; i < 7u; i++) {
        snr += (((frame[6] >> i) & 1u) != 0u) ? (int32_t)(1u << i) : 0;
    }
    snr -= (frame[6] >= 128u) ? 128 : 0;
    crsf->link.rssi[0] = frame[3];
    crsf->link.rssi[1] = frame[4];
    crsf->link.quality = frame[5];
    crsf->link.snr = (int8_t)snr;
    crsf->link.antenna = frame[7];
    crsf->link.mode = frame[8];
    crsf->link_age_us = 0u;
    crsf->count.links = model_framing_sum(crsf->count.links, 1u);
}

/* CRF-004, CRF-008: by type, when it is long enough; what is behind the fields is not read. */
static keel_crsf_taken_t said(keel_crsf_t *crsf)
{
    const uint8_t *const frame = crsf->framing.byte;

    if ((frame[1] >= 24u) && (frame[2] == 0x16u)) {
        channels_said(crsf, frame);
        return KEEL_CRSF_TOOK_CHANNELS;
    }
    if ((frame[1] >= 12u) && (frame[2] == 0x14u)) {
        link_said(crsf, frame);
        return KEEL_CRSF_TOOK_LINK;
    }
    if ((frame[2] == 0x16u) || (frame[2] == 0x14u)) {
        crsf->count.shorts = model_framing_sum(crsf->count.shorts, 1u);
        return KEEL_CRSF_TOOK_SHORT;
    }
    crsf->count.others = model_framing_sum(crsf->count.others, 1u);
    return KEEL_CRSF_TOOK_OTHER;
}

/* CRF-003 to CRF-011 */
keel_crsf_taken_t model_crsf_take(keel_crsf_t *crsf, uint8_t byte, uint32_t elapsed_us)
{
    keel_crsf_taken_t taken = KEEL_CRSF_NOTHING;
    uint32_t length;

    model_crsf_pass_time(crsf, elapsed_us);
    model_framing_take(&crsf->framing, byte, 0u); /* CRF-010 */
    if (crsf->framing.held < 2u) {
        return KEEL_CRSF_NOTHING;
    }
    length = crsf->framing.byte[1];
    if ((length < 2u) || (length > 62u)) { /* CRF-008, CRF-011 */
        crsf->count.lengths = model_framing_sum(crsf->count.lengths, 1u);
        model_framing_drop(&crsf->framing, 1u);
    } else if (crsf->framing.held < (length + 2u)) {
        /* CRF-010: what is behind it is still to come. */
    } else if (!crc_right(crsf->framing.byte)) { /* CRF-008, CRF-011 */
        crsf->count.crcs = model_framing_sum(crsf->count.crcs, 1u);
        model_framing_drop(&crsf->framing, 1u);
    } else { /* CRF-004 */
        taken = said(crsf);
        model_framing_drop(&crsf->framing, length + 2u);
    }
    return taken;
}

/* CRF-012 */
bool model_crsf_is_lost(const keel_crsf_t *crsf)
{
    bool lost = crsf->channels_age_us > crsf->config.channels_us;

    if (crsf->config.link_us != 0u) {
        lost = lost || (crsf->link.quality == 0u) || (crsf->link_age_us > crsf->config.link_us);
    }
    return lost;
}
