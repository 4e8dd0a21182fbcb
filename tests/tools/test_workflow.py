# SPDX-License-Identifier: Apache-2.0
"""Tests of .github/workflows, .ci/run and of what docs/ci.md shows: what they call exists, and the
steps run, in a clone of another user as a container has it.

What is dear is not run but noted: provers, and the targets of make.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import Any

from makefile import rule_of, rules

from keel.install.packages import provide

provide("common")
provide("ci")
import yaml

from keel.base.git import is_clone
from keel.evidence.commands import commands_of
from keel.install import Toolchain
from keel.lint.workflows import schema_errors

ROOT = Path(__file__).resolve().parents[2]

WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
SETTING = r"-f +\S+|[A-Z_]+=(?:\"[^\"]*\"|'[^']*'|[^\s`]+)"
MAKE = re.compile(rf"(?:^|`|&& |run: )[ ]*make((?: +(?:{SETTING}|[a-z][\w-]*))+)", re.M)
NAMED = re.compile(r"\bNAME=")
PROVE = re.compile(r"tools/keel prove([^`\n]*)")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]+")


DOCUMENT = (ROOT / "docs/ci.md").read_text(encoding="utf-8")
USES = re.compile(r"uses: (\S+?)@(\S+)( # v\d+\.\d+\.\d+)?$", re.M)
# What steps are given of the run, as far as they look at it.
GIVEN = {
    "matrix.shard": "2",
    "github.event_name == 'schedule' && '1' || ''": "",
    "github.event_name == 'schedule' && '1' || '0'": "0",
}


def workflow(path: Path) -> dict[str, Any]:
    """A workflow."""
    read: dict[str, Any] = yaml.safe_load(path.read_text("utf-8"))
    return read


def jobs() -> dict[str, Any]:
    """The jobs of all workflows."""
    return {name: job for path in WORKFLOWS for name, job in workflow(path)["jobs"].items()}


def blocks(language: str) -> list[str]:
    """What docs/ci.md shows of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", DOCUMENT, re.M | re.S)


def texts() -> list[str]:
    """The workflows' steps, and the documents about CI."""
    steps = [str(step.get("run", "")) for job in jobs().values() for step in job["steps"]]
    return steps + [(ROOT / "docs" / name).read_text("utf-8") for name in ("ci.md", "own_unit.md")]


def commands() -> Iterator[str]:
    """The calls of make."""
    for text in texts():
        yield from (match[1].strip() for match in MAKE.finditer(text))


def proofs() -> list[str]:
    """The words for the program that proves, called directly or by make."""
    called = [match[1] for text in texts() for match in PROVE.finditer(text)]
    return called + [command for command in commands() if re.search(r"\bprove\b", command)]


class Workflows(unittest.TestCase):
    def test_the_workflow_proves_joins_and_tests(self) -> None:
        self.assertLessEqual({"prove", "verdict", "check"}, set(jobs()))
        said = " ".join(proofs())
        for option in ("--shard", "--join"):
            self.assertIn(option, said)

    def test_every_target_of_make_exists(self) -> None:
        for command in commands():
            file = "keel.mk" if "keel" in command else "Makefile"
            if NAMED.search(command):
                self.assertIn(rule_of(f"make {command}"), rules(file))
            for target in re.sub(SETTING, "", command).split():
                self.assertIn(target, rules(file), command)

    def test_every_option_of_prove_exists(self) -> None:
        helped = subprocess.run(
            [sys.executable, str(ROOT / "tools/keel"), "prove", "--help"],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        known = set(OPTION.findall(helped))
        asked = {option for command in proofs() for option in OPTION.findall(command)}
        self.assertIn("--explain", asked)
        self.assertLessEqual(asked, known)

    def test_all_shards_are_proved(self) -> None:
        job = jobs()["prove"]
        numbers = job["strategy"]["matrix"]["shard"]
        [command] = [step["run"] for step in job["steps"] if "--shard" in step.get("run", "")]
        self.assertIn(f'/{len(numbers)}" ', command)
        self.assertEqual(numbers, list(range(1, len(numbers) + 1)))

    def test_what_is_shown_and_kept_is_what_the_driver_writes(self) -> None:
        written = {"summary.md", "results.sarif", "junit.xml", "report.json", "determined.md"}
        text = "\n".join(path.read_text("utf-8") for path in WORKFLOWS)
        named = set(re.findall(r"build/prove/([\w.]+)", text)) - {"shard"}
        self.assertLessEqual({name for name in named if not name.startswith("shard")}, written)
        self.assertIn("bash .ci/run", text)
        self.assertTrue((ROOT / ".ci/run").is_file())

    def test_the_evidence_rests_on_the_other_jobs_and_is_kept(self) -> None:
        job = jobs()["evidence"]
        self.assertLessEqual({"verdict", "check"}, set(job["needs"]))
        kept = [
            step["with"]["path"]
            for step in job["steps"]
            if "upload-artifact" in step.get("uses", "")
        ]
        self.assertIn("build/evidence", kept)
        text = " ".join(str(step.get("run", "")) for step in job["steps"])
        self.assertIn("build/evidence-work/summary.md", text)
        program = (ROOT / "tools/keel/evidence/command.py").read_text("utf-8")
        self.assertIn('context.work / "summary.md"', program)

    def test_the_evidence_takes_the_proofs_and_all_reports(self) -> None:
        steps = jobs()["evidence"]["steps"]
        taken = {
            step["with"]["name"]: step["with"]["path"]
            for step in steps
            if "download-artifact" in step.get("uses", "")
        }
        self.assertEqual(taken, {"reports": "build", "proofs": "build/prove"})
        [made] = [step for step in steps if step.get("run") == "make evidence"]
        self.assertEqual(made["env"], {"KEEL_PROVED": "1"})

    def test_the_check_hands_over_each_report_that_the_evidence_is_made_from(self) -> None:
        [paths] = [
            step["with"]["path"].split()
            for step in jobs()["check"]["steps"]
            if step.get("with", {}).get("name") == "reports"
        ]
        reports = [f"build/{command.report}" for command in commands_of(ROOT)]
        left = [
            name for name in reports if not any(PurePosixPath(name).match(path) for path in paths)
        ]
        self.assertEqual(left, [])
        self.assertEqual(reports[0], "build/prove/report.json")
        self.assertIn("!build/prove/**", paths)

    def test_a_cache_is_renewed(self) -> None:
        """A key that stays is not saved again: what is known is kept under the run's own."""
        for job in jobs().values():
            for step in job["steps"]:
                if "actions/cache" in step.get("uses", "") and "tools" not in step["with"]["path"]:
                    self.assertIn("github.run_id", step["with"]["key"])
                    self.assertNotRegex(step["uses"], "^actions/cache@")

    def test_a_quarter_fits_its_limit_also_job_by_job_and_the_document_says_how_long(self) -> None:
        times = json.loads((ROOT / "proofs/times.json").read_text(encoding="utf-8"))
        minutes = sum(times.values()) / 60
        job = jobs()["prove"]
        quarter = minutes / len(job["strategy"]["matrix"]["shard"])
        self.assertLess(1.5 * quarter, job["timeout-minutes"])
        for said, known in (
            (r"jobs of (\d+) minutes in all", minutes),
            (r"(\d+) minutes for each machine", quarter / 3),
        ):
            [told] = re.findall(said, DOCUMENT)
            self.assertLess(abs(int(told) / known - 1), 0.2, said)

    def test_the_document_names_the_limits(self) -> None:
        for name, job in jobs().items():
            self.assertIn(f"| `{name}` | {job['timeout-minutes']} min |", DOCUMENT)

    def test_an_action_has_one_commit_wherever_it_is_used(self) -> None:
        texts = [path.read_text("utf-8") for path in WORKFLOWS] + [DOCUMENT]
        found = [match for text in texts for match in USES.findall(text)]
        self.assertEqual(len(found), sum(text.count("uses: ") for text in texts))
        pins: dict[str, set[tuple[str, str]]] = {}
        for action, commit, version in found:
            self.assertRegex(commit, r"^[0-9a-f]{40}$")
            repository = "/".join(action.split("/")[:2])
            pins.setdefault(repository, set()).add((commit, version))
        for repository, used in pins.items():
            self.assertEqual(len(used), 1, repository)
            self.assertNotIn("", [version for _, version in used], repository)

    def test_what_the_document_shows_has_the_form_of_its_host(self) -> None:
        packages = Path(Toolchain().command("ci-packages")[0])
        shown = {"github-workflows": [], "gitlab-ci": []}  # type: dict[str, list[str]]
        for text in blocks("yaml"):
            shown["github-workflows" if "runs-on" in text else "gitlab-ci"].append(text)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "ci.yml"
            for schema, texts in shown.items():
                self.assertEqual(len(texts), 1, schema)
                file.write_text(texts[0], encoding="utf-8")
                self.assertEqual(schema_errors(packages, file, schema), [])
                file.write_text(texts[0].replace("script:", "scripts:").replace("run:", "rn:"))
                self.assertNotEqual(schema_errors(packages, file, schema), [])

    def test_documents_are_checked_by_the_one_workflow_or_the_other(self) -> None:
        read = {path.name: workflow(path)[True] for path in WORKFLOWS}  # `on`, as YAML 1.1 reads.
        for event in ("push", "pull_request"):
            left_out = read["ci.yml"][event]["paths-ignore"]
            self.assertEqual(left_out, read["documents.yml"][event]["paths"])


NOTING = """\
#!/bin/sh
printf '%s' "${0##*/}" >> "$NOTED"
for word; do printf ' %s' "$word" >> "$NOTED"; done
echo >> "$NOTED"
"""
PYTHON = """\
case "$1 $2" in "tools/keel prove") exit ${PROVED:-0};; esac
exec "$PYTHON" "$@"
"""


class Steps(unittest.TestCase):
    """What jobs run, in a clone of another user, where make and provers only note their words."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.clone = self.folder / "clone"
        self.noted = self.folder / "noted"
        for name, more in (("make", ""), ("python3", PYTHON)):
            path = self.folder / "bin" / name
            path.parent.mkdir(exist_ok=True)
            path.write_text(NOTING + more, encoding="utf-8")
            path.chmod(0o755)

    def cloned(self) -> None:
        """Make the clone, which belongs to another user where that can be had."""
        if not is_clone(ROOT):
            self.skipTest("a release archive cannot be cloned")
        # Without --no-hardlinks the other user would be given the objects of this clone, too.
        subprocess.run(
            ["git", "clone", "-q", "--no-hardlinks", ROOT, self.clone],
            check=True,
            env={**os.environ, **workflow(WORKFLOWS[0])["env"]},
        )
        if os.geteuid() == 0:
            for path in (self.clone, *self.clone.rglob("*")):
                os.chown(path, 1234, 1234, follow_symlinks=False)

    def bare(self) -> dict[str, str]:
        """The variables of a machine of CI, before the workflow's."""
        kept = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith(("GIT_", "KEEL_", "SUDO_", "MAKE"))
        }
        return {
            **kept,
            "HOME": str(self.folder),
            "GIT_CONFIG_NOSYSTEM": "1",
            "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}",
            "NOTED": str(self.noted),
            "PYTHON": sys.executable,
            "GITHUB_STEP_SUMMARY": str(self.folder / "summary"),
            "GIT_TEST_ASSUME_DIFFERENT_OWNER": "1",
        }

    def run_in(self, text: str, **variables: str) -> subprocess.CompletedProcess[str]:
        """Run a script as a container's shell does."""
        return subprocess.run(
            ["sh", "-e", "-c", text],
            cwd=self.clone,
            text=True,
            check=False,
            env={**self.bare(), **variables},
            timeout=300,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )

    def notes(self) -> list[str]:
        """What was asked of make and of Python."""
        text = self.noted.read_text(encoding="utf-8") if self.noted.is_file() else ""
        self.noted.unlink(missing_ok=True)
        return text.splitlines()

    def test_every_workflow_has_git_read_a_clone_of_another_user(self) -> None:
        self.cloned()
        ask = (
            f'PYTHONPATH=tools exec "{sys.executable}" -c "from pathlib import Path;'
            "from keel.base.source import stamp_of; print(stamp_of(Path.cwd())['commit'])\""
        )
        refused = self.run_in(ask)
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("detected dubious ownership", refused.stdout)
        commit = self.run_in("git rev-parse HEAD", **workflow(WORKFLOWS[0])["env"]).stdout
        self.assertRegex(commit, r"^[0-9a-f]{40}\n$")
        for path in WORKFLOWS:
            self.assertEqual(self.run_in(ask, **workflow(path)["env"]).stdout, commit)

    def step_of(self, job: str, part: str) -> tuple[str, dict[str, str]]:
        """A step's script, and its variables in the run that GIVEN tells of."""
        [step] = [one for one in jobs()[job]["steps"] if part in one.get("run", "")]
        told = {
            name: re.sub(r"\$\{\{ (.*?) \}\}", lambda found: GIVEN[found[1]], str(value))
            for name, value in step.get("env", {}).items()
        }
        return step["run"], told

    def test_what_each_step_asks_for(self) -> None:
        self.clone.mkdir()
        for job, part, asked in (
            ("prove", "--shard", ["python3 tools/keel prove --shard 2/4"]),
            ("evidence", "make evidence", ["make evidence"]),
            ("documents", "make lint", ["make lint"]),
            (
                "documents",
                "make test",
                ["make test ARGS=--filter tools/docs", "make test ARGS=--filter tools/workflow"],
            ),
        ):
            script, variables = self.step_of(job, part)
            ended = self.run_in(script, **variables)
            self.assertEqual((ended.returncode, self.notes()), (0, asked), ended.stdout)

    def test_once_a_week_all_is_proved_anew(self) -> None:
        self.clone.mkdir()
        script, _ = self.step_of("prove", "--shard")
        self.run_in(script, SHARD="3", FRESH="1")
        self.assertEqual(self.notes(), ["python3 tools/keel prove --shard 3/4 --fresh"])

    def test_the_join_takes_the_reports_of_all_shards(self) -> None:
        shards = self.clone / "build/shards"
        shards.mkdir(parents=True)
        for number in (1, 2):
            (shards / f"shard-{number}-of-2.json").touch()
        script, _ = self.step_of("verdict", "--join")
        self.run_in(script)
        self.assertEqual(
            self.notes(),
            [
                "python3 tools/keel prove --join build/shards/"
                "shard-1-of-2.json build/shards/shard-2-of-2.json"
            ],
        )

    def test_the_summaries_are_shown(self) -> None:
        for job, file in (("verdict", "prove"), ("evidence", "evidence-work")):
            path = self.clone / "build" / file / "summary.md"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"{job}\n", encoding="utf-8")
            script, _ = self.step_of(job, "GITHUB_STEP_SUMMARY")
            self.assertEqual(self.run_in(script).returncode, 0)
        shown = (self.folder / "summary").read_text(encoding="utf-8")
        self.assertEqual(shown, "verdict\nevidence\n")

    def checked(self, **variables: str) -> tuple[list[str], str]:
        """What .ci/run asks for, and what it says."""
        (self.clone / ".ci").mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / ".ci/run", self.clone / ".ci/run")
        ended = self.run_in("bash .ci/run", **variables)
        self.assertEqual(ended.returncode, 1)  # No report of tests was written.
        return [note for note in self.notes() if "-c" not in note.split()[1]], ended.stdout

    def test_where_others_prove_the_check_neither_proves_nor_makes_evidence(self) -> None:
        self.clone.mkdir()
        script, variables = self.step_of("check", ".ci/run")
        self.assertEqual(script, "bash .ci/run")
        asked, _ = self.checked(**variables)
        words = [" ".join(note.split()[1:3]) for note in asked]
        made = {note.split()[1] for note in asked}
        self.assertNotIn("tools/keel prove", words)
        self.assertTrue({"prove", "prove-all", "evidence"}.isdisjoint(made))
        self.assertLessEqual({"test-all", "lint", "firmware", "test-target", "coverage"}, made)

    def test_on_one_machine_all_is_proved_and_the_evidence_made_at_last(self) -> None:
        asked, said = self.checked(KEEL_FRESH="1", KEEL_LONG="1")
        self.assertEqual(
            asked[:3],
            [
                "make python",
                "python3 tools/keel prove --kernel --fresh",
                "python3 tools/keel prove --fresh",
            ],
        )
        self.assertEqual(asked[-1], "make evidence")
        self.assertIn("--- tools/keel prove --fresh: passed\n", said)

    def test_the_long_checks_are_asked_for_by_a_variable(self) -> None:
        long = {"test-all", "coverage", "fly", "evidence"}
        for value in ("", "0", "1"):
            asked, _ = self.checked(KEEL_LONG=value)
            made = {note.split()[1] for note in asked}
            named = {word for note in asked for word in note.split() if word.startswith("NAME=")}
            with self.subTest(value):
                self.assertLessEqual({"firmware", "test-target", "lint", "analyze", "bench"}, made)
                self.assertIn("python3 tools/keel prove", asked)
                self.assertEqual(made & long, long if value == "1" else set())
                self.assertEqual("test" in made, value != "1")
                self.assertEqual("NAME=qualify" in named, value == "1")

    def test_what_is_not_proved_is_told_apart_from_what_could_not_be_tried(self) -> None:
        for status, word in ((1, "not proved"), (2, "could not be tried (exit status 2)")):
            _, said = self.checked(PROVED=str(status))
            self.assertIn(f"--- tools/keel prove --kernel: FAILED, {word}\n", said)
