# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/common: programs, files, checked TOML and JSON, builds, reports."""

from __future__ import annotations

import contextlib
import errno
import io
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Annotated, ClassVar, NoReturn
from unittest import mock
from xml.etree import ElementTree

from keel.base.arguments import Parser
from keel.base.build import Build, BuildError, source_files
from keel.base.errors import ToolError, nearest, program, unknown
from keel.base.files import write_json, write_text
from keel.base.git import commit_of, git
from keel.base.junit import JUnitSuite, write_junit
from keel.base.run import output_of, run
from keel.base.source import stamp_of
from keel.config import ConfigError, Field, Mistake, Table, Text, read_json, read_toml

ROOT = Path(__file__).resolve().parents[2]


class FolderTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, text: str, name: str = "file.toml") -> Path:
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path


class Git(FolderTest):
    """A clone, an archive, and a git that fails are three things."""

    # Neither the user's settings nor those of CI may make a strange owner trusted.
    ALONE: ClassVar = {
        "HOME": "/nowhere",
        "XDG_CONFIG_HOME": "/nowhere",
        "GIT_CONFIG_NOSYSTEM": "1",
        "GIT_CONFIG_COUNT": "0",
    }

    def setUp(self) -> None:
        super().setUp()
        patched = mock.patch.dict(os.environ, self.ALONE)
        patched.start()
        self.addCleanup(patched.stop)

    def real(self, *words: str) -> str:
        who = ["-c", "user.name=a", "-c", "user.email=a@b"]
        done = subprocess.run(
            ["git", *who, *words], cwd=self.folder, check=True, capture_output=True, text=True
        )
        return done.stdout

    def clone(self) -> str:
        """Make the folder a clone with a commit, which it gives."""
        self.real("init", "-q")
        self.real("commit", "-q", "--allow-empty", "-m", "x")
        return self.real("log", "--format=%H").strip()

    def test_a_clone_has_a_commit(self) -> None:
        commit = self.clone()
        self.assertEqual(commit_of(self.folder), commit)

    def test_a_clone_before_its_first_commit_has_none(self) -> None:
        self.real("init", "-q")
        self.assertEqual(commit_of(self.folder), "")

    def test_an_archive_has_none_and_git_is_not_asked(self) -> None:
        with mock.patch.dict(os.environ, PATH="/nowhere"):
            self.assertEqual(commit_of(self.folder), "")

    def test_an_archive_within_another_clone_has_none(self) -> None:
        self.clone()
        (self.folder / "archive").mkdir()
        self.assertEqual(commit_of(self.folder / "archive"), "")

    def refused(self, words: str) -> None:
        for ask in (commit_of, stamp_of, lambda root: git(root, "ls-files")):
            with self.assertRaisesRegex(ToolError, words):
                ask(self.folder)

    def test_a_clone_that_git_does_not_trust_is_an_error_in_its_words(self) -> None:
        self.clone()
        with mock.patch.dict(os.environ, GIT_TEST_ASSUME_DIFFERENT_OWNER="1"):
            self.refused("git fails: fatal: detected dubious ownership(.|\n)*safe.directory")

    @unittest.skipUnless(os.geteuid() == 0, "root alone gives files away")
    def test_the_clone_of_another_user_is_an_error_unless_it_is_trusted(self) -> None:
        commit = self.clone()
        for path in (self.folder, *self.folder.rglob("*")):
            os.chown(path, 1234, 1234)
        with mock.patch.dict(os.environ):
            os.environ.pop("SUDO_UID", None)  # Whom git trusts, too.
            self.refused("git fails: fatal: detected dubious ownership")
            trusted = {
                "GIT_CONFIG_COUNT": "1",
                "GIT_CONFIG_KEY_0": "safe.directory",
                "GIT_CONFIG_VALUE_0": "*",
            }
            with mock.patch.dict(os.environ, trusted):
                self.assertEqual(commit_of(self.folder), commit)

    def test_a_broken_clone_is_an_error(self) -> None:
        (self.folder / ".git").write_text("gitdir: nowhere\n")
        self.refused("git fails: fatal: ")

    def test_a_clone_without_git_is_an_error(self) -> None:
        self.clone()
        with mock.patch.dict(os.environ, PATH="/nowhere"):
            self.refused("is a clone, but git does not start: git: No such file")


class Names(unittest.TestCase):
    def test_the_nearest_name_is_told(self) -> None:
        self.assertEqual(nearest("queu", ["clock", "queue", "voter"]), "queue")
        self.assertEqual(nearest("NUCLEO", ["mps2_an500", "nucleo_f767zi"]), "nucleo_f767zi")
        self.assertEqual(nearest("xyz", ["clock", "queue"]), "")
        self.assertEqual(nearest("", ["clock", "queue"]), "")

    def test_a_refusal_is_one_line(self) -> None:
        self.assertEqual(
            unknown("unit", "queu", ["clock", "queue"]),
            "there is no unit queu; did you mean queue? (units: clock, queue)",
        )
        self.assertEqual(unknown("unit", "", ["x"]), "there is no unit (none named) (units: x)")


class NotGood(ToolError):
    status = 1


class Programs(FolderTest):
    def told(self, body: NoReturn | object) -> tuple[int, str]:
        def raising() -> int:
            if isinstance(body, BaseException):
                raise body
            return 0

        with contextlib.redirect_stderr(io.StringIO()) as said:
            return program("tool", raising), said.getvalue()

    def test_what_a_tool_cannot_do_is_status_2(self) -> None:
        self.assertEqual(self.told(ToolError("no such unit")), (2, "tool: no such unit\n"))
        self.assertEqual(self.told(NotGood("too deep")), (1, "tool: too deep\n"))
        gone = FileNotFoundError(errno.ENOENT, "No such file or directory", "a.toml")
        self.assertEqual(self.told(gone), (2, "tool: a.toml: No such file or directory\n"))
        self.assertEqual(self.told(KeyboardInterrupt())[0], 130)
        self.assertEqual(self.told(None), (0, ""))

    def test_a_fault_of_the_program_itself_is_status_2_and_shows_where(self) -> None:
        status, said = self.told(KeyError("queue"))
        self.assertEqual(status, 2)
        self.assertIn("KeyError: 'queue'\ntool: a fault of the program itself\n", said)
        self.assertIn("in raising", said)

    def test_a_command_line_is_refused_in_one_line(self) -> None:
        parser = Parser("A tool.", prog="tool")
        parser.add_argument("--filter")
        with contextlib.redirect_stderr(io.StringIO()) as said:
            with self.assertRaises(SystemExit) as ended:
                parser.parse_args(["--filtre=x"])
        self.assertEqual(ended.exception.code, 2)
        [line] = said.getvalue().splitlines()
        self.assertIn("tool: unrecognized arguments: --filtre=x; did you mean --filter?", line)

    def test_the_streams_and_the_status_are_kept(self) -> None:
        script = "import sys; print('out'); print('err', file=sys.stderr); sys.exit(3)"
        ended = run([sys.executable, "-c", script], apart=True)
        self.assertEqual((ended.status, ended.output, ended.errors), (3, "out\n", "err\n"))
        self.assertEqual((ended.good, ended.how), (False, "exit status 3"))
        self.assertIn("err", run([sys.executable, "-c", script]).output)

    def test_a_hanging_program_is_killed_with_its_children(self) -> None:
        began = time.monotonic()
        ended = run(["sh", "-c", "echo begun; sleep 600 & sleep 600"], 2)
        self.assertLess(time.monotonic() - began, 300)
        self.assertTrue(ended.timed_out)
        self.assertEqual((ended.output, ended.good), ("begun\n", False))
        self.assertIn("hung", ended.how)

    def test_a_crash_and_a_missing_program_are_told(self) -> None:
        self.assertEqual(run(["sh", "-c", "kill -SEGV $$"]).how, "crashed: SIGSEGV")
        missing = run([self.folder / "nothing"])
        self.assertEqual(missing.status, 127)
        self.assertIn("nothing: No such file", missing.output)

    def test_the_evidence_of_a_sanitizer_comes_first(self) -> None:
        ended = run(["sh", "-c", "echo a; echo 'x.c:1: runtime error: y'; seq 50"])
        self.assertTrue(ended.evidence.startswith("x.c:1: runtime error: y\n1\n"))

    def test_the_words_of_a_failure_are_the_error(self) -> None:
        self.assertEqual(output_of(["echo", "hello"]), "hello\n")
        with self.assertRaisesRegex(ToolError, "sh: exit status 4\nbecause"):
            output_of(["sh", "-c", "echo because >&2; exit 4"])


class Files(FolderTest):
    def test_folders_are_made_and_the_file_is_readable(self) -> None:
        path = self.folder / "a" / "b.json"
        before = os.umask(0o022)
        self.addCleanup(os.umask, before)
        write_json(path, {"x": [1]})
        self.assertEqual(path.read_text(encoding="utf-8"), '{\n "x": [\n  1\n ]\n}\n')
        self.assertEqual(path.stat().st_mode & 0o777, 0o644)

    def test_a_full_disk_is_one_line_and_leaves_the_old_file(self) -> None:
        path = self.file("old", "report.json")
        full = OSError(errno.ENOSPC, "No space left on device")
        with mock.patch.object(Path, "write_bytes", side_effect=full):
            with self.assertRaisesRegex(ToolError, r"^cannot write .*report\.json: No space left"):
                write_text(path, "new")
        self.assertEqual(path.read_text(encoding="utf-8"), "old")
        self.assertEqual([item.name for item in self.folder.iterdir()], ["report.json"])

    @unittest.skipUnless(Path("/dev/full").exists(), "needs /dev/full")
    def test_a_device_that_is_really_full(self) -> None:
        """The file in which the text is drafted leads to a device that is always full."""
        with mock.patch("keel.base.files.threading.get_ident", return_value=7):
            draft = self.folder / f".report.json.{os.getpid()}-7"
            draft.symlink_to("/dev/full")
            with self.assertRaisesRegex(ToolError, r"report\.json: No space left on device$"):
                write_text(self.folder / "report.json", "text")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_writers_do_not_disturb_each_other(self) -> None:
        path = self.folder / "x"
        writers = [
            threading.Thread(target=write_text, args=(path, text * 100_000)) for text in "abcd"
        ]
        for writer in writers:
            writer.start()
        for writer in writers:
            writer.join()
        self.assertEqual(len(set(path.read_text(encoding="utf-8"))), 1)


class Entry(Table):
    id: Annotated[str, Field(pattern="^MD-[0-9]+$")]
    reason: Text
    limit: Annotated[int, Field(ge=1, le=9)] = 1


class Entries(Table):
    entry: list[Entry] = []


GOOD = '[[entry]]\nid = "MD-1"\nreason = "why"\n'


class Config(FolderTest):
    def refusal(self, text: str) -> str:
        with self.assertRaises(ConfigError) as caught:
            read_toml(self.file(text), Entries)
        return str(caught.exception).replace(f"{self.folder}/", "")

    def test_what_is_right_is_read(self) -> None:
        [entry] = read_toml(self.file(GOOD), Entries).entry
        self.assertEqual((entry.id, entry.reason, entry.limit), ("MD-1", "why", 1))
        self.assertEqual(read_toml(self.file(""), Entries).entry, [])
        text = '{"entry": [{"id": "MD-2", "reason": "x"}]}'
        self.assertEqual(read_json(self.file(text, "x.json"), Entries).entry[0].id, "MD-2")

    def test_each_mistake_is_a_line_with_file_line_key_and_reason(self) -> None:
        cases = {
            GOOD + "limit = 12\n": "file.toml:4: entry MD-1: limit: expected to be less than or "
            "equal to 9, found 12",
            GOOD + 'limit = "2"\n': "file.toml:4: entry MD-1: limit: expected to be a valid "
            "integer, found '2'",
            GOOD + "limt = 2\n": "file.toml:4: entry MD-1: limt: unknown key; did you mean limit?",
            GOOD.replace("why", ""): "file.toml:3: entry MD-1: reason: expected to have at least "
            "1 character, found ''",
            '\n[[entry]]\nid = "MD-1"\n': "file.toml:2: entry MD-1: reason: is missing",
            f"{GOOD}[[entry]]\n": "file.toml:4: entry number 2: id: is missing\n"
            "file.toml:4: entry number 2: reason: is missing",
            "entries = 1\n": "file.toml:1: entries: unknown key; did you mean entry?",
            "entry = 1\n": "file.toml:1: entry: expected to be a valid list, found 1",
            "a = 1\nb = \n": "file.toml:2: no TOML: Invalid value",
            "a = [": "file.toml:1: no TOML: Invalid value",
        }
        for text, wanted in cases.items():
            with self.subTest(text):
                self.assertEqual(self.refusal(text), wanted)

    def test_what_types_cannot_say_is_told_in_the_same_way(self) -> None:
        twice = GOOD + GOOD

        def check(entries: Entries) -> list[Mistake]:
            return [(("entry", n, "id"), "is taken") for n in range(1, len(entries.entry))]

        with self.assertRaisesRegex(ConfigError, r"file\.toml:5: entry MD-1: id: is taken$"):
            read_toml(self.file(twice), Entries, check)
        self.assertEqual(len(read_toml(self.file(GOOD), Entries, check).entry), 1)

    def test_json_and_missing_files_are_refused(self) -> None:
        with self.assertRaisesRegex(ConfigError, r"x\.json:2: no JSON: "):
            read_json(self.file("{\n,", "x.json"), Entries)
        with self.assertRaisesRegex(ConfigError, r"x\.json: entry number 1: id: is missing"):
            read_json(self.file('{"entry": [{"reason": "x"}]}', "x.json"), Entries)
        with self.assertRaisesRegex(ToolError, "nothing.toml: cannot be read: No such file"):
            read_toml(self.folder / "nothing.toml", Entries)
        self.file(GOOD, "units.toml")
        with self.assertRaisesRegex(ToolError, r"unit\.toml: .*; did you mean .*/units\.toml\?$"):
            read_toml(self.folder / "unit.toml", Entries)
        (self.folder / "latin.toml").write_bytes(b"x = '\xe9'")
        with self.assertRaisesRegex(ToolError, "expected UTF-8"):
            read_toml(self.folder / "latin.toml", Entries)

    def test_hostile_files_are_refused(self) -> None:
        for text in ("a = " + "[" * 100_000, "a = " + "9" * 5000, 'entry = [{"\\n" = 1}]'):
            with self.subTest(text[:20]):
                self.assertIn("file.toml:1: ", self.refusal(text))


class Gcc:
    """The host's compiler."""

    def command(self, tool: str) -> list[str]:
        return [tool]


class Builds(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.file("int two(void);\nint main(void) { return two() - VALUE; }\n", "main.c")
        (self.folder / "lib").mkdir()
        self.file("int two(void);\nint two(void) { return 2; }\n", "lib/two.c")
        flags = ["-Wall", "-Werror", "-DVALUE=2"]
        self.build = Build(Gcc(), "gcc", flags, self.folder / "out", self.folder)

    def test_a_program_is_built_from_files_and_folders(self) -> None:
        path = self.build.program("prog", ["main.c", "lib"])
        self.assertEqual(run([path]).status, 0)
        objects = {
            path.relative_to(self.folder).as_posix(): source
            for path, source in self.build.sources().items()
        }
        self.assertEqual(objects, {"out/obj/main.o": "main.c", "out/obj/lib/two.o": "lib/two.c"})

    def test_a_file_is_compiled_once_for_the_same_flags(self) -> None:
        first = self.build.object("main.c")
        stamp = first.stat().st_mtime_ns
        self.assertEqual(self.build.object("main.c"), first)
        self.assertEqual(first.stat().st_mtime_ns, stamp)
        self.assertNotEqual(self.build.object("main.c", ["-UVALUE", "-DVALUE=3"]), first)

    def test_threads_share_a_compilation(self) -> None:
        begun: list[int] = []

        def compile_slowly(_: Build, words: Sequence[str]) -> None:
            begun.append(1)
            time.sleep(0.2)
            Path(self.folder, words[-1]).touch()

        with mock.patch.object(Build, "compile", compile_slowly), ThreadPoolExecutor(4) as pool:
            paths = set(pool.map(self.build.object, ["main.c"] * 4))
        self.assertEqual((len(begun), [path.is_file() for path in paths]), (1, [True]))

    def test_the_compilers_words_are_the_error_and_nothing_half_remains(self) -> None:
        self.file("int main(void) { return x; }\n", "wrong.c")
        with self.assertRaisesRegex(BuildError, r"gcc: exit status 1\nwrong\.c.*\n.*undeclared"):
            self.build.program("prog", ["wrong.c"])
        self.build.program("prog", ["main.c", "lib"])
        with self.assertRaisesRegex(BuildError, "undefined reference"):
            self.build.program("prog", ["main.c"])
        self.assertFalse((self.folder / "out/prog").exists())

    def test_a_source_that_is_not_there_is_named(self) -> None:
        self.assertEqual(source_files(["lib", "lib/two.c"], self.folder), ["lib/two.c"])
        with self.assertRaisesRegex(BuildError, "there is no source file nothing"):
            self.build.objects(["nothing"])


class Reports(FolderTest):
    def test_suites_tests_and_failures_are_there(self) -> None:
        suites = {
            "unit/x": JUnitSuite({"good": "", "bad": "x.c:3: bad\n\x1b[0m<&>"}, 1.5),
            "y": JUnitSuite({"z": ""}, properties={"how": "a"}),
        }
        path = self.folder / "junit.xml"
        write_junit(path, "Keel", suites)
        whole = ElementTree.parse(path).getroot()
        self.assertEqual((whole.get("tests"), whole.get("failures")), ("3", "1"))
        self.assertEqual([item.get("name") for item in whole], ["unit/x", "y"])
        [failure] = whole.iter("failure")
        self.assertEqual(failure.get("message"), "x.c:3: bad")
        self.assertEqual(failure.text, "x.c:3: bad\n?[0m<&>")
        self.assertEqual(
            [case.get("name") for case in whole.iter("testcase")], ["good", "bad", "z"]
        )
