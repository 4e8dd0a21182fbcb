/* SPDX-License-Identifier: Apache-2.0 */
/* The STM32F767 as a board: board.h, and what an application may use beyond it. */
#include "stm32f767/target/chip.h"

#include "board.h"
#include "common/supervisor.h"
#include "cortex_m7/core.h"
#include "cortex_m7/fault.h"
#include "cortex_m7/reset.h"
#include "cortex_m7/sleep.h"
#include "devices/fm25v02.h"
#include "devices/ms5611.h"
#include "stm32f767/flash_medium.h"
#include "stm32f767/pwm.h"
#include "stm32f767/registers/dbgmcu.h"
#include "stm32f767/registers/factory.h"
#include "stm32f767/registers/memory.h"
#include "stm32f767/sdmmc.h"
#include "stm32f767/serial.h"
#include "stm32f767/spi_bus.h"
#include "stm32f767/target/cache.h"
#include "stm32f767/target/chip_parts.h"
#include "stm32f767/time_base.h"
#include "stm32f767/watchdog.h"

#define RCC             ((keel_rcc_t *)RCC_BASE)
#define PWR             ((keel_pwr_t *)PWR_BASE)
#define FLASH           ((keel_flash_t *)FLASH_BASE)
#define TIM5            ((keel_tim_t *)TIM5_BASE)
#define SPI2            ((keel_spi_t *)SPI2_BASE)
#define SPI4            ((keel_spi_t *)SPI4_BASE)
#define SDMMC1          ((keel_sdmmc_t *)SDMMC1_BASE)
#define IWDG            ((keel_iwdg_t *)IWDG_BASE)
#define DBGMCU          ((keel_dbgmcu_t *)DBGMCU_BASE)
#define PINS            (&keel_board_pins)
#define ELEMENTS(array) (sizeof(array) / sizeof((array)[0]))

#define HSI_HZ           16000000u /* The internal oscillator, when the clocks did not start. */
#define MEGAHERTZ        1000000u
#define BAUD             115200u
#define PWM_RATE_HZ      400u
#define WATCHDOG_US      50000u
#define FEED_EVERY_US    5000u
#define POWER_ON_US      20000u /* The sensor is up 11 ms after its supply. */
#define BLINK_US         100000u
#define HOLD_TURNS       1296000u /* 6 ms of cycles at 216 MHz. */
#define LOG2_NULL_GUARD  8u
#define LOG2_STACK_GUARD 10u
#define LOG2_HALF_GIB    29u
#define CARD_CLOCK_HZ    48000000u
#define CARD_LIMIT_HZ    16000000u  /* The processor moves the data: 512 bytes in 64 us. */
#define DELAY_LOOKS      100000000u /* Far more than a delay takes, but not for ever. */
#define EXCEPTION_NMI    2u         /* Of the clock that is lost. */
#define CLOCK_FAULTS     0xFFu      /* In KEEL_FAULT_CLOCK, the keel_clock_fault_t. */

#define GPIO_CLOCKS                                                                                \
    (RCC_AHB1ENR_GPIOAEN | RCC_AHB1ENR_GPIOBEN | RCC_AHB1ENR_GPIOCEN | RCC_AHB1ENR_GPIODEN |       \
     RCC_AHB1ENR_GPIOEEN | RCC_AHB1ENR_GPIOFEN | RCC_AHB1ENR_GPIOGEN | RCC_AHB1ENR_GPIOHEN |       \
     RCC_AHB1ENR_GPIOIEN)

/* The core is at 16 MHz until the clocks run, so a look takes half a microsecond at least: 150 ms
 * for a crystal, which needs some milliseconds. Later the core is faster and a look at a peripheral
 * takes some 50 ns: 15 ms, and a character takes 87 us. */
static const keel_wait_t patience = {300000u, NULL, NULL};

/* For a byte of the sensor, which takes 1.2 us at 6.75 MHz, or of the memory, 0.3 us: 20 us at some
 * 50 ns a look. Too short only if a look took less than 3 ns, which is less than a cycle. */
const keel_wait_t keel_chip_byte_patience = {400u, NULL, NULL};

/* The guards come last: where regions overlap, the last one holds. Code lies in flash and in ITCM
 * alone. Nothing lies behind the external memory controller, nothing may be read ahead there. */
const keel_mpu_region_t keel_board_regions[] = {
    {MEMORY_ITCM_BASE, LOG2_HALF_GIB, KEEL_MPU_NONE}, /* Below RAM, but for the next two. */
    {MEMORY_FLASH_BASE, 21u, KEEL_MPU_CODE},
    {MEMORY_ITCM_BASE, 14u, KEEL_MPU_CODE},
    {MEMORY_DTCM_BASE, 19u, KEEL_MPU_DATA}, /* And SRAM, which follows it. */
    {0x60000000u, LOG2_HALF_GIB, KEEL_MPU_NONE},
    {0x80000000u, LOG2_HALF_GIB, KEEL_MPU_NONE},
    {MEMORY_ITCM_BASE, LOG2_NULL_GUARD, KEEL_MPU_NONE},
    {MEMORY_DTCM_BASE, LOG2_STACK_GUARD, KEEL_MPU_NONE},
};
const uint32_t keel_board_region_count = ELEMENTS(keel_board_regions);

static keel_serial_t serial;
static keel_supervisor_t supervisor;
static const keel_scheduler_t *supervised;
static uint32_t last_fed_us;

/* Before memory is filled: nothing static but constants may be used. */

/* Whatever else is on the board sees by this pin whether motors may turn. */
static void tell_armed(bool armed)
{
    if (PINS->armed == NULL) {
        return;
    }
    if (armed) {
        keel_pin_output(*PINS->armed, KEEL_DRIVE_OPEN_DRAIN, false);
    } else {
        keel_pin_input(*PINS->armed, KEEL_PULL_UP);
    }
}

/* Outputs low, before anything takes time: at 16 MHz ITCM alone takes more than a millisecond. */
void keel_board_early(void)
{
    keel_bits_enable(&RCC->AHB1ENR, GPIO_CLOCKS);
    tell_armed(false);
    for (uint32_t i = 0u; i < PINS->output_count; i++) {
        keel_pin_output(PINS->outputs[i].pin, KEEL_DRIVE_PUSH_PULL, false);
    }
}

void keel_board_open_record(void)
{
    (void)keel_backup_open(RCC, PWR, &patience);
}

void keel_chip_require(keel_bsp_status_t status)
{
    if (status != KEEL_BSP_OK) {
        keel_fault_stop(KEEL_FAULT_START | (uint32_t)status);
    }
}

void keel_chip_give(keel_alternate_t to, keel_pull_t pull)
{
    keel_pin_alternate(to.pin, to.function, pull);
}

void keel_chip_deselect(keel_pin_t select)
{
    keel_pin_output(select, KEEL_DRIVE_PUSH_PULL, true);
}

void keel_chip_give_spi(keel_alternate_t sck, keel_alternate_t miso, keel_alternate_t mosi)
{
    keel_chip_give(sck, KEEL_PULL_UP); /* Mode 3. */
    keel_chip_give(miso, KEEL_PULL_UP);
    keel_chip_give(mosi, KEEL_PULL_NONE);
}

void keel_chip_give_light(const keel_led_t *light)
{
    keel_pin_output(light->pin, light->active_low ? KEEL_DRIVE_OPEN_DRAIN : KEEL_DRIVE_PUSH_PULL,
                    light->active_low);
}

void keel_chip_shine(const keel_led_t *light, bool on)
{
    keel_pin_write(light->pin, on != light->active_low);
}

static void start_leds(void)
{
    for (uint32_t i = 0u; i < KEEL_LEDS; i++) {
        keel_chip_give_light(&PINS->led[i]);
    }
}

static void start_console(uint32_t clock_hz)
{
    keel_bits_enable(&RCC->APB1ENR, PINS->console_clock);
    keel_chip_give(PINS->console_tx, KEEL_PULL_UP);
    keel_chip_give(PINS->console_rx, KEEL_PULL_UP);
    keel_chip_require(keel_serial_start(&serial, PINS->console, clock_hz, BAUD));
}

/* Supplies, and pins that must not float. */
static void start_levels(void)
{
    for (uint32_t i = 0u; i < PINS->level_count; i++) {
        keel_pin_output(PINS->levels[i].pin, KEEL_DRIVE_PUSH_PULL, PINS->levels[i].high);
    }
}

const keel_pwm_timer_t keel_chip_timers[KEEL_CHIP_TIMERS] = {
    [KEEL_TIMER_TIM1] = {(keel_tim_t *)TIM1_BASE, 4u, true},
    [KEEL_TIMER_TIM4] = {(keel_tim_t *)TIM4_BASE, 4u, false},
    [KEEL_TIMER_TIM12] = {(keel_tim_t *)TIM12_BASE, 2u, false},
};

static bool is_used(const keel_pwm_timer_t *timer)
{
    bool used = false;

    for (uint32_t i = 0u; i < PINS->output_count; i++) {
        used = used || (PINS->outputs[i].timer == timer);
    }
    return used;
}

/* The pins stay outputs, and low, until they are armed. */
static void start_outputs(uint32_t apb1_timer_hz, uint32_t apb2_timer_hz)
{
    static const struct {
        volatile uint32_t *enable;
        uint32_t bit;
        bool on_apb2;
    } clocks[KEEL_CHIP_TIMERS] = {
        [KEEL_TIMER_TIM1] = {&RCC->APB2ENR, RCC_APB2ENR_TIM1EN, true},
        [KEEL_TIMER_TIM4] = {&RCC->APB1ENR, RCC_APB1ENR_TIM4EN, false},
        [KEEL_TIMER_TIM12] = {&RCC->APB1ENR, RCC_APB1ENR_TIM12EN, false},
    };

    for (uint32_t i = 0u; i < KEEL_CHIP_TIMERS; i++) {
        if (is_used(&keel_chip_timers[i])) {
            keel_bits_enable(clocks[i].enable, clocks[i].bit);
            keel_chip_require(keel_pwm_start(&keel_chip_timers[i],
                                             clocks[i].on_apb2 ? apb2_timer_hz : apb1_timer_hz,
                                             PWM_RATE_HZ));
        }
    }
}

static keel_restart_t restart; /* Why it started. */

/* As the flags tell it; they are cleared for the next reset. */
static keel_restart_t read_restart(void)
{
    const keel_restart_t found = keel_restart_of(RCC->CSR);

    RCC->CSR |= RCC_CSR_RMVF;
    return found;
}

/* What a fault leaves is a reset that was asked for, and a record. */
static keel_restart_t restart_by(const keel_fault_record_t *record)
{
    keel_restart_t found = KEEL_RESTART_FAULT;

    if (record->code == KEEL_FAULT_WATCHDOG) {
        found = KEEL_RESTART_WATCHDOG;
    } else if ((record->number == EXCEPTION_NMI) ||
               ((record->code & ~CLOCK_FAULTS) == KEEL_FAULT_CLOCK)) {
        found = KEEL_RESTART_CLOCK;
    } else {
        /* Whatever else it was. */
    }
    return found;
}

/* A debugger that halts the core halts the watchdog, the time and the outputs as well. */
static void freeze_with_the_core(void)
{
    DBGMCU->APB1_FZ |= DBGMCU_APB1_FZ_DBG_IWDG_STOP | DBGMCU_APB1_FZ_DBG_TIM4_STOP |
                       DBGMCU_APB1_FZ_DBG_TIM5_STOP | DBGMCU_APB1_FZ_DBG_TIM12_STOP;
    DBGMCU->APB2_FZ |= DBGMCU_APB2_FZ_DBG_TIM1_STOP;
}

static uint32_t core_mhz; /* What the core runs at since the start. */

/* Without the oscillator the board still tells why, on the internal one, but starts no application:
 * no bus would have its rate. The record is written but once, or reset would follow reset. */
void keel_board_start(void)
{
    const keel_clock_registers_t registers = {RCC, PWR, FLASH};
    const keel_clock_fault_t fault = keel_clock_tree_start(&registers, &keel_board_pins.oscillator,
                                                           &patience);
    const bool good = (fault == KEEL_CLOCK_OK);
    const uint32_t core_hz = good ? KEEL_CORE_HZ : HSI_HZ;
    const uint32_t apb1 = good ? keel_bus_divisor(core_hz, KEEL_APB1_LIMIT_HZ) : 1u;
    const uint32_t apb2 = good ? keel_bus_divisor(core_hz, KEEL_APB2_LIMIT_HZ) : 1u;
    const keel_restart_t reset = read_restart();
    const keel_fault_record_t *const record = keel_fault_last();
    const bool told = (record != NULL) && (record->fresh == 1u);

    core_mhz = core_hz / MEGAHERTZ;
    restart = told ? restart_by(record) : reset;
    if (!good) { /* The buses as the reset left them. */
        keel_fault_allow_restart(false);
        keel_bits_put(&RCC->CFGR, RCC_CFGR_HPRE | RCC_CFGR_PPRE1 | RCC_CFGR_PPRE2, 0u);
    }
    start_levels();
    keel_cache_start();
    freeze_with_the_core();
    keel_bits_enable(&RCC->APB1ENR, RCC_APB1ENR_TIM5EN);
    keel_chip_require(keel_time_base_start(TIM5, keel_timer_hz(core_hz, apb1)));
    start_leds();
    start_console(core_hz / apb1);
    start_outputs(keel_timer_hz(core_hz, apb1), keel_timer_hz(core_hz, apb2));
    if (!good && !told) {
        keel_fault_stop(KEEL_FAULT_CLOCK | (uint32_t)fault);
    }
    if ((reset == KEEL_RESTART_WATCHDOG) && !told) {
        keel_fault_stop(KEEL_FAULT_WATCHDOG);
    }
}

KEEL_REALTIME_CODE uint32_t keel_board_clock_us(void *context)
{
    (void)context;
    return TIM5->CNT;
}

void keel_board_sleep_us(uint32_t us)
{
    keel_core_sleep_us(us, core_mhz);
}

/* Also moves the console on, for applications that do not call keel_chip_turn. */
void keel_board_put(char c)
{
    keel_serial_pump(&serial);
    if (c == '\n') {
        keel_serial_put(&serial, '\r'); /* What terminals expect. */
    }
    keel_serial_put(&serial, c);
}

/* May be called with anything broken: constants, loads and stores alone. Without its clock a timer
 * takes none, but then its pins are not its own yet. */
void keel_board_outputs_off(void)
{
    keel_pwm_off(PINS->outputs, PINS->output_count);
    tell_armed(false);
}

/* By counting, for any clock may be broken. A turn takes a cycle at least, and the core runs at 216
 * MHz at most: at least 6 ms. With turns of three cycles it is 18 ms; 243 ms on the internal
 * oscillator, where the watchdog may bite earlier, with the pins as low. */
void keel_board_outputs_hold(void)
{
    for (uint32_t i = 0u; i < HOLD_TURNS; i++) {
        __asm volatile("nop");
    }
}

/* Shines slowly for an end, quickly for the safe state. */
static void blink(keel_led_name_t name, uint32_t time_us) __attribute__((noreturn));

static void blink(keel_led_name_t name, uint32_t time_us)
{
    bool on = false;

    for (;;) {
        on = !on;
        keel_chip_led(name, on);
        (void)keel_wait_us(keel_board_clock_us, NULL, time_us, DELAY_LOOKS);
    }
}

void keel_board_halt(int status)
{
    (void)keel_serial_flush(&serial, &patience);
    if (status == KEEL_SAFE_STATUS) {
        blink(KEEL_LED_RED, BLINK_US);
    }
    blink((status == 0) ? KEEL_LED_GREEN : KEEL_LED_RED, 10u * BLINK_US);
}

void keel_chip_led(keel_led_name_t name, bool on)
{
    keel_chip_shine(&PINS->led[name], on);
}

keel_bsp_status_t keel_chip_delay(void *context, uint32_t time_us)
{
    (void)context;
    return keel_wait_us(keel_board_clock_us, NULL, time_us, DELAY_LOOKS) ? KEEL_BSP_OK
                                                                         : KEEL_BSP_TIMEOUT;
}

bool keel_chip_barometer(keel_bus_t *bus)
{
    static keel_spi_device_t device;
    const keel_board_device_t *const barometer = PINS->barometer;

    if (barometer == NULL) {
        return false;
    }
    device = (keel_spi_device_t){SPI4, barometer->select, &keel_chip_byte_patience};
    keel_chip_deselect(barometer->select);
    keel_chip_give_spi(barometer->sck, barometer->miso, barometer->mosi);
    keel_bits_enable(&RCC->APB2ENR, RCC_APB2ENR_SPI4EN);
    keel_chip_require(keel_spi_start(SPI4, KEEL_APB2_LIMIT_HZ, KEEL_MS5611_BUS_LIMIT_HZ));
    *bus = (keel_bus_t){keel_spi_bus_exchange, &device};
    return true;
}

bool keel_chip_card(keel_disk_t *disk)
{
    /* A look takes 50 ns at least: 1 ms and 0.5 s. One at the card's status, 6 us. */
    static const keel_wait_t prompt = {20000u, NULL, NULL};
    static const keel_wait_t patient = {10000000u, NULL, NULL};
    static const keel_wait_t busy_patience = {90000u, NULL, NULL};
    static keel_sdmmc_host_t host;
    static keel_sd_card_t card;
    const keel_board_card_t *const slot = PINS->card;

    if (slot == NULL) {
        return false;
    }
    keel_chip_give(slot->clock, KEEL_PULL_NONE);
    keel_chip_give(slot->command, KEEL_PULL_UP);
    for (uint32_t i = 0u; i < KEEL_CARD_LINES; i++) {
        keel_chip_give(slot->data[i], KEEL_PULL_UP);
    }
    keel_bits_enable(&RCC->APB2ENR, RCC_APB2ENR_SDMMC1EN);
    (void)keel_chip_delay(NULL, POWER_ON_US);
    keel_chip_require(keel_sdmmc_start(&host, SDMMC1, CARD_CLOCK_HZ, CARD_LIMIT_HZ, &prompt,
                                       &patient));
    card.host = keel_sdmmc_host(&host);
    card.delay = keel_chip_delay;
    card.patience = busy_patience;
    *disk = keel_sd_card_disk(&card);
    return true;
}

/* Where the first of the kept sectors begins. */
static uint32_t kept_base(void)
{
    return MEMORY_FLASH_BASE +
           (KEEL_FLASH_SECTOR_BYTES * (PINS->kept_sector - KEEL_FLASH_FIRST_LARGE + 1u));
}

static void settle_kept(void *context)
{
    (void)context;
    __asm volatile("dsb\n\tisb" ::: "memory");
}

/* The data cache may hold what was there before the flash was programmed or erased. It has no line
 * of the flash that memory lacks, as nobody writes there through it. */
static uint8_t get_kept(void *context, uint32_t address)
{
    settle_kept(context);
    ((keel_cbp_t *)CBP_BASE)->DCIMVAC = kept_base() + address;
    settle_kept(context);
    return *(const volatile uint8_t *)(kept_base() + address);
}

/* The flash is code, which the regions let nobody write; there is no ninth one for two sectors. */
static void put_kept(void *context, uint32_t address, uint8_t byte)
{
    ((keel_mpu_t *)MPU_BASE)->CTRL = 0u;
    settle_kept(context);
    *(volatile uint8_t *)(kept_base() + address) = byte;
    settle_kept(context);
    keel_mpu_start(keel_board_regions, keel_board_region_count);
}

static keel_bsp_status_t start_sectors(keel_medium_t *medium)
{
    /* A look takes 50 ns at least: 1 ms, and 10 s. */
    static const keel_wait_t program_patience = {20000u, NULL, NULL};
    static const keel_wait_t erasure_patience = {200000000u, NULL, NULL};
    static keel_flash_sectors_t sectors;

    sectors = (keel_flash_sectors_t){.flash = FLASH,
                                     .first = PINS->kept_sector,
                                     .program = &program_patience,
                                     .erasure = &erasure_patience,
                                     .settle = settle_kept,
                                     .get = get_kept,
                                     .put = put_kept};
    return keel_flash_medium(&sectors, medium);
}

static keel_bsp_status_t start_memory(const keel_board_device_t *memory, keel_medium_t *medium)
{
    static keel_spi_device_t device;
    static keel_bus_t bus = {keel_spi_bus_exchange, &device};
    keel_bsp_status_t status;

    device = (keel_spi_device_t){SPI2, memory->select, &keel_chip_byte_patience};
    keel_chip_deselect(memory->select);
    keel_chip_give_spi(memory->sck, memory->miso, memory->mosi);
    keel_bits_enable(&RCC->APB1ENR, RCC_APB1ENR_SPI2EN);
    keel_chip_require(keel_spi_start(SPI2, KEEL_APB1_LIMIT_HZ, KEEL_FM25V02_BUS_LIMIT_HZ));
    status = keel_fm25v02_start(&bus);
    if (status == KEEL_BSP_OK) {
        *medium = keel_fm25v02_medium(&bus);
    }
    return status;
}

keel_bsp_status_t keel_chip_memory(keel_medium_t *medium, uint32_t *slot_bytes)
{
    const bool is_flash = (PINS->memory == NULL);
    const keel_bsp_status_t status = is_flash ? start_sectors(medium)
                                              : start_memory(PINS->memory, medium);

    if (status == KEEL_BSP_OK) {
        *slot_bytes = is_flash ? KEEL_FLASH_SECTOR_BYTES
                               : (KEEL_FM25V02_BYTES / (uint32_t)KEEL_SLOTS);
    }
    return status;
}

bool keel_chip_brownout_is_set(void)
{
    return keel_brownout_level(FLASH) == KEEL_BROWNOUT_2V7;
}

keel_bsp_status_t keel_chip_brownout_set(void)
{
    /* A look takes 50 ns at least. */
    static const keel_wait_t option_patience = {40000000u, NULL, NULL};

    return keel_brownout_set(FLASH, KEEL_BROWNOUT_2V7, &option_patience);
}

void keel_chip_watchdog_start(const keel_scheduler_t *scheduler)
{
    supervised = scheduler;
    keel_supervisor_start(&supervisor, scheduler);
    last_fed_us = keel_board_clock_us(NULL);
    keel_chip_require(keel_watchdog_start(IWDG, WATCHDOG_US, &patience));
}

void keel_chip_turn(void)
{
    const uint32_t now_us = keel_board_clock_us(NULL);

    keel_serial_pump(&serial);
    keel_chip_lines_turn(now_us);
    if ((supervised != NULL) && ((now_us - last_fed_us) >= FEED_EVERY_US)) {
        last_fed_us = now_us;
        if (keel_supervisor_met(&supervisor, supervised, supervised->clock.now_us)) {
            keel_watchdog_feed(IWDG);
        }
    }
}

bool keel_chip_get(char *character)
{
    return keel_serial_get(&serial, character);
}

uint32_t keel_chip_output_count(void)
{
    return PINS->output_count;
}

keel_bsp_status_t keel_chip_pulse(uint32_t output, uint32_t pulse_us)
{
    return (output < PINS->output_count) ? keel_pwm_set(&PINS->outputs[output], pulse_us)
                                         : KEEL_BSP_ARGUMENT;
}

void keel_chip_arm(void)
{
    tell_armed(true);
    keel_chip_require(keel_pwm_arm(PINS->outputs, PINS->output_count));
}

/* A conversion takes 11.6 us. At some 50 ns a look this gives up after 25 us, within the budget of
 * the paper's ADC task. Too short only if a look took less than 24 ns, five cycles of the core, of
 * which the bus alone, at half the core's clock, takes four. */
static const keel_wait_t conversion_patience = {500u, NULL, NULL};

static const keel_adc_device_t converter = {(keel_adc_t *)ADC1_BASE,
                                            (keel_adc_common_t *)ADC123_COMMON_BASE,
                                            &conversion_patience, keel_board_clock_us, NULL};
static keel_adc_calibration_t calibration;

static uint16_t factory_value(uint32_t address)
{
    return *(const volatile uint16_t *)address;
}

/* The system memory lies where the regions let nobody read, and there is no ninth region to open
 * it. So the protection is off for some readings; there are no interrupts that could come
 * meanwhile. */
static void open_factory(void)
{
    ((keel_mpu_t *)MPU_BASE)->CTRL = 0u;
    __asm volatile("dsb\n\tisb" ::: "memory");
}

static void close_factory(void)
{
    keel_mpu_start(keel_board_regions, keel_board_region_count);
}

static void read_calibration(void)
{
    open_factory();
    calibration.reference = factory_value(VREFINTCAL_BASE);
    calibration.at_30 = factory_value(TS_CAL1_BASE);
    calibration.at_110 = factory_value(TS_CAL2_BASE);
    close_factory();
}

void keel_chip_uid(uint8_t uid[KEEL_CHIP_UID_BYTES])
{
    open_factory();
    for (uint32_t i = 0u; i < KEEL_CHIP_UID_BYTES; i += 2u) {
        const uint16_t value = factory_value(UID_BASE + i);

        uid[i] = (uint8_t)(value & 0xFFu);
        uid[i + 1u] = (uint8_t)(value >> 8);
    }
    close_factory();
}

keel_restart_t keel_chip_restart(void)
{
    return restart;
}

void keel_chip_reset(void)
{
    keel_core_reset();
}

keel_bsp_status_t keel_chip_adc_start(void)
{
    for (uint32_t i = 0u; i < PINS->analogue_count; i++) {
        keel_pin_analogue(PINS->analogue[i].pin);
    }
    read_calibration();
    keel_bits_enable(&RCC->APB2ENR, RCC_APB2ENR_ADC1EN);
    return keel_adc_start(&converter, KEEL_APB2_LIMIT_HZ);
}

uint32_t keel_chip_analogue_count(void)
{
    return PINS->analogue_count;
}

keel_bsp_status_t keel_chip_supply(uint32_t *supply_mv)
{
    uint16_t count;
    const keel_bsp_status_t status = keel_adc_read(&converter, KEEL_ADC_REFERENCE, &count);

    return (status == KEEL_BSP_OK) ? keel_adc_supply(&calibration, count, supply_mv) : status;
}

keel_bsp_status_t keel_chip_temperature(uint32_t supply_mv, int32_t *temperature_cdeg)
{
    uint16_t count;
    const keel_bsp_status_t status = keel_adc_read(&converter, KEEL_ADC_TEMPERATURE, &count);

    return (status == KEEL_BSP_OK)
               ? keel_adc_temperature(&calibration, count, supply_mv, temperature_cdeg)
               : status;
}

keel_bsp_status_t keel_chip_analogue(uint32_t name, uint16_t *count)
{
    return (name < PINS->analogue_count)
               ? keel_adc_read(&converter, PINS->analogue[name].channel, count)
               : KEEL_BSP_ARGUMENT;
}
