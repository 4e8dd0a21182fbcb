# SPDX-License-Identifier: Apache-2.0
"""Executes harnesses on this machine: most mutants are so wrong that some execution shows it.

A harness is a function of C. Here it is compiled as such, with the sources that it links: what is
arbitrary is drawn from an input, an assumption that does not hold ends the execution, and an
assertion that does not hold, where all assumptions before it did, is a counterexample: the values
that were drawn are among those that the harness speaks of. So it kills the mutant, without a
solver. That nothing is found says nothing, and the mutant goes on to CBMC.

What could make it wrong, and what is done about it:
- What C leaves undefined. Sanitizers end such an execution before it can show anything; a local
  that nobody has written holds 0, which is one of the values that CBMC takes it to have. Nothing is
  optimised: a copy of a structure copies its padding, as it does for CBMC.
- This machine is not the target: pointers and `size_t` have 64 bits. Enumerations and `char` are as
  on the target. Floats are IEEE 754's on both, no two operations are contracted into one, and one
  NaN counts as another. A harness that fails on the unchanged code is not used, and told.
- What one execution leaves to the next. Objects begin each with what C gives them, and the failing
  input is executed again in a process of its own.
- All the same, CBMC is asked about some of the executions (`replayed`): with the very values that
  were drawn, the same assertion must fail for it. If not, the run fails.

Where a harness replaces a function of another file, the linker puts its stand-in there. Where the
function is called in the file that defines it, that definition is made weak, and the stand-in bears
its name. A static one is seen by no linker: such a harness is left to CBMC. Inputs that no search
would find come from CBMC (tools/keel/mutate/seeds.py).
"""

from __future__ import annotations

import base64
import re
import shutil
import threading
import zlib
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any

from keel.base.jobs import Finished, Runner
from keel.base.verdict_cache import Cache, digest
from keel.c import declarations
from keel.c import source as csource
from keel.c.project import ProjectError, Unit, closure, include_options
from keel.engines.cbmc import Cbmc
from keel.judge.harness import Harness, without_solver
from keel.mutate.harnesses import Seen, in_tree
from keel.mutate.operators import Mutant
from keel.mutate.seeds import Seeds, program
from keel.mutate.verdicts import EXECUTED, Identity

OWN = Path(__file__).resolve().parent
RUNTIME = (OWN / "mutant_run.c", OWN / "mutant_run.h")
# As the target has it where that can be had, and nothing that C leaves open taken for granted.
LANGUAGE = (
    "-std=c99",
    "-ffreestanding",
    "-funsigned-char",
    "-fshort-enums",
    "-ffp-contract=off",
    "-w",
    "-ffunction-sections",
)
CHECKED = (
    "-O0",
    "-fsanitize=address,undefined",
    "-fsanitize-trap=undefined",
    "-ftrivial-auto-var-init=zero",
)
HOSTED = ("-fhosted", "-D_GNU_SOURCE", "-fno-sanitize=all")  # what executes, itself
QUIET = {
    "ASAN_OPTIONS": "detect_leaks=0:symbolize=0:handle_segv=0:handle_sigbus=0:handle_sigfpe=0:"
    "handle_sigill=0:handle_abort=0:log_path=/dev/null"
}
# How libFuzzer looks for inputs, always the same.
SEARCHES = 300_000
SEARCH = (
    f"-runs={SEARCHES}",
    "-seed=1",
    "-max_len=32768",
    "-len_control=0",
    "-verbosity=0",
    "-timeout=10",
    "-rss_limit_mb=0",
)
INPUTS = 40_000  # of a harness: those that are kept, and variations
LONGEST = 20.0  # seconds for all executions of a mutant
ALONE = 8  # of the harnesses with a header that is mutated, each of which is compiled anew
NOT_HERE = "is no program of this machine"
DEATHS = 4  # after so many harnesses in which the sanitizers ended the program nobody goes on
CONFIRMING = 60.0  # seconds for CBMC and one execution
NUMBERS = 400
NUMBER = re.compile(
    r"(?<![\w.])(0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[uUlLfF]*(?![\w.])"
)
# A harness, and how many executions did not end or did what C leaves undefined.
PASSED = re.compile(r"^PASSED (\w+) \d+ (\d+) (\d+) \d+$", re.M)
NONDET = re.compile(r"nondet_\w+$")
# Above the size of every array that is drawn: a harness's own bound is that of its own loops.
FILLED = 1 << 16


@dataclass(frozen=True)
class Kill:
    """An execution that refutes a mutant."""

    harness: Harness
    text: str
    number: int
    values: tuple[str, ...]

    @property
    def said(self) -> str:
        """For a verdict."""
        return f"killed: {self.harness.name}: {self.text}{EXECUTED}{self.number})"


class Sample:
    """Which kills CBMC is asked about: the first, and one of so many from then on.

    Where CBMC gives no answer the next one is asked in its place.
    """

    def __init__(self, every: int) -> None:
        self.every = every
        self.executed = self.confirmed = 0
        self.contradictions: list[str] = []
        self._due = False
        self._lock = threading.Lock()

    def takes(self) -> bool:
        """Whether a kill is to be confirmed."""
        with self._lock:
            self._due = self._due or self.executed % self.every == 0
            self.executed += 1
            return self._due

    def heard(self, confirmed: bool | None, what: str) -> None:
        """What CBMC said of it."""
        with self._lock:
            self._due = confirmed is None
            self.confirmed += confirmed is True
            if confirmed is False:
                self.contradictions.append(what)


def judge() -> str:
    """SHA-256 over what executes."""
    files = [*RUNTIME, Path(__file__), OWN / "seeds.py"]
    return digest({path.name: path.read_text(encoding="utf-8") for path in files})


# --- Harnesses as programs ------------------------------------------------------------------------


def numbers_in(texts: Iterable[str]) -> list[str]:
    """The numbers that stand in texts of C, as C writes them."""
    words = {word for text in texts for word in NUMBER.findall(csource.without_comments(text))}
    found = {float(int(word, 16)) if word[:2] in ("0x", "0X") else float(word) for word in words}
    return [repr(value) for value in sorted(found) if value < 1e39][:NUMBERS]


def drawn(texts: Sequence[str]) -> dict[str, str]:
    """The functions that give arbitrary values, with their types."""
    found: dict[str, str] = {}
    for text in texts:
        for name, signature in declarations.signatures(text).items():
            if not NONDET.match(name):
                continue
            if signature.parameters or "*" in signature.result:
                raise ProjectError(f"{name}: takes something, or gives a pointer")
            found[name] = signature.result
    return found


def _calls(name: str, text: str) -> bool:
    """Whether a file that defines a function calls it, too."""
    found = len(re.findall(rf"\b{name}\s*\(", csource.code_only(text)))
    return found > 1 and any(one.name == name for one in csource.defined(text))


def _is_hidden(name: str, path: Path) -> bool:
    """Whether no linker can replace a function that a file defines: it is static, or inline."""
    return path.suffix == ".h" or any(
        one.static for one in csource.defined(csource.read(path)) if one.name == name
    )


def weakened(names: Iterable[str]) -> str:
    """What makes definitions weak in a file that it stands before."""
    return "".join(f"#pragma weak {name}\n" for name in names)


class Wrapping:
    """A harness with functions that give the values which are arbitrary in it."""

    def __init__(self, harness: Harness, files: Sequence[Path]) -> None:
        texts = [csource.read(path) for path in files]
        # The replaced functions that a file calls which defines them.
        self.weak = {
            path: inside
            for path, text in zip(files, texts, strict=True)
            if (inside := [name for name in harness.replaces if _calls(name, text)])
        }
        self._inside = {name for inside in self.weak.values() for name in inside}
        if hidden := [
            name for path in self.weak for name in self._inside if _is_hidden(name, path)
        ]:
            raise ProjectError(f"{harness.name}: no linker can replace {hidden[0]}")
        self._harness = harness
        self._types = drawn(texts)
        self._known = declarations.structures(texts)
        self._numbers = numbers_in(texts)

    def _filled(self, place: str, type_: str, depth: int) -> list[str]:
        """Statements that give an object arbitrary values."""
        if type_ == "float":
            return [f"{place} = keel_run_float();"]
        if type_ == "double":
            raise ProjectError(f"{self._harness.name}: an arbitrary double")
        if type_ in ("bool", "_Bool"):
            return [f"{place} = keel_run_bool();"]
        if type_ not in self._known:
            return [f"{place} = ({type_})keel_run_int(sizeof({type_}));"]
        lines = []
        for field in self._known[type_]:
            inner, index = f"{place}.{field.name}", f"i{depth}"
            if not field.size:
                lines += (
                    [f"{inner} = NULL;"]
                    if field.pointer
                    else self._filled(inner, field.type, depth)
                )
                continue
            body = (
                [f"{inner}[{index}] = NULL;"]
                if field.pointer
                else self._filled(f"{inner}[{index}]", field.type, depth + 1)
            )
            end = f"sizeof({inner}) / sizeof({inner}[0])"
            lines += [f"for (size_t {index} = 0u; {index} < {end}; {index}++) {{", *body, "}"]
        return lines

    def _functions(self) -> list[str]:
        lines = []
        for name, type_ in sorted(self._types.items()):
            lines += [
                f"{type_} {name}(void)",
                "{",
                f"{type_} value;",
                *self._filled("value", type_, 0),
                "return value;",
                "}",
            ]
        return lines

    @property
    def unwound(self) -> tuple[str, ...]:
        """Options by which CBMC comes to the end of the loops that fill what is drawn."""
        loops = [
            f"{name}.{number}:{FILLED}"
            for name, type_ in sorted(self._types.items())
            for number in range("".join(self._filled("value", type_, 0)).count("for ("))
        ]
        return ("--unwindset", ",".join(loops)) if loops else ()

    @property
    def wrapped(self) -> list[str]:
        """The replaced functions that other files than their own call."""
        return [name for name in self._harness.replaces if name not in self._inside]

    def _stand_in(self, name: str) -> str:
        """How the stand-in of a function is called for the linker."""
        return name if name in self._inside else f"__wrap_{name}"

    def text(self, path: Path) -> str:
        """For this machine; the names are such that several harnesses make one program."""
        name = self._harness.name
        numbers = ", ".join(self._numbers) or "0.0"
        return "\n".join(
            [
                *(f"#define {one} {name}_{one}" for one in sorted(self._types)),
                *(
                    f"#define {one}_stand_in {self._stand_in(one)}"
                    for one in self._harness.replaces
                ),
                f'#include "{path}"',
                *self._functions(),
                f"static const double keel_run_numbers[] = {{{numbers}}};",
                f"const keel_run_entry_t {name}_entry = {{",
                f'"{name}", {name}, keel_run_numbers, {len(self._numbers)}u}};',
                "",
            ]
        )

    def seeding(self, path: Path) -> str:
        """For CBMC, which is to say what may be drawn."""
        return program(RUNTIME[1], path, self._harness.name, self._functions())

    def replay(self, path: Path, values: Sequence[str]) -> str:
        """For CBMC: nothing is arbitrary any more."""
        table = ", ".join(f"{value}ull" for value in values) or "0"
        return "\n".join(
            [
                "#define KEEL_RUN_REPLAY",
                "#include <stdint.h>",
                f"static const uint64_t keel_run_values[] = {{{table}}};",
                "#define KEEL_RUN_VALUE(place) keel_run_values[place]",
                f'#include "{RUNTIME[1]}"',
                f'#include "{path}"',
                *self._functions(),
                "",
            ]
        )


def replayed(kill: Kill, wrapping: Wrapping, checker: Cbmc, root: Path) -> bool | None:
    """Whether the same assertion fails for CBMC in the same execution; None: it gives no answer."""
    harness = in_tree(kill.harness, root)
    place = root / "build" / "replay" / f"{harness.name}.c"
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text(wrapping.replay(harness.path, kill.values), encoding="utf-8")
    # No solver is needed, but the bound of a loop whose end is not seen to be constant is.
    options = (*without_solver(list(harness.options)), *wrapping.unwound)
    alone = replace(harness, path=place, options=options, assertions_only=True, timeout=CONFIRMING)
    binary, complaint = checker.build(alone, f"{harness.name}-replay")
    if complaint:
        return None
    answer = checker.check(alone, binary)
    if not answer.complete:
        return None
    return any(
        item["status"] == "FAILURE" and item["description"] == kill.text
        for item in answer.properties
    )


# --- Programs -------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Ready:
    """A harness that can be executed: its inputs, and how many variations there are with them."""

    inputs: Path
    count: int


class Executions:
    """The harnesses of a unit as programs, and what they say of mutants."""

    def __init__(
        self,
        unit: Unit,
        clang: Sequence[str],
        version: str,
        seen: Iterable[Seen],
        scratch: Path,
        cache: Cache,
        unchanged: Callable[[], Runner],
        seeds: Callable[[], Seeds] | None = None,
    ) -> None:
        self._root = unit.root.resolve()
        self._unit = unit.name
        self._clang = list(clang)
        self._version = version
        self._seen = {one.harness.name: one for one in seen}
        self._scratch = scratch / "executed"
        self._cache = cache
        self._unchanged = unchanged
        self._seeds = seeds
        self._lock = threading.RLock()
        self._wrappings: dict[str, Wrapping | None] = {}
        self._ready: dict[str, Ready | None] = {}
        self._objects: dict[tuple[Path, tuple[str, ...]], Path | None] = {}
        self._kills: Counter[tuple[str, str]] = Counter()
        self._closures: dict[Path, frozenset[Path]] = {}
        self.failing: dict[str, str] = {}
        # By mutant: the first harness in which an execution did not come to its end.
        self.ended: dict[Identity, Harness] = {}

    def wrapping(self, name: str) -> Wrapping | None:
        """How a harness becomes a program; None if it cannot."""
        with self._lock:
            if name not in self._wrappings:
                one = self._seen[name]
                try:
                    files = closure(self._root, [one.harness.path, *one.harness.sources])
                    self._wrappings[name] = Wrapping(one.harness, files)
                except ProjectError:
                    self._wrappings[name] = None
            return self._wrappings[name]

    def confirmed(self, kill: Kill, checker: Cbmc, tree: Path) -> bool | None:
        """Whether CBMC sees in a tree what an execution showed; None if it gives no answer."""
        wrapping = self.wrapping(kill.harness.name)
        return replayed(kill, wrapping, checker, tree) if wrapping else None

    def kills(
        self, mutant: Mutant, harnesses: Sequence[Harness], tree: Path, runner: Runner
    ) -> Kill | None:
        """An execution that refutes a mutant, which stands in a tree; None if there is none.

        Harnesses of other units that only call what they do not cover are left to CBMC.
        """
        function = mutant.function
        near = [one for one in harnesses if function in one.covers or one.unit.name == self._unit]
        order = sorted(near, key=lambda one: -self._kills[function, one.name])
        changed = mutant.file.resolve().relative_to(self._root)
        try:
            for group in self._groups(order, mutant.file):
                for program, asked in self._parts(group, changed, tree, runner):
                    if kill := self._run(mutant, program, asked, runner):
                        self._kills[function, kill.harness.name] += 1
                        return kill
        except ProjectError:
            pass  # to this compiler it is no C
        return None

    def _groups(self, harnesses: Sequence[Harness], file: Path) -> Iterable[list[Harness]]:
        """Harnesses that make one program: where the mutant is in a header, each its own.

        So does one with stand-ins, which may be those of its model as well.
        """
        if file.suffix == ".h":
            usable = (one for one in harnesses if self._prepared(one))
            return ([one] for one in islice(usable, ALONE))
        groups: dict[tuple[str, ...], list[Harness]] = {}
        for one in harnesses:
            if self._prepared(one):
                apart = (one.name,) if one.replaces else ()
                groups.setdefault((*one.defines, *apart), []).append(one)
        return groups.values()

    def _parts(
        self, group: Sequence[Harness], changed: Path, tree: Path, runner: Runner
    ) -> Iterable[tuple[Path, list[Harness]]]:
        """The programs of a group: one, or one for each harness that goes with no other."""
        place = self._scratch / tree.name
        program = self._program(group, changed, tree, place, runner)
        if program:
            yield program, list(group)
        elif len(group) > 1:
            for one in group:
                if program := self._program([one], changed, tree, place, runner):
                    yield program, [one]

    # Compiling.

    def _compile(
        self, source: Path, target: Path, folder: Path, runner: Runner, extra: Sequence[str]
    ) -> bool:
        target.parent.mkdir(parents=True, exist_ok=True)
        command = [
            *self._clang,
            *LANGUAGE,
            *CHECKED,
            *include_options(folder),
            "-include",
            str(RUNTIME[1]),
            *extra,
            "-c",
            str(source),
            "-o",
            str(target),
        ]
        return runner.run(command).status == 0

    def _object(self, source: Path, defines: tuple[str, ...], extra: Sequence[str] = ()) -> Path:
        """The object of what is unchanged, made once."""
        key = (source, (*defines, *extra))
        with self._lock:
            if key not in self._objects:
                target = self._scratch / "objects" / f"{len(self._objects)}.o"
                words = [*defines, *extra]
                made = self._compile(source, target, self._root, self._unchanged(), words)
                self._objects[key] = target if made else None
        found = self._objects[key]
        if not found:
            raise ProjectError(f"{source}: does not compile for this machine")
        return found

    def _wrapped(self, harness: Harness, root: Path, folder: Path) -> Path:
        """The file of a harness as a part of a program."""
        wrapping = self.wrapping(harness.name)
        assert wrapping
        path = root / harness.path.relative_to(self._root)
        target = folder / f"{harness.name}.wrapped.c"
        text = wrapping.text(path)
        if not target.is_file() or target.read_text(encoding="utf-8") != text:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")
        return target

    def _table(self, harnesses: Sequence[Harness], folder: Path) -> Path:
        names = [one.name for one in harnesses]
        lines = [f"extern const keel_run_entry_t {name}_entry;" for name in names]
        lines += [
            "const keel_run_entry_t *const keel_run_entries[] = {",
            ", ".join(f"&{name}_entry" for name in names),
            "};",
            f"const size_t keel_run_entry_count = {len(names)}u;",
            "",
        ]
        target = folder / f"{digest(names)[:16]}.table.c"
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text("\n".join(lines), encoding="utf-8")
        return target

    def _program(
        self,
        harnesses: Sequence[Harness],
        changed: Path | None,
        tree: Path,
        place: Path,
        runner: Runner,
        extra: Sequence[str] = (),
        more: Sequence[str] = (),
    ) -> Path | None:
        """A program of harnesses; what a mutant is in, or includes it, is compiled in its tree.

        None if they do not go together; what does not compile is an error.
        """
        common = self._scratch / "common"
        defines = harnesses[0].defines
        sources = {path for one in harnesses for path in one.sources}
        wrapped = {one.path: one for one in harnesses}
        wrappings = [found for one in harnesses if (found := self.wrapping(one.name))]
        objects: list[Path] = []
        for path in sorted({*sources, *wrapped}):
            touched = changed is not None and self._root / changed in self._closure(path)
            where = tree if touched else self._root
            folder = place if touched else common
            source = self._wrapped(wrapped[path], where, folder) if path in wrapped else path
            weak = self._weak(path, wrappings, common)
            if not touched:
                objects.append(self._object(source, defines, [*extra, *weak]))
                continue
            if path not in wrapped:
                source = tree / path.relative_to(self._root)
            target = place / f"{len(objects)}.o"
            if not self._compile(source, target, tree, runner, [*defines, *extra, *weak]):
                raise ProjectError(f"{source}: does not compile for this machine")
            objects.append(target)
        objects.append(self._object(self._table(harnesses, common), (), extra))
        objects.append(self._object(RUNTIME[0], (), [*extra, *HOSTED]))
        place.mkdir(parents=True, exist_ok=True)
        program = place / "program"
        linker = ["-fuse-ld=gold"] if shutil.which("ld.gold") else []  # which is faster
        linker += ["-Wl,--gc-sections"]  # as for CBMC, what nobody calls need not be whole
        linker += [f"-Wl,--wrap={name}" for one in wrappings for name in one.wrapped]
        done = runner.run(
            [*self._clang, *CHECKED, *linker, *more, *map(str, objects), "-o", str(program)]
        )
        return program if done.status == 0 else None

    def _weak(self, source: Path, wrappings: Iterable[Wrapping], folder: Path) -> list[str]:
        """Options that let the harnesses' stand-ins take the place of functions of a source."""
        names = sorted({name for one in wrappings for name in one.weak.get(source, [])})
        if not names:
            return []
        header = folder / f"{digest(names)[:16]}.weak.h"
        header.parent.mkdir(parents=True, exist_ok=True)
        header.write_text(weakened(names), encoding="utf-8")
        return ["-include", str(header)]

    def _closure(self, path: Path) -> frozenset[Path]:
        with self._lock:
            if path not in self._closures:
                self._closures[path] = frozenset(closure(self._root, [path]))
            return self._closures[path]

    # Inputs.

    def _prepared(self, harness: Harness) -> Ready | None:
        """A harness that can be executed, and passes all its inputs on the unchanged code."""
        with self._lock:
            name = harness.name
            if name not in self._ready:
                self._ready[name] = self._prepare(harness) if self.wrapping(name) else None
            return self._ready[name]

    def _prepare(self, harness: Harness) -> Ready | None:
        key = self._key(harness)
        place = self._scratch / "inputs" / f"{harness.name}.bin"
        place.parent.mkdir(parents=True, exist_ok=True)
        kept = self._cache.get(key)
        if kept is None:
            try:
                kept = self._searched(self._seen[harness.name].harness, place)
            except ProjectError:
                kept = {"why": NOT_HERE}
            if not kept["why"]:
                self._cache.put(key, kept)
        if kept["why"]:
            self.failing[harness.name] = str(kept["why"])
            return None
        place.write_bytes(zlib.decompress(base64.b64decode(kept["inputs"])))
        return Ready(place, int(kept["count"]))

    def _key(self, harness: Harness) -> str:
        """All that the inputs of a harness depend on."""
        seen = self._seen[harness.name]
        read = {path: path.read_text(encoding="utf-8") for path in seen.files}
        texts = {
            path.relative_to(self._root).as_posix(): csource.essence(text)
            for path, text in read.items()
        }
        return digest([judge(), self._version, seen.command, texts])

    def _searched(self, harness: Harness, place: Path) -> dict[str, Any]:
        """The inputs of a harness, found on the unchanged code, or why there are none."""
        runner = self._unchanged()
        folder = self._scratch / "search" / harness.name
        corpus = folder / "corpus"
        corpus.mkdir(parents=True, exist_ok=True)
        plain = self._program([harness], None, self._root, folder, runner)
        if not plain:
            return {"why": NOT_HERE}
        plain = plain.rename(folder / "plain")
        place.write_bytes(b"")
        first = self._execute(plain, "run", [(harness.name, place, 2)], runner)
        if re.search(rf"^PASSED {harness.name} 1 0 0 0$", first.output, re.M):
            return self._passing(harness, plain, place, b"", runner)  # nothing is arbitrary in it
        for number, seed in enumerate(self._seeded(harness)):
            (corpus / f"seed{number}").write_bytes(seed)
        extra = ["-fsanitize=fuzzer-no-link", "-DKEEL_RUN_SEARCH"]
        # With what the search counts, no function is left out, not even one that nobody calls.
        more = ["-fsanitize=fuzzer", "-Wl,--unresolved-symbols=ignore-all"]
        search = self._program([harness], None, self._root, folder, runner, extra, more)
        if not search:
            return {"why": NOT_HERE}
        command = [str(search), *SEARCH, f"-artifact_prefix={folder}/", str(corpus)]
        done = runner.run(command, 600.0, extra=QUIET)
        if done.status != 0:
            return {"why": "fails on the unchanged code when it is executed"}
        inputs = b"".join(
            (path.stat().st_size // 8).to_bytes(4, "little") + path.read_bytes()
            for path in sorted(corpus.iterdir())
            if path.stat().st_size % 8 == 0
        )
        return self._passing(harness, plain, place, inputs, runner)

    def _seeded(self, harness: Harness) -> list[bytes]:
        """What CBMC says leads to each place; nothing where a solver of equations is needed."""
        wrapping = self.wrapping(harness.name)
        if not self._seeds or not wrapping or "--z3" in harness.options:
            return []
        text = wrapping.seeding(harness.path)
        return self._seeds().of(replace(harness, options=harness.options + wrapping.unwound), text)

    def _passing(
        self, harness: Harness, program: Path, place: Path, inputs: bytes, runner: Runner
    ) -> dict[str, Any]:
        """The inputs that the program takes to the end, once all have passed."""
        place.write_bytes(inputs)
        if inputs:
            packed = place.with_suffix(".packed")
            shell = [
                "sh",
                "-c",
                'exec "$0" pack "$1" "$2" > "$3"',
                str(program),
                harness.name,
                str(place),
                str(packed),
            ]
            runner.run(shell, 60.0, extra=QUIET)
            place.write_bytes(packed.read_bytes())
            if not place.stat().st_size:
                return {"why": "no execution that was found reaches its end"}
        done = self._execute(program, "run", [(harness.name, place, INPUTS)], runner, 600.0)
        if not re.search(rf"^PASSED {harness.name} [1-9]\d* 0 0 \d+$", done.output, re.M):
            return {"why": "fails on the unchanged code when it is executed"}
        text = base64.b64encode(zlib.compress(place.read_bytes())).decode()
        return {"why": "", "inputs": text, "count": INPUTS}

    # Executing.

    def _execute(
        self,
        program: Path,
        what: str,
        asked: Sequence[tuple[str, Path, int]],
        runner: Runner,
        limit: float = LONGEST,
    ) -> Finished:
        words = [str(word) for one in asked for word in one]
        return runner.run([str(program), what, *words], limit, merged=False, extra=QUIET)

    def _run(
        self, mutant: Mutant, program: Path, harnesses: Sequence[Harness], runner: Runner
    ) -> Kill | None:
        """The first execution that fails, and fails again from a fresh start."""
        left = {one.name: one for one in harnesses}
        for _ in range(DEATHS):
            asked = [(name, *self._inputs(name)) for name in left]
            if not asked:
                return None
            done = self._execute(program, "run", asked, runner)
            if found := re.search(r"^FAILED (\w+) (\d+) (.*)$", done.output, re.M):
                return self._again(program, left[found[1]], int(found[2]), runner)
            passed = PASSED.findall(done.output)
            unended = [left[name] for name, hung, ill in passed if int(hung) or int(ill)]
            # The one after these ended the program, if it did not come to its end.
            unended += list(left.values())[len(passed) : len(passed) + 1]
            if unended:
                self.ended.setdefault(mutant.identity, unended[0])
            if done.status == 0 or done.timed_out:
                return None
            left = dict(list(left.items())[len(passed) + 1 :])
        return None

    def _inputs(self, name: str) -> tuple[Path, int]:
        ready = self._ready[name]
        assert ready
        return ready.inputs, ready.count

    def _again(self, program: Path, harness: Harness, number: int, runner: Runner) -> Kill | None:
        path, _ = self._inputs(harness.name)
        output = self._execute(program, "again", [(harness.name, path, number)], runner).output
        failed = re.search(r"^FAILED \w+ \d+ (.*)\nVALUES(.*)$", output, re.M)
        return Kill(harness, failed[1], number, tuple(failed[2].split())) if failed else None
