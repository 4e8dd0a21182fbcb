/* SPDX-License-Identifier: Apache-2.0 */
#include "ubx.h"

/* UBX-001, UBX-002 */
keel_status_t model_ubx_init(keel_ubx_t *ubx, const keel_ubx_config_t *config)
{
    const keel_ubx_t fresh = {
        .config = *config, .age_us = UINT32_MAX, .quiet_us = UINT32_MAX, .step = 0u, .kind = 0u};

    if ((config->speed_accuracy < 1u) || (config->accuracy_mm < 1u)) {
        return KEEL_ERR_LIMITS;
    }
    if ((config->max_age_us < 1u) || (config->gap_us < 1u)) {
        return KEEL_ERR_AGE;
    }
    *ubx = fresh;
    return KEEL_OK;
}

/* What is counted and timed stays at its end (UBX-007, UBX-008). */
static uint32_t ubx_end(uint32_t a, uint32_t b)
{
    const uint64_t sum = (uint64_t)a + b;

    return (sum > UINT32_MAX) ? UINT32_MAX : (uint32_t)sum;
}

/* Numbers of a payload: the lowest byte first (UBX-005). */
static uint32_t number_at(const uint8_t *payload, uint32_t at)
{
    return (uint32_t)payload[at] | ((uint32_t)payload[at + 1u] << 8) |
           ((uint32_t)payload[at + 2u] << 16) | ((uint32_t)payload[at + 3u] << 24);
}

/* Two's complement. */
static int32_t whole_of(uint32_t number)
{
    const int64_t wide = (int64_t)number;

    return (int32_t)((wide >= 0x80000000) ? (wide - 0x100000000) : wide);
}

/* UBX-005, UBX-016: byte by byte, as the receiver's manual has it. */
keel_ubx_fix_t model_ubx_fix(const uint8_t *payload, uint32_t length)
{
    const keel_ubx_fix_t fix = {.tow_ms = number_at(payload, 0u),
                                .type = payload[20],
                                .is_ok = (payload[21] % 2u) == 1u,
                                .satellites = payload[23],
                                .longitude = whole_of(number_at(payload, 24u)),
                                .latitude = whole_of(number_at(payload, 28u)),
                                .height_mm = whole_of(number_at(payload, 36u)),
                                .accuracy_mm = number_at(payload, 40u),
                                .height_accuracy = number_at(payload, 44u),
                                .north = whole_of(number_at(payload, 48u)),
                                .east = whole_of(number_at(payload, 52u)),
                                .down = whole_of(number_at(payload, 56u)),
                                .speed_accuracy = number_at(payload, 68u),
                                .is_invalid = (length > 91u) && ((payload[78] % 2u) == 1u)};

    return fix;
}

/* UBX-012: a week has 604800 seconds. */
static bool time_moves(uint32_t from, uint32_t to)
{
    int64_t by = (int64_t)to - (int64_t)from;

    if ((from >= 604800000u) || (to >= 604800000u)) {
        return false;
    }
    if (by < 0) {
        by += 604800000;
    }
    return (by > 0) && (by < 302400000);
}

/* UBX-004: both sums, of one byte more. */
static void sum_with(keel_ubx_t *ubx, uint8_t byte)
{
    ubx->sum_a = (uint8_t)((ubx->sum_a + byte) & 0xFF);
    ubx->sum_b = (uint8_t)((ubx->sum_b + ubx->sum_a) & 0xFF);
}

/* UBX-005: what ends with this byte of the payload, from the last four. */
static void put_field(keel_ubx_t *ubx, uint32_t at)
{
    keel_ubx_fix_t *const to = &ubx->pending;
    const uint32_t number = (uint32_t)((ubx->window >> 16) & UINT32_MAX);

    if (at == 3u) {
        to->tow_ms = number;
    }
    if (at == 23u) { /* Bytes 20, 21 and 23. */
        to->type = (uint8_t)(number % 256u);
        to->is_ok = (number & 0x100u) != 0u;
        to->satellites = (uint8_t)((number & 0xFF000000u) >> 24);
    }
    if (at == 27u) {
        to->longitude = whole_of(number);
    }
    if (at == 31u) {
        to->latitude = whole_of(number);
    }
    if (at == 39u) {
        to->height_mm = whole_of(number);
    }
    if (at == 43u) {
        to->accuracy_mm = number;
    }
    if (at == 47u) {
        to->height_accuracy = number;
    }
    if (at == 51u) {
        to->north = whole_of(number);
    }
    if (at == 55u) {
        to->east = whole_of(number);
    }
    if (at == 59u) {
        to->down = whole_of(number);
    }
    if (at == 71u) {
        to->speed_accuracy = number;
    }
    if (at == 79u) { /* Byte 78; reserved in protocol 14 (UBX-016). */
        to->is_invalid = (ubx->length > 91u) && ((number & 0x10000u) != 0u);
    }
}

/* UBX-004, UBX-007: a message whose checksum is right. */
static bool end_message(keel_ubx_t *ubx)
{
    uint32_t *const counts[4] = {&ubx->count.others, &ubx->count.fixes, &ubx->count.acks,
                                 &ubx->count.naks};
    uint32_t *const count = counts[(ubx->kind < 4u) ? ubx->kind : 0u];

    if (ubx->kind == 1u) {
        ubx->is_advancing = (*count != 0u) && time_moves(ubx->fix.tow_ms, ubx->pending.tow_ms);
        ubx->fix = ubx->pending;
        ubx->age_us = 0u;
    }
    *count = ubx_end(*count, 1u);
    ubx->window = 0u;
    return ubx->kind == 1u;
}

/* UBX-010, UBX-011, UBX-016: the window holds a header: sync, sync, class, id, length. */
static void start_message(keel_ubx_t *ubx)
{
    const uint32_t group = (uint32_t)((ubx->window >> 16) & 0xFFu);
    const uint32_t id = (uint32_t)((ubx->window >> 24) & 0xFFu);
    const uint32_t length = (uint32_t)((ubx->window >> 32) & 0xFFFFu);

    if (ubx->step > 0u) {
        ubx->count.cut = ubx_end(ubx->count.cut, 1u);
    }
    ubx->kind = 0u;
    if ((group == 1u) && (id == 7u) && (length > 83u)) {
        ubx->kind = 1u;
    }
    if ((group == 5u) && (id < 2u) && (length == 2u)) {
        ubx->kind = (id == 1u) ? 2u : 3u;
    }
    ubx->length = (uint16_t)length;
    ubx->left = (uint16_t)length;
    ubx->step = (length == 0u) ? 2u : 1u;
    ubx->sum_a = 0u;
    ubx->sum_b = 0u;
    sum_with(ubx, (uint8_t)group);
    sum_with(ubx, (uint8_t)id);
    sum_with(ubx, (uint8_t)(length & 0xFFu));
    sum_with(ubx, (uint8_t)(length >> 8));
}

/* UBX-004: a byte of the checksum is compared; whether the second one is right, too. */
static bool compare(keel_ubx_t *ubx, uint8_t byte)
{
    const bool second = ubx->step == 3u;
    const bool same = byte == (second ? ubx->sum_b : ubx->sum_a);

    ubx->step = (same && !second) ? 3u : 0u;
    ubx->count.checksums = ubx_end(ubx->count.checksums, same ? 0u : 1u);
    return same && second;
}

/* UBX-004, UBX-011 */
static bool add_byte(keel_ubx_t *ubx, uint8_t byte)
{
    if (ubx->step == 0u) {
        return false;
    }
    if (ubx->step > 1u) {
        return compare(ubx, byte) && end_message(ubx);
    }
    sum_with(ubx, byte);
    if (ubx->kind == 1u) {
        put_field(ubx, (uint32_t)ubx->length - ubx->left);
    }
    ubx->left = (uint16_t)(ubx->left - 1u);
    ubx->step = (ubx->left == 0u) ? 2u : 1u;
    return false;
}

/* UBX-008 */
void model_ubx_pass_time(keel_ubx_t *ubx, uint32_t elapsed_us)
{
    ubx->age_us = ubx_end(ubx->age_us, elapsed_us);
    ubx->quiet_us = ubx_end(ubx->quiet_us, elapsed_us);
}

bool model_ubx_take(keel_ubx_t *ubx, uint8_t byte, uint32_t elapsed_us)
{
    bool is_fix;

    model_ubx_pass_time(ubx, elapsed_us);
    ubx->count.bytes = ubx_end(ubx->count.bytes, 1u);
    if (ubx->quiet_us > ubx->config.gap_us) { /* UBX-009 */
        ubx->count.cut = ubx_end(ubx->count.cut, (ubx->step > 0u) ? 1u : 0u);
        ubx->step = 0u;
        ubx->window = 0u;
    }
    ubx->quiet_us = 0u;
    ubx->window = (ubx->window >> 8) | ((uint64_t)byte << 40);
    is_fix = add_byte(ubx, byte);
    if (ubx->window == 0x005C070162B5u) { /* UBX-010: B5 62 01 07 5C 00 */
        start_message(ubx);
    } else if (ubx->window == 0x0054070162B5u) { /* B5 62 01 07 54 00 */
        start_message(ubx);
    } else if ((ubx->step == 0u) && ((ubx->window & 0xFFFFu) == 0x62B5u)) {
        start_message(ubx);
    } else {
        /* Nothing begins. */
    }
    return is_fix;
}

/* UBX-013: the last reason first, so that the first one stays. */
keel_ubx_verdict_t model_ubx_judge(const keel_ubx_t *ubx)
{
    keel_ubx_verdict_t verdict = KEEL_UBX_USABLE;

    verdict = ubx->is_advancing ? verdict : KEEL_UBX_STUCK;
    verdict = (ubx->fix.speed_accuracy > ubx->config.speed_accuracy) ? KEEL_UBX_WIDE_SPEED
                                                                     : verdict;
    verdict = (ubx->fix.accuracy_mm > ubx->config.accuracy_mm) ? KEEL_UBX_WIDE : verdict;
    verdict = ubx->fix.is_invalid ? KEEL_UBX_INVALID : verdict;
    verdict = (ubx->fix.type == 3u) ? verdict : KEEL_UBX_NOT_3D;
    verdict = ubx->fix.is_ok ? verdict : KEEL_UBX_NOT_OK;
    verdict = (ubx->age_us > ubx->config.max_age_us) ? KEEL_UBX_OLD : verdict;
    return (ubx->count.fixes == 0u) ? KEEL_UBX_NONE : verdict;
}

/* UBX-014, UBX-015: sync, CFG, id, length, what is said, both sums. */
static void write_cfg(keel_ubx_message_t *message, uint8_t id, const uint8_t *says, uint32_t length)
{
    const uint8_t head[6] = {0xB5u, 0x62u, 0x06u, id, (uint8_t)length, 0u};
    uint32_t a = 0u;
    uint32_t b = 0u;

    for (uint32_t i = 0u; i < 28u; i++) {
        uint8_t byte = 0u;

        if (i < 6u) {
            byte = head[i];
        } else if (i < (6u + length)) {
            byte = says[i - 6u];
        } else if (i == (6u + length)) {
            byte = (uint8_t)(a & 0xFFu);
        }
        if (i == (7u + length)) {
            byte = (uint8_t)(b & 0xFFu);
        }
        message->bytes[i] = byte;
        if ((i >= 2u) && (i < (6u + length))) {
            a += byte;
            b += a;
        }
    }
    message->size = (uint8_t)(8u + length);
}

keel_status_t model_ubx_write_value(keel_ubx_message_t *message, uint32_t key, uint32_t value)
{
    static const uint32_t sizes[8] = {0u, 1u, 1u, 2u, 4u, 0u, 0u, 0u};
    const uint32_t size = sizes[(key / 0x10000000u) % 8u];
    const uint8_t says[12] = {0u,
                              1u,
                              0u,
                              0u,
                              (uint8_t)(key & 0xFFu),
                              (uint8_t)((key >> 8) & 0xFFu),
                              (uint8_t)((key >> 16) & 0xFFu),
                              (uint8_t)(key >> 24),
                              (uint8_t)(value & 0xFFu),
                              (uint8_t)((value >> 8) & 0xFFu),
                              (uint8_t)((value >> 16) & 0xFFu),
                              (uint8_t)(value >> 24)};

    if (size == 0u) {
        return KEEL_ERR_VALUE;
    }
    write_cfg(message, 0x8Au, says, 8u + size);
    return KEEL_OK;
}

void model_ubx_write_output(keel_ubx_message_t *message, uint8_t group, uint8_t id, uint8_t every)
{
    const uint8_t says[3] = {group, id, every};

    write_cfg(message, 0x01u, says, 3u);
}

void model_ubx_write_rate(keel_ubx_message_t *message, uint16_t period_ms)
{
    const uint8_t says[6] = {
        (uint8_t)(period_ms & 0xFFu), (uint8_t)(period_ms >> 8), 1u, 0u, 1u, 0u};

    write_cfg(message, 0x08u, says, 6u);
}

void model_ubx_write_port(keel_ubx_message_t *message, uint32_t baud)
{
    const uint8_t says[20] = {1u,
                              0u,
                              0u,
                              0u,
                              0xD0u,
                              0x08u,
                              0u,
                              0u,
                              (uint8_t)(baud & 0xFFu),
                              (uint8_t)((baud >> 8) & 0xFFu),
                              (uint8_t)((baud >> 16) & 0xFFu),
                              (uint8_t)(baud >> 24),
                              1u,
                              0u,
                              1u,
                              0u,
                              0u,
                              0u,
                              0u,
                              0u};

    write_cfg(message, 0x00u, says, 20u);
}
