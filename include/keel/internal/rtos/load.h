/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/load.h
 * @brief The contracts of load.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_RTOS_LOAD_H
#define KEEL_INTERNAL_RTOS_LOAD_H

#include "keel/c_declarations.h"
#include "keel/rtos/load.h"

KEEL_C_BEGIN

/*@ requires \valid(load);
  @ assigns *load;
  @ ensures LOD_006: load->start_us == now_us && load->busy_us == busy_us;
  @*/
void keel_load_begin(keel_load_t *load, uint64_t now_us, uint64_t busy_us);

/*@ requires \valid_read(load);
  @ requires load->start_us <= now_us && now_us - load->start_us <= UINT32_MAX;
  @ requires load->busy_us <= busy_us && busy_us - load->busy_us <= now_us - load->start_us;
  @ assigns \nothing;
  @ ensures LOD_007_range: \result <= KEEL_LOAD_FULL_PPM;
  @ ensures LOD_007_empty: now_us == load->start_us ==> \result == 0;
  @ ensures LOD_007_load: now_us > load->start_us ==> \result ==
  @     ((busy_us - load->busy_us) * KEEL_LOAD_FULL_PPM) / (now_us - load->start_us);
  @*/
uint32_t keel_load_ppm(const keel_load_t *load, uint64_t now_us, uint64_t busy_us);

KEEL_C_END

#endif
