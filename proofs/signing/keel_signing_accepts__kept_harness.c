// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 307 --unwindset place_of_stream.0:9 --external-sat-solver cadical
// sources: src/middleware/signing.c
// covers: keel_signing_accepts count_signed byte_in place_of_stream is_fresh put_frame
// covers: is_sealed note_frame
//
// The clauses, without the model's decisions: with a key, what is accepted has a signature of all
// of its bytes, and is newer than its stream was; that is noted. What is refused moves nothing.
#include "signing_proof.h"

/* The byte at this place of what was sent: header, payload, checksum, link and timestamp. */
static uint8_t sent_byte(const keel_mavlink_frame_t *frame, uint32_t at)
{
    const uint8_t header[7] = {0xFDu,           frame->length, 0x01u,           frame->compatible,
                               frame->sequence, frame->system, frame->component};
    const uint32_t end = 10u + (uint32_t)frame->length;
    uint8_t byte;

    if (at < 7u) {
        byte = header[at];
    } else if (at < 10u) {
        byte = (uint8_t)((frame->id >> (8u * (at - 7u))) & 0xFFu);
    } else if (at < end) {
        byte = frame->payload[at - 10u];
    } else if (at < (end + 2u)) {
        byte = (uint8_t)((frame->checksum >> (8u * (at - end))) & 0xFFu);
    } else if (at == (end + 2u)) {
        byte = frame->link;
    } else {
        byte = (uint8_t)((frame->timestamp >> (8u * (at - (end + 3u)))) & 0xFFu);
    }
    return byte;
}

void keel_signing_accepts__kept_harness(void)
{
    keel_signing_t signing = any_valid_signing();
    const keel_signing_t before = signing;
    const keel_mavlink_frame_t frame = any_frame();
    const uint32_t i = nondet_u32();
    const uint32_t j = nondet_u32();
    bool noted = false;
    bool accepted;

    ask_for(&signing);
    accepted = keel_signing_accepts(&signing, &frame);

    __CPROVER_assume(j < KEEL_MAVLINK_SEAL_BYTES);
    __CPROVER_assert(signing_valid_here(&signing), "SGN_003_valid: it stays valid");
    __CPROVER_assert((i >= KEEL_SIGNING_KEY_BYTES) || (signing.text[i] == before.text[i]),
                     "SGN_002_stays: the key stays");
    if (!accepted || !before.has_key) {
        __CPROVER_assert(decisions_same(&signing, &before),
                         "SGN_009_kept: what is refused, or not checked, moves nothing");
    } else {
        const uint32_t size = 19u + (uint32_t)frame.length;

        __CPROVER_assert(frame.is_signed && (asked == 1u) && asked_own &&
                             (asked_size == (32u + size)),
                         "SGN_005_signed: what is accepted is signed");
        if (asked_at < 32u) {
            __CPROVER_assert(asked_byte == before.text[asked_at],
                             "SGN_008_key: the hash begins with the key");
        } else if (asked_at < (32u + size)) {
            __CPROVER_assert(asked_byte == sent_byte(&frame, asked_at - 32u),
                             "SGN_008_frame: and goes on with all that was sent");
        } else {
            /* There is no such byte. */
        }
        __CPROVER_assert(digest_of_all[j] == frame.seal[j], "SGN_008_seal: its seal is the hash's");
        __CPROVER_assert((i >= before.streams) || !is_stream_of(&before.stream[i], &frame) ||
                             (before.stream[i].timestamp < frame.timestamp),
                         "SGN_006_newer: it is newer than its stream was");
        for (uint32_t n = 0u; n < KEEL_SIGNING_STREAMS; n++) {
            noted = noted || ((n < signing.streams) && is_stream_of(&signing.stream[n], &frame) &&
                              (signing.stream[n].timestamp == frame.timestamp));
        }
        __CPROVER_assert(noted, "SGN_010_noted: and its stream's time is its own");
    }
}
