/* SPDX-License-Identifier: Apache-2.0 */
/* The board that QEMU emulates as mps2-an500: console, time base, memory protection, its end. */
#include "board.h"

#include "cortex_m7/sleep.h"
#include "mps2_an500/emulator.h"

#define ELEMENTS(array) (sizeof(array) / sizeof((array)[0]))

/* CMSDK UART 0. */
typedef struct uart {
    volatile uint32_t DATA;
    volatile uint32_t STATE;
    volatile uint32_t CTRL;
    volatile uint32_t INTSTATUS;
    volatile uint32_t BAUDDIV;
} uart_t;

#define UART          ((uart_t *)0x40004000u)
#define UART_TX_FULL  1u
#define UART_TX_ON    1u
#define UART_BAUDDIV  217u /* 25 MHz / 115200. */
#define UART_PATIENCE 100000u

/* FPGA system control: a counter behind a prescaler, both driven by 25 MHz. */
typedef struct fpgaio {
    volatile uint32_t LED;
    volatile uint32_t reserved0;
    volatile uint32_t BUTTON;
    volatile uint32_t reserved1;
    volatile uint32_t CLK1HZ;
    volatile uint32_t CLK100HZ;
    volatile uint32_t COUNTER;
    volatile uint32_t PRESCALE;
} fpgaio_t;

#define FPGAIO           ((fpgaio_t *)0x40028000u)
#define TICKS_PER_US     25u
#define LOG2_NULL_GUARD  8u
#define LOG2_STACK_GUARD 10u

const char keel_board_name[] = "mps2_an500";

/* The guards come last: where regions overlap, the last one holds. */
const keel_mpu_region_t keel_board_regions[] = {
    {0x00000000u, 29u, KEEL_MPU_NONE}, /* Below RAM, but for the next two. */
    {0x00200000u, 21u, KEEL_MPU_CODE}, /* Flash. */
    {0x00000000u, 14u, KEEL_MPU_CODE}, /* ITCM. */
    {0x20000000u, 29u, KEEL_MPU_DATA}, /* DTCM and SRAM. */
    {0x60000000u, 29u, KEEL_MPU_DATA}, /* PSRAM, which stands for backup SRAM. */
    {0x00000000u, LOG2_NULL_GUARD, KEEL_MPU_NONE},
    {0x20000000u, LOG2_STACK_GUARD, KEEL_MPU_NONE},
};
const uint32_t keel_board_region_count = ELEMENTS(keel_board_regions);

void keel_board_early(void)
{
}

void keel_board_open_record(void)
{
}

void keel_board_start(void)
{
    UART->BAUDDIV = UART_BAUDDIV;
    UART->CTRL = UART_TX_ON;
    FPGAIO->PRESCALE = TICKS_PER_US - 1u;
    FPGAIO->COUNTER = 0u;
}

uint32_t keel_board_clock_us(void *context)
{
    (void)context;
    return FPGAIO->COUNTER;
}

void keel_board_sleep_us(uint32_t us)
{
    keel_core_sleep_us(us, TICKS_PER_US);
}

void keel_board_put(char c)
{
    for (uint32_t i = 0u; (i < UART_PATIENCE) && ((UART->STATE & UART_TX_FULL) != 0u); i++) {
    }
    UART->DATA = (uint8_t)c;
}

void keel_board_outputs_off(void)
{
    FPGAIO->LED = 0u; /* All outputs that this board has. */
}

/* They drive nothing that would have to notice. */
void keel_board_outputs_hold(void)
{
}

void keel_board_halt(int status)
{
    keel_emulator_exit(status);
}
