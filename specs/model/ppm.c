/* SPDX-License-Identifier: Apache-2.0 */
#include "ppm.h"

#include "framing.h"

/* PPM-001, PPM-002 */
keel_status_t model_ppm_init(keel_ppm_t *ppm, const keel_ppm_config_t *config)
{
    const keel_ppm_t fresh = {.config = *config, .age_us = UINT32_MAX, .quiet_us = UINT32_MAX};
    const bool ordered = (config->lowest_us <= config->highest_us) &&
                         (config->highest_us < config->sync_us) &&
                         (config->sync_us < config->lost_us);

    if (!ordered) {
        return KEEL_ERR_LIMITS;
    }
    if ((config->least < 1u) || (config->least > 16u)) {
        return KEEL_ERR_LIMITS;
    }
    if (config->frames_to_take < 1u) {
        return KEEL_ERR_LATCH;
    }
    *ppm = fresh;
    return KEEL_OK;
}

/* PPM-008 */
void model_ppm_pass_time(keel_ppm_t *ppm, uint32_t elapsed_us)
{
    ppm->age_us = model_framing_sum(ppm->age_us, elapsed_us);
    ppm->quiet_us = model_framing_sum(ppm->quiet_us, elapsed_us);
}

/* PPM-009: the frame that comes is none, nor part of a row. */
static void refused(keel_ppm_t *ppm, uint32_t *reason)
{
    *reason = model_framing_sum(*reason, 1u);
    ppm->row = 0u;
    ppm->begun = false;
}

/* PPM-009: how many of as many channels come in a row with this one. */
static uint8_t row_with(const keel_ppm_t *ppm)
{
    if ((ppm->row == 0u) || (ppm->come != ppm->row_of)) {
        return 1u;
    }
    return (ppm->row == ppm->config.frames_to_take) ? ppm->row : (uint8_t)(ppm->row + 1u);
}

/* PPM-005, PPM-007 */
static void published(keel_ppm_t *ppm)
{
    for (uint32_t i = 0u; i < 16u; i++) {
        ppm->channel[i] = 0u;
        if (i < ppm->come) {
            ppm->channel[i] = ppm->next[i];
        }
    }
    ppm->channels = ppm->come;
    ppm->age_us = 0u;
    ppm->count.frames = model_framing_sum(ppm->count.frames, 1u);
}

/* PPM-004, PPM-009 */
static bool ended(keel_ppm_t *ppm)
{
    if (!ppm->begun) {
        return false;
    }
    if (ppm->come < ppm->config.least) {
        refused(ppm, &ppm->count.numbers);
        return false;
    }
    ppm->row = row_with(ppm);
    ppm->row_of = ppm->come;
    if (ppm->row < ppm->config.frames_to_take) {
        return false;
    }
    published(ppm);
    return true;
}

/* PPM-004: whether the channel that comes next is judged. */
static bool judged(const keel_ppm_t *ppm)
{
    uint32_t bits = ppm->config.judged;

    for (uint32_t i = 0u; i < 16u; i++) {
        bits /= (i < ppm->come) ? 2u : 1u;
    }
    return (bits % 2u) == 1u;
}

/* PPM-009 */
static void went_on(keel_ppm_t *ppm, uint32_t width)
{
    if (!ppm->begun) {
        return;
    }
    if (judged(ppm) && ((width < ppm->config.lowest_us) || (ppm->config.highest_us < width))) {
        refused(ppm, &ppm->count.pulses);
    } else if (ppm->come >= 16u) {
        refused(ppm, &ppm->count.numbers);
    } else {
        ppm->next[ppm->come] = (uint16_t)width;
        ppm->come = (uint8_t)(ppm->come + 1u);
    }
}

/* PPM-003 to PPM-010 */
bool model_ppm_take(keel_ppm_t *ppm, uint32_t elapsed_us)
{
    const uint32_t width = model_framing_sum(ppm->quiet_us, elapsed_us);
    bool taken = false;

    model_ppm_pass_time(ppm, elapsed_us);
    ppm->quiet_us = 0u;
    if (width < ppm->config.sync_us) {
        went_on(ppm, width);
        return false;
    }
    if (width <= ppm->config.lost_us) { /* PPM-010 */
        taken = ended(ppm);
        ppm->begun = true;
    } else {
        if (ppm->begun) {
            refused(ppm, &ppm->count.gaps);
        }
        ppm->row = 0u;
    }
    ppm->come = 0u;
    return taken;
}

/* PPM-011 */
bool model_ppm_is_lost(const keel_ppm_t *ppm)
{
    return ppm->config.lost_us < ppm->age_us;
}
