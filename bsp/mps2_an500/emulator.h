/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file emulator.h
 * @brief What the emulator offers a program by semihosting (Arm, Semihosting for AArch32).
 */
#ifndef KEEL_BSP_MPS2_AN500_EMULATOR_H
#define KEEL_BSP_MPS2_AN500_EMULATOR_H

/** Ends the emulator with an exit status from 0 to 255. */
void keel_emulator_exit(int status) __attribute__((noreturn));

#endif
