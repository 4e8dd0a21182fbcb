// SPDX-License-Identifier: Apache-2.0
// The low-pass against the analytic response of the same filter in double precision, and the sums
// that its documented bounds rest on.
#include "reference.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <string>
#include <vector>

extern "C" {
#include "keel/flight/filter.h"
}

namespace {

using reference::ROUNDING;
using reference::Suite;

const double PI = std::acos(-1.0);
const double ROOT = std::sqrt(2.0);

// The coefficients of filter.h, from the library's tangent in long double.
struct Exact {
    double g, a, b, c;
};

Exact exact(double ratio)
{
    const long double g = std::tan(acosl(-1.0L) * static_cast<long double>(ratio));
    const long double d = 1.0L + (std::sqrt(2.0L) * g) + (g * g);

    return {static_cast<double>(g), static_cast<double>((g * g) / d),
            static_cast<double>((std::sqrt(2.0L) * g) / d), static_cast<double>((2.0L / d) - 1.0L)};
}

// The analytic response: H(s) = 1 / (s^2 + sqrt(2) s + 1) at s = j tan(pi f) / g, which is what the
// bilinear transform makes of it. f and the cut-off are parts of the rate.
std::complex<double> response(double f, double g)
{
    const std::complex<double> s(0.0, std::tan(PI * f) / g);

    return 1.0 / ((s * s) + (ROOT * s) + 1.0);
}

// All the filter's coefficients, for cut-offs from 2^-20 of the rate to nearly half of it.
void coefficients(Suite &suite)
{
    double worst = 0.0;
    std::mt19937 random(1u);
    std::uniform_real_distribution<double> exponent(-20.0, -1.0);

    for (int i = 0; i < 200000; i++) {
        const double wanted = std::min(std::exp2(exponent(random)), 0.4999999);
        const float ratio = static_cast<float>((i % 2 == 0) ? wanted : 0.5 - (wanted / 2.0));
        keel_filter_t filter;

        if ((ratio < KEEL_FILTER_RATIO_MIN) || !(ratio < 0.5f) ||
            (keel_filter_init(&filter, 1.0f, ratio) != KEEL_OK)) {
            continue;
        }
        const Exact e = exact(static_cast<double>(ratio));
        worst = std::max({worst, std::fabs(static_cast<double>(filter.a) - e.a),
                          std::fabs(static_cast<double>(filter.b) - e.b),
                          std::fabs(static_cast<double>(filter.c) - e.c)});
    }
    suite.within("FLT_002_coefficients_everywhere", worst, 0.0, 0x1p-20);
}

// The energy of sine and cosine parts of the output at a frequency, found by least squares over
// whole periods after the filter has settled: the complex gain.
std::complex<double> measured(keel_filter_t filter, double f, int settle, int periods)
{
    const int samples = static_cast<int>(std::lround(static_cast<double>(periods) / f));
    Eigen::MatrixXd basis(samples, 2);
    Eigen::VectorXd output(samples);

    for (int n = -settle; n < samples; n++) {
        const double angle = 2.0 * PI * f * static_cast<double>(n);

        (void)keel_filter_step(&filter, static_cast<float>(std::cos(angle)));
        if (n >= 0) {
            basis(n, 0) = std::cos(angle);
            basis(n, 1) = -std::sin(angle);
            output(n) = static_cast<double>(filter.output);
        }
    }
    const Eigen::Vector2d fit = basis.colPivHouseholderQr().solve(output);

    return {fit(0), fit(1)};
}

// Rounding in the filter. Each state takes a handful of roundings of values of at most about
// (1 + g) a step: less than 8 ROUNDING (1 + g). What a step adds to the state fades with the
// impulse response of the state, whose l1 norm is below 4 (g + 1/g) (the poles lie within
// 1 - min(g, 1/g) / 2 or so of the circle). A rounded coefficient acts as such an addition, too; it
// is within 2^-20, which only makes a difference where it moves the poles: relative to g.
double tolerance(double g)
{
    return (8.0 + 4.0) * ROUNDING * (1.0 + g) * 4.0 * (g + (1.0 / g)) + 0x1p-20;
}

void frequency_response(Suite &suite)
{
    struct Case {
        const char *name;
        float rate_hz, cutoff_hz;
    };
    const Case cases[] = {{"1000_50", 1000.0f, 50.0f},
                          {"1000_100", 1000.0f, 100.0f},
                          {"8000_80", 8000.0f, 80.0f},
                          {"500_5", 500.0f, 5.0f},
                          {"1000_1", 1000.0f, 1.0f}};

    for (const Case &item : cases) {
        const double ratio = static_cast<double>(item.cutoff_hz) /
                             static_cast<double>(item.rate_hz);
        const double g = exact(ratio).g;
        const int settle = static_cast<int>(40.0 / g);
        keel_filter_t filter;

        suite.check(std::string("FLT_007_taken_") + item.name,
                    keel_filter_init(&filter, item.rate_hz, item.cutoff_hz) == KEEL_OK, "refused");
        for (const auto &[where, factor] :
             {std::pair<const char *, double>("at", 1.0), {"below", 0.1}, {"above", 10.0}}) {
            const double f = ratio * factor;
            const std::string name = std::string(where) + "_" + item.name;

            if (f >= 0.5) {
                continue; // There is no decade above the cut-off.
            }
            const std::complex<double> gain = measured(filter, f, settle, 20);
            const std::complex<double> wanted = response(f, g);

            suite.within(std::string("FLT_007_gain_") + name, std::abs(gain), std::abs(wanted),
                         tolerance(g));
            suite.within(std::string("FLT_007_phase_") + name, std::abs(gain - wanted), 0.0,
                         tolerance(g));
            std::printf("%-14s gain %.7f, analytic %.7f, apart %.1e, allowed %.1e\n", name.c_str(),
                        std::abs(gain), std::abs(wanted), std::abs(gain - wanted), tolerance(g));
        }
    }
}

// At the cut-off the analytic gain is 1/sqrt(2): that the oracle is the right one.
void oracle(Suite &suite)
{
    for (const double ratio : {0.001, 0.1, 0.25, 0.4}) {
        suite.within("FLT_007_oracle_" + std::to_string(ratio),
                     std::abs(response(ratio, exact(ratio).g)), 1.0 / ROOT, 1e-12);
    }
}

void constant(Suite &suite)
{
    for (const float cutoff_hz : {0.1f, 1.0f, 100.0f, 300.0f, 490.0f}) {
        const double g = exact(static_cast<double>(cutoff_hz) / 1000.0).g;
        keel_filter_t filter;

        (void)keel_filter_init(&filter, 1000.0f, cutoff_hz);
        for (int i = 0; i < static_cast<int>(60.0 * (g + (1.0 / g))); i++) {
            (void)keel_filter_step(&filter, 3.0f);
        }
        // A state stops moving when what is added rounds away: half a unit of its own, 3 ROUNDING,
        // at one of the couplings, which are about g.
        suite.within("FLT_007_constant_" + std::to_string(cutoff_hz),
                     static_cast<double>(filter.output), 3.0, 4.0 * 3.0 * ROUNDING * (g + 1.0 / g));
    }
}

// The l1 norms of the impulse responses of the states and of the output, in exact arithmetic: M
// times them is the most that inputs up to M can lead to.
void bounds(Suite &suite)
{
    double worst_state = 0.0;
    double worst_output = 0.0;
    double worst_low_output = 0.0;

    for (int i = 1; i < 500; i++) {
        const double ratio = static_cast<double>(i) / 1000.0;
        const Exact e = exact(ratio);
        Eigen::Matrix2d step;
        Eigen::Vector2d state;
        double norm1 = 0.0;
        double norm2 = 0.0;
        double output = e.a;

        // d = x - s2, h = b s1 + a d, y = s2 + h; s1 <- c s1 + b d, s2 <- y + h.
        step << e.c, -e.b, 2.0 * e.b, 1.0 - (2.0 * e.a);
        state << e.b, 2.0 * e.a;
        for (int n = 0; n < static_cast<int>(60.0 * (e.g + (1.0 / e.g))); n++) {
            norm1 += std::fabs(state(0));
            norm2 += std::fabs(state(1));
            output += std::fabs((e.b * state(0)) + ((1.0 - e.a) * state(1)));
            state = (step * state).eval();
        }
        worst_state = std::max(worst_state, std::hypot(norm1, norm2) / (1.0 + e.g));
        worst_output = std::max(worst_output, output);
        if (ratio <= 0.25) {
            worst_low_output = std::max(worst_low_output, output);
        }
    }
    std::printf("states %.4f (1 + g), output %.4f, up to a quarter of the rate %.4f\n", worst_state,
                worst_output, worst_low_output);
    suite.check("FLT_008_states", worst_state <= 1.4, "more than 1.4 M (1 + g)");
    suite.check("FLT_008_output", worst_output <= 2.5, "more than 2.5 M");
    suite.check("FLT_008_low_output", worst_low_output <= 1.3, "more than 1.3 M");
    // The limits hold (2 M (1 + g))^2 for the greatest g of their range: 1, and 1.07e7.
    suite.check("FLT_008_low_limit",
                4.0e6 * 4.0e6 <= static_cast<double>(KEEL_FILTER_LOW_ENERGY_LIMIT), "too low");
    suite.check("FLT_008_high_limit",
                std::pow(2.0e6 * 1.07e7, 2.0) <= static_cast<double>(KEEL_FILTER_HIGH_ENERGY_LIMIT),
                "too low");
}

// The filter itself: the inputs that drive its states farthest are never refused.
void worst_inputs(Suite &suite)
{
    int refused = 0;

    for (const float cutoff_hz : {1.0f, 20.0f, 100.0f, 250.0f, 400.0f, 499.0f}) {
        for (int period = 2; period < 400; period += 13) {
            keel_filter_t filter;

            (void)keel_filter_init(&filter, 1000.0f, cutoff_hz);
            for (int n = 0; n < 2000; n++) {
                const float input = ((n % period) < (period / 2)) ? 1.0e6f : -1.0e6f;

                refused += (keel_filter_step(&filter, input) == KEEL_OK) ? 0 : 1;
            }
        }
    }
    suite.check("FLT_008_never_refused", refused == 0, std::to_string(refused) + " refused");
}

} // namespace

int main()
{
    Suite suite;

    coefficients(suite);
    oracle(suite);
    frequency_response(suite);
    constant(suite);
    bounds(suite);
    worst_inputs(suite);
    return suite.end();
}
