# SPDX-License-Identifier: Apache-2.0
"""Inputs of harnesses from CBMC: values that lead to each place, where no search would find them.

A frame with a right checksum, behind a beginning that is right as well, is one of 2^40. CBMC is
asked what to draw so that each block of the functions that a harness covers is reached, and all
assumptions hold. Its answer is only an input: it is executed as any other, and counts for nothing
unless that execution comes to its end on the unchanged code.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from keel.base.jobs import Runner
from keel.engines.cbmc import COVER, Cbmc, blocks_of
from keel.judge.harness import Harness, without_solver

DRAWS = 2048  # of an execution: what is drawn after so many values is not known of it
# A solver gives 0 for each bit that does not matter to it, and an input of zeros tells little. So
# it is asked for the difference from these numbers: of 16 bits, which as floats lie beside 0.
USUAL = tuple(n * 0x9E3779B1 >> 8 & 0xFFFF for n in range(1, DRAWS + 1))
SECONDS = 400  # of processor time for one harness
# One bit pattern of a slot's lowest byte: the value itself stands above it (mutant_run.c).
LITERAL = 0xFF
SLOT = (1 << 64) - 1
TABLE = "keel_run_seed"
INPUTS = (
    *COVER,
    "--show-test-suite",
    "--max-field-sensitivity-array-size",  # each value by itself, not as a part of an array
    str(DRAWS),
)


def program(header: Path, path: Path, name: str, functions: Sequence[str]) -> str:
    """A harness whose arbitrary values stand in one table, which is what CBMC tells."""
    inner = f"{name}_body"
    usual = ", ".join(f"{value}u" for value in USUAL)
    return "\n".join(
        [
            "#define KEEL_RUN_REPLAY",
            "#include <stdint.h>",
            f"typedef struct {{ uint64_t value[{DRAWS}]; }} {TABLE}_t;",
            f"static {TABLE}_t {TABLE};",
            f"static const uint16_t keel_run_usual[] = {{{usual}}};",
            f"#define KEEL_RUN_VALUE(place) ({TABLE}.value[place] ^ keel_run_usual[place])",
            f'#include "{header}"',
            f"#define {name} {inner}",
            f'#include "{path}"',
            f"#undef {name}",
            *functions,
            f"{TABLE}_t nondet_{TABLE}(void);",
            f"void {name}(void)",
            "{",
            f"{TABLE} = nondet_{TABLE}();",
            f'__CPROVER_input("{TABLE}", {TABLE});',
            f"{inner}();",
            "}",
            "",
        ]
    )


def inputs_in(output: str) -> list[bytes]:
    """The inputs in an answer of CBMC, as slots; none if it breaks off."""
    try:
        tests = [test for entry in json.loads(output) for test in entry.get("tests", [])]
    except ValueError:
        return []
    drawn = [values for test in tests if (values := _values(test))]
    return [b"".join(_slot(value) for value in (0, *values)) for values in drawn]


def _values(test: dict[str, Any]) -> list[int]:
    for one in test["inputs"]:
        if one["id"] == TABLE:
            elements = one["value"]["members"][0]["value"]["elements"]
            told = [int(element["value"]["binary"], 2) for element in elements]
            return [value ^ usual for value, usual in zip(told, USUAL, strict=True)]
    return []


def _slot(value: int) -> bytes:
    return ((value << 8 | LITERAL) & SLOT).to_bytes(8, "little")


@dataclass(frozen=True)
class Seeds:
    """CBMC, asked about the unchanged code."""

    command: Sequence[str]
    checker: Cbmc
    runner: Runner
    root: Path

    def of(self, harness: Harness, text: str) -> list[bytes]:
        """Inputs that reach what a harness covers; none where CBMC gives no answer in time."""
        place = self.root / "build" / "seeds" / f"{harness.name}.c"  # its name is the entry
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, encoding="utf-8")
        options = tuple(without_solver(list(harness.options)))
        alone = replace(harness, path=place, options=options, timeout=4.0 * SECONDS)
        binary, complaint = self.checker.build(alone, f"{harness.name}-seed")
        if complaint:
            return []
        command = [*self.command, str(binary), "--json-ui", *INPUTS, *options]
        listing = self.runner.run([*command, "--show-properties"], alone.timeout, merged=False)
        wanted = blocks_of(listing.output, {f"{harness.name}_body", *harness.covers})
        answer = self.runner.run([*command, *wanted], alone.timeout, merged=False)
        return inputs_in(answer.output)
