/* SPDX-License-Identifier: Apache-2.0 */
/* The processor, with its memories: Unicorn executes the image's instructions. */
#include "model.h"

#include "cortex_m7/core.h"
#include "stm32f767/registers/factory.h"
#include "stm32f767/registers/memory.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unicorn/unicorn.h>

#define ITCM_SIZE     0x4000u
#define FLASH_SIZE    0x200000u
#define SRAM_BASE     0x20020000u
#define SRAM_SIZE     0x60000u
#define BACKUP_BASE   0x40024000u
#define BACKUP_SIZE   0x1000u
#define FACTORY_START 0x1FF0F000u
#define FACTORY_SIZE  0x1000u
#define STACK_GUARD   0x400u

#define NOISE     0xA5u /* What memory holds that nobody has filled. */
#define ERASED    0xFFu
#define TASKS     32u
#define IT_BITS   0x0600FC00u
#define WIDE_FROM 0x1Du /* The upper five bits of an instruction of two halfwords. */
#define CACHED    0x10000u

#define STACKED     32u /* Bytes that an exception stacks. */
#define THUMB       (1u << 24u)
#define TO_THREAD   0xFFFFFFF9u /* EXC_RETURN: to the main stack, without the FPU's registers. */
#define USAGE_FAULT 6u
#define UNDEFINED   0x10000u /* UNDEFINSTR, of CFSR. */
#define NO_TASK     UINT32_MAX

/* What the chip's maker measured: the reference at 3.3 V, the temperature at 30 and 110 degrees. */
static const uint16_t calibration[3] = {1502u, 943u, 1186u};

/* A memory. */
typedef struct model_area {
    uint32_t start;
    uint32_t size;
    uint32_t rights;  /* Of the processor. */
    uint32_t guarded; /* The same while the protection is on. */
    uint8_t fill;
    bool keeps; /* Its content, over a reset. */
    uint8_t *bytes;
} model_area_t;

/* A block's instructions, by where it begins. */
typedef struct model_block {
    uint32_t address;
    uint16_t size;
    uint16_t instructions;
} model_block_t;

/* Runs of a task that take longer. */
typedef struct model_delay {
    uint32_t runs;
    uint32_t extra_us;
} model_delay_t;

static uint8_t itcm[ITCM_SIZE] __attribute__((aligned(4096)));
static uint8_t flash[FLASH_SIZE] __attribute__((aligned(4096)));
static uint8_t dtcm[MODEL_DTCM_SIZE] __attribute__((aligned(4096)));
static uint8_t sram[SRAM_SIZE] __attribute__((aligned(4096)));
static uint8_t backup[BACKUP_SIZE] __attribute__((aligned(4096)));
static uint8_t factory[FACTORY_SIZE] __attribute__((aligned(4096)));

#define READ    ((uint32_t)UC_PROT_READ)
#define WRITE   ((uint32_t)UC_PROT_WRITE)
#define EXECUTE ((uint32_t)UC_PROT_EXEC)

static const model_area_t areas[] = {
    {0u, ITCM_SIZE, READ | WRITE | EXECUTE, READ | EXECUTE, NOISE, false, itcm},
    {MEMORY_FLASH_BASE, FLASH_SIZE, READ | EXECUTE, READ | EXECUTE, ERASED, true, flash},
    {MODEL_DTCM, STACK_GUARD, READ | WRITE, 0u, NOISE, false, dtcm},
    {MODEL_DTCM + STACK_GUARD, MODEL_DTCM_SIZE - STACK_GUARD, READ | WRITE, READ | WRITE, NOISE,
     false, &dtcm[STACK_GUARD]},
    {SRAM_BASE, SRAM_SIZE, READ | WRITE, READ | WRITE, NOISE, false, sram},
    {BACKUP_BASE, BACKUP_SIZE, READ | WRITE, READ | WRITE, NOISE, true, backup},
    {FACTORY_START, FACTORY_SIZE, READ, 0u, ERASED, true, factory},
};
#define AREAS (sizeof areas / sizeof areas[0])

static uc_engine *engine; /* Null: there was no start yet. */
static uint32_t vectors;  /* Where the image lies. */
static uint32_t pc;
static bool is_guarded;
static bool has_stopped; /* A block was not executed. */
static bool reset_wanted;
static model_cause_t cause;
static bool expects_faults;
static bool hangs;          /* No instruction is executed, … */
static uint32_t hangs_with; /* … or none from the end of this task's next run on. */
static uint32_t pending;    /* An exception; 0: none. */
static uint32_t pending_status;
static uint32_t active; /* Likewise. */
static uint32_t watched;
static model_delay_t delays[TASKS];
static model_block_t blocks[CACHED];

uint8_t *model_memory(uint32_t address, uint32_t size)
{
    for (uint32_t i = 0u; i < AREAS; i++) {
        const uint32_t offset = address - areas[i].start;

        if ((offset < areas[i].size) && (size <= (areas[i].size - offset))) {
            return &areas[i].bytes[offset];
        }
    }
    return NULL;
}

static uint32_t word_at(uint32_t address)
{
    const uint8_t *const bytes = model_memory(address, sizeof(uint32_t));
    uint32_t word = 0u;

    if (bytes != NULL) {
        memcpy(&word, bytes, sizeof word);
    }
    return word;
}

/* --- Time: the instructions of a block. --- */

static uint32_t count_instructions(uint32_t address, uint32_t size)
{
    const uint8_t *const code = model_memory(address, size);
    uint32_t count = 0u;
    uint32_t at = 0u;

    while ((code != NULL) && (at < size)) {
        at += ((uint32_t)(code[at + 1u] >> 3u) >= WIDE_FROM) ? 4u : 2u;
        count++;
    }
    return count;
}

static uint32_t instructions_of(uint32_t address, uint32_t size)
{
    model_block_t *const block = &blocks[(address >> 1u) % CACHED];

    if ((block->address != address) || (block->size != size)) {
        *block = (model_block_t){address, (uint16_t)size,
                                 (uint16_t)count_instructions(address, size)};
    }
    return block->instructions;
}

/* Within an IT block execution cannot begin anew. */
static bool may_stop(void)
{
    uint32_t status = 0u;

    (void)uc_reg_read(engine, UC_ARM_REG_CPSR, &status);
    return (status & IT_BITS) == 0u;
}

/* A task's run ends; it may take longer. */
static void pass_delay(void)
{
    uint32_t task = 0u;

    (void)uc_reg_read(engine, UC_ARM_REG_R1, &task);
    hangs = hangs || (task == hangs_with);
    if ((task < TASKS) && (delays[task].runs > 0u)) {
        delays[task].runs--;
        model_pass((uint64_t)delays[task].extra_us * MODEL_TICKS_PER_US);
    }
}

static void meet_block(uc_engine *uc, uint64_t address, uint32_t size, void *context)
{
    (void)context;
    if (has_stopped) {
        return;
    }
    if ((model_time_is_up() || reset_wanted || (pending != 0u) || hangs || model_clock.failed) &&
        may_stop()) {
        has_stopped = true;
        (void)uc_emu_stop(uc);
        return;
    }
    model_pass((uint64_t)instructions_of((uint32_t)address, size) * model_instruction_ticks);
    if ((uint32_t)address == watched) {
        pass_delay();
    }
}

/* --- What the processor meets. --- */

static uint64_t read_register(uc_engine *uc, uint64_t offset, unsigned size, void *context)
{
    (void)uc;
    return model_read(*(const uint32_t *)context + (uint32_t)offset, size);
}

static void write_register(uc_engine *uc, uint64_t offset, unsigned size, uint64_t value,
                           void *context)
{
    (void)uc;
    model_write(*(const uint32_t *)context + (uint32_t)offset, size, (uint32_t)value);
}

static const char *kind_of(uc_mem_type type)
{
    if (type == UC_MEM_WRITE) {
        return "writes to";
    }
    return (type == UC_MEM_FETCH) ? "executes" : "reads";
}

static uint32_t right_of(uc_mem_type type)
{
    if (type == UC_MEM_WRITE) {
        return WRITE;
    }
    return (type == UC_MEM_FETCH) ? EXECUTE : READ;
}

static bool is_register(uint32_t address)
{
    return ((address - MODEL_CHIP) < MODEL_CHIP_SIZE) || ((address - MODEL_CORE) < MODEL_CORE_SIZE);
}

/* What the processor may do with a page. */
static uint32_t rights_of(uint32_t address)
{
    for (uint32_t i = 0u; i < AREAS; i++) {
        if ((address - areas[i].start) < areas[i].size) {
            return is_guarded ? areas[i].guarded : areas[i].rights;
        }
    }
    return is_register(address) ? (READ | WRITE) : 0u;
}

/* Unicorn (2.1.4) sets the state of an IT block for the instruction that meets a page, and leaves
 * it set behind a load or a store: what follows would be skipped. Within a block of instructions it
 * is to be clear. */
static void forget_condition(uc_engine *uc)
{
    uint32_t status = 0u;

    (void)uc_reg_read(uc, UC_ARM_REG_CPSR, &status);
    if ((status & IT_BITS) != 0u) {
        status &= ~IT_BITS;
        (void)uc_reg_write(uc, UC_ARM_REG_CPSR, &status);
    }
}

/* Where the processor goes for the first time; data that are no code are stored quickly. */
static bool meet_page(uc_engine *uc, uint64_t address, uc_mem_type type, uc_tlb_entry *entry,
                      void *context)
{
    const uint32_t rights = rights_of((uint32_t)address);
    uint32_t at = 0u;

    (void)context;
    entry->paddr = address;
    entry->perms = (uc_prot)rights;
    if ((rights & right_of(type)) != 0u) {
        if (type != UC_MEM_FETCH) {
            forget_condition(uc);
        }
        return true;
    }
    (void)uc_reg_read(uc, UC_ARM_REG_PC, &at);
    model_fail("the code at 0x%08x %s the page at 0x%08x, where it may not", at, kind_of(type),
               (uint32_t)address);
    return false;
}

/* --- Start, and run. --- */

static bool map_registers(void)
{
    static const uint32_t starts[] = {MODEL_CHIP, BACKUP_BASE + BACKUP_SIZE, MODEL_CORE};
    static const uint32_t ends[] = {BACKUP_BASE, MODEL_CHIP + MODEL_CHIP_SIZE,
                                    MODEL_CORE + MODEL_CORE_SIZE};
    bool good = true;

    for (uint32_t i = 0u; i < (sizeof starts / sizeof starts[0]); i++) {
        void *const context = (void *)&starts[i];

        good = good && (uc_mmio_map(engine, starts[i], ends[i] - starts[i], read_register, context,
                                    write_register, context) == UC_ERR_OK);
    }
    return good;
}

static bool map_memories(void)
{
    bool good = true;

    for (uint32_t i = 0u; i < AREAS; i++) {
        memset(areas[i].bytes, areas[i].fill, areas[i].size);
        good = good && (uc_mem_map_ptr(engine, areas[i].start, areas[i].size,
                                       READ | WRITE | EXECUTE, areas[i].bytes) == UC_ERR_OK);
    }
    return good;
}

static bool add_hooks(void)
{
    uc_hook hook;

    return (uc_ctl_tlb_mode(engine, UC_TLB_VIRTUAL) == UC_ERR_OK) &&
           (uc_hook_add(engine, &hook, UC_HOOK_BLOCK, (void *)meet_block, NULL, 1u, 0u) ==
            UC_ERR_OK) &&
           (uc_hook_add(engine, &hook, UC_HOOK_TLB_FILL, (void *)meet_page, NULL, 1u, 0u) ==
            UC_ERR_OK);
}

static void fill_factory(void)
{
    uint8_t *const uid = model_memory(UID_BASE, 12u);
    uint8_t *const measured = model_memory(VREFINTCAL_BASE, sizeof calibration);

    for (uint32_t i = 0u; i < 12u; i++) {
        uid[i] = (uint8_t)(0x41u + i);
    }
    memcpy(measured, calibration, sizeof calibration);
}

static bool load_image(const char *path, uint32_t address)
{
    FILE *const file = fopen(path, "rb");
    uint8_t *const place = model_memory(address, sizeof(uint32_t));
    size_t count = 0u;

    if ((file != NULL) && (place != NULL)) {
        count = fread(place, 1u, FLASH_SIZE - (address - MEMORY_FLASH_BASE), file);
    }
    if (file != NULL) {
        (void)fclose(file);
    }
    return count > 0u;
}

/* What a reset does: to memories without power, to registers, and to the processor. The backup
 * memory has no battery: without supply it is anything. */
static void begin(void)
{
    const uint32_t sp = word_at(vectors);
    const uint32_t nobody = UINT32_MAX;

    model_guard(false);
    if (cause == MODEL_BY_POWER) {
        model_devices_power();
    }
    model_registers_reset(cause);
    model_note(model_now(), MODEL_EVENT, MODEL_RESET_EVENT + (uint32_t)cause);
    for (uint32_t i = 0u; i < AREAS; i++) {
        const bool is_off = (cause == MODEL_BY_POWER) && (areas[i].bytes == backup);

        if (!areas[i].keeps || is_off) {
            memset(areas[i].bytes, areas[i].fill, areas[i].size);
        }
    }
    (void)uc_ctl_flush_tb(engine);
    (void)uc_reg_write(engine, UC_ARM_REG_SP, &sp);
    (void)uc_reg_write(engine, UC_ARM_REG_LR, &nobody);
    pc = word_at(vectors + 4u) & ~1u;
    reset_wanted = false;
    hangs = false;
    hangs_with = NO_TASK;
    pending = 0u;
    active = 0u;
}

bool model_processor_start(const char *path, uint32_t address)
{
    if (engine != NULL) {
        (void)uc_close(engine);
        engine = NULL;
    }
    vectors = address;
    is_guarded = false;
    expects_faults = false;
    cause = MODEL_BY_POWER;
    memset(delays, 0, sizeof delays);
    memset(blocks, 0, sizeof blocks);
    if ((uc_open(UC_ARCH_ARM, UC_MODE_THUMB, &engine) != UC_ERR_OK) ||
        (uc_ctl_set_cpu_model(engine, UC_CPU_ARM_CORTEX_M7) != UC_ERR_OK) || !map_memories() ||
        !map_registers() || !add_hooks()) {
        model_fail("the processor could not be made");
        return false;
    }
    if (!load_image(path, address)) {
        model_fail("%s could not be read", path);
        return false;
    }
    fill_factory();
    begin();
    return true;
}

void model_guard(bool on)
{
    if (on != is_guarded) {
        is_guarded = on;
        (void)uc_ctl_flush_tlb(engine);
    }
}

void model_reset(model_cause_t by)
{
    reset_wanted = true;
    cause = by;
}

void model_expect_faults(void)
{
    expects_faults = true;
}

void model_except(uint32_t number, uint32_t status)
{
    pending = number;
    pending_status = status;
}

uint32_t model_exception(void)
{
    return active;
}

void model_hang(void)
{
    hangs = true;
}

void model_hang_task(uint32_t task)
{
    hangs_with = task;
}

void model_watch(uint32_t address)
{
    watched = address & ~1u;
}

void model_delay(uint32_t task, uint32_t runs, uint32_t extra_us)
{
    if (task < TASKS) {
        delays[task] = (model_delay_t){runs, extra_us};
    }
}

/* Until the next stop. */
static void run_on(void)
{
    uc_err error;

    has_stopped = false;
    error = uc_emu_start(engine, pc | 1u, 0u, 0u, 0u);
    (void)uc_reg_read(engine, UC_ARM_REG_PC, &pc);
    pc &= ~1u;
    if (error == UC_ERR_OK) {
        return;
    }
    if (expects_faults && (error == UC_ERR_INSN_INVALID)) {
        model_except(USAGE_FAULT, UNDEFINED);
    } else if (!model_clock.failed) {
        uint32_t r0 = 0u;

        (void)uc_reg_read(engine, UC_ARM_REG_R0, &r0);
        model_fail("the processor stopped at 0x%08x with r0 0x%08x: %s", pc, r0,
                   uc_strerror(error));
    } else {
        /* It was told why. */
    }
}

/* The registers that the core stacks, from the lowest address on. */
static void stack_registers(void)
{
    static const int names[] = {UC_ARM_REG_R0,  UC_ARM_REG_R1, UC_ARM_REG_R2, UC_ARM_REG_R3,
                                UC_ARM_REG_R12, UC_ARM_REG_LR, UC_ARM_REG_PC, UC_ARM_REG_CPSR};
    uint32_t values[8];
    uint32_t sp = 0u;
    uint8_t *place;

    for (uint32_t i = 0u; i < 8u; i++) {
        (void)uc_reg_read(engine, names[i], &values[i]);
    }
    values[7] |= THUMB;
    (void)uc_reg_read(engine, UC_ARM_REG_SP, &sp);
    sp = (sp - STACKED) & ~7u;
    place = model_memory(sp, STACKED);
    if (place != NULL) {
        memcpy(place, values, STACKED);
    }
    (void)uc_reg_write(engine, UC_ARM_REG_SP, &sp);
}

/* The handler of the exception that is pending begins. */
static void enter_exception(void)
{
    const uint32_t back = TO_THREAD;

    if (active != 0u) {
        model_fail("exception %u in the handler of %u: lock-up", pending, active);
        return;
    }
    stack_registers();
    (void)uc_reg_write(engine, UC_ARM_REG_LR, &back);
    *model_word(SCB_BASE + offsetof(keel_scb_t, CFSR)) |= pending_status;
    active = pending;
    pending = 0u;
    pc = word_at(*model_word(SCB_BASE + offsetof(keel_scb_t, VTOR)) + (4u * active)) & ~1u;
    model_note(model_now(), MODEL_EVENT, active);
}

/* The watchdog's time is up. */
static void bite(void)
{
    if (expects_faults) {
        model_reset(MODEL_BY_WATCHDOG);
    } else {
        model_fail("the watchdog was not fed");
    }
}

/* Up to a time, or to the watchdog's, whichever is the first. */
static void run_piece(uint64_t until)
{
    const uint64_t bites_at = model_bites_at();

    model_clock_limit((bites_at < until) ? bites_at : until);
    if (hangs) {
        (void)model_wait(UINT64_MAX);
    } else {
        run_on();
    }
    if (model_now() >= model_bites_at()) {
        bite();
    }
}

void model_processor_run(void)
{
    const uint64_t until = model_clock.limit;

    while ((model_now() < until) && !model_clock.failed) {
        run_piece(until);
        if (reset_wanted) {
            begin();
        } else if (pending != 0u) {
            enter_exception();
        } else {
            /* It goes on. */
        }
    }
    model_clock_limit(until);
}
