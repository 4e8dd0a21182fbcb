// SPDX-License-Identifier: Apache-2.0
// The controller against eq. 4 in state space, in double precision: alone, with random inputs, and
// in a closed loop with a plant.
#include "reference.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

extern "C" {
#include "keel/flight/pid.h"
}

namespace {

using reference::ROUNDING;
using reference::Suite;

struct Case {
    const char *name;
    float kp, ki, kd, kff, rate_hz, cutoff_hz;
};

const Case CASES[] = {{"p", 2.0f, 0.0f, 0.0f, 0.0f, 500.0f, 40.0f},
                      {"pi", 2.0f, 5.0f, 0.0f, 0.0f, 500.0f, 40.0f},
                      {"pd", 2.0f, 0.0f, 0.02f, 0.0f, 500.0f, 40.0f},
                      {"pid", 2.0f, 5.0f, 0.02f, 0.0f, 500.0f, 40.0f},
                      {"pid_ff", 2.0f, 5.0f, 0.02f, 0.5f, 1000.0f, 80.0f}};

keel_pid_t made(const Case &item)
{
    const keel_pid_config_t config = {{item.kp, item.ki, item.kd, item.kff},
                                      item.rate_hz,
                                      item.cutoff_hz,
                                      -1.0e6f,
                                      1.0e6f,
                                      -1.0e6f,
                                      1.0e6f};
    keel_pid_t pid;

    (void)keel_pid_init(&pid, &config);
    return pid;
}

// Eq. 4 in state space. The low-pass is in controllable canonical form, from its transfer function
// H(z) = b0 (1 + z^-1)^2 / (1 + a1 z^-1 + a2 z^-2): not the kernel's realisation.
class Controller {
  public:
    explicit Controller(const Case &item)
        : kp_(static_cast<double>(item.kp)), ki_(static_cast<double>(item.ki)),
          kd_(static_cast<double>(item.kd)), kff_(static_cast<double>(item.kff)),
          rate_(static_cast<double>(item.rate_hz))
    {
        const double ratio = static_cast<double>(item.cutoff_hz) / rate_;
        const double root = std::sqrt(2.0);
        const double d = 1.0 + (root * g(ratio)) + (g(ratio) * g(ratio));
        const double b0 = (g(ratio) * g(ratio)) / d;
        const double a1 = (2.0 * ((g(ratio) * g(ratio)) - 1.0)) / d;
        const double a2 = (1.0 - (root * g(ratio)) + (g(ratio) * g(ratio))) / d;

        a_ << -a1, -a2, 1.0, 0.0;
        b_ << 1.0, 0.0;
        c_ << (2.0 - a1) * b0, (1.0 - a2) * b0;
        d_ = b0;
    }

    static double g(double ratio)
    {
        return std::tan(std::acos(-1.0) * ratio);
    }

    // A linear controller starts from rest; a real one from its first error.
    void start(double error)
    {
        state_ = (Eigen::Matrix2d::Identity() - a_).fullPivLu().solve(b_ * error);
        filtered_ = error;
    }

    double step(double r, double y)
    {
        const double error = r - y;
        const double filtered = c_.dot(state_) + (d_ * error);
        const double slope = (filtered - filtered_) * rate_;

        state_ = ((a_ * state_) + (b_ * error)).eval();
        filtered_ = filtered;
        integral_ += (ki_ / rate_) * error;
        most_integral = std::max(most_integral, std::fabs(integral_));
        most_slope = std::max(most_slope, std::fabs(slope));
        most_error = std::max(most_error, std::fabs(error));
        most_setpoint = std::max(most_setpoint, std::fabs(r));
        return (kp_ * error) + integral_ + (kd_ * slope) + (kff_ * r);
    }

    double most_integral = 0.0;
    double most_slope = 0.0;
    double most_error = 0.0;
    double most_setpoint = 0.0;

  private:
    double kp_, ki_, kd_, kff_, rate_;
    Eigen::Matrix2d a_;
    Eigen::Vector2d b_;
    Eigen::Vector2d c_;
    double d_ = 0.0;
    Eigen::Vector2d state_ = Eigen::Vector2d::Zero();
    double filtered_ = 0.0;
    double integral_ = 0.0;
};

// How far the kernel's output may be from the reference's, for the magnitudes that occurred.
// - Each term and partial sum is rounded, as are the inputs, their difference and the gains: 8
//   roundings of the sum of the magnitudes.
// - The filter's output is off by what test_filter.cpp derives; the derivative is of two of them.
// - The integral is rounded at each step, as are its increments (gain, product, difference).
double tolerance(const Case &item, const Controller &c, int steps)
{
    const double rate = static_cast<double>(item.rate_hz);
    const double g = Controller::g(static_cast<double>(item.cutoff_hz) / rate);
    const double kp = static_cast<double>(item.kp);
    const double kd = static_cast<double>(item.kd);
    const double sum = (kp * c.most_error) + (static_cast<double>(item.kff) * c.most_setpoint) +
                       (kd * c.most_slope) + c.most_integral;
    const double filter = c.most_error *
                          ((12.0 * ROUNDING * (1.0 + g) * 4.0 * (g + (1.0 / g))) + 0x1p-20);
    const double increment = (static_cast<double>(item.ki) / rate) * c.most_error;

    return (8.0 * ROUNDING * sum) + (2.0 * kd * rate * filter) +
           (static_cast<double>(steps) * ROUNDING * (c.most_integral + (4.0 * increment)));
}

void random_inputs(Suite &suite, const Case &item)
{
    constexpr int STEPS = 3000;
    keel_pid_t pid = made(item);
    Controller controller(item);
    std::mt19937 random(7u);
    std::uniform_real_distribution<float> any(-10.0f, 10.0f);
    double worst = 0.0;
    float r = 0.0f;

    for (int n = 0; n < STEPS; n++) {
        const float y = any(random);

        r = ((n % 50) == 0) ? any(random) : r;
        if (n == 0) {
            controller.start(static_cast<double>(r) - static_cast<double>(y));
        }
        const double wanted = controller.step(static_cast<double>(r), static_cast<double>(y));
        if (keel_pid_step(&pid, r, y) != KEEL_OK) {
            worst = INFINITY;
        }
        worst = std::max(worst, std::fabs(static_cast<double>(pid.output) - wanted));
    }
    std::printf("%-8s random inputs: apart %.1e, allowed %.1e\n", item.name, worst,
                tolerance(item, controller, STEPS));
    suite.within(std::string("PID_008_random_") + item.name, worst, 0.0,
                 tolerance(item, controller, STEPS));
}

// A body with inertia and drag behind an actuator with a lag: x = (rate of turn, moment).
class Plant {
  public:
    explicit Plant(double rate)
    {
        const double step = 1.0 / rate;
        Eigen::Matrix2d a;
        Eigen::Vector2d b;
        const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();

        a << -0.5, 10.0, 0.0, -25.0;
        b << 0.0, 25.0;
        const Eigen::Matrix2d inverse = (one - (a * (step / 2.0))).inverse();
        a_ = inverse * (one + (a * (step / 2.0)));
        b_ = inverse * b * step;
    }

    double measured() const
    {
        return x_(0);
    }

    void step(double u)
    {
        x_ = ((a_ * x_) + (b_ * u)).eval();
    }

  private:
    Eigen::Matrix2d a_;
    Eigen::Vector2d b_;
    Eigen::Vector2d x_ = Eigen::Vector2d::Zero();
};

// What a disturbance of 1 of the control action at each step can at most do to the measurement: the
// l1 norm of the closed loop's impulse response.
double loop_gain(const Case &item, int steps)
{
    Controller controller(item);
    Plant plant(static_cast<double>(item.rate_hz));
    double norm = 0.0;

    for (int n = 0; n < steps; n++) {
        const double u = controller.step(0.0, plant.measured());

        plant.step((n == 0) ? (u + 1.0) : u);
        norm += std::fabs(plant.measured());
    }
    return norm;
}

void closed_loop(Suite &suite, const Case &item)
{
    constexpr int STEPS = 2000;
    keel_pid_t pid = made(item);
    Controller controller(item);
    Plant with_kernel(static_cast<double>(item.rate_hz));
    Plant with_reference(static_cast<double>(item.rate_hz));
    double worst = 0.0;

    for (int n = 0; n < STEPS; n++) {
        const double r = (n < 10) ? 0.0 : 1.0; // From rest: both start with an error of 0.
        const double u = controller.step(r, with_reference.measured());

        (void)keel_pid_step(&pid, static_cast<float>(r),
                            static_cast<float>(with_kernel.measured()));
        with_kernel.step(static_cast<double>(pid.output));
        with_reference.step(u);
        worst = std::max(worst, std::fabs(with_kernel.measured() - with_reference.measured()));
    }
    const double allowed = tolerance(item, controller, STEPS) * loop_gain(item, STEPS);

    std::printf("%-8s step response: ends at %.6f, apart %.1e, allowed %.1e\n", item.name,
                with_reference.measured(), worst, allowed);
    suite.within(std::string("PID_008_loop_") + item.name, worst, 0.0, allowed);
    // The loop does what it is for: with an integral the measurement arrives.
    if (item.ki > 0.0f) {
        suite.within(std::string("PID_008_arrives_") + item.name, with_kernel.measured(), 1.0, 0.2);
    }
}

// In the midst of a response the gains change: the next output is that of the old gains, but for
// what the new integral gain adds, when the inputs stay.
void change_of_gains(Suite &suite)
{
    const Case &item = CASES[3];
    const keel_pid_gains_t gains = {7.0f, 1.0f, 0.0f, 3.0f};
    keel_pid_t pid = made(item);
    Controller controller(item);

    for (int n = 0; n < 400; n++) {
        (void)keel_pid_step(&pid, 2.0f, 1.5f);
        (void)controller.step(2.0, 1.5);
    }
    const double before = static_cast<double>(pid.output);

    suite.check("PID_005_taken", keel_pid_set_gains(&pid, &gains) == KEEL_OK, "refused");
    (void)keel_pid_step(&pid, 2.0f, 1.5f);
    // 1/500 * 1 * 0.5 is what is integrated; a dozen roundings of terms of up to 6.
    suite.within("PID_005_no_bump", static_cast<double>(pid.output), before + 0.001,
                 (12.0 * 6.0 * ROUNDING) + tolerance(item, controller, 1));
}

} // namespace

int main()
{
    Suite suite;

    for (const Case &item : CASES) {
        random_inputs(suite, item);
        closed_loop(suite, item);
    }
    change_of_gains(suite);
    return suite.end();
}
