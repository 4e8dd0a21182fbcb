/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/spi_bus.h"

#define CODE_MAX   7u
#define BYTE_FRAME 7u /* Eight bits, less one. */
#define FIFO_BYTES 4u

keel_bsp_status_t keel_spi_divisor(uint32_t clock_hz, uint32_t limit_hz, uint32_t *code)
{
    uint32_t found = 0u;

    while ((found <= CODE_MAX) && ((clock_hz >> (found + 1u)) > limit_hz)) {
        found++;
    }
    if (found > CODE_MAX) {
        return KEEL_BSP_ARGUMENT;
    }
    *code = found;
    return KEEL_BSP_OK;
}

keel_bsp_status_t keel_spi_start(keel_spi_t *spi, uint32_t clock_hz, uint32_t limit_hz)
{
    uint32_t code;

    if (keel_spi_divisor(clock_hz, limit_hz, &code) != KEEL_BSP_OK) {
        return KEEL_BSP_ARGUMENT;
    }
    spi->CR1 = 0u; /* Off while it is set up. */
    spi->CR2 = FIELD(SPI_CR2_DS, BYTE_FRAME) | SPI_CR2_FRXTH;
    spi->CR1 = SPI_CR1_CPHA | SPI_CR1_CPOL | SPI_CR1_MSTR | FIELD(SPI_CR1_BR, code) | SPI_CR1_SSM |
               SPI_CR1_SSI;
    spi->CR1 |= SPI_CR1_SPE;
    return KEEL_BSP_OK;
}

/* The data register, a byte wide: a wider access would move two bytes at once (RM0410, 35.5.9). */
static volatile uint8_t *data_byte(keel_spi_t *spi)
{
    return (volatile uint8_t *)&spi->DR;
}

static keel_bsp_status_t exchange_byte(const keel_spi_device_t *device, uint8_t out, uint8_t *in)
{
    keel_spi_t *const spi = device->spi;

    if (!keel_wait_for(&spi->SR, SPI_SR_TXE, SPI_SR_TXE, device->wait)) {
        return KEEL_BSP_TIMEOUT;
    }
    *data_byte(spi) = out;
    if (!keel_wait_for(&spi->SR, SPI_SR_RXNE, SPI_SR_RXNE, device->wait)) {
        return KEEL_BSP_TIMEOUT;
    }
    *in = *data_byte(spi);
    return ((spi->SR & (SPI_SR_OVR | SPI_SR_MODF)) == 0u) ? KEEL_BSP_OK : KEEL_BSP_BUS;
}

/* Whatever of a failed exchange is still on its way must not become the next one's: the bus off,
 * its receive FIFO emptied, and on again (RM0410, 35.5.9). The status read after the data ends an
 * overrun; a mode fault has switched the master off, which writing CR1 ends. */
static void recover(keel_spi_t *spi)
{
    spi->CR1 &= ~SPI_CR1_SPE;
    for (uint32_t i = 0u; (i < FIFO_BYTES) && ((spi->SR & SPI_SR_RXNE) != 0u); i++) {
        (void)*data_byte(spi);
    }
    (void)*data_byte(spi);
    (void)spi->SR;
    spi->CR1 |= SPI_CR1_MSTR;
    spi->CR1 |= SPI_CR1_SPE;
}

keel_bsp_status_t keel_spi_bus_exchange(void *context, const uint8_t *out, uint8_t *in,
                                        uint32_t length, uint32_t *done)
{
    const keel_spi_device_t *const device = context;
    keel_bsp_status_t status = KEEL_BSP_OK;
    uint32_t exchanged = 0u;

    keel_pin_write(device->select, false);
    while ((exchanged < length) && (status == KEEL_BSP_OK)) {
        status = exchange_byte(device, out[exchanged], &in[exchanged]);
        if (status == KEEL_BSP_OK) {
            exchanged++;
        }
    }
    /* The last bit is out before the device is deselected; a bus that failed is not waited for. */
    if ((status == KEEL_BSP_OK) && !keel_wait_for(&device->spi->SR, SPI_SR_BSY, 0u, device->wait)) {
        status = KEEL_BSP_TIMEOUT;
    }
    keel_pin_write(device->select, true);
    if (status != KEEL_BSP_OK) {
        recover(device->spi);
    }
    *done = exchanged;
    return status;
}
