# SPDX-License-Identifier: Apache-2.0
"""What is joined to what on the boards whose chip is modelled."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from keel.emulator.spi import SPI1, SPI2, SPI4, Bus, Pin, Seat

RCC = 0x4002_3800
AHB1ENR, APB1ENR, APB2ENR = RCC + 0x30, RCC + 0x40, RCC + 0x44
USART3, UART7 = 0x4000_4800, 0x4000_7800

Pins = tuple[Pin, Pin, Pin]  # Clock, from the device, to the device.
SENSORS_ON: Pin = (4, 3)  # PE3: 3.3 V of an FMUv5's sensors.


def spi1(pins: Pins) -> Bus:
    return Bus(SPI1, pins, (APB2ENR, 12), 108)


# Limits of buses in MHz, and what a unit needs after its supply in us, are of the data sheets.
ICM20689 = ("ICM-20689", 8.0, 11_000)
BMI055 = {"BMI055's gyroscope": ((5, 4), 10.0), "BMI055's accelerometer": ((6, 10), 10.0)}


@dataclass(frozen=True)
class LineWiring:
    """A UART at a socket: the stream of DMA that takes its bytes, its pin with its function."""

    uart: str
    dma: int
    stream: int
    rx: Pin
    function: int
    clock: tuple[int, int]  # Register and bit.
    clock_hz: int


@dataclass(frozen=True)
class Wiring:
    """A board around the chip."""

    console: int
    buses: tuple[Bus, ...]
    seats: tuple[Seat, ...]
    lines: Mapping[str, LineWiring] = field(default_factory=dict)
    i2c: tuple[Pin, Pin] | None = None  # SCL and SDA of I2C 3, with an IST8310.
    button: Pin | None = None  # Of the safety switch: it joins its pin to 3.3 V.
    ppm: Pin | None = None  # Of a receiver of PPM, which only pulls it low.


def icm20689(select: Pin, supply: Pin | None) -> Seat:
    name, limit_mhz, ready_us = ICM20689
    return Seat(name, SPI1, select, limit_mhz, supply, ready_us)


WIRINGS = {
    "nucleo_f767zi": Wiring(USART3, (spi1(((0, 5), (0, 6), (0, 7))),), (icm20689((3, 14), None),)),
    "fmuv5": Wiring(
        UART7,
        (
            spi1(((6, 11), (0, 6), (3, 7))),
            Bus(SPI2, ((8, 1), (8, 2), (8, 3)), (APB1ENR, 14), 54),
            Bus(SPI4, ((4, 2), (4, 13), (4, 6)), (APB2ENR, 13), 108),
        ),
        (
            icm20689((5, 2), SENSORS_ON),
            *(
                Seat(name, SPI1, select, limit_mhz, SENSORS_ON, 3_000)
                for name, (select, limit_mhz) in BMI055.items()
            ),
            Seat("memory", SPI2, (5, 5), 40.0),
            Seat("barometer", SPI4, (5, 10), 20.0, SENSORS_ON),
        ),
        {
            "pilot": LineWiring("USART6", 2, 1, (6, 9), 8, (APB2ENR, 5), 108_000_000),
            "spare": LineWiring("USART3", 1, 1, (3, 9), 7, (APB1ENR, 18), 54_000_000),
            "satellites": LineWiring("USART1", 2, 5, (1, 7), 7, (APB2ENR, 4), 108_000_000),
            "telemetry": LineWiring("USART2", 1, 5, (3, 6), 7, (APB1ENR, 17), 54_000_000),
        },
        ((7, 7), (7, 8)),
        (4, 10),
        (8, 5),
    ),
}

# After FMUv5, with an ICM-20602 besides.
ICM20602 = Seat("ICM-20602", SPI1, (5, 3), 10.0, SENSORS_ON, 11_000)
WIRINGS["cuav_v5"] = replace(WIRINGS["fmuv5"], seats=(*WIRINGS["fmuv5"].seats, ICM20602))
