/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file range.h
 * @brief What the functions of keel/middleware/range.h do.
 */
#ifndef MODEL_RANGE_H
#define MODEL_RANGE_H

#include "keel/middleware/range.h"

bool model_range_contains(float value, float lowest, float highest);
float model_range_clamp(float value, float lowest, float highest);

#endif
