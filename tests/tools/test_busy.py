# SPDX-License-Identifier: Apache-2.0
"""Some of the dearest goals are proved while each core runs an endless program, too.

They run Frama-C and CBMC, believe no verdict that is known, and are skipped without the provers.
"""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from endless import CORES, busy

from keel.base.jobs import Runner
from keel.c.project import find_units
from keel.engines import cbmc, wp
from keel.install import Toolchain, ToolchainError, small_environment
from keel.judge import wp_targets
from keel.judge.goals import read_goals
from keel.judge.harness import read_harness

ROOT = Path(__file__).resolve().parents[2]

# A goal that CVC4 and Alt-Ergo once gave up, by the clock, on a machine with other work; and a
# harness that keeps z3 busy.
FUNCTION = ("signing", "keel_signing_accepts")
HARNESS = ("priority", "keel_priority_dynamic__exact_harness")


def installed() -> bool:
    """Whether the provers are there."""
    try:
        Toolchain().frama_c()
        Toolchain().goto_cc()
    except ToolchainError:
        return False
    return True


@unittest.skipUnless(installed(), "the provers are not installed: make prove")
class Dearest(unittest.TestCase):
    def setUp(self) -> None:
        self.tools = Toolchain()
        self.tools.ensure("prove", say=lambda _: None)
        self.scratch = Path(self.enterContext(tempfile.TemporaryDirectory()))
        variables = {**self.tools.environment(), "TMPDIR": str(self.scratch)}
        self.runner = Runner(small_environment(variables), ROOT)
        self.enterContext(busy(CORES))

    def test_a_function(self) -> None:
        name, function = FUNCTION
        unit = find_units()[name]
        [target] = [one for one in wp_targets.targets(unit) if one.function == function]
        prover = wp.Wp(
            self.tools.frama_c(),
            self.runner,
            ROOT,
            self.scratch,
            None,
            self.tools.command("ocamlfind"),
        )
        recorded = read_goals(unit.goal_list, str(unit.goal_list)).provers
        result = prover.prove(target, recorded=recorded)
        self.assertEqual(result.problems, [])
        self.assertGreater(result.proved, 0)

    def test_a_harness(self) -> None:
        name, harness = HARNESS
        unit = find_units()[name]
        path = unit.folder / f"{harness}.c"
        checker = cbmc.Cbmc(
            self.tools.goto_cc(), self.tools.command("cbmc"), self.runner, ROOT, self.scratch
        )
        result = checker.prove(read_harness(unit, path))
        self.assertEqual(result.problems, [])
