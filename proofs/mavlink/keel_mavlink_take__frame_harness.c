// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 256 --external-sat-solver cadical
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c specs/model/crc.c
// covers: keel_mavlink_take put_byte end_frame publish_frame
//
// Any frame of a message that is known, of a length that it may have: with nothing held its first
// byte is held, and when all that is held are its first bytes, one more of them is, where it
// belongs. Beside them the checksum of those bytes is kept, and from the header on the place of its
// message. Its last byte takes it when its checksum is right, and only then. So by induction over
// its bytes a right frame that begins when nothing is held is taken by its last byte.
//
// The frame is what a decoder has that holds all of it: of its bytes those that are held are what
// they are there, and the others any.
#include "mavlink_proof.h"

/* The byte of the frame at this place. */
static uint8_t byte_at(const keel_mavlink_t *frame, uint32_t at)
{
    const uint32_t end = 10u + (uint32_t)frame->header[1];
    uint8_t byte = 0u;

    if (at < 10u) {
        byte = frame->header[at];
    } else if (at < end) {
        byte = frame->payload[at - 10u];
    } else if ((at - end) < KEEL_MAVLINK_TAIL_MAX) {
        byte = frame->tail[at - end];
    } else {
        /* No frame has so many. */
    }
    return byte;
}

void keel_mavlink_take__frame_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_PAYLOAD_MAX);
    keel_mavlink_t mavlink = any_valid_mavlink();
    const keel_mavlink_t before = mavlink;
    const uint32_t count = before.held;
    const uint32_t end = 10u + (uint32_t)before.header[1];
    const uint32_t place = nondet_u32();
    const uint32_t i = nondet_u32();
    uint32_t whole;
    bool right;

    __CPROVER_assume(place < MESSAGES);
    __CPROVER_assume((before.header[0] == 0xFDu) && (before.header[2] <= 1u) &&
                     is_of(before.header, &table[place]));
    whole = model_mavlink_whole(before.header);
    __CPROVER_assume((count < whole) && ((count < 10u) || (before.message == place)));

    right = keel_mavlink_take(&mavlink, byte_at(&before, count));

    __CPROVER_assert(byte_at(&mavlink, i) == byte_at(&before, i),
                     "MAV_008_bytes: its bytes are where they belong");
    if (count == 0u) {
        __CPROVER_assert(mavlink.crc == 0xFFFFu, "MAV_008_begin: its checksum begins");
    } else if (count < end) {
        __CPROVER_assert(mavlink.crc == keel_crc16(before.crc, byte_at(&before, count)),
                         "MAV_008_crc: its checksum takes the byte in");
    } else {
        __CPROVER_assert(mavlink.crc == before.crc, "MAV_008_stays: its checksum is whole");
    }
    if ((count + 1u) < whole) {
        __CPROVER_assert(!right && (mavlink.held == (count + 1u)),
                         "MAV_008_step: one more byte of it is held");
        __CPROVER_assert(((count + 1u) < 10u) || (mavlink.message == place),
                         "MAV_008_place: and its message is known");
    } else {
        const bool is_right = (before.tail[0] + (256u * before.tail[1])) ==
                              keel_crc16(before.crc, table[place].crc_extra);
        const keel_mavlink_frame_t says = model_mavlink_frame(&before);

        __CPROVER_assert(right == is_right, "MAV_004_taken: it is taken when it is right");
        __CPROVER_assert(!right || mavlink_frame_same(&mavlink.frame, &says, at),
                         "MAV_005_says: and this is what it says");
        __CPROVER_assert(mavlink.held == 0u, "MAV_008_nothing: nothing of it is held");
    }
}
