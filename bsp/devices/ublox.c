/* SPDX-License-Identifier: Apache-2.0 */
#include "devices/ublox.h"

#include "keel/middleware/ubx.h"

#define KEY_BAUD     0x40520001u /* CFG-UART1-BAUDRATE. */
#define KEY_UBX_IN   0x10730001u /* CFG-UART1INPROT-UBX. */
#define KEY_UBX_OUT  0x10740001u /* CFG-UART1OUTPROT-UBX. */
#define KEY_NMEA_OUT 0x10740002u /* CFG-UART1OUTPROT-NMEA. */
#define KEY_PVT      0x20910007u /* CFG-MSGOUT-UBX_NAV_PVT_UART1. */
#define KEY_MODEL    0x20110021u /* CFG-NAVSPG-DYNMODEL. */
#define KEY_PERIOD   0x30210001u /* CFG-RATE-MEAS. */

#define GROUP_NAV   0x01u
#define ID_PVT      0x07u
#define AIRBORNE_4G 8u
#define EACH        1u

/* Milliseconds times bits per second that a NAV-PVT takes: ten bits a byte. */
#define PVT_BITS_MS (10u * 1000u * (uint32_t)KEEL_UBX_BYTES)

#define ITEMS      5u
#define NAV5_BYTES 44u

/* An item of the configuration. */
typedef struct ublox_item {
    uint32_t key;
    uint32_t value;
} ublox_item_t;

/* The rates of receivers as they come, M8, M9 and M10, before those that others set. */
const uint32_t keel_ublox_baud[KEEL_UBLOX_RATES] = {9600u, 38400u, 115200u, 57600u, 230400u};

static void enter_state(keel_ublox_t *receiver, keel_ublox_state_t state)
{
    receiver->state = state;
    keel_progress_begin(&receiver->progress);
}

static void add_bytes(keel_ublox_t *receiver, const uint8_t *bytes, uint32_t size)
{
    for (uint32_t i = 0u; i < size; i++) {
        receiver->bytes[receiver->size] = bytes[i];
        receiver->size++;
    }
}

static void add_item(keel_ublox_t *receiver, uint32_t key, uint32_t value)
{
    keel_ubx_message_t message = {.size = 0u};

    (void)keel_ubx_write_value(&message, key, value); /* Our keys have lengths that it knows. */
    add_bytes(receiver, message.bytes, message.size);
}

/* For M9, M10 and F9: an item a message, as a message with one that they do not know is refused.
 * NMEA is off first: at 9600 baud it may fill the line, and keep answers waiting. */
static void add_items(keel_ublox_t *receiver, uint32_t period_ms)
{
    static const ublox_item_t item[ITEMS] = {{KEY_NMEA_OUT, 0u},
                                             {KEY_UBX_IN, 1u},
                                             {KEY_UBX_OUT, 1u},
                                             {KEY_MODEL, AIRBORNE_4G},
                                             {KEY_PVT, EACH}};

    for (uint32_t i = 0u; i < ITEMS; i++) {
        add_item(receiver, item[i].key, item[i].value);
    }
    add_item(receiver, KEY_PERIOD, period_ms);
}

/* For u-blox 7 and M8. CFG-NAV5 has 36 bytes, of which the first two say that nothing but the third
 * is to be taken, the dynamic model; its checksum is at its end. */
static void add_messages(keel_ublox_t *receiver, uint32_t period_ms)
{
    static const uint8_t nav5[NAV5_BYTES] = {
        [0] = 0xB5u, [1] = 0x62u,       [2] = 0x06u,  [3] = 0x24u, [4] = 36u,
        [6] = 0x01u, [8] = AIRBORNE_4G, [42] = 0x57u, [43] = 0xF8u};
    keel_ubx_message_t message;

    keel_ubx_write_output(&message, GROUP_NAV, ID_PVT, EACH);
    add_bytes(receiver, message.bytes, message.size);
    keel_ubx_write_rate(&message, (uint16_t)period_ms);
    add_bytes(receiver, message.bytes, message.size);
    add_bytes(receiver, nav5, NAV5_BYTES);
}

/* The first that the receiver knows changes its rate, and the other is noise to it. */
static void add_rate(keel_ublox_t *receiver)
{
    keel_ubx_message_t message;

    add_item(receiver, KEY_BAUD, receiver->target_baud);
    keel_ubx_write_port(&message, receiver->target_baud);
    add_bytes(receiver, message.bytes, message.size);
}

static bool is_known_baud(uint32_t baud)
{
    bool known = false;

    for (uint32_t i = 0u; i < KEEL_UBLOX_RATES; i++) {
        known = known || (baud == keel_ublox_baud[i]);
    }
    return known;
}

static keel_bsp_status_t tell_timeout(keel_ublox_t *receiver)
{
    receiver->progress.failures = keel_progress_next(receiver->progress.failures);
    return KEEL_BSP_TIMEOUT;
}

static void listen_at_target(keel_ublox_t *receiver)
{
    receiver->port.set_baud(receiver->port.context, receiver->target_baud);
    enter_state(receiver, KEEL_UBLOX_LISTENING);
}

static keel_bsp_status_t start_sending(keel_ublox_t *receiver)
{
    receiver->tried_baud = keel_ublox_baud[receiver->rate];
    receiver->attempts = keel_progress_next(receiver->attempts);
    receiver->sent = 0u;
    receiver->port.set_baud(receiver->port.context, receiver->tried_baud);
    enter_state(receiver, KEEL_UBLOX_SENDING);
    return tell_timeout(receiver);
}

static void choose_next_rate(keel_ublox_t *receiver)
{
    receiver->rate++;
    if (receiver->rate == KEEL_UBLOX_RATES) {
        receiver->rate = 0u;
        receiver->rounds = keel_progress_next(receiver->rounds);
    }
}

static keel_bsp_status_t take_fix(keel_ublox_t *receiver)
{
    keel_progress_sample(&receiver->progress);
    return KEEL_BSP_OK;
}

/* A receiver that was never spoken to is given more time, and is first sought at the first rate. */
static keel_bsp_status_t listen_for_fix(keel_ublox_t *receiver, bool is_fixed)
{
    const bool was_tried = receiver->tried_baud != 0u;

    if (is_fixed) {
        receiver->found_baud = was_tried ? receiver->tried_baud : receiver->target_baud;
        enter_state(receiver, KEEL_UBLOX_RUNNING);
        return take_fix(receiver);
    }
    if (receiver->progress.passed_us < (was_tried ? KEEL_UBLOX_LISTEN_US : KEEL_UBLOX_START_US)) {
        return KEEL_BSP_WAIT;
    }
    if (was_tried) {
        choose_next_rate(receiver);
    }
    return start_sending(receiver);
}

/* A few bytes, as long as the line takes them. Bytes that it never takes are given up, as the
 * receiver may speak to us all the same. */
static keel_bsp_status_t send_settings(keel_ublox_t *receiver)
{
    const uint32_t left = receiver->size - receiver->sent;
    const uint32_t count = (left < KEEL_UBLOX_BURST) ? left : KEEL_UBLOX_BURST;
    bool is_taken = true;

    for (uint32_t i = 0u; (i < count) && is_taken; i++) {
        is_taken = receiver->port.send(receiver->port.context, receiver->bytes[receiver->sent]);
        receiver->sent += is_taken ? 1u : 0u;
    }
    if (receiver->sent == receiver->size) {
        enter_state(receiver, KEEL_UBLOX_SETTLING);
        return KEEL_BSP_WAIT;
    }
    if (receiver->progress.passed_us < KEEL_UBLOX_SEND_US) {
        return KEEL_BSP_WAIT;
    }
    enter_state(receiver, KEEL_UBLOX_SETTLING);
    return tell_timeout(receiver);
}

static keel_bsp_status_t let_settle(keel_ublox_t *receiver)
{
    if (receiver->progress.passed_us >= KEEL_UBLOX_SETTLE_US) {
        listen_at_target(receiver);
    }
    return KEEL_BSP_WAIT;
}

/* A receiver that has lost its settings has, most likely, the rate again that it had before. */
static keel_bsp_status_t watch_fixes(keel_ublox_t *receiver, bool is_fixed)
{
    if (is_fixed) {
        return take_fix(receiver);
    }
    return (receiver->progress.age_us < KEEL_UBLOX_LOST_US) ? KEEL_BSP_OK : start_sending(receiver);
}

keel_bsp_status_t keel_ublox_begin(keel_ublox_t *receiver, keel_ublox_port_t port,
                                   uint32_t target_baud, uint32_t period_ms)
{
    static const keel_ublox_t off = {.state = KEEL_UBLOX_OFF};

    if (!is_known_baud(target_baud) || (period_ms > KEEL_UBLOX_PERIOD_MAX_MS) ||
        ((period_ms * target_baud) < PVT_BITS_MS)) {
        return KEEL_BSP_ARGUMENT;
    }
    *receiver = off;
    receiver->port = port;
    receiver->progress = keel_progress_none();
    receiver->target_baud = target_baud;
    add_items(receiver, period_ms);
    add_messages(receiver, period_ms);
    add_rate(receiver);
    return KEEL_BSP_OK;
}

keel_bsp_status_t keel_ublox_step(keel_ublox_t *receiver, uint32_t elapsed_us, uint32_t fixes)
{
    const bool is_fixed = fixes != receiver->fixes;
    keel_bsp_status_t status = KEEL_BSP_WAIT;

    receiver->fixes = fixes;
    keel_progress_pass(&receiver->progress, elapsed_us);
    switch (receiver->state) {
    case KEEL_UBLOX_LISTENING:
        status = listen_for_fix(receiver, is_fixed);
        break;
    case KEEL_UBLOX_SENDING:
        status = send_settings(receiver);
        break;
    case KEEL_UBLOX_SETTLING:
        status = let_settle(receiver);
        break;
    case KEEL_UBLOX_RUNNING:
        status = watch_fixes(receiver, is_fixed);
        break;
    default: /* KEEL_UBLOX_OFF, and what cannot be. */
        listen_at_target(receiver);
        break;
    }
    return status;
}
