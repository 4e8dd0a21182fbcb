#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compare the data model under which Keel is proved with the compiler that builds it.

    python3 tests/machdep/check_machdep.py              # one line; exit status 1 on a difference
    python3 tests/machdep/check_machdep.py --self-test  # every field altered must be noticed

Each fact is a constant expression of C. Frama-C folds it under keel_cortex_m7.ml,
arm-none-eabi-gcc compiles it to a word of data; the two numbers must agree. A theorem about
overflow under another `long`, or about a struct under another alignment, is a theorem about
another program.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from keel.install import MACHDEP_FILE, TARGET_FLAGS, Toolchain, ToolchainError

# What the facts are about. Every type gets its size, its alignment alone and inside a struct;
# every arithmetic type its sign; every name of a type the base type it stands for.
DECLARATIONS = """
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
typedef int (*function_t)(void);
typedef enum { U8_A, U8_B = 255 } enum_u8_t;
typedef enum { I8_A = -1, I8_B = 127 } enum_i8_t;
typedef enum { U16_A, U16_B = 256 } enum_u16_t;
typedef enum { I16_A = -1, I16_B = 128 } enum_i16_t;
typedef enum { U32_A, U32_B = 65536 } enum_u32_t;
typedef enum { I32_A = -1, I32_B = 32768 } enum_i32_t;
typedef struct { char a; short b; char c; } struct_short_t;
typedef struct { char a; double b; char c; } struct_double_t;
typedef struct { float a; int64_t b; bool c; } struct_mixed_t;
typedef struct { unsigned a : 3; unsigned b : 30; unsigned c : 1; } struct_bits_t;
typedef union { char a[5]; int b; } union_t;
struct aligned { char a; char b __attribute__((aligned)); };
int function(void);
"""

EXACT = [f"{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)]
LEAST = [f"{sign}int_least{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)]
FAST = [f"{sign}int_fast{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)]
NAMED = [*EXACT, *LEAST, *FAST, "intptr_t", "uintptr_t", "intmax_t", "uintmax_t"]
NAMED += ["size_t", "ptrdiff_t", "wchar_t"]
BASIC = ["char", "signed char", "unsigned char", "short", "int", "unsigned", "long"]
BASIC += ["unsigned long", "long long", "unsigned long long", "bool"]
ENUMS = [f"enum_{sign}{bits}_t" for sign in "ui" for bits in (8, 16, 32)]
FLOATS = ["float", "double", "long double"]
POINTERS = ["void *", "char *", "double *", "function_t"]
AGGREGATES = ["struct_short_t", "struct_double_t", "struct_mixed_t", "struct_bits_t", "union_t"]
INTEGERS = [
    "signed char",
    "unsigned char",
    "short",
    "unsigned short",
    "int",
    "unsigned int",
    "long",
    "unsigned long",
    "long long",
    "unsigned long long",
]
# Types of expressions: what the data model itself says, without any header.
IMPLICIT = {"sizeof": "sizeof(int)", "difference": "(char *)0 - (char *)0", "wide": "L'x'"}


@dataclass(frozen=True)
class Fact:
    """A constant expression, and what it says when a person reads it."""

    name: str
    expression: str


def facts() -> Iterator[Fact]:
    """Everything that must agree."""
    for kind in [*BASIC, *NAMED, *ENUMS, *FLOATS, *POINTERS, *AGGREGATES]:
        yield Fact(f"size of {kind}", f"sizeof({kind})")
        yield Fact(f"alignment of {kind}", f"__alignof__({kind})")
        yield Fact(f"offset of {kind} after a char", f"offsetof(struct {{ char a; {kind} b; }}, b)")
    for kind in [*BASIC, *NAMED, *ENUMS]:
        yield Fact(f"{kind} is unsigned", f"({kind})-1 > 0")
    for kind in NAMED:
        yield from base_types(kind, kind)
    for name, expression in IMPLICIT.items():
        yield from base_types(f"type of {name}", f"__typeof__({expression})")
    yield Fact("size of void", "sizeof(void)")
    yield Fact("size of a function", "sizeof(function)")
    yield Fact("alignment of a function", "__alignof__(function)")
    yield Fact("alignment of a string", '__alignof__("x")')
    yield Fact("alignment of attribute aligned", "offsetof(struct aligned, b)")
    yield Fact("-1 >> 1 is negative", "(-1 >> 1) < 0")
    yield Fact("unsigned char promotes to int", "(unsigned char)0 - 1 < 0")
    yield Fact("too large unsigned wraps to a negative long", "(long)0x80000000u < 0")


def base_types(name: str, kind: str) -> Iterator[Fact]:
    """Which basic type a type is: int and long have one size here, and still are two types."""
    for basic in INTEGERS:
        test = f"__builtin_types_compatible_p({kind}, {basic})"
        yield Fact(f"{name} is {basic}", test)


def program(all_facts: Sequence[Fact]) -> str:
    """One array of words, one word a fact."""
    rows = "".join(f"    (unsigned)({fact.expression}),\n" for fact in all_facts)
    return f"{DECLARATIONS}\nunsigned facts[] = {{\n{rows}}};\n"


def output_of(command: Sequence[str], environment: dict[str, str], what: str) -> str:
    """The output of a tool; its failure is ours, with its own words."""
    done = subprocess.run(
        list(command),
        env=environment,
        text=True,
        capture_output=True,
        stdin=subprocess.DEVNULL,
        check=False,
    )
    if done.returncode != 0:
        raise ToolchainError(f"{what} refuses the facts:\n{done.stdout}{done.stderr}".strip())
    return done.stdout


def words_of(assembly: str) -> list[int]:
    """The facts in what a compiler writes."""
    words = assembly.partition("\nfacts:")[2].partition("\n\t.size")[0]
    found = re.findall(r"^\s+\.(?:word|long)\s+(\d+)$", words, re.MULTILINE)
    return [int(value) for value in found]


def compiler_values(
    tools: Toolchain, source: Path, options: Sequence[str] = ("-std=gnu99",)
) -> list[int]:
    """The facts as the compiler sees them: the words of its assembly."""
    command = [*tools.command("arm-none-eabi-gcc"), *TARGET_FLAGS, *options, "-ffreestanding"]
    text = output_of([*command, "-S", str(source), "-o", "-"], dict(os.environ), "the compiler")
    return words_of(text)


def frama_c_values(
    tools: Toolchain, source: Path, machdep: Path, options: Sequence[str] = ()
) -> tuple[list[int], str]:
    """The facts as Frama-C folds them, and its description of the machine."""
    # Frama-C compiles a script beside its source, where two processes would collide.
    script = source.with_name(machdep.name)
    shutil.copyfile(machdep, script)
    command = [str(script) if word == str(MACHDEP_FILE) else word for word in tools.frama_c()]
    command += [f"-cpp-extra-args={' '.join(options)}"] if options else []
    environment = {**os.environ, **tools.environment()}
    text = output_of([*command, "-constfold", str(source), "-print"], environment, "frama-c")
    machine = output_of([*command, "-print-machdep"], environment, "frama-c")
    array = re.search(r"facts\[\d+\]\s*=\s*\{(.*?)\}", text, re.DOTALL)
    if not array:
        raise ToolchainError(f"frama-c prints no array of facts:\n{text[-500:]}")
    words = [word.strip() for word in array.group(1).split(",")]
    unfolded = [word for word in words if not re.fullmatch(r"\d+U?", word)]
    if unfolded:
        raise ToolchainError(f"frama-c leaves facts unfolded: {unfolded[:3]}")
    return [int(word.rstrip("U")) for word in words], machine


# What no constant expression of C tells: a macro of the compiler, its value, and the line of
# -print-machdep that must be there if, and only if, the macro has that value.
MACHINE = [
    ("__BYTE_ORDER__", "__ORDER_LITTLE_ENDIAN__", "machine is little endian"),
    ("__USER_LABEL_PREFIX__", "", "assembly names have no leading '_'"),
    ("__CHAR_UNSIGNED__", "1", "char is unsigned"),
]


def machine_differences(tools: Toolchain, machine: str) -> list[str]:
    """Byte order, label prefix and char, as the compiler's macros and Frama-C tell them."""
    command = [*tools.command("arm-none-eabi-gcc"), *TARGET_FLAGS]
    macros = output_of(
        [*command, "-E", "-dM", "-x", "c", "/dev/null"], dict(os.environ), "the compiler"
    )
    defined = dict(re.findall(r"^#define (\S+) ?(.*)$", macros, re.MULTILINE))
    return [
        f"{line!r}: the compiler defines {macro} as {defined.get(macro)!r}"
        for macro, value, line in MACHINE
        if (defined.get(macro) == value) != (line in machine)
    ]


def differences_of(tools: Toolchain, machdep: Path) -> tuple[int, list[str]]:
    """How many facts were compared, and which differ."""
    all_facts = list(facts())
    with tempfile.TemporaryDirectory(prefix="keel-machdep-") as folder:
        source = Path(folder) / "facts.c"
        source.write_text(program(all_facts))
        compiled = compiler_values(tools, source)
        folded, machine = frama_c_values(tools, source, machdep)
    if not len(all_facts) == len(compiled) == len(folded):
        counts = f"{len(all_facts)} facts, {len(compiled)} compiled, {len(folded)} folded"
        raise ToolchainError(f"the facts do not line up: {counts}")
    found = [
        f"{fact.name}: the compiler says {built}, Frama-C {proved}"
        for fact, built, proved in zip(all_facts, compiled, folded, strict=True)
        if built != proved
    ]
    return len(all_facts) + len(MACHINE), found + machine_differences(tools, machine)


# --- Does the check notice? ----------------------------------------------------------------------

# Fields without an effect on any C program that is compiled for the target.
UNCHECKED = {
    "version": "a description",
    "compiler": "which GNU extensions are parsed",
    "cpp_arch_flags": "flags for the preprocessor; it is given them anyway",
    "const_string_literals": "a warning of the parser",
    "has__builtin_va_list": "variadic functions, which the kernel does not have",
}


def altered(value: str) -> str:
    """Another value for a field of the machdep."""
    if value in {"true", "false"}:
        return "false" if value == "true" else "true"
    if value.startswith('"'):
        return '"long"' if value == '"int"' else '"unsigned long"'
    return str(int(value) * 2)


def mutants(text: str) -> Iterator[tuple[str, str]]:
    """The machdep with one field altered, for each field that matters."""
    for match in re.finditer(r"^    (\w+) = (\"[^\"]*\"|\w+)", text, re.MULTILINE):
        if match.group(1) not in UNCHECKED:
            start, end = match.span(2)
            yield match.group(1), text[:start] + altered(match.group(2)) + text[end:]


def noticed(tools: Toolchain, machdep: Path) -> bool:
    """True when the check fails with this machdep, or Frama-C refuses it."""
    try:
        return bool(differences_of(tools, machdep)[1])
    except ToolchainError:
        return True


def self_test(tools: Toolchain) -> int:
    """Alter each field in turn; one that nobody notices is an error."""
    survivors = []
    count = 0
    with tempfile.TemporaryDirectory(prefix="keel-machdep-") as folder:
        for name, text in mutants(MACHDEP_FILE.read_text()):
            mutant = Path(folder) / f"{name}.ml"
            mutant.write_text(text)
            count += 1
            if not noticed(tools, mutant):
                survivors.append(name)
    if survivors or count < 20:
        print(f"machdep self-test: {count} altered, not noticed: {survivors}", file=sys.stderr)
        return 1
    print(f"machdep self-test: {count} fields altered one by one, each noticed")
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(description="Compare Frama-C's machdep with the compiler.")
    parser.add_argument("--machdep", type=Path, default=MACHDEP_FILE, help="another file to check")
    parser.add_argument("--self-test", action="store_true", help="try the check itself")
    options = parser.parse_args(arguments)
    tools = Toolchain()
    try:
        if options.self_test:
            return self_test(tools)
        count, differences = differences_of(tools, options.machdep)
    except ToolchainError as error:
        print(f"machdep: {error}", file=sys.stderr)
        return 1
    if differences:
        print(f"machdep: {len(differences)} of {count} facts differ", file=sys.stderr)
        print("\n".join(f"  {line}" for line in differences), file=sys.stderr)
        return 1
    print(f"machdep: {count} facts agree with the compiler")
    return 0


if __name__ == "__main__":
    sys.exit(main())
