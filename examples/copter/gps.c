/* SPDX-License-Identifier: Apache-2.0 */
/* GPS: fixes, and how the aircraft accelerates, which tells gravity from thrust (attitude.h). */
#include "copter.h"

/* Two fixes farther apart than this say nothing of the acceleration now; nor does an old one. */
#define APART_MS 500u
#define APART_US 500000u

/* Millimetres and milliseconds in metres and seconds. */
#define MILLI 1.0e-3f

keel_status_t copter_gps_init(copter_gps_t *gps)
{
    return keel_ubx_init(&gps->receiver, &copter_settings.gps);
}

static copter_fix_t fix_of(const keel_ubx_t *receiver)
{
    const keel_ubx_fix_t *const fix = &receiver->fix;

    return (copter_fix_t){.tow_ms = fix->tow_ms,
                          .latitude = fix->latitude,
                          .longitude = fix->longitude,
                          .height = MILLI * (float)fix->height_mm,
                          .north = MILLI * (float)fix->north,
                          .east = MILLI * (float)fix->east,
                          .climb = -MILLI * (float)fix->down,
                          .accuracy = MILLI * (float)fix->accuracy_mm,
                          .height_accuracy = MILLI * (float)fix->height_accuracy,
                          .speed_accuracy = MILLI * (float)fix->speed_accuracy,
                          .is_valid = keel_ubx_judge(receiver) == KEEL_UBX_USABLE};
}

/* By the receiver's times: a run of this task may come late, a fix be lost on the way. */
static void derive_acceleration(copter_gps_t *self, const copter_fix_t *before)
{
    const uint32_t apart_ms = self->fix.tow_ms - before->tow_ms;

    self->is_accelerated = before->is_valid && self->fix.is_valid && (apart_ms > 0u) &&
                           (apart_ms <= APART_MS);
    if (self->is_accelerated) {
        const float time_s = MILLI * (float)apart_ms;

        self->acceleration = (keel_attitude_vector_t){(self->fix.north - before->north) / time_s,
                                                      (self->fix.east - before->east) / time_s,
                                                      0.0f};
    }
}

/* Whether it has been silent for too long, whatever its bytes say. */
static void watch_silence(copter_gps_t *self, uint64_t now_us)
{
    const uint32_t bytes = self->receiver.count.bytes;

    if ((bytes != self->bytes) || (self->byte_us == 0u)) {
        self->bytes = bytes;
        self->byte_us = now_us;
    }
    self->is_silent = (now_us - self->byte_us) > COPTER_GPS_SILENT_US;
}

void copter_gps(copter_gps_t *self, const copter_t *copter)
{
    const copter_port_t *const port = copter->port;
    const uint64_t now_us = copter->scheduler.clock.now_us;
    copter_byte_t byte;

    for (uint32_t i = 0u; (i < COPTER_BYTES) && port->read_byte(port->context, COPTER_GPS, &byte);
         i++) {
        copter_date_take(&self->date, byte.value);
        if (keel_ubx_take(&self->receiver, byte.value, byte.elapsed_us)) {
            const copter_fix_t before = self->fix;

            self->fix = fix_of(&self->receiver);
            derive_acceleration(self, &before);
            copter_date_read(&self->date, now_us);
            self->fixed_us = now_us;
            self->fixes++;
        }
    }
    if ((now_us - self->fixed_us) > APART_US) {
        self->is_accelerated = false;
    }
    watch_silence(self, now_us);
}
