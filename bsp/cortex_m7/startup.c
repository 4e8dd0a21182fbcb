#include "cortex_m7/startup.h"

#include "board.h"
#include "cortex_m7/core.h"
#include "cortex_m7/fault.h"
#include "cortex_m7/memory.h"

#define SCB ((keel_scb_t *)SCB_BASE)
#define FPU ((keel_fpu_t *)FPU_BASE)

#define PAINT_ROOM_B 64u
#define CPACR_FULL   0xFu /* Full access to both halves of the FPU. */

int main(void);

static void copy(const uint32_t *load, uint32_t *start, const uint32_t *end)
{
    for (uint32_t *to = start; to < end; to++) {
        *to = load[to - start];
    }
}

static void fill(uint32_t *start, const uint32_t *end, uint32_t value)
{
    for (volatile uint32_t *to = start; to < end; to++) {
        *to = value;
    }
}

/* Up to what is in use, with room for the call that does it. */
static void paint_stack(void)
{
    uint32_t sp;

    __asm volatile("mov %0, sp" : "=r"(sp));
    fill(keel_stack_bottom, (const uint32_t *)(sp - PAINT_ROOM_B), KEEL_STACK_PAINT);
}

uint32_t keel_stack_used_b(void)
{
    const uint32_t *lowest = keel_stack_bottom;

    while ((lowest < keel_stack_top) && (*lowest == KEEL_STACK_PAINT)) {
        lowest++;
    }
    return (uint32_t)keel_stack_top - (uint32_t)lowest;
}

static void fill_memory(void)
{
    copy(keel_itcm_load, keel_itcm_start, keel_itcm_end);
    copy(keel_dtcm_load, keel_dtcm_start, keel_dtcm_end);
    copy(keel_data_load, keel_data_start, keel_data_end);
    fill(keel_dtcm_bss_start, keel_dtcm_bss_end, 0u);
    fill(keel_bss_start, keel_bss_end, 0u);
    __asm volatile("dsb\n\tisb" ::: "memory");
}

/* The FPU's registers are stacked only when a handler uses the FPU: lazy stacking. */
static void start_fpu(void)
{
    SCB->CPACR |= FIELD(SCB_CPACR_CP, CPACR_FULL);
    FPU->FPCCR |= FPU_FPCCR_ASPEN | FPU_FPCCR_LSPEN;
    __asm volatile("dsb\n\tisb" ::: "memory");
}

static void start_faults(void)
{
    SCB->VTOR = (uint32_t)keel_vectors;
    SCB->SHCSR |= SCB_SHCSR_MEMFAULTENA | SCB_SHCSR_BUSFAULTENA | SCB_SHCSR_USGFAULTENA;
    SCB->CCR |= SCB_CCR_DIV_0_TRP | SCB_CCR_STKALIGN;
    __asm volatile("dsb\n\tisb" ::: "memory");
}

void keel_reset(void)
{
    start_fpu();
    start_faults();
    keel_board_early();
    paint_stack();
    fill_memory();
    keel_mpu_start(keel_board_regions, keel_board_region_count);
    keel_board_start();
    if (keel_fault_take()) {
        keel_board_safe();
    }
    keel_board_end(main());
}
