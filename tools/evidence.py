#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Make the evidence package of the present commit, or verify one: docs/evidence.md.

    python3 tools/evidence.py                     # run what has to be run, write build/evidence
    python3 tools/evidence.py --as-is             # run nothing: the reports as they are
    python3 tools/evidence.py --draft FOLDER      # what there is, problems included, unsealed
    python3 tools/evidence.py --verify FOLDER     # is a package as it was made?

A package is written as a whole, and only when nothing is wrong; else the one that was there stays,
and each problem is told in a line.

Exit status: 0 when the package is written or is as it was made, 1 when something is wrong, 2 when
it could not be tried.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from pathlib import Path

from common.arguments import Parser
from common.errors import ROOT, ToolError, program
from common.packages import provide
from common.source import stamp_of
from toolchain import Toolchain

provide("common")
provide("evidence")

from evidence.assemble import assemble  # noqa: E402
from evidence.commands import run_commands  # noqa: E402
from evidence.package import Source, source_of, write_package  # noqa: E402
from evidence.part import Context  # noqa: E402
from evidence.verify import verify  # noqa: E402


def tell(line: str) -> None:
    """Progress, at once."""
    print(line, flush=True)


def context_of(root: Path, out: Path) -> Context:
    """What the parts may look at."""
    work = out.with_name(f"{out.name}-work")
    work.mkdir(parents=True, exist_ok=True)
    return Context(root, root / "build", work, stamp_of(root), tell)


def versions() -> dict[str, str]:
    """The tools that are here, with their versions."""
    return {name: found.version for name, found in sorted(Toolchain().versions().items())}


def refused(source: Source) -> list[str]:
    """A package is made of a commit."""
    return [f"{name}: is not as the commit has it: commit it, or say --dirty"
            for name in source.changed]  # fmt: skip


def closing(problems: Sequence[str], done: str) -> int:
    """Tell the problems, and end with one line."""
    for problem in problems:
        tell(f"FAILED {problem}")
    tell(f"evidence: {done}" if not problems else f"evidence: {len(problems)} problems, {done}")
    return 1 if problems else 0


def make(out: Path, as_is: bool, dirty: bool, draft: Path | None) -> int:
    """Make the package, or the draft of one."""
    begun = time.monotonic()
    context = context_of(ROOT, out)
    source = source_of(ROOT, context.stamp)
    problems = [] if dirty or draft else refused(source)
    if not as_is and not problems:
        problems += run_commands(context)
    made = assemble(context)
    made.problems[:0] = problems
    seconds = f"in {time.monotonic() - begun:.0f} s"
    if draft:
        write_package(draft, made, source, versions(), sealed=False)
        return closing(made.problems, f"a draft is in {draft}, {seconds}")
    if made.problems:
        return closing(made.problems, f"nothing is written, {seconds}")
    if stamp_of(ROOT) != context.stamp:
        return closing(["the source has changed meanwhile"], f"nothing is written, {seconds}")
    write_package(out, made, source, versions())
    return closing([], f"{out} is written, {seconds}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = Parser("Make the evidence package, or verify one.", "evidence")
    parser.add_argument("--as-is", action="store_true", help="run no command before")
    parser.add_argument("--dirty", action="store_true", help="also with uncommitted changes")
    parser.add_argument("--draft", type=Path, metavar="FOLDER", help="write one with its problems")
    parser.add_argument("--verify", type=Path, metavar="FOLDER", help="look at a package only")
    parser.add_argument("--out", type=Path, default=ROOT / "build/evidence", metavar="FOLDER")
    options = parser.parse_args(arguments)

    def work() -> int:
        if options.verify:
            return closing(verify(options.verify, stamp_of(ROOT)), f"{options.verify} is verified")
        if options.draft and options.draft.resolve() == options.out.resolve():
            raise ToolError("a draft has a folder of its own")
        return make(options.out, options.as_is, options.dirty, options.draft)

    return program("evidence", work)


if __name__ == "__main__":
    sys.exit(main())
