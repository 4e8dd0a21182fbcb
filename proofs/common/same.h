/**
 * @file same.h
 * @brief Whether two objects are the same in every field: what the code leaves and what the model
 *        (specs/model) leaves.
 *
 * One function for each structure; each compares every field of it (make prove checks that none is
 * left out). Padding has no meaning and is not compared.
 */
#ifndef SAME_H
#define SAME_H

#include <stdbool.h>

/* Bit for bit, so that 0 and -0 differ; all that are no number are the same. */
static inline bool float_same(float a, float b)
{
    return ((a == b) && (__CPROVER_signf(a) == __CPROVER_signf(b))) || ((a != a) && (b != b));
}

#endif
