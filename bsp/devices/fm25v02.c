/* SPDX-License-Identifier: Apache-2.0 */
#include "devices/fm25v02.h"

#include <stddef.h>

#define WRITE_BYTES   0x02u
#define READ_BYTES    0x03u
#define ENABLE_WRITES 0x06u
#define READ_IDENTITY 0x9Fu

#define HEAD_BYTES     3u /* Opcode and address. */
#define PIECE_BYTES    ((uint32_t)KEEL_SLOTS_PIECE)
#define TRANSFER_BYTES (HEAD_BYTES + PIECE_BYTES)

#define IDENTITY_BYTES 8u /* The ninth is the revision. */

/* One exchange in which all bytes must come. */
static keel_bsp_status_t exchange_all(const keel_bus_t *bus, const uint8_t *out, uint8_t *in,
                                      uint32_t length)
{
    uint32_t done = 0u;
    const keel_bsp_status_t status = bus->exchange(bus->context, out, in, length, &done);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    return (done == length) ? KEEL_BSP_OK : KEEL_BSP_SHORT;
}

static bool is_within_memory(uint32_t address, uint32_t count)
{
    return (count > 0u) && (count <= PIECE_BYTES) && (address <= (KEEL_FM25V02_BYTES - count));
}

static void put_head(uint8_t *out, uint8_t opcode, uint32_t address)
{
    out[0] = opcode;
    out[1] = (uint8_t)((address >> 8u) & 0xFFu);
    out[2] = (uint8_t)(address & 0xFFu);
}

keel_bsp_status_t keel_fm25v02_start(const keel_bus_t *bus)
{
    /* The maker's number is in the seventh bank of JEDEC's; then family and density. */
    static const uint8_t identity[IDENTITY_BYTES] = {0x7Fu, 0x7Fu, 0x7Fu, 0x7Fu,
                                                     0x7Fu, 0x7Fu, 0xC2u, 0x22u};
    static const uint8_t out[1u + IDENTITY_BYTES] = {[0] = READ_IDENTITY};
    uint8_t in[1u + IDENTITY_BYTES] = {[0] = 0u};
    const keel_bsp_status_t status = exchange_all(bus, out, in, sizeof out);
    bool same = true;
    bool zeros = true;
    bool ones = true;

    if (status != KEEL_BSP_OK) {
        return status;
    }
    for (uint32_t i = 0u; i < IDENTITY_BYTES; i++) {
        same = same && (in[1u + i] == identity[i]);
        zeros = zeros && (in[1u + i] == 0x00u);
        ones = ones && (in[1u + i] == 0xFFu);
    }
    if (zeros || ones) {
        return KEEL_BSP_STUCK;
    }
    return same ? KEEL_BSP_OK : KEEL_BSP_ID;
}

keel_bsp_status_t keel_fm25v02_read(const keel_bus_t *bus, uint32_t address, uint8_t *bytes,
                                    uint32_t count)
{
    uint8_t out[TRANSFER_BYTES] = {[0] = 0u};
    uint8_t in[TRANSFER_BYTES] = {[0] = 0u};
    keel_bsp_status_t status;

    if (!is_within_memory(address, count)) {
        return KEEL_BSP_ARGUMENT;
    }
    put_head(out, READ_BYTES, address);
    status = exchange_all(bus, out, in, HEAD_BYTES + count);
    if (status != KEEL_BSP_OK) {
        return status;
    }
    for (uint32_t i = 0u; i < count; i++) {
        bytes[i] = in[HEAD_BYTES + i];
    }
    return KEEL_BSP_OK;
}

keel_bsp_status_t keel_fm25v02_write(const keel_bus_t *bus, uint32_t address, const uint8_t *bytes,
                                     uint32_t count)
{
    static const uint8_t enable[1] = {ENABLE_WRITES};
    uint8_t out[TRANSFER_BYTES] = {[0] = 0u};
    uint8_t in[TRANSFER_BYTES] = {[0] = 0u};
    keel_bsp_status_t status;

    if (!is_within_memory(address, count)) {
        return KEEL_BSP_ARGUMENT;
    }
    put_head(out, WRITE_BYTES, address);
    for (uint32_t i = 0u; i < count; i++) {
        out[HEAD_BYTES + i] = bytes[i];
    }
    status = exchange_all(bus, enable, in, sizeof enable);
    if (status != KEEL_BSP_OK) {
        return status;
    }
    return exchange_all(bus, out, in, HEAD_BYTES + count);
}

static bool read_medium(void *context, uint32_t address, uint8_t *bytes, uint32_t count)
{
    const keel_bus_t *const bus = context;

    return keel_fm25v02_read(bus, address, bytes, count) == KEEL_BSP_OK;
}

static bool write_medium(void *context, uint32_t address, const uint8_t *bytes, uint32_t count)
{
    const keel_bus_t *const bus = context;

    return keel_fm25v02_write(bus, address, bytes, count) == KEEL_BSP_OK;
}

keel_medium_t keel_fm25v02_medium(keel_bus_t *bus)
{
    const keel_medium_t medium = {
        .read = read_medium, .write = write_medium, .erase = NULL, .context = bus};

    return medium;
}
