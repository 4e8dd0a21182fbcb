/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file radio.c
 * @brief Background radio on a Cortex-M7: how long its runs take with each receiver, or with noise.
 *
 * Bytes of a receiver come at their times, the runs are 10 ms apart, and each is measured with the
 * board's clock. A line for each stream tells the longest, which tools/keel test-target judges.
 */
#include "board.h"
#include "console.h"
#include "copter.h"

#define RUNS      200u
#define PERIOD_US 10000u
#define LONGEST   64u /* Bytes of a stream's pattern at most. */

/* A pattern that comes over and over. */
typedef struct stream {
    const char *name;
    uint8_t protocol; /* COPTER_PROTOCOL_ANY: noise, which is none. */
    uint8_t set;      /* What RC_PROTOCOL is. */
    uint32_t every_us;
    uint32_t byte_us; /* Between two bytes of it; 0: edges of PPM. */
    uint32_t size;
    uint8_t byte[LONGEST];
} stream_t;

/* SBUS as fast as sbus.h has it, CRSF 500 times a second, IBUS, and PPM of eight channels. The
 * worst noise for CRSF has beginnings of its longest frame everywhere: each second byte ends 64
 * whose CRC is wrong. That for SBUS has nothing but headers. */
static const stream_t stream[] = {
    {"SBUS",
     COPTER_PROTOCOL_SBUS,
     COPTER_PROTOCOL_ANY,
     6000u,
     120u,
     25u,
     {0x0F, 0xE0, 0x03, 0x1F, 0xF8, 0xC0, 0x07, 0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0xE0,
      0x03, 0x1F, 0xF8, 0xC0, 0x07, 0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0x00, 0x00}},
    {"CRSF",
     COPTER_PROTOCOL_CRSF,
     COPTER_PROTOCOL_ANY,
     2000u,
     24u,
     26u,
     {0xC8, 0x18, 0x16, 0xAC, 0x98, 0x38, 0xF8, 0xC0, 0x07, 0x3E, 0xF0, 0x81, 0x0F,
      0x7C, 0xE0, 0x03, 0x1F, 0xF8, 0xC0, 0x07, 0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0x20}},
    {"IBUS",
     COPTER_PROTOCOL_IBUS,
     COPTER_PROTOCOL_ANY,
     7000u,
     87u,
     32u,
     {0x20, 0x40, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC,
      0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05,
      0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0xDC, 0x05, 0x51, 0xF3}},
    {"PPM", COPTER_PROTOCOL_PPM, COPTER_PROTOCOL_ANY, 20000u, 0u, 9u, {0}},
    {"noise", COPTER_PROTOCOL_ANY, COPTER_PROTOCOL_ANY, 48u, 24u, 2u, {0x00, 0x3E}},
    {"noise of CRSF", COPTER_PROTOCOL_CRSF, COPTER_PROTOCOL_CRSF, 48u, 24u, 2u, {0x00, 0x3E}},
    {"noise of SBUS", COPTER_PROTOCOL_SBUS, COPTER_PROTOCOL_SBUS, 120u, 120u, 1u, {0x0F}}};

/* What comes, at its times. */
typedef struct line {
    const stream_t *stream;
    uint32_t now_us;
    uint32_t last_us; /* When the byte before came. */
    uint32_t sent;    /* Bytes, or edges. */
    uint32_t whole;   /* Patterns. */
} line_t;

static copter_t copter KEEL_REALTIME_ZERO;
static line_t line KEEL_REALTIME_ZERO;

/* When the next byte comes, or the next edge: eight of 1500 us, and the silence. */
static uint32_t next_us(const line_t *from)
{
    const stream_t *const what = from->stream;
    const uint32_t begins_us = from->whole * what->every_us;

    if (what->byte_us == 0u) {
        return begins_us +
               (((from->sent + 1u) == what->size) ? what->every_us : (1500u * (from->sent + 1u)));
    }
    return begins_us + (what->byte_us * (from->sent + 1u));
}

static bool read_byte(void *context, uint32_t receiver, copter_byte_t *byte)
{
    line_t *const from = context;
    const uint32_t comes_us = next_us(from);

    (void)receiver;
    if (comes_us > from->now_us) {
        return false;
    }
    byte->elapsed_us = comes_us - from->last_us;
    byte->value = from->stream->byte[from->sent];
    from->last_us = comes_us;
    from->sent++;
    if (from->sent == from->stream->size) {
        from->sent = 0u;
        from->whole++;
    }
    return true;
}

static void print_number(const char *label, uint64_t value)
{
    keel_console_text(label);
    keel_console_number(value);
}

static void measure(const stream_t *what)
{
    const copter_port_t port = {
        .read_clock = keel_board_clock_us, .read_byte = read_byte, .context = &line};
    uint32_t longest_us = 0u;
    uint32_t found = 0u;

    line = (line_t){.stream = what};
    copter = (copter_t){.port = &port};
    copter_settings = copter_defaults;
    copter_settings.rc.protocol = what->set;
    if (copter_pilot_init(&copter.pilot) != KEEL_OK) {
        keel_console_text("refused\n");
    }
    for (uint32_t run = 1u; run <= RUNS; run++) {
        uint32_t took_us;

        line.now_us = run * PERIOD_US;
        took_us = keel_board_clock_us(NULL);
        copter_background_radio(&copter.pilot, &copter);
        took_us = keel_board_clock_us(NULL) - took_us;
        longest_us = (took_us > longest_us) ? took_us : longest_us;
        if ((found == 0u) && (copter.pilot.rc.protocol != COPTER_PROTOCOL_ANY)) {
            found = run;
        }
    }
    keel_console_text("radio ");
    keel_console_text(what->name);
    print_number(": protocol ", copter.pilot.rc.protocol);
    print_number(" found ", found);
    print_number(" sent ", line.whole);
    print_number(" frames ", copter.pilot.rc.frames);
    print_number(" longest ", longest_us);
    print_number(" behind ", (line.now_us - line.last_us) / 1000u);
    keel_console_text("\n");
}

int main(void)
{
    for (uint32_t i = 0u; i < (sizeof stream / sizeof stream[0]); i++) {
        measure(&stream[i]);
    }
    keel_console_text("radio ended\n");
    return 0;
}
