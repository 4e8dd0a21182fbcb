/* SPDX-License-Identifier: Apache-2.0 */
#include "cortex_m7/mpu.h"

#include "cortex_m7/core.h"

#define MPU      ((keel_mpu_t *)MPU_BASE)
#define REGIONS  8u
#define LOG2_MIN 5u
#define LOG2_MAX 31u

/* Access permissions: for privileged code, all that Keel has. */
#define AP_NONE       FIELD(MPU_RASR_AP, 0u)
#define AP_READ_WRITE FIELD(MPU_RASR_AP, 1u)
#define AP_READ_ONLY  FIELD(MPU_RASR_AP, 5u)

/* Normal memory that is cached, write-back and write-allocate; and a device's registers. */
#define NORMAL (FIELD(MPU_RASR_TEX, 1u) | MPU_RASR_C | MPU_RASR_B)
#define DEVICE MPU_RASR_B

static uint32_t permissions(keel_mpu_access_t access)
{
    switch (access) {
    case KEEL_MPU_CODE:
        return AP_READ_ONLY | NORMAL;
    case KEEL_MPU_DATA:
        return AP_READ_WRITE | NORMAL | MPU_RASR_XN;
    case KEEL_MPU_DEVICE:
        return AP_READ_WRITE | DEVICE | MPU_RASR_XN;
    case KEEL_MPU_NONE:
    default:
        return AP_NONE | NORMAL | MPU_RASR_XN;
    }
}

uint32_t keel_mpu_attributes(const keel_mpu_region_t *region)
{
    /* The field holds the size's logarithm less one. */
    return permissions(region->access) | FIELD(MPU_RASR_SIZE, region->log2_b - 1u) |
           MPU_RASR_ENABLE;
}

bool keel_mpu_valid(const keel_mpu_region_t *region, uint32_t count)
{
    if (count > REGIONS) {
        return false;
    }
    for (uint32_t i = 0u; i < count; i++) {
        const uint32_t log2_b = region[i].log2_b;

        if ((log2_b < LOG2_MIN) || (log2_b > LOG2_MAX) ||
            ((region[i].base & ((1u << log2_b) - 1u)) != 0u)) {
            return false;
        }
    }
    return true;
}

void keel_mpu_start(const keel_mpu_region_t *region, uint32_t count)
{
    MPU->CTRL = 0u;
    for (uint32_t i = 0u; i < REGIONS; i++) {
        MPU->RNR = i;
        MPU->RASR = 0u;
        if (i < count) {
            MPU->RBAR = region[i].base;
            MPU->RASR = keel_mpu_attributes(&region[i]);
        }
    }
    MPU->CTRL = MPU_CTRL_PRIVDEFENA | MPU_CTRL_ENABLE;
    __asm volatile("dsb\n\tisb" ::: "memory");
}
