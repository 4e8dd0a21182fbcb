# SPDX-License-Identifier: Apache-2.0
"""What the files of proofs/ and specs/model/ may hold: nothing that makes a harness say less.

- A function nondet_... has no body: it gives anything.
- A macro is in capitals, does not begin with KEEL_ or an underscore but for the guard of a header,
  and bears no name that the code or the headers use: it cannot stand for a function or a type.
  Nothing is undefined again, and no other condition than a guard selects code, but for CONDITIONS.
- A harness defines no function of the code, and none that its sources define, too: which of the two
  is proved would be the linker's choice. Functions keel_... of proofs end in _harness, _stand_in,
  _may or _does. No source is included.
- A macro is a number or another expression that neither calls nor sets anything, and names nothing
  but constants and its own parameters, or it is one of MACROS: what reads a harness does not look
  into one.
- What is called has a body somewhere, is nondet_..., or is one of CBMC's that are listed here: a
  function that ends the program ends what is asserted after it, too. A model declares no function
  but in its header, and has a body for each. Of CBMC's variables, as that of the rounding, none is
  named.
- What is called by its name is no variable or parameter that bears the name of a function, and a
  variable in a block bears no name that is declared around it, but for the counter of a loop.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import lru_cache
from pathlib import Path

from keel.audit.harness_inputs import CONDITIONS, ENDINGS, taken
from keel.audit.harness_writes import declared
from keel.c import source as csource
from keel.c import syntax
from keel.c.project import Unit, closure, include_folders, shown
from keel.c.syntax import Node, written
from keel.judge.harness import read_harness

CAPITALS = re.compile(r"[A-Z][A-Z0-9_]*")
NONDET = re.compile(r"nondet_\w+")
CBMC = frozenset(f"__CPROVER_{name}" for name in "assert assume equal havoc_object r_ok".split())
UNKNOWN = re.compile(r"__CPROVER_uninterpreted_\w+")
# Functions of the language's library that have a body in CBMC.
LIBRARY = frozenset("memcpy memset memcmp isnan isinf isfinite signbit __builtin_inff".split())
# Functions of the code for which harnesses have others, which no harness shows to be like them.
# Each is a bound in proofs/determined.md.
OTHERS = {"proofs/signing/signing_write.h": ("keel_mavlink_write",)}
DIRECTIVE = re.compile(r"^[ \t]*#[ \t]*(?P<word>\w+)[ \t]*(?P<rest>[^\n]*)", re.MULTILINE)
# Macros that are more than an expression, and why.
MACROS = {
    # Asserts, at places that it draws itself, what a function could not under a harness's own ids.
    ("proofs/common/keel_proof.h", "ASSERT_QUEUE_VALID"),
    # Clauses of contracts, which stand in comments.
    ("proofs/scheduler/isolation.c", "SET_GIVEN"),
    ("proofs/scheduler/isolation.c", "SET_STAYS"),
    ("proofs/scheduler/isolation.c", "ASKED_ABOUT"),
}
# Words that narrow, or lead past an assertion, and have no place in a macro.
NARROWING = re.compile(
    r"__CPROVER_(?!assert\b)\w*|nondet_\w*|\b(?:return|for|break|continue|switch|case|default)\b"
)
# Words and signs that do more than give a value.
STATEMENT = re.compile(
    r"\b(?:if|else|while|do|typedef|static|extern|const|struct|enum|union)\b"
    r"|(?<![<>=!])=(?!=)|\+\+|--|;|##?"
)
# In a macro: strings, and numbers with their suffixes.
LITERAL = re.compile(
    r'"(?:[^"\\]|\\.)*"|\b0[xX][\w.]+(?:[pP][+-]\d+)?\w*|\b\d[\w.]*(?:[eE][+-]\d+)?\w*'
)
# Names in small letters that a macro may have: types, constants, and a constant of the compiler's.
PLAIN = re.compile(r"u?int(?:8|16|32|64)?(?:_t)?|float|double|bool|true|false|__builtin_inff")
# Functions that end a program, or an execution, wherever they are declared.
ENDS = frozenset(
    "exit _exit _Exit quick_exit abort raise longjmp __builtin_unreachable __builtin_trap".split()
)
# Other spellings of directives, and what a compiler knows besides C.
STRANGE = re.compile(r"%:|\?\?[=/]|\b(?:_Pragma|_Generic|asm|__asm\w*|goto|__attribute\w*)\b")
WORD = re.compile(r"\b[A-Za-z_]\w*")
# Words of C that are neither types nor functions, and what its headers define.
RESERVED = frozenset(
    "NULL true false bool INFINITY NAN FLT_MAX FLT_MIN FLT_EPSILON DBL_MAX SIZE_MAX".split()
)
LIMITS = re.compile(
    r"U?INT(?:8|16|32|64|MAX|PTR)?_(?:MAX|MIN|C)|U?(?:CHAR|SHRT|INT|LONG|LLONG)_MAX"
)


def problems(root: Path, units: Iterable[Unit]) -> list[str]:
    """What the proofs of a project hold that they must not."""
    files = [
        path
        for folder in ("proofs", "specs/model")
        for path in sorted((root / folder).rglob("*.[ch]"))
    ]
    code = _code(root)
    headers = [text for path, text in code.items() if path.suffix == ".h"]
    words = {word for text in headers for word in _words(text)}
    public = {
        function.name
        for text in code.values()
        for function in csource.defined(text)
        if not function.static or function.name.startswith("keel_")
    }
    found: list[str] = []
    for path in files:
        text = csource.read(path)
        place = shown(path, root)
        found += [f"{place}:{line}: {what}" for line, what in _directives(text, place, words)]
        others = OTHERS.get(place, ())
        found += [f"{place}:{line}: {what}" for line, what in _definitions(text, public, others)]
        found += [f"{place}:{line}: {what}" for line, what in _names(text)]
    found += _without_bodies(root, code)
    for unit in units:
        for path in unit.harnesses:
            found += [f"{shown(path, root)}: {what}" for what in _linked(root, unit, path, code)]
    return found


def _code(root: Path) -> dict[Path, str]:
    """The code and its headers, of the project and of Keel."""
    folders = include_folders(root)
    sources = [folder.parent / "src" for folder in folders]
    return {
        path: csource.read(path)
        for folder in (*folders, *sources)
        for path in sorted(folder.rglob("*.[ch]"))
    }


@lru_cache(maxsize=1024)
def _words(text: str) -> frozenset[str]:
    return frozenset(WORD.findall(csource.without_comments(text)))


def _directives(text: str, place: str, words: set[str]) -> Iterator[tuple[int, str]]:
    """What is wrong with the directives of a file."""
    # Of the same length, so that places stay what they are.
    bare = csource.without_comments(text).replace("\\\n", "  ")
    path = Path(place)
    guard = re.sub(r"\W", "_", path.name).upper()
    guards = (guard, f"MODEL_{guard}", f"{path.parent.name.upper()}_{guard}")
    for match in STRANGE.finditer(bare):
        yield text.count("\n", 0, match.start()) + 1, f"{match[0]} has no place in proofs"
    for match in DIRECTIVE.finditer(bare):
        line = text.count("\n", 0, match.start("word")) + 1
        word, rest = match["word"], match["rest"].strip()
        name = (WORD.match(rest) or [""])[0]
        own_guard = name in guards and path.suffix == ".h"
        if word == "define" and not own_guard:
            reason = _macro(name, words)
            if reason:
                yield line, f"the macro {name} {reason}"
            else:
                listed = (place, name) in MACROS
                yield from ((line, what) for what in _meaning(name, rest[len(name) :], listed))
        elif word in ("undef", "line", "pragma"):
            yield line, f"#{word} may make this another text than it seems"
        elif word in ("if", "elif") or (
            word in ("ifdef", "ifndef") and not own_guard and name not in CONDITIONS
        ):
            yield line, f"#{word} {rest}: what is left out is not looked at"
        elif word == "include" and re.search(r"\.c\b", text.splitlines()[line - 1]):
            yield line, "a source is included: what is proved is what is linked"


def _macro(name: str, words: set[str]) -> str:
    """Why a macro of proofs may not have this name, or ""."""
    if not CAPITALS.fullmatch(name):
        return "is not in capitals: it may stand for a function"
    if name.startswith("KEEL_"):
        return "begins with KEEL_: it may stand for one of the code's"
    if name in words or name in RESERVED or LIMITS.fullmatch(name):
        return "has a name that the code uses"
    return ""


def _meaning(name: str, rest: str, listed: bool) -> Iterator[str]:
    """Why a macro may not be what it is: what stands behind its name."""
    match = re.match(r"\((?P<own>[^()]*)\)", rest)
    own = set(WORD.findall(match["own"])) if match else set()
    plain = LITERAL.sub("0", rest[match.end() :] if match else rest)
    for found in NARROWING.finditer(plain):
        yield f"the macro {name} has {found[0]} in it, where no reader of a harness sees it"
    if listed:
        return
    for found in STATEMENT.finditer(plain):
        yield f"the macro {name} has {found[0]} in it: it does more than give a value"
    for word in WORD.findall(plain):
        small = not CAPITALS.fullmatch(word) and not PLAIN.fullmatch(word)
        if NARROWING.fullmatch(word):
            continue  # That is said above.
        if small and (word not in own or re.search(rf"\b{word}\s*\(", plain)):
            yield f"the macro {name} names {word}, which no reader of a harness sees there"
    if plain.count("(") != plain.count(")") or re.search(r"^[^({]*,", plain):
        yield f"the macro {name} is no whole expression"


def _definitions(text: str, public: set[str], others: Collection[str]) -> Iterator[tuple[int, str]]:
    """What is wrong with the functions that a file defines."""
    for function in csource.defined(text):
        if function.name in others:
            continue
        if NONDET.fullmatch(function.name):
            yield function.line, f"{function.name} has a body: it does not give anything"
        if function.name in public:
            yield function.line, f"{function.name} is a function of the code"
        elif function.name.startswith("keel_") and not function.name.endswith(ENDINGS):
            yield function.line, f"{function.name} bears a name of the code"
        if CBMC & {function.name} or UNKNOWN.fullmatch(function.name):
            yield function.line, f"{function.name} is CBMC's own"


def _names(text: str) -> Iterator[tuple[int, str]]:
    """What is wrong with the names in a file."""
    tree = syntax.parse(text)
    for node in syntax.found(tree, "identifier"):
        name = written(node)
        line = node.start_point.row + 1
        if name in ENDS:
            yield line, f"{name} ends what is asserted after it, too"
        elif name.startswith("__CPROVER_") and name not in CBMC and not UNKNOWN.fullmatch(name):
            yield line, f"{name} is CBMC's own, and may make this another proof than it seems"
    for function in syntax.found(tree, "function_definition"):
        yield from _shadows(function)


def _shadows(function: Node) -> Iterator[tuple[int, str]]:
    """The variables of a function that stand for one that is declared around, or for a function."""
    variables = [
        (declared(declarator), node)
        for node in syntax.found(function, "declaration", "parameter_declaration")
        if node.type == "declaration" or _is_own(node, function)
        for declarator in node.children_by_field_name("declarator")
    ]
    for node in syntax.found(function, "type_definition"):
        yield (
            node.start_point.row + 1,
            "a type is defined in a function: it may bear another's name",
        )
    called = {call.name for call in csource.calls(function, r"\w+")}
    for name, node in variables:
        line = node.start_point.row + 1
        if name in called:
            yield line, f"{name} is a variable that is called: it may bear a function's name"
        scope = node.parent
        counts = scope and scope.type == "for_statement"
        around = [
            other.parent
            for one, other in variables
            if one == name and other != node and other.parent != scope
        ]
        if scope and not counts and any(one and _holds(one, scope) for one in around):
            yield line, f"{name} is declared around, too: it stands for another thing here"


def _is_own(parameter: Node, function: Node) -> bool:
    """Whether a parameter is the function's, and not one of a type that is named in it."""
    declarator = parameter.parent.parent if parameter.parent else None
    while declarator and declarator.type.endswith("declarator") and declarator.parent:
        if declarator.parent == function:
            return True
        declarator = declarator.parent
    return False


def _holds(outer: Node, inner: Node) -> bool:
    """Whether one block is around another; that of parameters is around the whole body."""
    if outer.type == "parameter_list":
        return True
    return outer.start_byte <= inner.start_byte and inner.end_byte <= outer.end_byte


def _without_bodies(root: Path, code: Mapping[Path, str]) -> Iterator[str]:
    """What models declare or call that has no body."""
    texts = {path: csource.read(path) for path in sorted((root / "specs/model").rglob("*.[ch]"))}
    bodies = {one.name for text in texts.values() for one in csource.defined(text)}
    known = (
        bodies
        | CBMC
        | LIBRARY
        | {one.name for text in code.values() for one in csource.defined(text)}
    )
    for path, text in texts.items():
        place = shown(path, root)
        # A header declares for all models, a source for itself.
        here = bodies if path.suffix == ".h" else {one.name for one in csource.defined(text)}
        for function in csource.functions(text):
            if function.name not in here and not NONDET.fullmatch(function.name):
                yield f"{place}:{function.line}: {function.name} is declared here, without a body"
        for name in sorted(_called(text)):
            if name not in known and name not in _macros(text) and not NONDET.fullmatch(name):
                yield f"{place} calls {name}, which has no body: it may end the program"


def _linked(root: Path, unit: Unit, path: Path, code: Mapping[Path, str]) -> Iterator[str]:
    """What is wrong with a harness, with what it includes and links."""
    harness = read_harness(unit, path)
    chosen = {word.removeprefix("-D").partition("=")[0] for word in harness.defines}
    chosen |= set(re.findall(r"^#define (\w+)", csource.without_comments(csource.read(path)), re.M))
    texts = {one: taken(csource.read(one), chosen) for one in closure(root, [path])}
    own = {
        one: text for one, text in texts.items() if one.is_relative_to(root.resolve() / "proofs")
    }
    here = {one.name for text in own.values() for one in csource.defined(text)}
    linked: dict[str, Path] = {}
    for source in harness.sources:
        linked |= {
            one.name: source for one in csource.defined(csource.read(source)) if not one.static
        }
    for name in sorted(here & linked.keys()):
        yield f"{name} is defined by proofs, and by {shown(linked[name], root)}, which is linked"
    known = here | linked.keys() | CBMC | LIBRARY
    known |= {one.name for text in texts.values() for one in csource.defined(text)}
    known |= {one.name for text in code.values() for one in csource.functions(text)}
    models = {
        one.name
        for file, text in texts.items()
        if file not in own
        for one in csource.functions(text)
    }
    macros = {name for text in texts.values() for name in _macros(text)}
    for file, text in own.items():
        for name in sorted(_called(text)):
            good = name in known | models | macros or NONDET.fullmatch(name)
            if not good and not UNKNOWN.fullmatch(name):
                yield f"{shown(file, root)} calls {name}, which has no body: it may end the program"


def _macros(text: str) -> set[str]:
    return set(re.findall(r"^[ \t]*#[ \t]*define[ \t]+(\w+)\(", text, re.M))


@lru_cache(maxsize=1024)
def _called(text: str) -> frozenset[str]:
    """The functions that a text calls by name; no variable is called so (_shadows)."""
    tree = syntax.parse(text)
    names = set()
    for node in syntax.found(tree, "call_expression"):
        function = node.child_by_field_name("function")
        if function and function.type == "identifier":
            names.add(written(function))
    return frozenset(names)
