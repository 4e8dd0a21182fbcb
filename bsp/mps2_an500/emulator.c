/* SPDX-License-Identifier: Apache-2.0 */
#include "mps2_an500/emulator.h"

#include <stdint.h>

#define SYS_EXIT_EXTENDED 0x20u
#define APPLICATION_EXIT  0x20026u

void keel_emulator_exit(int status)
{
    const uint32_t arguments[2] = {APPLICATION_EXIT, (uint32_t)status};
    register uint32_t operation __asm("r0") = SYS_EXIT_EXTENDED;
    register const uint32_t *pointer __asm("r1") = arguments;

    __asm volatile("bkpt 0xAB" : "+r"(operation) : "r"(pointer) : "memory");
    for (;;) {
    }
}
