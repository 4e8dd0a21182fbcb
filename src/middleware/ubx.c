/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/ubx.h"

#define SYNC_A 0xB5u
#define SYNC_B 0x62u

/* The two of them, as they stand in a window. */
#define SYNC       0x62B5u
#define SYNC_LIMIT 0x10000u

/* Class, id and length behind them; a NAV-PVT's length is one of many. */
#define MESSAGE_ACK 0x00020105u
#define MESSAGE_NAK 0x00020005u
#define PVT         0x0701u
#define PVT_LIMIT   0x10000u

/* In a window: the latest byte's place; behind two bytes the latest four. */
#define LATEST 0x10000000000u
#define TWO    0x10000u

/* In those four: their places. Divisions by them are shifts; provers know more of the former. */
#define WEIGHT_1 0x100u
#define WEIGHT_2 0x10000u
#define WEIGHT_3 0x1000000u
#define BYTE     0x100u

/* Of a byte of flags, the lowest: the fix is vouched for, the place is invalid. */
#define FLAG 2u

/* The last bytes of a NAV-PVT's fields, from the begin of its payload. */
#define TOW_END             3u
#define TYPE_END            23u
#define LONGITUDE_END       27u
#define LATITUDE_END        31u
#define HEIGHT_END          39u
#define ACCURACY_END        43u
#define HEIGHT_ACCURACY_END 47u
#define NORTH_END           51u
#define EAST_END            55u
#define DOWN_END            59u
#define SPEED_ACCURACY_END  71u
#define INVALID_END         79u

/* The CFG messages and their fields. */
#define GROUP_CFG     0x06u
#define CFG_PRT       0x00u
#define CFG_MSG       0x01u
#define CFG_RATE      0x08u
#define CFG_VALSET    0x8Au
#define EACH_SOLUTION 1u
#define GPS_TIME      1u
#define UART_1        1u
#define MODE_8N1      0x08D0u
#define ONLY_UBX      0x01u
#define LAYER_RAM     0x01u
#define SIZE_PLACE    0x10000000u
#define SIZE_LIMIT    8u
#define SIZE_TWO      3u
#define SIZE_FOUR     4u

/* Where a payload begins, and how long those of CFG messages are. */
#define AT_PAYLOAD   6u
#define HALF_WEEK_MS ((uint32_t)KEEL_UBX_WEEK_MS / 2u)

/*@ assigns \nothing;
  @ ensures \result == ubx_sum(a, b);
  @*/
static uint32_t sum_up_to_end(uint32_t a, uint32_t b)
{
    return (a <= (UINT32_MAX - b)) ? (a + b) : UINT32_MAX;
}

/*@ requires \valid(count);
  @ assigns *count;
  @ ensures *count == ubx_sum(\old(*count), 1);
  @*/
static void count_event(uint32_t *count)
{
    *count = sum_up_to_end(*count, 1u);
}

/* Two's complement, whatever the compiler makes of a conversion. */
/*@ assigns \nothing;
  @ ensures \result == (word <= INT32_MAX ? word : word - 0x100000000);
  @*/
static int32_t signed_of(uint32_t word)
{
    const uint32_t below = UINT32_MAX - word;

    return (word <= (uint32_t)INT32_MAX) ? (int32_t)word : (-(int32_t)below - 1);
}

/*@ assigns \nothing;
  @ ensures \result <==> ubx_advances(from, to);
  @*/
static bool advances(uint32_t from, uint32_t to)
{
    const bool known = (from < (uint32_t)KEEL_UBX_WEEK_MS) && (to < (uint32_t)KEEL_UBX_WEEK_MS);

    if (!known) {
        return false;
    }
    return (from < to) ? ((to - from) < HALF_WEEK_MS) : ((from - to) > HALF_WEEK_MS);
}

/*@ requires window < 0x1000000000000;
  @ assigns \nothing;
  @ ensures \result == ubx_shifted(window, byte);
  @ ensures \result < 0x1000000000000;
  @*/
static uint64_t shifted(uint64_t window, uint8_t byte)
{
    return (window / 256u) + ((uint64_t)byte * LATEST);
}

/*@ requires \valid(ubx);
  @ assigns ubx->sum_a, ubx->sum_b;
  @ ensures ubx->sum_a == (\old(ubx->sum_a) + byte) % 256;
  @ ensures ubx->sum_b == (\old(ubx->sum_b) + ubx->sum_a) % 256;
  @*/
static void add_to_sums(keel_ubx_t *ubx, uint8_t byte)
{
    ubx->sum_a = (uint8_t)(((uint32_t)ubx->sum_a + byte) % 256u);
    ubx->sum_b = (uint8_t)(((uint32_t)ubx->sum_b + ubx->sum_a) % 256u);
}

/* A word of a NAV-PVT's payload ended with this byte of it. The flag of an invalid place
 * came with protocol 15: in a shorter payload those bits are reserved. */
/*@ requires \valid(pending);
  @ assigns *pending;
  @*/
static void gather(keel_ubx_fix_t *pending, uint32_t length, uint32_t at, uint32_t word)
{
    switch (at) {
    case TOW_END:
        pending->tow_ms = word;
        break;
    case TYPE_END:
        pending->type = (uint8_t)(word % BYTE);
        pending->is_ok = ((word / WEIGHT_1) % FLAG) != 0u;
        pending->satellites = (uint8_t)(word / WEIGHT_3);
        break;
    case LONGITUDE_END:
        pending->longitude = signed_of(word);
        break;
    case LATITUDE_END:
        pending->latitude = signed_of(word);
        break;
    case HEIGHT_END:
        pending->height_mm = signed_of(word);
        break;
    case ACCURACY_END:
        pending->accuracy_mm = word;
        break;
    case HEIGHT_ACCURACY_END:
        pending->height_accuracy = word;
        break;
    case NORTH_END:
        pending->north = signed_of(word);
        break;
    case EAST_END:
        pending->east = signed_of(word);
        break;
    case DOWN_END:
        pending->down = signed_of(word);
        break;
    case SPEED_ACCURACY_END:
        pending->speed_accuracy = word;
        break;
    case INVALID_END:
        pending->is_invalid = (length >= (uint32_t)KEEL_UBX_PAYLOAD) &&
                              (((word / WEIGHT_2) % FLAG) != 0u);
        break;
    default:
        /* Nothing that is handed out ends here. */
        break;
    }
}

/* The byte is the latest in the window already. */
/*@ requires \valid(ubx) && ubx_valid(ubx) && ubx->step == KEEL_UBX_DATA;
  @ assigns ubx->pending, ubx->left, ubx->sum_a, ubx->sum_b, ubx->step;
  @ ensures ubx_valid(ubx) && ubx->left == \old(ubx->left) - 1;
  @ ensures ubx->step == (ubx->left > 0 ? KEEL_UBX_DATA : KEEL_UBX_SUM_A);
  @*/
static void take_data(keel_ubx_t *ubx, uint8_t byte)
{
    add_to_sums(ubx, byte);
    if (ubx->kind == (uint8_t)KEEL_UBX_PVT) {
        gather(&ubx->pending, ubx->length, (uint32_t)ubx->length - ubx->left,
               (uint32_t)(ubx->window / TWO));
    }
    ubx->left--;
    if (ubx->left == 0u) {
        ubx->step = (uint8_t)KEEL_UBX_SUM_A;
    }
}

/* The words of a NAV-PVT become the fix. */
/*@ requires \valid(ubx);
  @ assigns ubx->fix;
  @ ensures ubx_published{Pre, Post}(ubx);
  @*/
static void publish_fix(keel_ubx_t *ubx)
{
    ubx->fix.tow_ms = ubx->pending.tow_ms;
    ubx->fix.longitude = ubx->pending.longitude;
    ubx->fix.latitude = ubx->pending.latitude;
    ubx->fix.height_mm = ubx->pending.height_mm;
    ubx->fix.accuracy_mm = ubx->pending.accuracy_mm;
    ubx->fix.height_accuracy = ubx->pending.height_accuracy;
    ubx->fix.north = ubx->pending.north;
    ubx->fix.east = ubx->pending.east;
    ubx->fix.down = ubx->pending.down;
    ubx->fix.speed_accuracy = ubx->pending.speed_accuracy;
    ubx->fix.type = ubx->pending.type;
    ubx->fix.satellites = ubx->pending.satellites;
    ubx->fix.is_ok = ubx->pending.is_ok;
    ubx->fix.is_invalid = ubx->pending.is_invalid;
}

/* A right message: none of its bytes is part of another one. */
/*@ requires \valid(ubx);
  @ assigns ubx->fix, ubx->count.fixes, ubx->count.acks, ubx->count.naks, ubx->count.others,
  @     ubx->is_advancing, ubx->age_us, ubx->window;
  @ ensures \result <==> ubx->kind == KEEL_UBX_PVT;
  @ ensures ubx->window == 0;
  @ ensures \result ==> ubx_published{Pre, Post}(ubx) && ubx->age_us == 0;
  @ ensures \result ==> (ubx->is_advancing != 0 <==> (\old(ubx->count.fixes) > 0 &&
  @     ubx_advances(\old(ubx->fix.tow_ms), ubx->pending.tow_ms)));
  @ ensures !\result ==> ubx_kept{Pre, Post}(ubx) &&
  @     ubx->is_advancing == \old(ubx->is_advancing) && ubx->age_us == \old(ubx->age_us);
  @ ensures ubx->count.fixes ==
  @     (\result ? ubx_sum(\old(ubx->count.fixes), 1) : \old(ubx->count.fixes));
  @*/
static bool take_message(keel_ubx_t *ubx)
{
    bool is_fix = false;

    ubx->window = 0u;
    if (ubx->kind == (uint8_t)KEEL_UBX_PVT) {
        ubx->is_advancing = (ubx->count.fixes > 0u) &&
                            advances(ubx->fix.tow_ms, ubx->pending.tow_ms);
        publish_fix(ubx);
        ubx->age_us = 0u;
        count_event(&ubx->count.fixes);
        is_fix = true;
    } else if (ubx->kind == (uint8_t)KEEL_UBX_ACK) {
        count_event(&ubx->count.acks);
    } else if (ubx->kind == (uint8_t)KEEL_UBX_NAK) {
        count_event(&ubx->count.naks);
    } else {
        count_event(&ubx->count.others);
    }
    return is_fix;
}

/* A byte of the message under way. */
/*@ requires \valid(ubx) && ubx_valid(ubx);
  @ assigns ubx->fix, ubx->count.fixes, ubx->count.acks, ubx->count.naks, ubx->count.others,
  @     ubx->count.checksums, ubx->is_advancing, ubx->age_us, ubx->pending, ubx->window,
  @     ubx->left, ubx->sum_a, ubx->sum_b, ubx->step;
  @ ensures ubx_valid(ubx);
  @ ensures \result <==> (\old(ubx->step) == KEEL_UBX_SUM_B && ubx->kind == KEEL_UBX_PVT &&
  @     byte == \old(ubx->sum_b));
  @ ensures ubx->step == KEEL_UBX_SUM_B ==>
  @     \old(ubx->step) == KEEL_UBX_SUM_A && byte == \old(ubx->sum_a);
  @ ensures \old(ubx->step) == KEEL_UBX_SEARCH || \old(ubx->step) == KEEL_UBX_SUM_B ==>
  @     ubx->step == KEEL_UBX_SEARCH;
  @ ensures \old(ubx->step) == KEEL_UBX_DATA ==> ubx->left == \old(ubx->left) - 1 &&
  @     ubx->step == (ubx->left > 0 ? KEEL_UBX_DATA : KEEL_UBX_SUM_A);
  @ ensures ubx->window ==
  @     (\old(ubx->step) == KEEL_UBX_SUM_B && byte == \old(ubx->sum_b) ? 0 : \old(ubx->window));
  @ ensures \result ==> ubx_published{Pre, Post}(ubx) && ubx->age_us == 0;
  @ ensures \result ==> (ubx->is_advancing != 0 <==> (\old(ubx->count.fixes) > 0 &&
  @     ubx_advances(\old(ubx->fix.tow_ms), \old(ubx->pending.tow_ms))));
  @ ensures !\result ==> ubx_kept{Pre, Post}(ubx) &&
  @     ubx->is_advancing == \old(ubx->is_advancing) && ubx->age_us == \old(ubx->age_us);
  @ ensures ubx->count.fixes ==
  @     (\result ? ubx_sum(\old(ubx->count.fixes), 1) : \old(ubx->count.fixes));
  @*/
static bool go_on_with(keel_ubx_t *ubx, uint8_t byte)
{
    bool is_fix = false;

    if (ubx->step == (uint8_t)KEEL_UBX_DATA) {
        take_data(ubx, byte);
    } else if (ubx->step != (uint8_t)KEEL_UBX_SEARCH) {
        const bool is_last = ubx->step == (uint8_t)KEEL_UBX_SUM_B;
        const bool right = byte == (is_last ? ubx->sum_b : ubx->sum_a);

        ubx->step = (uint8_t)((right && !is_last) ? KEEL_UBX_SUM_B : KEEL_UBX_SEARCH);
        if (!right) {
            count_event(&ubx->count.checksums);
        } else if (is_last) {
            is_fix = take_message(ubx);
        } else {
            /* One half of the checksum is right. */
        }
    } else {
        /* No message is under way. */
    }
    return is_fix;
}

/*@ assigns \nothing;
  @ ensures \result <= KEEL_UBX_NAK;
  @ ensures \result == KEEL_UBX_PVT <==>
  @     message % 0x10000 == 0x0701 && message / 0x10000 >= KEEL_UBX_PAYLOAD_LEAST;
  @*/
static uint8_t kind_of(uint32_t message)
{
    uint32_t kind = KEEL_UBX_OTHER;

    if (((message % PVT_LIMIT) == PVT) &&
        ((message / WEIGHT_2) >= (uint32_t)KEEL_UBX_PAYLOAD_LEAST)) {
        kind = KEEL_UBX_PVT;
    } else if (message == MESSAGE_ACK) {
        kind = KEEL_UBX_ACK;
    } else if (message == MESSAGE_NAK) {
        kind = KEEL_UBX_NAK;
    } else {
        /* Skipped. */
    }
    return (uint8_t)kind;
}

/* The window holds the header of a message. */
/*@ requires \valid(ubx) && ubx->window < 0x1000000000000;
  @ assigns ubx->count.cut, ubx->length, ubx->left, ubx->sum_a, ubx->sum_b, ubx->kind, ubx->step;
  @ ensures ubx_valid(ubx);
  @ ensures ubx->step == KEEL_UBX_DATA || ubx->step == KEEL_UBX_SUM_A;
  @ ensures ubx->left == ubx->length && ubx->length == ubx_length(ubx->window);
  @ ensures ubx_is_pvt(ubx->window) ==> ubx->step == KEEL_UBX_DATA && ubx->kind == KEEL_UBX_PVT;
  @ ensures ubx->window == KEEL_UBX_HEADER ==> ubx->step == KEEL_UBX_DATA &&
  @     ubx->kind == KEEL_UBX_PVT && ubx->left == KEEL_UBX_PAYLOAD && ubx->sum_a == 0x64 &&
  @     ubx->sum_b == 0xD1;
  @ ensures ubx->window == KEEL_UBX_HEADER_14 ==> ubx->step == KEEL_UBX_DATA &&
  @     ubx->kind == KEEL_UBX_PVT && ubx->left == KEEL_UBX_PAYLOAD_LEAST &&
  @     ubx->sum_a == 0x5C && ubx->sum_b == 0xC1;
  @*/
static void begin_message(keel_ubx_t *ubx)
{
    const uint32_t message = (uint32_t)(ubx->window / TWO);
    const uint32_t group = message % BYTE;
    const uint32_t id = (message / WEIGHT_1) % BYTE;
    const uint32_t low = (message / WEIGHT_2) % BYTE;
    const uint32_t high = message / WEIGHT_3;

    //@ assert fix: ubx->window == KEEL_UBX_HEADER ==> message == 0x005C0701;
    //@ assert fix_14: ubx->window == KEEL_UBX_HEADER_14 ==> message == 0x00540701;
    if (ubx->step != (uint8_t)KEEL_UBX_SEARCH) {
        count_event(&ubx->count.cut);
    }
    ubx->kind = kind_of(message);
    ubx->length = (uint16_t)(message / WEIGHT_2);
    ubx->left = ubx->length;
    ubx->step = (uint8_t)((ubx->left > 0u) ? KEEL_UBX_DATA : KEEL_UBX_SUM_A);
    ubx->sum_a = (uint8_t)((group + id + low + high) % 256u);
    ubx->sum_b = (uint8_t)(((4u * group) + (3u * id) + (2u * low) + high) % 256u);
}

/* A byte is the latest in the window; too long a silence before it has ended what was under way. */
/*@ requires \valid(ubx) && ubx_valid(ubx);
  @ assigns ubx->count.bytes, ubx->count.cut, ubx->quiet_us, ubx->window, ubx->step;
  @ ensures ubx_valid(ubx) && ubx->quiet_us == 0;
  @ ensures ubx->count.bytes == ubx_sum(\old(ubx->count.bytes), 1);
  @ ensures \old(ubx->quiet_us) > ubx->config.gap_us ==>
  @     ubx->step == KEEL_UBX_SEARCH && ubx->window == 0x10000000000 * byte;
  @ ensures \old(ubx->quiet_us) <= ubx->config.gap_us ==>
  @     ubx->step == \old(ubx->step) && ubx->window == ubx_shifted(\old(ubx->window), byte);
  @*/
static void let_in(keel_ubx_t *ubx, uint8_t byte)
{
    if (ubx->quiet_us > ubx->config.gap_us) {
        if (ubx->step != (uint8_t)KEEL_UBX_SEARCH) {
            count_event(&ubx->count.cut);
        }
        ubx->step = (uint8_t)KEEL_UBX_SEARCH;
        ubx->window = 0u;
    }
    ubx->quiet_us = 0u;
    count_event(&ubx->count.bytes);
    ubx->window = shifted(ubx->window, byte);
}

/* Whether a message begins with the latest byte. */
/*@ requires \valid(ubx) && ubx_valid(ubx);
  @ assigns ubx->count.cut, ubx->length, ubx->left, ubx->sum_a, ubx->sum_b, ubx->kind, ubx->step;
  @ ensures ubx_valid(ubx);
  @ ensures ubx->window == KEEL_UBX_HEADER ==> ubx->step == KEEL_UBX_DATA &&
  @     ubx->kind == KEEL_UBX_PVT && ubx->length == KEEL_UBX_PAYLOAD &&
  @     ubx->left == KEEL_UBX_PAYLOAD && ubx->sum_a == 0x64 && ubx->sum_b == 0xD1;
  @ ensures ubx->window == KEEL_UBX_HEADER_14 ==> ubx->step == KEEL_UBX_DATA &&
  @     ubx->kind == KEEL_UBX_PVT && ubx->length == KEEL_UBX_PAYLOAD_LEAST &&
  @     ubx->left == KEEL_UBX_PAYLOAD_LEAST && ubx->sum_a == 0x5C && ubx->sum_b == 0xC1;
  @ ensures \old(ubx->step) == KEEL_UBX_SEARCH && ubx_is_pvt(ubx->window) ==>
  @     ubx->step == KEEL_UBX_DATA && ubx->kind == KEEL_UBX_PVT &&
  @     ubx->length == ubx_length(ubx->window) && ubx->left == ubx->length;
  @ ensures !ubx_begins(ubx->window) && (\old(ubx->step) != KEEL_UBX_SEARCH ||
  @     ubx->window % 0x10000 != 0x62B5) ==> ubx->step == \old(ubx->step) &&
  @     ubx->left == \old(ubx->left) && ubx->length == \old(ubx->length);
  @ ensures \old(ubx->step) == KEEL_UBX_SEARCH ==> ubx->step != KEEL_UBX_SUM_B;
  @*/
static void look_for_header(keel_ubx_t *ubx)
{
    if ((ubx->window == (uint64_t)KEEL_UBX_HEADER) ||
        (ubx->window == (uint64_t)KEEL_UBX_HEADER_14) ||
        ((ubx->step == (uint8_t)KEEL_UBX_SEARCH) && ((ubx->window % SYNC_LIMIT) == SYNC))) {
        begin_message(ubx);
    }
}

keel_status_t keel_ubx_init(keel_ubx_t *ubx, const keel_ubx_config_t *config)
{
    static const keel_ubx_fix_t no_fix = {0};
    static const keel_ubx_count_t no_count = {0};

    if ((config->accuracy_mm == 0u) || (config->speed_accuracy == 0u)) {
        return KEEL_ERR_LIMITS;
    }
    if ((config->gap_us == 0u) || (config->max_age_us == 0u)) {
        return KEEL_ERR_AGE;
    }
    ubx->config.gap_us = config->gap_us;
    ubx->config.max_age_us = config->max_age_us;
    ubx->config.accuracy_mm = config->accuracy_mm;
    ubx->config.speed_accuracy = config->speed_accuracy;
    ubx->is_advancing = false;
    ubx->age_us = UINT32_MAX;
    ubx->quiet_us = UINT32_MAX;
    ubx->window = 0u;
    ubx->length = 0u;
    ubx->left = 0u;
    ubx->sum_a = 0u;
    ubx->sum_b = 0u;
    ubx->kind = (uint8_t)KEEL_UBX_OTHER;
    ubx->step = (uint8_t)KEEL_UBX_SEARCH;
    ubx->count = no_count;
    ubx->fix = no_fix;
    ubx->pending = no_fix;
    return KEEL_OK;
}

void keel_ubx_pass_time(keel_ubx_t *ubx, uint32_t elapsed_us)
{
    ubx->age_us = sum_up_to_end(ubx->age_us, elapsed_us);
    ubx->quiet_us = sum_up_to_end(ubx->quiet_us, elapsed_us);
}

bool keel_ubx_take(keel_ubx_t *ubx, uint8_t byte, uint32_t elapsed_us)
{
    bool is_fix;

    keel_ubx_pass_time(ubx, elapsed_us);
    let_in(ubx, byte);
    is_fix = go_on_with(ubx, byte);
    look_for_header(ubx);
    return is_fix;
}

keel_ubx_verdict_t keel_ubx_judge(const keel_ubx_t *ubx)
{
    keel_ubx_verdict_t verdict = KEEL_UBX_USABLE;

    if (ubx->count.fixes == 0u) {
        verdict = KEEL_UBX_NONE;
    } else if (ubx->age_us > ubx->config.max_age_us) {
        verdict = KEEL_UBX_OLD;
    } else if (!ubx->fix.is_ok) {
        verdict = KEEL_UBX_NOT_OK;
    } else if (ubx->fix.type != (uint8_t)KEEL_UBX_3D) {
        verdict = KEEL_UBX_NOT_3D;
    } else if (ubx->fix.is_invalid) {
        verdict = KEEL_UBX_INVALID;
    } else if (ubx->fix.accuracy_mm > ubx->config.accuracy_mm) {
        verdict = KEEL_UBX_WIDE;
    } else if (ubx->fix.speed_accuracy > ubx->config.speed_accuracy) {
        verdict = KEEL_UBX_WIDE_SPEED;
    } else if (!ubx->is_advancing) {
        verdict = KEEL_UBX_STUCK;
    } else {
        /* Nothing is against it. */
    }
    return verdict;
}

/* A message of CFG without its payload, which is 0. */
/*@ requires \valid(message) && length <= KEEL_UBX_MESSAGE_BYTES - 8;
  @ assigns *message;
  @ ensures ubx_begun(message, 0x06, id, length);
  @ ensures \forall integer i; 6 <= i < KEEL_UBX_MESSAGE_BYTES ==> message->bytes[i] == 0;
  @*/
static void write_header(keel_ubx_message_t *message, uint8_t id, uint8_t length)
{
    /*@ loop invariant 0 <= i <= KEEL_UBX_MESSAGE_BYTES;
      @ loop invariant \forall integer j; 0 <= j < i ==> message->bytes[j] == 0;
      @ loop assigns i, message->bytes[0 .. KEEL_UBX_MESSAGE_BYTES - 1];
      @ loop variant KEEL_UBX_MESSAGE_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_UBX_MESSAGE_BYTES; i++) {
        message->bytes[i] = 0u;
    }
    message->bytes[0] = SYNC_A;
    message->bytes[1] = SYNC_B;
    message->bytes[2] = GROUP_CFG;
    message->bytes[3] = id;
    message->bytes[4] = length;
    message->size = (uint8_t)(length + 8u);
}

/* Some bytes of a number, the lowest first. */
/*@ requires \valid(message) && 6 <= at && count <= 4 && at + count <= KEEL_UBX_MESSAGE_BYTES;
  @ assigns message->bytes[at .. at + count - 1];
  @ ensures count >= 1 ==> message->bytes[at] == value % 256;
  @ ensures count >= 2 ==> message->bytes[at + 1] == (value / 256) % 256;
  @*/
static void write_number(keel_ubx_message_t *message, uint32_t at, uint32_t value, uint32_t count)
{
    uint32_t rest = value;

    /*@ loop invariant 0 <= i <= count;
      @ loop invariant i == 0 ==> rest == value;
      @ loop invariant i == 1 ==> rest == value / 256;
      @ loop invariant i >= 1 ==> message->bytes[at] == value % 256;
      @ loop invariant i >= 2 ==> message->bytes[at + 1] == (value / 256) % 256;
      @ loop assigns i, rest, message->bytes[at .. at + count - 1];
      @ loop variant count - i;
      @*/
    for (uint32_t i = 0u; i < count; i++) {
        message->bytes[at + i] = (uint8_t)(rest % 256u);
        rest /= 256u;
    }
}

/* The checksum behind a payload. */
/*@ requires \valid(message) && 8 <= message->size <= KEEL_UBX_MESSAGE_BYTES;
  @ assigns message->bytes[message->size - 2 .. message->size - 1];
  @*/
static void write_sums(keel_ubx_message_t *message)
{
    const uint32_t end = (uint32_t)message->size - 2u;
    uint32_t a = 0u;
    uint32_t b = 0u;

    /*@ loop invariant 2 <= i <= end && a < 256 && b < 256;
      @ loop assigns i, a, b;
      @ loop variant end - i;
      @*/
    for (uint32_t i = 2u; i < end; i++) {
        a = (a + message->bytes[i]) % 256u;
        b = (b + a) % 256u;
    }
    message->bytes[end] = (uint8_t)a;
    message->bytes[end + 1u] = (uint8_t)b;
}

keel_status_t keel_ubx_write_value(keel_ubx_message_t *message, uint32_t key, uint32_t value)
{
    const uint32_t told = (key / SIZE_PLACE) % SIZE_LIMIT;
    uint32_t size = 1u;

    if ((told < 1u) || (told > SIZE_FOUR)) {
        return KEEL_ERR_VALUE;
    }
    if (told == SIZE_TWO) {
        size = 2u;
    } else if (told == SIZE_FOUR) {
        size = 4u;
    } else {
        /* A bit, or a byte. */
    }
    write_header(message, CFG_VALSET, (uint8_t)(8u + size));
    message->bytes[AT_PAYLOAD + 1u] = LAYER_RAM;
    write_number(message, AT_PAYLOAD + 4u, key, 4u);
    write_number(message, AT_PAYLOAD + 8u, value, size);
    write_sums(message);
    return KEEL_OK;
}

void keel_ubx_write_output(keel_ubx_message_t *message, uint8_t group, uint8_t id, uint8_t every)
{
    write_header(message, CFG_MSG, 3u);
    message->bytes[AT_PAYLOAD] = group;
    message->bytes[AT_PAYLOAD + 1u] = id;
    message->bytes[AT_PAYLOAD + 2u] = every;
    write_sums(message);
}

void keel_ubx_write_rate(keel_ubx_message_t *message, uint16_t period_ms)
{
    write_header(message, CFG_RATE, 6u);
    write_number(message, AT_PAYLOAD, period_ms, 2u);
    message->bytes[AT_PAYLOAD + 2u] = EACH_SOLUTION;
    message->bytes[AT_PAYLOAD + 4u] = GPS_TIME;
    write_sums(message);
}

void keel_ubx_write_port(keel_ubx_message_t *message, uint32_t baud)
{
    write_header(message, CFG_PRT, 20u);
    message->bytes[AT_PAYLOAD] = UART_1;
    write_number(message, AT_PAYLOAD + 4u, MODE_8N1, 4u);
    write_number(message, AT_PAYLOAD + 8u, baud, 4u);
    message->bytes[AT_PAYLOAD + 12u] = ONLY_UBX;
    message->bytes[AT_PAYLOAD + 14u] = ONLY_UBX;
    write_sums(message);
}
