# SPDX-License-Identifier: Apache-2.0
"""Tests of the evidence package's frame: what is wrong is named, and nothing wrong is packed.

The parts are a small sample's; each part's own faults are in test_evidence_<part>.py.
"""

from __future__ import annotations

import contextlib
import io
import json
import shutil
import subprocess
import tempfile
import unittest
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any
from unittest import mock

from evidence_sample import SOURCE, STAMP, assembled, formal, sample_tests

from keel.base.errors import ToolError
from keel.base.files import write_json
from keel.base.junit import JUnitSuite, write_junit
from keel.base.source import STAMP as MADE_FROM
from keel.base.source import stamp_of
from keel.evidence import command
from keel.evidence.assemble import PARTS, maker_of
from keel.evidence.attestation import PREDICATE
from keel.evidence.measured import copied
from keel.evidence.package import (
    ATTESTATION,
    MANIFEST,
    SUMS,
    Source,
    digests,
    source_of,
    write_package,
)
from keel.evidence.verify import reproduced, verify
from keel.gather.part import Context, Item, Part, Table
from keel.install import ToolchainError
from keel.install.packages import provide

ROOT = Path(__file__).resolve().parents[2]


def write_sample(folder: Path) -> Path:
    """Make the sample's package."""
    place = folder / "evidence"
    write_package(place, assembled(folder), SOURCE, {"cbmc": "6.6.0"})
    return place


@cache
def sample_package() -> Path:
    """The sample's package, made once."""
    folder = tempfile.mkdtemp()
    unittest.addModuleCleanup(shutil.rmtree, folder)
    return write_sample(Path(folder))


class InFolder(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def problems(self, **parts: Callable[[Context], Part]) -> list[str]:
        """What is wrong with the sample when some parts are others."""
        return assembled(self.folder, **parts).problems

    def package(self) -> Path:
        """A copy of the sample's package, whole and sealed."""
        return Path(shutil.copytree(sample_package(), self.folder / "evidence", dirs_exist_ok=True))


def added(*items: Item, **facts: Any) -> Callable[[Context], Part]:
    """The sample's tests with more items, or other facts."""
    part = sample_tests()
    return lambda _: part.model_copy(update={"items": (*part.items, *items), **facts})


class Parts(InFolder):
    def test_a_sound_sample_has_no_problem(self) -> None:
        self.assertEqual(self.problems(), [])

    def test_what_a_part_finds_is_told_with_its_name(self) -> None:
        self.assertEqual(
            self.problems(tests=added(problems=("test_x fails",))), ["tests: test_x fails"]
        )

    def test_an_absent_part(self) -> None:
        with self.assertRaisesRegex(ToolError, r"no tools/keel/gather/parts/nonesuch\.py"):
            maker_of("nonesuch")

        def absent(_: Context) -> Part:
            raise ToolError("is missing")

        self.assertIn("formal: is missing", self.problems(formal=absent))

    def test_a_missing_tool(self) -> None:
        def without(_: Context) -> Part:
            raise ToolchainError("frama-c is missing; run: tools/keel tools ensure prove")

        told = self.problems(formal=without)
        self.assertTrue(any("formal: frama-c is missing" in line for line in told), told)

    def test_a_report_with_another_content_than_its_reader_takes_for_granted(self) -> None:
        def stumbles(_: Context) -> Part:
            report: dict[str, str] = {}
            return Part(name="tests", title=report["units"])

        self.assertEqual(
            self.problems(tests=stumbles), ["tests: cannot be made: KeyError: 'units'"]
        )

    def test_a_link_that_leads_nowhere(self) -> None:
        lost = Item(kind="test", id="unit/x/y", title="y", links=("requirement:QUE-999",))
        told = "tests: test:unit/x/y links to requirement:QUE-999, which is nowhere"
        self.assertEqual(self.problems(tests=added(lost)), [told])

    def test_a_cell_that_leads_nowhere_and_a_row_that_is_too_short(self) -> None:
        table = Table(title="T", columns=("a", "b"), rows=(("goal:no/where", "1"), ("x",)))
        self.assertEqual(
            self.problems(tests=added(tables=(table,))),
            [
                "tests: table 'T' names goal:no/where, which is nowhere",
                "tests: table 'T' has an uneven row: ('x',)",
            ],
        )

    def test_a_removed_harness_leaves_links_to_nothing(self) -> None:
        part = formal()
        left = tuple(item for item in part.items if item.kind != "harness")
        told = self.problems(formal=lambda _: part.model_copy(update={"items": left}))
        self.assertTrue(
            any("harness:queue/keel_queue_init_harness, which is nowhere" in line for line in told),
            told,
        )

    def test_an_item_twice_in_one_part(self) -> None:
        self.assertEqual(
            self.problems(tests=added(sample_tests().items[0])),
            ["tests: test:unit/test_queue/test_0_adds is there twice"],
        )

    def test_something_bad_of_which_no_problem_speaks(self) -> None:
        failed = Item(kind="test", id="unit/x/y", title="expected 1, was 2", state="bad")
        self.assertEqual(
            self.problems(tests=added(failed)), ["tests: test:unit/x/y is bad: expected 1, was 2"]
        )
        told = added(failed, problems=("unit/x/y: expected 1, was 2",))
        self.assertEqual(self.problems(tests=told), ["tests: unit/x/y: expected 1, was 2"])

    def test_a_file_that_is_not_there(self) -> None:
        gone = self.folder / "gone.xml"
        self.assertEqual(
            self.problems(tests=added(files={"junit.xml": gone})),
            [f"tests: junit.xml: is missing: {gone}"],
        )

    def test_parts_that_speak_of_one_thing_are_joined(self) -> None:
        more = Item(
            kind="function",
            id="keel_queue_init",
            title="",
            text="Not reached: line 7",
            state="open",
            links=("assumption:A-01",),
        )
        entry = assembled(self.folder, tests=added(more)).entries["function:keel_queue_init"]
        self.assertEqual([part for part, _ in entry.items], ["formal", "tests"])
        self.assertEqual((entry.title, entry.state), ("Empties a queue", "open"))
        self.assertIn("unit:queue", entry.links)
        self.assertIn("assumption:A-01", entry.links)
        self.assertIn("harness:queue/keel_queue_init_harness", entry.back)

    def test_every_part_of_the_package_has_a_module(self) -> None:
        there = {path.stem for path in (ROOT / "tools/keel/gather/parts").glob("[a-z]*.py")}
        self.assertLessEqual(there, set(PARTS))


class Packages(InFolder):
    """What a finished package is, and whether a change of it is noticed."""

    def test_one_that_nobody_touched_is_verified(self) -> None:
        place = self.package()
        self.assertEqual(verify(place, STAMP), [])
        for name in ("index.html", "evidence.pdf", MANIFEST, SUMS, ATTESTATION, "tests/part.json"):
            self.assertTrue((place / name).is_file(), name)

    def test_two_of_one_source_are_the_same_bytes(self) -> None:
        first = digests(self.package())
        self.assertEqual(first, digests(write_sample(self.folder / "again")))
        self.assertGreater(len(first), 40)

    def test_an_altered_file(self) -> None:
        place = self.package()
        page = place / "site/style.css"
        page.write_text(page.read_text(encoding="utf-8") + " ", encoding="utf-8")
        told = verify(place, STAMP)
        self.assertIn(f"site/style.css: was altered, {SUMS} has another digest", told)
        self.assertIn(f"site/style.css: was altered, {ATTESTATION} has another digest", told)

    def test_a_missing_file(self) -> None:
        place = self.package()
        (place / "formal/part.json").unlink()
        self.assertIn(f"formal/part.json: is missing, {SUMS} has it", verify(place, STAMP))

    def test_an_added_file(self) -> None:
        place = self.package()
        (place / "tests/more.txt").write_text("x", encoding="utf-8")
        self.assertIn(f"tests/more.txt: was added, {SUMS} does not have it", verify(place, STAMP))

    def test_checksums_that_were_made_anew_after_a_change(self) -> None:
        place = self.package()
        (place / "index.html").write_text("all is well", encoding="utf-8")
        lines = [f"{digest}  {name}\n" for name, digest in digests(place, (SUMS,)).items()]
        (place / SUMS).write_text("".join(lines), encoding="utf-8")
        told = f"index.html: was altered, {ATTESTATION} has another digest"
        self.assertEqual(verify(place, STAMP), [told])

    def test_half_written_checksums_attestation_and_manifest(self) -> None:
        place = self.package()
        sums = (place / SUMS).read_text(encoding="utf-8")
        (place / SUMS).write_text(sums[: sums.rindex("\n", 0, -1) + 11], encoding="utf-8")
        with self.assertRaisesRegex(ToolError, rf"{SUMS}:\d+: expected a SHA-256 and a name"):
            verify(place, STAMP)
        place = self.package()
        (place / ATTESTATION).write_text('{"subject": ', encoding="utf-8")
        self.assertTrue(
            any(
                line.startswith(f"{ATTESTATION}: is missing or not whole")
                for line in verify(place, STAMP)
            )
        )
        (place / MANIFEST).write_text('{"schema"', encoding="utf-8")
        with self.assertRaisesRegex(ToolError, f"{MANIFEST}: is not whole"):
            verify(place, STAMP)

    def test_one_of_another_commit_or_source(self) -> None:
        place = self.package()
        other = {**STAMP, "commit": "0" * 40}
        self.assertEqual(verify(place, other), [f"made from commit {'c' * 40}, here is {'0' * 40}"])
        told = ["the source here is not the one that the package was made from"]
        self.assertEqual(verify(place, {**STAMP, "tree": "0" * 64}), told)

    def test_a_folder_that_is_none(self) -> None:
        with self.assertRaisesRegex(ToolError, "there is no such folder"):
            verify(self.folder / "x", STAMP)
        with self.assertRaisesRegex(ToolError, "is no evidence package"):
            verify(self.folder, STAMP)

    def test_the_attestation_names_each_file_and_the_source(self) -> None:
        place = self.package()
        read = json.loads((place / ATTESTATION).read_text(encoding="utf-8"))
        self.assertEqual(read["_type"], "https://in-toto.io/Statement/v1")
        named = {one["name"]: one["digest"]["sha256"] for one in read["subject"]}
        self.assertEqual(named, digests(place, (SUMS, ATTESTATION)))
        source = read["predicate"]["buildDefinition"]["resolvedDependencies"][0]
        self.assertEqual(source["digest"]["gitCommit"], STAMP["commit"])

    def test_the_attestation_is_one_of_in_totos_with_slsas_provenance(self) -> None:
        provide("attestation")
        from google.protobuf.json_format import Parse, ParseDict
        from in_toto_attestation.predicates.provenance.v1.provenance_pb2 import Provenance
        from in_toto_attestation.v1.statement import Statement
        from in_toto_attestation.v1.statement_pb2 import Statement as Read

        text = (self.package() / ATTESTATION).read_text(encoding="utf-8")
        Statement.copy_from_pb(Parse(text, Read())).validate()
        made = ParseDict(json.loads(text)["predicate"], Provenance())
        self.assertEqual(made.build_definition.external_parameters["command"], "make evidence")
        bare = text.replace('"predicateType"', '"predicate_type"').replace(PREDICATE, "")
        with self.assertRaisesRegex(ValueError, "Predicate type required"):
            Statement.copy_from_pb(Parse(bare, Read())).validate()

    def test_the_json_of_a_part_says_all_that_it_says(self) -> None:
        report = self.folder / "junit.xml"
        report.write_text("<testsuite/>", encoding="utf-8")
        made = assembled(self.folder, tests=added(files={"a/junit.xml": report}))
        write_package(self.folder / "evidence", made, SOURCE, {})
        part = json.loads((self.folder / "evidence/tests/part.json").read_text(encoding="utf-8"))
        self.assertEqual(part["schema"], 1)
        self.assertEqual(len(part["items"]), len(sample_tests().items))
        self.assertEqual(list(part["files"]), ["a/junit.xml"])
        self.assertTrue((self.folder / "evidence/tests/a/junit.xml").is_file())

    def test_a_file_that_would_lead_out_of_the_package(self) -> None:
        report = self.folder / "junit.xml"
        report.write_text("<testsuite/>", encoding="utf-8")
        made = assembled(self.folder, tests=added(files={"../../x": report}))
        with self.assertRaisesRegex(ToolError, "leads out of the package"):
            write_package(self.folder / "evidence", made, SOURCE, {})
        self.assertFalse((self.folder / "evidence").exists())


class Measured(InFolder):
    """Two packages of one source, made from reports with other times."""

    def made(self, name: str, times: float, **facts: Any) -> Path:
        """The sample, with a report of the tests that took this long."""
        folder = self.folder / name
        folder.mkdir()
        report = {"suites": {"unit/queue": {"seconds": times, "passed": 1}}, MADE_FROM: STAMP}
        write_json(folder / "report.json", report)
        write_junit(folder / "junit.xml", "Keel", {"queue": JUnitSuite({"it_adds": ""}, times)})
        files = {one: folder / one for one in ("report.json", "junit.xml")}
        took = {"queue/wp/lemmas": times}
        part = added(files=files, measured=took, **facts)
        write_package(folder / "evidence", assembled(folder, tests=part), SOURCE, {})
        return folder / "evidence"

    def test_they_differ_in_one_file_its_page_and_their_digests(self) -> None:
        one, other = self.made("one", 1.5), self.made("other", 22.25)
        self.assertEqual(reproduced(one, other), [])
        before, after = digests(one), digests(other)
        self.assertEqual(before.keys(), after.keys())
        self.assertEqual(
            {name for name in before if before[name] != after[name]},
            {"measured.json", "site/measured.html", ATTESTATION, SUMS},
        )
        page = (other / "site/measured.html").read_text(encoding="utf-8")
        self.assertIn("<td>22.2</td><td>queue/wp/lemmas</td>", page)
        read = json.loads((other / "measured.json").read_text(encoding="utf-8"))
        self.assertEqual(
            read["seconds"]["tests"],
            {"queue/wp/lemmas": 22.25, "report.json/suites/unit/queue": 22.25},
        )
        for name in ("report.json", "junit.xml"):
            self.assertNotIn("22.25", (other / "tests" / name).read_text(encoding="utf-8"))
        self.assertIn('"passed": 1', (other / "tests/report.json").read_text(encoding="utf-8"))
        self.assertEqual(verify(other, STAMP), [])

    def test_a_time_anywhere_else_is_found(self) -> None:
        one = self.made("one", 1.5, summary={"seconds": "1.5"})
        told = reproduced(one, self.made("other", 2.5, summary={"seconds": "2.5"}))
        for name in ("tests/part.json", MANIFEST, "index.html", "evidence.pdf"):
            self.assertIn(f"{name}: was altered, {one} has another digest", told)

    def test_an_attestation_or_checksums_that_state_something_else(self) -> None:
        one, other = self.made("one", 1.5), self.made("other", 2.5)
        text = (other / ATTESTATION).read_text(encoding="utf-8")
        (other / ATTESTATION).write_text(
            text.replace('"tools": {}', '"tools": {"z3": "4"}'), encoding="utf-8"
        )
        told = f"{ATTESTATION}: states something else than in {one}"
        self.assertEqual(reproduced(one, other), [told])
        sums = (other / SUMS).read_text(encoding="utf-8").splitlines(keepends=True)
        (other / SUMS).write_text("".join(sums[:-1]), encoding="utf-8")
        self.assertIn(f"{SUMS}: states other digests than in {one}", reproduced(one, other))

    def test_one_of_another_source(self) -> None:
        one, other = self.made("one", 1.5), self.made("other", 1.5)
        read = json.loads((other / MANIFEST).read_text(encoding="utf-8"))
        write_json(other / MANIFEST, {**read, MADE_FROM: {**STAMP, "commit": "0" * 40}})
        self.assertEqual(reproduced(one, other), [f"{other}: is of another source than {one}"])

    def test_what_is_no_report_is_packed_as_it_is(self) -> None:
        path = self.folder / "lock.json"
        path.write_text('{"seconds": 3}', encoding="utf-8")
        self.assertEqual(copied("lock.json", path), (b'{"seconds": 3}', {}))


class Program(InFolder):
    """tools/keel evidence with the sample's parts."""

    def setUp(self) -> None:
        super().setUp()
        self.program = command
        self.out = self.folder / "out"

    def run_it(
        self, *words: str, as_is: tuple[str, ...] = ("--as-is",), **parts: Callable[[Context], Part]
    ) -> tuple[int, list[str]]:
        def sample(context: Context) -> Any:
            return assembled(self.folder, **parts)

        said = io.StringIO()
        with (
            mock.patch.object(self.program, "assemble", sample),
            mock.patch.object(self.program, "stamp_of", lambda _: STAMP),
            mock.patch.object(self.program, "source_of", lambda *_: self.source),
            contextlib.redirect_stdout(said),
            contextlib.redirect_stderr(said),
        ):
            status = self.program.main([*as_is, "--out", str(self.out), *words])
        return status, said.getvalue().splitlines()

    source = SOURCE

    def test_it_writes_a_package_and_verifies_it(self) -> None:
        status, lines = self.run_it()
        self.assertEqual(status, 0, lines)
        self.assertRegex(lines[-1], r"^evidence: .*/out is written, in \d+ s$")
        short = (self.folder / "out-work/summary.md").read_text(encoding="utf-8")
        self.assertIn("**Complete.**", short)
        self.assertIn("| Requirements | requirements: 24 |", short)
        status, lines = self.run_it("--verify", str(self.out))
        self.assertEqual((status, len(lines)), (0, 1), lines)
        self.assertIn(f"evidence: {self.out} is as it was made", lines[0])
        (self.out / "index.html").unlink()
        status, lines = self.run_it("--verify", str(self.out))
        self.assertEqual(status, 1)
        self.assertIn(f"FAILED index.html: is missing, {SUMS} has it", lines)

    def test_where_others_prove_nothing_is_run_without_their_report(self) -> None:
        with (
            mock.patch.object(self.program, "run_commands") as run,
            mock.patch.object(self.program, "foreseen", return_value=[]),
            mock.patch.object(self.program, "handed_over", return_value=["refused"]),
            mock.patch.object(self.program, "Toolchain"),
        ):
            status, lines = self.run_it(as_is=())
        run.assert_not_called()
        self.assertEqual((status, lines[0]), (1, "FAILED refused"))
        self.assertIn("no command is run", lines[-1])

    def test_with_a_problem_it_leaves_what_was_there(self) -> None:
        self.run_it()
        before = digests(self.out)
        status, lines = self.run_it(tests=added(problems=("test_x fails",)))
        self.assertEqual(status, 1)
        self.assertIn("FAILED tests: test_x fails", lines)
        self.assertRegex(lines[-1], r"^evidence: 1 problem, nothing is written")
        short = (self.folder / "out-work/summary.md").read_text(encoding="utf-8")
        self.assertIn("**Failed: 1 problems.**", short)
        self.assertIn("- tests: test_x fails", short)
        self.assertEqual(digests(self.out), before)
        self.assertEqual([path.name for path in self.folder.glob(".*")], [])

    def test_a_draft_shows_the_problems_and_is_not_sealed(self) -> None:
        draft = self.folder / "draft"
        lost = Item(kind="test", id="unit/x/y", title="y", links=("requirement:QUE-999",))
        status, _ = self.run_it("--draft", str(draft), tests=added(lost))
        self.assertEqual(status, 1)
        self.assertIn(
            "requirement:QUE-999, which is nowhere",
            (draft / "index.html").read_text(encoding="utf-8"),
        )
        self.assertFalse((draft / SUMS).exists())
        self.assertFalse(self.out.exists())

    def test_a_source_that_is_not_committed_is_refused(self) -> None:
        self.source = Source(STAMP, 1, ("src/rtos/queue.c",))
        status, lines = self.run_it()
        self.assertEqual(status, 1)
        self.assertIn(
            "FAILED src/rtos/queue.c: is not as the commit has it: commit it, or say --dirty", lines
        )
        self.assertEqual(self.run_it("--dirty")[0], 0)
        told = json.loads((self.out / MANIFEST).read_text(encoding="utf-8"))
        self.assertEqual(told["not_as_committed"], ["src/rtos/queue.c"])


class Sources(InFolder):
    def git(self, *words: str) -> None:
        who = ["-c", "user.name=a", "-c", "user.email=a@b"]
        subprocess.run(["git", *who, *words], cwd=self.folder, check=True, capture_output=True)

    def test_a_change_after_the_commit_is_seen_and_changes_the_stamp(self) -> None:
        (self.folder / "src").mkdir()
        code = self.folder / "src/a.c"
        code.write_text("int a;\n", encoding="utf-8")
        self.git("init", "-q")
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "x", "--date=2026-01-02T03:04:05Z")
        first = stamp_of(self.folder)
        self.assertEqual(source_of(self.folder, first).changed, ())
        self.assertGreater(source_of(self.folder, first).seconds, 0)
        code.write_text("int b;\n", encoding="utf-8")
        second = stamp_of(self.folder)
        self.assertNotEqual(first["product"], second["product"])
        self.assertEqual(source_of(self.folder, second).changed, ("src/a.c",))

    def test_an_archive_has_no_commit_and_no_time(self) -> None:
        (self.folder / "a").write_text("a", encoding="utf-8")
        stamp = stamp_of(self.folder)
        self.assertEqual((stamp["commit"], source_of(self.folder, stamp).seconds), ("", 0))
