// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9
// sources: src/middleware/voter.c
// defines: -DKEEL_VOTER_SENSORS=3u
// covers: keel_voter_combine keel_voter_mean
//
// The operations of eq. 18 for three sensors and their order are those of mean_of_three, whose
// roundings mean.g bounds: on numbers with which any other order of the sums, and a fused product
// and sum, give another result.
#include "../common/voter_proof.h"
#include "voter_mean.h"

#define POINTS 8u

typedef struct point {
    float weight[3];
    float value[3];
} point_t;

static const point_t points[POINTS] = {
    {{0x1.fda0ccp-2f, 0x1.b60814p-1f, 0x1.8f1162p-1f},
     {0x1.0b5208p+9f, -0x1.db51f2p+5f, -0x1.182cf8p+8f}},
    {{0x1.ecc29cp-1f, 0x1.8ab714p-2f, 0x1.24496p-4f},
     {0x1.8c2adap+8f, -0x1.e186a4p+9f, 0x1.5a7cc6p+9f}},
    {{0x1.389608p-2f, 0x1.feaad4p-1f, 0x1.40490cp-2f},
     {0x1.efc49cp+7f, -0x1.5a6e8cp+9f, -0x1.b8fb08p+6f}},
    {{0x1.228fb2p-1f, 0x1.f512d8p-2f, 0x1.5fde8p-6f},
     {-0x1.b54e54p+9f, 0x1.561ddep+9f, -0x1.3862a2p+8f}},
    {{0x1.b04868p-1f, 0x1.782aaep-1f, 0x1.ba488p-6f},
     {0x1.9d3076p+8f, -0x1.1cd874p+9f, -0x1.48a952p+7f}},
    {{0x1.65765ap-1f, 0x1.7c19acp-1f, 0x1.eb92eep-1f},
     {-0x1.d5d48ep+9f, -0x1.1c4b38p+9f, 0x1.2a1062p+9f}},
    {{0x1.2dcf8p-6f, 0x1.42f95cp-2f, 0x1.ce0bccp-1f},
     {0x1.4bffa4p+9f, -0x1.a99228p+9f, 0x1.53f6aap+7f}},
    {{0x1.ab1a6cp-1f, 0x1.3a7accp-1f, 0x1.10448ep-1f},
     {0x1.cfbd2ap+8f, -0x1.e970fap+9f, 0x1.2a5a3ap+3f}},
};

void keel_voter_combine__rounding_harness(void)
{
    for (uint32_t i = 0u; i < POINTS; i++) {
        const float *const w = points[i].weight;
        const float *const x = points[i].value;
        const keel_voter_sample_t sample[3] = {
            {x[0], 0u, true}, {x[1], 0u, true}, {x[2], 0u, true}};
        const float mean = keel_voter_combine(sample, w, 3u);

        __CPROVER_assert(mean == mean_of_three(w[0], x[0], w[1], x[1], w[2], x[2]),
                         "VOT_016_operations: eq. 18 as rounded, where the clamp does nothing");
    }
}
