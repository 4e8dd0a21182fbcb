/* SPDX-License-Identifier: Apache-2.0 */
/* What the functions of app/limiter.h do, as plainly as possible. */
#ifndef MODEL_LIMITER_H
#define MODEL_LIMITER_H

#include "app/limiter.h"

#include <stdbool.h>

void model_limiter_init(limiter_t *limiter, uint16_t limit);
uint16_t model_limiter_step(limiter_t *limiter, uint16_t value);

#endif
