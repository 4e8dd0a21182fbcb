# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel dist: the same bytes twice, an archive that builds and proves, and
refusals.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import os
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

from consumer import ROOT, ConsumerTest, version

from keel.release import dist

NAME = "keel-" + ".".join(map(str, version()))
VALIDATE = """\
import sys
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
error = JsonStrictValidator(SchemaVersion.V1_6).validate_str(open(sys.argv[1]).read())
sys.exit(f"{error}" if error else 0)
"""
LOCK = {
    "tools": {
        "gcc": {"kind": "system", "at_least": "12", "below": "16"},
        "cmake": {"kind": "wheel", "package": "cmake", "pin": "4.4.4", "sha256": "ab" * 32},
        "more": {"kind": "packages", "path": "more.txt", "pin": "1", "sha256": "cd" * 32},
    }
}


class SmallTest(unittest.TestCase):
    """A repository of a few files."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "clone"
        self.write(
            "include/keel/version.h",
            "".join(
                f"#define KEEL_VERSION_{part} {number}\n"
                for part, number in (("MAJOR", 1), ("MINOR", 2), ("PATCH", 3))
            ),
        )
        self.write("tools/toolchain.lock.json", json.dumps(LOCK))
        self.write("more.txt", "rich==15.0.0 \\\n    --hash=sha256:00\n# a==1\nattrs==2 --hash=x\n")
        self.write("run.sh", "#!/bin/sh\n").chmod(0o755)
        self.git("init", "-q")
        self.git("add", "-A")
        self.commit()

    def write(self, name: str, text: str) -> Path:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def git(self, *words: str) -> None:
        who = {
            f"GIT_{who}_{what}": "a@b"
            for who in ("AUTHOR", "COMMITTER")
            for what in ("NAME", "EMAIL")
        }
        dates = {"GIT_COMMITTER_DATE": "2026-01-02T03:04:05+0100"}
        subprocess.run(
            ["git", *words],
            cwd=self.root,
            env={**os.environ, **who, **dates},
            check=True,
            capture_output=True,
            timeout=60,
        )

    def commit(self) -> None:
        self.git("commit", "-q", "-m", "x")

    def dist(self, *words: str) -> tuple[int, str]:
        """Exit status, and what is said of a failure."""
        said = io.StringIO()
        out = ["--out", str(self.root.parent / "out")]
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
            status = dist.main([*out, *words], self.root)
        return status, said.getvalue()

    def test_entries(self) -> None:
        self.assertEqual(self.dist(), (0, ""))
        with tarfile.open(self.root.parent / "out/keel-1.2.3.tar.gz") as archive:
            entries = archive.getmembers()
        names = ["include/keel/version.h", "more.txt", "run.sh", "tools/toolchain.lock.json"]
        self.assertEqual([entry.name for entry in entries], [f"keel-1.2.3/{n}" for n in names])
        self.assertEqual([entry.mode for entry in entries], [0o644, 0o644, 0o755, 0o644])
        self.assertEqual(
            {(e.uid, e.gid, e.uname, e.mtime) for e in entries}, {(0, 0, "", 1767319445)}
        )

    def test_the_bill(self) -> None:
        self.dist()
        bill = json.loads((self.root.parent / "out/keel-1.2.3.cdx.json").read_text())
        self.assertEqual(bill["metadata"]["timestamp"], "2026-01-02T02:04:05Z")
        self.assertEqual(bill["metadata"]["component"]["version"], "1.2.3")
        found = [(c["name"], c.get("version"), c.get("purl")) for c in bill["components"]]
        self.assertEqual(
            found,
            [
                ("gcc", None, None),
                ("attrs", "2", "pkg:pypi/attrs@2"),
                ("cmake", "4.4.4", "pkg:pypi/cmake@4.4.4"),
                ("rich", "15.0.0", "pkg:pypi/rich@15.0.0"),
            ],
        )

    def refused(self, words: str, *arguments: str) -> None:
        status, said = self.dist(*arguments)
        self.assertEqual((status, said.count("\n")), (1, 1), said)
        self.assertIn(words, said)
        self.assertFalse((self.root.parent / "out").exists())

    def test_a_dirty_tree_is_refused(self) -> None:
        self.write("more.txt", "changed==1\n")
        self.refused("more.txt not committed: commit, or say --dirty")
        self.write("new.txt", "")
        self.refused("more.txt and 1 more not committed")
        self.assertEqual(self.dist("--dirty"), (0, ""))

    def test_no_version(self) -> None:
        self.write("include/keel/version.h", "#define KEEL_VERSION_MAJOR 1\n")
        self.refused("version.h does not define KEEL_VERSION_MINOR as a number", "--dirty")

    def test_no_clone(self) -> None:
        self.root = self.root / "include"
        self.write("keel/tools/x", "")
        (self.root.parent / ".git").rename(self.root.parent / "git")
        status, said = self.dist()
        self.assertEqual((status, said.count("\n")), (1, 1))
        self.assertIn("is no clone of Keel", said)

    def test_a_clone_that_git_does_not_trust_is_told_in_its_words(self) -> None:
        distrusted = {
            "GIT_TEST_ASSUME_DIFFERENT_OWNER": "1",
            "GIT_CONFIG_COUNT": "0",
            "GIT_CONFIG_NOSYSTEM": "1",
            "HOME": "/nowhere",
        }
        with mock.patch.dict(os.environ, distrusted):
            status, said = self.dist()
        self.assertEqual(status, 1)
        self.assertIn("git fails: fatal: detected dubious ownership", said)
        self.assertFalse((self.root.parent / "out").exists())


class ReleaseTest(ConsumerTest):
    """The release of this very tree."""

    def release(self, name: str) -> Path:
        out = self.folder / name
        self.good([sys.executable, ROOT / "tools/keel", "dist", "--dirty", "--out", out])
        return out

    def test_twice_the_same_bytes(self) -> None:
        first = self.release("first")
        time.sleep(1.1)  # A time of now, in whole seconds, would be another one.
        second = self.release("second")
        names = [f"{NAME}.cdx.json", f"{NAME}.tar.gz", "SHA256SUMS"]
        self.assertEqual(sorted(path.name for path in first.iterdir()), sorted(names))
        for name in names:
            self.assertEqual((first / name).read_bytes(), (second / name).read_bytes(), name)
        for line in (first / "SHA256SUMS").read_text().splitlines():
            digest, file = line.split("  ")
            self.assertEqual(hashlib.sha256((first / file).read_bytes()).hexdigest(), digest)

    def test_the_bill_is_valid(self) -> None:
        self.python("-c", VALIDATE, self.release("out") / f"{NAME}.cdx.json")

    def unpacked(self) -> Path:
        """The tree that somebody unpacks."""
        with tarfile.open(self.release("out") / f"{NAME}.tar.gz") as archive:
            archive.extractall(self.folder)
        return self.folder / NAME

    def test_each_file_has_a_licence(self) -> None:
        """By the specification of REUSE, and the licence is the one that LICENSE has."""
        keel = self.unpacked()
        self.python("-m", "reuse", "--root", keel, "lint")
        self.assertEqual(
            (keel / "LICENSE").read_bytes(), (keel / "LICENSES/Apache-2.0.txt").read_bytes()
        )
        (keel / "LICENSES/Apache-2.0.txt").unlink()
        with self.assertRaisesRegex(AssertionError, "Missing licenses: Apache-2.0"):
            self.python("-m", "reuse", "--root", keel, "lint")

    def test_it_builds_and_proves_without_git(self) -> None:
        keel = self.unpacked()
        self.good(["cmake", "-S", keel, "-B", "build"])
        self.good(["cmake", "--build", "build"])
        self.assertEqual(len(list((self.folder / "build").glob("*.a"))), 3)
        forbidden = self.folder / "bin"
        forbidden.mkdir()
        (forbidden / "git").write_text("#!/bin/sh\nexit 99\n")
        (forbidden / "git").chmod(0o755)
        path = os.pathsep.join([str(forbidden), self.environment()["PATH"]])
        told = self.good(["make", "-C", keel, "prove", "UNIT=clock"], PATH=path)
        self.assertRegex(told, r"proved (\d+) of \1 goals")
