/* SPDX-License-Identifier: Apache-2.0 */
/* Everything is read and written byte by byte. */
#include "slots.h"

#include "crc.h"

#include <stddef.h>

/* SLT-001, SLT-002 */
keel_status_t model_slots_init(keel_slots_t *slots, const keel_slots_config_t *config)
{
    const uint64_t size = 13u + (uint64_t)config->room;
    const uint64_t end_0 = config->address[0] + size;
    const uint64_t end_1 = config->address[1] + size;
    const keel_slots_t closed = {.config = *config};

    if (config->medium.read == NULL) {
        return KEEL_ERR_NULL;
    }
    if (config->medium.write == NULL) {
        return KEEL_ERR_NULL;
    }
    if (config->room == 0u) {
        return KEEL_ERR_LIMITS;
    }
    if ((end_0 > UINT32_MAX) || (end_1 > UINT32_MAX)) {
        return KEEL_ERR_LIMITS;
    }
    if ((config->address[0] < end_1) && (config->address[1] < end_0)) {
        return KEEL_ERR_LIMITS;
    }
    *slots = closed;
    return KEEL_OK;
}

static uint8_t number_byte(uint32_t number, uint32_t index)
{
    return (uint8_t)((number >> (8u * index)) & 0xFFu);
}

static uint32_t number_at(const uint8_t *bytes)
{
    uint32_t number = 0u;

    for (uint32_t i = 0u; i < 4u; i++) {
        number += (uint32_t)bytes[i] << (8u * i);
    }
    return number;
}

/* SLT-010: what a slot holds: mark, number, length, bytes, the check of all but the mark. */
uint8_t model_slots_byte(uint32_t sequence, const uint8_t *image, uint32_t length, uint32_t at)
{
    uint32_t crc = 0xFFFFFFFFu;

    if (at == 0u) {
        return 0x4Bu;
    }
    if (at < 5u) {
        return number_byte(sequence, at - 1u);
    }
    if (at < 9u) {
        return number_byte(length, at - 5u);
    }
    if (at < (9u + length)) {
        return image[at - 9u];
    }
    for (uint32_t i = 1u; i < (9u + length); i++) {
        crc = model_crc32(crc, (i < 5u)   ? number_byte(sequence, i - 1u)
                               : (i < 9u) ? number_byte(length, i - 5u)
                                          : image[i - 9u]);
    }
    return number_byte(~crc, at - 9u - length);
}

/* SLT-003 */
bool model_slots_whole(const uint8_t *slot, uint32_t room)
{
    const uint32_t length = number_at(&slot[5]);
    uint32_t crc = 0xFFFFFFFFu;

    if ((slot[0] != 0x4Bu) || (length > room)) {
        return false;
    }
    for (uint32_t i = 1u; i < (9u + length); i++) {
        crc = model_crc32(crc, slot[i]);
    }
    return number_at(&slot[9u + length]) == (crc ^ 0xFFFFFFFFu);
}

static bool get_bytes(const keel_slots_t *slots, uint32_t index, uint32_t from, uint8_t *bytes,
                      uint32_t count)
{
    const keel_medium_t *const medium = &slots->config.medium;
    bool good = true;

    for (uint32_t i = 0u; i < count; i++) {
        const uint32_t at = slots->config.address[index] + from + i;

        if (good) {
            good = medium->read(medium->context, at, &bytes[i], 1u);
        }
    }
    return good;
}

static bool put_bytes(const keel_slots_t *slots, uint32_t index, uint32_t from,
                      const uint8_t *bytes, uint32_t count)
{
    const keel_medium_t *const medium = &slots->config.medium;
    bool good = true;

    for (uint32_t i = 0u; i < count; i++) {
        const uint32_t at = slots->config.address[index] + from + i;

        if (good) {
            good = medium->write(medium->context, at, &bytes[i], 1u);
        }
    }
    return good;
}

/* SLT-005: what the mark, the sequence number and the length say. */
static keel_slot_t head_of(const keel_slots_t *slots, uint32_t index)
{
    keel_slot_t slot = {KEEL_SLOT_EMPTY, 0u, 0u};
    uint8_t mark = 0u;
    uint8_t head[8] = {0u};

    if (!get_bytes(slots, index, 0u, &mark, 1u)) {
        slot.state = KEEL_SLOT_UNREADABLE;
    } else if (mark == 0x4Bu) {
        if (!get_bytes(slots, index, 1u, head, 8u)) {
            slot.state = KEEL_SLOT_UNREADABLE;
        } else {
            const bool fits = number_at(&head[4]) <= slots->config.room;

            slot.state = fits ? KEEL_SLOT_MARKED : KEEL_SLOT_DAMAGED;
            slot.sequence = number_at(head);
            slot.length = fits ? number_at(&head[4]) : 0u;
        }
    }
    return slot;
}

/* SLT-003: a set whose head is right, with its check. */
static void take_set(const keel_slots_t *slots, uint32_t index, keel_slot_t *slot, uint8_t *image)
{
    const uint32_t length = slot->length;
    uint8_t check[4] = {0u};
    uint32_t crc = 0xFFFFFFFFu;

    if (slot->state != KEEL_SLOT_MARKED) {
        return;
    }
    if (!get_bytes(slots, index, 9u, image, length) ||
        !get_bytes(slots, index, 9u + length, check, 4u)) {
        slot->state = KEEL_SLOT_UNREADABLE;
        slot->length = 0u;
        return;
    }
    for (uint32_t i = 0u; i < 4u; i++) {
        crc = model_crc32(crc, number_byte(slot->sequence, i));
    }
    for (uint32_t i = 0u; i < 4u; i++) {
        crc = model_crc32(crc, number_byte(length, i));
    }
    for (uint32_t i = 0u; i < length; i++) {
        crc = model_crc32(crc, image[i]);
    }
    if (number_at(check) == (crc ^ 0xFFFFFFFFu)) {
        slot->state = KEEL_SLOT_WHOLE;
    } else {
        slot->state = KEEL_SLOT_DAMAGED;
        slot->length = 0u;
    }
}

/* SLT-003, SLT-004, SLT-005: the newer one, or else the other. */
keel_slots_result_t model_slots_load(keel_slots_t *slots, uint8_t *image, uint32_t *length)
{
    keel_slot_t slot[2];
    uint32_t chosen = 0u;
    bool unreadable;

    for (uint32_t i = 0u; i < 2u; i++) {
        slot[i] = head_of(slots, i);
    }
    if (slot[1].state == KEEL_SLOT_MARKED) {
        if (slot[0].state != KEEL_SLOT_MARKED) {
            chosen = 1u;
        } else if (slot[0].sequence < slot[1].sequence) {
            chosen = 1u;
        } else {
            chosen = 0u;
        }
    }
    take_set(slots, chosen, &slot[chosen], image);
    if (slot[chosen].state != KEEL_SLOT_WHOLE) {
        chosen = (chosen == 0u) ? 1u : 0u;
        take_set(slots, chosen, &slot[chosen], image);
    }
    unreadable = (slot[0].state == KEEL_SLOT_UNREADABLE) || (slot[1].state == KEEL_SLOT_UNREADABLE);
    slots->slot[0] = slot[0];
    slots->slot[1] = slot[1];
    slots->newest = chosen;
    if (slot[chosen].state == KEEL_SLOT_WHOLE) {
        slots->sequence = slot[chosen].sequence;
        slots->stage = KEEL_SLOTS_READY;
        *length = slot[chosen].length;
        return KEEL_SLOTS_DONE;
    }
    slots->sequence = 0u;
    slots->stage = unreadable ? KEEL_SLOTS_CLOSED : KEEL_SLOTS_READY;
    return unreadable ? KEEL_SLOTS_READ : KEEL_SLOTS_NONE;
}

/* SLT-006 */
keel_status_t model_slots_begin(keel_slots_t *slots, const uint8_t *image, uint32_t length)
{
    if (slots->stage != KEEL_SLOTS_READY) {
        return KEEL_ERR_STATE;
    }
    if (slots->config.room < length) {
        return KEEL_ERR_LIMITS;
    }
    if (slots->sequence == 0xFFFFFFFFu) {
        return KEEL_ERR_FULL;
    }
    slots->stage = KEEL_SLOTS_CLEARING;
    slots->image = image;
    slots->length = length;
    slots->crc = 0xFFFFFFFFu;
    slots->at = 0u;
    return KEEL_OK;
}

/* A byte behind the mark; crc is of all bytes before the check. */
static uint8_t byte_behind_mark(const keel_slots_t *slots, uint32_t at, uint32_t crc)
{
    if (at < 4u) {
        return number_byte(slots->sequence + 1u, at);
    }
    if (at < 8u) {
        return number_byte(slots->length, at - 4u);
    }
    if (at < (8u + slots->length)) {
        return slots->image[at - 8u];
    }
    return number_byte(crc ^ 0xFFFFFFFFu, at - 8u - slots->length);
}

/* SLT-009, SLT-010: writes the mark, and reads whether it is the one that means a set. */
static keel_slots_result_t mark_is(const keel_slots_t *slots, bool written, bool wanted)
{
    uint8_t mark = 0u;

    if (!written) {
        return KEEL_SLOTS_WRITE;
    }
    if (!get_bytes(slots, 1u - slots->newest, 0u, &mark, 1u)) {
        return KEEL_SLOTS_READ;
    }
    return (wanted == (mark == 0x4Bu)) ? KEEL_SLOTS_BUSY : KEEL_SLOTS_VERIFY;
}

static keel_slots_result_t cleared(keel_slots_t *slots)
{
    const keel_medium_t *const medium = &slots->config.medium;
    const uint32_t other = 1u - slots->newest;
    const uint8_t zero = 0u;
    const bool written = (medium->erase != NULL)
                             ? medium->erase(medium->context, slots->config.address[other],
                                             slots->config.room + 13u)
                             : put_bytes(slots, other, 0u, &zero, 1u);
    const keel_slots_result_t result = mark_is(slots, written, false);

    if (result == KEEL_SLOTS_BUSY) {
        slots->stage = KEEL_SLOTS_WRITING;
        slots->crc = 0xFFFFFFFFu;
        slots->at = 0u;
    }
    return result;
}

static keel_slots_result_t written(keel_slots_t *slots, uint32_t count)
{
    uint8_t bytes[8] = {0u};

    for (uint32_t i = 0u; i < count; i++) {
        bytes[i] = byte_behind_mark(slots, slots->at + i, slots->crc);
        if ((slots->at + i) < (8u + slots->length)) {
            slots->crc = model_crc32(slots->crc, bytes[i]);
        }
    }
    return put_bytes(slots, 1u - slots->newest, slots->at + 1u, bytes, count) ? KEEL_SLOTS_BUSY
                                                                              : KEEL_SLOTS_WRITE;
}

static keel_slots_result_t compared(const keel_slots_t *slots, uint32_t count)
{
    uint8_t bytes[8] = {0u};

    if (!get_bytes(slots, 1u - slots->newest, slots->at + 1u, bytes, count)) {
        return KEEL_SLOTS_READ;
    }
    for (uint32_t i = 0u; i < count; i++) {
        if (bytes[i] != byte_behind_mark(slots, slots->at + i, slots->crc)) {
            return KEEL_SLOTS_VERIFY;
        }
    }
    return KEEL_SLOTS_BUSY;
}

static keel_slots_result_t marked(keel_slots_t *slots)
{
    const uint32_t other = 1u - slots->newest;
    const uint8_t mark = 0x4Bu;
    const bool done = put_bytes(slots, other, 0u, &mark, 1u);
    const keel_slots_result_t result = mark_is(slots, done, true);

    if (result != KEEL_SLOTS_BUSY) {
        return result;
    }
    slots->newest = other;
    slots->sequence = slots->sequence + 1u;
    return KEEL_SLOTS_DONE;
}

/* SLT-007 to SLT-011: one stage after the other, eight bytes a step, back to ready at the end. */
keel_slots_result_t model_slots_step(keel_slots_t *slots)
{
    const bool pieces = (slots->stage == KEEL_SLOTS_WRITING) ||
                        (slots->stage == KEEL_SLOTS_COMPARING);
    keel_slots_result_t result = KEEL_SLOTS_DONE;
    uint32_t body;
    uint32_t count;

    if ((slots->stage == KEEL_SLOTS_CLOSED) || (slots->stage == KEEL_SLOTS_READY)) {
        return KEEL_SLOTS_DONE;
    }
    body = 8u + slots->length + 4u;
    count = ((body - slots->at) > 8u) ? 8u : (body - slots->at);
    if (slots->stage == KEEL_SLOTS_CLEARING) {
        result = cleared(slots);
    } else if (slots->stage == KEEL_SLOTS_WRITING) {
        result = written(slots, count);
    } else if (slots->stage == KEEL_SLOTS_COMPARING) {
        result = compared(slots, count);
    } else {
        result = marked(slots);
    }
    if (result != KEEL_SLOTS_BUSY) {
        slots->stage = KEEL_SLOTS_READY;
    } else if (pieces) {
        slots->at += count;
        if (slots->at == body) {
            slots->at = 0u;
            slots->stage = (slots->stage == KEEL_SLOTS_WRITING) ? KEEL_SLOTS_COMPARING
                                                                : KEEL_SLOTS_MARKING;
        }
    }
    return result;
}
