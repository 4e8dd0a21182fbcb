# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel lint: each rule with a text that breaks it and one that does not.

The last class runs clang-format and Cppcheck on small projects of its own.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import tempfile
import threading
import unittest
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from keel.base.errors import ToolError
from keel.base.source import STAMP, files_below, stamp_of
from keel.install import Toolchain
from keel.lint import command as lint
from keel.lint import house, misra, models, prose, record, unit_tables
from keel.lint.misra import Deviation, Violation
from keel.lint.texts import Finding, Text

ROOT = Path(__file__).resolve().parents[2]


def text(path: str, *lines: str) -> Text:
    return Text(path, list(lines))


def places(findings: object) -> list[tuple[str, int]]:
    assert isinstance(findings, list)
    return [(finding.file, finding.line) for finding in findings]


class UnitTablesTest(unittest.TestCase):
    """No tool has a table of units."""

    UNITS = ("pid", "mixer", "log_ring", "log", "crsf", "rotor")
    NAMES = ("pid", "mixer", "log_ring", "crsf", "rotor")

    def lines(self, *source: str, path: str = "tools/keel/test/a.py") -> list[int]:
        headers = [text(f"include/keel/flight/{unit}.h", "") for unit in self.UNITS]
        found = unit_tables.check_unit_tables([*headers, text(path, *source)])
        return [one.line for one in found]

    def test_tables_however_they_name_units(self) -> None:
        steps = ", ".join(f'("a {name}", "keel_{name}_step", 3)' for name in self.NAMES)
        files = ", ".join(f'"specs/model/{name}.c"' for name in self.NAMES)
        tests = ", ".join(f'"unit/{name}_specified": 5.0' for name in self.NAMES)
        for table in (repr(self.NAMES), f"[{steps}]", f"{{{files}}}", f"{{{tests}}}"):
            self.assertEqual(self.lines("X = 1", f"Y = {table}"), [2], table)

    def test_a_table_is_told_once_with_its_units(self) -> None:
        headers = [text(f"include/keel/flight/{unit}.h", "") for unit in self.UNITS]
        tool = text("tools/keel/a.py", f"X = {{'all': {self.NAMES}, 'more': []}}")
        (found,) = unit_tables.check_unit_tables([*headers, tool])
        self.assertEqual(
            found.reason, "a table of units, which is data: crsf, log_ring, mixer, pid, rotor, ..."
        )

    def test_few_units_and_other_words_are_none(self) -> None:
        self.assertEqual(self.lines(f"X = {self.NAMES[:4]}"), [])
        self.assertEqual(self.lines(f"X = {('log', *self.NAMES[:3], 'pidgin', 'remixer')}"), [])
        self.assertEqual(self.lines(f"X = {[name.upper() for name in self.NAMES]}"), [])

    def test_tests_may(self) -> None:
        self.assertEqual(self.lines(f"X = {self.NAMES}", path="tests/tools/test_a.py"), [])


class OrderTest(unittest.TestCase):
    """The order of layers and units."""

    def test_a_file_that_is_refused(self) -> None:
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        good = (ROOT / house.ORDER).read_text(encoding="utf-8")
        for old, new, reason in (
            ('["queue"]', '["quue"]', "layers.toml:6: rtos number 3: there is no header of quue"),
            ('["queue"]', '["task"]', "task stands twice"),
            ("layers = [", "layer = [", "unknown key; did you mean layers?"),
        ):
            (folder / "layers.toml").write_text(good.replace(old, new), encoding="utf-8")
            with self.subTest(new), self.assertRaises(ToolError) as caught:
                house.read_order(folder / "layers.toml")
            self.assertIn(reason, str(caught.exception))


class ModelTest(unittest.TestCase):
    """The rules of the executable specification."""

    HEADER = text("specs/model/box.h", "keel_status_t model_box_put(keel_box_t *box, uint32_t n);")
    ABOVE = (
        text("include/keel/rtos/box.h", ""),
        text("include/keel/flight/plane.h", ""),
        text("specs/model/plane.h", ""),
    )

    def findings(self, *body: str, before: tuple[str, ...] = ()) -> list[str]:
        source = text(
            "specs/model/box.c",
            *before,
            "keel_status_t model_box_put(keel_box_t *box, uint32_t n)",
            "{",
            *body,
            "}",
        )
        texts = [self.HEADER, *self.ABOVE, source]
        return [one.reason for one in models.check_models(texts, house.read_order().layers)]

    def test_a_model_that_keeps_them(self) -> None:
        self.assertEqual(
            self.findings(
                "if (n > 3u) {",
                "return KEEL_ERR_FULL;",
                "}",
                "for (uint32_t i = 0u; i < n; i++) {",
                "box->side[i] = other(i);",
                "}",
                "for (uint32_t i = 0u; i < 64u; i += 8u) {",
                "if (box->side[i] > n) {",
                "return KEEL_OK;",
                "}",
                "}",
                "switch (n) {",
                "case 1u:",
                "break;",
                "}",
                "box->count = n;",
                "return KEEL_OK;",
                before=("static const uint8_t table[2] = {1u, 2u};", '#include "box.h"'),
            ),
            [],
        )

    def test_what_breaks_one(self) -> None:
        for body, why in (
            ("keel_box_add(box);", "keel_box_add is of the code: a model calls models"),
            ("while (n > 0u) {\n}", "this loop does not count to a bound that it leaves"),
            ("for (;;) {\n}", "this loop does not count to a bound that it leaves"),
            ("for (uint32_t i = 0u; i < n; i++) {\nn = n + 1u;\n}", "this loop does not count"),
            ("for (uint32_t i = 0u; i < n; i++) {\ni = 0u;\n}", "this loop does not count"),
            ("for (uint32_t i = 0u; i < box->n; i++) {\nbox->n = 9u;\n}", "does not count to"),
            ("for (uint32_t i = 0u; i < n; i++) {\nbreak;\n}", "a loop is left early"),
            ("for (uint32_t i = 0u; i < n; i++) {\nreturn;\n}", "a loop is left early"),
            ("static uint32_t calls;", "static data: static uint32_t calls;"),
            (
                "box->count = n;\nif (n > 3u) {\nreturn KEEL_ERR_FULL;\n}",
                "model_box_put writes before it refuses",
            ),
        ):
            with self.subTest(body):
                found = self.findings(*body.split("\n"))
                self.assertTrue(any(why in one for one in found), found)

    def test_a_refusal_that_writes_names_its_requirement(self) -> None:
        refusal = "return KEEL_ERR_FULL; /* BOX-001 */"
        self.assertEqual(self.findings("box->count = n;", refusal), [])

    def test_data_includes_and_declarations_at_file_level(self) -> None:
        for line, why in (
            ("uint32_t calls;", "static data: uint32_t calls;"),
            ('#include "plane.h"', "plane stands above: a model calls those below"),
            ("void model_box_shut(void)\n{\n}", "model_box_shut is not declared in box.h"),
        ):
            with self.subTest(line):
                self.assertEqual(self.findings(before=tuple(line.split("\n"))), [why])

    def test_what_is_declared_is_said(self) -> None:
        found = [
            one.reason for one in models.check_models([self.HEADER], house.read_order().layers)
        ]
        why = "model_box_put is declared, and no source of box says what it does"
        self.assertEqual(found, [why])


class HouseTest(unittest.TestCase):
    """One rule, one text."""

    def lines_of(self, check: Callable[[Text], Iterator[Finding]], item: Text) -> list[int]:
        return [finding.line for finding in check(item)]

    def test_unfinished_work_is_found(self) -> None:
        item = text("a.md", "done", "TO" + "DO: more", "fix" + "me in prose", "(FIX" + "ME)")
        self.assertEqual(self.lines_of(house.check_words, item), [2, 4])

    def test_a_path_of_one_machine_is_found(self) -> None:
        item = text("a.md", "see /ro" + "ot/x", "cd /wo" + "rk/x", "/ho" + "me/ann/y", "src/work/z")
        self.assertEqual(self.lines_of(house.check_words, item), [1, 2, 3])

    def test_the_name_of_a_registry_is_found(self) -> None:
        item = text(
            "a.yml", "url: https://py" + "pi.org/simple", "pip install x", "FROM gh" + "cr.io/a"
        )
        self.assertEqual(self.lines_of(house.check_words, item), [1, 3])

    def test_the_linter_does_not_find_itself(self) -> None:
        for name in ("tools/keel/lint/house.py", "tests/tools/test_lint.py"):
            lines = (ROOT / name).read_text().splitlines()
            self.assertEqual(list(house.check_words(Text(name, lines))), [])

    def test_100_columns_are_allowed_101_are_not(self) -> None:
        item = text("src/a.c", "x" * 100, "x" * 101)
        self.assertEqual(self.lines_of(house.check_length, item), [2])
        self.assertEqual(self.lines_of(house.check_length, text("a.json", "x" * 101)), [])

    def test_admit_and_axiom_are_found_in_annotations(self) -> None:
        item = text(
            "src/rtos/a.c",
            "//@ admit x > 0;",
            "/*@ requires \\true;",
            "  @ axiom zero: \\false;",
            "  @*/",
        )
        self.assertEqual(self.lines_of(house.check_unproved, item), [1, 3])

    def test_admit_in_prose_and_in_names_is_no_matter(self) -> None:
        item = text(
            "src/rtos/a.c",
            "/* Refuses to admit what it cannot prove: no axiom. */",
            "/*@ // Whether to admit the task.",
            "  @ ensures keel_admission_admit_ok: \\true; // no axiom",
            "  @*/",
            "status = admit(task);",
        )
        self.assertEqual(self.lines_of(house.check_unproved, item), [])

    def test_axioms_outside_the_kernel_count_in_proofs_alone(self) -> None:
        self.assertEqual(self.lines_of(house.check_unproved, text("proofs/a.why", "axiom x")), [1])
        self.assertEqual(
            self.lines_of(house.check_unproved, text("proofs/a.c", "//@ admit x;")), [1]
        )
        self.assertEqual(self.lines_of(house.check_unproved, text("tests/a.c", "//@ admit x;")), [])

    def test_the_kernel_must_not_know_a_prover(self) -> None:
        item = text("src/rtos/a.c", "#ifdef __FRAMAC__", "__CPROVER_assume(x);", "#endif")
        self.assertEqual(self.lines_of(house.check_prover, item), [1, 2])
        self.assertEqual(self.lines_of(house.check_prover, text("proofs/a.c", item.lines[1])), [])

    def test_the_guard_is_named_after_the_path(self) -> None:
        good = ["/** text */", "#ifndef KEEL_RTOS_A_H", "#define KEEL_RTOS_A_H", "int a;", "#endif"]
        self.assertEqual(self.lines_of(house.check_guard, Text("include/keel/rtos/a.h", good)), [])
        self.assertEqual(self.lines_of(house.check_guard, Text("include/keel/rtos/b.h", good)), [2])
        self.assertEqual(self.lines_of(house.check_guard, text("include/keel/a.h", "int a;")), [1])
        open_end = [*good[:4], "#endif", "#if 1", "int b;"]
        item = Text("include/keel/rtos/a.h", open_end)
        self.assertEqual(self.lines_of(house.check_guard, item), [2])


class ProseTest(unittest.TestCase):
    """Plain English in documents and in the kernel's comments."""

    def lines_of(self, path: str, *lines: str) -> list[int]:
        return [finding.line for finding in prose.check_prose([text(path, *lines)])]

    def test_a_sentence_that_begins_with_what_or_who_is_found(self) -> None:
        for line in (
            "What is left CBMC checks.",
            "All is well. Who knows it can tell.",
            "- **What holds.** All.",
            "1. What is left:",
            "| a | What is left |",
            "(What is more.)",
            "Why so? What is\nleft, is checked.",
        ):
            with self.subTest(line):
                self.assertEqual(self.lines_of("docs/a.md", "", *line.split("\n")), [2])

    def test_a_question_a_title_and_code_are_allowed(self) -> None:
        self.assertEqual(
            self.lines_of(
                "docs/a.md",
                "# What is proved",
                "What happens then? It ends.",
                "Look what it does.",
                "[What is proved](proved.md) has all.",
                "Whatever comes is taken.",
                "```",
                "What.",
                "```",
                "See `What.`",
                "It says what it is.",
            ),
            [],
        )

    def test_comments_of_the_kernel_are_prose_and_clauses_are_not(self) -> None:
        path = "include/keel/rtos/a.h"
        self.assertEqual(
            self.lines_of(
                path,
                "/*@ // What a step keeps.",
                "  @ predicate What(integer a) = a > 0; // The words go on here. Who",
                "  @ // has it? Nobody.",
                "  @*/",
                "int a; /**< What it is. */",
                "/**",
                " * @brief What is here.",
                " *",
                " * Its size |q|",
                " * is |What.| long.",
                " */",
                "// What else.",
                'const char *b = "/* What. */";',
                "/* Whether it is. What",
                " * is next? */",
            ),
            [1, 5, 7, 12],
        )
        self.assertEqual(self.lines_of("tests/unit/a.c", "/* What it is. */"), [])

    def test_a_finding_names_file_line_and_sentence(self) -> None:
        found = list(prose.check_prose([text("a.md", "Good.", "", "So. What is", "left, stays.")]))
        self.assertEqual(
            [str(one) for one in found],
            ["a.md:3: a sentence begins with What or Who: What is left, stays."],
        )

    def test_a_word_may_be_rare_and_not_frequent(self) -> None:
        rest = " ".join(["word"] * 9999)
        self.assertEqual(self.lines_of("a.md", rest, "It stands alone."), [])
        self.assertEqual(
            self.lines_of("a.md", rest + ".", "It stands alone.", "Alone, it falls."), [2, 3]
        )
        self.assertEqual(self.lines_of("src/a.c", "/* It stands alone. */"), [])
        self.assertEqual(self.lines_of("proofs/determined.md", "It stands alone. What?"), [])


class IncludeTest(unittest.TestCase):
    """Arrows point down only."""

    def reason(self, path: str, header: str, quoted: bool = True) -> str:
        return house.include_reason(path, quoted, header)

    def test_down_is_allowed(self) -> None:
        for path, header in (
            ("include/keel/rtos/task.h", "keel/rtos/clock.h"),
            ("include/keel/rtos/queue.h", "keel/status.h"),
            ("src/rtos/queue.c", "keel/rtos/queue.h"),
            ("src/rtos/queue.c", "keel/internal/rtos/queue.h"),
            ("include/keel/internal/rtos/queue.h", "keel/rtos/queue.h"),
            ("include/keel/internal/rtos/queue.h", "keel/internal/rtos/task.h"),
            ("include/keel/flight/pid.h", "keel/rtos/clock.h"),
            ("src/flight/pid.c", "keel/flight/filter.h"),
        ):
            self.assertEqual(self.reason(path, header), "", (path, header))
        self.assertEqual(self.reason("src/rtos/a.c", "stdint.h", quoted=False), "")

    def test_up_sideways_and_outside_are_refused(self) -> None:
        for path, header in (
            ("include/keel/rtos/clock.h", "keel/rtos/task.h"),
            ("include/keel/rtos/queue.h", "keel/rtos/scheduler.h"),
            ("src/rtos/admission.c", "keel/rtos/decision.h"),
            ("include/keel/rtos/queue.h", "keel/internal/rtos/queue.h"),
            ("include/keel/rtos/queue.h", "keel/internal/rtos/task.h"),
            ("include/keel/internal/rtos/task.h", "keel/internal/rtos/queue.h"),
            ("include/keel/internal/rtos/task.h", "keel/rtos/queue.h"),
            ("src/rtos/task.c", "keel/flight/pid.h"),
            ("src/middleware/voter.c", "keel/flight/pid.h"),
            ("src/rtos/task.c", "bsp/board.h"),
            ("src/rtos/unknown.c", "keel/rtos/clock.h"),
        ):
            self.assertNotEqual(self.reason(path, header), "", (path, header))
        self.assertNotEqual(self.reason("src/rtos/a.c", "stdio.h", quoted=False), "")

    def test_findings_name_the_line(self) -> None:
        item = text(
            "src/rtos/clock.c", '#include "keel/rtos/clock.h"', '#  include "keel/rtos/task.h"'
        )
        self.assertEqual([finding.line for finding in house.check_includes(item)], [2])

    def test_a_header_that_no_source_includes_is_found(self) -> None:
        texts = [
            text("include/keel/rtos/a.h", '#include "keel/rtos/b.h"'),
            text("include/keel/rtos/b.h"),
            text("include/keel/rtos/c.h", '#include "keel/rtos/a.h"'),
            text("src/rtos/a.c", '#include "keel/rtos/a.h"'),
        ]
        self.assertEqual(places(list(house.check_reached(texts))), [("include/keel/rtos/c.h", 1)])


class DeclarationTest(unittest.TestCase):
    """A task's declaration in an example is an object of its own."""

    def lines_of(self, path: str, *lines: str) -> list[int]:
        return [finding.line for finding in house.check_declarations(text(path, *lines))]

    def test_a_declaration_in_a_structure_or_on_the_stack_is_found(self) -> None:
        lines = (
            "typedef struct demo_task {",
            "    keel_task_config_t config;",
            "} demo_task_t;",
            "    const keel_task_config_t config = {0};",
            "    keel_task_config_t row[2];",
            "keel_task_config_t shared;",
        )
        self.assertEqual(self.lines_of("examples/urpilot/demo.c", *lines), [2, 4, 5, 6])
        self.assertEqual(self.lines_of("tests/unit/actors.h", *lines), [])

    def test_objects_pointers_and_values_are_allowed(self) -> None:
        lines = (
            "static const keel_task_config_t gyro = {",
            "static keel_task_config_t declaration[TASKS] IN_DTCM;",
            "    const keel_task_config_t *declaration;",
            "static void add(const keel_task_config_t *task)",
            "keel_task_config_t set_task_config(uint32_t row);",
            "    return (keel_task_config_t){.name = task->name,",
        )
        self.assertEqual(self.lines_of("examples/urpilot/demo.c", *lines), [])


def deviation(
    name: str = "MD-001", rule: str = "15.5", line: str = "", marked: bool = False
) -> Deviation:
    return Deviation(name, rule, "reason", ("src/",), line, marked, 7)


class JudgeTest(unittest.TestCase):
    """Which violations stand, and which deviations are of no use."""

    SOURCE = text("src/a.c", "a", "return 1; /* MISRA deviation MD-001 */", "return 2;", "b")

    def judge(self, violations: list[Violation], *deviations: Deviation) -> list[tuple[str, int]]:
        return places(list(misra.judge(violations, deviations, [self.SOURCE])))

    def test_a_violation_without_a_deviation_stands(self) -> None:
        source = text("src/a.c", "return 1;")
        found = list(misra.judge([Violation("src/a.c", 1, "15.5", "m")], [], [source]))
        self.assertEqual(found, [Finding("src/a.c", 1, "15.5: m")])

    def test_a_mark_covers_its_line_and_the_next(self) -> None:
        violations = [Violation("src/a.c", line, "15.5", "m") for line in (1, 2, 3, 4)]
        found = self.judge(violations, deviation(marked=True))
        self.assertEqual(found, [("src/a.c", 1), ("src/a.c", 4)])

    def test_a_mark_covers_its_own_rule_alone(self) -> None:
        violations = [Violation("src/a.c", 2, rule, "m") for rule in ("15.5", "15.6", "15.50")]
        self.assertEqual(len(self.judge(violations, deviation(marked=True))), 2)

    def test_a_deviation_of_the_project_needs_no_mark_but_its_place(self) -> None:
        source = text("src/a.c", "return 1;")
        header = text("include/a.h", "return 1;")
        violations = [Violation(name, 1, "15.5", "m") for name in ("src/a.c", "include/a.h")]
        found = list(misra.judge(violations, [deviation()], [source, header]))
        self.assertEqual(places(found), [("include/a.h", 1)])

    def test_the_line_must_match(self) -> None:
        source = text("src/a.c", "return 1;", "goto end;")
        violations = [Violation("src/a.c", line, "15.5", "m") for line in (1, 2)]
        found = list(misra.judge(violations, [deviation(line="^return")], [source]))
        self.assertEqual(places(found), [("src/a.c", 2)])

    def test_a_deviation_without_use_is_a_finding(self) -> None:
        found = self.judge(
            [Violation("src/a.c", 2, "15.5", "m")],
            deviation(marked=True),
            deviation("MD-002", "8.7"),
        )
        self.assertEqual(found, [(misra.DEVIATIONS, 7)])

    def test_a_mark_without_use_is_a_finding(self) -> None:
        self.assertEqual(self.judge([]), [("src/a.c", 2)])
        elsewhere = [Violation("src/a.c", 4, "8.7", "m")]
        self.assertEqual(self.judge(elsewhere, deviation("MD-002", "8.7")), [("src/a.c", 2)])


ENTRY = """
[[deviation]]
id = "MD-001"
rule = "15.5"
scope = "line"
where = ["src/"]
reason = "because"
"""


class DeviationFileTest(unittest.TestCase):
    """A slip in the file of deviations must not let findings through."""

    def read(self, content: str) -> list[Deviation]:
        with tempfile.TemporaryDirectory() as name:
            path = Path(name) / misra.DEVIATIONS
            path.parent.mkdir()
            path.write_text(content)
            return misra.read_deviations(Path(name))

    def test_an_entry_is_read(self) -> None:
        (entry,) = self.read(ENTRY)
        self.assertEqual(entry, Deviation("MD-001", "15.5", "because", ("src/",), "", True, 2))
        self.assertEqual(self.read(ENTRY.replace("[[deviation]]", "[[ deviation ]]")), [entry])

    def test_slips_are_refused(self) -> None:
        for old, new in (
            ('id = "MD-001"', 'id = "MD-1"'),
            ('rule = "15.5"\n', ""),
            ('reason = "because"', 'reason = " "'),
            ('where = ["src/"]\n', ""),
            ('where = ["src/"]', "where = []"),
            ('scope = "line"', 'scope = "file"'),
            ('scope = "line"', 'scope = "line"\nlines = "x"'),
            ("[[deviation]]", "[[deviation]"),
            ('scope = "line"', 'scope = "line"\nline = "("'),
        ):
            with self.subTest(new), self.assertRaises(ToolError):
                self.read(ENTRY.replace(old, new))

    def test_an_id_declared_twice_is_refused(self) -> None:
        with self.assertRaisesRegex(ToolError, r":10: deviation MD-001: id: is declared twice"):
            self.read(ENTRY + ENTRY)


HEADER = """#ifndef KEEL_RTOS_CLOCK_H
#define KEEL_RTOS_CLOCK_H

#include <stdint.h>

uint32_t keel_clock_half(uint32_t a);

#endif
"""
BARE = """#include "keel/rtos/clock.h"

uint32_t keel_clock_half(uint32_t a)
{
    return a / 2u;
}
"""
TWO_ON_A_LINE = """#include "keel/rtos/clock.h"

uint32_t keel_clock_half(uint32_t a)
{
    if (a) {
        return a / 2;
    }
    return 0u;
}
"""
LIBRARY = """
[[deviation]]
id = "MD-002"
rule = "8.7"
scope = "project"
where = ["src/"]
reason = "a library"
"""


class ToolTest(unittest.TestCase):
    """The tools themselves, on a project of two files."""

    @classmethod
    def setUpClass(cls) -> None:
        Toolchain().ensure("lint")

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write(".clang-format", (ROOT / ".clang-format").read_text())
        self.write("include/keel/rtos/clock.h", HEADER)
        self.write(misra.DEVIATIONS, LIBRARY)

    def write(self, name: str, content: str) -> None:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)

    def lint(self, *arguments: str) -> tuple[int, list[str]]:
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            status = lint.main(arguments, self.root)
        return status, output.getvalue().splitlines()

    def test_a_clean_project_has_no_finding(self) -> None:
        self.write("src/rtos/clock.c", BARE)
        status, lines = self.lint()
        self.assertEqual((status, len(lines)), (0, 1), lines)
        self.assertTrue(lines[0].startswith("lint: no finding"))

    def test_findings_on_one_line_are_all_told(self) -> None:
        self.write("src/rtos/clock.c", TWO_ON_A_LINE)
        status, lines = self.lint()
        rules = [line.split(": ")[:2] for line in lines[:-1]]
        source = "src/rtos/clock.c"
        self.assertEqual(status, 1)
        self.assertEqual(
            rules, [[f"{source}:5", "14.4"], [f"{source}:6", "10.4"], [f"{source}:6", "15.5"]]
        )
        self.assertTrue(lines[-1].startswith("lint: 3 findings"))

    def report(self) -> dict[str, Any]:
        found = json.loads((self.root / record.REPORT).read_text())
        assert isinstance(found, dict)
        return found

    def test_the_report_and_sarif_have_every_finding_with_its_place(self) -> None:
        self.write("src/rtos/clock.c", TWO_ON_A_LINE)
        self.lint()
        self.assertEqual(self.report()["verdict"], "failed")
        found = [(one["rule"], one["file"], one["line"]) for one in self.report()["findings"]]
        rules = [("misra-c2012-14.4", 5), ("misra-c2012-10.4", 6), ("misra-c2012-15.5", 6)]
        self.assertEqual(found, [(rule, "src/rtos/clock.c", line) for rule, line in rules])
        results = json.loads((self.root / record.RESULTS).read_text())["runs"][0]["results"]
        places = [result["locations"][0]["physicalLocation"] for result in results]
        self.assertEqual([place["region"]["startLine"] for place in places], [5, 6, 6])
        self.assertEqual(
            {place["artifactLocation"]["uri"] for place in places}, {"src/rtos/clock.c"}
        )

    def test_the_report_tells_what_deviations_allow_and_what_nothing_looks_for(self) -> None:
        self.write("src/rtos/clock.c", BARE)
        self.lint()
        report = self.report()
        self.assertEqual(report["findings"], [])
        (deviation,) = report["deviations"]
        self.assertEqual(deviation["id"], "MD-002")
        self.assertEqual(deviation["allows"], {"src/rtos/clock.c": 1})
        self.assertEqual(report["rules_without_checker"], ["1.1", "3.2"])
        self.assertEqual(report[STAMP], stamp_of(self.root))
        self.assertEqual(report["verdict"], "good")

    def test_a_run_that_does_not_end_leaves_no_report(self) -> None:
        self.write("src/rtos/clock.c", BARE)
        self.lint()
        self.write(misra.DEVIATIONS, "[[deviation]")
        self.assertEqual(self.lint()[0], 2)
        self.assertFalse((self.root / record.REPORT).exists())
        self.assertFalse((self.root / record.RESULTS).exists())

    def test_a_deviation_of_no_use_fails(self) -> None:
        self.write("src/rtos/clock.c", BARE)
        self.write(misra.DEVIATIONS, LIBRARY + ENTRY)
        status, lines = self.lint()
        self.assertEqual(status, 1)
        self.assertIn("MD-001 covers no finding", lines[0])

    def test_nothing_is_written_beside_the_source(self) -> None:
        """Another command that looks at the source meanwhile would see another one."""
        for number in range(8):
            self.write(f"src/rtos/clock_{number}.c", BARE)
        before, during, ended = set(files_below(self.root)), set[Path](), threading.Event()

        def look() -> None:
            while not ended.is_set():
                during.update(files_below(self.root))

        looking = threading.Thread(target=look)
        looking.start()
        try:
            self.lint()
        finally:
            ended.set()
            looking.join()
        self.assertEqual(during, before)

    def test_layout_is_told_and_mended(self) -> None:
        self.write("src/rtos/clock.c", BARE.replace("    return a", "  return  a"))
        status, lines = self.lint()
        self.assertEqual(status, 1)
        self.assertTrue(lines[0].startswith("src/rtos/clock.c:5: not laid out"), lines)
        self.assertEqual(self.lint("--fix")[0], 0)
        self.assertEqual((self.root / "src/rtos/clock.c").read_text(), BARE)

    def test_the_layout_of_reference_tests_is_checked(self) -> None:
        self.write("src/rtos/clock.c", BARE)
        self.write("tests/reference/test_x.cpp", "int main() { return 0;}\n")
        status, lines = self.lint()
        self.assertEqual(status, 1)
        self.assertIn("tests/reference/test_x.cpp:1: not laid out", "\n".join(lines))

    def test_contracts_are_never_laid_out(self) -> None:
        contract = "/*@ requires   a>0  &&   \\true;\n  @   ensures   \\result  <=  a;\n  @*/\n"
        odd = BARE.replace("uint32_t keel", contract + "uint32_t keel")
        self.write("src/rtos/clock.c", odd)
        self.lint("--fix")
        self.assertEqual((self.root / "src/rtos/clock.c").read_text(), odd)

    def test_code_that_does_not_parse_fails(self) -> None:
        self.write("src/rtos/clock.c", BARE.replace("{", "{{", 1))
        self.assertEqual(self.lint()[0], 1)

    def test_a_slip_in_the_deviations_is_one_line_with_its_place(self) -> None:
        self.write(misra.DEVIATIONS, ENTRY.replace("reason", "reson"))
        status, lines = self.lint()
        self.assertEqual(status, 2)
        place = f"{self.root / misra.DEVIATIONS}"
        self.assertEqual(
            lines,
            [
                f"lint: {place}:2: deviation MD-001: reason: is missing",
                f"{place}:7: deviation MD-001: reson: unknown key; did you mean reason?",
            ],
        )

    WORKFLOW = ".github/workflows/ci.yml"
    # By hand; the commit is no action's.
    GOOD_WORKFLOW = """\
name: CI
on: push
permissions: {}
jobs:
  check:
    runs-on: ubuntu-24.04
    steps:
      - &checkout
        uses: actions/checkout@0123456789abcdef0123456789abcdef01234567
        with:
          persist-credentials: false
      - run: make lint
  again:
    runs-on: ubuntu-24.04
    steps:
      - *checkout
"""

    def workflow(self, old: str = "", new: str = "") -> list[str]:
        """What is found in a workflow with a slip."""
        self.assertIn(old, self.GOOD_WORKFLOW)
        self.write("src/rtos/clock.c", BARE)
        self.write(self.WORKFLOW, self.GOOD_WORKFLOW.replace(old, new))
        status, lines = self.lint()
        self.assertEqual(status, 1 if lines[:-1] else 0, lines)
        return lines[:-1]

    def test_a_workflow_that_is_good(self) -> None:
        self.assertEqual(self.workflow(), [])

    def test_a_workflow_that_is_no_yaml(self) -> None:
        [line] = self.workflow("on: push", "on: [push")
        self.assertTrue(line.startswith(f"{self.WORKFLOW}:3: no YAML: "), line)

    def test_a_workflow_of_another_form_is_told_with_its_line(self) -> None:
        [line] = self.workflow("- run: make", "- rn: make")
        self.assertTrue(line.startswith(f"{self.WORKFLOW}:12: $.jobs.check.steps[1]: "), line)
        [line] = self.workflow(
            "runs-on: ubuntu-24.04\n    steps:\n      - *c",
            "runs-on: x\n    timeout: 3\n    steps:\n      - *c",
        )
        self.assertTrue(line.startswith(f"{self.WORKFLOW}:13: $.jobs.again: "), line)
        self.assertIn("'timeout' was unexpected", line)

    def test_what_a_workflow_names_and_there_is_not(self) -> None:
        for old, new, line, why in (
            ("make lint", "echo ${{ steps.none.outputs.x }}", 12, 'expression: property "none"'),
            ("  again:", "  again:\n    needs: [chekc]", 13, 'job-needs: job "again" needs job'),
            ("on: push", "on: pus", 2, None),
        ):
            found = self.workflow(old, new)
            begin = f"{self.WORKFLOW}:{line}: {why or ''}"
            self.assertTrue(any(one.startswith(begin) for one in found), (why, found))

    def test_what_strangers_may_use_in_a_workflow(self) -> None:
        for old, new, line, why in (
            ("@0123456789abcdef0123456789abcdef01234567", "@v7", 9, "unpinned-uses"),
            ("persist-credentials: false", "fetch-depth: 1", 8, "artipacked"),
            ("permissions: {}", "permissions: write-all", 3, "excessive-permissions"),
            ("make lint", "echo ${{ github.head_ref }}", 12, "template-injection"),
        ):
            found = self.workflow(old, new)
            self.assertTrue(
                any(one.startswith(f"{self.WORKFLOW}:{line}: {why}: ") for one in found),
                (why, found),
            )
            rules = {one["rule"] for one in self.report()["findings"]}
            self.assertEqual(rules, {"workflows"})


if __name__ == "__main__":
    os.environ.setdefault("PYTHONDONTWRITEBYTECODE", "1")
    unittest.main()
