# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel trace: each kind of orphan is found in a small project that has
just this one.
"""

from __future__ import annotations

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from keel.base.files import write_text
from keel.trace import command as requirements_trace

ROOT = Path(__file__).resolve().parents[2]

SDOC = """\
[DOCUMENT]
TITLE: Widget

[REQUIREMENT]
UID: WID-001
TITLE: Turning
VERIFICATION: proof
CLAUSES: WID_001_range, WID_001_turns
STATEMENT: >>>
It shall turn.
<<<
RELATIONS:
- TYPE: Parent
  VALUE: HLR-001

[REQUIREMENT]
UID: WID-002
TITLE: Looping
VERIFICATION: test
TESTS: it_loops
STATEMENT: It shall loop.
RELATIONS:
- TYPE: Parent
  VALUE: HLR-002

[REQUIREMENT]
UID: WID-003
TITLE: Forever
VERIFICATION: theorem
STATEMENT: It shall turn for ever.
DERIVED: Nobody asked for an end.
"""
HIGH = """\
[DOCUMENT]
TITLE: High-level requirements

[REQUIREMENT]
UID: HLR-001
TITLE: Moving
VERIFICATION: proof
SOURCE: eq. 1; section III-A
STATEMENT: It shall move.
RATIONALE: Widgets that stand still are no use.

[REQUIREMENT]
UID: HLR-002
TITLE: Surprising
VERIFICATION: test
STATEMENT: It shall loop and more.
RATIONALE: Someone may look.
DEPARTURE: The paper's widgets do not loop.
DERIVED: The paper does not say it.
"""
HEADER = """\
/** Turns (requirement WID-001). */
#define STAYS ensures WID_001_range : \\true;
/*@ ensures ok: \\true;
  @ ensures WID_001_turns:
  @     \\true;
  @*/
void keel_widget_turn(void);
"""
SOURCE = """\
static void nudge(void)
{
}

static void push(void)
{
    nudge();
}

void keel_widget_turn(void)
{
    push();
}
"""
FILES = {
    "specs/requirements/widget.sdoc": SDOC,
    "specs/requirements/high_level.sdoc": HIGH,
    "specs/soundness.md": "The theorem (WID-003).\n",
    "docs/paper.md": "| HLR-002 | no loops | loops |\n",
    "src/rtos/widget.c": SOURCE,
    "include/keel/widget.h": HEADER,
    "proofs/widget/turn_harness.c": '__CPROVER_assert(x, "WID_001_turns: it turns");\n',
    "tests/unit/test_widget.c": "RUN_TEST(it_loops);\n",
}


class TraceTest(unittest.TestCase):
    """A project without orphans, changed in one place."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name, text in FILES.items():
            self.write(name, text)

    def write(self, name: str, text: str) -> None:
        """Write a file of the project."""
        write_text(self.root / name, text)

    def change(self, name: str, old: str, new: str) -> None:
        """Replace a text that must be there."""
        self.assertIn(old, FILES[name])
        self.write(name, FILES[name].replace(old, new))

    def run_trace(self, *arguments: str) -> tuple[int, list[str]]:
        """The exit status, and the lines that were printed."""
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            status = requirements_trace.main(arguments, self.root)
        return status, output.getvalue().splitlines()

    def orphans(self) -> list[str]:
        """The orphans; the exit status and the last line agree with them."""
        status, lines = self.run_trace()
        self.assertEqual(status, 1 if lines[1:] else 0)
        self.assertTrue(lines[-1].endswith(f" {len(lines) - 1} orphans"), lines[-1])
        return lines[:-1]

    def test_no_orphan(self) -> None:
        self.assertEqual(
            self.run_trace(),
            (0, ["traced 5 requirements: 2 clauses, 1 harnesses, 1 tests, 3 functions, 0 orphans"]),
        )

    def test_label_without_requirement(self) -> None:
        self.change("include/keel/widget.h", "ensures ok:", "ensures WID_009_ok:")
        self.assertEqual(
            self.orphans(), ["include/keel/widget.h: WID_009_ok: there is no requirement WID-009"]
        )

    def test_lemma_without_requirement(self) -> None:
        self.change("include/keel/widget.h", "ensures ok:", "lemma WID_009_ok{Here}:")
        self.assertEqual(
            self.orphans(), ["include/keel/widget.h: WID_009_ok: there is no requirement WID-009"]
        )

    def test_comment_without_requirement(self) -> None:
        self.change("include/keel/widget.h", "requirement WID-001", "requirement WID-009")
        self.assertEqual(self.orphans(), ["include/keel/widget.h: there is no requirement WID-009"])

    def test_harness_without_requirement(self) -> None:
        self.write("proofs/widget/more_harness.c", '__CPROVER_assert(x, "WID_009: more");\n')
        self.assertEqual(
            self.orphans(),
            ["proofs/widget/more_harness.c: WID_009: there is no requirement WID-009"],
        )

    def test_test_without_requirement(self) -> None:
        self.write("tests/unit/test_more.c", "RUN_TEST(WID_009_more);\n")
        self.assertEqual(
            self.orphans(),
            ["tests/unit/test_more.c: WID_009_more: there is no requirement WID-009"],
        )

    def test_reference_test_without_requirement(self) -> None:
        self.write("tests/reference/test_more.cpp", 'suite.check("WID_009_more", ok, "no");\n')
        self.assertEqual(
            self.orphans(),
            ["tests/reference/test_more.cpp: WID_009_more: there is no requirement WID-009"],
        )

    def test_a_reference_test_is_enough_for_a_clause(self) -> None:
        self.change("proofs/widget/turn_harness.c", "WID_001_turns", "turns")
        self.write("tests/reference/test_more.cpp", 'suite.check("WID_001_at_" + which, ok, "");\n')
        self.assertEqual(self.orphans(), [])

    def test_requirement_without_clause(self) -> None:
        self.write("include/keel/widget.h", "/** Turns. */\n")
        self.write("src/rtos/widget.c", "")
        self.assertEqual(
            self.orphans(),
            [
                "WID-001: CLAUSES is not what the headers say (tools/keel trace --update)",
                "WID-001: no clause states it",
            ],
        )

    def test_clause_that_nobody_checks(self) -> None:
        self.change("proofs/widget/turn_harness.c", "WID_001_turns", "turns")
        self.assertEqual(self.orphans(), ["WID-001: neither a harness nor a test names it"])

    def model(self, text: str, harness: str = "") -> None:
        """A model beside the code, and a harness that need not name the requirement."""
        self.write("specs/model/widget.h", "void model_turn(void);\n")
        self.write("specs/model/widget.c", text)
        self.write("proofs/widget/turn_harness.c", harness)

    include = '#include "../../specs/model/widget.h"\n'

    def test_a_model_that_is_compared_is_enough_for_a_clause(self) -> None:
        self.model("/* WID-001 */\n", self.include)
        self.assertEqual(self.orphans(), [])
        self.write("proofs/common/widget_proof.h", self.include)
        self.model("// WID-001: turns\n", '#include "../common/widget_proof.h"\n')
        self.assertEqual(self.orphans(), [])

    def test_a_model_that_is_not_compared_says_nothing(self) -> None:
        self.model("/* WID-001 */\n", "/* " + self.include + " */")
        self.assertEqual(
            self.orphans(),
            [
                "WID-001: neither a harness nor a test names it",
                "specs/model/widget.c: no harness compares the code with this model",
            ],
        )

    def test_only_comments_of_a_model_name_requirements(self) -> None:
        self.model('const char *text = "WID-001";\n', self.include)
        self.assertEqual(self.orphans(), ["WID-001: neither a harness nor a test names it"])

    def test_a_model_names_requirements_that_there_are(self) -> None:
        self.model("/* WID-001, WID-009 */\n", self.include)
        self.assertEqual(self.orphans(), ["specs/model/widget.c: there is no requirement WID-009"])

    def test_a_test_is_enough_for_a_clause(self) -> None:
        self.change("proofs/widget/turn_harness.c", "WID_001_turns", "turns")
        self.write("tests/unit/test_more.c", "RUN_TEST(WID_001_it_turns);\n")
        self.assertEqual(self.orphans(), [])

    def test_requirement_to_be_tested_without_test(self) -> None:
        self.change("specs/requirements/widget.sdoc", "TESTS: it_loops\n", "")
        self.assertEqual(
            self.orphans(),
            [
                "HLR-002: VERIFICATION says test, and neither it nor a low-level requirement of it"
                " has tests",
                "WID-002: no test checks it",
            ],
        )

    def test_listed_test_that_does_not_exist(self) -> None:
        self.change("specs/requirements/widget.sdoc", "it_loops", "it_loops, it_stops")
        self.assertEqual(self.orphans(), ["WID-002: TESTS lists it_stops, which is no test"])

    def test_a_file_of_tests_may_be_listed(self) -> None:
        self.change("specs/requirements/widget.sdoc", "it_loops", "tests/property/drive.c")
        self.write("tests/property/drive.c", "")
        self.assertEqual(self.orphans(), [])

    def test_theorem_that_is_not_argued(self) -> None:
        self.write("specs/soundness.md", "Nothing.\n")
        self.assertEqual(self.orphans(), ["WID-003: specs/soundness.md does not name it"])

    def test_unknown_verification(self) -> None:
        self.change("specs/requirements/widget.sdoc", ": theorem", ": hope")
        self.assertEqual(self.orphans(), ["WID-003: VERIFICATION is not of proof, test, theorem"])

    def test_two_requirements_with_one_id(self) -> None:
        self.change("specs/requirements/widget.sdoc", "WID-003", "WID-002")
        self.assertIn("WID-002: two requirements have this id", self.orphans())

    def test_stale_clauses_are_updated(self) -> None:
        self.change("specs/requirements/widget.sdoc", "WID_001_range, WID_001_turns", "WID_001")
        self.assertEqual(
            self.orphans(),
            ["WID-001: CLAUSES is not what the headers say (tools/keel trace --update)"],
        )
        self.assertEqual(self.run_trace("--update")[0], 0)
        text = (self.root / "specs/requirements/widget.sdoc").read_text(encoding="utf-8")
        self.assertEqual(text, SDOC)

    low = "specs/requirements/widget.sdoc"
    high = "specs/requirements/high_level.sdoc"

    def test_a_requirement_without_a_parent(self) -> None:
        self.change(self.low, "<<<\nRELATIONS:\n- TYPE: Parent\n  VALUE: HLR-001\n", "<<<\n")
        self.assertEqual(
            self.orphans(),
            [
                "HLR-001: VERIFICATION says proof, and none of its low-level requirements is"
                " proved",
                "HLR-001: no low-level requirement has it as its parent, and it lists no tests",
                "WID-001: it has no parent, and no DERIVED says why",
            ],
        )

    def test_a_parent_that_does_not_exist(self) -> None:
        self.change(self.low, "VALUE: HLR-001", "VALUE: HLR-001\n- TYPE: Parent\n  VALUE: HLR-009")
        self.assertEqual(self.orphans(), ["WID-001: its parent HLR-009 does not exist"])

    def test_a_parent_of_the_same_level(self) -> None:
        self.change(self.low, "VALUE: HLR-001", "VALUE: HLR-001\n- TYPE: Parent\n  VALUE: WID-002")
        self.assertEqual(
            self.orphans(), ["WID-001: its parent WID-002 is no high-level requirement"]
        )

    def test_what_has_a_parent_is_not_derived(self) -> None:
        self.change(self.low, "loop.\n", "loop.\nDERIVED: For fun.\n")
        self.assertEqual(self.orphans(), ["WID-002: it has a parent, so it is not DERIVED"])

    def test_a_requirement_that_nobody_refines(self) -> None:
        more = "\n[REQUIREMENT]\nUID: HLR-003\nTITLE: More\nVERIFICATION: test\nSOURCE: fig. 2\n"
        self.write(self.high, HIGH + more + "STATEMENT: More.\nRATIONALE: More is more.\n")
        self.assertEqual(
            self.orphans(),
            [
                "HLR-003: VERIFICATION says test, and neither it nor a low-level requirement of it"
                " has tests",
                "HLR-003: no low-level requirement has it as its parent, and it lists no tests",
            ],
        )

    def test_a_source_that_cites_nothing(self) -> None:
        self.change(self.high, "eq. 1; section III-A", "the paper")
        self.assertEqual(
            self.orphans(),
            [
                "HLR-001: its SOURCE cites no equation, section, figure or table, and no DERIVED"
                " says why"
            ],
        )

    def test_a_requirement_without_its_texts(self) -> None:
        self.write(
            self.high,
            HIGH.replace("STATEMENT: It shall move.\n", "").replace(
                "RATIONALE: Widgets that stand still are no use.\n", ""
            ),
        )
        self.assertEqual(
            self.orphans(), ["HLR-001: it has no RATIONALE", "HLR-001: it has no STATEMENT"]
        )

    def test_a_departure_that_the_document_does_not_tell(self) -> None:
        text = "DEPARTURE and docs/paper.md do not agree on whether it departs from the paper"
        self.write("docs/paper.md", "| HLR-001 | |\n")
        self.assertEqual(self.orphans(), [f"HLR-001: {text}", f"HLR-002: {text}"])

    def test_a_function_without_a_requirement(self) -> None:
        self.write("src/rtos/widget.c", SOURCE + "\nvoid keel_widget_stop(void)\n{\n}\n")
        self.assertEqual(
            self.orphans(),
            [
                "src/rtos/widget.c: keel_widget_stop: no clause of its contract bears a"
                " requirement's id"
            ],
        )

    def test_a_dropped_label(self) -> None:
        self.write("include/keel/widget.h", HEADER.replace("WID_001_turns", "turns"))
        self.write(self.low, SDOC.replace(", WID_001_turns", ""))
        self.assertEqual(
            self.orphans(),
            [
                "src/rtos/widget.c: keel_widget_turn: no clause of its contract bears a"
                " requirement's id",
                "src/rtos/widget.c: nudge: not all of its callers trace to a requirement: push",
                "src/rtos/widget.c: push: not all of its callers trace to a requirement:"
                " keel_widget_turn",
            ],
        )

    def test_a_static_function_that_nobody_calls(self) -> None:
        self.change("src/rtos/widget.c", "    push();\n", "")
        self.assertEqual(
            self.orphans(),
            [
                "src/rtos/widget.c: nudge: not all of its callers trace to a requirement: push",
                "src/rtos/widget.c: push: nothing calls this static function",
            ],
        )

    def test_no_requirement_at_all(self) -> None:
        with tempfile.TemporaryDirectory() as empty, contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(requirements_trace.main([], Path(empty)), 1)
