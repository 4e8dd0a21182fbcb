/* SPDX-License-Identifier: Apache-2.0 */
/* The vector table of a board without interrupts: every exception but the reset is a fault. */
#include "cortex_m7/fault.h"
#include "cortex_m7/memory.h"
#include "cortex_m7/startup.h"

#define SYSTEM_VECTORS 16u
#define VECTORS        (SYSTEM_VECTORS + KEEL_BOARD_INTERRUPTS)

typedef void (*vector_t)(void);

/* The first two words are the stack and the entry; the rest are handlers. */
typedef struct vector_table {
    const uint32_t *stack;
    vector_t entry;
    vector_t handler[VECTORS - 2u];
} vector_table_t;

extern const vector_table_t keel_vector_table;

/* clang-format off: the range initializer is the compiler's extension. */
__attribute__((section(".vectors"), used)) const vector_table_t keel_vector_table = {
    keel_stack_top, keel_reset, {[0 ... VECTORS - 3u] = keel_fault_handler}};
/* clang-format on */
