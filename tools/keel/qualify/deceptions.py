# SPDX-License-Identifier: Apache-2.0
"""Seeded deceptions: texts that would be proved although they say something else, or assume it."""

from __future__ import annotations

from keel.qualify.seeds import Seed

ANNOTATED = """\
/*@ logic integer total(integer n) = (n <= 0) ? 0 : total(n - 1) + 2;
  @ predicate even(integer n) = n % 2 == 0;
  @ lemma none: total(0) == 0;
  @*/
/*@ ghost /@ assigns \\nothing; ensures \\result == 2; @/ static int two(void) { return 2; } */
/*@ requires x <= 100; assigns \\nothing; ensures \\result == x + 1; */
static int next(int x)
{
    //@ assert even(2);
    return x + 1;
}
/*@ requires x <= 99; assigns \\nothing; */
int last(int x)
{
    return next(x);
}
"""
# Old, new, and what is said of it.
ASSUMED = (
    (
        "admit instead of assert, by a macro",
        "//@ assert even(2);",
        "#define HOLDS admit\n    //@ HOLDS even(3);",
        "admit",
    ),
    ("admit in two lines", "//@ assert even(2);", "/*@ ad\\\nmit even(3); */", "admit"),
    ("an admitted precondition", "requires x <= 99", "admit requires x <= 9", "admit"),
    (
        "an admitted postcondition",
        "ensures \\result == x + 1",
        "admit ensures \\result == x",
        "admit",
    ),
    ("a lemma that is only checked", "lemma none", "check lemma none", "check"),
    (
        "an axiom",
        "  @ lemma none: total(0) == 0;",
        "  @ axiomatic A { axiom none: total(0) == 1; }",
        "axiomatic A",
    ),
    (
        "logic without a definition",
        "  @ lemma none: total(0) == 0;",
        "  @ axiomatic A { logic integer other(integer n); }",
        "other is declared, and not defined",
    ),
    (
        "a logic function that is its own successor",
        "total(n - 1) + 2",
        "total(n) + 2",
        "total is defined by itself",
    ),
    (
        "a logic function that goes up",
        "total(n - 1) + 2",
        "total(n + 1) + 2",
        "total is defined by itself",
    ),
    (
        "a logic function whose end is passed by",
        "(n <= 0)",
        "(n == 0)",
        "total is defined by itself",
    ),
    ("a predicate that is its own denial", "n % 2 == 0", "!even(n)", "even is defined by itself"),
    (
        "an inductive definition",
        "  @ lemma none: total(0) == 0;",
        "  @ inductive odd(integer n) { case one: odd(2); }",
        "inductive definition of odd",
    ),
    (
        "a function that need not end",
        "assigns \\nothing; */\nint last",
        "terminates \\false; assigns \\nothing; */\nint last",
        "need not terminate",
    ),
    (
        "a ghost function without a body",
        "static int two(void) { return 2; } */",
        "int two(void); */",
        "ghost function two has no body",
    ),
)

BUILT = """\
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KEEL_BOX_H
#define KEEL_BOX_H
#include <stdint.h>
#ifndef KEEL_BOX_SIZE
#define KEEL_BOX_SIZE 4u
#endif
#if KEEL_BOX_SIZE > 8u
#error "KEEL_BOX_SIZE: at most 8"
#endif
static inline uint32_t keel_box(uint32_t x)
{
    return x + KEEL_BOX_SIZE; /* A comment. */
}
#endif
"""
RETURN = "    return x + KEEL_BOX_SIZE;"
HIDDEN = (
    (
        "code for one compiler",
        RETURN,
        f"#ifdef __OPTIMIZE__\n    x++;\n#endif\n{RETURN}",
        "different code",
    ),
    (
        "code for one compiler, by a digraph",
        RETURN,
        f"%:ifdef __OPTIMIZE__\n    x++;\n%:endif\n{RETURN}",
        "digraph",
    ),
    (
        "code that a build may leave out",
        RETURN,
        f"#ifndef NDEBUG\n    x++;\n#endif\n{RETURN}",
        "different code",
    ),
    (
        "a size that chooses code",
        RETURN,
        f"#if KEEL_BOX_SIZE > 4u\n    x++;\n#endif\n{RETURN}",
        "different code",
    ),
    (
        "another branch of a guard",
        "}\n#endif",
        "}\n#else\nstatic int other;\n#endif",
        "different code",
    ),
    ("a number of the compiler's own", RETURN, "    return x + __OPTIMIZE__;", "__OPTIMIZE__"),
    (
        "a name of CBMC, pasted together",
        RETURN,
        f"#define P(a, b) a##b\n    P(__CPRO, VER_assume)(x < 3);\n{RETURN}",
        "pastes together",
    ),
    (
        "a check that is switched off, by _Pragma",
        RETURN,
        f'    _Pragma("CPROVER check disable \\"bounds\\"")\n{RETURN}',
        "_Pragma",
    ),
    ("a pragma", RETURN, f"#pragma GCC optimize 3\n{RETURN}", "#pragma"),
    ("another file's name and line", RETURN, f'#line 1 "other.c"\n{RETURN}', "#line"),
    (
        "code behind a comment that goes on",
        "/* A comment. */",
        "// A comment. \\\n    x++;",
        "goes on outside",
    ),
    (
        "a comment that goes on by a trigraph",
        "/* A comment. */",
        "// A comment. ??/\n    x++;",
        "trigraph",
    ),
    (
        "a directive that goes on into an empty line, which no key of a verdict has",
        "static inline",
        "#define KEEL_BOX_MORE 1u \\\n\nstatic inline",
        "goes on into an empty line",
    ),
    (
        "code that a comment takes into a directive",
        "static inline",
        "#define KEEL_BOX_MORE /* More\n*/ static\nstatic inline",
        "behind a comment that began in a directive",
    ),
    ("a text that is shown in another order", "A comment.", "A \u202e comment.", "U+202E"),
    ("assertions that a build may leave out", "<stdint.h>", "<assert.h>", "assert.h"),
    (
        "a pragma behind a comment",
        "static inline",
        '/* Fast. */ #pragma GCC optimize ("Ofast")\nstatic inline',
        "#pragma behind a comment",
    ),
    (
        "another file's name and line, behind a comment",
        "static inline",
        '/* Here it begins. */ #line 30 "a box.h"\nstatic inline',
        "#line behind a comment",
    ),
    (
        "a number that is defined in a body, for the bodies behind it, too",
        RETURN,
        f"#define KEEL_BOX_MORE 1u\n{RETURN}",
        "#define in the body of keel_box",
    ),
    (
        "an endless loop, by a macro",
        "static inline",
        "#define KEEL_BOX_WAIT(more) while (more)\nstatic inline",
        "stands for `while`",
    ),
    (
        "a lemma that nobody proves, by a macro",
        "static inline",
        "#define KEEL_BOX_SAID lemma\n/*@ KEEL_BOX_SAID none: 0 == 1; */\nstatic inline",
        "stands for `lemma`",
    ),
    (
        "a call of whatever a macro is given",
        "static inline",
        "#define KEEL_BOX_CALL(f, x) (f)(x)\nstatic inline",
        "calls f",
    ),
    (
        "a word that is another one",
        "static inline",
        "#define ensures requires\nstatic inline",
        "not in capitals",
    ),
    (
        "a number of the standard's headers that is another one",
        "static inline",
        "#define UINT32_MAX 7u\nstatic inline",
        "the standard's",
    ),
    (
        "a number that changes on its way",
        "static inline",
        "#define KEEL_BOX_MORE 1u\n#define KEEL_BOX_MORE 2u\nstatic inline",
        "defined a second time",
    ),
    ("a promise to the compiler alone", RETURN, f"    int *restrict p;\n{RETURN}", "restrict"),
    (
        "an object of two types",
        RETURN,
        f"    *(const unsigned *)&x += 1;\n{RETURN}",
        "cast to a pointer",
    ),
    (
        "a function that no audit finds",
        "static inline",
        "static int (one)(int x) { return x; }\nstatic inline",
        "a name in parentheses",
    ),
    (
        "a call that no audit follows",
        RETURN,
        f"    (keel_box)(x);\n{RETURN}",
        "a call that audits do not follow",
    ),
    (
        "an assertion with the name of a loop's goal",
        RETURN,
        f"    //@ assert loop_variant_decrease: \\true;\n{RETURN}",
        "a goal's own name",
    ),
    (
        "a goal's name, by a macro",
        "static inline",
        "#define KEEL_BOX_NAME loop_variant_decrease\nstatic inline",
        "a goal's own name",
    ),
    (
        "a header that only annotations include",
        "static inline",
        "/*@ ensures \\true;\n#include <box.txt>\n*/\nstatic inline",
        "a directive in an annotation",
    ),
    (
        "ghost code behind a remark",
        RETURN,
        f"    /*@ // More.\n    ghost x++; */\n{RETURN}",
        "does not begin its annotation",
    ),
    (
        "an address that is taken for a number",
        RETURN,
        f"    if ((((uintptr_t)(&x)) >> 24) == 32u) {{\n        x++;\n    }}\n{RETURN}",
        "an address as a number",
    ),
    (
        "a size that the target sees otherwise",
        RETURN,
        f"    x += sizeof(enum {{ NONE }});\n{RETURN}",
        "another one on the target",
    ),
    (
        "a function in place of which a build may call another",
        "static inline",
        "inline",
        "inline and not static",
    ),
    (
        "code that an apostrophe hides from audits",
        '#error "KEEL_BOX_SIZE: at most 8"',
        "#error don't choose more /* than 8",
        "a quote without its end",
    ),
    (
        "two members in one place",
        RETURN,
        f"    union {{\n        uint32_t a;\n        uint32_t b;\n    }} u;\n{RETURN}",
        "a union",
    ),
    (
        "a constant that another file may give a value",
        "static inline",
        "static const uint32_t keel_first;\nstatic inline",
        "in a header, and no constant with a value",
    ),
    (
        "a variable that files share",
        "static inline",
        "extern uint32_t keel_ticks;\nstatic inline",
        "a variable that files share",
    ),
    (
        "a function that a type declares",
        "static inline",
        "typedef uint32_t sum_t(uint32_t x);\nextern sum_t keel_sum;\nstatic inline",
        "a type of functions",
    ),
    (
        "a variable that is its own first value",
        RETURN,
        f"    uint32_t y = y;\n    x += y;\n{RETURN}",
        "y is read before it has a value",
    ),
    (
        "a macro that changes an object",
        "static inline",
        "#define BOX_NEXT (box->count++)\nstatic inline",
        "BOX_NEXT changes an object",
    ),
    (
        "code in the name of a linker's place",
        "static inline",
        "#define KEEL_REALTIME_ZERO + 1u\nstatic inline",
        "KEEL_REALTIME_ZERO is a linker's place",
    ),
    (
        "a cast behind a macro",
        "static inline",
        "#define BOX_AT(p) ((unsigned int *)(p))\nstatic inline",
        "hides `*)`",
    ),
    ("a line's end that only some tools see", "A comment.", "A \u2028 comment.", "U+2028"),
)

# Two states of a header of the user's, one behind the other.
STATES = "#define LIMIT 4\n-----\n#define LIMIT 4\n"

SEEDS = (
    *(
        Seed("frama-c", "assumptions", fault, ANNOTATED, old, new, what)
        for fault, old, new, what in ASSUMED
    ),
    *(
        Seed("arm-none-eabi-gcc", "disguises", fault, BUILT, old, new, what)
        for fault, old, new, what in HIDDEN
    ),
    Seed(
        "arm-none-eabi-gcc",
        "environment",
        "a header from a folder that CPATH names",
        "int x;\n",
        "int x;",
        "#include <stray.h>",
        "stray.h: No such file",
    ),
    Seed(
        "arm-none-eabi-gcc",
        "keys",
        "a header in <...> that changes behind a verdict",
        STATES,
        "-----\n#define LIMIT 4",
        "-----\n#define LIMIT 5",
        "another key",
    ),
)
