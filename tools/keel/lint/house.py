# SPDX-License-Identifier: Apache-2.0
"""The rules of the house, each with a text that breaks it in tests/tools/test_lint.py."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path, PurePosixPath

from keel.base.errors import ROOT
from keel.config import Mistake, Table, read_toml
from keel.lint.models import check_models
from keel.lint.prose import check_prose
from keel.lint.texts import Finding, Text
from keel.lint.unit_tables import check_unit_tables

LINE_LIMIT = 100
# In two parts, so that this file does not break the rules that it checks.
UNFINISHED = re.compile(r"\b(TO" + r"DO|FIX" + r"ME|XX" + r"X)\b")
MACHINE_PATH = re.compile(r"(?<![\w.}])/(root|work|home/\w+|Users/\w+)/")
REGISTRY = re.compile(
    r"\b(pypi|pythonhosted|crates|npmjs|rubygems|docker|ghcr|quay|debian|ubuntu|golang|maven|conda)"
    r"\.(org|io|com|net)\b",
    re.IGNORECASE,
)
PROVER = re.compile(r"\b(__FRAMAC__|__CPROVER\w*|__KLEE\w*)\b")


def check_lines(text: Text, pattern: re.Pattern[str], reason: str) -> Iterator[Finding]:
    for number, line in enumerate(text.lines, 1):
        if match := pattern.search(line):
            yield Finding(text.path, number, reason.format(match[0]))


def check_words(text: Text) -> Iterator[Finding]:
    """Nothing unfinished, nothing of one machine, no name of a registry's host."""
    yield from check_lines(text, UNFINISHED, "unfinished: {}")
    yield from check_lines(text, MACHINE_PATH, "a path of one machine: {}")
    yield from check_lines(text, REGISTRY, "the name of a registry's host: {}")


def check_length(text: Text) -> Iterator[Finding]:
    """At most 100 columns; clang-format leaves comments alone. Directives are one line each."""
    if text.path.endswith((".c", ".h", ".cpp", ".hpp", ".py")):
        for number, line in enumerate(text.lines, 1):
            if len(line) > LINE_LIMIT and not DIRECTIVE.match(line):
                yield Finding(text.path, number, f"{len(line)} columns, {LINE_LIMIT} at most")


DIRECTIVE = re.compile(r"// [a-z-]+: ")
UNPROVED = re.compile(r"\b(admit|axiom)\b")
ANNOTATION = re.compile(r"/\*@.*?\*/|//@[^\n]*", re.DOTALL)
ANNOTATION_COMMENT = re.compile(r"//[^\n]*")
PROVER_INPUT = re.compile(r"^proofs/.*\.(why|mlw|driver|ml|v|smt2)$")


def statements(text: Text) -> Iterator[tuple[int, str]]:
    """What a prover reads in a file, each piece with its line; comments are blank."""
    whole = "\n".join(text.lines)
    if PROVER_INPUT.match(text.path):
        yield 1, whole
    if text.is_kernel or (text.is_c and text.path.startswith("proofs/")):
        for match in ANNOTATION.finditer(whole):
            body = match[0][:3] + ANNOTATION_COMMENT.sub("", match[0][3:])
            yield whole.count("\n", 0, match.start()) + 1, body


def check_unproved(text: Text) -> Iterator[Finding]:
    """Nothing is taken for true: no admit, no axiom. Their names in prose are no matter."""
    for first, statement in statements(text):
        for match in UNPROVED.finditer(statement):
            line = first + statement.count("\n", 0, match.start())
            yield Finding(text.path, line, f"taken for true without a proof: {match[0]}")


def check_prover(text: Text) -> Iterator[Finding]:
    """What is proved is what is built: the kernel does not know that it is being proved."""
    if text.is_kernel:
        yield from check_lines(text, PROVER, "the kernel knows a prover: {}")


def check_guard(text: Text) -> Iterator[Finding]:
    """A header's guard is named after its path."""
    if not text.path.endswith(".h") or not text.path.startswith("include/"):
        return
    place = text.path.removeprefix("include/")
    guard = re.sub(r"\W", "_", place).upper()
    directives = [(n, line) for n, line in enumerate(text.lines, 1) if line.startswith("#")]
    wanted = [f"#ifndef {guard}", f"#define {guard}"]
    if [line for _, line in directives[:2]] != wanted or directives[-1][1] != "#endif":
        line = directives[0][0] if directives else 1
        yield Finding(text.path, line, f"the include guard is not {guard}")


ORDER = "specs/layers.toml"


class Order(Table):
    """The layers, and the units of the RTOS layer by their ranks, from the bottom to the top."""

    layers: list[str]
    rtos: list[list[str]]

    def rank(self, unit: str) -> int | None:
        """How high a unit of the RTOS layer stands."""
        return next((rank for rank, units in enumerate(self.rtos) if unit in units), None)


def misplaced(order: Order, root: Path = ROOT) -> Iterator[Mistake]:
    """Units without a header, and those that stand twice."""
    headers = {path.stem for path in root.glob("include/keel/**/rtos/*.h")}
    seen: set[str] = set()
    for rank, units in enumerate(order.rtos):
        for unit in units:
            if unit not in headers:
                yield ("rtos", rank), f"there is no header of {unit}"
            if unit in seen:
                yield ("rtos", rank), f"{unit} stands twice"
            seen.add(unit)


@cache
def read_order(path: Path = ROOT / ORDER) -> Order:
    """Read and check the file."""
    return read_toml(path, Order, misplaced)


INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')
# Contracts, and what no user calls. A source includes them, a header for users does not.
INTERNAL = "keel/internal/"
COMMON_HEADERS = frozenset({"keel/c_declarations.h", "keel/status.h"})
# For users alone: if the kernel included it, a new version would ask for new proofs.
VERSION_HEADER = "include/keel/version.h"
SYSTEM_HEADERS = frozenset({"float.h", "limits.h", "math.h", "stdbool.h", "stddef.h", "stdint.h"})


def unit_of(path: str) -> tuple[str, str]:
    """Layer and unit of a header or source, from its path."""
    parts = PurePosixPath(path).parts
    return (parts[-2] if len(parts) > 1 else ""), PurePosixPath(path).stem


def include_reason(path: str, quoted: bool, header: str) -> str:
    """Why a file of the kernel must not include a header; empty when it may."""
    if not quoted:
        return "" if header in SYSTEM_HEADERS else f"<{header}> is not freestanding"
    if header in COMMON_HEADERS:
        return ""
    if header.startswith(INTERNAL) and path.startswith("include/") and INTERNAL not in path:
        return f"{header} is not for users"
    layer, unit = unit_of(path)
    other_layer, other_unit = unit_of(header)
    order = read_order()
    layers = order.layers
    if not header.startswith("keel/") or layer not in layers or other_layer not in layers:
        return f"{header} belongs to no layer"
    if layers.index(other_layer) > layers.index(layer):
        return f"{layer} includes {other_layer}, which stands above it"
    own = unit == other_unit and (path.endswith(".c") or INTERNAL in path)
    if layer != "rtos" or own:
        return ""
    rank, other_rank = order.rank(unit), order.rank(other_unit)
    if rank is None or other_rank is None:
        return f"{unit} or {other_unit} has no place in the order of units ({ORDER})"
    if other_rank >= rank:
        return f"{unit} includes {other_unit}, which does not stand below it"
    return ""


def check_includes(text: Text) -> Iterator[Finding]:
    """Arrows point down only."""
    if text.is_kernel:
        for number, line in enumerate(text.lines, 1):
            match = INCLUDE.match(line)
            reason = include_reason(text.path, match[1] == '"', match[2]) if match else ""
            if reason:
                yield Finding(text.path, number, reason)


DECLARATION = re.compile(r"\bkeel_task_config_t\b(?!\s*\*)")
APART = re.compile(
    r"^static (const )?keel_task_config_t \w+[\[ ;]"  # An object of its own, or a table.
    r"|^(static )?keel_task_config_t \w+\("  # A function that gives one.
    r"|\(keel_task_config_t\)\{"  # A value, which is copied into one.
)


def check_declarations(text: Text) -> Iterator[Finding]:
    """Examples show what the kernel asks for: a declaration outlives its task's stay, and lies
    outside of the scheduler. As an object of a file it does; in a structure it may not."""
    if text.path.startswith("examples/") and text.is_c:
        for number, line in enumerate(text.lines, 1):
            if DECLARATION.search(line) and not APART.search(line):
                yield Finding(text.path, number, "the declaration of a task is no static object")


HOUSE_CHECKS: tuple[Callable[[Text], Iterator[Finding]], ...] = (
    check_words,
    check_length,
    check_unproved,
    check_prover,
    check_guard,
    check_includes,
    check_declarations,
)


def check_reached(texts: Sequence[Text]) -> Iterator[Finding]:
    """Every header is included by a source, directly or not: else Cppcheck does not see it."""
    kernel = {text.path: text for text in texts if text.is_kernel}
    todo = [path for path in kernel if path.endswith(".c")]
    seen = set(todo)
    while todo:
        matches = map(INCLUDE.match, kernel[todo.pop()].lines)
        headers = {f"include/{match[2]}" for match in matches if match}
        new = (headers & kernel.keys()) - seen
        seen |= new
        todo.extend(new)
    for path in sorted(kernel.keys() - seen - {VERSION_HEADER}):
        yield Finding(path, 1, "no source includes this header, so nothing checks it")


def check_house(texts: Sequence[Text]) -> Iterator[Finding]:
    for text in texts:
        for check in HOUSE_CHECKS:
            yield from check(text)
    yield from check_reached(texts)
    yield from check_models(texts, read_order().layers)
    yield from check_prose(texts)
    yield from check_unit_tables(texts)
