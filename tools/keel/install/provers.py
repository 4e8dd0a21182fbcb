# SPDX-License-Identifier: Apache-2.0
"""How the provers are started: for which target, with which flags and which configuration.

Verdicts depend on this file beside the tools' versions: a change of it makes them void
(tools/keel/prove/verdict_keys.py), while a change of how tools are found and installed does not.
"""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

MACHDEP_FILE = Path(__file__).resolve().with_name("machdep") / "keel_cortex_m7.ml"
MACHDEP = "keel_cortex_m7"

# The target, as the firmware is built for it. Proof, firmware and the check of the machdep must
# not disagree about it, so they all read it here.
TARGET_FLAGS = ("-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard")

# WP ends a prover by the clock. So it is told so many times the processor time that a prover has:
# no verdict depends on what else the machine does, unless a prover gets less than one part in so
# many of a processor. The script takes the provers' time limits from the words of why3.
CLOCK_PER_PROCESSOR = 20
# Of the processor, for a test for contradictions that has steps left: CVC4 spends most of its time
# between two of them where quantifiers are many. Seeded contradictions are found within 2 s there.
SMOKE_SECONDS = 10
# CVC4 1.8 has --cpu-time the wrong way round: with it the clock's time counts, and without it the
# processor's (measured beside endless programs; tests/tools/test_limits.py).
BY_PROCESSOR_TIME = f"""\
#!/bin/sh
# Starts a prover with a limit of its processor time: a part of the clock's that it is told.
# WP tells the steps of a test for contradictions alone, and no time.
case " $* " in
    *" --rlimit="*) set -- "--tlimit={SMOKE_SECONDS * 1000 * CLOCK_PER_PROCESSOR}" "$@" ;;
esac
before=
for word do
    shift
    case $before$word in
        --tlimit=*)
            limit=$((${{word#--tlimit=}} / {CLOCK_PER_PROCESSOR}))
            ulimit -S -t "$((limit / 1000 + 1))" # CVC4 looks at its own limit now and then.
            set -- "$@" "--tlimit=$limit" ;;
        -T:*)
            ulimit -S -t "$((${{word#-T:}} / {CLOCK_PER_PROCESSOR}))"
            set -- "$@" "$word" ;;
        -timelimit[0-9]*)
            set -- "$@" "$((word / {CLOCK_PER_PROCESSOR}))" ;;
        *)
            set -- "$@" "$word" ;;
    esac
    before=
    test "$word" != -timelimit || before=$word
done
"""
# All that provers, compilers and preprocessors see of the caller's environment: another variable,
# such as CPATH, might change what they read. PATH is the tools' own, then the caller's.
INHERITED = ("PATH", "HOME", "USER", "LOGNAME", "TMPDIR")

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
        *command("frama-c"),
        "-load-script",
        str(MACHDEP_FILE),
        "-machdep",
        MACHDEP,
        "-enums",
        "gcc-short-enums",
        "-no-frama-c-stdlib",
        "-cpp-frama-c-compliant",
        "-cpp-command",
        shlex.join(preprocess),
    ]


def goto_cc(command: Command) -> list[str]:
    """goto-cc for the target: sizes, alignments and headers are then the cross compiler's.

    Except that enumerations keep four bytes in CBMC, where the target has the shortest type.
    """
    compiler = command("arm-none-eabi-gcc")
    return [
        *command("goto-cc"),
        "--native-compiler",
        *compiler,
        *TARGET_FLAGS,
        "-std=c99",
        "-ffreestanding",
    ]


def header_folders(command: Command, answer: Answer) -> list[Path]:
    """The folders of the compiler's own headers, in which the preprocessor looks for <...>."""
    words = [*command("arm-none-eabi-gcc"), *TARGET_FLAGS, "-E", "-v", "-x", "c", os.devnull]
    said = answer(words)
    listed = re.search(r"^#include <\.\.\.> [^\n]*\n((?: [^\n]+\n)+)", said, re.MULTILINE)
    return [Path(line.strip()).resolve() for line in listed[1].splitlines()] if listed else []


def provers_known(configuration: str) -> dict[str, str]:
    """The provers that a configuration of why3 knows, with their versions."""
    entry = re.compile(r'^name = "(.+)"\n(?:.*\n)*?version = "(.+)"', re.MULTILINE)
    return dict(entry.findall(configuration))


def by_processor_time(program: str) -> str:
    """The script that starts a prover so that its processor time is limited, not the clock's."""
    return f'{BY_PROCESSOR_TIME}exec {shlex.quote(program)} "$@"\n'


def small_environment(tools: Mapping[str, str]) -> dict[str, str]:
    """The variables under which verdicts are had: few of the caller's, and those of the tools."""
    inherited = {name: os.environ[name] for name in INHERITED if name in os.environ}
    return {**inherited, **tools}
