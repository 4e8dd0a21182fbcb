/* SPDX-License-Identifier: Apache-2.0 */
/* The fault campaign and fig. 14: three inertial units on a moving trajectory, one of them (or two)
 * faulty. Writes JSON to the standard output; tools/keel campaign prints tables and plots of it. */
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

extern "C" {
#include "keel/middleware/virtual_imu.h"
}

namespace {

using Channels = Eigen::Matrix<double, 6, 1>;

constexpr int units = 3;
constexpr int rate_hz = 1000;
constexpr int samples = 12 * rate_hz;
constexpr double gravity = 9.81;
constexpr double agree[2] = {0.5, 0.1}; /* a of m/s^2 and of rad/s. */
constexpr double noise[2] = {0.05, 0.01};

double roll_at(double t)
{
    return 0.4 * std::sin(1.7 * t);
}

double pitch_at(double t)
{
    return 0.3 * std::sin(1.1 * t + 0.5);
}

/* What a perfect unit measures: gravity in the body's frame, and the body's rates. */
Channels truth(double t)
{
    const double roll = roll_at(t);
    const double pitch = pitch_at(t);
    const double roll_rate = 0.4 * 1.7 * std::cos(1.7 * t);
    const double pitch_rate = 0.3 * 1.1 * std::cos(1.1 * t + 0.5);
    Channels x;

    x << -gravity * std::sin(pitch), gravity * std::sin(roll) * std::cos(pitch),
        gravity * std::cos(roll) * std::cos(pitch), roll_rate, pitch_rate * std::cos(roll),
        -pitch_rate * std::sin(roll);
    return x;
}

keel_voter_config_t configuration(int kind, std::uint16_t density_limit)
{
    keel_voter_config_t config = {};

    config.agree = static_cast<float>(agree[kind]);
    config.cutoff = 3.0f;
    config.lowest = (kind == 0) ? -160.0f : -35.0f;
    config.highest = -config.lowest;
    config.max_age_us = 5000u;
    config.latch_count = 100u;
    config.stale_count = 100u;
    config.density_limit = density_limit;
    config.sensors = units;
    return config;
}

using Samples = std::array<keel_virtual_imu_sample_t, units>;

/* What a fault makes of a unit's sample; i counts the samples since it began. */
void spoil(keel_virtual_imu_sample_t &sample, const std::string &fault, int i,
           const keel_virtual_imu_sample_t &frozen, std::mt19937_64 &generator)
{
    std::normal_distribution<double> normal;

    for (unsigned k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        const double a = agree[k / 3u];
        float &value = sample.value[k];

        if (fault == "stuck") {
            value = frozen.value[k];
        } else if (fault == "bias 2a") {
            value += static_cast<float>(2.0 * a);
        } else if (fault == "bias 10a" || fault == "two equal 10a") {
            value += static_cast<float>(10.0 * a);
        } else if (fault == "drift a/s") {
            value += static_cast<float>(a * i / rate_hz);
        } else if (fault == "spike 50a") {
            value += (i % 100 == 0) ? static_cast<float>(50.0 * a) : 0.0f;
        } else if (fault == "49 of 50 bad") {
            value += (i % 50 != 0) ? static_cast<float>(10.0 * a) : 0.0f;
        } else if (fault == "noise burst") {
            value += (i < rate_hz / 2) ? static_cast<float>(20.0 * a * normal(generator)) : 0.0f;
        } else if (fault == "non-finite") {
            value = (i % 2 == 0) ? std::numeric_limits<float>::quiet_NaN()
                                 : std::numeric_limits<float>::infinity();
        } else if (fault == "silence") {
            sample.present = false;
        } else if (fault == "late") {
            sample.age_us = 20000u;
        }
    }
}

struct Angles {
    double roll = roll_at(0.0);
    double pitch = pitch_at(0.0);

    /* A complementary filter, one step of the attitude. */
    void step(const Channels &x)
    {
        const double yaw_part = std::sin(roll) * x[4] + std::cos(roll) * x[5];
        const double roll_rate = x[3] + std::tan(pitch) * yaw_part;
        const double pitch_rate = std::cos(roll) * x[4] - std::sin(roll) * x[5];
        const double by_roll = std::atan2(x[1], x[2]);
        const double by_pitch = std::atan2(-x[0], std::hypot(x[1], x[2]));

        roll = 0.995 * (roll + roll_rate / rate_hz) + 0.005 * by_roll;
        pitch = 0.995 * (pitch + pitch_rate / rate_hz) + 0.005 * by_pitch;
    }
};

struct Flight {
    double first_latch_s = -1.0; /* After the fault's start: of the first channel, of all. */
    double all_latched_s = -1.0;
    bool healthy_latched = false;
    double worst = 0.0; /* How far outputs left the hull of the healthy units, in a. */
    std::string trace;  /* Time and the errors of the angles, with and without the voter. */
};

Flight fly(const std::string &fault, int unit, double start_s, std::uint16_t density_limit,
           bool traced)
{
    const keel_virtual_imu_config_t config = {configuration(0, density_limit),
                                              configuration(1, density_limit)};
    const int start = static_cast<int>(start_s * rate_hz);
    const bool two = fault.rfind("two", 0) == 0;
    std::mt19937_64 generator(static_cast<std::uint64_t>(unit) * 1000u + start);
    std::normal_distribution<double> normal;
    keel_virtual_imu_t imu;
    Samples sample = {};
    keel_virtual_imu_sample_t frozen = {};
    Angles with;
    Angles without;
    Flight flight;

    (void)keel_virtual_imu_init(&imu, &config);
    for (int i = 0; i < samples; i++) {
        const double t = static_cast<double>(i) / rate_hz;
        const Channels x = truth(t);
        Channels voted;
        Channels plain = Channels::Zero();
        std::array<double, 6> low;
        std::array<double, 6> high;

        low.fill(1e9);
        high.fill(-1e9);
        for (int j = 0; j < units; j++) {
            const bool faulty = (j == unit) || (two && (j == (unit + 1) % units));

            sample[j].present = true;
            sample[j].age_us = 0u;
            for (int k = 0; k < 6; k++) {
                sample[j].value[k] = static_cast<float>(x[k] + noise[k / 3] * normal(generator));
            }
            if (faulty && (i == start)) {
                frozen = sample[j];
            }
            if (faulty && (i >= start)) {
                spoil(sample[j], fault, i - start, frozen, generator);
            }
            for (int k = 0; k < 6; k++) {
                plain[k] += static_cast<double>(sample[j].value[k]) / units;
                if (!faulty) {
                    low[k] = std::min<double>(low[k], sample[j].value[k]);
                    high[k] = std::max<double>(high[k], sample[j].value[k]);
                }
            }
        }
        keel_virtual_imu_step(&imu, sample.data(), 1000000u / rate_hz);
        for (int k = 0; k < 6; k++) {
            voted[k] = static_cast<double>(imu.channel[k].vote.output);
            if (i >= start) {
                const double excess = std::max(voted[k] - high[k], low[k] - voted[k]);

                flight.worst = std::max(flight.worst, excess / agree[k / 3]);
            }
        }
        for (int j = 0; j < units; j++) {
            const bool faulty = (j == unit) || (two && (j == (unit + 1) % units));

            flight.healthy_latched = flight.healthy_latched || (!faulty && (imu.latched[j] != 0u));
        }
        if ((flight.first_latch_s < 0.0) && (imu.latched[unit] != 0u)) {
            flight.first_latch_s = t - start_s;
        }
        if ((flight.all_latched_s < 0.0) && (imu.latched[unit] == KEEL_VIRTUAL_IMU_ALL)) {
            flight.all_latched_s = t - start_s;
        }
        with.step(voted);
        without.step(plain);
        if (traced && (i % 10 == 0)) {
            char line[160];

            std::snprintf(line, sizeof line, "%s[%.3f, %.6f, %.6f, %.6f, %.6f]",
                          flight.trace.empty() ? "" : ",\n    ", t, with.roll - roll_at(t),
                          with.pitch - pitch_at(t), without.roll - roll_at(t),
                          without.pitch - pitch_at(t));
            flight.trace += line;
        }
    }
    return flight;
}

} // namespace

int main()
{
    const std::vector<std::string> faults = {
        "stuck",       "bias 2a",    "bias 10a", "drift a/s", "spike 50a",    "49 of 50 bad",
        "noise burst", "non-finite", "silence",  "late",      "two equal 10a"};
    const char *separator = "";

    std::printf("{\"bound\": 0.5, \"flights\": [");
    for (const std::uint16_t density_limit : {0, 100}) {
        for (const std::string &fault : faults) {
            for (int unit = 0; unit < units; unit++) {
                for (const double start_s : {1.0, 2.7, 5.3, 8.0}) {
                    const Flight f = fly(fault, unit, start_s, density_limit, false);

                    std::printf("%s\n  {\"density_limit\": %u, \"fault\": \"%s\", \"unit\": %d, "
                                "\"start_s\": %.1f, "
                                "\"first_latch_s\": %.3f, \"all_latched_s\": %.3f, "
                                "\"healthy_latched\": %s, \"worst_a\": %.4f}",
                                separator, static_cast<unsigned>(density_limit), fault.c_str(),
                                unit + 1, start_s, f.first_latch_s, f.all_latched_s,
                                f.healthy_latched ? "true" : "false", f.worst);
                    separator = ",";
                }
            }
        }
    }
    const Flight f = fly("stuck", 2, 8.0, 0u, true);

    std::printf("],\n \"figure14\": {\"first_latch_s\": %.3f, \"all_latched_s\": %.3f, "
                "\"trace\": [\n    %s]}}\n",
                f.first_latch_s, f.all_latched_s, f.trace.c_str());
    return 0;
}
