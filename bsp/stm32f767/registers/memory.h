/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file memory.h
 * @brief Memories of the STM32F767 (RM0410, chapter 2): addresses and sizes in bytes.
 */
#ifndef KEEL_BSP_STM32F767_MEMORY_H
#define KEEL_BSP_STM32F767_MEMORY_H

#define MEMORY_ITCM_BASE   0x00000000u
#define MEMORY_ITCM_SIZE   0x00004000u
#define MEMORY_FLASH_BASE  0x08000000u
#define MEMORY_FLASH_SIZE  0x00200000u
#define MEMORY_DTCM_BASE   0x20000000u
#define MEMORY_DTCM_SIZE   0x00020000u
#define MEMORY_SRAM_BASE   0x20020000u
#define MEMORY_SRAM_SIZE   0x00060000u
#define MEMORY_BACKUP_BASE 0x40024000u
#define MEMORY_BACKUP_SIZE 0x00001000u

#endif
