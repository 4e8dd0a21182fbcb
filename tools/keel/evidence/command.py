# SPDX-License-Identifier: Apache-2.0
"""Make the evidence package of the present commit, or verify one: docs/evidence.md.

    python3 tools/keel evidence                     # run what has to be run, write build/evidence
    python3 tools/keel evidence --as-is             # run nothing: the reports as they are
    python3 tools/keel evidence --draft FOLDER      # the same, problems included, and unsealed
    python3 tools/keel evidence --verify FOLDER     # is a package as it was made?
    python3 tools/keel evidence --same ONE OTHER    # do two differ in measured seconds alone?
    python3 tools/keel evidence --project FOLDER    # the package of a project that uses Keel

A package is written as a whole, and only when nothing is wrong; else the one that was there stays,
and each problem is told in a line. With KEEL_PROVED=1 in the environment nothing is proved: the
report of the proofs is the one that `prove --join` has written, of the same commit, files
and tools; another one is refused. build/evidence-work has the logs of the commands that were run,
and summary.md, a short table for CI.

Exit status: 0 when the package is written or is as it was made, 1 when something is wrong, 2 when
it could not be tried.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import write_text
from keel.base.source import stamp_of
from keel.install import Toolchain
from keel.install.packages import provide

provide("common")
provide("evidence")

from keel.evidence.assemble import OWN_PARTS, Assembled, assemble, own_maker_of
from keel.evidence.commands import (
    Command,
    commands_of,
    handed_over,
    not_good,
    own_commands,
    run_commands,
)
from keel.evidence.digest import as_markdown
from keel.evidence.package import Source, source_of, write_package
from keel.evidence.verify import reproduced, verify
from keel.gather.part import Context
from keel.gather.parts.tools import GROUPS
from keel.gather.strength.mutants import foreseen

BEGUN = time.monotonic()


def tell(line: str) -> None:
    """Progress, at once."""
    print(line, flush=True)


def context_of(root: Path, out: Path) -> Context:
    """What the parts may look at."""
    stamp = stamp_of(root)
    work = out.with_name(f"{out.name}-work")
    work.mkdir(parents=True, exist_ok=True)
    return Context(root, root / "build", work, stamp, tell)


def versions() -> dict[str, str]:
    """The tools that are here, with their versions."""
    return {name: found.version for name, found in sorted(Toolchain().versions().items())}


def refused(source: Source) -> list[str]:
    """A package is made of a commit."""
    return [
        f"{name}: is not as the commit has it: commit it, or say --dirty" for name in source.changed
    ]


def closing(problems: Sequence[str], done: str) -> int:
    """Tell the problems, and end with one line."""
    for problem in problems:
        tell(f"FAILED {problem}")
    many = f"{len(problems)} problem{'s' * (len(problems) > 1)}, " if problems else ""
    tell(f"evidence: {many}{done}, in {time.monotonic() - BEGUN:.0f} s")
    return 1 if problems else 0


@dataclass(frozen=True)
class Choice:
    """Keel itself, or a project that uses it."""

    root: Path
    out: Path
    as_is: bool
    dirty: bool

    @property
    def own(self) -> bool:
        """Whether it is a project of a user's."""
        return self.root != ROOT

    def commands(self) -> tuple[Command, ...]:
        """What makes the reports."""
        return own_commands() if self.own else commands_of(self.root)

    def assemble(self, context: Context) -> Assembled:
        """All parts."""
        if not self.own:
            return assemble(context)
        return replace(assemble(context, OWN_PARTS, own_maker_of), product=self.root.name)


def make(choice: Choice) -> int:
    """Make the package."""
    context = context_of(choice.root, choice.out)
    source = source_of(choice.root, context.stamp)
    problems = [] if choice.dirty else refused(source)
    if not choice.as_is and not problems:
        # The commands take a quarter of an hour, which is lost where it is known how it ends.
        problems = handed_over(context)
        problems += [] if choice.own else foreseen(choice.root)
        if not choice.own:
            # Where the reports of other machines hold, no command installs what they are held to.
            Toolchain().ensure(*GROUPS)
        if problems:
            return closing(problems, "no command is run, nothing is written")
        problems = run_commands(context, choice.commands())
    problems += not_good(context, choice.commands())
    made = choice.assemble(context)
    problems += made.problems
    if not problems and stamp_of(choice.root) != context.stamp:
        problems = ["the source has changed meanwhile"]
    write_text(context.work / "summary.md", as_markdown(made, problems))
    if problems:
        return closing(problems, "nothing is written")
    write_package(choice.out, made, source, versions())
    return closing([], f"{choice.out} is written")


def make_draft(choice: Choice, draft: Path) -> int:
    """Make what there is, with its problems on every page."""
    if draft.resolve() == choice.out.resolve():
        raise ToolError("a draft has a folder of its own")
    context = context_of(choice.root, choice.out)
    made = choice.assemble(context)
    made.problems[:0] = not_good(context, choice.commands())
    source = source_of(choice.root, context.stamp)
    write_package(draft, made, source, versions(), sealed=False)
    return closing(made.problems, f"a draft is in {draft}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = Parser("Make the evidence package, or verify one.", "evidence")
    parser.add_argument("--as-is", action="store_true", help="run no command before")
    parser.add_argument("--dirty", action="store_true", help="also with uncommitted changes")
    parser.add_argument("--draft", type=Path, metavar="FOLDER", help="write one with its problems")
    parser.add_argument("--verify", type=Path, metavar="FOLDER", help="look at a package only")
    parser.add_argument(
        "--same",
        type=Path,
        nargs=2,
        metavar=("ONE", "OTHER"),
        help="do two packages of one source differ in measured seconds alone?",
    )
    parser.add_argument("--out", type=Path, metavar="FOLDER", help="build/evidence unless said")
    parser.add_argument(
        "--project",
        type=Path,
        default=ROOT,
        metavar="FOLDER",
        help="a project that uses Keel, rather than Keel itself",
    )
    options = parser.parse_args(arguments)
    root = options.project.resolve()

    def work() -> int:
        if options.verify:
            problems = verify(options.verify, stamp_of(root))
            return closing(problems, f"{options.verify} is {'not ' * bool(problems)}as it was made")
        if options.same:
            problems = reproduced(*options.same)
            return closing(problems, f"{'not ' * bool(problems)}the same but for measured seconds")
        out = options.out or root / "build/evidence"
        choice = Choice(root, out, options.as_is, options.dirty)
        return make_draft(choice, options.draft) if options.draft else make(choice)

    return program("evidence", work)
