# SPDX-License-Identifier: Apache-2.0
"""Tests of the parts that read what people wrote: objectives, plans, safety manual, contracts,
configuration. Each fault shows in the problems of its part, or refuses the file in one line.
"""

from __future__ import annotations

import subprocess
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

from evidence_sample import STAMP, context_in

from keel.base.errors import ToolError
from keel.base.files import sha256_of, write_text
from keel.gather.part import Context
from keel.gather.parts import configuration, contracts, objectives, plans, safety

ROOT = Path(__file__).resolve().parents[2]

STANDARD = """\
id = "S-1"
title = "A standard"
note = "In our words."
source = [ { id = "A", address = "https://a.org/b", on = 2026-11-22, what = "Its annex" } ]
objective = [
  { id = "1", checked = "A", what = "Proved", status = "input", by = ["part:formal", "file:a.md"] },
  { id = "2", what = "It flies", status = "partly", by = ["part:tests"], why = "Not yet" },
  { id = "3", what = "It lands", status = "no", why = "No ground" },
]
"""
LEDGER = """\
# Soundness

## The ledger of assumptions

| id | assumption | stated in | owner | who ensures it | how it is verified |
|---|---|---|---|---|---|
| A-07 | A task's body *returns*, `always`. | `task.h` | integrator | caller | review \\| watchdog |
| A-15 | It holds. | here | Keel | the kernel | proved |

More:

| id | assumption | stated in | owner | who ensures it | how it is verified |
|---|---|---|---|---|---|
| A-23 | It rounds to nearest. | `filter.h` | integrator | the board | flags |

## Other

| id | assumption |
|---|---|
| A-99 | no entry of the ledger |
"""
HEADER = """\
/* A licence. */
KEEL_C_BEGIN

/*@ predicate queue_valid(keel_queue_t *q) = \\true; @*/

/**
 * Makes a queue empty (requirement QUE-001).
 *
 * @param queue the queue
 */
/*@ requires \\valid(queue);
  @ ensures QUE_001_count: queue->count == 0u;
  @*/
void keel_queue_init(keel_queue_t *queue);

/** Whether eq. 4 holds. */
/*@ assigns \\nothing; */
static inline bool keel_queue_holds(const keel_queue_t *queue)
{
    return (queue->count == 0u) && other(queue);
}

/*@ assigns \\nothing; */
void keel_any_body(void *context);
"""


class Parts(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.context: Context = context_in(self.root)

    def write(self, name: str, text: str) -> None:
        write_text(self.root / name, text)


class Objectives(Parts):
    def make(self, old: str = "", new: str = "") -> str:
        """What a standard with one change is refused with."""
        self.write("a.md", "a")
        self.assertIn(old, STANDARD)
        self.write("specs/objectives/s.toml", STANDARD.replace(old, new, 1))
        try:
            self.part = objectives.make(self.context)
        except ToolError as error:
            return str(error)
        return ""

    def test_statuses_are_counted_and_never_called_compliant(self) -> None:
        self.assertEqual(self.make(), "")
        self.assertEqual(
            self.part.summary,
            {
                "A standard": "1 met as input, 1 partly, 1 not addressed; "
                "2 of 3 numbers from memory alone"
            },
        )
        first = self.part.items[0]
        self.assertEqual((first.id, first.links), ("S-1/1", ("part:formal", "file:a.md")))
        self.assertEqual([item.state for item in self.part.items], ["good", "open", "open"])

    def test_each_row_tells_what_its_number_was_compared_with(self) -> None:
        self.assertEqual(self.make(), "")
        (table,) = self.part.tables
        place = table.columns.index("number compared with")
        self.assertEqual([row[place] for row in table.rows], ["A", "nothing", "nothing"])
        self.assertIn("A (https://a.org/b, read on 2026-11-22): Its annex.", table.note)
        told = [item.facts["number compared with"] for item in self.part.items]
        memory = "nothing: it is from memory"
        self.assertEqual(told, ["A, 2026-11-22: https://a.org/b", memory, memory])

    def test_a_comparison_with_a_source_that_is_not_there(self) -> None:
        told = self.make('checked = "A"', 'checked = "B"')
        self.assertRegex(told, r"s\.toml:\d+: objective 1.*there is no source B$")
        self.assertIn("on", self.make("on = 2026-11-22, ", ""))

    def test_an_artefact_that_does_not_exist(self) -> None:
        for old, new in (
            ("part:formal", "part:magic"),
            ("file:a.md", "file:b.md"),
            ("part:tests", "nonsense"),
        ):
            told = self.make(old, new)
            self.assertRegex(told, rf"s\.toml:\d+: objective \d.*there is no artefact {new}$")

    def test_a_status_without_artefact_or_reason(self) -> None:
        self.assertIn(
            "partly, but why does not say what is missing", self.make(', why = "Not yet"')
        )
        self.assertIn("no, but why does not say", self.make(', why = "No ground"'))
        self.assertIn(
            "input, but no artefact is named", self.make(', by = ["part:formal", "file:a.md"]')
        )

    def test_a_strange_status_and_an_id_twice(self) -> None:
        self.assertIn("status", self.make('"input"', '"compliant"'))
        self.assertIn("is there twice", self.make('id = "2"', 'id = "1"'))

    def test_no_standard_at_all(self) -> None:
        with self.assertRaisesRegex(ToolError, "there is no standard"):
            objectives.make(self.context)

    def test_keels_own_are_accepted(self) -> None:
        part = objectives.make(replace(self.context, root=ROOT))
        self.assertEqual(part.problems, ())
        self.assertEqual(len(part.tables), 3)
        self.assertGreater(len(part.items), 150)


class Safety(Parts):
    def make(self, old: str = "", new: str = "") -> None:
        self.assertIn(old, LEDGER)
        self.write("specs/soundness.md", LEDGER.replace(old, new))
        self.part = safety.make(self.context)

    def test_the_integrators_assumptions_are_numbered_constraints(self) -> None:
        self.make()
        self.assertEqual(self.part.problems, ())
        self.assertEqual([item.id for item in self.part.items], ["SC-07", "SC-23"])
        first = self.part.items[0]
        self.assertEqual(first.links, ("assumption:A-07",))
        self.assertEqual(first.title, "A task's body *returns*, always.")
        self.assertEqual(first.facts["verification"], "review | watchdog")
        self.assertEqual([row[0] for row in self.part.tables[1].rows], ["assumption:A-15"])

    def test_an_entry_without_owner_or_verification(self) -> None:
        self.make("| integrator | the board", "| | the board")
        self.assertEqual(self.part.problems, ("specs/soundness.md: A-23: has no owner",))
        self.make("| flags |", "| |")
        told = "specs/soundness.md: A-23: does not say how it is verified"
        self.assertEqual(self.part.problems, (told,))

    def test_a_ledger_that_has_gone(self) -> None:
        self.make("## The ledger of assumptions", "## Assumptions")
        self.assertEqual(len(self.part.problems), 1)
        self.assertIn("there is no entry", self.part.problems[0])


class Plans(Parts):
    def test_a_section_that_is_missing(self) -> None:
        text = (ROOT / plans.PLAN).read_text(encoding="utf-8")
        self.write(plans.PLAN, text)
        self.assertEqual(plans.make(self.context).problems, ())
        self.write(plans.PLAN, text.replace("## Problem reporting", "## Bugs"))
        self.assertEqual(
            plans.make(self.context).problems,
            ("docs/plan.md: there is no section Problem reporting",),
        )

    def test_words_and_tables_come_over(self) -> None:
        part = plans.make(replace(self.context, root=ROOT))
        self.assertIn("make prove-all", [row[2] for row in part.tables[0].rows])
        self.assertNotIn("](", part.text)
        self.assertIn("A commit is the baseline.", part.text)


class Contracts(Parts):
    def make(self, header: str = HEADER) -> None:
        self.write("include/keel/rtos/queue.h", header)
        self.part = contracts.make(self.context)
        self.items = {item.id: item for item in self.part.items if item.kind == "function"}

    def test_a_function_has_its_own_comment_contract_and_prototype(self) -> None:
        self.make()
        self.assertEqual(list(self.items), ["keel_queue_init", "keel_queue_holds"])
        first = self.items["keel_queue_init"]
        self.assertEqual(first.title, "Makes a queue empty")
        self.assertTrue(first.text.startswith("/**\n * Makes a queue empty"))
        self.assertTrue(first.text.endswith("void keel_queue_init(keel_queue_t *queue);"))
        self.assertIn("@ ensures QUE_001_count", first.text)
        self.assertNotIn("predicate", first.text)
        self.assertEqual(first.facts["declared at"], "include/keel/rtos/queue.h:14")
        self.assertEqual(self.items["keel_queue_holds"].title, "Whether eq. 4 holds")

    def test_a_function_without_a_contract(self) -> None:
        self.make(HEADER.replace("/*@ requires \\valid(queue);", "/* requires \\valid(queue);"))
        self.assertEqual(self.part.problems, ("keel_queue_init: has no contract",))

    def test_all_of_keels_functions_are_found(self) -> None:
        part = contracts.make(replace(self.context, root=ROOT))
        status = (ROOT / "docs/status.md").read_text(encoding="utf-8")
        self.assertIn(f"\n| all | {part.summary['public functions']} |", status)
        self.assertEqual(part.problems, ())


class Configuration(Parts):
    def test_each_item_has_its_digest(self) -> None:
        lock = '{"tools": {"z3": {"kind": "system", "at_least": "4", "below": "5"}}}'
        self.write("tools/toolchain.lock.json", lock)
        names = ("MAJOR", "MINOR", "PATCH")
        numbers = "".join(f"#define KEEL_VERSION_{name} 1\n" for name in names)
        self.write("include/keel/version.h", numbers)
        who = ["-c", "user.name=a", "-c", "user.email=a@b"]
        for words in (["init", "-q"], ["add", "include", "tools"], ["commit", "-qm", "x"]):
            subprocess.run(["git", *who, *words], cwd=self.root, check=True, capture_output=True)
        part = configuration.make(self.context)
        self.assertEqual(part.summary["version"], "1.1.1")
        self.assertEqual(part.summary["commit"], STAMP["commit"])
        digest = sha256_of(self.root / "include/keel/version.h")
        items = {item.id: item.facts["SHA-256"] for item in part.items}
        self.assertEqual(items["include/keel/version.h"], digest)
        self.assertEqual(len(items), 2)
        self.assertIn('"z3"', part.files["tools.cdx.json"].read_text(encoding="utf-8"))

    def test_a_version_that_is_missing(self) -> None:
        self.write("tools/toolchain.lock.json", '{"tools": {}}')
        with self.assertRaisesRegex(ToolError, r"version\.h"):
            configuration.make(self.context)
