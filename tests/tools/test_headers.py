# SPDX-License-Identifier: Apache-2.0
"""Tests of the public headers: each alone, in C and in C++, for the host and the Cortex-M7."""

from __future__ import annotations

import re

from consumer import ROOT, ConsumerTest

from keel.install import TARGET_FLAGS

HEADERS = sorted(path.relative_to(ROOT / "include") for path in (ROOT / "include").rglob("*.h"))
WARNINGS = (
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wsign-conversion",
    "-Wshadow",
    "-Wundef",
    "-Werror",
)
HOST = {"c": ("gcc",), "c++": ("g++",)}
TARGET = {"c": ("arm-none-eabi-gcc", *TARGET_FLAGS), "c++": ("arm-none-eabi-g++", *TARGET_FLAGS)}
STANDARDS = {"c99": "c", "c17": "c", "c++11": "c++", "c++20": "c++"}
# A function that is declared, not defined: the line of its name is the first without a comment.
DECLARED = re.compile(r"^(?!static\b|typedef\b)[a-z]\w* [^;{}=]*?\b(keel_\w+)\([^;{}]*\);", re.M)


class HeaderTest(ConsumerTest):
    """No warning, and the names of C."""

    def compiled(self, compiler: tuple[str, ...], standard: str, text: str) -> None:
        """Compile a text into unit.o without a warning."""
        source = self.folder / "unit"
        source.write_text(text)
        language = STANDARDS[standard]
        flags = [f"-std={standard}", *WARNINGS, f"-I{ROOT}/include", "-x", language]
        self.good([*compiler, *flags, "-c", source, "-o", "unit.o"])

    def test_each_alone(self) -> None:
        for compilers in (HOST, TARGET):
            for standard, language in STANDARDS.items():
                for header in HEADERS:
                    with self.subTest(header=header, standard=standard):
                        text = f'#include "{header}"\nextern int more;\n'
                        self.compiled(compilers[language], standard, text)

    def test_functions_have_the_names_of_c(self) -> None:
        """What a C++ unit asks the linker for when it takes the address of every function."""
        number = 0
        for header in HEADERS:
            names = sorted(set(DECLARED.findall((ROOT / "include" / header).read_text())))
            users = "".join(f"auto use_{name} = &{name};\n" for name in names)
            self.compiled(HOST["c++"], "c++11", f'#include "{header}"\n{users}')
            asked = self.good(["nm", "--undefined-only", "--format=just-symbols", "unit.o"])
            self.assertEqual(sorted(asked.split()), names, header)
            number += len(names)
        self.assertGreater(number, 40)
