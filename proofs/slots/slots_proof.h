/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file slots_proof.h
 * @brief What the harnesses of the slots share: a medium whose power may fail, arbitrary slots, and
 *        when two are the same.
 *
 * The check is any function of a value and a byte, or one that finds next to nothing: nothing that
 * is proved here rests on what a CRC finds.
 */
#ifndef SLOTS_PROOF_H
#define SLOTS_PROOF_H

#include "../../specs/model/slots.h"

#include <stdbool.h>
#include <stddef.h>

/* The longest set, and a slot with it: its bytes are written and compared in two pieces. */
#define ROOM   2u
#define SIZE   (ROOM + 13u)
#define MEMORY (2u * SIZE)

bool nondet_bool(void);
uint8_t nondet_u8(void);
uint32_t nondet_u32(void);
keel_slots_t nondet_slots(void);
keel_slots_config_t nondet_slots_config(void);
#ifdef SUM_AS_CHECK
#define CHECK(crc, byte) ((crc) ^ (byte))
#else
uint32_t __CPROVER_uninterpreted_check(uint32_t crc, uint8_t byte);
#define CHECK(crc, byte) __CPROVER_uninterpreted_check((crc), (byte))
#endif

/* For the code and for the model. */
uint32_t keel_crc32(uint32_t crc, uint8_t byte)
{
    return CHECK(crc, byte);
}

uint32_t model_crc32(uint32_t crc, uint8_t byte)
{
    return CHECK(crc, byte);
}

/* A memory. As long as there is power, what is written is there afterwards, unless `worn` says that
 * it is any byte; it may be told that it was written or not, either way. The byte that is being
 * written when the power fails is any, and so is the whole slot when it is erased then: but a set
 * it does not seem to hold, unless it is as it was. Afterwards nothing is written. */
static uint8_t memory[MEMORY];
static uint32_t power; /* How many bytes can still be written. */
static bool is_off;
static bool is_honest;          /* All that is written is there, and told so. */
static bool is_read[MEMORY];    /* Which bytes can be read, and which written, when it is not */
static bool is_written[MEMORY]; /* a question of power. */
static bool has_erase;

static void any_memory(void)
{
    for (uint32_t i = 0u; i < MEMORY; i++) {
        memory[i] = nondet_u8();
        is_read[i] = nondet_bool();
        is_written[i] = nondet_bool();
    }
    power = UINT32_MAX;
    is_off = false;
    is_honest = true;
    has_erase = nondet_bool();
}

static bool memory_read(void *context, uint32_t address, uint8_t *bytes, uint32_t count)
{
    bool good = true;

    (void)context;
    __CPROVER_assert((0u < count) && (count <= 8u) && (address <= (MEMORY - count)),
                     "SLT_011_read: 1 to 8 bytes of the slots are read");
    for (uint32_t i = 0u; i < count; i++) {
        good = good && is_read[address + i];
        bytes[i] = (is_off || !good) ? nondet_u8() : memory[address + i];
    }
    return is_off ? nondet_bool() : good;
}

/* Writes a byte as far as there is power. */
static void memory_change(uint32_t at, uint8_t byte)
{
    if (power > 0u) {
        power--;
        memory[at] = byte;
    } else if (!is_off) {
        is_off = true;
        memory[at] = nondet_u8();
    } else {
        /* Nothing is written any more. */
    }
}

static bool memory_write(void *context, uint32_t address, const uint8_t *bytes, uint32_t count)
{
    bool good = true;

    (void)context;
    __CPROVER_assert((0u < count) && (count <= 8u) && (address <= (MEMORY - count)),
                     "SLT_011_write: 1 to 8 bytes of the slots are written");
    for (uint32_t i = 0u; i < count; i++) {
        const uint8_t before = memory[address + i];
        const uint8_t byte = has_erase ? (before & bytes[i]) : bytes[i];

        good = good && is_written[address + i];
        if (good) {
            memory_change(address + i, is_honest ? byte : nondet_u8());
        }
    }
    return (is_honest && !is_off) ? good : nondet_bool();
}

/* Whether an erasure that went wrong seems to have left a set: by the ledger's A-41 it does not. */
static bool memory_erase(void *context, uint32_t address, uint32_t count)
{
    uint8_t before[SIZE];
    const bool right = is_honest && is_written[address];
    bool same = true;

    (void)context;
    __CPROVER_assert((count == SIZE) && ((address == 0u) || (address == SIZE)),
                     "SLT_011_erase: a slot is erased");
    for (uint32_t i = 0u; i < SIZE; i++) {
        before[i] = memory[address + i];
    }
    if (!is_off) {
        for (uint32_t i = 0u; i < SIZE; i++) {
            memory[address + i] = (right && (power > 0u)) ? 0xFFu : nondet_u8();
            same = same && (memory[address + i] == before[i]);
        }
        __CPROVER_assume(same || (memory[address] != 0x4Bu) ||
                         !model_slots_whole(&memory[address], ROOM));
    }
    is_off = is_off || (power == 0u);
    power = is_off ? 0u : (power - 1u);
    return (is_honest && !is_off) ? right : nondet_bool();
}

static keel_slots_config_t memory_config(void)
{
    const bool swapped = nondet_bool();
    const keel_slots_config_t config = {.medium = {.read = memory_read,
                                                   .write = memory_write,
                                                   .erase = has_erase ? memory_erase : NULL,
                                                   .context = NULL},
                                        .address = {swapped ? SIZE : 0u, swapped ? 0u : SIZE},
                                        .room = ROOM};

    return config;
}

/* slots_valid, of slots of this memory. */
static bool slots_valid_here(const keel_slots_t *s)
{
    const bool saving = (s->stage >= KEEL_SLOTS_CLEARING) && (s->stage <= KEEL_SLOTS_MARKING);
    const bool pieces = (s->stage == KEEL_SLOTS_WRITING) || (s->stage == KEEL_SLOTS_COMPARING);

    return (s->newest < 2u) && ((uint32_t)s->stage <= (uint32_t)KEEL_SLOTS_MARKING) &&
           (!saving || ((s->length <= s->config.room) && (s->at <= (s->length + 12u)) &&
                        (s->sequence < UINT32_MAX))) &&
           (!pieces || (s->at < (s->length + 12u)));
}

/* Any slots of this memory; their set, if they save one, is this. */
static keel_slots_t any_slots(const uint8_t *image)
{
    keel_slots_t slots = nondet_slots();

    slots.config = memory_config();
    slots.image = image;
    return slots;
}

static bool medium_same(const keel_medium_t *a, const keel_medium_t *b)
{
    return (a->read == b->read) && (a->write == b->write) && (a->erase == b->erase) &&
           (a->context == b->context);
}

static bool slots_config_same(const keel_slots_config_t *a, const keel_slots_config_t *b)
{
    return medium_same(&a->medium, &b->medium) && (a->address[0] == b->address[0]) &&
           (a->address[1] == b->address[1]) && (a->room == b->room);
}

static bool slot_same(const keel_slot_t *a, const keel_slot_t *b)
{
    return (a->state == b->state) && (a->sequence == b->sequence) && (a->length == b->length);
}

static bool slots_same(const keel_slots_t *a, const keel_slots_t *b)
{
    return slots_config_same(&a->config, &b->config) && slot_same(&a->slot[0], &b->slot[0]) &&
           slot_same(&a->slot[1], &b->slot[1]) && (a->stage == b->stage) &&
           (a->newest == b->newest) && (a->sequence == b->sequence) && (a->image == b->image) &&
           (a->length == b->length) && (a->at == b->at) && (a->crc == b->crc);
}

#endif
