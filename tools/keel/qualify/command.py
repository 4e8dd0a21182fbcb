# SPDX-License-Identifier: Apache-2.0
"""Show that each tool still detects what it is trusted to detect: runs with seeded faults.

    python3 tools/keel qualify            # what this very tool has shown before is known
    python3 tools/keel qualify --fresh    # nothing is

Each fault stands beside the same text without it (tools/keel/qualify/seeds.py). A tool passes when
it complains of the fault, by the name under which the fault is known, and does not so without it.
The model of the chip is asked about mistakes in the boards' code (tests/target/mistakes.toml).
A new version of a tool, another file of it, or another way to ask is asked anew; what is known lies
in the user's cache, for all clones. build/qualify/report.json has what became of each fault. What
the project makes of a tool's words is tested elsewhere: specs/tools.toml names these tests.

Exit status: 0 when each fault is detected, 1 when one is not, 2 when none could be tried.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import sha256_of
from keel.base.source import digest_of_tree, write_report
from keel.base.verdict_cache import Cache, digest
from keel.install import Found, Toolchain
from keel.qualify import mistakes as chip
from keel.qualify.deceptions import SEEDS as DECEPTIONS
from keel.qualify.seeds import SEEDS, Seed
from keel.qualify.trials import ask

REPORT = "build/qualify/report.json"
KNOWN = "qualified"  # In the user's cache.
GROUPS = ("prove", "lint", "test", "coverage", "stack", "target")
# What asks the tools, and the board that is run on the emulator.
HOW = (
    "bsp",
    *(
        f"tools/keel/{room}"
        for room in (
            "analyse",
            "audit",
            "base",
            "boards",
            "c",
            "engines",
            "install/machdep",
            "judge",
            "prove",
            "qualify",
            "test",
        )
    ),
)
STARTS = ROOT / "tools/keel/install/provers.py"


def verdict_of(tools: Toolchain, seed: Seed, folder: Path) -> str:
    """Why a tool does not detect a fault; "" if it does."""
    try:
        without = ask(tools, seed.trial, seed.text, seed.option, folder / "good")
        said = ask(tools, seed.trial, seed.faulty, seed.option, folder / "bad")
    except ToolError as error:
        return str(error).replace("\n", " ")
    if any(seed.detects in text for text in without):
        return f"says {seed.detects!r} also where there is no fault"
    if not any(seed.detects in text for text in said):
        return f"does not say {seed.detects!r}, but: {'; '.join(said) or 'nothing'}"
    return ""


def how_asked() -> list[str]:
    """The digests of all that a verdict depends on besides the tools and the seed."""
    return [digest_of_tree(ROOT, HOW), sha256_of(STARTS)]


def key_of(seed: Seed, found: Mapping[str, Found], how: Sequence[str]) -> str:
    """All that a verdict depends on."""
    tools = {
        name: [one.version, one.sha256, one.parts]
        for name, one in found.items()
        if name not in ("why3-config",)
    }
    return digest({"seed": asdict(seed), "tools": tools, "how": how})


def qualify(tools: Toolchain, seeds: Sequence[Seed], cache: Cache) -> list[dict[str, str]]:
    """Ask about each fault; those that were detected before by the same tools are known."""
    found, how = tools.versions(*GROUPS), how_asked()
    runs = []
    for seed in seeds:
        key = key_of(seed, found, how)
        known = cache.get(key)
        if known is None:
            with tempfile.TemporaryDirectory(prefix="keel-seed-") as folder:
                wrong = verdict_of(tools, seed, Path(folder))
            if not wrong:
                cache.put(key, {"detected": True})
            print(f"{seed.name}: {wrong or 'detected'}", flush=True)
        else:
            wrong = ""
        runs.append(
            {
                "tool": seed.tool,
                "fault": seed.fault,
                "how": seed.trial,
                "version": found[seed.tool].version,
                "wrong": wrong,
            }
        )
    return runs


def main(
    arguments: Sequence[str] | None = None,
    root: Path = ROOT,
    seeds: Sequence[Seed] = (*SEEDS, *DECEPTIONS),
    known: Path | None = None,
    mistakes: Sequence[chip.Mistake] | None = None,
) -> int:
    """Entry point."""
    parser = Parser("Show that each tool detects what it is trusted to detect.", "qualify")
    parser.add_argument("--fresh", action="store_true", help="ask also what is known")
    options = parser.parse_args(arguments)

    def work() -> int:
        (root / REPORT).unlink(missing_ok=True)
        seeded = chip.read_mistakes() if mistakes is None else mistakes
        tools = Toolchain()
        tools.ensure(*GROUPS)
        cache = Cache(known or tools.cache.folder / KNOWN, options.fresh)
        runs = [*qualify(tools, seeds, cache), *chip.rows(tools, seeded, cache)]
        cache.prune()
        failed = [one for one in runs if one["wrong"]]
        problems = [f"{one['tool']}: {one['fault']}: {one['wrong']}" for one in failed]
        write_report(root / REPORT, {"problems": problems, "runs": runs}, root, good=not problems)
        for problem in problems:
            print(f"FAILED {problem}")
        print(f"qualify: {len(runs) - len(problems)} of {len(runs)} seeded faults detected")
        return 1 if problems else 0

    return program("qualify", work)
