# SPDX-License-Identifier: Apache-2.0
"""Tests of keel.analyse.eva: what is left of a contract, what is judged, and that Frama-C finds
what is put into small programs.
"""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path
from typing import Any

from keel.analyse import analysis, eva
from keel.analyse.analysis import ANY_CONTEXT, Analysis, Eva, read_log
from keel.analyse.reduced import public_functions, reduced, widened, write_tree
from keel.base.errors import ToolError
from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

CONTRACT = """\
/*@ requires \\valid(a);
  @ assigns a->x, a->y[a->n];
  @ ensures a->x > 0;
  @ behavior refused:
  @   assigns \\nothing;
  @*/
void keel_f(struct s *a);
"""


class Reduced(unittest.TestCase):
    """What Eva gets to read."""

    def test_of_a_contract_what_is_assigned_is_left_on_its_line(self) -> None:
        told = reduced(CONTRACT)
        lines = told.splitlines()
        self.assertEqual(lines[0], "/*@ assigns a->x, a->y[a->n]; */")
        self.assertEqual(lines[6], "void keel_f(struct s *a);")
        self.assertEqual(len(lines), 7)

    def test_all_other_annotations_go(self) -> None:
        text = "//@ assert x;\n/*@ loop assigns i;\n  @*/\n/*@ ghost int i; */\n/* assigns x; */\n"
        self.assertEqual(reduced(text), "\n\n\n\n/* assigns x; */\n")

    def test_open_indices(self) -> None:
        self.assertEqual(widened("assigns a->y[b[a->n]].z, *c;"), "assigns a->y[..], *c;")

    def test_every_public_function_is_known(self) -> None:
        names = public_functions(ROOT)
        self.assertEqual(names["keel_queue_add"], "include/keel/internal/rtos/queue.h")
        self.assertEqual(names["keel_clock_advance"], "include/keel/rtos/clock.h")
        self.assertGreater(len(names), 60)


def analysed(share: int, status: str) -> Analysis:
    """What one run says of keel_f."""
    row = analysis.Property("x.h", 1, "keel_f_2", "assigns clause", status, "assigns a->x;")
    reach = {"keel_f_2": analysis.Reach(share, 10), "keel_f": analysis.Reach(0, 10)}
    return Analysis((row,), reach, 1, 1, ())


ALARM = {
    "file": "src/x.c",
    "line": 7,
    "function": "keel_f",
    "kind": "mem_access",
    "status": "Unknown",
    "text": "mem_access: \\valid(p)",
}


def found(**more: Any) -> dict[str, Any]:
    """What a good run found."""
    return {"alarms": [], "warnings": [], "assigns": [], **more}


class Judged(unittest.TestCase):
    """What is left to explain."""

    def problems(self, report: dict[str, Any], **settings: Any) -> list[str]:
        return list(eva.judge(report, eva.Settings.model_validate(settings)))

    def test_the_run_that_reaches_more_counts(self) -> None:
        for alone, demo, run, verdict in (
            (analysed(9, "Valid"), analysed(8, "Unknown"), eva.ALONE, eva.EXACT),
            (analysed(8, "Valid"), analysed(9, "Unknown"), eva.IN_DEMO, eva.UNKNOWN),
            (analysed(9, "Unknown"), Analysis((), {}, 1, 1, ()), eva.ALONE, eva.UNKNOWN),
        ):
            told = eva.judged("keel_f", alone, demo)
            self.assertEqual((told["run"], told["verdict"]), (run, verdict))

    def test_an_alarm_without_an_explanation(self) -> None:
        (problem,) = self.problems(found(alarms=[ALARM]))
        self.assertEqual(problem, "src/x.c:7: keel_f: mem_access: mem_access: \\valid(p)")

    def test_an_alarm_with_an_explanation_and_one_that_has_gone(self) -> None:
        entry = {key: ALARM[key] for key in ("file", "function", "text")} | {"reason": "known"}
        self.assertEqual(self.problems(found(alarms=[ALARM]), alarm=[entry]), [])
        (problem,) = self.problems(found(), alarm=[entry])
        self.assertIn("specs/eva.toml: alarm in keel_f: there is none", problem)

    def test_a_warning_is_no_good_result(self) -> None:
        (problem,) = self.problems(found(warnings=["eva: garbled mix"]))
        self.assertEqual(problem, "the demo: eva: garbled mix")

    def test_writes_that_the_contract_does_not_name(self) -> None:
        report = found(assigns=[{"function": "keel_f", "verdict": eva.UNKNOWN}])
        (problem,) = self.problems(report)
        self.assertEqual(problem, "keel_f: may write what its contract does not name")
        entry = {"function": "keel_f", "reason": "its callback does"}
        self.assertEqual(self.problems(report, writes=[entry]), [])
        (problem,) = self.problems(found(), writes=[entry])
        self.assertIn("writes of keel_f: there is nothing to explain", problem)

    def test_a_log_that_breaks_off(self) -> None:
        with self.assertRaisesRegex(ToolError, "the analysis did not end"):
            read_log("[eva] Analyzing", "directory\tfile\n")


PROGRAM = """\
struct pair { int a; int b; int c[4]; };

/*@ assigns p->a; */
void within(struct pair *p);
/*@ assigns p->a; */
void outside(struct pair *p);
/*@ assigns p->c[i]; */
void element(struct pair *p, unsigned i);

void within(struct pair *p) { p->a = 1; }
void outside(struct pair *p) { p->a = 1; p->b = 2; }
void element(struct pair *p, unsigned i) { if (i < 4u) { p->c[i] = 1; } }

int entry(void)
{
    int four[4] = {0, 0, 0, 0};
    int sum = 0;
    for (int i = 0; i < LIMIT; i++) {
        sum += four[i];
    }
    return sum;
}
"""


class Frama(unittest.TestCase):
    """Frama-C itself, on a small program."""

    tools: Toolchain

    @classmethod
    def setUpClass(cls) -> None:
        cls.tools = Toolchain()
        cls.tools.ensure("prove")

    def analyse(self, limit: int, entries: list[str], *options: str) -> dict[str, Analysis]:
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        (folder / "src").mkdir()
        (folder / "src/p.c").write_text(PROGRAM.replace("LIMIT", str(limit)))
        tree = folder / "tree"
        write_tree(folder, ["src"], tree)
        return Eva(self.tools, tree).analyse(["src/p.c"], ["src"], entries, options)

    def test_an_index_out_of_bounds_is_an_alarm(self) -> None:
        self.assertEqual(self.analyse(4, ["entry"])["entry"].alarms, [])
        (alarm,) = self.analyse(5, ["entry"])["entry"].alarms
        self.assertEqual(
            (alarm.file, alarm.function, alarm.kind), ("src/p.c", "entry", "index_bound")
        )

    def test_a_write_outside_of_the_contract_is_found(self) -> None:
        names = ["within", "outside", "element"]
        every = self.analyse(4, names, *ANY_CONTEXT)
        self.assertEqual(
            [every[name].assigns(name) for name in names], ["Valid", "Unknown", "Unknown"]
        )
        self.assertEqual(every["outside"].share("outside"), 1.0)

    def test_a_program_that_does_not_parse(self) -> None:
        with self.assertRaisesRegex(ToolError, "frama-c: "):
            self.analyse(4, ["nothing"])
