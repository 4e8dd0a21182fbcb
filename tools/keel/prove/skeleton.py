# SPDX-License-Identifier: Apache-2.0
"""Writes what a unit lacks whose header has prototypes: harnesses, models, a file of unit tests.

A harness is whole but for what makes a state valid. A model, a body that is not there and a test
are left to be written: they do nothing, or fail.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from keel.audit.clauses import header_texts
from keel.c import source as csource
from keel.c.declarations import (
    Field,
    Macros,
    Parameter,
    Signature,
    Structures,
    macros,
    number,
    signatures,
    structures,
)
from keel.c.project import ProjectError, Unit
from keel.judge import wp_frames

# REUSE-IgnoreStart
HEAD = "/* SPDX-License-Identifier: Apache-2.0 */\n"
LINE = "// SPDX-License-Identifier: Apache-2.0\n"
# REUSE-IgnoreEnd
WIDTH = 100
# An array in a structure is compared place by place, up to so many.
PLACES = 16
SHORT = re.compile(r"^(u?)int(\d+)_t$")
FLOAT = "float"
FLOAT_SAME = """\
static bool float_same(float a, float b)
{
    return __CPROVER_equal(a, b);
}
"""


@dataclass(frozen=True)
class Skeleton:
    """What is known of a unit when its files are written."""

    unit: Unit
    functions: dict[str, Signature]
    # The start of each function's labels: that of its contract's first label, or made up.
    labels: dict[str, str]
    known: Structures
    sizes: Macros

    def is_structure(self, type_: str) -> bool:
        """Whether a type is a structure whose fields are known."""
        return type_ in self.known


def read_unit(unit: Unit, prefix: str) -> Skeleton:
    """Read a header; `prefix` begins the labels of functions whose contract has none."""
    text = csource.read(unit.header)
    static = {one.name for one in csource.functions(text) if one.static}
    functions = {name: one for name, one in signatures(text).items() if name not in static}
    if not functions:
        raise ProjectError(f"{unit.header.relative_to(unit.root)}: there is no prototype in it")
    contracts = dict(wp_frames.contracts(text))
    labels = {}
    for position, name in enumerate(functions, 1):
        own = re.search(r"\b([A-Z]{3,4}_\d{3})\w*\s*:", contracts.get(name, ""))
        labels[name] = own[1] if own else f"{prefix}_{position:03d}"
    headers = header_texts(unit.root)
    return Skeleton(unit, functions, labels, structures(headers), macros(headers))


def files(one: Skeleton) -> dict[str, str]:
    """The files, by their paths in the project."""
    unit = one.unit
    source = unit.source.relative_to(unit.root).as_posix()
    made = {
        f"specs/model/{unit.name}.h": model_header(one),
        f"specs/model/{unit.name}.c": bodies(one, f'#include "{unit.name}.h"', "model_"),
        f"proofs/{unit.name}/proof.h": proof_header(one),
        f"tests/unit/test_{unit.name}.c": unit_tests(one),
    }
    for name in one.functions:
        made[f"proofs/{unit.name}/{name}_harness.c"] = harness(one, name)
    if not unit.source.is_file():
        made[source] = bodies(one, f'#include "{unit.layer}/{unit.name}.h"', "")
    return made


def short(type_: str) -> str:
    """How a function that gives any value of a type calls it: u16 for uint16_t."""
    plain = SHORT.match(type_)
    if plain:
        return f"{'u' if plain[1] else 'i'}{plain[2]}"
    return type_.removesuffix("_t")


def prototype(name: str, signature: Signature) -> str:
    """A prototype, broken where a line is full."""
    given = [_declared(one.type, one.name) for one in signature.parameters] or ["void"]
    line = _declared(signature.result, f"{name}(")
    start = " " * len(line)
    for position, text in enumerate(given):
        last = line.rpartition("\n")[2]
        end = ")" if position == len(given) - 1 else ","
        space = " " if position else ""
        fits = len(last + space + text + end) < WIDTH
        line += f"{space}{text}{end}" if fits else f"\n{start}{text}{end}"
    return line


def _declared(type_: str, name: str) -> str:
    pointed = type_.removesuffix("*").rstrip()
    return f"{type_} {name}" if pointed == type_ else f"{pointed} *{name}"


def model_header(one: Skeleton) -> str:
    """The declarations of the models."""
    unit = one.unit
    guard = f"MODEL_{unit.name.upper()}_H"
    declared = "".join(
        f"{prototype(f'model_{name}', signature)};\n" for name, signature in one.functions.items()
    )
    about = f"What the functions of {unit.layer}/{unit.name}.h do, as plainly as possible."
    return (
        f"{HEAD}/* {about} */\n#ifndef {guard}\n#define {guard}\n\n"
        f'#include "{unit.layer}/{unit.name}.h"\n\n#include <stdbool.h>\n#include <stdint.h>\n\n'
        f"{declared}\n#endif\n"
    )


def bodies(one: Skeleton, include: str, prefix: str) -> str:
    """Functions that do nothing yet."""
    written = [f"{HEAD}{include}\n"]
    for name, signature in one.functions.items():
        told = "Say here what it does, as plainly as possible." if prefix else "To be written."
        lines = [f"    /* {told} */"]
        if one.is_structure(signature.result):
            lines += [f"    const {signature.result} nothing = {{0}};", "", "    return nothing;"]
        elif signature.result == "bool":
            lines.append("    return false;")
        elif signature.result != "void":
            lines.append("    return 0;")
        if not prefix:
            lines[1:1] = [f"    (void){given.name};" for given in signature.parameters]
        body = "\n".join(lines)
        written.append(f"{prototype(prefix + name, signature)}\n{{\n{body}\n}}\n")
    return "\n".join(written)


def _types(one: Skeleton) -> list[str]:
    """The types of which a harness draws or compares a value, each once."""
    every: list[str] = []
    for signature in one.functions.values():
        every += [given.base for given in signature.parameters]
        every += [signature.result] if one.is_structure(signature.result) else []
    found: list[str] = []

    def take(type_: str) -> None:
        inner = one.known.get(type_, ())
        for field in inner:
            if one.is_structure(field.type):
                take(field.type)
        if type_ not in found:
            found.append(type_)

    for type_ in every:
        take(type_)
    if any(field.type == "bool" for type_ in found for field in one.known.get(type_, ())):
        found.append("bool")
    return list(dict.fromkeys(found))


def proof_header(one: Skeleton) -> str:
    """What the harnesses share."""
    unit = one.unit
    types = _types(one)
    guard = f"{unit.name.upper()}_PROOF_H"
    about = f"What the harnesses of {unit.name} share: any state, and when two are the same."
    parts = [
        f"{HEAD}/* {about} */\n#ifndef {guard}\n#define {guard}\n\n"
        f'#include "../../specs/model/{unit.name}.h"\n',
        "".join(f"{type_} nondet_{short(type_)}(void);\n" for type_ in types),
    ]
    fields = [field for type_ in types for field in one.known.get(type_, ())]
    results = [signature.result for signature in one.functions.values()]
    if FLOAT in [*types, *results, *(field.type for field in fields)]:
        parts.append(FLOAT_SAME)
    parts += [
        text
        for type_ in types
        if one.is_structure(type_)
        for text in (_any(one, type_), _same(one, type_))
    ]
    return "\n".join([*parts, "#endif\n"])


def _any(one: Skeleton, type_: str) -> str:
    """The function that gives any value of a structure."""
    lines = [f"    {type_} any = nondet_{short(type_)}();", ""]
    for field in one.known[type_]:
        for way in _ways(one, type_, field):
            if field.type == "bool":
                lines.append(f"    any{way} = nondet_bool(); /* Its bits may be neither. */")
            elif one.is_structure(field.type):
                lines.append(f"    any{way} = any_{short(field.type)}();")
    lines += [
        "    /* What the contract requires of it: __CPROVER_assume(any.FIELD <= ...); */",
        "    return any;",
    ]
    body = "\n".join(lines)
    return f"static {type_} any_{short(type_)}(void)\n{{\n{body}\n}}\n"


def _ways(one: Skeleton, type_: str, field: Field) -> list[str]:
    """How a field is named, each place of an array by its number."""
    if not field.size:
        return [f".{field.name}"]
    size = number(field.size, one.sizes)
    if size is None or size > PLACES:
        raise ProjectError(
            f"{one.unit.header.relative_to(one.unit.root)}: {type_}.{field.name}: an array of"
            f" {field.size}: of more than {PLACES} places or of an unknown number, harnesses are"
            " written by hand"
        )
    return [f".{field.name}[{index}]" for index in range(size)]


def _same(one: Skeleton, type_: str) -> str:
    """The function that compares two structures in every field."""
    compared = []
    for field in one.known[type_]:
        for way in _ways(one, type_, field):
            left, right = f"a->{way[1:]}", f"b->{way[1:]}"
            if one.is_structure(field.type):
                compared.append(f"{short(field.type)}_same(&{left}, &{right})")
            else:
                compared.append(_equal(field.type, left, right))
    expression = " &&\n           ".join(compared)
    return (
        f"static bool {short(type_)}_same(const {type_} *a, const {type_} *b)\n"
        f"{{\n    return {expression};\n}}\n"
    )


def _equal(type_: str, left: str, right: str) -> str:
    return f"float_same({left}, {right})" if type_ == FLOAT else f"({left} == {right})"


def harness(one: Skeleton, name: str) -> str:
    """The harness of a function: it and its model from any state, and equal results and objects."""
    unit, signature, label = one.unit, one.functions[name], one.labels[name]
    drawn = [line for given in signature.parameters for line in _drawn(one, given)]
    call = ", ".join(_argument(given, "") for given in signature.parameters)
    model = ", ".join(_argument(given, "_expected") for given in signature.parameters)
    code, modelled = f"{name}({call})", f"model_{name}({model})"
    claims = []
    if signature.result == "void":
        middle = f"    {code};\n\n    {modelled};\n"
    else:
        drawn += [f"    {signature.result} result;"]
        drawn += [f"    {signature.result} result_expected;"]
        middle = f"    result = {code};\n\n    result_expected = {modelled};\n"
        claims.append(_claim(one, signature.result, "result", label))
    claims += [
        _claim(one, given.base, given.name, label)
        for given in signature.parameters
        if given.written
    ]
    source = unit.source.relative_to(unit.root).as_posix()
    lines = "".join(f"{line}\n" for line in drawn)
    return (
        f"{LINE}// sources: {source} specs/model/{unit.name}.c\n// covers: {name} model_{name}\n"
        f'#include "proof.h"\n\nvoid {name}_harness(void)\n{{\n{lines}\n{middle}'
        f"{''.join(claims)}}}\n"
    )


def _drawn(one: Skeleton, given: Parameter) -> Iterator[str]:
    """The objects that stand for a parameter: of what is written, one for the model, too."""
    if given.type.endswith("*") and not given.written and not one.is_structure(given.base):
        raise ProjectError(
            f"{one.unit.header.relative_to(one.unit.root)}: {given.name}: {given.type}: of how many"
            " elements? A harness of an array is written by hand"
        )
    start = "any" if one.is_structure(given.base) else "nondet"
    value = f"{start}_{short(given.base)}()"
    fixed = "" if given.written else "const "
    yield f"    {fixed}{given.base} {given.name} = {value};"
    if given.written:
        yield f"    {given.base} {given.name}_expected = {given.name};"


def _argument(given: Parameter, suffix: str) -> str:
    """What is handed in for a parameter."""
    name = f"{given.name}{suffix}" if given.written else given.name
    return f"&{name}" if given.type.endswith("*") else name


def _claim(one: Skeleton, type_: str, name: str, label: str) -> str:
    """The assertion that a result or an object is the model's."""
    if one.is_structure(type_):
        equal = f"{short(type_)}_same(&{name}, &{name}_expected)"
    else:
        equal = _equal(type_, name, f"{name}_expected")
        equal = equal if type_ == FLOAT else equal[1:-1]
    return (
        f"    __CPROVER_assert({equal},\n"
        f'                     "{label}_{name}: as the model says");\n'
    )


def unit_tests(one: Skeleton) -> str:
    """A test of each function, which fails until it is written."""
    unit = one.unit
    names = {name: f"{label}_{name}_does_what" for name, label in one.labels.items()}
    tests = "".join(
        f'static void {test}(void)\n{{\n    TEST_FAIL_MESSAGE("write what {name} shall do, with'
        f' values worked out by hand");\n}}\n\n'
        for name, test in names.items()
    )
    run = "".join(f"    RUN_TEST({test});\n" for test in names.values())
    return (
        f"{HEAD}/* Unit tests of {unit.layer}/{unit.name}.h. */\n"
        f'#include "{unit.layer}/{unit.name}.h"\n#include "unity.h"\n\n'
        "void setUp(void)\n{\n}\n\nvoid tearDown(void)\n{\n}\n\n"
        f"{tests}int main(void)\n{{\n    UNITY_BEGIN();\n{run}    return UNITY_END();\n}}\n"
    )
