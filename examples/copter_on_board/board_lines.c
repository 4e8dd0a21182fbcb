/* SPDX-License-Identifier: Apache-2.0 */
#include "board_lines.h"

#include "board.h"

#include <stddef.h>

#define BITS_A_BYTE 10u /* On the telemetry's line. */

/* A turn of the search: a protocol, and the socket that is listened to with its bits. Of PPM the
 * bits are edges, and the socket is the pin of its own. */
typedef struct pilot_turn {
    uint8_t protocol;
    const keel_line_t *line; /* Null: PPM. */
    keel_chip_line_t socket; /* Where there is a line. */
} pilot_turn_t;

/* All sockets with one protocol's bits, then with the next one's. */
static const pilot_turn_t pilot_turns[] = {
    {COPTER_PROTOCOL_SBUS, &keel_line_sbus, KEEL_LINE_PILOT},
    {COPTER_PROTOCOL_SBUS, &keel_line_sbus, KEEL_LINE_SPARE},
    {COPTER_PROTOCOL_CRSF, &keel_line_crsf, KEEL_LINE_PILOT},
    {COPTER_PROTOCOL_CRSF, &keel_line_crsf, KEEL_LINE_SPARE},
    {COPTER_PROTOCOL_IBUS, &keel_line_115200, KEEL_LINE_PILOT},
    {COPTER_PROTOCOL_IBUS, &keel_line_115200, KEEL_LINE_SPARE},
    {COPTER_PROTOCOL_PPM, NULL, KEEL_LINE_PILOT},
};

#define TURNS ((uint32_t)(sizeof pilot_turns / sizeof pilot_turns[0]))

static void listen_at(board_lines_t *lines, uint32_t turn, uint32_t now_us)
{
    const pilot_turn_t *const now = &pilot_turns[turn % TURNS];

    lines->turn = turn % TURNS;
    lines->since_us = now_us;
    lines->socket = now->socket;
    lines->by_edges = now->line == NULL;
    lines->pilot = lines->by_edges ? keel_chip_ppm_start()
                                   : keel_chip_line_start(now->socket, now->line);
}

/* Whether a turn is of a socket that the board has, and of a protocol that may be heard. */
static bool may_listen(uint32_t turn, uint8_t chosen)
{
    const pilot_turn_t *const other = &pilot_turns[turn % TURNS];
    const bool is_there = (other->line == NULL) ? keel_chip_has_ppm()
                                                : keel_chip_has_line(other->socket);

    return is_there && ((chosen == COPTER_PROTOCOL_ANY) || (chosen == other->protocol));
}

/* The next turn that makes sense; none without a socket. */
static void search_pilot(board_lines_t *lines, uint8_t chosen, uint32_t now_us)
{
    for (uint32_t i = 1u; i <= TURNS; i++) {
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

static keel_bsp_status_t set_satellites(uint32_t baud)
{
    const keel_line_t line = {.baud = baud};

    return keel_chip_line_start(KEEL_LINE_SATELLITES, &line);
}

static bool send_to_satellites(void *context, uint8_t byte)
{
    (void)context;
    return keel_chip_line_send(KEEL_LINE_SATELLITES, byte);
}

static void set_satellites_baud(void *context, uint32_t baud)
{
    board_lines_t *const lines = context;

    lines->satellites = set_satellites(baud);
}

void board_lines_start(board_lines_t *lines)
{
    static const keel_line_t telemetry = {.baud = BOARD_TELEMETRY_BAUD};
    const uint32_t now_us = keel_board_clock_us(NULL);

    *lines = (board_lines_t){.pilot = KEEL_BSP_ARGUMENT, .stepped_us = now_us};
    listen_at(lines, 0u, now_us);
    lines->satellites = set_satellites(BOARD_SATELLITES_BAUD);
    (void)keel_ublox_begin(&lines->receiver,
                           (keel_ublox_port_t){send_to_satellites, set_satellites_baud, lines},
                           BOARD_SATELLITES_BAUD, BOARD_FIX_MS);
    lines->telemetry = keel_chip_line_start(KEEL_LINE_TELEMETRY, &telemetry);
}

void board_lines_turn(board_lines_t *lines, const board_heard_t *heard, uint32_t now_us)
{
    send_telemetry(lines);
    if ((heard->heard == COPTER_PROTOCOL_ANY) && ((now_us - lines->since_us) >= BOARD_LISTEN_US)) {
        search_pilot(lines, heard->chosen, now_us);
    }
    if (keel_chip_has_line(KEEL_LINE_SATELLITES)) {
        (void)keel_ublox_step(&lines->receiver, now_us - lines->stepped_us, heard->fixes);
        lines->stepped_us = now_us;
    }
}

/* An edge of PPM is a byte of any value. */
static bool read_edge(copter_byte_t *byte)
{
    uint32_t elapsed_us;

    if (!keel_chip_ppm_read(&elapsed_us)) {
        return false;
    }
    byte->elapsed_us = elapsed_us;
    byte->value = 0u;
    return true;
}

bool board_lines_read(board_lines_t *lines, uint32_t receiver, copter_byte_t *byte)
{
    const bool is_pilot = (receiver == COPTER_RC);
    const keel_chip_line_t name = is_pilot ? lines->socket : KEEL_LINE_SATELLITES;
    keel_receiver_byte_t come;

    if (is_pilot && lines->by_edges) {
        return read_edge(byte);
    }
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
