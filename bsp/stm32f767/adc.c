/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/adc.h"

#include <stdbool.h>

/* The chip's own sensors are sampled for 10 us at least (data sheet, temperature sensor and
 * reference voltage). Of the divisors of 108 MHz, 2 is beyond the converter's 36 MHz. With 4 and 6
 * the time to sample that is long enough is 480 cycles, 18 and 27 us; with 8, at 13.5 MHz, it is
 * 144, which are 10.7 us: the shortest conversion. It is long enough for a pin behind 50 kOhm,
 * too. */
#define PRESCALER_8  3u
#define SAMPLING_144 6u

#define SAMPLING_BITS  3u
#define SMPR1_CHANNELS 9u  /* 10 to 18. */
#define SMPR2_CHANNELS 10u /* 0 to 9. */

/* Data sheet, tSTAB and tSTART: the converter is up within 3 us, the chip's sensors within 10. One
 * more, as the clock's first microsecond has begun when it is read. */
#define STABLE_US 4u
#define START_US  11u

#define CHANNEL_PIN_MAX 15u

#define COUNTS          4096u
#define CALIBRATED_MV   3300u
#define CALIBRATED_CDEG 3000

/* The calibrations lie 8000 hundredths of a degree apart, at 3300 mV. A hundredth of both keeps the
 * product below 2^31. */
#define SPAN_CDEG 80
#define SPAN_MV   33

/* The same time to sample for each of a register's channels. */
static uint32_t sampling(uint32_t channels)
{
    uint32_t word = 0u;

    for (uint32_t i = 0u; i < channels; i++) {
        word = (word << SAMPLING_BITS) | SAMPLING_144;
    }
    return word;
}

/* On, with nothing left of what was before; each conversion's end is told, and with it overruns
 * (RM0410, 15.8.2). */
static keel_bsp_status_t switch_on(const keel_adc_device_t *device, uint32_t time_us)
{
    device->adc->SR = 0u;
    device->adc->CR2 = ADC_CR2_EOCS | ADC_CR2_ADON;
    return keel_wait_us(device->clock_us, device->context, time_us, device->wait->looks)
               ? KEEL_BSP_OK
               : KEEL_BSP_TIMEOUT;
}

keel_bsp_status_t keel_adc_start(const keel_adc_device_t *device, uint32_t clock_hz)
{
    keel_adc_t *const adc = device->adc;

    if ((clock_hz < KEEL_ADC_CLOCK_MIN_HZ) || (clock_hz > KEEL_ADC_CLOCK_MAX_HZ)) {
        return KEEL_BSP_ARGUMENT;
    }
    adc->CR2 = 0u; /* Off while it is set up. */
    /* VBATE stays off: the battery would take the temperature sensor's channel (RM0410, 15.11). */
    device->common->CCR = FIELD(ADC_COMMON_CCR_ADCPRE, PRESCALER_8) | ADC_COMMON_CCR_TSVREFE;
    adc->CR1 = 0u; /* 12 bits, one channel, no interrupt. */
    adc->SMPR1 = sampling(SMPR1_CHANNELS);
    adc->SMPR2 = sampling(SMPR2_CHANNELS);
    adc->SQR1 = 0u; /* One conversion. */
    return switch_on(device, START_US);
}

/* Off ends a conversion, so that it cannot become the next one's. The sensors stay on. */
static void restart(const keel_adc_device_t *device)
{
    device->adc->CR2 = 0u;
    (void)switch_on(device, STABLE_US);
}

static bool is_channel(uint32_t channel)
{
    return (channel <= CHANNEL_PIN_MAX) || (channel == KEEL_ADC_REFERENCE) ||
           (channel == KEEL_ADC_TEMPERATURE);
}

keel_bsp_status_t keel_adc_read(const keel_adc_device_t *device, uint32_t channel, uint16_t *count)
{
    keel_adc_t *const adc = device->adc;
    uint32_t data;

    if (!is_channel(channel)) {
        return KEEL_BSP_ARGUMENT;
    }
    adc->SQR3 = FIELD(ADC_SQR3_SQ1, channel);
    adc->SR = 0u; /* What ends from here on is this conversion. */
    adc->CR2 |= ADC_CR2_SWSTART;
    if (!keel_wait_for(&adc->SR, ADC_SR_EOC, ADC_SR_EOC, device->wait)) {
        restart(device);
        return KEEL_BSP_TIMEOUT;
    }
    data = adc->DR & ADC_DR_DATA;
    if ((adc->SR & ADC_SR_OVR) != 0u) {
        restart(device);
        return KEEL_BSP_BUS;
    }
    *count = (uint16_t)data;
    return KEEL_BSP_OK;
}

static bool is_count(uint32_t count)
{
    return (count > 0u) && (count <= KEEL_ADC_COUNT_MAX);
}

static bool is_supply(uint32_t supply_mv)
{
    return (supply_mv >= KEEL_ADC_SUPPLY_MIN_MV) && (supply_mv <= KEEL_ADC_SUPPLY_MAX_MV);
}

keel_bsp_status_t keel_adc_supply(const keel_adc_calibration_t *calibration, uint16_t count,
                                  uint32_t *supply_mv)
{
    uint32_t found;

    if (!is_count(calibration->reference) || (count > KEEL_ADC_COUNT_MAX)) {
        return KEEL_BSP_ARGUMENT;
    }
    if (count == 0u) {
        return KEEL_BSP_RANGE;
    }
    found = ((CALIBRATED_MV * calibration->reference) + (count / 2u)) / count;
    if (!is_supply(found)) {
        return KEEL_BSP_RANGE;
    }
    *supply_mv = found;
    return KEEL_BSP_OK;
}

keel_bsp_status_t keel_adc_pin(uint16_t count, uint32_t supply_mv, uint32_t *pin_mv)
{
    if ((count > KEEL_ADC_COUNT_MAX) || !is_supply(supply_mv)) {
        return KEEL_BSP_ARGUMENT;
    }
    *pin_mv = ((count * supply_mv) + (COUNTS / 2u)) / COUNTS;
    return KEEL_BSP_OK;
}

/* Halves away from zero. */
static int32_t rounded(int32_t numerator, int32_t denominator)
{
    const int32_t half = denominator / 2;

    return ((numerator < 0) ? (numerator - half) : (numerator + half)) / denominator;
}

keel_bsp_status_t keel_adc_temperature(const keel_adc_calibration_t *calibration, uint16_t count,
                                       uint32_t supply_mv, int32_t *temperature_cdeg)
{
    const uint32_t scaled = count * supply_mv;
    const uint32_t scaled_30 = calibration->at_30 * CALIBRATED_MV;
    int32_t span;
    int32_t beyond;
    int32_t found;

    if ((count > KEEL_ADC_COUNT_MAX) || !is_supply(supply_mv) || !is_count(calibration->at_30) ||
        !is_count(calibration->at_110) || (calibration->at_110 <= calibration->at_30)) {
        return KEEL_BSP_ARGUMENT;
    }
    span = (int32_t)calibration->at_110 - (int32_t)calibration->at_30;
    beyond = (int32_t)scaled - (int32_t)scaled_30;
    found = CALIBRATED_CDEG + rounded(beyond * SPAN_CDEG, span * SPAN_MV);
    if ((found < KEEL_ADC_TEMPERATURE_MIN_CDEG) || (found > KEEL_ADC_TEMPERATURE_MAX_CDEG)) {
        return KEEL_BSP_RANGE;
    }
    *temperature_cdeg = found;
    return KEEL_BSP_OK;
}
