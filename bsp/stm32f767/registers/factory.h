/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file factory.h
 * @brief What the maker wrote on each chip, in the system memory: its number (RM0410, unique device
 *        ID, 96 bits), and half-words that were measured (data sheet, calibration values of the
 *        temperature sensor and of the internal reference voltage).
 */
#ifndef KEEL_BSP_STM32F767_FACTORY_H
#define KEEL_BSP_STM32F767_FACTORY_H

#define UID_BASE        0x1FF0F420u
#define VREFINTCAL_BASE 0x1FF0F44Au
#define TS_CAL1_BASE    0x1FF0F44Cu
#define TS_CAL2_BASE    0x1FF0F44Eu

#endif
