/* SPDX-License-Identifier: Apache-2.0 */
#include "cortex_m7/fault.h"

#include "board.h"
#include "console.h"
#include "cortex_m7/core.h"
#include "cortex_m7/memory.h"
#include "cortex_m7/reset.h"

#include <stddef.h>

#define SCB ((keel_scb_t *)SCB_BASE)

#define MAGIC           0x4B46524Du
#define STACKED         8u /* Registers that the core stacks. */
#define STACKED_B       32u
#define EXC_RETURN_PSP  4u      /* Bit of EXC_RETURN: the process stack was in use. */
#define STATUS_UNSTACK  0x3838u /* CFSR: stacking or unstacking failed, in memory or on the bus. */
#define ICSR_VECTACTIVE 0x1FFu
#define ICSR_RETTOBASE  BITS(11u, 1u) /* No other exception is active. */
#define WORD_B          4u
#define CHECK_SEED      0x811C9DC5u /* FNV-1a. */
#define CHECK_PRIME     0x01000193u
#define RESTARTS        0x52535452u

/* Kept over a reset; not cleared at the start. */
static keel_fault_record_t keel_fault_record __attribute__((section(".backup")));

/* A word with its complement: a fault may come before memory is filled, when both are anything. */
typedef struct checked_word {
    volatile uint32_t value;
    volatile uint32_t complement;
} checked_word_t;

static checked_word_t watched; /* The scheduler's address. */
static checked_word_t stop_code;

/* Behind the record, and kept as that is: RESTARTS if the application is to be started again. */
static checked_word_t restarts __attribute__((section(".backup.restarts")));

static void set_checked(checked_word_t *word, uint32_t value)
{
    word->value = value;
    word->complement = ~value;
}

/* The word, or 0 if it was never set. */
static uint32_t get_checked(const checked_word_t *word)
{
    const uint32_t value = word->value;

    return (word->complement == ~value) ? value : 0u;
}

void keel_fault_watch(const keel_scheduler_t *scheduler)
{
    set_checked(&watched, (uint32_t)scheduler);
}

static uint32_t check_of(const keel_fault_record_t *record)
{
    const uint8_t *const byte = (const uint8_t *)record;
    uint32_t check = CHECK_SEED;

    for (size_t i = 0u; i < offsetof(keel_fault_record_t, check); i++) {
        check = (check ^ byte[i]) * CHECK_PRIME;
    }
    return check;
}

bool keel_fault_is_whole(const keel_fault_record_t *record)
{
    return (record->magic == MAGIC) && (record->check == check_of(record));
}

void keel_fault_seal(keel_fault_record_t *record)
{
    record->magic = MAGIC;
    record->check = check_of(record);
}

const keel_fault_record_t *keel_fault_last(void)
{
    return keel_fault_is_whole(&keel_fault_record) ? &keel_fault_record : NULL;
}

bool keel_fault_take(void)
{
    const bool fresh = (keel_fault_last() != NULL) && (keel_fault_record.fresh == 1u);

    if (fresh) {
        keel_fault_record.fresh = 0u;
        keel_fault_seal(&keel_fault_record);
    }
    return fresh;
}

void keel_fault_allow_restart(bool allowed)
{
    set_checked(&restarts, allowed ? RESTARTS : 0u);
}

bool keel_fault_take_restart(void)
{
    const bool allowed = get_checked(&restarts) == RESTARTS;

    keel_fault_allow_restart(false);
    return allowed;
}

static bool lies_in(uint32_t address, uint32_t size_b, const uint32_t *start, const uint32_t *end)
{
    return (address >= (uint32_t)start) && (address < (uint32_t)end) &&
           (size_b <= ((uint32_t)end - address));
}

/* Whether reading there cannot fault: constants in flash, stack and data in DTCM, data in SRAM. */
static bool is_readable(const void *object, uint32_t size_b)
{
    const uint32_t address = (uint32_t)object;

    return lies_in(address, size_b, keel_vectors, keel_data_load) ||
           lies_in(address, size_b, keel_stack_bottom, keel_dtcm_bss_end) ||
           lies_in(address, size_b, keel_data_start, keel_bss_end);
}

/* The same for a structure, whose words must be aligned. */
static bool is_sound(const void *structure, uint32_t size_b)
{
    return (((uint32_t)structure % WORD_B) == 0u) && is_readable(structure, size_b);
}

/* The name of the task that runs, as far as a broken system can be believed; or null. */
static const char *running_name(void)
{
    const keel_scheduler_t *const scheduler = (const keel_scheduler_t *)get_checked(&watched);
    const keel_task_config_t *task;
    uint32_t slot;

    /* A position of none, or any that is negative, is a large one then. */
    if (!is_sound(scheduler, sizeof *scheduler) ||
        ((uint32_t)scheduler->running >= KEEL_QUEUE_CAPACITY)) {
        return NULL;
    }
    slot = scheduler->queue.order[scheduler->running];
    if (slot >= KEEL_QUEUE_CAPACITY) {
        return NULL;
    }
    task = scheduler->queue.task[slot];
    return is_sound(task, sizeof *task) ? task->name : NULL;
}

/* The name is read as a whole before the record changes, which is whole already. */
static void note_task(keel_fault_record_t *record)
{
    char copy[KEEL_FAULT_NAME_SIZE];
    const char *name = running_name();

    for (uint32_t i = 0u; i < KEEL_FAULT_NAME_SIZE; i++) {
        const bool more = (i < (KEEL_FAULT_NAME_SIZE - 1u)) && is_readable(name, 1u) &&
                          (*name != '\0');

        copy[i] = more ? *name : '\0';
        name = more ? &name[1] : NULL;
    }
    for (uint32_t i = 0u; i < KEEL_FAULT_NAME_SIZE; i++) {
        record->task[i] = copy[i];
    }
    keel_fault_seal(record);
}

/* The registers that the core stacked, unless stacking them is what failed. */
static void note_stacked(keel_fault_record_t *record, uint32_t sp)
{
    const uint32_t *const stacked = (const uint32_t *)sp;
    uint32_t *const target[STACKED] = {&record->r0,  &record->r1, &record->r2, &record->r3,
                                       &record->r12, &record->lr, &record->pc, &record->xpsr};
    const bool on_stack = (sp >= (uint32_t)keel_stack_bottom) &&
                          (sp <= ((uint32_t)keel_stack_top - STACKED_B));
    const bool readable = on_stack && ((record->cfsr & STATUS_UNSTACK) == 0u);

    record->stacked = readable ? 1u : 0u;
    for (uint32_t i = 0u; i < STACKED; i++) {
        *target[i] = readable ? stacked[i] : 0u;
    }
}

/**
 * Records and resets. Called by the handler alone, on the fault stack.
 *
 * @param sp         the stack pointer at the fault
 * @param exc_return the handler's link register
 * @param registers  r4 to r11
 */
void keel_fault_finish(uint32_t sp, uint32_t exc_return, const uint32_t *registers)
    __attribute__((noreturn, used));

void keel_fault_finish(uint32_t sp, uint32_t exc_return, const uint32_t *registers)
{
    keel_fault_record_t *const record = &keel_fault_record;
    uint32_t before;

    /* Nothing before this, not even a look at the record: its memory may be what faults. */
    keel_board_outputs_off();
    if ((SCB->ICSR & ICSR_RETTOBASE) == 0u) { /* A fault in this handler: the record is as it is. */
        keel_core_reset();
    }
    before = keel_fault_is_whole(record) ? record->count : 0u;
    record->magic = 0u;
    record->count = before + 1u;
    record->fresh = 1u;
    record->number = SCB->ICSR & ICSR_VECTACTIVE;
    record->code = get_checked(&stop_code);
    record->sp = sp;
    record->exc_return = exc_return;
    record->cfsr = SCB->CFSR;
    record->hfsr = SCB->HFSR;
    record->mmfar = SCB->MMFAR;
    record->bfar = SCB->BFAR;
    note_stacked(record, sp);
    for (uint32_t i = 0u; i < KEEL_FAULT_REGISTERS; i++) {
        record->r4_to_r11[i] = registers[i];
    }
    for (uint32_t i = 0u; i < KEEL_FAULT_NAME_SIZE; i++) {
        record->task[i] = '\0';
    }
    keel_fault_seal(record);
    note_task(record);
    keel_core_reset();
}

/* Takes a stack of its own: the one in use may be what is broken. It never returns. */
__attribute__((naked)) void keel_fault_handler(void)
{
    __asm volatile("cpsid i\n\t"
                   "mov r1, lr\n\t"
                   "tst lr, #4\n\t" /* EXC_RETURN_PSP */
                   "ite eq\n\t"
                   "mrseq r0, msp\n\t"
                   "mrsne r0, psp\n\t"
                   "ldr r2, =keel_fault_stack_top\n\t"
                   "mov sp, r2\n\t"
                   "push {r4-r11}\n\t"
                   "mov r2, sp\n\t"
                   "b keel_fault_finish\n\t"
                   ".ltorg");
}

void keel_fault_stop(uint32_t code)
{
    set_checked(&stop_code, code);
    __asm volatile("udf #0");
    for (;;) {
    }
}

static void print_word(const char *label, uint32_t value)
{
    keel_console_text(label);
    keel_console_hex(value);
}

void keel_fault_print(void)
{
    const keel_fault_record_t *const record = keel_fault_last();

    if (record == NULL) {
        keel_console_text("no fault\n");
        return;
    }
    keel_console_text("fault ");
    keel_console_number(record->count);
    keel_console_text(" exception ");
    keel_console_number(record->number);
    print_word(" code ", record->code);
    keel_console_text(" task ");
    keel_console_text((record->task[0] != '\0') ? record->task : "-");
    print_word("\n  cfsr ", record->cfsr);
    print_word(" hfsr ", record->hfsr);
    print_word(" mmfar ", record->mmfar);
    print_word(" bfar ", record->bfar);
    print_word("\n  sp ", record->sp);
    print_word(" exc_return ", record->exc_return);
    keel_console_text((record->stacked == 1u) ? "\n  stacked" : "\n  not stacked");
    print_word(" pc ", record->pc);
    print_word(" lr ", record->lr);
    print_word(" xpsr ", record->xpsr);
    print_word("\n  r0 ", record->r0);
    print_word(" r1 ", record->r1);
    print_word(" r2 ", record->r2);
    print_word(" r3 ", record->r3);
    print_word(" r12 ", record->r12);
    print_word("\n  r4 ", record->r4_to_r11[0]);
    for (uint32_t i = 1u; i < KEEL_FAULT_REGISTERS; i++) {
        keel_console_text(" ");
        keel_console_hex(record->r4_to_r11[i]);
    }
    keel_console_text("\n");
}
