# SPDX-License-Identifier: Apache-2.0
"""Tests of which smoke tests tools/keel/engines/find_contradictions.ml asks: no fewer than say all.

They run Frama-C, and are skipped without it. `make check NAME=qualify` seeds what the tests find.
"""

from __future__ import annotations

import re
import shutil
import tempfile
import unittest
from pathlib import Path

from keel.install import Toolchain, ToolchainError
from keel.qualify.trials import said_by_frama_c

ROOT = Path(__file__).resolve().parents[2]

SCRIPT = ROOT / "tools/keel/engines/find_contradictions.ml"
ASKED = re.compile(r"^\[wp\] \[(?:Passed|Failed)\] Smoke-test typed_(\w+)", re.MULTILINE)
STEP = """\
/*@ assigns \\nothing; ensures 0 <= \\result <= v; */
extern unsigned step(unsigned v);

/*@ requires v < 100; assigns \\nothing; */
unsigned f(unsigned v)
{
"""
BRANCHES = """\
    if (v > 5u) {
        v = step(v);
        v++;
    } else {
        v = step(v + 1u);
    }
    v = step(v);
    return v;
"""
LOOP = """\
    /*@ loop invariant i <= 3; loop assigns i; loop variant 3 - i; */
    for (unsigned i = 0u; i < 3u; i++) {
    }
    return v;
"""


def frama_c_tools() -> Toolchain | None:
    """The tools, if Frama-C and its provers are among them."""
    try:
        tools = Toolchain()
        tools.command("frama-c")
        configured = Path(tools.environment()["WHY3CONFIG"]).is_file()
    except (ToolchainError, KeyError):
        return None
    return tools if configured else None


@unittest.skipUnless(frama_c_tools(), "Frama-C is not installed: make prove")
class Places(unittest.TestCase):
    def asked(self, body: str) -> list[str]:
        """What is asked of a function, without the numbers of its statements, in order."""
        tools = frama_c_tools()
        assert tools
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            file = folder / "f.c"
            file.write_text(f"{STEP}{body}}}\n", encoding="utf-8")
            script = str(shutil.copy(SCRIPT, folder))
            words = ["-load-script", script, "-wp-rte", "-wp-smoke-timeout", "2"]
            said = said_by_frama_c(tools, file, words, {"KEEL_SMOKE": "cvc4 60000 f"})
        return sorted(re.sub(r"_s\d+$", "", one) for one in ASKED.findall(said))

    def test_of_one_way_the_end_is_asked_and_the_precondition(self) -> None:
        asked = self.asked("    v = step(v);\n    v = step(v);\n    v = step(v);\n    return v;\n")
        end = ["f_wp_smoke_dead_code"]
        self.assertEqual(asked, [*end, "f_wp_smoke_default_requires"])

    def test_each_branch_is_asked_and_what_follows_them(self) -> None:
        asked = self.asked(BRANCHES)
        self.assertEqual(asked.count("f_wp_smoke_dead_code"), 2)
        self.assertEqual(asked.count("step_wp_smoke_dead_call"), 1)

    def test_a_loop_is_asked_inside_and_behind(self) -> None:
        self.assertEqual(self.asked(LOOP).count("f_wp_smoke_dead_code"), 2)
