# SPDX-License-Identifier: Apache-2.0
"""How the provers are started: for which target, with which flags and which configuration.

Verdicts depend on this file beside the tools' versions: a change of it makes them void
(tools/proofs/session.py), while a change of how tools are found and installed does not.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable, Sequence
from pathlib import Path

MACHDEP_FILE = Path(__file__).resolve().parents[1] / "machdep" / "keel_cortex_m7.ml"
MACHDEP = "keel_cortex_m7"

# The target, as the firmware is built for it. Proof, firmware and the check of the machdep must
# not disagree about it, so they all read it here.
TARGET_FLAGS = ("-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard")

Command = Callable[[str], list[str]]
Answer = Callable[[Sequence[str]], str]


def frama_c(command: Command, answer: Answer, libc_specifications: bool) -> list[str]:
    """frama-c for the target: data model, preprocessor and headers of the flight computer.

    The headers are the compiler's own freestanding ones, so that int32_t is `long` and
    UINT32_MAX an unsigned long, as in the firmware. With `libc_specifications`, a header that
    a freestanding compiler does not have (math.h, string.h) comes from Frama-C, with contracts.
    """
    compiler = command("arm-none-eabi-gcc")
    preprocess = [*compiler, "-E", "-C", "-std=c99", "-ffreestanding", *TARGET_FLAGS]
    if libc_specifications:
        share = answer([*command("frama-c"), "-print-share-path"]).strip()
        own = answer([*compiler, "-print-file-name=include"]).strip()
        preprocess += ["-nostdinc", "-isystem", own, "-idirafter", f"{share}/libc"]
        preprocess += ["-D__FC_MACHDEP_X86_32"]
    return [
        *command("frama-c"), "-load-script", str(MACHDEP_FILE), "-machdep", MACHDEP,
        "-enums", "gcc-short-enums", "-no-frama-c-stdlib", "-cpp-frama-c-compliant",
        "-cpp-command", shlex.join(preprocess),
    ]  # fmt: skip


def goto_cc(command: Command) -> list[str]:
    """goto-cc for the target: sizes, alignments and headers are then the cross compiler's.

    Except that enumerations keep four bytes in CBMC, where the target has the shortest type.
    """
    compiler = command("arm-none-eabi-gcc")
    return [
        *command("goto-cc"), "--native-compiler", *compiler,
        *TARGET_FLAGS, "-std=c99", "-ffreestanding",
    ]  # fmt: skip


def provers_known(configuration: str) -> dict[str, str]:
    """The provers that a configuration of why3 knows, with their versions."""
    entry = re.compile(r'^name = "(.+)"\n(?:.*\n)*?version = "(.+)"', re.MULTILINE)
    return dict(entry.findall(configuration))
