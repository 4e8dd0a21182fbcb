/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/serial.h"

#define DIVISOR_MIN 16u
#define DIVISOR_MAX 65535u
#define TOLERANCE   50u /* 1 in 50: 2 %. */

keel_bsp_status_t keel_serial_divisor(uint32_t clock_hz, uint32_t baud, uint32_t *divisor)
{
    const uint64_t rate = baud;
    const uint64_t rounded = (clock_hz + (rate / 2u)) / rate;
    const uint32_t nearest = (uint32_t)rounded;
    uint64_t made;
    uint64_t off;

    if ((nearest < DIVISOR_MIN) || (nearest > DIVISOR_MAX)) {
        return KEEL_BSP_ARGUMENT;
    }
    made = (uint64_t)nearest * baud;
    off = (made > clock_hz) ? (made - clock_hz) : (clock_hz - made);
    if ((off * TOLERANCE) > clock_hz) {
        return KEEL_BSP_ARGUMENT;
    }
    *divisor = nearest;
    return KEEL_BSP_OK;
}

keel_bsp_status_t keel_serial_start(keel_serial_t *serial, keel_uart_t *uart, uint32_t clock_hz,
                                    uint32_t baud)
{
    uint32_t divisor;

    if (keel_serial_divisor(clock_hz, baud, &divisor) != KEEL_BSP_OK) {
        return KEEL_BSP_ARGUMENT;
    }
    serial->uart = uart;
    serial->head = 0u;
    serial->tail = 0u;
    serial->dropped = 0u;
    uart->CR1 = 0u; /* The rate can only change while the line is off. */
    uart->CR2 = 0u;
    uart->CR3 = 0u;
    uart->BRR = divisor;
    uart->CR1 = UART_CR1_UE | UART_CR1_TE | UART_CR1_RE;
    return KEEL_BSP_OK;
}

void keel_serial_put(keel_serial_t *serial, char character)
{
    if ((serial->head - serial->tail) < KEEL_SERIAL_CAPACITY) {
        serial->text[serial->head % KEEL_SERIAL_CAPACITY] = (uint8_t)character;
        serial->head++;
    } else if (serial->dropped < UINT32_MAX) {
        serial->dropped++;
    } else {
        /* The count stays at its maximum. */
    }
}

static void send(keel_serial_t *serial)
{
    serial->uart->TDR = serial->text[serial->tail % KEEL_SERIAL_CAPACITY];
    serial->tail++;
}

void keel_serial_pump(keel_serial_t *serial)
{
    if ((serial->head != serial->tail) && ((serial->uart->ISR & UART_ISR_TXE) != 0u)) {
        send(serial);
    }
}

keel_bsp_status_t keel_serial_flush(keel_serial_t *serial, const keel_wait_t *wait)
{
    while (serial->head != serial->tail) {
        if (!keel_wait_for(&serial->uart->ISR, UART_ISR_TXE, UART_ISR_TXE, wait)) {
            return KEEL_BSP_TIMEOUT;
        }
        send(serial);
    }
    return keel_wait_for(&serial->uart->ISR, UART_ISR_TC, UART_ISR_TC, wait) ? KEEL_BSP_OK
                                                                             : KEEL_BSP_TIMEOUT;
}

bool keel_serial_get(keel_serial_t *serial, char *character)
{
    const uint32_t state = serial->uart->ISR;

    if ((state & UART_ISR_ORE) != 0u) {
        serial->uart->ICR = UART_ICR_ORECF; /* Or the receiver would take nothing more. */
    }
    if ((state & UART_ISR_RXNE) == 0u) {
        return false;
    }
    *character = (char)(uint8_t)serial->uart->RDR;
    return true;
}
