/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file voter.h
 * @brief What the functions of keel/middleware/voter.h do.
 */
#ifndef MODEL_VOTER_H
#define MODEL_VOTER_H

#include "keel/middleware/voter.h"

keel_status_t model_voter_check(const keel_voter_config_t *config);
keel_status_t model_voter_init(keel_voter_t *voter, const keel_voter_config_t *config);
void model_voter_scale(keel_voter_t *voter);
float model_voter_agreement(float x, float y, float agree, float disagree);
float model_voter_weight(const float agreement[], uint32_t others);
float model_voter_mean(float sum, float weights, float least, float most);
float model_voter_plain_mean(const keel_voter_sample_t sample[], uint32_t sensors, float least,
                             float most);
bool model_voter_within(float least, float most, float agree);
float model_voter_combine(const keel_voter_sample_t sample[], const float weight[],
                          uint32_t sensors);
void model_voter_step(keel_voter_t *voter, const keel_voter_sample_t sample[], uint32_t elapsed_us);
bool model_voter_step_unanimous(keel_voter_t *voter, const keel_voter_sample_t sample[],
                                uint32_t oldest_us);
keel_status_t model_voter_readmit(keel_voter_t *voter, uint32_t sensor);
void model_voter_reconsider(keel_voter_t *voter, const keel_voter_sample_t sample[]);

#endif
