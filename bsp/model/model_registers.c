/* SPDX-License-Identifier: Apache-2.0 */
/* Registers of the chip and of its core, as far as the images of FMUv5 use them. */
#include "model.h"

#include "cortex_m7/core.h"
#include "stm32f767/registers/adc.h"
#include "stm32f767/registers/adc_common.h"
#include "stm32f767/registers/dbgmcu.h"
#include "stm32f767/registers/dma.h"
#include "stm32f767/registers/flash.h"
#include "stm32f767/registers/gpio.h"
#include "stm32f767/registers/i2c.h"
#include "stm32f767/registers/iwdg.h"
#include "stm32f767/registers/pwr.h"
#include "stm32f767/registers/rcc.h"
#include "stm32f767/registers/sdmmc.h"
#include "stm32f767/registers/spi.h"
#include "stm32f767/registers/tim.h"
#include "stm32f767/registers/uart.h"

#include <stddef.h>
#include <string.h>

#define APB2      0x40010000u
#define AHB       0x40020000u
#define PORTS     9u
#define PORT_SIZE 0x400u
#define SYSTICK   0xE000E010u
#define NVIC      0xE000E100u
#define SYSTEM    0xE000ED00u /* SCB, MPU and FPU. */

/* Ticks of four clocks of a bus, which an access takes: at 54 MHz, at 108 MHz, and at 216 MHz. */
#define APB1_TICKS 32u
#define APB2_TICKS 16u
#define AHB_TICKS  8u

#define FAST_TICKS 2u  /* Of an instruction at 216 MHz, … */
#define SLOW_TICKS 27u /* … and at 16 MHz. */
#define OF_PLL     2u  /* The core's clock. */

#define NMI            2u            /* The exception. */
#define CSS_FAILED     BITS(7u, 1u)  /* Of CIR: the clock security system. */
#define ICSR_RETTOBASE BITS(11u, 1u) /* No other exception is active. */
/* Of CSR: flags, a reset by software, and that the pin went low, as it does by every reset. */
#define CSR_FLAGS   0xFE000000u
#define CSR_SFTRSTF BITS(28u, 1u)
#define CSR_PINRSTF BITS(26u, 1u)
#define I2C_SDA     8u /* Of port H. */

#define POLLS      3u   /* So many readings of the clock in a row are a wait for a time. */
#define POLL_TICKS 200u /* One behind the other. */

#define KEY_OPEN  0x5555u
#define KEY_FEED  0xAAAAu
#define KEY_START 0xCCCCu
#define LSI_KHZ   32u

#define BYTE_TICKS 37500u /* Of a character of the console, at 115200 baud. */
#define UNREADABLE '?'
#define DIVIDES    4u  /* The codes of a bus's divisor, from 2 on. */
#define CONVERT    12u /* Cycles beside those to sample. */

typedef uint32_t (*model_reader_t)(uint32_t offset);
typedef void (*model_writer_t)(uint32_t offset, uint32_t value);

/* A peripheral; without functions it is words that are kept. */
typedef struct model_registers {
    uint32_t base;
    uint32_t size;
    model_reader_t read;
    model_writer_t write;
} model_registers_t;

/* What is written by a reset. */
typedef struct model_default {
    uint32_t address;
    uint32_t value;
} model_default_t;

static const model_default_t defaults[] = {
    {RCC_BASE, 0x83u},
    {RCC_BASE + offsetof(keel_rcc_t, PLLCFGR), 0x24003010u},
    {RCC_BASE + offsetof(keel_rcc_t, AHB1ENR), 0x00100000u},
    {PWR_BASE, 0xC000u},
    {UART7_BASE + offsetof(keel_uart_t, ISR), 0xC0u},
    {SPI1_BASE + offsetof(keel_spi_t, CR2), 0x700u},
    {SPI2_BASE + offsetof(keel_spi_t, CR2), 0x700u},
    {SPI4_BASE + offsetof(keel_spi_t, CR2), 0x700u},
    {IWDG_BASE + offsetof(keel_iwdg_t, RLR), 0xFFFu},
    {FLASH_BASE + offsetof(keel_flash_t, CR), 1u << 31u},
    {FLASH_BASE + offsetof(keel_flash_t, OPTCR), 0xFFFFAAF1u},
    {GPIOA_BASE, 0xA8000000u},
    {GPIOB_BASE, 0x280u},
    {SCB_BASE + offsetof(keel_scb_t, CCSIDR), 0xF00FE019u},
    {MPU_BASE, MPU_TYPE_RESET},
};

uint32_t model_chip[MODEL_CHIP_SIZE / sizeof(uint32_t)];
uint32_t model_core[MODEL_CORE_SIZE / sizeof(uint32_t)];
uint32_t model_instruction_ticks;

static uint64_t counted_from; /* When TIM 5 was 0, … */
static uint64_t count_ticks;  /* … and for how long it has each count. */
static uint64_t looked_at;    /* When the clock was read last, and how often in a row. */
static uint32_t looks;
static bool sleeps;            /* SysTick counts, … */
static uint64_t sleeps_until;  /* … to this time. */
static uint64_t starves_after; /* The watchdog's time; 0: it does not run. */
static uint64_t fed_at;
static uint64_t said_until; /* The console's last character is out. */
static char text[MODEL_TEXT + 1u];
static uint32_t said;
static bool converts;
static uint64_t converted_at;
static bool oscillator_lost;

/* --- Clocks and supplies: all become ready at once. --- */

static uint32_t followed(uint32_t word, uint32_t control, uint32_t flag)
{
    return ((word & control) != 0u) ? (word | flag) : (word & ~flag);
}

static uint32_t *rcc_word(uint32_t offset)
{
    return model_word(RCC_BASE + offset);
}

/* Without the oscillator neither it nor the PLL behind it becomes ready. */
static uint32_t ready_clocks(uint32_t control)
{
    const bool from_hse = (*rcc_word(offsetof(keel_rcc_t, PLLCFGR)) & RCC_PLLCFGR_PLLSRC) != 0u;
    uint32_t word = followed(control, RCC_CR_HSION, RCC_CR_HSIRDY);

    word = followed(word, oscillator_lost ? 0u : RCC_CR_HSEON, RCC_CR_HSERDY);
    return followed(word, (oscillator_lost && from_hse) ? 0u : RCC_CR_PLLON, RCC_CR_PLLRDY);
}

static void run_core_of(uint32_t source)
{
    keel_bits_put(rcc_word(offsetof(keel_rcc_t, CFGR)), RCC_CFGR_SW | RCC_CFGR_SWS,
                  FIELD(RCC_CFGR_SW, source) | FIELD(RCC_CFGR_SWS, source));
    model_instruction_ticks = (source == OF_PLL) ? FAST_TICKS : SLOW_TICKS;
    model_timers_clock(model_instruction_ticks);
}

/* The clock security system goes over to the internal oscillator, and says so by the NMI (RM0410,
 * 5.2.7). Without it nothing clocks the core any more. */
void model_lose_oscillator(void)
{
    uint32_t *const control = rcc_word(offsetof(keel_rcc_t, CR));
    const bool is_watched = (*control & RCC_CR_CSSON) != 0u;

    oscillator_lost = true;
    if (!is_watched) {
        model_hang();
        return;
    }
    *control &= ~(RCC_CR_HSEON | RCC_CR_HSERDY | RCC_CR_PLLON | RCC_CR_PLLRDY);
    run_core_of(0u);
    *rcc_word(offsetof(keel_rcc_t, CIR)) |= CSS_FAILED;
    model_except(NMI, 0u);
}

static void write_rcc(uint32_t offset, uint32_t value)
{
    uint32_t word = value;

    if (offset == offsetof(keel_rcc_t, CR)) {
        word = ready_clocks(value);
    } else if (offset == offsetof(keel_rcc_t, CFGR)) {
        *rcc_word(offset) = value;
        run_core_of(keel_bits_get(value, RCC_CFGR_SW));
        return;
    } else if (offset == offsetof(keel_rcc_t, CSR)) {
        word = ((value & RCC_CSR_RMVF) != 0u) ? 0u : value;
    } else {
        /* It is kept. */
    }
    *model_word(RCC_BASE + offset) = word;
}

static void write_pwr(uint32_t offset, uint32_t value)
{
    *model_word(PWR_BASE + offset) = value;
    if (offset == offsetof(keel_pwr_t, CR1)) { /* Over-drive, and its switch. */
        *model_word(PWR_BASE + offsetof(keel_pwr_t, CSR1)) |= value & 0x30000u;
    }
}

/* Of APB 1, a clock. */
static uint32_t apb1_ticks(void)
{
    const uint32_t code = keel_bits_get(*rcc_word(offsetof(keel_rcc_t, CFGR)), RCC_CFGR_PPRE1);

    return model_instruction_ticks * ((code < DIVIDES) ? 1u : (2u << (code - DIVIDES)));
}

/* --- The clock, sleep, and the watchdog. --- */

/* Who reads nothing but the clock waits for it: the next microsecond comes at once. */
static uint32_t read_clock(uint32_t offset)
{
    if (offset != offsetof(keel_tim_t, CNT)) {
        return *model_word(TIM5_BASE + offset);
    }
    looks = ((model_now() - looked_at) < POLL_TICKS) ? (looks + 1u) : 0u;
    if (looks >= POLLS) {
        const uint64_t passed = model_now() - counted_from;

        (void)model_wait(counted_from + (((passed / count_ticks) + 1u) * count_ticks));
    }
    looked_at = model_now();
    return (uint32_t)((model_now() - counted_from) / count_ticks);
}

/* Timers have twice the clock of their bus, where that is divided (RM0410, 5.2). */
static void start_count(void)
{
    const uint32_t bus = apb1_ticks();
    const uint32_t timer = (bus > model_instruction_ticks) ? (bus / 2u) : bus;

    counted_from = model_now();
    count_ticks = (uint64_t)timer * (*model_word(TIM5_BASE + offsetof(keel_tim_t, PSC)) + 1u);
    if ((*rcc_word(offsetof(keel_rcc_t, APB1ENR)) & RCC_APB1ENR_TIM5EN) == 0u) {
        model_fail("TIM 5 is used without its clock");
    } else if (count_ticks != MODEL_TICKS_PER_US) {
        model_fail("TIM 5 counts each %u ns, not each microsecond",
                   (unsigned)((count_ticks * 1000u) / MODEL_TICKS_PER_US));
    } else {
        /* It is a clock. */
    }
}

static void write_clock(uint32_t offset, uint32_t value)
{
    *model_word(TIM5_BASE + offset) = value;
    if ((offset == offsetof(keel_tim_t, EGR)) && ((value & TIM_EGR_UG) != 0u)) {
        start_count();
    }
}

static void write_systick(uint32_t offset, uint32_t value)
{
    *model_word(SYSTICK + offset) = value;
    if (offset == 0u) {
        const uint32_t load = *model_word(SYSTICK + 4u);

        sleeps = (value & 1u) != 0u;
        sleeps_until = model_now() + (((uint64_t)load + 1u) * FAST_TICKS);
        *model_word(SYSTICK + 8u) = load;
    }
}

static uint32_t read_system(uint32_t offset)
{
    if (offset == offsetof(keel_scb_t, ICSR)) {
        const uint32_t active = model_exception();

        return ((sleeps && model_wait(sleeps_until)) ? SCB_ICSR_PENDSTSET : 0u) | active |
               ((active != 0u) ? ICSR_RETTOBASE : 0u);
    }
    return *model_word(SYSTEM + offset);
}

static void write_system(uint32_t offset, uint32_t value)
{
    *model_word(SYSTEM + offset) = value;
    if ((offset == offsetof(keel_scb_t, AIRCR)) && ((value >> 16u) == SCB_AIRCR_KEY) &&
        ((value & SCB_AIRCR_SYSRESETREQ) != 0u)) {
        model_reset(MODEL_BY_SOFTWARE);
    } else if (offset == ((MPU_BASE - SYSTEM) + offsetof(keel_mpu_t, CTRL))) {
        model_guard((value & MPU_CTRL_ENABLE) != 0u);
    } else {
        /* It is kept. */
    }
}

/* The count is that of RLR from the next start or feeding on (RM0410, 30.3). */
static void take_reload(void)
{
    const uint64_t divisor = 4u << *model_word(IWDG_BASE + offsetof(keel_iwdg_t, PR));
    const uint64_t count = *model_word(IWDG_BASE + offsetof(keel_iwdg_t, RLR)) + 1u;

    starves_after = (count * divisor * 1000u * MODEL_TICKS_PER_US) / LSI_KHZ;
    fed_at = model_now();
}

static void write_watchdog(uint32_t offset, uint32_t value)
{
    *model_word(IWDG_BASE + offset) = value;
    if ((offset != offsetof(keel_iwdg_t, KR)) || (value == KEY_OPEN)) {
        return;
    }
    if (!model_is_fed()) {
        model_fail("the watchdog was fed too late");
    }
    if ((value == KEY_START) || ((value == KEY_FEED) && (starves_after != 0u))) {
        take_reload();
    }
}

bool model_is_fed(void)
{
    return (starves_after == 0u) || ((model_now() - fed_at) <= starves_after);
}

uint64_t model_bites_at(void)
{
    return (starves_after == 0u) ? UINT64_MAX : (fed_at + starves_after + 1u);
}

bool model_is_up(void)
{
    return starves_after != 0u;
}

/* --- Pins. --- */

static uint32_t port_word(uint32_t port, uint32_t offset)
{
    return *model_word(GPIOA_BASE + (PORT_SIZE * port) + offset);
}

static uint32_t mode_of(uint32_t port, uint32_t pin)
{
    return (port_word(port, offsetof(keel_gpio_t, MODER)) >> (2u * pin)) & 3u;
}

static bool is_driven(uint32_t port, uint32_t pin, uint32_t level)
{
    return (mode_of(port, pin) == 1u) &&
           (((port_word(port, offsetof(keel_gpio_t, ODR)) >> pin) & 1u) == level);
}

bool model_pin_is_low(uint32_t port, uint32_t pin)
{
    return is_driven(port, pin, 0u);
}

bool model_pin_is_high(uint32_t port, uint32_t pin)
{
    return is_driven(port, pin, 1u);
}

bool model_pin_has(uint32_t port, uint32_t pin, uint32_t function)
{
    const uint32_t offset = (pin < 8u) ? offsetof(keel_gpio_t, AFRL) : offsetof(keel_gpio_t, AFRH);

    return (mode_of(port, pin) == 2u) &&
           (((port_word(port, offset) >> (4u * (pin % 8u))) & 0xFu) == function);
}

/* Of all inputs something is joined to those of the I2C alone: its lines are high, unless they are
 * driven. */
static uint32_t read_port(uint32_t port, uint32_t offset)
{
    uint32_t levels = 0u;

    if (offset != offsetof(keel_gpio_t, IDR)) {
        return port_word(port, offset);
    }
    for (uint32_t pin = 7u; (port == 7u) && (pin <= 8u); pin++) {
        levels |= (model_pin_is_low(port, pin) ? 0u : 1u) << pin;
    }
    return model_i2c_is_held() ? (levels & ~(1u << I2C_SDA)) : levels;
}

static void write_port(uint32_t port, uint32_t offset, uint32_t value)
{
    const uint32_t base = GPIOA_BASE + (PORT_SIZE * port);

    model_pins_pass();
    if (offset == offsetof(keel_gpio_t, BSRR)) {
        uint32_t *const output = model_word(base + offsetof(keel_gpio_t, ODR));

        *output = (*output & ~(value >> 16u)) | (value & 0xFFFFu);
    } else {
        *model_word(base + offset) = value;
    }
    model_select();
    model_pins_look();
    model_i2c_look();
}

/* --- The converter. --- */

static uint32_t adc_word(uint32_t offset)
{
    return *model_word(ADC1_BASE + offset);
}

/* Ticks of a conversion: of a clock that is half of 108 MHz, or an even part of it. */
static uint64_t conversion_ticks(uint32_t channel)
{
    static const uint16_t cycles[] = {3u, 15u, 28u, 56u, 84u, 112u, 144u, 480u};
    const uint32_t word = adc_word((channel > 9u) ? offsetof(keel_adc_t, SMPR1)
                                                  : offsetof(keel_adc_t, SMPR2));
    const uint32_t control = *model_word(ADC123_COMMON_BASE + offsetof(keel_adc_common_t, CCR));
    const uint32_t divisor = 2u * (keel_bits_get(control, ADC_COMMON_CCR_ADCPRE) + 1u);
    const uint32_t code = (word >> (3u * (channel % 10u))) & 7u;

    return ((uint64_t)cycles[code] + CONVERT) * divisor * 2u * FAST_TICKS;
}

static void end_conversion(void)
{
    const uint32_t channel = adc_word(offsetof(keel_adc_t, SQR3)) & 0x1Fu;

    converts = false;
    *model_word(ADC1_BASE + offsetof(keel_adc_t, DR)) = model_count(channel);
    *model_word(ADC1_BASE + offsetof(keel_adc_t, SR)) |= ADC_SR_EOC;
    *model_word(ADC1_BASE + offsetof(keel_adc_t, CR2)) &= ~ADC_CR2_SWSTART;
}

static uint32_t read_adc(uint32_t offset)
{
    if ((offset == offsetof(keel_adc_t, SR)) && converts && model_wait(converted_at)) {
        end_conversion();
    }
    if (offset == offsetof(keel_adc_t, DR)) {
        *model_word(ADC1_BASE + offsetof(keel_adc_t, SR)) &= ~ADC_SR_EOC;
    }
    return adc_word(offset);
}

static void write_adc(uint32_t offset, uint32_t value)
{
    if (offset == offsetof(keel_adc_t, SR)) {
        *model_word(ADC1_BASE + offset) &= value;
        return;
    }
    *model_word(ADC1_BASE + offset) = value;
    if (offset == offsetof(keel_adc_t, CR2)) {
        converts = (value & (ADC_CR2_ADON | ADC_CR2_SWSTART)) == (ADC_CR2_ADON | ADC_CR2_SWSTART);
        converted_at = model_now() + conversion_ticks(adc_word(offsetof(keel_adc_t, SQR3)) & 0x1Fu);
    }
}

/* --- The console. --- */

/* Ticks of a character on the line, of 10 bits. */
static uint64_t character_ticks(void)
{
    return 10u * (uint64_t)apb1_ticks() * *model_word(UART7_BASE + offsetof(keel_uart_t, BRR));
}

/* Whoever listens has 115200 baud, and reads nothing that is off by more than a fiftieth. */
static char heard(uint32_t value)
{
    const uint64_t ticks = character_ticks();
    const uint64_t off = (ticks > BYTE_TICKS) ? (ticks - BYTE_TICKS) : (BYTE_TICKS - ticks);

    return ((off * 50u) <= BYTE_TICKS) ? (char)value : UNREADABLE;
}

static uint32_t read_console(uint32_t offset)
{
    const uint64_t now = model_now();

    if (offset != offsetof(keel_uart_t, ISR)) {
        return *model_word(UART7_BASE + offset);
    }
    return ((said_until <= (now + character_ticks())) ? UART_ISR_TXE : 0u) |
           ((said_until <= now) ? UART_ISR_TC : 0u);
}

static void write_console(uint32_t offset, uint32_t value)
{
    *model_word(UART7_BASE + offset) = value;
    if (offset == offsetof(keel_uart_t, TDR)) {
        said_until = ((said_until > model_now()) ? said_until : model_now()) + character_ticks();
        if (said == MODEL_TEXT) { /* The older half goes. */
            said = MODEL_TEXT / 2u;
            memmove(text, &text[MODEL_TEXT - said], said);
        }
        text[said] = heard(value);
        said++;
    }
}

const char *model_text(void)
{
    text[said] = '\0';
    return text;
}

/* --- Each peripheral's registers. --- */

static uint32_t read_converters(uint32_t offset)
{
    return (offset < (ADC123_COMMON_BASE - ADC1_BASE)) ? read_adc(offset) : adc_word(offset);
}

static void write_converters(uint32_t offset, uint32_t value)
{
    if (offset < (ADC123_COMMON_BASE - ADC1_BASE)) {
        write_adc(offset, value);
    } else {
        *model_word(ADC1_BASE + offset) = value;
    }
}

#define SPI_FUNCTIONS(number)                                                                      \
    static uint32_t read_spi##number(uint32_t offset)                                              \
    {                                                                                              \
        return model_spi_read(SPI##number##_BASE, offset);                                         \
    }                                                                                              \
    static void write_spi##number(uint32_t offset, uint32_t value)                                 \
    {                                                                                              \
        model_spi_write(SPI##number##_BASE, offset, value);                                        \
    }
#define DMA_FUNCTIONS(number)                                                                      \
    static uint32_t read_dma##number(uint32_t offset)                                              \
    {                                                                                              \
        return model_dma_read(number##u, offset);                                                  \
    }                                                                                              \
    static void write_dma##number(uint32_t offset, uint32_t value)                                 \
    {                                                                                              \
        model_dma_write(number##u, offset, value);                                                 \
    }

#define TIMER_FUNCTION(number)                                                                     \
    static void write_tim##number(uint32_t offset, uint32_t value)                                 \
    {                                                                                              \
        model_timer_write(TIM##number##_BASE, offset, value);                                      \
    }

TIMER_FUNCTION(1)
TIMER_FUNCTION(4)
TIMER_FUNCTION(12)
SPI_FUNCTIONS(1)
SPI_FUNCTIONS(2)
SPI_FUNCTIONS(4)
DMA_FUNCTIONS(1)
DMA_FUNCTIONS(2)

static const model_registers_t peripherals[] = {
    {TIM5_BASE, sizeof(keel_tim_t), read_clock, write_clock},
    {SYSTICK, 0x10u, NULL, write_systick},
    {SYSTEM, 0x2A4u, read_system, write_system},
    {SPI1_BASE, 0x24u, read_spi1, write_spi1},
    {SPI2_BASE, 0x24u, read_spi2, write_spi2},
    {SPI4_BASE, 0x24u, read_spi4, write_spi4},
    {I2C3_BASE, sizeof(keel_i2c_t), model_i2c_read, model_i2c_write},
    {DMA1_BASE, sizeof(keel_dma_t), read_dma1, write_dma1},
    {DMA2_BASE, sizeof(keel_dma_t), read_dma2, write_dma2},
    {TIM1_BASE, 0x68u, NULL, write_tim1},
    {ADC1_BASE, 0x30Cu, read_converters, write_converters},
    {IWDG_BASE, sizeof(keel_iwdg_t), NULL, write_watchdog},
    {UART7_BASE, sizeof(keel_uart_t), read_console, write_console},
    {RCC_BASE, sizeof(keel_rcc_t), NULL, write_rcc},
    {PWR_BASE, sizeof(keel_pwr_t), NULL, write_pwr},
    {SDMMC1_BASE, sizeof(keel_sdmmc_t), model_slot_read, model_slot_write},
    {TIM4_BASE, 0x54u, NULL, write_tim4},
    {TIM12_BASE, 0x54u, NULL, write_tim12},
    {TIM8_BASE, 0x68u, NULL, NULL},
    {TIM9_BASE, 0x54u, NULL, NULL},
    {FLASH_BASE, sizeof(keel_flash_t), NULL, NULL},
    {DBGMCU_BASE, 0x10u, NULL, NULL},
    {NVIC, 0x200u, NULL, NULL},
};
#define KINDS (sizeof peripherals / sizeof peripherals[0])

/* Of each page of 1 KiB the peripheral that begins there. */
#define PAGE  0x400u
#define PAGES ((MODEL_CHIP_SIZE + MODEL_CORE_SIZE) / PAGE)

static const model_registers_t *pages[PAGES];

static uint32_t page_of(uint32_t address)
{
    return ((address >= MODEL_CORE) ? ((address - MODEL_CORE) + MODEL_CHIP_SIZE)
                                    : (address - MODEL_CHIP)) /
           PAGE;
}

static void make_pages(void)
{
    for (uint32_t i = 0u; i < KINDS; i++) {
        pages[page_of(peripherals[i].base)] = &peripherals[i];
    }
}

/* The core's own share a page. */
static const model_registers_t *peripheral_of(uint32_t address)
{
    const model_registers_t *found = pages[page_of(address)];

    for (uint32_t i = 0u; (i < KINDS) && (address >= MODEL_CORE); i++) {
        if ((address - peripherals[i].base) < peripherals[i].size) {
            found = &peripherals[i];
        }
    }
    return ((found != NULL) && ((address - found->base) < found->size)) ? found : NULL;
}

static bool is_port(uint32_t address)
{
    return ((address - GPIOA_BASE) < (PORTS * PORT_SIZE)) &&
           ((address % PORT_SIZE) < sizeof(keel_gpio_t));
}

static void pass_access(uint32_t address)
{
    uint64_t ticks = 0u;

    if (address < APB2) {
        ticks = APB1_TICKS;
    } else if (address < AHB) {
        ticks = APB2_TICKS;
    } else if (address < MODEL_CORE) {
        ticks = AHB_TICKS;
    } else {
        /* The core's own take no longer. */
    }
    model_pass(ticks);
}

static void miss(uint32_t address)
{
    model_fail("0x%08x is no register of a peripheral that is modelled", address);
}

static uint32_t read_whole(uint32_t address)
{
    const model_registers_t *const found = peripheral_of(address);
    model_line_t line;

    if ((found == NULL) && is_port(address)) {
        return read_port((address - GPIOA_BASE) / PORT_SIZE, address % PORT_SIZE);
    }
    if ((found == NULL) && model_is_uart(address, &line)) {
        return model_uart_read(line, address % PORT_SIZE);
    }
    if (found == NULL) {
        miss(address);
        return 0u;
    }
    return (found->read != NULL) ? found->read(address - found->base) : *model_word(address);
}

uint32_t model_read(uint32_t address, uint32_t size)
{
    const uint32_t shift = 8u * (address & 3u);
    const uint32_t mask = (size < sizeof(uint32_t)) ? ((1u << (8u * size)) - 1u) : UINT32_MAX;

    pass_access(address);
    return (read_whole(address & ~3u) >> shift) & mask;
}

void model_write(uint32_t address, uint32_t size, uint32_t value)
{
    const model_registers_t *const found = peripheral_of(address);
    model_line_t line;

    (void)size;
    pass_access(address);
    if (is_port(address)) {
        write_port((address - GPIOA_BASE) / PORT_SIZE, address % PORT_SIZE, value);
    } else if (model_is_uart(address, &line)) {
        model_uart_write(line, address % PORT_SIZE, value);
    } else if (found == NULL) {
        miss(address);
    } else if (found->write != NULL) {
        found->write(address - found->base, value);
    } else {
        *model_word(address) = value;
    }
}

/* What the reset's cause adds to the flags, which stay until they are cleared (RM0410, 5.3.21). */
static uint32_t reset_flags(model_cause_t cause)
{
    static const uint32_t flags[] = {[MODEL_BY_POWER] = RCC_CSR_RESET,
                                     [MODEL_BY_SOFTWARE] = CSR_SFTRSTF | CSR_PINRSTF,
                                     [MODEL_BY_WATCHDOG] = RCC_CSR_IWDGRSTF | CSR_PINRSTF};
    const uint32_t before = *rcc_word(offsetof(keel_rcc_t, CSR)) & CSR_FLAGS;

    return flags[cause] | ((cause == MODEL_BY_POWER) ? 0u : before);
}

void model_registers_start(void)
{
    oscillator_lost = false;
    said = 0u;
}

void model_registers_reset(model_cause_t cause)
{
    const uint32_t flags = reset_flags(cause);

    memset(model_chip, 0, sizeof model_chip);
    memset(model_core, 0, sizeof model_core);
    model_instruction_ticks = SLOW_TICKS;
    for (uint32_t i = 0u; i < (sizeof defaults / sizeof defaults[0]); i++) {
        *model_word(defaults[i].address) = defaults[i].value;
    }
    *rcc_word(offsetof(keel_rcc_t, CSR)) = flags;
    make_pages();
    counted_from = model_now();
    count_ticks = MODEL_TICKS_PER_US;
    starves_after = 0u;
    said_until = model_now();
    looks = 0u;
    sleeps = false;
    converts = false;
    model_card_reset();
    model_buses_reset();
    model_lines_reset();
    model_pins_reset();
}
