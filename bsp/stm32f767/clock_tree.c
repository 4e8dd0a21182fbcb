/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/clock_tree.h"

#define VCO_INPUT_HZ   2000000u
#define SOURCE_MIN_HZ  4000000u
#define SOURCE_MAX_HZ  26000000u
#define CORE_MIN_HZ    96000000u
#define CORE_STEP_HZ   24000000u
#define USB_HZ         48000000u
#define PLL_P          2u
#define WAIT_STATE_HZ  30000000u
#define SWITCH_HSI     0u
#define SWITCH_PLL     2u
#define SCALE_1        3u
#define DIVISOR_LIMIT  16u
#define DIVIDED_BY_TWO 4u /* PPRE1 and PPRE2: 4 means 2, 5 means 4 and so on; 0 means 1. */

keel_bsp_status_t keel_pll_plan(uint32_t source_hz, uint32_t core_hz, keel_pll_t *pll)
{
    const bool source = (source_hz >= SOURCE_MIN_HZ) && (source_hz <= SOURCE_MAX_HZ) &&
                        ((source_hz % VCO_INPUT_HZ) == 0u);
    const bool core = (core_hz >= CORE_MIN_HZ) && (core_hz <= KEEL_CORE_HZ) &&
                      ((core_hz % CORE_STEP_HZ) == 0u);

    if (!source || !core) {
        return KEEL_BSP_ARGUMENT;
    }
    pll->m = source_hz / VCO_INPUT_HZ;
    pll->n = (core_hz * PLL_P) / VCO_INPUT_HZ;
    pll->p = PLL_P;
    pll->q = (core_hz * PLL_P) / USB_HZ;
    return KEEL_BSP_OK;
}

uint32_t keel_pll_word(const keel_pll_t *pll)
{
    const uint32_t fields = RCC_PLLCFGR_PLLM | RCC_PLLCFGR_PLLN | RCC_PLLCFGR_PLLP |
                            RCC_PLLCFGR_PLLQ | RCC_PLLCFGR_PLLSRC;

    return (RCC_PLLCFGR_RESET & ~fields) | FIELD(RCC_PLLCFGR_PLLM, pll->m) |
           FIELD(RCC_PLLCFGR_PLLN, pll->n) | FIELD(RCC_PLLCFGR_PLLP, (pll->p / 2u) - 1u) |
           FIELD(RCC_PLLCFGR_PLLQ, pll->q) | RCC_PLLCFGR_PLLSRC;
}

uint32_t keel_flash_wait_states(uint32_t core_hz)
{
    return (core_hz - 1u) / WAIT_STATE_HZ;
}

uint32_t keel_bus_divisor(uint32_t core_hz, uint32_t limit_hz)
{
    uint32_t divisor = 1u;

    while ((divisor < DIVISOR_LIMIT) && ((core_hz / divisor) > limit_hz)) {
        divisor *= 2u;
    }
    return divisor;
}

uint32_t keel_timer_hz(uint32_t core_hz, uint32_t divisor)
{
    return (divisor == 1u) ? core_hz : (2u * (core_hz / divisor));
}

/* The content of PPRE1 or PPRE2 for a divisor. */
static uint32_t prescaler_code(uint32_t divisor)
{
    uint32_t code = (divisor == 1u) ? 0u : DIVIDED_BY_TWO;

    for (uint32_t rest = divisor; rest > 2u; rest /= 2u) {
        code++;
    }
    return code;
}

static bool switch_core(keel_rcc_t *rcc, uint32_t source, const keel_wait_t *wait)
{
    keel_bits_put(&rcc->CFGR, RCC_CFGR_SW, FIELD(RCC_CFGR_SW, source));
    return keel_wait_for(&rcc->CFGR, RCC_CFGR_SWS, FIELD(RCC_CFGR_SWS, source), wait);
}

/* A boot loader may have left any clock running: back to how a reset leaves them. The oscillator
 * must stand still while its bypass is chosen, the PLL while its factors are. */
static keel_clock_fault_t stop_clocks(keel_rcc_t *rcc, const keel_wait_t *wait)
{
    rcc->CR |= RCC_CR_HSION;
    if (!keel_wait_for(&rcc->CR, RCC_CR_HSIRDY, RCC_CR_HSIRDY, wait)) {
        return KEEL_CLOCK_HSI;
    }
    if (!switch_core(rcc, SWITCH_HSI, wait)) {
        return KEEL_CLOCK_TO_HSI;
    }
    keel_bits_put(&rcc->CR, RCC_CR_PLLON | RCC_CR_CSSON, 0u);
    if (!keel_wait_for(&rcc->CR, RCC_CR_PLLRDY, 0u, wait)) {
        return KEEL_CLOCK_PLL_STOP;
    }
    keel_bits_put(&rcc->CR, RCC_CR_HSEON, 0u);
    keel_bits_put(&rcc->DCKCFGR1, RCC_DCKCFGR1_TIMPRE, 0u);
    keel_bits_put(&rcc->DCKCFGR2,
                  RCC_DCKCFGR2_USART3SEL | RCC_DCKCFGR2_UART7SEL | RCC_DCKCFGR2_CK48MSEL |
                      RCC_DCKCFGR2_SDMMC1SEL,
                  0u);
    return keel_wait_for(&rcc->CR, RCC_CR_HSERDY, 0u, wait) ? KEEL_CLOCK_OK : KEEL_CLOCK_HSE_STOP;
}

static keel_clock_fault_t start_oscillator(keel_rcc_t *rcc, bool bypass, const keel_wait_t *wait)
{
    keel_bits_put(&rcc->CR, RCC_CR_HSEBYP, bypass ? RCC_CR_HSEBYP : 0u);
    rcc->CR |= RCC_CR_HSEON;
    return keel_wait_for(&rcc->CR, RCC_CR_HSERDY, RCC_CR_HSERDY, wait) ? KEEL_CLOCK_OK
                                                                       : KEEL_CLOCK_HSE;
}

/* Over-drive can be entered while the PLL runs but does not clock the core yet (RM0410, 4.1.4). */
static keel_clock_fault_t start_overdrive(keel_pwr_t *pwr, const keel_wait_t *wait)
{
    pwr->CR1 |= PWR_CR1_ODEN;
    if (!keel_wait_for(&pwr->CSR1, PWR_CSR1_ODRDY, PWR_CSR1_ODRDY, wait)) {
        return KEEL_CLOCK_OVERDRIVE;
    }
    pwr->CR1 |= PWR_CR1_ODSWEN;
    return keel_wait_for(&pwr->CSR1, PWR_CSR1_ODSWRDY, PWR_CSR1_ODSWRDY, wait)
               ? KEEL_CLOCK_OK
               : KEEL_CLOCK_OVERDRIVE_SWITCH;
}

static uint32_t latency(void)
{
    return FIELD(FLASH_ACR_LATENCY, keel_flash_wait_states(KEEL_CORE_HZ));
}

/* Wait states before the clock rises. The accelerator is reset while it is off. */
static void start_flash(keel_flash_t *flash)
{
    keel_bits_put(&flash->ACR, FLASH_ACR_ARTEN | FLASH_ACR_LATENCY, latency());
    flash->ACR |= FLASH_ACR_ARTRST;
    keel_bits_put(&flash->ACR, FLASH_ACR_ARTRST, 0u);
    flash->ACR |= FLASH_ACR_ARTEN | FLASH_ACR_PRFTEN;
}

static keel_clock_fault_t start_core(const keel_clock_registers_t *registers,
                                     const keel_wait_t *wait)
{
    keel_rcc_t *const rcc = registers->rcc;
    const uint32_t apb1 = prescaler_code(keel_bus_divisor(KEEL_CORE_HZ, KEEL_APB1_LIMIT_HZ));
    const uint32_t apb2 = prescaler_code(keel_bus_divisor(KEEL_CORE_HZ, KEEL_APB2_LIMIT_HZ));

    keel_bits_put(&rcc->CFGR, RCC_CFGR_HPRE | RCC_CFGR_PPRE1 | RCC_CFGR_PPRE2,
                  FIELD(RCC_CFGR_PPRE1, apb1) | FIELD(RCC_CFGR_PPRE2, apb2));
    if (!keel_wait_for(&rcc->CR, RCC_CR_PLLRDY, RCC_CR_PLLRDY, wait)) {
        return KEEL_CLOCK_PLL;
    }
    if (!keel_wait_for(&registers->flash->ACR, FLASH_ACR_LATENCY, latency(), wait)) {
        return KEEL_CLOCK_LATENCY;
    }
    if (!switch_core(rcc, SWITCH_PLL, wait)) {
        /* It must not change later on, when all is set up for the internal oscillator. */
        (void)switch_core(rcc, SWITCH_HSI, wait);
        return KEEL_CLOCK_TO_PLL;
    }
    rcc->CR |= RCC_CR_CSSON;
    return KEEL_CLOCK_OK;
}

keel_clock_fault_t keel_clock_tree_start(const keel_clock_registers_t *registers,
                                         const keel_oscillator_t *oscillator,
                                         const keel_wait_t *wait)
{
    keel_rcc_t *const rcc = registers->rcc;
    keel_clock_fault_t fault;
    keel_pll_t pll;

    if (keel_pll_plan(oscillator->hz, KEEL_CORE_HZ, &pll) != KEEL_BSP_OK) {
        return KEEL_CLOCK_PLAN;
    }
    keel_bits_enable(&rcc->APB1ENR, RCC_APB1ENR_PWREN);
    fault = stop_clocks(rcc, wait);
    if (fault == KEEL_CLOCK_OK) {
        keel_bits_put(&registers->pwr->CR1, PWR_CR1_VOS, FIELD(PWR_CR1_VOS, SCALE_1));
        fault = start_oscillator(rcc, oscillator->bypass, wait);
    }
    if (fault == KEEL_CLOCK_OK) {
        rcc->PLLCFGR = keel_pll_word(&pll);
        rcc->CR |= RCC_CR_PLLON;
        start_flash(registers->flash);
        fault = start_overdrive(registers->pwr, wait);
    }
    return (fault == KEEL_CLOCK_OK) ? start_core(registers, wait) : fault;
}
