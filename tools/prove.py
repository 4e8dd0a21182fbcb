#!/usr/bin/env python3
"""Prove Keel: every contract with Frama-C/WP, every harness with CBMC, rounding with Gappa.

    python3 tools/prove.py                    # everything
    python3 tools/prove.py --unit queue       # one unit
    python3 tools/prove.py --update-goals     # accept the goals as they are now, after review

Exit status: 0 when all is proved and the goals are those of proofs/UNIT/goals.txt, 1 when not, 2
for a wrong command line. build/prove/report.json has the details; there is none while a run is
not over. A verdict is kept in the user's cache (KEEL_CACHE) under all that it depends on, and only
success is: another clone of the same text has it, too.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from proofs.jobs import end_as_by_ctrl_c  # noqa: E402
from proofs.project import ROOT, ProjectError, find_units  # noqa: E402
from proofs.session import Choice, Session  # noqa: E402
from toolchain import Toolchain, ToolchainError  # noqa: E402

ENGINES = ("wp", "cbmc", "gappa")


def parse(arguments: Sequence[str] | None, names: Sequence[str]) -> argparse.Namespace:
    """The command line; a unit that does not exist is named, with those that do."""
    parser = argparse.ArgumentParser(description="Prove Keel with Frama-C/WP, CBMC and Gappa.")
    parser.add_argument("--unit", nargs="+", metavar="U", help="only these units")
    parser.add_argument("--engine", choices=ENGINES, help="only this engine")
    parser.add_argument("--update-goals", action="store_true", help="rewrite proofs/UNIT/goals.txt")
    parser.add_argument("-j", dest="width", type=int, default=min(2, os.cpu_count() or 1),
                        metavar="N", help="jobs side by side (default %(default)s)")  # fmt: skip
    parser.add_argument("--fresh", action="store_true",
                        help="prove everything, whatever verdicts are known")  # fmt: skip
    parser.add_argument("--quick", action="store_true",
                        help="give up early on what provers do not prove at once")  # fmt: skip
    options = parser.parse_args(arguments)
    unknown = [name for name in options.unit or () if name not in names]
    if unknown:
        parser.error(f"no such unit: {', '.join(unknown)} (there are: {', '.join(names)})")
    if options.width < 1:
        parser.error("-j needs at least 1")
    return options


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    end_as_by_ctrl_c()
    try:
        units = find_units()
        options = parse(arguments, list(units))
        tools = Toolchain()
        tools.ensure("prove")
        choice = Choice(
            units=tuple(units[name] for name in options.unit or units),
            partial=bool(options.unit or options.engine),
            engines=(options.engine,) if options.engine else ENGINES,
            width=options.width, verdicts=tools.cache.folder / "verdicts",
            fresh=options.fresh, quick=options.quick, update_goals=options.update_goals,
        )  # fmt: skip
        return Session(ROOT, tools, choice).run()
    except (ProjectError, ToolchainError) as error:
        print(f"prove: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("prove: interrupted; nothing was reported", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
