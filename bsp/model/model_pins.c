/* SPDX-License-Identifier: Apache-2.0 */
/* The outputs with the timers that make their pulses, and each edge of their pins.
 *
 * A timer's edges are worked out when something looks: behind each write to a timer, a port or a
 * clock, and at the end of a turn. A register counts from its write on. */
#include "model.h"

#include "stm32f767/registers/gpio.h"
#include "stm32f767/registers/rcc.h"
#include "stm32f767/registers/tim.h"

#include <stddef.h>
#include <string.h>

#define TIMERS      3u
#define CHANNELS    4u
#define PORT_SIZE   0x400u
#define ARMED_PORT  8u
#define ARMED_PIN   0u
#define MODE_PWM    6u
#define MODE_BITS   7u
#define EDGES       0x200000u /* Four outputs' of ten minutes. */
#define FIRST_TICKS 27u       /* Of a count at 16 MHz, behind a reset. */

/* A timer. */
typedef struct model_timer {
    uint32_t base;
    bool has_gate;
    uint32_t active[CHANNELS]; /* The pulses of this period, in its counts. */
    uint64_t from;             /* When it began. */
    uint64_t passed;           /* Up to where edges are worked out. */
} model_timer_t;

/* An output as the board wires it: FMU_CH1 to FMU_CH8. */
typedef struct model_output {
    uint8_t port;
    uint8_t pin;
    uint8_t timer;
    uint8_t channel; /* From 0 on. */
    uint8_t function;
} model_output_t;

static const model_output_t outputs[MODEL_OUTPUTS] = {
    {4u, 14u, 0u, 3u, 1u}, {0u, 10u, 0u, 2u, 1u}, {4u, 11u, 0u, 1u, 1u}, {4u, 9u, 0u, 0u, 1u},
    {3u, 13u, 1u, 1u, 2u}, {3u, 14u, 1u, 2u, 2u}, {7u, 6u, 2u, 0u, 9u},  {7u, 9u, 2u, 1u, 9u},
};

static model_timer_t timers[TIMERS];
static uint32_t clock_ticks = FIRST_TICKS; /* Of a timer's clock. */
static uint32_t levels[MODEL_OUTPUTS + 1u];
static model_edge_t edges[EDGES];
static uint32_t edge_count;

static uint32_t timer_word(const model_timer_t *timer, uint32_t offset)
{
    return *model_word(timer->base + offset);
}

static uint64_t count_ticks(const model_timer_t *timer)
{
    return ((uint64_t)timer_word(timer, offsetof(keel_tim_t, PSC)) + 1u) * clock_ticks;
}

static uint64_t period_ticks(const model_timer_t *timer)
{
    return ((uint64_t)timer_word(timer, offsetof(keel_tim_t, ARR)) + 1u) * count_ticks(timer);
}

static bool counts(const model_timer_t *timer)
{
    return (timer_word(timer, offsetof(keel_tim_t, CR1)) & TIM_CR1_CEN) != 0u;
}

/* --- What is noted. --- */

void model_note(uint64_t at, uint32_t line, uint32_t level)
{
    if (edge_count < EDGES) {
        edges[edge_count] = (model_edge_t){at, line, level};
        edge_count++;
    } else {
        model_fail("there are more edges than are kept");
    }
}

const model_edge_t *model_edges(uint32_t *count)
{
    *count = edge_count;
    return edges;
}

/* --- What a pin does. --- */

/* The mode of a channel of a timer, with its preload: of each half of CCMR1 and CCMR2. */
static uint32_t channel_mode(const model_timer_t *timer, uint32_t channel)
{
    const uint32_t offset = (channel < 2u) ? offsetof(keel_tim_t, CCMR1)
                                           : offsetof(keel_tim_t, CCMR2);

    return timer_word(timer, offset) >> (8u * (channel % 2u));
}

/* A channel that is off, or no PWM of mode 1, gives nothing that a pin could rely on. */
static uint32_t timer_level(const model_timer_t *timer, uint32_t channel, uint64_t at)
{
    const uint32_t enabled = timer_word(timer, offsetof(keel_tim_t, CCER)) >> (4u * channel);
    const uint32_t gate = timer_word(timer, offsetof(keel_tim_t, BDTR));

    if (((enabled & 3u) != 1u) ||
        (((channel_mode(timer, channel) >> 4u) & MODE_BITS) != MODE_PWM)) {
        return MODEL_FLOATS;
    }
    if (timer->has_gate && ((gate & TIM_BDTR_MOE) == 0u)) {
        return ((gate & TIM_BDTR_OSSI) != 0u) ? MODEL_LOW : MODEL_FLOATS;
    }
    return ((at - timer->from) < (timer->active[channel] * count_ticks(timer))) ? MODEL_HIGH
                                                                                : MODEL_LOW;
}

static uint32_t output_level(const model_output_t *output, uint64_t at)
{
    const uint32_t base = GPIOA_BASE + (PORT_SIZE * output->port);
    const uint32_t mode = (*model_word(base) >> (2u * output->pin)) & 3u;

    if (mode == 1u) {
        return ((*model_word(base + offsetof(keel_gpio_t, ODR)) >> output->pin) & 1u) != 0u
                   ? MODEL_HIGH
                   : MODEL_LOW;
    }
    return model_pin_has(output->port, output->pin, output->function)
               ? timer_level(&timers[output->timer], output->channel, at)
               : MODEL_FLOATS;
}

static void note_level(uint64_t at, uint32_t line, uint32_t level)
{
    if (levels[line] != level) {
        levels[line] = level;
        model_note(at, line, level);
    }
}

/* nARMED is open; its resistor is on the board. */
static void note_levels(uint64_t at)
{
    for (uint32_t i = 0u; i < MODEL_OUTPUTS; i++) {
        note_level(at, i, output_level(&outputs[i], at));
    }
    note_level(at, MODEL_ARMED, model_pin_is_low(ARMED_PORT, ARMED_PIN) ? MODEL_LOW : MODEL_HIGH);
}

/* --- Time passes. --- */

static void take_pulses(model_timer_t *timer)
{
    for (uint32_t i = 0u; i < CHANNELS; i++) {
        timer->active[i] = timer_word(timer, offsetof(keel_tim_t, CCR1) + (4u * i));
    }
}

/* The next time at which a pulse ends, or a period. */
static uint64_t next_of(const model_timer_t *timer)
{
    uint64_t next = timer->from + period_ticks(timer);

    for (uint32_t i = 0u; i < CHANNELS; i++) {
        const uint64_t ends = timer->from + (timer->active[i] * count_ticks(timer));

        next = ((ends > timer->passed) && (ends < next)) ? ends : next;
    }
    return next;
}

static void pass_event(model_timer_t *timer, uint64_t at)
{
    if ((at - timer->from) >= period_ticks(timer)) {
        timer->from = at;
        take_pulses(timer);
    }
    timer->passed = at;
    note_levels(at);
}

/* The timer whose next event is the first, up to now; null: there is none. */
static model_timer_t *first_timer(uint64_t now)
{
    model_timer_t *first = NULL;

    for (uint32_t i = 0u; i < TIMERS; i++) {
        if (counts(&timers[i]) && (next_of(&timers[i]) <= now) &&
            ((first == NULL) || (next_of(&timers[i]) < next_of(first)))) {
            first = &timers[i];
        }
    }
    return first;
}

void model_pins_pass(void)
{
    const uint64_t now = model_now();

    for (model_timer_t *first = first_timer(now); first != NULL; first = first_timer(now)) {
        pass_event(first, next_of(first));
    }
}

void model_pins_look(void)
{
    note_levels(model_now());
}

/* --- Registers. --- */

static model_timer_t *timer_of(uint32_t base)
{
    uint32_t i = 0u;

    while (timers[i].base != base) {
        i++;
    }
    return &timers[i];
}

/* A channel without its preload takes a pulse at once. */
static void take_at_once(model_timer_t *timer, uint32_t offset, uint32_t value)
{
    const uint32_t channel = (offset - (uint32_t)offsetof(keel_tim_t, CCR1)) / 4u;

    if ((channel < CHANNELS) && ((channel_mode(timer, channel) & TIM_CCMR1_OC1PE) == 0u)) {
        timer->active[channel] = value;
    }
}

void model_timer_write(uint32_t base, uint32_t offset, uint32_t value)
{
    model_timer_t *const timer = timer_of(base);
    const bool counted = counts(timer);

    model_pins_pass();
    *model_word(base + offset) = value;
    if ((!counted && counts(timer)) ||
        ((offset == offsetof(keel_tim_t, EGR)) && ((value & TIM_EGR_UG) != 0u))) {
        timer->from = model_now();
        timer->passed = model_now();
    }
    if ((offset == offsetof(keel_tim_t, EGR)) && ((value & TIM_EGR_UG) != 0u)) {
        take_pulses(timer);
    }
    take_at_once(timer, offset, value);
    model_pins_look();
}

void model_timers_clock(uint32_t ticks)
{
    model_pins_pass();
    for (uint32_t i = 0u; i < TIMERS; i++) {
        if (counts(&timers[i])) {
            const uint64_t count = (model_now() - timers[i].from) / clock_ticks;

            timers[i].from = model_now() - (count * ticks);
            timers[i].passed = model_now();
        }
    }
    clock_ticks = ticks;
}

uint32_t model_pulse_us(uint32_t output)
{
    const model_output_t *const place = &outputs[output];
    const model_timer_t *const timer = &timers[place->timer];
    const bool is_open = (timer_word(timer, offsetof(keel_tim_t, BDTR)) & TIM_BDTR_MOE) != 0u;
    const bool is_on = ((timer_word(timer, offsetof(keel_tim_t, CCER)) >> (4u * place->channel)) &
                        1u) != 0u;

    model_pins_pass();
    if (!is_on || !counts(timer) || (timer->has_gate && !is_open) ||
        !model_pin_has(place->port, place->pin, place->function)) {
        return 0u;
    }
    return (uint32_t)((timer->active[place->channel] * count_ticks(timer)) / MODEL_TICKS_PER_US);
}

/* --- Start and reset. --- */

void model_pins_start(void)
{
    edge_count = 0u;
    for (uint32_t i = 0u; i <= MODEL_OUTPUTS; i++) {
        levels[i] = MODEL_UNKNOWN;
    }
}

void model_pins_reset(void)
{
    static const model_timer_t fresh[TIMERS] = {
        {.base = TIM1_BASE, .has_gate = true}, {.base = TIM4_BASE}, {.base = TIM12_BASE}};

    memcpy(timers, fresh, sizeof timers);
    clock_ticks = FIRST_TICKS;
    model_pins_look();
}
