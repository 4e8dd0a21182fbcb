# SPDX-License-Identifier: Apache-2.0
"""Fuzz the scheduler and the decoders beside their models, and decoders beside those of others.

    python3 tools/keel fuzz --seconds 60            # each target, with the sanitizers
    python3 tools/keel fuzz --runs 100000000        # frames to ours and others' decoders, so many
    python3 tools/keel fuzz --filter crsf

Corpora stay in build/fuzz, and help the next run; build/fuzz/report.json has the verdicts.

Exit status: 0 when nothing differs, 1 when something does or hangs, 2 when nothing could be run.
"""

from __future__ import annotations

from collections.abc import Sequence

from keel.base.arguments import Parser
from keel.base.errors import ROOT, program
from keel.base.jobs import end_as_by_ctrl_c
from keel.install import Toolchain
from keel.test import suites as running
from keel.test.fuzzing import BUILD, Fuzzing, fuzz_suites


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    end_as_by_ctrl_c()
    parser = Parser("Fuzz the kernel.", "fuzz")
    running.add_options(parser)
    parser.add_argument("--seconds", type=int, default=60, metavar="S", help="for each target")
    parser.add_argument(
        "--runs",
        type=int,
        default=0,
        metavar="N",
        help="so many executions instead, of targets that others judge",
    )
    options = running.parse(parser, arguments)
    if options.seconds < 1 or options.runs < 0:
        parser.error("--seconds needs at least 1, --runs at least 0")

    def work() -> int:
        running.begin(ROOT / BUILD)
        tools = Toolchain()
        fuzzing = Fuzzing(options.seconds, options.runs)
        suites = running.chosen(fuzz_suites(tools, fuzzing), options.filter)
        outcomes = running.run_all(tools, suites, options.jobs)
        facts = {"filter": options.filter, "seconds_each": options.seconds, "runs": options.runs}
        return running.end(ROOT / BUILD, "Keel, fuzzed", outcomes, facts)

    return program("fuzz", work)
