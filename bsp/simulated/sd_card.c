/* SPDX-License-Identifier: Apache-2.0 */
#include "simulated/sd_card.h"

#include <string.h>

/* By the SD Physical Layer Simplified Specification, 4.7.4, 4.8 and 4.10.1. */
#define ILLEGAL       (1u << 22)
#define OUT_OF_RANGE  (1u << 31)
#define FAILED        (1u << 19)
#define READY         (1u << 8)
#define APPLICATION   (1u << 5)
#define IS_READY      (1u << 31)
#define IS_HIGH       (1u << 30)
#define ECHO          0xFFFu
#define IDENTIFIED    0x0500u
#define UNIT_SECTORS  1024u
#define SIZE_AT       16u
#define ADDRESS_AT    16u
#define STATE_AT      9u
#define STANDARD_UNIT 512u

void simulated_sd_init(simulated_sd_t *card, uint8_t *bytes, uint32_t sectors)
{
    const uint32_t size = (sectors / UNIT_SECTORS) - 1u;

    memset(card, 0, sizeof *card);
    card->bytes = bytes;
    card->sectors = sectors;
    /* Of a card on the market, but for C_SIZE: CSD 2.0, 25 MHz, blocks of 512. */
    card->csd[0] = 0x400E0032u;
    card->csd[1] = 0x5B590000u | (size >> SIZE_AT);
    card->csd[2] = (size << SIZE_AT) | 0x7F80u;
    card->csd[3] = 0x0A400001u;
    card->conditions = 0x00FF8000u | IS_HIGH;
    card->address = 0xB368u;
    card->is_high_capacity = true;
    card->pattern = 0x1AAu;
    card->ready_after = 3u;
    card->fails_programming = SIMULATED_SD_NEVER;
    card->damages_command = SIMULATED_SD_NEVER;
    card->loses_command = SIMULATED_SD_NEVER;
    card->fails_block = SIMULATED_SD_NEVER;
    card->state = SIMULATED_SD_TRANSFER; /* As a program before it may have left it. */
    card->given_address = 0x7777u;
    card->block_length = STANDARD_UNIT;
}

void simulated_sd_make_standard(simulated_sd_t *card)
{
    /* (C_SIZE + 1) * 2^(C_SIZE_MULT + 2) blocks of 2^READ_BL_LEN: here with 7 and 9. */
    const uint32_t size = (card->sectors / STANDARD_UNIT) - 1u;

    card->csd[0] = 0x00260032u;
    card->csd[1] = 0x5F590000u | (size >> 2);
    card->csd[2] = (size << 30) | (7u << 15);
    card->conditions &= ~IS_HIGH;
    card->is_high_capacity = false;
    card->block_length = 0u;
}

static uint32_t take_status(simulated_sd_t *card)
{
    const uint32_t ready = (card->state == SIMULATED_SD_TRANSFER) ? READY : 0u;
    const uint32_t word = card->errors | ((uint32_t)card->state << STATE_AT) | ready;

    card->errors = 0u;
    return word;
}

/* A command that is not for the card as it is: it does not answer, and tells so with the next. */
static keel_bsp_status_t refuse(simulated_sd_t *card)
{
    card->errors |= ILLEGAL;
    return KEEL_BSP_TIMEOUT;
}

static keel_bsp_status_t move(simulated_sd_t *card, bool allowed, simulated_sd_state_t next,
                              uint32_t *answer)
{
    if (!allowed) {
        return refuse(card);
    }
    *answer = take_status(card); /* Tells the state that it comes from. */
    card->state = next;
    return KEEL_BSP_OK;
}

static keel_bsp_status_t take_condition(simulated_sd_t *card, uint32_t argument, uint32_t *answer)
{
    if (card->is_version_1 || (card->state != SIMULATED_SD_IDLE)) {
        return refuse(card);
    }
    *answer = (argument & ~ECHO) | card->pattern;
    return KEEL_BSP_OK;
}

/* A card of high capacity stays unready for a host that does not say that it knows these. */
static keel_bsp_status_t take_question(simulated_sd_t *card, uint32_t argument, uint32_t *answer)
{
    const bool suits = !card->is_high_capacity || ((argument & IS_HIGH) != 0u);

    if (card->state != SIMULATED_SD_IDLE) {
        return refuse(card);
    }
    card->questions++;
    *answer = card->conditions & ~IS_HIGH;
    if (suits && (card->questions > card->ready_after)) {
        *answer = card->conditions | IS_READY;
        card->state = SIMULATED_SD_READY;
    }
    return KEEL_BSP_OK;
}

static keel_bsp_status_t take_transfer(simulated_sd_t *card, const keel_sd_command_t *command,
                                       uint32_t *answer)
{
    const bool is_write = (command->index == 24u) || (command->index == 25u);
    const uint32_t unit = card->is_high_capacity ? 1u : STANDARD_UNIT;

    if (card->state != SIMULATED_SD_TRANSFER) {
        return refuse(card);
    }
    card->is_single = (command->index == 17u) || (command->index == 24u);
    card->at = command->argument / unit;
    if (((command->argument % unit) != 0u) || (card->at >= card->sectors)) {
        card->errors |= OUT_OF_RANGE;
        *answer = take_status(card);
        return KEEL_BSP_OK;
    }
    card->writes += is_write ? 1u : 0u;
    return move(card, true, is_write ? SIMULATED_SD_RECEIVING : SIMULATED_SD_SENDING, answer);
}

static void program(simulated_sd_t *card)
{
    card->state = SIMULATED_SD_PROGRAMMING;
    card->busy_left = card->busy_looks;
}

static keel_bsp_status_t take_stop(simulated_sd_t *card, uint32_t *answer)
{
    const simulated_sd_state_t state = card->state;
    const bool is_last = (card->at == card->sectors);
    const bool allowed = (state == SIMULATED_SD_SENDING) || (state == SIMULATED_SD_RECEIVING);

    if (allowed && is_last) {
        card->errors |= OUT_OF_RANGE; /* It had looked ahead. */
    }
    if (allowed && (state == SIMULATED_SD_RECEIVING)) {
        *answer = take_status(card);
        program(card);
        return KEEL_BSP_OK;
    }
    return move(card, allowed, SIMULATED_SD_TRANSFER, answer);
}

/* A look: what is programmed ends some looks later. */
static keel_bsp_status_t take_look(simulated_sd_t *card, uint32_t *answer)
{
    if (card->state < SIMULATED_SD_STANDBY) {
        return refuse(card);
    }
    if (card->state == SIMULATED_SD_PROGRAMMING) {
        if (card->busy_left == 0u) {
            card->state = SIMULATED_SD_TRANSFER;
            card->errors |= (card->writes == card->fails_programming) ? FAILED : 0u;
        } else {
            card->busy_left--;
        }
    }
    *answer = take_status(card);
    return KEEL_BSP_OK;
}

static keel_bsp_status_t take_address(simulated_sd_t *card, uint32_t *answer)
{
    if (card->state != SIMULATED_SD_IDENTIFY) {
        return refuse(card);
    }
    card->state = SIMULATED_SD_STANDBY;
    card->given_address = card->address;
    *answer = (card->address << ADDRESS_AT) | IDENTIFIED; /* And some of its status. */
    return KEEL_BSP_OK;
}

static keel_bsp_status_t take_application(simulated_sd_t *card, const keel_sd_command_t *command,
                                          uint32_t *answer)
{
    if (command->index == 41u) {
        return take_question(card, command->argument, answer);
    }
    if ((command->index == 6u) && (card->state == SIMULATED_SD_TRANSFER)) {
        card->is_selected_wide = (command->argument == 2u);
        *answer = take_status(card);
        return KEEL_BSP_OK;
    }
    return refuse(card);
}

static void go_idle(simulated_sd_t *card)
{
    card->state = SIMULATED_SD_IDLE;
    card->given_address = 0u;
    card->is_selected_wide = false;
    card->errors = 0u;
    card->questions = 0u;
}

/* Commands that name a card are for this one only with its address. */
static bool is_called(const simulated_sd_t *card, const keel_sd_command_t *command)
{
    const bool names = (command->index == 7u) || (command->index == 9u) ||
                       (command->index == 13u) || (command->index == 55u);

    return !names || ((command->argument >> ADDRESS_AT) == card->given_address);
}

static keel_bsp_status_t take_plain(simulated_sd_t *card, const keel_sd_command_t *command,
                                    uint32_t *answer)
{
    switch (command->index) {
    case 0u:
        go_idle(card);
        return KEEL_BSP_OK;
    case 2u:
        card->state = SIMULATED_SD_IDENTIFY;
        return KEEL_BSP_OK;
    case 3u:
        return take_address(card, answer);
    case 7u:
        return move(card, card->state == SIMULATED_SD_STANDBY, SIMULATED_SD_TRANSFER, answer);
    case 8u:
        return take_condition(card, command->argument, answer);
    case 9u:
        memcpy(answer, card->csd, sizeof card->csd);
        return (card->state == SIMULATED_SD_STANDBY) ? KEEL_BSP_OK : refuse(card);
    case 12u:
        return take_stop(card, answer);
    case 13u:
        return take_look(card, answer);
    case 16u:
        card->block_length = command->argument;
        return move(card, card->state == SIMULATED_SD_TRANSFER, card->state, answer);
    case 55u:
        card->is_application = true;
        *answer = take_status(card) | APPLICATION;
        return KEEL_BSP_OK;
    default:
        return take_transfer(card, command, answer);
    }
}

/* Commands of an application; behind APP_CMD any other is the ordinary one (4.3.9). */
static bool is_of_application(uint32_t index)
{
    return (index == 6u) || (index == 41u);
}

/* How each command is answered; others are not known. */
static keel_sd_answer_t answer_of(uint32_t index, bool is_application)
{
    if (is_application && (index == 41u)) {
        return KEEL_SD_PLAIN;
    }
    if (index == 0u) {
        return KEEL_SD_SILENT;
    }
    return ((index == 2u) || (index == 9u)) ? KEEL_SD_LONG : KEEL_SD_SHORT;
}

static keel_bsp_status_t obey(void *context, const keel_sd_command_t *command, uint32_t *answer)
{
    simulated_sd_t *const card = context;
    const bool is_application = card->is_application && is_of_application(command->index);
    keel_bsp_status_t status;

    card->commands++;
    card->count[command->index]++;
    card->last[command->index] = command->argument;
    card->breaches += (command->answer == answer_of(command->index, is_application)) ? 0u : 1u;
    /* Until it is known, no faster than it must be. */
    card->breaches += ((card->bus == KEEL_SD_BUS_IDENTIFY) || (card->state >= SIMULATED_SD_STANDBY))
                          ? 0u
                          : 1u;
    if (card->is_absent || (card->commands == card->loses_command)) {
        return (command->answer == KEEL_SD_SILENT) ? KEEL_BSP_OK : KEEL_BSP_TIMEOUT;
    }
    if (!is_called(card, command)) {
        return KEEL_BSP_TIMEOUT;
    }
    card->is_application = false;
    status = is_application ? take_application(card, command, answer)
                            : take_plain(card, command, answer);
    if ((status == KEEL_BSP_OK) && (card->commands == card->damages_command)) {
        memset(answer, 0, (command->answer == KEEL_SD_LONG) ? 16u : 4u);
        return KEEL_BSP_BUS;
    }
    return status;
}

static void set_bus(void *context, keel_sd_bus_t bus)
{
    simulated_sd_t *const card = context;

    card->bus = bus;
}

static void expect(void *context, uint32_t blocks)
{
    simulated_sd_t *const card = context;

    card->expected = blocks;
}

/* Whether a block can go its way now, by card and host. */
static bool can_move(simulated_sd_t *card, simulated_sd_state_t state)
{
    const bool fits = (card->state == state) && (card->block_length == STANDARD_UNIT) &&
                      card->is_selected_wide && (card->bus == KEEL_SD_BUS_TRANSFER) &&
                      (card->at < card->sectors);

    card->breaches += fits ? 0u : 1u;
    return fits;
}

static keel_bsp_status_t take(void *context, uint8_t *bytes, uint32_t blocks)
{
    simulated_sd_t *const card = context;

    card->breaches += (card->expected == blocks) ? 0u : 1u;
    card->expected = 0u;
    for (uint32_t i = 0u; i < blocks; i++) {
        if (!can_move(card, SIMULATED_SD_SENDING)) {
            return KEEL_BSP_TIMEOUT;
        }
        card->blocks++;
        if (card->blocks == card->fails_block) {
            card->state = card->is_single ? SIMULATED_SD_TRANSFER : card->state;
            return KEEL_BSP_BUS;
        }
        memcpy(&bytes[i * STANDARD_UNIT], &card->bytes[(size_t)card->at * STANDARD_UNIT],
               STANDARD_UNIT);
        card->at++;
        card->state = card->is_single ? SIMULATED_SD_TRANSFER : card->state;
    }
    return KEEL_BSP_OK;
}

static keel_bsp_status_t give(void *context, const uint8_t *bytes, uint32_t blocks)
{
    simulated_sd_t *const card = context;

    for (uint32_t i = 0u; i < blocks; i++) {
        if (!can_move(card, SIMULATED_SD_RECEIVING)) {
            return KEEL_BSP_TIMEOUT;
        }
        card->blocks++;
        if (card->blocks == card->fails_block) {
            return KEEL_BSP_BUS; /* It waits for the block again, or for the end. */
        }
        if (card->writes != card->fails_programming) {
            memcpy(&card->bytes[(size_t)card->at * STANDARD_UNIT], &bytes[i * STANDARD_UNIT],
                   STANDARD_UNIT);
        }
        card->at++;
        if (card->is_single) {
            program(card);
        }
    }
    return KEEL_BSP_OK;
}

keel_sd_host_t simulated_sd_host(simulated_sd_t *card)
{
    return (keel_sd_host_t){set_bus, obey, expect, take, give, card};
}

keel_bsp_status_t simulated_sd_delay(void *context, uint32_t time_us)
{
    simulated_sd_t *const card = context;

    card->waited_us += time_us;
    return card->delays;
}
