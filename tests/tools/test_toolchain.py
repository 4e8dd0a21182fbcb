# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/toolchain. No network, no package manager, nothing installed.

Tools, apt-get and apt-cache are small scripts in a folder that is the whole PATH; each writes a
line when it runs, so that a test can also state what must not run.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from keel import install as toolchain
from keel.base.files import sha256_of
from keel.install import Toolchain, ToolchainError, groups, python_packages
from keel.install import command as command_line
from keel.install.apt import Log, Suite
from keel.install.cache import Cache
from keel.install.found import Finder, answer
from keel.install.groups import requirements_of
from keel.install.lock import LOCK_FILE, Lock, Spec
from keel.install.mirror import debian_mirrors
from keel.install.unpack import Tree, write_starter

ROOT = Path(__file__).resolve().parents[2]


def quiet(line: str) -> None:
    """Takes the place of progress lines."""
    del line


OUTSIDE = dict(os.environ)


class Sandbox(unittest.TestCase):
    """A PATH of scripts, a cache and a lock file of the test's own."""

    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="keel-test-")))
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        for name in ("sh", "env", "touch", "cp"):
            (self.bin / name).symlink_to(shutil.which(name) or name)
        self.cache = self.folder / "cache"
        self.set_path(self.bin)

    def set_path(self, *folders: Path) -> None:
        """Make these folders the whole PATH."""
        values = {"PATH": os.pathsep.join(map(str, folders)), "KEEL_CACHE": str(self.cache)}
        self.enterContext(mock.patch.dict(os.environ, values))
        for name in ("KEEL_NO_INSTALL", "KEEL_DEBIAN_MIRROR"):
            os.environ.pop(name, None)

    def script(self, name: str, body: str, folder: Path | None = None) -> Path:
        """An executable that notes that it ran."""
        path = (folder or self.bin) / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"#!/bin/sh\necho {name} >> {self.folder}/ran\n{body}\n")
        path.chmod(0o755)
        return path

    def ran(self) -> list[str]:
        """The scripts that ran, in order."""
        log = self.folder / "ran"
        return log.read_text().split() if log.exists() else []

    def lock(self, **tools: dict[str, object]) -> Lock:
        """A lock file with these tools in one group called g."""
        path = self.folder / "lock.json"
        path.write_text(json.dumps({"schema": 1, "groups": {"g": list(tools)}, "tools": tools}))
        return Lock.read(path)

    def refusal(self, tools: Toolchain) -> str:
        """The message with which ensure fails."""
        with self.assertRaises(ToolchainError) as caught:
            tools.ensure("g", say=quiet)
        return str(caught.exception)


def system(name: str, at_least: str = "2.0", below: str = "3") -> dict[str, object]:
    """The entry of a tool that prints its version."""
    return {
        "kind": "system",
        "commands": [name],
        "probe": [name, "--version"],
        "version": r"(\d+\.\d+)",
        "at_least": at_least,
        "below": below,
        "packages": [f"{name}-deb"],
    }


DEB: dict[str, object] = {
    "kind": "deb",
    "commands": ["prover"],
    "probe": ["prover", "--version"],
    "version": r"(\d+\.\d+)",
    "at_least": "6.6",
    "below": "7",
    "suite": "trixie",
    "package": "prover",
    "pin": "6.6-4",
    "sha256": "0" * 64,
}


class FindingTools(Sandbox):
    """What is on PATH is used if it fits, and looked at only once."""

    def test_a_suitable_tool_is_used_and_identified(self) -> None:
        path = self.script("z", "echo z 2.5")
        tools = Toolchain(self.cache, self.lock(z=system("z")))
        tools.ensure("g", say=quiet)
        self.assertEqual(tools.command("z"), [str(path)])
        finding = tools.versions("g")["z"]
        self.assertEqual((finding.version, finding.origin), ("2.5", "found"))
        self.assertEqual(finding.sha256, sha256_of(path))

    def test_the_second_time_runs_nothing(self) -> None:
        self.script("z", "echo z 2.5")
        lock = self.lock(z=system("z"))
        Toolchain(self.cache, lock).ensure("g", say=quiet)
        Toolchain(self.cache, lock).ensure("g", say=self.fail)
        self.assertEqual(self.ran(), ["z"])

    def test_a_changed_tool_is_looked_at_again(self) -> None:
        self.script("z", "echo z 2.5")
        lock = self.lock(z=system("z"))
        Toolchain(self.cache, lock).ensure("g", say=quiet)
        self.script("z", "echo z 4.0 is too new")
        self.assertIn("version 4.0", self.refusal(Toolchain(self.cache, lock)))

    def test_an_unsuitable_tool_earlier_on_path_does_not_hide_ours(self) -> None:
        other = self.folder / "other"
        self.script("z", "echo z 9.0", other)
        good = self.script("z", "echo z 2.5")
        self.set_path(other, self.bin)
        tools = Toolchain(self.cache, self.lock(z=system("z")))
        tools.ensure("g", say=quiet)
        self.assertEqual(tools.command("z"), [str(good)])
        with mock.patch.dict(os.environ, tools.environment()):
            self.assertEqual(subprocess.check_output(["z"], text=True), "z 2.5\n")
            # A driver started by a driver finds everything as it was.
            Toolchain(self.cache, tools.lock).ensure("g", say=self.fail)

    def test_all_commands_of_a_tool_are_needed(self) -> None:
        self.script("z", "echo z 2.5")
        entry = {**system("z"), "commands": ["z", "z-link"]}
        os.environ["KEEL_NO_INSTALL"] = "1"
        message = self.refusal(Toolchain(self.cache, self.lock(z=entry)))
        self.assertIn("no suitable z z-link", message)


class Refusals(Sandbox):
    """Where nothing can be installed, each missing tool is named and nothing is begun."""

    def test_each_missing_tool_is_named(self) -> None:
        os.environ["KEEL_NO_INSTALL"] = "1"
        tools = Toolchain(self.cache, self.lock(z=system("z"), y=system("y"), prover=DEB))
        message = self.refusal(tools)
        for part in (
            "z, y, prover: missing; KEEL_NO_INSTALL=1",
            "z: wanted 2.0 or later, before 3",
            "y-deb",
            "prover 6.6-4",
        ):
            self.assertIn(part, message)
        self.assertIn(str(self.bin), message)

    def test_without_apt(self) -> None:
        message = self.refusal(Toolchain(self.cache, self.lock(z=system("z"), prover=DEB)))
        self.assertIn("no apt-get", message)
        self.assertIn("prover: wanted 6.6", message)

    def test_without_rights(self) -> None:
        self.script("apt-get", "exit 0")
        with mock.patch("os.geteuid", return_value=1000):
            message = self.refusal(Toolchain(self.cache, self.lock(z=system("z"))))
        self.assertIn("not root", message)
        self.assertEqual(self.ran(), [])

    def test_an_installation_without_effect_is_no_success(self) -> None:
        self.script("apt-get", "exit 0")
        self.script("apt-cache", "printf 'z-deb:\\n  Installed: (none)\\n  Candidate: 9\\n'")
        with mock.patch("os.geteuid", return_value=0):
            message = self.refusal(Toolchain(self.cache, self.lock(z=system("z"))))
        self.assertIn("still not suitable", message)

    def test_lists_are_read_first_when_they_were_never_read(self) -> None:
        script = self.folder / "z.sh"
        script.write_text("#!/bin/sh\necho z 2.5\n")
        script.chmod(0o755)
        install = f'[ "$1" = update ] && touch {self.folder}/lists\n'
        install += f'[ "$1" = install ] && cp {script} {self.bin}/z\nexit 0'
        self.script("apt-get", install)
        answer = "printf 'z-deb:\\n  Installed: (none)\\n  Candidate: 9\\n'"
        self.script("apt-cache", f"[ -e {self.folder}/lists ] && {answer}\nexit 0")
        tools = Toolchain(self.cache, self.lock(z=system("z")))
        with mock.patch("os.geteuid", return_value=0):
            tools.ensure("g", say=quiet)
        self.assertEqual(self.ran(), ["apt-cache", "apt-get", "apt-cache", "apt-get"])

    def test_a_failed_installation_shows_the_words_of_apt_and_its_log(self) -> None:
        self.script("apt-get", "echo E: held broken packages; exit 100")
        self.script("apt-cache", "printf 'z-deb:\\n  Installed: (none)\\n  Candidate: 9\\n'")
        with mock.patch("os.geteuid", return_value=0):
            message = self.refusal(Toolchain(self.cache, self.lock(z=system("z"))))
        self.assertIn("held broken packages", message)
        self.assertIn("install.log", message)

    def test_the_command_line_ends_with_two_and_names_the_tools_first(self) -> None:
        os.environ["KEEL_NO_INSTALL"] = "1"
        with contextlib.redirect_stderr(io.StringIO()) as errors:
            self.assertEqual(command_line.main(["ensure", "prove"]), 2)
        first, *others = errors.getvalue().splitlines()
        self.assertRegex(first, r"^toolchain: gcc, .*frama-c.*: missing; KEEL_NO_INSTALL=1 forbids")
        self.assertTrue(any("frama-c: wanted 25" in line for line in others))

    def test_all_groups_are_meant_where_none_is_named(self) -> None:
        os.environ["KEEL_NO_INSTALL"] = "1"
        with contextlib.redirect_stderr(io.StringIO()) as errors:
            self.assertEqual(command_line.main(["ensure"]), 2)
        missing = errors.getvalue().partition(": missing;")[0].removeprefix("toolchain: ")
        every = {spec.name for spec in Lock.read().of_groups(Lock.read().groups)}
        packages = {name for name in every if name.endswith("-packages")}
        self.assertLessEqual(packages | {"hacl", "frama-c", "qemu"}, set(missing.split(", ")))

    def test_a_wrong_name_is_told_in_one_line_with_the_nearest(self) -> None:
        for words, wanted in (
            (["ensure", "prov"], "there is no group prov; did you mean prove?"),
            (["path", "cmbc"], "there is no tool cmbc; did you mean cbmc?"),
            (["version"], "did you mean versions?"),
            (["versions", "--jsn"], "--jsn; did you mean --json?"),
        ):
            with self.subTest(words), contextlib.redirect_stderr(io.StringIO()) as errors:
                status: object = 2
                try:
                    status = command_line.main(words)
                except SystemExit as ended:
                    status = ended.code
                self.assertEqual(status, 2)
                [line] = errors.getvalue().splitlines()
                self.assertIn(wanted, line)

    def test_an_unknown_group_and_tool(self) -> None:
        tools = Toolchain(self.cache, self.lock(z=system("z")))
        with self.assertRaisesRegex(ToolchainError, "no group proof \\(groups: g\\)"):
            tools.ensure("proof")
        with self.assertRaisesRegex(ToolchainError, "there is no tool cobol"):
            tools.command("cobol")


class Unpacking(Sandbox):
    """The cache holds whole, pinned trees or nothing."""

    def setUp(self) -> None:
        super().setUp()
        self.spec = self.lock(prover=DEB).tools["prover"]
        self.store = Cache(self.cache)

    def fill(self, tree: Tree, answer: str = "6.6") -> None:
        """A tree with a program that answers a version."""
        program = tree.root / "usr/bin/prover"
        program.parent.mkdir(parents=True)
        program.write_text(f"#!/bin/sh\necho prover {answer}\n")
        program.chmod(0o755)
        write_starter(tree, "prover")
        tree.add_part("prover", "6.6-4", "test", program)

    def trees(self) -> list[str]:
        """What lies in the cache, finished or not."""
        return [path.name for part in ("tools", "tmp") for path in (self.cache / part).glob("*")]

    def test_a_whole_tree_is_found_again(self) -> None:
        self.store.unpack(self.spec, self.fill, Finder(self.cache))
        again = self.store.find(self.spec, Finder(self.cache))
        assert again is not None
        self.assertEqual((again.version, again.origin), ("6.6", "cache"))
        self.assertEqual(again.parts[0]["name"], "prover")
        self.assertTrue(again.location.endswith("usr/bin/prover"))

    def test_a_program_that_is_only_right_behind_a_filter_is_and_no_other_is_taken(self) -> None:
        self.script("prover", "echo prover 6.6")
        before = self.folder / "before.py"
        before.write_text("import os, sys\nos.execv(sys.argv[1], sys.argv[1:])\n")
        lock = self.lock(prover={**DEB, "before": str(before)})
        self.store.unpack(lock.tools["prover"], self.fill, Finder(self.cache))
        tools = Toolchain(self.cache, lock)
        tools.ensure("g", say=quiet)
        found = tools.versions("g")["prover"]
        self.assertEqual(found.origin, "cache")
        [starter] = tools.command("prover")
        self.assertIn('before.py" "$root/usr/bin/prover"', Path(starter).read_text())
        # It is what stands before it that identifies it: of the program there is the manifest.
        self.assertEqual(found.sha256, sha256_of(before))
        self.assertEqual(found.parts[0]["name"], "prover")

    def test_another_filter_makes_another_tree_and_what_was_found_is_forgotten(self) -> None:
        before = self.folder / "before.py"
        text = "import os, sys\nos.execv(sys.argv[1], sys.argv[1:])\n"
        before.write_text(text)
        lock = self.lock(prover={**DEB, "before": str(before)})
        self.store.unpack(lock.tools["prover"], self.fill, Finder(self.cache))
        Toolchain(self.cache, lock).ensure("g", say=quiet)
        place = self.store.tree(lock.tools["prover"])
        before.write_text(f"# another\n{text}")
        self.assertNotEqual(self.store.tree(lock.tools["prover"]), place)
        self.assertEqual(Toolchain(self.cache, lock).versions("g"), {})

    def test_a_download_that_is_not_the_pinned_one_leaves_nothing(self) -> None:
        def fill(tree: Tree) -> None:
            self.fill(tree)
            tree.check_pin(tree.root / "usr/bin/prover")

        with self.assertRaisesRegex(ToolchainError, "is not the pinned file.*nothing was kept"):
            self.store.unpack(self.spec, fill, Finder(self.cache))
        self.assertEqual(self.trees(), [])

    def test_packages_are_installed_as_their_group_pins_them(self) -> None:
        pip = self.folder / "pip"  # Called as a Python: -m pip install OPTIONS --target ROOT ...
        pip.write_text(
            '#!/bin/sh\nwhile [ "$1" != --target ]; do\n  case "$1" in --require-hashes) pinned=1;;'
            ' esac\n  shift\ndone\n[ "$pinned" ] && /bin/mkdir "$2/z" && echo 1.5 >"$2/z/version"\n'
        )
        pip.chmod(0o755)

        def fill(tree: Tree) -> None:
            python_packages.install(tree, [str(pip)])

        spec = Spec(
            "z-packages",
            "packages",
            group="base",
            file="z/version",
            pin="1",
            sha256="0" * 64,
            version=r"(\d\.\d)",
            at_least="1",
            below="2",
        )
        found = self.store.unpack(spec, fill, Finder(self.cache))
        self.assertEqual((found.version, found.origin), ("1.5", "cache"))
        self.assertIn(sys.implementation.cache_tag, found.commands["z-packages"])
        self.assertEqual(found.parts[0]["name"], "group base")

    def test_a_tool_that_does_not_work_is_not_kept(self) -> None:
        with self.assertRaisesRegex(ToolchainError, "does not work: .*version 5.0"):
            self.store.unpack(self.spec, lambda tree: self.fill(tree, "5.0"), Finder(self.cache))
        self.assertEqual(self.trees(), [])

    def test_a_half_unpacked_tree_never_counts(self) -> None:
        place = self.store.tree(self.spec)
        place.mkdir(parents=True)
        self.fill(Tree(self.spec, place, self.folder, self.store.log))
        self.assertIsNone(self.store.find(self.spec, Finder(self.cache)))

    def test_what_an_interrupted_installation_left_is_removed(self) -> None:
        (self.cache / "tmp/prover/root").mkdir(parents=True)
        with self.store.locked(quiet):
            self.assertEqual(self.trees(), [])

    def test_only_one_installation_at_a_time(self) -> None:
        waiting = "import pathlib, sys; sys.path.insert(0, sys.argv[1])\n"
        waiting += "from keel.install.cache import Cache\nfrom keel.install.tools import tell\n"
        waiting += "with Cache(pathlib.Path(sys.argv[2])).locked(tell):\n"
        waiting += "    print('inside', flush=True)"
        command = [sys.executable, "-c", waiting, str(ROOT / "tools"), str(self.cache)]
        with self.store.locked(quiet):
            child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
            assert child.stdout is not None
            self.assertIn("waiting for another", child.stdout.readline())
        self.assertEqual(child.communicate()[0], "inside\n")

    def test_a_cache_that_cannot_be_written(self) -> None:
        self.cache.write_text("a file in the way")
        self.script("z", "echo z 2.5")
        message = self.refusal(Toolchain(self.cache, self.lock(z=system("z"))))
        self.assertIn("cannot write the cache", message)

    def test_a_cache_with_white_space_is_refused(self) -> None:
        tools = Toolchain(self.folder / "a b", self.lock(z=system("z")))
        self.assertIn("no white space", self.refusal(tools))


class Crates(Sandbox):
    """A crate is data: cargo fetches it, only the wanted parts of the pinned archive are kept."""

    def setUp(self) -> None:
        super().setUp()
        home = self.folder / "cargo-home"
        self.enterContext(mock.patch.dict(os.environ, {"CARGO_HOME": str(home)}))
        self.fetched = home / "registry/cache/index-1234/regs-1.2.0.crate"
        self.fetched.parent.mkdir(parents=True)
        self.archive = self.folder / "regs-1.2.0.crate"
        with tarfile.open(self.archive, "w:gz") as tar:
            for name, text in (
                ("Cargo.toml", 'version = "1.2.0"'),
                ("src/a/x.rs", "a"),
                ("src/b/y.rs", "b"),
                ("../out.rs", "outside"),
            ):
                data = io.BytesIO(text.encode())
                member = tarfile.TarInfo(f"regs-1.2.0/{name}")
                member.size = len(text)
                tar.addfile(member, data)
        self.script("cargo", f"echo cargo 1.80.0; cp {self.archive} {self.fetched}")

    def crate(self, sha256: str = "", keep: str = "src/a/") -> Lock:
        cargo = {**system("cargo", "1.70", "2"), "version": r"cargo (\d+\.\d+)"}
        regs: dict[str, object] = {
            "kind": "crate",
            "file": "Cargo.toml",
            "version": r'version = "(\d+\.\d+)',
            "at_least": "1.2",
            "below": "1.3",
            "package": "regs",
            "pin": "1.2.0",
            "sha256": sha256 or sha256_of(self.archive),
            "keep": [keep],
        }
        return self.lock(cargo=cargo, regs=regs)

    def test_the_wanted_parts_are_kept(self) -> None:
        tools = Toolchain(self.cache, self.crate())
        tools.ensure("g", say=quiet)
        folder = Path(tools.command("regs")[0])
        files = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.*"))
        self.assertEqual(files, ["Cargo.toml", "manifest.json", "src/a/x.rs"])

    def test_a_clone_that_keeps_other_parts_has_its_own_folder(self) -> None:
        for part in ("src/a/", "src/b/"):
            tools = Toolchain(self.cache, self.crate(keep=part))
            tools.ensure("g", say=quiet)
            self.assertTrue((Path(tools.command("regs")[0]) / part).is_dir(), part)

    def test_another_archive_is_refused(self) -> None:
        message = self.refusal(Toolchain(self.cache, self.crate("0" * 64)))
        self.assertIn("regs-1.2.0.crate is not the pinned file", message)
        self.assertFalse(list(self.cache.glob("tools/regs*")))

    def test_a_fetch_that_fails_says_so(self) -> None:
        self.script("cargo", 'test "$1" = fetch && exit 1; echo cargo 1.80.0')
        message = self.refusal(Toolchain(self.cache, self.crate()))
        self.assertIn("cargo does not get regs 1.2.0", message)

    def test_a_fetch_that_leaves_nothing_says_so(self) -> None:
        self.script("cargo", "echo cargo 1.80.0")
        message = self.refusal(Toolchain(self.cache, self.crate()))
        self.assertIn("cargo left no regs-1.2.0.crate", message)


class OtherSuites(Sandbox):
    """Packages of another Debian suite: gone versions are named, and so are the offered ones."""

    def suite(self) -> Suite:
        """A suite whose lists were read."""
        os.environ["KEEL_DEBIAN_MIRROR"] = "mirror:/debian"
        return Suite("trixie", "deb", self.folder / "apt", Log(self.folder / "log"))

    def test_a_gone_version_names_the_offered_one(self) -> None:
        self.script("apt-get", "exit 0")
        self.script("apt-cache", "echo Package: prover; echo Version: 6.7-1")
        with self.assertRaisesRegex(ToolchainError, r"6\.6-4 is not in .*offered: 6\.7-1"):
            self.suite().download("prover", "6.6-4", self.folder / "into")

    def test_no_server_is_not_taken_for_an_empty_suite(self) -> None:
        self.script("apt-get", "echo W: Temporary failure resolving; exit 0")
        with self.assertRaisesRegex(ToolchainError, "cannot read Debian trixie(.|\n)*resolving"):
            self.suite().update()

    def test_a_suite_that_a_mirror_dropped_comes_from_the_next(self) -> None:
        """Only the archive's line leaves a list behind."""
        folder = self.folder / "apt"
        found = f": > {folder}/lists/archive_dists_trixie_main_binary-amd64_Packages"
        words = f'read -r line < {folder}/sources.list; case "$line" in *x:/archive*) {found} ;;'
        self.script("apt-get", f"{words} *) exit 100 ;; esac")
        suite = self.suite()
        os.environ["KEEL_DEBIAN_MIRROR"] = "x:/mirror x:/archive x:/never"
        suite.update()
        self.assertIn(" x:/archive trixie main", (folder / "sources.list").read_text())
        os.environ["KEEL_DEBIAN_MIRROR"] = "x:/mirror x:/other"
        with self.assertRaisesRegex(ToolchainError, "x:/mirror trixie(.|\\n)*x:/other trixie"):
            suite.update()

    def test_everything_of_apt_is_private(self) -> None:
        self.script("apt-get", f'echo "$@" >> {self.folder}/words; exit 1')
        suite = self.suite()
        with self.assertRaises(ToolchainError):
            suite.update()
        words = (self.folder / "words").read_text()
        for part in ("sourcelist", "State::lists", "State::status", "Cache::archives"):
            self.assertRegex(words, rf"{part}={re.escape(str(suite.folder))}")
        self.assertIn("Dir::Etc::sourceparts=-", words)
        self.assertIn("mirror:/debian trixie main", (suite.folder / "sources.list").read_text())


# What apt keeps of an archive's description.
RELEASE = """\
Origin: {owner}
Codename: bookworm
Components: main
Date: Sat, 11 Jul 2026 09:00:00 UTC
SHA256:
 0000000000000000000000000000000000000000000000000000000000000000 11 main/binary-{cpu}/Packages
"""


@unittest.skipUnless(shutil.which("apt-get"), "the host has no apt")
class Mirrors(Sandbox):
    """The mirror is the one that the host takes Debian from, however it is written down. The host's
    apt reads configurations of the test's own."""

    def setUp(self) -> None:
        super().setUp()
        self.set_path(*map(Path, OUTSIDE["PATH"].split(os.pathsep)))

    def mirror(self, **files: str) -> str:
        """What apt says of a configuration; `list`, `parts_x_list` and `parts_x_sources` are its
        files, the others lists that it has read."""
        etc, lists = self.folder / "etc", self.folder / "lists"
        (etc / "sources.list.d").mkdir(parents=True)
        (lists / "partial").mkdir(parents=True)
        for name, text in files.items():
            file = name.removeprefix("parts_").replace("_", ".")
            target = etc / "sources.list.d" / file if "parts_" in name else etc / "sources.list"
            target.write_text(text)
        settings = ["-o", f"Dir::Etc={etc}", "-o", f"Dir::State::lists={lists}"]
        return " ".join(debian_mirrors(settings))

    def test_one_line_format(self) -> None:
        text = "# deb http://old/debian bookworm main\ndeb-src http://src/debian bookworm main\n"
        text += "deb [signed-by=/k.gpg] http://host/debian bookworm main contrib # ours\n"
        self.assertEqual(self.mirror(list=text), "http://host/debian")

    def test_deb822_format(self) -> None:
        text = "Types: deb\nEnabled: no\nURIs: http://off/debian\nSuites: bookworm\n"
        text += "Components: main\n\nTypes: deb deb-src\n# a comment\n"
        text += "URIs: http://host/debian http://second/debian\n"
        text += "Suites: bookworm\n  bookworm-updates\nComponents: main\n"
        self.assertEqual(self.mirror(parts_a_sources=text), "http://host/debian")

    def test_third_parties_with_the_same_suite_name_come_last(self) -> None:
        """Before the lists are read, by the archive's name; afterwards by what the lists say."""
        text = "deb http://other/apt bookworm main\ndeb http://host/debian bookworm main\n"
        text += "deb http://house/mirror bookworm main\n"
        self.assertEqual(self.mirror(list=text), "http://host/debian")
        settings = [f"Dir::Etc={self.folder}/etc", f"Dir::State::lists={self.folder}/lists"]
        cpu = answer(["dpkg", "--print-architecture"]).strip()
        for place, owner in (("other_apt", "Other"), ("house_mirror", "Debian")):
            read = self.folder / f"lists/{place}_dists_bookworm"
            Path(f"{read}_Release").write_text(RELEASE.format(owner=owner, cpu=cpu))
            Path(f"{read}_main_binary-{cpu}_Packages").write_text("Package: x\n")
        mirrors = debian_mirrors([word for one in settings for word in ("-o", one)])
        self.assertEqual(mirrors, ["http://house/mirror"])

    def test_security_and_media_do_not_count(self) -> None:
        text = "deb http://host/debian-security bookworm-security main\n"
        text += "deb cdrom:[D]/ bookworm main\n"
        with self.assertRaisesRegex(ToolchainError, "no Debian mirror"):
            self.mirror(list=text)

    def test_the_environment_may_choose(self) -> None:
        os.environ["KEEL_DEBIAN_MIRROR"] = "x:/chosen  x:/archive"
        self.assertEqual(self.mirror(), "x:/chosen x:/archive")


class Verdicts(Sandbox):
    """Which files of the toolchain the verdicts of proofs depend on."""

    def digest(self, changed: str = "") -> str:
        """The driver's digest in a copy of the tools in which a line was added to a file."""
        tools = self.folder / "tools"
        if not tools.exists():
            skipped = shutil.ignore_patterns("__pycache__")
            shutil.copytree(ROOT / "tools", tools, ignore=skipped)
            shutil.copy(ROOT / "pyproject.toml", self.folder)
        if changed:
            with (tools / changed).open("a") as stream:
                stream.write("# A comment.\n")
        script = "from keel.prove.verdict_keys import own_digest; print(own_digest('wp'))"
        command = [sys.executable, "-c", script]
        return subprocess.check_output(command, cwd=tools, text=True, env=OUTSIDE)

    def test_the_way_provers_are_started_counts_and_the_installer_does_not(self) -> None:
        before = self.digest()
        for file in ("keel/install/apt.py", "keel/install/tools.py", "keel/cli/commands.py"):
            self.assertEqual(self.digest(file), before, file)
        started = self.digest("keel/install/provers.py")
        self.assertNotEqual(started, before)
        self.assertNotEqual(self.digest("keel/c/syntax.py"), started)


class TwoClones(Sandbox):
    """Clones share a cache, and start proofs side by side."""

    def test_a_configuration_that_both_have_stays_as_it_is(self) -> None:
        """A clone that made it again would take it from the one that is about to use it."""
        self.script("alt-ergo", "echo alt-ergo 2.5")
        known = r'name = "Alt-Ergo"\nversion = "2.5"\n'
        detect = f"""[ "$1" != config ] || printf '{known}' > "$WHY3CONFIG\""""
        self.script("why3", f"echo why3 2.5; {detect}")
        tools = {
            "alt-ergo": system("alt-ergo"),
            "why3": system("why3"),
            "why3-config": {"kind": "why3-config", "provers": ["Alt-Ergo"]},
        }
        lock = self.lock(**tools)
        first = Toolchain(self.cache, lock)
        first.ensure("g", say=quiet)
        found = sorted((self.cache / "found").iterdir())
        self.assertEqual(len(found), 1)
        found[0].unlink()  # as for another clone, which has a file of its own
        Toolchain(self.cache, lock).ensure("g", say=quiet)
        self.assertEqual(self.ran().count("why3"), 4)
        self.assertIn("WHY3CONFIG", first.environment())
        self.assertEqual(
            [path.name for path in (self.cache / "why3").rglob("*.conf")], ["why3.conf"]
        )


class TheLockFile(Sandbox):
    """The lock file that is shipped, and mistakes in one."""

    def test_a_mistyped_key_is_an_error(self) -> None:
        with self.assertRaisesRegex(ToolchainError, "unknown key 'at_leats'"):
            self.lock(z={**system("z"), "at_leats": "1"})
        with self.assertRaisesRegex(ToolchainError, "wrong type"):
            self.lock(z={**system("z"), "packages": "z"})

    def test_versions_compare_as_numbers(self) -> None:
        spec = Spec("z", "system", at_least="4.8.12", below="4.9")
        admitted = [spec.admits(v) for v in ("4.8.12", "4.8.2", "4.9.0", "4.8.100-beta", "")]
        self.assertEqual(admitted, [True, False, False, True, False])

    def test_what_is_unpacked_is_pinned(self) -> None:
        for spec in Lock.read().tools.values():
            if spec.cached:
                self.assertRegex(spec.sha256, r"^[0-9a-f]{64}$", spec.name)
                self.assertTrue(spec.pin and (spec.package or spec.group), spec.name)
            if not spec.cached and not spec.derived:
                self.assertTrue(spec.at_least and spec.below and spec.packages, spec.name)

    def test_every_package_of_a_group_has_its_files_and_every_file_a_group(self) -> None:
        named = {one for group in groups.groups().values() for one in group}
        self.assertEqual(named, set(groups.hashes()))
        for name, items in groups.groups().items():
            self.assertEqual(items, sorted(set(items)), name)

    def group_error(self, project: str, lock: str) -> str:
        """Why a group "a" of these two files is refused."""
        files = self.folder / "pyproject.toml", self.folder / "packages.lock"
        for path, text in zip(files, (project, lock), strict=True):
            path.write_text(text, encoding="utf-8")
        with self.assertRaises(groups.GroupError) as refused:
            requirements_of("a", *files)
        return str(refused.exception)

    def test_a_group_that_is_not_there_or_not_pinned_is_refused(self) -> None:
        self.assertEqual(
            self.group_error("[dependency-groups]\nb = []\n", ""),
            "pyproject.toml: there is no group a",
        )

    def test_a_package_without_a_digest_is_refused(self) -> None:
        text = '[dependency-groups]\na = ["z==1"]\n'
        self.assertEqual(
            self.group_error(text, "z==2 \\\n    --hash=sha256:" + "0" * 64 + "\n"),
            "packages.lock: z==1 of group a has no SHA-256",
        )

    def test_a_package_has_one_version_in_all_files_of_one_program(self) -> None:
        lock = Lock.read()
        for group in ("timing-tests", "tools-tests", "fly-tests"):
            seen: dict[str, str] = {}
            for name in lock.groups[group]:
                text = requirements_of(lock.tools[name].group) if name.endswith("-packages") else ""
                for package, version in re.findall(r"^([a-z]\S*)==(\S+)", text, re.MULTILINE):
                    self.assertEqual(seen.setdefault(package, version), version, package)
            self.assertIn("pytest", seen)

    def test_no_registry_is_named(self) -> None:
        for path in (
            LOCK_FILE,
            groups.HASHES,
            groups.PROJECT,
            *Path(toolchain.__file__).parent.glob("*.py"),
        ):
            hosts = re.findall(r"\b[a-z0-9-]+\.(?:org|com|net|io)\b|https?:", path.read_text())
            self.assertEqual(hosts, [], path.name)
