/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/middleware/mavlink.h"

/* Where it is in a header. */
#define LENGTH_AT     1u
#define FLAGS_AT      2u
#define COMPATIBLE_AT 3u
#define SEQUENCE_AT   4u
#define SYSTEM_AT     5u
#define COMPONENT_AT  6u
#define ID_AT         7u

/* Where the payload is in a frame. */
#define PAYLOAD_AT ((uint32_t)KEEL_MAVLINK_HEADER_BYTES)

/* Where it is in a tail, behind the checksum. */
#define LINK_AT      2u
#define TIMESTAMP_AT 3u
#define SEAL_AT      9u

/* The one flag of those that a decoder has to know. */
#define FLAG_SIGNED 1u

#define BYTE 0xFFu
#define BITS 8u

/* What a byte of a number counts, the lowest first. */
#define SECOND 0x100u
#define THIRD  0x10000u
#define FOURTH 0x1000000u
#define FIFTH  0x100000000u

/*@ requires \valid(count);
  @ assigns *count;
  @ ensures *count == mavlink_sum(\old(*count));
  @*/
static void count_met(uint32_t *count)
{
    *count += (*count < UINT32_MAX) ? 1u : 0u;
}

/* With a header: its message. */
/*@ requires \valid_read(mavlink);
  @ assigns \nothing;
  @ ensures \result == mavlink_id(&mavlink->header[0]);
  @*/
static uint32_t id_in(const keel_mavlink_t *mavlink)
{
    return mavlink->header[ID_AT] + (256u * mavlink->header[ID_AT + 1u]) +
           (65536u * mavlink->header[ID_AT + 2u]);
}

/* With a checksum: that. */
/*@ requires \valid_read(mavlink);
  @ assigns \nothing;
  @*/
static uint16_t checksum_in(const keel_mavlink_t *mavlink)
{
    return (uint16_t)(mavlink->tail[0] + (256u * mavlink->tail[1]));
}

/* With a length: where its checksum is. */
/*@ requires \valid_read(mavlink);
  @ assigns \nothing;
  @ ensures \result == mavlink_end(&mavlink->header[0]);
  @*/
static uint32_t end_of(const keel_mavlink_t *mavlink)
{
    return PAYLOAD_AT + (uint32_t)mavlink->header[LENGTH_AT];
}

/* With flags: how many bytes it has. */
/*@ requires \valid_read(mavlink);
  @ assigns \nothing;
  @ ensures \result == mavlink_whole(&mavlink->header[0]);
  @*/
static uint32_t whole_frame(const keel_mavlink_t *mavlink)
{
    const uint32_t signature = (mavlink->header[FLAGS_AT] != 0u)
                                   ? (uint32_t)KEEL_MAVLINK_SIGNATURE_BYTES
                                   : 0u;

    return end_of(mavlink) + (uint32_t)KEEL_MAVLINK_CHECKSUM_BYTES + signature;
}

/* The message's place; the number of messages when there is none. */
/*@ requires mavlink_apart(mavlink);
  @ assigns \nothing;
  @ ensures \result <= mavlink->known;
  @ ensures \result < mavlink->known ==> mavlink->messages[\result].id == id;
  @ ensures \forall integer i; 0 <= i < \result ==> mavlink->messages[i].id != id;
  @*/
static uint32_t place_of(const keel_mavlink_t *mavlink, uint32_t id)
{
    uint32_t place = 0u;

    /*@ loop invariant 0 <= place <= mavlink->known;
      @ loop invariant \forall integer i; 0 <= i < place ==> mavlink->messages[i].id != id;
      @ loop assigns place;
      @ loop variant mavlink->known - place;
      @*/
    while ((place < mavlink->known) && (mavlink->messages[place].id != id)) {
        place++;
    }
    return place;
}

/* Puts a byte where it belongs. Whether the checksum is of it, too. */
/*@ requires \valid(mavlink) && mavlink->held < KEEL_MAVLINK_FRAME_MAX;
  @ requires mavlink->held > 2 ==> mavlink->header[2] <= 1 &&
  @     mavlink->held < mavlink_whole(&mavlink->header[0]);
  @ assigns mavlink->header[0 .. KEEL_MAVLINK_HEADER_BYTES - 1],
  @     mavlink->payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1],
  @     mavlink->tail[0 .. KEEL_MAVLINK_TAIL_MAX - 1];
  @ ensures \result <==> \old(mavlink->held < mavlink_end(&mavlink->header[0]));
  @ ensures \forall integer i; 0 <= i < KEEL_MAVLINK_HEADER_BYTES ==> mavlink->header[i] ==
  @     (i == mavlink->held ? byte : \old(mavlink->header[i]));
  @ ensures \forall integer i; 0 <= i < \old(mavlink->header[1]) ==> mavlink->payload[i] ==
  @     (KEEL_MAVLINK_HEADER_BYTES + i == mavlink->held ? byte : \old(mavlink->payload[i]));
  @*/
static bool put_byte(keel_mavlink_t *mavlink, uint8_t byte)
{
    const uint32_t at = mavlink->held;
    const uint32_t end = end_of(mavlink);

    if (at < PAYLOAD_AT) {
        mavlink->header[at] = byte;
    } else if (at < end) {
        mavlink->payload[at - PAYLOAD_AT] = byte;
    } else {
        mavlink->tail[at - end] = byte;
    }
    return at < end;
}

/* Takes a byte into a partial frame, or begins one with it. */
/*@ requires \valid(mavlink) && mavlink->held < KEEL_MAVLINK_FRAME_MAX;
  @ requires mavlink->held > 2 ==> mavlink->header[2] <= 1 &&
  @     mavlink->held < mavlink_whole(&mavlink->header[0]);
  @ assigns mavlink->header[0 .. KEEL_MAVLINK_HEADER_BYTES - 1],
  @     mavlink->payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1],
  @     mavlink->tail[0 .. KEEL_MAVLINK_TAIL_MAX - 1], mavlink->held, mavlink->crc,
  @     mavlink->count.others;
  @ ensures \old(mavlink->held) == 0 && byte != KEEL_MAVLINK_FIRST ==> mavlink->held == 0 &&
  @     mavlink->crc == \old(mavlink->crc);
  @ ensures \old(mavlink->held) > 0 || byte == KEEL_MAVLINK_FIRST ==>
  @     mavlink->held == \old(mavlink->held) + 1;
  @ ensures \old(mavlink->held) > 0 || byte == KEEL_MAVLINK_FIRST ==>
  @     \forall integer i; 0 <= i < KEEL_MAVLINK_HEADER_BYTES ==> mavlink->header[i] ==
  @         (i == \old(mavlink->held) ? byte : \old(mavlink->header[i]));
  @ ensures \old(mavlink->held) > 0 ==>
  @     \forall integer i; 0 <= i < \old(mavlink->header[1]) ==> mavlink->payload[i] ==
  @         (KEEL_MAVLINK_HEADER_BYTES + i == \old(mavlink->held) ? byte :
  @             \old(mavlink->payload[i]));
  @ ensures \old(mavlink->held) == 0 && byte == KEEL_MAVLINK_FIRST ==>
  @     mavlink->crc == KEEL_CRC16_FIRST;
  @*/
static void offer(keel_mavlink_t *mavlink, uint8_t byte)
{
    if (mavlink->held > 0u) {
        if (put_byte(mavlink, byte)) {
            mavlink->crc = keel_crc16(mavlink->crc, byte);
        }
        mavlink->held++;
    } else if (byte == (uint8_t)KEEL_MAVLINK_FIRST) {
        (void)put_byte(mavlink, byte);
        mavlink->crc = KEEL_CRC16_FIRST;
        mavlink->held = 1u;
    } else {
        count_met(&mavlink->count.others);
    }
}

/* With three bytes. When they begin no frame, one may begin at the second or the third. */
/*@ requires \valid(mavlink) && mavlink->held == 3 && mavlink->header[0] == KEEL_MAVLINK_FIRST;
  @ assigns mavlink->header[0 .. KEEL_MAVLINK_HEADER_BYTES - 1],
  @     mavlink->payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1],
  @     mavlink->tail[0 .. KEEL_MAVLINK_TAIL_MAX - 1], mavlink->held, mavlink->crc,
  @     mavlink->count.others, mavlink->count.flags;
  @ ensures \old(mavlink->header[2]) <= 1 ==> mavlink->held == 3 &&
  @     mavlink->crc == \old(mavlink->crc) &&
  @     (\forall integer i; 0 <= i < KEEL_MAVLINK_HEADER_BYTES ==>
  @         mavlink->header[i] == \old(mavlink->header[i])) &&
  @     (\forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==>
  @         mavlink->payload[i] == \old(mavlink->payload[i]));
  @ ensures \old(mavlink->header[2]) > 1 ==> mavlink->held <= 2;
  @ ensures mavlink->held > 0 ==> mavlink->header[0] == KEEL_MAVLINK_FIRST;
  @*/
static void check_flags(keel_mavlink_t *mavlink)
{
    const uint8_t second = mavlink->header[LENGTH_AT];
    const uint8_t third = mavlink->header[FLAGS_AT];

    if (third > FLAG_SIGNED) {
        count_met(&mavlink->count.flags);
        mavlink->held = 0u;
        offer(mavlink, second);
        offer(mavlink, third);
    }
}

/* With a header. */
/*@ requires mavlink_apart(mavlink);
  @ assigns mavlink->message, mavlink->count.unknown, mavlink->count.lengths;
  @ ensures mavlink->message <= mavlink->known;
  @ ensures mavlink->message < mavlink->known ==>
  @     mavlink_is_of(&mavlink->header[0], mavlink->messages + mavlink->message);
  @*/
static void check_message(keel_mavlink_t *mavlink)
{
    const uint8_t length = mavlink->header[LENGTH_AT];

    mavlink->message = place_of(mavlink, id_in(mavlink));
    if (mavlink->message == mavlink->known) {
        count_met(&mavlink->count.unknown);
    } else if ((length < mavlink->messages[mavlink->message].shortest) ||
               (length > mavlink->messages[mavlink->message].longest)) {
        count_met(&mavlink->count.lengths);
        mavlink->message = mavlink->known;
    } else {
        /* It is one that may be taken. */
    }
}

/* With a signature: its time. */
/*@ requires \valid_read(mavlink);
  @ assigns \nothing;
  @*/
static uint64_t timestamp_in(const keel_mavlink_t *mavlink)
{
    const uint8_t *const byte = &mavlink->tail[TIMESTAMP_AT];
    const uint32_t low = (uint32_t)byte[0] + ((uint32_t)byte[1] * SECOND) +
                         ((uint32_t)byte[2] * THIRD) + ((uint32_t)byte[3] * FOURTH);
    const uint32_t high = (uint32_t)byte[4] + ((uint32_t)byte[5] * SECOND);

    return ((uint64_t)high * FIFTH) + low;
}

/*@ requires \valid(mavlink);
  @ assigns mavlink->frame.payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1];
  @ ensures \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> mavlink->frame.payload[i] ==
  @     \old(i < mavlink->header[1] ? mavlink->payload[i] : 0);
  @*/
static void publish_payload(keel_mavlink_t *mavlink)
{
    const uint8_t length = mavlink->header[LENGTH_AT];

    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_PAYLOAD_MAX;
      @ loop invariant \forall integer j; 0 <= j < i ==> mavlink->frame.payload[j] ==
      @     \at(j < mavlink->header[1] ? mavlink->payload[j] : 0, Pre);
      @ loop assigns i, mavlink->frame.payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1];
      @ loop variant KEEL_MAVLINK_PAYLOAD_MAX - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_PAYLOAD_MAX; i++) {
        mavlink->frame.payload[i] = (i < length) ? mavlink->payload[i] : 0u;
    }
}

/*@ requires \valid(mavlink);
  @ assigns mavlink->frame.is_signed, mavlink->frame.link, mavlink->frame.timestamp,
  @     mavlink->frame.seal[0 .. KEEL_MAVLINK_SEAL_BYTES - 1];
  @ ensures mavlink->frame.is_signed <==> \old(mavlink->header[2]) != 0;
  @*/
static void publish_signature(keel_mavlink_t *mavlink)
{
    const bool is_signed = mavlink->header[FLAGS_AT] != 0u;

    mavlink->frame.is_signed = is_signed;
    mavlink->frame.link = is_signed ? mavlink->tail[LINK_AT] : 0u;
    mavlink->frame.timestamp = is_signed ? timestamp_in(mavlink) : 0u;
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_SEAL_BYTES;
      @ loop assigns i, mavlink->frame.seal[0 .. KEEL_MAVLINK_SEAL_BYTES - 1];
      @ loop variant KEEL_MAVLINK_SEAL_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_SEAL_BYTES; i++) {
        mavlink->frame.seal[i] = is_signed ? mavlink->tail[SEAL_AT + i] : 0u;
    }
}

/*@ requires \valid(mavlink);
  @ assigns mavlink->frame;
  @ ensures mavlink->frame.length == \old(mavlink->header[1]) &&
  @     (mavlink->frame.is_signed <==> \old(mavlink->header[2]) != 0) &&
  @     mavlink->frame.compatible == \old(mavlink->header[3]) &&
  @     mavlink->frame.sequence == \old(mavlink->header[4]) &&
  @     mavlink->frame.system == \old(mavlink->header[5]) &&
  @     mavlink->frame.component == \old(mavlink->header[6]) &&
  @     mavlink->frame.id == \old(mavlink_id(&mavlink->header[0]));
  @ ensures \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> mavlink->frame.payload[i] ==
  @     \old(i < mavlink->header[1] ? mavlink->payload[i] : 0);
  @*/
static void publish_frame(keel_mavlink_t *mavlink)
{
    mavlink->frame.id = id_in(mavlink);
    mavlink->frame.sequence = mavlink->header[SEQUENCE_AT];
    mavlink->frame.system = mavlink->header[SYSTEM_AT];
    mavlink->frame.component = mavlink->header[COMPONENT_AT];
    mavlink->frame.compatible = mavlink->header[COMPATIBLE_AT];
    mavlink->frame.length = mavlink->header[LENGTH_AT];
    publish_signature(mavlink);
    publish_payload(mavlink);
}

/* With all of its bytes: takes the frame, or counts why not. */
/*@ requires mavlink_apart(mavlink) && mavlink->message <= mavlink->known;
  @ requires mavlink->header[2] <= 1;
  @ assigns mavlink->frame, mavlink->count.frames, mavlink->count.checksums;
  @ ensures \result ==> \old(mavlink->message < mavlink->known);
  @ ensures \result ==> mavlink->frame.length == \old(mavlink->header[1]) &&
  @     mavlink->frame.is_signed == \old(mavlink->header[2]) &&
  @     mavlink->frame.compatible == \old(mavlink->header[3]) &&
  @     mavlink->frame.sequence == \old(mavlink->header[4]) &&
  @     mavlink->frame.system == \old(mavlink->header[5]) &&
  @     mavlink->frame.component == \old(mavlink->header[6]) &&
  @     mavlink->frame.id == \old(mavlink_id(&mavlink->header[0]));
  @ ensures \result ==>
  @     \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> mavlink->frame.payload[i] ==
  @         \old(i < mavlink->header[1] ? mavlink->payload[i] : 0);
  @ ensures !\result ==> mavlink_kept{Pre, Post}(mavlink);
  @ ensures mavlink->count.frames ==
  @     (\result ? mavlink_sum(\old(mavlink->count.frames)) : \old(mavlink->count.frames));
  @*/
static bool end_frame(keel_mavlink_t *mavlink)
{
    bool right = false;

    if (mavlink->message < mavlink->known) {
        const uint8_t extra = mavlink->messages[mavlink->message].crc_extra;
        const uint16_t checksum = keel_crc16(mavlink->crc, extra);

        right = checksum_in(mavlink) == checksum;
        if (right) {
            publish_frame(mavlink);
            mavlink->frame.checksum = checksum;
            count_met(&mavlink->count.frames);
        } else {
            count_met(&mavlink->count.checksums);
        }
    }
    return right;
}

/*@ requires \valid_read(messages + (0 .. known - 1));
  @ assigns \nothing;
  @ ensures \result <==> mavlink_table(messages, known);
  @*/
static bool is_table(const keel_mavlink_message_t *messages, uint32_t known)
{
    bool ordered = true;

    /*@ loop invariant 0 <= i <= known;
      @ loop invariant ordered <==> mavlink_table(messages, i);
      @ loop assigns i, ordered;
      @ loop variant known - i;
      @*/
    for (uint32_t i = 0u; i < known; i++) {
        ordered = ordered && (messages[i].id <= (uint32_t)KEEL_MAVLINK_ID_MAX) &&
                  (messages[i].shortest <= messages[i].longest) &&
                  ((i == 0u) || (messages[i - 1u].id < messages[i].id));
    }
    return ordered;
}

keel_status_t keel_mavlink_init(keel_mavlink_t *mavlink, const keel_mavlink_message_t *messages,
                                uint32_t known)
{
    static const keel_mavlink_count_t no_count = {0};

    if (known > (uint32_t)KEEL_MAVLINK_MESSAGES_MAX) {
        return KEEL_ERR_FULL;
    }
    if (!is_table(messages, known)) {
        return KEEL_ERR_LIMITS;
    }
    mavlink->messages = messages;
    mavlink->known = known;
    mavlink->count = no_count;
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_HEADER_BYTES;
      @ loop invariant \forall integer j; 0 <= j < i ==> mavlink->header[j] == 0;
      @ loop assigns i, mavlink->header[0 .. KEEL_MAVLINK_HEADER_BYTES - 1];
      @ loop variant KEEL_MAVLINK_HEADER_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_HEADER_BYTES; i++) {
        mavlink->header[i] = 0u;
    }
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_PAYLOAD_MAX;
      @ loop assigns i, mavlink->payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1];
      @ loop variant KEEL_MAVLINK_PAYLOAD_MAX - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_PAYLOAD_MAX; i++) {
        mavlink->payload[i] = 0u;
    }
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_TAIL_MAX;
      @ loop assigns i, mavlink->tail[0 .. KEEL_MAVLINK_TAIL_MAX - 1];
      @ loop variant KEEL_MAVLINK_TAIL_MAX - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_TAIL_MAX; i++) {
        mavlink->tail[i] = 0u;
    }
    publish_frame(mavlink);
    mavlink->frame.checksum = 0u;
    mavlink->held = 0u;
    mavlink->crc = KEEL_CRC16_FIRST;
    mavlink->message = known;
    return KEEL_OK;
}

void keel_mavlink_gap(keel_mavlink_t *mavlink)
{
    if (mavlink->held > 0u) {
        count_met(&mavlink->count.gaps);
        mavlink->held = 0u;
    }
}

bool keel_mavlink_take(keel_mavlink_t *mavlink, uint8_t byte)
{
    bool right = false;

    offer(mavlink, byte);
    if (mavlink->held == (FLAGS_AT + 1u)) {
        check_flags(mavlink);
    } else if (mavlink->held == PAYLOAD_AT) {
        check_message(mavlink);
    } else if ((mavlink->held > PAYLOAD_AT) && (mavlink->held == whole_frame(mavlink))) {
        mavlink->held = 0u;
        right = end_frame(mavlink);
    } else {
        /* It is not whole yet. */
    }
    return right;
}

/* The bytes of a payload without its trailing zeros; the first one stays. */
/*@ requires length >= 1 && \valid_read(payload + (0 .. length - 1));
  @ assigns \nothing;
  @ ensures mavlink_cut(payload, length, \result);
  @*/
static uint8_t cut_of(const uint8_t *payload, uint8_t length)
{
    uint8_t cut = length;

    /*@ loop invariant 1 <= cut <= length;
      @ loop invariant \forall integer i; cut <= i < length ==> payload[i] == 0;
      @ loop assigns cut;
      @ loop variant cut;
      @*/
    while ((cut > 1u) && (payload[cut - 1u] == 0u)) {
        cut--;
    }
    return cut;
}

/* What the checksum is of such bytes of a frame, and of its message. */
/*@ requires 1 <= end <= KEEL_MAVLINK_FRAME_MAX && \valid_read(bytes + (0 .. end - 1));
  @ assigns \nothing;
  @*/
static uint16_t checksum_of(const uint8_t *bytes, uint32_t end, uint8_t extra)
{
    uint16_t crc = KEEL_CRC16_FIRST;

    /*@ loop invariant LENGTH_AT <= i <= end;
      @ loop assigns i, crc;
      @ loop variant end - i;
      @*/
    for (uint32_t i = LENGTH_AT; i < end; i++) {
        crc = keel_crc16(crc, bytes[i]);
    }
    return keel_crc16(crc, extra);
}

uint16_t keel_mavlink_write(keel_mavlink_sender_t *sender, const keel_mavlink_message_t *message,
                            const uint8_t *payload, uint8_t length, uint8_t *out, uint32_t size)
{
    const uint32_t signature = sender->is_signing ? (uint32_t)KEEL_MAVLINK_SIGNATURE_BYTES : 0u;
    const uint8_t sequence = sender->sequence;
    uint32_t end;
    uint32_t whole;
    uint16_t checksum;
    uint8_t cut;

    if ((length < 1u) || (length > message->longest) ||
        (message->id > (uint32_t)KEEL_MAVLINK_ID_MAX)) {
        return 0u;
    }
    cut = cut_of(payload, length);
    end = PAYLOAD_AT + (uint32_t)cut;
    whole = end + (uint32_t)KEEL_MAVLINK_CHECKSUM_BYTES + signature;
    if (whole > size) {
        return 0u;
    }
    out[0] = (uint8_t)KEEL_MAVLINK_FIRST;
    out[LENGTH_AT] = cut;
    out[FLAGS_AT] = sender->is_signing ? FLAG_SIGNED : 0u;
    out[COMPATIBLE_AT] = 0u;
    out[SEQUENCE_AT] = sequence;
    out[SYSTEM_AT] = sender->system;
    out[COMPONENT_AT] = sender->component;
    out[ID_AT] = (uint8_t)(message->id & BYTE);
    out[ID_AT + 1u] = (uint8_t)((message->id >> BITS) & BYTE);
    out[ID_AT + 2u] = (uint8_t)((message->id >> (2u * BITS)) & BYTE);
    /*@ loop invariant 0 <= i <= cut;
      @ loop assigns i, out[PAYLOAD_AT .. end - 1];
      @ loop variant cut - i;
      @*/
    for (uint32_t i = 0u; i < cut; i++) {
        out[PAYLOAD_AT + i] = payload[i];
    }
    checksum = checksum_of(out, end, message->crc_extra);
    out[end] = (uint8_t)(checksum & BYTE);
    out[end + 1u] = (uint8_t)(((uint32_t)checksum >> BITS) & BYTE);
    /*@ loop invariant end + 2 <= i <= whole;
      @ loop assigns i, out[end + 2 .. whole - 1];
      @ loop variant whole - i;
      @*/
    for (uint32_t i = end + 2u; i < whole; i++) {
        out[i] = 0u;
    }
    sender->sequence = (uint8_t)((sequence + 1u) & BYTE);
    return (uint16_t)whole;
}
