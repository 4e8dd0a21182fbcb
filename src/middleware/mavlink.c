/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/mavlink.h"

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

/* Where it is behind the payload, when the frame is signed. */
#define LINK_AT      2u
#define TIMESTAMP_AT 3u
#define SEAL_AT      9u

/* The one flag of those that a decoder has to know. */
#define FLAG_SIGNED 1u

#define BYTE 0xFFu
#define BITS 8u

/* The weights of a number's bytes, the lowest first. */
#define WEIGHT_1 0x100u
#define WEIGHT_2 0x10000u
#define WEIGHT_3 0x1000000u
#define WEIGHT_4 0x100000000u

/*@ requires \valid(count);
  @ assigns *count;
  @ ensures *count == mavlink_sum(\old(*count));
  @*/
static void count_met(uint32_t *count)
{
    *count += (*count < UINT32_MAX) ? 1u : 0u;
}

/* A header's message. */
/*@ requires \valid_read(bytes + (0 .. KEEL_MAVLINK_HEADER_BYTES - 1));
  @ assigns \nothing;
  @ ensures \result == mavlink_id(bytes);
  @*/
static uint32_t id_in(const uint8_t *bytes)
{
    return bytes[ID_AT] + (256u * bytes[ID_AT + 1u]) + (65536u * bytes[ID_AT + 2u]);
}

/* Where a frame's checksum is. */
/*@ requires \valid_read(bytes + (0 .. KEEL_MAVLINK_HEADER_BYTES - 1));
  @ assigns \nothing;
  @ ensures \result == mavlink_end(bytes);
  @*/
static uint32_t end_of(const uint8_t *bytes)
{
    return PAYLOAD_AT + (uint32_t)bytes[LENGTH_AT];
}

/* How many bytes a frame has. */
/*@ requires \valid_read(bytes + (0 .. KEEL_MAVLINK_HEADER_BYTES - 1));
  @ assigns \nothing;
  @ ensures \result == mavlink_whole(bytes);
  @*/
static uint32_t whole_frame(const uint8_t *bytes)
{
    const uint32_t signature = (bytes[FLAGS_AT] != 0u) ? (uint32_t)KEEL_MAVLINK_SIGNATURE_BYTES
                                                       : 0u;

    return end_of(bytes) + (uint32_t)KEEL_MAVLINK_CHECKSUM_BYTES + signature;
}

/* A frame's checksum, as it was sent. */
/*@ requires \valid_read(bytes + (0 .. KEEL_MAVLINK_FRAME_MAX - 1));
  @ assigns \nothing;
  @ ensures \result == mavlink_sent(bytes);
  @*/
static uint16_t checksum_in(const uint8_t *bytes)
{
    const uint32_t end = end_of(bytes);

    return (uint16_t)(bytes[end] + (256u * bytes[end + 1u]));
}

/* The checksum of such bytes of a frame, and of its message. */
/*@ requires 1 <= end <= KEEL_MAVLINK_FRAME_MAX && \valid_read(bytes + (0 .. end - 1));
  @ assigns \nothing;
  @ ensures \result == mavlink_checksum(bytes, end, extra);
  @*/
static uint16_t checksum_of(const uint8_t *bytes, uint32_t end, uint8_t extra)
{
    uint16_t crc = KEEL_CRC16_FIRST;

    /*@ loop invariant LENGTH_AT <= i <= end;
      @ loop invariant crc == mavlink_crc(bytes, i);
      @ loop assigns i, crc;
      @ loop variant end - i;
      @*/
    for (uint32_t i = LENGTH_AT; i < end; i++) {
        /*@ assert more: mavlink_crc(bytes, i + 1) ==
          @     mavlink_crc16(mavlink_crc(bytes, i), bytes[i]);
          @*/
        crc = keel_crc16(crc, bytes[i]);
    }
    return keel_crc16(crc, extra);
}

/* The message's place; the number of messages when there is none. */
/*@ requires mavlink_apart(mavlink);
  @ assigns \nothing;
  @ ensures \result <= mavlink->known;
  @ ensures \result < mavlink->known ==> mavlink->messages[\result].id == id;
  @ ensures \forall integer i; 0 <= i < mavlink->known && i != \result ==>
  @     mavlink->messages[i].id != id;
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

void keel_mavlink_drop(keel_mavlink_t *mavlink, uint32_t count)
{
    uint32_t from = 1u;
    uint32_t left;

    /*@ loop invariant 1 <= from <= mavlink->held;
      @ loop invariant \forall integer j; count <= j < from ==>
      @     mavlink->bytes[j] != KEEL_MAVLINK_FIRST;
      @ loop invariant mavlink->count.others == \min(UINT32_MAX,
      @     \at(mavlink->count.others, Pre) + \max(0, from - count));
      @ loop assigns from, mavlink->count.others;
      @ loop variant mavlink->held - from;
      @*/
    while ((from < mavlink->held) &&
           ((from < count) || (mavlink->bytes[from] != (uint8_t)KEEL_MAVLINK_FIRST))) {
        if (from >= count) {
            count_met(&mavlink->count.others);
        }
        from++;
    }
    left = mavlink->held - from;
    /*@ loop invariant 0 <= i <= left;
      @ loop invariant \forall integer j; from <= j < from + i ==>
      @     mavlink->bytes[j - from] == \at(mavlink->bytes[j], Pre);
      @ loop invariant \forall integer j; i <= j < KEEL_MAVLINK_FRAME_MAX ==>
      @     mavlink->bytes[j] == \at(mavlink->bytes[j], Pre);
      @ loop assigns i, mavlink->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1];
      @ loop variant left - i;
      @*/
    for (uint32_t i = 0u; i < left; i++) {
        mavlink->bytes[i] = mavlink->bytes[from + i];
    }
    mavlink->held = (uint16_t)left;
    mavlink->awaited = (uint16_t)KEEL_MAVLINK_HEADER_BYTES;
}

/* With a header: awaits its frame when it may be one, and otherwise drops its first byte. */
/*@ requires mavlink_apart(mavlink) && mavlink_valid(mavlink);
  @ requires KEEL_MAVLINK_HEADER_BYTES == mavlink->awaited <= mavlink->held;
  @ assigns mavlink->message, mavlink->count.flags, mavlink->count.unknown,
  @     mavlink->count.lengths, mavlink->count.others, mavlink->held, mavlink->awaited,
  @     mavlink->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1];
  @ ensures mavlink_valid(mavlink);
  @ ensures mavlink->held == \old(mavlink->held) ==>
  @     mavlink->awaited > KEEL_MAVLINK_HEADER_BYTES &&
  @     \forall integer j; 0 <= j < KEEL_MAVLINK_FRAME_MAX ==>
  @         mavlink->bytes[j] == \old(mavlink->bytes[j]);
  @ ensures mavlink->held != \old(mavlink->held) ==> !\old(mavlink_right(mavlink)) &&
  @     mavlink_dropped{Pre, Post}(mavlink, 1) && mavlink->held < \old(mavlink->held) &&
  @     mavlink->awaited == KEEL_MAVLINK_HEADER_BYTES;
  @*/
static void read_header(keel_mavlink_t *mavlink)
{
    const uint8_t length = mavlink->bytes[LENGTH_AT];
    const uint32_t place = place_of(mavlink, id_in(mavlink->bytes));
    bool fits = false;

    if (mavlink->bytes[FLAGS_AT] > FLAG_SIGNED) {
        count_met(&mavlink->count.flags);
    } else if (place == mavlink->known) {
        count_met(&mavlink->count.unknown);
    } else if ((length < mavlink->messages[place].shortest) ||
               (length > mavlink->messages[place].longest)) {
        count_met(&mavlink->count.lengths);
    } else {
        fits = true;
    }
    if (fits) {
        mavlink->message = place;
        mavlink->awaited = (uint16_t)whole_frame(mavlink->bytes);
    } else {
        keel_mavlink_drop(mavlink, 1u);
    }
}

/* A signature's time. */
/*@ requires \valid_read(byte + (0 .. 5));
  @ assigns \nothing;
  @*/
static uint64_t timestamp_in(const uint8_t *byte)
{
    const uint32_t low = (uint32_t)byte[0] + ((uint32_t)byte[1] * WEIGHT_1) +
                         ((uint32_t)byte[2] * WEIGHT_2) + ((uint32_t)byte[3] * WEIGHT_3);
    const uint32_t high = (uint32_t)byte[4] + ((uint32_t)byte[5] * WEIGHT_1);

    return ((uint64_t)high * WEIGHT_4) + low;
}

/*@ requires \valid(mavlink);
  @ assigns mavlink->frame.payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1];
  @ ensures \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> mavlink->frame.payload[i] ==
  @     \old(i < mavlink->bytes[1] ? mavlink->bytes[KEEL_MAVLINK_HEADER_BYTES + i] : 0);
  @*/
static void publish_payload(keel_mavlink_t *mavlink)
{
    const uint8_t length = mavlink->bytes[LENGTH_AT];

    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_PAYLOAD_MAX;
      @ loop invariant \forall integer j; 0 <= j < i ==> mavlink->frame.payload[j] ==
      @     \at(j < mavlink->bytes[1] ? mavlink->bytes[KEEL_MAVLINK_HEADER_BYTES + j] : 0, Pre);
      @ loop assigns i, mavlink->frame.payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1];
      @ loop variant KEEL_MAVLINK_PAYLOAD_MAX - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_PAYLOAD_MAX; i++) {
        mavlink->frame.payload[i] = (i < length) ? mavlink->bytes[PAYLOAD_AT + i] : 0u;
    }
}

/*@ requires \valid(mavlink);
  @ assigns mavlink->frame.is_signed, mavlink->frame.link, mavlink->frame.timestamp,
  @     mavlink->frame.seal[0 .. KEEL_MAVLINK_SEAL_BYTES - 1];
  @ ensures mavlink->frame.is_signed <==> \old(mavlink->bytes[2]) != 0;
  @*/
static void publish_signature(keel_mavlink_t *mavlink)
{
    const uint32_t end = end_of(mavlink->bytes);
    const bool is_signed = mavlink->bytes[FLAGS_AT] != 0u;

    mavlink->frame.is_signed = is_signed;
    mavlink->frame.link = is_signed ? mavlink->bytes[end + LINK_AT] : 0u;
    mavlink->frame.timestamp = is_signed ? timestamp_in(&mavlink->bytes[end + TIMESTAMP_AT]) : 0u;
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_SEAL_BYTES;
      @ loop assigns i, mavlink->frame.seal[0 .. KEEL_MAVLINK_SEAL_BYTES - 1];
      @ loop variant KEEL_MAVLINK_SEAL_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_SEAL_BYTES; i++) {
        mavlink->frame.seal[i] = is_signed ? mavlink->bytes[end + SEAL_AT + i] : 0u;
    }
}

/* The contents of the frame that begins with the first byte. */
/*@ requires \valid(mavlink);
  @ assigns mavlink->frame;
  @ ensures mavlink_header_of{Pre, Post}(mavlink);
  @ ensures \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> mavlink->frame.payload[i] ==
  @     \old(i < mavlink->bytes[1] ? mavlink->bytes[KEEL_MAVLINK_HEADER_BYTES + i] : 0);
  @*/
static void publish_frame(keel_mavlink_t *mavlink)
{
    mavlink->frame.id = id_in(mavlink->bytes);
    mavlink->frame.sequence = mavlink->bytes[SEQUENCE_AT];
    mavlink->frame.system = mavlink->bytes[SYSTEM_AT];
    mavlink->frame.component = mavlink->bytes[COMPONENT_AT];
    mavlink->frame.compatible = mavlink->bytes[COMPATIBLE_AT];
    mavlink->frame.length = mavlink->bytes[LENGTH_AT];
    mavlink->frame.checksum = checksum_in(mavlink->bytes);
    publish_signature(mavlink);
    publish_payload(mavlink);
}

/* Publishes the frame that begins with the first byte, and drops its bytes. */
/*@ requires mavlink_apart(mavlink) && mavlink_valid(mavlink);
  @ requires KEEL_MAVLINK_HEADER_BYTES < mavlink->awaited <= mavlink->held;
  @ assigns mavlink->frame, mavlink->count.frames, mavlink->count.others, mavlink->held,
  @     mavlink->awaited, mavlink->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1];
  @ ensures mavlink_valid(mavlink) && mavlink->awaited == KEEL_MAVLINK_HEADER_BYTES;
  @ // mavlink_dropped, clause by clause: as one goal it takes a prover minutes.
  @ ensures mavlink->held <= \old(mavlink->held - mavlink->awaited);
  @ ensures \forall integer j;
  @     \old(mavlink->awaited) <= j < \old(mavlink->held) - mavlink->held ==>
  @         \old(mavlink->bytes[j]) != KEEL_MAVLINK_FIRST;
  @ ensures \forall integer j; 0 <= j < mavlink->held ==>
  @     mavlink->bytes[j] ==
  @     \old(mavlink->bytes[\at(mavlink->held, Pre) - \at(mavlink->held, Post) + j]);
  @ ensures mavlink_header_of{Pre, Post}(mavlink);
  @ ensures \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> mavlink->frame.payload[i] ==
  @     \old(i < mavlink->bytes[1] ? mavlink->bytes[KEEL_MAVLINK_HEADER_BYTES + i] : 0);
  @ ensures mavlink->count.frames == mavlink_sum(\old(mavlink->count.frames));
  @*/
static void accept_frame(keel_mavlink_t *mavlink)
{
    count_met(&mavlink->count.frames);
    publish_frame(mavlink);
    keel_mavlink_drop(mavlink, mavlink->awaited);
}

/* With a whole frame: takes it, or drops its first byte. */
/*@ requires mavlink_apart(mavlink) && mavlink_valid(mavlink);
  @ requires KEEL_MAVLINK_HEADER_BYTES < mavlink->awaited <= mavlink->held;
  @ assigns mavlink->frame, mavlink->count.frames, mavlink->count.checksums,
  @     mavlink->count.others, mavlink->held, mavlink->awaited,
  @     mavlink->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1];
  @ ensures mavlink_valid(mavlink) && mavlink->awaited == KEEL_MAVLINK_HEADER_BYTES;
  @ ensures \result <==> \old(mavlink_right(mavlink));
  @ ensures \result ==> mavlink_dropped{Pre, Post}(mavlink, \old(mavlink->awaited));
  @ ensures \result ==> mavlink_header_of{Pre, Post}(mavlink);
  @ ensures \result ==>
  @     \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> mavlink->frame.payload[i] ==
  @         \old(i < mavlink->bytes[1] ? mavlink->bytes[KEEL_MAVLINK_HEADER_BYTES + i] : 0);
  @ ensures !\result ==> mavlink_kept{Pre, Post}(mavlink) &&
  @     mavlink_dropped{Pre, Post}(mavlink, 1);
  @ ensures mavlink->count.frames ==
  @     (\result ? mavlink_sum(\old(mavlink->count.frames)) : \old(mavlink->count.frames));
  @*/
static bool end_frame(keel_mavlink_t *mavlink)
{
    const uint8_t extra = mavlink->messages[mavlink->message].crc_extra;
    const uint16_t checksum = checksum_of(mavlink->bytes, end_of(mavlink->bytes), extra);
    const bool right = checksum_in(mavlink->bytes) == checksum;

    if (right) {
        accept_frame(mavlink);
    } else {
        count_met(&mavlink->count.checksums);
        keel_mavlink_drop(mavlink, 1u);
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
    mavlink->message = known;
    mavlink->held = 0u;
    mavlink->awaited = (uint16_t)KEEL_MAVLINK_HEADER_BYTES;
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_FRAME_MAX;
      @ loop invariant \forall integer j; 0 <= j < i ==> mavlink->bytes[j] == 0;
      @ loop assigns i, mavlink->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1];
      @ loop variant KEEL_MAVLINK_FRAME_MAX - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_FRAME_MAX; i++) {
        mavlink->bytes[i] = 0u;
    }
    publish_frame(mavlink); /* Of zeros, which say zeros. */
    return KEEL_OK;
}

keel_status_t keel_mavlink_take(keel_mavlink_t *mavlink, uint8_t byte)
{
    if (mavlink->held >= (uint16_t)KEEL_MAVLINK_FRAME_MAX) {
        return KEEL_ERR_FULL;
    }
    if ((mavlink->held == 0u) && (byte != (uint8_t)KEEL_MAVLINK_FIRST)) {
        count_met(&mavlink->count.others);
    } else {
        mavlink->bytes[mavlink->held] = byte;
        mavlink->held++;
    }
    return KEEL_OK;
}

keel_mavlink_look_t keel_mavlink_look(keel_mavlink_t *mavlink)
{
    keel_mavlink_look_t seen = KEEL_MAVLINK_AGAIN;

    if (mavlink->held < mavlink->awaited) {
        seen = KEEL_MAVLINK_NOTHING;
    } else if (mavlink->awaited == (uint16_t)KEEL_MAVLINK_HEADER_BYTES) {
        read_header(mavlink);
    } else if (end_frame(mavlink)) {
        seen = KEEL_MAVLINK_FRAME;
    } else {
        /* Its first byte was no beginning. */
    }
    return seen;
}

keel_mavlink_look_t keel_mavlink_gap(keel_mavlink_t *mavlink)
{
    keel_mavlink_look_t seen = KEEL_MAVLINK_AGAIN;

    if ((mavlink->held > 0u) && (mavlink->held < mavlink->awaited)) {
        count_met(&mavlink->count.gaps);
        keel_mavlink_drop(mavlink, 1u);
    } else {
        seen = keel_mavlink_look(mavlink);
    }
    return seen;
}

/* The bytes of a payload without its trailing zeros; the first one stays. */
/*@ requires length >= 1 && \valid_read(payload + (0 .. length - 1));
  @ assigns \nothing;
  @ ensures mavlink_cut(payload, length, \result);
  @*/
static uint8_t cut_of(const uint8_t *payload, uint8_t length)
{
    uint8_t cut = 1u;

    /*@ loop invariant 0 <= i <= length;
      @ loop invariant 1 <= cut <= length && (cut > 1 ==> cut <= i && payload[cut - 1] != 0);
      @ loop invariant \forall integer j; cut <= j < i ==> payload[j] == 0;
      @ loop assigns i, cut;
      @ loop variant length - i;
      @*/
    for (uint32_t i = 0u; i < length; i++) {
        cut = (payload[i] != 0u) ? (uint8_t)(i + 1u) : cut;
    }
    return cut;
}

uint16_t keel_mavlink_write(keel_mavlink_sender_t *sender, const keel_mavlink_message_t *message,
                            const uint8_t *payload, uint8_t length, keel_mavlink_packet_t *packet)
{
    const uint32_t signature = sender->is_signing ? (uint32_t)KEEL_MAVLINK_SIGNATURE_BYTES : 0u;
    const uint8_t sequence = sender->sequence;
    uint8_t *const out = packet->bytes;
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
      @ loop assigns i, packet->bytes[PAYLOAD_AT .. end - 1];
      @ loop variant cut - i;
      @*/
    for (uint32_t i = 0u; i < cut; i++) {
        out[PAYLOAD_AT + i] = payload[i];
    }
    checksum = checksum_of(out, end, message->crc_extra);
    out[end] = (uint8_t)(checksum & BYTE);
    out[end + 1u] = (uint8_t)(((uint32_t)checksum >> BITS) & BYTE);
    /*@ loop invariant end + 2 <= i <= whole;
      @ loop assigns i, packet->bytes[end + 2 .. whole - 1];
      @ loop variant whole - i;
      @*/
    for (uint32_t i = end + 2u; i < whole; i++) {
        out[i] = 0u;
    }
    sender->sequence = (uint8_t)((sequence + 1u) & BYTE);
    return (uint16_t)whole;
}
