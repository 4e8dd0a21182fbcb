/* SPDX-License-Identifier: Apache-2.0 */
/* The console by MAVLink. */
#include "shell.h"

#include <string.h>

#define DATA        70u /* Bytes that a message carries at most. */
#define FIRST_SHOWN 0x20u
#define LAST_SHOWN  0x7Eu

static const char prompt[] = "keel> ";

/* The place of a station, or COPTER_SHELL_STATIONS. */
static uint32_t place_of(const copter_shell_t *shell, uint8_t system, uint8_t component)
{
    uint32_t found = COPTER_SHELL_STATIONS;

    for (uint32_t i = 0u; i < COPTER_SHELL_STATIONS; i++) {
        const copter_shell_station_t *const station = &shell->station[i];

        if (station->is_open && (station->system == system) && (station->component == component)) {
            found = i;
        }
    }
    return found;
}

/* The same; one that has none gets one. */
static copter_shell_station_t *open_place(copter_shell_t *shell, uint8_t system, uint8_t component)
{
    uint32_t place = place_of(shell, system, component);

    if (place == COPTER_SHELL_STATIONS) {
        place = shell->next_station;
        shell->next_station = (place + 1u) % COPTER_SHELL_STATIONS;
        shell->station[place] = (copter_shell_station_t){
            .system = system, .component = component, .is_open = true};
    }
    return &shell->station[place];
}

/* Lines end with a line feed; of what else is no character to be seen, nothing is known. */
static bool is_typed(uint8_t byte)
{
    return (byte == (uint8_t)'\n') || ((byte >= FIRST_SHOWN) && (byte <= LAST_SHOWN));
}

static bool type_bytes(copter_shell_station_t *station, const uint8_t *byte, uint32_t count)
{
    bool fits = true;

    for (uint32_t i = 0u; i < count; i++) {
        if (is_typed(byte[i])) {
            const bool room = station->count < COPTER_SHELL_TYPED;

            if (room) {
                station->typed[station->count] = (char)byte[i];
                station->count++;
            }
            fits = fits && room;
        }
    }
    return fits;
}

bool copter_shell_take(copter_shell_t *shell, const message_serial_control_t *message,
                       uint8_t system, uint8_t component)
{
    uint32_t place;
    bool fits = true;

    if ((message->device != SERIAL_CONTROL_DEV_SHELL) || (message->count > DATA) ||
        ((message->flags & SERIAL_CONTROL_FLAG_REPLY) != 0u)) {
        /* It is nothing for the console. */
    } else if ((message->flags & SERIAL_CONTROL_FLAG_RESPOND) == 0u) {
        place = place_of(shell, system, component);
        if (place < COPTER_SHELL_STATIONS) {
            shell->station[place].is_open = false;
        }
    } else if (message->count > 0u) {
        fits = type_bytes(open_place(shell, system, component), message->data, message->count);
    } else {
        /* Some only ask whether there is more. */
    }
    return fits;
}

/* Up to the first end of line, which counts; 0: there is none. Characters that fill all the room
 * are taken as a line: no command is so long. */
static uint32_t typed_line(const copter_shell_station_t *station)
{
    const char *const end = memchr(station->typed, '\n', station->count);

    if (end != NULL) {
        return (uint32_t)(end - station->typed) + 1u;
    }
    return (station->count == COPTER_SHELL_TYPED) ? COPTER_SHELL_TYPED : 0u;
}

static bool has_output(const copter_shell_station_t *station)
{
    return station->is_open &&
           ((station->sent < station->length) || station->answers || (typed_line(station) > 0u));
}

/* The line is taken, and shown to whoever typed it: programs leave that to the other side. */
static void begin_answer(copter_shell_station_t *station, uint32_t length)
{
    uint32_t shown = length;

    if (station->typed[shown - 1u] == '\n') {
        shown--;
    }
    copter_console_ask(&station->answer, station->typed, shown);
    memcpy(station->line, station->typed, shown);
    station->line[shown] = '\n';
    station->length = (uint8_t)(shown + 1u);
    station->answers = true;
    station->count -= (uint8_t)length;
    memmove(station->typed, &station->typed[length], station->count);
}

/* The next line to be sent, behind the last: what was typed, its answer, and the prompt. */
static void next_line(const struct copter *copter, copter_shell_station_t *station)
{
    station->sent = 0u;
    station->length = 0u;
    if (station->answers) {
        station->length = (uint8_t)copter_console_line(copter, &station->answer, station->line);
        if (station->length == 0u) {
            station->answers = false;
            station->length = (uint8_t)(sizeof prompt - 1u);
            memcpy(station->line, prompt, station->length);
        }
    } else if (typed_line(station) > 0u) {
        begin_answer(station, typed_line(station));
    } else {
        /* Nobody asks. */
    }
}

/* Of a table at most one line is made: none of them is shorter than a message. */
static void fill_answer(const struct copter *copter, copter_shell_station_t *station,
                        message_serial_control_t *message)
{
    while (has_output(station) && (message->count < DATA)) {
        const uint32_t room = DATA - message->count;
        uint32_t left = (uint32_t)station->length - station->sent;

        if (left == 0u) {
            next_line(copter, station);
            left = station->length;
        }
        left = (left < room) ? left : room;
        memcpy(&message->data[message->count], &station->line[station->sent], left);
        station->sent += (uint8_t)left;
        message->count += (uint8_t)left;
    }
}

bool copter_shell_waits(const copter_shell_t *shell)
{
    bool found = false;

    for (uint32_t i = 0u; i < COPTER_SHELL_STATIONS; i++) {
        found = found || has_output(&shell->station[i]);
    }
    return found;
}

bool copter_shell_report(const struct copter *copter, copter_shell_t *shell,
                         message_serial_control_t *message)
{
    const bool found = copter_shell_waits(shell);
    copter_shell_station_t *station;

    if (found) {
        do {
            shell->turn = (shell->turn + 1u) % COPTER_SHELL_STATIONS;
            station = &shell->station[shell->turn];
        } while (!has_output(station));
        *message = (message_serial_control_t){.device = (uint8_t)SERIAL_CONTROL_DEV_SHELL,
                                              .flags = (uint8_t)SERIAL_CONTROL_FLAG_REPLY,
                                              .target_system = station->system,
                                              .target_component = station->component};
        fill_answer(copter, station, message);
    }
    return found;
}
