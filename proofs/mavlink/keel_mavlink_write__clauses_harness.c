// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 58
// sources: src/middleware/mavlink.c
// replaces: keel_crc16
// checks: assertions
// covers: keel_mavlink_write cut_of checksum_of
//
// Each clause of the contract, without the model: any sender and message, and any payload of up
// to 32 bytes. The checksum may come to any number, as no clause speaks of it. All other checks:
// keel_mavlink_write_harness.c.
#include "../common/crc_contracts.h"
#include "mavlink_contracts.h"

#define PAYLOAD 32u

keel_mavlink_packet_t nondet_packet(void);

uint16_t keel_crc16_stand_in(uint16_t crc, uint8_t byte)
{
    const uint16_t is = nondet_u16();

    __CPROVER_assert(keel_crc16_may(crc, byte), "precondition: keel_crc16");
    __CPROVER_assume(keel_crc16_does(is, is));
    return is;
}

/* All of a payload, drawn at once. */
typedef struct {
    uint8_t bytes[PAYLOAD];
} payload_t;

payload_t nondet_payload(void);

/* mavlink_cut, of one byte */
static bool cut_here(const uint8_t *payload, uint32_t length, uint32_t cut, uint32_t i)
{
    return (1u <= cut) && (cut <= length) && ((cut == 1u) || (payload[cut - 1u] != 0u)) &&
           ((i < cut) || (i >= length) || (payload[i] == 0u));
}

void keel_mavlink_write__clauses_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);
    const uint32_t i = any_below(PAYLOAD);
    const keel_mavlink_message_t message = nondet_message();
    const payload_t payload = nondet_payload();
    const uint8_t length = nondet_u8();
    keel_mavlink_sender_t sender = {nondet_u8(), nondet_u8(), nondet_u8(), nondet_bool()};
    const uint8_t sequence = sender.sequence;
    keel_mavlink_packet_t packet = nondet_packet();
    const keel_mavlink_packet_t before = packet;
    const uint8_t *const bytes = packet.bytes;
    uint32_t written;
    bool some;
    uint32_t cut;

    __CPROVER_assume(length <= PAYLOAD);

    written = keel_mavlink_write(&sender, &message, payload.bytes, length, &packet);
    some = written > 0u;
    cut = bytes[1];

    __CPROVER_assert(((length < 1u) || (length > message.longest) ||
                      (message.id > (uint32_t)KEEL_MAVLINK_ID_MAX)) == !some,
                     "MAV_011_refused: a length or an id that is not in its range is refused");
    __CPROVER_assert(some || (sender.sequence == sequence),
                     "MAV_011_kept: a refusal counts nothing");
    __CPROVER_assert((at < written) || (bytes[at] == before.bytes[at]),
                     "MAV_012_kept: bytes behind the frame stay");
    __CPROVER_assert(!some || ((bytes[0] == KEEL_MAVLINK_FIRST) && (bytes[3] == 0u) &&
                               (bytes[2] == (sender.is_signing ? 1u : 0u)) &&
                               (bytes[4] == sequence) && (bytes[5] == sender.system) &&
                               (bytes[6] == sender.component) && (id_of(bytes) == message.id)),
                     "MAV_012_header: it says what the frame is, and who sends it");
    __CPROVER_assert(!some || cut_here(payload.bytes, length, cut, i),
                     "MAV_012_length: zeros at the end are left out, but for the first byte");
    __CPROVER_assert(!some || (written == (12u + (sender.is_signing ? 13u : 0u) + cut)),
                     "MAV_012_length: all bytes of the frame are told");
    __CPROVER_assert(!some || (i >= cut) || (bytes[10u + i] == payload.bytes[i]),
                     "MAV_012_payload: all others are there as they were");
    __CPROVER_assert(!some || (sender.sequence == ((sequence + 1u) % 256u)),
                     "MAV_013_sequence: a frame that is written is counted");
}
