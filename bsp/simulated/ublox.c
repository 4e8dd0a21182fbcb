/* SPDX-License-Identifier: Apache-2.0 */
#include "simulated/ublox.h"

#include <string.h>

#define SECOND_US  1000000u
#define WRONG_MOST 100u

/* A slow character is many to a fast receiver: each of its low bits ends one. */
#define WRONG_SLOW 5u

/* A number in the message, the lowest byte first. */
static uint32_t simulated_ublox_number(const simulated_ublox_t *receiver, uint32_t at,
                                       uint32_t size)
{
    uint32_t number = 0u;

    for (uint32_t i = 0u; i < size; i++) {
        number |= (uint32_t)receiver->message[at + i] << (8u * i);
    }
    return number;
}

void simulated_ublox_init(simulated_ublox_t *receiver, uint32_t baud)
{
    const simulated_ublox_settings_t factory = {
        .baud = baud, .period_ms = 1000u, .ubx_in = true, .ubx_out = true, .nmea_out = true};

    memset(receiver, 0, sizeof *receiver);
    receiver->factory = factory;
    receiver->line_baud = 9600u;
    simulated_ublox_power(receiver);
}

void simulated_ublox_unplug(simulated_ublox_t *receiver)
{
    receiver->is_off = true;
}

void simulated_ublox_power(simulated_ublox_t *receiver)
{
    receiver->is_off = false;
    receiver->now = receiver->factory;
    receiver->new_baud = 0u;
    receiver->epoch_us = 0u;
    receiver->second_us = 0u;
    receiver->wrong = 0u;
    receiver->length = 0u;
}

/* Takes so much of what is left, and tells whether nothing is. */
static bool simulated_ublox_ends(uint32_t *left_us, uint32_t time_us)
{
    *left_us -= (*left_us < time_us) ? *left_us : time_us;
    return *left_us == 0u;
}

static void simulated_ublox_measure(simulated_ublox_t *receiver, uint32_t time_us)
{
    const simulated_ublox_settings_t *const now = &receiver->now;

    receiver->epoch_us += time_us;
    if (receiver->epoch_us < (1000u * now->period_ms)) {
        return;
    }
    receiver->epoch_us -= 1000u * now->period_ms;
    if ((now->every == 1u) && now->ubx_out && (now->baud == receiver->line_baud)) {
        receiver->fixes++;
    }
}

void simulated_ublox_pass(simulated_ublox_t *receiver, uint32_t time_us)
{
    (void)simulated_ublox_ends(&receiver->sends_us, time_us);
    if (receiver->is_off) {
        return;
    }
    if (simulated_ublox_ends(&receiver->new_us, time_us) && (receiver->new_baud != 0u)) {
        receiver->now.baud = receiver->new_baud;
        receiver->new_baud = 0u;
    }
    receiver->second_us += time_us;
    if (receiver->second_us >= SECOND_US) {
        receiver->second_us -= SECOND_US;
        receiver->wrong = 0u;
    }
    simulated_ublox_measure(receiver, time_us);
}

static void simulated_ublox_tell_rate(simulated_ublox_t *receiver, uint32_t baud)
{
    if (receiver->lag_us == 0u) {
        receiver->now.baud = baud;
    } else {
        receiver->new_baud = baud;
        receiver->new_us = receiver->lag_us;
    }
}

/* CFG-VALSET of one item, in RAM alone; whether it did. */
static bool simulated_ublox_set_item(simulated_ublox_t *receiver)
{
    static const uint32_t sizes[6] = {0u, 1u, 1u, 2u, 4u, 8u};
    const uint32_t key = simulated_ublox_number(receiver, 10u, 4u);
    const uint32_t size = sizes[(key >> 28u) % 6u];
    const uint32_t value = simulated_ublox_number(receiver, 14u, (size < 8u) ? size : 4u);
    bool done = (receiver->length == (16u + size)) &&
                (simulated_ublox_number(receiver, 6u, 4u) == 0x0100u);

    if (!done) {
        return false;
    }
    switch (key) {
    case 0x40520001u:
        simulated_ublox_tell_rate(receiver, value);
        break;
    case 0x10730001u:
        receiver->now.ubx_in = value == 1u;
        break;
    case 0x10740001u:
        receiver->now.ubx_out = value == 1u;
        break;
    case 0x10740002u:
        receiver->now.nmea_out = value == 1u;
        break;
    case 0x20910007u:
        receiver->now.every = value;
        break;
    case 0x20110021u:
        receiver->now.model = value;
        break;
    case 0x30210001u:
        receiver->now.period_ms = value;
        break;
    default:
        done = false;
        break;
    }
    return done;
}

/* CFG-PRT of the first UART, with a mode of 8 data bits, no parity and one stop bit. */
static bool simulated_ublox_set_port(simulated_ublox_t *receiver)
{
    const uint32_t in = simulated_ublox_number(receiver, 18u, 2u);
    const uint32_t out = simulated_ublox_number(receiver, 20u, 2u);

    if ((receiver->length != 28u) || (receiver->message[6] != 1u) ||
        ((simulated_ublox_number(receiver, 10u, 4u) & ~0x10u) != 0x8C0u)) {
        return false;
    }
    receiver->now.ubx_in = (in & 1u) != 0u;
    receiver->now.ubx_out = (out & 1u) != 0u;
    receiver->now.nmea_out = (out & 2u) != 0u;
    simulated_ublox_tell_rate(receiver, simulated_ublox_number(receiver, 14u, 4u));
    return true;
}

/* CFG-MSG, CFG-RATE and CFG-NAV5. */
static bool simulated_ublox_set_message(simulated_ublox_t *receiver, uint32_t id)
{
    bool done = false;

    if ((id == 0x01u) && (receiver->length == 11u) &&
        (simulated_ublox_number(receiver, 6u, 2u) == 0x0701u)) {
        receiver->now.every = receiver->message[8];
        done = true;
    } else if ((id == 0x08u) && (receiver->length == 14u) &&
               (simulated_ublox_number(receiver, 8u, 2u) == 1u)) {
        receiver->now.period_ms = simulated_ublox_number(receiver, 6u, 2u);
        done = true;
    } else if ((id == 0x24u) && (receiver->length == 44u) &&
               (simulated_ublox_number(receiver, 6u, 2u) == 1u)) {
        receiver->now.model = receiver->message[8];
        done = true;
    } else {
        /* It is refused. */
    }
    return done;
}

static void simulated_ublox_obey(simulated_ublox_t *receiver)
{
    const uint32_t group = receiver->message[2];
    const uint32_t id = receiver->message[3];
    bool done = false;

    if ((group == 0x06u) && (id == 0x8Au)) {
        done = receiver->knows_items && simulated_ublox_set_item(receiver);
    } else if ((group == 0x06u) && (id == 0x00u)) {
        done = receiver->knows_messages && simulated_ublox_set_port(receiver);
    } else if (group == 0x06u) {
        done = receiver->knows_messages && simulated_ublox_set_message(receiver, id);
    } else {
        /* It is refused. */
    }
    receiver->acks += done ? 1u : 0u;
    receiver->naks += done ? 0u : 1u;
}

/* Fletcher's sums over all behind the first two bytes. */
static bool simulated_ublox_is_right(const simulated_ublox_t *receiver)
{
    const uint32_t end = receiver->length - 2u;
    uint8_t a = 0u;
    uint8_t b = 0u;

    for (uint32_t i = 2u; i < end; i++) {
        a = (uint8_t)(a + receiver->message[i]);
        b = (uint8_t)(b + a);
    }
    return (a == receiver->message[end]) && (b == receiver->message[end + 1u]);
}

static void simulated_ublox_take(simulated_ublox_t *receiver, uint8_t byte)
{
    static const uint8_t sync[2] = {0xB5u, 0x62u};
    uint32_t whole;

    if ((receiver->length < 2u) && (byte != sync[receiver->length])) {
        receiver->length = 0u;
        return;
    }
    receiver->message[receiver->length] = byte;
    receiver->length++;
    whole = 8u + simulated_ublox_number(receiver, 4u, 2u);
    if (receiver->length < 6u) {
        return;
    }
    if (whole > SIMULATED_UBLOX_BYTES) {
        receiver->length = 0u;
    } else if (receiver->length == whole) {
        if (simulated_ublox_is_right(receiver)) {
            simulated_ublox_obey(receiver);
        } else {
            receiver->checksums++;
        }
        receiver->length = 0u;
    } else {
        /* There is more to come. */
    }
}

bool simulated_ublox_send(void *context, uint8_t byte)
{
    simulated_ublox_t *const receiver = context;
    const uint32_t byte_us = 10u * SECOND_US / receiver->line_baud;
    const bool is_slow = receiver->line_baud < receiver->now.baud;

    if (receiver->is_mute || (receiver->sends_us > byte_us)) {
        return false;
    }
    receiver->sends_us += byte_us;
    if (receiver->is_off) {
        receiver->garbage++;
    } else if (receiver->line_baud != receiver->now.baud) {
        receiver->garbage++;
        receiver->wrong += is_slow ? WRONG_SLOW : 1u;
        receiver->length = 0u;
    } else if (receiver->wrong > WRONG_MOST) {
        receiver->garbage++;
    } else if (receiver->now.ubx_in) {
        simulated_ublox_take(receiver, byte);
    } else {
        /* It listens to other protocols. */
    }
    return true;
}

void simulated_ublox_set_baud(void *context, uint32_t baud)
{
    simulated_ublox_t *const receiver = context;

    receiver->cut += (receiver->sends_us > 0u) ? 1u : 0u;
    receiver->rates++;
    receiver->line_baud = baud;
}
