/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Does a compiler, with the flags that Keel gets, compute floats as the proofs take it (A-23 of
 * specs/soundness.md)? CMake compiles this file, and runs it where it can. On a board, compile it
 * with Keel's flags and -Dmain=float_check, and call that function: it gives 0, or the number of
 * the first question that fails. cmake/KeelFloats.cmake has each in words, in the same order.
 */
#include <float.h>
#include <stdint.h>
#include <string.h>

#if (FLT_RADIX != 2) || (FLT_MANT_DIG != 24) || (FLT_MIN_EXP != -125) || (FLT_MAX_EXP != 128)
#error "float is not IEEE 754's single precision"
#endif
#if defined(FLT_EVAL_METHOD)
#if (FLT_EVAL_METHOD != 0) && (FLT_EVAL_METHOD != 16)
#error "float is computed in a wider type"
#endif
#endif
#if defined(__FAST_MATH__)
#error "the compiler may compute as it likes (__FAST_MATH__)"
#endif
#if defined(__FINITE_MATH_ONLY__)
#if __FINITE_MATH_ONLY__ != 0
#error "the compiler takes it that there is no NaN (__FINITE_MATH_ONLY__)"
#endif
#endif

/* What no compiler can work out before the program runs. */
static volatile float one = 1.0f;
static volatile float near_one = 1.000244140625f; /* 1 + 2^-12, whose square is rounded. */
static volatile float hundred_million = 1e8f;     /* From here on floats are 8 apart. */
static volatile float forty_one = 41.0f;          /* 41 times 1/41, rounded, is not 1. */
static volatile float negative_zero = -0.0f;
static volatile float largest = FLT_MAX;
static volatile float least_normal = FLT_MIN;

static uint32_t bits(float value)
{
    uint32_t word;
    (void)memcpy(&word, &value, sizeof word);
    return word;
}

static int fuses(void)
{
    float x = near_one;
    float y = 1.00048828125f; /* x times x, rounded. */
    return bits((x * x) - y) != 0u;
}

static int reorders(void)
{
    float x = one;
    float y = hundred_million;
    return bits((x + y) - y) != 0u;
}

static int divides_by_reciprocal(void)
{
    return bits(forty_one / 41.0f) != bits(1.0f);
}

static int knows_no_nan(void)
{
    float infinity = largest * 2.0f;
    float nan = infinity - infinity;
    return (nan == nan) || (nan < 0.0f) || (nan >= 0.0f);
}

static int loses_zeros_sign(void)
{
    return bits(negative_zero + 0.0f) != 0u;
}

static int keeps_what_overflows(void)
{
    float x = largest;
    return ((x * 2.0f) / 2.0f) <= FLT_MAX;
}

static int rounds_otherwise(void)
{
    float x = one;
    float less = FLT_EPSILON / 8.0f;
    return (bits(x + less) != bits(1.0f)) || (bits(x - less) != bits(1.0f)) ||
           (bits(-x - less) != bits(-1.0f));
}

static int flushes_subnormals(void)
{
    return bits(least_normal / 2.0f) != 0x00400000u;
}

int main(void)
{
    static int (*const wrong[])(void) = {
        fuses,
        reorders,
        divides_by_reciprocal,
        knows_no_nan,
        loses_zeros_sign,
        keeps_what_overflows,
        rounds_otherwise,
        flushes_subnormals,
    };
    int number;
    for (number = 0; number < (int)(sizeof wrong / sizeof wrong[0]); number++) {
        if (wrong[number]()) {
            return number + 1;
        }
    }
    return 0;
}
