/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file receiver.h
 * @brief Bytes from a UART, each with the time since the one before: DMA writes them into a ring,
 *        the main loop looks at how far it came, and tasks read them.
 *
 * Nothing waits and nothing interrupts: at 420 000 baud a byte comes every 24 us, so the processor
 * cannot take each itself. Decoders find frames by the gaps between them. The newest byte that a
 * look finds is taken to have come at that look, each one before it a byte's time earlier, but none
 * before the look before: so the time of a byte, and a gap, is right to within the time from look
 * to look.
 *
 * A byte with a wrong parity, without its stop bit, or with noise is not among those read: DMA is
 * never asked to move it (RM0410, 34.8.3, DDRE = 0), its flag is all that tells of it. The parity
 * is the ninth bit of a character, which DMA leaves behind, as it moves the lower eight.
 *
 * A receiver must lie in DTCM (KEEL_REALTIME_ZERO). DMA 1 and 2 reach that through the core's AHBS
 * port (RM0410, 2.1), and no cache is between: elsewhere the core would read what its cache kept.
 *
 * All counts and times stay at UINT32_MAX.
 */
#ifndef KEEL_BSP_STM32F767_RECEIVER_H
#define KEEL_BSP_STM32F767_RECEIVER_H

#include "common/bsp_status.h"
#include "common/wait.h"
#include "stm32f767/registers/dma.h"
#include "stm32f767/registers/uart.h"

#include <stdbool.h>
#include <stdint.h>

/** Bytes of the ring; a power of two. */
#define KEEL_RECEIVER_CAPACITY 512u

/** Bytes that may come from look to look, and that may be unread. The rest of the ring is for a
 *  sender that is faster than its line, and for bytes that come between a look and a reading. */
#define KEEL_RECEIVER_TRUSTED 448u

/** The lowest rate of a line, in bits per second. */
#define KEEL_RECEIVER_BAUD_MIN 300u

/** The bits of a line: for a byte a start bit, 8 data bits, the parity if there is one, stops. */
typedef struct keel_line {
    uint32_t baud;    /**< Bits per second, at least KEEL_RECEIVER_BAUD_MIN. */
    bool even_parity; /**< Behind the data; else there is none. */
    bool two_stops;   /**< Else one. */
    bool inverted;    /**< A line at rest is low. */
} keel_line_t;

/** SBUS: 100 000 baud, even parity, two stop bits, inverted. */
extern const keel_line_t keel_line_sbus;

/** CRSF: 420 000 baud. Receivers have that or 416 666, which differs by less than 1 %. */
extern const keel_line_t keel_line_crsf;

/** IBUS, MAVLink and most satellite receivers: 115 200 baud. */
extern const keel_line_t keel_line_115200;

/** What a receiver is made from. */
typedef struct keel_receiver_config {
    keel_uart_t *uart;       /**< With its clock on. */
    keel_dma_t *dma;         /**< With its clock on. */
    uint32_t stream;         /**< Of the DMA that hears the UART, 0 to 7 (RM0410, 8.3.3). */
    uint32_t channel;        /**< Of the stream: the one of the UART's receiver, 0 to 15. */
    uint32_t clock_hz;       /**< The UART's clock. */
    const keel_wait_t *wait; /**< The bound for the stream to stop, some cycles. */
    keel_line_t line;        /**< The bits. */
    bool sends;              /**< Whether the UART also sends, with the same bits. */
} keel_receiver_config_t;

/** What came, and what did not. A look counts an error once, however often it was. */
typedef struct keel_receiver_count {
    uint32_t bytes;     /**< Bytes that looks found. */
    uint32_t parity;    /**< Looks behind a wrong parity. */
    uint32_t framing;   /**< Looks behind a missing stop bit. */
    uint32_t noise;     /**< Looks behind a bit whose samples differ. */
    uint32_t overruns;  /**< Looks behind bytes that DMA did not take in time. */
    uint32_t laps;      /**< Times that bytes may have been overwritten, and unread ones were
                             forgotten. */
    uint32_t transfers; /**< Times that DMA stopped for a bus error, and was started again. */
} keel_receiver_count_t;

/** A receiver. The caller owns it, in DTCM; only the functions below and DMA write it. */
typedef struct keel_receiver {
    keel_receiver_config_t config; /**< What it was started with. */
    keel_receiver_count_t count;   /**< Since its start. */
    uint32_t byte_us;              /**< The time of a byte, in us. */
    uint32_t trusted_us;           /**< The time of KEEL_RECEIVER_TRUSTED bytes, in us. */
    uint32_t look_us;              /**< The time of the last look, in us, modulo 2^32. */
    uint32_t quiet_us;             /**< At that look, since the last byte. */
    uint32_t head;                 /**< Bytes found, modulo 2^32; modulo the capacity, where DMA
                                        writes the next. */
    uint32_t tail;                 /**< Bytes read or forgotten, modulo 2^32. */
    uint32_t elapsed_us[KEEL_RECEIVER_CAPACITY];   /**< Of each byte, since the one before. */
    volatile uint8_t ring[KEEL_RECEIVER_CAPACITY]; /**< Written by DMA. */
} keel_receiver_t;

/** A byte. */
typedef struct keel_receiver_byte {
    uint32_t elapsed_us; /**< Since the byte that was read before, or since the start, in us. */
    uint8_t value;       /**< The data. */
} keel_receiver_byte_t;

/**
 * Starts a receiver, or starts it anew, with another line say: what was unread is forgotten, and
 * counts begin at 0 (requirements REC-001 to REC-003). A receiver that was started already must
 * have the same UART and stream.
 *
 * @param receiver the receiver
 * @param config   what it is made from; copied
 * @param now_us   the time, in us, modulo 2^32
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT as keel_serial_divisor, or for a lower rate than
 *         KEEL_RECEIVER_BAUD_MIN, a stream above 7 or a channel above 15: the receiver and the
 *         hardware are as they were; KEEL_BSP_TIMEOUT when the stream does not stop: then the UART
 *         is off, and the receiver as it was
 */
keel_bsp_status_t keel_receiver_start(keel_receiver_t *receiver,
                                      const keel_receiver_config_t *config, uint32_t now_us);

/**
 * Looks at the bytes and errors that came: to be called in every turn of the main loop, and before
 * a task reads when turns may take long (requirements REC-004 to REC-007). Never waits.
 *
 * When more than KEEL_RECEIVER_TRUSTED bytes may have come since the last look, or are unread,
 * some may be overwritten. Then all are forgotten, and elapsed_us of the next byte tells the gap.
 *
 * @param receiver the receiver, started
 * @param now_us   the time, in us, modulo 2^32; less than 2^32 us after the last look
 */
void keel_receiver_turn(keel_receiver_t *receiver, uint32_t now_us);

/**
 * Reads the next byte that a look found; never waits (requirement REC-008).
 *
 * @param receiver the receiver, started
 * @param byte     the byte
 * @return whether there is one; else byte is as it was
 */
bool keel_receiver_read(keel_receiver_t *receiver, keel_receiver_byte_t *byte);

/**
 * Sends a byte if the line takes one; never waits, and keeps none (requirement REC-009).
 *
 * @param receiver the receiver, started
 * @param value    the byte
 * @return whether it is on its way; false, too, when the receiver was not started to send
 */
bool keel_receiver_send(keel_receiver_t *receiver, uint8_t value);

#endif
