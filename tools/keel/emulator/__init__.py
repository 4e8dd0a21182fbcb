# SPDX-License-Identifier: Apache-2.0
"""A model of an STM32F767 and of the devices around it, which runs a board's image.

chip, processor    the chip's peripherals, and the core that runs an image
chip_model         an image on a board's model: `python3 tools/keel model`
attached, wiring   which device is at which bus and pin of a board
spi, i2c, dma_uart the buses, and what a line receives by DMA
capture, pulses    timers that measure edges, and outputs
icm20689, bmi055, motion, ist8310, ms5611, fram, card    the devices
"""
