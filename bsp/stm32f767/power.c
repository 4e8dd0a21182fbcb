/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/power.h"

/* The keys that unlock the option bytes (RM0410, 3.4.2). */
#define OPTION_KEY_1 0x08192A3Bu
#define OPTION_KEY_2 0x4C5D6E7Fu

keel_brownout_t keel_brownout_level(const keel_flash_t *flash)
{
    return (keel_brownout_t)keel_bits_get(flash->OPTCR, FLASH_OPTCR_BOR_LEV);
}

keel_bsp_status_t keel_brownout_set(keel_flash_t *flash, keel_brownout_t level,
                                    const keel_wait_t *wait)
{
    bool done;

    if (keel_brownout_level(flash) == level) {
        return KEEL_BSP_OK;
    }
    if (!keel_wait_for(&flash->SR, FLASH_SR_BSY, 0u, wait)) {
        return KEEL_BSP_TIMEOUT;
    }
    flash->OPTKEYR = OPTION_KEY_1;
    flash->OPTKEYR = OPTION_KEY_2;
    keel_bits_put(&flash->OPTCR, FLASH_OPTCR_BOR_LEV, FIELD(FLASH_OPTCR_BOR_LEV, (uint32_t)level));
    flash->OPTCR |= FLASH_OPTCR_OPTSTRT;
    done = keel_wait_for(&flash->OPTCR, FLASH_OPTCR_OPTSTRT, 0u, wait);
    flash->OPTCR |= FLASH_OPTCR_OPTLOCK;
    if (!done) {
        return KEEL_BSP_TIMEOUT;
    }
    return (keel_brownout_level(flash) == level) ? KEEL_BSP_OK : KEEL_BSP_VERIFY;
}

keel_bsp_status_t keel_backup_open(keel_rcc_t *rcc, keel_pwr_t *pwr, const keel_wait_t *wait)
{
    keel_bits_enable(&rcc->APB1ENR, RCC_APB1ENR_PWREN);
    pwr->CR1 |= PWR_CR1_DBP;
    keel_bits_enable(&rcc->AHB1ENR, RCC_AHB1ENR_BKPSRAMEN);
    return keel_wait_for(&pwr->CR1, PWR_CR1_DBP, PWR_CR1_DBP, wait) ? KEEL_BSP_OK
                                                                    : KEEL_BSP_TIMEOUT;
}

keel_restart_t keel_restart_of(uint32_t csr)
{
    /* What counts most comes last. */
    static const struct {
        uint32_t flags;
        keel_restart_t restart;
    } order[] = {{RCC_CSR_PINRSTF, KEEL_RESTART_PIN},
                 {RCC_CSR_SFTRSTF, KEEL_RESTART_ASKED},
                 {RCC_CSR_BORRSTF, KEEL_RESTART_BROWNOUT},
                 {RCC_CSR_PORRSTF, KEEL_RESTART_POWER},
                 {RCC_CSR_IWDGRSTF | RCC_CSR_WWDGRSTF, KEEL_RESTART_WATCHDOG}};
    keel_restart_t found = KEEL_RESTART_UNTOLD;

    for (uint32_t i = 0u; i < (sizeof(order) / sizeof(order[0])); i++) {
        found = ((csr & order[i].flags) != 0u) ? order[i].restart : found;
    }
    return found;
}
