# SPDX-License-Identifier: Apache-2.0
"""Refuses texts of C that readers, provers and the build's compiler may take for different things.

In all that is proved, and in the proofs: line splices outside of directives, directives that go on
into an empty line or behind a comment of several lines, trigraphs, digraphs, control characters,
directives behind a comment, pragmas, #line, and headers that only the preprocessor could name. In
what is built, besides: conditionals but for those below, and names that a compiler may have defined
by itself or that promise something only to it. In harnesses: every conditional, as what stands in
one may not be there.

Of what is built a conditional may

    guard a header:                         #ifndef KEEL_RTOS_QUEUE_H
    give a number that a build may choose:  #ifndef KEEL_QUEUE_CAPACITY, with nothing but #define
    refuse a number:                        #if KEEL_QUEUE_CAPACITY > 255u, with nothing but #error

and what proofs/units.toml lists under `conditionals`, with a reason. Shapes of code and macros that
only some of the tools would see through are refused here, too (shapes.py, macros.py), and what
comes out differently in another order of evaluation (order.py).
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence, Set
from dataclasses import dataclass, field
from pathlib import Path

from keel.audit import macros, order, shapes
from keel.audit.places import THEOREM
from keel.c import source as csource
from keel.c.project import KEEL

Finding = tuple[int, str]  # The line, and what is wrong there.
Rule = Callable[[str, Path], Iterable[Finding]]

WHITE = "\n\t"
TRIGRAPH = re.compile(r"\?\?[=/'()!<>-]")
DIGRAPH = re.compile(r"<:|:>|<%|%>|%:")
SPLICE = re.compile(r"\\[ \t]*$")
DIRECTIVE = re.compile(r"^[ \t]*#[ \t]*(\w*)[ \t]*(.*)$")
PLAIN = frozenset("include define error if ifdef ifndef else elif endif".split())
RESERVED = re.compile(r"\b(?:__\w+|_[A-Z]\w*|linux|unix|i386|asm)\b")
# A promise that only the compiler believes: provers take no note of it.
PROMISED = re.compile(r"\brestrict\b")
NUMBERS_ALONE = re.compile(
    r"(?:KEEL_\w+|[A-Z]+_[A-Z_]+|0[xX][0-9a-fA-F]+u?|\d+u?|[\s()<>=!&|+*-])*"
)
# A header for C++, of which neither the provers nor a compiler of C see anything else than nothing.
FOR_CPP = "include/keel/c_declarations.h"
FOR_CPP_TEXT = """\
#ifndef KEEL_C_DECLARATIONS_H
#define KEEL_C_DECLARATIONS_H
#ifdef __cplusplus
#define KEEL_C_BEGIN extern "C" {
#define KEEL_C_END   }
#else
#define KEEL_C_BEGIN
#define KEEL_C_END
#endif
#endif"""


@dataclass
class Conditional:
    """A conditional of the preprocessor and what stands in it."""

    line: int
    kind: str
    condition: str
    # The directives, each with its words, and whether there is anything else.
    directives: list[tuple[str, str]] = field(default_factory=list)
    code: bool = False


def everywhere(text: str) -> Iterator[Finding]:
    """What no text may have."""
    text = text.replace("\r\n", "\n")
    lines = text.split("\n")
    bare = csource.without_comments(text)
    starts = directives(lines)
    for number, line in enumerate(lines, 1):
        if hidden := [one for one in line if one not in WHITE and _is_control(one)]:
            yield number, f"the control character U+{ord(hidden[0]):04X}"
        if TRIGRAPH.search(line):
            yield number, "a trigraph"
        if SPLICE.search(line) and number not in starts:
            yield number, "a line that goes on outside of a directive"
        directive = DIRECTIVE.match(line) if starts.get(number) == number else None
        if directive and directive[1] not in PLAIN:
            yield number, f"#{directive[1]}"
    for number, line in enumerate(csource.TOKEN.sub(csource.blanked, text).split("\n"), 1):
        if "'" in line or '"' in line:
            yield number, "a quote without its end: a preprocessor may read on elsewhere"
    for number, line in enumerate(bare.split("\n"), 1):
        if DIGRAPH.search(line):
            yield number, "a digraph"
        if "##" in line:
            yield number, "##: what it pastes together is in no text"
        if "_Pragma" in line:
            yield number, "_Pragma"
        behind = DIRECTIVE.match(line) if number not in starts else None
        if behind:
            yield number, f"#{behind[1]} behind a comment"
        # Keys of verdicts have no comments and no empty lines, so neither may end a directive.
        if starts.get(number, number) != number and not line.strip():
            yield number, "a directive that goes on into an empty line"
    for comment in csource.TOKEN.finditer(text):
        if "\n" in (comment["comment"] or ""):
            first, last = (text.count("\n", 0, at) + 1 for at in comment.span())
            if first in starts and bare[comment.end() :].partition("\n")[0].strip():
                yield last, "code behind a comment that began in a directive"
    yield from shapes.in_annotations(text)
    yield from macros.everywhere(text)


def directives(lines: Sequence[str]) -> dict[int, int]:
    """The numbers of the lines that are of a directive, each with that of its first line."""
    starts: dict[int, int] = {}
    for number, line in enumerate(lines, 1):
        if number - 1 in starts and SPLICE.search(lines[number - 2]):
            starts[number] = starts[number - 1]
        elif DIRECTIVE.match(line):
            starts[number] = number
    return starts


def _is_control(one: str) -> bool:
    return unicodedata.category(one) in ("Cc", "Cf", "Zl", "Zp")


def conditionals(text: str) -> list[Conditional]:
    """The conditionals of a text, outer ones first; one that has branches has them all in it."""
    open_: list[Conditional] = []
    every: list[Conditional] = []
    number = 1
    for line in re.split(r"(?<!\\)\n", csource.without_comments(text)):
        start, number = number, number + line.count("\n") + 1
        line = line.replace("\\\n", " ")
        directive = DIRECTIVE.match(line)
        kind, words = (directive[1], " ".join(directive[2].split())) if directive else ("", "")
        if kind in ("if", "ifdef", "ifndef"):
            for one in open_:
                one.directives.append((kind, words))
            open_.append(Conditional(start, kind, words))
            every.append(open_[-1])
        elif kind == "endif" and open_:
            open_.pop()
        elif open_ and (kind or line.strip()):
            for one in open_:
                one.code = one.code or not kind
                if kind:
                    one.directives.append((kind, words))
    return every


def is_guard(one: Conditional, text: str) -> bool:
    """Whether a conditional is around the whole of a header, and names it."""
    code = csource.without_comments(text).strip()
    name = one.condition
    return (
        one.kind == "ifndef"
        and re.fullmatch(r"[A-Z][A-Z0-9_]*_H", name) is not None
        and re.match(rf"#ifndef {name}\s+#define {name}\s", code) is not None
        and code.endswith("#endif")
        and not any(kind in ("else", "elif") for kind, _ in one.directives)
    )


def chooses_no_code(one: Conditional) -> bool:
    """Whether a conditional gives a number that a build may choose, or refuses one."""
    kinds = {kind for kind, _ in one.directives}
    if one.code:
        return False
    if one.kind == "ifndef":
        names = {words.partition(" ")[0].partition("(")[0] for _, words in one.directives}
        return kinds == {"define"} and names == {one.condition}
    return one.kind == "if" and kinds == {"error"} and bool(NUMBERS_ALONE.fullmatch(one.condition))


def in_what_is_built(
    text: str, name: str, allowed: Collection[str], pointers: Set[str] = frozenset()
) -> Iterator[Finding]:
    """What must not be in a source or a header besides, as a compiler may see something else.

    `name` is its place in the project, `pointers` are names of pointers (shapes.pointers_in).
    """
    if name == FOR_CPP:
        if " ".join(csource.without_prose(text).split()) != " ".join(FOR_CPP_TEXT.split()):
            yield 1, "another text than audits know, which look no further into this header"
        return
    for one in conditionals(text):
        said = f"#{one.kind} {one.condition}"
        if not (is_guard(one, text) or chooses_no_code(one) or said in allowed):
            yield one.line, f"`{said}`: provers and compilers may see different code"
    for number, line in enumerate(csource.without_comments(text).split("\n"), 1):
        if match := RESERVED.search(line):
            yield number, f"`{match.group()}`, which a compiler may define by itself"
        if match := PROMISED.search(line):
            yield number, f"`{match.group()}`, a promise that no prover looks at"
        if "assert.h" in line and "include" in line:
            yield number, "<assert.h>, which a build may turn into nothing"
    yield from macros.in_what_is_built(text)
    yield from shapes.in_what_is_proved(text, pointers)
    yield from shapes.in_file(text, is_header=name.endswith(".h"))


def in_theorem(text: str, pointers: Set[str]) -> Iterator[Finding]:
    """What must not be in a theorem besides: WP proves it as it proves what is built."""
    yield from macros.in_what_is_built(text)
    yield from shapes.in_what_is_proved(text, pointers)


def in_harness(text: str) -> Iterator[Finding]:
    """What must not be in a harness besides: what stands in a conditional may not be there."""
    yield from ((one.line, f"`#{one.kind} {one.condition}`") for one in conditionals(text))


def problems(root: Path, allowed: Collection[str]) -> list[str]:
    """The disguises in a project; `allowed` are conditionals that a person has accepted."""
    pointers = shapes.pointers_in(
        csource.read(path)
        for folder in dict.fromkeys((root, KEEL))
        for path in (*folder.glob("include/**/*.h"), *root.glob("src/**/*.[ch]"))
    )

    def built_rule(text: str, path: Path) -> Iterable[Finding]:
        return in_what_is_built(text, path.relative_to(root).as_posix(), allowed, pointers)

    def proof_rule(text: str, path: Path) -> Iterable[Finding]:
        if THEOREM in text[:500]:
            return in_theorem(text, pointers)
        return in_harness(text) if path.name.endswith("_harness.c") else ()

    found = [
        *_of(root, ("include/**/*.h", "src/**/*.[ch]"), built_rule),
        *_of(root, ("specs/model/*.[ch]", "proofs/**/*.[ch]"), proof_rule),
        *macros.problems(root),
        *order.problems(root),
    ]
    built = (*root.glob("include/**/*.h"), *root.glob("src/**/*.[ch]")) if allowed else ()
    used = {
        f"#{one.kind} {one.condition}" for path in built for one in conditionals(csource.read(path))
    }
    stale = (
        f"units.toml: conditionals: `{text}` stands nowhere any more, remove it"
        for text in allowed
        if text not in used
    )
    return [*found, *stale]


def _of(root: Path, patterns: Iterable[str], more: Rule) -> Iterator[str]:
    for pattern in patterns:
        for path in sorted(root.glob(pattern)):
            text = csource.read(path)
            for line, what in (*everywhere(text), *more(text, path)):
                yield f"{path.relative_to(root)}:{line}: {what}"
