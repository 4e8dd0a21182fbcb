/* SPDX-License-Identifier: Apache-2.0 */
#include "devices/registers.h"

keel_bsp_status_t keel_register_read(const keel_bus_t *bus, uint8_t address, uint8_t *value)
{
    const uint8_t out[2] = {(uint8_t)(address | KEEL_REGISTERS_READ), 0u};
    uint8_t in[2] = {0u, 0u};
    const keel_bsp_status_t status = keel_bus_transfer(bus, out, in, 2u);

    if (status == KEEL_BSP_OK) {
        *value = in[1];
    }
    return status;
}

keel_bsp_status_t keel_register_write(const keel_registers_t *device, keel_setting_t setting,
                                      uint32_t time_us)
{
    const uint8_t out[2] = {setting.address, setting.value};
    uint8_t in[2] = {0u, 0u};
    const keel_bsp_status_t status = keel_bus_transfer(&device->bus, out, in, 2u);

    return (status == KEEL_BSP_OK) ? device->delay(device->delay_context, time_us) : status;
}

keel_bsp_status_t keel_register_identify(const keel_registers_t *device, keel_setting_t identity)
{
    uint8_t value = 0u;
    const keel_bsp_status_t status = keel_register_read(&device->bus, identity.address, &value);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    if (keel_bus_is_still(&value, 1u)) {
        return KEEL_BSP_STUCK;
    }
    return ((value & identity.mask) == identity.value) ? KEEL_BSP_OK : KEEL_BSP_ID;
}

static keel_bsp_status_t check_bits(const keel_registers_t *device, keel_setting_t setting)
{
    uint8_t value = 0u;
    const keel_bsp_status_t status = keel_register_read(&device->bus, setting.address, &value);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    return ((value & setting.mask) == setting.value) ? KEEL_BSP_OK : KEEL_BSP_VERIFY;
}

/* The bits outside of the mask are written as they were read. */
static keel_bsp_status_t write_setting(const keel_registers_t *device, keel_setting_t setting)
{
    uint8_t value = 0u;
    keel_bsp_status_t status = keel_register_read(&device->bus, setting.address, &value);

    if (status == KEEL_BSP_OK) {
        const keel_setting_t written = {
            setting.address, 0xFFu, (uint8_t)((value & (uint8_t)~setting.mask) | setting.value)};

        status = keel_register_write(device, written, KEEL_REGISTERS_SETTLE_US);
    }
    return (status == KEEL_BSP_OK) ? check_bits(device, setting) : status;
}

keel_bsp_status_t keel_settings_check(const keel_registers_t *device, const keel_setting_t *setting,
                                      uint32_t count)
{
    keel_bsp_status_t status = KEEL_BSP_OK;

    for (uint32_t i = 0u; (i < count) && (status == KEEL_BSP_OK); i++) {
        status = check_bits(device, setting[i]);
    }
    return status;
}

keel_bsp_status_t keel_settings_write(const keel_registers_t *device, const keel_setting_t *setting,
                                      uint32_t count)
{
    keel_bsp_status_t status = KEEL_BSP_OK;

    for (uint32_t i = 0u; (i < count) && (status == KEEL_BSP_OK); i++) {
        status = write_setting(device, setting[i]);
    }
    return status;
}
