/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/pin.h"

#define MODE_INPUT     0u
#define MODE_OUTPUT    1u
#define MODE_ALTERNATE 2u
#define MODE_ANALOGUE  3u
#define MODE_MASK      3u
#define SPEED_HIGH     2u
#define RESET_HALF     16u /* BSRR: the upper half clears. */
#define PINS_PER_AFR   8u
#define FUNCTION_BITS  4u

static void put_two_bits(volatile uint32_t *target, uint32_t number, uint32_t value)
{
    keel_bits_put(target, BITS(2u * number, 2u), value << (2u * number));
}

static uint32_t level_of(keel_pin_t pin, bool high)
{
    return 1u << (pin.number + (high ? 0u : RESET_HALF));
}

void keel_pin_write(keel_pin_t pin, bool high)
{
    pin.port->BSRR = level_of(pin, high);
}

bool keel_pin_read(keel_pin_t pin)
{
    return ((pin.port->IDR >> pin.number) & 1u) != 0u;
}

/* Not by keel_pin_write, which lies in ITCM: the first outputs are low before that is filled. */
void keel_pin_output(keel_pin_t pin, keel_drive_t drive, bool high)
{
    pin.port->BSRR = level_of(pin, high);
    keel_bits_put(&pin.port->OTYPER, BITS(pin.number, 1u), (uint32_t)drive << pin.number);
    put_two_bits(&pin.port->PUPDR, pin.number, (uint32_t)KEEL_PULL_NONE);
    put_two_bits(&pin.port->MODER, pin.number, MODE_OUTPUT);
}

void keel_pin_input(keel_pin_t pin, keel_pull_t pull)
{
    put_two_bits(&pin.port->PUPDR, pin.number, (uint32_t)pull);
    put_two_bits(&pin.port->MODER, pin.number, MODE_INPUT);
}

static void give_pin(keel_pin_t pin, uint32_t function, keel_drive_t drive, keel_pull_t pull)
{
    const uint32_t shift = FUNCTION_BITS * (pin.number % PINS_PER_AFR);
    volatile uint32_t *const select = (pin.number < PINS_PER_AFR) ? &pin.port->AFRL
                                                                  : &pin.port->AFRH;

    keel_bits_put(select, BITS(shift, FUNCTION_BITS), function << shift);
    keel_bits_put(&pin.port->OTYPER, BITS(pin.number, 1u), (uint32_t)drive << pin.number);
    put_two_bits(&pin.port->OSPEEDR, pin.number, SPEED_HIGH);
    put_two_bits(&pin.port->PUPDR, pin.number, (uint32_t)pull);
    put_two_bits(&pin.port->MODER, pin.number, MODE_ALTERNATE);
}

void keel_pin_alternate(keel_pin_t pin, uint32_t function, keel_pull_t pull)
{
    give_pin(pin, function, KEEL_DRIVE_PUSH_PULL, pull);
}

void keel_pin_alternate_open_drain(keel_pin_t pin, uint32_t function, keel_pull_t pull)
{
    give_pin(pin, function, KEEL_DRIVE_OPEN_DRAIN, pull);
}

bool keel_pin_is_alternate(keel_pin_t pin)
{
    return ((pin.port->MODER >> (2u * pin.number)) & MODE_MASK) == MODE_ALTERNATE;
}

void keel_pin_analogue(keel_pin_t pin)
{
    put_two_bits(&pin.port->PUPDR, pin.number, (uint32_t)KEEL_PULL_NONE);
    put_two_bits(&pin.port->MODER, pin.number, MODE_ANALOGUE);
}
