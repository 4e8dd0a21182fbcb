# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel stack on small call graphs whose deepest paths are known."""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import os
import tempfile
import unittest
from pathlib import Path

from keel.base.errors import ToolError
from keel.base.run import output_of
from keel.base.source import PRODUCT, STAMP, stamp_of
from keel.boards import stack
from keel.boards.built import read_built
from keel.boards.call_graph import Code, Disassembler, Function, StackError, complete, parse
from keel.boards.elf import Contents, Symbol, read_contents
from keel.boards.stack_bounds import (
    TABLE,
    Bounds,
    Entry,
    Indirect,
    StackTable,
    analyse,
    idle_code,
    mistakes,
)
from keel.config import read_toml
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]


def node(title: str, frame: str = "") -> str:
    """A function as the compiler writes it; without a frame, one that it only calls."""
    name = title.rpartition(":")[2]
    if not frame:
        return f'node: {{ title: "{title}" label: "{name}\\nx.h:1:1" shape : ellipse }}'
    return f'node: {{ title: "{title}" label: "{name}\\nx.c:1:1\\n{frame}\\n0 dynamic objects" }}'


def edge(source: str, target: str) -> str:
    return f'edge: {{ sourcename: "{source}" targetname: "{target}" label: "x.c:2:2" }}'


def graph_of(*lines: str) -> dict[str, Function]:
    graph: dict[str, Function] = {}
    parse("\n".join(lines), graph, "x.c")
    return graph


# reset -> main -> (left -> deep) or right; left is the shorter frame, but deeper below.
DIAMOND = (
    node("reset", "8 bytes (static)"),
    node("main", "16 bytes (static)"),
    edge("reset", "main"),
    node("x.c:left", "8 bytes (static)"),
    edge("main", "x.c:left"),
    node("x.c:right", "40 bytes (static)"),
    edge("main", "x.c:right"),
    node("deep"),
    edge("x.c:left", "deep"),
)
DEEP = node("deep", "64 bytes (static)")
SIZES = {"main": 1024}
RESET = Entry(function="reset")


def table_of(
    tasks: tuple[str, ...] = (),
    indirect: dict[str, tuple[str, ...]] | None = None,
    entries: tuple[Entry, ...] = (RESET,),
) -> StackTable:
    """A table."""
    calls = [
        Indirect(caller=name, calls=[*them], reason="r") for name, them in (indirect or {}).items()
    ]
    return StackTable(tasks=[*tasks], indirect=calls, entry=[*entries])


class GraphTest(unittest.TestCase):
    def test_frames_and_calls(self) -> None:
        graph = graph_of(*DIAMOND, DEEP)
        self.assertEqual(graph["main"].frame, 16)
        self.assertEqual(graph["main"].calls, {"x.c:left", "x.c:right"})
        self.assertEqual((graph["x.c:left"].name, graph["x.c:left"].file), ("left", "x.c"))
        self.assertEqual(graph["deep"].frame, 64)

    def test_the_deepest_path_not_the_widest_frame(self) -> None:
        path = Bounds(graph_of(*DIAMOND, DEEP)).of("reset")
        self.assertEqual(path.bytes, 8 + 16 + 8 + 64)
        self.assertEqual(path.functions, ("reset", "main", "x.c:left", "deep"))

    def test_recursion_is_an_error(self) -> None:
        graph = graph_of(*DIAMOND, DEEP, edge("deep", "main"))
        with self.assertRaisesRegex(StackError, "recursion: main -> x.c:left -> deep -> main"):
            Bounds(graph).of("reset")

    def test_a_function_that_calls_itself_is_an_error(self) -> None:
        graph = graph_of(node("a", "8 bytes (static)"), edge("a", "a"))
        with self.assertRaisesRegex(StackError, "recursion: a -> a"):
            Bounds(graph).of("a")

    def test_a_frame_without_a_bound_is_an_error(self) -> None:
        with self.assertRaisesRegex(StackError, "the frame of a has no bound .dynamic"):
            graph_of(node("a", "8 bytes (dynamic)"))
        self.assertEqual(graph_of(node("a", "8 bytes (dynamic,bounded)"))["a"].frame, 8)

    def test_a_function_defined_twice_is_an_error(self) -> None:
        with self.assertRaisesRegex(StackError, "a is defined twice"):
            graph_of(node("a", "8 bytes (static)"), node("a", "8 bytes (static)"))

    def test_an_unknown_function_is_an_error(self) -> None:
        with self.assertRaisesRegex(StackError, "deep: its frame is not known"):
            Bounds(graph_of(*DIAMOND)).of("reset")


ASSEMBLY = """
.syntax unified
.cpu cortex-m7
.fpu fpv5-d16
.thumb
.macro function name
.type \\name, %function
\\name:
.endm

function deep
    stmdb sp!, {r4, r5, r6, r7, r8, r9, sl, lr}
    vpush {d8-d9}
    sub sp, #12
    str lr, [sp, #-4]!
    bl deeper
    bls.n inside
    bl __other_veneer
inside:
    add sp, #12
    ldr r5, [sp, #32]
    ldr r0, number
    ldmia sp!, {r4, r5, r6, r7, r8, r9, sl, pc}
number:
    .word 0xb0ffb0ff    @ Data: as instructions they would move the stack pointer.
.size deep, . - deep

function __other_veneer
    b.w other
.size __other_veneer, . - __other_veneer

.hidden deeper          @ No size, as in libraries.
function deeper
    push {r4-r6, lr}
    bx lr

.globl alias
.thumb_set alias, other
function other
    b.w deeper
.size other, . - other

function single
    vpush {s16-s19}
    strd r0, r1, [sp, #-16]!
    bx lr
.size single, . - single

function dynamic
    sub.w sp, sp, r3
    bx lr
.size dynamic, . - dynamic

.data
.type table, %object
table:
    .word 0
.size table, . - table
"""


class CodeTest(unittest.TestCase):
    code: dict[str, Code]

    @classmethod
    def setUpClass(cls) -> None:
        tools = Toolchain()
        tools.ensure("firmware", "stack")
        with tempfile.TemporaryDirectory(prefix="keel-test-") as folder:
            source, elf = Path(folder, "code.s"), Path(folder, "code.elf")
            source.write_text(ASSEMBLY)
            gcc = tools.command("arm-none-eabi-gcc")
            output_of([*gcc, "-nostdlib", "-Wl,-Ttext=0x8000100,-e,deep", source, "-o", elf])
            contents = read_contents(tools, elf)
        cls.code = Disassembler(tools, contents).functions()

    def test_every_push_is_counted(self) -> None:
        self.assertEqual(self.code["deep"].pushed, 8 * 4 + 2 * 8 + 12 + 4)
        self.assertEqual(self.code["deeper"].pushed, 16)

    def test_calls_are_found_also_through_a_veneer(self) -> None:
        self.assertEqual(self.code["deep"].calls, {"deeper", "other"})
        self.assertEqual(self.code["alias"].calls, {"deeper"})

    def test_single_registers_of_the_fpu_and_pairs(self) -> None:
        self.assertEqual(self.code["single"].pushed, 16 + 16)

    def test_a_frame_of_a_size_in_a_register_is_an_error(self) -> None:
        graph = graph_of(*DIAMOND, node("dynamic"), edge("main", "dynamic"))
        code = {**self.code, **dict.fromkeys(("reset", "main", "left", "right"), Code())}
        self.assertEqual(code["deep"].unbounded, "")
        unbounded = "dynamic: the frame has no bound .sub.* sp, sp, r3"
        with self.assertRaisesRegex(StackError, unbounded):
            complete(graph, code)

    def test_a_library_function_gets_its_frame_and_calls(self) -> None:
        graph = graph_of(*DIAMOND)
        self.assertEqual(complete(graph, self.code), ["deep", "deeper", "other"])
        self.assertEqual(Bounds(graph).of("reset").bytes, 8 + 16 + 8 + 64 + 16)

    def test_functions_of_an_image(self) -> None:
        names = {"deep", "deeper", "other", "alias", "single", "dynamic"}
        self.assertEqual(set(self.code), names)
        self.assertIs(self.code["other"], self.code["alias"])


class AnalysisTest(unittest.TestCase):
    def analyse(
        self, *lines: str, table: StackTable | None = None, more: tuple[str, ...] = ()
    ) -> tuple[int, dict[str, int]]:
        graph = graph_of(*DIAMOND, DEEP, *lines)
        names = [function.name for function in graph.values()]
        code = {name: Code() for name in (*names, *more)}
        stacks, tasks, _ = analyse(graph, code, table or table_of(), SIZES)
        return stacks[0].bytes, {name: path.bytes for name, path in tasks.items()}

    def test_the_exceptions_frame_is_added(self) -> None:
        # Eight registers, sixteen of the FPU with two words more, and one that aligns them.
        self.assertEqual(self.analyse()[0], 96 + 32 + 72 + 4)

    def test_an_indirect_call_without_an_entry_is_an_error(self) -> None:
        with self.assertRaisesRegex(StackError, "main calls through a pointer"):
            self.analyse(edge("main", "__indirect_call"))

    def test_an_indirect_call_takes_the_deepest_target(self) -> None:
        table = table_of(("work",), {"main": ("clock", "tasks")})
        bytes_, tasks = self.analyse(
            edge("main", "__indirect_call"),
            node("clock", "4 bytes (static)"),
            node("y.c:work", "100 bytes (static)"),
            edge("y.c:work", "deep"),
            table=table,
        )
        self.assertEqual(bytes_, 8 + 16 + 100 + 64 + 108)
        self.assertEqual(tasks, {"work": 164})

    def test_a_clone_calls_what_its_original_calls(self) -> None:
        table = table_of((), {"f": ("g",)})
        bytes_, _ = self.analyse(
            node("x.c:f.constprop.0", "8 bytes (static)"),
            edge("main", "x.c:f.constprop.0"),
            edge("x.c:f.constprop.0", "__indirect_call"),
            node("g", "200 bytes (static)"),
            table=table,
        )
        self.assertEqual(bytes_, 8 + 16 + 8 + 200 + 108)

    def test_targets_that_are_not_there_are_an_error(self) -> None:
        table = table_of((), {"main": ("gone",)})
        with self.assertRaisesRegex(StackError, "none of what .* is in the image"):
            self.analyse(edge("main", "__indirect_call"), table=table)

    def test_targets_that_are_not_there_are_right_where_the_table_says_so(self) -> None:
        gone = Indirect(caller="main", calls=["gone"], may_be_none=True, reason="r")
        table = StackTable(indirect=[gone], entry=[RESET])
        bytes_, _ = self.analyse(edge("main", "__indirect_call"), table=table)
        self.assertEqual(bytes_, 8 + 16 + 8 + 64 + 108)

    def test_recursion_through_a_pointer_is_an_error(self) -> None:
        table = table_of((), {"deep": ("main",)})
        with self.assertRaisesRegex(StackError, "recursion"):
            self.analyse(edge("deep", "__indirect_call"), table=table)

    def test_a_function_that_nobody_calls_is_an_error(self) -> None:
        with self.assertRaisesRegex(StackError, "nobody calls them: forgotten"):
            self.analyse(node("forgotten", "4 bytes (static)"))

    def test_what_comes_with_a_librarys_object_is_not_called(self) -> None:
        graph = graph_of(*DIAMOND, DEEP)
        code = {name: Code() for name in ("reset", "main", "left", "right", "deep", "neighbour")}
        stacks, _, _ = analyse(graph, code, table_of(), SIZES)
        self.assertEqual(stacks[0].bytes, 96 + 108)

    def test_what_the_linker_left_out_does_not_count(self) -> None:
        graph = graph_of(*DIAMOND, DEEP, node("out", "900 bytes (static)"), edge("main", "out"))
        code = {name: Code() for name in ("reset", "main", "left", "right", "deep")}
        stacks, _, _ = analyse(graph, code, table_of(), SIZES)
        self.assertEqual(stacks[0].bytes, 96 + 108)

    def test_an_entry_begins_with_what_is_there_already(self) -> None:
        table = table_of(entries=(RESET, Entry(function="handler", bytes=32, stack="fault")))
        graph = graph_of(*DIAMOND, DEEP, node("handler", "40 bytes (static)"))
        code = {function.name: Code() for function in graph.values()}
        stacks, _, _ = analyse(graph, code, table, {"main": 1024, "fault": 64})
        self.assertEqual(
            [(item.name, item.bytes) for item in stacks], [("main", 204), ("fault", 72)]
        )

    def test_a_stack_without_an_entry_is_an_error(self) -> None:
        with self.assertRaisesRegex(StackError, "no entry of this image on the stack main"):
            self.analyse(table=table_of(entries=(Entry(function="other"),)))


class IdleTest(unittest.TestCase):
    """Code in ITCM that nobody calls while tasks run."""

    def idle(self, *names: str) -> list[str]:
        graph: dict[str, Function] = {}
        text = "\n".join(
            [
                *(
                    node(name, "8 bytes (static)")
                    for name in ("start", "step", "task", "a.c:twice")
                ),
                edge("start", "step"),
                edge("step", "task"),
                edge("task", "a.c:twice"),
                edge("a.c:twice", "step"),
            ]
        )
        parse(text, graph)
        code = {name: Code() for name in ("start", "step", "task", "twice", "alone")}
        code["also_task"] = code["task"]  # Another name of it.
        return idle_code(graph, code, ["step"], names)

    def test_what_runs_calls_is_not_idle(self) -> None:
        self.assertEqual(self.idle("step", "task", "twice", "also_task"), [])

    def test_what_the_start_alone_calls_is_idle(self) -> None:
        self.assertEqual(self.idle("task", "start", "alone"), ["alone", "start"])

    def test_what_is_not_in_the_image_does_not_count(self) -> None:
        self.assertEqual(self.idle("absent"), [])


class FilesTest(unittest.TestCase):
    def setUp(self) -> None:
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        for folder in PRODUCT:
            (self.root / folder).mkdir()

    def table(self, text: str) -> StackTable:
        path = self.root / "stack.toml"
        path.write_text(text)
        return read_toml(path, StackTable, mistakes)

    def test_the_projects_table_can_be_read(self) -> None:
        table = read_toml(ROOT / TABLE, StackTable, mistakes)
        self.assertIn("keel_scheduler_step", [item.caller for item in table.indirect])
        self.assertEqual({entry.stack for entry in table.entry}, {"main", "fault"})

    def test_bad_tables_are_refused(self) -> None:
        entry = '[[entry]]\nfunction = "reset"\n'
        unexplained = '[[indirect]]\ncaller = "a"\ncalls = ["b"]'
        indirect = '[[indirect]]\ncaller = "a"\ncalls = []\nreason = "r"\n'
        bad = {
            "": "toml: entry: is missing",
            "entry = []": "toml:1: entry: expected to have at least 1 item",
            entry + "[other]": "toml:3: other: unknown key",
            "tasks = [": "toml:1: no TOML: ",
            entry + unexplained: "toml:3: indirect number 1: reason: is missing",
            entry + indirect * 2: "toml:8: indirect number 2: caller: a has two entries",
            '[[entry]]\nname = "reset"': "toml:1: entry reset: function: is missing",
        }
        for text, reason in bad.items():
            with self.assertRaisesRegex(ToolError, reason):
                self.table(text)

    def test_no_image_says_what_to_run(self) -> None:
        with self.assertRaisesRegex(ToolError, "run: make firmware BOARD=some"):
            read_built(self.root, "some")

    def test_too_little_room_fails_and_is_reported(self) -> None:
        report = {
            "board": "some",
            "functions": 3,
            "tasks": {"work": {"bound": 10, "path": ["work"]}},
            "stacks": {"main": {"size": 100, "bound": 101, "path": ["reset", "x.c:work"]}},
        }
        with contextlib.redirect_stdout(io.StringIO()) as out:
            self.assertEqual(stack.conclude(report, self.root), 1)
        self.assertIn("101 of 100 bytes: reset > work", out.getvalue())
        self.assertIn("TOO LITTLE ROOM: main", out.getvalue())
        written = json.loads((self.root / stack.REPORT / "some.json").read_text())
        self.assertEqual(written, {**report, "verdict": "failed", STAMP: stamp_of(self.root)})

    def test_a_painted_stack_below_and_above_the_bound(self) -> None:
        report = {
            "board": "some",
            "functions": 3,
            "tasks": {},
            "painted": 92,
            "stacks": {"main": {"size": 500, "bound": 200, "path": ["reset"]}},
        }
        with contextlib.redirect_stdout(io.StringIO()) as out:
            self.assertEqual(stack.conclude(report, self.root), 0)
            self.assertEqual(stack.conclude({**report, "painted": 93}, self.root), 1)
        self.assertIn("92 of the 92 bytes bounded", out.getvalue())
        self.assertIn("THE BOUND IS WRONG", out.getvalue())

    def test_only_a_run_of_this_image_counts(self) -> None:
        elf, path = self.root / "keel.elf", self.root / stack.PAINTED
        elf.write_bytes(b"image")
        self.assertIsNone(stack.painted(self.root, "some", elf))
        path.parent.mkdir(parents=True)
        digest = hashlib.sha256(b"image").hexdigest()
        ran = {"used": {"demo": 256}, "demo_sha256": digest}
        path.write_text(json.dumps({"board": "some", "painted_stack": ran}))
        os.utime(path, (0, 0))  # Linked again since, to the same bits.
        self.assertEqual(stack.painted(self.root, "some", elf), 256)
        self.assertIsNone(stack.painted(self.root, "other", elf))
        elf.write_bytes(b"another image")
        self.assertIsNone(stack.painted(self.root, "some", elf))

    def test_a_stack_that_was_not_compared_is_told(self) -> None:
        report = {
            "board": "some",
            "functions": 3,
            "tasks": {},
            "painted": None,
            "stacks": {"main": {"size": 500, "bound": 200, "path": ["reset"]}},
        }
        with contextlib.redirect_stdout(io.StringIO()) as out:
            self.assertEqual(stack.conclude(report, self.root), 0)
        self.assertIn("not compared", out.getvalue())

    def test_sizes_of_the_stacks(self) -> None:
        places = {
            "keel_stack_bottom": 0x400,
            "keel_stack_top": 0x4400,
            "keel_fault_stack_top": 0x4800,
        }
        contents = Contents(
            0,
            symbols=[
                Symbol(name, 0x2000_0000 + at, 0, False, ".stack", "")
                for name, at in places.items()
            ],
        )
        self.assertEqual(stack.stack_sizes(contents), {"main": 0x4000, "fault": 0x400})
        with self.assertRaisesRegex(ToolError, "no symbol keel_stack_top"):
            stack.stack_sizes(Contents(0))
