# SPDX-License-Identifier: Apache-2.0
"""What fuzzing is made of: the pinned crates, the targets, and what is told of a finding."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path
from unittest import mock

from keel.base.build import BuildError
from keel.base.run import Ended
from keel.install import Toolchain
from keel.test import fuzzing, oracles
from keel.test.sources import with_code

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
    """Each file of tests/fuzz is one."""

    def test_a_target_needs_no_more_than_its_files(self) -> None:
        root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, text in {
            "tests/fuzz/oracles.h": "",
            "tests/fuzz/fuzz_rotor.c": '#include "../../specs/model/rotor.h"\n'
            '#include "oracles.h"\n#include "keel/flight/rotor.h"\n',
            "tests/fuzz/fuzz_wing.c": '#include "../../specs/model/wing.h"\n',
            "specs/model/rotor.h": "",
            "specs/model/rotor.c": '#include "rotor.h"\n',
            "specs/model/rotor_parts.c": '#include "rotor.h"\n\n#include "blade.h"\n',
            "specs/model/rotor_blade.h": "",
            "specs/model/rotor_blade.c": '#include "rotor_blade.h"\n',
            "specs/model/rotors.c": "",
            "specs/model/blade.h": "",
            "specs/model/blade.c": '#include "blade.h"\n#include "rotor.h"\n',
            "specs/model/wing.h": "",
            "specs/model/wing.c": '#include "wing.h"\n',
        }.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        self.assertEqual(
            sorted(with_code("tests/fuzz/fuzz_rotor.c", root)),
            [
                *(f"specs/model/{name}.c" for name in ("blade", "rotor", "rotor_parts")),
                "tests/fuzz/fuzz_rotor.c",
            ],
        )
        for runs, names in ((0, ["rotor", "wing"]), (1, ["rotor"])):
            suites = fuzzing.fuzz_suites(Toolchain(), fuzzing.Fuzzing(1, runs), root)
            self.assertEqual([suite.name for suite in suites], names)
            self.assertEqual(suites[0].groups, ("fuzz", "oracles"))
        (root / "tests/fuzz/oracle_rotor.c").write_text("")
        self.assertEqual(oracles.groups("rotor", root), ("mavlink",))

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
