# SPDX-License-Identifier: Apache-2.0
"""Reads what a harness hands to the function that it proves: anything, or less than that.

Three kinds of harness differ in what they show. One of chosen points hands in constants, or rows of
a table, and shows nothing of anything else. One within a bound narrows its inputs: a size smaller
than the shipped one, fewer bits, an assumption, a number set. Any other is for every valid state.

What narrows is looked for in the harness and in all functions of proofs that it leads to, stand-ins
and callbacks included. What the precondition asks for anyway narrows nothing: an assumption of
F_may(...) or of a predicate ..._valid_here(...), and what proofs/preconditions.toml says is a part
of it, or what no argument depends on.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from keel.audit import harness_writes
from keel.audit.comparers import bare
from keel.c import source as csource
from keel.c import syntax
from keel.c.declarations import Macros, Parameter, Signature, macros, number, signatures
from keel.c.project import ProjectError, closure
from keel.c.syntax import Node, written
from keel.judge.harness import Harness

EVERY, BOUND, CHOSEN = "every valid state", "within a bound", "chosen points"
TABLE = "proofs/preconditions.toml"
# What may be left out of a header of proofs, by a macro of a harness.
CONDITIONS = frozenset(["VOTER_FLOATS_OPEN", "CRC_AS_IT_IS"])
# What functions of proofs that bear the name of one of the code end in.
ENDINGS = ("_harness", "_stand_in", "_may", "_does")
# Names that harnesses of chosen points bear.
POINTS = re.compile(r"__(?:\w+_)?(?:points|edges|chosen)_harness$")
DEFINED = re.compile(r"^#define (\w+)", re.MULTILINE)
NONDET = re.compile(r"nondet_\w+")
DRAWS = re.compile(r"any_bits(?:64)?|any_below|any_within")
# What a precondition is called, where a harness assumes it, and what a contract is.
PRECONDITION = re.compile(r"(?:\w+_)?(?:may|valid_here)\(.*\)|\w+_does\(.*\)", re.DOTALL)
WIDTHS = {"any_bits": 32, "any_bits64": 64}
# Where a value of an argument comes from.
ANYTHING, CONSTANT, ROW = "anything", "constant", "row of a table"


@dataclass
class Inputs:
    """What a harness hands in."""

    kind: str = EVERY
    # What narrows it.
    bounds: list[str] = field(default_factory=list)
    # The functions that assume or build what the precondition asks for, and contracts that take
    # part.
    assumes: list[str] = field(default_factory=list)
    # What each of these functions says: lines of text.
    said: dict[str, list[str]] = field(default_factory=dict)


@dataclass(frozen=True)
class Function:
    """A function of proofs."""

    name: str
    body: str
    parameters: tuple[Parameter, ...]
    file: str

    @property
    def tree(self) -> Node:
        """Its body, parsed."""
        return syntax.parse(self.body)


@dataclass
class Preconditions:
    """What proofs/preconditions.toml says: text and the function that it stands in."""

    known: dict[tuple[str, str], str] = field(default_factory=dict)
    used: set[tuple[str, str]] = field(default_factory=set)

    def says(self, function: str, text: str) -> str:
        """What this is a part of, or ""."""
        key = (function, text)
        if key in self.known:
            self.used.add(key)
        return self.known.get(key, "")

    def unused(self) -> list[str]:
        """Entries that nothing needs."""
        return [
            f"{TABLE}: nothing in {where} says {text!r} any more, remove it"
            for where, text in sorted(self.known.keys() - self.used)
        ]


def read_preconditions(path: Path) -> Preconditions:
    """Read the table; each entry says of which precondition its texts are parts."""
    entries = tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    known: dict[tuple[str, str], str] = {}
    for entry in entries.get("part", []):
        if set(entry) != {"in", "of", "texts"} or not all(entry.values()):
            raise ProjectError(f"{TABLE}: each part has `in`, `of` and `texts`: {entry}")
        known |= {(str(entry["in"]), str(text)): str(entry["of"]) for text in entry["texts"]}
    return Preconditions(known)


class Reader:
    """Reads the inputs of harnesses."""

    def __init__(self, root: Path, shipped: Macros, parts: Preconditions) -> None:
        self._root = root
        self._shipped = shipped
        self._parts = parts

    def read(
        self, harness: Harness, call: csource.Call, signature: Signature, loops: Iterable[str]
    ) -> Inputs:
        """What the call of a harness is given, in loops with these heads."""
        paths = [
            path
            for path in closure(self._root, [harness.path])
            if path.is_relative_to(self._root / "proofs")
        ]
        scene = _Scene(harness, paths, call, self._shipped)
        known = {**self._shipped, **macros(map(csource.read, paths)), **_defined(harness.defines)}
        found = Inputs(bounds=[*self._defines(harness), *scene.others()])
        for where, text in [
            *scene.narrowings(known),
            *((harness.name, f"for {head}") for head in loops),
        ]:
            plain = _resolved(text, known, self._shipped, harness)
            own = where == harness.name
            predicate = _is_precondition(text)
            part = self._parts.says(where, text)
            if predicate:
                found.assumes.append(text.partition("(")[0] if own else where)
                scene.tell(found.said, text.partition("(")[0])
            elif not part:
                found.bounds.append(plain if own else f"{plain} in {where}")
                continue
            else:
                found.assumes.append(where)
            if not own:
                lines = found.said.setdefault(scene.place(where), [])
                lines.append(f"{text}: {part}" if part else text)
            elif part:
                found.said.setdefault(scene.place(where), []).append(f"{text}: {part}")
        found.bounds = list(dict.fromkeys(found.bounds))
        found.assumes = list(dict.fromkeys(found.assumes))
        if POINTS.search(harness.name) or scene.is_chosen(signature):
            found.kind = CHOSEN
        elif found.bounds:
            found.kind = BOUND
        return found

    def _defines(self, harness: Harness) -> Iterator[str]:
        """The numbers that a harness sets, other than the shipped ones."""
        for name, (_, value) in _defined(harness.defines).items():
            now, shipped = number(value, {}), number(name, self._shipped)
            if now is not None and now == shipped:
                continue
            text = f"{name} = {value if now is None else now}"
            if not self._parts.says(harness.name, text):
                yield text + ("" if shipped is None else f" ({shipped} is shipped)")


def _defined(defines: Iterable[str]) -> Macros:
    words = (word.removeprefix("-D").partition("=") for word in defines)
    return {name: ((), value or "1") for name, _, value in words}


def _resolved(text: str, known: Macros, shipped: Macros, harness: Harness) -> str:
    """A text with the numbers that macros of proofs stand for, and those set for this harness."""
    own = _defined(harness.defines)

    def meant(match: re.Match[str]) -> str:
        name = match[0]
        while name in known and known[name][1].isidentifier():
            name = known[name][1]
        value = number(name, known) if name in known else None
        return str(value) if value is not None and (name in own or name not in shipped) else name

    return re.sub(r"\b[A-Z][A-Z_0-9]+\b", meant, text)


class _Scene:
    """The functions of proofs that a harness leads to, and what flows into the call."""

    def __init__(
        self, harness: Harness, paths: list[Path], call: csource.Call, shipped: Macros
    ) -> None:
        chosen = {word.removeprefix("-D").partition("=")[0] for word in harness.defines}
        chosen |= set(DEFINED.findall(csource.read(harness.path)))
        texts = [taken(csource.read(path), chosen) for path in paths]
        self._harness = harness
        self._shipped = shipped
        self._call = call
        self._functions = {
            function.name: Function(
                function.name,
                csource.body_of(text, function.name),
                signatures(text)[function.name].parameters,
                path.relative_to(harness.unit.root).as_posix(),
            )
            for path, text in zip(paths, texts, strict=True)
            for function in csource.defined(text)
        }
        self._texts = texts
        stand_ins = [f"{name}_stand_in" for name in harness.replaces]
        models = [name for name in self._functions if name.startswith("model_")]
        self._reached = self._from([harness.name, *stand_ins, *models])
        self._tables = _tables(texts)
        self._statics = _statics(texts)
        self._drawing = self._those_that_draw()
        self._tags = self._flow()
        # The variables of loops.
        self._counters = {
            harness_writes.root(head)
            for loop in syntax.found(self._functions[harness.name].tree, "for_statement")
            if (head := loop.child_by_field_name("initializer"))
        }

    def _from(self, names: Iterable[str]) -> list[Function]:
        """The functions that these lead to, by a call or a pointer."""
        waiting = list(names)
        seen: dict[str, None] = {}
        while waiting:
            name = waiting.pop(0)
            if name in self._functions and name not in seen:
                seen[name] = None
                waiting += re.findall(r"\b[a-z_]\w*", self._functions[name].body)
        return [self._functions[name] for name in seen]

    def _those_that_draw(self) -> set[str]:
        """The functions that lead to arbitrary values."""
        drawing = {
            one.name for one in self._functions.values() if re.search(r"\bnondet_\w+\(", one.body)
        }
        while True:
            more = {
                one.name
                for one in self._functions.values()
                if set(re.findall(r"\b(\w+)\(", one.body)) & drawing
            } - drawing
            if not more:
                return drawing
            drawing |= more

    def others(self) -> Iterator[str]:
        """Functions of the code for which there are others here."""
        prefix = self._harness.unit.prefix
        for name in self._functions:
            if prefix and name.startswith(prefix) and not name.endswith(ENDINGS):
                yield f"{name} is another function here"

    def narrowings(self, known: Macros) -> Iterator[tuple[str, str]]:
        """What narrows: in which function, and how."""
        for text in self._call.arguments:
            if self._tags_of(syntax.expression(text)) == {CONSTANT} and text not in self._counters:
                yield self._harness.name, f"argument {text}"
        for one in self._reached:
            if DRAWS.fullmatch(one.name):
                continue  # Where it is called, it is listed.
            for call in csource.calls(one.body, "__CPROVER_assume"):
                for part in _conjuncts(syntax.expression(call.arguments[0])):
                    yield one.name, written(part)
            yield from ((one.name, text) for text in self._draws(one))
            yield from ((one.name, text) for text in self._set(one))
            yield from ((one.name, text) for text in self._masks(one))
            yield from ((one.name, text) for text in self._sizes(one, known))

    def place(self, name: str) -> str:
        """How a function is named in the list of what is assumed."""
        return f"{self._functions[name].file}: {name}"

    def tell(self, said: dict[str, list[str]], name: str) -> None:
        """Tell what a predicate says, and those that it calls."""
        waiting = [name]
        while waiting:
            one = self._functions.get(waiting.pop())
            if one and self.place(one.name) not in said:
                said[self.place(one.name)] = [" ".join(one.body.split())[1:-1].strip()]
                waiting += re.findall(r"\b(\w+)\(", one.body)

    def _draws(self, one: Function) -> Iterator[str]:
        """Values of fewer bits, and those below a number."""
        for call in csource.calls(one.body, DRAWS.pattern):
            name = written(call.node.children[0])
            bits = re.fullmatch(r"(\d+)u?", call.arguments[0])
            if bits and int(bits[1]) == WIDTHS.get(name):
                continue
            if one.name == self._harness.name and self._is_only_read(call.node):
                continue
            yield written(call.node)

    def _is_only_read(self, node: Node) -> bool:
        """Whether a value is drawn for a variable on which no argument depends."""
        around = node.parent
        if not around or around.type != "init_declarator":
            return False
        name = written(around.child_by_field_name("declarator"))
        return name not in self._sources()

    def _sources(self) -> set[str]:
        """The variables of the harness on which the arguments depend."""
        roots = {root for text in self._call.arguments for root in re.findall(r"\b[a-z]\w*", text)}
        flows = list(self._flows())
        while True:
            more = {
                source for target, sources, _ in flows if target in roots for source in sources
            } - roots
            if not more:
                return roots
            roots |= more

    def _set(self, one: Function) -> Iterator[str]:
        """What is set to a constant, or to one of some: parts of an argument, or all of it."""
        own = one.name == self._harness.name
        stands_in = one.name.startswith("model_") or one.name.endswith("_stand_in")
        if not own and one.name not in self._drawing:
            return
        sources = self._sources() if own else None
        for node in syntax.found(one.tree, "assignment_expression", "init_declarator"):
            left = node.child_by_field_name("left") or node.child_by_field_name("declarator")
            right = node.child_by_field_name("right") or node.child_by_field_name("value")
            if not left or not right or (own and node.start_byte > self._call.start):
                continue
            if sources is not None and harness_writes.root(left) not in sources:
                continue
            part = left.type in ("field_expression", "subscript_expression")
            if (part and not stands_in and self._is_constant(right, own)) or self._is_one_of(right):
                yield f"{written(left)} = {written(right)}"
        for node in [] if own else syntax.found(one.tree, "return_statement"):
            if any(self._is_one_of(value) for value in node.named_children):
                yield written(node).rstrip(";")

    def _is_constant(self, node: Node, own: bool) -> bool:
        names = [written(name) for name in syntax.found(node, "identifier")]
        if not own:
            return not self._is_drawn(node)
        return not self._is_drawn(node) and not any(
            ANYTHING in self._tags.get(name, ()) for name in names
        )

    def _is_one_of(self, node: Node) -> bool:
        """Whether a value is one of two constants, whichever."""
        node = bare(node)
        if node.type != "conditional_expression":
            return False
        _, *branches = [
            node.child_by_field_name(name) for name in ("condition", "consequence", "alternative")
        ]
        return all(
            branch and (self._is_one_of(branch) or not re.search(r"\b[a-z]\w*", written(branch)))
            for branch in branches
        )

    def _is_drawn(self, node: Node) -> bool:
        names = re.findall(r"\b(\w+)\(", written(node))
        return any(NONDET.fullmatch(name) or name in self._drawing for name in names)

    def _masks(self, one: Function) -> Iterator[str]:
        """Arbitrary values of which a part is taken."""
        for node in syntax.found(one.tree, "binary_expression"):
            sign = written(node.child_by_field_name("operator"))
            sides = [node.child_by_field_name(side) for side in ("left", "right")]
            if sign in ("&", "%", ">>", "/", "*", "<<", "+", "-") and any(
                side
                and side.type == "call_expression"
                and NONDET.fullmatch(written(side.child_by_field_name("function")))
                for side in sides
            ):
                yield written(node)

    def _sizes(self, one: Function, known: Macros) -> Iterator[str]:
        """Arrays of a size that is a number here, in what builds the inputs."""
        if one.name != self._harness.name:
            return
        sources = self._sources()
        statics = [
            node for node in _file_level(self._texts) if harness_writes.root(node) in self._statics
        ]
        for node in syntax.found(one.tree, "array_declarator") + [
            array for static in statics for array in syntax.found(static, "array_declarator")
        ]:
            size = written(node.child_by_field_name("size"))
            own = [name for name in re.findall(r"[A-Z]\w+", size) if self._is_own(name, known)]
            if harness_writes.root(node) in sources and (own or number(size, {}) is not None):
                yield f"{harness_writes.root(node)}[{size}]"

    def _is_own(self, name: str, known: Macros) -> bool:
        """Whether a macro's number is that of the proofs, not one that is shipped."""
        while name in known and known[name][1].isidentifier():
            name = known[name][1]
        return number(name, self._shipped) is None

    def is_chosen(self, signature: Signature) -> bool:
        """Whether a row of a table reaches the arguments, or no arbitrary value reaches those that
        are only read; the others, if there are none."""
        every = [self._tags_of(syntax.expression(text)) for text in self._call.arguments]
        read = [
            tags
            for tags, parameter in zip(every, signature.parameters, strict=False)
            if not parameter.written
        ]
        deciding = {tag for tags in read or every for tag in tags}
        anywhere = {tag for tags in every for tag in tags}
        return ROW in anywhere or (CONSTANT in deciding and ANYTHING not in deciding)

    def _flows(self) -> Iterator[tuple[str, set[str], set[str]]]:
        """What is written in the harness: the variable, those that it depends on, and more tags."""
        tree = self._functions[self._harness.name].tree
        for node in syntax.found(
            tree, "assignment_expression", "init_declarator", "update_expression"
        ):
            target = node.child_by_field_name("left") or node.child_by_field_name("declarator")
            value = node.child_by_field_name("right") or node.child_by_field_name("value")
            if target and value:
                names = {written(one) for one in syntax.found(value, "identifier")}
                constant = set() if names or self._is_drawn(value) else {CONSTANT}
                yield harness_writes.root(target), names, constant
        for node in syntax.found(tree, "call_expression"):
            name = written(node.child_by_field_name("function"))
            given = node.child_by_field_name("arguments")
            if not given or name.startswith("__CPROVER") or name not in self._functions:
                continue
            names = {written(one) for one in syntax.found(given, "identifier")}
            tags = {ANYTHING} if name in self._drawing else {CONSTANT}
            arguments = [one for one in given.named_children if one.type != "comment"]
            for one, parameter in zip(arguments, self._functions[name].parameters, strict=False):
                if parameter.written:
                    yield harness_writes.root(one), names, tags
            for static in self._statics & set(self._mentions(name)):
                yield static, names, tags

    def _mentions(self, name: str) -> Iterator[str]:
        """The names in a function and in those that it leads to."""
        for one in self._from([name]):
            yield from re.findall(r"\b[a-z_]\w*", one.body)

    def _flow(self) -> dict[str, set[str]]:
        """For each variable of the harness, where its value comes from."""
        tags: dict[str, set[str]] = {name: {ROW} for name in self._tables}
        flows = list(self._flows())
        for _ in range(len(flows) + 1):
            for target, names, more in flows:
                mine = tags.setdefault(target, set())
                mine |= more
                for name in names:
                    mine |= tags.get(name, set())
                    if NONDET.fullmatch(name) or name in self._drawing:
                        mine.add(ANYTHING)
        return tags

    def _tags_of(self, node: Node) -> set[str]:
        names = {written(one) for one in syntax.found(node, "identifier")}
        tags = {tag for name in names for tag in self._tags.get(name, ())}
        if any(NONDET.fullmatch(name) or name in self._drawing for name in names):
            tags.add(ANYTHING)
        return tags if names else {CONSTANT}


def _is_precondition(text: str) -> bool:
    """Whether a text is the call of a precondition or contract, and no more than that."""
    if not PRECONDITION.fullmatch(text):
        return False
    return bare(syntax.expression(text)).type == "call_expression"


def _conjuncts(node: Node) -> Iterator[Node]:
    """What && joins in an assumption."""
    node = bare(node)
    sign, *sides = (node.child_by_field_name(name) for name in ("operator", "left", "right"))
    if node.type == "binary_expression" and written(sign) == "&&":
        for side in sides:
            if side:
                yield from _conjuncts(side)
    else:
        yield node


def _file_level(texts: Iterable[str]) -> Iterator[Node]:
    for text in texts:
        for node in syntax.found(syntax.parse(text), "declaration"):
            around = node.parent
            while around and around.type.startswith("preproc"):
                around = around.parent
            if around and around.type == "translation_unit":
                yield node


def _tables(texts: Iterable[str]) -> set[str]:
    """Arrays of constants at file level."""
    found = set()
    for node in _file_level(texts):
        for one in syntax.found(node, "init_declarator"):
            if syntax.found(one, "array_declarator") and syntax.found(one, "initializer_list"):
                found.add(harness_writes.root(one))
    return found


def _statics(texts: Iterable[str]) -> set[str]:
    """Variables at file level."""
    return {
        harness_writes.root(node)
        for node in _file_level(texts)
        if not syntax.found(node, "function_declarator") and harness_writes.root(node)
    }


def taken(text: str, names: Iterable[str]) -> str:
    """A text without what the conditions of CONDITIONS leave out, places kept."""
    chosen = set(names)
    result: list[str] = []
    stack: list[bool] = []
    for line in text.splitlines(keepends=True):
        match = re.match(r"\s*#\s*(ifdef|ifndef|if|else|elif|endif)\b\s*(\w*)", line)
        word, name = (match[1], match[2]) if match else ("", "")
        shows = all(stack)
        if word in ("ifdef", "ifndef", "if"):
            stack.append(name not in CONDITIONS or (name in chosen) == (word == "ifdef"))
        elif word == "else" and stack:
            stack[-1] = not stack[-1]
        elif word == "endif" and stack:
            stack.pop()
        result.append(line if shows or match else re.sub(r"[^\n]", " ", line))
    return "".join(result)
