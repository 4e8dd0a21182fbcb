/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file registers.h
 * @brief A device that is a set of registers of eight bits on an SPI bus, where bit 7 of the
 *        address says that a register is read: its identity, and settings that must read back.
 *
 * A setting is some bits of a register. The others, which a data sheet reserves, stay as they are.
 */
#ifndef KEEL_BSP_DEVICES_REGISTERS_H
#define KEEL_BSP_DEVICES_REGISTERS_H

#include "common/bsp_status.h"
#include "common/bus.h"

#include <stdint.h>

/** Bit 7 of the address: a register is read. */
#define KEEL_REGISTERS_READ 0x80u

/** What a device has to take a setting before it is read back, in us. */
#define KEEL_REGISTERS_SETTLE_US 1000u

/** Waits; returns KEEL_BSP_OK, or why it could not. */
typedef keel_bsp_status_t (*keel_delay_fn_t)(void *context, uint32_t time_us);

/** A device. The caller owns it. */
typedef struct keel_registers {
    keel_bus_t bus;        /**< The bus, with the device selected. */
    keel_delay_fn_t delay; /**< Waits between the steps of a start. */
    void *delay_context;   /**< Handed to delay; may be null. */
} keel_registers_t;

/** Some bits of a register, and what they are to be. */
typedef struct keel_setting {
    uint8_t address; /**< The register, 0 to 0x7F. */
    uint8_t mask;    /**< The bits … */
    uint8_t value;   /**< … and what they are to be; 0 in all others. */
} keel_setting_t;

/**
 * Reads a register.
 *
 * @param bus     the bus, with the device selected
 * @param address the register, 0 to 0x7F
 * @param value   what it says
 * @return KEEL_BSP_OK, or KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT, with value as it was
 */
keel_bsp_status_t keel_register_read(const keel_bus_t *bus, uint8_t address, uint8_t *value);

/**
 * Writes a register, and waits.
 *
 * @param device  the device
 * @param setting the register with its value; all bits are written, whatever the mask
 * @param time_us how long, in us
 * @return KEEL_BSP_OK, or the reason of the bus or of the delay
 */
keel_bsp_status_t keel_register_write(const keel_registers_t *device, keel_setting_t setting,
                                      uint32_t time_us);

/**
 * Whether a register says that this is the device.
 *
 * @param device   the device
 * @param identity the register, and what it must say
 * @return KEEL_BSP_OK; KEEL_BSP_STUCK when it reads all zeros or all ones; KEEL_BSP_ID; or the
 *         reason of the bus
 */
keel_bsp_status_t keel_register_identify(const keel_registers_t *device, keel_setting_t identity);

/**
 * Whether settings are as they should be; nothing is written.
 *
 * @param device  the device
 * @param setting the settings
 * @param count   how many
 * @return KEEL_BSP_OK, KEEL_BSP_VERIFY at the first that is not, or the reason of the bus
 */
keel_bsp_status_t keel_settings_check(const keel_registers_t *device, const keel_setting_t *setting,
                                      uint32_t count);

/**
 * Writes settings in their order, and reads each back.
 *
 * @param device  the device
 * @param setting the settings
 * @param count   how many
 * @return as keel_settings_check, or the reason of the delay
 */
keel_bsp_status_t keel_settings_write(const keel_registers_t *device, const keel_setting_t *setting,
                                      uint32_t count);

#endif
