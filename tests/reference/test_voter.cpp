/* SPDX-License-Identifier: Apache-2.0 */
/* The voter against eq. 16 to 18 in long double, over random and adversarial samples. Tolerances
 * follow from the rounding of each operation (u = 2^-24), none is tuned. */
#include "reference.hpp"

#include <Eigen/Dense>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

extern "C" {
#include "keel/internal/middleware/voter.h"
}

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;

static const Real u = 0x1p-24L;
static std::mt19937_64 generator(20240607);

static float uniform(float low, float high)
{
    return std::uniform_real_distribution<float>(low, high)(generator);
}

static float any_bits()
{
    const auto bits = static_cast<std::uint32_t>(generator());
    float value;

    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/* Eq. 16 as it is printed. */
static Real eq16(Real d, Real a, Real n)
{
    return (d <= a) ? 1 : ((d >= n * a) ? 0 : (n / (n - 1)) * (1 - d / (n * a)));
}

static bool agrees_with_eq16()
{
    for (int i = 0; i < 200000; i++) {
        const float a = uniform(0.001f, 100.0f);
        const float disagree = a * uniform(1.01f, 20.0f);
        const float d = uniform(0.0f, 1.2f * disagree);
        const Real exact = eq16(d, a, static_cast<Real>(disagree) / a);
        const float s = keel_voter_agreement(0.0f, d, a, disagree);

        /* Two differences and a quotient: three roundings. */
        if ((s > 1.0f) || (std::fabs(s - exact) > 3.001L * u * exact + 1e-17L)) {
            return false;
        }
    }
    return true;
}

static bool mean_is_rounded_as_proved()
{
    for (int i = 0; i < 200000; i++) {
        keel_voter_sample_t sample[3];
        float weight[3];
        Vector x;
        Vector w;

        for (int k = 0; k < 3; k++) {
            sample[k].value = uniform(-1000.0f, 1000.0f);
            weight[k] = uniform(0x1p-24f, 1.0f);
            x[k] = sample[k].value;
            w[k] = weight[k];
        }
        const float mean = keel_voter_combine(sample, weight, 3u);

        if (std::fabs(mean - w.dot(x) / w.sum()) > 6.0001L * u * x.cwiseAbs().maxCoeff()) {
            return false;
        }
    }
    return true;
}

static keel_voter_config_t usual(float a, float n)
{
    keel_voter_config_t config = {};

    config.agree = a;
    config.cutoff = n;
    config.lowest = -1000.0f;
    config.highest = 1000.0f;
    config.max_age_us = 1000u;
    config.latch_count = 100u;
    config.sensors = 3u;
    return config;
}

/* VOT-015: the least c of the requirement. */
static Real influence(Real n)
{
    return (3 * n < 4) ? 1.0L / 3 : (2 * n - 1 - std::sqrt((3 * n - 1) * (n - 1))) / 2;
}

static bool influence_is_bounded(bool wild)
{
    for (int i = 0; i < 300000; i++) {
        const float a = uniform(0.01f, 10.0f);
        const float n = uniform(1.01f, 10.0f);
        const float x = uniform(-500.0f, 500.0f);
        const float y = x + uniform(-1.0f, 1.0f) * 0.99f * a;
        const float z = wild ? any_bits() : (x + uniform(-1.1f, 1.1f) * n * a);
        const int at = static_cast<int>(generator() % 3u);
        keel_voter_sample_t sample[3] = {{x, 0u, true}, {y, 0u, true}, {z, 0u, true}};
        const keel_voter_config_t config = usual(a, n);
        keel_voter_t voter;

        std::swap(sample[at], sample[2]);
        if (keel_voter_init(&voter, &config) != KEEL_OK) {
            return false;
        }
        keel_voter_step(&voter, sample, 10u);
        const Real output = voter.vote.output;
        const Real excess = std::fmax(output - std::fmax(x, y),
                                      static_cast<Real>(std::fmin(x, y)) - output);
        /* VOT-017, with the n that the channel has: its n a is rounded. */
        const Real n_ = voter.disagree / static_cast<Real>(a);
        const Real c = influence(n_);
        const bool three = voter.vote.weight[at] > 0.0f;
        const Real largest = std::fmax(std::fmax(std::fabs(x), std::fabs(y)),
                                       three ? std::fabs(z) : 0.0f);
        const Real room = u *
                          ((4.01L * n_ * (n_ + 2 * c + 0.5L) / (n_ - 1) + 1.01L * (n_ + 1)) * a +
                           6.01L * largest);

        if (!(excess <= c * a + room)) {
            return false;
        }
    }
    return true;
}

static bool any_bit_pattern_gives_a_plausible_output()
{
    for (int round = 0; round < 200; round++) {
        const keel_voter_config_t config = usual(uniform(0.01f, 100.0f), uniform(1.1f, 9.0f));
        keel_voter_t voter;

        if (keel_voter_init(&voter, &config) != KEEL_OK) {
            return false;
        }
        for (int i = 0; i < 1000; i++) {
            keel_voter_sample_t sample[3];

            for (auto &one : sample) {
                one.value = (generator() % 2u == 0u) ? any_bits() : uniform(-1100.0f, 1100.0f);
                one.age_us = static_cast<std::uint32_t>(generator() % 1100u);
                one.present = generator() % 8u != 0u;
            }
            keel_voter_step(&voter, sample, 10u);
            if (!(std::fabs(voter.vote.output) <= 1000.0f)) {
                return false;
            }
            (void)keel_voter_readmit(&voter, static_cast<std::uint32_t>(generator() % 3u));
        }
    }
    return true;
}

/* VOT-018: the same output, bit for bit, and the same verdicts; at least a quarter is taken. */
static bool unanimous_is_the_whole_vote()
{
    int taken = 0;
    int asked = 0;

    for (int round = 0; round < 2000; round++) {
        const float a = uniform(0.01f, 100.0f);
        keel_voter_config_t config = usual(a, uniform(1.1f, 9.0f));
        keel_voter_t voter;

        config.sensors = static_cast<std::uint8_t>(2u + (generator() % 3u));
        config.stale_count = 2u;
        if (keel_voter_init(&voter, &config) != KEEL_OK) {
            return false;
        }
        for (int i = 0; i < 100; i++) {
            const float truth = uniform(-950.0f, 950.0f);
            const bool rests = generator() % 8u == 0u;
            keel_voter_sample_t sample[KEEL_VOTER_SENSORS];
            keel_voter_t whole = voter;

            for (std::uint32_t k = 0; k < config.sensors; k++) {
                sample[k] = {truth + uniform(-0.52f, 0.52f) * a, 0u, true};
                sample[k].value = rests ? voter.sensor[k].last : sample[k].value;
            }
            keel_voter_step(&whole, sample, 10u);
            asked++;
            if (!keel_voter_step_unanimous(&voter, sample, 0u)) {
                voter = whole;
                continue;
            }
            taken++;
            if (std::memcmp(&voter.vote.output, &whole.vote.output, sizeof(float)) != 0 ||
                voter.vote.state != whole.vote.state || !whole.unanimous) {
                return false;
            }
            for (std::uint32_t k = 0; k < config.sensors; k++) {
                if (voter.vote.weight[k] != whole.vote.weight[k] ||
                    voter.vote.reason[k] != whole.vote.reason[k] ||
                    voter.sensor[k].last != whole.sensor[k].last ||
                    voter.sensor[k].unchanged_votes != whole.sensor[k].unchanged_votes ||
                    voter.sensor[k].condemned_votes != whole.sensor[k].condemned_votes ||
                    voter.sensor[k].density != whole.sensor[k].density) {
                    return false;
                }
            }
        }
    }
    return 4 * taken >= asked;
}

int main()
{
    reference::Suite suite;

    suite.check("VOT_015_influence_of_three", std::fabs(influence(3) - 0.5L) < 1e-15L,
                "c(3) is not 1/2");
    suite.check("VOT_003_agreement_of_eq_16", agrees_with_eq16(), "differs from eq. 16");
    suite.check("VOT_016_mean_of_eq_18", mean_is_rounded_as_proved(), "beyond the bound");
    suite.check("VOT_017_third_nearby", influence_is_bounded(false), "beyond c a");
    suite.check("VOT_017_third_any_bits", influence_is_bounded(true), "beyond c a");
    suite.check("VOT_005_any_bits", any_bit_pattern_gives_a_plausible_output(),
                "an output that is not plausible");
    suite.check("VOT_018_same_as_the_whole_vote", unanimous_is_the_whole_vote(),
                "another result, or hardly ever taken");
    return suite.end();
}
