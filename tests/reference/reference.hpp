/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file reference.hpp
 * @brief What the reference tests share: counting them, and telling how each went.
 *
 * A reference test compares the kernel, in single precision, with an independent computation in
 * double precision. Its tolerance is derived from the number of roundings and written beside it,
 * not found by trying.
 *
 * A program prints `PASS test` or `FAIL test: why` for each test and `N passed, N failed` at the
 * end, and exits with 0 exactly if none failed (tools/keel test reads this). A test has a name
 * without blanks and of its own, which begins with its requirement: FLT_007_decade_above.
 */
#ifndef KEEL_TESTS_REFERENCE_HPP
#define KEEL_TESTS_REFERENCE_HPP

#include <cmath>
#include <cstdio>
#include <string>

namespace reference {

/* Half the distance from 1 to the next number of single precision: the greatest relative error of
 * one rounding. */
constexpr double ROUNDING = 0x1p-24;

/** Counts tests and tells their verdicts. */
class Suite {
  public:
    /** One test that is right or wrong; why says what was wrong. */
    void check(const std::string &name, bool right, const std::string &why)
    {
        if (right) {
            passed_++;
            std::printf("PASS %s\n", name.c_str());
        } else {
            failed_++;
            std::printf("FAIL %s: %s\n", name.c_str(), why.c_str());
        }
    }

    /** One test that a value is near another. A value that is no number is near nothing. */
    void within(const std::string &name, double value, double expected, double tolerance)
    {
        const double error = std::fabs(value - expected);
        char why[160];

        (void)std::snprintf(why, sizeof why, "%.9g, expected %.9g: off by %.3g, allowed %.3g",
                            value, expected, error, tolerance);
        check(name, error <= tolerance, why);
    }

    /** The last line; what main returns. */
    int end() const
    {
        std::printf("%d passed, %d failed\n", passed_, failed_);
        return (failed_ == 0) ? 0 : 1;
    }

  private:
    int passed_ = 0;
    int failed_ = 0;
};

} // namespace reference

#endif
