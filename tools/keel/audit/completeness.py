# SPDX-License-Identifier: Apache-2.0
"""What must hold of the proofs besides that they succeed: nothing left out, nothing assumed."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from keel.audit.clauses import CLAUSE
from keel.audit.places import THEOREM
from keel.c import source as csource
from keel.c.project import KEEL, Unit, closure
from keel.judge import wp_frames
from keel.judge.harness import read_harness

CONTRACTS = ("include/**/*.h", "src/**/*.[ch]", "proofs/**/*.c")
CLAUSE_OF = re.compile(r"\b(?:requires|ensures|assigns|behavior)\b")
POINTED_AT = re.compile(r"&\s*(\w+)")
# Functions of C99's library (ISO C99, 7.4 and 7.12 to 7.24) and of POSIX that compilers replace.
LIBRARY = re.compile(
    r"(?:a?cos|a?sin|a?tan|(?:a?cos|a?sin|a?tan)h|atan2|cbrt|ceil|copysign|erfc?|exp[2m1]*|fabs"
    r"|fdim|floor|fma|fmax|fmin|fmod|frexp|hypot|ilogb|ldexp|[lt]gamma|log(?:10|1p|2|b)?|modf|nan"
    r"|nearbyint|nextafter|nexttoward|pow|remainder|remquo|l{0,2}rint|l{0,2}round|scalbl?n|sqrt"
    r"|trunc|sincos|significand|drem|gamma|j[01n]|y[01n])[fl]?"
    r"|l{0,2}abs|imaxabs|l{0,2}div|abort|_?exit|_Exit|atexit|alloca|[cm]alloc|realloc|free|qsort"
    r"|bsearch|ffsl{0,2}|b(?:cmp|copy|zero)|r?index|mem(?:chr|cmp|p?cpy|move|set)"
    r"|st[pr]n?cpy|str(?:n?cat|r?chr|n?cmp|n?casecmp|c?spn|n?dup|len|pbrk|str|tok|tol+|toul+)"
    r"|strto[dfl]|is(?:alnum|alpha|ascii|blank|cntrl|digit|graph|lower|print|punct|space|upper)"
    r"|isxdigit|to(?:ascii|lower|upper)|v?[fs]?n?(?:printf|scanf)|f?put[cs]|putchar|fwrite"
)


def assumptions_in(files: Iterable[Path], root: Path) -> list[str]:
    """Annotations that take something for granted, and code that tells provers apart."""
    problems = []
    for path in dict.fromkeys(files):
        text = csource.read(path)
        for line, word in csource.forbidden(text):
            place = f"{path.relative_to(root)}:{line}"
            problems.append(
                f"{place}: `{word}` is assumed, not proved; state a lemma or a contract"
            )
        for line, word in csource.prover_code(text):
            problems.append(
                f"{path.relative_to(root)}:{line}: `{word}`: what is proved must be what is built"
            )
    return problems


def endless(files: Iterable[Path]) -> list[str]:
    """Functions, ghosts too, that lead back to themselves: each would rest on its own contract."""
    bodies: dict[str, str] = {}
    for path in dict.fromkeys(files):
        text = csource.with_ghosts(csource.read(path))
        bodies |= {one.name: csource.body_of(text, one.name) for one in csource.defined(text)}
    called = {
        name: {*(call.name for call in csource.calls(body, r"\w+")), *POINTED_AT.findall(body)}
        & bodies.keys()
        for name, body in bodies.items()
    }
    problems = []
    for name in called:
        reached: set[str] = set()
        waiting = [*called[name]]
        while waiting:
            other = waiting.pop()
            if other not in reached:
                reached.add(other)
                waiting += called[other]
        if name in reached:
            problems.append(f"the function {name} calls itself: what ends its argument?")
    return problems


def strays(root: Path, units: Iterable[Unit]) -> list[str]:
    """Code that belongs to no unit, and so is proved nowhere."""
    own = {path for unit in units for path in unit.own_files}
    return [
        f"{path.relative_to(root)}: it belongs to no unit, so nobody proves it"
        for path in sorted((root / "src").rglob("*.[ch]"))
        if path not in own
    ]


def defined_twice(root: Path) -> list[str]:
    """Functions of one name in two sources: the linker may take either, and one alone is proved."""
    first: dict[str, Path] = {}
    problems = []
    for folder in dict.fromkeys((KEEL, root.resolve())):
        for path in sorted((folder / "src").rglob("*.[ch]")):
            for function in csource.defined(csource.read(path)):
                if function.static:
                    continue
                other = first.setdefault(function.name, path)
                if other != path:
                    place = f"{path.relative_to(folder)}:{function.line}"
                    problems.append(f"{place}: {function.name} is defined in {other.name}, too")
    return problems


def undeclared(root: Path) -> list[str]:
    """Functions that other files may call and no header declares: nothing compares them."""
    folders = [folder / "include" for folder in dict.fromkeys((root.resolve(), KEEL))]
    declared = {
        function.name
        for folder in folders
        for path in folder.rglob("*.h")
        for function in csource.functions(csource.read(path))
    }
    problems = []
    for path in sorted((root / "src").rglob("*.c")):
        for one in csource.defined(csource.read(path)):
            place = f"{path.relative_to(root)}:{one.line}: {one.name}"
            if not one.static and LIBRARY.fullmatch(one.name):
                problems.append(f"{place} is the C library's: a compiler knows what that one does")
            elif not one.static and one.name not in declared:
                problems.append(f"{place} is not static, and no header declares it")
    return problems


def contracts_elsewhere(root: Path) -> list[str]:
    """Second contracts of public functions: callers that read those would rest on them."""
    folders = dict.fromkeys((KEEL, root.resolve()))
    public = {
        function.name
        for folder in folders
        for path in sorted((folder / "src").rglob("*.c"))
        for function in csource.defined(csource.read(path))
        if not function.static
    }
    first: dict[str, Path] = {}
    problems = []
    for folder in folders:
        for path in (path for tree in CONTRACTS for path in sorted(folder.glob(tree))):
            text = csource.read(path)
            if path.is_relative_to(folder / "proofs") and THEOREM not in text[:500]:
                continue
            names = {name for name, said in wp_frames.contracts(text) if CLAUSE_OF.search(said)}
            for name in sorted(names & public):
                if first.setdefault(name, path) != path:
                    place = path.relative_to(folder)
                    problems.append(f"{place}: a second contract of {name}, see {first[name]}")
    return problems


def include_circles(root: Path) -> list[str]:
    """Headers that include each other: each one's lemmas could be proved from the other's."""
    included: dict[Path, list[Path]] = {}
    headers = sorted((root.resolve() / "include").rglob("*.h"))
    closure(root, headers, included)
    return [
        f"{path.relative_to(root.resolve())}: it includes itself, by way of other headers"
        for path in headers
        if path in closure(root, included[path], included)
    ]


def switched_off_checks(files: Iterable[Path], root: Path) -> list[str]:
    """Places where a harness tells CBMC not to look."""
    problems = []
    for path in dict.fromkeys(files):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if "CPROVER" in line and "pragma" in line:
                problems.append(f"{path.relative_to(root)}:{number}: switches a check off")
    return problems


def without_contract(unit: Unit, root: Path) -> list[str]:
    """Functions of a unit's headers whose contract nobody has written: nothing can be proved."""
    texts = {path: csource.read(path) for path in unit.headers}
    stated = {
        name
        for text in texts.values()
        for name, annotations in wp_frames.contracts(text)
        if CLAUSE.search(annotations)
    }
    return [
        f"{path.relative_to(root)}:{function.line}: {function.name} has no contract: write"
        " /*@ requires ...; assigns ...; ensures ...; */ before it"
        for path, text in texts.items()
        for function in csource.functions(text)
        if function.name not in stated
    ]


def unread_contracts(unit: Unit, root: Path) -> list[str]:
    """Headers with contracts that a unit's source does not include: nothing would be proved."""
    source = unit.source if unit.source.is_file() else unit.header
    seen = closure(root, [source])
    return [
        f"{source.relative_to(root)}: it does not include {path.relative_to(root)}, whose contracts"
        " would hold of nothing"
        for path in unit.headers
        if path.resolve() not in seen
    ]


def undefined_functions(unit: Unit, excepted: Mapping[str, str], root: Path) -> list[str]:
    """Functions whose contract is stated but whose body nobody proves."""
    own = [(path, csource.read(path)) for path in unit.own_files]
    bodies = {function.name for _, text in own for function in csource.defined(text)}
    problems = []
    for path, text in own:
        for function in csource.functions(text):
            if function.name not in bodies and function.name not in excepted:
                place = f"{path.relative_to(root)}:{function.line}"
                problems.append(
                    f"{place}: {function.name} has a contract and no body to prove it by"
                )
    return problems + _stale(unit, "no_body", excepted, bodies)


def missing_harnesses(unit: Unit, excepted: Mapping[str, str], root: Path) -> list[str]:
    """Functions of a unit's headers that no harness proves."""
    proved = {read_harness(unit, path).function for path in unit.harnesses}
    texts = [csource.read(path) for path in unit.headers]
    names = dict.fromkeys(one.name for text in texts for one in csource.functions(text))
    problems = []
    for name in names:
        if name not in proved and name not in excepted:
            wanted = unit.folder / f"{name}_harness.c"
            problems.append(f"{name} has no harness: write {wanted.relative_to(root)}")
    for name in sorted(proved - names.keys()):
        problems.append(
            f"{unit.folder.relative_to(root)}: {name}, which a harness proves, is in no header"
        )
    return problems + _stale(unit, "no_harness", excepted, proved)


def left_by_wp(unit: Unit, excepted: Mapping[str, str], root: Path) -> list[str]:
    """Functions that WP leaves to CBMC, and that no harness reaches."""
    names = {
        function.name
        for path in (*unit.own_files, *unit.theorems)
        for function in csource.defined(csource.read(path))
    }
    covered = {name for path in unit.harnesses for name in read_harness(unit, path).covers}
    problems = []
    for name in excepted:
        if name not in names:
            problems.append(f"units.toml: [{unit.name}] not_by_wp: there is no function {name}")
        elif name not in covered:
            place = unit.folder.relative_to(root)
            problems.append(f"{name} is proved by neither engine: no harness in {place} covers it")
    return problems


def left_twice(unit: Unit, entries: Iterable[str]) -> list[str]:
    """Labels that WP leaves in a function, where they stand for more than the one clause.

    WP leaves every goal of a label. `entries` are those of by_cbmc: function, clause and harness.
    """
    said: dict[str, list[str]] = {}
    for path in unit.own_files:
        text = csource.read(path)
        for name, contract in wp_frames.contracts(text):
            said.setdefault(name, []).append(contract)
        for function in csource.defined(text):
            if function.body:
                inner = csource.acsl(text[slice(*function.body)])
                said.setdefault(function.name, []).append(" ".join(one for _, one in inner))
    problems = []
    for left, clause, _ in (entry.split() for entry in dict.fromkeys(entries)):
        annotations = " ".join(said.get(left, []))
        stated = len(re.findall(rf"\b{clause}\s*:(?!:)", annotations))
        invariants = wp_frames.INVARIANT.findall(annotations).count(clause)
        if stated > min(invariants, 1):
            problems.append(
                f"units.toml: [{unit.name}] by_cbmc: {left}, {clause}: stands for more than"
                " the one clause, and WP would leave all of them"
            )
    return problems


def _stale(unit: Unit, kind: str, excepted: Mapping[str, str], settled: set[str]) -> list[str]:
    return [
        f"units.toml: [{unit.name}] {kind}: {name} is no exception any more, remove it"
        for name in excepted
        if name in settled
    ]


def compare_goals(listed: Sequence[str], seen: Sequence[str], where: str) -> list[str]:
    """How the goals that WP made differ from the fixed list."""
    problems = []
    if list(listed) != sorted(set(listed)):
        problems.append(f"{where}: not sorted, or a goal twice; run --update-goals")
    for name in sorted(set(listed) - set(seen)):
        problems.append(
            f"{where}: {name} is listed, but WP has no such goal any more: if its clause was"
            " removed on purpose, review and run --update-goals"
        )
    for name in sorted(set(seen) - set(listed)):
        problems.append(f"{where}: {name} is a new goal: review and run --update-goals")
    for name, times in Counter(seen).items():
        if times > 1:
            problems.append(f"{where}: {times} goals are called {name}")
    return problems
