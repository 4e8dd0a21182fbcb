/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/i2c_bus.h"

#include <stdbool.h>
#include <stddef.h>

#define NANOSECONDS 1000000000u /* In a second. */

/* UM10204, table 10: fast mode. */
#define PERIOD_NS 2500u
#define HIGH_NS   600u
#define SETUP_NS  100u
#define RISE_NS   300u
#define FALL_NS   300u

/* RM0410, 33.4.5: the analogue filter's least delay, and clocks until an edge is seen. */
#define FILTER_MIN_NS 50u
#define PERIOD_CLOCKS 4u
#define HOLD_CLOCKS   3u
#define VALID_CLOCKS  4u
#define HOLD_MOST_NS  340u /* Data are valid in 900: less 300 of rising, and 260 of the filter. */

#define DIVISOR_MAX 16u
#define SETUP_MAX   16u
#define CLOCKS      9u /* UM10204, 3.1.16. */
#define FAILURES    (I2C_ISR_NACKF | I2C_ISR_BERR | I2C_ISR_ARLO | I2C_ISR_OVR)
#define ALL_FLAGS                                                                                  \
    (I2C_ICR_NACKCF | I2C_ICR_STOPCF | I2C_ICR_BERRCF | I2C_ICR_ARLOCF | I2C_ICR_OVRCF)

/* A clock, and what it is divided by to make a tick. */
typedef struct i2c_ticks {
    uint32_t clock_hz;
    uint32_t divisor;
} i2c_ticks_t;

/* An exchange that is under way. */
typedef struct i2c_exchange {
    const keel_i2c_device_t *device;
    uint32_t looks; /* So many are left. */
    uint32_t done;  /* Bytes. */
} i2c_exchange_t;

/* How many ticks make a time full, when a few clocks of it pass anyway; rounded up, these are no
 * more than it has, whatever clock is taken. */
static uint32_t ticks_for(i2c_ticks_t ticks, uint32_t time_ns, uint32_t clocks)
{
    const uint64_t tick = (uint64_t)NANOSECONDS * ticks.divisor;
    const uint64_t time = ((uint64_t)time_ns * ticks.clock_hz) + (tick - 1u);
    const uint64_t passed = (uint64_t)NANOSECONDS * clocks;

    return (uint32_t)((time - passed) / tick);
}

/* The most ticks until data are valid; that VALID_CLOCKS are no longer than the time is known. */
static uint32_t most_hold_ticks(i2c_ticks_t ticks)
{
    const uint64_t time = (uint64_t)HOLD_MOST_NS * ticks.clock_hz;
    const uint64_t passed = (uint64_t)NANOSECONDS * VALID_CLOCKS;

    return (uint32_t)((time - passed) / ((uint64_t)NANOSECONDS * ticks.divisor));
}

/* Whether all fits with a divisor; then the timing. Low and high times are one tick longer than
 * their fields say. A tick that is long enough for the setup time in its field is so for all. The
 * high time leaves a low time of more than 1300 ns in a period. */
static bool fit_timing(i2c_ticks_t ticks, uint32_t *timing)
{
    const uint32_t setup = ticks_for(ticks, RISE_NS + SETUP_NS, 0u);
    const uint32_t hold = ticks_for(ticks, FALL_NS - FILTER_MIN_NS, HOLD_CLOCKS);
    const uint32_t high = ticks_for(ticks, HIGH_NS, 0u);
    const uint32_t low = ticks_for(ticks, PERIOD_NS - (2u * FILTER_MIN_NS), PERIOD_CLOCKS) - high;

    if ((setup > SETUP_MAX) || (hold > most_hold_ticks(ticks))) {
        return false;
    }
    *timing = FIELD(I2C_TIMINGR_PRESC, ticks.divisor - 1u) | FIELD(I2C_TIMINGR_SCLDEL, setup - 1u) |
              FIELD(I2C_TIMINGR_SDADEL, hold) | FIELD(I2C_TIMINGR_SCLH, high - 1u) |
              FIELD(I2C_TIMINGR_SCLL, low - 1u);
    return true;
}

keel_bsp_status_t keel_i2c_timing(uint32_t clock_hz, uint32_t *timing)
{
    const uint64_t valid = (uint64_t)HOLD_MOST_NS * clock_hz;
    bool fits = false;

    if (valid < ((uint64_t)NANOSECONDS * VALID_CLOCKS)) {
        return KEEL_BSP_ARGUMENT;
    }
    for (uint32_t divisor = 1u; (divisor <= DIVISOR_MAX) && !fits; divisor++) {
        fits = fit_timing((i2c_ticks_t){clock_hz, divisor}, timing);
    }
    return fits ? KEEL_BSP_OK : KEEL_BSP_ARGUMENT;
}

keel_bsp_status_t keel_i2c_start(keel_i2c_t *i2c, uint32_t clock_hz)
{
    uint32_t timing;

    if (keel_i2c_timing(clock_hz, &timing) != KEEL_BSP_OK) {
        return KEEL_BSP_ARGUMENT;
    }
    i2c->CR1 = 0u; /* Off while it is set up; the analogue filter is on. */
    i2c->CR2 = 0u;
    i2c->OAR1 = 0u; /* It is nobody's device. */
    i2c->OAR2 = 0u;
    i2c->TIMEOUTR = 0u;
    i2c->TIMINGR = timing;
    i2c->CR1 = I2C_CR1_PE;
    return KEEL_BSP_OK;
}

/* Off for three clocks of its bus at least, which reading back takes, and on again (RM0410,
 * 33.4.6): the lines are let go, and nothing is under way. That clears the flags, too. */
static void restart_i2c(keel_i2c_t *i2c)
{
    i2c->CR1 &= ~I2C_CR1_PE;
    (void)i2c->CR1;
    (void)i2c->CR1;
    (void)i2c->CR1;
    i2c->ICR = ALL_FLAGS;
    i2c->CR1 |= I2C_CR1_PE;
}

/* Sets a line, and lets half a clock pass. */
static void move_line(const keel_i2c_device_t *device, keel_pin_t line, bool high)
{
    keel_pin_write(line, high);
    device->pause(device->pause_context);
}

static bool lines_are_high(const keel_i2c_device_t *device)
{
    return keel_pin_read(device->scl) && keel_pin_read(device->sda);
}

keel_bsp_status_t keel_i2c_bus_free(const keel_i2c_device_t *device)
{
    keel_bsp_status_t status;

    keel_pin_output(device->sda, KEEL_DRIVE_OPEN_DRAIN, true);
    keel_pin_output(device->scl, KEEL_DRIVE_OPEN_DRAIN, true);
    for (uint32_t i = 0u; (i < CLOCKS) && !keel_pin_read(device->sda); i++) {
        move_line(device, device->scl, false);
        move_line(device, device->scl, true);
    }
    move_line(device, device->scl, false);
    move_line(device, device->sda, false);
    move_line(device, device->scl, true);
    move_line(device, device->sda, true); /* SDA rises while SCL is high: a stop condition. */
    status = lines_are_high(device) ? KEEL_BSP_OK : KEEL_BSP_STUCK;
    keel_pin_alternate_open_drain(device->scl, device->function, KEEL_PULL_NONE);
    keel_pin_alternate_open_drain(device->sda, device->function, KEEL_PULL_NONE);
    restart_i2c(device->i2c);
    return status;
}

/* Waits for a flag, within the exchange's bound. */
static keel_bsp_status_t await_flag(i2c_exchange_t *exchange, uint32_t flag)
{
    const keel_wait_t *const wait = exchange->device->wait;

    while (exchange->looks > 0u) {
        uint32_t state;

        if ((wait->between != NULL) && (exchange->looks < wait->looks)) {
            wait->between(wait->context);
        }
        exchange->looks--;
        state = exchange->device->i2c->ISR;
        if ((state & FAILURES) != 0u) {
            return KEEL_BSP_BUS;
        }
        if ((state & flag) != 0u) {
            return KEEL_BSP_OK;
        }
    }
    return KEEL_BSP_TIMEOUT;
}

static void begin_i2c_bytes(const keel_i2c_device_t *device, uint32_t count, uint32_t options)
{
    device->i2c->CR2 = FIELD(I2C_CR2_SADD, (uint32_t)device->address << 1u) |
                       FIELD(I2C_CR2_NBYTES, count) | options | I2C_CR2_START;
}

/* Writes bytes: each is asked for when the one before was acknowledged; a flag ends the last. */
static keel_bsp_status_t write_i2c_bytes(i2c_exchange_t *exchange, const uint8_t *out,
                                         uint32_t count, uint32_t end)
{
    keel_bsp_status_t status = await_flag(exchange, I2C_ISR_TXIS);

    while ((exchange->done < count) && (status == KEEL_BSP_OK)) {
        const bool last = (exchange->done + 1u) == count;

        exchange->device->i2c->TXDR = out[exchange->done];
        status = await_flag(exchange, last ? end : I2C_ISR_TXIS);
        exchange->done += (status == KEEL_BSP_OK) ? 1u : 0u;
    }
    return status;
}

/* Reads bytes behind the first, up to the stop condition. */
static keel_bsp_status_t read_i2c_bytes(i2c_exchange_t *exchange, uint8_t *in, uint32_t length)
{
    keel_bsp_status_t status = KEEL_BSP_OK;

    begin_i2c_bytes(exchange->device, length - 1u, I2C_CR2_RD_WRN | I2C_CR2_AUTOEND);
    while ((exchange->done < length) && (status == KEEL_BSP_OK)) {
        status = await_flag(exchange, I2C_ISR_RXNE);
        if (status == KEEL_BSP_OK) {
            in[exchange->done] = (uint8_t)exchange->device->i2c->RXDR;
            exchange->done++;
        }
    }
    return (status == KEEL_BSP_OK) ? await_flag(exchange, I2C_ISR_STOPF) : status;
}

static keel_bsp_status_t move_i2c_bytes(i2c_exchange_t *exchange, const uint8_t *out, uint8_t *in,
                                        uint32_t length)
{
    keel_bsp_status_t status;

    if ((in == NULL) || (length == 1u)) {
        begin_i2c_bytes(exchange->device, length, I2C_CR2_AUTOEND);
        status = write_i2c_bytes(exchange, out, length, I2C_ISR_STOPF);
    } else {
        begin_i2c_bytes(exchange->device, 1u, 0u);
        status = write_i2c_bytes(exchange, out, 1u, I2C_ISR_TC);
        if (status == KEEL_BSP_OK) {
            status = read_i2c_bytes(exchange, in, length);
        }
    }
    return status;
}

/* Behind a byte that was not acknowledged the bus makes a stop condition by itself, which is waited
 * for: cut off, it would leave the other devices within a byte. */
static void end_failure(i2c_exchange_t *exchange)
{
    keel_i2c_t *const i2c = exchange->device->i2c;

    if ((i2c->ISR & I2C_ISR_NACKF) != 0u) {
        i2c->ICR = I2C_ICR_NACKCF;
        (void)await_flag(exchange, I2C_ISR_STOPF);
    }
    restart_i2c(i2c);
}

keel_bsp_status_t keel_i2c_bus_exchange(void *context, const uint8_t *out, uint8_t *in,
                                        uint32_t length, uint32_t *done)
{
    const keel_i2c_device_t *const device = context;
    i2c_exchange_t exchange = {device, device->wait->looks, 0u};
    keel_bsp_status_t status;

    *done = 0u;
    if ((length == 0u) || (length > KEEL_I2C_BYTES)) {
        return KEEL_BSP_ARGUMENT;
    }
    if (((device->i2c->ISR & I2C_ISR_BUSY) != 0u) || !lines_are_high(device)) {
        (void)keel_i2c_bus_free(device); /* If that fails, the next exchange tries again. */
        return KEEL_BSP_BUS;
    }
    status = move_i2c_bytes(&exchange, out, in, length);
    if (status == KEEL_BSP_OK) {
        device->i2c->ICR = I2C_ICR_STOPCF;
    } else {
        end_failure(&exchange);
    }
    *done = exchange.done;
    return status;
}
