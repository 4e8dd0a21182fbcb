/* SPDX-License-Identifier: Apache-2.0 */
#include "common/slots.h"

#include "keel/middleware/crc.h"

#include <stddef.h>

#define BYTES_OF_NUMBER 4u

#define HEAD_BYTES  ((uint32_t)KEEL_SLOTS_HEAD)
#define CHECK_BYTES ((uint32_t)KEEL_SLOTS_CHECK)
#define PIECE_BYTES ((uint32_t)KEEL_SLOTS_PIECE)

/* A byte of a number, the lowest first. */
static uint8_t byte_of(uint32_t number, uint32_t index)
{
    return (uint8_t)((number >> (8u * index)) & 0xFFu);
}

static uint32_t number_of(const uint8_t *bytes)
{
    return bytes[0] + (256u * bytes[1]) + (65536u * bytes[2]) + (16777216u * bytes[3]);
}

/* How many of the bytes that are left make the next piece. */
static uint32_t piece_of(uint32_t left)
{
    return (left < PIECE_BYTES) ? left : PIECE_BYTES;
}

static bool read_slot(const keel_slots_t *slots, uint32_t index, uint32_t offset, uint8_t *bytes,
                      uint32_t count)
{
    const keel_medium_t *const medium = &slots->config.medium;

    return medium->read(medium->context, slots->config.address[index] + offset, bytes, count);
}

/* Writes the slot that is not the newest: there is no other that could be written. */
static bool write_slot(const keel_slots_t *slots, uint32_t offset, const uint8_t *bytes,
                       uint32_t count)
{
    const keel_medium_t *const medium = &slots->config.medium;
    const uint32_t target = 1u - slots->newest;

    return medium->write(medium->context, slots->config.address[target] + offset, bytes, count);
}

/* A slot of which nothing is known. */
static void forget_slot(keel_slot_t *slot)
{
    slot->state = KEEL_SLOT_EMPTY;
    slot->sequence = 0u;
    slot->length = 0u;
}

/* What a slot's mark, sequence number and length say; the state that it has then. */
static void read_head(keel_slots_t *slots, uint32_t index)
{
    keel_slot_t *const slot = &slots->slot[index];
    uint8_t mark = 0u;
    uint8_t head[KEEL_SLOTS_HEAD] = {[0] = 0u};

    forget_slot(slot);
    if (!read_slot(slots, index, 0u, &mark, 1u)) {
        slot->state = KEEL_SLOT_UNREADABLE;
    } else if (mark != (uint8_t)KEEL_SLOTS_MARK) {
        slot->state = KEEL_SLOT_EMPTY;
    } else if (!read_slot(slots, index, 1u, head, HEAD_BYTES)) {
        slot->state = KEEL_SLOT_UNREADABLE;
    } else {
        const uint32_t length = number_of(&head[BYTES_OF_NUMBER]);
        const bool fits = length <= slots->config.room;

        slot->state = fits ? KEEL_SLOT_MARKED : KEEL_SLOT_DAMAGED;
        slot->sequence = number_of(head);
        slot->length = fits ? length : 0u;
    }
}

static uint32_t crc_of_bytes(uint32_t first, const uint8_t *bytes, uint32_t count)
{
    uint32_t crc = first;

    for (uint32_t i = 0u; i < count; i++) {
        crc = keel_crc32(crc, bytes[i]);
    }
    return crc;
}

static uint32_t crc_of_number(uint32_t first, uint32_t number)
{
    uint32_t crc = first;

    for (uint32_t i = 0u; i < BYTES_OF_NUMBER; i++) {
        crc = keel_crc32(crc, byte_of(number, i));
    }
    return crc;
}

/* Reads the set of a slot whose head is right; the state that the slot has then. */
static keel_slot_state_t read_set(const keel_slots_t *slots, uint32_t index, uint8_t *image)
{
    const uint32_t length = slots->slot[index].length;
    uint8_t check[KEEL_SLOTS_CHECK] = {[0] = 0u};
    uint32_t crc = crc_of_number(KEEL_CRC32_FIRST, slots->slot[index].sequence);
    uint32_t at = 0u;

    crc = crc_of_number(crc, length);
    while (at < length) {
        const uint32_t count = piece_of(length - at);

        if (!read_slot(slots, index, 1u + HEAD_BYTES + at, &image[at], count)) {
            return KEEL_SLOT_UNREADABLE;
        }
        crc = crc_of_bytes(crc, &image[at], count);
        at += count;
    }
    if (!read_slot(slots, index, 1u + HEAD_BYTES + length, check, CHECK_BYTES)) {
        return KEEL_SLOT_UNREADABLE;
    }
    return (number_of(check) == ~crc) ? KEEL_SLOT_WHOLE : KEEL_SLOT_DAMAGED;
}

/* Reads the set of a slot, if its head says that there is one; whether it is whole. */
static bool load_slot(keel_slots_t *slots, uint32_t index, uint8_t *image)
{
    keel_slot_t *const slot = &slots->slot[index];

    if (slot->state == KEEL_SLOT_MARKED) {
        slot->state = read_set(slots, index, image);
        slot->length = (slot->state == KEEL_SLOT_WHOLE) ? slot->length : 0u;
    }
    return slot->state == KEEL_SLOT_WHOLE;
}

/* Whether the set of the second slot is the newer one, or the only one. */
static bool is_second_newer(const keel_slots_t *slots)
{
    const keel_slot_t *const slot = slots->slot;

    return (slot[1].state == KEEL_SLOT_MARKED) &&
           ((slot[0].state != KEEL_SLOT_MARKED) || (slot[1].sequence > slot[0].sequence));
}

/* Loads the set of a slot, or else that of the other one; whether one of them is whole. */
static bool load_either(keel_slots_t *slots, uint32_t first, uint8_t *image)
{
    bool whole = load_slot(slots, first, image);

    slots->newest = first;
    if (!whole) {
        slots->newest = 1u - first;
        whole = load_slot(slots, 1u - first, image);
    }
    return whole;
}

/* A byte behind the mark of what is being saved. */
static uint8_t byte_to_save(const keel_slots_t *slots, uint32_t at)
{
    const uint32_t end = HEAD_BYTES + slots->length;
    uint8_t byte;

    if (at < BYTES_OF_NUMBER) {
        byte = byte_of(slots->sequence + 1u, at);
    } else if (at < HEAD_BYTES) {
        byte = byte_of(slots->length, at - BYTES_OF_NUMBER);
    } else if (at < end) {
        byte = slots->image[at - HEAD_BYTES];
    } else {
        byte = byte_of(~slots->crc, at - end);
    }
    return byte;
}

/* How many bytes there are behind the mark. */
static uint32_t bytes_to_save(const keel_slots_t *slots)
{
    return HEAD_BYTES + slots->length + CHECK_BYTES;
}

/* Goes on behind a piece, and behind the last one with the next stage. */
static void go_on_saving(keel_slots_t *slots, uint32_t count, keel_slots_stage_t next)
{
    const uint32_t end = bytes_to_save(slots);

    slots->at += count;
    if (slots->at == end) {
        slots->at = 0u;
        slots->stage = next;
    }
}

static keel_slots_result_t write_piece(keel_slots_t *slots)
{
    uint8_t piece[KEEL_SLOTS_PIECE] = {[0] = 0u};
    const uint32_t count = piece_of(bytes_to_save(slots) - slots->at);

    for (uint32_t i = 0u; i < count; i++) {
        piece[i] = byte_to_save(slots, slots->at + i);
        if ((slots->at + i) < (HEAD_BYTES + slots->length)) {
            slots->crc = keel_crc32(slots->crc, piece[i]);
        }
    }
    if (!write_slot(slots, 1u + slots->at, piece, count)) {
        return KEEL_SLOTS_WRITE;
    }
    go_on_saving(slots, count, KEEL_SLOTS_COMPARING);
    return KEEL_SLOTS_BUSY;
}

static keel_slots_result_t compare_piece(keel_slots_t *slots)
{
    uint8_t piece[KEEL_SLOTS_PIECE] = {[0] = 0u};
    const uint32_t count = piece_of(bytes_to_save(slots) - slots->at);
    bool same = true;

    if (!read_slot(slots, 1u - slots->newest, 1u + slots->at, piece, count)) {
        return KEEL_SLOTS_READ;
    }
    for (uint32_t i = 0u; i < count; i++) {
        same = same && (piece[i] == byte_to_save(slots, slots->at + i));
    }
    if (!same) {
        return KEEL_SLOTS_VERIFY;
    }
    go_on_saving(slots, count, KEEL_SLOTS_MARKING);
    return KEEL_SLOTS_BUSY;
}

/* What the mark reads after it was to be written or erased. */
static keel_slots_result_t confirm_mark(const keel_slots_t *slots, bool is_set)
{
    uint8_t mark = 0u;
    bool is_marked;

    if (!read_slot(slots, 1u - slots->newest, 0u, &mark, 1u)) {
        return KEEL_SLOTS_READ;
    }
    is_marked = mark == (uint8_t)KEEL_SLOTS_MARK;
    return (is_marked == is_set) ? KEEL_SLOTS_BUSY : KEEL_SLOTS_VERIFY;
}

static bool clear_slot(const keel_slots_t *slots)
{
    static const uint8_t cleared = KEEL_SLOTS_CLEARED;
    const keel_medium_t *const medium = &slots->config.medium;

    if (medium->erase == NULL) {
        return write_slot(slots, 0u, &cleared, 1u);
    }
    return medium->erase(medium->context, slots->config.address[1u - slots->newest],
                         (uint32_t)KEEL_SLOTS_OVERHEAD + slots->config.room);
}

static keel_slots_result_t begin_to_write(keel_slots_t *slots)
{
    keel_slots_result_t result = KEEL_SLOTS_WRITE;

    if (clear_slot(slots)) {
        result = confirm_mark(slots, false);
    }
    if (result == KEEL_SLOTS_BUSY) {
        slots->stage = KEEL_SLOTS_WRITING;
        slots->at = 0u;
        slots->crc = KEEL_CRC32_FIRST;
    }
    return result;
}

static keel_slots_result_t set_mark(keel_slots_t *slots)
{
    static const uint8_t mark = KEEL_SLOTS_MARK;
    keel_slots_result_t result = KEEL_SLOTS_WRITE;

    if (write_slot(slots, 0u, &mark, 1u)) {
        result = confirm_mark(slots, true);
    }
    if (result == KEEL_SLOTS_BUSY) {
        slots->newest = 1u - slots->newest;
        slots->sequence++;
        result = KEEL_SLOTS_DONE;
    }
    return result;
}

/* From an address to the end of a slot there: whether both are addresses. */
static bool slot_fits(uint32_t address, uint32_t room)
{
    return (room <= (UINT32_MAX - (uint32_t)KEEL_SLOTS_OVERHEAD)) &&
           (address <= (UINT32_MAX - (uint32_t)KEEL_SLOTS_OVERHEAD - room));
}

keel_status_t keel_slots_init(keel_slots_t *slots, const keel_slots_config_t *config)
{
    uint32_t size;

    if ((config->medium.read == NULL) || (config->medium.write == NULL)) {
        return KEEL_ERR_NULL;
    }
    if ((config->room == 0u) || !slot_fits(config->address[0], config->room) ||
        !slot_fits(config->address[1], config->room)) {
        return KEEL_ERR_LIMITS;
    }
    size = (uint32_t)KEEL_SLOTS_OVERHEAD + config->room;
    if (((config->address[0] + size) > config->address[1]) &&
        ((config->address[1] + size) > config->address[0])) {
        return KEEL_ERR_LIMITS;
    }
    slots->config.medium.read = config->medium.read;
    slots->config.medium.write = config->medium.write;
    slots->config.medium.erase = config->medium.erase;
    slots->config.medium.context = config->medium.context;
    slots->config.address[0] = config->address[0];
    slots->config.address[1] = config->address[1];
    slots->config.room = config->room;
    forget_slot(&slots->slot[0]);
    forget_slot(&slots->slot[1]);
    slots->stage = KEEL_SLOTS_CLOSED;
    slots->newest = 0u;
    slots->sequence = 0u;
    slots->image = NULL;
    slots->length = 0u;
    slots->at = 0u;
    slots->crc = 0u;
    return KEEL_OK;
}

keel_slots_result_t keel_slots_load(keel_slots_t *slots, uint8_t *image, uint32_t *length)
{
    keel_slots_result_t result = KEEL_SLOTS_NONE;
    bool whole = false;

    slots->stage = KEEL_SLOTS_CLOSED;
    read_head(slots, 0u);
    read_head(slots, 1u);
    if (is_second_newer(slots)) {
        whole = load_either(slots, 1u, image);
    } else {
        whole = load_either(slots, 0u, image);
    }
    slots->sequence = whole ? slots->slot[slots->newest].sequence : 0u;
    if (whole) {
        *length = slots->slot[slots->newest].length;
        result = KEEL_SLOTS_DONE;
    } else if ((slots->slot[0].state == KEEL_SLOT_UNREADABLE) ||
               (slots->slot[1].state == KEEL_SLOT_UNREADABLE)) {
        result = KEEL_SLOTS_READ;
    } else {
        result = KEEL_SLOTS_NONE;
    }
    slots->stage = (result == KEEL_SLOTS_READ) ? KEEL_SLOTS_CLOSED : KEEL_SLOTS_READY;
    return result;
}

keel_status_t keel_slots_begin(keel_slots_t *slots, const uint8_t *image, uint32_t length)
{
    if (slots->stage != KEEL_SLOTS_READY) {
        return KEEL_ERR_STATE;
    }
    if (length > slots->config.room) {
        return KEEL_ERR_LIMITS;
    }
    if (slots->sequence == UINT32_MAX) {
        return KEEL_ERR_FULL;
    }
    slots->image = image;
    slots->length = length;
    slots->at = 0u;
    slots->crc = KEEL_CRC32_FIRST;
    slots->stage = KEEL_SLOTS_CLEARING;
    return KEEL_OK;
}

keel_slots_result_t keel_slots_step(keel_slots_t *slots)
{
    keel_slots_result_t result = KEEL_SLOTS_DONE;

    switch (slots->stage) {
    case KEEL_SLOTS_CLEARING:
        result = begin_to_write(slots);
        break;
    case KEEL_SLOTS_WRITING:
        result = write_piece(slots);
        break;
    case KEEL_SLOTS_COMPARING:
        result = compare_piece(slots);
        break;
    case KEEL_SLOTS_MARKING:
        result = set_mark(slots);
        break;
    default:
        return KEEL_SLOTS_DONE;
    }
    if (result != KEEL_SLOTS_BUSY) {
        slots->stage = KEEL_SLOTS_READY;
    }
    return result;
}
