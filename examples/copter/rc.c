/* SPDX-License-Identifier: Apache-2.0 */
/* The pilot's receiver: which protocol it speaks, and what its frames say in microseconds. */
#include "rc.h"

/* So many frames are enough to know a protocol by. */
static const uint8_t enough[COPTER_PROTOCOLS] = {[COPTER_PROTOCOL_SBUS] = 20u,
                                                 [COPTER_PROTOCOL_CRSF] = 5u,
                                                 [COPTER_PROTOCOL_IBUS] = 5u,
                                                 [COPTER_PROTOCOL_PPM] = 5u};

static keel_status_t first_of(keel_status_t a, keel_status_t b)
{
    return (a != KEEL_OK) ? a : b;
}

keel_status_t copter_rc_init(copter_rc_t *self, const copter_rc_config_t *config)
{
    keel_status_t status;

    *self = (copter_rc_t){.protocol = config->protocol};
    status = keel_sbus_init(&self->sbus, &config->sbus);
    status = first_of(status, keel_crsf_init(&self->crsf, &config->crsf));
    status = first_of(status, keel_ibus_init(&self->ibus, &config->ibus));
    return first_of(status, keel_ppm_init(&self->ppm, &config->ppm));
}

static bool take_by(copter_rc_t *self, uint8_t protocol, const copter_byte_t *byte)
{
    bool taken = false;

    switch (protocol) {
    case COPTER_PROTOCOL_SBUS:
        taken = keel_sbus_take(&self->sbus, byte->value, byte->elapsed_us);
        break;
    case COPTER_PROTOCOL_CRSF:
        taken = keel_crsf_take(&self->crsf, byte->value, byte->elapsed_us) ==
                KEEL_CRSF_TOOK_CHANNELS;
        break;
    case COPTER_PROTOCOL_IBUS:
        taken = keel_ibus_take(&self->ibus, byte->value, byte->elapsed_us);
        break;
    default:
        taken = keel_ppm_take(&self->ppm, byte->elapsed_us);
        break;
    }
    return taken;
}

/* One more frame of a protocol, while none is known. A frame with a checksum is no other by
 * chance. */
static void hear_protocol(copter_rc_t *self, uint8_t protocol)
{
    const uint8_t row = (uint8_t)(self->row[protocol] + 1u);
    const bool is_checked = (protocol == COPTER_PROTOCOL_CRSF) ||
                            (protocol == COPTER_PROTOCOL_IBUS);

    for (uint8_t i = 0u; is_checked && (i < COPTER_PROTOCOLS); i++) {
        self->row[i] = 0u;
    }
    self->row[protocol] = row;
    if (row == enough[protocol]) {
        self->protocol = protocol;
    }
}

/* CRSF's channels are scaled as SBUS's. */
static uint16_t channel_us(const copter_rc_t *self, uint32_t index)
{
    uint16_t us = 0u;

    switch (self->protocol) {
    case COPTER_PROTOCOL_SBUS:
        us = keel_sbus_us(self->sbus.frame.channel[index]);
        break;
    case COPTER_PROTOCOL_CRSF:
        us = keel_sbus_us(self->crsf.channel[index]);
        break;
    case COPTER_PROTOCOL_IBUS:
        us = self->ibus.channel[index];
        break;
    default:
        us = self->ppm.channel[index];
        break;
    }
    return us;
}

static void publish_channels(copter_rc_t *self)
{
    const keel_sbus_frame_t *const sbus = &self->sbus.frame;
    const keel_crsf_t *const crsf = &self->crsf;

    for (uint32_t i = 0u; i < COPTER_CHANNELS; i++) {
        self->channel[i] = channel_us(self, i);
    }
    self->is_lost = ((self->protocol == COPTER_PROTOCOL_SBUS) && (sbus->failsafe || sbus->lost)) ||
                    ((self->protocol == COPTER_PROTOCOL_CRSF) && (crsf->count.links > 0u) &&
                     (crsf->link.quality == 0u));
    self->frames++;
}

void copter_rc_count(const copter_rc_t *self, uint32_t refused[COPTER_REFUSALS])
{
    const keel_sbus_count_t *const sbus = &self->sbus.count;
    const keel_crsf_t *const crsf = &self->crsf;
    const keel_ibus_t *const ibus = &self->ibus;
    const keel_ppm_count_t *const ppm = &self->ppm.count;

    refused[COPTER_REFUSED_STICK] = sbus->ranges + ibus->count.ranges + ppm->pulses;
    refused[COPTER_REFUSED_FLAGS] = sbus->flags;
    refused[COPTER_REFUSED_CHECK] = sbus->footers + crsf->count.crcs + ibus->count.sums +
                                    ppm->numbers;
    refused[COPTER_REFUSED_BYTES] = sbus->headers + sbus->gaps + crsf->count.lengths +
                                    crsf->count.shorts + crsf->framing.strays + crsf->framing.gaps +
                                    ibus->count.headers + ibus->framing.strays +
                                    ibus->framing.gaps + ppm->gaps;
}

/* All decoders take a byte, until one of them is known. */
static bool feed_decoder(copter_rc_t *self, const copter_byte_t *byte)
{
    bool taken = false;

    for (uint8_t i = COPTER_PROTOCOL_SBUS; (i < COPTER_PROTOCOLS) && !taken; i++) {
        if (take_by(self, i, byte)) {
            hear_protocol(self, i);
            taken = self->protocol == i;
        }
    }
    return taken;
}

bool copter_rc_take(copter_rc_t *self, const copter_byte_t *byte)
{
    const bool taken = (self->protocol == COPTER_PROTOCOL_ANY)
                           ? feed_decoder(self, byte)
                           : take_by(self, self->protocol, byte);

    if (taken) {
        publish_channels(self);
    }
    return taken;
}

const char *copter_rc_words(copter_heard_t heard, uint8_t protocol)
{
    static const char *const name[COPTER_PROTOCOLS] = {
        "listening", "heard by SBUS", "heard by CRSF", "heard by IBUS", "heard by PPM"};
    static const char *const words[] = {
        [COPTER_HEARD_YET] = "listening",
        [COPTER_HEARD_LOST] = "the receiver has lost the transmitter",
        [COPTER_HEARD_NO_STICK] = "refused: a stick is beyond its range",
        [COPTER_HEARD_FLAGS] = "refused: flags that SBUS has none of",
        [COPTER_HEARD_NOISE] = "no frames: protocol, baud or inversion?",
        [COPTER_HEARD_NOTHING] = "nothing comes from the receiver"};

    return (heard == COPTER_HEARD_PILOT) ? name[protocol] : words[heard];
}
