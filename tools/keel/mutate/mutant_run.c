/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mutant_run.c
 * @brief Executes harnesses on inputs: kept ones, and as many variations of them as it is told.
 *
 *     program run HARNESS FILE COUNT ...     until an execution fails
 *     program again HARNESS FILE NUMBER      one of them, from a fresh start; tells what was drawn
 *     program pack HARNESS FILE              what of a file executions take to their end, to stdout
 *
 * An input is a list of slots of 64 bits. The first seeds what the others do not say, each of the
 * others is one value, most of them such as matter: small, one of the harness's numbers, one that
 * was drawn before, and what lies beside these; or it says the value (LITERAL). The input with a
 * number is the same on every machine and does not depend on what was executed before it.
 *
 * What is not defined by C traps (the sanitizers) and ends the execution, and shows nothing. Nor
 * does one that goes on for too long.
 */
#include "mutant_run.h"

#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#pragma clang section bss = "" data = ""

#define LITERAL     0xFFu /* in a slot's lowest byte: the others are the value */
#define SLOTS       4096u
#define DRAWS       65536u
#define KEPT        1024u
#define PATIENCE_US 50000
#define TICKS       3
#define HANGS       3u
#define TRAPS       200u

typedef enum {
    HELD,
    ASSUMED_AWAY,
    FAILED,
    HUNG,
    UNDEFINED
} outcome_t;

extern const keel_run_entry_t *const keel_run_entries[];
extern const size_t keel_run_entry_count;
/* Made by the linker. */
extern char __start_keel_zero[] __attribute__((weak));
extern char __stop_keel_zero[] __attribute__((weak));
extern char __start_keel_data[] __attribute__((weak));
extern char __stop_keel_data[] __attribute__((weak));

static const keel_run_entry_t *entry;
static jmp_buf out;
static volatile sig_atomic_t running;
static volatile uint64_t executions;
static const char *failed;
static char *first_data;

static uint64_t slots[SLOTS];
static size_t slot_count;
static size_t draws;
static uint64_t values[DRAWS];
static float floats[DRAWS];
static size_t float_count;
static uint64_t ints[DRAWS];
static size_t int_count;

static uint64_t mixed(uint64_t x)
{
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

static void leave(outcome_t outcome)
{
    running = 0;
    _longjmp(out, (int)outcome + 1);
}

/* --- What is drawn -------------------------------------------------------------------------- */

static uint64_t next_slot(void)
{
    draws++;
    if (draws >= DRAWS) {
        leave(HUNG);
    }
    return (draws < slot_count) ? slots[draws] : mixed(slots[0] + draws);
}

static float float_of(uint32_t bits)
{
    float value;

    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t bits_of(float value)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* A number, or what lies beside it, or a part of it; or that of the other sign. */
static float beside(float value, uint64_t how)
{
    const float part = (float)((how >> 8) & 0xFFFFu) / 65536.0f;
    const float same = ((how & 0x30u) == 0u) ? -value : value;

    switch (how & 15u) {
    case 0u:
    case 1u:
        return float_of(bits_of(same) + 1u);
    case 2u:
        return float_of(bits_of(same) - 1u);
    case 3u:
    case 4u:
    case 5u:
        return same * part;
    case 6u:
        return same + part;
    case 7u:
        return same - part;
    case 8u:
        return same * (1.0f + part);
    default:
        return same;
    }
}

static float special(uint64_t which)
{
    static const uint32_t bits[] = {
        0u,          0x80000000u, 0x7F800000u, 0xFF800000u, 0x7FC00000u, 0x7F7FFFFFu,
        0xFF7FFFFFu, 0x00800000u, 0x00000001u, 0x80000001u, 0x3F800000u, 0xBF800000u,
    };

    return float_of(bits[which % (sizeof bits / sizeof bits[0])]);
}

static float drawn_float(uint64_t slot)
{
    const uint32_t kind = slot & 0xFFu;
    const uint64_t rest = slot >> 8;

    if (kind == LITERAL) {
        return float_of((uint32_t)rest);
    }
    if (kind < 16u) {
        return float_of((uint32_t)mixed(slot));
    }
    if (kind < 64u) {
        return (float)((int)(rest % 33u) - 16) / (float)(1u << ((rest >> 8) % 6u));
    }
    if (kind < 128u) { /* magnitudes from 2^-12 to 2^11 */
        const uint32_t exponent = 115u + (uint32_t)((rest >> 24) % 24u);
        const uint32_t sign = (uint32_t)(rest >> 50) & 1u;

        return float_of((sign << 31) | (exponent << 23) | (uint32_t)(rest & 0x7FFFFFu));
    }
    if (kind < 140u) {
        return special(rest);
    }
    if ((kind < 208u) && (entry->count > 0u)) {
        return beside((float)entry->numbers[(rest >> 24) % entry->count], rest);
    }
    if (float_count > 0u) {
        return beside(floats[(rest >> 24) % float_count], rest);
    }
    return (float)(rest % 3u);
}

static uint64_t integer_of(double value)
{
    return (value < 18446744073709551616.0) ? (uint64_t)value : UINT64_MAX;
}

static uint64_t drawn_int(uint64_t slot, uint64_t most)
{
    const uint32_t kind = slot & 0xFFu;
    const uint64_t rest = slot >> 8;
    const uint64_t down = ((rest & 7u) == 2u) ? UINT64_MAX : 0u;
    const uint64_t step = ((rest & 7u) == 1u) ? 1u : down;

    if (kind == LITERAL) {
        return rest;
    }
    if (kind < 24u) {
        return mixed(slot);
    }
    if (kind < 96u) {
        return (rest >> 8) % 17u;
    }
    if (kind < 112u) {
        return (rest >> 8) & 0xFFu;
    }
    if (kind < 120u) {
        return ((uint64_t)1u << ((rest >> 8) % 64u)) + step;
    }
    if (kind < 128u) {
        return most - ((rest >> 8) % 3u);
    }
    if ((kind < 208u) && (entry->count > 0u)) {
        const uint64_t number = integer_of(entry->numbers[(rest >> 24) % entry->count]);

        return ((rest & 8u) != 0u)
                   ? (mixed(rest) % ((number < UINT64_MAX) ? (number + 1u) : number))
                   : (number + step);
    }
    if (int_count > 0u) { /* drawn before, or the difference to another one */
        const uint64_t value = ints[(rest >> 24) % int_count];

        return ((rest & 8u) != 0u) ? (value - ints[(rest >> 40) % int_count] + step)
                                   : (value + step);
    }
    return rest & 1u;
}

uint64_t keel_run_int(size_t size)
{
    const uint64_t most = (size < 8u) ? (((uint64_t)1u << (8u * size)) - 1u) : UINT64_MAX;
    const uint64_t value = drawn_int(next_slot(), most) & most;

    values[draws] = value;
    ints[int_count++] = value;
    return value;
}

bool keel_run_bool(void)
{
    const uint64_t slot = next_slot();
    const bool value = ((slot >> (((slot & LITERAL) == LITERAL) ? 8u : 16u)) & 1u) != 0u;

    values[draws] = value ? 1u : 0u;
    return value;
}

float keel_run_float(void)
{
    const float value = drawn_float(next_slot());

    values[draws] = bits_of(value);
    floats[float_count++] = value;
    return value;
}

/* --- One execution -------------------------------------------------------------------------- */

void keel_run_assume(bool holds)
{
    if (!holds) {
        leave(ASSUMED_AWAY);
    }
}

void keel_run_assert(bool holds, const char *text)
{
    if (!holds) {
        failed = text;
        leave(FAILED);
    }
}

/* As bits; one NaN is like another. */
bool keel_run_equal(float a, float b)
{
    return (bits_of(a) == bits_of(b)) || ((a != a) && (b != b));
}

static void undefined(int number)
{
    (void)number;
    if (running == 0) {
        _exit(98);
    }
    leave(UNDEFINED);
}

static void tick(int number)
{
    static uint64_t last;
    static int seen;

    (void)number;
    seen = ((running != 0) && (last == executions)) ? (seen + 1) : 0;
    last = executions;
    if (seen >= TICKS) {
        seen = 0;
        leave(HUNG);
    }
}

__attribute__((no_builtin)) static void prepare(void)
{
    const size_t size = (size_t)(__stop_keel_data - __start_keel_data);
    const struct itimerval period = {{0, PATIENCE_US}, {0, PATIENCE_US}};
    static const int traps[] = {SIGILL, SIGTRAP, SIGFPE, SIGSEGV, SIGBUS};
    struct sigaction action = {.sa_flags = SA_NODEFER};

    action.sa_handler = undefined;
    for (size_t i = 0u; i < (sizeof traps / sizeof traps[0]); i++) {
        sigaction(traps[i], &action, NULL);
    }
    action.sa_handler = tick;
    sigaction(SIGVTALRM, &action, NULL);
    setitimer(ITIMER_VIRTUAL, &period, NULL);
    first_data = malloc(size + 1u);
    if (first_data == NULL) {
        _exit(97);
    }
    for (size_t i = 0u; i < size; i++) {
        first_data[i] = __start_keel_data[i];
    }
}

/* Gives objects their first values. Between them lie bytes that the sanitizer lets no library
 * function touch. */
__attribute__((no_builtin)) static void begin_anew(void)
{
    const char *first = first_data;

    for (char *at = __start_keel_zero; at < __stop_keel_zero; at++) {
        *at = 0;
    }
    for (char *at = __start_keel_data; at < __stop_keel_data; at++) {
        *at = *first++;
    }
}

static outcome_t execute(void)
{
    int left;

    begin_anew();
    draws = 0u;
    float_count = 0u;
    int_count = 0u;
    executions++;
    left = _setjmp(out);
    if (left != 0) {
        return (outcome_t)(left - 1);
    }
    running = 1;
    entry->run();
    running = 0;
    return HELD;
}

/* --- Inputs --------------------------------------------------------------------------------- */

static uint64_t *kept;
static size_t kept_start[KEPT + 1u];
static size_t kept_count;

static void take_kept(size_t place)
{
    slot_count = kept_start[place + 1u] - kept_start[place];
    memcpy(slots, &kept[kept_start[place]], slot_count * sizeof slots[0]);
}

/* Changes some of the slots; another input may lend its own. */
static void vary(uint64_t random, const uint64_t *other, size_t other_count)
{
    const uint32_t changes = 1u + (uint32_t)(((random & 3u) == 0u) ? ((random >> 8) % 12u)
                                                                   : ((random >> 8) % 3u));

    for (uint32_t i = 0u; i < changes; i++) {
        random = mixed(random);
        const size_t to = (size_t)((random >> 8) % slot_count);
        const size_t from = (size_t)((random >> 36) % slot_count);

        switch (random & 7u) {
        case 0u:
        case 1u:
            slots[to] = slots[from];
            break;
        case 2u:
            slots[to] += (random & 8u) ? 0x100u : 0x10000u;
            break;
        case 3u:
            if (to < other_count) {
                slots[to] = other[to];
            }
            break;
        default:
            slots[to] = mixed(random);
            break;
        }
    }
}

static void take(size_t number)
{
    const uint64_t random = mixed(number * 0x2545F4914F6CDD1Du);

    if (number < kept_count) {
        take_kept(number);
    } else if ((kept_count == 0u) || ((number % 16u) == 0u)) {
        slot_count = 1u;
        slots[0] = random;
    } else {
        const size_t other = (size_t)((random >> 32) % kept_count);

        take_kept((size_t)(random % kept_count));
        vary(mixed(random), &kept[kept_start[other]], kept_start[other + 1u] - kept_start[other]);
    }
}

/* A file of inputs: a count of slots, and they. */
static void read_kept(const char *path)
{
    FILE *const file = fopen(path, "rb");
    size_t size = 0u;
    uint32_t count;

    kept_count = 0u;
    kept_start[0] = 0u;
    free(kept);
    kept = NULL;
    if (file == NULL) {
        _exit(96);
    }
    while ((kept_count < KEPT) && (fread(&count, sizeof count, 1u, file) == 1u)) {
        count = (count > SLOTS) ? SLOTS : count;
        kept = realloc(kept, (size + count + 1u) * sizeof slots[0]);
        if ((kept == NULL) || (count == 0u) ||
            (fread(&kept[size], sizeof slots[0], count, file) != count)) {
            break;
        }
        size += count;
        kept_count++;
        kept_start[kept_count] = size;
    }
    fclose(file);
}

/* --- What the program is asked -------------------------------------------------------------- */

#ifndef KEEL_RUN_SEARCH

static const keel_run_entry_t *entry_of(const char *name)
{
    for (size_t i = 0u; i < keel_run_entry_count; i++) {
        if (strcmp(keel_run_entries[i]->name, name) == 0) {
            return keel_run_entries[i];
        }
    }
    _exit(95);
}

static void tell_values(void)
{
    printf("VALUES");
    for (size_t i = 1u; i <= draws; i++) {
        printf(" 0x%llX", (unsigned long long)values[i]);
    }
    printf("\n");
}

/* All inputs, until one fails, or too many show nothing. */
static bool passes(size_t count)
{
    size_t seen[UNDEFINED + 1] = {0u};
    size_t most = 0u;

    for (size_t number = 0u; number < count; number++) {
        outcome_t outcome;

        take(number);
        outcome = execute();
        seen[outcome]++;
        most = (draws > most) ? draws : most;
        if (outcome == FAILED) {
            printf("FAILED %s %zu %s\n", entry->name, number, failed);
            return false;
        }
        if ((draws == 0u) || (seen[HUNG] >= HANGS) || (seen[UNDEFINED] >= TRAPS)) {
            break; /* where nothing is drawn, one execution is all */
        }
    }
    printf("PASSED %s %zu %zu %zu %zu\n", entry->name, seen[HELD], seen[HUNG], seen[UNDEFINED],
           most);
    fflush(stdout);
    return seen[HUNG] < HANGS;
}

static void again(size_t number)
{
    take(number);
    if (execute() == FAILED) {
        printf("FAILED %s %zu %s\n", entry->name, number, failed);
        tell_values();
    }
}

/* Each input with all that was drawn, so that a variation is one of what was executed. */
static void pack(void)
{
    for (size_t place = 0u; place < kept_count; place++) {
        uint32_t count;

        take_kept(place);
        if (execute() != HELD) {
            continue;
        }
        count = (uint32_t)(((draws + 1u) < SLOTS) ? (draws + 1u) : SLOTS);
        for (size_t i = slot_count; i < count; i++) {
            slots[i] = mixed(slots[0] + i);
        }
        fwrite(&count, sizeof count, 1u, stdout);
        fwrite(slots, sizeof slots[0], count, stdout);
    }
}

int main(int argc, char **argv)
{
    prepare();
    if ((argc == 4) && (strcmp(argv[1], "pack") == 0)) {
        entry = entry_of(argv[2]);
        read_kept(argv[3]);
        pack();
        return 0;
    }
    for (int i = 2; (i + 2) < argc; i += 3) {
        entry = entry_of(argv[i]);
        read_kept(argv[i + 1]);
        if (strcmp(argv[1], "again") == 0) {
            again(strtoul(argv[i + 2], NULL, 10));
        } else if (!passes(strtoul(argv[i + 2], NULL, 10))) {
            break;
        }
    }
    return 0;
}

#else

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned int seed);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (entry == NULL) {
        entry = keel_run_entries[0];
        prepare();
    }
    slot_count = size / sizeof slots[0];
    if ((slot_count == 0u) || (slot_count > SLOTS)) {
        return -1;
    }
    memcpy(slots, data, slot_count * sizeof slots[0]);
    switch (execute()) {
    case FAILED:
        abort(); /* the code is unchanged: nobody can use this harness */
    case UNDEFINED:
        return -1;
    default:
        return 0;
    }
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned int seed)
{
    const uint64_t random = mixed(seed);
    const size_t longest = (most / sizeof slots[0] < SLOTS) ? (most / sizeof slots[0]) : SLOTS;
    size_t wanted;

    slot_count = size / sizeof slots[0];
    if ((slot_count == 0u) || ((random & 0x3Fu) == 0u)) {
        slots[0] = mixed(random);
        slot_count = 1u;
    } else {
        memcpy(slots, data, slot_count * sizeof slots[0]);
        wanted = slot_count + (size_t)((random >> 8) % 16u);
        wanted = (wanted < longest) ? wanted : longest;
        for (; slot_count < wanted; slot_count++) {
            slots[slot_count] = mixed(slots[0] + slot_count);
        }
        vary(mixed(random), NULL, 0u);
    }
    memcpy(data, slots, slot_count * sizeof slots[0]);
    return slot_count * sizeof slots[0];
}

#endif
