# SPDX-License-Identifier: Apache-2.0
"""Seeded faults: a text, what is replaced in it, and what the tool must then say.

The text as it stands must pass: a tool that refuses everything detects nothing.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Seed:
    """A fault for a tool."""

    tool: str  # As the lock file names it.
    trial: str  # How it is asked: a function of qualification.trials.
    fault: str  # In words.
    text: str
    old: str
    new: str
    detects: str  # A part of what the tool says of the fault, and not of the text without it.
    option: str = ""  # Of the trial.

    @property
    def name(self) -> str:
        """Unique."""
        return f"{self.tool}: {self.fault}"

    @property
    def faulty(self) -> str:
        """The text with the fault."""
        if self.text.count(self.old) != 1:
            raise ValueError(f"{self.name}: {self.old!r} does not stand once in the text")
        return self.text.replace(self.old, self.new)


CONTRACT = """\
/*@ requires 0 <= a <= 100 && 0 < b <= 100;
  @ assigns \\nothing;
  @ ensures \\result == a + (a * b) / b;
  @*/
int twice(int a, int b)
{
    return a + (a * b) / b;
}
"""
PROVERS = ("alt-ergo", "cvc4", "z3")
# What every quotient of integers fulfils, and a goal without any. The goal that is seeded is false,
# and yet Alt-Ergo 2.0.0 proves it, unless a filter keeps it from it (proofs/linear.py). `div` and
# `size` stand for what a program divides by, and for the size of a number.
QUOTIENTS = """\
logic size : int -> int
logic div : int, int -> int
axiom size_of_none : forall x:int. 0 <= x -> size(x) = x
axiom size_positive : forall x:int. 0 <= size(x)
axiom division : forall x, y:int. y <> 0 -> x = y * (x / y) + x % y
axiom bound : forall x, y:int. y <> 0 -> x % y < size(y)
axiom unique : forall x, y, q:int. 0 < y -> q * y <= x and x < q * y + y -> x / y = q
axiom below : forall x, y:int. 0 < x and x <= y -> (-x) / y = -1
axiom last : forall y:int. 1 < y -> (-1) % y = y - 1
axiom up : forall n, d:int [div(n, d)]. 0 <= n -> 0 < d -> div(n, d) = n / d
axiom down : forall n, d:int [div(n, d)]. n <= 0 -> 0 < d -> div(n, d) = -((-n) / d)
goal rest : forall x, r:int. 3 <= x -> x <= 512 -> r = x - 3 -> x = 3 + r
"""
LENGTH = """\
/*@ requires 3 <= size <= 512 && \\valid(bytes + (0 .. 1));
  @ assigns bytes[0 .. 1];
  @ ensures bytes[0] + 256 * bytes[1] == size - 3;
  @*/
void store(unsigned char *bytes, unsigned size)
{
    bytes[0] = (unsigned char)((size - 3u) % 256u);
    bytes[1] = (unsigned char)((size - 3u) / 256u);
}
"""
# Each branch can be taken.
NEAR = """\
/*@ requires \\is_finite(most) && 0 <= most && most < 8.0f && -1 <= most;
  @ assigns \\nothing;
  @*/
int near(float most)
{
    if (most < 1.0f) {
        return 1;
    }
    return 0;
}
"""
# What nothing proves: the promise of whatever a pointer leads to. More is done behind the call.
CALLED = """\
/*@ assigns \\nothing;
  @ ensures 0 <= \\result <= 9;
  @*/
int source(void);

/*@ requires from == source;
  @ assigns \\nothing;
  @*/
int take(int (*from)(void))
{
    int got;

    //@ calls source;
    got = from();
    if (got > 4) {
        return 1;
    }
    return 0;
}
"""
# A goal for each prover that Qed does not prove alone.
ARRAY = """\
/*@ requires \\valid(t + (0 .. 9)) && 0 <= k < 10;
  @ requires \\forall integer i; 0 <= i < 10 ==> t[i] > i;
  @ assigns t[k];
  @ ensures \\forall integer i; 0 <= i < 10 ==> t[i] > 0;
  @*/
void set(int *t, int k)
{
    t[k] = k + 1;
}
"""
HARNESS = """\
unsigned nondet_unsigned(void);
int nondet_int(void);

void harness(void)
{
    int t[4] = {0, 1, 2, 3};
    unsigned i = nondet_unsigned();
    int x = nondet_int();
    int sum = 0;

    __CPROVER_assume(i < 4u && x < 1000);
    x = x + 1;
    for (unsigned k = 0u; k < 4u; k++) {
        sum += t[k & 3u];
    }
    __CPROVER_assert(t[i] >= 0 && sum == 6, "expected");
}
"""
FLOATS = """\
float nondet_float(void);

void harness(void)
{
    float a = nondet_float();

    __CPROVER_assume(a >= 1.0f && a <= 2.0f);
    __CPROVER_assert((a + 16777216.0f) >= 16777216.0f, "rounded");
}
"""
BOUND = """\
d = 1 + e;
{ |e| <= 0x1p-24 -> |d - 1| <= 0x1p-24 }
"""
PLAIN = """\
int plain(int a);
int plain(int a)
{
    int b = a;

    if (b > 0) {
        b = 1;
    }
    return b;
}
"""
RECURSIVE = """\
int left(int a);
int deep(int a);

__attribute__((noinline)) int deep(int a)
{
    return a + 1;
}

__attribute__((noinline)) int left(int a)
{
    return deep(a) * 3;
}
"""
PROGRAM = """\
#include <limits.h>

int main(int argc, char **argv)
{
    int t[4] = {0, 1, 2, 3};
    int near = INT_MAX - 4;

    (void)argv;
    return ((near + argc + t[argc + 2]) > 0) ? 0 : 1;
}
"""
DECISION = """\
int main(int argc, char **argv)
{
    (void)argv;
    return argc - 1;
}
"""
UNITY = """\
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}
void test_sum(void)
{
    TEST_ASSERT_EQUAL(2, 1 + 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sum);
    return UNITY_END();
}
"""
ABSTRACT = """\
/*@ assigns p[0]; */
void set(int *p);
void set(int *p)
{
    p[0] = 1;
}

int main(void)
{
    int t[4] = {0, 1, 2, 3};

    set(t);
    return t[3];
}
"""

SEEDS = (
    *(
        Seed(prover, "wp", "a wrong body", ARRAY, "= k + 1", "= k", "set_ensures", prover)
        for prover in PROVERS
    ),
    Seed(
        "frama-c",
        "wp",
        "a wrong result",
        CONTRACT,
        "return a + (",
        "return 1 + a + (",
        "twice_ensures",
        "z3",
    ),
    Seed(
        "frama-c",
        "wp",
        "a division by zero",
        CONTRACT,
        "&& 0 < b",
        "&& 0 <= b",
        "division_by_zero",
        "z3",
    ),
    Seed(
        "frama-c", "wp", "an overflow", CONTRACT, "0 <= a <= 100", "0 <= a", "signed_overflow", "z3"
    ),
    Seed(
        "frama-c",
        "wp",
        "a write that is not assigned",
        ARRAY,
        "t[k] = k + 1",
        "t[k] = k + 1; t[0] = 1",
        "set_assigns",
        "alt-ergo",
    ),
    Seed(
        "cvc4",
        "smoke",
        "a contradiction among integers",
        CONTRACT,
        "0 <= a <= 100",
        "100 < a <= b - 1",
        "twice_wp_smoke_default_requires",
        "cvc4",
    ),
    Seed(
        "cvc4",
        "smoke",
        "a promise that nothing called through a pointer can keep",
        CALLED,
        "0 <= \\result",
        "9 < \\result",
        "take_wp_smoke_dead_code",
        "cvc4",
    ),
    Seed(
        "alt-ergo",
        "smoke",
        "a contradiction among floats",
        NEAR,
        "0 <= most",
        "most < -2.0f",
        "near_wp_smoke_default_requires",
        "alt-ergo",
    ),
    Seed(
        "alt-ergo",
        "smoke",
        "a branch of floats that is never taken",
        NEAR,
        "0 <= most",
        "most == 2.0f",
        "near_wp_smoke_dead_code",
        "alt-ergo",
    ),
    Seed(
        "alt-ergo",
        "alt-ergo",
        "any number for a remainder",
        QUOTIENTS,
        "r = x - 3 -> x = 3 + r",
        "x = 3 + 256 * div(x - 3, 256) + r",
        "I don't know",
    ),
    *(
        Seed(prover, "wp", "a wrong quotient", LENGTH, "/ 256u", "/ 257u", "store_ensures", prover)
        for prover in ("cvc4", "z3")
    ),
    Seed("frama-c", "eva", "an index out of bounds", ABSTRACT, "t[3]", "t[4]", "index_bound"),
    Seed(
        "frama-c",
        "eva",
        "a write outside of the contract",
        ABSTRACT,
        "p[0] = 1",
        "p[0] = 1; p[1] = 1",
        "assigns of set: Unknown",
    ),
    *(
        Seed("cbmc", "cbmc", fault, HARNESS, old, new, what)
        for fault, old, new, what in (
            ("an assertion that fails", "sum == 6", "sum == 7", "harness.assertion"),
            ("an index out of bounds", "i < 4u &&", "i <= 4u &&", "harness.array_bounds"),
            ("an overflow", "&& x < 1000", "", "harness.overflow"),
            ("a loop that is not unwound", "k < 4u", "k < 8u", "harness.unwind"),
        )
    ),
    Seed(
        "cbmc",
        "cbmc",
        "a sum that is rounded",
        FLOATS,
        ">= 16777216.0f",
        "- 16777216.0f == a",
        "harness.assertion",
    ),
    Seed(
        "cadical",
        "cbmc",
        "an assertion that fails",
        HARNESS,
        "sum == 6",
        "sum == 7",
        "harness.assertion",
        "cadical",
    ),
    Seed(
        "gappa",
        "gappa",
        "a bound that is too narrow",
        BOUND,
        "|d - 1| <= 0x1p-24",
        "|d - 1| <= 0x1p-25",
        "some properties were not satisfied",
    ),
    *(
        Seed("cppcheck", "cppcheck", fault, PLAIN, old, new, what)
        for fault, old, new, what in (
            (
                "rule 15.1: a goto",
                "    return b;",
                "    goto end;\nend:\n    return b;",
                "misra-c2012-15.1",
            ),
            (
                "rule 15.6: a body without braces",
                "{\n        b = 1;\n    }",
                "b = 1;",
                "misra-c2012-15.6",
            ),
            ("rule 9.1: a value that was not set", "int b = a;", "int b;", "uninitvar"),
        )
    ),
    Seed(
        "arm-none-eabi-gcc",
        "stack",
        "recursion",
        RECURSIVE,
        "return a + 1;",
        "return (a > 9) ? left(a) : 1;",
        "recursion: ",
    ),
    Seed(
        "arm-none-eabi-gcc",
        "stack",
        "a frame without a bound",
        RECURSIVE,
        "return a + 1;",
        "volatile int t[a]; t[0] = a; return t[0];",
        "has no bound",
    ),
    Seed(
        "gcc",
        "sanitizers",
        "an index out of bounds",
        PROGRAM,
        "argc + 2",
        "argc + 3",
        "out of bounds",
    ),
    Seed(
        "gcc",
        "sanitizers",
        "an overflow",
        PROGRAM,
        "INT_MAX - 4",
        "INT_MAX",
        "signed integer overflow",
    ),
    Seed(
        "clang-19",
        "coverage",
        "a branch that no test takes",
        DECISION,
        "argc - 1",
        "(argc > 1) ? 1 : 0",
        "line 4: not taken",
    ),
    Seed("qemu", "emulated", "a test that fails", UNITY, "(2, 1 + 1)", "(3, 1 + 1)", ":FAIL"),
)
