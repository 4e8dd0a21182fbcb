/* SPDX-License-Identifier: Apache-2.0 */
#include "range.h"

/* RNG-001. NaN is the only value that does not equal itself; infinities lie beyond finite ends. */
bool model_range_contains(float value, float lowest, float highest)
{
    const bool number = value == value;

    return number && !(value < lowest) && !(highest < value);
}

/* RNG-002. An end takes the place of what equals it, too: 0 and -0 are equal. */
float model_range_clamp(float value, float lowest, float highest)
{
    float clamped = value;

    if (!(clamped > lowest)) {
        clamped = lowest; /* NaN, too, is not above it. */
    }
    if (!(clamped < highest)) {
        clamped = highest;
    }
    return clamped;
}
