/* SPDX-License-Identifier: Apache-2.0 */
#include "memory.h"

#include "common/slots.h"
#include "console.h"
#include "stm32f767/target/chip.h"

#define COUNT_BYTES 4u

static uint32_t count_of(const uint8_t *bytes)
{
    uint32_t count = 0u;

    for (uint32_t i = 0u; i < COUNT_BYTES; i++) {
        count |= (uint32_t)bytes[i] << (8u * i);
    }
    return count;
}

static void put_count(uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0u; i < COUNT_BYTES; i++) {
        bytes[i] = (uint8_t)((count >> (8u * i)) & 0xFFu);
    }
}

static keel_slots_result_t save(keel_slots_t *slots, const uint8_t *bytes)
{
    keel_slots_result_t result = KEEL_SLOTS_BUSY;

    if (keel_slots_begin(slots, bytes, COUNT_BYTES) != KEEL_OK) {
        return KEEL_SLOTS_WRITE;
    }
    while (result == KEEL_SLOTS_BUSY) {
        result = keel_slots_step(slots);
    }
    return result;
}

static void print_value(const char *label, uint32_t value)
{
    keel_console_text(label);
    keel_console_number(value);
}

/* The slots are as large as the count, not as the memory gives room for. */
static void count_start(const keel_slots_config_t *config)
{
    static keel_slots_t slots;
    static uint8_t kept[COUNT_BYTES];
    uint32_t length = 0u;
    keel_slots_result_t result;

    if (keel_slots_init(&slots, config) != KEEL_OK) {
        keel_console_text(" no room");
        return;
    }
    result = keel_slots_load(&slots, kept, &length);
    print_value(" load ", (uint32_t)result);
    if ((result != KEEL_SLOTS_DONE) || (length != COUNT_BYTES)) {
        put_count(kept, 0u);
    }
    if ((config->medium.erase == NULL) && (result != KEEL_SLOTS_READ)) {
        put_count(kept, count_of(kept) + 1u);
        result = save(&slots, kept);
        print_value(" save ", (uint32_t)result);
    }
    print_value(" starts ", count_of(kept));
}

void print_memory(void)
{
    keel_slots_config_t config = {.room = COUNT_BYTES};
    uint32_t slot_bytes = 0u;
    const keel_bsp_status_t status = keel_chip_memory(&config.medium, &slot_bytes);

    print_value("memory status ", (uint32_t)status);
    if (status == KEEL_BSP_OK) {
        config.address[1] = slot_bytes;
        count_start(&config);
    }
    keel_console_text("\n");
}
