# SPDX-License-Identifier: Apache-2.0
"""What fuzzing is made of: the pinned crates, the targets, and what is told of a finding."""

from __future__ import annotations

import unittest
from pathlib import Path
from unittest import mock

from keel.base.build import BuildError
from keel.base.run import Ended
from keel.install import Toolchain
from keel.test import fuzzing, oracles

ROOT = Path(__file__).resolve().parents[2]

PINNED = (ROOT / "tests/oracles/Cargo.lock.in").read_text()


class Crates(unittest.TestCase):
    """They are those that were looked at, and no others."""

    def test_the_lock_has_cargos_own_name_of_the_registry(self) -> None:
        resolved = '[[package]]\nname = "a"\nsource = "registry+somewhere"\n'
        lock = oracles.pinned_lock(resolved, PINNED)
        self.assertNotIn(oracles.PLACE, lock)
        self.assertEqual(lock.count("registry+somewhere"), PINNED.count(oracles.PLACE))

    def test_without_a_registry_it_is_refused(self) -> None:
        with self.assertRaisesRegex(BuildError, "no registry"):
            oracles.pinned_lock('[[package]]\nname = "oracles"\n', PINNED)

    def test_each_crate_but_our_own_has_a_checksum(self) -> None:
        packages = PINNED.split("[[package]]")[1:]
        self.assertGreater(len(packages), 4)
        for package in packages:
            own = 'name = "oracles"' in package
            self.assertEqual("checksum" in package, not own, package)


class Targets(unittest.TestCase):
    """Each file of tests/fuzz is one, and each is one of those."""

    def test_every_file_is_a_target(self) -> None:
        files = {path.stem.removeprefix("fuzz_") for path in ROOT.glob("tests/fuzz/fuzz_*.c")}
        self.assertEqual(files, set(fuzzing.TARGETS))

    def test_counted_executions_are_of_those_that_others_judge(self) -> None:
        suites = fuzzing.fuzz_suites(Toolchain(), fuzzing.Fuzzing(60, 1000))
        names = ["crsf", "ibus", "mavlink", "ppm", "sbus", "ubx"]
        self.assertEqual([suite.name for suite in suites], names)

    def test_a_difference_is_told_with_how_to_see_it_again(self) -> None:
        said = "decoder and model DIFFER: a field\nTest unit written to build/fuzz/ibus/crash-1\n"
        built = mock.patch.object(
            fuzzing, "fuzz_program", return_value=ROOT / "build/fuzz/built/ibus"
        )
        ended = mock.patch.object(fuzzing, "run", return_value=Ended(77, said))
        with built, ended:
            outcome = fuzzing.fuzz_suite(Toolchain(), fuzzing.Fuzzing(1), "ibus")
        self.assertEqual(outcome.passed, 0)
        self.assertIn("DIFFER: a field", outcome.failures[0])
        self.assertIn("build/fuzz/ibus/crash-1", outcome.failures[0])
        self.assertIn("to see it again: build/fuzz/built/ibus FILE", outcome.failures[0])
