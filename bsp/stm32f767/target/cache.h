/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file cache.h
 * @brief The core's caches. Keel has no DMA, so they need no care once they are on.
 */
#ifndef KEEL_BSP_STM32F767_TARGET_CACHE_H
#define KEEL_BSP_STM32F767_TARGET_CACHE_H

/** Invalidates both caches, whose content is random after power-on, and switches them on. */
void keel_cache_start(void);

#endif
