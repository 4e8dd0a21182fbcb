# SPDX-License-Identifier: Apache-2.0
"""The deepest path of each stack: the call graph, with what the compiler cannot know of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated

from keel.boards.call_graph import Code, Graph, StackError, complete
from keel.config import Field, Mistake, Table, Text

TABLE = "specs/stack.toml"
TASKS = "tasks"

# Eight registers, the FPU's sixteen, its status and a reserved word, and the word that aligns them
# (ARMv7-M Architecture Reference Manual, B1.5.7).
EXCEPTION_FRAME_B = 8 * 4 + 18 * 4 + 4


# --- The table -----------------------------------------------------------------------------------


class Indirect(Table):
    """A function that calls through a pointer, and all that it may call."""

    caller: Text
    calls: list[Text]
    may_be_none: bool = False  # Whether an image may have none of them: the pointer is null there.
    reason: Text


class Entry(Table):
    """Where hardware or assembly enters: bytes on the stack already, and which stack it is."""

    function: Text
    bytes: Annotated[int, Field(ge=0)] = 0
    stack: Text = "main"


class StackTable(Table):
    """What the compiler cannot know."""

    tasks: list[Text] = []
    running: list[Text] = []
    indirect: list[Indirect] = []
    entry: Annotated[list[Entry], Field(min_length=1)]


def mistakes(table: StackTable) -> Iterator[Mistake]:
    """Callers that have two entries."""
    callers = [entry.caller for entry in table.indirect]
    for number, caller in enumerate(callers):
        if caller in callers[:number]:
            yield ("indirect", number, "caller"), f"{caller} has two entries"


def resolve(graph: Graph, table: StackTable) -> list[str]:
    """Put the table's calls into the graph; the titles of the tasks' bodies that are there."""

    def titles(name: str) -> list[str]:
        return [title for title, item in graph.items() if item.name == name]

    listed = {entry.caller: entry for entry in table.indirect}
    tasks = [title for name in table.tasks for title in titles(name)]
    for caller in sorted(name for name, function in graph.items() if function.indirect):
        name = graph[caller].name.partition(".")[0]  # A clone calls what its original calls.
        if name not in listed:
            raise StackError(f"{caller} calls through a pointer: {TABLE} does not say whom")
        targets: set[str] = set()
        for target in listed[name].calls:
            targets.update(tasks if target == TASKS else titles(target))
        if listed[name].calls and not targets and not listed[name].may_be_none:
            raise StackError(f"{caller}: none of what {TABLE} says it calls is in the image")
        graph[caller].calls |= targets
    return tasks


# --- Bounds --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Deepest:
    """The deepest path from a function: its bytes, and the functions on it."""

    bytes: int
    functions: tuple[str, ...]


class Bounds:
    """The deepest path from each function; computed once each."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self._known: dict[str, Deepest] = {}
        self._open: list[str] = []

    def of(self, title: str) -> Deepest:
        """The deepest path from a function."""
        if title in self._known:
            return self._known[title]
        if title in self._open:
            circle = [*self._open[self._open.index(title) :], title]
            raise StackError(f"recursion: {' -> '.join(circle)}")
        function = self.graph.get(title)
        if function is None or function.frame is None:
            raise StackError(f"{title}: its frame is not known")
        self._open.append(title)
        below = [self.of(target) for target in sorted(function.calls)]
        self._open.pop()
        deepest = max(below, key=lambda path: path.bytes, default=Deepest(0, ()))
        found = Deepest(function.frame + deepest.bytes, (title, *deepest.functions))
        self._known[title] = found
        return found

    @property
    def reached(self) -> set[str]:
        """The functions whose bounds were needed."""
        return set(self._known)


def check_reached(
    graph: Graph, reached: set[str], code: Mapping[str, Code], compiled: set[str]
) -> None:
    """Every function that was compiled must be on some path; else a call is missing in the graph.

    Of a library the linker takes whole objects: what nobody calls came with what is called.
    """
    names = {graph[title].name for title in reached}
    seen = {id(item) for name, item in code.items() if name in names}
    missing = sorted(
        name for name, item in code.items() if id(item) not in seen and name in compiled
    )
    if missing:
        raise StackError(
            f"in the image, but nobody calls them: {', '.join(missing)}; a call "
            f"through a pointer or an entry is missing in {TABLE}"
        )


def idle_code(
    graph: Graph, code: Mapping[str, Code], running: Iterable[str], names: Iterable[str]
) -> list[str]:
    """Of these functions, the ones that nobody calls while tasks run: on no path from what runs."""
    open_titles = [title for title, item in graph.items() if item.name in set(running)]
    seen = set(open_titles)
    while open_titles:
        new = graph[open_titles.pop()].calls - seen
        seen |= new
        open_titles += new
    called = {id(code[graph[title].name]) for title in seen if graph[title].name in code}
    return sorted(name for name in names if name in code and id(code[name]) not in called)


@dataclass(frozen=True)
class Stack:
    """A stack with its room and its deepest path, the exception's frame included."""

    name: str
    size: int
    bytes: int
    path: tuple[str, ...]


def analyse(
    graph: Graph, code: Mapping[str, Code], table: StackTable, sizes: Mapping[str, int]
) -> tuple[list[Stack], dict[str, Deepest], list[str]]:
    """The stacks, the bound of each task and the functions of libraries."""
    # Only what is in the image counts: the compiler also lists what the linker left out.
    for title in [title for title, item in graph.items() if item.name not in code]:
        del graph[title]
    for function in graph.values():
        function.calls &= graph.keys()
    compiled = {function.name for function in graph.values() if function.frame is not None}
    library = complete(graph, code)
    tasks = resolve(graph, table)
    bounds = Bounds(graph)
    stacks: list[Stack] = []
    for name, size in sizes.items():
        extra = EXCEPTION_FRAME_B if name == "main" else 0
        found = [
            Stack(name, size, entry.bytes + path.bytes + extra, path.functions)
            for entry in table.entry
            if entry.stack == name and entry.function in graph
            for path in [bounds.of(entry.function)]
        ]
        if not found:
            raise StackError(f"{TABLE} names no entry of this image on the stack {name}")
        stacks.append(max(found, key=lambda stack: stack.bytes))
    check_reached(graph, bounds.reached, code, compiled)
    return stacks, {graph[title].name: bounds.of(title) for title in tasks}, library
