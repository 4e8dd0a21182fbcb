/* SPDX-License-Identifier: Apache-2.0 */
/* SPI 1, 2 and 4 and I2C 3, as polled masters: who looks for the end of a byte waits for it. */
#include "model.h"

#include "stm32f767/registers/gpio.h"
#include "stm32f767/registers/i2c.h"
#include "stm32f767/registers/spi.h"

#include <stddef.h>
#include <string.h>

#define SPIS        3u
#define BITS_A_BYTE 8u
#define CORE_TICKS  2u /* A cycle's. */
#define FIELD_PLACE 0x0Eu
#define I2C_BIT     (MODEL_TICKS_PER_US * 5u / 2u) /* 400 kHz. */
#define I2C_BYTE    (9u * I2C_BIT)
#define I2C_TXE     1u /* Which the drivers do not look at. */
#define I2C_CLEARED (I2C_ISR_NACKF | I2C_ISR_STOPF | I2C_ISR_ARLO)
#define SCL_PORT    7u
#define SCL_PIN     7u
#define PORT_SIZE   0x400u
#define PULL_UP     1u

/* An SPI. */
typedef struct model_spi {
    uint32_t base;
    uint32_t divisor; /* Of the core's clock, for its bus. */
    uint64_t free_at; /* The byte that is on its way has come. */
    bool has;         /* A byte comes, or has come. */
    uint8_t byte;
} model_spi_t;

/* A device's seat. */
typedef struct model_seat {
    uint32_t base;
    uint8_t port;
    uint8_t pin;
    bool selected;
} model_seat_t;

/* I2C 3. */
typedef struct model_i2c {
    uint32_t flags; /* As they are from a time on; before the bus is busy. */
    uint64_t flags_at;
    uint32_t left; /* Bytes of the transfer. */
    uint8_t received;
} model_i2c_t;

/* What holds SDA low. */
typedef struct model_hold {
    bool holds;
    uint32_t clocks; /* Until it lets go; 0: it never does. */
    bool scl_is_low;
} model_hold_t;

static model_spi_t spis[SPIS];
static bool held[SPIS]; /* What they read is low. */
static model_hold_t hold;
static uint32_t noise; /* Of an input that nobody drives. */
static model_seat_t seats[MODEL_DEVICES];
static model_i2c_t i2c;

static uint32_t spi_word(const model_spi_t *spi, uint32_t offset)
{
    return *model_word(spi->base + offset);
}

void model_buses_start(void)
{
    memset(held, 0, sizeof held);
    hold = (model_hold_t){0};
    noise = 1u;
}

void model_buses_reset(void)
{
    static const model_spi_t spi[SPIS] = {{.base = SPI1_BASE, .divisor = 2u},
                                          {.base = SPI2_BASE, .divisor = 4u},
                                          {.base = SPI4_BASE, .divisor = 2u}};
    static const model_seat_t seat[MODEL_DEVICES] = {
        [MODEL_ICM20689] = {SPI1_BASE, 5u, 2u, false},
        [MODEL_GYROSCOPE] = {SPI1_BASE, 5u, 4u, false},
        [MODEL_ACCELEROMETER] = {SPI1_BASE, 6u, 10u, false},
        [MODEL_FRAM] = {SPI2_BASE, 5u, 5u, false},
        [MODEL_MS5611] = {SPI4_BASE, 5u, 10u, false}};

    memcpy(spis, spi, sizeof spis);
    memcpy(seats, seat, sizeof seats);
    i2c = (model_i2c_t){0};
    for (uint32_t i = 0u; i < (uint32_t)MODEL_DEVICES; i++) {
        model_device_select((model_device_t)i, false);
    }
}

void model_select(void)
{
    for (uint32_t i = 0u; i < (uint32_t)MODEL_DEVICES; i++) {
        const bool selected = model_pin_is_low(seats[i].port, seats[i].pin);

        if (selected != seats[i].selected) {
            seats[i].selected = selected;
            model_device_select((model_device_t)i, selected);
        }
    }
}

/* --- SPI. --- */

static model_spi_t *spi_of(uint32_t base)
{
    uint32_t i = 0u;

    while (spis[i].base != base) {
        i++;
    }
    return &spis[i];
}

static uint64_t byte_ticks(const model_spi_t *spi)
{
    const uint32_t code = keel_bits_get(spi_word(spi, offsetof(keel_spi_t, CR1)), SPI_CR1_BR);

    return (uint64_t)BITS_A_BYTE * CORE_TICKS * spi->divisor * (2u << code);
}

/* A byte of a line that nobody drives: as the pin is pulled, or anything. */
static uint8_t undriven(const model_spi_t *spi)
{
    static const uint8_t ports[SPIS] = {0u, 8u, 4u};
    static const uint8_t pins[SPIS] = {6u, 2u, 13u};
    const uint32_t number = (uint32_t)(spi - spis);
    const uint32_t pulls = *model_word(GPIOA_BASE + (PORT_SIZE * ports[number]) +
                                       offsetof(keel_gpio_t, PUPDR));
    const uint32_t pull = (pulls >> (2u * pins[number])) & 3u;

    noise = (noise * 1664525u) + 1013904223u;
    if (pull == 0u) {
        return (uint8_t)(noise >> 24u);
    }
    return (pull == PULL_UP) ? 0xFFu : 0u;
}

static uint8_t exchanged(const model_spi_t *spi, uint8_t byte)
{
    uint8_t answer = undriven(spi);
    uint32_t chosen = 0u;

    for (uint32_t i = 0u; i < (uint32_t)MODEL_DEVICES; i++) {
        if ((seats[i].base == spi->base) && seats[i].selected) {
            if (model_device_is_there((model_device_t)i)) {
                answer = model_device_exchange((model_device_t)i, byte);
            }
            chosen++;
        }
    }
    if (chosen > 1u) {
        model_fail("a byte goes to two devices at SPI 0x%08x", spi->base);
    }
    return held[spi - spis] ? 0u : answer;
}

void model_spi_hold(uint32_t spi, bool holds)
{
    held[(spi == 4u) ? 2u : (spi - 1u)] = holds;
}

uint32_t model_spi_read(uint32_t base, uint32_t offset)
{
    model_spi_t *const spi = spi_of(base);

    if (offset == offsetof(keel_spi_t, SR)) {
        const bool is_free = model_wait(spi->free_at);

        return is_free ? (SPI_SR_TXE | (spi->has ? SPI_SR_RXNE : 0u)) : SPI_SR_BSY;
    }
    if (offset == offsetof(keel_spi_t, DR)) {
        spi->has = false;
        return spi->byte;
    }
    return spi_word(spi, offset);
}

void model_spi_write(uint32_t base, uint32_t offset, uint32_t value)
{
    model_spi_t *const spi = spi_of(base);
    const uint64_t now = model_now();

    if (offset != offsetof(keel_spi_t, DR)) {
        *model_word(base + offset) = value;
    } else if ((spi_word(spi, offsetof(keel_spi_t, CR1)) & SPI_CR1_SPE) == 0u) {
        model_fail("a byte is sent while SPI 0x%08x is off", base);
    } else {
        spi->byte = exchanged(spi, (uint8_t)value);
        spi->has = true;
        spi->free_at = ((spi->free_at > now) ? spi->free_at : now) + byte_ticks(spi);
    }
}

/* --- I2C. --- */

static uint32_t i2c_word(uint32_t offset)
{
    return *model_word(I2C3_BASE + offset);
}

static void set_flags(uint32_t flags, uint64_t ticks)
{
    i2c.flags = flags;
    i2c.flags_at = model_now() + ticks;
}

/* Whoever sends a high bit while SDA is low has lost the bus. */
static void lose_bus(void)
{
    set_flags(I2C_ISR_BUSY | I2C_ISR_ARLO, I2C_BIT);
}

void model_i2c_hold(bool holds, uint32_t clocks)
{
    hold = (model_hold_t){holds, clocks, false};
    if (holds && (i2c.left > 0u)) {
        lose_bus();
    }
}

bool model_i2c_is_held(void)
{
    return hold.holds;
}

/* Each time that SCL rises is a clock. */
void model_i2c_look(void)
{
    const bool is_low = model_pin_is_low(SCL_PORT, SCL_PIN);

    if (hold.holds && hold.scl_is_low && !is_low && (hold.clocks > 0u)) {
        hold.clocks--;
        hold.holds = hold.clocks > 0u;
    }
    hold.scl_is_low = is_low;
}

/* The next byte, or the end. */
static void go_on(uint64_t ticks)
{
    const uint32_t control = i2c_word(offsetof(keel_i2c_t, CR2));

    if (hold.holds) {
        lose_bus();
    } else if ((i2c.left == 0u) && ((control & I2C_CR2_AUTOEND) != 0u)) {
        set_flags(I2C_ISR_STOPF, ticks + I2C_BIT);
    } else if (i2c.left == 0u) {
        set_flags(I2C_ISR_BUSY | I2C_ISR_TC, ticks);
    } else if ((control & I2C_CR2_RD_WRN) != 0u) {
        i2c.received = model_field_give();
        set_flags(I2C_ISR_BUSY | I2C_ISR_RXNE, ticks + I2C_BYTE);
    } else {
        set_flags(I2C_ISR_BUSY | I2C_ISR_TXIS, ticks);
    }
}

/* The address goes out. */
static void begin_transfer(uint32_t control)
{
    const uint32_t address = keel_bits_get(control, I2C_CR2_SADD) >> 1u;

    i2c.left = keel_bits_get(control, I2C_CR2_NBYTES);
    *model_word(I2C3_BASE + offsetof(keel_i2c_t, CR2)) = control & ~I2C_CR2_START;
    if (hold.holds) {
        lose_bus();
        return;
    }
    if ((address != FIELD_PLACE) || !model_field_is_there()) {
        set_flags(I2C_ISR_NACKF | I2C_ISR_STOPF, I2C_BYTE + (2u * I2C_BIT));
        return;
    }
    model_field_begin((control & I2C_CR2_RD_WRN) != 0u);
    go_on(I2C_BYTE + I2C_BIT);
}

uint32_t model_i2c_read(uint32_t offset)
{
    if (offset == offsetof(keel_i2c_t, ISR)) {
        return model_wait(i2c.flags_at) ? (i2c.flags | I2C_TXE) : I2C_ISR_BUSY;
    }
    if (offset == offsetof(keel_i2c_t, RXDR)) {
        const uint8_t byte = i2c.received;

        i2c.left -= (i2c.left > 0u) ? 1u : 0u;
        go_on(0u);
        return byte;
    }
    return i2c_word(offset);
}

void model_i2c_write(uint32_t offset, uint32_t value)
{
    *model_word(I2C3_BASE + offset) = value;
    if (offset == offsetof(keel_i2c_t, CR1)) {
        if ((value & I2C_CR1_PE) == 0u) {
            i2c = (model_i2c_t){0};
        }
    } else if (offset == offsetof(keel_i2c_t, ICR)) {
        i2c.flags &= ~(value & I2C_CLEARED);
    } else if ((offset == offsetof(keel_i2c_t, CR2)) && ((value & I2C_CR2_START) != 0u)) {
        begin_transfer(value);
    } else if (offset == offsetof(keel_i2c_t, TXDR)) {
        i2c.left -= (i2c.left > 0u) ? 1u : 0u;
        model_field_take((uint8_t)value);
        go_on(I2C_BYTE);
    } else {
        /* It is kept. */
    }
}
