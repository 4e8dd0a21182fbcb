/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mpu.h
 * @brief The memory protection unit, from a board's table of regions.
 *
 * Where regions overlap, the later one of the table holds. Memory in no region is as the
 * architecture's default map says.
 */
#ifndef KEEL_BSP_CORTEX_M7_MPU_H
#define KEEL_BSP_CORTEX_M7_MPU_H

#include <stdbool.h>
#include <stdint.h>

/** Who may do what in a region. */
typedef enum keel_mpu_access {
    KEEL_MPU_NONE,   /**< Nobody anything: a guard. */
    KEEL_MPU_CODE,   /**< Read and execute. */
    KEEL_MPU_DATA,   /**< Read and write. */
    KEEL_MPU_DEVICE, /**< Read and write, in order and uncached. */
} keel_mpu_access_t;

/** One region. */
typedef struct keel_mpu_region {
    uint32_t base;   /**< A multiple of its size. */
    uint32_t log2_b; /**< The size is 2^log2_b bytes, log2_b from 5 to 31. */
    keel_mpu_access_t access;
} keel_mpu_region_t;

/** The attribute and size register's value for a region, enabled. */
uint32_t keel_mpu_attributes(const keel_mpu_region_t *region);

/** Whether a table can be set up: at most 8 regions, sizes in range, bases aligned. */
bool keel_mpu_valid(const keel_mpu_region_t *region, uint32_t count);

/** Sets up the regions and switches the unit on; off for the hard-fault handler. */
void keel_mpu_start(const keel_mpu_region_t *region, uint32_t count);

#endif
