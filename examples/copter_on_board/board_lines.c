/* SPDX-License-Identifier: Apache-2.0 */
#include "board_lines.h"

#include "board.h"

#include <stddef.h>

#define TRIED       3u  /* Protocols that a UART hears: PPM is none. */
#define BITS_A_BYTE 10u /* On the telemetry's line. */

/* A protocol with its bits. */
typedef struct pilot_bits {
    uint8_t protocol;
    const keel_line_t *line;
} pilot_bits_t;

static const pilot_bits_t pilot_bits[TRIED] = {
    {COPTER_PROTOCOL_SBUS, &keel_line_sbus},
    {COPTER_PROTOCOL_CRSF, &keel_line_crsf},
    {COPTER_PROTOCOL_IBUS, &keel_line_115200},
};

/* The sockets of the pilot's receiver, one after the other. */
static const keel_chip_line_t pilot_sockets[] = {KEEL_LINE_PILOT, KEEL_LINE_SPARE};

#define SOCKETS (sizeof pilot_sockets / sizeof pilot_sockets[0])

/* All sockets with one protocol's bits, then with the next one's. */
static void listen_at(board_lines_t *lines, uint32_t turn, uint32_t now_us)
{
    lines->turn = turn % (TRIED * (uint32_t)SOCKETS);
    lines->since_us = now_us;
    lines->socket = pilot_sockets[lines->turn % SOCKETS];
    lines->pilot = keel_chip_line_start(lines->socket, pilot_bits[lines->turn / SOCKETS].line);
}

/* Whether a turn is of a socket that the board has, and of a protocol that may be heard. */
static bool may_listen(uint32_t turn, uint8_t chosen)
{
    const uint8_t protocol = pilot_bits[(turn / SOCKETS) % TRIED].protocol;

    return keel_chip_has_line(pilot_sockets[turn % SOCKETS]) &&
           ((chosen == COPTER_PROTOCOL_ANY) || (chosen == protocol));
}

/* The next turn that makes sense; none with PPM alone, or without a socket. */
static void search_pilot(board_lines_t *lines, uint8_t chosen, uint32_t now_us)
{
    for (uint32_t i = 1u; i <= (TRIED * (uint32_t)SOCKETS); i++) {
        if (may_listen(lines->turn + i, chosen)) {
            listen_at(lines, lines->turn + i, now_us);
            return;
        }
    }
}

/* While the line takes one. */
static void send_telemetry(board_lines_t *lines)
{
    while ((lines->head != lines->tail) &&
           keel_chip_line_send(KEEL_LINE_TELEMETRY, lines->out[lines->tail % sizeof lines->out])) {
        lines->tail++;
    }
}

void board_lines_start(board_lines_t *lines)
{
    static const keel_line_t telemetry = {.baud = BOARD_TELEMETRY_BAUD};

    *lines = (board_lines_t){.pilot = KEEL_BSP_ARGUMENT};
    listen_at(lines, 0u, keel_board_clock_us(NULL));
    lines->satellites = keel_chip_line_start(KEEL_LINE_SATELLITES, &keel_line_115200);
    lines->telemetry = keel_chip_line_start(KEEL_LINE_TELEMETRY, &telemetry);
}

void board_lines_turn(board_lines_t *lines, uint8_t chosen, uint8_t heard, uint32_t now_us)
{
    send_telemetry(lines);
    if ((heard == COPTER_PROTOCOL_ANY) && ((now_us - lines->since_us) >= BOARD_LISTEN_US)) {
        search_pilot(lines, chosen, now_us);
    }
}

bool board_lines_read(board_lines_t *lines, uint32_t receiver, copter_byte_t *byte)
{
    const keel_chip_line_t name = (receiver == COPTER_RC) ? lines->socket : KEEL_LINE_SATELLITES;
    keel_receiver_byte_t come;

    if (!keel_chip_line_read(name, &come)) {
        return false;
    }
    byte->elapsed_us = come.elapsed_us;
    byte->value = come.value;
    return true;
}

static uint32_t read_telemetry(void *context, uint32_t link, uint8_t *bytes, uint32_t size)
{
    uint32_t count = 0u;
    keel_receiver_byte_t byte;

    (void)context;
    (void)link;
    while ((count < size) && keel_chip_line_read(KEEL_LINE_TELEMETRY, &byte)) {
        bytes[count] = byte.value;
        count++;
    }
    return count;
}

static uint32_t telemetry_room(void *context, uint32_t link)
{
    const board_lines_t *const lines = context;

    (void)link;
    return BOARD_TELEMETRY_BYTES - (lines->head - lines->tail);
}

static void write_telemetry(void *context, uint32_t link, const uint8_t *bytes, uint32_t size)
{
    board_lines_t *const lines = context;

    (void)link;
    for (uint32_t i = 0u; i < size; i++) {
        lines->out[lines->head % BOARD_TELEMETRY_BYTES] = bytes[i];
        lines->head++;
    }
}

copter_telemetry_config_t board_lines_telemetry(board_lines_t *lines)
{
    return (copter_telemetry_config_t){
        .lines = {.context = lines,
                  .read = read_telemetry,
                  .room = telemetry_room,
                  .write = write_telemetry},
        .link = {{.bytes_per_s = BOARD_TELEMETRY_BAUD / BITS_A_BYTE, .commands = true}}};
}
