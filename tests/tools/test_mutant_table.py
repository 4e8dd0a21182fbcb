# SPDX-License-Identifier: Apache-2.0
"""Tests of specs/mutation.toml: it is written as it is read, and refused if it is not whole."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from keel.base.errors import ToolError
from keel.c.project import ProjectError, Unit, find_units
from keel.mutate import standing
from keel.mutate import table as mutant_table
from keel.mutate.operators import Mutant
from keel.mutate.verdicts import EXECUTED, Identity, Verdict

ROOT = Path(__file__).resolve().parents[2]

MADE_OF = {"source": "1" * 64, "proofs": "2" * 64, "cbmc": "6.6.0", "alt-ergo": "2.0.0"}
BY_CBMC = {"cbmc": "killed: keel_box_harness: BOX_001"}
EXECUTION = {"cbmc": f"killed: keel_box__far_harness: BOX_002{EXECUTED}3)"}
BY_WP = {"cbmc": "no answer", "wp": "killed: a goal"}
ODD = 'abscissa = \\"x\\";'  # As JSON and TOML write it.
TEXT = f"""\
{mutant_table.HEAD}
[tools.TOOLS]
cbmc = "6.6.0"
alt-ergo = "2.0.0"

[unit.box]
source = "{"1" * 64}"
proofs = "{"2" * 64}"
tools = "TOOLS"
killers = ["keel_box__far_harness", "keel_box_harness"]
mutants = 10
killed = {{executed = 1, solved = 2, wp = 1}}
stillborn = 1
same_code = {{f = [3, 3], g = [9]}}
accepted = [{{entry = 2, line = 7}}]
open = [
    {{function = "f", line = 5, original = "{ODD}", mutant = "", status = "undecided"}},
]
problems = ["it is so"]
"""


def mutant(function: str, line: int, before: str = "a", after: str = "b") -> Mutant:
    """A mutant of the unit."""
    return Mutant(Path("box.h"), function, "relation", 0, 1, after, line, before, after)


def same_code(function: str, line: int) -> Verdict:
    """On a mutant that makes no difference to the compiler."""
    return Verdict(mutant(function, line), "equivalent", "same object code")


class TableTest(unittest.TestCase):
    """A project with one unit."""

    def setUp(self) -> None:
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        self.unit = Unit(self.root, "rtos", "box")
        self.path = self.root / mutant_table.FILE
        self.path.parent.mkdir()
        self.unit.folder.mkdir(parents=True)
        self.accept(("f", "other", "b", 1), ("f", "a", "b", 1))
        self.verdicts = [
            Verdict(mutant("f", 1), "killed", "", EXECUTION),
            Verdict(mutant("f", 1), "killed", "", BY_CBMC),
            Verdict(mutant("f", 2), "killed", "", BY_CBMC),
            Verdict(mutant("f", 2), "killed", "", BY_WP),
            Verdict(mutant("f", 2), "stillborn", "does not compile"),
            same_code("f", 3),
            same_code("f", 3),
            same_code("g", 9),
            Verdict(mutant("f", 7), "equivalent", "why"),
            Verdict(mutant("f", 5, 'abscissa = "x";', ""), "undecided", "", {"wp": "undecided: g"}),
        ]

    def accept(self, *identities: Identity) -> None:
        """Write the reasons of people."""
        entries = [
            f'[[equivalent]]\nfunction = "{function}"\noriginal = "{before}"\n'
            f'mutant = "{after}"\nreason = "why"\n'
            for function, before, after, _ in identities
        ]
        (self.unit.folder / "equivalent.toml").write_text("\n".join(entries), encoding="utf-8")

    def keep(self) -> str:
        """Keep the verdicts."""
        return mutant_table.keep(self.unit, self.verdicts, ["it is so"], MADE_OF)


class Written(TableTest):
    """What is written, and read."""

    def test_the_text(self) -> None:
        self.assertEqual(self.keep(), "box: specs/mutation.toml written")
        [tools] = mutant_table.read(self.root).tools
        self.assertEqual(self.path.read_text("utf-8"), TEXT.replace("TOOLS", tools))

    def test_what_is_written_is_read_back(self) -> None:
        self.keep()
        results = mutant_table.read(self.root)
        self.assertEqual(results.made_of("box"), MADE_OF)
        self.assertEqual(mutant_table.text_of(results), self.path.read_text("utf-8"))
        record = results.unit["box"]
        self.assertEqual(
            record.summary,
            {
                "killed": 4,
                "survived": 0,
                "undecided": 1,
                "equivalent": 4,
                "stillborn": 1,
                "skipped": 0,
            },
        )
        self.assertEqual(record.open[0].original, 'abscissa = "x";')

    def test_tools_of_which_no_result_is_left_are_dropped(self) -> None:
        self.keep()
        mutant_table.keep(self.unit, self.verdicts, [], MADE_OF | {"cbmc": "6.7.0"})
        [tools] = mutant_table.read(self.root).tools.values()
        self.assertEqual(tools["cbmc"], "6.7.0")

    def test_units_with_the_same_tools_share_their_table(self) -> None:
        self.keep()
        other = Unit(self.root, "rtos", "axe")
        mutant_table.keep(other, self.verdicts[:4], [], MADE_OF | {"source": "3" * 64})
        results = mutant_table.read(self.root)
        self.assertEqual((list(results.unit), len(results.tools)), (["axe", "box"], 1))
        self.assertEqual(results.made_of("box"), MADE_OF)

    def test_without_the_file_there_is_no_result(self) -> None:
        self.assertEqual(mutant_table.read(self.root).unit, {})

    def test_what_was_not_tried_whole_is_not_kept(self) -> None:
        self.verdicts[0].status = "skipped"
        self.assertIn("left alone", self.keep())
        self.assertFalse(self.path.exists())

    def test_an_explanation_that_no_person_gave(self) -> None:
        self.accept(("f", "other", "b", 1))
        with self.assertRaisesRegex(ProjectError, "box: equivalent.toml has no reason for f:7 "):
            self.keep()
        self.assertFalse(self.path.exists())

    def test_the_table_of_this_project(self) -> None:
        text = (ROOT / mutant_table.FILE).read_text("utf-8")
        self.assertEqual(mutant_table.text_of(mutant_table.read(ROOT)), text)


class Refused(TableTest):
    """A table that is not whole, or of which the numbers do not fit together."""

    def setUp(self) -> None:
        super().setUp()
        self.text = TEXT.replace("TOOLS", "a")

    def refused(self, old: str, new: str, key: str, reason: str) -> None:
        """With `old` replaced, the file is refused: its name, the line of the key, and a reason."""
        self.assertIn(old, self.text)
        text = self.text.replace(old, new, 1)
        self.path.write_text(text, encoding="utf-8")
        lines = text.splitlines()
        line = next(number for number, one in enumerate(lines, 1) if one.startswith(key))
        with self.assertRaises(ToolError) as raised:
            mutant_table.read(self.root)
        said = str(raised.exception).splitlines()
        self.assertTrue(
            any(one.startswith(f"specs/mutation.toml:{line}: ") and reason in one for one in said),
            said,
        )

    def test_unchanged_it_is_read(self) -> None:
        self.path.write_text(self.text, encoding="utf-8")
        self.assertEqual(list(mutant_table.read(self.root).unit), ["box"])

    def test_a_key_that_is_missing(self) -> None:
        for key in mutant_table.Record.model_fields:
            with self.subTest(key):
                self.refused(
                    f"\n{key} = ", f"\n{key}x = ", "[unit.box]", f"unit: box: {key}: is missing"
                )

    def test_a_key_that_is_not_known(self) -> None:
        self.refused(
            "stillborn = 1",
            "stillborn = 1\nstilborn = 0",
            "stilborn",
            "unit: box: stilborn: unknown key; did you mean stillborn?",
        )
        self.refused("[unit.box]", "[units]\n[unit.box]", "[units]", "units: unknown key")

    def test_keys_within_a_line(self) -> None:
        self.refused(", wp = 1}", "}", "killed", "unit: box: killed: wp: is missing")
        self.refused("wp = 1}", "wp = 1, z3 = 0}", "killed", "unit: box: killed: z3: unknown key")
        self.refused(", line = 7", "", "accepted", "unit: box: accepted number 1: line: is missing")
        self.refused(", line = 5", "", "open", "unit: box: open number 1: line: is missing")

    def test_what_is_of_another_kind(self) -> None:
        for old, new in (
            ("mutants = 10", "mutants = 0"),
            ("stillborn = 1", "stillborn = -1"),
            ("stillborn = 1", 'stillborn = "1"'),
            ('proofs = "2', 'proofs = "x'),
            ("g = [9]", "g = []"),
            ("g = [9]", "g = [0]"),
            ("entry = 2", "entry = 0"),
            ("undecided", "killed"),
            ("keel_box__far_harness", ""),
        ):
            with self.subTest(new):
                key = next(line for line in self.text.splitlines() if old in line).split(" = ")[0]
                key = "open" if old == "undecided" else key
                self.refused(old, new, key, f"unit: box: {key}")

    def test_what_is_no_toml(self) -> None:
        self.refused('so"]', "so]", "problems", "no TOML")

    def test_counts_that_do_not_add_up(self) -> None:
        self.refused(
            "mutants = 10",
            "mutants = 11",
            "mutants",
            "unit: box: mutants: 11, but those that are counted below add up to 10",
        )
        for old, new in (
            ("[3, 3]", "[3]"),
            ("solved = 2", "solved = 1"),
            ("stillborn = 1", "stillborn = 0"),
            ("[{entry = 2, line = 7}]", "[]"),
        ):
            with self.subTest(new):
                self.refused(old, new, "mutants", "add up to 9")

    def test_kills_without_a_killer_and_the_other_way_round(self) -> None:
        self.refused(
            '["keel_box__far_harness", "keel_box_harness"]',
            "[]",
            "killers",
            "unit: box: killers: 0 harnesses, but 3 mutants",
        )
        self.refused(
            "executed = 1, solved = 2, wp = 1",
            "executed = 0, solved = 0, wp = 4",
            "killers",
            "unit: box: killers: 2 harnesses, but 0 mutants",
        )

    def test_what_is_named_twice(self) -> None:
        self.refused(
            '"keel_box_harness"',
            '"keel_box__far_harness"',
            "killers",
            "unit: box: killers: names something twice",
        )
        self.refused(
            "{entry = 2, line = 7}",
            "{entry = 2, line = 7}, {entry = 2, line = 8}",
            "accepted",
            "unit: box: accepted: names something twice",
        )

    def test_tools_that_are_not_there_and_tools_of_nobody(self) -> None:
        self.refused(
            'tools = "a"', 'tools = "b"', "tools", "unit: box: tools: there is no table [tools.b]"
        )
        self.refused('tools = "a"', 'tools = "b"', "[tools.a]", "no unit names it")


class ReasonsTest(unittest.TestCase):
    """proofs/*/equivalent.toml, as they stand."""

    def test_a_reason_is_about_a_line_that_the_unit_has(self) -> None:
        units = find_units(ROOT).values()
        gone = [stray for unit in units if unit.folder.is_dir() for stray in standing.strays(unit)]
        self.assertEqual(gone, [])
