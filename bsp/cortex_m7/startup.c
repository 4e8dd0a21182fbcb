/* SPDX-License-Identifier: Apache-2.0 */
#include "cortex_m7/startup.h"

#include "board.h"
#include "console.h"
#include "cortex_m7/core.h"
#include "cortex_m7/fault.h"
#include "cortex_m7/memory.h"

#define SCB ((keel_scb_t *)SCB_BASE)
#define FPU ((keel_fpu_t *)FPU_BASE)
#define MPU ((keel_mpu_t *)MPU_BASE)

/* What the core has at the same place on every ARMv7-M (Architecture Reference Manual, B3.3, B3.4
 * and B3.2.4). */
#define SYSTICK_CTRL (*(volatile uint32_t *)0xE000E010u)
#define NVIC_DISABLE ((volatile uint32_t *)0xE000E180u) /* ICER. */
#define NVIC_FORGET  ((volatile uint32_t *)0xE000E280u) /* ICPR. */
#define NVIC_WORDS   ((KEEL_BOARD_INTERRUPTS + 31u) / 32u)
#define ICSR_FORGET  (BITS(25u, 1u) | BITS(27u, 1u)) /* PENDSTCLR, PENDSVCLR. */

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

/* As a reset leaves them, whatever a boot loader did: every interrupt would be a fault here, and
 * its regions of memory are not Keel's. */
static void stop_leftovers(void)
{
    __asm volatile("cpsid i" ::: "memory");
    MPU->CTRL = 0u;
    SYSTICK_CTRL = 0u;
    for (uint32_t i = 0u; i < NVIC_WORDS; i++) {
        NVIC_DISABLE[i] = UINT32_MAX;
        NVIC_FORGET[i] = UINT32_MAX;
    }
    SCB->ICSR = ICSR_FORGET;
    /* Masked exceptions would all be hard faults. */
    __asm volatile("dsb\n\tisb\n\tmsr basepri, %0\n\tcpsie f\n\tcpsie i" ::"r"(0u) : "memory");
}

static void fill_itcm(void)
{
    copy(keel_itcm_load, keel_itcm_start, keel_itcm_end);
    __asm volatile("dsb\n\tisb" ::: "memory");
}

static void fill_memory(void)
{
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

/* What is to be told at the end of an application. */
static void end(int status) __attribute__((noreturn));

static void end(int status)
{
    keel_board_outputs_off();
    keel_console_text("stack: ");
    keel_console_number(keel_stack_used_b());
    keel_console_text(" of ");
    keel_console_number((uint32_t)keel_stack_top - (uint32_t)keel_stack_bottom);
    keel_console_text((status == 0) ? " bytes used\nended\n"
                                    : " bytes used\nended with a failure\n");
    keel_board_halt(status);
}

/* Where a reset ends that follows a fault, unless the application has allowed another: the fault is
 * told, and there is no application. */
static void stay_safe(void) __attribute__((noreturn));

static void stay_safe(void)
{
    keel_board_outputs_off();
    keel_console_text("safe state: ");
    keel_fault_print();
    keel_console_text("outputs are off; reset to start again\n");
    keel_board_halt(KEEL_SAFE_STATUS);
}

void keel_reset(void)
{
    bool restarts;

    stop_leftovers();
    start_fpu();
    start_faults();
    keel_board_early();
    fill_itcm();
    keel_board_open_record();
    paint_stack();
    fill_memory();
    keel_mpu_start(keel_board_regions, keel_board_region_count);
    keel_board_start();
    restarts = keel_fault_take_restart();
    if (keel_fault_take() && !restarts) {
        stay_safe();
    }
    end(main());
}
