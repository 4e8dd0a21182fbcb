/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/middleware/mavlink.h"

/* Where it is in a frame. */
#define LENGTH_AT     1u
#define FLAGS_AT      2u
#define COMPATIBLE_AT 3u
#define SEQUENCE_AT   4u
#define SYSTEM_AT     5u
#define COMPONENT_AT  6u
#define ID_AT         7u
#define PAYLOAD_AT    10u

/* From the checksum on. */
#define LINK_AT      2u
#define TIMESTAMP_AT 3u
#define SEAL_AT      9u

/* The one flag of those that a decoder has to know. */
#define FLAG_SIGNED 1u

#define BYTE            0xFFu
#define BITS            8u
#define TIMESTAMP_BYTES 6u

/*@ requires \valid(count);
  @ assigns *count;
  @ ensures *count == mavlink_sum(\old(*count));
  @*/
static void count_met(uint32_t *count)
{
    *count += (*count < UINT32_MAX) ? 1u : 0u;
}

/*@ requires \valid_read(bytes + (0 .. 1));
  @ assigns \nothing;
  @ ensures \result == mavlink_pair(bytes, 0);
  @*/
static uint32_t pair_at(const uint8_t *bytes)
{
    return bytes[0] + (256u * bytes[1]);
}

/* With a length: where its checksum is. */
/*@ requires \valid_read(bytes + (0 .. 1));
  @ assigns \nothing;
  @ ensures \result == mavlink_end(bytes);
  @*/
static uint32_t end_of(const uint8_t *bytes)
{
    return PAYLOAD_AT + (uint32_t)bytes[LENGTH_AT];
}

/* With flags: how many bytes it has. */
/*@ requires \valid_read(bytes + (0 .. 2));
  @ assigns \nothing;
  @ ensures \result == mavlink_whole(bytes);
  @*/
static uint32_t whole_frame(const uint8_t *bytes)
{
    const uint32_t signature = (bytes[FLAGS_AT] != 0u) ? (uint32_t)KEEL_MAVLINK_SIGNATURE_BYTES
                                                       : 0u;

    return end_of(bytes) + (uint32_t)KEEL_MAVLINK_CHECKSUM_BYTES + signature;
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

/* Adds a byte to a partial frame, or begins one with it. */
/*@ requires \valid(mavlink) && mavlink->held < KEEL_MAVLINK_FRAME_MAX;
  @ requires mavlink->held == 0 ==> byte == KEEL_MAVLINK_FIRST;
  @ assigns mavlink->bytes[mavlink->held], mavlink->held, mavlink->crc;
  @ ensures mavlink->held == \old(mavlink->held) + 1;
  @ ensures mavlink->bytes[\old(mavlink->held)] == byte;
  @ ensures mavlink->crc == (\old(mavlink->held) == 0 ? KEEL_CRC16_FIRST :
  @     \old(mavlink->held) < mavlink_end(&mavlink->bytes[0]) ?
  @         mavlink_rest(\old(mavlink->crc), byte) : \old(mavlink->crc));
  @*/
static void hold(keel_mavlink_t *mavlink, uint8_t byte)
{
    mavlink->bytes[mavlink->held] = byte;
    if (mavlink->held == 0u) {
        mavlink->crc = KEEL_CRC16_FIRST;
    } else if ((uint32_t)mavlink->held < end_of(mavlink->bytes)) {
        mavlink->crc = keel_crc16(mavlink->crc, byte);
    } else {
        /* The checksum and the signature are not part of what the checksum is of. */
    }
    mavlink->held++;
}

/*@ requires \valid(mavlink) && mavlink->held < KEEL_MAVLINK_FRAME_MAX;
  @ assigns mavlink->bytes[mavlink->held], mavlink->held, mavlink->crc, mavlink->count.others;
  @ ensures \old(mavlink->held) == 0 && byte != KEEL_MAVLINK_FIRST ==>
  @     mavlink->held == 0 && mavlink->crc == \old(mavlink->crc);
  @ ensures \old(mavlink->held) > 0 || byte == KEEL_MAVLINK_FIRST ==>
  @     mavlink->held == \old(mavlink->held) + 1 &&
  @     mavlink->bytes[\old(mavlink->held)] == byte &&
  @     mavlink->crc == (\old(mavlink->held) == 0 ? KEEL_CRC16_FIRST :
  @         \old(mavlink->held) < mavlink_end(&mavlink->bytes[0]) ?
  @             mavlink_rest(\old(mavlink->crc), byte) : \old(mavlink->crc));
  @*/
static void offer(keel_mavlink_t *mavlink, uint8_t byte)
{
    if ((mavlink->held == 0u) && (byte != (uint8_t)KEEL_MAVLINK_FIRST)) {
        count_met(&mavlink->count.others);
    } else {
        hold(mavlink, byte);
    }
}

/* With three bytes. When they begin no frame, one may begin at the second or the third. */
/*@ requires \valid(mavlink) && mavlink->held == 3 && mavlink->bytes[0] == KEEL_MAVLINK_FIRST;
  @ assigns mavlink->bytes[0 .. 1], mavlink->held, mavlink->crc, mavlink->count.others,
  @     mavlink->count.flags;
  @ ensures \old(mavlink->bytes[2]) <= 1 ==> mavlink->held == 3 &&
  @     mavlink->crc == \old(mavlink->crc) && mavlink->bytes[1] == \old(mavlink->bytes[1]);
  @ ensures \old(mavlink->bytes[2]) > 1 ==> mavlink->held <= 2;
  @ ensures mavlink->held > 0 ==> mavlink->bytes[0] == KEEL_MAVLINK_FIRST;
  @*/
static void check_flags(keel_mavlink_t *mavlink)
{
    const uint8_t second = mavlink->bytes[LENGTH_AT];
    const uint8_t third = mavlink->bytes[FLAGS_AT];

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
  @     mavlink_is_of(&mavlink->bytes[0], mavlink->messages + mavlink->message);
  @*/
static void check_message(keel_mavlink_t *mavlink)
{
    const uint32_t id = pair_at(&mavlink->bytes[ID_AT]) +
                        (65536u * mavlink->bytes[ID_AT + 2u]);
    const uint8_t length = mavlink->bytes[LENGTH_AT];

    mavlink->message = place_of(mavlink, id);
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

/*@ requires \valid_read(bytes + (0 .. TIMESTAMP_BYTES - 1));
  @ assigns \nothing;
  @ ensures \result == mavlink_pair(bytes, 0) + 65536 * mavlink_pair(bytes, 2) +
  @     4294967296 * mavlink_pair(bytes, 4);
  @*/
static uint64_t timestamp_at(const uint8_t *bytes)
{
    return pair_at(bytes) + (65536u * (uint64_t)pair_at(&bytes[2])) +
           (4294967296u * (uint64_t)pair_at(&bytes[4]));
}

/*@ requires \valid(frame) && \valid_read(bytes + (0 .. KEEL_MAVLINK_FRAME_MAX - 1)) &&
  @     \separated(frame, bytes + (0 .. KEEL_MAVLINK_FRAME_MAX - 1));
  @ assigns frame->payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1];
  @ ensures \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> frame->payload[i] ==
  @     (i < bytes[1] ? bytes[KEEL_MAVLINK_HEADER_BYTES + i] : 0);
  @*/
static void publish_payload(keel_mavlink_frame_t *frame, const uint8_t *bytes)
{
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_PAYLOAD_MAX;
      @ loop invariant \forall integer j; 0 <= j < i ==> frame->payload[j] ==
      @     (j < bytes[1] ? bytes[KEEL_MAVLINK_HEADER_BYTES + j] : 0);
      @ loop assigns i, frame->payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1];
      @ loop variant KEEL_MAVLINK_PAYLOAD_MAX - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_PAYLOAD_MAX; i++) {
        frame->payload[i] = (i < bytes[LENGTH_AT]) ? bytes[PAYLOAD_AT + i] : 0u;
    }
}

/*@ requires \valid(frame) && \valid_read(bytes + (0 .. KEEL_MAVLINK_FRAME_MAX - 1)) &&
  @     \separated(frame, bytes + (0 .. KEEL_MAVLINK_FRAME_MAX - 1));
  @ assigns frame->is_signed, frame->link, frame->timestamp,
  @     frame->seal[0 .. KEEL_MAVLINK_SEAL_BYTES - 1];
  @ ensures frame->is_signed <==> bytes[2] != 0;
  @*/
static void publish_signature(keel_mavlink_frame_t *frame, const uint8_t *bytes)
{
    const uint32_t end = end_of(bytes);
    const bool is_signed = bytes[FLAGS_AT] != 0u;

    frame->is_signed = is_signed;
    frame->link = is_signed ? bytes[end + LINK_AT] : 0u;
    frame->timestamp = is_signed ? timestamp_at(&bytes[end + TIMESTAMP_AT]) : 0u;
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_SEAL_BYTES;
      @ loop assigns i, frame->seal[0 .. KEEL_MAVLINK_SEAL_BYTES - 1];
      @ loop variant KEEL_MAVLINK_SEAL_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_SEAL_BYTES; i++) {
        frame->seal[i] = is_signed ? bytes[end + SEAL_AT + i] : 0u;
    }
}

/*@ requires \valid(frame) && \valid_read(bytes + (0 .. KEEL_MAVLINK_FRAME_MAX - 1)) &&
  @     \separated(frame, bytes + (0 .. KEEL_MAVLINK_FRAME_MAX - 1));
  @ assigns *frame;
  @ ensures frame->length == bytes[1] && (frame->is_signed <==> bytes[2] != 0) &&
  @     frame->compatible == bytes[3] && frame->sequence == bytes[4] &&
  @     frame->system == bytes[5] && frame->component == bytes[6] &&
  @     frame->id == mavlink_id(bytes);
  @ ensures \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> frame->payload[i] ==
  @     (i < bytes[1] ? bytes[KEEL_MAVLINK_HEADER_BYTES + i] : 0);
  @*/
static void publish_frame(keel_mavlink_frame_t *frame, const uint8_t *bytes)
{
    frame->id = pair_at(&bytes[ID_AT]) + (65536u * bytes[ID_AT + 2u]);
    frame->sequence = bytes[SEQUENCE_AT];
    frame->system = bytes[SYSTEM_AT];
    frame->component = bytes[COMPONENT_AT];
    frame->compatible = bytes[COMPATIBLE_AT];
    frame->length = bytes[LENGTH_AT];
    frame->checksum = (uint16_t)pair_at(&bytes[end_of(bytes)]);
    publish_signature(frame, bytes);
    publish_payload(frame, bytes);
}

/* With all of its bytes: takes the frame, or counts why not. */
/*@ requires mavlink_apart(mavlink) && mavlink->message <= mavlink->known;
  @ requires mavlink->bytes[0] == KEEL_MAVLINK_FIRST && mavlink->bytes[2] <= 1;
  @ assigns mavlink->frame, mavlink->count.frames, mavlink->count.checksums;
  @ ensures \result ==> mavlink->message < mavlink->known &&
  @     mavlink_pair(&mavlink->bytes[0], mavlink_end(&mavlink->bytes[0])) ==
  @         mavlink_rest(mavlink->crc, mavlink->messages[mavlink->message].crc_extra);
  @ ensures \result ==> mavlink->frame.length == mavlink->bytes[1] &&
  @     mavlink->frame.is_signed == mavlink->bytes[2] &&
  @     mavlink->frame.compatible == mavlink->bytes[3] &&
  @     mavlink->frame.sequence == mavlink->bytes[4] &&
  @     mavlink->frame.system == mavlink->bytes[5] &&
  @     mavlink->frame.component == mavlink->bytes[6] &&
  @     mavlink->frame.id == mavlink_id(&mavlink->bytes[0]);
  @ ensures \result ==>
  @     \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> mavlink->frame.payload[i] ==
  @         (i < mavlink->bytes[1] ? mavlink->bytes[KEEL_MAVLINK_HEADER_BYTES + i] : 0);
  @ ensures !\result ==> mavlink_kept{Pre, Post}(mavlink);
  @ ensures mavlink->count.frames ==
  @     (\result ? mavlink_sum(\old(mavlink->count.frames)) : \old(mavlink->count.frames));
  @*/
static bool end_frame(keel_mavlink_t *mavlink)
{
    bool right = false;

    if (mavlink->message < mavlink->known) {
        const uint8_t extra = mavlink->messages[mavlink->message].crc_extra;

        right = pair_at(&mavlink->bytes[end_of(mavlink->bytes)]) ==
                keel_crc16(mavlink->crc, extra);
        if (right) {
            publish_frame(&mavlink->frame, mavlink->bytes);
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
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_FRAME_MAX;
      @ loop invariant \forall integer j; 0 <= j < i ==> mavlink->bytes[j] == 0;
      @ loop assigns i, mavlink->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1];
      @ loop variant KEEL_MAVLINK_FRAME_MAX - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_FRAME_MAX; i++) {
        mavlink->bytes[i] = 0u;
    }
    publish_frame(&mavlink->frame, mavlink->bytes);
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
    } else if ((mavlink->held > PAYLOAD_AT) && (mavlink->held == whole_frame(mavlink->bytes))) {
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
    out[SEQUENCE_AT] = sender->sequence;
    out[SYSTEM_AT] = sender->system;
    out[COMPONENT_AT] = sender->component;
    out[ID_AT] = (uint8_t)(message->id & BYTE);
    out[ID_AT + 1u] = (uint8_t)((message->id >> BITS) & BYTE);
    out[ID_AT + 2u] = (uint8_t)(message->id >> (2u * BITS));
    /*@ loop invariant 0 <= i <= cut;
      @ loop invariant \forall integer j; 0 <= j < i ==> out[PAYLOAD_AT + j] == payload[j];
      @ loop assigns i, out[PAYLOAD_AT .. end - 1];
      @ loop variant cut - i;
      @*/
    for (uint32_t i = 0u; i < cut; i++) {
        out[PAYLOAD_AT + i] = payload[i];
    }
    checksum = checksum_of(out, end, message->crc_extra);
    out[end] = (uint8_t)(checksum & BYTE);
    out[end + 1u] = (uint8_t)(checksum >> BITS);
    /*@ loop invariant end + 2 <= i <= whole;
      @ loop assigns i, out[end + 2 .. whole - 1];
      @ loop variant whole - i;
      @*/
    for (uint32_t i = end + 2u; i < whole; i++) {
        out[i] = 0u;
    }
    sender->sequence = (uint8_t)((sender->sequence + 1u) & BYTE);
    return (uint16_t)whole;
}
