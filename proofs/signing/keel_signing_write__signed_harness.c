// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 307 --external-sat-solver cadical
// sources: src/middleware/signing.c
// covers: keel_signing_write sign_frame byte_in
//
// The clauses, without the model: what is signed is what keel_mavlink_write made, our link, a time
// that no frame before it had, and six bytes of the hash of the key and of all of that. Of the key
// nothing else gets out. Any frame of any length, and any hash.
#include "signing_write.h"

void keel_signing_write__signed_harness(void)
{
    keel_signing_t signing = any_valid_signing();
    const keel_signing_t before = signing;
    keel_mavlink_sender_t sender = any_sender();
    const keel_mavlink_message_t message = nondet_message();
    const uint8_t payload[1] = {nondet_u8()};
    const uint8_t length = nondet_u8();
    keel_mavlink_packet_t packet = nondet_packet();
    const keel_mavlink_packet_t packet_before = packet;
    const uint32_t i = nondet_u32();
    uint32_t at;
    uint16_t written;

    __CPROVER_assume(i < KEEL_MAVLINK_FRAME_MAX);
    begin_frame();
    told_message = &message;
    told_payload = payload;
    told_length = length;
    ask_for(&signing);

    written = keel_signing_write(&signing, &sender, &message, payload, length, &packet);

    at = ((written > 0u) && before.has_key) ? ((uint32_t)written - 13u) : 0u;
    __CPROVER_assert(signing_valid_here(&signing), "SGN_012_valid: it stays valid");
    __CPROVER_assert((i >= KEEL_SIGNING_KEY_BYTES) || (signing.text[i] == before.text[i]),
                     "SGN_002_stays: the key stays");
    if ((written == 0u) || !before.has_key) {
        __CPROVER_assert((asked == 0u) && decisions_same(&signing, &before),
                         "SGN_011_none: what is not signed moves nothing");
        __CPROVER_assert(packet.bytes[i] ==
                             ((i < written) ? told.bytes[i] : packet_before.bytes[i]),
                         "SGN_011_unsigned: and is what it was");
    } else {
        __CPROVER_assert((asked == 1u) && asked_own && (asked_size == (32u + at + 7u)),
                         "SGN_011_hash: of the key and the frame");
        if (asked_at < 32u) {
            __CPROVER_assert(asked_byte == before.text[asked_at], "SGN_011_key: first the key");
        } else if (asked_at < asked_size) {
            __CPROVER_assert(asked_byte == packet.bytes[asked_at - 32u],
                             "SGN_011_all: then all that goes out before the seal");
        } else {
            /* There is no such byte. */
        }
        if (i < at) {
            __CPROVER_assert(packet.bytes[i] == told.bytes[i], "SGN_011_frame: the frame");
        } else if (i == at) {
            __CPROVER_assert(packet.bytes[i] == before.link, "SGN_011_link: our link");
        } else if (i < (at + 7u)) {
            __CPROVER_assert(packet.bytes[i] ==
                                 (uint8_t)((signing.timestamp >> (8u * (i - (at + 1u)))) & 0xFFu),
                             "SGN_012_time: our time");
        } else if (i < written) {
            __CPROVER_assert(packet.bytes[i] == digest_of_all[i - (at + 7u)],
                             "SGN_011_seal: six bytes of the hash");
        } else {
            __CPROVER_assert(packet.bytes[i] == packet_before.bytes[i],
                             "SGN_011_behind: and nothing behind it");
        }
        __CPROVER_assert(signing.timestamp == (before.timestamp + 1u),
                         "SGN_012_next: a time of its own");
    }
}
