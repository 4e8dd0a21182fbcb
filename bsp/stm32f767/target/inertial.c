/* SPDX-License-Identifier: Apache-2.0 */
/* The inertial units of a board: up to three of four kinds, all on SPI 1. */
#include "board.h"
#include "devices/bmi055.h"
#include "devices/icm42688.h"
#include "devices/invensense.h"
#include "stm32f767/spi_bus.h"
#include "stm32f767/target/chip.h"
#include "stm32f767/target/chip_parts.h"

#include <stddef.h>

#define RCC  ((keel_rcc_t *)RCC_BASE)
#define SPI1 ((keel_spi_t *)SPI1_BASE)
#define PINS (&keel_board_pins)

#define POWER_ON_US 20000u                 /* A unit is up 11 ms after its supply. */
#define FORCE_UNIT  (9.80665f / 2048.0f)   /* In m/s^2. */
#define RATE_UNIT   (0.017453293f / 16.4f) /* In rad/s. */

/* A unit with the driver of its kind; those of the other kinds are not used. */
typedef struct inertial_unit {
    keel_spi_device_t device;        /* Of the BMI055, the gyroscope. */
    keel_spi_device_t accelerometer; /* Of the BMI055. */
    keel_invensense_t invensense;
    keel_bmi055_t bmi055;
    keel_icm42688_t icm42688;
} inertial_unit_t;

static inertial_unit_t inertial_unit[KEEL_CHIP_INERTIAL_UNITS] KEEL_REALTIME_ZERO;

uint32_t keel_chip_inertial_count(void)
{
    return keel_board_units.count;
}

/* Whatever else is on the bus is not selected before the first unit is. */
void keel_chip_inertial_begin(void)
{
    for (uint32_t i = 0u; i < keel_board_units.deselect_count; i++) {
        keel_chip_deselect(keel_board_units.deselect[i]);
    }
    for (uint32_t i = 0u; i < keel_board_units.count; i++) {
        keel_chip_deselect(keel_board_units.unit[i].select);
        keel_chip_deselect(keel_board_units.unit[i].accelerometer_select);
    }
    keel_chip_give_spi(PINS->sck, PINS->miso, PINS->mosi);
    keel_bits_enable(&RCC->APB2ENR, RCC_APB2ENR_SPI1EN);
    /* All kinds take the rate of the slowest: 108 MHz / 16 = 6.75 MHz. */
    keel_chip_require(keel_spi_start(SPI1, KEEL_APB2_LIMIT_HZ, keel_icm20689.bus_limit_hz));
    (void)keel_chip_delay(NULL, POWER_ON_US);
}

static keel_registers_t registers_at(keel_spi_device_t *device)
{
    return (keel_registers_t){{keel_spi_bus_exchange, device}, keel_chip_delay, NULL};
}

static keel_bsp_status_t start_invensense(inertial_unit_t *unit, const keel_invensense_kind_t *kind)
{
    unit->invensense = (keel_invensense_t){.kind = kind,
                                           .registers = registers_at(&unit->device),
                                           .sample_bus = {keel_spi_bus_exchange, &unit->device}};
    return keel_invensense_start(&unit->invensense);
}

static keel_bsp_status_t start_bmi055(inertial_unit_t *unit)
{
    unit->bmi055 = (keel_bmi055_t){.gyroscope = registers_at(&unit->device),
                                   .accelerometer = registers_at(&unit->accelerometer)};
    return keel_bmi055_start(&unit->bmi055);
}

static keel_bsp_status_t start_icm42688(inertial_unit_t *unit)
{
    unit->icm42688 = (keel_icm42688_t){.registers = registers_at(&unit->device)};
    return keel_icm42688_start(&unit->icm42688);
}

keel_bsp_status_t keel_chip_inertial_start(uint32_t number)
{
    keel_bsp_status_t status = KEEL_BSP_ARGUMENT;
    inertial_unit_t *unit;
    const keel_board_inertial_t *place;

    if (number >= keel_board_units.count) {
        return status;
    }
    unit = &inertial_unit[number];
    place = &keel_board_units.unit[number];
    unit->device = (keel_spi_device_t){SPI1, place->select, &keel_chip_byte_patience};
    unit->accelerometer = (keel_spi_device_t){SPI1, place->accelerometer_select,
                                              &keel_chip_byte_patience};
    switch (place->kind) {
    case KEEL_INERTIAL_ICM20689:
        status = start_invensense(unit, &keel_icm20689);
        break;
    case KEEL_INERTIAL_ICM20602:
        status = start_invensense(unit, &keel_icm20602);
        break;
    case KEEL_INERTIAL_BMI055:
        status = start_bmi055(unit);
        break;
    default: /* KEEL_INERTIAL_ICM42688. */
        status = start_icm42688(unit);
        break;
    }
    return status;
}

KEEL_REALTIME_CODE keel_bsp_status_t keel_chip_inertial_read(uint32_t number,
                                                             keel_inertial_sample_t *sample)
{
    keel_bsp_status_t status = KEEL_BSP_ARGUMENT;

    if (number >= keel_board_units.count) {
        return status;
    }
    switch (keel_board_units.unit[number].kind) {
    case KEEL_INERTIAL_ICM20689:
    case KEEL_INERTIAL_ICM20602:
        status = keel_invensense_read(&inertial_unit[number].invensense, sample);
        break;
    case KEEL_INERTIAL_BMI055:
        status = keel_bmi055_read(&inertial_unit[number].bmi055, sample);
        break;
    default: /* KEEL_INERTIAL_ICM42688. */
        status = keel_icm42688_read(&inertial_unit[number].icm42688, sample);
        break;
    }
    return status;
}

KEEL_REALTIME_CODE void keel_mounting_turn(const keel_mounting_t *mounting, const int16_t sensor[3],
                                           float unit, float body[3])
{
    for (uint32_t i = 0u; i < 3u; i++) {
        const int8_t axis = mounting->axis[i];
        const int16_t value = sensor[((axis < 0) ? -axis : axis) - 1];

        body[i] = unit * ((axis < 0) ? -(float)value : (float)value);
    }
}

KEEL_REALTIME_CODE keel_bsp_status_t keel_chip_motion(uint32_t number, keel_chip_motion_t *motion)
{
    keel_inertial_sample_t sample;
    const keel_bsp_status_t status = keel_chip_inertial_read(number, &sample);

    if (status == KEEL_BSP_OK) {
        const keel_mounting_t *const mounting = &keel_board_units.unit[number].mounting;

        keel_mounting_turn(mounting, sample.acceleration, FORCE_UNIT, motion->force);
        keel_mounting_turn(mounting, sample.rate, RATE_UNIT, motion->rate);
        motion->temperature_cdeg = sample.temperature_cdeg;
    }
    return status;
}
